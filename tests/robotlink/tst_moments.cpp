// SPDX-License-Identifier: GPL-3.0-or-later
// Looking back at a simulated match: frames from rows, sessions, exact re-entry, scenarios of
// moments.
#include <QtTest>

#include <random>
#include <set>

#include <robotlink/frame/build_robot.h>
#include <robotlink/match/match_runner.h>
#include <robotlink/match/referee_packet.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/moment_scenario.h>
#include <robotlink/session/recorded_frame.h>
#include <simcore/rules/game_start.h>

#include "../support/frame_settings.h"
#include "../support/group_facts.h"

namespace tst_moments {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;

namespace {

/// Snapshots, boards and hashes by tick, as the match went on from them.
class Witness : public TickObserver {
 public:
  struct Seen {
    sim::Snapshot snapshot;
    std::uint64_t hash = 0;
    std::map<int, std::vector<std::uint32_t>> boards;
  };
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds) override {
    Seen& s = seen[match.simulation().state().tick];
    s.snapshot = match.simulation().snapshot();
    s.hash = match.simulation().hash();
    for (const auto& robot : s.snapshot.robots) {
      auto& words = s.boards[robot.identity.id.value];
      words.resize(Blackboard::words);
      match.blackboard(robot.identity.id)
          ->copyWords(std::span<std::uint32_t, Blackboard::words>(words.data(), Blackboard::words));
    }
  }
  std::map<std::uint64_t, Seen> seen;
};

Scenario scenarioOf(const char* physics = "rigid-body") {
  Scenario scenario = loadScenario("match-3v3").value();
  scenario.settings.physics = physics;
  scenario.settings.noise = noisePreset("paper").value();
  scenario.stop = {};
  return scenario;
}

const RecorderOptions recording;

/// A match that was played for 20 s, seen by everybody.
struct Played {
  explicit Played(const QString& folder, const char* physics = "rigid-body")
      : scenario(scenarioOf(physics)), path((folder + "/match.mcap").toStdString()) {
    const auto sampler = std::make_shared<MatchSampler>(
        std::shared_ptr<telemetry::RowSink>(std::shared_ptr<void>(), &store));
    recorder =
        MatchRecorder::create(path, scenario, VariableCatalog::published(), sampler, recording)
            .value();
    runner = MatchRunner::start(scenario, {}, true, VariableCatalog::published(),
                                {archive, sampler, recorder, witness})
                 .value();
    runner->runTo(500);
    if (!runner->waitUntilStill(60s)) qFatal("still playing");
    runner->execute([](SimulatedMatch& m) {
      (void)m.simulation().placeBall({0.5, -1}, {1, 0.3});
      (void)m.robots().add(
          {{RobotId{9}, TeamColor::Blue, 7, false}, {{-2, 2}, 1.0}, "striker", {}});
      (void)m.robots().remove(RobotId{2});
      return Changed::Yes;
    });
    runner->runTo(700);
    if (!runner->waitUntilStill(60s)) qFatal("still playing");
    runner->execute([](SimulatedMatch& m) {
      (void)m.simulation().setPhysics("published");
      return Changed::Yes;
    });
    runner->runTo(1200);
    if (!runner->waitUntilStill(60s)) qFatal("still playing");
  }
  void stop() {
    // With its thread: a match that stands still shows itself to its observers after every command.
    runner.reset();
    const auto finished = recorder->finish();
    if (!finished) qFatal("%s", finished.error().text().c_str());
  }

  Scenario scenario;
  std::string path;
  telemetry::SeriesStore store;
  std::shared_ptr<StateArchive> archive = std::make_shared<StateArchive>();
  std::shared_ptr<Witness> witness = std::make_shared<Witness>();
  std::shared_ptr<MatchRecorder> recorder;
  std::unique_ptr<MatchRunner> runner;
};

void compareFrame(const MatchFrame& frame, const Witness::Seen& seen) {
  QVERIFY(frame.origin == FrameOrigin::Recorded && frame.truthKnown && frame.ballKnown);
  QCOMPARE(frame.snapshot.tick, seen.snapshot.tick);
  QVERIFY(frame.snapshot.ball == seen.snapshot.ball);
  QVERIFY(frame.snapshot.score == seen.snapshot.score);
  QCOMPARE(frame.snapshot.clock, seen.snapshot.clock);
  QCOMPARE(frame.robots.size(), seen.snapshot.robots.size());
  for (const sim::RobotSnapshot& robot : seen.snapshot.robots) {
    const RobotFrame* found = frame.robot(robot.identity.id);
    QVERIFY(found != nullptr && found->identity == robot.identity);
    QVERIFY(found->boardKey && !found->link);
    QVERIFY(found->pose.position == robot.pose.position);
    QVERIFY(std::abs(std::remainder(found->pose.yaw - robot.pose.yaw, 6.283185307179586)) < 1e-12);
    QVERIFY(found->statistics == robot.statistics);
    QCOMPARE(found->action, robot.action);
  }
}

void compareBoards(const Moment& moment, const Witness::Seen& seen) {
  QCOMPARE(moment.robots.size(), seen.snapshot.robots.size());
  for (const MomentRobot& robot : moment.robots) {
    QCOMPARE(robot.words.size(), VariableCatalog::published().variables().size());
    for (const BoardWord& word : robot.words) {
      QCOMPARE(word.bits, seen.boards.at(robot.id.value)[static_cast<std::size_t>(word.index)]);
    }
  }
}

}  // namespace

class TestMoments : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  std::unique_ptr<Played> m_match;

 private slots:
  void initTestCase() {
    QVERIFY(m_folder.isValid());
    m_match = std::make_unique<Played>(m_folder.path());
    m_match->stop();
  }

  void framesComeFromMemory() {
    RecordedFrames frames;
    const double oneTick = 1.0 / 60;
    // Not 500: a robot that was taken away then has a row of that very time.
    for (const std::uint64_t tick : {0U, 1U, 300U, 499U, 501U, 900U, 1200U}) {
      const MatchFrame frame = frames.frameAt(m_match->store, static_cast<double>(tick) * oneTick);
      compareFrame(frame, m_match->witness->seen.at(tick));
      if (tick < 60) continue;
      // The battery is that of the robot's model (kid-size in this scenario), not the usual one.
      const auto limits = batteryLimitsOf(m_match->scenario.robots[0].model);
      const auto& battery = frame.robots[0].battery;
      QVERIFY(battery && *battery == telemetry::batteryAt(battery->volts, limits));
      QVERIFY(frame.robots[0].lamps[1].state == telemetry::HeartbeatState::Working);
      QVERIFY(!frame.robots[0].behaviour.empty());
    }
    // Back at the first moment, no process has worked yet, whatever was shown before.
    const MatchFrame first = frames.frameAt(m_match->store, 0.0);
    for (const auto& lamp : first.robots[0].lamps) {
      QVERIFY(lamp.state != telemetry::HeartbeatState::NotResponding);
    }
  }

  void framesComeFromASession() {
    const auto session = telemetry::SessionReader::open(m_match->path).value();
    QVERIFY(session.complete() && session.notes().empty());
    const FrameSettings backdrop = backdropOf(session);
    QVERIFY(backdrop.field == m_match->scenario.settings.field);
    QVERIFY(backdrop.noise == m_match->scenario.settings.noise);
    RecordedFrames frames(backdrop);
    for (const std::uint64_t tick : {0U, 1U, 300U, 499U, 501U, 900U, 1200U, 7U}) {
      const MatchFrame frame = frames.frameAt(session, static_cast<double>(tick) / 60);
      compareFrame(frame, m_match->witness->seen.at(tick));
      QVERIFY(frame.settings->noise == m_match->scenario.settings.noise);
      QCOMPARE(frame.settings->seed, m_match->scenario.settings.seed);
    }
    // Before the first row there is nothing, and that is no error.
    QVERIFY(frames.frameAt(session, -5).robots.empty());
    const auto events = session.events();
    QVERIFY(
        std::any_of(events.begin(), events.end(), [](const auto& e) { return e.kind == "kick"; }));
  }

  void aRecordedMomentIsEnteredExactly() {
    const auto session = telemetry::SessionReader::open(m_match->path).value();
    std::mt19937 random(5);
    for (int i = 0; i < 40; ++i) {
      const std::uint64_t tick = i < 3 ? 499 + static_cast<std::uint64_t>(i) : random() % 1200;
      const auto& seen = m_match->witness->seen.at(tick);
      const double seconds = static_cast<double>(tick) / 60;
      const auto fromFile = momentFromSession(session, seconds, VariableCatalog::published());
      QVERIFY2(fromFile, fromFile ? "" : fromFile.error().text().c_str());
      QVERIFY2(sim::stateHash(fromFile->state) == seen.hash, qPrintable(QString::number(tick)));
      const auto fromMemory =
          momentFromMemory(*m_match->archive, m_match->store, tick, VariableCatalog::published());
      QVERIFY2(fromMemory, fromMemory ? "" : fromMemory.error().text().c_str());
      QVERIFY(sim::stateHash(fromMemory->state) == seen.hash);
      for (const Moment& moment : {*fromFile, *fromMemory}) {
        compareBoards(moment, seen);
      }
    }
    QVERIFY(!momentFromSession(session, -10, VariableCatalog::published()));
  }

  void anAdvisorOfARunningMatchKeepsThePast() {
    const Scenario scenario = scenarioOf();
    const std::string path = m_folder.filePath("advised.mcap").toStdString();
    telemetry::SeriesStore store;
    const auto sampler = std::make_shared<MatchSampler>(
        std::shared_ptr<telemetry::RowSink>(std::shared_ptr<void>(), &store));
    const auto archive = std::make_shared<StateArchive>();
    const auto witness = std::make_shared<Witness>();
    const auto recorder =
        MatchRecorder::create(path, scenario, VariableCatalog::published(), sampler, recording)
            .value();
    auto runner = MatchRunner::start(scenario, {}, true, VariableCatalog::published(),
                                     {archive, sampler, recorder, witness})
                      .value();
    const auto playTo = [&](std::uint64_t tick, std::optional<AdvisorOptions> advisor) {
      runner->runTo(tick);
      if (!runner->waitUntilStill(60s)) qFatal("still playing");
      runner->execute([advisor](SimulatedMatch& m) {
        if (!m.robots().setAdvisor(TeamColor::Blue, advisor)) qFatal("no advisor");
        return Changed::Yes;
      });
    };
    const AdvisorOptions learns;
    playTo(120, learns);
    playTo(240, {});
    playTo(300, learns);
    playTo(360, {});
    runner.reset();
    QVERIFY(recorder->finish());

    // In memory: each robot is one group, with everything it had and has.
    const auto session = telemetry::SessionReader::open(path).value();
    QCOMPARE(store.groups(), scenario.robots.size() + 1);
    QCOMPARE(session.groups().size(), store.groups());
    for (telemetry::GroupId g = 0; g < store.groups(); ++g) {
      const auto view = store.view(g);
      QVERIFY(view->range()->begin == 0.0 && view->range()->end == 6.0);
      std::set<std::string> names;
      for (const auto& column : session.groups()[g].info.columns) names.insert(column.name);
      QCOMPARE(names.size(), session.groups()[g].info.columns.size());
      QCOMPARE(names.size(), view->info().columns.size());
    }
    const auto advice = store.find("B1", "ADVISOR_AIM");
    const auto truth = store.find("B1", "TRUE_X");
    QVERIFY(advice && truth);
    RecordedFrames fromRows, fromFile;
    for (const std::uint64_t tick : {60U, 119U, 180U, 239U, 270U, 330U}) {
      const auto& seen = witness->seen.at(tick);
      const double seconds = static_cast<double>(tick) / 60;
      const bool isAdvised = (tick > 120 && tick < 240) || tick > 300;
      QCOMPARE(std::isnan(store.view(advice->group)->at(advice->column, seconds)->value),
               !isAdvised);
      QVERIFY(std::isfinite(store.view(truth->group)->at(truth->column, seconds)->value));
      for (const MatchFrame& frame :
           {fromRows.frameAt(store, seconds), fromFile.frameAt(session, seconds)}) {
        compareFrame(frame, seen);
        const RobotFrame* robot = frame.robot(scenario.robots[0].identity.id);
        QVERIFY(robot->lamps[1].state == telemetry::HeartbeatState::Working);
      }
      const auto inMemory =
          momentFromMemory(*archive, store, tick, VariableCatalog::published()).value();
      const auto inFile = momentFromSession(session, seconds, VariableCatalog::published()).value();
      for (const Moment& moment : {inMemory, inFile}) {
        compareBoards(moment, seen);
        auto match = SimulatedMatch::create(scenario, {}).value();
        QVERIFY(match.restore(moment));
        QCOMPARE(match.simulation().hash(), seen.hash);
        // What the robots believe is what they believed.
        for (const auto& robot : scenario.robots) {
          const auto& board = seen.boards.at(robot.identity.id.value);
          const IntVar x = match.variables().localizationX;
          QCOMPARE(static_cast<std::uint32_t>(match.blackboard(robot.identity.id)->read(x)),
                   board[static_cast<std::size_t>(x.index)]);
        }
      }
    }

    // What is saved of the past has each column once, too.
    RecentPast past;
    past.rows = &store;
    past.archive = archive.get();
    past.scenario = scenarioToJson(scenario);
    const std::string recent = m_folder.filePath("advised-recent.mcap").toStdString();
    QVERIFY(saveRecent(recent, 100.0, past, sessionInfo(scenario, recording)));
    const auto saved = telemetry::SessionReader::open(recent).value();
    QCOMPARE(saved.groups().size(), store.groups());
    const auto moment = momentFromSession(saved, 1.0, VariableCatalog::published()).value();
    compareBoards(moment, witness->seen.at(60));
  }

  void aMatchGoesOnFromAMoment() {
    const auto session = telemetry::SessionReader::open(m_match->path).value();
    const auto moment = momentFromSession(session, 15.0, VariableCatalog::published()).value();
    auto match = SimulatedMatch::create(m_match->scenario, {}).value();
    for (int i = 0; i < 50; ++i) match.tick();
    const auto entered = match.restore(moment);
    QVERIFY2(entered, entered ? "" : entered.error().text().c_str());
    QCOMPARE(match.simulation().hash(), m_match->witness->seen.at(900).hash);
    QVERIFY(match.blackboard(RobotId{9}) && !match.blackboard(RobotId{2}));
    QCOMPARE(match.robots().find(RobotId{9})->behaviour, std::string("striker"));
    const auto& names = match.variables();
    QCOMPARE(std::bit_cast<std::uint32_t>(match.blackboard(RobotId{9})->read(names.controlAction)),
             m_match->witness->seen.at(900).boards.at(
                 9)[static_cast<std::size_t>(names.controlAction.index)]);
    for (int i = 0; i < 100; ++i) match.tick();
    QCOMPARE(match.simulation().state().tick, std::uint64_t{1000});
    Scenario other = m_match->scenario;
    other.settings.tickRate = 120;
    QVERIFY(!SimulatedMatch::create(other, {}).value().restore(moment));
  }

  void theRecentPastIsSaved() {
    RecentPast past;
    past.rows = &m_match->store;
    past.archive = m_match->archive.get();
    past.events.resize(2);
    for (MatchEvent& event : past.events) event.kind = MatchEventKind::Bookmark;
    past.events[0].time = 1.0;  // too old
    past.events[1].time = 18.0;
    past.scenario = scenarioToJson(m_match->scenario);
    const std::string path = m_folder.filePath("recent.mcap").toStdString();
    const auto saved = saveRecent(path, 5.0, past, sessionInfo(m_match->scenario, recording));
    QVERIFY2(saved, saved ? "" : saved.error().text().c_str());
    QCOMPARE(saved->dropped, std::uint64_t{0});
    const auto session = telemetry::SessionReader::open(path).value();
    QCOMPARE(session.events().size(), std::size_t{1});
    RecordedFrames frames(backdropOf(session));
    for (const std::uint64_t tick : {901U, 1000U, 1200U}) {
      const double seconds = static_cast<double>(tick) / 60;
      compareFrame(frames.frameAt(session, seconds), m_match->witness->seen.at(tick));
      const auto moment = momentFromSession(session, seconds, VariableCatalog::published());
      QVERIFY2(moment, moment ? "" : moment.error().text().c_str());
      QCOMPARE(sim::stateHash(moment->state), m_match->witness->seen.at(tick).hash);
    }
    QCOMPARE(saveRecent(path, 5.0, past, {}).error().code, ErrorCode::Conflict);
    const telemetry::SeriesStore empty;
    past.rows = &empty;
    QVERIFY(!saveRecent(path + "2", 5.0, past, {}));
  }

  void anExistingFileIsNeverWrittenOver() {
    const auto again =
        MatchRecorder::create(m_match->path, m_match->scenario, VariableCatalog::published(),
                              std::make_shared<MatchSampler>(), recording);
    QVERIFY(!again);
    QCOMPARE(again.error().code, ErrorCode::Conflict);
  }

  void aMomentBecomesAScenario_data() {
    QTest::addColumn<QString>("physics");
    QTest::addColumn<bool>("believed");
    QTest::newRow("rigid-body, true") << "rigid-body" << false;
    QTest::newRow("rigid-body, believed") << "rigid-body" << true;
    QTest::newRow("published, true") << "published" << false;
    QTest::newRow("published, believed") << "published" << true;
  }
  void aMomentBecomesAScenario() {
    QFETCH(QString, physics);
    QFETCH(bool, believed);
    RecordedFrames frames;
    MatchFrame frame = frames.frameAt(m_match->store, 15.0);
    ownSettings(frame).field = m_match->scenario.settings.field;
    ownSettings(frame).physics = physics.toStdString();
    frame.snapshot.score = {2, 1};
    MomentOptions options;
    options.base = &m_match->scenario;
    if (believed) {
      options.poses = MomentOptions::Poses::Believed;
      options.ball = MomentOptions::Ball::Perceived;
    }
    const MomentScenario made = scenarioFromMoment(frame, options);
    auto match = SimulatedMatch::create(made.scenario, {});
    QVERIFY2(match, match ? "" : match.error().text().c_str());
    const sim::Snapshot start = match->simulation().snapshot();
    QVERIFY(start.score == (sim::Score{2, 1}));
    QVERIFY(std::abs(start.clock - frame.snapshot.clock) < 1e-9);
    QCOMPARE(start.robots.size(), frame.robots.size());
    for (std::size_t i = 0; !believed && i < start.robots.size(); ++i) {
      QVERIFY(std::hypot(start.robots[i].pose.position.x - frame.robots[i].pose.position.x,
                         start.robots[i].pose.position.y - frame.robots[i].pose.position.y) < 0.05);
    }
    for (int i = 0; i < 600; ++i) match->tick();
    const auto text = scenarioToJson(made.scenario);
    QVERIFY(scenarioFromJson(text, "moment.json"));
  }

  void whateverIsSeenCanBeStarted() {
    MatchFrame frame;
    frame.origin = FrameOrigin::Live;
    frame.truthKnown = frame.ballKnown = false;
    const double nan = std::nan("");
    const std::vector<Pose> poses{{{99, 99}, 0},  {{nan, 0}, nan}, {{1, 1}, 0}, {{1, 1}, 3},
                                  {{1.05, 1}, 9}, {{-4, 0}, 1},    {{0, 0}, 0}};
    for (std::size_t i = 0; i < poses.size(); ++i) {
      RobotFrame robot;
      robot.identity.id.value = i == 1 ? 70000 : static_cast<int>(i % 5);
      robot.identity.number = static_cast<int>(i % 3);
      robot.pose = poses[i];
      frame.robots.push_back(robot);
    }
    frame.snapshot.score = {-4, 3};
    frame.snapshot.clock = nan;
    ownSettings(frame).field.length = -3;
    for (const char* physics : {"rigid-body", "published", "something new"}) {
      ownSettings(frame).physics = physics;
      const MomentScenario made = scenarioFromMoment(frame);
      QVERIFY(made.notes.size() >= 5);
      auto match = SimulatedMatch::create(made.scenario, {});
      QVERIFY2(match, match ? "" : match.error().text().c_str());
      const auto start = match->simulation().snapshot();
      QCOMPARE(start.robots.size(), poses.size());
      for (std::size_t a = 0; a < start.robots.size(); ++a) {
        for (std::size_t b = a + 1; b < start.robots.size(); ++b) {
          const Point p = start.robots[a].pose.position, q = start.robots[b].pose.position;
          QVERIFY(distance(p, q) >= 2 * made.scenario.settings.field.robotRadius);
        }
      }
      for (int i = 0; i < 60; ++i) match->tick();
      QVERIFY(scenarioFromJson(scenarioToJson(made.scenario), "moment.json"));
    }
  }

  void theBallIsWhereMostRobotsSeeIt() {
    MatchFrame frame;
    frame.origin = FrameOrigin::Live;
    frame.truthKnown = frame.ballKnown = false;
    const Point ball{1.0, 0.5};
    for (int i = 0; i < 4; ++i) {
      RobotFrame robot;
      robot.identity = {RobotId{i + 1}, TeamColor::Blue, i + 1, false};
      robot.pose = {{-1.0 + i, -1.0}, 0.3 * i};
      // The last one sees something else.
      const Point seen = i == 3 ? Point{-4, -2} : Point{ball.x + 0.1 * (i - 1), ball.y};
      robot.ball = SeenBall{seen, distance(seen, robot.pose.position), 0.0};
      frame.robots.push_back(robot);
    }
    MomentScenario made = scenarioFromMoment(frame);
    QVERIFY(distance(made.scenario.ball, ball) < 1e-4);
    QCOMPARE(made.notes.size(), std::size_t{1});
    QVERIFY2(made.notes[0].find("3 of 4") != std::string::npos, made.notes[0].c_str());
    for (RobotFrame& robot : frame.robots) robot.ball.reset();
    made = scenarioFromMoment(frame);
    QVERIFY(made.scenario.ball == Point{});
    QCOMPARE(
        made.notes,
        (std::vector<std::string>{"No robot sees the ball, so it is placed on the centre mark."}));
  }

  void simulateFromHereKeepsTheGame_data() {
    QTest::addColumn<int>("version");
    QTest::addColumn<int>("size");
    QTest::newRow("v9") << 9 << 244;
    QTest::newRow("v12") << 12 << 688;
    QTest::newRow("v20") << 20 << 158;
  }
  void simulateFromHereKeepsTheGame() {
    QFETCH(int, version);
    QFETCH(int, size);
    // The game that the referee tells of.
    Scenario scenario = loadScenario("match").value();
    scenario.settings.referee->packetVersion = version;
    scenario.settings.referee->packetSize = size;
    scenario.settings.teams = {{TeamColor::Blue, 12, "RoboFEI"}, {TeamColor::Red, 5, ""}};
    sim::GameStart& game = scenario.game.emplace();
    game.state = PlayState::Playing;
    game.half = 2;
    game.clock = 451.5;
    game.left = TeamColor::Red;
    game.teams[TeamColor::Blue].score = 3;
    game.robots[RobotId{2}] = {.penalty = PenaltyKind::Incapable, .left = 21.0};
    const auto reported = SimulatedMatch::create(scenario, {}).value();
    // Seen live.
    MatchFrame frame;
    frame.origin = FrameOrigin::Live;
    frame.truthKnown = frame.ballKnown = false;
    frame.teams = {{}, {12, "RoboFEI", TeamColor::Blue, true}, {5, "", TeamColor::Red, false}};
    const telemetry::RefereeState packet = refereePacket(reported.simulation().state(), 1, true);
    frame.game = telemetry::gameOf(packet);
    frame.reception.version = packet.version;
    frame.reception.size = packet.size;
    for (const sim::RobotSnapshot& one : reported.simulation().snapshot().robots) {
      RobotFrame& robot = frame.robots.emplace_back();
      static_cast<sim::RobotSnapshot&>(robot) = one;
      robot.key = {one.identity.team == TeamColor::Blue ? 1 : 2, one.identity.number, 0};
      robot.belief = robot.pose;
    }
    const MomentScenario made = scenarioFromMoment(frame);
    const auto match = SimulatedMatch::create(made.scenario, {});
    QVERIFY2(match, match ? "" : match.error().text().c_str());
    QCOMPARE(QString::fromStdString(made.notes.empty() ? "" : made.notes.back()),
             QString("The game continues from the referee's packet: PLAYING with 452 s left."));
    const sim::WorldState& world = match->simulation().state();
    QCOMPARE(world.game->state, PlayState::Playing);
    QCOMPARE(world.game->half, 2);
    QCOMPARE(world.game->secondsLeft(), 452);
    QCOMPARE(world.score, (sim::Score{0, 3}));
    QCOMPARE(world.game->teams[0].number, 12);
    QVERIFY(world.game->swapped);
    const GamePlayer& player = *world.game->player(TeamColor::Blue, 2);
    QCOMPARE(player.penalty, PenaltyKind::Incapable);
    QCOMPARE(world.game->penaltySeconds(player), 21);
    QCOMPARE(world.settings.referee->packetVersion, version);
    QVERIFY(world.settings.referee->automatic && !world.refereeMemory.obeyed);
    const auto text = scenarioToJson(made.scenario);
    QVERIFY(scenarioFromJson(text, "moment.json"));
  }

  void theExactGameIsTakenToTheTick() {
    Scenario base = loadScenario("match").value();
    base.runtimes[TeamColor::Blue] = {};
    base.robots[1].runtime = runtimeChoiceFromText("own").value();
    auto match = SimulatedMatch::create(loadScenario("match").value(), {}).value();
    for (int i = 0; i < 60 * 65 + 7; ++i) match.tick();
    const sim::WorldState& state = match.simulation().state();
    base.game = sim::gameStartOf(state);
    MatchFrame frame;
    frame.snapshot.tick = state.tick;
    for (const sim::RobotSnapshot& one : match.simulation().snapshot().robots) {
      static_cast<sim::RobotSnapshot&>(frame.robots.emplace_back()) = one;
    }
    ownSettings(frame).field = base.settings.field;
    ownSettings(frame).physics = "rigid-body";
    MomentOptions options;
    options.base = &base;
    Scenario made = scenarioFromMoment(frame, options).scenario;
    QVERIFY(made.robots[1].runtime == base.robots[1].runtime);
    made.robots[1].runtime = {};
    const auto goesOn = SimulatedMatch::create(made, {});
    QVERIFY2(goesOn, goesOn ? "" : goesOn.error().text().c_str());
    const Game& now = *goesOn->simulation().state().game;
    QCOMPARE(now.clock, state.game->clock);
    QCOMPARE(now.state, state.game->state);
    QCOMPARE(now.stateTicks, state.game->stateTicks);
    QVERIFY(now.teams == state.game->teams);
    // A robot that is left out takes nothing with it.
    frame.robots.pop_back();
    QVERIFY(SimulatedMatch::create(scenarioFromMoment(frame, options).scenario, {}));
  }

  void missingColumnsAreNoError() {
    telemetry::SeriesStore store;
    telemetry::GroupInfo strange{
        "X1",
        {{"NEVER_HEARD_OF",
          telemetry::ColumnType::Int32,
          "",
          "",
          telemetry::ColumnKind::Number,
          {}}},
        telemetry::facts({{"robot", "1"}, {"number", "999999999999"}, {"team", "green"}})};
    const auto id = store.addGroup(strange);
    const std::uint32_t word = 7;
    store.append(id, {1.0, {&word, 1}, {}});
    telemetry::GroupInfo bare{"nobody", {}, {}};
    store.append(store.addGroup(bare), {1.0, {}, {}});
    RecordedFrames frames;
    const MatchFrame frame = frames.frameAt(store, 2.0);
    QCOMPARE(frame.robots.size(), std::size_t{1});
    QVERIFY(!frame.truthKnown && !frame.ballKnown);
  }
};

PITCHBOARD_TEST(TestMoments)

}  // namespace tst_moments

#include "tst_moments.moc"

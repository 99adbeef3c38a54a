// SPDX-License-Identifier: GPL-3.0-or-later
// "What if": robots and ball of a match follow a recording until others change what happens.
#include <QtTest>

#include <cmath>
#include <map>

#include <robotlink/match/followed_recording.h>
#include <robotlink/match/match_player.h>
#include <robotlink/session/follow_recording.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_events.h>
#include <simcore/world/published_frame.h>

namespace tst_what_if {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

/// Three against three; the ball rolls into the right goal beside the keeper.
Scenario goalScenario() {
  Scenario scenario = loadScenario("match-3v3").value();
  scenario.ball = {3.6, 0.7};
  scenario.ballVelocity = {5.0, 0.0};
  scenario.settings.field.surface = {0.3, 1.0};
  scenario.stop = {};
  return scenario;
}

/// A robot that stands, and a ball that rolls past it on a field without noise.
Scenario rollingScenario() {
  Scenario scenario = loadScenario("match-3v3").value();
  scenario.settings.noise = {};
  scenario.robots.resize(2);
  scenario.robots[0].pose = {{-2.0, 2.0}, 0.0};  // B1
  scenario.robots[1].identity = {RobotId{2}, TeamColor::Red, 1, true};
  scenario.robots[1].pose = {{3.0, 2.0}, 3.0};  // R1
  for (ScenarioRobot& robot : scenario.robots) robot.behaviour = noBehaviour;
  scenario.ball = {0.0, 0.0};
  scenario.ballVelocity = {3.0, 0.0};
  scenario.settings.field.surface = {0.3, 1.0};
  scenario.stop = {};
  return scenario;
}

/// A match, recorded tick by tick.
struct Recorded {
  Recorded(Scenario played, int ticks) : scenario(std::move(played)) {
    path = folder.filePath("match.mcap").toStdString();
    auto match = SimulatedMatch::create(scenario, {}).value();
    const auto sampler = std::make_shared<MatchSampler>();
    const auto recorder =
        MatchRecorder::create(path, scenario, VariableCatalog::published(), sampler).value();
    for (int i = 0; i <= ticks; ++i) {
      if (i > 0) match.tick();
      snapshots.push_back(match.simulation().snapshot());
      sampler->ticked(match, {});
      recorder->ticked(match, {});
    }
    score = match.simulation().state().score;
    if (!recorder->finish()) qFatal("not recorded");
    session.emplace(telemetry::SessionReader::open(path).value());
  }

  std::shared_ptr<FollowedRecording> follow(std::vector<std::string> who, double from = 0.0) const {
    RecordedFrames frames(backdropOf(*session));
    FollowOptions options;
    options.who = std::move(who);
    options.from = options.matchTime = from;
    options.until = session->range()->end;
    return std::make_shared<FollowedRecording>(recordingToFollow(
                                                   [&](double time) {
                                                     return std::make_shared<const MatchFrame>(
                                                         frames.frameAt(*session, time));
                                                   },
                                                   scenario, options)
                                                   .value());
  }

  QTemporaryDir folder;
  Scenario scenario;
  std::string path;
  std::vector<sim::Snapshot> snapshots;  // by tick
  sim::Score score;
  std::optional<telemetry::SessionReader> session;
};

QByteArray exampleText(const char* name) {
  QFile file(QString(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/") + name);
  if (!file.open(QIODevice::ReadOnly)) qFatal("there is no %s", name);
  return file.readAll();
}

std::vector<MatchEvent> letGoOf(SimulatedMatch& match) {
  std::vector<MatchEvent> events;
  match.drainEvents(events);
  std::erase_if(events, [](const auto& e) { return e.kind != MatchEventKind::LetGo; });
  return events;
}

}  // namespace

class TestWhatIf : public QObject {
  Q_OBJECT

 private slots:
  void followingEverythingReproducesTheRecording_data() {
    QTest::addColumn<QString>("physics");
    QTest::newRow("rigid-body") << "rigid-body";
    QTest::newRow("published") << "published";
  }

  /// The poses of a row are put back as they are: what is left is the conversion from degrees, and
  /// with the published physics from centimetres.
  void followingEverythingReproducesTheRecording() {
    QFETCH(QString, physics);
    Scenario scenario = goalScenario();
    scenario.settings.physics = physics.toStdString();
    const Recorded recorded(scenario, 300);
    QVERIFY(recorded.score.left > 0);
    constexpr std::uint64_t from = 20;
    auto match = SimulatedMatch::create(scenario, {}).value();
    QVERIFY(match.restore(
        momentFromSession(*recorded.session, from / 60.0, VariableCatalog::published()).value()));
    match.follow(recorded.follow({"red", "blue", "ball"}, from / 60.0));
    constexpr double tolerance = 1e-9;
    for (std::uint64_t tick = from + 1; tick < 300; ++tick) {
      match.tick();
      QVERIFY(match.followState().moved);
      const sim::Snapshot now = match.simulation().snapshot();
      const sim::Snapshot& then = recorded.snapshots[tick];
      QVERIFY2(
          distance(now.ball, then.ball) < tolerance,
          qPrintable(QString("ball, tick %1: %2").arg(tick).arg(distance(now.ball, then.ball))));
      for (std::size_t i = 0; i < then.robots.size(); ++i) {
        QVERIFY(distance(now.robots[i].pose.position, then.robots[i].pose.position) < tolerance);
        QVERIFY(std::abs(std::remainder(now.robots[i].pose.yaw - then.robots[i].pose.yaw,
                                        2 * M_PI)) < tolerance);
      }
      QVERIFY(now.score == then.score);
    }
    QVERIFY(letGoOf(match).empty());
    match.tick();
    const auto events = letGoOf(match);
    QCOMPARE(events.size(), std::size_t{1});
    QCOMPARE(sentenceOf(events[0]),
             std::string("robots stopped following the recording: its followed part ends"));
    QCOMPARE(events[0].time, 5.0);
  }

  void aKeeperThatStandsElsewhereChangesTheOutcome() {
    const Recorded recorded(rollingScenario(), 180);
    QCOMPARE(recorded.score.left, 1);
    for (const bool elsewhere : {false, true}) {
      auto match = SimulatedMatch::create(recorded.scenario, {}).value();
      if (elsewhere) {
        QVERIFY(match.simulation().placeRobot(RobotId{2}, {{3.0, 0.0}, 3.0}));
      }
      match.follow(recorded.follow({"ball", "B1"}));
      for (int i = 0; i < 180; ++i) match.tick();
      QCOMPARE(match.simulation().state().score.left, elsewhere ? 0 : 1);
    }
  }

  /// The ball rolls along y = 0, slowed down by grass: x = v·t − a·t²/2. R1 stands at x = 3, where
  /// it was not recorded, so the ball is within reach of it when x = 3 − reach.
  void letsGoAtTheStatedDistance_data() {
    QTest::addColumn<double>("reach");
    QTest::newRow("default") << FollowedRecording::defaultReach;
    QTest::newRow("1.5 m") << 1.5;
  }
  void letsGoAtTheStatedDistance() {
    QFETCH(double, reach);
    const Recorded recorded(rollingScenario(), 180);
    Scenario scenario = recorded.scenario;
    scenario.robots[0].behaviour = "striker";
    auto match = SimulatedMatch::create(scenario, {}).value();
    QVERIFY(match.simulation().placeRobot(RobotId{2}, {{3.0, 0.0}, 3.0}));
    const auto following = recorded.follow({"ball", "blue"});
    following->reach = reach;
    match.follow(following);
    const double v = 3.0, a = scenario.settings.field.surface.deceleration, way = 3.0 - reach;
    QVERIFY(a > 0.1);
    const double byHand = (v - std::sqrt(v * v - 2.0 * a * way)) / a;
    const Pose begin = *match.simulation().robotPose(RobotId{1});
    while (match.followState().follows) {
      QVERIFY(match.simulation().state().tick < 180);
      QCOMPARE(*match.simulation().robotPose(RobotId{1}), begin);
      match.tick();
    }
    const auto events = letGoOf(match);
    QCOMPARE(events.size(), std::size_t{1});
    QVERIFY2(std::abs(events[0].time - byHand) <= 1.0 / 60.0,
             qPrintable(QString("%1 instead of %2").arg(events[0].time).arg(byHand)));
    QVERIFY2(
        events[0].detail.starts_with("R1 is ") && events[0].detail.ends_with("m from the ball"),
        events[0].detail.c_str());
    // From there B1 plays, and knows where it is.
    const Blackboard& board = *match.blackboard(RobotId{1});
    QCOMPARE(board.read(match.variables().localizationX), 250);  // cm from the left: -2 + 4.5 m
    for (int i = 0; i < 300; ++i) match.tick();
    QVERIFY(*match.simulation().robotPose(RobotId{1}) != begin);
    QVERIFY(letGoOf(match).empty());
  }

  /// Its processes ran all the time on motions that they did not command. From the moment of
  /// letting go they play: told where the robot stands, without being started again. A program of
  /// the team goes on, too.
  void separateProcessesPlayFromWhereTheirRobotWasLetGo() {
    const Recorded recorded(rollingScenario(), 180);
    Scenario scenario = recorded.scenario;
    scenario.robots[0].behaviour = "striker";
    const QString program = recorded.folder.filePath("own.py");
    QFile file(program);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(exampleText("ball_robot.py"));
    file.close();
    QFile profile(recorded.folder.filePath("team.json"));
    QVERIFY(profile.open(QIODevice::WriteOnly));
    profile.write(R"({"version": 1, "name": "team", "cycle": "MATCH_CYCLE", "processes": [
      {"name": "localization", "reference": "localization"},
      {"name": "decision", "command": ["python3", ")" +
                  program.toUtf8() + R"(", "${key}"]}]})");
    profile.close();
    for (const bool own : {false, true}) {
      MatchOptions options;
      options.cognition = Cognition::Separate;
      options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
      options.newBoards = true;
      scenario.robots[0].runtime.profile = own ? profile.fileName().toStdString() : std::string();
      auto made = SimulatedMatch::create(scenario, options);
      QVERIFY2(made, made ? "" : made.error().text().c_str());
      MatchPlayer player(std::move(*made));
      SimulatedMatch& match = player.match();
      const auto await = [&] {
        const auto now = MatchPlayer::Clock::now();
        player.lookAfterProcesses(now);
        return !match.pace().awaitsPrograms(ProcessPace::Await::AllPrograms, now);
      };
      QTRY_VERIFY_WITH_TIMEOUT(await(), 30'000);
      // It is moved 3 m away from where it began, in small steps that it did not command.
      const auto following = recorded.follow({"ball", "blue"});
      for (FollowedRobot& robot : following->robots) {
        for (FollowedPose& pose : robot.track.poses) {
          pose.pose.position.x += std::min(3.0, 2.0 * pose.time);
        }
      }
      following->end = 2.0;
      match.follow(following);
      std::map<std::string, int> pids;
      const auto pidsNow = [&] {
        std::map<std::string, int> all;
        for (const ProcessStatus& status : match.robots().processes().statuses()) {
          all[status.name] = status.pid;
        }
        return all;
      };
      while (match.followState().follows) {
        player.tick();
        if (pids.empty()) pids = pidsNow();
      }
      QVERIFY2(pids.size() >= 2, qPrintable(QString::number(pids.size())));
      for (const auto& [name, pid] : pids) QVERIFY2(pid > 0, name.c_str());
      const auto apart = [&] {  // m, of what it believes
        const Pose truth = *match.simulation().robotPose(RobotId{1});
        const Blackboard& board = *match.blackboard(RobotId{1});
        const Pose belief = sim::published_frame::studioFromLocalization(
            scenario.settings.field, {double(board.read(match.variables().localizationX)),
                                      double(board.read(match.variables().localizationY)), 0.0});
        return distance(truth.position, belief.position);
      };
      const Pose begin = *match.simulation().robotPose(RobotId{1});
      for (int i = 0; i < 12; ++i) player.tick();
      QVERIFY2(apart() < 0.15, qPrintable(QString::number(apart())));
      for (int i = 0; i < 300; ++i) player.tick();
      QVERIFY(*match.simulation().robotPose(RobotId{1}) != begin);
      QVERIFY(pidsNow() == pids);
    }
  }

  /// Who stands where it was recorded has changed nothing, however near it is.
  void whoIsWhereItWasChangesNothing() {
    Scenario scenario = rollingScenario();
    scenario.robots[1].pose = {{2.0, 0.4}, 3.0};  // the ball passes it at 0.4 m
    const Recorded recorded(scenario, 180);
    auto match = SimulatedMatch::create(scenario, {}).value();
    match.follow(recorded.follow({"ball", "blue"}));
    for (int i = 0; i < 179; ++i) match.tick();
    QVERIFY(match.followState().follows);
    QCOMPARE(match.simulation().state().score.left, 1);
  }

  void isDeterministicAndCanBeRestored() {
    const Recorded recorded(goalScenario(), 240);
    std::vector<std::uint64_t> hashes[2];
    for (auto& seen : hashes) {
      auto match = SimulatedMatch::create(recorded.scenario, {}).value();
      QVERIFY(match.simulation().placeRobot(RobotId{1}, {{0.0, -0.45}, 1.5}));
      match.follow(recorded.follow({"red", "ball"}));
      StateArchive archive;
      archive.ticked(match, {});
      for (int i = 0; i < 200; ++i) {
        match.tick();
        archive.ticked(match, {});
        seen.push_back(match.simulation().hash());
      }
      for (const std::uint64_t tick : {1, 30, 77, 200}) {
        QCOMPARE(sim::stateHash(archive.restore(tick).value()), seen[tick - 1]);
      }
      QVERIFY(match.followState().letGoAt);
    }
    QVERIFY(hashes[0] == hashes[1]);
  }

  /// Messages of real robots come five times a second and late, and only tell what they believe.
  void believedPosesAreMarkedAndInterpolated() {
    Scenario scenario = rollingScenario();
    FollowOptions options;
    options.who = {"R1"};
    options.until = 2.0;
    const auto frameAt = [&](double time) {
      auto frame = std::make_shared<MatchFrame>();
      frame->truthKnown = frame->ballKnown = false;
      frame->snapshot.time = time;
      const double sent = std::floor(time * 5.0 + 1e-6) / 5.0;
      RobotFrame robot;
      robot.identity = scenario.robots[1].identity;
      robot.link.emplace();
      robot.link->age = std::chrono::duration_cast<telemetry::Duration>(
          std::chrono::duration<double>(time - sent));
      robot.belief = robot.pose = {{1.0 + 0.5 * sent, 0.0}, 0.0};
      frame->robots.push_back(robot);
      return frame;
    };
    auto recording = recordingToFollow(frameAt, scenario, options);
    QVERIFY(recording.has_value());
    QVERIFY(recording->believed);
    // 0.5 m/s, between messages, too.
    for (const double t : {0.05, 0.33, 1.0, 1.51}) {
      const auto pose = recording->robots[1].track.at(t);
      QVERIFY(pose && std::abs(pose->position.x - (1.0 + 0.5 * t)) < 1e-5);
    }
    auto match = SimulatedMatch::create(scenario, {}).value();
    match.follow(std::make_shared<FollowedRecording>(*recording));
    while (match.followState().follows) match.tick();
    const auto events = letGoOf(match);
    QCOMPARE(events.size(), std::size_t{1});
    QVERIFY2(QString::fromStdString(events[0].detail).contains("believed"),
             events[0].detail.c_str());
    options.who = {"R9"};
    const auto wrong = recordingToFollow(frameAt, scenario, options);
    QVERIFY(!wrong);
    QCOMPARE(wrong.error().message,
             std::string("there is no robot, team or ball \"R9\"; did you mean \"R1\"?"));
    options.who = {"B1"};  // in the scenario, but never received
    QVERIFY(!recordingToFollow(frameAt, scenario, options));
  }

  /// Nothing changes for a recording that stands still for long: it moves when it moved.
  void aTrackStandsUntilItMoves() {
    RecordedTrack track;
    track.poses = {{0.0, {{0, 0}, 3.0}}, {10.0, {{1, 0}, -3.0}}};
    QVERIFY(!track.at(-0.1));
    QCOMPARE(track.at(9.7)->position.x, 0.0);
    QVERIFY(std::abs(track.at(9.85)->position.x - 0.5) < 1e-9);
    // Through ±180°, not back through 0.
    QVERIFY(std::abs(track.at(9.85)->yaw) > 3.1);
    QCOMPARE(track.at(11.0)->position.x, 1.0);
  }
};

PITCHBOARD_TEST(TestWhatIf)

}  // namespace tst_what_if

#include "tst_what_if.moc"

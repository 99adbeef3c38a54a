// SPDX-License-Identifier: GPL-3.0-or-later
// Events as values: their table, how a simulated match makes them, and how files keep them.
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <set>

#include <robotlink/frame/ball_sight.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <robotlink/session/session_events.h>
#include <telemetry/session/session_writer.h>

#include "../support/match_moment.h"
#include "../support/robot_keys.h"

namespace tst_match_events {

using namespace pitchboard;
using namespace pitchboard::link;
using Kind = MatchEventKind;

namespace {

std::vector<MatchEvent> taken(SimulatedMatch& match) {
  std::vector<MatchEvent> events;
  match.drainEvents(events);
  return events;
}

/// Everything that a robot's process did until this one; its exit is waited for.
const MatchEvent* find(const std::vector<MatchEvent>& events, Kind kind) {
  for (const MatchEvent& event : events) {
    if (event.kind == kind) return &event;
  }
  return nullptr;
}

MatchEvent full(Kind kind) {
  MatchEvent event;
  event.kind = kind;
  event.time = 12.25;
  event.robot = uidOf(red(7));
  event.name = "R2";
  event.side = Side::Right;
  event.team = 5;
  event.colour = TeamColor::Red;
  event.value = -30;
  event.score = sim::Score{2, 3};
  event.process = "decision";
  event.detail = "died: \"left\" started\n";
  return event;
}

}  // namespace

class TestMatchEvents : public QObject {
  Q_OBJECT
 private slots:
  void everyKindHasItsNameAndReads() {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < matchEventKindCount; ++i) {
      const auto kind = static_cast<Kind>(i);
      names.insert(info(kind).name);
      QVERIFY(matchEventKind(info(kind).name) == kind);
      QVERIFY(!sentenceOf(full(kind)).empty());
      QVERIFY(!logLineOf(full(kind)).origin.empty());
      MatchEvent bare;
      bare.kind = kind;
      bare.detail = info(kind).predicate.empty() ? "PLAYING" : "";
      QVERIFY2(!sentenceOf(bare).empty(), info(kind).name.data());
    }
    QCOMPARE(names.size(), matchEventKindCount);
    QVERIFY(!matchEventKind("of tomorrow"));
  }

  void whatWasUndoneIsDropped() {
    MatchEvent kick, goal, state, undone;
    kick.kind = Kind::Kick;
    goal.kind = Kind::Goal;
    state.kind = Kind::GameState;
    undone.kind = Kind::Undone;
    goal.cause = state.cause = undone.cause = 4;
    // The goal was given again after the undo.
    std::vector<MatchEvent> events{kick, goal, state, undone, kick, goal};
    dropUndone(events);
    QCOMPARE(events, (std::vector<MatchEvent>{kick, kick, goal}));
  }

  void theDocumentNamesEveryKind() {
    QFile file(QStringLiteral(PITCHBOARD_SOURCE_DIR "/docs/sessions.md"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(file.readAll());
    for (std::size_t i = 0; i < matchEventKindCount; ++i) {
      const std::string name(info(static_cast<Kind>(i)).name);
      QVERIFY2(text.contains(QStringLiteral("`%1`").arg(QString::fromStdString(name))),
               name.c_str());
    }
  }

  void aMatchReportsEachEventOnce() {
    Scenario scenario = loadScenario("one-robot").value();
    scenario.stop.duration = 60.0;
    auto match = SimulatedMatch::create(scenario, {}).value();
    std::vector<MatchEvent> all = taken(match);
    QCOMPARE(all.size(), std::size_t{1});
    QCOMPARE(all[0].kind, Kind::GameState);
    std::vector<sim::Event> raw;
    while (!match.finished()) {
      match.tick();
      raw.insert(raw.end(), match.simulation().events().begin(), match.simulation().events().end());
      match.drainEvents(all);
    }
    // What the robot sees is no event of the simulation.
    std::erase_if(all, [](const MatchEvent& event) {
      return event.kind == Kind::BallLost || event.kind == Kind::BallSeen;
    });
    QCOMPARE(all.size(), raw.size() + 2);  // the beginning and the end
    QVERIFY(find(all, Kind::Kick));
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const MatchEvent& event = all[i + 1];
      QCOMPARE(event.time, static_cast<double>(raw[i].tick) / 60.0);
      QVERIFY(event.robot == uidOf(raw[i].robot));
      if (raw[i].robot == RobotId{1}) QCOMPARE(event.name, std::string("B1"));
    }
    QCOMPARE(all.back().kind, Kind::MatchOver);
    QCOMPARE(all.back().detail, std::string("duration"));
    QCOMPARE(all.back().time, 60.0);
    QVERIFY(taken(match).empty());
  }

  void aBallThatIsOutOfSightForAMomentIsNotLost() {
    BallSight sight;
    QVERIFY(!sight.look(true, 0.0));
    for (int i = 1; i <= 90; ++i) QVERIFY(!sight.look(i % 10 == 0, 0.1 * i));
    QVERIFY(!sight.look(false, 10.9));
    QVERIFY(sight.look(false, 11.0) == Kind::BallLost);
    QVERIFY(!sight.look(false, 30.0));
    QVERIFY(sight.look(true, 30.1) == Kind::BallSeen);
    QVERIFY(!sight.look(false, 30.2));
    BallSight blind;
    for (int i = 0; i < 100; ++i) QVERIFY(!blind.look(false, 0.1 * i));
    QVERIFY(blind.look(true, 10.0) == Kind::BallSeen);
  }

  void aRobotOfAMatchLosesTheBallAndSeesIt() {
    auto match = SimulatedMatch::create(loadScenario("one-robot").value(), {}).value();
    const sim::Simulation& world = match.simulation();
    const auto play = [&match](int ticks) {
      for (int i = 0; i < ticks; ++i) match.tick();
      std::vector<MatchEvent> sight = taken(match);
      std::erase_if(sight, [](const MatchEvent& event) {
        return event.kind != Kind::BallLost && event.kind != Kind::BallSeen;
      });
      return sight;
    };
    const auto ahead = [&world] {
      const Pose pose = world.snapshot().robots[0].pose;
      return Point{pose.position.x + std::cos(pose.yaw), pose.position.y + std::sin(pose.yaw)};
    };
    QVERIFY(match.simulation().placeBall(ahead()));
    QVERIFY(play(60).empty());
    // Farther away than it can see.
    const bool isLeft = world.snapshot().robots[0].pose.position.x < 0.0;
    QVERIFY(match.simulation().placeBall({isLeft ? 4.0 : -4.0, 2.5}));
    QVERIFY(play(60).empty());
    const auto lost = play(120);
    QCOMPARE(lost.size(), std::size_t{1});
    QCOMPARE(sentenceOf(lost[0]), std::string("B1 lost the ball: not seen for 2 s"));
    QVERIFY(lost[0].robot == uidOf(RobotId{1}) && lost[0].time >= 3.0 && lost[0].time < 3.5);
    std::vector<MatchEvent> seen;
    for (int tries = 0; tries < 20 && seen.empty(); ++tries) {
      QVERIFY(match.simulation().placeBall(ahead()));
      seen = play(30);
    }
    QCOMPARE(seen.size(), std::size_t{1});
    QCOMPARE(seen[0].kind, Kind::BallSeen);
  }

  void aStoppedClockIsReportedBetweenTicks() {
    auto match = SimulatedMatch::create(loadScenario("one-robot").value(), {}).value();
    (void)taken(match);
    match.simulation().setClockRunning(false);
    auto events = taken(match);
    QCOMPARE(events.size(), std::size_t{1});
    QCOMPARE(events[0].detail, std::string("CLOCK STOPPED"));
    match.simulation().setClockRunning(true);
    QCOMPARE(taken(match).at(0).detail, std::string("PLAYING"));
  }

  void aGoalHasItsTeamAndTheScore() {
    sim::WorldState state;
    state.score = {0, 1};
    state.robots = {{RobotId{1}, TeamColor::Yellow, 1, false},
                    {RobotId{2}, TeamColor::Orange, 1, true}};
    const MatchEvent goal = matchEvent({sim::EventKind::Goal, 120, {}, 1}, state);
    QVERIFY(goal.side == Side::Right);
    QCOMPARE(goal.colour, std::optional(TeamColor::Orange));
    QCOMPARE(sentenceOf(goal), std::string("goal for ORANGE, 0 : 1"));
    QCOMPARE(labelOf(goal), std::string("goal ORANGE"));
    QCOMPARE(logLineOf(goal).origin, std::string("simulation"));
  }

  // While the match is paused, too, and each of them once, whatever is done in between.
  void callsByHandAreReportedAtOnce() {
    auto match = SimulatedMatch::create(loadScenario("match-3v3").value(), {}).value();
    sim::Simulation& simulation = match.simulation();
    QVERIFY(simulation.setReferee(refereeRuleSet("humanoid-2021").value()));
    (void)taken(match);
    const auto kindsOf = [](const std::vector<MatchEvent>& events) {
      std::vector<Kind> kinds;
      for (const MatchEvent& event : events) kinds.push_back(event.kind);
      return kinds;
    };
    using Kinds = std::vector<Kind>;
    const auto ready = [&] {
      return simulation.call({.kind = sim::CallKind::State, .state = PlayState::Ready, .cause = 7});
    };
    const Moment before = momentOf(match);
    QVERIFY(ready());
    QCOMPARE(kindsOf(taken(match)), Kinds{Kind::GameState});
    QVERIFY(taken(match).empty());
    // Restored, the simulation has no calls: the next one is a new one.
    QVERIFY(match.restore(before));
    QVERIFY(ready());
    QCOMPARE(kindsOf(taken(match)), Kinds{Kind::GameState});
    simulation.reportChanged(sim::Setting::Noise, 8);
    simulation.reportUndone(8);
    simulation.reportChanged(sim::Setting::Noise, 8);
    const auto reported = taken(match);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::SettingChanged, Kind::Undone, Kind::SettingChanged}));
    QCOMPARE(sentenceOf(reported[0]), std::string("noise changed"));
    QCOMPARE(reported[0].cause, std::uint32_t{8});
    QVERIFY(isMarked(reported[0]));
    // The events of a step include those that were reported before it.
    simulation.reportUndone(7);
    match.tick();
    QVERIFY(simulation.events().size() >= 5);
    QCOMPARE(kindsOf(taken(match)), Kinds{Kind::Undone});
  }

  // Undoing something else does not take back the goal that ends the match.
  void onlyTheGoalsOwnCallTakesItBack() {
    Scenario scenario = loadScenario("match-3v3").value();
    scenario.stop = {};
    scenario.stop.goal = true;
    scenario.settings.referee = refereeRuleSet("humanoid-2021").value();
    auto match = SimulatedMatch::create(scenario, {}).value();
    sim::Simulation& simulation = match.simulation();
    for (const PlayState state : {PlayState::Ready, PlayState::Set, PlayState::Playing}) {
      QVERIFY(simulation.call({.kind = sim::CallKind::State, .state = state}));
    }
    QVERIFY(simulation.call({.kind = sim::CallKind::Goal, .team = 0, .value = 1, .cause = 5}));
    match.tick();
    QCOMPARE(match.finishedBy(), std::string_view("goal"));
    simulation.reportUndone(6);
    match.tick();
    QCOMPARE(match.finishedBy(), std::string_view("goal"));
    simulation.reportUndone(5);
    match.tick();
    QCOMPARE(match.finishedBy(), std::string_view());
  }

  void aProcessThatEndsAsItShouldHasNotDied() {
    auto match = SimulatedMatch::create(loadScenario("one-robot").value(), {}).value();
    (void)taken(match);
    using Clock = std::chrono::steady_clock;
    int last = 0;
    std::vector<MatchEvent> events;
    const auto run = [&](const char* script, Kind until) {
      events.clear();
      ManagedProcess process;
      process.spec = {RobotId{1}, "decision", {"/bin/sh", "-c", script}};
      process.restart.policy = RestartPolicy::Never;
      const auto id =
          match.robots().processes().add(process, *match.blackboard(RobotId{1}), Clock::now());
      if (!id) return false;
      last = *id;
      return QTest::qWaitFor(
          [&] {
            match.pace().lookAfterProcesses(Clock::now());
            match.drainEvents(events);
            return find(events, until) != nullptr;
          },
          20'000);
    };
    QVERIFY(run("exit 0", Kind::ProcessEnded));
    QCOMPARE(events[0].kind, Kind::ProcessStarted);
    QCOMPARE(events[0].name, std::string("B1"));
    QCOMPARE(events[0].process, std::string("decision"));
    QVERIFY(!find(events, Kind::ProcessDied));

    QVERIFY(run("echo ouch; exit 2", Kind::ProcessDied));
    QCOMPARE(events[0].kind, Kind::ProcessRestarted);
    QCOMPARE(find(events, Kind::ProcessDied)->detail,
             std::string("exit code 2; last output: ouch"));

    QVERIFY(run("exec sleep 600", Kind::ProcessRestarted));
    match.robots().processes().stop(last);
    const auto stopped = taken(match);
    QCOMPARE(stopped.size(), std::size_t{1});
    QCOMPARE(stopped[0].kind, Kind::ProcessEnded);
    QCOMPARE(sentenceOf(stopped[0]), std::string("B1 decision stopped"));

    QVERIFY(run("kill -9 $$", Kind::ProcessDied));
    QCOMPARE(logLineOf(*find(events, Kind::ProcessDied)).origin, std::string("B1 decision"));
  }

  void aFileGivesBackEveryFact() {
    const QTemporaryDir folder;
    const std::string path = folder.filePath("events.mcap").toStdString();
    auto writer = telemetry::SessionWriter::create(path, {});
    QVERIFY(writer);
    std::vector<MatchEvent> all;
    for (std::size_t i = 0; i < matchEventKindCount; ++i) {
      if (static_cast<Kind>(i) == Kind::Undone) continue;  // is not given back
      all.push_back(full(static_cast<Kind>(i)));
      all.back().cause = static_cast<std::uint32_t>(i);
      all.back().time += static_cast<double>(i);
      MatchEvent bare;
      bare.kind = static_cast<Kind>(i);
      bare.time = all.back().time + 0.5;
      all.push_back(bare);
    }
    for (const MatchEvent& event : all) (*writer)->append(sessionEvent(event));
    QVERIFY((*writer)->finish());
    const auto read = eventsOf(telemetry::SessionReader::open(path).value());
    QCOMPARE(read.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      MatchEvent wanted = all[i];
      QVERIFY(std::abs(read[i].time - wanted.time) < 1e-6);
      wanted.time = read[i].time;
      QVERIFY2(read[i] == wanted, info(wanted.kind).name.data());
    }
  }

  void aKindOfALaterVersionKeepsItsName() {
    telemetry::SessionEvent later{3.0, "throw-in", "B1", "B1 throws in"};
    later.facts.emplace();
    const MatchEvent event = matchEvent(later);
    QCOMPARE(event.kind, Kind::Other);
    QCOMPARE(event.detail, std::string("throw-in: B1 throws in"));
  }

  void sessionsOfBeforeAreRead_data() {
    QTest::addColumn<QString>("file");
    for (const char* file : {"small.mcap", "plain_broken_off.mcap"}) QTest::newRow(file) << file;
  }
  void sessionsOfBeforeAreRead() {
    QFETCH(QString, file);
    const QString path = QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/sessions/") + file;
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session);
    const auto raw = session->events();
    const auto events = eventsOf(*session);
    QVERIFY(session->count(telemetry::SessionStream::Events) > 0);
    QCOMPARE(events.size(), raw.size());
    for (std::size_t i = 0; i < raw.size(); ++i) {
      QVERIFY(!raw[i].facts);
      QVERIFY2(events[i].kind != Kind::Other, raw[i].kind.c_str());
      QCOMPARE(std::string(info(events[i].kind).name), raw[i].kind);
      QCOMPARE(events[i].time, raw[i].time);
      QCOMPARE(events[i].name, raw[i].group);
      QCOMPARE(events[i].robot != RobotUid{}, !raw[i].group.empty());
    }
  }

  void textsOfOtherProgramsAreKept() {
    const MatchEvent known = matchEvent(telemetry::SessionEvent{1.5, "kick", "B1", "with force"});
    QCOMPARE(known.kind, Kind::Kick);
    QCOMPARE(sentenceOf(known), std::string("B1 kicks the ball: with force"));
    const MatchEvent unknown = matchEvent(telemetry::SessionEvent{1.5, "rain", "", "it is wet"});
    QCOMPARE(unknown.kind, Kind::Other);
    QCOMPARE(unknown.detail, std::string("rain: it is wet"));
  }
};

PITCHBOARD_TEST(TestMatchEvents)

}  // namespace tst_match_events

#include "tst_match_events.moc"

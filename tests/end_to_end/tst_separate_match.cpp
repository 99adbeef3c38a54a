// SPDX-License-Identifier: GPL-3.0-or-later
// A match played by separate operating-system processes is the match played inside one program:
// the same state, tick for tick, whatever the pace, and whatever happens to a process.
#include <QtTest>
#include <cmath>
#include <csignal>
#include <map>

#include <robotlink/match/match_runner.h>
#include <robotlink/match/simulated_match.h>

#include "../support/segment_keys.h"

namespace tst_separate_match {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;

namespace {

constexpr int tickRate = 60;

MatchOptions separate() {
  MatchOptions options;
  options.cognition = Cognition::Separate;
  options.keyBase = testKeyBase();
  options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
  return options;
}

SimulatedMatch make(const Scenario& scenario, const MatchOptions& options) {
  auto match = SimulatedMatch::create(scenario, options);
  if (!match) qFatal("%s", match.error().text().c_str());
  return std::move(*match);
}

Scenario soccer() {
  Scenario scenario = loadScenario("match-3v3").value();
  scenario.settings.noise = noisePreset("realistic").value();
  scenario.settings.seed = 7;
  return scenario;
}

pid_t pidOf(const SimulatedMatch& match, RobotId robot, const char* name) {
  for (const ProcessStatus& one : match.robots().processes().statuses()) {
    if (one.robot == robot && one.name == name) return one.pid;
  }
  return 0;
}

/// m between belief and truth, mean over the robots.
double beliefError(const SimulatedMatch& match) {
  double sum = 0.0;
  const sim::Snapshot snapshot = match.simulation().snapshot();
  const sim::FieldSpec& field = match.simulation().state().settings.field;
  for (const sim::RobotSnapshot& robot : snapshot.robots) {
    const Blackboard& board = *match.blackboard(robot.identity.id);
    const double x = board.read(match.variables().localizationX) / 100.0 - field.halfLength();
    const double y = field.halfWidth() - board.read(match.variables().localizationY) / 100.0;
    sum += std::hypot(x - robot.pose.position.x, y - robot.pose.position.y);
  }
  return sum / static_cast<double>(snapshot.robots.size());
}

}  // namespace

class TestSeparateMatch : public QObject {
  Q_OBJECT
  const int m_base = testKeyBase();

 private slots:
  void cleanup() {
    for (int n = 1; n <= 22; ++n) removeSegment(m_base + 100 * n);
  }

  void theStateIsThatOfAMatchInside_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("striker, supporter, keeper") << "match-3v3";
    QTest::newRow("blue has an advisor") << "advised";
    QTest::newRow("as published") << "scenario-1";
  }
  void theStateIsThatOfAMatchInside() {
    QFETCH(QString, name);
    Scenario scenario = name == "scenario-1" ? loadScenario("scenario-1").value() : soccer();
    if (name == "advised") scenario.advisors[TeamColor::Blue];
    auto inside = make(scenario, {});
    auto outside = make(scenario, separate());
    for (int second = 0; second < 20; ++second) {
      for (int i = 0; i < tickRate; ++i) {
        inside.tick();
        outside.tick();
      }
      QCOMPARE(outside.simulation().hash(), inside.simulation().hash());
    }
    QVERIFY(inside.simulation().snapshot().robots[0].statistics.distanceWalked > 0.0);
    for (int i = 1; i <= 4; ++i) {  // what was learned of the opponents
      const IntVar word =
          *VariableCatalog::extended().intVar("ADVISOR_EVIDENCE" + std::to_string(i));
      for (const sim::RobotSnapshot& robot : inside.simulation().snapshot().robots) {
        QCOMPARE(outside.blackboard(robot.identity.id)->read(word),
                 inside.blackboard(robot.identity.id)->read(word));
      }
    }
  }

  void anyPaceGivesTheSame() {
    constexpr std::uint64_t end = 15 * tickRate;
    auto inside = make(soccer(), {});
    std::map<std::uint64_t, std::uint64_t> hashes;
    while (inside.simulation().state().tick < end) {
      inside.tick();
      hashes[inside.simulation().state().tick] = inside.simulation().hash();
    }
    auto runner = MatchRunner::start(soccer(), separate(), true).value();
    const auto tickAndHash = [&runner] {
      std::pair<std::uint64_t, std::uint64_t> now;
      runner->read([&now](const SimulatedMatch& match) {
        now = {match.simulation().state().tick, match.simulation().hash()};
      });
      return now;
    };
    const auto playedTo = [&](std::uint64_t tick) -> bool {
      const auto now = tickAndHash();
      if (now.first > 0 && now.second != hashes[now.first]) {
        qFatal("another state at tick %llu", static_cast<unsigned long long>(now.first));
      }
      return now.first >= tick;
    };
    runner->stepOnce();
    runner->stepOnce();
    QTRY_VERIFY(playedTo(2));
    for (const auto& [speed, tick] :
         std::map<double, std::uint64_t>{{0.1, 4}, {1.0, 40}, {5.0, 200}, {20.0, 500}}) {
      runner->setSpeed(speed);
      runner->setPaused(false);
      QTRY_VERIFY_WITH_TIMEOUT(playedTo(tick), 60'000);
      runner->setPaused(true);
      QVERIFY(runner->waitUntilStill(20s));
    }
    runner->runTo(end);
    QVERIFY(runner->waitUntilStill(100s));
    QCOMPARE(tickAndHash(), (std::pair<std::uint64_t, std::uint64_t>{end, hashes[end]}));
  }

  // The naive decision remembers nothing, so a match that loses it again and again goes the same
  // way.
  void aProcessThatIsKilledIsReplacedInItsTurn() {
    Scenario scenario = loadScenario("scenario-1").value();
    auto inside = make(scenario, {});
    auto outside = make(scenario, separate());
    const RobotId robot = scenario.robots[0].identity.id;
    for (int i = 0; i < 10 * tickRate; ++i) {
      inside.tick();
      outside.tick();
      if (i % 150 != 149) continue;
      const pid_t victim = pidOf(outside, robot, "decision");
      QVERIFY(victim > 0);
      ::kill(victim, SIGKILL);
    }
    QCOMPARE(outside.simulation().hash(), inside.simulation().hash());
    std::vector<MatchEvent> events;
    outside.drainEvents(events);
    const auto count = [&events](MatchEventKind kind) {
      return std::count_if(events.begin(), events.end(),
                           [kind](const MatchEvent& event) { return event.kind == kind; });
    };
    QVERIFY(count(MatchEventKind::ProcessDied) >= 3);
    QVERIFY(count(MatchEventKind::ProcessRestarted) >= 3);
  }

  void aRestartIsTheSameInsideAndOutside() {
    auto inside = make(soccer(), {});
    auto outside = make(soccer(), separate());
    for (int i = 0; i < 8 * tickRate; ++i) {
      if (i == 200) {
        for (auto* match : {&inside, &outside}) {
          QVERIFY(match->robots().restartProcess(RobotId{1}, "decision"));
          QVERIFY(match->robots().restartProcess(RobotId{4}, "localization"));
        }
      }
      if (i == 300) {
        for (auto* match : {&inside, &outside})
          QVERIFY(match->robots().setBehaviour(RobotId{2}, "striker"));
      }
      inside.tick();
      outside.tick();
    }
    QCOMPARE(outside.simulation().hash(), inside.simulation().hash());
  }

  void changingTheBehaviourLeavesLocalizationAlone() {
    auto match = make(soccer(), separate());
    for (int i = 0; i < 2 * tickRate; ++i) match.tick();
    const pid_t localization = pidOf(match, RobotId{1}, "localization");
    const pid_t decision = pidOf(match, RobotId{1}, "decision");
    QVERIFY(match.robots().setBehaviour(RobotId{1}, "keeper"));
    match.tick();
    QCOMPARE(pidOf(match, RobotId{1}, "localization"), localization);
    QVERIFY(pidOf(match, RobotId{1}, "decision") != decision);
    QVERIFY(match.robots().setBehaviour(RobotId{1}, std::string(noBehaviour)));
    QCOMPARE(pidOf(match, RobotId{1}, "localization"), 0);
    match.tick();
  }

  void aProcessThatHangsIsReportedAndNotWaitedForForEver() {
    QTemporaryDir folder;
    QFile profile(folder.filePath("short.json"));
    QVERIFY(profile.open(QIODevice::WriteOnly));
    profile.write(R"({"version": 1, "name": "short", "processes": [
      {"name": "decision", "reference": "decision", "response_timeout": 0.3, "restart": "never"}]})");
    profile.close();
    Scenario scenario = loadScenario("scenario-1").value();
    scenario.robots[0].runtime.profile = profile.fileName().toStdString();
    auto match = make(scenario, separate());
    const RobotId robot = scenario.robots[0].identity.id;
    for (int i = 0; i < tickRate; ++i) match.tick();
    const pid_t stopped = pidOf(match, robot, "decision");
    ::kill(stopped, SIGSTOP);
    for (int i = 0; i < tickRate; ++i) match.tick();
    std::vector<MatchEvent> events;
    match.drainEvents(events);
    const auto notResponding = std::find_if(
        events.begin(), events.end(),
        [](const MatchEvent& event) { return event.kind == MatchEventKind::ProcessNotResponding; });
    QVERIFY(notResponding != events.end());
    QCOMPARE(sentenceOf(*notResponding),
             std::string("B1 decision stopped responding: no cycle done for 0.3 s"));
    ::kill(stopped, SIGCONT);
    const auto back = [&] {
      match.tick();
      return match.robots().processes().statuses()[0].state == ProcessState::Running;
    };
    QTRY_VERIFY(back());
    QCOMPARE(pidOf(match, robot, "decision"), stopped);
  }

  // What a pause used to spoil: the beliefs are as good as those of a match that was never paused.
  void beliefsSurvivePausesAndFreeRunning() {
    constexpr std::uint64_t end = 8 * tickRate;
    MatchOptions options = separate();
    options.pace = RobotsPace::Free;
    auto runner = MatchRunner::start(soccer(), options, false).value();
    const auto reached = [&runner](std::uint64_t tick) {
      const auto frame = runner->latest();
      return frame && frame->snapshot.tick >= tick;
    };
    QTRY_VERIFY_WITH_TIMEOUT(reached(2 * tickRate), 30'000);
    QVERIFY(!runner->latest()->inLockStep);
    runner->setPaused(true);
    QVERIFY(runner->waitUntilStill(10s));
    std::uint64_t serial = 0;
    double before = 0.0;
    runner->read([&](const SimulatedMatch& match) { before = beliefError(match); });
    // Frames go on while it stands still; so many of them take some seconds.
    int frames = 0;
    QTRY_VERIFY_WITH_TIMEOUT(
        [&] {
          if (const auto frame = runner->latest(serial)) {
            serial = frame->serial;
            ++frames;
          }
          return frames >= 40;
        }(),
        60'000);
    double after = 0.0;
    runner->read([&](const SimulatedMatch& match) { after = beliefError(match); });
    QCOMPARE(after, before);
    runner->setPaused(false);
    QTRY_VERIFY_WITH_TIMEOUT(reached(end), 60'000);
    runner->setPaused(true);
    QVERIFY(runner->waitUntilStill(10s));
    runner->read([&](const SimulatedMatch& match) { after = beliefError(match); });
    QVERIFY2(after < 0.5, qPrintable(QString::number(after)));
  }
};

PITCHBOARD_TEST(TestSeparateMatch)

}  // namespace tst_separate_match

#include "tst_separate_match.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/syscall.h>
#include <unistd.h>
#include <QFile>
#include <QTemporaryDir>
#include <QtTest>
#include <atomic>
#include <thread>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/match/match_runner.h>
#include <robotlink/match/pacer.h>

#include "../support/segment_keys.h"

namespace tst_match_runner {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;

namespace {

std::unique_ptr<MatchRunner> start(const Scenario& scenario, bool paused) {
  auto runner = MatchRunner::start(scenario, {}, paused);
  if (!runner) qFatal("%s", runner.error().text().c_str());
  return std::move(*runner);
}

Scenario builtIn(const char* name) {
  return loadScenario(name).value();
}

std::uint64_t hashOf(MatchRunner& runner) {
  std::uint64_t hash = 0;
  runner.read([&](const SimulatedMatch& match) { hash = match.simulation().hash(); });
  return hash;
}

/// Writes down what it is shown; read when the match stands still.
class Notes : public TickObserver {
 public:
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override {
    ticks.push_back(match.simulation().state().tick);
    if (tickTime.count() > 0) ++timed;
    ball = match.simulation().snapshot().ball;
  }
  void happened(std::span<const MatchEvent> events) override { happenings += events.size(); }
  void worldChanged(const SimulatedMatch& /*match*/) override { ++changes; }
  void logged(const LogLine& line) override { lines.push_back(line.text); }

  std::vector<std::uint64_t> ticks;
  std::size_t timed = 0, happenings = 0, changes = 0;
  std::vector<std::string> lines;
  Point ball;
};

}  // namespace

class TestMatchRunner : public QObject {
  Q_OBJECT

 private slots:
  void startsPausedAndStepsOnce() {
    auto runner = start(builtIn("match-3v3"), true);
    QVERIFY(runner->waitUntilStill(10s));
    QCOMPARE(runner->latest()->snapshot.tick, std::uint64_t{0});
    QVERIFY(runner->latest()->paused);
    runner->stepOnce();
    runner->stepOnce();
    QVERIFY(runner->waitUntilStill(10s));
    QCOMPARE(runner->latest()->snapshot.tick, std::uint64_t{2});
    QVERIFY(!runner->latest(runner->latest()->serial));
  }

  void theHashDoesNotDependOnThePace() {
    std::vector<std::uint64_t> hashes;
    for (const double speed : {0.0, 20.0, 3.0}) {
      auto runner = start(builtIn("match-3v3"), true);
      runner->setSpeed(speed);
      if (speed != 0.0) {
        runner->setPaused(false);
        QTRY_VERIFY_WITH_TIMEOUT(runner->latest()->snapshot.tick > 20, 30'000);
      }
      runner->runTo(1200);
      QVERIFY(runner->waitUntilStill(20s));
      QCOMPARE(runner->latest()->snapshot.tick, std::uint64_t{1200});
      hashes.push_back(hashOf(*runner));
    }
    QCOMPARE(hashes[1], hashes[0]);
    QCOMPARE(hashes[2], hashes[0]);
    auto match = SimulatedMatch::create(builtIn("match-3v3"), {}).value();
    for (int i = 0; i < 1200; ++i) match.tick();
    QCOMPARE(match.simulation().hash(), hashes[0]);
  }

  void realTimeIsRealTime() {
    auto runner = start(builtIn("match-3v3"), false);
    QTRY_VERIFY_WITH_TIMEOUT(runner->latest()->snapshot.time > 1.5, 30'000);
    const double speed = runner->latest()->speed;
    QVERIFY2(speed > 0.5 && speed < 1.2, qPrintable(QString::number(speed)));
  }

  void commandsAreCarriedOutInOrderWhilePaused() {
    auto runner = start(builtIn("one-robot"), true);
    std::vector<int> order;
    for (int i = 0; i < 5; ++i) {
      runner->post([&order, i](SimulatedMatch&) {
        order.push_back(i);
        return Changed::No;
      });
    }
    runner->execute([](SimulatedMatch& match) {
      (void)match.simulation().placeBall({1, 1});
      return Changed::Yes;
    });
    QCOMPARE(order, (std::vector<int>{0, 1, 2, 3, 4}));
    QTRY_COMPARE(runner->latest()->snapshot.ball, (Point{1, 1}));
  }

  void newsAreReportedOnceUntilTaken() {
    auto runner = start(builtIn("one-robot"), true);
    QVERIFY(runner->waitUntilStill(10s));
    (void)runner->latest();
    std::atomic<int> reported = 0;
    runner->setNews([&reported] { ++reported; });
    const auto change = [&] { runner->execute([](SimulatedMatch&) { return Changed::Yes; }); };
    const std::uint64_t before = runner->latest()->serial;
    change();
    change();
    QTRY_VERIFY(runner->latest()->serial > before);
    QTRY_VERIFY(reported >= 1);
    runner->setNews({});
    change();  // waits for a call that is under way
    const int then = reported;
    change();
    runner->stepOnce();
    QVERIFY(runner->waitUntilStill(10s));
    QCOMPARE(reported, then);
  }

  // Its blackboards are shared: what others write to them is seen, and nothing else is told.
  void aPausedMatchReportsNothingUntilSomethingChanges() {
    MatchOptions options;
    options.systemV = true;
    options.keyBase = testKeyBase();
    auto runner = MatchRunner::start(builtIn("one-robot"), options, true).value();
    QVERIFY(runner->waitUntilStill(10s));
    QElapsedTimer rested;
    rested.start();
    std::uint64_t serial = 0;
    const auto rests = [&] {
      if (const auto frame = runner->latest(serial)) {
        serial = frame->serial;
        rested.start();
      }
      return rested.elapsed() > 700;
    };
    QTRY_VERIFY_WITH_TIMEOUT(rests(), 30'000);
    Blackboard board =
        SystemVSegments::open(*runner->latest()->robots.front().boardKey, AttachMode::AttachOnly)
            .value();
    board.write(VariableCatalog::published().intVar("DECISION_ACTION_A").value(), 3);
    QTRY_COMPARE(runner->latest()->robots.front().decided.value_or(0), 3);
  }

  void aFinishedMatchStandsStill() {
    Scenario scenario = builtIn("one-robot");
    scenario.stop.duration = 2.0;
    auto runner = start(scenario, false);
    runner->setSpeed(MatchRunner::unlimitedSpeed);
    QTRY_VERIFY_WITH_TIMEOUT(runner->latest()->finished, 30'000);
    QCOMPARE(runner->latest()->snapshot.tick, std::uint64_t{120});
    QCOMPARE(runner->latest()->finishedBy, std::string("duration"));
    const auto events = runner->drainEvents();
    QVERIFY(!events.empty());
    QCOMPARE(events.front().kind, MatchEventKind::GameState);
    QCOMPARE(events.front().detail, std::string("PLAYING"));
    QCOMPARE(events.back().kind, MatchEventKind::MatchOver);
    QCOMPARE(events.back().time, 2.0);
    QCOMPARE(sentenceOf(events.back()), std::string("the match is over (duration)"));
    QVERIFY(runner->drainEvents().empty());
  }

  void eventsArrive() {
    auto runner = start(builtIn("one-robot"), true);
    runner->runTo(60 * 60);
    QVERIFY(runner->waitUntilStill(20s));
    const auto events = runner->drainEvents();
    QVERIFY(std::any_of(events.begin(), events.end(),
                        [](const auto& event) { return event.kind == MatchEventKind::Kick; }));
  }

  void observersSeeEveryTickOnce() {
    const auto first = std::make_shared<Notes>();
    const auto late = std::make_shared<Notes>();
    auto runner = std::move(
        *MatchRunner::start(builtIn("one-robot"), {}, true, VariableCatalog::published(), {first}));
    runner->runTo(600);
    QVERIFY(runner->waitUntilStill(20s));
    runner->observe(late);
    runner->runTo(1200);
    QVERIFY(runner->waitUntilStill(20s));
    runner->stopObserving(late);
    runner->execute([](SimulatedMatch& match) {
      (void)match.simulation().placeBall({1, 1});
      return Changed::Yes;
    });
    runner->stepOnce();
    QVERIFY(runner->waitUntilStill(20s));
    runner->stopObserving(first);

    std::vector<std::uint64_t> distinct = first->ticks;
    QVERIFY(std::is_sorted(distinct.begin(), distinct.end()));
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    QCOMPARE(distinct.size(), std::size_t{1202});  // 0 to 1201
    QCOMPARE(first->timed, std::size_t{1201});
    QCOMPARE(late->ticks.front(), std::uint64_t{600});
    QCOMPARE(late->ticks.back(), std::uint64_t{1200});
    QCOMPARE(late->timed, std::size_t{600});
    QCOMPARE(first->happenings, runner->drainEvents().size());
    QVERIFY(first->happenings > 0);
  }

  void observersSeeWhatACommandDidToAMatchThatStandsStill() {
    const auto notes = std::make_shared<Notes>();
    auto runner = std::move(
        *MatchRunner::start(builtIn("one-robot"), {}, true, VariableCatalog::published(), {notes}));
    QVERIFY(runner->waitUntilStill(10s));
    runner->execute([](SimulatedMatch& match) {
      (void)match.simulation().placeBall({1, 1});
      return Changed::Yes;
    });
    runner->stopObserving(notes);
    QCOMPARE(notes->ball, (Point{1, 1}));
    QCOMPARE(notes->timed, std::size_t{0});
  }

  /// None looks at the world to find out.
  void aCommandReportsWhetherItChangedTheWorld() {
    auto runner = start(builtIn("one-robot"), true);
    const auto notes = std::make_shared<Notes>();
    runner->observe(notes);
    runner->execute([](SimulatedMatch&) { return Changed::Yes; });
    runner->execute([](SimulatedMatch&) { return Changed::No; });
    runner->read([](const SimulatedMatch&) {});
    runner->stopObserving(notes);
    QCOMPARE(notes->changes, std::size_t{1});
  }

  void standingStillCostsNothing() {
    auto runner = start(builtIn("match-3v3"), true);
    QVERIFY(runner->waitUntilStill(10s));
    // Its thread sleeps in the kernel until somebody wakes it: a wait on descriptors (argument 2 is
    // the time limit) without a limit.
    pid_t thread = 0;
    runner->read([&thread](const SimulatedMatch&) { thread = gettid(); });
    QFile call(QStringLiteral("/proc/self/task/%1/syscall").arg(thread));
    if (!call.open(QIODevice::ReadOnly)) QSKIP("this kernel does not say what threads wait for");
    const auto waitsForEver = [&call] {
      call.seek(0);
      const QList<QByteArray> words = call.readAll().split(' ');
      return words.size() > 4 && words[0] == QByteArray::number(SYS_ppoll) && words[3] == "0x0";
    };
    QTRY_VERIFY(waitsForEver());
  }

  void manyCallersAtOnce() {
    auto runner = start(builtIn("match-3v3"), false);
    runner->setSpeed(MatchRunner::unlimitedSpeed);
    std::vector<std::jthread> callers;
    for (int caller = 0; caller < 3; ++caller) {
      callers.emplace_back([&runner] {
        std::uint64_t known = 0;
        for (int i = 0; i < 100; ++i) {
          if (const auto frame = runner->latest(known)) known = frame->serial;
          runner->execute([](SimulatedMatch& match) {
            (void)match.simulation().placeBall({0.5, 0.5});
            return Changed::Yes;
          });
          runner->setPaused(i % 2 == 0);
          (void)runner->drainEvents();
        }
      });
    }
    callers.clear();
    runner->setPaused(true);
    QVERIFY(runner->waitUntilStill(10s));
  }

  void aMatchThatCannotBeCreatedReportsWhy() {
    MatchOptions options;
    options.cognition = Cognition::Separate;
    const auto runner = MatchRunner::start(builtIn("one-robot"), options);
    QVERIFY(!runner);
    QVERIFY(runner.error().message.find("pitchboard-robot") != std::string::npos);
  }

  void pacerDropsWhatCannotBeCaughtUp() {
    const Pacer::Time begin{};
    Pacer pacer;
    pacer.start(begin, 10, 60.0);
    QCOMPARE(pacer.target(begin + 1s), std::uint64_t{70});
    pacer.forgive(begin + 1s, 68);  // a little behind: to be caught up
    QCOMPARE(pacer.target(begin + 1s), std::uint64_t{70});
    pacer.forgive(begin + 1s, 20);  // hopelessly behind: goes on from here
    QCOMPARE(pacer.target(begin + 1s), std::uint64_t{20});
    QCOMPARE(pacer.target(begin + 2s), std::uint64_t{80});
    QVERIFY(pacer.wake(begin + 1s, 20) > begin + 1016ms);
    QVERIFY(pacer.wake(begin + 1s, 20) < begin + 1018ms);
  }

  // A match that was asked for more than this computer can give takes its programs along.
  void clocksOfProgramsFollowWhatIsReached() {
    constexpr double reached = 10.0;
    class Slow : public TickObserver {
      void ticked(const SimulatedMatch& /*match*/, std::chrono::nanoseconds /*tickTime*/) override {
        m_next = std::max(m_next + 1'000'000us / static_cast<int>(60 * reached),
                          std::chrono::steady_clock::now() - 50ms);
        std::this_thread::sleep_until(m_next);
      }
      std::chrono::steady_clock::time_point m_next{};
    };
    const QTemporaryDir folder;
    QFile file(folder.filePath("team.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"json({"version": 1, "name": "team", "processes": [{"name": "decision", "command":
      ["python3", "-u", "-c", "import time\nwhile True:\n time.sleep(1)\n print(time.monotonic())"]}]})json");
    file.close();
    Scenario scenario = builtIn("one-robot");
    scenario.robots[0].runtime.profile = file.fileName().toStdString();
    MatchOptions options;
    options.keyBase = testKeyBase();
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    options.speed = 10 * reached;
    options.waitForTeamPrograms = false;
    auto runner = MatchRunner::start(scenario, options, false, VariableCatalog::published(),
                                     {std::make_shared<Slow>()});
    QVERIFY(runner);
    std::vector<std::pair<double, double>> times;  // of the match, of the program
    double settled = 0.0;                          // s of the match
    const auto isLongEnough = [&] {
      for (const LogLine& line : (*runner)->drainLog()) {
        times.emplace_back(line.time, std::stod(line.text));
      }
      // Once it is known what is reached.
      if (times.empty() || times.back().first < 4 * reached) return false;
      if (settled == 0.0) {
        times.erase(times.begin(), times.end() - 1);
        settled = times.front().first;
      }
      return times.back().first > settled + 40.0;
    };
    QTRY_VERIFY_WITH_TIMEOUT(isLongEnough(), 60'000);
    const double match = times.back().first - times.front().first;
    const double program = times.back().second - times.front().second;
    QVERIFY2(std::abs(program - match) < 0.05 * match,
             qPrintable(QStringLiteral("%1 s, its clock %2 s").arg(match).arg(program)));
  }

  // A match waits for a program that cooperates, at ×1; the clocks of programs follow it at once
  // when it begins.
  void clocksFollowFromTheFirstTickOn() {
    constexpr double speed = 8.0;
    const QTemporaryDir folder;
    QFile file(folder.filePath("team.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"version": 1, "name": "team", "cycle": "MATCH_CYCLE", "processes": [{"name":
      "decision", "command": ["/bin/sleep", "600"], "response_timeout": 0.2}]})");
    file.close();
    Scenario scenario = builtIn("one-robot");
    scenario.robots[0].runtime.profile = file.fileName().toStdString();
    MatchOptions options;
    options.keyBase = testKeyBase();
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    options.speed = speed;
    auto made = SimulatedMatch::create(scenario, options);
    QVERIFY2(made, made ? "" : made.error().text().c_str());
    MatchPlayer player(std::move(*made));
    const auto now = std::chrono::steady_clock::now();
    player.match().pace().setPlaying(speed, false, now);
    player.setSpeed(speed, now);
    const auto clockSpeed = [&player] {
      return player.match().robots().processes().statuses().front().speed;
    };
    QCOMPARE(player.play(now).ticks, std::uint64_t{0});
    QCOMPARE(clockSpeed(), 1.0);
    player.match().blackboard(RobotId{1})->write(IntVar{447}, -1);  // it is there
    QVERIFY(player.play(now + 20ms, player.currentTick() + 1).next > now);
    QCOMPARE(clockSpeed(), speed);
  }
};

PITCHBOARD_TEST(TestMatchRunner)

}  // namespace tst_match_runner

#include "tst_match_runner.moc"

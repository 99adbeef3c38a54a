// SPDX-License-Identifier: GPL-3.0-or-later
// A process that shares no code with this project plays a simulated robot through its blackboard.
#include <robotlink/match/match_runner.h>
#include <robotlink/match/simulated_match.h>

#include <QElapsedTimer>
#include <QJsonArray>
#include <QJsonDocument>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>

#include "../support/guide_programs.h"
#include "../support/segment_keys.h"

namespace tst_unchanged_process {

using namespace pitchboard;
using namespace pitchboard::link;

class TestUnchangedProcess : public QObject {
  Q_OBJECT

  const int m_base = testKeyBase();
  const QTemporaryDir m_folder;

  /// A profile of one process; `more`: further keys of it.
  static QByteArray profileOf(const QStringList& command, const QByteArray& more = {}) {
    return R"({"version": 1, "name": "own", "processes": [{"name": "decision", "command": )" +
           QJsonDocument(QJsonArray::fromStringList(command)).toJson(QJsonDocument::Compact) +
           more + "}]}";
  }

  static ProcessStatus firstProgram(MatchRunner& runner) {
    const auto frame = runner.latest();
    const auto all = frame->robots[0].processes();
    return all.empty() ? ProcessStatus{} : all.front();
  }

  /// What is loaded into the first program of the match, and how it gets its time.
  static QByteArray timeVariables(MatchRunner& runner) {
    QByteArray found;
    QFile environment(QStringLiteral("/proc/%1/environ").arg(firstProgram(runner).pid));
    if (!environment.open(QIODevice::ReadOnly)) return "no environment";
    for (const QByteArray& one : environment.readAll().split('\0')) {
      if (one.contains("pitchboard_time") || one.startsWith("PITCHBOARD_TIME")) found += one + ' ';
    }
    return found;
  }

  /// A match of one robot, a metre behind the ball, whose processes are those of the profile.
  std::unique_ptr<MatchRunner> startWith(const QByteArray& profile, bool paused, double speed = 1.0,
                                         std::optional<double> duration = {},
                                         bool waits = true) const {
    QFile file(m_folder.filePath("profile.json"));
    if (!file.open(QIODevice::WriteOnly)) qFatal("no profile can be written");
    file.write(profile);
    file.close();
    Scenario scenario;
    ScenarioRobot robot;
    robot.identity.id = {1};
    robot.pose = {{-1.0, 0.0}, 0.0};
    robot.runtime.profile = file.fileName().toStdString();
    scenario.robots = {robot};
    scenario.writes = {{{1}, "COM_REFEREE", 2, 0.0}};
    scenario.stop.duration = duration;
    MatchOptions options;
    options.cognition = Cognition::Separate;
    options.keyBase = m_base;
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    options.speed = speed;
    options.waitForTeamPrograms = waits;
    auto runner = MatchRunner::start(scenario, options, paused);
    if (!runner) qFatal("%s", runner.error().text().c_str());
    return std::move(*runner);
  }

  /// Every line but the first comes a second after the one before it. A busy computer may print, or
  /// collect, a line late, so the lines are compared with the start, before which nothing waited.
  static void waitsAsLong(MatchRunner& runner, const QElapsedTimer& sinceStart,
                          const std::vector<std::string>& lines) {
    std::vector<std::string> reported;
    std::vector<double> times;
    const auto isDone = [&] {
      for (const LogLine& line : runner.drainLog()) {
        reported.push_back(line.text);
        times.push_back(1e-3 * double(sinceStart.elapsed()));
      }
      return reported.size() >= lines.size();
    };
    // A wait that does not return fails here.
    QTRY_VERIFY2_WITH_TIMEOUT(isDone(), reported.empty() ? "nothing" : reported.back().c_str(),
                              60'000);
    QCOMPARE(reported, lines);
    for (std::size_t i = 1; i < times.size(); ++i) {
      QVERIFY2(times[i] > 0.99 * double(i), qPrintable(QString::number(times[i])));
    }
  }

 private slots:
  void cleanup() { removeSegment(m_base + 100); }

  void theGuideShowsThesePrograms() {
    QCOMPARE(whyNotShown("naive_robot.py", 45), QString());
    QCOMPARE(whyNotShown("naive_robot.cpp", 45), QString());
  }

  void walksToTheBallAndKicksIt_data() {
    QTest::addColumn<QString>("physics");
    QTest::addColumn<QStringList>("program");
    const QStringList python{"python3", PITCHBOARD_SOURCE_DIR "/tests/end_to_end/naive_robot.py"};
    const QStringList cpp{QCoreApplication::applicationDirPath() + "/naive_robot"};
    QTest::newRow("Python, rigid-body") << "rigid-body" << python;
    QTest::newRow("Python, published") << "published" << python;
    QTest::newRow("C++, rigid-body") << "rigid-body" << cpp;
  }
  void walksToTheBallAndKicksIt() {
    QFETCH(QString, physics);
    QFETCH(QStringList, program);
    constexpr double cycle = 0.25;  // s of the match
    Scenario scenario;
    scenario.settings.physics = physics.toStdString();
    ScenarioRobot robot;
    robot.identity.id = {1};
    robot.pose = {{-1.0, 0.0}, 0.0};
    robot.behaviour = noBehaviour;
    scenario.robots = {robot};
    scenario.ball = {0.0, 0.0};
    scenario.writes = {{{1}, "COM_REFEREE", 2, 0.0}};
    MatchOptions options;
    options.cognition = Cognition::None;
    options.keyBase = m_base;

    {
      auto match = SimulatedMatch::create(scenario, options);
      QVERIFY2(match, match ? "" : match.error().text().c_str());
      // Vision has spoken before the process decides for the first time.
      for (int tick = 0; tick < scenario.settings.tickRate; ++tick) match->tick();

      QProcess process;
      process.setProcessChannelMode(QProcess::ForwardedChannels);
      process.start(program.first(),
                    program.mid(1) + QStringList{QString::number(m_base + 100), "0.01"});
      QVERIFY(process.waitForStarted());

      // The match goes on when the process has decided, however long that takes on a busy computer.
      auto board = SystemVSegments::open(m_base + 100, AttachMode::AttachOnly);
      QVERIFY(board);
      const IntVar working = *VariableCatalog::published().intVar("DECISION_WORKING");
      const auto hasDecided = [&] { return board->read(working) != 0; };
      bool kicked = false;
      double ballPath = 0.0, walkedAtKick = 0.0;
      for (double time = 0.0; time < 120.0 && !(kicked && ballPath > 0.3); time += cycle) {
        for (int decisions = 0; decisions < 2;
             ++decisions) {  // the first one may have begun before
          board->write(working, 0);
          QTRY_VERIFY(hasDecided());
        }
        for (int tick = 0; tick < cycle * scenario.settings.tickRate; ++tick) {
          match->tick();
          for (const sim::Event& event : match->simulation().events()) {
            if (event.kind != sim::EventKind::Kick || kicked) continue;
            kicked = true;
            QCOMPARE(event.robot, RobotId{1});
            walkedAtKick = match->simulation().state().statistics.front().distanceWalked;
          }
        }
        const Point ball = match->simulation().snapshot().ball;
        ballPath = std::hypot(ball.x, ball.y);
      }
      QVERIFY2(kicked, "the robot did not kick");
      QVERIFY2(ballPath > 0.3, "the ball did not move");
      QVERIFY2(walkedAtKick > 0.6, qPrintable(QString::number(walkedAtKick)));
      QCOMPARE(process.state(), QProcess::Running);
      process.kill();
      QVERIFY(process.waitForFinished());
    }
    QVERIFY(!SystemVSegments::info(m_base + 100));
  }

  // The same program, not told how fast it is played: the clocks that it sleeps by are the match's.
  void walksToTheBallAndKicksItAtTenTimes() {
    constexpr double speed = 10.0;
    auto runner = startWith(R"({"version": 1, "name": "python", "processes": [{"name":
      "decision", "command": ["python3", "naive_robot.py", "${key}"], "directory": ")" PITCHBOARD_SOURCE_DIR
                            R"(/tests/end_to_end", "heartbeat": "DECISION_WORKING"}]})",
                            true, speed);
    runner->setPaused(false);
    double walkedAtKick = 0.0, ballPath = 0.0;
    const auto kicked = [&] {
      for (const MatchEvent& event : runner->drainEvents()) {
        if (event.kind != MatchEventKind::Kick || walkedAtKick > 0.0) continue;
        walkedAtKick = runner->latest()->robots[0].statistics.distanceWalked;
      }
      const Point ball = runner->latest()->snapshot.ball;
      ballPath = std::hypot(ball.x, ball.y);
      return walkedAtKick > 0.0 && ballPath > 0.3;
    };
    QTRY_VERIFY_WITH_TIMEOUT(kicked(), 60'000);
    QVERIFY2(walkedAtKick > 0.6, qPrintable(QString::number(walkedAtKick)));
    const auto frame = runner->latest();
    QCOMPARE(frame->robots[0].processes().front().speed, speed);
    // Stopped with the match, and not taken for silent.
    const pid_t pid = frame->robots[0].processes().front().pid;
    runner->setPaused(true);
    const auto state = [pid] {
      QFile status(QStringLiteral("/proc/%1/stat").arg(pid));
      return status.open(QIODevice::ReadOnly) ? status.readAll().split(')').last().trimmed().left(1)
                                              : QByteArray();
    };
    QTRY_COMPARE(state(), QByteArray("T"));
    runner->setPaused(false);
    // Working and waiting change all the time.
    QTRY_VERIFY(QByteArray("SRD").contains(state()) && !state().isEmpty());
    runner.reset();
    QVERIFY(!SystemVSegments::info(m_base + 100));
  }

  // With "clock": "real" nothing stands between a program and the system; the clock of the match
  // lets every call of a program at ×1 through as it is.
  void timedWaitsReturnAtRealTime_data() {
    QTest::addColumn<QStringList>("program");
    QTest::addColumn<std::vector<std::string>>("lines");
    QTest::newRow("Python") << QStringList{"python3",
                                           PITCHBOARD_SOURCE_DIR "/tests/end_to_end/timed_waits.py"}
                            << std::vector<std::string>{"began", "Event.wait", "queue.get",
                                                        "lock.acquire"};
    QTest::newRow("C++") << QStringList{QCoreApplication::applicationDirPath() + "/timed_waits"}
                         << std::vector<std::string>{"began", "wait_for", "wait_until"};
  }
  void timedWaitsReturnAtRealTime() {
    QFETCH(QStringList, program);
    QFETCH(std::vector<std::string>, lines);
    QElapsedTimer sinceStart;
    sinceStart.start();
    {
      const auto real = startWith(profileOf(program, R"(, "clock": "real")"), false);
      QTRY_VERIFY(firstProgram(*real).pid != 0);
      QCOMPARE(timeVariables(*real), QByteArray());
      waitsAsLong(*real, sinceStart, lines);
    }
    sinceStart.start();
    const auto match = startWith(profileOf(program), false);
    QTRY_VERIFY(timeVariables(*match).contains("libpitchboard_time"));
    waitsAsLong(*match, sinceStart, lines);
  }
  // A program that is started at ×1 goes along with every later speed.
  void aProgramStartedAtOneFollowsLater() {
    const auto runner = startWith(
        profileOf({"python3", "-u", "-c",
                   "import time\nwhile True:\n time.sleep(0.5)\n print(time.monotonic())"}),
        false);
    std::vector<std::pair<double, double>> times;  // of the match, of the program
    const auto hasLines = [&](std::size_t count) {
      for (const LogLine& line : runner->drainLog()) {
        times.emplace_back(line.time, std::stod(line.text));
      }
      return times.size() >= count;
    };
    QTRY_VERIFY(hasLines(2));
    const pid_t pid = firstProgram(*runner).pid;
    runner->setSpeed(8.0);
    times.clear();
    // A line is collected late on a busy computer, and never early: the least by which the match is
    // ahead of the program is the same in the first lines and in the last ones.
    double apart = 0.0;
    const auto areTogether = [&] {
      if (!hasLines(50)) return false;
      const auto least = [](auto begin, auto end) {
        double ahead = 1e9;
        for (auto line = begin; line != end; ++line)
          ahead = std::min(ahead, line->first - line->second);
        return ahead;
      };
      const auto middle = times.begin() + std::ptrdiff_t(times.size() / 2);
      apart = least(middle, times.end()) - least(times.begin(), middle);
      // Lines are collected 20 times a second, 0.4 s of the match, and a clock that is behind
      // catches up.
      return std::abs(apart) < 0.05 * (times.back().first - times.front().first) + 0.4;
    };
    QTRY_VERIFY2(areTogether(), qPrintable(QString::number(apart)));
    QCOMPARE(firstProgram(*runner).pid, pid);
    QCOMPARE(firstProgram(*runner).clock, link::ProcessClock::Match);
    for (const MatchEvent& event : runner->drainEvents()) {
      QVERIFY(event.kind != MatchEventKind::ProcessRealTime);
    }
  }

  // A program with real time has nothing loaded, and is named once the match leaves real time.
  void whoKeepsRealTimeIsNamed() {
    const QString sentence =
        R"(B1 decision uses real time: its runtime profile says "clock": "real")";
    const auto runner =
        startWith(profileOf({"/bin/sleep", "600"}, R"(, "clock": "real")"), false, 8.0, {}, false);
    QTRY_VERIFY(firstProgram(*runner).pid != 0);
    QCOMPARE(timeVariables(*runner), QByteArray());
    QStringList given;
    const auto isAnnounced = [&] {
      for (const MatchEvent& event : runner->drainEvents()) {
        if (event.kind != MatchEventKind::ProcessRealTime) continue;
        given << QString::fromStdString(sentenceOf(event));
      }
      return !given.isEmpty();
    };
    QTRY_VERIFY_WITH_TIMEOUT(isAnnounced(), 30'000);
    QTRY_COMPARE_WITH_TIMEOUT(runner->latest()->slowestTeamProgram, std::optional(1.0), 30'000);
    // A match that waits for its programs does not leave it behind.
    runner->execute([](SimulatedMatch& match) {
      match.pace().waitForTeamPrograms = true;
      return Changed::No;
    });
    QTRY_COMPARE_WITH_TIMEOUT(firstProgram(*runner).speed, 1.0, 30'000);
    runner->execute([](SimulatedMatch& match) {
      match.pace().waitForTeamPrograms = false;
      return Changed::No;
    });
    runner->setSpeed(4.0);
    QTRY_COMPARE_WITH_TIMEOUT(firstProgram(*runner).speed, 4.0, 30'000);
    (void)isAnnounced();
    QCOMPARE(given, QStringList{sentence});
  }

  // A minute is played in no time: without waiting it would be over before Python runs.
  void asFastAsPossibleItWaitsForTheProgram() {
    const auto runner = startWith(
        profileOf({"python3", PITCHBOARD_SOURCE_DIR "/tests/end_to_end/naive_robot.py", "${key}"}),
        false, MatchRunner::unlimitedSpeed, 60.0);
    QTRY_VERIFY_WITH_TIMEOUT(runner->latest()->finished, 60'000);
    QVERIFY(runner->latest()->robots[0].statistics.distanceWalked > 0.1);
    for (const MatchEvent& event : runner->drainEvents()) {
      QVERIFY2(event.kind != MatchEventKind::ProcessNotAttached, sentenceOf(event).c_str());
    }
  }

  // Played faster than a team's program can think, the match slows down to it when the user wants,
  // and is as fast as it was asked to be when not.
  void theMatchWaitsForTeamProgramsWhenAsked() {
    constexpr double wanted = 400.0;
    auto runner = startWith(R"json({"version": 1, "name": "slow", "processes": [{"name":
      "decision", "command": ["python3", "-c",
        "import time\nwhile True:\n sum(range(300000))\n time.sleep(0.5)"]}]})json",
                            false, wanted, {}, false);
    const auto program = [&runner] { return firstProgram(*runner); };
    runner->setSpeed(1.0);
    // At x1 it is learned what the program does in a second of its own.
    QTRY_VERIFY_WITH_TIMEOUT(program().achieved == 1.0, 30'000);
    runner->setSpeed(wanted);
    QTRY_VERIFY_WITH_TIMEOUT(runner->latest()->slowestTeamProgram.has_value(), 60'000);
    QCOMPARE(program().speed, wanted);
    runner->execute([](SimulatedMatch& match) {
      match.pace().waitForTeamPrograms = true;
      return Changed::No;
    });
    QTRY_VERIFY_WITH_TIMEOUT(program().speed < 0.9 * wanted, 60'000);
    // Both: the program's time and the match's.
    const double slowed = program().speed;
    QVERIFY2(slowed >= 0.1, qPrintable(QString::number(slowed)));
    runner->execute([](SimulatedMatch& match) {
      match.pace().waitForTeamPrograms = false;
      return Changed::No;
    });
    QTRY_COMPARE_WITH_TIMEOUT(program().speed, wanted, 60'000);
    runner.reset();
    QVERIFY(!SystemVSegments::info(m_base + 100));
  }

  // A program with threads, a queue and select() walks as far at any speed.
  void theDrillTakesAsLongAtEightTimes() {
    struct Drill {
      double walked = 0.0, seconds = 0.0;
    };
    const auto play = [this](double speed) {
      const auto runner =
          startWith(profileOf({"python3", PITCHBOARD_SOURCE_DIR "/tests/end_to_end/drill_robot.py",
                               "${key}"}),
                    false, speed);
      Drill drill;
      double began = 0.0;
      const auto isDone = [&] {
        for (const LogLine& line : runner->drainLog()) {
          if (line.text == "began") began = line.time;
          if (line.text != "done") continue;
          drill.seconds = line.time - began;
          drill.walked = runner->latest()->robots[0].statistics.distanceWalked;
          return true;
        }
        return false;
      };
      if (!QTest::qWaitFor(isDone, 60'000)) qWarning("the drill does not end");
      return drill;
    };
    // A busy computer lets a step last longer, and none shorter: the shortest of several drills.
    constexpr int maxAttempts = 6;
    std::array<Drill, 2> shortest{Drill{1e9, 1e9}, Drill{1e9, 1e9}};  // at ×1, at ×8
    const auto differ = [&shortest](double Drill::*value) {
      return std::abs(shortest[1].*value / shortest[0].*value - 1.0);
    };
    // Lines are collected 20 times a second, 0.4 s of the match.
    const auto areAlike = [&] {
      return differ(&Drill::walked) < 0.05 && differ(&Drill::seconds) < 0.05 + 0.4 / 12.0;
    };
    for (int attempt = 0; attempt < maxAttempts && !(attempt > 0 && areAlike()); ++attempt) {
      for (const std::size_t fast : {0, 1}) {
        const Drill drill = play(fast == 1 ? 8.0 : 1.0);
        shortest[fast].walked = std::min(shortest[fast].walked, drill.walked);
        shortest[fast].seconds = std::min(shortest[fast].seconds, drill.seconds);
      }
    }
    QVERIFY(shortest[0].walked > 0.5);
    QVERIFY2(areAlike(), qPrintable(QStringLiteral("walked %1, seconds %2")
                                        .arg(differ(&Drill::walked))
                                        .arg(differ(&Drill::seconds))));
  }
};

PITCHBOARD_TEST(TestUnchangedProcess)

}  // namespace tst_unchanged_process

#include "tst_unchanged_process.moc"

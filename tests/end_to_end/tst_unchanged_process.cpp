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
#include <chrono>
#include <cmath>
#include <thread>

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

  static ProcessSummary firstProgram(MatchRunner& runner) {
    const auto frame = runner.latest();
    const auto all = frame->robots[0].processes();
    return all.empty() ? ProcessSummary{} : all.front();
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

  static void waitsAsLong(MatchRunner& runner, const std::vector<std::string>& lines) {
    std::vector<std::string> reported;
    std::vector<double> times;  // of the match
    const auto isDone = [&] {
      for (const LogLine& line : runner.takeLog()) {
        reported.push_back(line.text);
        times.push_back(line.time);
      }
      return reported.size() >= lines.size();
    };
    // A wait that does not return fails here.
    QTRY_VERIFY2_WITH_TIMEOUT(isDone(), reported.empty() ? "nothing" : reported.back().c_str(),
                              60'000);
    QCOMPARE(reported, lines);
    for (std::size_t i = 1; i < times.size(); ++i) {
      const double waited = times[i] - times[i - 1];
      QVERIFY2(waited > 0.3 && waited < 20.0, qPrintable(QString::number(waited)));
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
    constexpr double speed = 8.0;
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
      match->tick();  // vision has spoken before the process decides for the first time

      QProcess process;
      process.setProcessChannelMode(QProcess::ForwardedChannels);
      process.start(program.first(), program.mid(1) + QStringList{QString::number(m_base + 100),
                                                                  QString::number(0.25 / speed)});
      QVERIFY(process.waitForStarted());

      // A late tick is not made up for: the process would be left behind on a busy computer.
      using Time = std::chrono::steady_clock;
      const auto tick = std::chrono::duration_cast<Time::duration>(
          std::chrono::duration<double>(1 / (scenario.settings.tickRate * speed)));
      QElapsedTimer limit;
      limit.start();
      bool kicked = false;
      double ballPath = 0.0, walkedAtKick = 0.0;
      while (limit.elapsed() < 90'000 && !(kicked && ballPath > 0.3)) {
        const auto next = Time::now() + tick;
        match->tick();
        for (const sim::Event& event : match->simulation().events()) {
          if (event.kind != sim::EventKind::Kick || kicked) continue;
          kicked = true;
          QCOMPARE(event.robot, RobotId{1});
          walkedAtKick = match->simulation().state().statistics.front().distanceWalked;
        }
        const Point ball = match->simulation().snapshot().ball;
        ballPath = std::hypot(ball.x, ball.y);
        std::this_thread::sleep_until(next);
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
      for (const MatchEvent& event : runner->takeEvents()) {
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
    {
      const auto real = startWith(profileOf(program, R"(, "clock": "real")"), false);
      QTRY_VERIFY(firstProgram(*real).pid != 0);
      QCOMPARE(timeVariables(*real), QByteArray());
      waitsAsLong(*real, lines);
    }
    const auto match = startWith(profileOf(program), false);
    QTRY_VERIFY(timeVariables(*match).contains("libpitchboard_time"));
    waitsAsLong(*match, lines);
  }
  // A program that is started at ×1 goes along with every later speed.
  void aProgramStartedAtOneFollowsLater() {
    const auto runner = startWith(
        profileOf({"python3", "-u", "-c",
                   "import time\nwhile True:\n time.sleep(0.5)\n print(time.monotonic())"}),
        false);
    std::vector<std::pair<double, double>> times;  // of the match, of the program
    const auto hasLines = [&](std::size_t count) {
      for (const LogLine& line : runner->takeLog()) {
        times.emplace_back(line.time, std::stod(line.text));
      }
      return times.size() >= count;
    };
    QTRY_VERIFY(hasLines(2));
    const pid_t pid = firstProgram(*runner).pid;
    runner->setSpeed(8.0);
    times.clear();
    QTRY_VERIFY(hasLines(50));
    const double match = times.back().first - times.front().first;
    const double program = times.back().second - times.front().second;
    // Lines are collected 20 times a second, 0.4 s of the match.
    QVERIFY2(std::abs(match - program) < 0.05 * match + 0.4,
             qPrintable(QStringLiteral("%1 s, its clock %2 s").arg(match).arg(program)));
    QCOMPARE(firstProgram(*runner).pid, pid);
    QCOMPARE(firstProgram(*runner).whyRealTime, std::string());
    for (const MatchEvent& event : runner->takeEvents()) {
      QVERIFY(event.kind != MatchEventKind::ProcessRealTime);
    }
  }

  // Who uses real time has nothing loaded, and is named as soon as the match does not.
  void whoKeepsRealTimeIsNamed() {
    const QString sentence =
        R"(B1 decision uses real time: its runtime profile says "clock": "real")";
    const auto runner =
        startWith(profileOf({"/bin/sleep", "600"}, R"(, "clock": "real")"), false, 8.0, {}, false);
    QTRY_VERIFY(firstProgram(*runner).pid != 0);
    QCOMPARE(timeVariables(*runner), QByteArray());
    QStringList given;
    const auto isAnnounced = [&] {
      for (const MatchEvent& event : runner->takeEvents()) {
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
    for (const MatchEvent& event : runner->takeEvents()) {
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
        for (const LogLine& line : runner->takeLog()) {
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
    // One of three may meet a busy moment of the computer.
    std::array<std::array<double, 3>, 2> walked{}, seconds{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::size_t fast : {0, 1}) {
        const Drill drill = play(fast == 1 ? 8.0 : 1.0);
        walked[fast][i] = drill.walked;
        seconds[fast][i] = drill.seconds;
      }
    }
    const auto differ = [](std::array<std::array<double, 3>, 2>& values) {
      for (auto& all : values) std::ranges::sort(all);
      return std::abs(values[1][1] / values[0][1] - 1.0);
    };
    QVERIFY(walked[0][1] > 0.5);
    QVERIFY2(differ(walked) < 0.05, qPrintable(QString::number(differ(walked))));
    // Lines are collected 20 times a second, 0.4 s of the match.
    QVERIFY2(differ(seconds) < 0.05 + 0.4 / 12.0, qPrintable(QString::number(differ(seconds))));
  }
};

PITCHBOARD_TEST(TestUnchangedProcess)

}  // namespace tst_unchanged_process

#include "tst_unchanged_process.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>

#include <sys/shm.h>
#include <unistd.h>
#include <csignal>

#include <robotlink/match/match_runner.h>

#include "../support/program_run.h"
#include "../support/segment_keys.h"
#include "../support/test_socket.h"

namespace tst_cli_simulate {

using namespace pitchboard;
using namespace std::chrono_literals;

namespace {

using Run = ProgramRun;

Run simulate(const QStringList& arguments) {
  return runProgram("pitchboard-cli", QStringList("simulate") + arguments);
}

/// Two halves of 5 s in which nobody moves; red, at first on the right, is four goals ahead.
QString shortMatch(const QTemporaryDir& dir) {
  QFile file(dir.filePath("short.json"));
  if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
  file.write(R"({"version": 1, "name": "short", "noise": "none", "field": "kid-2020",
    "referee": {"rules": "humanoid-2021", "half_time": 5, "break_time": 1, "before_match": 1},
    "teams": [{"colour": "blue", "number": 12, "name": "RoboFEI"}],
    "score": {"left": 0, "right": 4}, "ball": {"x": 0, "y": 0},
    "robots": [{"team": "blue", "number": 1, "x": -3, "y": 2, "behaviour": "none"},
               {"team": "red", "number": 1, "x": 3, "y": 2, "behaviour": "none"}]})");
  return file.fileName();
}

/// A runtime profile whose only process is this one.
QString ownDecision(const QTemporaryDir& dir, const QStringList& command) {
  QFile file(dir.filePath("profile.json"));
  if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
  const QJsonObject process{{"name", "decision"}, {"command", QJsonArray::fromStringList(command)}};
  file.write(QJsonDocument(
                 QJsonObject{{"version", 1}, {"name", "own"}, {"processes", QJsonArray{process}}})
                 .toJson());
  return file.fileName();
}

}  // namespace

class TestCliSimulate : public QObject {
  Q_OBJECT

 private slots:
  void jsonAndTheSameHashAsTheRunner() {
    const Run run = simulate({"--duration", "10", "--seed", "5", "--json"});
    QCOMPARE(run.exitCode, 0);
    const QJsonObject out = QJsonDocument::fromJson(run.out).object();
    QCOMPARE(out["ticks"].toInt(), 600);
    QCOMPARE(out["finished_by"].toString(), QString("duration"));
    QCOMPARE(out["robots"].toArray().size(), 8);
    auto scenario = link::loadScenario("match").value();
    scenario.settings.seed = 5;
    auto runner = link::MatchRunner::start(scenario, {}, true).value();
    runner->runTo(600);
    QVERIFY(runner->waitUntilStill(20s));
    std::uint64_t hash = 0;
    runner->read([&](const link::SimulatedMatch& match) { hash = match.simulation().hash(); });
    QCOMPARE(out["state_hash"].toString(), QString("0x%1").arg(hash, 16, 16, QChar('0')));
    const Run paced = simulate({"--duration", "0:10", "--seed", "5", "--json", "--speed", "20"});
    QCOMPARE(QJsonDocument::fromJson(paced.out).object()["state_hash"], out["state_hash"]);
  }

  void summaryAndList() {
    const Run run = simulate({"--scenario", "one-robot", "--duration", "1"});
    QVERIFY(run.out.contains("Score      Blue 0 : 0 Red") && run.err.isEmpty());
    QVERIFY(simulate({"--list"}).out.startsWith("match "));
    QVERIFY(simulate({"--help"}).out.contains("pitchboard-cli simulate --scenario"));
  }

  void aProgramThatDiesInALoopIsInTheSummaryAndTheExitCode() {
    const QTemporaryDir dir;
    const QString profile = ownDecision(dir, {"sh", "-c", "echo no camera; exit 3"});
    const QStringList arguments{"--scenario", "one-robot", "--duration", "2",
                                "--speed",    "max",       "--runtime",  profile};
    const Run text = simulate(arguments);
    QCOMPARE(text.exitCode, 1);
    QVERIFY2(text.out.contains("Died       ") && text.out.contains("decision, ") &&
                 text.out.contains("exit code 3; last output: no camera"),
             text.out);
    const Run json = simulate(arguments + QStringList("--json"));
    QCOMPARE(json.exitCode, 1);
    const QJsonObject died =
        QJsonDocument::fromJson(json.out).object()["died"].toArray().at(0).toObject();
    QVERIFY(died["times"].toInt() >= 1 && died["name"].toString().endsWith(" decision"));
  }

  /// Who won is the same before and after a change of sides.
  void aMatchWithoutOrdersToPlayPrintsAWarning() {
    const Run idle = simulate({"--scenario", "match", "--referee", "published", "--duration", "6"});
    QCOMPARE(idle.exitCode, 0);
    QVERIFY2(idle.err.contains("none was told to"), idle.err.constData());
    for (const char* scenario : {"match", "match-3v3", "empty"}) {
      const Run played = simulate({"--scenario", scenario, "--duration", "6"});
      QVERIFY2(played.exitCode == 0 && !played.err.contains("told to"), played.err.constData());
    }
  }

  void theOutcomeNamesTheTeams() {
    QTemporaryDir dir;
    const QString file = shortMatch(dir);
    const Run run = simulate({"--scenario", file, "--json"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QJsonObject out = QJsonDocument::fromJson(run.out).object();
    QCOMPARE(out["finished_by"].toString(), QString("full_time"));
    QCOMPARE(out["score"].toObject(), (QJsonObject{{"left", 4}, {"right", 0}}));
    QCOMPARE(out["teams"].toArray(), (QJsonArray{QJsonObject{{"side", "right"},
                                                             {"colour", "blue"},
                                                             {"number", 12},
                                                             {"name", "RoboFEI"},
                                                             {"score", 0},
                                                             {"by_half", QJsonArray{0, 0}}},
                                                 QJsonObject{{"side", "left"},
                                                             {"colour", "red"},
                                                             {"number", 2},
                                                             {"score", 4},
                                                             {"by_half", QJsonArray{4, 0}}}}));
    QVERIFY(simulate({"--scenario", file})
                .out.contains("Score      RoboFEI (blue) 0 : 4 Red (0 : 4, 0 : 0)\n"));
    const Run unrefereed = simulate({"--scenario", "one-robot", "--duration", "1", "--json"});
    QCOMPARE(QJsonDocument::fromJson(unrefereed.out)["teams"].toArray(),
             (QJsonArray{QJsonObject{{"side", "left"}, {"colour", "blue"}, {"score", 0}},
                         QJsonObject{{"side", "right"}, {"colour", "red"}, {"score", 0}}}));
  }

  void aRecordingPlaysToTheFinalWhistle() {
    QTemporaryDir dir;
    const QString file = shortMatch(dir), session = dir.filePath("match.mcap");
    const Run run = runProgram("pitchboard-cli", {"record", "--scenario", file, "-o", session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.out.contains("\nRoboFEI (blue) 0 : 4 Red (0 : 4, 0 : 0); the final whistle\n"),
             run.out.constData());
    const Run events = runProgram("pitchboard-cli", {"inspect", session, "--events"});
    QVERIFY2(events.out.contains("final whistle"), events.out.constData());
  }

  /// It takes the options of `simulate` that say who plays, and by which rules.
  void aRecordingTakesRefereeRuntimeAndCognition() {
    QTemporaryDir dir;
    const QString session = dir.filePath("match.mcap");
    const auto record = [&](const QStringList& options) {
      QFile::remove(session);
      return runProgram("pitchboard-cli", QStringList{"record", "--scenario", "one-robot",
                                                      "--duration", "0:02", "-o", session} +
                                              options);
    };
    Run run = record({"--referee", "humanoid-2021"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    run = runProgram("pitchboard-cli", {"inspect", session, "--json"});
    QVERIFY2(run.out.contains("GAME_STATE"), run.out.constData());
    run = record({"--runtime", "B1=program=/bin/true"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.err.contains("B1 decision"), run.err.constData());  // and that it has ended
    run = record({"--cognition", "separate", "--speed", "max", "--key-base",
                  QString::number(testKeyBase() + 60)});
    QVERIFY2(run.exitCode == 0 && run.out.contains(": 2.000 s,"), run.err + run.out);
  }

  // With its clock, score, set play and penalties: PLAYING at 07:31 goes on in PLAYING at 07:31.
  void savedMomentOfAMatchGoesOn() {
    QTemporaryDir dir;
    const QString path = dir.filePath("moment.json");
    const QString session = dir.filePath("match.mcap");
    QVERIFY(simulate({"--duration", "100", "--save-moment", path}).exitCode == 0);
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QJsonObject saved = QJsonDocument::fromJson(file.readAll()).object();
    const QJsonObject game = saved["game"].toObject();
    QCOMPARE(game["state"].toString(), QString("playing"));
    // The ball is in play, so that the clock runs.
    QCOMPARE(game["set_play"].toObject()["step"].toString(), QString("free"));
    const double clock = game["clock"].toDouble();
    QVERIFY(clock > 400 && clock < 590);
    QVERIFY(!saved.contains("score") && !saved.contains("clock"));
    const QString second = dir.filePath("second.json");
    QCOMPARE(simulate({"--scenario", path, "--duration", "1", "--save-moment", second}).exitCode,
             0);
    QFile then(second);
    QVERIFY(then.open(QIODevice::ReadOnly));
    const QJsonObject later = QJsonDocument::fromJson(then.readAll()).object()["game"].toObject();
    QCOMPARE(later["state"].toString(), QString("playing"));
    QVERIFY(std::abs(clock - 1 - later["clock"].toDouble()) < 1e-3);
    QCOMPARE(later["score"], game["score"]);
  }

  // A GameController counts real seconds.
  void obeyingKeepsRealTime() {
    const TestSocket free;
    const QStringList obey{"--obey-referee", QString::number(free.port()), "--json"};
    const auto speed = [](const Run& run) {
      return QJsonDocument::fromJson(run.out).object()["speed"].toDouble();
    };
    const Run paced = simulate(obey + QStringList{"--duration", "2"});
    QVERIFY2(paced.exitCode == 0, paced.err.constData());
    QVERIFY2(speed(paced) < 1.5, paced.out.constData());
    QVERIFY(speed(simulate(obey + QStringList{"--duration", "20", "--speed", "max"})) > 1.5);
    const Run alone = simulate({"--answer-referee", "0", "--duration", "1"});
    QVERIFY(alone.exitCode != 0 && alone.err.contains("--obey-referee"));
    const Run negative = simulate({"--seed", "-1", "--duration", "1"});
    QVERIFY2(negative.exitCode == 2 && negative.err.contains("--seed must be 0 or more"),
             negative.err.constData());
  }

  void savedMomentGoesOn() {
    QTemporaryDir dir;
    const QString path = dir.filePath("moment.json");
    const QStringList save{"--scenario", "one-robot", "--duration", "3", "--save-moment", path};
    QCOMPARE(simulate(save).exitCode, 0);
    const auto moment = link::loadScenario(path.toStdString());
    QVERIFY2(moment.has_value(), moment ? "" : moment.error().text().c_str());
    QCOMPARE(moment->robots.size(), std::size_t{1});
    QVERIFY(!(moment->robots[0].pose == link::loadScenario("one-robot")->robots[0].pose));
    const Run again = simulate(save);
    QCOMPARE(again.exitCode, 2);
    QVERIFY(again.err.contains("This file exists; add --force"));
    QCOMPARE(simulate(save + QStringList("--force")).exitCode, 0);
    const Run nowhere = simulate({"--duration", "1", "--save-moment", "/nowhere/moment.json"});
    QCOMPARE(nowhere.exitCode, 2);
    QVERIFY(nowhere.err.contains("The folder does not exist"));
  }

  void traceHasARowPerTick() {
    QTemporaryDir dir;
    const QString path = dir.filePath("a.csv");
    const QStringList arguments{"--scenario", "one-robot", "--duration", "2", "--trace", path};
    QCOMPARE(simulate(arguments).exitCode, 0);
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll().count('\n'), 1 + 121);
    const Run again = simulate(arguments);
    QCOMPARE(again.exitCode, 2);
    QVERIFY(again.err.contains("--force"));
    QCOMPARE(simulate(arguments + QStringList{"--force"}).exitCode, 0);
  }

  void wrongArgumentsAreExplained_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QByteArray>("words");
    QTest::newRow("scenario") << QStringList{"--scenario", "nope"} << QByteArray("nope");
    QTest::newRow("speed") << QStringList{"--speed", "fast"} << QByteArray("--speed must be");
    QTest::newRow("speed range") << QStringList{"--speed", "1e6"}
                                 << QByteArray("from 0.01 to 1000, or max, not \"1e6\"");
    QTest::newRow("cognition") << QStringList{"--cognition", "x"} << QByteArray("--cognition must");
    QTest::newRow("duration") << QStringList{"--duration", "-1"} << QByteArray("--duration must");
    QTest::newRow("seconds") << QStringList{"--duration", "1:75"}
                             << QByteArray("write seconds (78.7), m:ss (1:18.7) or h:mm:ss");
    QTest::newRow("program of nobody")
        << QStringList{"--runtime", "B1=program=/bin/true", "--cognition", "none"}
        << QByteArray("--cognition none starts none; leave one of them out");
    QTest::newRow("physics") << QStringList{"--physics", "x"} << QByteArray("physics model");
    QTest::newRow("noise") << QStringList{"--noise", "papr"}
                           << QByteArray("did you mean \"paper\"");
    QTest::newRow("folder") << QStringList{"--trace", "/nonexistent/a.csv"}
                            << QByteArray("The folder does not exist");
    QTest::newRow("full disk") << QStringList{"--trace", "/dev/full", "--force"}
                               << QByteArray("The disk is full");
  }
  void wrongArgumentsAreExplained() {
    QFETCH(QStringList, arguments);
    QFETCH(QByteArray, words);
    const Run run = simulate(arguments);
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.startsWith("error: ") && run.err.contains(words), run.err.constData());
  }

  // As fast as possible a match is over before a program in Python has begun: it is waited for.
  void asFastAsPossibleAMatchWaitsForPrograms_data() {
    QTest::addColumn<QStringList>("command");
    QTest::addColumn<bool>("plays");
    const QString late =
        "import runpy, time\ntime.sleep(2)\n"
        "runpy.run_path('" PITCHBOARD_SOURCE_DIR "/tests/end_to_end/naive_robot.py')";
    QTest::newRow("begins late") << QStringList{"python3", "-c", late, "${key}"} << true;
    QTest::newRow("is started by another one")
        << QStringList{"/bin/sh", "-c", "python3 -c \"$0\" $1; true", late, "${key}"} << true;
    QTest::newRow("never attaches") << QStringList{"/bin/sleep", "600"} << false;
  }
  void asFastAsPossibleAMatchWaitsForPrograms() {
    QFETCH(QStringList, command);
    QFETCH(bool, plays);
    QTemporaryDir dir;
    const auto write = [&dir](const char* name, const QJsonObject& json) {
      QFile file(dir.filePath(name));
      if (!file.open(QIODevice::WriteOnly)) qFatal("no file");
      file.write(QJsonDocument(json).toJson());
      return file.fileName();
    };
    const QString profile = ownDecision(dir, command);
    const QString scenario =
        write("scenario.json",
              {{"version", 1},
               {"noise", "none"},
               {"robots",
                QJsonArray{QJsonObject{
                    {"team", "blue"}, {"number", 1}, {"x", -1}, {"y", 0}, {"runtime", profile}}}},
               {"writes", QJsonArray{QJsonObject{{"variable", "COM_REFEREE"}, {"value", 2}}}}});
    const Run run = simulate({"--scenario", scenario, "--cognition", "separate", "--speed", "max",
                              "--duration", "15", "--json"});
    QCOMPARE(run.exitCode, 0);
    const QJsonObject out = QJsonDocument::fromJson(run.out).object();
    QCOMPARE(out["simulated_seconds"].toDouble(), 15.0);
    const double walked = out["robots"].toArray()[0].toObject()["distance_m"].toDouble();
    QCOMPARE(walked > 0.1, plays);
    const QByteArray given =
        "warning: B1 decision has not attached to its blackboard after 10 s; the match starts "
        "without it\n";
    // Another test may play match 0 at the same time; the command line says so first.
    QByteArray reported = run.err;
    if (reported.startsWith("match ")) reported.remove(0, reported.indexOf('\n') + 1);
    QCOMPARE(reported, plays ? QByteArray() : given);
  }

  // A second of Python's work in ten of its own: "max" is what it manages.
  void maxSlowsDownToPrograms() {
    QTemporaryDir dir;
    const QString profile =
        ownDecision(dir, {"python3", "-c",
                          "import ctypes, sys, time\n"
                          "c = ctypes.CDLL(None)\n"
                          "c.shmat(c.shmget(int(sys.argv[1]), 2048, 0o600), None, 0)\n"
                          "while True:\n end = time.thread_time() + 0.02\n"
                          " while time.thread_time() < end: pass\n time.sleep(0.18)\n",
                          "${key}"});
    const auto play = [&](const QStringList& more) {
      return simulate(QStringList{"--scenario", "one-robot", "--cognition", "separate", "--speed",
                                  "max", "--duration", "8", "--json", "--runtime", profile,
                                  "--key-base", QString::number(testKeyBase() + 80)} +
                      more);
    };
    const Run run = play({});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QJsonObject out = QJsonDocument::fromJson(run.out).object();
    // 0.02 s of work in 0.2 s: not more than ten times.
    QVERIFY2(out["speed"].toDouble() < 10.0, run.out.constData());
    const QJsonObject program = out["programs"].toArray().at(0).toObject();
    QCOMPARE(program["name"], QJsonValue("B1 decision"));
    QCOMPARE(program["clock"], QJsonValue("match"));
    QVERIFY2(program["kept"].toDouble() > 0.3 && program["cycles"].toInt() > 4,
             run.out.constData());
    QVERIFY(program["missed_cycles"].isDouble() && program["speed"].toDouble() > 0.5);
    const Run fast = play({"--keep-speed"});
    QVERIFY2(QJsonDocument::fromJson(fast.out)["speed"].toDouble() > out["speed"].toDouble(),
             fast.out.constData());
  }

  void outputOfProgramsIsShownAndKept() {
    QTemporaryDir dir;
    const QString profile = ownDecision(
        dir,
        {"/bin/sh", "-c", "echo ready to play ${team} ${shirt} as robot ${robot}; exec sleep 600"});
    const QStringList match{"--scenario", "one-robot",  "--cognition",
                            "separate",   "--speed",    "4",
                            "--duration", "4",          "--runtime",
                            profile,      "--key-base", QString::number(testKeyBase() + 80)};
    const Run run = simulate(match);
    QVERIFY2(
        run.exitCode == 0 && run.err.contains("B1 decision: ready to play blue 1 as robot 1\n"),
        run.err.constData());
    const QString session = dir.filePath("match.mcap"), text = dir.filePath("match.jsonl");
    const Run record = runProgram("pitchboard-cli", QStringList{"record", "-o", session} + match);
    QVERIFY2(record.exitCode == 0, record.err.constData());
    const Run exported =
        runProgram("pitchboard-cli", {"export", session, "--to", "jsonl", "-o", text});
    QVERIFY2(exported.exitCode == 0, exported.err.constData());
    QFile file(text);
    QVERIFY(file.open(QIODevice::ReadOnly) && file.readAll().contains("ready to play"));
  }

  void aSignalEndsProcessesAndRemovesSegments() {
    const int base = testKeyBase();
    QProcess process;
    process.start(QString(PITCHBOARD_BIN) + "/pitchboard-cli",
                  {"simulate", "--scenario", "one-robot", "--cognition", "separate", "--json",
                   "--duration", "600", "--key-base", QString::number(base)});
    QVERIFY(process.waitForStarted());
    // The segment is there, and besides the simulator the five robot processes are attached to it.
    const auto attached = [&] {
      const int id = ::shmget(base + 100, 0, 0);
      shmid_ds info{};
      return id >= 0 && ::shmctl(id, IPC_STAT, &info) == 0 ? static_cast<int>(info.shm_nattch) : -1;
    };
    QTRY_COMPARE_WITH_TIMEOUT(attached(), 6, 20000);
    ::kill(static_cast<pid_t>(process.processId()), SIGTERM);
    QVERIFY(process.waitForFinished(60'000));
    QCOMPARE(process.exitCode(), 0);
    QCOMPARE(QJsonDocument::fromJson(process.readAllStandardOutput()).object()["finished_by"],
             QJsonValue("interrupted"));
    QCOMPARE(attached(), -1);
  }

  // Killed, it can do nothing any more: its guard ends children and what they started, also what
  // left their process group, and removes the segment.
  void nothingIsLeftAfterSigkill() {
    const int base = testKeyBase() + 40;  // keys beside those above
    QTemporaryDir dir;
    // Its own seconds tell the sleeps of this test from others.
    const QByteArray asleep = QByteArray::number(100'000 + getpid());
    QFile profile(dir.filePath("team.json"));
    QVERIFY(profile.open(QIODevice::WriteOnly));
    profile.write(R"({"version": 1, "name": "team", "processes": [
      {"name": "localization", "reference": "localization"},
      {"name": "decision", "command": ["sh", "-c",
       "sleep )" + asleep +
                  R"( & (setsid sleep )" + asleep + R"( &) ; exec sleep )" + asleep + R"("]}]})");
    profile.close();
    const auto left = [&asleep, base] {
      int found = 0;
      for (const QString& pid : QDir("/proc").entryList(QDir::Dirs)) {
        QFile file(QString("/proc/%1/cmdline").arg(pid));
        if (!file.open(QIODevice::ReadOnly)) continue;
        const QByteArray line = file.readAll();
        found +=
            line == QByteArray("sleep") + '\0' + asleep + '\0' ||
            (line.contains("pitchboard-robot") && line.contains(QByteArray::number(base + 100)));
      }
      return found;
    };
    const auto hasSegment = [base] { return ::shmget(base + 100, 0, 0) >= 0; };
    QProcess process;
    process.start(
        QString(PITCHBOARD_BIN) + "/pitchboard-cli",
        {"simulate", "--scenario", "one-robot", "--cognition", "separate", "--duration", "100000",
         "--speed", "1", "--key-base", QString::number(base), "--runtime", profile.fileName()});
    QVERIFY(process.waitForStarted());
    QTRY_COMPARE_WITH_TIMEOUT(left(), 4, 30000);
    QVERIFY(hasSegment());
    ::kill(static_cast<pid_t>(process.processId()), SIGKILL);
    QVERIFY(process.waitForFinished(60'000));
    QTRY_COMPARE_WITH_TIMEOUT(left(), 0, 30000);
    QTRY_VERIFY_WITH_TIMEOUT(!hasSegment(), 30000);
  }
};

PITCHBOARD_TEST(TestCliSimulate)

}  // namespace tst_cli_simulate

#include "tst_cli_simulate.moc"

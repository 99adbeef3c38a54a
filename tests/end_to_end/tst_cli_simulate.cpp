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

namespace tst_cli_simulate {

using namespace pitchboard;
using namespace std::chrono_literals;

namespace {

using Run = ProgramRun;

Run simulate(const QStringList& arguments) {
  return runProgram("pitchboard-cli", QStringList("simulate") + arguments);
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
    QCOMPARE(out["robots"].toArray().size(), 6);
    auto scenario = link::loadScenario("match").value();
    scenario.settings.seed = 5;
    auto runner = link::MatchRunner::start(scenario, {}, true).value();
    runner->runTo(600);
    QVERIFY(runner->waitUntilStill(20s));
    std::uint64_t hash = 0;
    runner->execute([&](link::SimulatedMatch& match) { hash = match.simulation().hash(); });
    QCOMPARE(out["state_hash"].toString(), QString("0x%1").arg(hash, 16, 16, QChar('0')));
    const Run paced = simulate({"--duration", "10", "--seed", "5", "--json", "--speed", "20"});
    QCOMPARE(QJsonDocument::fromJson(paced.out).object()["state_hash"], out["state_hash"]);
  }

  void summaryAndList() {
    const Run run = simulate({"--scenario", "one-robot", "--duration", "1"});
    QVERIFY(run.out.contains("Score      left 0 : 0 right") && run.err.isEmpty());
    QVERIFY(simulate({"--list"}).out.startsWith("match "));
    QVERIFY(simulate({"--help"}).out.contains("pitchboard-cli simulate --scenario"));
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
    QVERIFY(again.err.contains("This file exists"));
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
    QTest::newRow("cognition") << QStringList{"--cognition", "x"} << QByteArray("--cognition must");
    QTest::newRow("duration") << QStringList{"--duration", "-1"} << QByteArray("--duration must");
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

  void aSignalEndsProcessesAndRemovesSegments() {
    const int base = testKeyBase();
    QProcess process;
    process.start(QString(PITCHBOARD_BIN) + "/pitchboard-cli",
                  {"simulate", "--scenario", "one-robot", "--cognition", "external", "--json",
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
        {"simulate", "--scenario", "one-robot", "--cognition", "external", "--duration", "100000",
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

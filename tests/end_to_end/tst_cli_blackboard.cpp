// SPDX-License-Identifier: GPL-3.0-or-later
// pitchboard-cli blackboard and catalog as a person at a terminal uses them.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

#include "../support/program_run.h"
#include "../support/segment_keys.h"

namespace tst_cli_blackboard {

class TestCliBlackboard : public QObject {
  Q_OBJECT

  const int m_base = testKeyBase();
  const QString m_baseText = QString::number(m_base);

  ProgramRun board(const QStringList& arguments) {
    return cli(QStringList{"blackboard"} + arguments + QStringList{"--key-base", m_baseText});
  }

 private slots:
  void init() { QCOMPARE(board({"create", "1"}).exitCode, 0); }
  void cleanup() { removeSegment(m_base + 100); }

  void setAndDump() {
    QCOMPARE(board({"set", "1", "DECISION_ACTION_A=-2147483648", "IMU_EULER_Z=0.1",
                    "VISION_BALL_DIST=nan"})
                 .exitCode,
             0);
    const auto dump = QJsonDocument::fromJson(board({"dump", "1", "--json"}).out).object();
    QCOMPARE(dump["int"].toObject()["DECISION_ACTION_A"].toDouble(), -2147483648.0);
    QCOMPARE(dump["float"].toObject()["IMU_EULER_Z"].toDouble(), 0.1);
    QCOMPARE(dump["float"].toObject()["VISION_BALL_DIST"].toString(), QString("nan"));
    QVERIFY(board({"dump", "1"}).out.contains("IMU_EULER_Z                      0.1\n"));
  }

  void badValues_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QByteArray>("message");
    QTest::newRow("range") << QStringList{"set", "1", "VOLTAGE=2147483648"}
                           << QByteArray("between");
    QTest::newRow("type") << QStringList{"set", "1", "VOLTAGE=1.5"} << QByteArray("whole number");
    QTest::newRow("float") << QStringList{"set", "1", "IMU_EULER_Z=x"} << QByteArray("nan or inf");
    QTest::newRow("name") << QStringList{"set", "1", "NO=1"} << QByteArray("no such variable");
    QTest::newRow("form") << QStringList{"set", "1", "VOLTAGE"} << QByteArray("NAME=VALUE");
    QTest::newRow("robot") << QStringList{"dump", "65"} << QByteArray("error: ");
    QTest::newRow("none") << QStringList{"dump", "2"} << QByteArray("no such segment");
    QTest::newRow("again") << QStringList{"create", "1"} << QByteArray("exists already");
  }
  void badValues() {
    QFETCH(QStringList, arguments);
    QFETCH(QByteArray, message);
    const ProgramRun output = board(arguments);
    QCOMPARE(output.exitCode, 2);
    QVERIFY2(output.err.startsWith("error: ") && output.err.contains(message),
             output.err.constData());
  }

  void aBadValueWritesNothing() {
    QCOMPARE(board({"set", "1", "VOLTAGE=5", "IMU_EULER_Z=x"}).exitCode, 2);
    QVERIFY(board({"dump", "1"}).out.contains("VOLTAGE                          0\n"));
  }

  void watchShowsChangesAndEndsOnInterrupt() {
    QProcess watch;
    watch.start(PITCHBOARD_BIN "/pitchboard-cli", {"blackboard", "watch", "1", "VOLTAGE", "--json",
                                                   "--interval", "1", "--key-base", m_baseText});
    QByteArray err;
    QTRY_VERIFY((err += watch.readAllStandardError()).contains("watching"));
    QCOMPARE(board({"set", "1", "VOLTAGE=120", "CONTROL_ACTION=3"}).exitCode, 0);
    QByteArray out;
    QTRY_VERIFY((out += watch.readAllStandardOutput()).endsWith('\n'));
    const auto change = QJsonDocument::fromJson(out).object();
    QCOMPARE(change["name"].toString(), QString("VOLTAGE"));
    QCOMPARE(change["value"].toInt(), 120);
    ::kill(static_cast<pid_t>(watch.processId()), SIGINT);
    QVERIFY(watch.waitForFinished());
    QCOMPARE(watch.exitStatus(), QProcess::NormalExit);
    QCOMPARE(watch.exitCode(), 0);
  }

  void orphansAreListedAndRemoved() {
    const auto rows = QJsonDocument::fromJson(board({"list", "--json"}).out).array();
    QCOMPARE(rows.size(), 1);
    QCOMPARE(rows[0].toObject()["robot"].toInt(), 1);
    QVERIFY(rows[0].toObject()["orphan"].toBool());
    QVERIFY(board({"list"}).out.contains("orphan"));
    QCOMPARE(board({"remove", "--orphans"}).exitCode, 0);
    QVERIFY(shmget(m_base + 100, 0, 0) < 0);
  }

  void attachedIsRemovedOnlyByForce() {
    void* const address = shmat(shmget(m_base + 100, 0, 0), nullptr, 0);
    QCOMPARE(board({"remove", "1"}).exitCode, 2);
    QVERIFY(shmget(m_base + 100, 0, 0) >= 0);
    QCOMPARE(board({"remove", "1", "--force"}).exitCode, 0);
    shmdt(address);
    QVERIFY(shmget(m_base + 100, 0, 0) < 0);
  }

  void importedMapRoundTrips() {
    QTemporaryDir folder;
    const QString file = folder.filePath("team.json");
    QCOMPARE(
        cli({"catalog", "import", PITCHBOARD_TEST_DATA "/catalogs/numbers.h", "--json", "-o", file})
            .exitCode,
        0);
    const ProgramRun table = cli({"catalog", "import", file});
    QVERIFY(table.out.contains("int    17  DECISION_ACTION_A\n"));
    QVERIFY(table.out.endsWith("83 int and 122 float variables\n"));
    QCOMPARE(board({"dump", "1", "--catalog", file}).exitCode, 0);
    QCOMPARE(cli({"catalog", "import", folder.filePath("none.h")}).exitCode, 2);
  }
};

PITCHBOARD_TEST(TestCliBlackboard)

}  // namespace tst_cli_blackboard

#include "tst_cli_blackboard.moc"

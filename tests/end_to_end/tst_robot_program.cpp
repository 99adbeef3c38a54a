// SPDX-License-Identifier: GPL-3.0-or-later
// pitchboard-robot as a process of its own on a System V blackboard.
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/blackboard/system_v.h>

#include "../support/program_run.h"
#include "../support/segment_keys.h"

namespace tst_robot_program {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

ProgramRun robot(const QStringList& arguments) {
  return runProgram("pitchboard-robot", arguments);
}

}  // namespace

class TestRobotProgram : public QObject {
  Q_OBJECT

  const int m_base = testKeyBase();
  const RobotVariables m_variables;

  QStringList withBase(const QStringList& arguments) const {
    return arguments + QStringList{"--key-base", QString::number(m_base)};
  }
  static void start(QProcess& process, const QStringList& arguments) {
    process.start(PITCHBOARD_BIN "/pitchboard-robot", arguments);
    QTRY_VERIFY(process.canReadLine() || process.state() == QProcess::NotRunning);
  }
  /// A decision process of robot 2 with these options kicks a ball that is 39 cm in front of it.
  void kicksFrom39Centimetres(const QStringList& options) const {
    QProcess process;
    start(process, withBase(QStringList("decision") + options));
    auto board = SystemVSegments::open(m_base + 200, AttachMode::AttachOnly);
    QVERIFY(board);
    board->write(m_variables.visionPanDeg, 10.0F);
    board->write(m_variables.visionBallDist, 39.0F);
    board->write(m_variables.comReferee, 2);
    QTRY_COMPARE(board->read(m_variables.decisionActionA), 5);
    process.kill();
    QVERIFY(process.waitForFinished());
  }

 private slots:
  void cleanup() {
    for (const int n : {1, 2, 7}) removeSegment(m_base + 100 * n);
  }

  void decisionActsOnTheBlackboard() {
    QProcess process;
    start(process, withBase({"decision", "--robot", "1", "--behaviour", "naive"}));
    QCOMPARE(process.readLine(), QByteArray("decision of robot 1 on key ") +
                                     QByteArray::number(m_base + 100) + ", behaviour naive\n");
    auto board = SystemVSegments::open(m_base + 100, AttachMode::AttachOnly);
    QVERIFY(board);
    const RobotVariables& v = m_variables;
    board->write(v.visionLost, 1);
    board->write(v.comReferee, 2);
    QTRY_COMPARE(board->read(v.decisionActionA), 3);
    QCOMPARE(board->read(v.decisionSearchOn), 1);
    board->write(v.visionPanDeg, 90.0F);
    board->write(v.visionBallDist, 100.0F);
    board->write(v.visionLost, 0);
    QTRY_COMPARE(board->read(v.decisionActionA), 2);
    board->write(v.visionPanDeg, 0.0F);
    QTRY_COMPARE(board->read(v.decisionActionA), 8);
    QCOMPARE(board->read(v.decisionActionB), 20);
    board->write(v.visionBallDist, 24.0F);
    QTRY_COMPARE(board->read(v.decisionActionA), 4);
    board->write(v.comReferee, 1);
    QTRY_COMPARE(board->read(v.decisionActionA), 0);
    board->write(v.decisionWorking, 0);
    QTRY_COMPARE(board->read(v.decisionWorking), 1);

    ::kill(static_cast<pid_t>(process.processId()), SIGTERM);
    QVERIFY(process.waitForFinished());
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 0);
    QCOMPARE(process.readAllStandardError(), QByteArray());
    QVERIFY(SystemVSegments::info(m_base + 100));  // nobody removes a robot's blackboard
  }

  void distanceToKick() {
    kicksFrom39Centimetres({"--robot", "2", "--behaviour", "naive", "--distance-to-kick", "40"});
  }

  /// A file of numbers, named on the command line or in the INI file.
  void parametersFromAFile() {
    QTemporaryDir folder;
    const auto write = [&](const char* name, const QByteArray& text) {
      QFile file(folder.filePath(name));
      if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
      file.write(text);
      return file.fileName();
    };
    const QString best =
        write("best.json", R"({"version": 1, "parameters": {"distance_to_kick": 40}})");
    const QString ini = write("robot.ini",
                              "[Communication]\nno_player_robofei = 2\n[Pitchboard]\n"
                              "behaviour = naive\nparameters = " +
                                  best.toUtf8() + '\n');
    for (const QStringList& arguments :
         {QStringList{"--robot", "2", "--behaviour", "naive", "--parameters", best},
          QStringList{"--config", ini}}) {
      kicksFrom39Centimetres(arguments);
      removeSegment(m_base + 200);
    }
    const ProgramRun none =
        robot(withBase({"decision", "--robot", "2", "--parameters", "nowhere.json"}));
    QVERIFY2(none.exitCode == 2 && none.err.contains("nowhere.json"), none.err.constData());
  }

  void endSignals_data() {
    QTest::addColumn<int>("signal");
    QTest::addColumn<QString>("name");
    QTest::newRow("SIGTERM") << SIGTERM << "communication";
    QTest::newRow("SIGINT") << SIGINT << "communication";
    QTest::newRow("SIGHUP") << SIGHUP << "decision";
  }
  void endSignals() {
    QFETCH(int, signal);
    QFETCH(QString, name);
    QProcess process;
    start(process, withBase({name, "--robot", "1", "--udp-address", "127.0.0.1",
                             "--telemetry-port-base", "64000", "--team-port-base", "64100"}));
    QVERIFY(process.state() == QProcess::Running);
    ::kill(static_cast<pid_t>(process.processId()), signal);
    QVERIFY(process.waitForFinished());
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 0);
  }

  void numberFromConfig() {
    QTemporaryDir folder;
    QFile file(folder.filePath("config.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(
        "; of our robot\r\n[Vision]\r\nno_player_robofei = 3\r\n[Communication]\r\n"
        "No_Player_RoboFEI : 7 ; lucky\r\n");
    file.close();
    QProcess process;
    start(process, withBase({"decision", "--config", file.fileName()}));
    QVERIFY(process.readLine().startsWith("decision of robot 7 on key "));
    QVERIFY(SystemVSegments::info(m_base + 700));
    process.kill();
    QVERIFY(process.waitForFinished());
  }

  void badConfig_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QByteArray>("message");
    const auto row = [](const char* name, const char* text, const char* message) {
      QTest::newRow(name) << QByteArray(text) << QByteArray(message);
    };
    row("no section", "no_player_robofei = 1\n", "gives no robot number");
    row("no value", "[Communication]\nport = 1\n", "gives no robot number");
    row("not a number", "[Communication]\nno_player_robofei = one\n", "line 2: 'one' is not");
    row("range", "\n[Communication]\nno_player_robofei = 65\n", "line 3: there is no robot 65");
    row("section", "[Communication\n", "line 1: a section name");
    row("empty", "", "gives no robot number");
  }
  void badConfig() {
    QFETCH(QByteArray, text);
    QFETCH(QByteArray, message);
    QTemporaryDir folder;
    QFile file(folder.filePath("config.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
    file.close();
    const ProgramRun output = robot(withBase({"decision", "--config", file.fileName()}));
    QCOMPARE(output.exitCode, 2);
    QVERIFY2(output.err.startsWith("error: ") && output.err.contains(message), output.err.data());
  }

  void refusals_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QByteArray>("message");
    const auto row = [](const char* name, const QStringList& arguments, const char* message) {
      QTest::newRow(name) << arguments << QByteArray(message);
    };
    row("nothing", {}, "--help");
    row("no such process", {"vision"}, "--help");
    row("no robot", {"decision"}, "--robot is missing");
    row("robot 0", {"decision", "--robot", "0"}, "no robot 0");
    row("robot 65", {"decision", "--robot", "65"}, "no robot 65");
    row("robot x", {"decision", "--robot", "x"}, "--robot");
    row("unknown option", {"decision", "--robot", "1", "--nonsense"}, "--nonsense");
    row("behaviour", {"decision", "--robot", "1", "--behaviour", "clever"}, "\"clever\"");
    row("distance", {"decision", "--robot", "1", "--distance-to-kick", "nan"}, "distance_to_kick");
    row("number of it",
        {"decision", "--robot", "1", "--behaviour", R"({"name": "keeper", "kick_distance": 7})"},
        "kick_distance: must lie between");
    row("address", {"communication", "--robot", "1", "--udp-address", "nowhere"}, "\"nowhere\"");
    row("port", {"communication", "--robot", "1", "--telemetry-port-base", "65535"}, "1..65535");
    row("no file", {"decision", "--config", "/no/such.ini"}, "No such file");
    row("folder", {"decision", "--config", "/"}, "error: /");
  }
  void refusals() {
    QFETCH(QStringList, arguments);
    QFETCH(QByteArray, message);
    const ProgramRun output = robot(arguments);
    QCOMPARE(output.exitCode, 2);
    QCOMPARE(output.out, QByteArray());
    QVERIFY2(output.err.startsWith("error: ") && output.err.contains(message), output.err.data());
  }

  void refusesASegmentOfAnotherSize() {
    const int shmid = shmget(m_base + 100, 4096, IPC_CREAT | IPC_EXCL | 0600);
    QVERIFY(shmid >= 0);
    const ProgramRun output = robot(withBase({"decision", "--robot", "1"}));
    QCOMPARE(output.exitCode, 2);
    QVERIFY2(output.err.startsWith("error: ") && output.err.contains("4096"), output.err.data());
  }

  void helpShowsExamples() {
    for (const QStringList& arguments :
         {QStringList{"--help"}, {"decision", "--help"}, {"communication", "--help"}}) {
      const ProgramRun output = robot(arguments);
      QCOMPARE(output.exitCode, 0);
      QVERIFY2(output.out.contains("Example:\n  pitchboard-robot "), output.out.data());
    }
  }

  void list() {
    const ProgramRun output = robot({"list"});
    QCOMPARE(output.exitCode, 0);
    for (const char* name : {"decision", "communication", "naive"}) {
      QVERIFY(output.out.contains(QByteArray("\n  ") + name + ' '));
    }
  }
};

PITCHBOARD_TEST(TestRobotProgram)

}  // namespace tst_robot_program

#include "tst_robot_program.moc"

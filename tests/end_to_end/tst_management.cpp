// SPDX-License-Identifier: GPL-3.0-or-later
// pitchboard-robot management with real processes: order, restarts, an end without remains.
#include <QElapsedTimer>
#include <QProcess>
#include <QRegularExpression>
#include <QtTest>
#include <csignal>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/processes/management_config.h>

#include "../support/program_run.h"
#include "../support/segment_keys.h"

namespace tst_management {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

bool alive(qint64 pid) {
  if (::kill(static_cast<pid_t>(pid), 0) != 0) return false;
  QFile status(QString("/proc/%1/stat").arg(pid));
  return status.open(QIODevice::ReadOnly) && !status.readAll().contains(") Z ");
}

}  // namespace

class TestManagement : public QObject {
  Q_OBJECT

  const int m_base = testKeyBase();
  const int m_key = m_base + 300;
  const RobotVariables m_variables;
  std::unique_ptr<QTemporaryDir> m_folder;
  std::unique_ptr<QProcess> m_manager;
  QByteArray m_output;

  QString config(const QByteArray& text) {
    QFile file(m_folder->filePath("robot.ini"));
    if (!file.open(QIODevice::WriteOnly)) qFatal("no temporary file");
    file.write(text);
    return file.fileName();
  }
  void start(const QByteArray& management) {
    const QString file = config(
        "[Communication]\nno_player_robofei = 3\n[Pitchboard]\nbehaviour = naive\n"
        "telemetry_port_base = 60000\nteam_port_base = 60100\nteam = 77\n"
        "[Pitchboard Management]\n" +
        management);
    m_manager->setProcessChannelMode(QProcess::MergedChannels);
    m_manager->start(PITCHBOARD_BIN "/pitchboard-robot",
                     {"management", "--config", file, "--key-base", QString::number(m_base)});
    QVERIFY(m_manager->waitForStarted());
  }
  const QByteArray& output() {
    m_output += m_manager->readAll();
    return m_output;
  }
  /// Process numbers of this one, in the order of its starts.
  std::vector<qint64> pidsOf(const QString& name) {
    std::vector<qint64> pids;
    const QRegularExpression line("^" + name + " started, process (\\d+)$",
                                  QRegularExpression::MultilineOption);
    auto found = line.globalMatch(QString::fromUtf8(output()));
    while (found.hasNext()) pids.push_back(found.next().captured(1).toLongLong());
    return pids;
  }
  bool reported(const char* text) { return output().contains(text); }
  void endsWithoutRemains(int signal = SIGTERM) {
    std::vector<qint64> pids;
    for (const char* name :
         {"localization", "team", "decision", "planning", "communication", "own"}) {
      for (const qint64 pid : pidsOf(name)) pids.push_back(pid);
    }
    ::kill(static_cast<pid_t>(m_manager->processId()), signal);
    QVERIFY(m_manager->waitForFinished(60'000));
    QCOMPARE(m_manager->exitStatus(), QProcess::NormalExit);
    QCOMPARE(m_manager->exitCode(), 0);
    for (const qint64 pid : pids) QVERIFY2(!alive(pid), qPrintable(QString::number(pid)));
  }

 private slots:
  void init() {
    m_folder = std::make_unique<QTemporaryDir>();
    m_manager = std::make_unique<QProcess>();
    m_output.clear();
  }
  void cleanup() {
    if (m_manager->state() != QProcess::NotRunning) {
      m_manager->kill();
      m_manager->waitForFinished();
    }
    if (QTest::currentTestFailed()) qInfo("%s", output().constData());
    removeSegment(m_key);
  }

  void startsInOrderAndLeavesNothing_data() {
    QTest::addColumn<QByteArray>("list");
    QTest::addColumn<QStringList>("order");
    QTest::newRow("as listed by the program")
        << QByteArray()
        << QStringList{"localization", "team", "decision", "planning", "communication"};
    QTest::newRow("as the file says") << QByteArray("processes = communication, decision\n")
                                      << QStringList{"communication", "decision"};
  }
  void startsInOrderAndLeavesNothing() {
    QFETCH(QByteArray, list);
    QFETCH(QStringList, order);
    start(list + "start_interval = 0.05\n");
    QTRY_VERIFY(!pidsOf(order.last()).empty());
    qsizetype last = -1;
    for (const QString& name : order) {
      const qsizetype at = output().indexOf((name + " started").toUtf8());
      QVERIFY(at > last);
      last = at;
    }
    QCOMPARE(output().count(" started, process "), order.size());
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOnly);
    QVERIFY(board);
    QTRY_COMPARE(board->read(m_variables.decisionWorking), 1);
    endsWithoutRemains();
    *board = Blackboard::onHeap();  // detached
    QVERIFY(!SystemVSegments::info(m_key));
  }

  void aBlackboardThatWasThereStays() {
    QVERIFY(SystemVSegments::create(m_key));
    start("processes = decision\n");
    QTRY_VERIFY(!pidsOf("decision").empty());
    endsWithoutRemains(SIGINT);
    QVERIFY(SystemVSegments::info(m_key));
  }

  void aKilledProcessStartsAgain() {
    start("start_interval = 0.05\nrestart_wait = 0.05\n");
    QTRY_VERIFY(!pidsOf("communication").empty());
    ::kill(static_cast<pid_t>(pidsOf("decision").front()), SIGKILL);
    QTRY_COMPARE(pidsOf("decision").size(), std::size_t{2});
    QVERIFY(reported("decision ended: killed by signal 9"));
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOnly);
    board->write(m_variables.decisionWorking, 0);
    QTRY_COMPARE(board->read(m_variables.decisionWorking), 1);
    for (const char* other : {"localization", "team", "planning", "communication"}) {
      QCOMPARE(pidsOf(other).size(), std::size_t{1});
    }
    endsWithoutRemains();
  }

  void waitsLongerEveryTime() {
    start("processes = own\nrestart_wait = 0.1\nlongest_wait = 0.4\ncommand.own = false\n");
    QTRY_VERIFY(pidsOf("own").size() >= 5);
    QVERIFY(reported("own ended: exit code 1; restarting in 0.1 s"));
    QVERIFY(reported("restarting in 0.2 s"));
    QVERIFY(reported("restarting in 0.4 s"));
    QVERIFY(!reported("restarting in 0.8 s"));
    endsWithoutRemains();
  }

  void aFrozenProcessStartsAgain_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QByteArray>("list");
    const QByteArray all = "localization, team, decision, communication";
    QTest::newRow("by its flag") << "decision" << all;
    QTest::newRow("by its flag, which nobody else clears")
        << "localization" << QByteArray("localization");
    QTest::newRow("without a flag") << "team" << all;
    QTest::newRow("who clears the flags") << "communication" << all;
  }
  void aFrozenProcessStartsAgain() {
    QFETCH(QString, name);
    QFETCH(QByteArray, list);
    start("processes = " + list +
          "\nstart_interval = 0.05\nresponse_timeout = 2.5\nrestart_wait = 0.05\n");
    QTRY_VERIFY(!pidsOf(name).empty());
    ::kill(static_cast<pid_t>(pidsOf(name).front()), SIGSTOP);
    QElapsedTimer timer;
    timer.start();
    QTRY_COMPARE_WITH_TIMEOUT(pidsOf(name).size(), std::size_t{2}, 30'000);
    QVERIFY(timer.elapsed() > 1000);
    QVERIFY(reported(qPrintable(name + " showed no sign of life for 2.5 s and was ended")));
    QVERIFY(!alive(pidsOf(name).front()));
    QCOMPARE(output().count("no sign of life"), qsizetype{1});  // the others are not blamed
    endsWithoutRemains();
  }

  void aTeamProgram() {
    start(
        "processes = decision own\n"
        "command.own = sh -c \"echo robot {robot} key {key}; exec sleep 600\"\n");
    QTRY_VERIFY(reported(("own: robot 3 key " + QByteArray::number(m_key)).constData()));
    endsWithoutRemains();
  }

  // A receiver may wait for its next packet for as long as it wants. The key is that of version
  // 0.8.
  void aReceiverThatBlocksLives() {
    start(
        "processes = own, decision\nsilent_after = 0.5\nstart_interval = 0.05\n"
        "command.own = python3 -c \"import socket; s = socket.socket(socket.AF_INET, "
        "socket.SOCK_DGRAM); s.bind(('127.0.0.1', 0)); s.recv(1)\"\n");
    QTRY_VERIFY(!pidsOf("decision").empty());
    QElapsedTimer timer;
    timer.start();
    while (timer.elapsed() < 2500) {
      QTest::qWait(50);
      QVERIFY2(!reported("own showed"), output().constData());
    }
    QCOMPARE(pidsOf("own").size(), std::size_t{1});
    endsWithoutRemains();
  }

  void childrenEndWithAManagerThatIsKilled() {
    start("start_interval = 0.05\n");
    QTRY_VERIFY(!pidsOf("communication").empty());
    const auto decision = pidsOf("decision"), communication = pidsOf("communication");
    m_manager->kill();
    QVERIFY(m_manager->waitForFinished());
    QTRY_VERIFY(!alive(decision.front()) && !alive(communication.front()));
  }

  void refusals_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QByteArray>("message");
    const auto row = [](const char* name, const char* text, const char* message) {
      QTest::newRow(name) << QByteArray("[Communication]\nno_player_robofei = 3\n") + text
                          << QByteArray(message);
    };
    row("unknown process", "[Pitchboard Management]\nprocesses = decision, cook\n",
        "robot.ini, line 4: there is no reference process 'cook'");
    row("twice", "[Pitchboard Management]\nprocesses = team team\n",
        "line 4: 'team' is listed twice");
    row("nothing to start", "[Pitchboard Management]\nprocesses =\n",
        "line 4: processes must name");
    row("time", "[Pitchboard Management]\n\nresponse_timeout = soon\n",
        "line 5: response_timeout must be a number of seconds");
    row("negative time", "[Pitchboard Management]\nrestart_wait = -1\n",
        "line 4: restart_wait must be");
    row("unknown key", "[Pitchboard Management]\nresponse_timeot = 3\n",
        "did you mean \"response_timeout\"");
    row("no program", "[Pitchboard Management]\ncommand.own =\n", "line 4: command.own must name");
    row("no such program",
        "[Pitchboard Management]\nprocesses = own\ncommand.own = /no/such/thing\n",
        "cannot start '/no/such/thing'");
    row("not a line", "[Pitchboard Management]\nquickly\n",
        "line 4: 'quickly' does not have the form");
    row("option", "[Pitchboard]\nbehavior = keeper\n", "line 4: there is no option 'behavior'");
    row("behaviour", "[Pitchboard]\nbehaviour = clever\n",
        "line 4: --behaviour: there is no behaviour \"clever\"");
    row("shirt", "[Pitchboard]\nreferee_team = 5\nshirt = 99\n", "robot.ini, line 5: ");
    row("address", "[Pitchboard]\nudp_address = home\n",
        "line 4: --udp-address: \"home\": Not an IPv4");
    row("field", "[Pitchboard]\nfield = {\"length\": -9}\n", "line 4: --field: ");
    row("number", "[Pitchboard]\nparticles = many\n", "robot.ini, line 4: ");
  }
  void refusals() {
    QFETCH(QByteArray, text);
    QFETCH(QByteArray, message);
    const ProgramRun run = runProgram("pitchboard-robot", {"management", "--config", config(text),
                                                           "--key-base", QString::number(m_base)});
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.startsWith("error: ") && run.err.contains(message), run.err.constData());
    QVERIFY(!SystemVSegments::info(m_key));
  }

  void words() {
    using Words = std::vector<std::string>;
    QCOMPARE(splitCommand("  a  b\t\"c d\"e \"\" "), (Words{"a", "b", "c de", ""}));
    QCOMPARE(splitCommand(""), Words{});
  }
};

PITCHBOARD_TEST(TestManagement)

}  // namespace tst_management

#include "tst_management.moc"

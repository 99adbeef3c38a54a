// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded GameController packets of every version, sent over UDP, reach COM_REFEREE; penalised
// robots stand.
#include <QElapsedTimer>
#include <QProcess>
#include <QtTest>
#include <csignal>

#include <base/game.h>
#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <telemetry/referee/gamecontroller.h>

#include "../support/segment_keys.h"
#include "../support/test_socket.h"

namespace tst_referee_obeyed {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

const QString recordings = QString(PITCHBOARD_TEST_DATA) + "/gamecontroller/";

QByteArray packet(const QString& name) {
  QFile file(recordings + name + ".bin");
  if (!file.open(QIODevice::ReadOnly)) qFatal("no recorded packet %s", qPrintable(name));
  return file.readAll();
}

QJsonObject expected(const QString& name) {
  QFile file(recordings + name + ".json");
  if (!file.open(QIODevice::ReadOnly)) qFatal("no description of %s", qPrintable(name));
  return QJsonDocument::fromJson(file.readAll())["expected"].toObject();
}

// While a kick-off or a set play of one team goes on: the others keep away from the ball.
int codeInPlay(const QString& name, const QJsonObject& state, int team) {
  const bool hasBall = state["kickOffTeamNumber"].toInt() == team;
  const int secondary = state["secGameState"].toInt();
  if (secondary >= 4 && secondary <= 9) {
    const QByteArray info = QByteArray::fromHex(state["secGameStateInfoHex"].toString().toLatin1());
    const bool frozen = state["size"].toInt() == 688 ? info[1] == 0 : info[1] == 1;
    if (frozen) return 1;
    return info[0] == team ? 2 : 11;
  }
  const bool ofStandardPlatform = name.contains("spl"), ofHumanoids = name.contains("hl");
  if (!ofStandardPlatform && !ofHumanoids && state["setPlay"].toInt() != 0) return hasBall ? 2 : 11;
  const bool kickOff = !ofStandardPlatform && state["secondaryTime"].toInt() > 0 &&
                       state.contains("kickOffTeamNumber") && secondary != 1 &&
                       state["gamePhase"].toInt() != 1;  // not in a shoot-out
  return kickOff && !hasBall ? 12 : 2;
}

// What the rules say of a robot without a penalty, from the recording's description.
int wordOf(const QString& name, const QJsonObject& state, int team) {
  if (state["secGameState"].toInt() == 3 || state["gamePhase"].toInt() == 3) return 1;  // timeout
  if (state["stopped"].toInt() != 0) return 1;
  switch (state["state"].toInt()) {
    case 1:
      return 11;
    case 2:
      return 12;
    case 3:
      return codeInPlay(name, state, team);
    default:
      return 1;
  }
}

}  // namespace

class TestRefereeObeyed : public QObject {
  Q_OBJECT

  const int m_base = testKeyBase();
  const RobotVariables m_variables;
  const TestSocket m_controller;

  /// Sends until the process has written `word`.
  void receives(const QByteArray& datagram, int team, int shirt, int word) {
    ProcessOptions options;
    options.telemetryPortBase = 60000;
    options.refereePort = TestSocket(INADDR_ANY).port();
    options.refereeTeam = team;
    options.shirt = shirt;
    auto process = findProcess("communication")->make(options);
    QVERIFY2(process, process ? "" : process.error().text().c_str());
    Blackboard board = Blackboard::onHeap();
    board.write(m_variables.comReferee, 77);
    const auto cycle = [&] {
      m_controller.send(static_cast<std::uint16_t>(options.refereePort), datagram.toStdString());
      (*process)->step(board, {0.0});
      return board.read(m_variables.comReferee);
    };
    QTRY_VERIFY(cycle() != 77);
    QCOMPARE(board.read(m_variables.comReferee), word);
  }

 private slots:
  void cleanup() {
    for (const int n : {1, 2}) removeSegment(m_base + 100 * n);
  }

  void everyVersion_data() {
    QTest::addColumn<QString>("name");
    const QStringList files = QDir(recordings).entryList({"*.bin"}, QDir::Files, QDir::Name);
    QVERIFY(files.size() > 100);
    for (const QString& file : files) {
      const QString name = file.chopped(4);
      if (expected(name)["header"].toString() == "RGTD") continue;  // not for robots
      QTest::newRow(qPrintable(name)) << name;
    }
  }
  void everyVersion() {
    QFETCH(QString, name);
    const QJsonObject state = expected(name);
    int free = 0, penalised = 0;
    for (const QJsonValue& team : state["teams"].toArray()) {
      for (const QJsonValue& player : team["players"].toArray()) {
        const bool stands = player["penalty"].toInt() != 0;
        int& done = stands ? penalised : free;
        if (done++ > 0) continue;  // one of each kind is enough
        receives(packet(name), team["number"].toInt(), player["n"].toInt(),
                 stands ? 1 : wordOf(name, state, team["number"].toInt()));
      }
    }
    QVERIFY(free + penalised > 0);
  }

  void aPenalisedRobotStopsBeforeItsNextTelemetry() {
    const QString playing = "v11hl592_PLAYING", penalised = "v11hl592_PENALISED";
    int team = 0, shirt = 0;
    for (const QJsonValue& t : expected(penalised)["teams"].toArray()) {
      for (const QJsonValue& p : t["players"].toArray()) {
        const int penalty = p["penalty"].toInt();
        if (shirt == 0 && penalty != 0 && penalty != 14) {
          team = t["number"].toInt();
          shirt = p["n"].toInt();
        }
      }
    }
    QVERIFY(shirt > 0);
    const std::uint16_t port = TestSocket(INADDR_ANY).port();
    QFile config;
    QTemporaryDir folder;
    config.setFileName(folder.filePath("robot.ini"));
    QVERIFY(config.open(QIODevice::WriteOnly));
    config.write("[Communication]\nno_player_robofei = 1\n[Pitchboard]\nreferee_team = " +
                 QByteArray::number(team) + "\nshirt = " + QByteArray::number(shirt) +
                 "\nreferee_port = " + QByteArray::number(port) + "\ntelemetry_rate = 0.1\n");
    config.close();
    QProcess communication, decision;
    const QStringList common{"--config",
                             config.fileName(),
                             "--key-base",
                             QString::number(m_base),
                             "--telemetry-port-base",
                             "60000",
                             "--team-port-base",
                             "60100"};
    communication.start(PITCHBOARD_BIN "/pitchboard-robot", QStringList{"communication"} + common);
    decision.start(PITCHBOARD_BIN "/pitchboard-robot",
                   QStringList{"decision", "--behaviour", "naive"} + common);
    QTRY_VERIFY(communication.canReadLine() && decision.canReadLine());
    auto board = SystemVSegments::open(m_base + 100, AttachMode::AttachOnly);
    QVERIFY(board);
    board->write(m_variables.visionLost, 1);
    const auto sees = [&](const QString& name, int word) {
      m_controller.send(port, packet(name).toStdString());
      return board->read(m_variables.comReferee) == word;
    };
    QTRY_VERIFY(sees(playing, 2));
    QTRY_COMPARE(board->read(m_variables.decisionActionA), 3);  // it plays: turns to find the ball
    QElapsedTimer timer;
    timer.start();
    m_controller.send(port, packet(penalised).toStdString());
    QTRY_COMPARE(board->read(m_variables.comReferee), 1);
    const qint64 received = timer.elapsed();
    qInfo("the referee's word was on the blackboard after %lld ms", received);
    QTRY_COMPARE(board->read(m_variables.decisionActionA), 0);
    communication.kill();
    decision.kill();
    QVERIFY(communication.waitForFinished() && decision.waitForFinished());
  }

  // Only where the decision is ours: a team's own map may have something else on these words.
  void aSetPlayIsReportedToOurDecision_data() {
    QTest::addColumn<QByteArray>("decision");
    QTest::addColumn<bool>("reported");
    QTest::newRow("ours") << QByteArray() << true;
    QTest::newRow("a team's") << QByteArray("command.decision = /bin/sleep 600\n") << false;
  }
  void aSetPlayIsReportedToOurDecision() {
    QFETCH(QByteArray, decision);
    QFETCH(bool, reported);
    const QString corner = "v12hl688_CORNER_KICK";
    const auto packetRead = telemetry::decodeReferee(packet(corner).toStdString()).value();
    const auto& state = std::get<telemetry::RefereeState>(packetRead);
    const int takers = (*state.secStateInfo)[0];
    const std::uint16_t port = TestSocket(INADDR_ANY).port();
    const QTemporaryDir folder;
    QFile config(folder.filePath("robot.ini"));
    QVERIFY(config.open(QIODevice::WriteOnly));
    config.write("[Communication]\nno_player_robofei = 1\n[Pitchboard]\nreferee_team = " +
                 QByteArray::number(takers) + "\nreferee_port = " + QByteArray::number(port) +
                 "\nbehaviour = idle\ntelemetry_port_base = 60000\nteam_port_base = 60100\n"
                 "[Pitchboard Management]\nprocesses = decision communication\n" +
                 decision);
    config.close();
    QProcess management;
    management.start(
        PITCHBOARD_BIN "/pitchboard-robot",
        {"management", "--config", config.fileName(), "--key-base", QString::number(m_base)});
    std::optional<Blackboard> board;
    const auto isThere = [&] {
      auto opened = SystemVSegments::open(m_base + 100, AttachMode::AttachOnly);
      if (opened) board = std::move(*opened);
      return board.has_value();
    };
    QTRY_VERIFY(isThere());
    const VariableCatalog& map = VariableCatalog::extended();
    const IntVar kind = *map.intVar("COM_SET_PLAY"), ours = *map.intVar("COM_SET_PLAY_OURS");
    board->write(kind, 77);
    const auto hasReceived = [&] {
      m_controller.send(port, packet(corner).toStdString());
      return board->read(m_variables.comReferee) != 0;
    };
    QTRY_VERIFY(hasReceived());
    QTRY_COMPARE(board->read(kind), reported ? static_cast<int>(SetPlay::CornerKick) : 77);
    QCOMPARE(board->read(ours), reported ? 1 : 0);
    management.terminate();
    QVERIFY(management.waitForFinished());
  }

  void robotsOfOneComputerShareThePort() {
    const std::uint16_t port = TestSocket(INADDR_ANY).port();
    const int team = expected("v12hl688_READY")["teams"][0]["number"].toInt();
    std::vector<std::unique_ptr<QProcess>> processes;
    std::vector<Blackboard> boards;
    for (const int n : {1, 2}) {
      auto& process = processes.emplace_back(std::make_unique<QProcess>());
      process->start(
          PITCHBOARD_BIN "/pitchboard-robot",
          {"communication", "--robot", QString::number(n), "--key-base", QString::number(m_base),
           "--telemetry-port-base", "60000", "--team-port-base", "60100", "--referee-team",
           QString::number(team), "--referee-port", QString::number(port)});
      QTRY_VERIFY(process->canReadLine());
      auto board = SystemVSegments::open(m_base + 100 * n, AttachMode::AttachOnly);
      QVERIFY(board);
      boards.push_back(std::move(*board));
    }
    constexpr std::uint32_t loopbackBroadcast = 0x7fffffff;  // 127.255.255.255
    const auto bothReady = [&] {
      m_controller.send(port, packet("v12hl688_READY").toStdString(), loopbackBroadcast);
      return boards[0].read(m_variables.comReferee) == 11 &&
             boards[1].read(m_variables.comReferee) == 11;
    };
    QTRY_VERIFY(bothReady());
    for (auto& process : processes) {
      process->kill();
      QVERIFY(process->waitForFinished());
    }
  }

  void refusals_data() {
    QTest::addColumn<int>("team");
    QTest::addColumn<int>("robot");
    QTest::addColumn<int>("port");
    QTest::addColumn<QString>("reason");
    QTest::newRow("team") << 300 << 1 << 3838 << "0 to 255";
    QTest::newRow("shirt") << 5 << 21 << 3838 << "1 to 20, not 21; give --shirt";
    QTest::newRow("port") << 5 << 1 << 70000 << "70000";
  }
  void refusals() {
    QFETCH(int, team);
    QFETCH(int, robot);
    QFETCH(int, port);
    QFETCH(QString, reason);
    ProcessOptions options;
    options.robot = {robot};
    options.refereeTeam = team;
    options.refereePort = port;
    const auto process = findProcess("communication")->make(options);
    QVERIFY(!process);
    QVERIFY2(QString::fromStdString(process.error().text()).contains(reason),
             process.error().text().c_str());
  }
};

PITCHBOARD_TEST(TestRefereeObeyed)

}  // namespace tst_referee_obeyed

#include "tst_referee_obeyed.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>
#include <limits>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/process_registry.h>

#include "../support/test_socket.h"

namespace tst_communication {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

class Receiver : public TestSocket {
 public:
  explicit Receiver(int port = 0) : TestSocket(INADDR_LOOPBACK, port) {}
  QByteArray take() const { return QByteArray::fromStdString(TestSocket::take()); }
};

// Four neighbouring ports.
std::vector<std::unique_ptr<Receiver>> team() {
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::vector<std::unique_ptr<Receiver>> receivers;
    receivers.push_back(std::make_unique<Receiver>());
    const int first = receivers.front()->port();
    for (int n = 1; n < 4; ++n) receivers.push_back(std::make_unique<Receiver>(first + n));
    if (std::all_of(receivers.begin(), receivers.end(),
                    [](const auto& receiver) { return receiver->good(); })) {
      return receivers;
    }
  }
  return {};
}

}  // namespace

class TestCommunication : public QObject {
  Q_OBJECT

  RobotVariables m_variables;
  const IntVar m_request = *VariableCatalog::published().intVar("CONTROL_MESSAGES");

  static std::unique_ptr<CognitiveProcess> make(const ProcessOptions& options) {
    auto process = findProcess("communication")->make(options);
    return process ? std::move(*process) : nullptr;
  }
  static std::string refusal(const ProcessOptions& options) {
    const auto process = findProcess("communication")->make(options);
    return process ? "" : process.error().text();
  }

 private slots:
  void telemetryByteForByte() {
    Receiver telemetry;
    const auto ports = team();
    QVERIFY(!ports.empty());
    ProcessOptions options;
    options.robot = {3};
    options.telemetryPortBase = telemetry.port() - 3;
    options.teamPortBase = ports.front()->port() - 1;
    const auto process = make(options);
    QVERIFY(process);

    Blackboard board = Blackboard::onHeap();
    const RobotVariables& v = m_variables;
    board.write(v.visionLost, 1);
    board.write(v.localizationX, 258);
    board.write(v.localizationY, 448);
    board.write(v.localizationTheta, -8);
    board.write(v.localizationBelief, 56.3184547424F);
    board.write(v.visionBallDist, 184.634048462F);
    board.write(v.visionPanDeg, 41.0279350281F);
    board.write(v.visionBallAngle, 99.0F);  // is not what is sent
    board.write(v.decisionActionA, 8);
    board.write(v.imuEulerZ, 0.0578468590975F);
    board.write(v.voltage, 189);
    const std::array flags{v.controlWorking, v.visionWorking, v.localizationWorking,
                           v.decisionWorking, v.imuWorking};
    for (std::size_t i = 0; i < flags.size(); ++i) board.write(flags[i], i % 2 == 0 ? 1 : 0);

    process->step(board, {0.0});
    QCOMPARE(telemetry.take(), QByteArray("3 258 448 -8 56.3184547424 184.634048462 41.0279350281 "
                                          "1 0 1 0 1 8 0.0578468590975 189 OUT"));
    QCOMPARE(telemetry.take(), QByteArray());
    QCOMPARE(board.read(v.robotNumber), 3);
    for (const IntVar flag : flags) QCOMPARE(board.read(flag), 0);

    board.write(v.decisionWorking, 1);
    board.write(v.imuEulerZ, std::numeric_limits<float>::quiet_NaN());
    process->step(board, {1.0});
    QCOMPARE(telemetry.take(), QByteArray("3 258 448 -8 56.3184547424 184.634048462 41.0279350281 "
                                          "0 0 0 1 0 8 nan 189 OUT"));
    QVERIFY(process->period() <= 0.1);  // the referee is received between two telemetry datagrams
  }

  void eachFlagHasItsPlace() {
    Receiver telemetry;
    ProcessOptions options;
    options.telemetryPortBase = telemetry.port() - 1;
    const auto process = make(options);
    QVERIFY(process);
    const RobotVariables& v = m_variables;
    const std::array flags{v.controlWorking, v.visionWorking, v.localizationWorking,
                           v.decisionWorking, v.imuWorking};
    for (int i = 0; i < 5; ++i) {
      Blackboard board = Blackboard::onHeap();
      board.write(v.visionLost, 1);
      board.write(flags[static_cast<std::size_t>(i)], 1);
      process->step(board, {1.0 * i});
      const QList<QByteArray> fields = telemetry.take().split(' ');
      QCOMPARE(fields.size(), 16);
      for (int k = 0; k < 5; ++k) QCOMPARE(fields[7 + k], QByteArray(k == i ? "1" : "0"));
    }
  }

  void theRateCanBeChosen_data() {
    QTest::addColumn<double>("period");
    QTest::newRow("published") << 1.0;
    QTest::newRow("five a second") << 0.2;
    QTest::newRow("seldom") << 4.0;
  }
  void theRateCanBeChosen() {
    QFETCH(double, period);
    Receiver telemetry;
    ProcessOptions options;
    options.telemetryPortBase = telemetry.port() - 1;
    options.telemetryPeriod = period;
    const auto process = make(options);
    QVERIFY(process);
    Blackboard board = Blackboard::onHeap();
    board.write(m_variables.visionLost, 1);
    int datagrams = 0;
    const auto play = [&](double from, double to) {
      for (int i = 0; from + i * process->period() < to; ++i) {
        process->step(board, {from + i * process->period()});
        while (!telemetry.take().isEmpty()) ++datagrams;
      }
    };
    play(0.0, 8.0 - 1e-9);
    QCOMPARE(datagrams, static_cast<int>(8.0 / period));
    play(100.0, 100.04);  // the computer slept: what was missed is not made up for
    QCOMPARE(datagrams, static_cast<int>(8.0 / period) + 1);
  }

  void teamMessages_data() {
    QTest::addColumn<int>("robot");
    QTest::addColumn<int>("lost");
    QTest::addColumn<int>("request");
    QTest::addColumn<QByteArray>("message");
    QTest::newRow("ball in view") << 2 << 0 << 0 << QByteArray("2 2 150.25");
    QTest::newRow("ball lost") << 2 << 1 << 0 << QByteArray();
    QTest::newRow("asked for") << 2 << 1 << 2 << QByteArray("2 2 77.5");
    QTest::newRow("another request") << 2 << 1 << 1 << QByteArray();
    QTest::newRow("robot without a variable for it") << 12 << 0 << 2 << QByteArray("2 12 150.25");
  }
  void teamMessages() {
    QFETCH(int, robot);
    QFETCH(int, lost);
    QFETCH(int, request);
    QFETCH(QByteArray, message);
    const auto ports = team();
    QVERIFY(!ports.empty());
    Receiver telemetry;
    ProcessOptions options;
    options.robot = {robot};
    options.telemetryPortBase = telemetry.port() - robot;
    options.teamPortBase = ports.front()->port() - 1;
    const auto process = make(options);
    QVERIFY(process);
    Blackboard board = Blackboard::onHeap();
    board.write(m_variables.visionLost, lost);
    board.write(m_variables.visionBallDist, 150.25F);
    board.write(*VariableCatalog::published().floatVar("DECISION_RBT02_DIST_BALL"), 77.5F);
    board.write(m_request, request);
    process->step(board, {});
    for (const auto& port : ports) {
      QCOMPARE(port->take(), message);
      QCOMPARE(port->take(), QByteArray());
    }
    QCOMPARE(board.read(m_request), request == 2 ? 0 : request);
    QVERIFY(telemetry.take().endsWith("OUT"));
  }

  void sendingWithoutAListenerIsNoError() {
    int freePort = 0;
    {
      Receiver gone;
      freePort = gone.port();
    }
    ProcessOptions options;
    options.telemetryPortBase = freePort - 1;
    const auto process = make(options);
    QVERIFY(process);
    Blackboard board = Blackboard::onHeap();
    for (int i = 0; i < 3; ++i) {
      board.write(m_variables.imuWorking, 1);
      process->step(board, {1.0 * i});
      QCOMPARE(board.read(m_variables.imuWorking), 0);
    }
  }

  void refusals_data() {
    QTest::addColumn<QString>("address");
    QTest::addColumn<int>("telemetry");
    QTest::addColumn<int>("teamBase");
    QTest::addColumn<QString>("reason");
    for (const char* address : {"", "localhost", "127.0.0", "256.0.0.1", "::1", "127.0.0.1 x"}) {
      QTest::addRow("address '%s'", address) << QString(address) << 1240 << 1230 << "IPv4 address";
    }
    QTest::newRow("telemetry too high") << "127.0.0.1" << 65535 << 1230 << "1..65535";
    QTest::newRow("telemetry too low") << "127.0.0.1" << -1 << 1230 << "1..65535";
    QTest::newRow("team too high") << "127.0.0.1" << 1240 << 65532 << "1..65535";
    QTest::newRow("team too low") << "127.0.0.1" << 1240 << -1 << "1..65535";
  }
  void refusals() {
    QFETCH(QString, address);
    QFETCH(int, telemetry);
    QFETCH(int, teamBase);
    QFETCH(QString, reason);
    ProcessOptions options;
    options.udpAddress = address.toStdString();
    options.telemetryPortBase = telemetry;
    options.teamPortBase = teamBase;
    const QString text = QString::fromStdString(refusal(options));
    QVERIFY2(text.contains(reason), qPrintable(text));
  }
};

PITCHBOARD_TEST(TestCommunication)

}  // namespace tst_communication

#include "tst_communication.moc"

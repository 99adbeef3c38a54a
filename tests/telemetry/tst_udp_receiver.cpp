// SPDX-License-Identifier: GPL-3.0-or-later
// Real sockets on 127.0.0.1, on ports that the system gives.
#include <QProcess>
#include <QtTest>
#include <atomic>
#include <set>
#include <thread>

#include <telemetry/monitor/monitor_request.h>
#include <telemetry/sockets/udp_receiver.h>
#include <telemetry/sockets/udp_sender.h>

#include "../support/test_socket.h"

namespace tst_udp_receiver {

using namespace pitchboard::telemetry;
using namespace std::chrono_literals;

namespace {

ReceiverOptions freePorts(std::size_t count, std::uint32_t address = INADDR_LOOPBACK) {
  ReceiverOptions options;
  options.bind = {address};
  options.ports.assign(count, 0);
  return options;
}

/// Takes until `count` datagrams have come; fewer when ten seconds pass.
std::vector<std::string> takeAll(UdpReceiver& receiver, std::size_t count) {
  std::vector<std::string> out;
  DatagramBatch batch;
  while (out.size() < count && receiver.take(batch, 10s)) {
    for (std::size_t i = 0; i < batch.size(); ++i) out.emplace_back(batch[i].payload);
  }
  return out;
}

}  // namespace

class TestUdpReceiver : public QObject {
  Q_OBJECT
 private slots:
  void receivesOnEveryPort() {
    auto receiver = UdpReceiver::start(freePorts(17));
    QVERIFY(receiver);
    const ReceiverStatus before = (*receiver)->status();
    const TestSocket socket;
    const auto earliest = std::chrono::system_clock::now();
    for (const PortStatus& port : before.ports) {
      QVERIFY2(port.bound, port.problem.c_str());
      QVERIFY(socket.send(port.port, "to " + std::to_string(port.port)));
    }
    DatagramBatch batch;
    std::set<std::uint16_t> seen;
    while (seen.size() < 17 && (*receiver)->take(batch, 10s)) {
      for (std::size_t i = 0; i < batch.size(); ++i) {
        const DatagramView d = batch[i];
        QCOMPARE(std::string(d.payload), "to " + std::to_string(d.localPort));
        QCOMPARE(d.sender.text(), "127.0.0.1:" + std::to_string(socket.port()));
        QVERIFY(!d.truncated);
        QVERIFY(d.time >= earliest - 1s && d.time <= std::chrono::system_clock::now() + 1s);
        seen.insert(d.localPort);
      }
    }
    QCOMPARE(seen.size(), std::size_t(17));
    QCOMPARE((*receiver)->status().datagrams(), std::uint64_t(17));
    QCOMPARE((*receiver)->status().kernelDrops(), std::uint64_t(0));
  }

  void broadcastAndTwoListeners() {
    // 127.255.255.255 is the broadcast address of the loopback network.
    auto first = UdpReceiver::start(freePorts(1, INADDR_ANY));
    QVERIFY(first);
    ReceiverOptions same = freePorts(1, INADDR_ANY);
    same.ports[0] = (*first)->status().ports[0].port;
    auto second = UdpReceiver::start(same);
    QVERIFY(second);
    QVERIFY2((*second)->status().ports[0].bound, (*second)->status().ports[0].problem.c_str());
    const TestSocket socket;
    if (!socket.send(same.ports[0], "all", 0x7fffffff)) QSKIP("no broadcast on this loopback");
    QCOMPARE(takeAll(**first, 1), std::vector<std::string>{"all"});
    QCOMPARE(takeAll(**second, 1), std::vector<std::string>{"all"});
  }

  /// A second studio took all robots away from the first one, because the kernel hands a unicast
  /// datagram to the socket that was bound last.
  void theFirstProgramKeepsItsDatagrams() {
    ReceiverOptions options = freePorts(1, INADDR_ANY);
    options.yieldsToFirst = true;
    options.retry = 1ms;
    auto first = UdpReceiver::start(options);
    QVERIFY(first);
    options.ports[0] = (*first)->status().ports[0].port;
    auto second = UdpReceiver::start(options);
    QVERIFY(second);
    QVERIFY((*second)->status().ports[0].bound);
    QVERIFY((*second)->status().ports[0].broadcastsOnly);
    QVERIFY(!(*first)->status().ports[0].broadcastsOnly);
    const TestSocket socket;
    QVERIFY(socket.send(options.ports[0], "to this computer"));
    QCOMPARE(takeAll(**first, 1), std::vector<std::string>{"to this computer"});
    if (!socket.send(options.ports[0], "to all", 0x7fffffff))
      QSKIP("no broadcast on this loopback");
    QCOMPARE(takeAll(**first, 1), std::vector<std::string>{"to all"});
    QCOMPARE(takeAll(**second, 1), std::vector<std::string>{"to all"});
    first->reset();
    QTRY_VERIFY(!(*second)->status().ports[0].broadcastsOnly);
    QVERIFY(socket.send(options.ports[0], "now here"));
    QCOMPARE(takeAll(**second, 1), std::vector<std::string>{"now here"});
  }

  void sharedPortsAreNamed() {
    ReceiverStatus status;
    for (const int number : {1241, 1242, 1243, 1341, 3838}) {
      PortStatus& port = status.ports.emplace_back();
      port.port = static_cast<std::uint16_t>(number);
      port.bound = true;
    }
    QCOMPARE(sharedPortsText(status, {}), std::string());
    for (PortStatus& port : status.ports) {
      port.others = "pitchboard (process 7)";
      port.broadcastsOnly = port.othersTakeAll = port.port < 1300;
    }
    const std::string text = sharedPortsText(status, std::uint16_t{3838});
    QVERIFY2(
        text.find("UDP 1241–1243 was first opened by pitchboard (process 7)") != std::string::npos,
        text.c_str());
    QVERIFY2(text.find("UDP 1341 was also opened by pitchboard (process 7)") != std::string::npos,
             text.c_str());
    QVERIFY2(text.find("3838") == std::string::npos, text.c_str());
    QCOMPARE(portRanges({3838, 1242, 1241}), (std::vector<std::string>{"1241–1242", "3838"}));
  }

  /// The bytes are a real robot's; only the address tells.
  void simulatedSendersAreRecognized() {
    auto receiver = UdpReceiver::start(freePorts(1, INADDR_ANY));
    const std::uint16_t port = (*receiver)->status().ports[0].port;
    for (const std::uint32_t to : {0x7f000001U, 0x7fffffffU}) {
      auto sender = UdpSender::simulatedTo({to});
      QVERIFY2(sender, sender ? "" : sender.error().text().c_str());
      if (!sender->send(port, "1 2 3 OUT")) QSKIP("no broadcast on this loopback");
      DatagramBatch batch;
      QVERIFY((*receiver)->take(batch, 10s));
      QVERIFY(isSimulated(batch[0].sender.address));
    }
    QVERIFY(UdpSender::simulatedTo({0xc0a80107}));  // 192.168.1.7: cannot be marked
    const TestSocket robot;
    QVERIFY(robot.send(port, "1 2 3 OUT"));
    DatagramBatch batch;
    QVERIFY((*receiver)->take(batch, 10s));
    QVERIFY(!isSimulated(batch[0].sender.address));
  }

  void aTakenPortIsReportedAndRetried() {
    auto blocker = std::make_unique<TestSocket>();
    ReceiverOptions options = freePorts(2);
    options.ports[0] = blocker->port();
    options.retry = 1ms;
    auto receiver = UdpReceiver::start(options);
    QVERIFY(receiver);
    const ReceiverStatus status = (*receiver)->status();
    QVERIFY(!status.ports[0].bound);
    QVERIFY(
        QByteArray::fromStdString(status.ports[0].problem).contains("another program is using it"));
    QVERIFY(status.ports[1].bound);
    const TestSocket socket;
    QVERIFY(socket.send(status.ports[1].port, "works"));
    QCOMPARE(takeAll(**receiver, 1), std::vector<std::string>{"works"});
    const std::uint16_t port = blocker->port();
    blocker.reset();
    QTRY_VERIFY((*receiver)->status().ports[0].bound);
    QVERIFY((*receiver)->status().ports[0].problem.empty());
    QVERIFY(socket.send(port, "now"));
    QCOMPARE(takeAll(**receiver, 1), std::vector<std::string>{"now"});
  }

  void longAndEmptyDatagramsArriveWhole() {
    auto receiver = UdpReceiver::start(freePorts(1));
    const std::uint16_t port = (*receiver)->status().ports[0].port;
    const TestSocket socket;
    const std::string longest(65507, 'x');
    QVERIFY(socket.send(port, longest));
    QVERIFY(socket.send(port, ""));
    QVERIFY(socket.send(port, "end"));
    QCOMPARE(takeAll(**receiver, 3), (std::vector<std::string>{longest, "", "end"}));
    QCOMPARE((*receiver)->status().ports[0].truncated, std::uint64_t(0));
  }

  void aFullQueueCountsItsDrops() {
    ReceiverOptions options = freePorts(1);
    options.maxDatagrams = 10;
    std::atomic<int> ready = 0;
    auto receiver = UdpReceiver::start(options, [&ready] { ++ready; });
    const std::uint16_t port = (*receiver)->status().ports[0].port;
    const TestSocket socket;
    for (int i = 0; i < 100; ++i) QVERIFY(socket.send(port, std::to_string(i)));
    QTRY_COMPARE((*receiver)->status().ports[0].datagrams, std::uint64_t(100));
    QTRY_COMPARE((*receiver)->status().queueDrops, std::uint64_t(90));
    QCOMPARE(ready.load(), 1);
    DatagramBatch batch;
    QVERIFY((*receiver)->take(batch));
    QCOMPARE(batch.size(), std::size_t(10));
    QCOMPARE(std::string(batch[9].payload), std::string("9"));
    QVERIFY(!(*receiver)->take(batch));
  }

  void stopWakesWhoWaits() {
    auto receiver = UdpReceiver::start(freePorts(3));
    std::thread waiting([&] {
      DatagramBatch batch;
      (*receiver)->take(batch, 60s);
    });
    (*receiver)->stop();
    waiting.join();
    (*receiver)->stop();
  }

  void portsOutOfRange() {
    QCOMPARE(livePorts()->size(), std::size_t(17));
    QCOMPARE(livePorts()->front(), std::uint16_t(1241));
    QCOMPARE(livePorts()->back(), std::uint16_t(3838));
    QVERIFY(!livePorts(65530));
    QVERIFY(!livePorts(-1));
    QVERIFY(!livePorts(1240, 16, 1250));
    QVERIFY(!livePorts(1240, 16, 70000));
    QVERIFY(parseAddress("255.255.255.255"));
    for (const char* bad : {"", "1.2.3", "256.1.1.1", "localhost", "::1"})
      QVERIFY2(!parseAddress(bad), bad);
  }

  void receivingSendsNothing() {
    auto receiver = UdpReceiver::start(freePorts(17));
    const TestSocket robot, referee;
    const auto ports = (*receiver)->status().ports;
    for (const PortStatus& port : ports) {
      QVERIFY(robot.send(port.port, "1 2 3 OUT"));
      QVERIFY(referee.send(port.port, "RGme"));
    }
    QCOMPARE(takeAll(**receiver, 34).size(), std::size_t(34));
    receiver->reset();
    QVERIFY(!robot.received());
    QVERIFY(!referee.received());
  }

  /// What cannot be called cannot happen by mistake: of the objects of these modules only the
  /// sender knows a function of the system that sends, and only the monitor request knows the
  /// sender.
  void onlyTheMonitorRequestCanSend() {
    QProcess nm;
    nm.start("nm", QStringList{"-u", "-A", "-C"} +
                       QStringLiteral(PITCHBOARD_TELEMETRY_LIBRARIES).split('|'));
    if (!nm.waitForStarted()) QSKIP("nm is not installed");
    QVERIFY(nm.waitForFinished());
    static const QRegularExpression sends(R"(\b(send|sendto|sendmsg|sendmmsg|connect)(@.*)?$)");
    QStringList senders, users;
    const QStringList lines = QString::fromUtf8(nm.readAllStandardOutput()).split('\n');
    QVERIFY(lines.size() > 50);
    for (const QString& line : lines) {
      if (sends.match(line.trimmed()).hasMatch()) senders << line;
      if (line.contains("UdpSender::send(")) users << line;
    }
    QCOMPARE(senders.size(), 1);
    QVERIFY2(senders[0].contains("udp_sender.cpp"), qPrintable(senders[0]));
    QCOMPARE(users.size(), 1);
    QVERIFY2(users[0].contains("monitor_request.cpp"), qPrintable(users[0]));
  }

  void whatCannotBeSentIsCounted() {
    TestSocket receiver;
    auto sender = UdpSender::to({INADDR_LOOPBACK});
    QVERIFY(sender);
    QVERIFY(sender->send(receiver.port(), "small"));
    QCOMPARE(sender->errors(), std::uint64_t{0});
    QVERIFY(!sender->send(receiver.port(), std::string(70'000, 'x')));  // no datagram is so long
    QVERIFY(!sender->send(receiver.port(), std::string(70'000, 'x')));
    QCOMPARE(sender->errors(), std::uint64_t{2});
    QCOMPARE(receiver.take(), std::string("small"));
    QCOMPARE(receiver.take(), std::string());

    auto unreachable =
        UdpSender::to({0xf0000001});  // 240.0.0.1, reserved: no computer has a way to it
    QVERIFY(unreachable);
    if (!unreachable->send(1241, "x")) QCOMPARE(unreachable->errors(), std::uint64_t{1});
  }

  void theMonitorRequestIsWhatIsDocumented() {
    const TestSocket referee;
    QVERIFY(sendMonitorRequest({INADDR_LOOPBACK}, referee.port()));
    char bytes[64];
    QCOMPARE(recv(referee.descriptor(), bytes, sizeof bytes, 0), ssize_t(5));
    QCOMPARE(QByteArray(bytes, 5), QByteArray("RGTr\0", 5));
    QVERIFY(!referee.received());
  }
};

PITCHBOARD_TEST(TestUdpReceiver)

}  // namespace tst_udp_receiver

#include "tst_udp_receiver.moc"

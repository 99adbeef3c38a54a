// SPDX-License-Identifier: GPL-3.0-or-later
// The rule of the league: Live sends nothing to robots. Every function of the C library that sends
// is replaced by one that counts, in this whole program, Qt included; the studio is then used in
// Live.
#include <dlfcn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <QSettings>
#include <QTemporaryDir>
#include <QtTest>
#include <atomic>
#include <mutex>

#include <ui/explore/explorer.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/window/main_window.h>

#include "live_rig.h"
#include "studio_rig.h"

namespace {

struct Sent {
  std::string bytes;
  sockaddr_in to{};
};
std::mutex sentMutex;
std::vector<Sent> sentPackets;

bool isInternet(int descriptor) {
  int domain = 0;
  socklen_t length = sizeof domain;
  return getsockopt(descriptor, SOL_SOCKET, SO_DOMAIN, &domain, &length) == 0 &&
         (domain == AF_INET || domain == AF_INET6);
}

void note(int descriptor, const void* bytes, std::size_t length, const sockaddr* to) {
  if (!isInternet(descriptor)) return;
  Sent sent{std::string(static_cast<const char*>(bytes), length), {}};
  if (to != nullptr) sent.to = *reinterpret_cast<const sockaddr_in*>(to);
  const std::lock_guard lock(sentMutex);
  sentPackets.push_back(std::move(sent));
}

std::vector<Sent> takeSent() {
  const std::lock_guard lock(sentMutex);
  return std::exchange(sentPackets, {});
}

}  // namespace

// System calls are made directly: what these call could be replaced as well.
extern "C" {
ssize_t sendto(int fd, const void* data, size_t size, int flags, const sockaddr* to,
               socklen_t length) {
  note(fd, data, size, to);
  return syscall(SYS_sendto, fd, data, size, flags, to, length);
}
ssize_t send(int fd, const void* data, size_t size, int flags) {
  note(fd, data, size, nullptr);
  return syscall(SYS_sendto, fd, data, size, flags, nullptr, 0);
}
ssize_t sendmsg(int fd, const msghdr* message, int flags) {
  note(fd, "", 0, static_cast<const sockaddr*>(message->msg_name));
  return syscall(SYS_sendmsg, fd, message, flags);
}
int sendmmsg(int fd, mmsghdr* messages, unsigned int count, int flags) {
  note(fd, "", 0, nullptr);
  return static_cast<int>(syscall(SYS_sendmmsg, fd, messages, count, flags));
}
ssize_t write(int fd, const void* data, size_t size) {
  note(fd, data, size, nullptr);
  return syscall(SYS_write, fd, data, size);
}
ssize_t writev(int fd, const iovec* parts, int count) {
  note(fd, "", 0, nullptr);
  return syscall(SYS_writev, fd, parts, count);
}
}

using namespace pitchboard;
using namespace pitchboard::ui;

class TestLiveSendsNothing : public QObject {
  Q_OBJECT

  struct Studio : studio_rig::Studio {
    link::LiveOptions options = live_rig::options();
    Studio() {
      window.live()->setOptions(options);
      window.showSource(SourceKind::Live);
    }
  };
  /// Sends past the counting functions.
  static bool tell(int port, const std::string& text) {
    const TestSocket socket;
    const sockaddr_in to = TestSocket::at(INADDR_LOOPBACK, static_cast<std::uint16_t>(port));
    const long sent =
        syscall(SYS_sendto, socket.descriptor(), text.data(), text.size(), 0, &to, sizeof to);
    return sent == static_cast<long>(text.size());
  }

 private slots:
  void theCountersSeeWhatIsSent() {
    takeSent();
    const TestSocket socket;
    QVERIFY(socket.send(socket.port(), "x"));
    QCOMPARE(takeSent().size(), std::size_t(1));
  }

  void liveSendsNothing() {
    takeSent();
    {
      Studio s;
      LiveController* live = s.window.live();
      QTRY_VERIFY(live->frame() && !live->details().network.ports.empty());
      for (int n = 1; n <= 6; ++n) {
        QVERIFY(tell(s.options.portBase + n, telemetry::encode(live_rig::message(n))));
        QVERIFY(tell(s.options.portBase + n, "nonsense"));
      }
      for (const char* file : {"v12hl688_PLAYING_1-0.bin", "v18spl118_READY.bin",
                               "v20hsl158_PLAYING_RGTD_truedata.bin"}) {
        const std::string bytes = live_rig::packet(QLatin1String(file));
        QVERIFY(!bytes.empty() && tell(s.options.refereePort, bytes));
      }
      QTRY_COMPARE(live->frame()->robots.size(), std::size_t(6));
      QTRY_VERIFY(live->frame()->game);
      live->setOurTeam(live->frame()->game->teamAt(false).number);
      for (QAction* action : s.window.findChildren<QAction*>()) {
        if (action->text().contains(QStringLiteral("Overlay"))) action->trigger();
      }
      auto* explorer = s.window.findChild<Explorer*>();
      explorer->start();
      QTRY_VERIFY_WITH_TIMEOUT(explorer->found() && explorer->found()->result.rollouts > 0, 60'000);
      s.window.grab();
      live->clear();
      s.window.showSource(SourceKind::Simulate);
      s.window.showSource(SourceKind::Live);
      QTRY_VERIFY(live->frame());
    }
    const std::vector<Sent> sent = takeSent();
    QVERIFY2(sent.empty(), sent.empty() ? "" : sent.front().bytes.c_str());
  }

  void monitorModeSendsOnePacketToTheReferee() {
    takeSent();
    TestSocket referee;
    Studio s;
    s.options.monitor = telemetry::Address{INADDR_LOOPBACK};
    s.options.monitorPort = referee.port();
    s.window.live()->setOptions(s.options);
    QTRY_VERIFY(referee.received());
    s.window.live()->setMonitor({});
    s.options.monitor.reset();
    QTRY_VERIFY(s.window.live()->details().network.ports.size() == 17);
    const std::vector<Sent> sent = takeSent();
    QVERIFY(!sent.empty());
    for (const Sent& packet : sent) {
      QCOMPARE(packet.bytes, std::string("RGTr\0", 5));
      QCOMPARE(packet.to.sin_addr.s_addr, htonl(INADDR_LOOPBACK));
      QCOMPARE(ntohs(packet.to.sin_port), referee.port());
    }
    // Off is off: the watch goes on for longer than there is between two requests.
    const LiveController* live = s.window.live();
    QTRY_VERIFY(live->frame());
    const double off = live->frame()->snapshot.time;
    QTRY_VERIFY(live->frame()->snapshot.time > off + 1.2);
    QVERIFY(takeSent().empty());
  }
};

QTEST_MAIN(TestLiveSendsNothing)
#include "tst_live_sends_nothing.moc"

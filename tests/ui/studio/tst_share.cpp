// SPDX-License-Identifier: GPL-3.0-or-later
// File > Share on the network: a client sees the match, then the recording that replaces it, and
// plays that.

#include <QCheckBox>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSpinBox>
#include <QTcpServer>
#include <QTcpSocket>
#include <QtTest>
#include <bit>
#include <map>
#include <optional>

#include <telemetry/foxglove/foxglove_client.h>
#include <ui/base/in_place_message.h>
#include <ui/share/network_share.h>
#include <ui/share/share_dialog.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/replay_controller.h>

#include "live_rig.h"
#include "session_rig.h"

namespace tst_share {

using namespace pitchboard;
using namespace pitchboard::ui;
using session_rig::Studio;
using telemetry::FoxgloveClient;

namespace {

/// What a client of the share sees of some topics.
class Client {
 public:
  explicit Client(int port)
      : m_client(
            telemetry::parseFoxgloveAddress("ws://127.0.0.1:" + std::to_string(port)).value(),
            [] { return telemetry::WallTime(); }, {}, limits()) {}

  /// Takes what has arrived.
  void take() {
    for (telemetry::FoxgloveEvent& event : m_client.take()) {
      if (const auto* start = std::get_if<telemetry::FoxgloveBegun>(&event)) {
        session = start->session;
        server = QString::fromStdString(start->server);
        topics.clear();
        last.clear();
      } else if (const auto* added = std::get_if<telemetry::FoxgloveChannelsAdded>(&event)) {
        std::vector<std::uint32_t> channels;
        for (const auto& channel : added->channels) {
          topics[channel.id] = QString::fromStdString(channel.topic);
          channels.push_back(channel.id);
        }
        m_client.subscribe(session, channels);
      } else if (const auto* message = std::get_if<telemetry::FoxgloveReceived>(&event)) {
        last[topics[message->channel]] =
            QJsonDocument::fromJson(QByteArray::fromStdString(message->payload)).object();
      }
    }
  }
  /// The time of the last row of a robot; −1 before the first one.
  double timeOf(const char* robot) {
    take();
    return last[QStringLiteral("/robots/%1/row").arg(QLatin1String(robot))]["time"].toDouble(-1);
  }

  std::uint64_t session = 0;
  QString server;
  std::map<std::uint32_t, QString> topics;
  std::map<QString, QJsonObject> last;

 private:
  static telemetry::FoxgloveLimits limits() {
    telemetry::FoxgloveLimits limits;
    limits.firstRetry = limits.lastRetry = std::chrono::milliseconds(20);
    return limits;
  }
  FoxgloveClient m_client;
};

/// A client that asks for playback: ours only reads.
class Player {
 public:
  explicit Player(int port) {
    m_socket.connectToHost(QHostAddress::LocalHost, static_cast<quint16>(port));
    m_socket.write(
        "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: MDEyMzQ1Njc4OTAxMjM0NQ==\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n");
  }
  bool isOpen() { return (m_seen += m_socket.readAll()).contains("serverInfo"); }
  void ask(bool plays, float speed, std::optional<std::uint64_t> seek) {
    QByteArray bytes(1, char(3));
    const auto add = [&bytes](std::uint64_t value, int count) {
      for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
    };
    add(plays ? 0 : 1, 1);
    add(std::bit_cast<std::uint32_t>(speed), 4);
    add(seek ? 1 : 0, 1);
    add(seek.value_or(0), 8);
    add(0, 4);
    // A client's frame is masked; with zeros it stays what it is.
    m_socket.write(QByteArray(1, char(0x82)) + char(0x80 | bytes.size()) + QByteArray(4, char(0)) +
                   bytes);
  }

 private:
  QTcpSocket m_socket;
  QByteArray m_seen;
};

/// A port that nobody has now.
int freePort() {
  QTcpServer server;
  return server.listen(QHostAddress::LocalHost) ? server.serverPort() : 0;
}

}  // namespace

class TestShare : public QObject {
  Q_OBJECT

 private slots:
  void whatIsShownIsShared() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.action("shareOnNetwork")->trigger();
    auto* dialog = s.window.findChild<ShareDialog*>();
    QVERIFY(dialog != nullptr && QTest::qWaitForWindowExposed(dialog));
    auto* port = dialog->findChild<QSpinBox*>(QStringLiteral("sharePort"));
    auto* everyone = dialog->findChild<QCheckBox*>(QStringLiteral("shareEveryComputer"));
    auto* change = dialog->findChild<QPushButton*>(QStringLiteral("shareChange"));
    auto* state = dialog->findChild<QLabel*>(QStringLiteral("shareState"));
    auto* status = s.window.findChild<QLabel*>(QStringLiteral("statusShared"));
    QCOMPARE(port->value(), 8765);
    QVERIFY(!everyone->isChecked());  // nobody else unless asked
    QCOMPARE(state->text(), QStringLiteral("Nothing is shared."));
    QVERIFY(status->text().isEmpty());

    // A port that another program has.
    QTcpServer other;
    QVERIFY(other.listen(QHostAddress::LocalHost));
    port->setValue(other.serverPort());
    QTest::mouseClick(change, Qt::LeftButton);
    auto* problem = dialog->findChild<InPlaceMessage*>(QStringLiteral("shareProblem"));
    QVERIFY(problem->isVisible());
    QVERIFY2(problem->text().startsWith(QStringLiteral("Cannot share: ")),
             qPrintable(problem->text()));
    QCOMPARE(state->text(), QStringLiteral("Nothing is shared."));

    const int used = freePort();
    port->setValue(used);
    QTest::mouseClick(change, Qt::LeftButton);
    QVERIFY(!problem->isVisible() && !port->isEnabled());
    const QString address = QStringLiteral("ws://127.0.0.1:%1").arg(used);
    QCOMPARE(state->text(), QStringLiteral("Shared at %1: nobody is connected.").arg(address));
    QTRY_VERIFY2(status->text().contains(address), qPrintable(status->text()));

    // The match, which is paused: its field at once, its rows as it goes on.
    Client client(used);
    const auto sees = [&client](const char* topic) {
      client.take();
      return client.last.contains(QLatin1String(topic));
    };
    QTRY_VERIFY(sees("/field"));
    QVERIFY(!client.last[QStringLiteral("/field")]["entities"].toArray().isEmpty());
    QTRY_VERIFY(state->text().endsWith(QStringLiteral("1 program is connected.")));
    s.controller.runTo(900);
    QTRY_VERIFY(s.played(900));
    QTRY_COMPARE(client.timeOf("B1"), 15.0);

    // A recording takes its place, at the moment that is shown.
    const QString file = s.recorded(300);
    QVERIFY(!file.isEmpty());
    s.window.openSession(file);
    ReplayController* replay = s.window.replay();
    QTRY_VERIFY(replay->isOpen() && s.window.shown()->source() == replay);
    QTRY_VERIFY((client.take(), client.topics.size() > 3));
    s.window.shown()->setPaused(true);
    s.window.shown()->seek(17.0);
    QTRY_COMPARE(client.timeOf("B1"), 17.0);

    // A client seeks, then plays; the window follows.
    Player player(used);
    QTRY_VERIFY(player.isOpen());
    const auto start = static_cast<std::uint64_t>(replay->info().start.time_since_epoch().count());
    player.ask(false, 1.0F, start + 18'000'000'000ULL);
    QTRY_COMPARE(s.window.shown()->time(), 18.0);
    QTRY_COMPARE(client.timeOf("B1"), 18.0);
    QVERIFY(s.window.shown()->isPaused());
    player.ask(true, 4.0F, {});
    QTRY_VERIFY(!s.window.shown()->isPaused() || s.window.shown()->time() > 19.9);
    QCOMPARE(s.window.shown()->speed(), 4.0);
    QTRY_COMPARE(client.timeOf("B1"), 20.0);  // its end

    QTest::mouseClick(change, Qt::LeftButton);
    QCOMPARE(state->text(), QStringLiteral("Nothing is shared."));
    QVERIFY(status->text().isEmpty());
    QVERIFY(port->isEnabled());
    // What was chosen is remembered, but not that it was on.
    QCOMPARE(s.settings.value(QStringLiteral("share/port")).toInt(), used);
  }

  void nothingIsOpen() {
    Studio s(0);
    NetworkShare* share = s.window.findChild<NetworkShare*>();
    const int used = freePort();
    share->start({false, used});
    QVERIFY(share->isOn());
    QCOMPARE(share->port(), 0);
    s.controller.open(link::loadScenario("one-robot").value());
    QTRY_COMPARE(share->port(), used);
    Client client(used);
    QTRY_VERIFY(client.timeOf("B1") > 0.0);
    // Another match: clients begin anew.
    const std::uint64_t before = client.session;
    s.controller.open(link::loadScenario("match-3v3").value());
    QTRY_VERIFY(client.timeOf("R3") >= 0.0 && client.session != before);
    // Live, without robots.
    auto* live = static_cast<LiveController*>(s.window.shown()->find(SourceKind::Live));
    live->setOptions(live_rig::options());
    s.window.showSource(SourceKind::Live);
    QTRY_VERIFY((client.take(), client.server == QStringLiteral("Live robots")));
  }
};

PITCHBOARD_GUI_TEST(TestShare)

}  // namespace tst_share

#include "tst_share.moc"

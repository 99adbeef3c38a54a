// SPDX-License-Identifier: GPL-3.0-or-later
// Foxglove's protocol: frames as the protocol defines them and any other bytes, and the client with
// a server that answers, ends, begins again, sends what it should not, or never answers.

#include <QElapsedTimer>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>

#include <atomic>

#include <base/base64.h>
#include <telemetry/foxglove/foxglove_client.h>

#include "../support/websocket_server.h"

namespace tst_foxglove {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace std::chrono_literals;

namespace {

constexpr const char* serverInfo =
    R"({"op":"serverInfo","name":"robot","capabilities":[],"sessionId":"a"})";
constexpr const char* twoChannels = R"({"op":"advertise","channels":[
  {"id":7,"topic":"/imu","encoding":"cdr","schemaName":"sensor_msgs/msg/Imu","schema":"float64 x"},
  {"id":9,"topic":"/log","encoding":"json","schemaName":"","schema":""}]})";

/// What a client has passed on.
struct Events {
  int begun = 0, ended = 0;
  std::uint64_t session = 0;
  std::vector<FoxgloveChannel> channels;
  std::vector<std::uint32_t> removed;
  std::vector<FoxgloveReceived> messages;

  void take(FoxgloveClient& client) {
    for (FoxgloveEvent& event : client.take()) {
      if (const auto* start = std::get_if<FoxgloveBegun>(&event)) {
        ++begun;
        session = start->session;
        channels.clear();
      } else if (auto* added = std::get_if<FoxgloveChannelsAdded>(&event)) {
        for (auto& channel : added->channels) channels.push_back(std::move(channel));
      } else if (const auto* gone = std::get_if<FoxgloveChannelsRemoved>(&event)) {
        removed.insert(removed.end(), gone->channels.begin(), gone->channels.end());
      } else if (auto* message = std::get_if<FoxgloveReceived>(&event)) {
        messages.push_back(std::move(*message));
      } else {
        ++ended;
      }
    }
  }
};

FoxgloveLimits quickLimits() {
  FoxgloveLimits limits;
  limits.firstRetry = 10ms;
  limits.lastRetry = 40ms;
  return limits;
}

std::unique_ptr<FoxgloveClient> clientOf(const std::string& url,
                                         FoxgloveLimits limits = quickLimits()) {
  return std::make_unique<FoxgloveClient>(
      parseFoxgloveAddress(url).value(), [] { return WallTime(5s); }, nullptr, limits);
}

/// Takes events until `isDone`.
#define TAKE_UNTIL(events, client, isDone) QTRY_VERIFY(((events).take(*(client)), (isDone)))

}  // namespace

class TestFoxglove : public QObject {
  Q_OBJECT

 private slots:
  void framesOfAServer() {
    auto frame = parseFoxgloveText(serverInfo);
    QCOMPARE(std::get<FoxgloveServerInfo>(*frame).name, std::string("robot"));
    QCOMPARE(std::get<FoxgloveServerInfo>(*frame).sessionId, std::string("a"));

    const std::string schema("\x0a\x00\xff", 3);
    frame = parseFoxgloveText(
        R"({"op":"advertise","channels":[{"id":4294967295,"topic":"/p","encoding":"protobuf",)"
        R"("schemaName":"T","schema":")" +
        toBase64(schema) +
        R"("},{"id":1,"topic":"/i","encoding":"cdr","schemaName":"I",)"
        R"("schema":"module a {};","schemaEncoding":"ros2idl"},)"
        R"({"id":2,"topic":"/r","encoding":"cdr","schemaName":"R",)"
        R"("schema":"int32 a"}]})");
    const auto& advertised = std::get<FoxgloveAdvertise>(*frame);
    QCOMPARE(advertised.channels.size(), std::size_t{3});
    QCOMPARE(advertised.refused, std::size_t{0});
    QCOMPARE(advertised.channels[0].id, 4294967295U);
    QCOMPARE(advertised.channels[0].schema, schema);
    QCOMPARE(advertised.channels[1].schemaEncoding, std::string("ros2idl"));
    QCOMPARE(advertised.channels[2].schemaEncoding, std::string("ros2msg"));  // the usual one

    frame = parseFoxgloveText(R"({"op":"unadvertise","channelIds":[3,7]})");
    QCOMPARE(std::get<FoxgloveUnadvertise>(*frame).channels, (std::vector<std::uint32_t>{3, 7}));
    frame = parseFoxgloveText(R"({"op":"status","level":2,"message":"no","id":"x"})");
    QCOMPARE(std::get<FoxgloveStatusText>(*frame).level, 2);
    for (const char* other : {R"({"op":"removeStatus","statusIds":["x"]})",
                              R"({"op":"parameterValues","parameters":[]})"}) {
      QVERIFY(std::holds_alternative<FoxgloveOther>(*parseFoxgloveText(other)));
    }

    // Opcode, subscription 258, log time 2 + 256^7, payload.
    const std::string binary("\x01\x02\x01\x00\x00\x02\x00\x00\x00\x00\x00\x00\x01hey", 16);
    frame = parseFoxgloveBinary(binary);
    const auto& message = std::get<FoxgloveMessage>(*frame);
    QCOMPARE(message.subscription, 258U);
    QCOMPARE(message.logTime, (std::uint64_t{1} << 56U) + 2);
    QCOMPARE(message.payload, std::string_view("hey"));
    for (const std::string_view other : {"\x02zzzzzzzz", "\x05", "\xff"}) {
      QVERIFY(std::holds_alternative<FoxgloveOther>(*parseFoxgloveBinary(other)));
    }
    const std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs{{1, 7}, {2, 9}};
    QCOMPARE(QJsonDocument::fromJson(QByteArray::fromStdString(foxgloveSubscribe(pairs))),
             QJsonDocument::fromJson(R"({"op":"subscribe","subscriptions":[
               {"id":1,"channelId":7},{"id":2,"channelId":9}]})"));
  }

  void malformedFramesSayWhatIsWrong() {
    const auto text = [](const char* json) { return parseFoxgloveText(json).error().message; };
    QCOMPARE(text("{"), std::string("A text frame is not valid JSON."));
    QCOMPARE(text("[]"), std::string("A text frame is not a JSON object."));
    QCOMPARE(text(R"({"op":5})"), std::string("A text frame has no \"op\"."));
    QCOMPARE(text(R"({"op":"advertise"})"), std::string("advertise has no list of channels."));
    QCOMPARE(text(R"({"op":"unadvertise","channelIds":[-1]})"),
             std::string("unadvertise has an id that is not valid."));
    // A bad channel costs itself.
    const auto frame = parseFoxgloveText(R"({"op":"advertise","channels":[5,
      {"id":4294967296,"topic":"/a","encoding":"cdr"}, {"id":1.5,"topic":"/a","encoding":"cdr"},
      {"id":1,"encoding":"cdr"}, {"id":2,"topic":"/p","encoding":"protobuf","schema":"%"},
      {"id":3,"topic":"/good","encoding":"json"}]})");
    const auto& advertised = std::get<FoxgloveAdvertise>(*frame);
    QCOMPARE(advertised.refused, std::size_t{5});
    QCOMPARE(advertised.channels.size(), std::size_t{1});
    QVERIFY(!parseFoxgloveBinary(""));
    QVERIFY(!parseFoxgloveBinary(std::string_view("\x01\0\0\0\0\0\0\0\0\0\0\0", 12)));
    QVERIFY(parseFoxgloveBinary(std::string_view("\x01\0\0\0\0\0\0\0\0\0\0\0\0", 13)));
  }

  void addresses_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("read");  // empty: it is refused
    const auto row = [](const char* text, const char* read) {
      QTest::newRow(text) << text << read;
    };
    row("ws://robot3:8765", "ws://robot3:8765");
    row("robot3", "ws://robot3:8765");
    row("192.168.0.7:9000", "ws://192.168.0.7:9000");
    row("ws://robot/a/b?c=1", "ws://robot:8765/a/b?c=1");
    row("ws://[fe80::1]:80", "ws://[fe80::1]:80");
    row("wss://robot", "");
    row("http://robot", "");
    row("ws://", "");
    row("ws://robot:", "");
    row("ws://robot:0", "");
    row("ws://robot:65536", "");
    row("ws://a b", "");
    row("ws://[fe80::1", "");
    row("ws://user@robot", "");
  }
  void addresses() {
    QFETCH(QString, text);
    QFETCH(QString, read);
    const auto address = parseFoxgloveAddress(text.toStdString());
    QCOMPARE(address ? QString::fromStdString(address->text()) : QString(), read);
    if (address) QCOMPARE(*parseFoxgloveAddress(address->text()), *address);
  }

  void messagesOfSubscribedChannels_data() {
    QTest::addColumn<QByteArray>("subprotocol");
    for (const std::string_view one : foxgloveSubprotocols) {
      const QByteArray name(one.data(), static_cast<qsizetype>(one.size()));
      QTest::newRow(name.constData()) << name;
    }
  }
  void messagesOfSubscribedChannels() {
    QFETCH(QByteArray, subprotocol);
    WebSocketServer server(subprotocol);
    const auto client = clientOf(server.url());
    Events events;
    QTRY_VERIFY(server.isOpen());
    QVERIFY(
        server.request.contains("Sec-WebSocket-Protocol: foxglove.sdk.v1, foxglove.websocket.v1"));
    QCOMPARE(client->status().state, FoxgloveState::Connecting);  // until it introduces itself
    server.sendText(serverInfo);
    server.sendText(twoChannels);
    TAKE_UNTIL(events, client, events.channels.size() == 2);
    QCOMPARE(client->status().state, FoxgloveState::Connected);
    QCOMPARE(client->status().server, std::string("robot"));
    QCOMPARE(client->status().subprotocol, subprotocol.toStdString());
    client->subscribe(events.session, {9, 12345});  // one of them does not exist
    QTRY_COMPARE(server.texts.size(), 1);
    const auto wish = QJsonDocument::fromJson(server.texts.first())["subscriptions"].toArray();
    QCOMPARE(wish.size(), 1);
    QCOMPARE(wish[0]["channelId"].toInt(), 9);
    const auto id = static_cast<quint32>(wish[0]["id"].toInt());
    server.sendMessage(id, 42, "{}");
    server.sendMessage(id + 100, 43, "of nobody");
    server.sendMessage(id, 44, QByteArray(200'000, 'x'));
    TAKE_UNTIL(events, client, events.messages.size() == 2);
    QCOMPARE(events.messages[0].channel, 9U);
    QCOMPARE(events.messages[0].logTime, std::uint64_t{42});
    QCOMPARE(events.messages[0].arrival, WallTime(5s));
    QCOMPARE(events.messages[0].payload, std::string("{}"));
    QCOMPARE(events.messages[1].payload.size(), std::size_t{200'000});
    QCOMPARE(client->status().messages, std::uint64_t{2});

    // A channel that goes and comes again under another id.
    server.sendText(R"({"op":"unadvertise","channelIds":[9]})");
    TAKE_UNTIL(events, client, events.removed == std::vector<std::uint32_t>{9});
    server.sendMessage(id, 45, "late");
    server.sendText(
        R"({"op":"advertise","channels":[{"id":11,"topic":"/log","encoding":"json"}]})");
    TAKE_UNTIL(events, client, events.channels.size() == 3);
    client->subscribe(events.session, {11});
    QTRY_COMPARE(server.texts.size(), 2);
    QCOMPARE(events.messages.size(), std::size_t{2});
    // It has sent its wishes and nothing else.
    QCOMPARE(server.otherFrames, 0);
    for (const QByteArray& text : server.texts) {
      QCOMPARE(QJsonDocument::fromJson(text)["op"].toString(), QStringLiteral("subscribe"));
    }
  }

  void badFramesCostThemselves() {
    FoxgloveLimits limits = quickLimits();
    limits.frameBytes = limits.textBytes = 1 << 20;
    limits.channels = 3;
    limits.schemaBytes = 1000;
    WebSocketServer server("foxglove.sdk.v1");
    const auto client = clientOf(server.url(), limits);
    Events events;
    QTRY_VERIFY(server.isOpen());
    server.sendText(twoChannels);  // before it has introduced itself
    server.sendText(serverInfo);
    server.sendText("{\"op\":");
    server.sendBinary("\x01short");
    server.sendBinary(QByteArray((1 << 20) + 1, '\x01'));
    server.sendText(QByteArray(3 << 20, ' '));
    server.sendText(R"({"op":"advertise","channels":[{"id":1,"topic":"/big","encoding":"json",)"
                    R"("schema":")" +
                    QByteArray(1001, 'x') + R"("}]})");
    server.sendText(twoChannels);
    server.sendText(R"({"op":"advertise","channels":[{"id":1,"topic":"/a","encoding":"json"},
                    {"id":2,"topic":"/too-many","encoding":"json"}]})");
    TAKE_UNTIL(events, client, events.channels.size() == 3);
    QCOMPARE(client->status().malformed, std::uint64_t{7});
    QCOMPARE(client->status().malformedReason, std::string("The server has more than 3 channels."));
    // The connection is still the first one, and a message comes through.
    client->subscribe(events.session, {7});
    QTRY_COMPARE(server.texts.size(), 1);
    server.sendMessage(1, 1, "good");
    TAKE_UNTIL(events, client, events.messages.size() == 1);
    QCOMPARE(server.connections, 1);
    // In two parts, and its second half is binary data of a text.
    server.sendFrame(char(0x02), QByteArray("\x01\x01\0\0\0", 5));
    server.sendFrame(char(0x80), QByteArray("\x02\0\0\0\0\0\0\0ok", 10));
    TAKE_UNTIL(events, client, events.messages.size() == 2);
    QCOMPARE(events.messages[1].payload, std::string("ok"));
    // What breaks WebSocket itself ends the connection, and the next one works.
    server.sendRaw(QByteArray(20, char(0xff)));
    QTRY_VERIFY(server.connections == 2 && server.isOpen());
    server.sendText(serverInfo);
    TAKE_UNTIL(events, client, events.begun == 2);
  }

  void aRestartedServerIsReadAgain() {
    WebSocketServer server("foxglove.sdk.v1");
    const auto client = clientOf(server.url());
    Events events;
    QTRY_VERIFY(server.isOpen());
    server.sendText(serverInfo);
    server.sendText(twoChannels);
    TAKE_UNTIL(events, client, events.channels.size() == 2);
    const std::uint64_t first = events.session;
    const quint16 port = server.port();
    server.stopListening();
    server.drop();
    QTRY_COMPARE(client->status().state, FoxgloveState::Waiting);
    QTRY_VERIFY(client->status().problem.find("refused") != std::string::npos);
    server.listenAgain(port);
    QTRY_VERIFY(server.isOpen());
    server.sendText(R"({"op":"serverInfo","name":"robot","sessionId":"b"})");
    TAKE_UNTIL(events, client, events.begun == 2);
    QCOMPARE(events.ended, 1);
    QVERIFY(events.channels.empty());
    QVERIFY(client->status().problem.empty());
    QCOMPARE(client->status().connections, std::uint64_t{2});
    server.sendText(twoChannels);
    TAKE_UNTIL(events, client, events.channels.size() == 2);
    client->subscribe(first, {7});  // a wish for the session before
    client->subscribe(events.session, {9});
    QTRY_COMPARE(server.texts.size(), 1);
    QVERIFY(server.texts.first().contains("\"channelId\":9"));
    // A session that begins anew within the connection.
    server.sendText(R"({"op":"serverInfo","name":"robot","sessionId":"c"})");
    TAKE_UNTIL(events, client, events.begun == 3);
    QVERIFY(events.channels.empty());
    server.sendText(R"({"op":"serverInfo","name":"renamed","sessionId":"c"})");
    QTRY_COMPARE(client->status().server, std::string("renamed"));
    QCOMPARE(events.begun, 3);
  }

  void serversThatAreNone_data() {
    QTest::addColumn<QByteArray>("subprotocol");
    QTest::addColumn<int>("answer");
    QTest::addColumn<QString>("why");
    using Answer = WebSocketServer::Answer;
    QTest::newRow("HTTP 400") << QByteArray() << static_cast<int>(Answer::Refuse400)
                              << QStringLiteral("HTTP 400");
    QTest::newRow("another protocol") << QByteArray("chat") << static_cast<int>(Answer::Accept)
                                      << QStringLiteral("not Foxglove's protocol");
    QTest::newRow("no protocol") << QByteArray() << static_cast<int>(Answer::Accept)
                                 << QStringLiteral("not Foxglove's protocol");
    QTest::newRow("no handshake") << QByteArray() << static_cast<int>(Answer::Nothing)
                                  << QStringLiteral("no answer");
    QTest::newRow("says nothing") << QByteArray("foxglove.sdk.v1")
                                  << static_cast<int>(Answer::Accept)
                                  << QStringLiteral("no answer");
  }
  void serversThatAreNone() {
    QFETCH(QByteArray, subprotocol);
    QFETCH(int, answer);
    QFETCH(QString, why);
    WebSocketServer server(subprotocol);
    server.answer = static_cast<WebSocketServer::Answer>(answer);
    FoxgloveLimits limits = quickLimits();
    limits.answer = 100ms;
    const auto client = clientOf(server.url(), limits);
    QTRY_VERIFY(QString::fromStdString(client->status().problem).contains(why));
    QVERIFY(client->status().problem.starts_with("Cannot connect to ws://127.0.0.1:"));
    QTRY_VERIFY(server.connections >= 3);  // it tries again, and again
  }

  void aNameThatNobodyHas() {
    std::atomic<int> announced = 0;  // changes of its state, which may last shorter than a look
    FoxgloveClient client(
        parseFoxgloveAddress("ws://no-such-robot.invalid").value(), [] { return WallTime(); },
        [&announced] { ++announced; }, quickLimits());
    // How soon a computer knows that there is no such name is its own affair.
    QTRY_VERIFY_WITH_TIMEOUT(!client.status().problem.empty(), 30'000);
    QVERIFY2(client.status().problem.starts_with("Cannot connect to ws://no-such-robot.invalid:"),
             client.status().problem.c_str());
    const int before = announced;
    QTRY_VERIFY_WITH_TIMEOUT((client.take(), announced >= before + 2), 30'000);  // it tries again
    // "localhost" is looked up, too.
    WebSocketServer server("foxglove.sdk.v1");
    const auto named = clientOf("ws://localhost:" + std::to_string(server.port()));
    QTRY_VERIFY(server.isOpen());
  }

  void aServerThatFallsSilentIsGone() {
    WebSocketServer server("foxglove.sdk.v1");
    FoxgloveLimits limits = quickLimits();
    limits.silence = 1s;  // less than a busy computer may need between two lines of this test
    const auto client = clientOf(server.url(), limits);
    Events events;
    QTRY_VERIFY(server.isOpen());
    server.sendText(serverInfo);
    TAKE_UNTIL(events, client, events.begun == 1);
    server.stopReading();
    QTRY_VERIFY(QString::fromStdString(client->status().problem)
                    .contains(QStringLiteral("does not answer any more")));
    TAKE_UNTIL(events, client, events.ended == 1);
  }

  void floodsAreBounded() {
    WebSocketServer server("foxglove.sdk.v1");
    FoxgloveLimits limits = quickLimits();
    limits.queueBytes = 100'000;
    const auto client = clientOf(server.url(), limits);
    Events events;
    QTRY_VERIFY(server.isOpen());
    server.sendText(serverInfo);
    server.sendText(twoChannels);
    TAKE_UNTIL(events, client, events.channels.size() == 2);
    client->subscribe(events.session, {7});
    QTRY_COMPARE(server.texts.size(), 1);
    for (int i = 0; i < 50; ++i) {
      server.sendMessage(1, static_cast<quint64>(i), QByteArray(10'000, 'x'));
    }
    QTRY_COMPARE(client->status().messages + client->status().dropped, std::uint64_t{50});
    const std::uint64_t kept = client->status().messages;
    QVERIFY(kept >= 8 && kept <= 10);
    // What is kept are the oldest; and there is room again once they are taken.
    events.take(*client);
    QCOMPARE(events.messages.size(), kept);
    QCOMPARE(events.messages.back().logTime, kept - 1);
    server.sendMessage(1, 1000, "x");
    TAKE_UNTIL(events, client, events.messages.back().logTime == 1000);
  }

  /// The end comes at once, whatever is under way.
  void stopsAtOnce() {
    QElapsedTimer time;
    WebSocketServer silent({});
    silent.answer = WebSocketServer::Answer::Nothing;
    WebSocketServer connected("foxglove.sdk.v1");
    for (const std::string& url :
         {silent.url(), connected.url(), std::string("ws://127.0.0.1:1"),
          std::string("ws://192.0.2.1:8765"), std::string("ws://no-such-robot.invalid")}) {
      auto client = clientOf(url);
      QTRY_VERIFY(url != connected.url() || connected.isOpen());
      time.start();
      client.reset();
      QVERIFY2(time.elapsed() < 3000, url.c_str());  // waiting for answers would take 5 s
    }
    QTRY_VERIFY(!connected.isOpen());
  }

  void newsAreAnnouncedOnce() {
    WebSocketServer server("foxglove.sdk.v1");
    std::atomic<int> announced = 0;
    FoxgloveClient client(
        parseFoxgloveAddress(server.url()).value(), [] { return WallTime(); },
        [&announced] { ++announced; }, quickLimits());
    QTRY_VERIFY(server.isOpen());
    client.take();
    const int before = announced;
    server.sendText(serverInfo);
    server.sendText(twoChannels);
    QTRY_COMPARE(client.status().state, FoxgloveState::Connected);
    QTRY_COMPARE(announced.load(), before + 1);
    QVERIFY(!client.take().empty());
  }
};

PITCHBOARD_TEST(TestFoxglove)

}  // namespace tst_foxglove

#include "tst_foxglove.moc"

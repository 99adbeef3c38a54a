// SPDX-License-Identifier: GPL-3.0-or-later
// The official server of Foxglove's protocol serves recordings that official writers made (ROS 2,
// ROS 1, JSON, protobuf): every value of every message arrives, as the JSON beside each recording
// says; a server that begins anew is read again, and images are not subscribed to.

#include <QFile>
#include <QProcess>
#include <QtTest>

#include <robotlink/live/live_pipeline.h>
#include <telemetry/foxglove/foxglove_client.h>

#include "../support/recorded_messages.h"

namespace tst_foxglove_server {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace recorded_messages;

namespace {

/// Keeps what was decoded.
class Reader : public LiveObserver {
 public:
  void decoded(const LiveTopicMessage& message) override {
    messages.push_back(messageOf(message.topic, message.message));
  }
  std::vector<Message> messages;
};

/// A server in its own process, and Live with it as its only source.
class Rig {
 public:
  explicit Rig(const QStringList& names) {
    // The packages are found beside the script, so it runs as a copy in their folder.
    const QString script = QStringLiteral(FOXGLOVE_SERVER "/serve_recordings.mjs");
    QFile::remove(script);
    QFile::copy(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/foxglove/serve_recordings.mjs"),
                script);
    QStringList arguments{script};
    for (const QString& name : names) {
      arguments << QString::fromStdString(dataPath(name.toStdString() + ".mcap"));
    }
    m_node.setProcessChannelMode(QProcess::MergedChannels);
    m_node.start(QStringLiteral("node"), arguments);
    const QByteArray port = line("port ");
    source = parseFoxgloveSource("ws://127.0.0.1:" + port.toStdString()).value();
    LiveOptions options;
    options.foxglove = {source};
    pipeline = std::make_unique<LivePipeline>(std::move(options), WallTime());
    reader = std::make_shared<Reader>();
    pipeline->observe(reader, WallTime());
    client = std::make_unique<FoxgloveClient>(
        source.address, [] { return WallTime(std::chrono::hours(500'000)); }, nullptr);
  }
  ~Rig() {
    client.reset();
    m_node.closeWriteChannel();
    if (!m_node.waitForFinished(10'000)) m_node.kill();
  }

  /// Waits for a line of the server, and returns what follows `begin`.
  QByteArray line(const QByteArray& begin) {
    for (;;) {
      while (m_node.canReadLine()) {
        const QByteArray text = m_node.readLine().trimmed();
        if (text.startsWith("subscribed ")) subscribed << text.mid(11);
        if (text.startsWith(begin)) return text.mid(begin.size());
      }
      if (!m_node.waitForReadyRead(60'000)) {
        qFatal("the server does not say \"%s\": %s", begin.constData(),
               m_node.readAll().constData());
      }
    }
  }
  void say(const QByteArray& command) {
    m_node.write(command + "\n");
    m_node.waitForBytesWritten();
  }

  void pump() {
    for (const FoxgloveEvent& event : client->take()) {
      TopicRequest request = pipeline->take(source, event);
      if (!request.channels.empty()) client->subscribe(request.session, request.channels);
    }
  }
  TopicSourceStatus status() const { return pipeline->details(WallTime()).topics.front(); }

  FoxgloveSource source;
  std::unique_ptr<LivePipeline> pipeline;
  std::shared_ptr<Reader> reader;
  std::unique_ptr<FoxgloveClient> client;
  QList<QByteArray> subscribed;

 private:
  QProcess m_node;
};

/// Messages of a channel are in order, those of several come as they come.
void sortMessages(std::vector<Message>& messages) {
  std::ranges::stable_sort(messages, [](const Message& a, const Message& b) {
    return std::tie(a.topic, a.time) < std::tie(b.topic, b.time);
  });
}

}  // namespace

class TestFoxgloveServer : public QObject {
  Q_OBJECT

 private slots:
  void everyValueArrives_data() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"ros2_types", "ros2_idl", "ros2_representations", "ros1", "json",
                             "protobuf", "images_between"}) {
      QTest::newRow(name) << name;
    }
  }
  void everyValueArrives() {
    QFETCH(QString, name);
    std::vector<Message> wanted = expected(name.toStdString() + ".json");
    QVERIFY(!wanted.empty());
    Rig rig({name});
    QTRY_VERIFY((rig.pump(), rig.reader->messages.size() >= wanted.size()));
    std::vector<Message> read = rig.reader->messages;
    QCOMPARE(read.size(), wanted.size());
    sortMessages(read);
    sortMessages(wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      QVERIFY2(read[i] == wanted[i],
               ("expected " + textOf(wanted[i]) + "\nread " + textOf(read[i])).c_str());
    }
    QCOMPARE(rig.client->status().subprotocol, std::string("foxglove.websocket.v1"));
    QCOMPARE(rig.client->status().malformed, std::uint64_t{0});
    QCOMPARE(rig.client->status().dropped, std::uint64_t{0});
  }

  void imagesAreNotSubscribedTo() {
    Rig rig({QStringLiteral("images_between")});
    QTRY_VERIFY((rig.pump(), rig.status().channels > 0 && !rig.reader->messages.empty()));
    QCOMPARE(rig.status().skipped, std::size_t{1});
    rig.say("restart");  // whatever was subscribed to has been printed then
    rig.line("port ");
    QCOMPARE(static_cast<std::size_t>(rig.subscribed.size()), rig.status().decoded);
    for (const QByteArray& topic : rig.subscribed) QVERIFY(!topic.contains("image"));
  }

  void restartedServerIsReadByTopic() {
    const std::size_t once = expected("json.json").size();
    Rig rig({QStringLiteral("json")});
    QTRY_COMPARE((rig.pump(), rig.reader->messages.size()), once);
    rig.say("restart");  // with other ids
    rig.line("port ");
    QTRY_COMPARE((rig.pump(), rig.reader->messages.size()), 2 * once);
    QCOMPARE(rig.client->status().connections, std::uint64_t{2});
    // A channel that goes is not counted any more.
    const std::size_t channels = rig.status().channels;
    rig.say("remove " + QByteArray::fromStdString(rig.reader->messages.front().topic));
    QTRY_COMPARE((rig.pump(), rig.status().channels), channels - 1);
  }

  void robotOfRos2IsOnTheField() {
    Rig rig({QStringLiteral("robot_walks")});
    const auto hasRobots = [&rig] {
      rig.pump();
      const auto frame = rig.pipeline->frame(WallTime(std::chrono::hours(500'000)));
      return std::ranges::count_if(frame.robots, [](const RobotFrame& robot) {
               return robot.belief && robot.link;
             }) == 2;
    };
    QTRY_VERIFY(hasRobots());
    const auto frame = rig.pipeline->frame(WallTime(std::chrono::hours(500'000)));
    QCOMPARE(frame.robots[0].name, std::string("B3"));
    QCOMPARE(frame.robots[1].name, std::string("B7"));
  }
};

PITCHBOARD_TEST(TestFoxgloveServer)

}  // namespace tst_foxglove_server

#include "tst_foxglove_server.moc"

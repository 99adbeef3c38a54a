// SPDX-License-Identifier: GPL-3.0-or-later
// `pitchboard-cli serve` and the official client of Foxglove's protocol: each row of a session
// arrives with its time, value for value; playback is controlled in the newer subprotocol; who
// speaks none is told so.

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QScopeGuard>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <QtTest>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <functional>
#include <mutex>
#include <thread>

#include <robotlink/serve/served_match.h>
#include <telemetry/foxglove/foxglove_client.h>
#include <telemetry/foxglove/foxglove_server.h>
#include <telemetry/series/losable.h>
#include <telemetry/session/session_reader.h>

#include "../robotlink/live_ports.h"
#include "../support/program_run.h"

namespace tst_cli_serve {

using namespace pitchboard;
using telemetry::SessionReader;

namespace {

const QString cli = QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli");

/// `pitchboard-cli serve` with these arguments.
class Server {
 public:
  explicit Server(const QStringList& arguments) {
    m_process.setReadChannel(QProcess::StandardError);
    m_process.start(cli, QStringList{"serve", "--port", "0"} + arguments);
    while (!m_url.contains("ws://") &&
           (m_process.canReadLine() || m_process.waitForReadyRead(60'000))) {
      m_url = m_process.readLine();
    }
    m_url = m_url.mid(m_url.indexOf("ws://"));
    m_url.truncate(m_url.indexOf(' '));
  }
  ~Server() { end(); }
  QString url() const { return QString::fromUtf8(m_url); }
  quint16 port() const {
    return static_cast<quint16>(m_url.mid(m_url.lastIndexOf(':') + 1).toInt());
  }
  /// Ctrl+C; returns the exit code.
  int end() {
    if (m_process.state() == QProcess::NotRunning) return m_process.exitCode();
    ::kill(static_cast<pid_t>(m_process.processId()), SIGINT);
    return m_process.waitForFinished(60'000) ? m_process.exitCode() : -1;
  }

 private:
  QProcess m_process;
  QByteArray m_url;
};

/// What the client printed until `isEnough` says so.
QList<QJsonObject> received(const QString& url, const QString& steps,
                            const std::function<bool(const QList<QJsonObject>&)>& isEnough) {
  // The packages are found beside the script, so it runs as a copy in their folder.
  const QString script = QStringLiteral(FOXGLOVE_SERVER "/read_server.mjs");
  QFile::remove(script);
  QFile::copy(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/foxglove/read_server.mjs"), script);
  QProcess node;
  node.start("node", {script, url, "120", steps});
  QList<QJsonObject> lines;
  while (!isEnough(lines) && (node.canReadLine() || node.waitForReadyRead(60'000))) {
    while (node.canReadLine()) lines << QJsonDocument::fromJson(node.readLine()).object();
  }
  node.kill();
  node.waitForFinished();
  return lines;
}

bool hasNumber(const QJsonValue& value, double number) {
  return std::isfinite(number) ? value.isDouble() && value.toDouble() == number : value.isNull();
}

}  // namespace

class TestCliServe : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QVERIFY(m_folder.isValid());
    m_session = m_folder.filePath("match.mcap");
    QCOMPARE(QProcess::execute(
                 cli, {"record", "--scenario", "match-3v3", "--duration", "4", "-o", m_session}),
             0);
  }

  /// Played from its first moment to its end.
  void rowsArriveValueForValue() {
    const auto session = SessionReader::open(m_session.toStdString());
    QVERIFY(session.has_value());
    const auto robot = session->groupsNamed("B1");
    QVERIFY(robot.has_value() && robot->size() == 1);
    const telemetry::GroupInfo& info = session->groups()[robot->front()].info;
    Server server({m_session, "--speed", "0.5"});
    const auto lines = received(server.url(), "official", [](const QList<QJsonObject>& seen) {
      return std::ranges::count_if(seen, [](const QJsonObject& one) {
               return one["topic"] == "/robots/B1/row";
             }) >= 60;
    });
    QHash<QString, QJsonObject> rows;  // by time
    QSet<QString> topics;
    for (const QJsonObject& line : lines) {
      QVERIFY2(!line.contains("error"), qPrintable(line["error"].toString()));
      topics << line["topic"].toString();
      if (line["topic"] == "/robots/B1/row")
        rows[line["time"].toString()] = line["message"].toObject();
    }
    QVERIFY(topics.contains("/match/row") && topics.contains("/field"));
    const auto slots_ = telemetry::slotsOf(info.columns);
    const auto losable = telemetry::losableColumns(info);
    int compared = 0;
    session->rows(
        *session->range(), *robot, [&](telemetry::GroupId, const telemetry::RowView& row) {
          const QString time = QString::number(session->logTime(row.time));
          if (!rows.contains(time)) return true;
          const QJsonObject& message = rows[time];
          ++compared;
          [&] {
            QCOMPARE(message["time"].toDouble(), row.time);
            QCOMPARE(message.size(), static_cast<qsizetype>(info.columns.size()) + 1);
            for (std::size_t c = 0; c < slots_.size(); ++c) {
              const auto rule = std::ranges::find(losable, c, &telemetry::Losable::column);
              const bool isLost = rule != losable.end() && rule->isLost(row);
              const auto [type, index] = slots_[c];
              const double number =
                  isLost                                   ? std::nan("")
                  : type == telemetry::ColumnType::Float64 ? row.values[index]
                  : type == telemetry::ColumnType::Int32
                      ? std::bit_cast<std::int32_t>(row.words[index])
                      : static_cast<double>(std::bit_cast<float>(row.words[index]));
              const std::string& name = info.columns[c].name;
              QVERIFY2(hasNumber(message[QString::fromStdString(name)], number), name.c_str());
            }
          }();
          return !QTest::currentTestFailed();
        });
    QVERIFY2(compared >= 60, qPrintable(QString::number(compared)));
    QCOMPARE(server.end(), 0);
  }

  /// A robot that gets another name has another channel; nobody who asked for the old one gets its
  /// rows.
  void renamedRobotsHaveNewChannels() {
    using namespace telemetry;
    FoxgloveServerOptions options;
    options.port = 0;
    options.sessionId = "1";
    const auto server = FoxgloveServer::start(options).value();
    link::ServedMatch served(
        *server, [](double seconds) { return static_cast<std::uint64_t>(seconds * 1e9); });
    ColumnInfo column;
    column.name = "X";
    GroupInfo group;
    group.name = "B1";
    group.columns = {column};
    group.id = "1 messages";
    group.robot.emplace().slot = 1;
    const GroupId id = served.addGroup(group);
    FoxgloveClient client(
        {.host = "127.0.0.1", .port = server->port()}, [] { return WallTime(); }, [] {});
    std::uint64_t session = 0;
    QStringList seen;
    const auto hasSeen = [&](const QString& what) {
      for (const FoxgloveEvent& event : client.take()) {
        if (const auto* begun = std::get_if<FoxgloveBegun>(&event)) session = begun->session;
        if (const auto* added = std::get_if<FoxgloveChannelsAdded>(&event)) {
          std::vector<std::uint32_t> ids;
          for (const FoxgloveChannel& one : added->channels) {
            seen << QString("+%1 %2").arg(one.id).arg(QString::fromStdString(one.topic));
            ids.push_back(one.id);
          }
          if (ids.front() < 5) client.subscribe(session, ids);  // not to those that come later
        }
        if (const auto* gone = std::get_if<FoxgloveChannelsRemoved>(&event)) {
          for (const std::uint32_t one : gone->channels) seen << QString("-%1").arg(one);
        }
        if (const auto* row = std::get_if<FoxgloveReceived>(&event)) {
          seen << QString("row of %1").arg(row->channel);
        }
      }
      return seen.contains(what);
    };
    const double x = 1.0;
    const auto rowIsSeen = [&] {
      served.append(id, {.time = 1.0, .words = {}, .values = {&x, 1}});
      return hasSeen("row of 4");
    };
    QTRY_VERIFY2(rowIsSeen(), qPrintable(seen.join(", ")));
    QVERIFY(seen.contains("+4 /robots/B1/row"));
    group.name = "R1";
    QCOMPARE(served.addGroup(group), id);
    QTRY_VERIFY2(hasSeen("+5 /robots/R1/row"), qPrintable(seen.join(", ")));
    QVERIFY2(seen.contains("-4"), qPrintable(seen.join(", ")));
    // What was sent before the name changed has come; of what follows nothing may.
    seen.clear();
    served.append(id, {.time = 2.0, .words = {}, .values = {&x, 1}});
    GroupInfo other = group;
    other.name = "B2";
    other.id = "2 messages";
    served.addGroup(other);
    QTRY_VERIFY2(hasSeen("+6 /robots/B2/row"), qPrintable(seen.join(", ")));
    QCOMPARE(seen, QStringList{"+6 /robots/B2/row"});
  }

  /// A match that nobody looks at costs nothing: what a client sees first is made when it asks.
  void nothingIsMadeForNobody() {
    using namespace telemetry;
    FoxgloveServerOptions options;
    options.port = 0;
    options.sessionId = "1";
    const auto server = FoxgloveServer::start(options).value();
    FoxgloveChannel channel;
    channel.id = 1;
    channel.topic = "/x";
    channel.encoding = "json";
    server->advertise(channel);
    const auto made = std::make_shared<std::atomic<int>>(0);
    const auto send = [&](int number) {
      server->sendKept(1, static_cast<std::uint64_t>(number), [made, number] {
        ++*made;
        return std::to_string(number);
      });
    };
    for (int i = 1; i <= 100; ++i) send(i);
    FoxgloveClient client(
        {.host = "127.0.0.1", .port = server->port()}, [] { return WallTime(); }, [] {});
    std::uint64_t session = 0;
    QStringList seen;
    const auto hasSeen = [&](const char* payload) {
      for (const FoxgloveEvent& event : client.take()) {
        if (const auto* begun = std::get_if<FoxgloveBegun>(&event)) session = begun->session;
        if (std::holds_alternative<FoxgloveChannelsAdded>(event)) client.subscribe(session, {1});
        if (const auto* message = std::get_if<FoxgloveReceived>(&event)) {
          seen << QString::fromStdString(message->payload);
        }
      }
      return seen.contains(QLatin1String(payload));
    };
    QTRY_VERIFY2(hasSeen("100"), qPrintable(seen.join(", ")));
    QCOMPARE(made->load(), 1);
    QCOMPARE(seen, QStringList{"100"});
    send(101);
    QTRY_VERIFY(hasSeen("101"));
    QCOMPARE(made->load(), 2);
  }

  /// `serve --live`: robots that send to this computer are channels with their rows, and are on the
  /// field.
  void liveRobotsAreServed() {
    const link::LiveOptions ports = freeOptions(2);
    Server server({"--live", "--bind", "127.0.0.1", "--robots", "2", "--port-base",
                   QString::number(ports.portBase), "--gamecontroller-port",
                   QString::number(ports.refereePort), "--rate", "20"});
    QVERIFY2(server.port() != 0, qPrintable(server.url()));
    // A robot that sends twenty times a second until it is ended.
    std::mutex mutex;
    std::condition_variable changed;
    bool isOver = false;
    std::thread robot([&] {
      const TestSocket socket;
      std::unique_lock lock(mutex);
      for (int sent = 0; !isOver; ++sent) {
        socket.send(static_cast<std::uint16_t>(ports.portBase + 1),
                    "1 " + std::to_string(300 + sent % 50) +
                        " 200 45 56.3 184.6 41.0 1 1 1 1 1 8 0.05 189 OUT");
        changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return isOver; });
      }
    });
    const auto end = qScopeGuard([&] {
      {
        const std::lock_guard lock(mutex);
        isOver = true;
      }
      changed.notify_all();
      robot.join();
    });
    const auto isRow = [](const QJsonObject& one) {
      return one["topic"].toString().startsWith("/robots/") &&
             one["message"]["LOCALIZATION_X"].isDouble();
    };
    const auto isField = [](const QJsonObject& one) {
      return one["topic"] == "/field" &&
             !one["message"]["entities"][1]["cylinders"].toArray().isEmpty();
    };
    const auto lines = received(server.url(), "official", [&](const QList<QJsonObject>& seen) {
      return std::ranges::count_if(seen, isRow) >= 5 && std::ranges::any_of(seen, isField);
    });
    const auto row = std::find_if(lines.rbegin(), lines.rend(), isRow);
    QVERIFY(row != lines.rend());
    const QJsonObject message = (*row)["message"].toObject();
    QVERIFY(message["LOCALIZATION_X"].toDouble() >= 300.0);
    QCOMPARE(message["LOCALIZATION_Y"].toDouble(), 200.0);
    QVERIFY(std::ranges::any_of(lines, isField));
    QVERIFY(std::ranges::any_of(lines, [](const QJsonObject& one) { return one.contains("now"); }));
    QCOMPARE(server.end(), 0);
  }

  void playbackIsControlled() {
    Server server({m_session, "--paused"});
    const QString steps = "seek:2.5,play:2,pause,seek:3.5,play:1";
    const auto states = [](const QList<QJsonObject>& seen) {
      QList<QJsonObject> found;
      for (const QJsonObject& one : seen) {
        if (one.contains("playback")) found << one["playback"].toObject();
      }
      return found;
    };
    const auto lines = received(server.url(), steps, [&](const QList<QJsonObject>& seen) {
      const auto all = states(seen);
      return !all.isEmpty() && all.last()["status"].toInt() == 3;
    });
    QVERIFY(!lines.isEmpty());
    QCOMPARE(lines.first()["subprotocol"].toString(), QString("foxglove.sdk.v1"));
    const auto all = states(lines);
    QStringList text;
    for (const QJsonObject& state : all) {
      text << QString("%1 %2 %3")
                  .arg(state["status"].toInt())
                  .arg(state["didSeek"].toInt())
                  .arg(state["request"].toString());
    }
    const QStringList expected{"1 0 ",
                               "1 1 request seek:2.5",
                               "0 0 request play:2",
                               "1 0 request pause",
                               "1 1 request seek:3.5",
                               "0 0 request play:1",
                               "3 0 "};
    QCOMPARE(text, expected);
    QCOMPARE(all[1]["time"].toDouble(), 2.5);
    QCOMPARE(all[2]["speed"].toDouble(), 2.0);
    QVERIFY(all[3]["time"].toDouble() >= 2.5);
    QCOMPARE(all[4]["time"].toDouble(), 3.5);
  }

  void aMatchIsServed() {
    Server server({"--scenario", "match-3v3", "--duration", "20", "--rate", "10"});
    const auto lines = received(server.url(), "official", [](const QList<QJsonObject>& seen) {
      return std::ranges::count_if(
                 seen, [](const QJsonObject& one) { return one["topic"] == "/field"; }) >= 5;
    });
    const auto field = std::find_if(lines.rbegin(), lines.rend(), [](const QJsonObject& one) {
      return one["topic"] == "/field";
    });
    QVERIFY(field != lines.rend());
    const QJsonArray entities = (*field)["message"]["entities"].toArray();
    QCOMPARE(entities.size(), 3);
    QCOMPARE(entities[0]["lines"].toArray().size(), 7);
    QCOMPARE(entities[1]["cylinders"].toArray().size(), 6);
    QCOMPARE(entities[1]["texts"][0]["text"].toString(), QString("B1"));
    QCOMPARE(entities[2]["spheres"].toArray().size(), 1);
    QCOMPARE(server.end(), 0);
  }

  void whoSpeaksNoProtocolIsToldSo() {
    Server server({m_session, "--paused"});
    const auto answer = [&server](const QByteArray& head) {
      QTcpSocket socket;
      socket.connectToHost("127.0.0.1", server.port());
      socket.write("GET / HTTP/1.1\r\nHost: localhost\r\n" + head + "\r\n");
      QByteArray text;
      while (socket.waitForReadyRead(60'000)) text += socket.readAll();
      return QString::fromUtf8(text);
    };
    QVERIFY(answer({}).startsWith("HTTP/1.1 426"));
    const QByteArray upgrade =
        "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    const QString refused = answer(upgrade + "Sec-WebSocket-Protocol: chat\r\n");
    QVERIFY2(refused.startsWith("HTTP/1.1 400") && refused.contains("foxglove.sdk.v1"),
             qPrintable(refused));
  }

  void mistakesAreExplained() {
    const auto error = [](const QStringList& arguments) {
      const ProgramRun run = runProgram("pitchboard-cli", QStringList{"serve"} + arguments);
      return QString("%1: %2").arg(run.exitCode).arg(QString::fromUtf8(run.err));
    };
    Server server({m_session, "--paused"});
    const QString taken = error({m_session, "--port", QString::number(server.port())});
    QVERIFY2(taken.startsWith("2: ") && taken.contains("choose another port"), qPrintable(taken));
    const QString missing = error({m_folder.filePath("none.mcap")});
    QVERIFY2(missing.startsWith("2: error: ") && missing.contains("none.mcap"),
             qPrintable(missing));
    const QString both = error({m_session, "--scenario", "match"});
    QVERIFY2(both.startsWith("2: "), qPrintable(both));
    const QString address = error({m_session, "--address", "here"});
    QVERIFY2(address.startsWith("2: ") && address.contains("here"), qPrintable(address));
  }

 private:
  QTemporaryDir m_folder;
  QString m_session;
};

PITCHBOARD_TEST(TestCliServe)

}  // namespace tst_cli_serve

#include "tst_cli_serve.moc"

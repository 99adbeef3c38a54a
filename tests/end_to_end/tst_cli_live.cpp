// SPDX-License-Identifier: GPL-3.0-or-later
// The listen and decode commands as people run them.

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>
#include <nlohmann/json.hpp>

#include "../support/program_run.h"
#include "../support/test_socket.h"

namespace tst_cli_live {

namespace {

const QString program = QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli");
const QString data = QStringLiteral(PITCHBOARD_TEST_DATA "/");

struct Outcome : ProgramRun {
  QList<QJsonObject> objects() const {
    QList<QJsonObject> list;
    for (const QByteArray& line : out.split('\n')) {
      if (!line.isEmpty()) list << QJsonDocument::fromJson(line).object();
    }
    return list;
  }
};

Outcome run(const QStringList& arguments, const QByteArray& input = {}) {
  return {runProgram("pitchboard-cli", arguments, input)};
}

/// A listening pitchboard-cli on free ports of 127.0.0.1.
class Listener {
 public:
  explicit Listener(const QStringList& more = {}) {
    const TestSocket robots, referee;
    base = robots.port() - 1;
    refereePort = referee.port();
    if (refereePort == base + 2) refereePort = base + 3;
    arguments = QStringList{"listen",
                            "--json",
                            "--bind",
                            "127.0.0.1",
                            "--robots",
                            "2",
                            "--port-base",
                            QString::number(base),
                            "--gamecontroller-port",
                            QString::number(refereePort)} +
                more;
  }
  /// True once it says that it listens.
  bool start() {
    process.start(program, arguments);
    while (!err.contains("listening at")) {
      if (!process.waitForReadyRead(60'000) && process.state() != QProcess::Running) return false;
      err += process.readAllStandardError();
    }
    return true;
  }
  /// Messages; what is said of the robots' health in between is left out.
  QList<QJsonObject> read(int count) {
    QList<QJsonObject> list;
    process.setReadChannel(QProcess::StandardOutput);
    while (list.size() < count) {
      if (!process.canReadLine() && !process.waitForReadyRead(60'000)) break;
      while (process.canReadLine()) {
        const QJsonObject object = QJsonDocument::fromJson(process.readLine()).object();
        if (object["type"] != "health" && object["type"] != "event") list << object;
      }
    }
    return list;
  }
  /// Exit code after SIGINT; -1 when it did not end by itself.
  int interrupt() {
    kill(static_cast<pid_t>(process.processId()), SIGINT);
    if (!process.waitForFinished(60'000) || process.exitStatus() != QProcess::NormalExit) return -1;
    err += process.readAllStandardError();
    return process.exitCode();
  }

  QProcess process;
  QStringList arguments;
  QByteArray err;
  int base = 0;
  int refereePort = 0;

 private:
  // Standard error is read while waiting for the first line.
  struct Channel {
    explicit Channel(QProcess& p) { p.setReadChannel(QProcess::StandardError); }
  } m_channel{process};
};

}  // namespace

class TestCliLive : public QObject {
  Q_OBJECT
 private slots:
  /// The second program used to take all robots that send to this computer alone, and neither said
  /// so.
  void twoProgramsOnTheSamePorts() {
    Listener first, second;
    first.arguments.replace(first.arguments.indexOf("127.0.0.1"), "0.0.0.0");
    second.arguments = first.arguments;
    QVERIFY(first.start());
    QVERIFY(second.start());
    const TestSocket robot;
    const auto port = static_cast<std::uint16_t>(first.base + 1);
    const QByteArray message = "1 450 300 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT";
    QVERIFY(robot.send(port, message.toStdString()));
    QCOMPARE(first.read(1).size(), 1);
    if (!robot.send(port, message.toStdString() + " ", 0x7fffffff)) QSKIP("no broadcast");
    // The first thing that the second one receives is the broadcast.
    QCOMPARE(second.read(1).value(0)["bytes"].toInt(), int(message.size()) + 1);
    const auto says = [](Listener& one, const QByteArray& text) {
      one.process.setReadChannel(QProcess::StandardError);
      one.err += one.process.readAllStandardError();
      return one.err.contains(text);
    };
    const auto idOf = [](const Listener& one) {
      return "pitchboard-cli (process " + QByteArray::number(one.process.processId()) + ")";
    };
    QTRY_VERIFY2_WITH_TIMEOUT(says(second, "was first opened by " + idOf(first)),
                              second.err.constData(), 20'000);
    QTRY_VERIFY2_WITH_TIMEOUT(says(first, "was also opened by " + idOf(second)),
                              first.err.constData(), 20'000);
    // One sentence for all ports; a second one if the second program was just opening them.
    QVERIFY2(first.err.count("was also opened by") <= 2, first.err.constData());
    QCOMPARE(first.interrupt(), 0);
    QTRY_VERIFY2_WITH_TIMEOUT(says(second, "No other program receives"), second.err.constData(),
                              20'000);
    QCOMPARE(second.interrupt(), 0);
  }

  void receivesRobotsWrittenByOthers() {
    Listener listener;
    QVERIFY(listener.start());
    QProcess sender;
    sender.start("python3",
                 {QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/robot_sender.py"),
                  QString::number(listener.base), "2", "5"});
    if (!sender.waitForStarted()) QSKIP("python3 is not installed");
    QVERIFY(sender.waitForFinished());
    QCOMPARE(sender.exitCode(), 0);
    const QList<QJsonObject> received = listener.read(10);
    QCOMPARE(received.size(), 10);
    QMap<int, int> messages;
    for (const QJsonObject& object : received) {
      QCOMPARE(object["type"].toString(), "telemetry");
      const int robot = object["robot"].toInt();
      QCOMPARE(object["port"].toInt(), listener.base + robot);
      const QJsonObject values = object["values"].toObject();
      QCOMPARE(values["LOCALIZATION_X"].toInt(), 100 + messages[robot]++);
      QCOMPARE(values["LOCALIZATION_THETA"].toInt(), -45);
      QCOMPARE(values["VISION_BALL_DIST"].toDouble(), 80.25);
      QCOMPARE(values["LOCALIZATION"].toInt(), 0);
      QCOMPARE(object["action"].toString(), "turn right");
      QVERIFY(object["errors"].toArray().isEmpty());
    }
    QCOMPARE(messages[2], 5);
    QCOMPARE(listener.interrupt(), 0);
    QVERIFY2(listener.err.contains("10 datagrams from 2 robots"), listener.err.constData());
  }

  void receivesTheRefereeAndSurvivesInvalidPackets() {
    Listener listener;
    QVERIFY(listener.start());
    const TestSocket socket;
    QFile packet(data + "gamecontroller/v12hl688_CORNER_KICK.bin");
    QVERIFY(packet.open(QIODevice::ReadOnly));
    const auto referee = static_cast<std::uint16_t>(listener.refereePort);
    const auto robot = static_cast<std::uint16_t>(listener.base + 1);
    QVERIFY(socket.send(referee, packet.readAll().toStdString()));
    QCOMPARE(listener.read(1)[0]["secGameStateName"].toString(), "CORNER_KICK");
    QVERIFY(socket.send(referee,
                        "RGme\x63"
                        "later version"));
    QVERIFY(listener.read(1)[0]["error"].toString().contains("version 99"));
    for (const std::string& text :
         {std::string(), std::string("\0\xff\x01", 3), std::string("1 2 3"),
          std::string(60000, 'A'), std::string("1 nan")}) {
      QVERIFY(socket.send(robot, text));
      const QList<QJsonObject> received = listener.read(1);
      QCOMPARE(received.size(), 1);
      QCOMPARE(received[0]["accepted"].toBool(true), false);
      QVERIFY(!received[0]["errors"].toArray().isEmpty());
    }
    QVERIFY(!socket.received());
    QCOMPARE(listener.interrupt(), 0);
    QVERIFY2(listener.err.contains("not text: 1"), listener.err.constData());
  }

  void healthIsReportedOnceASecondAndAtTheEnd() {
    QTemporaryDir folder;
    QFile profile(folder.filePath("p.json"));
    QVERIFY(profile.open(QIODevice::WriteOnly));
    profile.write(R"({"name": "t", "fields": [{"name": "ID", "type": "int", "meaning": "robot"},
                      {"name": "SEQ", "type": "int", "meaning": "sequence", "bits": 8}]})");
    profile.close();
    Listener listener({"--profile", profile.fileName()});
    QVERIFY(listener.start());
    const TestSocket robot;
    const auto port = static_cast<std::uint16_t>(listener.base + 1);
    // Every fourth of 1200 numbers that wrap five times is missing; one comes twice, one late.
    const auto sendOne = [&](int i) {
      return robot.send(port, "1 " + std::to_string(i % 256) + " OUT");
    };
    for (int i = 0; i < 1200; ++i) {
      if (i % 4 == 2 || i == 600) continue;
      QVERIFY(sendOne(i));
      if (i == 601) QVERIFY(sendOne(600) && sendOne(601));
      if (i % 100 == 99) QCOMPARE(listener.read(i == 699 ? 76 : 75).size(), i == 699 ? 76 : 75);
    }
    listener.process.setReadChannel(QProcess::StandardOutput);
    // The line of this second, without asking for it.
    QVERIFY(listener.process.waitForReadyRead(60'000));
    QCOMPARE(listener.interrupt(), 0);
    QList<QByteArray> lines = listener.process.readAllStandardOutput().trimmed().split('\n');
    const QByteArray last = lines.last();
    QVERIFY2(
        last.startsWith(R"({"type":"health","robot":1,"name":"Robot 1","received":900,"lost":300,)"
                        R"("duplicates":1,"late":1,"loss":0.25,)"),
        last.constData());
    QVERIFY(lines.size() >= 2);
    QVERIFY2(
        listener.err.contains("Robot 1: 900 received, 300 lost (25.0 %), 1 duplicates, 1 late"),
        listener.err.constData());
  }

  void aDrawingIsNoBadMessage() {
    Listener listener;
    QVERIFY(listener.start());
    const TestSocket robot;
    const auto port = static_cast<std::uint16_t>(listener.base + 1);
    const std::string drawing = "PBD1 1\nlayer a\ncircle 0.4 0.1 0.1\n";
    const std::string words = "1 450 300 90 12.5 80 10 1 1 1 1 1 8 0.5 189 OUT";
    QVERIFY(robot.send(port, drawing) && robot.send(port, words + "\n" + drawing));
    const QList<QJsonObject> received = listener.read(2);
    QCOMPARE(received.value(0)["type"].toString(), "drawing");
    QCOMPARE(received.value(0)["name"].toString(), "Robot 1");
    QCOMPARE(received.value(1)["type"].toString(), "telemetry");
    QVERIFY(received.value(1)["errors"].toArray().isEmpty());
    QCOMPARE(listener.interrupt(), 0);
    QVERIFY2(listener.err.contains("2 datagrams from 1 robot;") && listener.err.contains("bad: 0"),
             listener.err.constData());
    const Outcome outcome = run({"decode", "telemetry", "--json", "-"},
                                QByteArray::fromStdString(words) + "\nPBD1 1\n");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.objects().value(0)["name"].toString(), "Robot 1");
  }

  void theRefereeHasAListOfItsOwn() {
    Listener listener({"--from", "10.1.2.3", "--referee-from", "127.0.0.1"});
    QVERIFY(listener.start());
    const TestSocket socket;
    QFile packet(data + "gamecontroller/v12hl688_CORNER_KICK.bin");
    QVERIFY(packet.open(QIODevice::ReadOnly));
    QVERIFY(socket.send(static_cast<std::uint16_t>(listener.base + 1), "1 2 3 OUT"));
    QVERIFY(socket.send(static_cast<std::uint16_t>(listener.refereePort),
                        packet.readAll().toStdString()));
    const QList<QJsonObject> received = listener.read(1);
    QCOMPARE(received.value(0)["type"].toString(), "referee");
    QCOMPARE(listener.interrupt(), 0);
    QVERIFY2(listener.err.contains("refused: 1 from senders outside --from"),
             listener.err.constData());

    Listener other({"--referee-from", "10.1.2.3"});
    QVERIFY(other.start());
    QVERIFY(socket.send(static_cast<std::uint16_t>(other.refereePort), "anything"));
    QVERIFY(socket.send(static_cast<std::uint16_t>(other.base + 1), "1 2 3 OUT"));
    QCOMPARE(other.read(1).value(0)["type"].toString(), "telemetry");
    QCOMPARE(other.interrupt(), 0);
    QVERIFY2(other.err.contains("1 from referees outside --referee-from"), other.err.constData());
  }

  void aTakenPortIsAWarning() {
    Listener listener;
    TestSocket blocker;  // does not share its port
    listener.arguments.replace(listener.arguments.indexOf("--gamecontroller-port") + 1,
                               QString::number(blocker.port()));
    listener.arguments << "--duration"
                       << "0.01";
    const Outcome outcome = run(listener.arguments);
    QCOMPARE(outcome.exitCode, 0);
    QVERIFY2(outcome.err.contains("warning: Cannot receive on UDP port " +
                                  QByteArray::number(blocker.port())),
             outcome.err.constData());
  }

  void mistakesEndWithTwo_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QByteArray>("expected");
    const auto row = [](const char* name, const QStringList& arguments, const char* expected) {
      QTest::newRow(name) << arguments << QByteArray(expected);
    };
    row("address", {"listen", "--bind", "localhost"}, "IPv4");
    row("port base", {"listen", "--port-base", "65530"}, "port base");
    row("referee among the robots", {"listen", "--gamecontroller-port", "1245"}, "GameController");
    row("duration", {"listen", "--duration", "-1"}, "--duration");
    row("sender", {"listen", "--from", "10.0.0.0/40"}, "network");
    row("referee", {"listen", "--referee-from", "host"}, "IPv4");
    row("version", {"listen", "--gamecontroller-version", "3"}, "--gamecontroller-version");
    row("no profile", {"listen", "--profile", "/nonexistent.json"}, "/nonexistent.json");
    row("no file", {"decode", "telemetry", "/nonexistent.txt"}, "/nonexistent.txt");
    row("a folder", {"decode", "gamecontroller", "/"}, "cannot be read");
    row("no kind", {"decode"}, "a command is missing");
    row("no files", {"decode", "telemetry"}, "FILE");
  }
  void mistakesEndWithTwo() {
    QFETCH(QStringList, arguments);
    QFETCH(QByteArray, expected);
    const Outcome outcome = run(arguments);
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.err.startsWith("error: "), outcome.err.constData());
    QVERIFY2(outcome.err.contains(expected), outcome.err.constData());
  }

  void decodesTheCapture() {
    const Outcome outcome = run(
        {"decode", "telemetry", "--json", data + "telemetry/telemetry_capture_1_robot_60s.txt"});
    QCOMPARE(outcome.exitCode, 0);
    const QList<QJsonObject> objects = outcome.objects();
    QCOMPARE(objects.size(), 60);
    QCOMPARE(objects[0]["sender"].toString(), "127.0.0.1:41708");
    QCOMPARE(objects[0]["values"].toObject()["LOCALIZATION_RBT01_X"].toDouble(), 56.3184547424);
  }

  /// Lines are the bytes that a JSON library makes of the same document.
  void decodedLinesAreCompactJson() {
    QTemporaryDir folder;
    QFile profile(folder.filePath("p.json"));
    QVERIFY(profile.open(QIODevice::WriteOnly));
    const auto quoted = [](QByteArray text) { return text.replace('\'', '"'); };
    profile.write(
        quoted("{'name': 't', 'format': 'json', 'fields': ["
               "{'name': 'ID', 'type': 'int', 'meaning': 'robot', 'key': 'id'},"
               "{'name': 'TEMP', 'type': 'float', 'key': 't'},"
               "{'name': 'A', 'type': 'text'}]}"));
    profile.close();
    const QByteArray messages = quoted(
        "{'id': 1, 't': 5, 'A': 'tab\\t, \\', \xc3\xa4, \\u0001', 'x': 0.1, 'y': 1e300, 'x': 7}\n"
        "{'id': 2, 't': -0.0, 'z': 12345678901234567890, 'TEMP': 'word', 'ID': null, '': 1e-7}\n"
        "{'id': 3, 't': 'none'}\n{'id': '\x01'}\nno JSON \\ '\n");
    const QString file = data + "telemetry/telemetry_capture_1_robot_60s.txt";
    const QList<Outcome> outcomes{
        run({"decode", "telemetry", "--json", "--profile", profile.fileName(), "-"}, messages),
        run({"decode", "telemetry", "--json", file}),
        run({"decode", "telemetry", "--json", "-"},
            "1 2 3 OUT\nPB2 1 2 3 A=1 B=0.5 OUT\nPBD1 1\n")};
    int lines = 0;
    for (const Outcome& outcome : outcomes) {
      QVERIFY2(outcome.exitCode == 0 || outcome.exitCode == 1, outcome.err.constData());
      for (const QByteArray& line : outcome.out.split('\n')) {
        if (line.isEmpty()) continue;
        ++lines;
        const auto json = nlohmann::ordered_json::parse(line.toStdString(), nullptr, false);
        QVERIFY2(!json.is_discarded(), line.constData());
        QCOMPARE(QByteArray::fromStdString(json.dump()), line);
      }
    }
    QCOMPARE(lines, 68);
    const QByteArrayList first = outcomes[0].out.split('\n');
    QVERIFY2(first[0].contains(quoted("'x':7,'y':1e+300")), first[0].constData());
  }

  void decodesWithATeamsProfile() {
    QTemporaryDir folder;
    QFile profile(folder.filePath("p.json"));
    QVERIFY(profile.open(QIODevice::WriteOnly));
    profile.write(R"({"name": "t", "fields": [{"name": "ID", "type": "int", "meaning": "robot"},
                      {"name": "TEMP", "type": "float"}]})");
    profile.close();
    const Outcome outcome = run(
        {"decode", "telemetry", "--json", "--profile", profile.fileName(), "-"}, "4 36.5 7 OUT\n");
    QCOMPARE(outcome.exitCode, 0);
    const QJsonObject values = outcome.objects()[0]["values"].toObject();
    QCOMPARE(values["TEMP"].toDouble(), 36.5);
    QCOMPARE(values["OTHER_1"].toInt(), 7);
    QCOMPARE(outcome.objects()[0]["robot"].toInt(), 4);
    const Outcome bad = run({"decode", "telemetry", "-"}, "4 36.5\n");
    QCOMPARE(bad.exitCode, 1);
    QVERIFY(bad.out.contains("too few fields"));
  }

  void aKeyThatNoMessageHasIsReported() {
    QTemporaryDir folder;
    QFile profile(folder.filePath("p.json"));
    QVERIFY(profile.open(QIODevice::WriteOnly));
    profile.write(R"({"name": "t", "format": "json", "fields": [
        {"name": "ID", "type": "int", "meaning": "robot", "key": "id"},
        {"name": "VOLTS", "type": "float", "key": "hw.vot"},
        {"name": "SOMETIMES", "type": "float", "key": "temp"}]})");
    profile.close();
    const Outcome outcome =
        run({"decode", "telemetry", "--profile", profile.fileName(), "-"},
            "{\"id\": 3, \"hw\": {\"volt\": 12.1}}\n{\"id\": 3, \"temp\": 40}\n");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.err, QByteArray("warning: no message has the key \"hw.vot\" of the field "
                                     "VOLTS; did you mean \"hw.volt\"?\n"));
  }

  /// Every value that a recording holds stands in the output under the same name.
  void decodesEveryRecording() {
    QStringList files;
    for (const QString& file : QDir(data + "gamecontroller").entryList({"*.bin"})) {
      files << data + "gamecontroller/" + file;
    }
    const Outcome outcome = run(QStringList{"decode", "gamecontroller", "--json"} + files);
    QCOMPARE(outcome.exitCode, 0);
    const QList<QJsonObject> objects = outcome.objects();
    QCOMPARE(objects.size(), files.size());
    for (int i = 0; i < files.size(); ++i) {
      QFile file(files[i].chopped(3) + "json");
      QVERIFY(file.open(QIODevice::ReadOnly));
      const QJsonValue expected = QJsonDocument::fromJson(file.readAll()).object()["expected"];
      QStringList wrong;
      compare(expected, objects[i], {}, wrong);
      // Not on the wire (tst_gamecontroller says why).
      if (files[i].contains("v7compat")) wrong.removeAll(".gameType");
      QVERIFY2(wrong.isEmpty(), qPrintable(files[i] + wrong.join(' ')));
    }
    const Outcome stream =
        run({"decode", "gamecontroller", "--json", data + "gamecontroller/stream_v12_688.jsonl"});
    QCOMPARE(stream.exitCode, 0);
    QCOMPARE(stream.objects().size(), 149);
  }

  void helpShowsExamples() {
    for (const QStringList& command : {QStringList{"listen", "--help"}, {"decode", "--help"}}) {
      const Outcome outcome = run(command);
      QCOMPARE(outcome.exitCode, 0);
      QVERIFY(outcome.out.contains("Example"));
    }
  }

 private:
  static void compare(const QJsonValue& expected, const QJsonValue& actual, const QString& name,
                      QStringList& wrong) {
    if (expected.isObject()) {
      const QJsonObject object = expected.toObject();
      for (auto it = object.begin(); it != object.end(); ++it) {
        // Remarks of whoever recorded the packet.
        if (it.key() == "notes") continue;
        compare(it.value(), actual.toObject()[it.key()], name + "." + it.key(), wrong);
      }
    } else if (expected.isArray()) {
      const QJsonArray list = expected.toArray();
      if (list.size() != actual.toArray().size()) wrong << name;
      for (int i = 0; i < list.size(); ++i) {
        compare(list[i], actual.toArray()[i], name + QStringLiteral("[%1]").arg(i), wrong);
      }
    } else if (expected != actual) {
      wrong << name;
    }
  }
};

PITCHBOARD_TEST(TestCliLive)

}  // namespace tst_cli_live

#include "tst_cli_live.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// pitchboard-agent beside other programs on a blackboard: what it sends is what they wrote, and
// nothing that happens to them or comes from the network stops it.
#include <elf.h>

#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <bit>
#include <map>
#include <set>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <telemetry/pb2/pb2.h>
#include <telemetry/session/session_reader.h>

#include "../support/program_run.h"
#include "../support/sanitized.h"
#include "../support/segment_keys.h"
#include "../support/session_values.h"
#include "../support/small_disk.h"
#include "../support/test_socket.h"

namespace tst_agent {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

/// The agent, and who listens to it.
class Agent {
 public:
  explicit Agent(const QStringList& options) {
    m_process.setProcessChannelMode(QProcess::SeparateChannels);
    m_process.start(
        QStringLiteral(PITCHBOARD_BIN "/pitchboard-agent"),
        QStringList{"--robot", "3", "--to", QStringLiteral("127.0.0.1:%1").arg(m_socket.port())} +
            options);
  }
  ~Agent() {
    m_process.kill();
    m_process.waitForFinished();
  }

  /// All that has come; false when something of it is not a message.
  bool take() {
    for (std::string text = m_socket.take(); !text.empty(); text = m_socket.take()) {
      const auto message = telemetry::parsePb2(text);
      if (!message) return false;
      ++datagrams;
      if (text.size() > telemetry::Pb2Limits::bytes) return false;
      if (message->status.blackboard) status = message->status;
      for (const auto& value : message->values) {
        values[QByteArray(value.name.data(), static_cast<qsizetype>(value.name.size()))].push_back(
            value.value);
      }
    }
    return true;
  }
  bool hasLast(const QByteArray& name, double value) {
    return take() && !values[name].empty() && values[name].back() == value;
  }
  QString reported() { return m_printed += QString::fromUtf8(m_process.readAllStandardError()); }
  bool runs() const { return m_process.state() == QProcess::Running; }
  /// As kill -9, or the switch of the robot.
  void kill() {
    m_process.kill();
    m_process.waitForFinished();
  }
  /// As systemd ends it. Returns the exit code.
  int end() {
    m_process.terminate();
    return m_process.waitForFinished() && m_process.exitStatus() == QProcess::NormalExit
               ? m_process.exitCode()
               : -1;
  }
  qint64 process() const { return m_process.processId(); }
  const TestSocket& socket() const { return m_socket; }

  std::map<QByteArray, std::vector<double>> values;
  telemetry::Pb2Status status;
  int datagrams = 0;

 private:
  TestSocket m_socket;
  QProcess m_process;
  QString m_printed;
};

using Clock = std::chrono::steady_clock;

struct RecordedValue {
  Clock::time_point at;
  int value = 0;
};

/// The values of a variable in a recording of the agent, each once, with the robot's time.
std::vector<RecordedValue> recorded(const telemetry::SessionReader& session, const char* name) {
  std::vector<RecordedValue> values;
  const std::int64_t zero_us = std::stoll(session.info().more.at("clock_us"));
  session.rows({-1e18, 1e18}, {}, [&](telemetry::GroupId group, const telemetry::RowView& row) {
    const auto& info = session.groups()[group].info;
    const int value = int(telemetry::valueOf(info, row, telemetry::columnOf(info, name)));
    if (!values.empty() && values.back().value == value) return true;
    const auto since = std::chrono::microseconds(zero_us + std::llround(row.time * 1e6));
    values.push_back({Clock::time_point(since), value});
    return true;
  });
  return values;
}

/// A program that uses the segment (tests/support/segment_user.cpp).
class User {
 public:
  User(const char* action, int key) {
    m_process.start(SEGMENT_USER, {action, QString::number(key)});
    good = m_process.waitForReadyRead(30'000) && m_process.readAll().startsWith("y");
  }
  ~User() {
    m_process.kill();
    m_process.waitForFinished();
  }
  bool good;

 private:
  QProcess m_process;
};

/// Names for the words that segment_user writes, one to four bytes.
QString writeCatalog(const QTemporaryDir& folder, const QByteArray& text) {
  QFile file(folder.filePath("map.json"));
  if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size()) return {};
  return file.fileName();
}

}  // namespace

class TestAgent : public QObject {
  Q_OBJECT
 private slots:
  void init() { m_key = testKeyBase() + 300 + 100 * m_number++; }
  void cleanup() { removeSegment(m_key); }

  void itWaitsForTheBlackboard() {
    Agent agent({"--key", QString::number(m_key)});
    QTRY_VERIFY(agent.take() && agent.status.blackboard == false);
    QTRY_VERIFY(agent.reported().contains(QStringLiteral("waiting for blackboard %1").arg(m_key)));
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    board->write(IntVar{17}, 42);
    board->write(FloatVar{2}, -1.25F);
    QTRY_VERIFY(agent.hasLast("DECISION_ACTION_A", 42));
    QTRY_VERIFY(agent.take() && agent.status.blackboard == true);
    // Every variable of the published map, under its name.
    QTRY_COMPARE((agent.take(), agent.values.size()), std::size_t{205});
    for (const Variable& variable : VariableCatalog::published().variables()) {
      QVERIFY(agent.values.contains(QByteArray::fromStdString(variable.name)));
    }
    QVERIFY(SystemVSegments::info(m_key)->attached == 2);
  }

  // A removed segment is read on while the robot's programs use it, and left for a new one.
  void itFollowsANewBlackboard() {
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    Agent agent({"--key", QString::number(m_key)});
    board->write(IntVar{17}, 1);
    QTRY_VERIFY(agent.hasLast("DECISION_ACTION_A", 1));
    QVERIFY(SystemVSegments::remove(m_key));
    board->write(IntVar{17}, 2);
    QTRY_VERIFY(agent.reported().contains("still use it"));
    board->write(IntVar{17}, 3);
    QTRY_VERIFY(agent.hasLast("DECISION_ACTION_A", 3));
    {
      auto second = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
      QVERIFY(second && second->created());
      second->write(IntVar{17}, 4);
      QTRY_VERIFY(agent.hasLast("DECISION_ACTION_A", 4));
      board->write(IntVar{17}, 5);
    }  // removes it, and nobody uses it any more
    QTRY_VERIFY(agent.take() && agent.status.blackboard == false);
    const auto third = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(third);
    QTRY_VERIFY(agent.hasLast("DECISION_ACTION_A", 0));
    const auto& values = agent.values["DECISION_ACTION_A"];
    QVERIFY(std::ranges::find(values, 5.0) == values.end());
    QVERIFY(agent.runs());
  }

  void aSegmentOfAnotherSizeIsReportedOnce() {
    QVERIFY(shmget(m_key, 4096, IPC_CREAT | IPC_EXCL | 0600) >= 0);
    Agent agent({"--key", QString::number(m_key)});
    QTRY_VERIFY(agent.reported().contains("has 4096 bytes, not 2048"));
    QTRY_VERIFY(agent.take() && agent.datagrams >= 2);
    QCOMPARE(agent.reported().count("4096"), 1);
    removeSegment(m_key);
    QVERIFY(SystemVSegments::create(m_key));
    QTRY_VERIFY(agent.take() && agent.status.blackboard == true);
  }

  // Also while the robot's program is killed and started again.
  void whatAProgramWritesIsSentInOrderAndWhole() {
    QTemporaryDir folder;
    const QString map =
        writeCatalog(folder, R"({"int": {"COUNT": 0, "BYTES": 1}, "float": {"SINGLE": 0}})");
    Agent agent({"--key", QString::number(m_key), "--rate", "100", "--catalog", map});
    for (int start = 0; start < 3; ++start) {
      const User writer("count", m_key);
      QVERIFY(writer.good);
      const std::size_t before = agent.values["COUNT"].size();
      QTRY_VERIFY(agent.take() && agent.values["COUNT"].size() >= before + 60);
    }
    // Counted by a word of 32 bits, which goes round.
    const std::vector<double>& counts = agent.values["COUNT"];
    for (std::size_t i = 1; i < counts.size(); ++i) {
      const auto step = static_cast<std::int64_t>(counts[i] - counts[i - 1]);
      QVERIFY2(static_cast<std::int32_t>(step) >= 0,
               qPrintable(QStringLiteral("%1 after %2").arg(counts[i]).arg(counts[i - 1])));
    }
    std::set<double> seen;
    for (const double value : agent.values["BYTES"]) {
      const auto word = static_cast<std::uint32_t>(static_cast<std::int32_t>(value));
      QVERIFY2(word == (word & 0xffU) * 0x01010101U, qPrintable(QString::number(word, 16)));
      seen.insert(value);
    }
    QVERIFY(seen.size() > 20);
    seen.clear();
    for (const double value : agent.values["SINGLE"]) {
      const auto word = std::bit_cast<std::uint32_t>(static_cast<float>(value));
      QVERIFY2(word == 0 || word == (0x3f000000U | (word & 0xffU) * 0x00010101U),
               qPrintable(QString::number(word, 16)));
      seen.insert(value);
    }
    QVERIFY(seen.size() > 20);
  }

  void nothingFromTheNetworkReachesIt() {
    QVERIFY(SystemVSegments::create(m_key));
    Agent agent({"--key", QString::number(m_key)});
    sockaddr_in from{};
    const auto received = [&] {
      char buffer[2000];
      socklen_t length = sizeof from;
      return recvfrom(agent.socket().descriptor(), buffer, sizeof buffer, MSG_DONTWAIT,
                      reinterpret_cast<sockaddr*>(&from), &length) > 0;
    };
    QTRY_VERIFY(received());
    for (int i = 0; i < 2000; ++i) {
      QVERIFY(agent.socket().send(
          ntohs(from.sin_port),
          std::string(1 + static_cast<std::size_t>(i) % 1500, static_cast<char>(i))));
    }
    const int before = agent.datagrams;
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOnly);
    QVERIFY(board);
    board->write(IntVar{17}, 77);
    QTRY_VERIFY(agent.hasLast("DECISION_ACTION_A", 77));
    QTRY_VERIFY(agent.take() && agent.datagrams > before + 20);
    QVERIFY(agent.runs());
    for (int word = 0; word < 125; ++word) {
      if (word != 17) QCOMPARE(board->read(IntVar{word}), 0);
    }
  }

  // A map of a thousand made-up names, in a segment of its own size.
  void aThousandNames() {
    QTemporaryDir folder;
    QByteArray text = R"({"segment": {"bytes": 8192, "float_offset_words": 1024}, "int": {)";
    for (int i = 0; i < 1000; ++i) {
      text += (i == 0 ? "" : ", ") +
              ('"' + QByteArray("MADE_UP_").append(50, static_cast<char>('A' + i % 26))) +
              QByteArray::number(i) + "\": " + QByteArray::number(i);
    }
    const QString map = writeCatalog(folder, text + "}, \"float\": {}}");
    const int shmid = shmget(m_key, 8192, IPC_CREAT | IPC_EXCL | 0600);
    QVERIFY(shmid >= 0);
    auto* const words = static_cast<std::int32_t*>(shmat(shmid, nullptr, 0));
    for (int i = 0; i < 1000; ++i) words[i] = i * 7;
    Agent agent({"--key", QString::number(m_key), "--catalog", map, "--limit", "500"});
    QTRY_COMPARE((agent.take(), agent.values.size()), std::size_t{1000});
    for (const auto& [name, values] : agent.values) {
      QCOMPARE(values.back(), name.mid(58).toInt() * 7.0);
    }
    shmdt(words);
  }

  void everyReceiverGetsTheSame() {
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    board->write(IntVar{17}, 42);
    const TestSocket second;
    Agent agent({"--key", QString::number(m_key), "--to",
                 QStringLiteral("127.0.0.1:%1").arg(second.port())});
    for (int i = 0; i < 5; ++i) {
      QTRY_VERIFY(second.received() && agent.socket().received());
      QCOMPARE(second.take(), agent.socket().take());
    }
  }

  // What is sent was read, so it must be recorded, too.
  void killedItHasAllButTheLastSecond_data() {
    QTest::addColumn<QString>("rate");
    for (const char* rate : {"100", "500"}) QTest::newRow(rate) << rate;
  }
  void killedItHasAllButTheLastSecond() {
    QFETCH(QString, rate);
    QTemporaryDir folder;
    const QString path = folder.filePath("flight.mcap");
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    Agent agent({"--key", QString::number(m_key), "--rate", "100", "--record", path,
                 "--record-rate", rate});
    std::vector<Clock::time_point> read{Clock::now()};
    const auto from = Clock::now();
    for (int value = 1; Clock::now() < from + std::chrono::seconds(3); ++value) {
      board->write(IntVar{17}, value);
      QTRY_VERIFY(agent.hasLast("DECISION_ACTION_A", value));
      read.push_back(Clock::now());
    }
    agent.kill();
    const auto killed = Clock::now();
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session && session->ours() && !session->complete() && !session->isDamaged());
    const auto values = recorded(*session, "DECISION_ACTION_A");
    QVERIFY(read.size() > 50 && !values.empty());
    const int first = values.front().value;
    QVERIFY(first <= 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
      QCOMPARE(values[i].value, first + int(i));  // each, in order
      QVERIFY(values[i].at <= read[std::size_t(values[i].value)]);
    }
    std::size_t safe = 0;
    while (safe < read.size() && read[safe] < killed - std::chrono::seconds(1)) ++safe;
    QVERIFY2(values.back().value + 1 >= int(safe), qPrintable(QString::number(read.size())));
  }

  void aFullDiskEndsTheRecordingAndNotTheSending() {
    QTemporaryDir folder;
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    std::optional<SmallDisk> disk(std::in_place, rlim_t{120'000});
    Agent agent({"--key", QString::number(m_key), "--rate", "100", "--record",
                 folder.filePath("flight.mcap")});
    QTRY_VERIFY(agent.reported().contains("recording to"));
    disk.reset();
    std::uint32_t value = 1;
    const auto busy = [&] {
      for (int i = 0; i < 120; ++i) {
        value = value * 1664525U + 1013904223U;
        board->write(FloatVar{i}, static_cast<float>(value >> 8));
      }
      return agent.take() && agent.reported().contains("Recording stopped.");
    };
    QTRY_VERIFY(busy());
    board->write(IntVar{17}, 42);
    QTRY_VERIFY(agent.hasLast("DECISION_ACTION_A", 42));
    QVERIFY(agent.runs());
    QCOMPARE(agent.reported().count("Recording stopped."), 1);
    const auto session =
        telemetry::SessionReader::open(folder.filePath("flight.mcap").toStdString());
    QVERIFY(session && session->ours() && session->groups()[0].rows > 10);
  }

  // Without a network, and with a blackboard that is made again; as a service ends it.
  void itRecordsAloneAndEndsItsFile() {
    QTemporaryDir folder;
    const QString path = folder.filePath("flight.mcap");
    QProcess agent;
    agent.start(
        QStringLiteral(PITCHBOARD_BIN "/pitchboard-agent"),
        {"--robot", "3", "--key", QString::number(m_key), "--to", "none", "--record", path});
    QByteArray reported;
    const auto says = [&](const char* text) {
      reported += agent.readAllStandardError();
      return reported.contains(text);
    };
    const auto has = [&](int value) {  // in the file while it grows
      const auto session = telemetry::SessionReader::open(path.toStdString());
      if (!session || session->groups().empty()) return false;
      const auto values = recorded(*session, "DECISION_ACTION_A");
      return !values.empty() && values.back().value == value;
    };
    QTRY_VERIFY(says("waiting for blackboard"));
    for (const int value : {1, 2}) {
      auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
      QVERIFY(board && board->created());
      board->write(IntVar{17}, value);
      QTRY_VERIFY(has(value));
    }  // removes it
    agent.terminate();
    QVERIFY(agent.waitForFinished());
    QCOMPARE(agent.exitStatus(), QProcess::NormalExit);
    QCOMPARE(agent.exitCode(), 0);
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session && session->complete());
    std::vector<int> values;
    for (const auto& one : recorded(*session, "DECISION_ACTION_A")) values.push_back(one.value);
    std::erase(values, 0);
    QVERIFY((values == std::vector<int>{1, 2}));
    QVERIFY(session->count(telemetry::SessionStream::Log) >= 2);
  }

  void aFileThatExistsIsRefused() {
    QTemporaryDir folder;
    QFile file(folder.filePath("flight.mcap"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    const ProgramRun run = runProgram(
        "pitchboard-agent", {"--robot", "3", "--to", "127.0.0.1", "--record", file.fileName()});
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.contains("this file exists; choose another name"), run.err.constData());
    QCOMPARE(QFileInfo(file.fileName()).size(), 0);
    const ProgramRun nowhere = runProgram(
        "pitchboard-agent", {"--robot", "3", "--to", "none", "--record", "/none/flight.mcap"});
    QCOMPARE(nowhere.exitCode, 2);
    QVERIFY2(nowhere.err.contains("The folder does not exist"), nowhere.err.constData());
  }

  void itIsOneSmallStaticProgram() {
#if PITCHBOARD_SANITIZED
    QSKIP("with sanitizers it is neither");
#endif
    QFile program(PITCHBOARD_BIN "/pitchboard-agent");
    QVERIFY(program.open(QIODevice::ReadOnly));
    QVERIFY2(program.size() < 3'000'000, qPrintable(QString::number(program.size())));
    const QByteArray elf = program.readAll();
    const auto* const head = reinterpret_cast<const Elf64_Ehdr*>(elf.constData());
    const auto* const parts = reinterpret_cast<const Elf64_Phdr*>(elf.constData() + head->e_phoff);
    for (int i = 0; i < head->e_phnum; ++i) QVERIFY2(parts[i].p_type != PT_INTERP, "not static");
    // All that it ever takes, with every variable changing at 50 Hz.
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    Agent agent({"--key", QString::number(m_key), "--rate", "50"});
    int value = 0;
    const auto busy = [&] {
      ++value;
      for (int i = 0; i < 80; ++i) board->write(IntVar{i}, value);
      for (int i = 0; i < 120; ++i) board->write(FloatVar{i}, 0.1F * static_cast<float>(value));
      return agent.take() && agent.datagrams > 100;
    };
    QTRY_VERIFY(busy());
    QFile status(QStringLiteral("/proc/%1/status").arg(agent.process()));
    QVERIFY(status.open(QIODevice::ReadOnly));
    static const QRegularExpression most("VmHWM:\\s+(\\d+) kB");
    const auto found = most.match(QString::fromUtf8(status.readAll()));
    QVERIFY(found.hasMatch());
    QVERIFY2(found.captured(1).toInt() <= 4096, qPrintable(found.captured()));
  }

  // With every variable changing at 500 Hz.
  void recordingTakesLittleMemory() {
#if PITCHBOARD_SANITIZED
    QSKIP("with sanitizers it takes more");
#endif
    QTemporaryDir folder;
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    Agent agent({"--key", QString::number(m_key), "--rate", "100", "--record",
                 folder.filePath("flight.mcap"), "--record-rate", "500"});
    int value = 0;
    const auto busy = [&] {
      ++value;
      for (int i = 0; i < 80; ++i) board->write(IntVar{i}, value);
      for (int i = 0; i < 120; ++i) board->write(FloatVar{i}, 0.1F * static_cast<float>(value));
      return agent.take() && agent.datagrams > 2000;
    };
    QTRY_VERIFY(busy());
    QFile status(QStringLiteral("/proc/%1/status").arg(agent.process()));
    QVERIFY(status.open(QIODevice::ReadOnly));
    static const QRegularExpression most("VmHWM:\\s+(\\d+) kB");
    const auto found = most.match(QString::fromUtf8(status.readAll()));
    QVERIFY(found.hasMatch());
    QVERIFY2(found.captured(1).toInt() <= 12'288, qPrintable(found.captured()));
    QCOMPARE(agent.end(), 0);
  }

 private:
  int m_key = 0, m_number = 0;
};

PITCHBOARD_TEST(TestAgent)

}  // namespace tst_agent

#include "tst_agent.moc"

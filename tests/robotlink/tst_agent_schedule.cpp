// SPDX-License-Identifier: GPL-3.0-or-later
// What the agent on a robot sends and when, with made-up values and a made-up clock; and how it
// reads its command line.
#include <QtTest>
#include <algorithm>
#include <deque>
#include <map>
#include <set>

#include <agent/arguments.h>
#include <agent/output.h>
#include <agent/schedule.h>

namespace tst_agent_schedule {

using namespace pitchboard;
using namespace pitchboard::agent;
using link::Variable;
using link::VariableType;
using telemetry::Pb2Message;

namespace {

constexpr Time tick = std::chrono::milliseconds(50);
constexpr Time second = std::chrono::seconds(1);

std::vector<Variable> variables(int count, int nameLength = 12) {
  std::vector<Variable> made;
  for (int i = 0; i < count; ++i) {
    std::string name = "V" + std::to_string(i) + "_";
    name.resize(static_cast<std::size_t>(nameLength), 'X');
    made.push_back({name, VariableType::Int, i});
  }
  return made;
}

/// A schedule, its clock, and all that it has sent.
struct Rig {
  struct Sent {
    Time at;
    double value;
  };
  explicit Rig(int count, double bytesPerSecond = 0.0, int receivers = 1, int nameLength = 12)
      : receiversCount(receivers),
        schedule(
            {.robot = 3, .rate = 20.0, .bytesPerSecond = bytesPerSecond, .receivers = receivers},
            variables(count, nameLength)),
        words(static_cast<std::size_t>(count)) {}

  void step() {
    for (const std::string& text :
         schedule.next(now, there ? words : std::vector<std::uint32_t>())) {
      const auto message = telemetry::parsePb2(text);
      QVERIFY2(message, message ? "" : message.error().text().c_str());
      QVERIFY(text.size() <= telemetry::Pb2Limits::bytes);
      QCOMPARE(message->robot, 3);
      QCOMPARE(message->sequence, sequence++);
      QCOMPARE(message->milliseconds, static_cast<std::uint64_t>(now.count() / 1000));
      for (const auto& value : message->values) {
        sent[std::string(value.name)].push_back({now, value.value});
      }
      if (message->status.blackboard) {
        status = message->status;
        statusTimes.push_back(now);
      }
      const double bytes = static_cast<double>(text.size() + 28) * receiversCount;
      total += bytes;
      lastSecond.push_back({now, bytes});
    }
    while (!lastSecond.empty() && now - lastSecond.front().at > second) lastSecond.pop_front();
    double inSecond = 0.0;
    for (const Sent& one : lastSecond) inSecond += one.value;
    busiest = std::max(busiest, inSecond);
    now += tick;
  }
  Time maxGap(int variable) {
    const auto& list = sent[schedule.variables()[static_cast<std::size_t>(variable)].name];
    Time gap{}, last{};
    for (const Sent& one : list) {
      gap = std::max(gap, one.at - last);
      last = one.at;
    }
    return std::max(gap, now - last);
  }

  int receiversCount;
  Schedule schedule;
  std::vector<std::uint32_t> words;
  bool there = true;
  Time now{};
  std::uint32_t sequence = 0;
  std::map<std::string, std::vector<Sent>> sent;
  telemetry::Pb2Status status;
  std::vector<Time> statusTimes;
  std::deque<Sent> lastSecond;
  double total = 0.0, busiest = 0.0;
};

}  // namespace

class TestAgentSchedule : public QObject {
  Q_OBJECT
 private slots:
  void aChangeIsSentAtOnceAndOnce() {
    Rig rig(3);
    rig.step();
    QCOMPARE(rig.sent.size(), std::size_t{3});
    const std::string name = rig.schedule.variables()[1].name;
    for (const std::uint32_t value : {5U, 6U, 6U, 7U}) {
      rig.words[1] = value;
      rig.step();
    }
    std::vector<double> values;
    for (const auto& one : rig.sent[name]) values.push_back(one.value);
    QVERIFY((values == std::vector<double>{0, 5, 6, 7}));
    QCOMPARE(rig.sent[name][3].at, 4 * tick);
  }

  /// What a datagram itself brings does not wait.
  void nothingWaitsWithoutALimit() {
    Rig rig(200);
    while (rig.now < 5 * second) {
      for (std::uint32_t& word : rig.words) ++word;
      rig.step();
      if (rig.status.waiting) QCOMPARE(*rig.status.waiting, std::int64_t{0});
    }
    QVERIFY(rig.statusTimes.size() >= 4);
  }

  void everyValueIsSentEveryTwoSecondsSpreadEvenly() {
    Rig rig(200);
    std::size_t before = 0, most = 0;
    while (rig.now < 20 * second) {
      rig.step();
      std::size_t count = 0;
      for (const auto& [name, list] : rig.sent) count += list.size();
      if (rig.now > tick) most = std::max(most, count - before);
      before = count;
    }
    for (int i = 0; i < 200; ++i) {
      QVERIFY2(rig.maxGap(i) <= 2 * second, qPrintable(QString::number(i)));
    }
    // 200 values in 1.9 s, ten steps a second.
    QVERIFY2(most <= 16, qPrintable(QString::number(most)));
    // The status is told once a second, with values and not in datagrams of its own.
    QVERIFY(rig.statusTimes.size() >= 18 && rig.statusTimes.size() <= 21);
    QVERIFY(rig.status.refresh_ms == 2000 && rig.status.waiting == 0);
    QVERIFY(rig.sequence < 12 * 20);
  }

  void theLimitIsKeptInEverySecond_data() {
    QTest::addColumn<int>("kbit");
    QTest::addColumn<int>("receivers");
    for (const int kbit : {16, 17, 32, 64, 100, 1000}) {
      for (const int receivers : {1, 3}) {
        QTest::addRow("%d kbit/s, %d receivers", kbit, receivers) << kbit << receivers;
      }
    }
  }
  void theLimitIsKeptInEverySecond() {
    QFETCH(int, kbit);
    QFETCH(int, receivers);
    const double limit = kbit * 125.0 * receivers;
    Rig rig(200, limit, receivers, 64);  // names of the greatest length
    // Silence, bursts and full load by turns.
    for (int step = 0; rig.now < 60 * second; ++step) {
      const bool busy = step % 400 > 200 || step % 37 == 0;
      for (std::size_t i = 0; busy && i < rig.words.size(); ++i) rig.words[i] += 1'000'003U;
      rig.step();
    }
    QVERIFY2(rig.busiest <= limit, qPrintable(QString::number(rig.busiest)));
    // And it is used: half of the time there is more to send than fits.
    if (kbit <= 100) QVERIFY2(rig.total > limit * 60 * 0.8, qPrintable(QString::number(rig.total)));
    for (int i = 0; i < 200; ++i) QVERIFY(rig.maxGap(i) < 60 * second);
  }

  // 100 variables change all the time, and 100 never: these are sent by the refresh alone.
  void aQuarterIsKeptForTheRefresh() {
    constexpr double limit = 4000.0;
    Rig rig(200, limit);
    while (rig.now < 10 * second) rig.step();  // all is known
    rig.sent.clear();
    const Time from = rig.now;
    Time reported{};
    while (rig.now < from + 60 * second) {
      for (std::size_t i = 0; i < 100; ++i) ++rig.words[i];
      rig.step();
      reported = std::max<Time>(reported, std::chrono::milliseconds(rig.status.refresh_ms.value()));
    }
    QVERIFY(rig.status.waiting.value() > 0);
    QVERIFY(rig.schedule.waiting() > 0);
    // Twelve letters and a number of four, in turn with what changes: 200 fields of at most 18
    // bytes, and headers for up to ten datagrams a second.
    const double bound = 200 * 18 / (limit / 4 - 10 * 60);
    QVERIFY2(reported > 2 * second, "it grows");
    for (int i = 100; i < 200; ++i) {
      const auto& list = rig.sent[rig.schedule.variables()[static_cast<std::size_t>(i)].name];
      QVERIFY(static_cast<double>(list.size()) >= 60 / bound - 2);
      for (std::size_t k = 1; k < list.size(); ++k) {
        const Time gap = list[k].at - list[k - 1].at;
        QVERIFY2(gap <= reported + 4 * tick, qPrintable(QString::number(gap.count())));
        QVERIFY2(static_cast<double>(gap.count()) < bound * 1e6,
                 qPrintable(QString::number(gap.count())));
      }
    }
    QVERIFY(rig.busiest <= limit);
    // What waits is served in turn (the refresh sends it, too), and the newest value is sent.
    std::size_t fewest = SIZE_MAX, most = 0;
    for (std::size_t i = 0; i < 100; ++i) {
      const auto& list = rig.sent[rig.schedule.variables()[i].name];
      fewest = std::min(fewest, list.size());
      most = std::max(most, list.size());
      for (const auto& one : list) QCOMPARE(one.value, double((one.at - from) / tick + 1));
    }
    QVERIFY2(fewest * 10 >= most * 7, qPrintable(QStringLiteral("%1 %2").arg(fewest).arg(most)));
    // With nothing left to wait for, the period is the usual one again.
    while (rig.now < from + 80 * second) rig.step();
    QVERIFY(rig.status.waiting == 0 && rig.status.refresh_ms == 2000);
  }

  void aThousandVariablesOfTheLongestNames() {
    Rig rig(1000, 0.0, 1, 64);
    while (rig.now < 5 * second) {
      for (std::uint32_t& word : rig.words) word += 0x01234567U;
      rig.step();
    }
    QCOMPARE(rig.sent.size(), std::size_t{1000});
    for (const auto& [name, list] : rig.sent) QCOMPARE(list.size(), std::size_t{100});
    QVERIFY(rig.schedule.waiting() == 0);
  }

  void aBlackboardThatGoesIsReported() {
    Rig rig(20);
    rig.there = false;
    for (int i = 0; i < 50; ++i) rig.step();
    QVERIFY(rig.sent.empty() && rig.status.blackboard == false);
    QCOMPARE(rig.statusTimes.size(), std::size_t{3});
    rig.there = true;
    rig.step();
    QVERIFY(rig.status.blackboard == true);
    QCOMPARE(rig.sent.size(), std::size_t{20});
    for (int i = 0; i < 60; ++i) rig.step();
    rig.there = false;
    rig.step();
    QVERIFY(rig.status.blackboard == false);
    rig.sent.clear();
    rig.there = true;
    rig.words[4] = 9;
    rig.step();
    // What stayed the same need not be sent at once.
    QVERIFY(rig.sent.contains(rig.schedule.variables()[4].name) && rig.sent.size() <= 2);
  }

  void globs() {
    QVERIFY(matchesGlob("*", "") && matchesGlob("*", "A") && matchesGlob("A*", "A"));
    QVERIFY(matchesGlob("VISION_*_X", "VISION_A_X_X") && !matchesGlob("VISION_*_X", "VISION_X"));
    QVERIFY(matchesGlob("?B", "AB") && !matchesGlob("?B", "B") && !matchesGlob("", "B"));
    QVERIFY(matchesGlob("*a*b*c", "xaxbxc") && !matchesGlob("*a*b*c", "xaxbx"));
    const auto& catalog = link::VariableCatalog::published();
    const std::vector<std::string> some{"IMU_EULER_?", "VOLTAGE"};
    const auto chosen = chosenVariables(catalog, some);
    QVERIFY(chosen);
    QCOMPARE(chosen->size(), std::size_t{4});
    QCOMPARE(chosenVariables(catalog, {})->size(), catalog.variables().size());
    const std::vector<std::string> none{"VOLTAGE", "FOO*"};
    const auto refused = chosenVariables(catalog, none);
    QVERIFY(!refused && refused.error().message.find("\"FOO*\"") != std::string::npos);
  }

  void theCommandLine() {
    const char* const words[] = {"--robot=7", "--to",  "10.0.0.1", "--to",      "broadcast:9",
                                 "--rate",    "50",    "--limit",  "64",        "--variables",
                                 "A*,B",      "--key", "4711",     "--catalog", "my_board.h"};
    const auto read = parseArguments(words);
    QVERIFY2(read, read ? "" : read.error().text().c_str());
    QCOMPARE(read->robot, 7);
    QVERIFY(read->key == 4711 && read->rate == 50.0 && read->limit == 64.0);
    QVERIFY((read->globs == std::vector<std::string>{"A*", "B"}) && read->catalog == "my_board.h");
    QCOMPARE(read->receivers.size(), std::size_t{2});
    QVERIFY(read->receivers[0].address.value == 0x0a000001 && !read->receivers[0].port);
    QVERIFY(read->receivers[1].address.value == 0xffffffff && read->receivers[1].port == 9);
    QVERIFY(read->sends && read->record.empty() && read->readRate() == 50.0);
    const char* const record[] = {"--robot",           "7",   "--record",      "a.mcap",
                                  "--record-rate",     "500", "--record-size", "50",
                                  "--record-keep=1000"};
    const auto recording = parseArguments(record);
    QVERIFY(recording && recording->sends && recording->record == "a.mcap");
    QVERIFY(recording->recordSize == 50.0 && recording->recordKeep == 1000.0);
    QVERIFY(recording->readRate() == 500.0 && recording->rate == 20.0);
    const char* const alone[] = {"--robot", "7", "--to", "none", "--record", "a.mcap"};
    const auto silent = parseArguments(alone);
    QVERIFY(silent && !silent->sends && silent->receivers.empty() && silent->readRate() == 100.0);
    const char* const least[] = {"--robot", "1"};
    QVERIFY(parseArguments(least)->receivers[0].address.value == 0xffffffff);
  }
  void theCommandLineIsRefused_data() {
    QTest::addColumn<QStringList>("words");
    QTest::addColumn<QString>("hasText");
    const auto row = [](const QStringList& words, const char* hasText) {
      QTest::newRow(qPrintable(words.join(' '))) << words << QString(hasText);
    };
    row({}, "--robot is missing");
    row({"--robot"}, "--robot needs a value");
    row({"--robot", "0"}, "1 to 64");
    row({"--robot", "1x"}, "not \"1x\"");
    row({"--robot", "1", "--rate", "nan"}, "1 to 100 Hz");
    row({"--robot", "1", "--rate", "0.5"}, "1 to 100 Hz");
    row({"--robot", "1", "--limit", "15"}, "16 to 1000000");
    row({"--robot", "1", "--limit", "20", "--to", "10.0.0.1", "--to", "10.0.0.2"}, "each of the 2");
    row({"--robot", "1", "--to", "localhost"}, "192.168.0.7");
    row({"--robot", "1", "--to", "10.0.0.1:0"}, "the port of --to must be 1 to 65535");
    row({"--robot", "1", "--to", "10.0.0.1:"}, "the port of --to");
    row({"--robot", "1", "--variables", "A,,B"}, "empty name");
    row({"--robot", "1", "--to", "none"}, "add --record FILE");
    row({"--robot", "1", "--to", "none", "--to", "10.0.0.1", "--record", "a.mcap"}, "another --to");
    row({"--robot", "1", "--record", ""}, "--record needs the name");
    row({"--robot", "1", "--record", "a.mcap", "--record-rate", "501"}, "1 to 500 Hz");
    row({"--robot", "1", "--record", "a.mcap", "--record-size", "0"}, "1 to 1000000 MB");
    row({"--robot", "1", "--record", "a", "--record-keep", "199"}, "at least twice --record-size");
    row({"--robot", "1", "--record-rate", "50"}, "add --record FILE");
    row({"--robot", "1", "--frobnicate"}, "no option \"--frobnicate\"");
    row({"1"}, "no option \"1\"");
  }
  void theCommandLineIsRefused() {
    QFETCH(QStringList, words);
    QFETCH(QString, hasText);
    std::vector<QByteArray> bytes;
    for (const QString& word : words) bytes.push_back(word.toUtf8());
    std::vector<const char*> pointers;
    for (const QByteArray& one : bytes) pointers.push_back(one.constData());
    const auto read = parseArguments(pointers);
    QVERIFY(!read);
    const QString error = QString::fromStdString(read.error().text());
    QVERIFY2(error.contains(hasText), qPrintable(error));
  }

  void aNetworkThatFailsIsReportedOnce() {
    auto output = Output::to({0x7f000001}, 9);
    QVERIFY(output);
    const std::string tooLong(70'000, 'x');
    QCOMPARE(output->send("x", second), std::string());
    const QString reported = QString::fromStdString(output->send(tooLong, 2 * second));
    QVERIFY2(reported.startsWith("cannot send to 127.0.0.1:9: "), qPrintable(reported));
    QCOMPARE(output->send(tooLong, 3 * second), std::string());
    // One that works between two that fail says nothing.
    QCOMPARE(output->send("x", 4 * second), std::string());
    QCOMPARE(output->send(tooLong, 4 * second), std::string());
    QCOMPARE(output->send("x", 5 * second), std::string());
    QCOMPARE(output->send("x", 7 * second), std::string("sending to 127.0.0.1:9 works again"));
    QVERIFY(!output->send(tooLong, 8 * second).empty());
  }
};

PITCHBOARD_TEST(TestAgentSchedule)

}  // namespace tst_agent_schedule

#include "tst_agent_schedule.moc"

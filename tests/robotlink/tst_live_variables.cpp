// SPDX-License-Identifier: GPL-3.0-or-later
// pitchboard-agent into Live, over a network that loses, doubles and reorders: what is shown is
// what stands on the robot's blackboard.

#include <QProcess>
#include <QtTest>
#include <algorithm>
#include <bit>
#include <cmath>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/live/live_watch.h>
#include <telemetry/formats/text_protocol.h>
#include <telemetry/series/series_store.h>

#include "../support/guide_programs.h"
#include "../support/segment_keys.h"
#include "../support/test_socket.h"
#include "../support/udp_relay.h"
#include "live_ports.h"

namespace tst_live_variables {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

class Agent {
 public:
  Agent(int robot, int key, std::uint16_t port, const QStringList& more = {}) {
    m_process.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-agent"),
                    QStringList{"--robot", QString::number(robot), "--key", QString::number(key),
                                "--to", QStringLiteral("127.0.0.1:%1").arg(port)} +
                        more);
  }
  ~Agent() {
    m_process.kill();
    m_process.waitForFinished();
  }

 private:
  QProcess m_process;
};

/// Live, and its rows.
class Studio {
 public:
  Studio() : options(optionsOfTest()), watch(options), m_rows(std::make_shared<Rows>(store)) {
    watch.observe(m_rows);
  }
  std::uint16_t port(int robot) const {
    return static_cast<std::uint16_t>(options.variablesPortBase + robot);
  }
  /// The newest value, and since when it is so; false when there is none.
  bool latest(const std::string& robot, const std::string& name, double& value,
              double* since = nullptr) const {
    const auto id = store->find(robot, name);
    if (!id) return false;
    const auto view = store->view(id->group);
    const auto found = view->latest(id->column);
    if (!found) return false;
    value = found->value;
    if (since != nullptr) *since = view->lastChange(id->column).value_or(0.0);
    return true;
  }
  /// Every variable is what stands on the board.
  bool shows(const std::string& robot, const Blackboard& board) const {
    for (const Variable& variable : VariableCatalog::published().variables()) {
      const double there = variable.type == VariableType::Int
                               ? static_cast<double>(board.read(IntVar{variable.index}))
                               : static_cast<double>(board.read(FloatVar{variable.index}));
      double value = 0.0;
      if (!latest(robot, variable.name, value)) return false;
      if (!(value == there || (std::isnan(value) && there == -1.0))) return false;
    }
    return true;
  }
  SentStatus sent(std::size_t place = 0) const {
    const auto all = watch.details().sent;
    return place < all.size() ? all[place] : SentStatus{};
  }

  static LiveOptions optionsOfTest() {
    LiveOptions made = freeOptions(4);
    made.variablesPortBase = made.refereePort;
    made.team.teams.emplace_back().colour = "blue";
    return made;
  }

  const LiveOptions options;
  std::shared_ptr<telemetry::SeriesStore> store = std::make_shared<telemetry::SeriesStore>();
  LiveWatch watch;

 private:
  struct Rows : LiveObserver {
    explicit Rows(std::shared_ptr<telemetry::RowSink> sink) : m_sink(std::move(sink)) {}
    std::shared_ptr<telemetry::RowSink> rows() override { return m_sink; }
    std::shared_ptr<telemetry::RowSink> m_sink;
  };
  std::shared_ptr<Rows> m_rows;
};

/// Another value in every word.
void fill(Blackboard& board, int round) {
  for (const Variable& variable : VariableCatalog::published().variables()) {
    if (variable.type == VariableType::Int) {
      board.write(IntVar{variable.index}, 1000 * round + variable.index);
    } else {
      board.write(FloatVar{variable.index},
                  static_cast<float>(round) + 0.001F * static_cast<float>(variable.index));
    }
  }
}

}  // namespace

class TestLiveVariables : public QObject {
  Q_OBJECT
 private slots:
  void init() { m_key = testKeyBase() + 340 + 100 * m_number++; }
  void cleanup() { removeSegment(m_key); }

  void afterLossAndAnOutageEveryVariableIsRight() {
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    fill(*board, 1);
    const Studio studio;
    UdpRelay relay(studio.port(3), {.loss = 0.3, .twice = 0.1, .late = 0.2});
    const Agent agent(3, m_key, relay.port());
    QTRY_VERIFY_WITH_TIMEOUT(studio.shows("B3", *board), 30'000);
    // While values change on a bad network.
    for (int round = 2; round < 60; ++round) {
      fill(*board, round);
      const int received = relay.received();
      QTRY_VERIFY(relay.received() >= received + 2);
    }
    const SentStatus before = studio.sent();
    QVERIFY(before.link.lost > 10 && before.link.duplicates > 0 && before.link.late > 0);
    QVERIFY(before.link.loss > 0.1 && before.link.loss < 0.5);
    QCOMPARE(before.variables, std::size_t(205));
    // Rows are in the order of the robot's time, and every value is one that was written.
    const auto group = studio.store->findGroup("B3");
    const auto view = studio.store->view(*group);
    std::vector<telemetry::Sample> samples;
    const auto column = studio.store->find("B3", "DECISION_ACTION_A")->column;
    const int index = VariableCatalog::published().find("DECISION_ACTION_A")->index;
    view->samples(column, *view->range(), samples);
    // Rows begin with the first variable that comes, which need not be this one.
    const auto isKnown = [](const telemetry::Sample& sample) { return !std::isnan(sample.value); };
    samples.erase(samples.begin(), std::ranges::find_if(samples, isKnown));
    QVERIFY(samples.size() > 20);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      QVERIFY(samples[i].time >= samples[i - 1].time && samples[i].value >= samples[i - 1].value);
      QCOMPARE(static_cast<int>(samples[i].value) % 1000, index);
    }

    QElapsedTimer outage;
    outage.start();
    relay.fail(true);
    const double newest = view->range()->end;  // before the outage
    fill(*board, 100);
    const int received = relay.received();
    QTRY_VERIFY(relay.received() >= received + 20);
    QVERIFY(!studio.shows("B3", *board));
    relay.heal();
    relay.fail(false);
    QTRY_VERIFY_WITH_TIMEOUT(studio.shows("B3", *board), 30'000);
    // Every variable has come again, and its time is that of the robot, not one that is made up for
    // the gap.
    double last = 0.0;
    for (const Variable& variable : VariableCatalog::published().variables()) {
      double value = 0.0, since = 0.0;
      QVERIFY(studio.latest("B3", variable.name, value, &since));
      last = std::max(last, since);
    }
    QVERIFY2(last > newest && last - newest < 1e-3 * double(outage.elapsed()) + 0.5,
             qPrintable(QString::number(last - newest)));
  }

  /// Two agents look at one blackboard, with clocks that are eleven days apart.
  void curvesOfTwoRobotsLineUp() {
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    const Studio studio;
    UdpRelay usual(studio.port(3), {.loss = 0.1, .late = 0.1});
    UdpRelay ahead(studio.port(4), {.loss = 0.1, .late = 0.1, .clockAhead = 1'000'000'000});
    const Agent one(3, m_key, usual.port(), {"--rate", "100"});
    const Agent other(4, m_key, ahead.port(), {"--rate", "100"});
    const auto variable = *VariableCatalog::published().intVar("DECISION_ACTION_A");
    double shown = 0.0;
    QTRY_VERIFY_WITH_TIMEOUT(studio.latest("B3", "DECISION_ACTION_A", shown) &&
                                 studio.latest("B4", "DECISION_ACTION_A", shown),
                             30'000);
    std::vector<double> apart;
    for (int value = 1; value <= 30; ++value) {
      board->write(variable, value);
      double a = 0.0, b = 0.0, sinceA = 0.0, sinceB = 0.0;
      const auto haveCome = [&] {
        return studio.latest("B3", "DECISION_ACTION_A", a, &sinceA) && a == value &&
               studio.latest("B4", "DECISION_ACTION_A", b, &sinceB) && b == value;
      };
      QTRY_VERIFY_WITH_TIMEOUT(haveCome(), 30'000);
      apart.push_back(std::abs(sinceA - sinceB));
    }
    // A lost datagram shows a change later, with the refresh; most are not lost.
    std::ranges::sort(apart);
    QVERIFY2(apart[apart.size() / 2] < 0.020, qPrintable(QString::number(apart[apart.size() / 2])));
    const SentStatus a = studio.sent(0), b = studio.sent(1);
    QVERIFY(std::abs(std::abs(a.clockOffset - b.clockOffset) - 1e6) < 0.05);
  }

  void aRobotThatSendsBothIsOne() {
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    board->write(*VariableCatalog::published().intVar("LOCALIZATION_X"), 600);
    board->write(*VariableCatalog::published().intVar("LOCALIZATION_Y"), 350);
    Studio studio;
    const TestSocket robot;
    telemetry::TextMessage message;
    message.robot = 3;
    message.x = 450;
    message.y = 300;
    const auto isShown = [&](double x) {
      (void)robot.send(static_cast<std::uint16_t>(studio.options.portBase + 3),
                       telemetry::encode(message));
      const LiveNews news = studio.watch.take();
      return news.frame && news.frame->robots.size() == 1 && news.frame->robots[0].name == "B3" &&
             news.frame->robots[0].pose.position.x == x;
    };
    QTRY_VERIFY_WITH_TIMEOUT(isShown(0.0), 30'000);
    {
      const Agent agent(3, m_key, studio.port(3));
      QTRY_VERIFY_WITH_TIMEOUT(isShown(1.5), 30'000);
      double value = 0.0;
      QTRY_VERIFY(studio.latest("B3", "LOCALIZATION_X", value) && value == 600.0);
      QVERIFY(studio.latest("B3 telemetry", "LOCALIZATION_X", value) && value == 450.0);
    }
    // Another one is started in its place, whose numbers begin at 0 again.
    QTest::qWait(300);
    const Agent again(3, m_key, studio.port(3));
    board->write(*VariableCatalog::published().intVar("LOCALIZATION_X"), 650);
    QTRY_VERIFY_WITH_TIMEOUT(isShown(2.0), 30'000);
    QCOMPARE(studio.sent().restarts, 1U);
  }

  void moreThanTwentyRobotsLoseNothing() {
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    fill(*board, 1);
    LiveOptions options = freeOptions(22);
    options.variablesPortBase = options.refereePort;
    LiveWatch watch(options);
    std::vector<std::unique_ptr<Agent>> agents;
    for (int robot = 1; robot <= 22; ++robot) {
      agents.push_back(std::make_unique<Agent>(
          robot, m_key, static_cast<std::uint16_t>(options.variablesPortBase + robot)));
    }
    const auto haveSent = [&watch](std::uint64_t datagrams) {
      const auto sent = watch.details().sent;
      return sent.size() == 22 && std::ranges::all_of(sent, [datagrams](const SentStatus& one) {
               return one.variables == 205 && one.link.messages >= datagrams;
             });
    };
    QTRY_VERIFY_WITH_TIMEOUT(haveSent(1), 60'000);
    for (int round = 2; round < 12; ++round) {
      fill(*board, round);
      QTest::qWait(50);
    }
    QTRY_VERIFY_WITH_TIMEOUT(haveSent(30), 60'000);
    for (const SentStatus& one : watch.details().sent) {
      QCOMPARE(one.link.lost, 0U);
      QCOMPARE(one.link.late, 0U);
    }
    QCOMPARE(watch.take().frame->robots.size(), std::size_t(22));
  }

  // The programs that docs show for teams that send from their own code.
  void teamsSendFromTheirPrograms_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QStringList>("command");
    QTest::newRow("Python") << "pb2_robot.py"
                            << QStringList{"python3",
                                           PITCHBOARD_SOURCE_DIR "/tests/end_to_end/pb2_robot.py"};
    QTest::newRow("C++") << "pb2_robot.cpp"
                         << QStringList{QCoreApplication::applicationDirPath() + "/pb2_robot"};
  }
  void teamsSendFromTheirPrograms() {
    QFETCH(QString, file);
    QFETCH(QStringList, command);
    QCOMPARE(whyNotShown(file, 15), QString());
    const Studio studio;
    QProcess sender;
    sender.start(command[0],
                 command.mid(1) + QStringList{"3", "127.0.0.1", QString::number(studio.port(3))});
    double volts = 0.0, yaw = 0.0;
    QTRY_VERIFY_WITH_TIMEOUT(
        studio.latest("B3", "VOLTAGE", volts) && studio.latest("B3", "IMU_EULER_Z", yaw), 30'000);
    QCOMPARE(volts, 148.0);
    QCOMPARE(yaw, 0.5);
    const SentStatus sent = studio.sent();
    QVERIFY(sent.variables == 2 && sent.unknown.empty());
    QVERIFY(sent.link.lost == 0 && sent.link.duplicates == 0 && sent.restarts == 0);
    // Both types are those of the published map.
    const auto view = studio.store->view(*studio.store->findGroup("B3"));
    for (const telemetry::ColumnInfo& column : view->info().columns) {
      if (column.name == "VOLTAGE") QCOMPARE(column.type, telemetry::ColumnType::Int32);
      if (column.name == "IMU_EULER_Z") QCOMPARE(column.type, telemetry::ColumnType::Float32);
    }
    sender.kill();
    QVERIFY(sender.waitForFinished());
  }

 private:
  int m_key = 0, m_number = 0;
};

PITCHBOARD_TEST(TestLiveVariables)

}  // namespace tst_live_variables

#include "tst_live_variables.moc"

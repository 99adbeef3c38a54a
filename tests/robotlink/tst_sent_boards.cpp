// SPDX-License-Identifier: GPL-3.0-or-later
// Variables that robots send (PB2): from datagrams to rows, robots and a recording, over the
// pipeline that studio and command line use.

#include <QTemporaryDir>
#include <QtTest>
#include <array>
#include <bit>
#include <map>

#include <robotlink/frame/join_boards.h>
#include <robotlink/live/board_columns.h>
#include <robotlink/live/live_pipeline.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/moment_scenario.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/series/series_store.h>

#include "../support/group_facts.h"
#include "frame_difference.h"

namespace tst_sent_boards {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;
using telemetry::Duration;
using telemetry::WallTime;

namespace {

constexpr const char* message = " 450 300 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT";

LiveOptions blueTeam() {
  LiveOptions options;
  options.team.teams.emplace_back().colour = "blue";
  return options;
}

/// A pipeline, and what robots send into it.
class Rig {
 public:
  explicit Rig(LiveOptions options = blueTeam())
      : pipeline(std::move(options), WallTime{}), m_rows(std::make_shared<Observer>(store)) {
    pipeline.observe(m_rows, WallTime{});
  }

  /// PB2 from 10.0.0.`robot`, sent at `ms` and received 1 ms later.
  SentBoards::Verdict send(int robot, std::uint32_t sequence, std::uint64_t ms,
                           const std::string& fields) {
    return sendAt(seconds(static_cast<double>(ms) / 1000 + 0.001), robot, sequence, ms, fields);
  }
  SentBoards::Verdict sendAt(WallTime time, int robot, std::uint32_t sequence, std::uint64_t ms,
                             const std::string& fields, int address = 0) {
    const std::string text = "PB2 " + std::to_string(robot) + " " + std::to_string(sequence) + " " +
                             std::to_string(ms) + " " + fields + " OUT";
    m_rows->verdict.reset();
    pipeline.take({time, from(address > 0 ? address : robot, 40'000),
                   static_cast<std::uint16_t>(1340 + robot), false, text});
    return m_rows->verdict.value_or(SentBoards::Verdict::TooManyRobots);
  }
  /// A message of the published telemetry.
  void sendOne(int robot, double time, int address = 0) {
    const std::string text = std::to_string(robot) + message;
    pipeline.take({seconds(time), from(address > 0 ? address : robot, 50'000),
                   static_cast<std::uint16_t>(1240 + robot), false, text});
  }
  /// Two seconds of variables.
  void begin(int robot, const std::string& fields, std::uint64_t ms = 1000) {
    for (std::uint32_t i = 0; i <= 20; ++i) send(robot, i, ms + 101 * i, fields);
  }
  MatchFrame frame(double time) { return pipeline.advance(seconds(time)); }

  std::shared_ptr<const telemetry::GroupView> view(const char* name) const {
    const auto group = store->findGroup(name);
    return group ? store->view(*group) : nullptr;
  }
  /// The newest value; NaN where there is none.
  double value(const char* group, const char* column) const {
    const auto id = store->find(group, column);
    const auto latest = id ? store->view(id->group)->latest(id->column) : std::nullopt;
    return latest ? latest->value : std::nan("");
  }
  SentStatus status(double time, std::size_t place = 0) {
    return pipeline.details(seconds(time)).sent.at(place);
  }
  QString names() const {
    QStringList all;
    for (std::size_t i = 0; i < store->groups(); ++i) {
      const auto one = store->view(static_cast<telemetry::GroupId>(i));
      if (one->rows() > 0) all << QString::fromStdString(one->info().name);
    }
    all.sort();
    return all.join(", ");
  }

  static WallTime seconds(double time) {
    return WallTime(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(time)));
  }
  static telemetry::Sender from(int last, std::uint16_t port) {
    return {{0x0a00'0000U + static_cast<std::uint32_t>(last)}, port};
  }

  std::shared_ptr<telemetry::SeriesStore> store = std::make_shared<telemetry::SeriesStore>();
  LivePipeline pipeline;

 private:
  struct Observer : LiveObserver {
    explicit Observer(std::shared_ptr<telemetry::RowSink> sink) : store(std::move(sink)) {}
    void received(const LiveDatagram& datagram) override { verdict = datagram.variablesVerdict; }
    std::shared_ptr<telemetry::RowSink> rows() override { return store; }
    std::shared_ptr<telemetry::RowSink> store;
    std::optional<SentBoards::Verdict> verdict;
  };
  std::shared_ptr<Observer> m_rows;
};

using Verdict = SentBoards::Verdict;

RobotFrame robotOf(int number, std::uint32_t address, TeamColor team) {
  RobotFrame robot;
  static std::uint32_t made = 0;
  robot.uid = {++made};
  robot.key = {0, number, 0};
  robot.identity.number = number;
  robot.identity.team = team;
  robot.link.emplace().sender.address.value = address;
  robot.name = robotName(robot.key, Teams(1));
  return robot;
}

RobotFrame boardOf(int number, std::uint32_t address, TeamColor team = TeamColor::Blue) {
  RobotFrame board = robotOf(number, address, team);
  if (address == 0) {
    board.key.team = placeByColour;
    board.boardKey = 100 * number;
  }
  board.pose = {{1.0, 2.0}, 0.5};
  board.belief = board.pose;
  return board;
}

}  // namespace

class TestSentBoards : public QObject {
  Q_OBJECT

 private slots:
  /// A robot whose program was replaced sends as many variables as before, but others.
  void aRobotWhoseVariablesChangeKeepsThePast() {
    const auto store = std::make_shared<telemetry::SeriesStore>();
    BoardRowKeeper keeper(store);
    const auto column = [](const char* name, telemetry::ColumnType type) {
      telemetry::ColumnInfo info;
      info.name = name;
      info.type = type;
      return info;
    };
    using enum telemetry::ColumnType;
    const telemetry::GroupInfo before{"B1", {column("SAME", Int32), column("OLD", Float32)}, {}};
    const telemetry::GroupInfo after{"B1", {column("NEW", Int32), column("SAME", Int32)}, {}};
    const std::array first{BoardRow{1.0, {7, std::bit_cast<std::uint32_t>(2.5F)}, {}}};
    const std::array second{BoardRow{2.0, {9, 8}, {}}};
    keeper.take(before, first);
    keeper.take(after, second);
    QCOMPARE(store->groups(), std::size_t{1});
    const auto value = [&](const char* name, double time) {
      const auto found = store->find("B1", name);
      return found ? store->view(0)->at(found->column, time)->value : -1.0;
    };
    QCOMPARE(value("SAME", 1.0), 7.0);
    QCOMPARE(value("SAME", 2.0), 8.0);
    QCOMPARE(value("OLD", 1.0), 2.5);
    QVERIFY(std::isnan(value("OLD", 2.0)));
    QVERIFY(std::isnan(value("NEW", 1.0)));
    QCOMPARE(value("NEW", 2.0), 9.0);
  }

  void rowsAreThoseOfASimulation() {
    Rig rig;
    // A sample takes several datagrams; with the first one all variables are known.
    std::uint32_t sequence = 0;
    for (std::uint64_t sample = 0; sample < 3; ++sample) {
      std::string fields = "@BLACKBOARD=1";
      for (const Variable& variable : VariableCatalog::published().variables()) {
        fields += " " + variable.name + (variable.type == VariableType::Int ? "=7" : "=-1.5");
        if (fields.size() < 1200) continue;
        QVERIFY(rig.send(3, sequence++, 1000 + 50 * sample, fields) == Verdict::Used);
        fields = "@WAITING=0";
      }
      QVERIFY(rig.send(3, sequence++, 1000 + 50 * sample, fields) == Verdict::Used);
    }
    rig.frame(1.2);
    const auto board = rig.view("B3");
    QVERIFY(board);
    QCOMPARE(board->rows(), std::size_t(3));
    const std::vector<telemetry::ColumnInfo> columns =
        BoardColumns(VariableCatalog::published()).columns();
    QVERIFY(board->info().columns == columns);
    QCOMPARE(rig.value("B3", "VISION_BALL_DIST"), -1.5);
    QCOMPARE(rig.value("B3", "DECISION_ACTION_A"), 7.0);
    QVERIFY(std::abs(board->range()->end - 1.101) < 1e-6);
    QCOMPARE(attributesOf(board->info()).at("sent"), std::string("10.0.0.3"));
    QCOMPARE(rig.status(1.2).catalog, std::string("published"));
    QVERIFY(rig.status(1.2).unknown.empty());
  }

  /// It brings what was lost, and undoes nothing.
  void aLateDatagram() {
    Rig rig;
    rig.begin(3, "VOLTAGE=140 IMU_EULER_Z=0.25 DECISION_ACTION_A=1");
    QVERIFY(rig.send(3, 23, 3300, "VOLTAGE=150") == Verdict::Used);
    QVERIFY(rig.send(3, 21, 3100, "VOLTAGE=145 IMU_EULER_Z=0.5") == Verdict::Late);
    QVERIFY(rig.send(3, 24, 3400, "DECISION_ACTION_A=8") == Verdict::Used);
    rig.frame(3.5);
    QCOMPARE(rig.value("B3", "VOLTAGE"), 150.0);
    QCOMPARE(rig.value("B3", "IMU_EULER_Z"), 0.5);
    QCOMPARE(rig.value("B3", "DECISION_ACTION_A"), 8.0);
    const SentStatus status = rig.status(3.5);
    QCOMPARE(status.link.late, 1U);
    QCOMPARE(status.link.lost, 1U);
    QVERIFY(rig.send(3, 24, 3400, "DECISION_ACTION_A=8") == Verdict::Duplicate);
    QVERIFY(rig.send(3, 22, 3200, "VOLTAGE=1") == Verdict::Late);
    QCOMPARE(rig.status(3.5).link.duplicates, 1U);
    QCOMPARE(rig.status(3.5).link.lost, 0U);
    rig.frame(3.6);
    QCOMPARE(rig.value("B3", "VOLTAGE"), 150.0);
  }

  void aCounterThatGoesRound() {
    Rig rig;
    for (std::uint32_t i = 0; i < 40; ++i) {
      const std::uint32_t sequence = 0xffff'ffffU - 20 + i;
      const std::string fields = "VOLTAGE=" + std::to_string(i);
      QVERIFY(rig.send(3, sequence, 1000 + 100 * i, fields) == Verdict::Used);
    }
    rig.frame(5.0);
    QCOMPARE(rig.value("B3", "VOLTAGE"), 39.0);
    QCOMPARE(rig.status(5.0).link.lost, 0U);
    QCOMPARE(rig.status(5.0).restarts, 0U);
  }

  /// The agent is started again, soon or late, or the robot is.
  void aRestart_data() {
    QTest::addColumn<int>("datagrams");
    QTest::addColumn<qint64>("clock");
    QTest::newRow("soon") << 25 << qint64{1};
    QTest::newRow("late") << 5000 << qint64{1};
    QTest::newRow("with the robot") << 5000 << qint64{-1};
  }
  void aRestart() {
    QFETCH(int, datagrams);
    QFETCH(qint64, clock);
    Rig rig;
    const std::uint64_t begun = 1'000'000;
    std::uint64_t sent = begun;
    double time = 1.0;
    const auto send = [&](std::uint32_t sequence, const std::string& fields) {
      sent += 100;
      time += 0.1;
      return rig.sendAt(Rig::seconds(time), 3, sequence, sent, fields);
    };
    for (int i = 0; i < datagrams; ++i) {
      QVERIFY(send(static_cast<std::uint32_t>(i), "VOLTAGE=150 HEAD=1") == Verdict::Used);
    }
    if (clock < 0) sent = 30'000;
    for (std::uint32_t i = 0; i < 5; ++i) {
      QVERIFY(send(i, "VOLTAGE=" + std::to_string(100 + i)) == Verdict::Used);
    }
    rig.frame(time);
    QCOMPARE(rig.value("B3", "VOLTAGE"), 104.0);
    QCOMPARE(rig.value("B3", "HEAD"), 1.0);
    QCOMPARE(rig.status(time).restarts, 1U);
    QCOMPARE(rig.status(time).link.lost, 0U);
    QVERIFY(std::abs(rig.view("B3")->range()->end - time) < 0.002);
  }

  void namesThatNoMapHas() {
    Rig rig;
    rig.begin(3, "VOLTAGE=150 OUR_GAIT=3 OUR_TILT=0.5 DECISION_ACTION_A=8");
    rig.frame(3.05);
    QVERIFY(rig.send(3, 21, 3100, "OUR_TILT=2 OUR_LATE=4") == Verdict::Used);
    rig.frame(3.2);
    QStringList names;
    for (const auto& column : rig.view("B3")->info().columns) {
      names << QString::fromStdString(column.name);
    }
    QCOMPARE(names.join(' '), QString("DECISION_ACTION_A VOLTAGE OUR_GAIT OUR_TILT OUR_LATE"));
    QCOMPARE(rig.value("B3", "OUR_TILT"), 2.0);
    QCOMPARE(rig.value("B3", "OUR_LATE"), 4.0);
    QCOMPARE(rig.status(3.2).unknown,
             (std::vector<std::string>{"OUR_GAIT", "OUR_LATE", "OUR_TILT"}));
    QVERIFY(rig.view("B3")->rows() > 1);
  }

  /// The map that has the most of the names is chosen, and its types count.
  void anImportedCatalogIsFoundByName() {
    QTemporaryDir folder;
    const QString map = folder.filePath("ours.json");
    QFile file(map);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"int": {"OUR_GAIT": 0}, "float": {"OUR_TILT": 0, "OUR_LEAN": 1}})");
    file.close();
    LiveOptions options = blueTeam();
    options.catalogs = {map.toStdString()};
    QVERIFY(validate(options));
    Rig rig(options);
    // A float that is written without a point is still one.
    rig.begin(3, "OUR_LEAN=3 OUR_GAIT=2 OUR_TILT=0.5");
    rig.frame(3.2);
    const auto& columns = rig.view("B3")->info().columns;
    QCOMPARE(columns.size(), std::size_t(3));
    QCOMPARE(columns[0].name, std::string("OUR_GAIT"));
    QVERIFY(columns[0].type == telemetry::ColumnType::Int32);
    QVERIFY(columns[2].type == telemetry::ColumnType::Float32);
    QCOMPARE(rig.value("B3", "OUR_LEAN"), 3.0);
    QCOMPARE(rig.status(3.2).catalog, std::string("ours.json"));
    QVERIFY(rig.status(3.2).unknown.empty());
    options.catalogs = {"/not/there.json"};
    QVERIFY(!validate(options));
  }

  void aThousandNamesAreKept() {
    Rig rig;
    for (std::uint32_t i = 0; i < 1100; ++i) {
      rig.send(3, i, 1000 + 10 * i, "MADE_UP_" + std::to_string(i) + "=1");
    }
    rig.frame(13.0);
    const SentStatus status = rig.status(13.0);
    QCOMPARE(status.variables, SentBoards::maxVariables);
    QCOMPARE(status.refused, 100U);
    QCOMPARE(rig.view("B3")->info().columns.size(), SentBoards::maxVariables);
  }

  void moreRobotsThanAreKept() {
    SentBoards boards;
    std::uint32_t sequence = 0;
    const auto sendOne = [&](std::uint32_t address, double time) {
      const std::string text = "PB2 3 " + std::to_string(sequence++) + " 1 OUT";
      const auto parsed = telemetry::parsePb2(text);
      return boards.take(*parsed, {Rig::seconds(time), {{address}, 1}, 1343, false, ""}, 0, time);
    };
    for (std::uint32_t i = 1; i <= SentBoards::maxRobots; ++i)
      QVERIFY(sendOne(i, 1.0) == Verdict::Used);
    QVERIFY(sendOne(1000, 2.0) == Verdict::TooManyRobots);
    QVERIFY(sendOne(1000, 30.0) == Verdict::Used);  // in place of one that is silent
    QCOMPARE(boards.status(Rig::seconds(30.0)).size(), SentBoards::maxRobots);
  }

  void aRobotIsShownByItsVariables() {
    Rig rig;
    const std::string fields =
        "LOCALIZATION_X=600 LOCALIZATION_Y=350 LOCALIZATION_THETA=90 VOLTAGE=150 "
        "VISION_WORKING=1 VISION_LOST=0 VISION_BALL_DIST=80.0 VISION_PAN_DEG=10.0 "
        "DECISION_ACTION_A=8";
    rig.begin(3, fields + " @BLACKBOARD=1");
    const MatchFrame frame = rig.frame(3.1);
    QCOMPARE(frame.robots.size(), std::size_t(1));
    const RobotFrame& robot = frame.robots[0];
    QCOMPARE(robot.name, std::string("B3"));
    QCOMPARE(robot.key, (RobotKey{1, 3, 0}));
    QVERIFY(robot.belief && robot.ball && robot.battery && robot.decided == 8);
    QCOMPARE(robot.pose.position.x, 1.5);
    QVERIFY(robot.lamps[1].state == telemetry::HeartbeatState::Working);
    QVERIFY(!robot.timedOut() && !robot.boardKey);
    // The agent lives, and there is no blackboard.
    rig.send(3, 21, 3200, "@BLACKBOARD=0");
    QVERIFY(rig.frame(3.3).robots.at(0).timedOut());
    rig.send(3, 22, 3400, fields + " @BLACKBOARD=1");
    QVERIFY(!rig.frame(3.5).robots.at(0).timedOut());
    QVERIFY(rig.frame(20.0).robots.at(0).timedOut());
  }

  /// Whichever comes first.
  void messagesAndVariablesAreOneRobot_data() {
    QTest::addColumn<bool>("messagesFirst");
    QTest::newRow("messages first") << true;
    QTest::newRow("variables first") << false;
  }
  void messagesAndVariablesAreOneRobot() {
    QFETCH(bool, messagesFirst);
    Rig rig;
    if (messagesFirst) {
      rig.sendOne(3, 0.5);
      QCOMPARE(rig.frame(0.6).robots.size(), std::size_t(1));
      QVERIFY(rig.view("B3"));
    }
    rig.begin(3, "LOCALIZATION_X=600 LOCALIZATION_Y=350 VOLTAGE=150");
    if (!messagesFirst) {
      QCOMPARE(rig.frame(3.05).robots.size(), std::size_t(1));
      rig.sendOne(3, 3.06);
    }
    const MatchFrame frame = rig.frame(3.1);
    QCOMPARE(frame.robots.size(), std::size_t(1));
    const RobotFrame& robot = frame.robots[0];
    QCOMPARE(robot.key, (RobotKey{1, 3, 0}));
    QCOMPARE(robot.name, std::string("B3"));
    QCOMPARE(robot.pose.position.x, 1.5);  // not 0, as the message says
    QVERIFY(robot.link && !robot.values.empty());
    rig.frame(4.2);
    QCOMPARE(rig.names(), QString("B3, B3 agent, B3 link, B3 telemetry"));
    QCOMPARE(rig.value("B3", "LOCALIZATION_X"), 600.0);
    QCOMPARE(rig.value("B3 telemetry", "LOCALIZATION_X"), 450.0);
    // Variables end, messages go on.
    rig.sendOne(3, 15.0);
    const MatchFrame later = rig.frame(15.1);
    QCOMPARE(later.robots.size(), std::size_t(1));
    QVERIFY(!later.robots[0].timedOut());
    QCOMPARE(later.robots[0].pose.position.x, 0.0);
    // Forgotten as one, too.
    rig.pipeline.forget(robot.uid, Rig::seconds(15.2));
    QVERIFY(rig.frame(15.3).robots.empty());
  }

  void anotherAddressIsAnotherRobot() {
    Rig rig;
    rig.sendOne(3, 0.5, 77);
    rig.begin(3, "LOCALIZATION_X=600 LOCALIZATION_Y=350");
    const MatchFrame frame = rig.frame(3.1);
    QCOMPARE(frame.robots.size(), std::size_t(2));
    QCOMPARE(frame.robots[1].name, std::string("B3 (2)"));
  }

  /// The one that also sends messages has the name; what each of them sent stays its own.
  void twoOfOneNumberExchangeTheirNames() {
    Rig rig;
    for (std::uint32_t i = 0; i <= 20; ++i) {
      const double time = 1.0 + 0.1 * i;
      rig.sendAt(Rig::seconds(time), 3, i, 1000 + 100 * i, "VOLTAGE=1", 8);
      rig.sendAt(Rig::seconds(time), 3, i, 1000 + 100 * i, "HEAD=2 VOLTAGE=2", 9);
    }
    rig.frame(3.1);
    QCOMPARE(rig.value("B3", "VOLTAGE"), 1.0);
    QCOMPARE(rig.value("B3 (2)", "VOLTAGE"), 2.0);
    rig.sendOne(3, 3.2, 9);
    for (std::uint32_t i = 21; i <= 23; ++i) {
      const double time = 1.2 + 0.1 * i;
      rig.sendAt(Rig::seconds(time), 3, i, 1000 + 100 * i, "VOLTAGE=1", 8);
      rig.sendAt(Rig::seconds(time), 3, i, 1000 + 100 * i, "VOLTAGE=2", 9);
      rig.frame(time);
    }
    QCOMPARE(rig.value("B3", "VOLTAGE"), 2.0);
    QCOMPARE(rig.value("B3", "HEAD"), 2.0);
    QCOMPARE(rig.value("B3 (2)", "VOLTAGE"), 1.0);
    QCOMPARE(rig.view("B3")->rows(), std::size_t(24));
    QCOMPARE(rig.view("B3 (2)")->rows(), std::size_t(24));
  }

  /// It is the same robot with the same rows.
  void anAddressThatChanges() {
    Rig rig;
    rig.begin(3, "VOLTAGE=150");
    rig.frame(3.1);
    const std::size_t rows = rig.view("B3")->rows();
    rig.sendAt(Rig::seconds(20.0), 3, 21, 20'000, "VOLTAGE=151", 99);
    const MatchFrame frame = rig.frame(20.1);
    QCOMPARE(frame.robots.size(), std::size_t(1));
    QCOMPARE(rig.view("B3")->rows(), rows + 1);
    QCOMPARE(attributesOf(rig.view("B3")->info()).at("sent"), std::string("10.0.0.99"));
    // Forgotten, it goes on with its curves when it is received again.
    rig.pipeline.forget(frame.robots[0].uid, Rig::seconds(20.2));
    rig.begin(3, "VOLTAGE=152", 30'000);
    rig.frame(33.0);
    QVERIFY(rig.view("B3")->rows() > rows + 1);
  }

  /// Before anybody says the colour it is "Robot 3"; then rows go on under the other name.
  void namesFollowTheColour() {
    Rig rig{LiveOptions()};
    rig.begin(3, "VOLTAGE=150");
    rig.sendOne(3, 3.05);
    QCOMPARE(rig.frame(3.1).robots.at(0).name, std::string("Robot 3"));
    QCOMPARE(rig.names(), QString("Robot 3, Robot 3 agent, Robot 3 link, Robot 3 telemetry"));
    const std::size_t rows = rig.view("Robot 3")->rows();
    rig.pipeline.setOptions(blueTeam(), Rig::seconds(3.2));
    rig.sendOne(3, 3.3);
    rig.send(3, 21, 3400, "VOLTAGE=151");
    QCOMPARE(rig.frame(3.5).robots.size(), std::size_t(1));
    rig.send(3, 22, 3600, "VOLTAGE=152");
    rig.frame(4.7);
    QCOMPARE(rig.names(), QString("B3, B3 agent, B3 link, B3 telemetry"));
    QCOMPARE(rig.view("B3")->rows(), rows + 2);
    QCOMPARE(rig.view("B3 telemetry")->rows(), std::size_t(2));
  }

  /// A robot that dies soon after it was switched on: what it sent until then is there, and that it
  /// was there.
  void theFirstSecondsAreKept() {
    const QTemporaryDir folder;
    const std::string path = folder.filePath("live.mcap").toStdString();
    Rig rig;
    auto recorder = LiveRecorder::create(path, rig.pipeline.options(), WallTime{}, {});
    QVERIFY(recorder);
    rig.pipeline.observe(*recorder, WallTime{});
    // Variables come one after the other, as those do that have not changed for long.
    const std::array<const char*, 5> names{"VOLTAGE", "VISION_BALL_DIST", "DECISION_ACTION_A",
                                           "TEAM_GAIN", "HEAD"};
    std::map<std::string, std::vector<double>> sent;
    for (std::uint32_t i = 0; i < 30; ++i) {
      std::string fields = "VOLTAGE=" + std::to_string(100 + i);
      sent["VOLTAGE"].push_back(100.0 + i);
      for (std::size_t n = 1; n < names.size(); ++n) {
        std::vector<double>& values = sent[names[n]];
        const bool isSent = i % 5 == n || !values.empty();
        const double value = i < 20 ? 0.5 * static_cast<double>(i) : 0.0;
        const bool isInt = n == 2 || n == 4;
        const double written = isInt ? std::floor(value) : value;
        if (isSent) fields += std::string(" ") + names[n] + "=" + std::to_string(written);
        if (isSent) values.push_back(written);
      }
      rig.send(3, i, 1000 + 50 * i, fields);
      const MatchFrame frame = rig.frame(1.002 + 0.05 * i);
      QCOMPARE(frame.robots.size(), std::size_t(1));
      QCOMPARE(rig.view("B3")->rows(), std::size_t(i + 1));
    }
    rig.pipeline.stopObserving(*recorder);
    QVERIFY((*recorder)->finish());
    recorder->reset();
    const auto session = telemetry::SessionReader::open(path);
    QVERIFY(session);
    const auto group = std::ranges::find(session->groups(), std::string("B3"),
                                         [](const auto& one) { return one.info.name; });
    QVERIFY(group != session->groups().end());
    QCOMPARE(group->rows, 30U);
    const auto events = session->events();
    QVERIFY(std::ranges::any_of(events, [](const telemetry::SessionEvent& event) {
      return event.kind == "robot-heard" && event.group == "B3" && event.time < 1.1;
    }));
    telemetry::SeriesStore again;
    const telemetry::GroupId id = again.addGroup(group->info);
    const auto index = static_cast<telemetry::GroupId>(group - session->groups().begin());
    session->rows({0.0, 10.0}, std::array{index},
                  [&](telemetry::GroupId, const telemetry::RowView& row) {
                    again.append(id, row);
                    return true;
                  });
    for (const telemetry::SeriesStore* store : {rig.store.get(), &again}) {
      for (const char* name : names) {
        const auto column = store->find("B3", name);
        QVERIFY2(column, name);
        std::vector<telemetry::Sample> samples;
        store->view(column->group)->samples(column->column, {0.0, 10.0}, samples);
        QCOMPARE(samples.size(), std::size_t(30));
        const std::vector<double>& values = sent[name];
        for (std::size_t i = 0; i < samples.size(); ++i) {
          // Unknown until it comes; a ball that was never seen has the distance 0.
          const std::size_t unknown = samples.size() - values.size();
          const bool isHole = i < unknown || (name == std::string("VISION_BALL_DIST") &&
                                              values[i - unknown] == 0.0);
          const QString where = QString("%1, row %2: %3").arg(name).arg(i).arg(samples[i].value);
          if (isHole)
            QVERIFY2(std::isnan(samples[i].value), qPrintable(where));
          else
            QVERIFY2(samples[i].value == values[i - unknown], qPrintable(where));
        }
      }
    }
  }

  void aBlackboardOfThisComputerIsTheRobotOfItsColour() {
    MatchFrame frame;
    frame.teams = Teams(1);
    frame.robots = {robotOf(3, 0x0a000003, TeamColor::Blue),
                    robotOf(4, 0x0a000004, TeamColor::Blue)};
    auto uids = joinBoards(frame, {boardOf(3, 0)});
    QCOMPARE(frame.robots.size(), std::size_t(2));
    QCOMPARE(uids.at(0), frame.robot(RobotKey{0, 3, 0})->uid);
    QCOMPARE(frame.robots[0].name, std::string("B3"));  // as it was attached
    QVERIFY(frame.robots[0].boardKey == 300 && frame.robots[0].belief);
    QCOMPARE(frame.robots[0].link->sender.address.value, 0x0a000003U);

    // The colours are known: another one is another robot, of a team that is added.
    frame.teams[0].colour = TeamColor::Blue;
    uids = joinBoards(frame, {boardOf(4, 0, TeamColor::Red), boardOf(4, 0, TeamColor::Red)});
    QCOMPARE(frame.robots.size(), std::size_t(4));
    QCOMPARE(uids.at(0), frame.robot(RobotKey{1, 4, 0})->uid);
    QCOMPARE(frame.robots[2].name, std::string("R4"));
    QCOMPARE(frame.robots[3].name, std::string("R4 (2)"));
    QVERIFY(frame.teams.at(1).colour == TeamColor::Red);
  }

  void whatIsNoMessageIsCounted() {
    Rig rig;
    rig.pipeline.take({Rig::seconds(1), Rig::from(3, 1), 1343, false, "PB2 3 x"});
    const LiveDetails details = rig.pipeline.details(Rig::seconds(1));
    QCOMPARE(details.badVariables, 1U);
    QVERIFY(!details.badVariablesReason.empty());
    QVERIFY(rig.frame(1.1).robots.empty());
    QCOMPARE(details.team.datagrams, 0U);
  }

  void refusedSendersAreNotReceived() {
    LiveOptions options = blueTeam();
    QVERIFY(options.team.senders.add("10.0.0.0/24"));
    Rig rig(options);
    const std::string text = "PB2 3 0 1 VOLTAGE=1 OUT";
    rig.pipeline.take({Rig::seconds(1), {{0x0b000003}, 1}, 1343, false, text});
    QCOMPARE(rig.pipeline.details(Rig::seconds(1)).refusedVariables, 1U);
    QVERIFY(rig.pipeline.details(Rig::seconds(1)).sent.empty());
  }

  void portsMustNotCollide() {
    LiveOptions options;
    const auto ports = portsOf(options);
    QVERIFY(ports && std::ranges::count(*ports, 1341) == 1 &&
            std::ranges::count(*ports, 1356) == 1);
    options.variablesPortBase = options.portBase + 3;
    QVERIFY(!validate(options));
    options.variablesPortBase = options.refereePort - 1;
    QVERIFY(!validate(options));
    options.variablesPortBase = 65'530;
    QVERIFY(!validate(options));
    options.variablesPortBase = 0;
    QCOMPARE(portsOf(options)->size(), std::size_t(17));
  }

  /// Simulate from here: its blackboard begins as it was, also from a recorded row.
  void aSimulationBeginsWithItsBlackboard() {
    LiveOptions options = blueTeam();
    Rig rig(options);
    rig.begin(3,
              "LOCALIZATION_X=600 LOCALIZATION_Y=350 VISION_BALL_DIST=-1.0 IMU_EULER_Z=0.1 "
              "DECISION_ACTION_A=8 COM_REFEREE=2 OUR_GAIT=3");
    const MatchFrame frame = rig.frame(3.1);
    RecordedFrames recorded;
    MatchFrame again = frame;
    again.robots.clear();
    joinBoards(again, recorded.boardsAt(*rig.store, 3.1));
    for (const MatchFrame& one : {frame, again}) {
      const MomentScenario made = scenarioFromMoment(one);
      const Scenario& scenario = made.scenario;
      QCOMPARE(scenario.robots.size(), std::size_t(1));
      const auto written = [&](const char* name) {
        for (const BlackboardWrite& write : scenario.writes) {
          if (write.variable == name && write.robot == scenario.robots[0].identity.id) {
            return write.value;
          }
        }
        return std::nan("");
      };
      QCOMPARE(written("LOCALIZATION_X"), 600.0);
      QCOMPARE(written("VISION_BALL_DIST"), -1.0);
      QCOMPARE(written("IMU_EULER_Z"), static_cast<double>(0.1F));
      QCOMPARE(written("DECISION_ACTION_A"), 8.0);
      QVERIFY(std::isnan(written("COM_REFEREE")) && std::isnan(written("OUR_GAIT")));
      QVERIFY(made.notes.at(made.notes.size() - 1).size() > 0);
      const auto read = scenarioFromJson(scenarioToJson(scenario), "moment");
      QVERIFY2(read, read ? "" : read.error().text().c_str());
      const auto match = SimulatedMatch::create(*read, {});
      QVERIFY2(match, match ? "" : match.error().text().c_str());
      const Blackboard* board = match->blackboard(read->robots[0].identity.id);
      QVERIFY(board);
      const VariableCatalog& map = VariableCatalog::published();
      QCOMPARE(board->read(*map.intVar("LOCALIZATION_X")), 600);
      QCOMPARE(board->read(*map.floatVar("VISION_BALL_DIST")), -1.0F);
    }
  }

  /// A recording shows the same robots at the same places, whichever way they were received.
  void aRecordingShowsTheSame() {
    const QTemporaryDir folder;
    const std::string path = folder.filePath("live.mcap").toStdString();
    Rig rig;
    auto recorder = LiveRecorder::create(path, rig.pipeline.options(), WallTime{}, {});
    QVERIFY(recorder);
    rig.pipeline.observe(*recorder, WallTime{});
    std::map<double, MatchFrame> seen;
    for (std::uint32_t i = 0; i <= 60; ++i) {
      const std::string place = "LOCALIZATION_X=" + std::to_string(400 + i) +
                                " LOCALIZATION_Y=350 LOCALIZATION_THETA=90 VOLTAGE=150 " +
                                "VISION_LOST=0 VISION_BALL_DIST=80.5 VISION_PAN_DEG=10.0 "
                                "VISION_WORKING=1 DECISION_ACTION_A=8 TEAM_GAIN=0.1";
      const double time = 1.0 + 0.1 * i;
      rig.send(3, i, 1000 + 100 * i, place);
      rig.send(5, i, 1000 + 100 * i, place);  // sends no messages
      if (i % 5 == 0) rig.sendOne(3, time);
      if (i % 5 == 2) rig.sendOne(4, time);
      MatchFrame frame = rig.frame(time + 0.01);
      if (i > 25) seen[time + 0.01] = std::move(frame);
    }
    rig.pipeline.stopObserving(*recorder);
    QVERIFY((*recorder)->finish());
    recorder->reset();
    const auto session = telemetry::SessionReader::open(path);
    QVERIFY(session);
    RecordedFrames frames(backdropOf(*session));
    for (const auto& [time, frame] : seen) {
      MatchFrame again = frames.frameAt(*session, frame.snapshot.time);
      QCOMPARE(again.robots.size(), std::size_t(3));
      for (std::size_t i = 0; i < 3; ++i) {
        RobotFrame a = frame.robots[i], b = again.robots[i];
        for (RobotFrame* robot : {&a, &b}) {
          // How often and how evenly variables came is not in their rows.
          if (robot->key.number != 5) continue;
          robot->link = boardLink(0.0, 0.0, robot->timedOut());
        }
        for (RobotFrame* robot : {&a, &b}) {
          for (auto& lamp : robot->lamps) lamp.since = {};
          robot->link->messages = robot->link->bytes = 0;
        }
        const QString found = difference(a, b);
        QVERIFY2(found.isEmpty(), qPrintable(QString::number(time) + ": " + found));
      }
    }
  }
};

PITCHBOARD_TEST(TestSentBoards)

}  // namespace tst_sent_boards

#include "tst_sent_boards.moc"

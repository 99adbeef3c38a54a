// SPDX-License-Identifier: GPL-3.0-or-later
// Team messages: the two channels, and the team process between two blackboards.
#include <QtTest>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/cognition/team_channel.h>

namespace tst_team_channel {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

int value(const Blackboard& board, const char* name) {
  return board.read(*VariableCatalog::published().intVar(name));
}

struct Robot {
  Blackboard board = Blackboard::onHeap();
  std::unique_ptr<CognitiveProcess> team;
  RobotVariables v;

  Robot(int id, const std::shared_ptr<TeamChannel>& channel) {
    ProcessOptions options;
    options.robot = RobotId{id};
    options.teamChannel = channel;
    team = std::move(findProcess("team")->make(options).value());
  }
  void step(double seconds) { team->step(board, Clock{seconds}); }
};

}  // namespace

class TestTeamChannel : public QObject {
  Q_OBJECT
 private slots:
  void inProcessReachesEveryOtherInOrder() {
    InProcessTeamChannel channel;
    for (int n = 1; n <= 3; ++n) QVERIFY(channel.take(RobotId{n}).empty());
    channel.post(RobotId{1}, "a");
    channel.post(RobotId{2}, "b");
    QCOMPARE(channel.take(RobotId{3}), (std::vector<std::string>{"a", "b"}));
    QCOMPARE(channel.take(RobotId{1}), (std::vector<std::string>{"b"}));
    QVERIFY(channel.take(RobotId{3}).empty());
  }

  void inProcessIsBounded() {
    InProcessTeamChannel channel;
    (void)channel.take(RobotId{2});
    for (int i = 0; i < 1000; ++i) channel.post(RobotId{1}, std::to_string(i));
    const auto kept = channel.take(RobotId{2});
    QCOMPARE(kept.size(), 64U);
    QCOMPARE(kept.back(), std::string("999"));
  }

  void elevenRobotsReceiveEachOther() {
    const auto channel = std::make_shared<InProcessTeamChannel>();
    std::vector<Robot> robots;
    for (int id = 1; id <= 11; ++id) robots.emplace_back(id, channel);
    const VariableCatalog& catalog = VariableCatalog::published();
    const IntVar intention = *catalog.intVar("DECISION_STATE");
    const FloatVar ballX = *catalog.floatVar("LOCALIZATION_BALL_X");
    const FloatVar ballY = *catalog.floatVar("LOCALIZATION_BALL_Y");
    for (int id = 1; id <= 11; ++id) {
      Robot& robot = robots[static_cast<std::size_t>(id - 1)];
      robot.board.write(robot.v.localizationX, 50 * id);
      robot.board.write(robot.v.localizationY, 300);
      robot.board.write(intention, id == 11 ? 3 : 6);      // robot 11 goes for the ball
      robot.board.write(ballX, id == 8 ? 450.0F : -1.0F);  // robot 8 sees it
      robot.board.write(ballY, id == 8 ? 200.0F : -1.0F);
    }
    for (int round = 0; round < 2; ++round) {
      for (Robot& robot : robots) robot.step(0.2 * round);
    }
    const Blackboard& first = robots[0].board;
    for (int id = 2; id <= 11; ++id) {
      const std::string name =
          "LOCALIZATION_RBT" + std::string(id < 10 ? "0" : "") + std::to_string(id);
      QCOMPARE(first.read(*catalog.floatVar(name + "_X")), 50.0F * static_cast<float>(id));
      QCOMPARE(first.read(*catalog.floatVar(name + "_Y")), 300.0F);
    }
    // Three with all they tell, by number: the nearest, the one that sees the ball, the one at it.
    QCOMPARE(value(first, "COM_POS_ROBOT1"), 100 * 10000 + 300);
    QCOMPARE(value(first, "COM_POS_ROBOT2"), 400 * 10000 + 300);
    QCOMPARE(value(first, "COM_POS_BALL_ROBOT2"), 450 * 10000 + 200);
    QCOMPARE(value(first, "COM_POS_ROBOT3"), 550 * 10000 + 300);
    QCOMPARE(value(first, "COM_ACTION_ROBOT3"), 3);
    robots[0].step(60.0);   // hears what still waited
    robots[0].step(120.0);  // all fell silent
    QCOMPARE(first.read(*catalog.floatVar("LOCALIZATION_RBT11_X")), -1.0F);
    QCOMPARE(value(first, "COM_STATE_ROBOT1"), 0);
  }

  void udpReachesTheTeamOnThisComputerOnly() {
    const int team = 40 + static_cast<int>(QCoreApplication::applicationPid() % 50);
    auto one = makeUdpTeamChannel("127.0.0.1", team);
    auto two = makeUdpTeamChannel("127.0.0.1", team);
    auto other = makeUdpTeamChannel("127.0.0.1", team == 99 ? 40 : team + 1);
    QVERIFY2(one && two && other, one ? "" : one.error().text().c_str());
    (*one)->post(RobotId{1}, "hello");
    std::vector<std::string> received;
    const auto listen = [&] {  // QTRY_VERIFY asks once more after the answer was yes
      for (std::string& text : (*two)->take(RobotId{2})) received.push_back(std::move(text));
      return !received.empty();
    };
    QTRY_VERIFY(listen());
    QCOMPARE(received, (std::vector<std::string>{"hello"}));
    QVERIFY((*one)->take(RobotId{1}).empty());  // not its own words
    QVERIFY((*other)->take(RobotId{3}).empty());
  }

  void udpRefusesWhatCannotWork() {
    QVERIFY(!makeUdpTeamChannel("no address", 1));
    QVERIFY(!makeUdpTeamChannel("127.0.0.1", -1));
    QVERIFY(!makeUdpTeamChannel("127.0.0.1", 100));
  }

  void poseBallAndIntentionArrive() {
    const auto channel = std::make_shared<InProcessTeamChannel>();
    Robot a(4, channel), b(2, channel);
    const VariableCatalog& names = VariableCatalog::published();
    a.board.write(a.v.localizationX, 321);
    a.board.write(a.v.localizationY, 45);
    a.board.write(*names.intVar("DECISION_STATE"), 3);
    a.board.write(*names.floatVar("LOCALIZATION_BALL_X"), 400.0F);
    a.board.write(*names.floatVar("LOCALIZATION_BALL_Y"), 7.0F);
    b.step(0.1);
    a.step(0.1);
    b.step(0.3);
    QCOMPARE(value(b.board, "COM_STATE_ROBOT1"), 1);
    QCOMPARE(value(b.board, "COM_POS_ROBOT1"), 3210045);
    QCOMPARE(value(b.board, "COM_POS_BALL_ROBOT1"), 4000007);
    QCOMPARE(value(b.board, "COM_ACTION_ROBOT1"), 3);
    QCOMPARE(value(b.board, "COM_STATE_ROBOT2"), 0);
    b.step(5.0);  // silence
    QCOMPARE(value(b.board, "COM_STATE_ROBOT1"), 0);
    QCOMPARE(value(b.board, "COM_POS_ROBOT1"), -1);
  }

  void invalidMessagesAreIgnored_data() {
    QTest::addColumn<QString>("text");
    QTest::newRow("empty") << "";
    QTest::newRow("other") << "2 3 45.6";
    QTest::newRow("short") << "PB1 3 1 2";
    QTest::newRow("long") << "PB1 3 1 2 3 4 5 1 6 7";
    QTest::newRow("words") << "PB1 a b c d e f g h";
    QTest::newRow("huge") << "PB1 99999999999999 1 2 3 4 5 1 6";
    QTest::newRow("robot 0") << "PB1 0 1 2 3 4 5 1 6";
  }
  void invalidMessagesAreIgnored() {
    QFETCH(QString, text);
    const auto channel = std::make_shared<InProcessTeamChannel>();
    Robot b(2, channel);
    b.step(0.1);
    channel->post(RobotId{3}, text.toStdString());
    b.step(0.3);
    QCOMPARE(value(b.board, "COM_STATE_ROBOT1"), 0);
  }
};

PITCHBOARD_TEST(TestTeamChannel)

}  // namespace tst_team_channel

#include "tst_team_channel.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/naive_decision.h>

#include <QtTest>
#include <limits>

namespace tst_naive_decision {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr int stop = 0, turnLeft = 2, turnRight = 3, kickRight = 4, kickLeft = 5, walk = 8,
              gait = 11;
constexpr int untouched = -77;

}  // namespace

class TestNaiveDecision : public QObject {
  Q_OBJECT

  RobotVariables m_variables;

  Blackboard boardWithBall(int lost, float bearing, float distance) const {
    Blackboard board = Blackboard::onHeap();
    board.write(m_variables.comReferee, 2);
    board.write(m_variables.visionLost, lost);
    board.write(m_variables.visionPanDeg, bearing);
    board.write(m_variables.visionBallDist, distance);
    board.write(m_variables.decisionActionA, untouched);
    board.write(m_variables.decisionActionB, untouched);
    return board;
  }

 private slots:
  void rule_data() {
    QTest::addColumn<float>("bearing");
    QTest::addColumn<float>("distance");
    QTest::addColumn<double>("kick");
    QTest::addColumn<int>("action");
    QTest::addColumn<int>("b");
    const auto row = [](const char* name, float bearing, float distance, int action,
                        int b = untouched, double kick = 25) {
      QTest::newRow(name) << bearing << distance << kick << action << b;
    };
    row("left: 40 is ahead", 40, 10, kickLeft);
    row("left: 40.99 is 40", 40.99F, 10, kickLeft);
    row("left: 41", 41, 10, turnLeft);
    row("left: 159.99 is 159", 159.99F, 10, turnLeft);
    row("left: 160 counts as ahead", 160, 10, kickLeft);
    row("left: 180", 180, 100, walk, 20);
    row("right: -40 is ahead", -40, 10, kickRight);
    row("right: -40.99 is -40", -40.99F, 10, kickRight);
    row("right: -41", -41, 10, turnRight);
    row("right: -159.99 is -159", -159.99F, 10, turnRight);
    row("right: -160 counts as ahead", -160, 10, kickRight);
    row("foot: 0", 0, 10, kickRight);
    row("foot: 0.99 is 0", 0.99F, 10, kickRight);
    row("foot: 1", 1, 10, kickLeft);
    row("foot: -0.99", -0.99F, 10, kickRight);
    row("kick: just nearer", 0, std::nextafter(25.0F, 0.0F), kickRight);
    row("kick: exactly there", 0, 25, walk, 5);
    row("kick: the real robot's", 0, 39.99F, kickRight, untouched, 40);
    row("kick: at the real robot's", 0, 40, walk, 8, 40);
    row("kick: before the first word of vision", 0, 0, kickRight);
    row("kick: no ball is -1", 0, -1, kickRight);
    row("walk: 20 is too near", 0, 20, gait, untouched, 10);
    row("walk: above 20", 0, 20.01F, walk, 4, 10);
    row("walk: between kick and 20", 0, 15, gait, untouched, 10);
    row("walk: below 50, B truncated", 0, 49.99F, walk, 9);
    row("walk: the hole at 50", 0, 50, gait);
    row("walk: above 50", 0, 50.01F, walk, 10);
    row("walk: B of 299", 10, 299, walk, 59);
    row("walk: 40 degrees", 40, 100, walk, 20);
    row("huge", 1e30F, 1e30F, walk, std::numeric_limits<int>::max());
  }
  void rule() {
    QFETCH(float, bearing);
    QFETCH(float, distance);
    QFETCH(double, kick);
    QFETCH(int, action);
    QFETCH(int, b);
    Blackboard board = boardWithBall(0, bearing, distance);
    ProcessOptions options;
    options.parameters.distanceToKick = kick;
    const auto decision = makeNaiveDecision(options);
    QVERIFY(decision);
    (*decision)->step(board, {});
    QCOMPARE(board.read(m_variables.decisionActionA), action);
    QCOMPARE(board.read(m_variables.decisionActionB), b);
    QCOMPARE(board.read(m_variables.decisionSearchOn), 0);
    QCOMPARE(board.read(m_variables.decisionWorking), 1);
  }

  void lostBall_data() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float inf = std::numeric_limits<float>::infinity();
    QTest::addColumn<int>("lost");
    QTest::addColumn<float>("bearing");
    QTest::addColumn<float>("distance");
    QTest::newRow("lost, ball was near") << 1 << 0.0F << 10.0F;
    QTest::newRow("lost, ball was left") << 1 << 90.0F << 100.0F;
    QTest::newRow("bearing nan") << 0 << nan << 100.0F;
    QTest::newRow("distance nan") << 0 << 0.0F << nan;
    QTest::newRow("bearing inf") << 0 << -inf << 100.0F;
    QTest::newRow("distance inf") << 0 << 0.0F << inf;
  }
  void lostBall() {
    QFETCH(int, lost);
    QFETCH(float, bearing);
    QFETCH(float, distance);
    Blackboard board = boardWithBall(lost, bearing, distance);
    (*makeNaiveDecision({}))->step(board, {});
    QCOMPARE(board.read(m_variables.decisionActionA), turnRight);
    QCOMPARE(board.read(m_variables.decisionActionB), untouched);
    QCOMPARE(board.read(m_variables.decisionSearchOn), 1);
  }

  void referee_data() {
    QTest::addColumn<int>("code");
    QTest::addColumn<int>("action");
    QTest::newRow("nobody has spoken") << 0 << untouched;
    QTest::newRow("stop") << 1 << stop;
    QTest::newRow("play") << 2 << walk;
    QTest::newRow("ready") << 11 << stop;
    QTest::newRow("set") << 12 << stop;
    QTest::newRow("3") << 3 << untouched;
    QTest::newRow("10") << 10 << untouched;
    QTest::newRow("-1") << -1 << untouched;
  }
  void referee() {
    QFETCH(int, code);
    QFETCH(int, action);
    Blackboard board = boardWithBall(0, 0, 100);
    board.write(m_variables.comReferee, code);
    (*makeNaiveDecision({}))->step(board, {});
    QCOMPARE(board.read(m_variables.decisionActionA), action);
    QCOMPARE(board.read(m_variables.decisionActionB), code == 2 ? 20 : untouched);
    QCOMPARE(board.read(m_variables.decisionWorking), 1);
  }

  void writesNothingElse() {
    Blackboard board = boardWithBall(1, 0, 0);
    std::array<std::uint32_t, Blackboard::words> before{}, after{};
    board.copyWords(before);
    (*makeNaiveDecision({}))->step(board, {});
    board.copyWords(after);
    for (const IntVar written : {m_variables.decisionActionA, m_variables.decisionActionB,
                                 m_variables.decisionSearchOn, m_variables.decisionWorking}) {
      const auto word = static_cast<std::size_t>(written.index);
      before[word] = after[word];
    }
    QVERIFY(before == after);
  }

  void period() { QCOMPARE((*makeNaiveDecision({}))->period(), 0.25); }

  void refusesSenselessDistances() {
    ProcessOptions options;
    options.parameters.distanceToKick = std::numeric_limits<double>::quiet_NaN();
    const auto decision = makeNaiveDecision(options);
    QVERIFY(!decision);
    QCOMPARE(decision.error().code, ErrorCode::InvalidArgument);
    QVERIFY(QString::fromStdString(decision.error().text()).contains("distance_to_kick"));
  }
};

PITCHBOARD_TEST(TestNaiveDecision)

}  // namespace tst_naive_decision

#include "tst_naive_decision.moc"

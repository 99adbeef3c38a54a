// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>
#include <map>

#include <robotlink/match/blackboard_bridge.h>

namespace tst_blackboard_bridge {

using namespace pitchboard;
using namespace pitchboard::link;
using Words = std::array<std::uint32_t, Blackboard::words>;

namespace {

std::uint32_t pattern(int word) {
  return 0xabcd0000U + static_cast<std::uint32_t>(word);
}

Blackboard patterned() {
  Blackboard board = Blackboard::onHeap();
  for (int i = 0; i < Blackboard::words; ++i) board.write(IntVar{i}, static_cast<int>(pattern(i)));
  return board;
}

std::uint32_t f(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

sim::Percepts everything() {
  sim::Percepts p;
  p.control = {4, 1, 4};
  p.imu = {0.1, {{1.0, 2.0}}, {{3.0, 4.0, 5.0}}, {{6.0, 7.0, 8.0}}, 1, true};
  p.landmarks = {250.0, 33.0, {{10.0, -999.0, 30.0, 40.0}}};
  p.ball = {0, 123.5, -4.0, -5.0};
  p.robots[0] = sim::SeenRobot{50.0, 51.0};
  p.robots[10] = sim::SeenRobot{60.0, 61.0};
  p.searchOn = 0;
  p.decisionWorking = true;
  return p;
}

}  // namespace

class TestBlackboardBridge : public QObject {
  Q_OBJECT

  const BlackboardBridge m_bridge{RobotVariables()};

  void compareWords(const Blackboard& board, const std::map<int, std::uint32_t>& written) {
    Words words{};
    board.copyWords(words);
    for (int i = 0; i < Blackboard::words; ++i) {
      const auto found = written.find(i);
      const std::uint32_t expected = found == written.end() ? pattern(i) : found->second;
      QVERIFY2(words[static_cast<std::size_t>(i)] == expected,
               qPrintable(QString("word %1: %2, expected %3")
                              .arg(i)
                              .arg(words[static_cast<std::size_t>(i)], 0, 16)
                              .arg(expected, 0, 16)));
    }
  }

 private slots:
  void writesExactlyItsVariables() {
    Blackboard board = patterned();
    board.write(IntVar{17}, 4);  // DECISION_ACTION_A
    board.write(IntVar{4}, 1);   // IMU_RESET
    m_bridge.publish(everything(), board);
    // Word numbers worked out by hand from the published map: float j is word 125 + j.
    compareWords(
        board,
        {{3, 1},         {4, 0},       {13, 4},        {17, 0},          {57, 0},      {58, 0},
         {84, 1},        {101, 1},     {102, 1},       {104, 1},         {105, 1},     {106, 189},
         {126, f(3)},    {127, f(4)},  {128, f(5)},    {129, f(6)},      {130, f(7)},  {131, f(8)},
         {135, f(1)},    {136, f(2)},  {137, f(0.1F)}, {142, f(123.5F)}, {143, f(-4)}, {168, f(50)},
         {178, f(60)},   {179, f(51)}, {189, f(61)},   {190, f(250)},    {191, f(-5)}, {244, f(10)},
         {245, f(-999)}, {246, f(30)}, {247, f(40)}});
  }

  void absentPerceptsLeaveTheBoardAlone() {
    Blackboard board = patterned();
    sim::Percepts p;
    p.imu.eulerZ = 1.0;
    m_bridge.publish(p, board);
    compareWords(board, {{13, 0}, {101, 1}, {102, 1}, {105, 1}, {106, 189}, {137, f(1)}});
  }

  void bodyComesBeforeSight() {
    Blackboard board = patterned();
    m_bridge.publishBody(everything(), board);
    QCOMPARE(board.read(FloatVar{66}), 33.0F);
    QCOMPARE(board.read(IntVar{57}), static_cast<int>(pattern(57)));
    m_bridge.publishSight(everything(), board);
    QCOMPARE(board.read(FloatVar{66}), -5.0F);
    QCOMPARE(board.read(IntVar{57}), 0);
  }

  void aNewerActionIsNotLost() {
    Blackboard board = Blackboard::onHeap();
    board.write(IntVar{17}, 8);
    m_bridge.publish(everything(), board);
    QCOMPARE(board.read(IntVar{17}), 8);
  }

  void readsTheCommand() {
    Blackboard board = Blackboard::onHeap();
    const std::pair<int, int> values[] = {{17, 8}, {18, 20}, {58, 1}, {59, 2}, {107, 1}, {4, 1}};
    for (const auto& [index, value] : values) board.write(IntVar{index}, value);
    QVERIFY((m_bridge.read(board) == sim::RobotCommand{8, 20, 1, 2, 1, 1}));
  }

  void aSmallMapIsEnough() {
    const auto catalog = VariableCatalog::fromJson(R"({"int": {"VOLTAGE": 9}})", "small");
    QVERIFY(catalog);
    const RobotVariables variables(*catalog);
    QVERIFY(!variables.missing.empty());
    const BlackboardBridge bridge(variables);
    Blackboard board = patterned();
    bridge.publish(everything(), board);
    compareWords(board, {{9, 189}});
    QVERIFY(bridge.read(board) == sim::RobotCommand{});
  }

  void publishedMapLacksNothing() { QVERIFY(RobotVariables().missing.empty()); }
};

PITCHBOARD_TEST(TestBlackboardBridge)

}  // namespace tst_blackboard_bridge

#include "tst_blackboard_bridge.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>
#include <array>
#include <limits>

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/robot_variables.h>

namespace tst_blackboard {

using namespace pitchboard::link;

class TestBlackboard : public QObject {
  Q_OBJECT

 private slots:
  void heapStartsAtZero() {
    const Blackboard board = Blackboard::onHeap();
    std::array<std::uint32_t, Blackboard::words> words{};
    words.fill(1);
    board.copyWords(words);
    for (const std::uint32_t word : words) QCOMPARE(word, 0U);
    QCOMPARE(board.key(), 0);
    QVERIFY(!board.created());
  }

  void floatsLie125WordsOn() {
    Blackboard board = Blackboard::onHeap();
    board.write(IntVar{13}, -5);
    board.write(FloatVar{13}, 0.5F);
    board.write(FloatVar{Blackboard::floatVariables - 1}, -0.0F);
    std::array<std::uint32_t, Blackboard::words> words{};
    board.copyWords(words);
    QCOMPARE(words[13], 0xfffffffbU);
    QCOMPARE(words[138], 0x3f000000U);
    QCOMPARE(words[511], 0x80000000U);
    QCOMPARE(board.read(IntVar{13}), -5);
    QCOMPARE(board.read(FloatVar{13}), 0.5F);
    board.write(IntVar{0}, std::numeric_limits<int>::min());
    QCOMPARE(board.read(IntVar{0}), std::numeric_limits<int>::min());
  }

  void replaceKeepsANewerValue() {
    Blackboard board = Blackboard::onHeap();
    board.write(IntVar{17}, 4);
    QVERIFY(!board.replace(IntVar{17}, 5, 0));
    QCOMPARE(board.read(IntVar{17}), 4);
    QVERIFY(board.replace(IntVar{17}, 4, 0));
    QCOMPARE(board.read(IntVar{17}), 0);
  }

  void absentVariablesAreLeftAlone() {
    Blackboard board = Blackboard::onHeap();
    QCOMPARE(readOr(board, IntVar{-1}, 7), 7);
    QCOMPARE(readOr(board, FloatVar{-1}), 0.0F);
    writeIfPresent(board, FloatVar{-1}, 1.0F);  // would be int 124
    QCOMPARE(board.read(IntVar{124}), 0);
    QVERIFY(!replaceIfPresent(board, IntVar{-1}, 0, 1));
  }

  void movedBlackboardKeepsItsWords() {
    Blackboard board = Blackboard::onHeap();
    board.write(IntVar{3}, 9);
    Blackboard other = Blackboard::onHeap();
    other = std::move(board);
    QCOMPARE(other.read(IntVar{3}), 9);
  }
};

PITCHBOARD_TEST(TestBlackboard)

}  // namespace tst_blackboard

#include "tst_blackboard.moc"

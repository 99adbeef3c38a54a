// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>
#include <array>
#include <limits>

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/cycle_words.h>
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

  void cyclesAreAnnounced() {
    const auto words = cycleWordsFromText("decision=460:461,localization=459", "--record-cycles");
    QCOMPARE(words.value(), (std::vector<CycleWords>{{"decision", IntVar{460}, IntVar{461}},
                                                     {"localization", IntVar{459}, {}}}));
    QCOMPARE(cycleVariable("decision", clockSuffix), std::string("DECISION_CLOCK"));
    for (const char* wrong : {"", "decision", "decision=", "Decision=460", "decision=512",
                              "decision=460:", "decision=460:x", "decision=460,"}) {
      const auto refused = cycleWordsFromText(wrong, "--record-cycles");
      QVERIFY2(!refused && refused.error().message.find("--record-cycles") != std::string::npos,
               wrong);
    }
    Blackboard board = Blackboard::onHeap();
    CycleAnnouncer announcer(board, words->front());
    for (int n = 1; n <= 2; ++n) {
      // The cycle uses the time that stands on the blackboard, in whole milliseconds.
      const double seconds = announcer.begin(0.07 * n + 0.0004);
      QCOMPARE(board.read(IntVar{460}), n);
      QCOMPARE(board.read(IntVar{461}), 70 * n);
      QCOMPARE(seconds, 70 * n / 1000.0);
      announcer.end();
      QCOMPARE(board.read(IntVar{460}), -n);
    }
    // Match time comes through unchanged.
    for (int tick = 0; tick < 100'000; ++tick) {
      if (announcer.begin(tick / 100.0) != tick / 100.0) QFAIL(std::to_string(tick).c_str());
    }
  }

  void aClockBelongsToAProcessThatAnnouncesCycles() {
    const auto map = VariableCatalog::fromJson(
                         R"({"int": {"DECISION_CYCLE": 460, "DECISION_CLOCK": 461,
                             "GAME_CLOCK": 462}, "float": {}})",
                         "map.json")
                         .value();
    std::vector<std::string> announcements;
    for (const Variable& variable : map.variables()) {
      if (isAnnouncement(map, variable)) announcements.push_back(variable.name);
    }
    QCOMPARE(announcements, (std::vector<std::string>{"DECISION_CYCLE", "DECISION_CLOCK"}));
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

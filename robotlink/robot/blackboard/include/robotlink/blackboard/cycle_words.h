// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Words in which programs announce their cycles: an int variable whose name ends in _CYCLE has n
// from the beginning of cycle n, and −n once all of it is written (docs/agent.md, docs/
// robot-programs.md). A second one, whose name ends in _CLOCK, has the program's own time at that
// beginning, in ms. Pure functions; any thread.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>

namespace pitchboard::link {

inline constexpr std::string_view cycleSuffix = "_CYCLE", clockSuffix = "_CLOCK";
/// The value of a runtime profile that says where its reference processes announce their cycles,
/// as cycleWordsFromText() reads it; empty or missing: nowhere.
inline constexpr const char* announceCyclesValue = "announce_cycles";

inline bool announcesCycles(const Variable& variable) {
  return variable.type == VariableType::Int && variable.name.ends_with(cycleSuffix);
}
/// Returns whether a variable of this map only announces cycles, and is no value of the robot.
bool isAnnouncement(const VariableCatalog& catalog, const Variable& variable);

/// The words of one process.
struct CycleWords {
  std::string process;  ///< "decision"
  IntVar cycle;
  std::optional<IntVar> clock;
  bool operator==(const CycleWords&) const = default;
};

/// Reads texts such as "decision=460:461,localization=459". Fails with InvalidArgument; `option` is
/// what the sentence calls it.
Result<std::vector<CycleWords>> cycleWordsFromText(std::string_view text, std::string_view option);
/// Fails with InvalidArgument if the map has another variable in one of the words.
Result<void> checkFree(std::span<const CycleWords> words, const VariableCatalog& catalog,
                       std::string_view option);
/// Returns "DECISION_CYCLE" for decision and cycleSuffix.
std::string cycleVariable(std::string_view process, std::string_view suffix);

/// Announces the cycles of a process on its blackboard. Every announcement wakes a pitchboard-agent
/// that records it. One thread at a time.
class CycleAnnouncer {
 public:
  CycleAnnouncer(Blackboard& board, CycleWords words);
  CycleAnnouncer(const CycleAnnouncer&) = delete;
  CycleAnnouncer& operator=(const CycleAnnouncer&) = delete;
  ~CycleAnnouncer();

  /// Announces the beginning of a cycle at `seconds` of the process's clock. Returns this time in
  /// whole milliseconds, for the cycle to use: a rerun knows no other.
  double begin(double seconds);
  /// Announces that everything of the cycle is written.
  void end();

 private:
  void announce(int value);

  Blackboard& m_board;
  CycleWords m_words;
  const void* m_segment = nullptr;  ///< where the kernel finds who waits; null: on the heap
  int m_cycle = 0;
};

}  // namespace pitchboard::link

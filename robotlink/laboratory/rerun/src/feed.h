// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decides which words of a rerun's blackboard come from the recording, and when. Within a tick the
// processes of a robot take turns: what comes before a process is there when it runs, what comes
// after it appears behind it. What a chosen process writes is never fed to it, except at the
// beginning, and where another process shares the variable. Private to the module; one thread.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/blackboard/variable_meanings.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

/// The turn of a process in a tick: 0 for what the robot senses and hears, then the reference
/// processes in their order, and last what a team's own programs write.
int turnOf(std::string_view process);
constexpr int lastTurn = 100;

class Feed {
 public:
  /// `processes` are chosen; `patterns` name more variables that they write, and `fed` those of
  /// theirs that somebody else wrote in this recording.
  Feed(const VariableCatalog& catalog, std::span<const std::string> processes,
       std::span<const std::string> patterns, std::span<const std::string> fed = {});

  /// Finds the columns of the recorded robot.
  void setColumns(const telemetry::GroupInfo& group);
  /// Says that this process did not run on the robot, so that it shares no variable.
  void exclude(std::string_view process);
  bool isRecorded(const Variable& variable) const {
    return m_has[static_cast<std::size_t>(
        variable.index + (variable.type == VariableType::Int ? 0 : Blackboard::floatOffset))];
  }
  /// Takes a recorded row; it holds until the next one.
  void take(const telemetry::RowView& row);
  /// Forgets that the row belongs to this tick.
  void endTick() { m_isFresh = false; }
  /// Tells whether the robot's senses are written by others (RecordedWorld) from now on.
  void setSensed(bool elsewhere) { m_sensedElsewhere = elsewhere; }
  /// Tells that a chosen process has no fixed cycle: a flag that it sets just after the recorded
  /// one was cleared would stay set, so cleared flags count for nothing.
  void setFree() { m_isFree = true; }

  /// Writes every recorded word.
  void writeAll(Blackboard& board) const;
  /// Writes what others wrote before this turn; nothing if there is no row of this tick.
  void before(Blackboard& board, int turn) const;
  /// Writes what others wrote in the rest of the tick. Outputs of processes that are within a cycle
  /// (`running`) stay: the row is from its beginning, and they are already written.
  void after(Blackboard& board, std::span<const std::string> running = {}) const;
  /// Writes a value that a scenario planned; only if it is one of the outputs.
  void plan(Blackboard& board, std::string_view variable, double value) const;

  struct Output {
    Variable variable;
    telemetry::ColumnInfo column;
    bool isRecorded = false;
    std::string process;  ///< that writes it; empty: named by a pattern
  };
  /// Returns the variables that the chosen processes write.
  const std::vector<Output>& outputs() const { return m_outputs; }
  std::uint32_t word(std::size_t output) const {
    return m_now[static_cast<std::size_t>(wordOf(output))];
  }
  std::uint32_t word(const Blackboard& board, std::size_t output) const;
  /// Returns whether the recorded value of this moment is one that the chosen processes wrote.
  bool counts(std::size_t output) const;
  /// Returns outputs that never count, because it is unknown who wrote them: the variable, and the
  /// one that would tell but was not recorded.
  std::vector<std::pair<std::string, std::string>> undecided() const;

  /// Returns those of the variables that fit `patterns` (all if empty) that nobody writes here:
  /// neither the recording nor a chosen process nor, with `senses`, the senses.
  std::vector<std::string> missing(std::span<const std::string> patterns, bool senses) const;
  /// Returns those that are only known at the times of rows.
  std::vector<std::string> sampled(std::span<const std::string> patterns, bool senses) const;

 private:
  struct Word {
    Variable variable;
    int word = 0;
    VariableWriters writers;
    bool isOwn = false, isSense = false;
    int shares = -1;  // the word whose value tells who writes it; −1: nobody shares it
    bool isOursWhileSet = false;  // shared: it is the chosen one's while that word is not 0
    bool clearedByOther = false, clearedBySense = false, clearedByChosen = false, isFlag = false;
    std::uint32_t cleared = 0;  // what "not seen" or 0 is
    int writerTurn = 0, clearTurn = -1, alsoTurn = -1;
    // In a row.
    telemetry::ColumnType type = telemetry::ColumnType::Float64;
    int column = -1;
  };
  int wordOf(std::size_t output) const { return m_words[m_outputWords[output]].word; }
  bool isOthers(const Word& one) const;
  bool isCleared(const Word& one) const;
  void write(Blackboard& board, const Word& one) const;
  bool isWanted(const Word& one, std::span<const std::string> patterns) const;

  std::vector<Word> m_words;
  std::vector<Output> m_outputs;
  std::vector<std::size_t> m_outputWords;
  std::array<std::uint32_t, Blackboard::words> m_now{};
  std::array<bool, Blackboard::words> m_has{};
  bool m_isFresh = false, m_sensedElsewhere = false, m_isFree = false;
};

}  // namespace pitchboard::link

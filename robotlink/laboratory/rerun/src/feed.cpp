// SPDX-License-Identifier: GPL-3.0-or-later
#include "feed.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <base/wildcard.h>
#include <robotlink/blackboard/cycle_words.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/live/board_columns.h>

namespace pitchboard::link {
namespace {

constexpr std::array<std::string_view, 3> senses{"vision", "control", "imu"};

bool isOneOf(std::span<const std::string> processes, const std::string& name) {
  return !name.empty() && std::ranges::find(processes, name) != processes.end();
}

bool isSenseName(const std::string& name) {
  return std::ranges::find(senses, name) != senses.end();
}

/// The turn in which a process clears what it has read. Communication writes the referee's orders
/// at the beginning of a tick, and clears at its own turn.
int clearTurnOf(const std::string& name) {
  if (name.empty()) return -1;
  const auto known = referenceProcesses();
  const auto found = std::ranges::find(known, std::string_view(name), &ProcessInfo::name);
  return found == known.end() ? 0 : 1 + static_cast<int>(found - known.begin());
}

}  // namespace

int turnOf(std::string_view process) {
  if (process == "communication") return 0;
  return clearTurnOf(std::string(process)) > 0 ? clearTurnOf(std::string(process)) : 0;
}

Feed::Feed(const VariableCatalog& catalog, std::span<const std::string> processes,
           std::span<const std::string> patterns, std::span<const std::string> fed) {
  const auto isAmong = [](std::span<const std::string> some, const std::string& name) {
    return std::ranges::any_of(
        some, [&](const std::string& pattern) { return fitsWildcard(pattern, name); });
  };
  const VariableMeanings& meanings = VariableMeanings::published();
  for (const Variable& variable : catalog.variables()) {
    if (isAnnouncement(catalog, variable)) continue;  // no value of the robot: see RecordedCycles
    const bool isInt = variable.type == VariableType::Int;
    Word one;
    one.variable = variable;
    one.word = variable.index + (isInt ? 0 : Blackboard::floatOffset);
    one.writers = meanings.writers(variable.name);
    const bool isFed = isAmong(fed, variable.name);
    const bool writes =
        !isFed && (isOneOf(processes, one.writers.writer) || isAmong(patterns, variable.name));
    const bool alsoWrites = !isFed && isOneOf(processes, one.writers.alsoBy);
    one.isOwn = writes || alsoWrites;
    one.isSense = isSenseName(one.writers.writer);
    one.writerTurn = turnOf(one.writers.writer);
    one.clearTurn = clearTurnOf(one.writers.clearedBy);
    one.alsoTurn = clearTurnOf(one.writers.alsoBy);
    if (const auto absent = meanings.absent(variable.name); absent && !isInt) {
      one.cleared = std::bit_cast<std::uint32_t>(static_cast<float>(*absent));
    }
    if (one.isOwn && !one.writers.alsoBy.empty() && writes != alsoWrites) {
      // A map without that variable belongs to a team whose processes do not share it.
      const Variable* tells = catalog.find(one.writers.alsoWhile);
      one.shares =
          tells ? tells->index + (tells->type == VariableType::Int ? 0 : Blackboard::floatOffset)
                : -1;
      one.isOursWhileSet = alsoWrites;
    }
    const std::string& clearer = one.writers.clearedBy;
    one.clearedBySense = isSenseName(clearer);
    one.clearedByChosen = isOneOf(processes, clearer);
    one.clearedByOther = !clearer.empty() && !isOneOf(processes, clearer);
    if (one.isOwn) {
      telemetry::ColumnInfo column;
      column.name = variable.name;
      column.type = isInt ? telemetry::ColumnType::Int32 : telemetry::ColumnType::Float32;
      meanings.describe(column);
      one.isFlag = column.kind == telemetry::ColumnKind::Flag;
      m_outputs.push_back(
          {variable, std::move(column), false, writes ? one.writers.writer : one.writers.alsoBy});
      m_outputWords.push_back(m_words.size());
    }
    m_words.push_back(std::move(one));
  }
}

void Feed::setColumns(const telemetry::GroupInfo& group) {
  m_has = {};
  int words = 0, values = 0;
  for (Word& one : m_words) one.column = -1;
  for (const telemetry::ColumnInfo& column : group.columns) {
    const bool isWord = column.type != telemetry::ColumnType::Float64;
    const int index = isWord ? words++ : values++;
    const auto found = std::ranges::find_if(
        m_words, [&](const Word& one) { return one.variable.name == column.name; });
    if (found == m_words.end()) continue;
    const auto own = found->variable.type == VariableType::Int ? telemetry::ColumnType::Int32
                                                               : telemetry::ColumnType::Float32;
    if (isWord && column.type != own) continue;
    found->type = column.type;
    found->column = index;
    m_has[static_cast<std::size_t>(found->word)] = true;
  }
  for (std::size_t i = 0; i < m_outputs.size(); ++i) {
    const Word& one = m_words[m_outputWords[i]];
    m_outputs[i].isRecorded = one.column >= 0;
    // As the recording describes it: a team may have texts of its own for codes.
    for (const telemetry::ColumnInfo& column : group.columns) {
      if (one.column >= 0 && column.name == one.variable.name) m_outputs[i].column = column;
    }
  }
}

void Feed::exclude(std::string_view process) {
  for (Word& one : m_words) {
    if (one.writers.writer == process || one.writers.alsoBy == process) one.shares = -1;
  }
}

void Feed::take(const telemetry::RowView& row) {
  m_isFresh = true;
  for (const Word& one : m_words) {
    if (one.column < 0) continue;
    const auto index = static_cast<std::size_t>(one.column);
    std::uint32_t& word = m_now[static_cast<std::size_t>(one.word)];
    const bool isInt = one.variable.type == VariableType::Int;
    if (one.type != telemetry::ColumnType::Float64) {
      if (index >= row.words.size()) continue;
      word = row.words[index];
    } else {
      // A variable that some rows of the robot do not have.
      if (index >= row.values.size() || std::isnan(row.values[index])) continue;
      const double value = row.values[index];
      word = isInt ? std::bit_cast<std::uint32_t>(
                         static_cast<std::int32_t>(std::clamp(value, -2147483648.0, 2147483647.0)))
                   : std::bit_cast<std::uint32_t>(static_cast<float>(value));
    }
    if (!isInt) word = BoardColumns::boardWord(one.variable.name, word);
  }
}

/// That it has read and cleared an input is what a chosen process does itself.
void Feed::write(Blackboard& board, const Word& one) const {
  const std::uint32_t word = m_now[static_cast<std::size_t>(one.word)];
  if (one.clearedByChosen && word == one.cleared) return;
  board.write(IntVar{one.word}, std::bit_cast<std::int32_t>(word));
}

void Feed::writeAll(Blackboard& board) const {
  for (const Word& one : m_words) {
    if (one.column < 0) continue;
    board.write(IntVar{one.word},
                std::bit_cast<std::int32_t>(m_now[static_cast<std::size_t>(one.word)]));
  }
}

void Feed::before(Blackboard& board, int turn) const {
  if (!m_isFresh) return;
  for (const Word& one : m_words) {
    if (one.isOwn || one.column < 0) continue;
    const bool sensed = one.isSense && m_sensedElsewhere;
    const bool byWriter = !sensed && one.writerTurn < turn;
    const bool byClearer = one.clearTurn > 0 && one.clearTurn < turn;
    const bool byOther = one.alsoTurn > 0 && one.alsoTurn < turn;
    if (byWriter || byClearer || byOther) write(board, one);
  }
}

/// Whether the recorded value of a shared output was written by a process that is not rerun.
bool Feed::isOthers(const Word& one) const {
  if (one.shares < 0) return false;
  const auto tells = static_cast<std::size_t>(one.shares);
  return !m_has[tells] || (m_now[tells] != 0) != one.isOursWhileSet;
}

/// Whether another process may have cleared the recorded value of an output.
bool Feed::isCleared(const Word& one) const {
  const bool known = one.clearedBySense && m_sensedElsewhere && !(m_isFree && one.isFlag);
  return one.clearedByOther && !known && m_now[static_cast<std::size_t>(one.word)] == one.cleared;
}

void Feed::after(Blackboard& board, std::span<const std::string> running) const {
  if (!m_isFresh) return;
  for (const Word& one : m_words) {
    const bool isKept =
        one.isOwn && (isOneOf(running, one.writers.writer) || isOneOf(running, one.writers.alsoBy));
    const bool isFed = !one.isOwn || isOthers(one) || isCleared(one);
    if (one.column >= 0 && isFed && !isKept) write(board, one);
  }
}

void Feed::plan(Blackboard& board, std::string_view variable, double value) const {
  for (const Output& output : m_outputs) {
    if (output.variable.name != variable) continue;
    if (output.variable.type == VariableType::Int) {
      board.write(IntVar{output.variable.index}, static_cast<int>(value));
    } else {
      board.write(FloatVar{output.variable.index}, static_cast<float>(value));
    }
  }
}

std::uint32_t Feed::word(const Blackboard& board, std::size_t output) const {
  return std::bit_cast<std::uint32_t>(board.read(IntVar{wordOf(output)}));
}

bool Feed::counts(std::size_t output) const {
  const Word& one = m_words[m_outputWords[output]];
  return m_isFresh && one.column >= 0 && !isOthers(one) && !isCleared(one);
}

std::vector<std::pair<std::string, std::string>> Feed::undecided() const {
  std::vector<std::pair<std::string, std::string>> out;
  for (const Word& one : m_words) {
    const bool unknown = one.shares >= 0 && !m_has[static_cast<std::size_t>(one.shares)];
    if (one.isOwn && unknown) out.emplace_back(one.variable.name, one.writers.alsoWhile);
  }
  return out;
}

bool Feed::isWanted(const Word& one, std::span<const std::string> patterns) const {
  return patterns.empty() || std::ranges::any_of(patterns, [&](const std::string& pattern) {
           return fitsWildcard(pattern, one.variable.name);
         });
}

std::vector<std::string> Feed::missing(std::span<const std::string> patterns, bool sensed) const {
  std::vector<std::string> names;
  for (const Word& one : m_words) {
    const bool given = one.isOwn || one.column >= 0 || (sensed && one.isSense);
    if (!given && isWanted(one, patterns)) names.push_back(one.variable.name);
  }
  return names;
}

std::vector<std::string> Feed::sampled(std::span<const std::string> patterns, bool sensed) const {
  std::vector<std::string> names;
  for (const Word& one : m_words) {
    const bool isRow = !one.isOwn && one.column >= 0 && !(sensed && one.isSense);
    if (isRow && isWanted(one, patterns)) names.push_back(one.variable.name);
  }
  return names;
}

}  // namespace pitchboard::link

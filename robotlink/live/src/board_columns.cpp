// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/board_columns.h>

#include <bit>
#include <limits>

#include <robotlink/blackboard/variable_meanings.h>

namespace pitchboard::link {
namespace {

constexpr auto hole = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN());

}  // namespace

BoardColumns::BoardColumns(std::span<const Variable> variables) {
  const VariableMeanings& meanings = VariableMeanings::published();
  for (const Variable& variable : variables) {
    const bool isInt = variable.type == VariableType::Int;
    telemetry::ColumnInfo column;
    column.name = variable.name;
    column.type = isInt ? telemetry::ColumnType::Int32 : telemetry::ColumnType::Float32;
    meanings.describe(column);
    // A team may use the same name for a number that is not a code: only whole numbers have labels.
    if (!isInt) {
      column.kind = telemetry::ColumnKind::Number;
      column.labels.clear();
    }
    if (const auto absent = meanings.absent(variable.name); absent && !isInt) {
      m_holes.push_back(
          {m_columns.size(), std::bit_cast<std::uint32_t>(static_cast<float>(*absent))});
    }
    m_columns.push_back(std::move(column));
    m_words.push_back(
        static_cast<std::uint16_t>(variable.index + (isInt ? 0 : Blackboard::floatOffset)));
  }
}

void BoardColumns::read(const Blackboard& board, std::span<std::uint32_t> out) const {
  std::array<std::uint32_t, Blackboard::words> words;
  board.copyWords(words);
  for (std::size_t i = 0; i < m_words.size(); ++i) out[i] = words[m_words[i]];
  makeHoles(out);
}

void BoardColumns::makeHoles(std::span<std::uint32_t> words) const {
  for (const Hole& one : m_holes) {
    if (words[one.column] == one.absent) words[one.column] = hole;
  }
}

std::uint32_t BoardColumns::boardWord(std::string_view name, std::uint32_t word) {
  if (word != hole) return word;
  const auto absent = VariableMeanings::published().absent(name);
  return absent ? std::bit_cast<std::uint32_t>(static_cast<float>(*absent)) : word;
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A blackboard as a row: the variables of a catalog as columns (ints by index, then floats by
// index), with unit, category and words from resources/variables.json.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

/// A value that does not change; any thread.
class BoardColumns {
 public:
  explicit BoardColumns(const VariableCatalog& catalog) : BoardColumns(catalog.variables()) {}
  explicit BoardColumns(std::span<const Variable> variables);

  const std::vector<telemetry::ColumnInfo>& columns() const { return m_columns; }
  std::size_t size() const { return m_words.size(); }
  /// The words of the columns, in their order; `out` has size() words. A float that says "not seen"
  /// (VariableMeanings::absent) is NaN, so that it is a hole in every curve.
  void read(const Blackboard& board, std::span<std::uint32_t> out) const;
  /// The same for words that were read elsewhere.
  void makeHoles(std::span<std::uint32_t> words) const;
  /// What stood on the blackboard where the row of a float has this word: a hole is "not seen"
  /// again, every other word is itself.
  static std::uint32_t boardWord(std::string_view name, std::uint32_t word);

 private:
  std::vector<telemetry::ColumnInfo> m_columns;
  std::vector<std::uint16_t> m_words;  // place of each column on the blackboard
  struct Hole {
    std::size_t column;
    std::uint32_t absent;  // the word of that float
  };
  std::vector<Hole> m_holes;
};

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts a blackboard to a row: the variables of a catalog become columns (ints by index, then
// floats by index), with unit, category and texts from resources/variables.json.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

/// An immutable value; any thread.
class BoardColumns {
 public:
  explicit BoardColumns(const VariableCatalog& catalog) : BoardColumns(catalog.variables()) {}
  explicit BoardColumns(std::span<const Variable> variables);

  const std::vector<telemetry::ColumnInfo>& columns() const { return m_columns; }
  std::size_t size() const { return m_words.size(); }
  /// Reads the words of the columns into `out`, which has size() words. A float that means "not
  /// seen" (VariableMeanings::absent) becomes NaN, so that every curve has a gap.
  void read(const Blackboard& board, std::span<std::uint32_t> out) const;
  /// The same for words that were read elsewhere.
  void makeHoles(std::span<std::uint32_t> words) const;
  /// Converts a word of a float column back to the blackboard: NaN becomes "not seen", every other
  /// word is unchanged.
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

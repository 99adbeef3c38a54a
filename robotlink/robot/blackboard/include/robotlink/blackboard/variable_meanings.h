// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What blackboard variables mean to people: unit, category, texts of codes, and a description, all
// read from resources/variables.json. Pitchboard applies them by name, so a team's own variables
// get a unit and a category, too. Plain values; any thread.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

/// The processes that write a variable, by name ("decision"). An empty name: there is none.
struct VariableWriters {
  std::string writer;     ///< empty: unknown
  std::string clearedBy;  ///< sets it to 0, or to "not seen", once it has read it
  std::string alsoBy;     ///< writes it, too, while the variable alsoWhile is not 0
  std::string alsoWhile;
  bool operator==(const VariableWriters&) const = default;
};

class VariableMeanings {
 public:
  /// Returns the rules of resources/variables.json, which are read once.
  static const VariableMeanings& published();
  /// Reads rules from a text. Fails with ParseError and "source:line: path".
  static Result<VariableMeanings> parse(std::string_view text, std::string_view source);

  /// Fills category, unit, kind, labels and `lost` of a column that has a name: the first rule that
  /// fits decides each of them, but every rule that fits adds its condition to `lost`.
  void describe(telemetry::ColumnInfo& column) const;
  /// Fills `lost` of a group from a session whose file does not say which variables can hold an
  /// old value, as this program would record it. Does nothing if any column says it already.
  void describeLost(telemetry::GroupInfo& group) const;
  /// Returns the value of this variable that means "not seen", or nothing if every value counts.
  std::optional<double> absent(std::string_view name) const;
  /// Returns who writes the variable: what the first rule that fits and names a writer says. A
  /// team's own variable gets the writer that its name begins with.
  VariableWriters writers(std::string_view name) const;
  /// Returns what the variable is for, in one sentence for people without a full stop.
  std::string_view description(std::string_view name) const;

 private:
  struct Rule {
    std::string name;  // with * for any text
    std::string description;
    std::optional<std::string> category, unit;
    std::optional<telemetry::ColumnKind> kind;
    std::map<std::int32_t, std::string> labels;
    std::optional<double> absent;
    std::optional<std::string> lostBy;  // telemetry::LostWhen
    double lostWhen = 1.0;
    VariableWriters writers;
  };
  std::vector<Rule> m_rules;
};

}  // namespace pitchboard::link

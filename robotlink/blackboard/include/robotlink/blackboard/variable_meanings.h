// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What blackboard variables mean to a reader (unit, category, words for codes), from
// resources/variables.json. Values; any thread.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

class VariableMeanings {
 public:
  /// Those of resources/variables.json. Read once; any thread.
  static const VariableMeanings& published();
  /// Error ParseError with "source:line: path".
  static Result<VariableMeanings> parse(std::string_view text, std::string_view source);

  /// Fills everything but name and type.
  void describe(telemetry::ColumnInfo& column) const;
  /// Of a session that was recorded before files said which variables can be lost: those that this
  /// program would record so (telemetry::ColumnInfo::lostBy).
  void describeLost(telemetry::GroupInfo& group) const;
  /// The value of this variable that says "not seen"; nothing where each is a value.
  std::optional<double> absent(std::string_view name) const;

 private:
  struct Rule {
    std::string name;  // with * for any text
    std::optional<std::string> category, unit;
    std::optional<telemetry::ColumnKind> kind;
    std::map<std::int32_t, std::string> labels;
    std::optional<double> absent;
    std::optional<std::string> lostBy;  // telemetry::ColumnInfo
    double lostWhen = 1.0;
  };
  std::vector<Rule> m_rules;
};

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rules: named conditions that must not hold, in a JSON file (docs/rules.md). They are checked in
// recordings (findMoments()), in rows that come (MomentWatch) and in the runs of experiments. Plain
// values; any thread. Times are seconds.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <base/lined_json.h>
#include <base/result.h>
#include <telemetry/query/find_moments.h>

namespace pitchboard::telemetry {

enum class RuleSeverity : std::uint8_t { Note, Warning, Error };
inline constexpr std::array<std::string_view, 3> ruleSeverityNames{"note", "warning", "error"};
constexpr std::string_view nameOf(RuleSeverity severity) {
  return ruleSeverityNames[static_cast<std::size_t>(severity)];
}

struct Rule {
  std::string name;  ///< letters, digits and '_'; unique in its file
  std::string
      text;  ///< what is wrong where the condition holds; the condition if the file has none
  MomentQuestion question;
  RuleSeverity severity = RuleSeverity::Error;
};

/// Reads a file. Fails with ParseError and the place, or as readFile() does.
Result<std::vector<Rule>> rulesFromFile(const std::string& path);
Result<std::vector<Rule>> rulesFromJson(std::string_view text, std::string_view source);
/// Reads the list under the key `rules`, which must be there. Errors are in the report.
std::vector<Rule> rulesOf(const JsonObject& object, JsonReport& report);

std::vector<MomentQuestion> questionsOf(const std::vector<Rule>& rules);

/// Returns the columns of a table of moments at which rules were broken, as CSV, and a line of it.
std::string brokenRuleCsvHead();
std::string brokenRuleCsv(const std::string& session, const Rule& rule, const FoundMoment& moment);

}  // namespace pitchboard::telemetry

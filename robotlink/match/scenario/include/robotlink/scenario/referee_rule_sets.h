// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads and writes referee rules: the name of a built-in set (resources/rules/*.json), or an object
// with the name and what differs. Plain values; any thread.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <simcore/world/referee_rules.h>

namespace pitchboard::link {

struct RuleSetInfo {
  std::string name;  ///< its name in files; "published" means no referee
  std::string title;
  std::string description;
};

/// Returns the built-in sets, "published" first.
std::vector<RuleSetInfo> refereeRuleSets();
/// Reads rules; nothing for "published". Errors name the known sets, or file, line and key.
Result<std::optional<sim::RefereeRules>> refereeRuleSet(std::string_view name);
/// Reads a file of rules as in resources/rules. Errors: "my.json:14: ready_time: ...".
Result<sim::RefereeRules> refereeRulesFromJson(std::string_view text, std::string_view source);

}  // namespace pitchboard::link

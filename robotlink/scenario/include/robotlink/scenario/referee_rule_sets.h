// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The built-in rule sets of the referee (resources/rules/*.json), and how rules are written in
// files: the name of a set, or an object with the name and what differs. Any thread.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <simcore/world/referee_rules.h>

namespace pitchboard::link {

struct RuleSetInfo {
  std::string name;  ///< as in files; "published" is no referee
  std::string title;
  std::string description;
};

/// "published" first.
std::vector<RuleSetInfo> refereeRuleSets();
/// Nothing for "published". Errors name the known sets, or file, line and key.
Result<std::optional<sim::RefereeRules>> refereeRuleSet(std::string_view name);
/// A file of rules as in resources/rules. Errors: "my.json:14: ready_time: ...".
Result<sim::RefereeRules> refereeRulesFromJson(std::string_view text, std::string_view source);

}  // namespace pitchboard::link

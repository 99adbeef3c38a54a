// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/action_codes.h>

namespace pitchboard {

std::string actionLabel(int code) {
  const bool known = code >= 0 && code < static_cast<int>(knownActions.size());
  return known ? std::string(knownActions[static_cast<std::size_t>(code)].label)
               : "action " + std::to_string(code);
}

std::map<std::int32_t, std::string> actionLabels() {
  std::map<std::int32_t, std::string> labels;
  for (const ActionInfo& action : knownActions) labels.emplace(action.code, action.label);
  return labels;
}

}  // namespace pitchboard

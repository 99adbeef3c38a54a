// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/group_order.h>

namespace pitchboard::telemetry {

bool isListedBefore(const GroupInfo& group, const GroupInfo& other) {
  const auto &a = factsOf(group).order, &b = factsOf(other).order;
  return a != b ? a < b : a.has_value() && group.name < other.name;
}

}  // namespace pitchboard::telemetry

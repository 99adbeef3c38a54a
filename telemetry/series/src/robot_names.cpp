// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/robot_names.h>

#include <algorithm>
#include <string>

#include <telemetry/series/group_order.h>

namespace pitchboard::telemetry {
namespace {

std::string joinedNames(std::span<const GroupInfo* const> groups) {
  std::string names;
  for (const std::size_t g :
       listedOrder(groups, [](const GroupInfo* group) -> const GroupInfo& { return *group; })) {
    if (groups[g]->match) continue;  // no robot
    names += (names.empty() ? "" : ", ") + groups[g]->name;
  }
  return names.empty() ? "none" : names;
}

}  // namespace

void keepFormerNames(const GroupInfo& before, GroupInfo& now) {
  if (!now.robot) return;
  std::vector<std::string> names = factsOf(before).formerNames;
  if (std::ranges::count(names, before.name) == 0) names.push_back(before.name);
  std::erase(names, now.name);  // it is not former if it comes back
  now.robot->formerNames = std::move(names);
}

Result<std::vector<GroupId>> groupsNamed(std::string_view name,
                                         std::span<const GroupInfo* const> groups) {
  std::vector<GroupId> found;
  for (GroupId id = 0; id < groups.size(); ++id) {
    if (groups[id]->name == name) return std::vector<GroupId>{id};
    if (std::ranges::count(factsOf(*groups[id]).formerNames, name) > 0) found.push_back(id);
  }
  const std::string quoted = "\"" + std::string(name.substr(0, 80)) + "\"";
  if (found.empty()) {
    return failure(ErrorCode::NotFound,
                   "There is no robot " + quoted + "; there are: " + joinedNames(groups) + ".");
  }
  std::vector<const GroupInfo*> robots;
  for (const GroupId id : found) robots.push_back(groups[id]);
  const RobotUid first = factsOf(*robots.front()).uid;
  const bool isOne = std::ranges::all_of(
      robots, [first](const GroupInfo* group) { return factsOf(*group).uid == first; });
  if (isOne && (first != RobotUid{} || found.size() == 1)) return found;
  return failure(ErrorCode::InvalidArgument,
                 "Several robots were called " + quoted +
                     ". Use one of their present names: " + joinedNames(robots) + ".");
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "world_columns.h"

#include <robotlink/capi/worlds.h>

namespace pitchboard::link {
namespace {

/// Collects names and words.
struct Listing {
  std::vector<WorldColumn> columns;
  template <class Value>
  void operator()(std::string_view name, std::string_view description, const Value& /*value*/) {
    columns.push_back({name, description});
  }
};

std::vector<WorldColumn> list(WorldArray array) {
  Listing listing;
  switch (array) {
    case WorldArray::Percepts:
      columns::visitPercepts({}, listing);
      break;
    case WorldArray::Robots:
      columns::visitRobot({}, listing);
      break;
    case WorldArray::Game:
      columns::visitGame({}, {}, 0, listing);
      break;
  }
  return std::move(listing.columns);
}

}  // namespace

std::span<const WorldColumn> columnsOf(WorldArray array) {
  static const std::array<std::vector<WorldColumn>, worldArrays> lists{
      list(WorldArray::Percepts), list(WorldArray::Robots), list(WorldArray::Game)};
  return lists[static_cast<std::size_t>(array)];
}

std::span<const WorldColumn> commandColumns() {
  static constexpr std::array<WorldColumn, 6> list{{
      {"DECISION_ACTION_A", "code of the action"},
      {"DECISION_ACTION_B", "its parameter"},
      {"DECISION_SEARCH_ON", "1: the head searches"},
      {"DECISION_ACTION_VISION", "what vision looks for: 0 ball, 1 team-mates, 2 opponents"},
      {"DECISION_LOCALIZATION", "0: the ball as a landmark, 1: corners"},
      {"IMU_RESET", "1: the IMU's yaw becomes zero"},
  }};
  return list;
}

}  // namespace pitchboard::link

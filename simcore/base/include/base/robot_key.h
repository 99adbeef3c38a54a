// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Identifies a robot for everything that shows or stores robots, whatever their source. Values.

#include <algorithm>
#include <compare>
#include <utility>
#include <vector>

namespace pitchboard {

/// A robot of a match: simulated, live or recorded.
struct RobotKey {
  int team = 0;    ///< index in the source's table of teams, from 1; 0: unknown
  int number = 0;  ///< number on the shirt; 0: no robot
  int sender = 0;  ///< 0: the first program with that number; 1, 2, ...: others
  auto operator<=>(const RobotKey&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The order in which robots are listed, on the screen and in files: our team before the others,
/// then by team, number and sender.
struct RobotOrder {
  bool isTheirs = true;
  RobotKey robot;
  auto operator<=>(const RobotOrder&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// A robot continues under another key.
struct Renaming {
  RobotKey from, to;
};
/// Returns what a key becomes by these renamings, which happen at the same time.
inline RobotKey renamed(const RobotKey& robot, const std::vector<Renaming>& renamings) {
  const auto found = std::ranges::find(renamings, robot, &Renaming::from);
  return found == renamings.end() ? robot : found->to;
}
/// Renames the entries of a set or map.
template <class Entries>
void rename(Entries& entries, const std::vector<Renaming>& renamings) {
  Entries now;
  while (!entries.empty()) {
    auto node = entries.extract(entries.begin());
    if constexpr (requires { node.mapped(); }) {
      node.key() = renamed(node.key(), renamings);
    } else {
      node.value() = renamed(node.value(), renamings);
    }
    now.insert(std::move(node));
  }
  entries = std::move(now);
}

}  // namespace pitchboard

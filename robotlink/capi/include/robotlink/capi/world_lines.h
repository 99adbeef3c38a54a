// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Worlds behind lines of JSON (docs/worlds.md): a request is an object on a line, and so is its
// answer. Whatever a line holds, there is an answer, and the next line is served. Units and shapes
// are those of Worlds. For one thread; owned by whoever reads the lines.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/capi/worlds.h>

namespace pitchboard::link {

/// What a request may ask for at most; a test of hostile lines allows less.
struct WorldLineLimits {
  int worlds = 4096;
  int ticks = Worlds::mostTicks;              ///< of one step, all worlds together
  bool files = true;                          ///< scenarios may be files, not only built-in names
  std::size_t snapshots = 1000;               ///< kept at a time
  std::size_t values = std::size_t{1} << 20;  ///< of one answer or request
};

class WorldLines {
 public:
  using Limits = WorldLineLimits;
  /// A longer line is refused without being looked at.
  static constexpr std::size_t longestLine = std::size_t{4} << 20;

  /// `usual`: what a `create` without a scenario makes worlds of.
  explicit WorldLines(Scenario usual, const Limits& limits = {});

  /// The answer: an object on one line, without the line's end. It has "ok", and an "error" when
  /// that is false; the "id" of the request is repeated.
  std::string answer(std::string_view line);
  /// What "do" may say; the table of docs/worlds.md has a row for each.
  static std::vector<std::string_view> requests();

 private:
  friend class WorldRequest;  // carries one line out; private to the library

  Scenario m_usual;
  Limits m_limits;
  std::optional<Worlds> m_worlds;
  std::map<int, WorldSnapshot> m_snapshots;
  int m_lastSnapshot = 0;
};

}  // namespace pitchboard::link

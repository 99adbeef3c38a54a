// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Controls Worlds with lines of JSON (docs/worlds.md). Each request and each answer is an object
// on a line. Every line gets an answer, even an invalid one. Units and shapes are those of Worlds.
// Used on one thread.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/capi/worlds.h>

namespace pitchboard::link {

/// Limits for requests.
struct WorldLineLimits {
  int worlds = 4096;
  int ticks = Worlds::maxTicks;               ///< in one step, all worlds together
  bool files = true;                          ///< scenarios may be files, not only built-in names
  std::size_t snapshots = 1000;               ///< kept at the same time
  std::size_t values = std::size_t{1} << 20;  ///< in one request or answer
};

class WorldLines {
 public:
  using Limits = WorldLineLimits;
  /// A longer line is refused without being parsed.
  static constexpr std::size_t maxLineLength = std::size_t{4} << 20;

  /// `usual` is the scenario of a `create` request that names none.
  explicit WorldLines(Scenario usual, const Limits& limits = {});

  /// Carries out a request and returns the answer without a line end: an object with "ok", with
  /// "error" if that is false, and with the "id" of the request.
  std::string answer(std::string_view line);
  /// Returns the possible values of "do"; docs/worlds.md describes each.
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

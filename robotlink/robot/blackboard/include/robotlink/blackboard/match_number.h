// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The number of a match on this computer, from which the keys of its blackboards and its UDP ports
// follow, so that two matches never share a blackboard or receive each other's messages. Match 0
// has the published keys and ports. Plain values; any thread.

#include <functional>
#include <string>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard::link {

struct MatchNumber {
  /// Higher numbers would use ports that the system assigns itself (from 32768).
  static constexpr int most = 45;

  int value = 0;

  /// The key of a blackboard is this + 100 × robot number.
  constexpr int keyBase() const { return value * 10'000; }
  /// Telemetry goes to this port + robot number (1 to 64).
  constexpr int telemetryPortBase() const { return value == 0 ? 1240 : block(); }
  /// Port of drawings from programs on this computer (docs/drawings.md).
  constexpr int drawingPort() const { return telemetryPortBase(); }
  /// The published team messages go to this port + 1 to 4.
  constexpr int teamPortBase() const { return value == 0 ? 1230 : block() + 70; }
  /// Robots of a team talk on this port + the team's number (0 to 99).
  constexpr int channelPortBase() const { return value == 0 ? 10'000 : block() + 100; }
  /// Ports of the GameController's packets and of the robots' answers.
  constexpr int refereePort() const { return value == 0 ? 3838 : block() + 200; }

  bool operator==(const MatchNumber&) const = default;

 private:
  constexpr int block() const { return 20'000 + 250 * value; }
};

/// The right to play the match of this number. The kernel frees it if its owner ends in any way.
class MatchClaim {
 public:
  /// Fails with Conflict if this or another program already plays it.
  static Result<MatchClaim> take(int number);
  /// Takes the smallest free number that suits the caller; without `suits` each of them does.
  static Result<MatchClaim> takeFree(const std::function<bool(MatchNumber)>& suits = {});

  MatchNumber number() const { return m_number; }
  /// Returns who plays match 0 if takeFree() took another number: "pitchboard, process 123".
  const std::string& publishedHolder() const { return m_publishedHolder; }

 private:
  MatchClaim(MatchNumber number, UniqueFd socket, std::string publishedHolder)
      : m_number(number),
        m_socket(std::move(socket)),
        m_publishedHolder(std::move(publishedHolder)) {}

  MatchNumber m_number;
  UniqueFd m_socket;
  std::string m_publishedHolder;
};

}  // namespace pitchboard::link

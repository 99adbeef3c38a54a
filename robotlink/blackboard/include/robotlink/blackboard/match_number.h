// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The identity of a match on this computer: one number, from which the keys of its blackboards and
// its UDP ports follow, so that robots of two matches never share a blackboard and never hear each
// other. Match 0 has the published keys and ports. Any thread.

#include <string>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard::link {

struct MatchNumber {
  /// Above that the ports would reach those that the system gives away (32768).
  static constexpr int most = 45;

  int value = 0;

  /// Key of a blackboard: this + 100 × robot number.
  constexpr int keyBase() const { return value * 10'000; }
  /// Telemetry goes to this + robot number (1..64).
  constexpr int telemetryPortBase() const { return value == 0 ? 1240 : block(); }
  /// What programs of this computer draw on the field (docs/drawings.md).
  constexpr int drawingPort() const { return telemetryPortBase(); }
  /// The published team messages go to this + 1..4.
  constexpr int teamPortBase() const { return value == 0 ? 1230 : block() + 70; }
  /// Robots of a team talk on this + the team's number (0..99).
  constexpr int channelPortBase() const { return value == 0 ? 10'000 : block() + 100; }
  /// The GameController's packets, and the robots' answers to it.
  constexpr int refereePort() const { return value == 0 ? 3838 : block() + 200; }
  constexpr int refereeAnswerPort() const { return value == 0 ? 3939 : block() + 201; }

  bool operator==(const MatchNumber&) const = default;

 private:
  constexpr int block() const { return 20'000 + 250 * value; }
};

/// The right to play the match of this number; freed by the kernel whatever happens to its owner.
class MatchClaim {
 public:
  /// Conflict when another program, or another match of this one, plays it.
  static Result<MatchClaim> take(int number);
  /// The smallest that is free.
  static Result<MatchClaim> takeFree();

  MatchNumber number() const { return m_number; }
  /// Who plays match 0, when takeFree() had to take another: "pitchboard, process 123".
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

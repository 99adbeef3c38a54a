// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A piece of a match that can be restored at every tick: the exact state at its beginning
// (checkpoint) and the commands that the bridge read before each later tick. A step is a pure
// function of state and commands, so stepping from the checkpoint gives every later state bit for
// bit. A plain value, for any thread.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/match/robots_memory.h>
#include <simcore/world/robot_io.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

/// Copies are independent of each other.
class StateSegment {
 public:
  StateSegment() = default;
  explicit StateSegment(const sim::WorldState& checkpoint);

  /// Adds the commands before the tick that follows lastTick(), in the order of the robots of the
  /// state.
  void add(std::span<const sim::RobotCommand> commands);

  std::uint64_t firstTick() const { return m_firstTick; }
  std::uint64_t lastTick() const { return m_firstTick + m_ticks; }
  std::size_t robots() const { return m_previous.size(); }
  double tickRate() const { return m_tickRate; }
  /// Returns roughly how much memory it uses.
  std::size_t bytes() const { return sizeof *this + m_state.size() + m_commands.size(); }

  /// Returns the state at a tick from firstTick() to lastTick(). Fails with NotFound outside, with
  /// ParseError if the commands are damaged, which is only possible in a segment from a file.
  Result<sim::WorldState> at(std::uint64_t tick) const;

  /// Returns how it was played from firstTick() to this tick. Fails as at() does.
  Result<PlayedStretch> playedTo(std::uint64_t tick) const;

  /// Convert to and from bytes. decode() refuses bytes that are no segment, with the offset; the
  /// result may still have damaged commands, which at() detects.
  std::string encode() const;
  static Result<StateSegment> decode(std::string_view bytes);

 private:
  Result<void> holds(std::uint64_t tick) const;

  std::uint64_t m_firstTick = 0;
  std::uint64_t m_ticks = 0;
  double m_tickRate = 60.0;
  std::string m_state;  // encodeState()
  // How many ticks had the same commands as the one before, then what changed, and so on: (count,
  // {robot + 1, mask of changed values, the values}..., 0).
  std::string m_commands;
  std::uint64_t m_same = 0;  // ticks since the last change that are not in m_commands yet
  std::vector<sim::RobotCommand> m_previous;
};

}  // namespace pitchboard::link

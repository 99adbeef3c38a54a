// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/state_segment.h>

#include <array>
#include <cassert>
#include <limits>

#include <base/try.h>
#include <robotlink/session/state_codec.h>
#include <simcore/simulation/simulation.h>

#include "byte_codec.h"

namespace pitchboard::link {
namespace {

constexpr std::string_view segmentMagic = "PBsg";
constexpr std::uint64_t segmentVersion = 1;
// A segment is a second of a match. A limit, so that a damaged one cannot make us step forever.
constexpr std::uint64_t maxTicks = 1'000'000;

constexpr std::array<int sim::RobotCommand::*, 6> values{
    &sim::RobotCommand::actionA,          &sim::RobotCommand::actionB,
    &sim::RobotCommand::searchOn,         &sim::RobotCommand::actionVision,
    &sim::RobotCommand::localizationLook, &sim::RobotCommand::imuReset};

Error damaged(const CodecReader& in) {
  return {ErrorCode::ParseError, "the recorded commands of the robots are damaged",
          "byte " + std::to_string(in.offset())};
}

/// Gives the commands back tick by tick.
class CommandReader {
 public:
  CommandReader(std::string_view bytes, std::size_t robots) : m_in(bytes), m_commands(robots) {
    m_same = m_in.varint();
  }
  std::span<const sim::RobotCommand> next() {
    if (m_same > 0) {
      --m_same;
    } else {
      readChanges();
      m_same = m_in.varint();
    }
    return m_commands;
  }
  const CodecReader& in() const { return m_in; }

 private:
  void readChanges() {
    while (const std::uint64_t place = m_in.varint()) {
      if (place > m_commands.size()) return m_in.fail();
      const std::uint64_t mask = m_in.varint();
      if (mask >= 1U << values.size()) return m_in.fail();
      for (std::size_t i = 0; i < values.size(); ++i) {
        if ((mask >> i & 1U) == 0) continue;
        const std::int64_t value = m_in.signedVarint();
        if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
          return m_in.fail();
        }
        m_commands[place - 1].*values[i] = static_cast<int>(value);
      }
    }
  }
  CodecReader m_in;
  std::uint64_t m_same = 0;
  std::vector<sim::RobotCommand> m_commands;
};

}  // namespace

StateSegment::StateSegment(const sim::WorldState& checkpoint)
    : m_firstTick(checkpoint.tick),
      m_tickRate(checkpoint.settings.tickRate),
      m_state(encodeState(checkpoint)),
      m_previous(checkpoint.robots.size()) {}

void StateSegment::add(std::span<const sim::RobotCommand> commands) {
  assert(commands.size() == m_previous.size());
  ++m_ticks;
  bool changed = false;
  for (std::size_t i = 0; i < m_previous.size(); ++i) {
    if (commands[i] == m_previous[i]) continue;
    if (!std::exchange(changed, true)) putVarint(m_commands, std::exchange(m_same, 0));
    std::uint64_t mask = 0;
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (commands[i].*values[v] != m_previous[i].*values[v]) mask |= std::uint64_t{1} << v;
    }
    putVarint(m_commands, i + 1);
    putVarint(m_commands, mask);
    for (std::size_t v = 0; v < values.size(); ++v) {
      if ((mask >> v & 1U) != 0) putSigned(m_commands, commands[i].*values[v]);
    }
    m_previous[i] = commands[i];
  }
  if (changed) {
    putVarint(m_commands, 0);
  } else {
    ++m_same;
  }
}

Result<void> StateSegment::holds(std::uint64_t tick) const {
  if (tick >= firstTick() && tick <= lastTick()) return {};
  return failure(ErrorCode::NotFound,
                 "tick " + std::to_string(tick) + " is not in this checkpoint (" +
                     std::to_string(firstTick()) + " to " + std::to_string(lastTick()) + ")");
}

Result<PlayedStretch> StateSegment::playedTo(std::uint64_t tick) const {
  TRY(holds(tick));
  std::string_view bytes = m_state;
  auto state = TRY(decodeState(bytes));
  std::string commands = m_commands;
  putVarint(commands, m_same);
  CommandReader reader(commands, state.robots.size());
  PlayedStretch played{std::move(state), {}};
  for (std::uint64_t at = firstTick(); at < tick; ++at) {
    const auto ordered = reader.next();
    if (!reader.in().ok()) return tl::unexpected(damaged(reader.in()));
    played.commands.emplace_back(ordered.begin(), ordered.end());
  }
  return played;
}

Result<sim::WorldState> StateSegment::at(std::uint64_t tick) const {
  TRY(holds(tick));
  std::string_view bytes = m_state;
  auto state = decodeState(bytes);
  if (!state || tick == firstTick()) return state;
  auto simulation = sim::Simulation::create({});
  TRY(simulation->restore(*state));
  std::string commands = m_commands;
  putVarint(commands, m_same);
  CommandReader reader(commands, state->robots.size());
  std::vector<sim::Percepts> percepts(state->robots.size());
  while (simulation->state().tick < tick) {
    const auto ordered = reader.next();
    if (!reader.in().ok()) return tl::unexpected(damaged(reader.in()));
    simulation->step(ordered, percepts);
  }
  return simulation->state();
}

std::string StateSegment::encode() const {
  std::string out(segmentMagic);
  putVarint(out, segmentVersion);
  putVarint(out, m_ticks);
  out += m_state;
  out += m_commands;
  putVarint(out, m_same);
  return out;
}

Result<StateSegment> StateSegment::decode(std::string_view bytes) {
  CodecReader in(bytes);
  if (in.bytes(segmentMagic.size()) != segmentMagic) {
    return failure(ErrorCode::ParseError, "this is not a checkpoint of a match");
  }
  const std::uint64_t found = in.varint();
  if (in.ok() && found != segmentVersion) {
    return failure(
        ErrorCode::Unsupported,
        "this checkpoint was recorded by a later version of Pitchboard; use that version");
  }
  const std::uint64_t ticks = in.varint();
  if (!in.ok() || ticks > maxTicks) return tl::unexpected(damaged(in));
  std::string_view rest = in.rest();
  const std::string_view before = rest;
  const auto state = TRY(decodeState(rest));
  StateSegment segment;
  segment.m_firstTick = state.tick;
  segment.m_ticks = ticks;
  segment.m_tickRate = state.settings.tickRate;
  segment.m_state = before.substr(0, before.size() - rest.size());
  segment.m_previous.resize(state.robots.size());
  segment.m_commands = rest;
  return segment;
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/referee/gamecontroller_encoder.h>

#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "gamecontroller_layouts.h"

namespace pitchboard::telemetry {
namespace {

/// Writes little-endian integers and remembers the first that does not fit.
class PacketBytes {
 public:
  explicit PacketBytes(std::size_t size) : m_bytes(size, '\0') {}

  void put(std::size_t offset, std::size_t count, bool isSigned, int value) {
    const int bits = static_cast<int>(8 * count);
    const std::int64_t least = isSigned ? -(std::int64_t{1} << (bits - 1)) : 0;
    const std::int64_t most = (std::int64_t{1} << (isSigned ? bits - 1 : bits)) - 1;
    if (value < least || value > most) {
      if (!m_bad) m_bad = {offset, value};
      return;
    }
    const auto raw = static_cast<std::uint32_t>(value);
    for (std::size_t i = 0; i < count; ++i) {
      m_bytes[offset + i] = static_cast<char>((raw >> (8 * i)) & 0xffU);
    }
  }
  template <class Owner>
  void putFields(std::span<const FieldAt<Owner>> fields, std::size_t at, const Owner& owner) {
    for (const FieldAt<Owner>& field : fields) {
      const auto* maybe = std::get_if<std::optional<int> Owner::*>(&field.member);
      const int value =
          maybe ? (owner.*(*maybe)).value_or(0) : owner.*std::get<int Owner::*>(field.member);
      put(at + field.offset, field.bytes, field.isSigned, value);
    }
  }
  void text(std::span<const char> chars) {
    for (std::size_t i = 0; i < chars.size(); ++i) m_bytes[i] = chars[i];
  }
  const std::optional<std::pair<std::size_t, int>>& bad() const { return m_bad; }
  std::string take() { return std::move(m_bytes); }

 private:
  std::string m_bytes;
  std::optional<std::pair<std::size_t, int>> m_bad;
};

}  // namespace

Result<std::string> encodeReferee(const RefereeState& state) {
  const RefereeLayout* layout =
      state.size < 0 ? nullptr : refereeLayout(state.version, static_cast<std::size_t>(state.size));
  if (layout == nullptr) {
    return failure(ErrorCode::Unsupported, "There is no referee packet of version " +
                                               std::to_string(state.version) + " with " +
                                               std::to_string(state.size) + " bytes.");
  }
  PacketBytes bytes(layout->size);
  bytes.text(state.magic);
  bytes.put(4, 1, false, state.version);
  bytes.putFields(layout->header, 0, state);
  if (layout->secStateInfo != 0 && state.secStateInfo) {
    for (std::size_t i = 0; i < 4; ++i) {
      bytes.put(layout->secStateInfo + i, 1, false, (*state.secStateInfo)[i]);
    }
  }
  for (std::size_t t = 0; t < 2; ++t) {
    const RefereeTeam& team = state.teams[t];
    const std::size_t at = layout->teamsAt + t * layout->teamBytes;
    bytes.putFields(layout->team, at, team);
    for (std::size_t i = 0; i < layout->slots; ++i) {
      bytes.putFields(layout->player, at + layout->slotsAt + i * layout->slotBytes,
                      team.allSlots[i]);
    }
  }
  if (state.extra2013 && layout->version == 7) {
    // What the program of 2013 writes over the last players.
    const RefereeExtra2013& extra = *state.extra2013;
    bytes.put(107, 1, false, extra.timeOut);
    bytes.put(108, 1, false, extra.penaltyShot[0]);
    bytes.put(109, 1, false, extra.penaltyShot[1]);
    bytes.put(110, 2, false, extra.penaltyTries[0]);
    bytes.put(112, 2, false, extra.penaltyTries[1]);
    bytes.put(114, 2, false, extra.subTime);
  }
  if (bytes.bad()) {
    return failure(ErrorCode::InvalidArgument,
                   "The value " + std::to_string(bytes.bad()->second) +
                       " does not fit into the referee packet of version " +
                       std::to_string(state.version) + ".",
                   "byte " + std::to_string(bytes.bad()->first));
  }
  return bytes.take();
}

Result<std::string> encodeReply(const RobotReply& reply) {
  constexpr std::size_t size1 = 16, size2 = 8, size4 = 32;
  const std::size_t size = reply.version == 1   ? size1
                           : reply.version == 2 ? size2
                           : reply.version == 4 ? size4
                                                : 0;
  if (size == 0) {
    return failure(ErrorCode::Unsupported, "There is no robot's reply (RGrt) of version " +
                                               std::to_string(reply.version) + ".");
  }
  PacketBytes bytes(size);
  constexpr std::array<char, 4> magic{'R', 'G', 'r', 't'};
  bytes.text(magic);
  bytes.put(4, 1, false, reply.version);
  bool finite = true;
  const auto real = [&](std::size_t offset, float value) {
    finite = finite && std::isfinite(value);
    bytes.put(offset, 4, true, std::bit_cast<std::int32_t>(value));
  };
  if (reply.version == 1) {
    bytes.put(8, 2, false, reply.team);
    bytes.put(10, 2, false, reply.player);
    bytes.put(12, 4, true, reply.message.value_or(0));
  } else if (reply.version == 2) {
    bytes.put(5, 1, false, reply.team);
    bytes.put(6, 1, false, reply.player);
    bytes.put(7, 1, false, reply.message.value_or(0));
  } else {
    bytes.put(5, 1, false, reply.player);
    bytes.put(6, 1, false, reply.team);
    bytes.put(7, 1, false, reply.fallen.value_or(0));
    const auto pose = reply.pose.value_or(std::array<float, 3>{});
    for (std::size_t i = 0; i < pose.size(); ++i) real(8 + 4 * i, pose[i]);
    real(20, reply.ballAge.value_or(-1.0F));
    const auto ball = reply.ball.value_or(std::array<float, 2>{});
    for (std::size_t i = 0; i < ball.size(); ++i) real(24 + 4 * i, ball[i]);
  }
  if (!finite || bytes.bad()) {
    return failure(ErrorCode::InvalidArgument,
                   "A number of this robot's reply does not fit into version " +
                       std::to_string(reply.version) + ".");
  }
  return bytes.take();
}

std::optional<int> refereePacketSize(int version, int preferred) {
  std::optional<int> size;
  for (const RefereeLayout& layout : refereeLayouts()) {
    if (layout.version != version) continue;
    const int one = static_cast<int>(layout.size);
    if (one == preferred || !size) size = one;
  }
  return size;
}

std::optional<League> refereeLeague(int version, int size) {
  const RefereeLayout* layout =
      size < 0 ? nullptr : refereeLayout(version, static_cast<std::size_t>(size));
  return layout == nullptr ? std::nullopt : std::optional<League>(layout->league);
}

std::size_t refereeSlots(int version, int size) {
  const RefereeLayout* layout =
      size < 0 ? nullptr : refereeLayout(version, static_cast<std::size_t>(size));
  return layout == nullptr ? 0 : layout->slots;
}

RefereeState asVersion7(const RefereeState& state) {
  constexpr int dropBall = 2;  // as a colour
  RefereeState out = state;
  out.version = 7;
  out.size = refereePacketSize(7).value_or(0);
  out.kickOffRaw = dropBall;
  for (const RefereeTeam& team : state.teams) {
    if (state.kickOffTeam == team.number) out.kickOffRaw = team.colour;
  }
  if (state.version > 8) {
    // A team number becomes a colour; all numbers but the left team's stand for the right team.
    const bool left = state.dropInTeam == state.teams[0].number;
    out.dropInTeam = state.teams[left ? 0 : 1].colour;
  }
  if (out.teams[0].colour > out.teams[1].colour) std::swap(out.teams[0], out.teams[1]);
  for (RefereeTeam& team : out.teams) team.goalColour = 1;  // always, as recorded
  return out;
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/referee/gamecontroller.h>

#include <algorithm>
#include <bit>

#include "gamecontroller_layouts.h"

namespace pitchboard::telemetry {
namespace {

using Bytes = std::span<const std::byte>;

std::uint32_t unsignedAt(Bytes bytes, std::size_t offset, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
  }
  return value;
}

int intAt(Bytes bytes, std::size_t offset, std::size_t count, bool isSigned) {
  const std::uint32_t raw = unsignedAt(bytes, offset, count);
  if (isSigned && count == 2) return static_cast<std::int16_t>(raw);
  return static_cast<std::int32_t>(raw);
}

float floatAt(Bytes bytes, std::size_t offset) {
  return std::bit_cast<float>(unsignedAt(bytes, offset, 4));
}

template <class Owner>
void readFields(std::span<const FieldAt<Owner>> fields, Bytes bytes, Owner& owner) {
  for (const FieldAt<Owner>& field : fields) {
    const int value = intAt(bytes, field.offset, field.bytes, field.isSigned);
    std::visit([&](auto member) { owner.*member = value; }, field.member);
  }
}

RefereeTeam readTeam(const RefereeLayout& layout, Bytes bytes) {
  RefereeTeam team;
  readFields(layout.team, bytes, team);
  team.slotCount = layout.slots;
  for (std::size_t i = 0; i < layout.slots; ++i) {
    RefereePlayer& player = team.allSlots[i];
    player.number = static_cast<int>(i) + 1;
    readFields(layout.player,
               bytes.subspan(layout.slotsAt + i * layout.slotBytes, layout.slotBytes), player);
  }
  return team;
}

std::optional<int> kickOffTeam(const RefereeLayout& layout, const RefereeState& state) {
  for (const RefereeTeam& team : state.teams) {
    const int key = layout.kickOff == KickOff::Colour ? team.colour : team.number;
    if (key == state.kickOffRaw) return team.number;
  }
  // Drop ball (2 as a colour, 128 or 255 as a number), nobody yet (0), or a team that is not here.
  return std::nullopt;
}

constexpr int substitute2013 = 14;

/// The native program of 2013 and the v7 packets that later ones add have version and size in
/// common. Slots 10 and 11 of team 1 are unused in games of up to nine a side and then hold the
/// code of a substitute, unless the native program wrote its own values over them.
bool isNative2013(const RefereeLayout& layout, Bytes bytes, int playersPerTeam) {
  return layout.version == 7 && playersPerTeam < 10 &&
         intAt(bytes, 108, 2, false) != substitute2013 &&
         intAt(bytes, 112, 2, false) != substitute2013;
}

void readExtra2013(Bytes bytes, RefereeState& state) {
  const auto byteAt = [bytes](std::size_t offset) { return intAt(bytes, offset, 1, false); };
  state.extra2013 = RefereeExtra2013{byteAt(107),
                                     {byteAt(108), byteAt(109)},
                                     {intAt(bytes, 110, 2, false), intAt(bytes, 112, 2, false)},
                                     intAt(bytes, 114, 2, false)};
  for (std::size_t slot = 8; slot < 11; ++slot) {
    RefereePlayer& player = state.teams[1].allSlots[slot];
    player.penalty = substitute2013;
    player.secondsLeft = 0;
    player.unreliable = true;
  }
}

Result<RefereePacket> decodeState(Bytes bytes) {
  const int version = intAt(bytes, 4, 1, false);
  const RefereeLayout* layout = refereeLayout(version, bytes.size());
  if (layout == nullptr) {
    std::string sizes;
    for (const RefereeLayout& known : refereeLayouts()) {
      if (known.version == version) {
        sizes += (sizes.empty() ? "" : " or ") + std::to_string(known.size);
      }
    }
    const std::string start = "Referee packet of version " + std::to_string(version) + " with " +
                              std::to_string(bytes.size()) + " bytes: ";
    return failure(ErrorCode::Unsupported, sizes.empty()
                                               ? start + "unknown version."
                                               : start + "this version has " + sizes + " bytes.");
  }
  RefereeState state;
  for (std::size_t i = 0; i < 4; ++i) state.magic[i] = std::to_integer<char>(bytes[i]);
  state.version = version;
  state.size = static_cast<int>(bytes.size());
  state.league = layout->league;
  readFields(layout->header, bytes, state);
  if (layout->secStateInfo != 0) {
    auto& info = state.secStateInfo.emplace();
    for (std::size_t i = 0; i < 4; ++i) info[i] = intAt(bytes, layout->secStateInfo + i, 1, false);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    state.teams[i] = readTeam(
        *layout, bytes.subspan(layout->teamsAt + i * layout->teamBytes, layout->teamBytes));
  }
  state.kickOffTeam = kickOffTeam(*layout, state);
  if (isNative2013(*layout, bytes, state.playersPerTeam)) readExtra2013(bytes, state);
  return RefereePacket{state};
}

Result<RobotReply> decodeReply(Bytes bytes) {
  RobotReply reply;
  reply.version = intAt(bytes, 4, 1, false);
  reply.size = static_cast<int>(bytes.size());
  const auto byteAt = [bytes](std::size_t offset) { return intAt(bytes, offset, 1, false); };
  if (reply.version == 1 && bytes.size() == 16) {
    reply.team = intAt(bytes, 8, 2, false);
    reply.player = intAt(bytes, 10, 2, false);
    reply.message = intAt(bytes, 12, 4, false);
  } else if (reply.version == 2 && bytes.size() == 8) {
    reply.team = byteAt(5);
    reply.player = byteAt(6);
    reply.message = byteAt(7);
  } else if (reply.version == 4 && bytes.size() == 32) {
    reply.player = byteAt(5);
    reply.team = byteAt(6);
    reply.fallen = byteAt(7);
    reply.pose = {floatAt(bytes, 8), floatAt(bytes, 12), floatAt(bytes, 16)};
    reply.ballAge = floatAt(bytes, 20);
    reply.ball = {floatAt(bytes, 24), floatAt(bytes, 28)};
  } else {
    return failure(ErrorCode::Unsupported, "A robot's reply to the referee (RGrt) of version " +
                                               std::to_string(reply.version) + " with " +
                                               std::to_string(bytes.size()) +
                                               " bytes: unknown version.");
  }
  return reply;
}

}  // namespace

const RefereeTeam* RefereeState::team(int number) const {
  const auto found = std::find_if(teams.begin(), teams.end(),
                                  [number](const RefereeTeam& t) { return t.number == number; });
  return found == teams.end() ? nullptr : &*found;
}

Result<RefereePacket> decodeReferee(Bytes bytes) {
  if (bytes.size() < 5) {
    return failure(ErrorCode::ParseError, "A referee packet has at least 5 bytes, this one " +
                                              std::to_string(bytes.size()) + ".");
  }
  const std::string_view magic(reinterpret_cast<const char*>(bytes.data()), 4);
  if (magic == "RGme" || magic == "RGTD") return decodeState(bytes);
  if (magic == "RGrt") return decodeReply(bytes);
  // Monitors get replies behind the IPv4 address of the robot, in network byte order.
  if (bytes.size() > 8 &&
      std::string_view(reinterpret_cast<const char*>(bytes.data()) + 4, 4) == "RGrt") {
    const auto reply = decodeReply(bytes.subspan(4));
    if (!reply) return tl::unexpected(reply.error());
    std::uint32_t robot = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      robot = robot << 8U | std::to_integer<std::uint32_t>(bytes[i]);
    }
    return RefereePacket{ForwardedReply{robot, *reply}};
  }
  if (magic == "RGTr") return RefereePacket{TrueDataRequest{}};
  return failure(ErrorCode::ParseError,
                 "Not a referee packet: it does not begin with RGme, RGTD, RGrt or RGTr.");
}

Result<RefereePacket> decodeReferee(std::string_view datagram) {
  return decodeReferee(std::as_bytes(std::span(datagram.data(), datagram.size())));
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where each version keeps each value: data, so that a new version is a new row.

#include <variant>

#include <telemetry/referee/gamecontroller.h>

namespace pitchboard::telemetry {

/// A little-endian integer of 1, 2 or 4 bytes and the member that takes it.
template <class Owner>
struct FieldAt {
  std::variant<int Owner::*, std::optional<int> Owner::*> member;
  std::uint16_t offset;
  std::uint8_t bytes;
  bool isSigned;
};

template <class Owner, class Value>
constexpr FieldAt<Owner> u8(Value Owner::*member, std::uint16_t offset) {
  return {member, offset, 1, false};
}
template <class Owner, class Value>
constexpr FieldAt<Owner> u16(Value Owner::*member, std::uint16_t offset) {
  return {member, offset, 2, false};
}
template <class Owner, class Value>
constexpr FieldAt<Owner> i16(Value Owner::*member, std::uint16_t offset) {
  return {member, offset, 2, true};
}
template <class Owner, class Value>
constexpr FieldAt<Owner> i32(Value Owner::*member, std::uint16_t offset) {
  return {member, offset, 4, true};
}

enum class KickOff : std::uint8_t { Colour, TeamNumber };
enum class PenaltyCodes : std::uint8_t { Hl2013, Hl2017, Spl2017, Spl2019, Hsl19, Hsl20 };

struct RefereeLayout {
  int version;
  std::size_t size;
  League league;
  KickOff kickOff;
  PenaltyCodes penalties;
  std::span<const FieldAt<RefereeState>> header;
  std::size_t secStateInfo;        ///< offset of four bytes; 0 when there are none
  std::size_t teamsAt, teamBytes;  ///< of the two team blocks
  std::span<const FieldAt<RefereeTeam>> team;
  std::size_t slots, slotsAt, slotBytes;  ///< of the players inside a team block
  std::span<const FieldAt<RefereePlayer>> player;
};

/// Every known layout.
std::span<const RefereeLayout> refereeLayouts();
/// The one of a version and size; nullptr when unknown.
const RefereeLayout* refereeLayout(int version, std::size_t size);

}  // namespace pitchboard::telemetry

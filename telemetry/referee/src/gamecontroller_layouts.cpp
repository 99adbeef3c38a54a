// SPDX-License-Identifier: GPL-3.0-or-later
#include "gamecontroller_layouts.h"

namespace pitchboard::telemetry {
namespace {

using S = RefereeState;
using T = RefereeTeam;
using P = RefereePlayer;

constexpr FieldAt<S> header7[] = {u8(&S::playersPerTeam, 8), u8(&S::state, 9),
                                  u8(&S::firstHalf, 10),     u8(&S::kickOffRaw, 11),
                                  u8(&S::secState, 12),      u8(&S::dropInTeam, 13),
                                  i16(&S::dropInTime, 14),   i32(&S::secsRemaining, 16)};
constexpr FieldAt<S> header8[] = {u8(&S::packetNumber, 5),    u8(&S::playersPerTeam, 6),
                                  u8(&S::state, 7),           u8(&S::firstHalf, 8),
                                  u8(&S::kickOffRaw, 9),      u8(&S::secState, 10),
                                  u8(&S::dropInTeam, 11),     i16(&S::dropInTime, 12),
                                  i16(&S::secsRemaining, 14), i16(&S::secondaryTime, 16)};
constexpr FieldAt<S> header9[] = {
    u8(&S::packetNumber, 6),    u8(&S::playersPerTeam, 7), u8(&S::gameType, 8),
    u8(&S::state, 9),           u8(&S::firstHalf, 10),     u8(&S::kickOffRaw, 11),
    u8(&S::secState, 12),       u8(&S::dropInTeam, 13),    i16(&S::dropInTime, 14),
    i16(&S::secsRemaining, 16), i16(&S::secondaryTime, 18)};
constexpr FieldAt<S> headerHl11[] = {
    u8(&S::packetNumber, 6),    u8(&S::playersPerTeam, 7), u8(&S::gameType, 8),
    u8(&S::state, 9),           u8(&S::firstHalf, 10),     u8(&S::kickOffRaw, 11),
    u8(&S::secState, 12),       u8(&S::dropInTeam, 17),    i16(&S::dropInTime, 18),
    i16(&S::secsRemaining, 20), i16(&S::secondaryTime, 22)};
constexpr FieldAt<S> headerSpl11[] = {
    u8(&S::packetNumber, 6),    u8(&S::playersPerTeam, 7), u8(&S::competitionPhase, 8),
    u8(&S::competitionType, 9), u8(&S::gamePhase, 10),     u8(&S::state, 11),
    u8(&S::setPlay, 12),        u8(&S::firstHalf, 13),     u8(&S::kickOffRaw, 14),
    u8(&S::dropInTeam, 15),     i16(&S::dropInTime, 16),   i16(&S::secsRemaining, 18),
    i16(&S::secondaryTime, 20)};
constexpr FieldAt<S> headerSpl12[] = {
    u8(&S::packetNumber, 5),    u8(&S::playersPerTeam, 6), u8(&S::competitionPhase, 7),
    u8(&S::competitionType, 8), u8(&S::gamePhase, 9),      u8(&S::state, 10),
    u8(&S::setPlay, 11),        u8(&S::firstHalf, 12),     u8(&S::kickOffRaw, 13),
    i16(&S::secsRemaining, 14), i16(&S::secondaryTime, 16)};
constexpr FieldAt<S> headerHsl[] = {
    u8(&S::packetNumber, 5),    u8(&S::playersPerTeam, 6), u8(&S::competitionType, 7),
    u8(&S::stopped, 8),         u8(&S::gamePhase, 9),      u8(&S::state, 10),
    u8(&S::setPlay, 11),        u8(&S::firstHalf, 12),     u8(&S::kickOffRaw, 13),
    i16(&S::secsRemaining, 14), i16(&S::secondaryTime, 16)};

constexpr FieldAt<T> team7[] = {u8(&T::number, 0), u8(&T::colour, 1), u8(&T::goalColour, 2),
                                u8(&T::score, 3)};
constexpr FieldAt<T> team8[] = {u8(&T::number, 0), u8(&T::colour, 1), u8(&T::score, 2),
                                u8(&T::penaltyShot, 3), u16(&T::singleShots, 4)};
constexpr FieldAt<T> team14[] = {u8(&T::number, 0),       u8(&T::colour, 1),
                                 u8(&T::score, 2),        u8(&T::penaltyShot, 3),
                                 u16(&T::singleShots, 4), u16(&T::messageBudget, 6)};
constexpr FieldAt<T> team15[] = {
    u8(&T::number, 0),       u8(&T::colour, 1),        u8(&T::goalkeeperColour, 2),
    u8(&T::goalkeeper, 3),   u8(&T::score, 4),         u8(&T::penaltyShot, 5),
    u16(&T::singleShots, 6), u16(&T::messageBudget, 8)};

constexpr FieldAt<P> player7[] = {u16(&P::penalty, 0), u16(&P::secondsLeft, 2)};
constexpr FieldAt<P> player8[] = {u8(&P::penalty, 0), u8(&P::secondsLeft, 1)};
constexpr FieldAt<P> player640[] = {u8(&P::penalty, 0), u8(&P::secondsLeft, 1), u8(&P::yellow, 2),
                                    u8(&P::red, 3)};
constexpr FieldAt<P> player688[] = {u8(&P::penalty, 0),  u8(&P::secondsLeft, 1),
                                    u8(&P::warnings, 2), u8(&P::yellow, 3),
                                    u8(&P::red, 4),      u8(&P::goalkeeper, 5)};
constexpr FieldAt<P> player19[] = {u8(&P::penalty, 0), u8(&P::secondsLeft, 1), u8(&P::warnings, 2),
                                   u8(&P::cautions, 3)};
constexpr FieldAt<P> player20[] = {u8(&P::penalty, 0), u8(&P::secondsLeft, 1), u8(&P::cautions, 2)};

constexpr League hl = League::Humanoid;
constexpr League spl = League::StandardPlatform;
constexpr League hsl = League::HumanoidSoccer;
constexpr KickOff colour = KickOff::Colour;
constexpr KickOff byNumber = KickOff::TeamNumber;
using Codes = PenaltyCodes;

// version, size, league, kick-off, penalties, header, info, team blocks, team, slots, player
constexpr RefereeLayout layouts[] = {
    {7, 116, hl, colour, Codes::Hl2013, header7, 0, 20, 48, team7, 11, 4, 4, player7},
    {8, 158, hl, colour, Codes::Hl2013, header8, 0, 18, 70, team8, 11, 48, 2, player8},
    {9, 244, hl, byNumber, Codes::Hl2013, header9, 0, 20, 112, team8, 11, 90, 2, player8},
    {10, 588, spl, byNumber, Codes::Spl2017, header9, 0, 20, 284, team8, 11, 262, 2, player8},
    {11, 592, hl, byNumber, Codes::Hl2017, headerHl11, 13, 24, 284, team8, 11, 262, 2, player8},
    {12, 640, hl, byNumber, Codes::Hl2017, headerHl11, 13, 24, 308, team8, 11, 264, 4, player640},
    {12, 688, hl, byNumber, Codes::Hl2017, headerHl11, 13, 24, 332, team8, 11, 266, 6, player688},
    {11, 58, spl, byNumber, Codes::Spl2017, headerSpl11, 0, 22, 18, team8, 6, 6, 2, player8},
    {12, 54, spl, byNumber, Codes::Spl2019, headerSpl12, 0, 18, 18, team8, 6, 6, 2, player8},
    {13, 54, spl, byNumber, Codes::Spl2019, headerSpl12, 0, 18, 18, team8, 6, 6, 2, player8},
    {14, 62, spl, byNumber, Codes::Spl2019, headerSpl12, 0, 18, 22, team14, 7, 8, 2, player8},
    {15, 118, spl, byNumber, Codes::Spl2019, headerSpl12, 0, 18, 50, team15, 20, 10, 2, player8},
    {16, 118, spl, byNumber, Codes::Spl2019, headerSpl12, 0, 18, 50, team15, 20, 10, 2, player8},
    {17, 118, spl, byNumber, Codes::Spl2019, headerSpl12, 0, 18, 50, team15, 20, 10, 2, player8},
    {18, 118, spl, byNumber, Codes::Spl2019, headerSpl12, 0, 18, 50, team15, 20, 10, 2, player8},
    {19, 198, hsl, byNumber, Codes::Hsl19, headerHsl, 0, 18, 90, team15, 20, 10, 4, player19},
    {20, 158, hsl, byNumber, Codes::Hsl20, headerHsl, 0, 18, 70, team15, 20, 10, 3, player20},
};

template <class Owner>
constexpr bool inside(std::span<const FieldAt<Owner>> fields, std::size_t size) {
  for (const FieldAt<Owner>& field : fields) {
    if (field.offset + field.bytes > size) return false;
  }
  return true;
}

// The decoder trusts the table: every field must lie inside its block, and the blocks fill the
// packet exactly.
constexpr bool consistent() {
  for (const RefereeLayout& l : layouts) {
    if (l.teamsAt + 2 * l.teamBytes != l.size) return false;
    if (l.slotsAt + l.slots * l.slotBytes != l.teamBytes) return false;
    if (l.slots > RefereeTeam::maxPlayers || l.secStateInfo + 4 > l.teamsAt) return false;
    if (!inside(l.header, l.teamsAt) || !inside(l.team, l.slotsAt)) return false;
    if (!inside(l.player, l.slotBytes)) return false;
  }
  return true;
}
static_assert(consistent());

}  // namespace

std::span<const RefereeLayout> refereeLayouts() {
  return layouts;
}

const RefereeLayout* refereeLayout(int version, std::size_t size) {
  for (const RefereeLayout& layout : layouts) {
    if (layout.version == version && layout.size == size) return &layout;
  }
  return nullptr;
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/announced_set_play.h>

#include <array>

namespace pitchboard::link {
namespace {

using telemetry::League;

struct SetPlayRow {
  sim::SetPlay play;
  int humanoid, humanoid2017, standard, soccer;  // 0: this league does not tell it
};
constexpr std::array<SetPlayRow, 6> setPlayRows{{
    {sim::SetPlay::DirectFreeKick, 4, 4, 2, 1},
    {sim::SetPlay::IndirectFreeKick, 5, 5, 2, 2},
    {sim::SetPlay::PenaltyKick, 6, 6, 5, 3},
    {sim::SetPlay::ThrowIn, 9, 0, 4, 4},
    {sim::SetPlay::GoalKick, 8, 0, 1, 5},
    {sim::SetPlay::CornerKick, 7, 0, 3, 6},
}};

int codeOfSetPlay(const SetPlayRow& row, League league, int version, int size) {
  if (league == League::HumanoidSoccer) return row.soccer;
  if (league == League::StandardPlatform) return version == 10 ? 0 : row.standard;
  if (version < 11) return 0;
  return size == 688 ? row.humanoid : row.humanoid2017;
}

}  // namespace

int setPlayCode(League league, int version, int size, sim::SetPlay play) {
  for (const SetPlayRow& row : setPlayRows) {
    if (row.play == play) return codeOfSetPlay(row, league, version, size);
  }
  return 0;
}

sim::SetPlay setPlayOf(League league, int version, int size, int code) {
  for (const SetPlayRow& row : setPlayRows) {
    if (code != 0 && codeOfSetPlay(row, league, version, size) == code) return row.play;
  }
  return sim::SetPlay::None;
}

AnnouncedSetPlay setPlayIn(const telemetry::RefereeState& packet) {
  const int code = packet.setPlay.value_or(packet.secState.value_or(0));
  AnnouncedSetPlay announced;
  announced.kind = setPlayOf(packet.league, packet.version, packet.size, code);
  if (announced.kind == sim::SetPlay::None) return announced;
  // Of 2021 on the Humanoid League says whose it is beside it; others by the kick-off.
  constexpr int sizeWithTaker = 688;
  const bool hasDetails = packet.secStateInfo && packet.size == sizeWithTaker;
  announced.team = hasDetails ? (*packet.secStateInfo)[0] : packet.kickOffTeam;
  return announced;
}

}  // namespace pitchboard::link

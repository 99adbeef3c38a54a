// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_codes.h"

#include <array>

namespace pitchboard::link {
namespace {

using Kind = sim::PenaltyKind;
using telemetry::League;

struct PenaltyRow {
  Kind kind;
  std::array<int, 5> codes;  // by PenaltyDialect
};

// The nearest that a version has. Source: docs/reference/gamecontroller.md, "Values".
constexpr std::array<PenaltyRow, 17> penalties{{
    {Kind::BallManipulation, {1, 30, 1, 8, 9}},
    {Kind::Pushing, {2, 31, 2, 9, 10}},
    {Kind::IllegalAttack, {3, 32, 5, 1, 1}},
    {Kind::IllegalDefence, {4, 33, 5, 1, 1}},
    {Kind::Incapable, {5, 34, 4, 4, 5}},
    {Kind::Service, {6, 35, 7, 5, 6}},
    {Kind::IllegalPosition, {4, 33, 5, 1, 1}},
    {Kind::MotionInSet, {5, 34, 3, 2, 2}},
    {Kind::MotionInStop, {5, 34, 3, 2, 3}},
    {Kind::LocalStuck, {5, 34, 8, 3, 4}},
    {Kind::Holding, {1, 30, 1, 6, 7}},
    {Kind::Leaving, {5, 34, 6, 7, 8}},
    {Kind::Hands, {1, 30, 1, 8, 9}},
    {Kind::Cautioned, {15, 15, 15, 9, 11}},
    {Kind::SentOff, {15, 15, 15, 10, 12}},
    {Kind::Substitute, {14, 14, 14, 11, 13}},
    {Kind::Manual, {15, 15, 15, 5, 6}},
}};

}  // namespace

PenaltyDialect penaltyDialect(int version, League league) {
  if (league == League::HumanoidSoccer) {
    return version == 19 ? PenaltyDialect::Soccer19 : PenaltyDialect::Soccer20;
  }
  if (league == League::StandardPlatform) return PenaltyDialect::StandardPlatform;
  return version < 11 ? PenaltyDialect::Humanoid2013 : PenaltyDialect::Humanoid2017;
}

int penaltyCode(PenaltyDialect dialect, Kind penalty) {
  for (const PenaltyRow& row : penalties) {
    if (row.kind == penalty) return row.codes[static_cast<std::size_t>(dialect)];
  }
  return 0;
}

Kind penaltyOf(PenaltyDialect dialect, int code) {
  if (code == 0) return Kind::None;
  for (const PenaltyRow& row : penalties) {
    if (row.codes[static_cast<std::size_t>(dialect)] == code) return row.kind;
  }
  return Kind::Manual;
}

int colourCode(TeamColor colour) {
  switch (colour) {
    case TeamColor::Blue:
      return 0;
    case TeamColor::Red:
      return 1;
    case TeamColor::Yellow:
      return 2;
    case TeamColor::Black:
      return 3;
    case TeamColor::Orange:
      return 6;
  }
  return 0;
}

}  // namespace pitchboard::link

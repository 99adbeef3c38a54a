// SPDX-License-Identifier: GPL-3.0-or-later
#include "formations.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <robotlink/frame/match_event.h>

namespace pitchboard::ui {
namespace {

enum Kind : std::size_t { KickOff, Corner, ThrowIn, GoalKick, FreeKick, PenaltyKick };

/// A place as shares of half the field's length and width, for a team that attacks right.
struct Share {
  double x, y;
};
using Line = std::array<Share, 6>;

// The first keeps the goal; more robots than places stand in a row behind.
constexpr Line kickOffWith{
    {{-0.93, 0}, {-0.10, 0}, {-0.30, 0.5}, {-0.30, -0.5}, {-0.6, 0.3}, {-0.6, -0.3}}};
constexpr Line kickOffWithout{
    {{-0.93, 0}, {-0.28, 0}, {-0.40, 0.5}, {-0.40, -0.5}, {-0.65, 0.3}, {-0.65, -0.3}}};
constexpr Line attack{{{-0.93, 0}, {0, 0}, {0.55, 0.1}, {0.45, -0.3}, {0.2, 0.3}, {0, -0.3}}};
constexpr Line defence{
    {{-0.95, 0}, {-0.7, 0.25}, {-0.7, -0.2}, {-0.55, 0.05}, {-0.35, 0.4}, {-0.35, -0.4}}};
constexpr Line behind{{{-0.97, 0}, {-0.3, 0.5}, {-0.3, -0.5}, {-0.25, 0.2}, {-0.25, -0.2}, {0, 0}}};

Point ballOf(Kind kind, const sim::FieldSpec& field) {
  const double x = field.halfLength(), y = field.halfWidth();
  switch (kind) {
    case KickOff:
      return {};
    case Corner:
      return {x, y};
    case ThrowIn:
      return {0.3 * x, y};
    case GoalKick:
      return {-x + field.goalAreaLength, field.goalAreaWidth / 2};
    case FreeKick:
      return {0.45 * x, 0.2 * y};
    case PenaltyKick:
      return {x - field.penaltyMarkDistance, 0};
  }
  return {};
}

sim::SetPlay setPlayOf(Kind kind) {
  switch (kind) {
    case KickOff:
      return sim::SetPlay::None;
    case Corner:
      return sim::SetPlay::CornerKick;
    case ThrowIn:
      return sim::SetPlay::ThrowIn;
    case GoalKick:
      return sim::SetPlay::GoalKick;
    case FreeKick:
      return sim::SetPlay::DirectFreeKick;
    case PenaltyKick:
      return sim::SetPlay::PenaltyKick;
  }
  return sim::SetPlay::None;
}

}  // namespace

const std::vector<Formation>& formations() {
  static const std::vector<Formation> all{
      {"Kick-off", "Both teams in their halves, the ball on the centre mark"},
      {"Corner kick", "The ball in the corner, the other team before its goal"},
      {"Throw-in", "The ball on the touch line"},
      {"Goal kick", "The ball on the corner of the goal area"},
      {"Free kick", "The ball in the opponents' half"},
      {"Penalty kick", "The ball on the mark, the keeper on its line, everybody else behind"},
  };
  return all;
}

FormationPlaces placesOf(std::size_t index, const link::MatchFrame& frame, bool leftAttacks) {
  const auto kind = static_cast<Kind>(std::min(index, formations().size() - 1));
  const sim::FieldSpec& field = frame.settings->field;
  std::vector<sim::RobotIdentity> robots;
  for (const link::RobotFrame& robot : frame.robots) robots.push_back(robot.identity);
  const auto staysOff = [&frame](RobotId id) { return frame.robot(id)->penalty.has_value(); };
  FormationPlaces places;
  const double turn = leftAttacks ? 1.0 : -1.0;
  const Point ball = ballOf(kind, field);
  places.ball = {turn * ball.x, turn * ball.y};
  places.setPlay = setPlayOf(kind);
  places.attackers = link::teamOn(leftAttacks ? link::Side::Left : link::Side::Right, robots);
  for (const link::Side side : {link::Side::Left, link::Side::Right}) {
    const TeamColor team = link::teamOn(side, robots);
    std::vector<sim::RobotIdentity> own;
    for (const sim::RobotIdentity& robot : robots) {
      if (robot.team == team && !staysOff(robot.id)) own.push_back(robot);
    }
    std::sort(own.begin(), own.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    const bool attacks = (side == link::Side::Left) == leftAttacks;
    const Line& line = kind == KickOff       ? (attacks ? kickOffWith : kickOffWithout)
                       : kind == GoalKick    ? (attacks ? defence : attack)
                       : kind == PenaltyKick ? (attacks ? attack : behind)
                       : attacks             ? attack
                                             : defence;
    const double sign = side == link::Side::Left ? 1.0 : -1.0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Share& share = line[i % line.size()];
      const std::size_t rank = i / line.size();
      const double row = static_cast<double>(rank) * 0.35;
      Point place{share.x * field.halfLength() - row, share.y * field.halfWidth()};
      double yaw = 0.0;
      if (attacks && i == 1 && kind != KickOff && kind != GoalKick) {
        // Who takes it stands before the ball.
        place = {ball.x - 0.4, ball.y};
        if (kind == Corner) place = {ball.x - 0.1, ball.y + 0.45};
        yaw = kind == Corner ? -std::numbers::pi / 2 : 0.0;
      } else if (kind == PenaltyKick && i > 0) {
        // Behind the ball, for both.
        const double x = attacks ? 0.15 : -0.1;
        place = {(attacks ? 1.0 : -1.0) * x * field.halfLength() - (attacks ? 0.6 : 0.0),
                 (static_cast<double>(i) - 1.5) * 0.8 + (attacks ? 0.4 : 0.0)};
      }
      const double heading = sign > 0 ? yaw : std::numbers::pi + yaw;
      places.robots.emplace_back(own[i].id, Pose{{sign * place.x, sign * place.y}, heading});
    }
  }
  return places;
}

}  // namespace pitchboard::ui

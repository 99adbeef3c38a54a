// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/soccer_board.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <base/angles.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

namespace cm_frame = sim::published_frame;

constexpr int visionOfBall = 0, visionOfOpponents = 2;

double numberOf(const Blackboard& board, FloatVar variable) {
  return static_cast<double>(board.read(variable));
}

Point placeFromCm(const sim::FieldSpec& field, double x_cm, double y_cm) {
  return cm_frame::studioFromLocalization(field, {x_cm, y_cm, 0.0}).position;
}

/// Nothing when the numbers make no sense.
std::optional<SeenAt> seenAt(double distance_cm, double bearing_deg) {
  const SeenAt seen{cm_frame::metresFromCm(distance_cm), radiansFromDegrees(bearing_deg)};
  const bool sensible =
      seen.distance > 0.0 && std::isfinite(seen.distance) && std::isfinite(seen.bearing);
  return sensible ? std::optional(seen) : std::nullopt;
}

}  // namespace

AdvisorVariables::AdvisorVariables() {
  const VariableCatalog& map = VariableCatalog::extended();
  aim = map.floatVar("ADVISOR_AIM").value_or(FloatVar{-1});
  aside = map.floatVar("ADVISOR_ASIDE").value_or(FloatVar{-1});
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    evidence[i] = map.intVar("ADVISOR_EVIDENCE" + std::to_string(i + 1)).value_or(IntVar{-1});
  }
}

SoccerBoard::SoccerBoard() {
  const VariableCatalog& map = VariableCatalog::extended();
  m_setPlay = map.intVar("COM_SET_PLAY").value_or(IntVar{-1});
  m_setPlayOurs = map.intVar("COM_SET_PLAY_OURS").value_or(IntVar{-1});
}

void SoccerBoard::read(const Blackboard& board, const WorldModel& world, SoccerInput& input) const {
  const sim::FieldSpec& field = world.field();
  const RobotVariables& v = m_variables;
  input.referee = static_cast<Referee>(board.read(v.comReferee));
  input.fallen = board.read(v.imuState) != 0;
  const int setPlay = readOr(board, m_setPlay);
  const bool known = setPlay >= 0 && setPlay <= static_cast<int>(lastOf(SetPlay{}));
  input.setPlay = known ? static_cast<SetPlay>(setPlay) : SetPlay::None;
  input.setPlayIsOurs = readOr(board, m_setPlayOurs) != 0;

  input.believed = cm_frame::studioFromLocalization(
      field, {static_cast<double>(board.read(v.localizationX)),
              static_cast<double>(board.read(v.localizationY)),
              static_cast<double>(board.read(v.localizationTheta))});
  input.imuYaw = numberOf(board, v.imuEulerZ);
  if (!std::isfinite(input.imuYaw)) input.imuYaw = 0.0;
  const double sigma = numberOf(board, v.localizationBelief);
  // Fresh memory holds zeros, and no filter is that sure.
  input.sigma = std::isfinite(sigma) && sigma > 0.0 ? cm_frame::metresFromCm(sigma) : 1e9;
  input.doing = {board.read(v.controlAction), board.read(v.decisionActionB)};

  constexpr double maxShift = 0.6;  // m
  const double shift = cm_frame::metresFromCm(static_cast<double>(readOr(board, m_advisor.aside)));
  input.keeperShift = std::isfinite(shift) ? std::clamp(shift, -maxShift, maxShift) : 0.0;

  input.ball.reset();
  if (board.read(v.visionLost) == 0) {
    input.ball = seenAt(numberOf(board, v.visionBallDist), numberOf(board, v.visionPanDeg));
  }
  for (std::size_t i = 0; world.looksForOpponents() && i < input.robots.size(); ++i) {
    // Right positive: the published sign of this variable.
    input.robots[i] = seenAt(numberOf(board, v.robotDist[i]), -numberOf(board, v.robotAngle[i]));
  }

  for (std::size_t i = 0; i < input.mates.size(); ++i) {
    input.mates[i].reset();
    const auto state = static_cast<MateState>(readOr(board, m_team.state[i]));
    const auto place = unpackPlace(readOr(board, m_team.place[i], -1));
    if (state == MateState::Unknown || !place) continue;
    TeamMate mate;
    mate.position = placeFromCm(field, place->x, place->y);
    mate.intention = static_cast<Intention>(readOr(board, m_team.action[i]));
    mate.active = state == MateState::Active;
    if (const auto ball = unpackPlace(readOr(board, m_team.ball[i], -1))) {
      mate.ball = placeFromCm(field, ball->x, ball->y);
    }
    input.mates[i] = mate;
  }
  input.matePlaces.clear();
  for (std::size_t i = 0; i < m_team.mateX.size(); ++i) {
    const auto x = static_cast<double>(readOr(board, m_team.mateX[i], -1.0F));
    const auto y = static_cast<double>(readOr(board, m_team.mateY[i], -1.0F));
    // Zeros mean that the variables were never written: no robot stands exactly on the corner.
    if (x >= 0.0 && y >= 0.0 && x + y > 0.0) input.matePlaces.push_back(placeFromCm(field, x, y));
  }
}

void SoccerBoard::lookFor(Blackboard& board, bool opponents) const {
  if (opponents) {
    for (const FloatVar distance : m_variables.robotDist) board.write(distance, 0.0F);
  }
  board.write(m_variables.decisionActionVision, opponents ? visionOfOpponents : visionOfBall);
}

void SoccerBoard::publish(Blackboard& board, const WorldModel& world, Intention intention,
                          const std::optional<Point>& target) const {
  const auto toCm = [&world](const Point& p) {
    return cm_frame::localizationFromStudio(world.field(), {world.toStudio(p), 0.0});
  };
  const cm_frame::CmPose unknown{-1.0, -1.0, 0.0};
  writeIfPresent(board, m_team.intention, static_cast<int>(intention));
  const bool known = world.seesBall() && world.localized();
  const cm_frame::CmPose ball = known ? toCm(world.toField(world.ballInFront())) : unknown;
  writeIfPresent(board, m_team.ballX, static_cast<float>(ball.x));
  writeIfPresent(board, m_team.ballY, static_cast<float>(ball.y));
  const std::size_t seen = world.localized() ? world.opponents().size() : 0;
  for (std::size_t i = 0; i < m_team.opponentX.size(); ++i) {
    const cm_frame::CmPose at = i < seen ? toCm(world.opponents()[i]) : unknown;
    writeIfPresent(board, m_team.opponentX[i], static_cast<float>(at.x));
    writeIfPresent(board, m_team.opponentY[i], static_cast<float>(at.y));
  }
  if (!target) return;
  const cm_frame::CmPose place = toCm(*target);
  writeIfPresent(board, m_team.targetX, static_cast<int>(std::lround(place.x)));
  writeIfPresent(board, m_team.targetY, static_cast<int>(std::lround(place.y)));
}

}  // namespace pitchboard::link

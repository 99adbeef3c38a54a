// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/situation.h>

#include <simcore/world/published_frame.h>

#include "soccer/soccer_board.h"

namespace pitchboard::link {

struct SituationReader::Parts {
  explicit Parts(const ProcessOptions& options)
      : world(options.field, options.model, options.parameters, options.facesLeft) {
    const VariableCatalog& map = VariableCatalog::extended();
    goalsOwn = map.intVar("COM_GOALS_OWN").value_or(IntVar{-1});
    goalsTheirs = map.intVar("COM_GOALS_THEIRS").value_or(IntVar{-1});
    secondsLeft = map.intVar("COM_SECONDS_LEFT").value_or(IntVar{-1});
  }

  SoccerBoard board;
  WorldModel world;
  TeamVariables team;
  IntVar goalsOwn, goalsTheirs, secondsLeft;
  SoccerInput input;
  Situation now;
};

SituationReader::SituationReader(const ProcessOptions& options)
    : m_parts(std::make_unique<Parts>(options)) {}
SituationReader::SituationReader(const SituationReader& other)
    : m_parts(std::make_unique<Parts>(*other.m_parts)) {}
SituationReader& SituationReader::operator=(const SituationReader& other) {
  *m_parts = *other.m_parts;
  return *this;
}
SituationReader::SituationReader(SituationReader&&) noexcept = default;
SituationReader& SituationReader::operator=(SituationReader&&) noexcept = default;
SituationReader::~SituationReader() = default;

const Situation& SituationReader::read(const Blackboard& board, double now) {
  auto& [reader, world, team, goalsOwn, goalsTheirs, secondsLeft, input, out] = *m_parts;
  reader.read(board, world, input);
  world.update(input, now);
  out.referee = world.referee();
  out.setPlay = world.setPlay();
  out.setPlayIsOurs = world.setPlayIsOurs();
  out.goalsOwn = readOr(board, goalsOwn);
  out.goalsTheirs = readOr(board, goalsTheirs);
  out.secondsLeft = readOr(board, secondsLeft);
  out.fallen = world.fallen();
  out.localized = world.localized();
  out.pose = world.pose();
  out.doing = input.doing;
  out.intention = static_cast<Intention>(readOr(board, team.intention));
  out.ball = world.ball();
  out.seesBall = world.seesBall();
  out.ballAge = world.ballAge();
  out.ballVelocity = world.seesBall() ? world.ballVelocity() : Velocity{};
  out.mates = world.mates();
  out.opponents.clear();
  for (std::size_t i = 0; i < team.opponentX.size(); ++i) {
    const auto x = static_cast<double>(readOr(board, team.opponentX[i], -1.0F));
    const auto y = static_cast<double>(readOr(board, team.opponentY[i], -1.0F));
    if (!(x >= 0.0 && y >= 0.0 && x + y > 0.0 && x < 1e5 && y < 1e5)) continue;
    out.opponents.push_back(world.toStudio(
        sim::published_frame::studioFromLocalization(world.field(), {x, y, 0.0}).position));
  }
  return out;
}

Pose SituationReader::toStudio(const Pose& turned) const {
  return m_parts->world.toStudio(turned);
}

bool SituationReader::attacksLeft() const {
  return m_parts->world.toStudio(Point{1.0, 0.0}).x < 0.0;
}

}  // namespace pitchboard::link

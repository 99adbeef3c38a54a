// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/soccer_player.h>

#include <base/try.h>
#include <variant>

#include "planning/walk.h"
#include "soccer/behaviour.h"

namespace pitchboard::link {
namespace {

// Paths are what a rollout takes most time for, and a path of a moment ago leads round nearly the
// same.
constexpr double planPeriod = 0.5;  // s

using AnyBehaviour = std::variant<Striker, Supporter, Keeper, Idle>;

Result<AnyBehaviour> behaviourOf(const BehaviourChoice& choice) {
  const BehaviourParameters& numbers = choice.parameters;
  if (choice.name == "striker") return AnyBehaviour(std::in_place_type<Striker>, numbers);
  if (choice.name == "supporter") return AnyBehaviour(std::in_place_type<Supporter>, numbers);
  if (choice.name == "keeper") return AnyBehaviour(std::in_place_type<Keeper>, numbers);
  if (choice.name == "idle") return AnyBehaviour(std::in_place_type<Idle>, numbers);
  return failure(ErrorCode::NotFound, "'" + choice.name +
                                          "' is not one of the behaviours striker, supporter, "
                                          "keeper, idle");
}

}  // namespace

struct SoccerPlayer::Parts {
  WorldModel world;
  AnyBehaviour behaviour;
  Walk walk;
  Surroundings surroundings;  // scratch memory of step()
};

SoccerPlayer::SoccerPlayer(std::unique_ptr<Parts> parts) : m_parts(std::move(parts)) {}
SoccerPlayer::SoccerPlayer(SoccerPlayer&&) noexcept = default;
SoccerPlayer& SoccerPlayer::operator=(SoccerPlayer&&) noexcept = default;
SoccerPlayer::~SoccerPlayer() = default;

Result<SoccerPlayer> SoccerPlayer::create(const SoccerPlayerOptions& options) {
  TRY(sim::validate(options.field));
  TRY(sim::validate(options.model));
  TRY(validate(options.behaviour.parameters));
  AnyBehaviour behaviour = TRY(behaviourOf(options.behaviour));
  sim::FieldSpec field = options.field;
  if (options.model.radius > 0.0) field.robotRadius = options.model.radius;
  return SoccerPlayer(std::make_unique<Parts>(
      Parts{WorldModel(field, options.model, options.behaviour.parameters, options.facesLeft),
            std::move(behaviour),
            Walk(field, options.field.robotRadius, options.model, planPeriod),
            {}}));
}

void SoccerPlayer::copyState(const SoccerPlayer& other) {
  *m_parts = *other.m_parts;
}

void SoccerPlayer::observe(const SoccerInput& input, double now) {
  m_parts->world.update(input, now);
}

PlayerDecision SoccerPlayer::step(const SoccerInput& input, double now) {
  auto& [world, anyBehaviour, walk, around] = *m_parts;
  world.update(input, now);
  Behaviour& behaviour = std::visit([](auto& one) -> Behaviour& { return one; }, anyBehaviour);
  const Choice choice = behaviour.choose(world);
  PlayerDecision decision;
  if (const Target* wanted = std::get_if<Target>(&choice.move)) {
    Target target = *wanted;
    target.pose = world.toStudio(target.pose);
    if (target.ball) target.ball = world.toStudio(*target.ball);
    around.now = now;
    around.pose = input.believed;
    around.robots = input.matePlaces;
    if (world.localized()) {
      for (const Point& opponent : world.opponents()) {
        if (!around.robots.full()) around.robots.push_back(world.toStudio(opponent));
      }
    }
    decision.act = walk.step(around, target).value_or(acts::stop);
  } else {
    walk.rest();
    decision.act = std::get<Act>(choice.move);
  }
  constexpr double lost = 0.4;  // s: a frame that missed the ball is no reason to search
  decision.search = choice.search && world.ballAge() > lost;
  decision.looksForOpponents = world.looksForOpponents();
  decision.intention = choice.intention;
  if (world.seesBall() && world.localized()) {
    decision.ball = world.toStudio(world.toField(world.ballInFront()));
  }
  return decision;
}

}  // namespace pitchboard::link

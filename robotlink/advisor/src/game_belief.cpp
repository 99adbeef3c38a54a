// SPDX-License-Identifier: GPL-3.0-or-later
#include "game_belief.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <robotlink/cognition/act.h>
#include <robotlink/cognition/keeper_place.h>

namespace pitchboard::link {
namespace {

constexpr double remembers = 6.0;    // s
constexpr double moves = 0.8;        // m between two sightings of one opponent
constexpr double sigmaSeen = 0.12;   // m
constexpr double sigmaGrows = 0.15;  // m/s
constexpr double keeperZone = 1.3;   // m before a goal
constexpr double getsUp = 3.0;       // s that a team-mate lies on the field, on average

rollout::RobotBelief at(const Point& place, double yaw, double sigma, double yawSigma) {
  rollout::RobotBelief robot;
  robot.pose = {place, yaw};
  robot.sigma = sigma;
  robot.yawSigma = yawSigma;
  return robot;
}

std::vector<BehaviourParameters> keeperVariants(const BehaviourParameters& usual) {
  std::vector<BehaviourParameters> out;
  for (std::size_t i = 0; i < keeperModels; ++i) out.push_back(keeperModel(i).numbers(usual));
  return out;
}

std::vector<BehaviourParameters> aimVariants(const BehaviourParameters& usual) {
  std::vector<BehaviourParameters> out(aimModels, usual);
  for (std::size_t i = 0; i < aimModels; ++i) out[i].aimSide = aimModel(i);
  return out;
}

/// Where a keeper stands that nobody has seen.
rollout::RobotBelief unseenKeeper(const sim::FieldSpec& field, const Point& ball,
                                  const std::vector<double>& shares) {
  constexpr double sigma = 0.25, yawSigma = 0.4;
  double y = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < keeperModels; ++i) {
    const Point place = keeperPlace(field, keeperModel(i).numbers(), {-ball.x, -ball.y}).position;
    y -= shares[i] * place.y;
    squares += shares[i] * place.y * place.y;
  }
  const Point line{field.halfLength() - 0.4, y};
  return at(line, direction(line, ball), std::sqrt(sigma * sigma + std::max(0.0, squares - y * y)),
            yawSigma);
}

/// What was learned, as the players of a rollout.
void addLearned(const OpponentModel& learned, rollout::Belief& belief) {
  const std::vector<double> paces = learned.paceShares();
  double mean = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < paceModels; ++i) {
    mean += paces[i] * paceModel(i);
    squares += paces[i] * paceModel(i) * paceModel(i);
  }
  for (std::size_t i = theirKeeper; i < allPlayers; ++i) {
    rollout::RobotBelief& robot = belief.robots[i];
    robot.shares = i == theirKeeper ? learned.keeperShares() : learned.aimShares();
    robot.pace = mean;
    robot.paceSigma = std::sqrt(std::max(0.0, squares - mean * mean));
  }
}

}  // namespace

rollout::Setup setupFor(const ProcessOptions& options) {
  rollout::Setup setup;
  setup.field = options.field;
  setup.body.ballMass = options.field.ballMass;
  setup.noise.ofModel = true;
  // Team-mates play with the numbers of this robot, and so do opponents but for what is peculiar to
  // it.
  BehaviourParameters theirs = options.parameters;
  theirs.aimSide = theirs.keeperAside = 0.0;
  const bool isKnown = options.behaviour == "supporter" || options.behaviour == "keeper";
  for (std::size_t i = 0; i < allPlayers; ++i) {
    rollout::Player player;
    player.side = i < theirKeeper ? rollout::Side::Left : rollout::Side::Right;
    player.model = options.model;
    player.behaviour.name = i == mateKeeper || i == theirKeeper ? "keeper" : "striker";
    if (i == ownPlayer && isKnown) player.behaviour.name = options.behaviour;
    player.behaviour.parameters = player.side == rollout::Side::Left ? options.parameters : theirs;
    if (player.side == rollout::Side::Right && options.advisor.learns) {
      player.variants = i == theirKeeper ? keeperVariants(theirs) : aimVariants(theirs);
    }
    setup.players.push_back(std::move(player));
  }
  return setup;
}

void OpponentMemory::update(const Points& opponents, double now) {
  std::vector<bool> isNew(m_known.size(), false);
  for (const Point& place : opponents) {
    std::size_t best = m_known.size();
    double least = moves;
    for (std::size_t i = 0; i < m_known.size(); ++i) {
      const double metres = distance(m_known[i].place, place);
      if (metres >= least || (i < isNew.size() && isNew[i])) continue;
      best = i;
      least = metres;
    }
    if (best == m_known.size()) {
      m_known.push_back({place, now});
      isNew.push_back(true);
    } else {
      isNew[best] = true;
      m_known[best] = {place, now};
    }
  }
  std::erase_if(m_known,
                [now](const Known& one) { return now - one.seen > remembers || one.seen > now; });
}

rollout::Belief beliefOf(const Situation& now, const OpponentMemory& opponents, double time,
                         const ProcessOptions& options, const OpponentModel& learned) {
  const sim::FieldSpec& field = options.field;
  rollout::Belief belief;
  belief.robots.resize(allPlayers);
  for (rollout::RobotBelief& robot : belief.robots) robot.absent = true;
  const Point ball = *now.ball;
  const auto facing = [&ball](const Point& from) { return direction(from, ball); };

  // What its own pose is wrong by counts less than where the ball lies before its feet.
  belief.robots[ownPlayer] = at(now.pose.position, now.pose.yaw, 0.03, 0.03);
  const sim::GaitSpeed gait = sim::gaitSpeed(options.model, now.doing.action, now.doing.b);
  belief.robots[ownPlayer].forward = gait.forward;
  belief.robots[ownPlayer].left = gait.left;
  belief.robots[ownPlayer].turn = gait.turn;

  std::size_t mates = 0, next = firstMate;
  for (const auto& mate : now.mates) {
    if (!mate) continue;
    ++mates;
    if (mate->active && !mate->takesPart()) continue;  // it stands aside
    const bool isKeeper = mate->intention == Intention::Keep && belief.robots[mateKeeper].absent;
    const std::size_t place = isKeeper ? mateKeeper : next;
    if (place == theirKeeper) continue;
    if (!isKeeper) ++next;
    belief.robots[place] = at(mate->position, facing(mate->position), sigmaSeen, 0.5);
    if (mate->active) continue;
    belief.robots[place].down = true;
    belief.robots[place].getsUpIn = getsUp;
  }

  const Point theirGoal{field.halfLength(), 0.0};
  const OpponentMemory::Known* keeper = nullptr;
  for (const OpponentMemory::Known& one : opponents.known()) {
    const double metres = distance(one.place, theirGoal);
    if (metres < keeperZone && (!keeper || metres < distance(keeper->place, theirGoal)))
      keeper = &one;
  }
  const auto sigmaOf = [time](const OpponentMemory::Known& one) {
    return sigmaSeen + sigmaGrows * (time - one.seen);
  };
  next = firstTheirs;
  for (const OpponentMemory::Known& one : opponents.known()) {
    if (&one == keeper) {
      belief.robots[theirKeeper] = at(one.place, facing(one.place), sigmaOf(one), 0.4);
    } else if (next < allPlayers) {
      belief.robots[next++] = at(one.place, facing(one.place), sigmaOf(one), 0.7);
    }
  }
  // As many as its own team are on the field; whom nobody has seen waits somewhere behind the ball.
  for (std::size_t side = 0; next < firstTheirs + mates && next < allPlayers; ++side) {
    constexpr double behind = 1.2, beside = 1.5, anywhere = 0.8, inside = 0.3;  // m
    const double x = field.halfLength() - inside, y = field.halfWidth() - inside;
    const Point place{std::clamp(ball.x + behind, -x, x),
                      std::clamp(ball.y + (side % 2 == 0 ? beside : -beside), -y, y)};
    belief.robots[next++] = at(place, facing(place), anywhere, 0.7);
  }
  // A keeper stands where nobody has looked, unless all of them are known.
  if (!keeper && mates > 0 && opponents.known().size() <= mates) {
    if (options.advisor.learns) {
      belief.robots[theirKeeper] = unseenKeeper(field, ball, learned.keeperShares());
    } else {
      const Point line{field.halfLength() - 0.4, 0.0};
      belief.robots[theirKeeper] = at(line, facing(line), 0.25, 0.4);
    }
  }
  if (options.advisor.learns) addLearned(learned, belief);

  belief.ball.place = ball;
  belief.ball.sigma = 0.03 + 0.04 * distance(now.pose.position, ball);
  if (now.seesBall) belief.ball.velocity = now.ballVelocity;
  belief.ball.velocitySigma = 0.02;
  if (!now.seesBall) belief.ball.sigma = 0.3;
  belief.game.goalsLeft = now.goalsOwn;
  belief.game.goalsRight = now.goalsTheirs;
  if (now.secondsLeft > 0) belief.game.secondsLeft = now.secondsLeft;
  return belief;
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_watch.h"

#include <algorithm>
#include <cmath>

#include <robotlink/report/match_tally.h>

namespace pitchboard::link {
namespace {

constexpr double close = 0.5;         // m between two robots that are in each other's way
constexpr double againWithin = 30.0;  // s
constexpr double stuckReach = 0.1;    // m
constexpr int stands = 0, stepsInPlace = 11;

bool isInPlay(const sim::WorldState& world) {
  if (!world.game) return true;
  const Game& game = *world.game;
  return game.state == PlayState::Playing && game.ballFree() && !game.stopped &&
         game.phase != GamePhase::ShootOut;
}

const GamePlayer* playerOf(const sim::WorldState& world, const sim::RobotIdentity& robot) {
  return world.game ? world.game->player(robot.team, robot.number) : nullptr;
}

bool takesPart(const sim::WorldState& world, const sim::RobotIdentity& robot) {
  const GamePlayer* player = playerOf(world, robot);
  return !player || player->penalty == PenaltyKind::None;
}

/// Returns whether the referee's packets call it a goalkeeper; false without a referee.
bool isGoalkeeper(const sim::WorldState& world, const sim::RobotIdentity& robot) {
  const GamePlayer* player = playerOf(world, robot);
  return player && player->goalkeeper;
}

bool isTransition(PlayState from, PlayState to, GamePhase phase) {
  using S = PlayState;
  switch (to) {
    case S::Initial:
      return from == S::Finished || phase == GamePhase::Timeout;
    case S::Ready:
      return from == S::Initial || from == S::Playing;
    case S::Set:
      return from == S::Ready ||
             (phase == GamePhase::ShootOut && (from == S::Initial || from == S::Finished));
    case S::Playing:
      return from == S::Set;
    case S::Finished:
      return from == S::Ready || from == S::Set || from == S::Playing;
    case S::Standby:
    case S::Unknown:
      break;
  }
  return false;
}

}  // namespace

void MatchWatch::ticked(const sim::WorldState& world, std::span<const sim::Event> events) {
  if (!world.game) return;
  m_tickRate = world.settings.tickRate;
  m_halves = std::max(m_halves, world.game->half);
  const bool ready = world.game->state == PlayState::Ready;
  m_readies += ready && !m_ready;
  m_readyTicks += ready;
  m_ready = ready;
  followStates(*world.game, events);
  followRemovals(world, events);
}

void MatchWatch::followStates(const Game& game, std::span<const sim::Event> events) {
  if (!m_state) {
    m_state = game.state;
    return;
  }
  for (const sim::Event& event : events) {
    if (event.kind != sim::EventKind::PlayStateChanged) continue;
    const auto next = static_cast<PlayState>(event.value);
    m_illegalTransitions += !isTransition(*m_state, next, game.phase);
    m_state = next;
  }
}

void MatchWatch::followRemovals(const sim::WorldState& world, std::span<const sim::Event> events) {
  for (const sim::Event& event : events) {
    const int robot = event.robot.value;
    if (event.kind == sim::EventKind::PenaltyOver) {
      if (const auto found = m_penalty.find(robot); found != m_penalty.end()) {
        m_cameBack[*found] = world.tick;
      }
    }
    if (event.kind != sim::EventKind::Penalised) continue;
    const auto kind = static_cast<PenaltyKind>(event.value);
    if (kind == PenaltyKind::Substitute || kind == PenaltyKind::Manual) continue;
    ++m_removals[static_cast<std::size_t>(kind)];
    m_penalty[robot] = kind;
    const auto before = m_cameBack.find({robot, kind});
    m_removedAgain += before != m_cameBack.end() &&
                      static_cast<double>(world.tick - before->second) <= againWithin * m_tickRate;
  }
}

void MatchWatch::sample(const sim::WorldState& world, const sim::Snapshot& now) {
  watchStuck(world, now);
  if (!isInPlay(world)) return;
  ++m_inPlay;
  bool attended = false;
  for (const sim::RobotSnapshot& robot : now.robots) {
    const double away = distance(robot.pose.position, now.ball);
    attended = attended || (away <= ballReach && !robot.fallen && takesPart(world, robot.identity));
  }
  m_attended += attended;
  countClose(world, now);
}

void MatchWatch::countClose(const sim::WorldState& world, const sim::Snapshot& now) {
  const sim::FieldSpec& field = world.settings.field;
  for (std::size_t colour = 0; colour < m_close.size(); ++colour) {
    std::vector<Point> team;
    for (const sim::RobotSnapshot& robot : now.robots) {
      const bool first = robot.identity.team == now.robots.front().identity.team;
      if (first != (colour == 0) || !takesPart(world, robot.identity) ||
          isGoalkeeper(world, robot.identity)) {
        continue;
      }
      team.push_back(robot.pose.position);
    }
    const auto nearest = std::ranges::min_element(
        team, {}, [&now](const Point& at) { return distance(at, now.ball); });
    if (nearest != team.end()) team.erase(nearest);
    std::erase_if(team, [&field](const Point& at) {
      return std::abs(at.x) > field.halfLength() || std::abs(at.y) > field.halfWidth();
    });
    bool any = false;
    for (std::size_t i = 0; i < team.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) any = any || distance(team[i], team[j]) < close;
    }
    m_close[colour] += any;
  }
}

void MatchWatch::watchStuck(const sim::WorldState& world, const sim::Snapshot& now) {
  m_still.resize(now.robots.size());
  for (std::size_t i = 0; i < now.robots.size(); ++i) {
    const sim::RobotSnapshot& robot = now.robots[i];
    Still& one = m_still[i];
    const bool plays = isInPlay(world) && takesPart(world, robot.identity);
    if (!plays || distance(robot.pose.position, one.place) > stuckReach) {
      one = {robot.pose.position, now.time, 0, 0};
    }
    ++one.samples;
    one.walking += robot.action != stands && robot.action != stepsInPlace;
    if (one.walking * 10 < one.samples * 9) continue;
    m_maxStuck = std::max(m_maxStuck, now.time - one.since);
  }
}

double MatchWatch::removalsOfTeamAndHalf() const {
  int all = 0;
  for (const int count : m_removals) all += count;
  return all / 2.0 / m_halves;
}

double MatchWatch::ready() const {
  if (m_readies == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(m_readyTicks) / m_tickRate / m_readies;
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/rules/game_start.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <base/try.h>

#include "referee_table.h"

namespace pitchboard::sim {
namespace {

tl::unexpected<Error> wrong(std::string text) {
  return failure(ErrorCode::InvalidArgument, std::move(text), "game");
}

/// Six digits say any tick.
double secondsIn(int ticks, double tickRate) {
  constexpr double digits = 1e6;
  return std::round(static_cast<double>(ticks) / tickRate * digits) / digits;
}

}  // namespace

Result<void> RefereeTable::start(const GameStart& start) {
  Game& g = m_game;
  const auto indexOf = [&](const std::optional<TeamColor>& colour) -> Result<int> {
    if (!colour) return Game::noTeam;
    const int team = g.teamOf(*colour);
    if (team >= 0) return team;
    return wrong("The " + std::string(info(*colour).name) + " team does not play in this match.");
  };
  const auto robotOf = [&](RobotId id) -> Result<std::size_t> {
    for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
      if (m_world.robots[i].id == id && player(i)) return i;
    }
    return wrong("Robot " + std::to_string(id.value) + " belongs to neither team.");
  };

  if (start.left && TRY(indexOf(start.left)) != static_cast<int>(g.leftTeam())) swapSides(m_world);
  if (start.firstKickOff) g.firstKickOff = TRY(indexOf(start.firstKickOff));
  g.phase = start.phase;
  g.phaseBefore = start.phaseBefore;
  if (g.phase == GamePhase::Timeout && start.state != PlayState::Initial) {
    return wrong("During a timeout the state is \"initial\"; the game then goes on with READY.");
  }
  if (g.phaseBefore == GamePhase::Timeout) {
    return wrong(
        "\"phase_before\" is the phase to which the game returns after the timeout, so it "
        "cannot be \"timeout\".");
  }
  g.half = start.half;
  g.kickOff = start.kickOff ? TRY(indexOf(start.kickOff->team)) : kickingOff(start.half);
  g.shooter = TRY(indexOf(start.shooter));
  const GamePhase timed = g.phase == GamePhase::Timeout ? g.phaseBefore : g.phase;
  const int full = ticks(timed == GamePhase::ShootOut    ? m_rules.shotTime
                         : timed == GamePhase::ExtraTime ? m_rules.extraHalfTime
                                                         : m_rules.halfTime);
  g.clock = start.clock ? ticks(*start.clock) : full;

  for (const auto& [colour, given] : start.teams) {
    GameTeam& team = g.teams[static_cast<std::size_t>(TRY(indexOf(colour)))];
    team.score = given.score;
    team.penaltyShots = given.shots;
    team.singleShots = given.scored;
    team.timeouts = given.timeouts;
    team.penalties = given.removals;
    team.byHalf = given.byHalf.value_or(std::array<int, 4>{});
    if (const auto period = g.period(); period && !given.byHalf) team.byHalf[*period] = given.score;
  }

  // The beginning of the state; what is said of it follows.
  const PlayState state = start.state;
  g.state = state;
  g.stateTicks = 0;
  g.countdown = state == PlayState::Ready ? Game::Countdown{ticks(m_rules.readyTime), true}
                : state == PlayState::Finished && g.half == 1
                    ? Game::Countdown{ticks(m_rules.breakTime), true}
                : g.phase == GamePhase::Timeout ? Game::Countdown{ticks(m_rules.timeoutTime), true}
                                                : Game::Countdown{};
  if (state == PlayState::Finished) {
    g.breakLeft = ticks(std::max(m_rules.breakTime, m_rules.beforeHalf));
  }
  const bool hasBegun = g.clock < full;
  g.clockUse = start.clockUse                                                ? *start.clockUse
               : hasBegun                                                    ? ClockUse::Began
               : state == PlayState::Playing || state == PlayState::Finished ? ClockUse::BeganNow
                                                                             : ClockUse::Full;
  m_memory.still = m_memory.near = {m_now.ball, 0};
  for (std::size_t i = 0; i < m_memory.watches.size(); ++i) {
    const Point& at = m_now.robots[i].pose.position;
    m_memory.watches[i].setPose = m_now.robots[i].pose;
    const bool isOutside = std::abs(at.x) > m_field.halfLength() + radiusOf(i) ||
                           std::abs(at.y) > m_field.halfWidth() + radiusOf(i);
    if (isOutside && state != PlayState::Initial) comesBack(i);
  }

  for (const auto& [id, given] : start.robots) {
    const std::size_t robot = TRY(robotOf(id));
    GamePlayer& one = *player(robot);
    one.warnings = given.warnings;
    one.yellow = given.yellow;
    one.red = given.red;
    one.cautions = given.cautions;
    if (given.goalkeeper) {
      // The goalkeeper is then given for the whole team.
      for (std::size_t i = 0; i < m_world.robots.size(); ++i) {
        if (teamOf(i) != teamOf(robot)) continue;
        const auto other = start.robots.find(m_world.robots[i].id);
        player(i)->goalkeeper =
            other != start.robots.end() && other->second.goalkeeper.value_or(false);
      }
    }
    if (given.penalty == PenaltyKind::None) continue;
    one.penalty = given.penalty;
    one.sinceTicks = ticks(given.since);
    one.outside = given.outside;
    one.ticksLeft = given.left ? ticks(*given.left) : removalTicks(robot, given.penalty);
    one.counting = given.counts
                       ? *given.counts
                       : given.outside || m_rules.countsFromCall || staysOnField(one.penalty);
  }

  if (const auto& given = start.setPlay) {
    const int team = TRY(indexOf(given->team));
    const Point where = given->place.value_or(m_now.ball);
    if (given->step) {
      g.restart = {*given->step,  given->kind,     team, where, given->kicker.value,
                   given->passed, given->onlyTaker};
    } else {
      if (given->kind == SetPlay::None || team < 0 || state != PlayState::Playing) {
        return wrong("A set play begins while the game is PLAYING, and needs its kind and team.");
      }
      beginSetPlay(given->kind, team, where);
    }
  } else if (state == PlayState::Playing && g.phase == GamePhase::ShootOut && g.shooter >= 0) {
    g.restart = {
        Restart::Step::Executed, SetPlay::PenaltyKick, g.shooter, m_now.ball, 0, true, false};
  }

  if (start.stateTime) g.stateTicks = ticks(*start.stateTime);
  if (start.countdown) g.countdown = {ticks(*start.countdown), *start.countdown > 0.0};
  if (start.countdownRuns) g.countdown.runs = *start.countdownRuns;
  if (start.hidden) g.hidden = ticks(*start.hidden);
  if (start.breakLeft) g.breakLeft = ticks(*start.breakLeft);
  if (start.dropIn) g.dropIn = {TRY(indexOf(start.dropIn->team)), ticks(start.dropIn->ago)};
  if (start.touch) {
    const std::size_t robot = TRY(robotOf(start.touch->robot));
    m_memory.touch = {start.touch->robot.value, teamOf(robot), ticks(start.touch->ago)};
  }
  for (const auto& [given, rest] :
       {std::pair(&start.ballStill, &m_memory.still), std::pair(&start.ballNear, &m_memory.near)}) {
    if (*given) *rest = {(*given)->place.value_or(m_now.ball), ticks((*given)->time)};
  }
  m_memory.aloneTicks = ticks(start.ballAlone);
  g.stopped = g.stopped || start.stopped;
  g.over = start.over;
  if (!isPlausible(g, m_memory, m_world.robots.size())) {
    return wrong("A number of the game is out of range.");
  }
  mirror();
  return {};
}

Result<void> startGame(WorldState& world, const Snapshot& now, const GameStart& start,
                       Placements& placements, std::vector<Event>& events) {
  return RefereeTable(world, now, placements, events).start(start);
}

GameStart gameStartOf(const WorldState& world) {
  const Game& g = *world.game;
  const RefereeMemory& memory = world.refereeMemory;
  const double rate = world.settings.tickRate;
  const auto seconds = [rate](int ticks) { return secondsIn(ticks, rate); };
  const auto colourOf = [&g](int team) -> std::optional<TeamColor> {
    if (team < 0) return {};
    return g.teams[static_cast<std::size_t>(team)].colour;
  };
  const auto plays = [&world](RobotId id) {
    return std::ranges::any_of(world.robots, [id](const auto& robot) { return robot.id == id; });
  };
  GameStart out;
  out.state = g.state;
  out.phase = g.phase;
  out.phaseBefore = g.phaseBefore;
  out.half = g.half;
  out.clock = seconds(g.clock);
  out.clockUse = g.clockUse;
  out.stateTime = seconds(g.stateTicks);
  out.countdown = seconds(g.countdown.ticks);
  out.countdownRuns = g.countdown.runs;
  out.hidden = seconds(g.hidden);
  out.breakLeft = seconds(g.breakLeft);
  out.left = colourOf(static_cast<int>(g.leftTeam()));
  out.firstKickOff = colourOf(g.firstKickOff);
  out.kickOff = GameStart::KickOff{colourOf(g.kickOff)};
  if (g.restart != Restart{}) {
    const RobotId kicker{plays(RobotId{g.restart.kicker}) ? g.restart.kicker : 0};
    out.setPlay = GameStart::Taking{
        g.restart.kind, colourOf(g.restart.team), g.restart.step,     g.restart.place,
        kicker,         g.restart.passed,         g.restart.onlyTaker};
  }
  out.shooter = colourOf(g.shooter);
  if (g.dropIn.team >= 0) {
    out.dropIn = GameStart::DropIn{*colourOf(g.dropIn.team), seconds(g.dropIn.ticks)};
  }
  if (plays(RobotId{memory.touch.robot})) {
    out.touch = GameStart::Touch{RobotId{memory.touch.robot}, seconds(memory.touch.ticks)};
  }
  out.ballStill = GameStart::Rest{memory.still.place, seconds(memory.still.ticks)};
  out.ballNear = GameStart::Rest{memory.near.place, seconds(memory.near.ticks)};
  out.ballAlone = seconds(memory.aloneTicks);
  out.stopped = g.stopped;
  out.over = g.over;
  for (const GameTeam& team : g.teams) {
    out.teams[team.colour] = {team.score,       team.byHalf,   team.penaltyShots,
                              team.singleShots, team.timeouts, team.penalties};
  }
  for (const RobotIdentity& robot : world.robots) {
    const GamePlayer* one = g.player(robot.team, robot.number);
    if (!one) continue;
    GameStart::Robot given;
    given.penalty = one->penalty;
    if (one->penalty != PenaltyKind::None) {
      given.left = seconds(one->ticksLeft);
      given.since = seconds(one->sinceTicks);
      given.outside = one->outside;
      given.counts = one->counting;
    }
    given.warnings = one->warnings;
    given.yellow = one->yellow;
    given.red = one->red;
    given.cautions = one->cautions;
    const auto& team = g.teams[static_cast<std::size_t>(g.teamOf(robot.team))];
    const bool anyKeeper =
        std::ranges::any_of(team.players, [](const GamePlayer& p) { return p.goalkeeper; });
    if (one->goalkeeper || !anyKeeper) given.goalkeeper = one->goalkeeper;
    if (given != GameStart::Robot{}) out.robots[robot.id] = given;
  }
  return out;
}

}  // namespace pitchboard::sim

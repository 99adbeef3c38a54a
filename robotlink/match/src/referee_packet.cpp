// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/referee_packet.h>

#include <algorithm>
#include <cmath>

#include <base/try.h>
#include <robotlink/cognition/announced_set_play.h>
#include <robotlink/frame/referee_view.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/rules/game_start.h>
#include <simcore/rules/referee.h>
#include <telemetry/wire/gamecontroller_encoder.h>

#include "referee_codes.h"

namespace pitchboard::link {
namespace {

using sim::GameState;
using sim::PlayState;
using sim::SetPlay;
using Step = sim::Restart::Step;
using telemetry::League;

constexpr int dropBallJava = 128, dropBallColour = 2, noTeamSoccer = 255;
constexpr int longestByte = 255;
constexpr int soccerBudget = 12000, standardBudget = 1200;

struct Dialect {
  int version, size;
  League league;
  PenaltyDialect penalties;
  bool soccer() const { return league == League::HumanoidSoccer; }
  bool byColour() const { return version <= 8; }
};

Dialect dialectOf(const sim::RefereeRules& rules) {
  const int version = rules.packetVersion;
  const int size = telemetry::refereePacketSize(version, rules.packetSize).value_or(0);
  const League league = telemetry::refereeLeague(version, size).value_or(League::Humanoid);
  return {version, size, league, penaltyDialect(version, league)};
}

int kickOffRaw(const GameState& game, const Dialect& dialect) {
  const bool stands = game.state != PlayState::Finished &&
                      !(game.state == PlayState::Playing && game.hidden == 0 && game.ballFree());
  if (dialect.soccer() && !stands) return noTeamSoccer;
  if (game.kickOff < 0) {
    return dialect.soccer() ? noTeamSoccer : dialect.byColour() ? dropBallColour : dropBallJava;
  }
  const sim::GameTeam& team = game.teams[static_cast<std::size_t>(game.kickOff)];
  return dialect.byColour() ? colourCode(team.colour) : team.number;
}

int penaltySeconds(const sim::GamePlayer& player, const Dialect& dialect, double rate) {
  const bool waits = dialect.soccer() && !player.counting;
  return waits ? 0 : std::clamp(sim::secondsOf(player.ticksLeft, rate), 0, longestByte);
}

void fillTeam(const sim::WorldState& world, const sim::GameTeam& team, const Dialect& dialect,
              telemetry::RefereeTeam& out) {
  out.number = team.number;
  out.colour = colourCode(team.colour);
  out.goalColour = out.goalkeeperColour = out.colour;
  out.score = team.score;
  out.penaltyShot = team.penaltyShots;
  out.singleShots = team.singleShots;
  out.messageBudget = dialect.soccer() ? soccerBudget : standardBudget;
  out.goalkeeper = 0;
  out.slotCount = telemetry::refereeSlots(dialect.version, dialect.size);
  for (std::size_t i = 0; i < out.slotCount; ++i) {
    telemetry::RefereePlayer& slot = out.allSlots[i];
    const sim::GamePlayer& player = team.players[i];
    const int number = static_cast<int>(i) + 1;
    slot.number = number;
    const bool there =
        team.shirts[i] != 0 &&
        std::any_of(world.robots.begin(), world.robots.end(), [&](const sim::RobotIdentity& robot) {
          return robot.team == team.colour && robot.number == team.shirts[i];
        });
    slot.penalty =
        penaltyCode(dialect.penalties, there ? player.penalty : sim::PenaltyKind::Substitute);
    slot.secondsLeft = there ? penaltySeconds(player, dialect, world.settings.tickRate) : 0;
    slot.warnings = player.warnings;
    slot.yellow = player.yellow;
    slot.red = player.red;
    slot.cautions = player.cautions;
    slot.goalkeeper = player.goalkeeper ? 1 : 0;
    if (player.goalkeeper) out.goalkeeper = number;
  }
}

int playersPerTeam(const sim::WorldState& world) {
  std::array<int, 2> count{};
  for (const sim::RobotIdentity& robot : world.robots) {
    const int team = world.game->teamOf(robot.team);
    if (team >= 0) ++count[static_cast<std::size_t>(team)];
  }
  return std::max(count[0], count[1]);
}

/// A game that begins again has the same teams.
void nameTeams(sim::WorldState& world) {
  std::vector<sim::TeamSettings> teams;
  for (const sim::GameTeam& team : world.game->teams) {
    teams.push_back({team.colour, team.number, {}});
    for (const sim::TeamSettings& before : world.settings.teams) {
      if (before.colour == team.colour) teams.back().name = before.name;
    }
  }
  world.settings.teams = std::move(teams);
}

/// Packets of version 7 alone have the teams in the order of their colours: who defends which goal
/// follows from the half, and from the shots of a shoot-out.
bool changesSides7(const telemetry::RefereeState& packet, const GameState& game) {
  constexpr int shootOut = 1;
  if (packet.secState == shootOut) {
    return game.phase == sim::GamePhase::ShootOut && game.state == PlayState::Finished &&
           packet.state == static_cast<int>(PlayState::Set);
  }
  return (packet.firstHalf != 0 ? 1 : 2) != game.half;
}

/// Numbers that the game does not know are given to the team of that colour, else by side; the
/// first team of a packet defends the left goal.
void followTeams(const telemetry::RefereeState& packet, sim::WorldState& world) {
  GameState& game = *world.game;
  const auto known = [&](int number) {
    return game.teams[0].number == number || game.teams[1].number == number;
  };
  const bool newTeams = !known(packet.teams[0].number) || !known(packet.teams[1].number);
  if (newTeams) {
    std::size_t first = game.leftTeam();
    for (std::size_t i = 0; i < 2; ++i) {
      if (colourCode(game.teams[i].colour) == packet.teams[0].colour) first = i;
    }
    game.teams[first].number = packet.teams[0].number;
    game.teams[1 - first].number = packet.teams[1].number;
    nameTeams(world);
  }
  const bool change = packet.version == 7
                          ? changesSides7(packet, game)
                          : game.swapped != (game.teams[1].number == packet.teams[0].number);
  if (change) sim::swapSides(world);
}

}  // namespace

telemetry::RefereeState refereePacket(const sim::WorldState& world, int packetNumber, bool truth) {
  const GameState& game = *world.game;
  const sim::RefereeRules& rules = *world.settings.referee;
  const Dialect dialect = dialectOf(rules);
  const double rate = world.settings.tickRate;
  telemetry::RefereeState out;
  out.version = dialect.version;
  out.size = dialect.size;
  out.league = dialect.league;
  out.packetNumber = packetNumber & 0xff;
  out.playersPerTeam = playersPerTeam(world);
  out.gameType = rules.knockout ? 1 : 0;
  out.competitionPhase = rules.knockout ? 1 : 0;
  out.competitionType = 0;

  // PLAYING that robots must not know yet looks like SET.
  const bool hidden = !truth && game.state == PlayState::Playing && game.hidden > 0;
  out.state = static_cast<int>(hidden ? PlayState::Set : game.state);
  out.firstHalf = game.half == 1 && game.phase != sim::GamePhase::ShootOut ? 1 : 0;
  out.stopped = game.stopped ? 1 : 0;
  out.kickOffRaw = kickOffRaw(game, dialect);
  for (const sim::GameTeam& team : game.teams) {
    const int key = dialect.byColour() ? colourCode(team.colour) : team.number;
    if (key == out.kickOffRaw) out.kickOffTeam = team.number;
  }
  const bool full = hidden && game.clockUse == sim::ClockUse::BeganNow;
  out.secsRemaining =
      full ? static_cast<int>(std::ceil(
                 game.phase == sim::GamePhase::ExtraTime ? rules.extraHalfTime : rules.halfTime))
           : sim::secondsOf(game.clock, rate);
  out.secondaryTime = hidden ? 0 : sim::secondsOf(game.countdown.ticks, rate);
  if (dialect.soccer() && game.state == PlayState::Playing && game.ballFree()) {
    out.secondaryTime = 0;
  }

  const int phase = static_cast<int>(game.phase == sim::GamePhase::ShootOut    ? 1
                                     : game.phase == sim::GamePhase::ExtraTime ? 2
                                     : game.phase == sim::GamePhase::Timeout   ? 3
                                                                               : 0);
  const int setPlay = setPlayCode(dialect.league, dialect.version, dialect.size, game.setPlay());
  out.gamePhase = phase;
  out.setPlay = setPlay;
  out.secState = dialect.league == League::Humanoid && setPlay != 0 ? setPlay : phase;
  std::array<int, 4> info{};
  if (dialect.league == League::Humanoid && setPlay != 0 && game.restart.team >= 0) {
    info[0] = game.teams[static_cast<std::size_t>(game.restart.team)].number;
    const bool placing = game.restart.step == Step::Placing;
    if (dialect.size == 688) {
      info[1] = placing ? 0 : game.restart.step == Step::Preparing ? 1 : 2;
    } else {
      info[1] = placing ? 1 : 0;
    }
  }
  out.secStateInfo = info;
  out.dropInTeam = 0;
  out.dropInTime = -1;
  if (game.dropIn.team >= 0) {
    const sim::GameTeam& team = game.teams[static_cast<std::size_t>(game.dropIn.team)];
    out.dropInTeam = dialect.byColour() ? colourCode(team.colour) : team.number;
    out.dropInTime = std::min(32767, static_cast<int>(game.dropIn.ticks / rate));
  }
  const std::size_t left = game.leftTeam();
  fillTeam(world, game.teams[left], dialect, out.teams[0]);
  fillTeam(world, game.teams[1 - left], dialect, out.teams[1]);
  // What this version does not send is not known to those who hear it.
  if (const auto bytes = telemetry::encodeReferee(out)) {
    const auto received = telemetry::decodeReferee(std::string_view(*bytes));
    if (const auto* state = received ? std::get_if<telemetry::RefereeState>(&*received) : nullptr) {
      return *state;
    }
  }
  return out;
}

void showReferee(const sim::WorldState& world, MatchFrame& frame) {
  frame.referee.reset();
  frame.refereedGame.reset();
  for (RobotFrame& robot : frame.robots) robot.penalty.reset();
  if (!world.game) return;
  const GameState& game = *world.game;
  const telemetry::RefereeState packet = refereePacket(world, 0, true);
  const sim::RefereeRules& rules = *world.settings.referee;
  frame.refereedGame = std::make_shared<const RefereedGame>(RefereedGame{game, rules});
  for (const sim::GameTeam& team : game.teams) {
    frame.teams[static_cast<std::size_t>(team.colour) + 1].number = team.number;
  }
  RefereeView& view = frame.referee.emplace(viewOf(packet, frame.teams));
  view.stopped = game.stopped;  // which version 12 does not send, and who referees has to see
  view.sender = rules.automatic ? "the simulated referee" : "a person";
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& shirts = game.teams[side == 0 ? game.leftTeam() : 1 - game.leftTeam()].shirts;
    for (RefereePlayerView& player : view.teams[side].players) {
      const int shirt = shirts[static_cast<std::size_t>(player.number - 1)];
      if (shirt != 0) player.number = shirt;
    }
  }
  for (RobotFrame& robot : frame.robots) {
    const int team = game.teamOf(robot.identity.team);
    if (team < 0) continue;
    const sim::GameTeam& own = game.teams[static_cast<std::size_t>(team)];
    robot.penalty = penaltyOf(packet, own.number, own.slotOf(robot.identity.number));
  }
}

void adoptPacket(const telemetry::RefereeState& packet, sim::WorldState& world) {
  GameState& game = *world.game;
  game.obeyed = true;
  followTeams(packet, world);
  const double rate = world.settings.tickRate;
  const auto ticks = [rate](int seconds) { return static_cast<int>(std::lround(seconds * rate)); };
  const PenaltyDialect penalties = penaltyDialect(packet.version, packet.league);
  const auto state = static_cast<PlayState>(std::clamp(packet.state, 0, 4));
  if (state != game.state) {
    game.stateTicks = 0;
    if (state == PlayState::Playing) game.beginClock();
    if (state == PlayState::Initial) game.clockUse = sim::ClockUse::Full;
  }
  game.state = state;
  game.half = packet.firstHalf != 0 ? 1 : 2;
  game.hidden = 0;
  game.stopped = packet.stopped.value_or(0) != 0;
  const int phase =
      packet.gamePhase.value_or(packet.secState.value_or(0) <= 3 ? packet.secState.value_or(0) : 0);
  game.phase = phase == 1   ? sim::GamePhase::ShootOut
               : phase == 2 ? sim::GamePhase::ExtraTime
               : phase == 3 ? sim::GamePhase::Timeout
                            : sim::GamePhase::Normal;
  // Small corrections of a clock that runs here as well would only make it jump.
  const auto follow = [&](int& have, int seconds) {
    if (sim::secondsOf(have, rate) != seconds) have = ticks(seconds);
  };
  follow(game.clock, packet.secsRemaining);
  follow(game.countdown.ticks, packet.secondaryTime.value_or(0));
  game.countdown.runs = game.countdown.ticks > 0;
  const auto indexOf = [&](std::optional<int> number) {
    for (std::size_t i = 0; number && i < game.teams.size(); ++i) {
      if (game.teams[i].number == *number) return static_cast<int>(i);
    }
    return GameState::noTeam;
  };
  game.restart = {};
  const AnnouncedSetPlay announced = setPlayIn(packet);
  game.restart.kind = announced.kind;
  if (announced.kind != SetPlay::None) {
    const bool hasDetails = packet.secStateInfo && packet.size == 688;
    const int step = hasDetails ? (*packet.secStateInfo)[1] : game.stopped ? 0 : 2;
    game.restart.step = step == 0 ? Step::Placing : step == 1 ? Step::Preparing : Step::Taking;
    game.restart.team = indexOf(announced.team);
  }
  game.kickOff = indexOf(packet.kickOffTeam);
  if (game.restart.kind == SetPlay::None && state == PlayState::Playing && game.kickOff >= 0 &&
      game.countdown.runs) {
    game.restart.step = Step::Executed;
    game.restart.team = game.kickOff;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const telemetry::RefereeTeam& sent = packet.teams[side];
    const int index = indexOf(sent.number);
    if (index < 0) continue;
    sim::GameTeam& team = game.teams[static_cast<std::size_t>(index)];
    if (const auto period = game.period()) {
      team.byHalf[*period] = std::max(0, team.byHalf[*period] + sent.score - team.score);
    }
    team.score = sent.score;
    team.penaltyShots = sent.penaltyShot.value_or(team.penaltyShots);
    team.singleShots = sent.singleShots.value_or(team.singleShots);
    const auto slots = sent.players();
    for (std::size_t i = 0; i < slots.size() && i < team.players.size(); ++i) {
      sim::GamePlayer& player = team.players[i];
      const sim::PenaltyKind kind = penaltyOf(penalties, slots[i].penalty);
      if (kind != player.penalty) {
        player.penalty = kind;
        player.outside = false;
        player.sinceTicks = 0;
      }
      player.ticksLeft = ticks(slots[i].secondsLeft);
      player.counting = kind != sim::PenaltyKind::None;
    }
  }
  const std::size_t left = game.leftTeam();
  world.score = {game.teams[left].score, game.teams[1 - left].score};
}

sim::RefereeRules rulesOfPacket(const telemetry::RefereeState& packet) {
  constexpr int firstOf2021 = 10, firstOf2026 = 19;
  const bool isNew = packet.version >= firstOf2026;
  const auto set = refereeRuleSet(isNew                           ? "humanoid-soccer-2026"
                                  : packet.version >= firstOf2021 ? "humanoid-2021"
                                                                  : "humanoid-2014");
  sim::RefereeRules rules = set && *set ? **set : sim::RefereeRules{};
  rules.packetVersion = packet.version;
  rules.packetSize = packet.size;
  return rules;
}

Result<void> takeGame(const telemetry::RefereeState& packet, Scenario& scenario) {
  sim::SimulationSettings settings = scenario.settings;
  settings.referee.reset();
  auto simulation = TRY(sim::Simulation::create(settings));
  TRY(simulation.placeBall(scenario.ball));
  for (const ScenarioRobot& robot : scenario.robots) {
    TRY(simulation.addRobot(robot.identity, robot.pose, robot.model));
  }
  TRY(simulation.setReferee(scenario.settings.referee.value_or(rulesOfPacket(packet))));
  sim::WorldState& world = simulation.editState();
  adoptPacket(packet, world);
  world.game->restart.place = scenario.ball;
  // Who is penalised has been put outside already, if it stands there.
  const sim::FieldSpec& field = settings.field;
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const Point& at = scenario.robots[i].pose.position;
    const int team = world.game->teamOf(world.robots[i].team);
    if (team < 0) continue;
    sim::GameTeam& own = world.game->teams[static_cast<std::size_t>(team)];
    const int slot = own.slotOf(world.robots[i].number);
    if (slot == 0) continue;
    sim::GamePlayer& player = own.players[static_cast<std::size_t>(slot - 1)];
    player.outside = player.penalty != sim::PenaltyKind::None &&
                     (std::abs(at.x) > field.halfLength() || std::abs(at.y) > field.halfWidth());
    scenario.robots[i].identity.imuStartsAt180 = world.robots[i].imuStartsAt180;
  }
  scenario.settings.referee = world.settings.referee;
  scenario.settings.teams = world.settings.teams;
  scenario.game = sim::gameStartOf(world);
  for (auto& [id, robot] : scenario.game->robots) {
    // Some leagues say 0 until the robot has been carried out.
    if (robot.penalty != sim::PenaltyKind::None && robot.left == 0.0 && !robot.outside) {
      robot.left.reset();
      robot.counts.reset();
    }
  }
  return {};
}

}  // namespace pitchboard::link

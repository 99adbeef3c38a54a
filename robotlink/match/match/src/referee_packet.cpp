// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/referee_packet.h>

#include <algorithm>
#include <cmath>

#include <base/try.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/rules/game_start.h>
#include <simcore/rules/referee.h>
#include <telemetry/referee/gamecontroller_encoder.h>

namespace pitchboard::link {
namespace {

using Step = Restart::Step;
using telemetry::colourCode;
using telemetry::RefereeState;

constexpr int dropBallJava = 128, dropBallColour = 2, noTeamSoccer = 255;
constexpr int maxByte = 255;
constexpr int soccerBudget = 12000, standardBudget = 1200;

bool isSoccer(const RefereeState& packet) {
  return packet.league == League::HumanoidSoccer;
}

/// Until version 8 teams are told by their colours.
int teamCode(const GameTeam& team, const RefereeState& packet) {
  return packet.version <= 8 ? colourCode(team.colour) : team.number;
}

int kickOffRaw(const Game& game, const RefereeState& packet) {
  const bool stands = game.state != PlayState::Finished &&
                      !(game.state == PlayState::Playing && game.hidden == 0 && game.ballFree());
  if (isSoccer(packet) && (!stands || game.kickOff < 0)) return noTeamSoccer;
  if (game.kickOff < 0) return packet.version <= 8 ? dropBallColour : dropBallJava;
  return teamCode(game.teams[static_cast<std::size_t>(game.kickOff)], packet);
}

/// Whether a robot wears the shirt in this slot.
bool isTaken(const sim::WorldState& world, const GameTeam& team, std::size_t slot) {
  return team.shirts[slot] != 0 && std::ranges::any_of(world.robots, [&](const auto& robot) {
           return robot.team == team.colour && robot.number == team.shirts[slot];
         });
}

telemetry::RefereeTeam teamOf(const sim::WorldState& world, const GameTeam& team,
                              const RefereeState& packet) {
  telemetry::RefereeTeam out;
  out.number = team.number;
  out.colour = colourCode(team.colour);
  out.goalColour = out.goalkeeperColour = out.colour;
  out.score = team.score;
  out.penaltyShot = team.penaltyShots;
  out.singleShots = team.singleShots;
  out.messageBudget = isSoccer(packet) ? soccerBudget : standardBudget;
  out.goalkeeper = 0;
  out.slotCount = telemetry::refereeSlots(packet.version, packet.size);
  for (std::size_t i = 0; i < out.slotCount; ++i) {
    telemetry::RefereePlayer& slot = out.allSlots[i];
    const GamePlayer& player = team.players[i];
    slot.number = static_cast<int>(i) + 1;
    const bool there = isTaken(world, team, i);
    slot.penalty = telemetry::penaltyCode(packet, there ? player.penalty : PenaltyKind::Substitute);
    slot.secondsLeft = there ? std::min(world.game->penaltySeconds(player), maxByte) : 0;
    slot.warnings = player.warnings;
    slot.yellow = player.yellow;
    slot.red = player.red;
    slot.cautions = player.cautions;
    slot.goalkeeper = player.goalkeeper ? 1 : 0;
    if (player.goalkeeper) out.goalkeeper = slot.number;
  }
  return out;
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
  for (const GameTeam& team : world.game->teams) {
    teams.push_back({team.colour, team.number, {}});
    for (const sim::TeamSettings& before : world.settings.teams) {
      if (before.colour == team.colour) teams.back().name = before.name;
    }
  }
  world.settings.teams = std::move(teams);
}

/// Packets of version 7 alone have the teams in the order of their colours: who defends which goal
/// follows from the half, and from the shots of a shoot-out.
bool changesSides7(const Game& received, const Game& game) {
  if (received.phase == GamePhase::ShootOut) {
    return game.phase == GamePhase::ShootOut && game.state == PlayState::Finished &&
           received.state == PlayState::Set;
  }
  return received.half != game.half;
}

/// Numbers that the game does not know are given to the team of that colour, else by side.
void followTeams(const Game& received, bool byColour, sim::WorldState& world) {
  Game& game = *world.game;
  const GameTeam &left = received.teamAt(false), &right = received.teamAt(true);
  if (game.teamNumbered(left.number) < 0 || game.teamNumbered(right.number) < 0) {
    const int alike = game.teamOf(left.colour);
    const std::size_t first = alike < 0 ? game.leftTeam() : static_cast<std::size_t>(alike);
    game.teams[first].number = left.number;
    game.teams[1 - first].number = right.number;
    nameTeams(world);
  }
  const bool change = byColour ? changesSides7(received, game)
                               : game.swapped != (game.teams[1].number == left.number);
  if (change) sim::swapSides(world);
}

/// State, phase, half and times.
void adoptState(const Game& received, Game& game, double rate) {
  const auto ticks = [rate](int seconds) { return static_cast<int>(std::lround(seconds * rate)); };
  const PlayState state =
      received.state <= lastOf(PlayState{}) ? received.state : PlayState::Initial;
  if (state != game.state) {
    game.stateTicks = 0;
    if (state == PlayState::Playing) game.beginClock();
    if (state == PlayState::Initial) game.clockUse = ClockUse::Full;
  }
  game.state = state;
  game.half = received.half;
  game.hidden = 0;
  game.stopped = received.stopped;
  game.phase = received.phase <= lastOf(GamePhase{}) ? received.phase : GamePhase::Normal;
  if (game.phase != GamePhase::Timeout) game.phaseBefore = game.phase;
  // Small corrections of a clock that runs here as well would only make it jump.
  const auto follow = [&](int& have, int seconds) {
    if (game.seconds(have) != seconds) have = ticks(seconds);
  };
  follow(game.clock, received.secondsLeft());
  follow(game.countdown.ticks, received.seconds(received.countdown.ticks));
  game.countdown.runs = game.countdown.ticks > 0;
}

/// Score, shots and penalties of a team; `hasShots`: packets of this version tell shots.
void adoptTeam(const GameTeam& sent, bool hasShots, Game& game, GameTeam& team) {
  if (const auto period = game.period()) {
    team.byHalf[*period] = std::max(0, team.byHalf[*period] + sent.score - team.score);
  }
  team.score = sent.score;
  if (game.phase == GamePhase::ShootOut && hasShots) {
    // Some versions of the Standard Platform League send another flag here in other phases.
    team.penaltyShots = sent.penaltyShots;
    team.singleShots = sent.singleShots;
  }
  for (std::size_t i = 0; i < team.players.size(); ++i) {
    if (sent.shirts[i] == 0 && sent.players[i] == GamePlayer{}) continue;  // not in packets
    GamePlayer& player = team.players[i];
    const PenaltyKind kind = simulated(sent.players[i].penalty);
    if (kind != player.penalty) {
      player.penalty = kind;
      player.outside = false;
      player.sinceTicks = 0;
    }
    player.ticksLeft = static_cast<int>(std::lround(sent.players[i].ticksLeft * game.tickRate));
    player.counting = sent.players[i].counting;
  }
}

}  // namespace

RefereeState refereePacket(const sim::WorldState& world, int packetNumber, bool truth) {
  const Game& game = *world.game;
  const sim::RefereeRules& rules = *world.settings.referee;
  RefereeState out;
  out.version = rules.packetVersion;
  out.size = telemetry::refereePacketSize(out.version, rules.packetSize).value_or(0);
  out.league = telemetry::refereeLeague(out.version, out.size).value_or(League::Humanoid);
  out.packetNumber = packetNumber & 0xff;
  out.playersPerTeam = playersPerTeam(world);
  out.gameType = rules.knockout ? 1 : 0;
  out.competitionPhase = rules.knockout ? 1 : 0;
  out.competitionType = 0;

  // PLAYING that robots must not know yet looks like SET.
  const bool hidden = !truth && game.state == PlayState::Playing && game.hidden > 0;
  out.state = static_cast<int>(hidden ? PlayState::Set : game.state);
  out.firstHalf = game.half == 1 && game.phase != GamePhase::ShootOut ? 1 : 0;
  out.stopped = game.stopped ? 1 : 0;
  out.kickOffRaw = kickOffRaw(game, out);
  for (const GameTeam& team : game.teams) {
    if (teamCode(team, out) == out.kickOffRaw) out.kickOffTeam = team.number;
  }
  const bool full = hidden && game.clockUse == ClockUse::BeganNow;
  out.secsRemaining =
      full ? static_cast<int>(std::ceil(game.phase == GamePhase::ExtraTime ? rules.extraHalfTime
                                                                           : rules.halfTime))
           : game.secondsLeft();
  out.secondaryTime = hidden ? 0 : game.seconds(game.countdown.ticks);
  if (isSoccer(out) && game.state == PlayState::Playing && game.ballFree()) {
    out.secondaryTime = 0;
  }

  const int phase = static_cast<int>(game.phase);
  const int setPlay = telemetry::setPlayCode(out, game.setPlay());
  out.gamePhase = phase;
  out.setPlay = setPlay;
  out.secState = out.league == League::Humanoid && setPlay != 0 ? setPlay : phase;
  std::array<int, 4> info{};
  if (out.league == League::Humanoid && setPlay != 0 && game.restart.team >= 0) {
    info[0] = game.teams[static_cast<std::size_t>(game.restart.team)].number;
    const bool placing = game.restart.step == Step::Placing;
    if (out.size == 688) {
      info[1] = placing ? 0 : game.restart.step == Step::Preparing ? 1 : 2;
    } else {
      info[1] = placing ? 1 : 0;
    }
  }
  out.secStateInfo = info;
  out.dropInTeam = 0;
  out.dropInTime = -1;
  if (game.dropIn.team >= 0) {
    out.dropInTeam = teamCode(game.teams[static_cast<std::size_t>(game.dropIn.team)], out);
    out.dropInTime = std::min(32767, static_cast<int>(game.dropIn.ticks / game.tickRate));
  }
  for (const bool right : {false, true}) {
    out.teams[right ? 1 : 0] = teamOf(world, game.teamAt(right), out);
  }
  // What this version does not send is not known to those who hear it.
  if (const auto bytes = telemetry::encodeReferee(out)) {
    const auto received = telemetry::decodeReferee(std::string_view(*bytes));
    if (const auto* state = received ? std::get_if<RefereeState>(&*received) : nullptr) {
      return *state;
    }
  }
  return out;
}

void showReferee(const std::optional<Game>& game, const std::optional<sim::RefereeRules>& rules,
                 MatchFrame& frame) {
  frame.game = game;
  frame.rules.reset();
  for (RobotFrame& robot : frame.robots) robot.penalty.reset();
  if (!game || !rules) return;
  frame.rules = std::make_shared<const sim::RefereeRules>(*rules);
  for (GameTeam& team : frame.game->teams) {
    frame.teams[static_cast<std::size_t>(teamIndex(team.colour))].number = team.number;
    for (int& shirt : team.shirts) {
      const bool worn = std::ranges::any_of(frame.robots, [&](const RobotFrame& robot) {
        return robot.identity.team == team.colour && robot.identity.number == shirt;
      });
      if (!worn) shirt = 0;
    }
  }
  for (RobotFrame& robot : frame.robots) {
    robot.penalty =
        penaltyOf(*frame.game, frame.game->player(robot.identity.team, robot.identity.number));
  }
}

void adoptGame(const Game& received, bool byColour, sim::WorldState& world) {
  Game& game = *world.game;
  world.refereeMemory.obeyed = true;
  followTeams(received, byColour, world);
  adoptState(received, game, world.settings.tickRate);
  const auto indexHere = [&](int team) {
    return team < 0 ? Game::noTeam
                    : game.teamNumbered(received.teams[static_cast<std::size_t>(team)].number);
  };
  game.kickOff = indexHere(received.kickOff);
  game.restart = {};
  game.restart.kind = simulated(received.setPlay());
  game.restart.team = indexHere(received.restart.team);
  // After a drop ball neither team has the kick-off.
  const bool held =
      received.restart.step == Step::Executed && game.kickOff >= 0 && game.countdown.runs;
  if (game.restart.kind != SetPlay::None || held) game.restart.step = received.restart.step;
  if (held && game.restart.team < 0) game.restart.team = game.kickOff;
  if (game.ballFree()) game.restart.team = Game::noTeam;
  for (const GameTeam& sent : received.teams) {
    const int index = game.teamNumbered(sent.number);
    if (index >= 0) adoptTeam(sent, !byColour, game, game.teams[static_cast<std::size_t>(index)]);
  }
  world.score = {game.teamAt(false).score, game.teamAt(true).score};
}

sim::RefereeRules rulesOfPacket(int version, int size) {
  constexpr int firstOf2021 = 10, firstOf2026 = 19;
  const bool isNew = version >= firstOf2026;
  const auto set = refereeRuleSet(isNew                    ? "humanoid-soccer-2026"
                                  : version >= firstOf2021 ? "humanoid-2021"
                                                           : "humanoid-2014");
  sim::RefereeRules rules = set && *set ? **set : sim::RefereeRules{};
  rules.packetVersion = version;
  rules.packetSize = size;
  return rules;
}

Result<void> takeGame(const Game& received, const sim::RefereeRules& rules, bool byColour,
                      Scenario& scenario) {
  sim::SimulationSettings settings = scenario.settings;
  settings.referee.reset();
  auto simulation = TRY(sim::Simulation::create(settings));
  TRY(simulation.placeBall(scenario.ball));
  for (const ScenarioRobot& robot : scenario.robots) {
    TRY(simulation.addRobot(robot.identity, robot.pose, robot.model));
  }
  TRY(simulation.setReferee(scenario.settings.referee.value_or(rules)));
  sim::WorldState& world = simulation.editState();
  adoptGame(received, byColour, world);
  world.game->restart.place = scenario.ball;
  // A penalised robot outside the field has been placed there already.
  const sim::FieldSpec& field = settings.field;
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const Point& at = scenario.robots[i].pose.position;
    const int team = world.game->teamOf(world.robots[i].team);
    if (team < 0) continue;
    GameTeam& own = world.game->teams[static_cast<std::size_t>(team)];
    const int slot = own.slotOf(world.robots[i].number);
    if (slot == 0) continue;
    GamePlayer& player = own.players[static_cast<std::size_t>(slot - 1)];
    player.outside = player.penalty != PenaltyKind::None &&
                     (std::abs(at.x) > field.halfLength() || std::abs(at.y) > field.halfWidth());
    scenario.robots[i].identity.imuStartsAt180 = world.robots[i].imuStartsAt180;
  }
  scenario.settings.referee = world.settings.referee;
  scenario.settings.teams = world.settings.teams;
  scenario.game = sim::gameStartOf(world);
  for (auto& [id, robot] : scenario.game->robots) {
    // Some leagues say 0 until the robot has been carried out.
    if (robot.penalty != PenaltyKind::None && robot.left == 0.0 && !robot.outside) {
      robot.left.reset();
      robot.counts.reset();
    }
  }
  return {};
}

}  // namespace pitchboard::link

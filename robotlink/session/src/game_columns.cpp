// SPDX-License-Identifier: GPL-3.0-or-later
#include "game_columns.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <simcore/rules/referee.h>

namespace pitchboard::link {
namespace {

using sim::GamePlayer;
using sim::GameState;
using sim::WorldState;
using telemetry::ColumnKind;

constexpr const char* category = "Referee";

double rateOf(const WorldState& world) {
  return world.settings.tickRate;
}
int ticksOf(double seconds, const WorldState& world) {
  return static_cast<int>(std::lround(std::clamp(seconds, -1e5, 1e5) * rateOf(world)));
}
int whole(double value, int least, int most) {
  return static_cast<int>(
      std::lround(std::clamp(value, static_cast<double>(least), static_cast<double>(most))));
}
template <class Enum>
Enum oneOf(double value) {
  return static_cast<Enum>(whole(value, 0, static_cast<int>(lastOf(Enum{}))));
}

/// How a number of the game is read from it, and put into another.
struct GameColumn {
  const char *name, *unit;
  double (*read)(const WorldState& world, const GameState& game);
  void (*put)(WorldState& world, GameState& game, double value);
  ColumnKind kind = ColumnKind::Number;
};

constexpr double byItself = 1, byHand = 2;

const std::array<GameColumn, gameColumnCount> game{{
    {"REFEREE", "",
     [](const WorldState& w, const GameState&) {
       return w.settings.referee && w.settings.referee->automatic ? byItself : byHand;
     },
     [](WorldState& w, GameState&, double v) { w.settings.referee->automatic = v == byItself; },
     ColumnKind::Enumeration},
    {"REFEREE_VERSION", "",
     [](const WorldState& w, const GameState&) {
       return w.settings.referee ? double(w.settings.referee->packetVersion) : 0.0;
     },
     [](WorldState& w, GameState&, double v) {
       w.settings.referee->packetVersion = whole(v, 0, 255);
     }},
    {"GAME_STATE", "", [](const WorldState&, const GameState& g) { return double(g.state); },
     [](WorldState&, GameState& g, double v) { g.state = oneOf<sim::PlayState>(v); },
     ColumnKind::Enumeration},
    {"GAME_PHASE", "", [](const WorldState&, const GameState& g) { return double(g.phase); },
     [](WorldState&, GameState& g, double v) { g.phase = oneOf<sim::GamePhase>(v); },
     ColumnKind::Enumeration},
    {"HALF", "", [](const WorldState&, const GameState& g) { return double(g.half); },
     [](WorldState&, GameState& g, double v) { g.half = whole(v, 1, 100); }},
    {"SECONDS_LEFT", "s",
     [](const WorldState& w, const GameState& g) {
       return double(sim::secondsOf(g.clock, rateOf(w)));
     },
     [](WorldState& w, GameState& g, double v) { g.clock = ticksOf(v, w); }},
    {"COUNTDOWN", "s",
     [](const WorldState& w, const GameState& g) {
       return double(sim::secondsOf(g.countdown.ticks, rateOf(w)));
     },
     [](WorldState& w, GameState& g, double v) { g.countdown.ticks = ticksOf(v, w); }},
    {"PLAY_STOPPED", "", [](const WorldState&, const GameState& g) { return double(g.stopped); },
     [](WorldState&, GameState& g, double v) { g.stopped = v != 0.0; }, ColumnKind::Flag},
    {"SET_PLAY", "", [](const WorldState&, const GameState& g) { return double(g.setPlay()); },
     [](WorldState&, GameState& g, double v) { g.restart.kind = oneOf<sim::SetPlay>(v); },
     ColumnKind::Enumeration},
    {"SET_PLAY_STEP", "",
     [](const WorldState&, const GameState& g) { return double(g.restart.step); },
     [](WorldState&, GameState& g, double v) {
       using Step = sim::Restart::Step;
       // Until 0.9 the time of a kick-off or of an executed set play had no step.
       const bool alone = g.state == sim::PlayState::Playing && g.countdown.ticks > 0;
       g.restart.step = v == 0.0 && alone ? Step::Executed : oneOf<Step>(v);
     }},
    {"SET_PLAY_TEAM", "",
     [](const WorldState&, const GameState& g) { return double(g.setPlayTeam()); },
     [](WorldState&, GameState& g, double v) { g.restart.team = whole(v, -1, 1); }},
    {"KICK_OFF_TEAM", "", [](const WorldState&, const GameState& g) { return double(g.kickOff); },
     [](WorldState&, GameState& g, double v) { g.kickOff = whole(v, -1, 1); }},
    {"LEFT_TEAM", "", [](const WorldState&, const GameState& g) { return double(g.leftTeam()); },
     [](WorldState&, GameState& g, double v) { g.swapped = v != 0.0; }},
    {"TEAM1_NUMBER", "",
     [](const WorldState&, const GameState& g) { return double(g.teams[0].number); },
     [](WorldState&, GameState& g, double v) { g.teams[0].number = whole(v, 0, 255); }},
    {"TEAM2_NUMBER", "",
     [](const WorldState&, const GameState& g) { return double(g.teams[1].number); },
     [](WorldState&, GameState& g, double v) { g.teams[1].number = whole(v, 0, 255); }},
    {"TEAM1_COLOUR", "",
     [](const WorldState&, const GameState& g) { return double(g.teams[0].colour); },
     [](WorldState&, GameState& g, double v) {
       g.teams[0].colour = static_cast<TeamColor>(whole(v, 0, teamColors.size() - 1));
     }},
    {"TEAM2_COLOUR", "",
     [](const WorldState&, const GameState& g) { return double(g.teams[1].colour); },
     [](WorldState&, GameState& g, double v) {
       g.teams[1].colour = static_cast<TeamColor>(whole(v, 0, teamColors.size() - 1));
     }},
}};

struct PlayerColumn {
  const char *name, *unit;
  double (*read)(const WorldState& world, const GamePlayer& player);
  void (*put)(WorldState& world, GamePlayer& player, double value);
  ColumnKind kind = ColumnKind::Number;
};

const std::array<PlayerColumn, playerColumnCount> playerTable{{
    {"PENALTY", "", [](const WorldState&, const GamePlayer& p) { return double(p.penalty); },
     [](WorldState&, GamePlayer& p, double v) { p.penalty = oneOf<sim::PenaltyKind>(v); },
     ColumnKind::Enumeration},
    {"PENALTY_LEFT", "s",
     [](const WorldState& w, const GamePlayer& p) {
       return double(sim::secondsOf(p.ticksLeft, rateOf(w)));
     },
     [](WorldState& w, GamePlayer& p, double v) { p.ticksLeft = ticksOf(v, w); }},
    {"PENALTY_WAITS", "",
     [](const WorldState&, const GamePlayer& p) {
       return double(p.penalty != sim::PenaltyKind::None && !p.counting);
     },
     [](WorldState&, GamePlayer& p, double v) { p.counting = v == 0.0; }, ColumnKind::Flag},
    {"WARNINGS", "", [](const WorldState&, const GamePlayer& p) { return double(p.warnings); },
     [](WorldState&, GamePlayer& p, double v) { p.warnings = whole(v, 0, 1000); }},
    {"YELLOW_CARDS", "", [](const WorldState&, const GamePlayer& p) { return double(p.yellow); },
     [](WorldState&, GamePlayer& p, double v) { p.yellow = whole(v, 0, 1000); }},
    {"RED_CARDS", "", [](const WorldState&, const GamePlayer& p) { return double(p.red); },
     [](WorldState&, GamePlayer& p, double v) { p.red = whole(v, 0, 1000); }},
    {"CAUTIONS", "", [](const WorldState&, const GamePlayer& p) { return double(p.cautions); },
     [](WorldState&, GamePlayer& p, double v) { p.cautions = whole(v, 0, 1000); }},
    {"GOALKEEPER", "", [](const WorldState&, const GamePlayer& p) { return double(p.goalkeeper); },
     [](WorldState&, GamePlayer& p, double v) { p.goalkeeper = v != 0.0; }, ColumnKind::Flag},
}};

template <class Enum>
std::map<std::int32_t, std::string> labelsOf() {
  std::map<std::int32_t, std::string> labels;
  for (int i = 0; i <= static_cast<int>(lastOf(Enum{})); ++i) {
    const std::string_view label = labelOf(static_cast<Enum>(i));
    labels[i] = label.empty() ? "none" : std::string(label);
  }
  return labels;
}

template <class Column>
telemetry::ColumnInfo infoOf(const Column& column) {
  return {column.name, telemetry::ColumnType::Float64, column.unit, category, column.kind, {}, 0.0};
}

template <class Slots, class Table>
void findSlots(const telemetry::GroupInfo& group, const Table& table, Slots& slots) {
  for (std::size_t i = 0; i < table.size(); ++i) slots[i] = findSlot(group, {table[i].name});
}

}  // namespace

std::vector<telemetry::ColumnInfo> gameColumns() {
  std::vector<telemetry::ColumnInfo> out;
  for (const GameColumn& column : game) {
    out.push_back(infoOf(column));
    const std::string_view name = column.name;
    if (name == "REFEREE") out.back().labels = {{0, "none"}, {1, "by itself"}, {2, "by hand"}};
    if (name == "GAME_STATE") out.back().labels = labelsOf<sim::PlayState>();
    if (name == "GAME_PHASE") out.back().labels = labelsOf<sim::GamePhase>();
    if (name == "SET_PLAY") out.back().labels = labelsOf<sim::SetPlay>();
  }
  return out;
}

void readGame(const WorldState& world, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  if (!world.game) return;
  for (std::size_t i = 0; i < game.size(); ++i) out[i] = game[i].read(world, *world.game);
}

std::vector<telemetry::ColumnInfo> playerColumns() {
  std::vector<telemetry::ColumnInfo> out;
  for (const PlayerColumn& column : playerTable) {
    out.push_back(infoOf(column));
    if (column.kind == ColumnKind::Enumeration) out.back().labels = labelsOf<sim::PenaltyKind>();
  }
  return out;
}

void readPlayer(const WorldState& world, const sim::RobotIdentity& robot, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  const GamePlayer* player = world.game ? world.game->player(robot.team, robot.number) : nullptr;
  if (!player) return;
  for (std::size_t i = 0; i < playerTable.size(); ++i) {
    out[i] = playerTable[i].read(world, *player);
  }
}

GameSlots::GameSlots(const telemetry::GroupInfo& match) {
  findSlots(match, game, slots);
}
PlayerSlots::PlayerSlots(const telemetry::GroupInfo& robot) {
  findSlots(robot, playerTable, slots);
}

std::optional<WorldState> gameFromRow(const GameSlots& slots, const telemetry::RowView& row) {
  if (!(slots.slots[0].readOr(row, 0.0) > 0.0)) return {};
  WorldState world;
  world.settings.referee.emplace();
  world.game.emplace();
  for (std::size_t i = 0; i < game.size(); ++i) {
    game[i].put(world, *world.game, slots.slots[i].readOr(row, 0.0));
  }
  return world;
}

void addPlayer(const PlayerSlots& slots, const telemetry::RowView& row,
               const sim::RobotIdentity& robot, WorldState& world) {
  world.robots.push_back(robot);
  sim::giveSlots(world.robots, *world.game);
  auto* player =
      const_cast<GamePlayer*>(std::as_const(*world.game).player(robot.team, robot.number));
  for (std::size_t i = 0; player && i < playerTable.size(); ++i) {
    playerTable[i].put(world, *player, slots.slots[i].readOr(row, 0.0));
  }
}

}  // namespace pitchboard::link

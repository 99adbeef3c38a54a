// SPDX-License-Identifier: GPL-3.0-or-later
#include "game_columns.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <simcore/rules/referee.h>
#include <telemetry/referee/gamecontroller_encoder.h>

namespace pitchboard::link {
namespace {

using sim::RefereeRules;
using telemetry::ColumnKind;

constexpr const char* category = "Referee";

/// Of a game that counts seconds.
int ticksOf(double seconds) {
  return static_cast<int>(std::lround(std::clamp(seconds, -1e5, 1e5)));
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
  double (*read)(const RefereeRules& rules, const Game& game);
  void (*put)(RefereeRules& rules, Game& game, double value);
  ColumnKind kind = ColumnKind::Number;
};

constexpr double byItself = 1, byHand = 2;

const std::array<GameColumn, gameColumnCount> game{{
    {"REFEREE", "",
     [](const RefereeRules& r, const Game&) { return r.automatic ? byItself : byHand; },
     [](RefereeRules& r, Game&, double v) { r.automatic = v == byItself; },
     ColumnKind::Enumeration},
    {"REFEREE_VERSION", "",
     [](const RefereeRules& r, const Game&) { return double(r.packetVersion); },
     [](RefereeRules& r, Game& g, double v) {
       r.packetVersion = whole(v, 0, 255);
       const int size = telemetry::refereePacketSize(r.packetVersion).value_or(0);
       g.league = telemetry::refereeLeague(r.packetVersion, size).value_or(League::Humanoid);
     }},
    {"GAME_STATE", "", [](const RefereeRules&, const Game& g) { return double(g.state); },
     [](RefereeRules&, Game& g, double v) { g.state = oneOf<PlayState>(v); },
     ColumnKind::Enumeration},
    {"GAME_PHASE", "", [](const RefereeRules&, const Game& g) { return double(g.phase); },
     [](RefereeRules&, Game& g, double v) { g.phase = oneOf<GamePhase>(v); },
     ColumnKind::Enumeration},
    {"HALF", "", [](const RefereeRules&, const Game& g) { return double(g.half); },
     [](RefereeRules&, Game& g, double v) { g.half = whole(v, 1, 100); }},
    {"SECONDS_LEFT", "s",
     [](const RefereeRules&, const Game& g) { return double(g.secondsLeft()); },
     [](RefereeRules&, Game& g, double v) { g.clock = ticksOf(v); }},
    {"COUNTDOWN", "s",
     [](const RefereeRules&, const Game& g) { return double(g.seconds(g.countdown.ticks)); },
     [](RefereeRules&, Game& g, double v) { g.countdown.ticks = ticksOf(v); }},
    {"PLAY_STOPPED", "", [](const RefereeRules&, const Game& g) { return double(g.stopped); },
     [](RefereeRules&, Game& g, double v) { g.stopped = v != 0.0; }, ColumnKind::Flag},
    {"SET_PLAY", "", [](const RefereeRules&, const Game& g) { return double(g.setPlay()); },
     [](RefereeRules&, Game& g, double v) { g.restart.kind = oneOf<SetPlay>(v); },
     ColumnKind::Enumeration},
    {"SET_PLAY_STEP", "", [](const RefereeRules&, const Game& g) { return double(g.restart.step); },
     [](RefereeRules&, Game& g, double v) {
       using Step = Restart::Step;
       // Until 0.9 the time of a kick-off or of an executed set play had no step.
       const bool alone = g.state == PlayState::Playing && g.countdown.ticks > 0;
       g.restart.step = v == 0.0 && alone ? Step::Executed : oneOf<Step>(v);
     }},
    {"SET_PLAY_TEAM", "",
     [](const RefereeRules&, const Game& g) { return double(g.setPlayTeam()); },
     [](RefereeRules&, Game& g, double v) { g.restart.team = whole(v, -1, 1); }},
    {"KICK_OFF_TEAM", "", [](const RefereeRules&, const Game& g) { return double(g.kickOff); },
     [](RefereeRules&, Game& g, double v) { g.kickOff = whole(v, -1, 1); }},
    {"LEFT_TEAM", "", [](const RefereeRules&, const Game& g) { return double(g.leftTeam()); },
     [](RefereeRules&, Game& g, double v) { g.swapped = v != 0.0; }},
    {"TEAM1_NUMBER", "",
     [](const RefereeRules&, const Game& g) { return double(g.teams[0].number); },
     [](RefereeRules&, Game& g, double v) { g.teams[0].number = whole(v, 0, 255); }},
    {"TEAM2_NUMBER", "",
     [](const RefereeRules&, const Game& g) { return double(g.teams[1].number); },
     [](RefereeRules&, Game& g, double v) { g.teams[1].number = whole(v, 0, 255); }},
    {"TEAM1_COLOUR", "",
     [](const RefereeRules&, const Game& g) { return double(g.teams[0].colour); },
     [](RefereeRules&, Game& g, double v) {
       g.teams[0].colour = static_cast<TeamColor>(whole(v, 0, teamColors.size() - 1));
     }},
    {"TEAM2_COLOUR", "",
     [](const RefereeRules&, const Game& g) { return double(g.teams[1].colour); },
     [](RefereeRules&, Game& g, double v) {
       g.teams[1].colour = static_cast<TeamColor>(whole(v, 0, teamColors.size() - 1));
     }},
}};

struct PlayerColumn {
  const char *name, *unit;
  double (*read)(const Game& game, const GamePlayer& player);
  void (*put)(GamePlayer& player, double value);
  ColumnKind kind = ColumnKind::Number;
};

const std::array<PlayerColumn, playerColumnCount> playerTable{{
    {"PENALTY", "", [](const Game&, const GamePlayer& p) { return double(p.penalty); },
     [](GamePlayer& p, double v) { p.penalty = oneOf<PenaltyKind>(v); }, ColumnKind::Enumeration},
    {"PENALTY_LEFT", "s",
     [](const Game& g, const GamePlayer& p) { return double(g.seconds(p.ticksLeft)); },
     [](GamePlayer& p, double v) { p.ticksLeft = ticksOf(v); }},
    {"PENALTY_WAITS", "",
     [](const Game&, const GamePlayer& p) {
       return double(p.penalty != PenaltyKind::None && !p.counting);
     },
     [](GamePlayer& p, double v) { p.counting = v == 0.0; }, ColumnKind::Flag},
    {"WARNINGS", "", [](const Game&, const GamePlayer& p) { return double(p.warnings); },
     [](GamePlayer& p, double v) { p.warnings = whole(v, 0, 1000); }},
    {"YELLOW_CARDS", "", [](const Game&, const GamePlayer& p) { return double(p.yellow); },
     [](GamePlayer& p, double v) { p.yellow = whole(v, 0, 1000); }},
    {"RED_CARDS", "", [](const Game&, const GamePlayer& p) { return double(p.red); },
     [](GamePlayer& p, double v) { p.red = whole(v, 0, 1000); }},
    {"CAUTIONS", "", [](const Game&, const GamePlayer& p) { return double(p.cautions); },
     [](GamePlayer& p, double v) { p.cautions = whole(v, 0, 1000); }},
    {"GOALKEEPER", "", [](const Game&, const GamePlayer& p) { return double(p.goalkeeper); },
     [](GamePlayer& p, double v) { p.goalkeeper = v != 0.0; }, ColumnKind::Flag},
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
    if (name == "GAME_STATE") out.back().labels = labelsOf<PlayState>();
    if (name == "GAME_PHASE") out.back().labels = labelsOf<GamePhase>();
    if (name == "SET_PLAY") out.back().labels = labelsOf<SetPlay>();
  }
  return out;
}

void readGame(const sim::WorldState& world, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  if (!world.game) return;
  for (std::size_t i = 0; i < game.size(); ++i) {
    out[i] = game[i].read(*world.settings.referee, *world.game);
  }
}

std::vector<telemetry::ColumnInfo> playerColumns() {
  std::vector<telemetry::ColumnInfo> out;
  for (const PlayerColumn& column : playerTable) {
    out.push_back(infoOf(column));
    if (column.kind == ColumnKind::Enumeration) out.back().labels = labelsOf<PenaltyKind>();
  }
  return out;
}

void readPlayer(const sim::WorldState& world, const sim::RobotIdentity& robot,
                std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  const GamePlayer* player = world.game ? world.game->player(robot.team, robot.number) : nullptr;
  if (!player) return;
  for (std::size_t i = 0; i < playerTable.size(); ++i) {
    out[i] = playerTable[i].read(*world.game, *player);
  }
}

GameSlots::GameSlots(const telemetry::GroupInfo& match) {
  findSlots(match, game, slots);
}
PlayerSlots::PlayerSlots(const telemetry::GroupInfo& robot) {
  findSlots(robot, playerTable, slots);
}

std::optional<RecordedGame> gameFromRow(const GameSlots& slots, const telemetry::RowView& row) {
  if (!(slots.slots[0].readOr(row, 0.0) > 0.0)) return {};
  RecordedGame out;
  for (std::size_t i = 0; i < game.size(); ++i) {
    game[i].put(out.rules, out.game, slots.slots[i].readOr(row, 0.0));
  }
  return out;
}

void addPlayer(const PlayerSlots& slots, const telemetry::RowView& row,
               std::span<const sim::RobotIdentity> robots, Game& game) {
  const sim::RobotIdentity& robot = robots.back();
  const int team = game.teamOf(robot.team);
  if (team < 0) return;
  GameTeam& own = game.teams[static_cast<std::size_t>(team)];
  sim::giveSlots(robots, game);
  const int slot = own.slotOf(robot.number);
  for (std::size_t i = 0; slot > 0 && i < playerTable.size(); ++i) {
    playerTable[i].put(own.players[static_cast<std::size_t>(slot - 1)],
                       slots.slots[i].readOr(row, 0.0));
  }
}

}  // namespace pitchboard::link

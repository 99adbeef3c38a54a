// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <simcore/world/parameters.h>

#include "game_json.h"
#include "game_names.h"

namespace pitchboard::link {
namespace {

using sim::GameStart;

constexpr NumberRange gameTime{0, 1e5, "seconds"};
constexpr NumberRange gameTimeBelowZero{-1e5, 1e5, "seconds"};
constexpr int maxOfTeam = 1000;      // shots, timeouts, removals
constexpr int maxGameGoals = 99999;  // of a team
constexpr int maxCards = 100;
constexpr int maxShots = 16;         // those that have a bit
constexpr double beyondWalls = 1.0;  // m, where a ball may have been
constexpr std::size_t maxRobotNameLength = 8;

std::vector<std::string_view> viewsOf(const std::vector<std::string>& texts) {
  return {texts.begin(), texts.end()};
}

class GameReader {
 public:
  GameReader(JsonReport& report, const Scenario& scenario)
      : m_report(report), m_scenario(scenario) {
    for (const TeamColorInfo& color : teamColors) m_teams.push_back(color.name);
  }

  void readGame(const JsonNode& node) {
    const JsonObject game(
        m_report, node, "game",
        {"state",     "phase",      "phase_before",   "half",           "clock",
         "clock_use", "state_time", "countdown",      "countdown_runs", "hidden",
         "break",     "left",       "first_kick_off", "kick_off",       "score",
         "by_half",   "timeouts",   "removals",       "set_play",       "shoot_out",
         "drop_in",   "touch",      "ball_still",     "ball_near",      "ball_alone",
         "stopped",   "over"});
    choose(game, "state", keysOf<PlayState>(), "game state", m_out.state);
    choose(game, "phase", keysOf<GamePhase>(), "game phase", m_out.phase);
    choose(game, "phase_before", keysOf<GamePhase>(), "game phase", m_out.phaseBefore);
    m_out.half = game.integer("half", 1, 1, 2);
    m_out.clock = time(game, "clock", gameTimeBelowZero);
    if (const auto use = game.choice("clock_use", clockUseKeys, "clock use")) {
      m_out.clockUse = static_cast<ClockUse>(*use);
    }
    m_out.stateTime = time(game, "state_time");
    m_out.countdown = time(game, "countdown", gameTimeBelowZero);
    m_out.countdownRuns = flag(game, "countdown_runs");
    m_out.hidden = time(game, "hidden");
    m_out.breakLeft = time(game, "break");
    m_out.left = team(game, "left");
    m_out.firstKickOff = team(game, "first_kick_off");
    if (const JsonNode* given = game.find("kick_off")) {
      m_out.kickOff = GameStart::KickOff{};
      if (given->kind != JsonNode::Kind::Null) m_out.kickOff->team = team(game, "kick_off");
    }
    eachTeam(game, "score", [](const JsonObject& of, std::string_view key, GameStart::Team& out) {
      out.score = of.integer(key, 0, 0, maxGameGoals);
    });
    eachTeam(game, "by_half", readByHalf);
    eachTeam(game, "timeouts",
             [](const JsonObject& of, std::string_view key, GameStart::Team& out) {
               out.timeouts = of.integer(key, 0, 0, maxOfTeam);
             });
    eachTeam(game, "removals",
             [](const JsonObject& of, std::string_view key, GameStart::Team& out) {
               out.removals = of.integer(key, 0, 0, maxOfTeam);
             });
    readSetPlay(game);
    readShootOut(game);
    if (const JsonNode* given = game.find("drop_in")) {
      const JsonObject object(m_report, *given, game.pathOf("drop_in"), {"team", "ago"});
      object.require("team");
      m_out.dropIn = GameStart::DropIn{team(object, "team").value_or(TeamColor::Blue),
                                       object.number("ago", 0.0, gameTime)};
    }
    if (const JsonNode* given = game.find("touch")) {
      const JsonObject object(m_report, *given, game.pathOf("touch"), {"robot", "ago"});
      object.require("robot");
      m_out.touch = GameStart::Touch{robot(object, "robot"), object.number("ago", 0.0, gameTime)};
    }
    m_out.ballStill = rest(game, "ball_still");
    m_out.ballNear = rest(game, "ball_near");
    m_out.ballAlone = game.number("ball_alone", 0.0, gameTime);
    m_out.stopped = game.boolean("stopped", false);
    m_out.over = game.boolean("over", false);
  }

  /// What a robot's object says.
  void readRobot(const JsonObject& object, RobotId id) {
    GameStart::Robot out;
    if (const JsonNode* given = object.find("penalty")) {
      const JsonObject penalty(m_report, *given, object.pathOf("penalty"),
                               {"kind", "left", "since", "outside", "counts"});
      penalty.require("kind");
      choose(penalty, "kind", penaltyKeys(), "penalty", out.penalty);
      out.left = time(penalty, "left");
      out.since = penalty.number("since", 0.0, gameTime);
      out.outside = penalty.boolean("outside", false);
      out.counts = flag(penalty, "counts");
    }
    if (const JsonNode* given = object.find("cards")) {
      const JsonObject cards(m_report, *given, object.pathOf("cards"),
                             {"warnings", "yellow", "red", "cautions"});
      out.warnings = cards.integer("warnings", 0, 0, maxCards);
      out.yellow = cards.integer("yellow", 0, 0, maxCards);
      out.red = cards.integer("red", 0, 0, maxCards);
      out.cautions = cards.integer("cautions", 0, 0, maxCards);
    }
    out.goalkeeper = flag(object, "goalkeeper");
    if (out != GameStart::Robot{}) m_out.robots[id] = out;
  }

  GameStart take() { return std::move(m_out); }

 private:
  template <class Enum>
  void choose(const JsonObject& object, std::string_view key, const std::vector<std::string>& known,
              std::string_view what, Enum& out) {
    if (const auto chosen = object.choice(key, viewsOf(known), what)) {
      out = static_cast<Enum>(*chosen);
    }
  }
  static std::optional<double> time(const JsonObject& object, std::string_view key,
                                    const NumberRange& range = gameTime) {
    if (!object.find(key)) return {};
    return object.number(key, 0.0, range);
  }
  static std::optional<bool> flag(const JsonObject& object, std::string_view key) {
    if (!object.find(key)) return {};
    return object.boolean(key, false);
  }
  std::optional<TeamColor> team(const JsonObject& object, std::string_view key) const {
    const auto chosen = object.choice(key, m_teams, "team");
    if (!chosen) return {};
    return teamColors[*chosen].color;
  }
  RobotId robot(const JsonObject& object, std::string_view key) const {
    const std::string name = object.text(key, "", maxRobotNameLength);
    const auto index = m_scenario.robotNamed(name);
    if (index) return m_scenario.robots[*index].identity.id;
    object.fail(key, index.error().message);
    return {};
  }
  template <class Read>
  void eachTeam(const JsonObject& parent, std::string_view key, Read&& read) {
    const JsonNode* node = parent.find(key);
    if (!node || m_report.failed()) return;
    const JsonObject object(m_report, *node, parent.pathOf(key), m_teams);
    if (m_report.failed()) return;
    for (const TeamColorInfo& color : teamColors) {
      if (object.find(color.name)) read(object, color.name, m_out.teams[color.color]);
    }
  }
  static void readByHalf(const JsonObject& of, std::string_view key, GameStart::Team& out) {
    auto& goals = out.byHalf.emplace();
    const auto* items = of.array(key, goals.size());
    for (std::size_t i = 0; items && i < items->size(); ++i) {
      const auto& whole = (*items)[i].whole;
      if (!whole || *whole > maxGameGoals) {
        of.fail(key, "must be a list of goals: of the first half, of the second, of extra time");
        return;
      }
      goals[i] = static_cast<int>(*whole);
    }
  }
  std::optional<GameStart::Rest> rest(const JsonObject& game, std::string_view key) {
    const JsonNode* node = game.find(key);
    if (!node) return {};
    const JsonObject object(m_report, *node, game.pathOf(key), {"x", "y", "time"});
    GameStart::Rest out;
    out.place = place(object);
    out.time = object.number("time", 0.0, gameTimeBelowZero);
    return out;
  }
  std::optional<Point> place(const JsonObject& object) const {
    if (!object.find("x") && !object.find("y")) return {};
    object.require("x");
    object.require("y");
    const sim::FieldSpec& field = m_scenario.settings.field;
    const double x = field.halfLength() + field.border + beyondWalls;
    const double y = field.halfWidth() + field.border + beyondWalls;
    return Point{object.number("x", 0.0, {-x, x, sim::units::metres.name}),
                 object.number("y", 0.0, {-y, y, sim::units::metres.name})};
  }
  void readSetPlay(const JsonObject& game) {
    const JsonNode* node = game.find("set_play");
    if (!node) return;
    const JsonObject object(m_report, *node, game.pathOf("set_play"),
                            {"kind", "team", "step", "x", "y", "kicker", "passed", "only_taker"});
    object.require("kind");
    m_out.setPlay = GameStart::Taking{};
    GameStart::Taking& out = *m_out.setPlay;
    choose(object, "kind", setPlayKeys(), "set play", out.kind);
    out.team = team(object, "team");
    if (const auto step = object.choice("step", stepKeys, "step of a set play")) {
      out.step = static_cast<Restart::Step>(*step);
    }
    out.place = place(object);
    if (object.find("kicker")) out.kicker = robot(object, "kicker");
    out.passed = object.boolean("passed", false);
    out.onlyTaker = object.boolean("only_taker", false);
  }
  void readShootOut(const JsonObject& game) {
    const JsonNode* node = game.find("shoot_out");
    if (!node) return;
    const JsonObject object(m_report, *node, game.pathOf("shoot_out"),
                            {"shooter", "shots", "scored"});
    m_out.shooter = team(object, "shooter");
    eachTeam(object, "shots", [](const JsonObject& of, std::string_view key, GameStart::Team& out) {
      out.shots = of.integer(key, 0, 0, maxOfTeam);
    });
    eachTeam(object, "scored",
             [](const JsonObject& of, std::string_view key, GameStart::Team& out) {
               const auto* items = of.array(key, maxShots);
               for (std::size_t i = 0; items && i < items->size(); ++i) {
                 const auto& whole = (*items)[i].whole;
                 if (!whole || *whole < 1 || *whole > maxShots) {
                   of.fail(key, "must be a list of the shots that scored, counted from 1");
                   return;
                 }
                 out.scored |= 1 << (*whole - 1);
               }
             });
  }

  JsonReport& m_report;
  const Scenario& m_scenario;
  std::vector<std::string_view> m_teams;
  GameStart m_out;
};

}  // namespace

std::optional<sim::GameStart> readGameStart(JsonReport& report, const JsonObject& root,
                                            const std::vector<JsonObject>& robots,
                                            const Scenario& scenario) {
  const JsonNode* node = root.find("game");
  bool isGiven = node != nullptr;
  for (const JsonObject& robot : robots) {
    for (const std::string_view key : robotGameKeys) isGiven = isGiven || robot.find(key);
  }
  if (!isGiven || report.failed()) return {};
  if (!scenario.settings.referee) {
    root.fail("game",
              "a game, penalties and cards need a referee: set \"referee\", for example to "
              "\"humanoid-2021\"");
    return {};
  }
  for (const std::string_view key : {"score", "clock"}) {
    if (node && root.find(key)) {
      root.fail(key, "belongs inside \"game\" if there is one; move it there");
    }
  }
  GameReader reader(report, scenario);
  if (node) reader.readGame(*node);
  for (std::size_t i = 0; i < robots.size() && i < scenario.robots.size(); ++i) {
    reader.readRobot(robots[i], scenario.robots[i].identity.id);
  }
  return reader.take();
}

}  // namespace pitchboard::link

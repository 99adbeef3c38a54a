// SPDX-License-Identifier: GPL-3.0-or-later
// What only a tournament's file has: teams, who plays whom, and what must hold of a team.
#include <algorithm>
#include <charconv>
#include <filesystem>

#include <simcore/world/limits.h>

#include "experiment_reader.h"

namespace pitchboard::link {
namespace {

constexpr std::size_t maxTeams = 128, maxPairings = 4000, maxTeamAssertions = 1000;
constexpr std::size_t maxRuntimeTextLength = 4096, maxTournamentTeamLength = 64;
constexpr int maxMatches = 1'000'000;

/// A file beside the tournament's own, as a name that leads to it from here.
std::string besideFile(const std::string& path, const std::string& folder) {
  if (folder.empty() || path.empty() || path.front() == '/') return path;
  if (path.find_first_of("/.") == std::string::npos) return path;  // a built-in one
  return (std::filesystem::path(folder) / path).string();
}

}  // namespace

void ExperimentReader::readTournament(Experiment& e) {
  Tournament& tournament = e.tournament.emplace();
  m_root.require("matches");
  tournament.swapSides = m_root.boolean("swap_sides", true);
  m_matches = static_cast<std::size_t>(m_root.integer("matches", 2, 1, maxMatches));
  e.success = "goals > goals_against";
  const auto* teams = m_root.array("teams", maxTeams);
  for (std::size_t i = 0; teams && i < teams->size() && !m_report.failed(); ++i) {
    readTeam((*teams)[i], i, tournament);
  }
  if (!m_report.failed() && tournament.teams.size() < 2) {
    m_root.fail("teams", "must be a list of two teams or more");
  }
  if (!m_report.failed()) readPairings(tournament);
  if (!m_report.failed()) readTeamAssertions(tournament);
}

void ExperimentReader::readTeam(const JsonNode& node, std::size_t index, Tournament& tournament) {
  const JsonObject object(m_report, node, m_root.pathOf("teams", index),
                          {"name", "number", "runtime", "advisor", "robots"});
  object.require("name");
  TournamentTeam team;
  team.line = node.line;
  team.name = object.text("name", "", maxTournamentTeamLength);
  if (!m_report.failed() && team.name.empty()) object.fail("name", "is empty");
  team.number = object.integer("number", 0, 0, 255);
  for (const TournamentTeam& other : tournament.teams) {
    if (other.name == team.name) object.fail("name", "another team has this name");
    if (team.number != 0 && other.number == team.number) {
      object.fail("number", "is also the number of " + other.name);
    }
  }
  if (object.find("runtime") && !m_report.failed()) {
    auto choice = runtimeChoiceFromText(object.text("runtime", "", maxRuntimeTextLength));
    if (!choice) return object.fail("runtime", choice.error().message);
    choice->profile = besideFile(choice->profile, m_folder);
    choice->decision = besideFile(choice->decision, m_folder);
    if (const auto profile = loadRuntime(*choice); !profile) {
      return object.fail("runtime", profile.error().text());
    }
    team.runtime = runtimeChoiceToText(*choice);
  }
  if (const JsonNode* advisor = object.find("advisor")) team.advisor = jsonOf(*advisor).dump();
  const JsonNode* robots = object.find("robots");
  const std::string path = object.pathOf("robots");
  if (!robots || m_report.failed()) return tournament.teams.push_back(std::move(team));
  const JsonObject shirts(m_report, *robots, path);
  for (const auto& [who, settings] : shirts.members()) {
    int shirt = 0;
    const char* const end = who.data() + who.size();
    const auto read = std::from_chars(who.data(), end, shirt);
    const bool isShirt =
        read.ec == std::errc() && read.ptr == end && shirt >= 1 && shirt <= sim::highestShirtNumber;
    if (who != "*" && !isShirt) {
      return m_report.fail(settings.line, path + '.' + who,
                           "must be the number on a shirt, or * for all robots of the team");
    }
    for (ScenarioSetting& setting : settingsOf(settings, path + '.' + who)) {
      const std::string key = setting.key.substr(0, setting.key.find('.'));
      if (key != "behaviour" && key != "model" && key != "runtime") {
        return m_report.fail(setting.line, path + '.' + who + '.' + setting.key,
                             "a team's robots have a behaviour, a model and a runtime");
      }
      team.robots.push_back({who == "*" ? 0 : shirt, std::move(setting)});
    }
  }
  tournament.teams.push_back(std::move(team));
}

std::optional<std::size_t> ExperimentReader::teamNamed(const JsonObject& object,
                                                       std::string_view key,
                                                       const Tournament& tournament) const {
  std::vector<std::string_view> names;
  for (const TournamentTeam& team : tournament.teams) names.push_back(team.name);
  return object.choice(key, names, "team");
}

/// Everybody against everybody, or the pairs of names that the file lists.
void ExperimentReader::readPairings(Tournament& tournament) {
  const JsonNode* node = m_root.find("pairs");
  if (!node || (node->kind == JsonNode::Kind::Text && node->text == "all")) {
    for (std::size_t i = 0; i < tournament.teams.size(); ++i) {
      for (std::size_t j = i + 1; j < tournament.teams.size(); ++j) {
        tournament.pairings.push_back({i, j});
      }
    }
    return;
  }
  if (node->kind != JsonNode::Kind::Array) {
    return m_root.fail("pairs", "must be \"all\" or a list of pairs of names");
  }
  const auto* items = m_root.array("pairs", maxPairings);
  const auto& teams = tournament.teams;
  for (std::size_t i = 0; items && i < items->size(); ++i) {
    const JsonNode& item = (*items)[i];
    std::vector<std::size_t> both;
    for (const JsonNode& name : item.items) {
      const auto team = std::ranges::find(teams, name.text, &TournamentTeam::name);
      if (name.kind != JsonNode::Kind::Text || team == teams.end()) {
        std::vector<std::string_view> names;
        for (const TournamentTeam& one : teams) names.push_back(one.name);
        return m_report.fail(name.line, m_root.pathOf("pairs", i),
                             unknownName("team", name.text, names));
      }
      both.push_back(static_cast<std::size_t>(team - teams.begin()));
    }
    if (both.size() != 2 || both[0] == both[1]) {
      return m_report.fail(item.line, m_root.pathOf("pairs", i),
                           "must be the names of two teams, in brackets");
    }
    for (const Pairing& other : tournament.pairings) {
      if (std::minmax(other.first, other.second) == std::minmax(both[0], both[1])) {
        return m_report.fail(item.line, m_root.pathOf("pairs", i),
                             "is listed twice; use more matches instead");
      }
    }
    tournament.pairings.push_back({both[0], both[1]});
  }
  if (tournament.pairings.empty()) m_root.fail("pairs", "is empty");
}

void ExperimentReader::readTeamAssertions(Tournament& tournament) {
  const auto* items = m_root.array("assertions", maxTeamAssertions);
  for (std::size_t i = 0; items && i < items->size() && !m_report.failed(); ++i) {
    const JsonNode& item = (*items)[i];
    TeamAssertion assertion{{}, 0, {}, item.line};
    if (item.kind == JsonNode::Kind::Text) {
      assertion.text = item.text;
    } else {
      const JsonObject object(m_report, item, m_root.pathOf("assertions", i),
                              {"check", "team", "opponent"});
      object.require("check");
      assertion.text = object.text("check", "", 500);
      assertion.team = teamNamed(object, "team", tournament).value_or(0);
      assertion.opponent = teamNamed(object, "opponent", tournament);
      const auto plays = [&](const Pairing& one) {
        const std::size_t us = assertion.team, them = assertion.opponent.value_or(us);
        return std::minmax(one.first, one.second) == std::minmax(us, them);
      };
      if (assertion.opponent && !m_report.failed() &&
          std::ranges::none_of(tournament.pairings, plays)) {
        object.fail("opponent", "these two teams do not play each other");
      }
    }
    tournament.assertions.push_back(std::move(assertion));
  }
}

}  // namespace pitchboard::link

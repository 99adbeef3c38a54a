// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/learn/learning.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include <base/lined_json.h>
#include <base/read_file.h>
#include <base/short_name.h>
#include <base/try.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <robotlink/experiment/experiment_summary.h>

namespace pitchboard::link {
namespace {

using LearnJson = nlohmann::ordered_json;

constexpr std::size_t maxLearnBytes = mebibyte;
constexpr std::size_t maxPopulation = 100;
constexpr int maxMatches = 100'000, maxGenerations = 10'000;
/// Range of a number for which the file gives none, as factors of its start.
constexpr double defaultRange = 3.0;

/// Keys that a tournament has, too, and that mean the same there.
constexpr std::array<std::string_view, 10> tournamentKeys{"scenario",  "set",  "random",  "starts",
                                                          "placed",    "stop", "metrics", "sample",
                                                          "processes", "speed"};

double sixDigits(double value) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  double out = value;
  std::from_chars(text.data(), end.ptr, out);
  return out;
}

const BehaviourParameter* findParameter(std::string_view key) {
  const auto found = std::ranges::find_if(
      behaviourParameters, [&](const BehaviourParameter& one) { return key == one.key; });
  return found == behaviourParameters.end() ? nullptr : &*found;
}

/// A tournament of our team against the others.
LearnJson tournamentOf(const LearnJson& file, const LearnJson& opponents) {
  LearnJson out{{"version", 1}, {"name", file["name"]}, {"matches", 2}, {"paths", 0}};
  for (const std::string_view key : tournamentKeys) {
    if (file.contains(key)) out[key] = file[key];
  }
  out["swap_sides"] = file.value("swap_sides", true);
  LearnJson team = file.value("team", LearnJson::object());
  team["name"] = file["name"];
  out["teams"] = LearnJson::array({team});
  for (const LearnJson& opponent : opponents) out["teams"].push_back(opponent);
  return out;
}

/// The team's robots take these numbers where the file gives them none.
LearnJson withNumbers(LearnJson team, const Learning& learning, const Candidate& candidate) {
  LearnJson numbers = LearnJson::object();
  for (std::size_t i = 0; i < learning.parameters.size(); ++i) {
    numbers[learning.parameters[i].key] = candidate.values[i];
  }
  team["name"] = candidate.name;
  // First those of all robots, because a later setting wins.
  LearnJson robots = LearnJson::object();
  const LearnJson given = team.value("robots", LearnJson::object());
  robots["*"] = given.value("*", LearnJson::object());
  for (const auto& [who, settings] : given.items()) robots[who] = settings;
  for (auto& [who, settings] : robots.items()) settings["behaviour.from"] = numbers;
  team["robots"] = robots;
  return team;
}

class LearnReader {
 public:
  LearnReader(const JsonNode& root, JsonReport& report, std::string_view text,
              std::string_view source, const std::string& folder)
      : m_report(report),
        m_root(report, root, "", keys()),
        m_file(LearnJson::parse(text)),
        m_source(source),
        m_folder(folder) {}

  Learning read() {
    Learning out;
    for (const std::string_view key : {"version", "name", "scenario", "opponents"}) {
      m_root.require(key);
    }
    (void)m_root.integer("version", 1, 1, 1);
    out.name = readShortName(m_root, "name", out.name, 32);
    out.objective = m_root.text("objective", out.objective, 500);
    out.swapSides = m_root.boolean("swap_sides", true);
    out.matches = count(m_root, "matches", out.matches, 1, maxMatches);
    readSearch(out);
    if (!m_report.failed()) readTeams(out);
    if (!m_report.failed()) readParameters(out);
    if (!m_report.failed()) checkCounts(out);
    return out;
  }

 private:
  static std::span<const std::string_view> keys() {
    static const auto all = [] {
      std::vector<std::string_view> out{"version", "name",      "title",     "description",
                                        "team",    "start",     "opponents", "parameters",
                                        "ranges",  "search",    "choose",    "validate",
                                        "matches", "objective", "swap_sides"};
      out.insert(out.end(), tournamentKeys.begin(), tournamentKeys.end());
      return out;
    }();
    return all;
  }

  static std::size_t count(const JsonObject& object, std::string_view key, std::size_t fallback,
                           int least, int most) {
    return static_cast<std::size_t>(object.integer(key, static_cast<int>(fallback), least, most));
  }

  void readSearch(Learning& out) {
    if (const JsonNode* node = m_root.find("search")) {
      const JsonObject search(m_report, *node, "search",
                              {"population", "generations", "sigma", "seed"});
      out.population = count(search, "population", out.population, 5, maxPopulation);
      out.generations = count(search, "generations", out.generations, 1, maxGenerations);
      out.sigma = search.number("sigma", out.sigma, {0.001, 1.0, {}});
      out.seed = static_cast<std::uint32_t>(search.integer("seed", 1, 0, 1'000'000'000));
    }
    if (const JsonNode* node = m_root.find("choose")) {
      const JsonObject choose(m_report, *node, "choose", {"last", "best", "matches"});
      out.lastMeans = count(choose, "last", out.lastMeans, 1, 50);
      out.bestPoints = count(choose, "best", out.bestPoints, 0, 50);
      out.choosingMatches = count(choose, "matches", out.choosingMatches, 1, maxMatches);
    }
    if (const JsonNode* node = m_root.find("validate")) {
      const JsonObject validate(m_report, *node, "validate",
                                {"opponents", "matches", "assertions"});
      out.validationMatches = count(validate, "matches", out.validationMatches, 1, maxMatches);
    }
  }

  /// A tournament says what is wrong with teams, scenario and stop.
  std::optional<LearnJson> expanded(const LearnJson& tournament) {
    const auto made = experimentFromJson(tournament.dump(), m_source, m_folder);
    if (!made) {
      // What was read is a tournament, whose lines are not those of the file.
      std::string message = made.error().message;
      for (std::size_t i = tournament["teams"].size(); i-- > 0;) {
        const std::string ours = "teams[" + std::to_string(i) + "]";
        if (!message.starts_with(ours)) continue;
        message.replace(0, ours.size(),
                        i == 0 ? "team" : "opponents[" + std::to_string(i - 1) + "]");
      }
      m_report.fail(1, "", message);
      return {};
    }
    m_conditions = made->conditions;
    const ResultTable none(*made);
    if (const auto values = valuesOf(m_root.text("objective", Learning().objective, 500), none, 0);
        !values) {
      m_root.fail("objective", values.error().message);
      return {};
    }
    return LearnJson::parse(made->text);
  }

  void readTeams(Learning& out) {
    const JsonNode* opponents = m_root.find("opponents");
    if (opponents->kind != JsonNode::Kind::Array || opponents->items.empty()) {
      return m_root.fail("opponents", "must be a list of one team or more");
    }
    if (const JsonNode* team = m_root.find("team")) {
      (void)JsonObject(m_report, *team, "team", {"number", "runtime", "robots"});
      if (m_report.failed()) return;
    }
    LearnJson held = m_file["opponents"];
    LearnJson assertions = LearnJson::array();
    if (m_file.contains("validate")) {
      const LearnJson& validate = m_file["validate"];
      assertions = validate.value("assertions", assertions);
      if (validate.contains("opponents")) held = validationOpponents(validate["opponents"]);
    }
    if (m_report.failed()) return;
    LearnJson last = tournamentOf(m_file, held);
    last["assertions"] = assertions;
    last["matches"] = 2;
    const auto validation = expanded(last);
    const auto training =
        validation ? expanded(tournamentOf(m_file, m_file["opponents"])) : std::nullopt;
    if (!training) return;
    out.validation = validation->dump();
    out.training = training->dump();
    LearnJson whole = m_file;
    whole["scenario"] = (*training)["scenario"];
    out.text = whole.dump(2) + '\n';
  }

  /// Teams, or names of opponents of the training.
  LearnJson validationOpponents(const LearnJson& list) {
    LearnJson out = LearnJson::array();
    for (const LearnJson& one : list) {
      if (!one.is_string()) {
        out.push_back(one);
        continue;
      }
      const auto same = std::ranges::find_if(m_file["opponents"], [&](const LearnJson& other) {
        return other.is_object() && other.value("name", LearnJson()) == one;
      });
      if (same == m_file["opponents"].end()) {
        m_root.fail("validate", "there is no opponent " + one.dump());
        return out;
      }
      out.push_back(*same);
    }
    return out;
  }

  bool teamReads(const BehaviourParameter& parameter) const {
    const Condition& condition = m_conditions.front();
    return std::ranges::any_of(condition.scenario.robots, [&](const ScenarioRobot& robot) {
      return robot.identity.team == condition.team && parameter.isOf(robot.behaviour);
    });
  }

  void readParameters(Learning& out) {
    BehaviourParameters start;
    if (m_root.find("start")) {
      const auto loaded = loadBehaviourParameters(m_root.text("start", "", 4096));
      if (!loaded) return m_root.fail("start", loaded.error().text());
      start = *loaded;
    }
    const JsonNode* node = m_root.find("parameters");
    std::vector<std::string> chosen;
    if (!node || (node->kind == JsonNode::Kind::Text && node->text == "all")) {
      for (const BehaviourParameter& one : behaviourParameters) {
        // No range follows from a start of 0: those are peculiarities, such as aim_side.
        if (teamReads(one) && start.*one.member != 0.0) chosen.emplace_back(one.key);
      }
    } else {
      const auto* items = m_root.array("parameters", std::size(behaviourParameters));
      for (std::size_t i = 0; items && i < items->size(); ++i) chosen.push_back((*items)[i].text);
    }
    std::vector<std::string_view> known;
    for (const BehaviourParameter& one : behaviourParameters) known.emplace_back(one.key);
    for (const std::string& key : chosen) {
      const BehaviourParameter* row = findParameter(key);
      if (!row) return m_root.fail("parameters", unknownName("parameter", key, known));
      if (!teamReads(*row)) {
        return m_root.fail("parameters", "no robot of the team reads " + key);
      }
      if (std::ranges::count(chosen, key) > 1) {
        return m_root.fail("parameters", key + " is given twice");
      }
      const double usual = row->written(start.*row->member);
      out.parameters.push_back({key, row->unit.symbol, std::max(row->least, usual / defaultRange),
                                std::min(row->most, usual * defaultRange), usual});
    }
    if (out.parameters.empty()) {
      return m_root.fail("parameters", "the team's robots have no behaviour with numbers");
    }
    readRanges(out);
  }

  void readRanges(Learning& out) {
    std::vector<std::string_view> known;
    for (const LearnedParameter& one : out.parameters) known.emplace_back(one.key);
    if (const JsonNode* node = m_root.find("ranges")) {
      const JsonObject ranges(m_report, *node, "ranges", known);
      for (LearnedParameter& one : out.parameters) {
        const JsonNode* range = ranges.find(one.key);
        if (!range) continue;
        const BehaviourParameter& row = *findParameter(one.key);
        const JsonObject object(m_report, *range, "ranges." + one.key, {"from", "to"});
        const NumberRange allowed{row.least, row.most, row.unit.name};
        one.from = object.number("from", one.from, allowed);
        one.to = object.number("to", one.to, allowed);
      }
    }
    for (LearnedParameter& one : out.parameters) {
      one.from = sixDigits(one.from);
      one.to = sixDigits(one.to);
      one.start = sixDigits(one.start);
      if (one.from < one.to && one.start >= one.from && one.start <= one.to) continue;
      m_root.fail("ranges", one.key + " begins at " + shortest(one.start) +
                                ", which must lie between \"from\" (" + shortest(one.from) +
                                ") and \"to\" (" + shortest(one.to) + ")");
    }
  }

  void checkCounts(const Learning& out) {
    const std::size_t sides = out.swapSides ? 2 : 1;
    for (const std::size_t matches : {out.matches, out.choosingMatches, out.validationMatches}) {
      if (matches % sides != 0) {
        m_root.fail("matches",
                    "is " + std::to_string(matches) + ", but with swapped sides it must be even");
      }
    }
    if (out.generations * out.matches / sides > firstChoosingSeed - firstTrainingSeed) {
      m_root.fail("matches", "with so many generations there are not enough seeds");
    }
  }

  JsonReport& m_report;
  JsonObject m_root;
  LearnJson m_file;
  std::string m_source, m_folder;
  std::vector<Condition> m_conditions;  ///< of the training
};

}  // namespace

double LearnedParameter::at(double share) const {
  const double value = from > 0.0 ? from * std::pow(to / from, share) : std::lerp(from, to, share);
  return std::clamp(sixDigits(value), from, to);
}

double LearnedParameter::shareOf(double value) const {
  const double share =
      from > 0.0 ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
  return std::clamp(share, 0.0, 1.0);
}

Result<Learning> learningFromJson(std::string_view text, std::string_view source,
                                  const std::string& folder) {
  JsonReport report(source);
  const auto root = parseJson(text, report);
  if (!root) return tl::unexpected(report.error());
  if (root->kind != JsonNode::Kind::Object) {
    return failure(ErrorCode::ParseError, "is not a JSON object", std::string(source));
  }
  Learning out = LearnReader(*root, report, text, source, folder).read();
  if (report.failed()) return tl::unexpected(report.error());
  return out;
}

Result<Learning> loadLearning(const std::string& path) {
  const auto text = TRY(readFile(path, maxLearnBytes, "the file"));
  return learningFromJson(text, path, std::filesystem::path(path).parent_path().string());
}

Result<Experiment> trainingOf(const Learning& learning, const std::string& name,
                              std::span<const Candidate> candidates, std::size_t matches,
                              std::uint64_t seed) {
  LearnJson file = LearnJson::parse(learning.training);
  const LearnJson team = file["teams"][0];
  LearnJson teams = LearnJson::array(), pairs = LearnJson::array();
  for (const Candidate& one : candidates) teams.push_back(withNumbers(team, learning, one));
  for (const Candidate& one : candidates) {
    for (std::size_t i = 1; i < file["teams"].size(); ++i) {
      pairs.push_back({one.name, file["teams"][i]["name"]});
    }
  }
  for (std::size_t i = 1; i < file["teams"].size(); ++i) teams.push_back(file["teams"][i]);
  file["name"] = name;
  file["seed"] = seed;
  file["matches"] = matches;
  file["teams"] = std::move(teams);
  file["pairs"] = std::move(pairs);
  return experimentFromJson(file.dump(2), name);
}

Result<Experiment> validationOf(const Learning& learning, const Candidate& winner) {
  LearnJson file = LearnJson::parse(learning.validation);
  LearnJson pairs = LearnJson::array();
  for (std::size_t i = 1; i < file["teams"].size(); ++i) {
    pairs.push_back({winner.name, file["teams"][i]["name"]});
  }
  file["teams"][0] = withNumbers(file["teams"][0], learning, winner);
  file["seed"] = firstValidationSeed;
  file["matches"] = learning.validationMatches;
  file["pairs"] = std::move(pairs);
  return experimentFromJson(file.dump(2), learning.name);
}

}  // namespace pitchboard::link

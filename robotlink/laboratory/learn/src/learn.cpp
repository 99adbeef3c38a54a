// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/learn/learn.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include <base/file_target.h>
#include <base/read_file.h>
#include <base/try.h>
#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/experiment/junit_report.h>

namespace pitchboard::link {
namespace {

using JournalJson = nlohmann::ordered_json;

constexpr std::size_t maxJournalBytes = 256 * mebibyte;
constexpr std::size_t shortestFolderNumber = 3;
constexpr const char* learnFile = "learn.json";
constexpr auto lookAtOtherShards = std::chrono::seconds(1);

std::string numbered(const char* what, std::size_t number) {
  const std::string digits = std::to_string(number);
  return std::string(what) +
         std::string(
             digits.size() < shortestFolderNumber ? shortestFolderNumber - digits.size() : 0, '0') +
         digits;
}

std::string inLearnFolder(const LearnSettings& settings, const std::string& name) {
  return (std::filesystem::path(settings.folder) / name).string();
}

std::string shardName(const LearnSettings& s) {
  return std::to_string(s.shard) + "-of-" + std::to_string(s.shards);
}

/// What the search began with, and a line for each generation that is over. A shard has its own.
class Journal {
 public:
  static Result<Journal> open(const LearnSettings& s, const SearchSettings& search) {
    const std::string name = s.shards == 1 ? "journal.jsonl" : "journal-" + shardName(s) + ".jsonl";
    Journal out(inLearnFolder(s, name), JournalJson{{"version", 1},
                                                    {"search", searchLibrary()},
                                                    {"population", search.population},
                                                    {"sigma", search.sigma},
                                                    {"seed", search.seed},
                                                    {"start", search.start}}
                                                .dump() +
                                            '\n');
    std::error_code ignored;
    if (!std::filesystem::exists(out.m_path, ignored)) {
      TRY(writeFile(out.m_path, out.m_text, IfExists::Refuse));
      return out;
    }
    if (!s.resume) {
      return failure(
          ErrorCode::Conflict,
          "this folder holds a learning run; add --resume to continue it, --force to start "
          "over, or choose another folder",
          s.folder);
    }
    TRY(out.read());
    return out;
  }

  const std::vector<Generation>& generations() const { return m_generations; }

  Result<void> add(const Generation& one) {
    m_generations.push_back(one);
    m_text +=
        JournalJson{
            {"generation", m_generations.size()}, {"points", one.points}, {"values", one.values}}
            .dump() +
        '\n';
    return writeFile(m_path, m_text, IfExists::Replace);
  }

 private:
  Journal(std::string path, std::string head) : m_path(std::move(path)), m_text(std::move(head)) {}

  Result<void> read() {
    const auto text = TRY(readFile(m_path, maxJournalBytes, "the journal"));
    if (!text.starts_with(m_text)) {
      return failure(
          ErrorCode::Conflict,
          "this learning run was started by another version or with other settings; choose "
          "another folder",
          m_path);
    }
    for (std::size_t at = m_text.size(); at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const auto line = JournalJson::parse(text.substr(at, end - at), nullptr, false);
      Generation one;
      if (!line.is_object() || !readList(line, one)) {
        return failure(ErrorCode::ParseError,
                       "generation " + std::to_string(m_generations.size() + 1) +
                           " cannot be read; remove its line and those behind it",
                       m_path);
      }
      m_generations.push_back(std::move(one));
      at = end + 1;
    }
    m_text = text;
    return {};
  }

  static bool readNumbers(const JournalJson& list, std::vector<double>& out) {
    if (!list.is_array()) return false;
    for (const JournalJson& value : list) {
      if (!value.is_number()) return false;
      out.push_back(value.get<double>());
    }
    return true;
  }
  static bool readList(const JournalJson& line, Generation& out) {
    const JournalJson points = line.value("points", JournalJson());
    if (!points.is_array()) return false;
    for (const JournalJson& point : points) {
      if (!readNumbers(point, out.points.emplace_back())) return false;
    }
    return readNumbers(line.value("values", JournalJson()), out.values);
  }

  std::string m_path, m_text;
  std::vector<Generation> m_generations;
};

class Learner {
 public:
  Learner(const Learning& learning, const LearnSettings& settings)
      : m_learning(learning), m_settings(settings) {}

  Result<LearnedTeam> run() {
    TRY(begin());
    SearchSettings search{{}, m_learning.population, m_learning.sigma, m_learning.seed};
    for (const LearnedParameter& one : m_learning.parameters) {
      search.start.push_back(one.shareOf(one.start));
    }
    auto journal = TRY(Journal::open(m_settings, search));
    LearnedTeam out;
    TRY(searchBest(search, journal, out));
    const Candidate winner = TRY(choose(out));
    out.values = winner.values;
    out.validation = TRY(validationOf(m_learning, {m_learning.name, winner.values}));
    const auto table = TRY(play(out.validation, "validation", "validation"));
    out.summary = summarize(out.validation, table);
    if (m_settings.shard == 1) {
      TRY(write(out));
    }
    return out;
  }

 private:
  /// A folder belongs to one file.
  Result<void> begin() const {
    std::error_code code;
    std::filesystem::create_directories(m_settings.folder, code);
    if (code) {
      return failure(ErrorCode::SystemError, "cannot create the folder: " + code.message(),
                     m_settings.folder);
    }
    const std::string path = inLearnFolder(m_settings, learnFile);
    if (!std::filesystem::exists(path, code)) {
      return writeFile(path, m_learning.text, IfExists::Replace);
    }
    const auto text = TRY(readFile(path, maxJournalBytes, "the file"));
    if (text == m_learning.text) return {};
    return failure(
        ErrorCode::Conflict,
        "this folder holds the learning run of another file, or of this one before it was "
        "edited (its learn.json differs); add --force to start over, or choose another "
        "folder",
        m_settings.folder);
  }

  std::vector<double> valuesAt(const std::vector<double>& point) const {
    std::vector<double> out;
    for (std::size_t i = 0; i < point.size(); ++i) {
      out.push_back(m_learning.parameters[i].at(point[i]));
    }
    return out;
  }

  void showProgress(const std::string& text) const {
    if (m_settings.progress) m_settings.progress(text);
  }
  bool isCancelled() const { return m_settings.play.cancelled && *m_settings.play.cancelled; }

  /// Results of all shards, as far as they are there.
  Result<ResultTable> resultsIn(const std::string& folder, const Experiment& e) const {
    ResultTable table(e);
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
      if (entry.is_directory(ignored)) {
        TRY(addResults(table, entry.path().string(), e));
      }
    }
    return table;
  }

  static std::vector<std::size_t> missingIn(const ResultTable& table, const Experiment& e) {
    std::vector<std::size_t> out;
    for (std::size_t number = 1; number <= e.allRuns(); ++number) {
      const RunPlace place = placeOf(e, number);
      if (!table.conditions[place.condition].played[place.index]) out.push_back(number);
    }
    return out;
  }

  /// Plays what is this shard's, and waits for the others.
  Result<ResultTable> play(const Experiment& e, const std::string& name, const std::string& what) {
    const std::string folder = inLearnFolder(m_settings, name);
    const std::string all = " of " + std::to_string(e.allRuns()) + " matches";
    auto table = TRY(resultsIn(folder, e));
    std::vector<std::size_t> missing = missingIn(table, e);
    std::vector<std::size_t> mine;
    for (const std::size_t number : missing) {
      if ((number - 1) % m_settings.shards == m_settings.shard - 1) mine.push_back(number);
    }
    if (!mine.empty()) {
      auto into = TRY(ExperimentFolder::begin(
          (std::filesystem::path(folder) / shardName(m_settings)).string(), e, true));
      std::size_t done = 0;
      TRY(playRuns(
          e, mine, m_settings.jobs, m_settings.play, [&](const PlayedRun& one) -> Result<void> {
            ++done;
            showProgress(what + ": " + std::to_string(done + e.allRuns() - missing.size()) + all);
            return into.add(one.result, one.timesRealTime);
          }));
    }
    while (true) {
      table = TRY(resultsIn(folder, e));
      missing = missingIn(table, e);
      if (missing.empty()) return table;
      if (isCancelled()) {
        return failure(ErrorCode::Conflict, "interrupted in " + what + "; add --resume to continue",
                       m_settings.folder);
      }
      showProgress(what + ": waiting for " + std::to_string(missing.size()) + all +
                   " of other shards");
      std::this_thread::sleep_for(lookAtOtherShards);
    }
  }

  /// Of each candidate: the objective in every match, in the same order for all.
  Result<std::vector<std::vector<double>>> objectives(std::span<const Candidate> candidates,
                                                      const Experiment& e,
                                                      const ResultTable& table) const {
    const std::size_t conditions = e.conditions.size() / candidates.size();
    // Opponents among each other are not paired, so that all conditions are the candidates'.
    std::vector<std::vector<double>> out(candidates.size());
    for (std::size_t c = 0; c < e.conditions.size(); ++c) {
      const auto values = TRY(valuesOf(m_learning.objective, table, c));
      auto& of = out[c / conditions];
      of.insert(of.end(), values.begin(), values.end());
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (std::ranges::none_of(out[i], [](double value) { return std::isfinite(value); })) {
        return failure(
            ErrorCode::InvalidArgument,
            "\"" + m_learning.objective + "\" has no value in any match of " + candidates[i].name,
            "objective");
      }
    }
    return out;
  }

  Result<void> searchBest(const SearchSettings& settings, Journal& journal, LearnedTeam& out) {
    auto search = TRY(CmaSearch::create(settings));
    for (const Generation& one : journal.generations()) {
      TRY(search.replay(one));
      out.means.push_back(search.mean());
    }
    const std::size_t seeds = m_learning.matches / (m_learning.swapSides ? 2 : 1);
    while (search.generationsDone() < m_learning.generations) {
      const std::size_t number = search.generationsDone() + 1;
      Generation generation{TRY(search.ask()), {}};
      std::vector<Candidate> candidates;
      for (const auto& point : generation.points) {
        candidates.push_back({numbered("candidate-", candidates.size() + 1), valuesAt(point)});
      }
      const std::string name = numbered("generation-", number);
      const auto e = TRY(trainingOf(m_learning, name, candidates, m_learning.matches,
                                    firstTrainingSeed + (number - 1) * seeds));
      const auto table = TRY(play(e, name,
                                  "generation " + std::to_string(number) + " of " +
                                      std::to_string(m_learning.generations)));
      const auto matches = TRY(objectives(candidates, e, table));
      for (const auto& values : matches) {
        generation.values.push_back(momentsOf(values).mean);
      }
      TRY(search.tell(generation.values));
      out.means.push_back(search.mean());
      TRY(journal.add(generation));
    }
    out.generations = journal.generations();
    return {};
  }

  struct Racer {
    Candidate candidate;
    std::string from;
    std::vector<double> values;  ///< of all its matches
  };

  /// The start, the last means, and the points that were farthest above their generation.
  std::vector<Racer> racersOf(const LearnedTeam& team) const {
    std::vector<Racer> out;
    const auto add = [&](const std::vector<double>& values, const std::string& from) {
      const bool known = std::ranges::any_of(
          out, [&](const Racer& other) { return other.candidate.values == values; });
      if (!known) out.push_back({{numbered("candidate-", out.size() + 1), values}, from, {}});
    };
    std::vector<double> start;
    for (const LearnedParameter& one : m_learning.parameters) start.push_back(one.start);
    add(start, "the start");
    const std::size_t all = team.means.size();
    for (std::size_t i = all - std::min(all, m_learning.lastMeans); i < all; ++i) {
      add(valuesAt(team.means[i]), "the mean after generation " + std::to_string(i + 1));
    }
    struct Best {
      double above;
      std::size_t generation, point;
    };
    std::vector<Best> points;
    for (std::size_t g = 0; g < team.generations.size(); ++g) {
      const auto& values = team.generations[g].values;
      const double mean = momentsOf(values).mean;
      for (std::size_t p = 0; p < values.size(); ++p) points.push_back({values[p] - mean, g, p});
    }
    std::ranges::stable_sort(points, std::ranges::greater(), &Best::above);
    for (std::size_t i = 0; i < std::min(points.size(), m_learning.bestPoints); ++i) {
      const auto& [above, g, p] = points[i];
      add(valuesAt(team.generations[g].points[p]),
          "candidate " + std::to_string(p + 1) + " of generation " + std::to_string(g + 1));
    }
    return out;
  }

  /// Sequential halving: all play, the better half plays on, until one is left.
  Result<Candidate> choose(LearnedTeam& team) {
    std::vector<Racer> racers = racersOf(team);
    const auto rounds = static_cast<std::size_t>(
        std::ceil(std::log2(static_cast<double>(std::max<std::size_t>(racers.size(), 2)))));
    const std::size_t sides = m_learning.swapSides ? 2 : 1;
    const std::size_t seeds =
        std::max<std::size_t>(1, m_learning.choosingMatches / (rounds * sides));
    for (std::size_t round = 0; racers.size() > 1; ++round) {
      std::vector<Candidate> candidates;
      for (const Racer& one : racers) candidates.push_back(one.candidate);
      const std::string name = numbered("choice-", round + 1);
      const auto e = TRY(trainingOf(m_learning, name, candidates, seeds * sides,
                                    firstChoosingSeed + round * seeds));
      const auto table = TRY(play(
          e, name, "choice, round " + std::to_string(round + 1) + " of " + std::to_string(rounds)));
      const auto values = TRY(objectives(candidates, e, table));
      for (std::size_t i = 0; i < racers.size(); ++i) {
        racers[i].values.insert(racers[i].values.end(), values[i].begin(), values[i].end());
        if (racers[i].from == "the start") team.objectiveOfStart = momentsOf(racers[i].values).mean;
      }
      const auto mean = [](const Racer& one) { return momentsOf(one.values).mean; };
      std::ranges::stable_sort(racers, std::ranges::greater(), mean);
      racers.resize((racers.size() + 1) / 2);
      team.choosingMatches += seeds * sides;
    }
    team.from = racers.front().from;
    team.objective = momentsOf(racers.front().values).mean;
    return racers.front().candidate;
  }

  Result<void> write(const LearnedTeam& team) const {
    const std::pair<const char*, std::string> files[] = {
        {"curve.csv", curveCsv(m_learning, team)},
        {"best.json", bestJson(m_learning, team, m_settings.program)},
        {"report.html", learnReportHtml(m_learning, team, m_settings.program)},
        {"junit.xml", junitReport(team.validation, team.summary)}};
    for (const auto& [name, text] : files) {
      TRY(writeFile(inLearnFolder(m_settings, name), text, IfExists::Replace));
    }
    return {};
  }

  const Learning& m_learning;
  const LearnSettings& m_settings;
};

}  // namespace

Result<void> discardLearning(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code code;
  if (!fs::exists(fs::path(folder) / learnFile, code)) return {};
  std::vector<fs::path> files;
  for (const char* name : {"curve.csv", "best.json", "report.html", "junit.xml", learnFile}) {
    files.push_back(fs::path(folder) / name);
  }
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename();
    if (name.starts_with("journal") && name.ends_with(".jsonl")) {
      files.insert(files.begin(), entry.path());
    }
    if (!name.starts_with("generation-") && !name.starts_with("choice-") && name != "validation") {
      continue;
    }
    for (const auto& shard : fs::directory_iterator(entry.path(), code)) {
      TRY(discardResults(shard.path().string()));
      fs::remove(shard.path(), code);  // only if it is empty
    }
    fs::remove(entry.path(), code);
  }
  for (const fs::path& file : files) {
    if (!fs::remove(file, code) && code) {
      return failure(ErrorCode::SystemError, "cannot remove what was learned: " + code.message(),
                     file.string());
    }
  }
  return {};
}

Result<LearnedTeam> learn(const Learning& learning, const LearnSettings& settings) {
  return Learner(learning, settings).run();
}

}  // namespace pitchboard::link

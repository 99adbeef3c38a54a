// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/experiment/experiment_folder.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <type_traits>

#include <base/file_target.h>
#include <base/lined_json.h>
#include <base/read_file.h>
#include <base/system_reason.h>
#include <base/try.h>
#include <robotlink/experiment/junit_report.h>
#include <robotlink/experiment/run_player.h>

#include "experiment_files.h"
#include "result_line.h"

namespace pitchboard::link {
namespace {

constexpr std::size_t maxExperimentBytes = 4 * mebibyte;
constexpr std::size_t maxTimesBytes = 256 * mebibyte;
constexpr std::string_view timesHead = "run,times_real_time\n";

std::string inFolder(const std::string& folder, const char* file) {
  return (std::filesystem::path(folder) / file).string();
}

/// A line of runs.jsonl: the run, and where its bytes are.
struct LinePlace {
  std::size_t number = 0;
  std::uint64_t offset = 0, size = 0;  ///< with the line's end
};

/// Every whole line in turn. A last line without an end, of a program that was killed, is left
/// out. Returns where the whole lines end.
template <class Take>
Result<std::uint64_t> eachResult(const std::string& path, const Experiment& experiment,
                                 const Take& take) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return failure(ErrorCode::NotFound, "no results found; is this the folder of an experiment?",
                   path);
  }
  const std::size_t metrics = metricsOf(experiment).size();
  std::string line;
  std::uint64_t offset = 0;
  for (std::size_t lineNumber = 1; std::getline(file, line) && !file.eof(); ++lineNumber) {
    const auto result = resultFromLine(line, experiment, metrics);
    if (!result) {
      return failure(result.error().code, "this line " + result.error().message,
                     path + ':' + std::to_string(lineNumber));
    }
    const LinePlace place{result->number, offset, line.size() + 1};
    if constexpr (std::is_void_v<decltype(take(*result, place))>) {
      take(*result, place);
    } else {
      TRY(take(*result, place));
    }
    offset += place.size;
  }
  return offset;
}

Result<void> writeAll(const UniqueFd& into, std::string_view text, const std::string& path) {
  while (!text.empty()) {
    const ssize_t written = ::write(into.get(), text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      return failure(ErrorCode::SystemError, "cannot write: " + systemReason(errno), path);
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

/// Both texts are the same experiment; where they differ is for the user to see.
Result<void> sameExperiment(const std::string& folder, const Experiment& experiment,
                            const char* advice) {
  const auto text =
      TRY(readFile(inFolder(folder, experimentFile), maxExperimentBytes, "the experiment"));
  if (text == experiment.text) return {};
  return failure(ErrorCode::Conflict,
                 std::string("this folder holds results of another experiment or of the same one "
                             "before it was edited (its experiment.json differs); ") +
                     advice,
                 folder);
}

}  // namespace

ExperimentFolder::ExperimentFolder(std::string path, const Experiment& experiment)
    : m_path(std::move(path)), m_experiment(&experiment), m_finished(experiment.allRuns(), 0) {}

std::string ExperimentFolder::file(const char* name) const {
  return inFolder(m_path, name);
}

tl::unexpected<Error> ExperimentFolder::failed() const {
  return failure(ErrorCode::SystemError, "cannot write: " + systemReason(errno), file(runsFile));
}

Result<ExperimentFolder> ExperimentFolder::begin(const std::string& path,
                                                 const Experiment& experiment, bool resume) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (code) {
    return failure(ErrorCode::SystemError, "cannot create the folder: " + code.message(), path);
  }
  ExperimentFolder made(path, experiment);
  const std::string lines = made.file(runsFile);
  const bool exists = std::filesystem::exists(lines, code);
  if (exists && !resume) {
    return failure(
        ErrorCode::Conflict,
        "this folder holds results; add --resume to continue with them, --force to start over, or "
        "choose another",
        path);
  }
  if (exists) {
    TRY(sameExperiment(path, experiment, "add --force to start over, or choose another folder"));
  } else {
    TRY(writeFile(made.file(experimentFile), experiment.text, IfExists::Replace));
  }
  made.m_lines = UniqueFd(::open(lines.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (made.m_lines.get() < 0) return made.failed();
  if (::flock(made.m_lines.get(), LOCK_EX | LOCK_NB) != 0) {
    return failure(ErrorCode::Conflict, "another program is playing this experiment", path);
  }
  const auto whole = TRY(eachResult(lines, experiment, [&](const RunResult& result, const auto&) {
    char& done = made.m_finished[result.number - 1];
    made.m_count += done == 0;
    done = 1;
  }));
  if (::ftruncate(made.m_lines.get(), static_cast<off_t>(whole)) != 0) return made.failed();
  return made;
}

Result<void> ExperimentFolder::add(const RunResult& result, std::optional<double> timesRealTime) {
  char& done = m_finished[result.number - 1];
  if (done) return {};
  TRY(writeAll(m_lines, lineOf(result), file(runsFile)));
  done = 1;
  ++m_count;
  if (!timesRealTime) return {};
  return putTimes(std::to_string(result.number) + ',' + shortest(*timesRealTime) + '\n');
}

Result<void> ExperimentFolder::putTimes(std::string_view rows) {
  const std::string name = file(timesFile);
  if (m_times.get() < 0) {
    m_times = UniqueFd(::open(name.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
    if (m_times.get() < 0) {
      return failure(ErrorCode::SystemError, "cannot write: " + systemReason(errno), name);
    }
    if (::lseek(m_times.get(), 0, SEEK_END) == 0) {
      TRY(writeAll(m_times, timesHead, name));
    }
  }
  return writeAll(m_times, rows, name);
}

/// A part that has none was played without separate processes.
Result<void> ExperimentFolder::addTimesOf(const std::string& part) {
  const std::string name = inFolder(part, timesFile);
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored)) return {};
  const auto text = TRY(readFile(name, maxTimesBytes, "the times"));
  if (!text.starts_with(timesHead)) {
    return failure(ErrorCode::ParseError,
                   "is not a table of run times; remove it to merge without it", name);
  }
  return putTimes(std::string_view(text).substr(timesHead.size()));
}

Result<void> ExperimentFolder::sortLines() {
  std::vector<LinePlace> places;
  const std::string name = file(runsFile);
  TRY(eachResult(name, *m_experiment,
                 [&](const RunResult&, const LinePlace& place) { places.push_back(place); }));
  const auto before = [](const LinePlace& a, const LinePlace& b) { return a.number < b.number; };
  if (std::ranges::is_sorted(places, before)) return {};
  std::ranges::sort(places, before);
  std::ifstream source(name, std::ios::binary);
  auto target = TRY(FileTarget::at(name, IfExists::Replace));
  auto sorted = TRY(target.open());
  std::string line;
  for (const LinePlace& place : places) {
    line.resize(place.size);
    source.seekg(static_cast<std::streamoff>(place.offset));
    if (!source.read(line.data(), static_cast<std::streamsize>(line.size()))) return failed();
    TRY(sorted.write(line));
  }
  TRY(sorted.close());
  return target.commit();
}

Result<void> ExperimentFolder::writeReports() const {
  const auto table = TRY(resultsOf(m_path, *m_experiment));
  {
    auto target = TRY(FileTarget::at(file("runs.csv"), IfExists::Replace));
    auto csv = TRY(target.open());
    TRY(csv.write(csvHead(table.metrics)));
    TRY(eachResult(file(runsFile), *m_experiment, [&](const RunResult& result, const auto&) {
      return csv.write(csvLine(*m_experiment, result));
    }));
    TRY(csv.close());
    TRY(target.commit());
  }
  const ExperimentSummary summary = summarize(*m_experiment, table);
  const std::pair<const char*, std::string> texts[] = {
      {"summary.json", summaryJson(*m_experiment, summary)},
      {"junit.xml", junitReport(*m_experiment, summary)},
      {"report.md", reportMarkdown(*m_experiment, summary)},
      {"report.html", experimentReportHtml(*m_experiment, table, summary)}};
  for (const auto& [name, text] : texts) {
    TRY(writeFile(file(name), text, IfExists::Replace));
  }
  if (!summary.tournament) return {};
  return writeFile(file("table.csv"), tableCsv(*summary.tournament), IfExists::Replace);
}

Result<void> ExperimentFolder::finish() {
  TRY(sortLines());
  if (!complete()) return {};
  return writeReports();
}

Result<void> discardResults(const std::string& folder) {
  namespace fs = std::filesystem;
  const std::string lines = inFolder(folder, runsFile);
  const UniqueFd playing(::open(lines.c_str(), O_WRONLY | O_CLOEXEC));
  if (!playing && errno == ENOENT) return {};
  if (playing && ::flock(playing.get(), LOCK_EX | LOCK_NB) != 0) {
    return failure(ErrorCode::Conflict, "another program is playing this experiment", folder);
  }
  std::error_code code;
  const fs::path sessions = fs::path(folder) / sessionsFolder;
  std::vector<fs::path> files;
  for (const char* name : {timesFile, "runs.csv", "summary.json", "junit.xml", "report.md",
                           "report.html", "table.csv", experimentFile}) {
    files.push_back(fs::path(folder) / name);
  }
  for (const auto& entry : fs::directory_iterator(sessions, code)) {
    std::size_t number = 0;
    const bool isRun = std::sscanf(entry.path().filename().c_str(), "run-%zu.mcap", &number) == 1;
    if (isRun && entry.path() == fs::path(sessionPath(folder, number))) {
      files.push_back(entry.path());
    }
  }
  // The runs go last: without them, nothing here counts as results.
  files.emplace_back(lines);
  for (const fs::path& file : files) {
    if (!fs::remove(file, code) && code) {
      return failure(ErrorCode::SystemError, "cannot remove the old results: " + code.message(),
                     file.string());
    }
  }
  fs::remove(sessions, code);  // only if it is empty
  return {};
}

Result<Experiment> experimentOf(const std::string& folder) {
  const std::string path = inFolder(folder, experimentFile);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return failure(ErrorCode::NotFound, "no results found; is this the folder of an experiment?",
                   folder);
  }
  const auto text = TRY(readFile(path, maxExperimentBytes, "the experiment"));
  return experimentFromJson(text, path);
}

Result<ResultTable> resultsOf(const std::string& folder, const Experiment& experiment) {
  ResultTable table(experiment);
  TRY(eachResult(inFolder(folder, runsFile), experiment,
                 [&](const RunResult& result, const auto&) { table.add(experiment, result); }));
  return table;
}

Result<void> addResults(ResultTable& table, const std::string& folder,
                        const Experiment& experiment) {
  std::error_code ignored;
  if (!std::filesystem::exists(inFolder(folder, runsFile), ignored)) return {};
  TRY(sameExperiment(folder, experiment, "choose another folder"));
  TRY(eachResult(inFolder(folder, runsFile), experiment,
                 [&](const RunResult& result, const auto&) { table.add(experiment, result); }));
  return {};
}

Result<RunResult> resultOf(const std::string& folder, const Experiment& experiment,
                           std::size_t number) {
  std::optional<RunResult> found;
  TRY(eachResult(inFolder(folder, runsFile), experiment, [&](const RunResult& result, const auto&) {
    if (result.number == number) found = result;
  }));
  if (!found) {
    return failure(ErrorCode::NotFound,
                   "there is no run " + std::to_string(number) + "; they go from 1 to " +
                       std::to_string(experiment.allRuns()),
                   folder);
  }
  return *found;
}

Result<void> markUnrepeatable(const std::string& path, const Experiment& experiment,
                              std::size_t number) {
  auto folder = TRY(ExperimentFolder::begin(path, experiment, true));
  const std::string name = folder.file(runsFile);
  auto target = TRY(FileTarget::at(name, IfExists::Replace));
  auto marked = TRY(target.open());
  TRY(eachResult(name, experiment, [&](RunResult result, const auto&) {
    if (result.number == number) result.match.repeatable = false;
    return marked.write(lineOf(result));
  }));
  TRY(marked.close());
  TRY(target.commit());
  return folder.finish();
}

Result<ExperimentFolder> mergeFolders(const std::vector<std::string>& parts,
                                      const std::string& into, const Experiment& experiment) {
  for (const std::string& part : parts) {
    TRY(sameExperiment(part, experiment, "leave it out"));
  }
  auto folder = TRY(ExperimentFolder::begin(into, experiment, false));
  std::vector<std::uint64_t> hashes(experiment.allRuns(), 0);
  for (const std::string& part : parts) {
    TRY(eachResult(inFolder(part, runsFile), experiment,
                   [&](const RunResult& result, const auto&) -> Result<void> {
                     std::uint64_t& hash = hashes[result.number - 1];
                     if (folder.finished()[result.number - 1] && hash != result.hash) {
                       return failure(
                           ErrorCode::Conflict,
                           "run " + std::to_string(result.number) +
                               " ended differently here than in another folder; were both played "
                               "by the same version?",
                           part);
                     }
                     hash = result.hash;
                     return folder.add(result);
                   }));
    TRY(folder.addTimesOf(part));
  }
  TRY(folder.finish());
  return folder;
}

}  // namespace pitchboard::link

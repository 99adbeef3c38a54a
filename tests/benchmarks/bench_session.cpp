// SPDX-License-Identifier: GPL-3.0-or-later
// Sessions: what writing rows costs, how large an hour of a match is, how fast that file opens,
// shows a moment and becomes CSV. An hour and two hours are recorded once, into the folder of
// TMPDIR.

#include <benchmark/benchmark.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <random>

#include <robotlink/session/match_recorder.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/session/session_export.h>

namespace pitchboard::telemetry {
namespace {

constexpr double hour = 3600.0;

std::string place(const char* name) {
  return (std::filesystem::temp_directory_path() / name).string();
}

/// Keeps the rows of some seconds of a match.
class Rows : public RowSink {
 public:
  struct Row {
    GroupId group;
    double time;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
  };
  GroupId addGroup(const GroupInfo& info) override {
    groups.push_back(info);
    return static_cast<GroupId>(groups.size() - 1);
  }
  void append(GroupId group, const RowView& row) override {
    rows.push_back({group,
                    row.time,
                    {row.words.begin(), row.words.end()},
                    {row.values.begin(), row.values.end()}});
    values += row.words.size() + row.values.size();
  }
  std::vector<GroupInfo> groups;
  std::vector<Row> rows;
  std::size_t values = 0;
};

link::SimulatedMatch makeMatch() {
  auto scenario = link::loadScenario("match-3v3").value();
  scenario.settings.noise = link::noisePreset("realistic").value();
  link::MatchOptions options;
  options.process.particles = 100;
  return link::SimulatedMatch::create(scenario, options).value();
}

void writeRows(benchmark::State& state) {
  auto match = makeMatch();
  const auto rows = std::make_shared<Rows>();
  link::MatchSampler sampler(rows);
  for (int tick = 0; tick < 60 * 60; ++tick) {
    match.tick();
    sampler.ticked(match, {});
  }
  const std::string path = place("bench_write.mcap");
  SessionWriterOptions options;
  options.waitWhenFull = true;
  double cpu = 0.0;
  for (auto _ : state) {
    std::remove(path.c_str());
    const std::clock_t begin = std::clock();  // of all threads
    auto writer = SessionWriter::create(path, {}, options).value();
    for (const GroupInfo& group : rows->groups) writer->addGroup(group);
    for (const Rows::Row& row : rows->rows)
      writer->append(row.group, {row.time, row.words, row.values});
    if (!writer->finish()) state.SkipWithError("not written");
    cpu += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }
  const double values = static_cast<double>(rows->values) * static_cast<double>(state.iterations());
  state.counters["values/s"] = benchmark::Counter(values, benchmark::Counter::kIsRate);
  state.counters["cores at 1M values/s"] = cpu / (values / 1e6);
  std::remove(path.c_str());
}
BENCHMARK(writeRows)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Six robots at 60 Hz, with checkpoints and events, played at full speed.
std::string recorded(const char* name, double seconds) {
  const std::string file = place(name);
  std::remove(file.c_str());
  auto match = makeMatch();
  SessionWriterOptions options;
  options.waitWhenFull = true;
  options.sync = false;
  std::shared_ptr<SessionWriter> writer =
      SessionWriter::create(file, link::sessionInfo(match, "benchmark", WallTime{}), options)
          .value();
  link::attachMatch(*writer, match.scenario(), link::VariableCatalog::published());
  link::MatchRecorder recorder(writer);
  recorder.ticked(match, {});
  for (int tick = 0; tick < static_cast<int>(seconds * 60); ++tick) {
    match.tick();
    recorder.happened(match.simulation().events());
    recorder.ticked(match, std::chrono::microseconds(20));
  }
  (void)recorder.finish();
  return file;
}

const std::string& hourFile() {
  static const std::string path = recorded("bench_hour.mcap", hour);
  return path;
}

void openAndFirstFrame(benchmark::State& state) {
  const std::string& path = hourFile();
  for (auto _ : state) {
    const auto session = SessionReader::open(path);
    link::RecordedFrames frames(link::backdropOf(*session));
    const link::MatchFrame frame = frames.frameAt(*session, session->range()->begin);
    if (frame.robots.size() != 6) state.SkipWithError("not six robots");
  }
  state.counters["MB of an hour"] = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
}
BENCHMARK(openAndFirstFrame)->Unit(benchmark::kMillisecond);

/// A frame at random moments; the slowest counts too.
void seekInTwoHours(benchmark::State& state) {
  const std::string path = recorded("bench_two_hours.mcap", 2 * hour);
  const auto session = SessionReader::open(path);
  link::RecordedFrames frames(link::backdropOf(*session));
  std::mt19937 random(1);
  double slowest = 0.0;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    const double time = std::uniform_real_distribution<double>(0.0, 2 * hour)(random);
    benchmark::DoNotOptimize(frames.frameAt(*session, time));
    slowest = std::max(
        slowest, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                     .count());
  }
  state.counters["slowest, ms"] = slowest;
  std::remove(path.c_str());
}
BENCHMARK(seekInTwoHours)->Unit(benchmark::kMillisecond)->Iterations(300);

void exportCsv(benchmark::State& state, ExportFormat format) {
  const auto session = SessionReader::open(hourFile());
  ExportSelection selection;
  selection.range = {0.0, 600.0};
  const std::string path = place("bench_export.csv");
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    std::remove(path.c_str());
    const auto report = exportFile(*session, format, selection, path);
    if (!report)
      state.SkipWithError(report.error().text().c_str());
    else
      bytes += report->bytes;
  }
  std::remove(path.c_str());
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
}
BENCHMARK_CAPTURE(exportCsv, wide, ExportFormat::CsvWide)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(exportCsv, long_form, ExportFormat::CsvLong)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace pitchboard::telemetry

BENCHMARK_MAIN();

// SPDX-License-Identifier: GPL-3.0-or-later
// How cost grows with the work: each kind of work at five sizes, one after the other in one
// process, so that the larger ones find the heap as the smaller ones left it. Prints processor
// time, memory and bytes written of the largest size, and the exponent of each: 1 if twice the work
// costs twice as much. Exits with 1 if an exponent is above its limit. scripts/growth.sh builds and
// runs it.
//
//     growth [WORD]      only kinds whose name contains the word

#include <malloc.h>
#include <pitchboard_sim.h>
#include <time.h>

#include <QCoreApplication>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/live/live_pipeline.h>
#include <robotlink/session/live_recorder.h>
#include <telemetry/session/session_export.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_repair.h>
#include <telemetry/session/session_writer.h>

#include "log_model.h"

using namespace pitchboard;

namespace {

constexpr std::size_t sizeCount = 5;
constexpr double limit = 1.2;  // of an exponent

/// What one size of a kind of work took; 0 where it is not measured.
struct Cost {
  double seconds = 0.0;
  double heapBytes = 0.0;  ///< in use at the end of the work, beyond those before
  double fileBytes = 0.0;
};

/// Processor time of all threads: other programs change it little.
double now() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
double heapInUse() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}
std::string file(const char* name) {
  return (std::filesystem::temp_directory_path() / name).string();
}
double sizeOf(const std::string& path) {
  return static_cast<double>(std::filesystem::file_size(path));
}
template <typename T>
T must(Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "error: %s\n", result.error().text().c_str());
    std::exit(2);
  }
  return std::move(*result);
}
void must(const Result<void>& result) {
  if (result) return;
  std::fprintf(stderr, "error: %s\n", result.error().text().c_str());
  std::exit(2);
}
void must(pb_status status) {
  if (status == PB_OK) return;
  std::fprintf(stderr, "error: %s\n", pb_last_error());
  std::exit(2);
}

/// The time of the fastest of a few repetitions.
double secondsOf(const std::function<void()>& work, int times = 3) {
  double best = 1e300;
  for (int i = 0; i < times; ++i) {
    const double begin = now();
    work();
    best = std::min(best, now() - begin);
  }
  return best;
}

/// The slope of the regression line of log(cost) over log(size).
double exponent(const std::array<int, sizeCount>& sizes,
                const std::array<double, sizeCount>& costs) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < sizeCount; ++i) {
    const double x = std::log(sizes[i]), y = std::log(std::max(costs[i], 1e-9));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  constexpr double n = sizeCount;
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

pb_worlds* worldsOf(int count, const char* behaviour) {
  pb_options options;
  must(pb_options_init(&options, sizeof options));
  options.worlds = count;
  options.noise = "none";
  pb_worlds* worlds = nullptr;
  must(pb_create(&options, &worlds));
  must(pb_set_behaviour(worlds, 1, behaviour));
  must(pb_reset(worlds, PB_ALL, 1));
  return worlds;
}

Cost stepsOfWorlds(int count) {
  pb_worlds* worlds = worldsOf(count, "none");
  const int ticks = std::max(4, 40'000 / count);
  Cost cost;
  cost.seconds = secondsOf([&] {
    for (int i = 0; i < ticks; ++i) must(pb_step(worlds, 1));
  });
  cost.seconds /= ticks;
  must(pb_destroy(worlds));
  return cost;
}

Cost creationOfWorlds(int count) {
  const double before = heapInUse(), begin = now();
  pb_worlds* worlds = worldsOf(count, "striker");
  Cost cost{now() - begin, heapInUse() - before, 0.0};
  must(pb_destroy(worlds));
  return cost;
}

/// A session of `rows` rows with 60 numbers of two robots each.
std::string sessionOf(int rows) {
  const std::string path = file("pitchboard-growth.mcap");
  std::filesystem::remove(path);
  telemetry::SessionWriterOptions options;
  options.waitWhenFull = true;
  options.sync = false;
  auto writer = must(telemetry::SessionWriter::create(path, {}, options));
  std::array<telemetry::GroupId, 2> groups{};
  constexpr std::size_t columns = 60;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    telemetry::GroupInfo info;
    info.name = g == 0 ? "B1" : "R1";
    for (std::size_t c = 0; c < columns; ++c) {
      info.columns.emplace_back().name = "VALUE_" + std::to_string(c);
    }
    groups[g] = writer->addGroup(info);
  }
  std::vector<double> values(columns);
  for (int row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < columns; ++c) {
      values[c] = std::sin(0.01 * row * static_cast<double>(c + 1));
    }
    for (const telemetry::GroupId group : groups) writer->append(group, {row / 60.0, {}, values});
  }
  must(writer->finish());
  return path;
}

Cost recording(int rows) {
  Cost cost;
  std::string path;
  cost.seconds = secondsOf([&] { path = sessionOf(rows); }, 2);
  cost.fileBytes = sizeOf(path);
  return cost;
}

Cost exporting(telemetry::ExportFormat format, int rows) {
  const std::string from = sessionOf(rows), to = file("pitchboard-growth-export");
  const auto session = must(telemetry::SessionReader::open(from));
  Cost cost;
  cost.seconds = secondsOf(
      [&] { (void)must(telemetry::exportFile(session, format, {}, to, {}, IfExists::Replace)); },
      2);
  cost.fileBytes = sizeOf(to);
  return cost;
}

Cost repairing(int rows) {
  const std::string from = sessionOf(rows), to = file("pitchboard-growth-repaired.mcap");
  std::filesystem::resize_file(from, std::filesystem::file_size(from) - 100);
  Cost cost;
  cost.seconds =
      secondsOf([&] { (void)must(telemetry::repairSession(from, to, {}, IfExists::Replace)); }, 2);
  cost.fileBytes = sizeOf(to);
  return cost;
}

/// A live session that is recorded, without a network.
class Live {
 public:
  explicit Live(link::LiveOptions options = {})
      : m_path(file("pitchboard-growth-live.mcap")), m_pipeline(options, telemetry::WallTime{}) {
    std::filesystem::remove(m_path);
    const link::RecorderOptions recording;
    m_recorder =
        must(link::LiveRecorder::create(m_path, options, telemetry::WallTime{}, recording));
    m_pipeline.observe(m_recorder, telemetry::WallTime{});
  }
  void receive(int robot, const std::string& text, bool isVariables) {
    m_pipeline.take({at(),
                     {{0x0a00'0000U + static_cast<std::uint32_t>(robot)}, 5000},
                     static_cast<std::uint16_t>((isVariables ? 1340 : 1240) + robot),
                     false,
                     text});
  }
  void frame(double passed) {
    (void)m_pipeline.advance(at());
    m_time += passed;
  }
  double finish() {
    m_pipeline.stopObserving(m_recorder);
    must(m_recorder->finish());
    return sizeOf(m_path);
  }
  telemetry::WallTime at() const {
    return telemetry::WallTime(
        std::chrono::duration_cast<telemetry::Duration>(std::chrono::duration<double>(m_time)));
  }
  double seconds() const { return m_time; }

 private:
  std::string m_path;
  link::LivePipeline m_pipeline;
  std::shared_ptr<link::LiveRecorder> m_recorder;
  double m_time = 1.0;
};

/// Agents send 100 variables each, 20 times a second, for two seconds.
Cost agents(int robots) {
  const double before = heapInUse(), begin = now();
  link::LiveOptions options;
  options.robots = robots;
  Live live(options);
  for (int message = 0; message < 40; ++message) {
    for (int robot = 1; robot <= robots; ++robot) {
      std::string text = "PB2 " + std::to_string(robot) + ' ' + std::to_string(message) + ' ' +
                         std::to_string(std::lround(1000 * live.seconds()));
      for (int name = 0; name < 100; ++name) {
        text += " N" + std::to_string(name) + '=' + std::to_string(message * name);
      }
      live.receive(robot, text + " OUT", true);
    }
    live.frame(0.05);
  }
  const double heap = heapInUse() - before;
  const double bytes = live.finish();
  return {now() - begin, heap, bytes};
}

/// The names of one agent appear one by one; memory must not grow faster than they do.
Cost names(int count) {
  const double before = heapInUse();
  Live live;
  for (int name = 0; name < count; ++name) {
    std::string text =
        "PB2 1 " + std::to_string(name) + ' ' + std::to_string(std::lround(1000 * live.seconds()));
    for (int last = std::max(0, name - 20); last <= name; ++last) {
      text += " N" + std::to_string(last) + '=' + std::to_string(name);
    }
    live.receive(1, text + " OUT", true);
    live.frame(0.05);
  }
  return {0.0, heapInUse() - before, live.finish()};
}

/// Every message of a robot has another text.
Cost texts(int count) {
  link::LiveOptions options;
  options.profile = must(telemetry::parseProfile(
      R"({"name": "texts", "format": "json", "fields": [
          {"name": "NUMBER", "key": "robot", "type": "int", "meaning": "robot"},
          {"name": "STATE", "key": "state", "type": "text"}]})",
      "texts"));
  const double before = heapInUse(), begin = now();
  Live live(options);
  for (int i = 0; i < count; ++i) {
    live.receive(1, R"({"robot": 1, "state": "looking )" + std::to_string(i) + "\"}", false);
    live.frame(0.05);
  }
  const double heap = heapInUse() - before;
  const double bytes = live.finish();
  return {now() - begin, heap, bytes};
}

/// Every variable of a map is looked up by its name.
Cost lookups(int count) {
  std::string map = R"({"segment": {"bytes": 8192}, "int": {)";
  for (int i = 0; i < count; ++i) {
    map += (i > 0 ? ", \"NAME_" : "\"NAME_") + std::to_string(i) + "\": " + std::to_string(i);
  }
  const std::string path = file("pitchboard-growth.json");
  std::filesystem::remove(path);
  must(writeFile(path, map + "}, \"float\": {}}", IfExists::Replace));
  link::SegmentLayout layout;
  const auto catalog = must(link::VariableCatalog::fromFile(path, layout));
  std::size_t found = 0;
  Cost cost;
  cost.seconds = secondsOf([&] {
    for (int round = 0; round < 50; ++round) {
      for (const auto& variable : catalog.variables())
        found += catalog.find(variable.name) != nullptr;
    }
  });
  if (found == 0) std::exit(2);
  return cost;
}

void fill(ui::LogModel& log, int first, int count) {
  std::vector<LogLine> lines;
  for (int i = first; i < first + count; ++i) {
    lines.push_back({i / 1000.0, i % 3 == 0 ? "B1 decision" : "R2 localization",
                     "cycle " + std::to_string(i) + ": the ball is 83.2 cm away"});
  }
  log.append(lines);
}

/// Lines that come in small portions, most of them to a log that is full.
Cost logLines(int count) {
  ui::LogModel log;
  Cost cost;
  const double begin = now();
  for (int line = 0; line < count; line += 100) fill(log, line, 100);
  cost.seconds = now() - begin;
  return cost;
}

/// The match goes back to its beginning, and its lines go.
Cost logRewind(int count) {
  ui::LogModel log;
  fill(log, 0, count);
  const double begin = now();
  log.rewind(ui::SourceKind::Simulate, 0.0);
  return {now() - begin, 0.0, 0.0};
}

struct Kind {
  const char* name;
  const char* unit;
  std::array<int, sizeCount> sizes;
  std::function<Cost(int)> work;
};

const std::vector<Kind>& kinds() {
  using Format = telemetry::ExportFormat;
  static const std::vector<Kind> all{
      {"worlds: a step", "worlds", {64, 256, 1024, 2048, 4096}, stepsOfWorlds},
      {"worlds: created", "worlds", {64, 128, 256, 512, 1024}, creationOfWorlds},
      {"session: rows recorded", "rows", {2000, 4000, 8000, 16'000, 32'000}, recording},
      {"session: export to mcap",
       "rows",
       {2000, 4000, 8000, 16'000, 32'000},
       [](int rows) { return exporting(Format::Mcap, rows); }},
      {"session: export to csv-wide",
       "rows",
       {2000, 4000, 8000, 16'000, 32'000},
       [](int rows) { return exporting(Format::CsvWide, rows); }},
      {"session: repair", "rows", {2000, 4000, 8000, 16'000, 32'000}, repairing},
      {"live: agents", "robots", {4, 8, 16, 32, 64}, agents},
      {"live: names that appear", "names", {100, 200, 400, 800, 1600}, names},
      {"live: texts that differ", "texts", {512, 1024, 2048, 4096, 8192}, texts},
      {"map: names found", "names", {60, 120, 240, 480, 960}, lookups},
      {"log: lines", "lines", {5000, 10'000, 20'000, 40'000, 80'000}, logLines},
      {"log: rewind", "lines", {1000, 2000, 3000, 5000, 10'000}, logRewind}};
  return all;
}

/// One measure of a kind as " 12.3 ms ^1.02"; counts it if it grows too fast.
std::string grown(const Kind& kind, const std::array<Cost, sizeCount>& costs, double Cost::*measure,
                  double scale, const char* unit, int& tooFast) {
  std::array<double, sizeCount> values{};
  for (std::size_t i = 0; i < sizeCount; ++i) values[i] = costs[i].*measure;
  if (values.back() <= 0.0) return {};
  const double power = exponent(kind.sizes, values);
  const bool isTooFast = power > limit;
  tooFast += isTooFast ? 1 : 0;
  char text[64];
  std::snprintf(text, sizeof text, "  %.3g %s ^%.2f%s", values.back() * scale, unit, power,
                isTooFast ? " TOO FAST" : "");
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const QCoreApplication app(argc, argv);
  const std::string wanted = argc > 1 ? argv[1] : "";
  int tooFast = 0, measured = 0;
  for (const Kind& kind : kinds()) {
    if (std::string(kind.name).find(wanted) == std::string::npos) continue;
    ++measured;
    std::array<Cost, sizeCount> costs;
    for (std::size_t i = 0; i < sizeCount; ++i) costs[i] = kind.work(kind.sizes[i]);
    const std::string line = grown(kind, costs, &Cost::seconds, 1e3, "ms", tooFast) +
                             grown(kind, costs, &Cost::heapBytes, 1e-6, "MB in memory", tooFast) +
                             grown(kind, costs, &Cost::fileBytes, 1e-6, "MB written", tooFast);
    std::printf("%-28s %6d %-7s%s\n", kind.name, kind.sizes.back(), kind.unit, line.c_str());
    std::fflush(stdout);
  }
  if (measured == 0) {
    std::fprintf(stderr, "error: no kind of work contains \"%s\"\n", wanted.c_str());
    return 2;
  }
  if (tooFast > 0) std::fprintf(stderr, "error: %d costs grow faster than the work\n", tooFast);
  return tooFast > 0 ? 1 : 0;
}

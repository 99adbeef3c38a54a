// SPDX-License-Identifier: GPL-3.0-or-later
// A day of real robots: how large its file is, how soon the first frame and curves over its whole
// length are there, and in how much memory (docs/performance.md).
//
//   bench_day make FILE [--hours 24] [--rate 5] [--robots 22]    as the studio would record it
//   bench_day open FILE [--memory MB]                            as the studio opens it
//
// Nothing is received: the same state, rows and recorder take datagrams that are made up, in the
// chunks that they would have in real time.
#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <robotlink/live/live_pipeline.h>
#include <robotlink/session/live_recorder.h>
#include <telemetry/formats/text_protocol.h>
#include <telemetry/referee/gamecontroller_encoder.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>
#include <ui/sources/replay_controller.h>

using namespace pitchboard;
using namespace std::chrono_literals;
using telemetry::Duration;
using telemetry::WallTime;

namespace {

struct Day {
  double hours = 24.0, rate = 5.0;
  int robots = 22;
};

/// A robot that walks about the field and sees a ball that rolls.
class Player {
 public:
  explicit Player(int number) : m_number(number), m_rng(static_cast<unsigned>(number)) {}

  std::string message(double time) {
    std::normal_distribution<double> noise(0.0, 1.0);
    const double phase = 0.05 * time + m_number;
    telemetry::TextMessage m;
    m.robot = m_number;
    m.x = static_cast<int>(450.0 + 350.0 * std::sin(phase) + 3.0 * noise(m_rng));
    m.y = static_cast<int>(300.0 + 220.0 * std::cos(1.3 * phase) + 3.0 * noise(m_rng));
    m.theta = (static_cast<int>(phase * 57.0 + 2.0 * noise(m_rng)) % 360 + 360) % 360;
    m.belief = static_cast<float>(20.0 + 4.0 * std::abs(noise(m_rng)));
    const bool sees = std::sin(0.3 * phase) > -0.3;
    m.ballDist =
        sees ? static_cast<float>(150.0 + 90.0 * std::sin(0.7 * phase) + noise(m_rng)) : -1;
    m.ballAngle = sees ? static_cast<float>(30.0 * std::sin(phase) + noise(m_rng)) : 0;
    m.control = m.vision = m.localization = m.decision = m.imu = 1;
    m.actionA = 1 + static_cast<int>(time / 3.0 + m_number) % 12;
    m.imuEulerZ = static_cast<float>(std::remainder(phase, 6.28) + 0.01 * noise(m_rng));
    m.voltage = static_cast<int>(168.0 - std::fmod(time, 5400.0) / 250.0);
    return telemetry::encode(m);
  }

 private:
  int m_number;
  std::mt19937 m_rng;
};

std::string refereePacket(double time) {
  telemetry::RefereeState state;
  state.version = 12;
  state.size = telemetry::refereePacketSize(12).value_or(0);
  state.playersPerTeam = 11;
  state.state = 3;
  state.firstHalf = std::fmod(time, 1200.0) < 600.0 ? 1 : 0;
  state.secsRemaining = 600 - static_cast<int>(std::fmod(time, 600.0));
  state.packetNumber = static_cast<int>(2.0 * time) % 256;
  state.gameType = 0;
  state.secState = 0;
  state.secStateInfo = {0, 0, 0, 0};
  state.kickOffRaw = 12;
  state.kickOffTeam = 12;
  for (int side = 0; side < 2; ++side) {
    state.teams[static_cast<std::size_t>(side)].number = 12 + side;
  }
  return telemetry::encodeReferee(state).value_or(std::string());
}

int make(const std::string& file, const Day& day) {
  link::LiveOptions options;
  options.robots = day.robots;
  options.ourTeam = 12;
  const WallTime zero{1'790'000'000s};
  link::RecorderOptions how;
  how.writer.waitWhenFull = true;
  how.writer.sync = false;
  // What comes in 0.8 s of real time makes a chunk.
  constexpr double bytesOfMessage = 470.0, bytesOfReferee = 6000.0;
  how.writer.chunkBytes = static_cast<std::size_t>(
      0.8 * (day.rate * day.robots * bytesOfMessage + 2.0 * bytesOfReferee));
  how.writer.chunkInterval = 1h;
  std::remove(file.c_str());
  const auto recorder = link::LiveRecorder::create(file, options, zero, how);
  if (!recorder) {
    std::fprintf(stderr, "error: %s\n", recorder.error().text().c_str());
    return 2;
  }
  link::LivePipeline pipeline(options, zero);
  std::vector<Player> players;
  for (int i = 1; i <= day.robots; ++i) players.emplace_back(i);
  const double period = 1.0 / day.rate;
  const auto at = [&](double time) {
    return zero + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(time));
  };
  double referee = 0.0, frame = 0.0;
  pipeline.observe(*recorder, zero);
  for (std::uint64_t step = 0; static_cast<double>(step) * period < day.hours * 3600.0; ++step) {
    for (std::size_t i = 0; i < players.size(); ++i) {
      const double time =
          (static_cast<double>(step) + static_cast<double>(i) / static_cast<double>(day.robots)) *
          period;
      const std::string text = players[i].message(time);
      const auto number = static_cast<std::uint32_t>(i + 1);
      const telemetry::DatagramView datagram{at(time),
                                             {{0x0A000000U + number}, 41708},
                                             static_cast<std::uint16_t>(1240 + number),
                                             false,
                                             text};
      pipeline.take(datagram);
    }
    const double time = static_cast<double>(step + 1) * period;
    if (time >= referee) {
      referee += 0.5;
      const std::string bytes = refereePacket(time);
      const telemetry::DatagramView datagram{at(time), {{0x0A0000FEU}, 3838}, 3838, false, bytes};
      pipeline.take(datagram);
    }
    if (time >= frame) {
      frame += 0.25;
      (void)pipeline.advance(at(time));
    }
  }
  if (const auto done = (*recorder)->finish(); !done) {
    std::fprintf(stderr, "error: %s\n", done.error().text().c_str());
    return 2;
  }
  const auto session = telemetry::SessionReader::open(file);
  if (!session) return 2;
  std::uint64_t packed = 0, plain = 0;
  for (const telemetry::McapChunkInfo& chunk : session->file().contents().chunks) {
    packed += chunk.compressedSize;
    plain += chunk.uncompressedSize;
  }
  const auto size = std::filesystem::file_size(file);
  const auto perHour = [&](std::uint64_t bytes) {
    return static_cast<double>(bytes) / 1e6 / day.hours;
  };
  std::printf(
      "%d robots, %.0f messages a second each, %.1f h: %.1f MB an hour, %.1f of them index; "
      "%.1f before packing, %.0f chunks an hour\n",
      day.robots, day.rate, day.hours, perHour(size), perHour(size - packed), perHour(plain),
      static_cast<double>(session->file().contents().chunks.size()) / day.hours);
  return 0;
}

double mib(const char* key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) return std::stod(line.substr(std::strlen(key) + 1)) / 1024.0;
  }
  return 0.0;
}

/// Of all threads, ms.
double cpu() {
  return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// False: it took longer than half a minute.
template <class Done>
bool waitFor(const Done& done) {
  QElapsedTimer clock;
  clock.start();
  while (!done()) {
    if (clock.elapsed() > 30'000) return false;
    QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents, 5);
  }
  return true;
}

int open(const std::string& file, std::size_t megabytes) {
  QElapsedTimer clock;
  ui::ReplayController replay;
  replay.setMemoryBudget(megabytes << 20);
  std::size_t robots = 0;
  QString problem;
  QObject::connect(&replay, &ui::FrameSource::frameReceived, [&](const ui::FramePtr& frame) {
    if (robots == 0) robots = frame->robots.size();
  });
  QObject::connect(&replay, &ui::ReplayController::failed,
                   [&](const QString& sentence) { problem = sentence; });
  clock.start();
  replay.open(QString::fromStdString(file));
  if (!waitFor([&] { return robots > 0 || !problem.isEmpty(); }) || robots == 0) {
    std::fprintf(stderr, "error: no frame. %s\n", qPrintable(problem));
    return 1;
  }
  std::printf("first frame with %zu robots after %lld ms, %.0f ms of CPU, %.0f MiB\n", robots,
              static_cast<long long>(clock.elapsed()), cpu(), mib("VmRSS:"));
  const auto rows = [&] { return replay.series(); };
  clock.start();
  if (!waitFor([&] { return rows() && rows()->groups() > 0 && rows()->range(); })) return 1;
  std::printf("list of variables after %lld ms more, %.0f ms of CPU in all\n",
              static_cast<long long>(clock.elapsed()), cpu());
  double before = cpu();
  const telemetry::TimeRange all = *rows()->range();
  constexpr std::size_t pixels = 1500;
  std::vector<telemetry::SeriesBucket> buckets(pixels);
  double slowest = 0.0, sum = 0.0;
  std::size_t curves = 0;
  const std::size_t groups = rows()->groups();
  for (telemetry::GroupId group = 0; group < groups; ++group) {
    clock.start();
    const auto whole = [&] {
      rows()->view(group)->buckets(0, all, buckets);
      const auto drawn = [](const auto& bucket) { return bucket.samples > 0; };
      const auto first = std::ranges::find_if(buckets, drawn);
      const auto last = std::find_if(buckets.rbegin(), buckets.rend(), drawn).base();
      return last - first > static_cast<std::ptrdiff_t>(pixels) * 95 / 100;
    };
    if (!waitFor(whole)) {
      std::fprintf(stderr, "error: %s has no whole curve\n",
                   rows()->view(group)->info().name.c_str());
      return 1;
    }
    const double took = static_cast<double>(clock.nsecsElapsed()) / 1e6;
    slowest = std::max(slowest, took);
    sum += took;
    ++curves;
  }
  std::printf(
      "%zu curves over %.1f h: %.0f ms on average, the slowest %.0f ms; %.0f ms of CPU each\n",
      curves, (all.end - all.begin) / 3600.0, sum / static_cast<double>(curves), slowest,
      (cpu() - before) / static_cast<double>(curves));
  before = cpu();
  // Ten minutes in the middle, every message.
  const telemetry::TimeRange some{(all.begin + all.end) / 2.0, (all.begin + all.end) / 2.0 + 600.0};
  clock.start();
  std::vector<telemetry::Sample> samples;
  if (!waitFor([&] { return rows()->view(0)->samples(0, some, samples); })) return 1;
  std::printf("every row of ten minutes (%zu of the first curve) after %lld ms, %.0f ms of CPU\n",
              samples.size(), static_cast<long long>(clock.elapsed()), cpu() - before);
  before = cpu();
  std::mt19937 rng(1);
  slowest = sum = 0.0;
  constexpr int jumps = 20;
  for (int i = 0; i < jumps; ++i) {
    const double time = std::uniform_real_distribution<double>(all.begin, all.end)(rng);
    bool there = false;
    const auto seen = QObject::connect(
        &replay, &ui::FrameSource::frameReceived,
        [&](const ui::FramePtr& frame) { there = std::abs(frame->snapshot.time - time) < 1.0; });
    clock.start();
    replay.standAt(time);
    const bool came = waitFor([&] { return there; });
    QObject::disconnect(seen);
    if (!came) return 1;
    const double took = static_cast<double>(clock.nsecsElapsed()) / 1e6;
    slowest = std::max(slowest, took);
    sum += took;
  }
  std::printf(
      "a moment anywhere: %.0f ms on average, the slowest of %d %.0f ms; %.0f ms of CPU each\n",
      sum / jumps, jumps, slowest, (cpu() - before) / jumps);
  std::printf("memory: %.0f MiB at most\n", mib("VmHWM:"));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const QCoreApplication app(argc, argv);
  const QStringList words = QCoreApplication::arguments();
  const auto value = [&words](const char* name, double otherwise) {
    const qsizetype at = words.indexOf(QLatin1String(name));
    return at > 0 && at + 1 < words.size() ? words[at + 1].toDouble() : otherwise;
  };
  const QString what = words.value(1), file = words.value(2);
  if (what == QLatin1String("make") && !file.isEmpty()) {
    return make(file.toStdString(), {value("--hours", 24.0), value("--rate", 5.0),
                                     static_cast<int>(value("--robots", 22))});
  }
  if (what == QLatin1String("open") && !file.isEmpty()) {
    return open(file.toStdString(), static_cast<std::size_t>(value("--memory", 1024)));
  }
  std::fprintf(stderr, "bench_day make|open FILE; see the source for options\n");
  return 2;
}

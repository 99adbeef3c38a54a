// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/run_player.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <mutex>
#include <thread>

#include <base/try.h>
#include <robotlink/experiment/checks.h>
#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/match/match_player.h>
#include <robotlink/session/match_recorder.h>
#include <telemetry/sockets/live_clock.h>

#include "rule_counter.h"
#include "run_layout.h"
#include "run_measure.h"

namespace pitchboard::link {

/// Runs in which a team's own programs play. They know nothing of turns: the match keeps a pace
/// that they can follow, begins when they are there, and how well they kept up is measured. For the
/// thread that plays the run.
class TeamPrograms {
 public:
  using Clock = std::chrono::steady_clock;
  /// `speed`: times real time, at most. The match must outlive it.
  TeamPrograms(MatchPlayer& player, double speed)
      : m_player(player), m_speed(speed), m_now(speed) {}

  /// Until the match awaits none of its programs (MatchPlayer::awaitPrograms()). Error NotFound
  /// when one of them does not run; none when `cancelled`.
  Result<void> begin(const std::atomic<bool>* cancelled);
  /// Until the next tick is due; looks after the processes meanwhile.
  void wait();
  /// What the slowest of them kept of the match's pace: 1 = all.
  double keptUp() const { return m_looks > 0 ? m_kept / m_looks : 1.0; }

 private:
  Result<void> missing() const;
  void look(Clock::time_point now);
  void setSpeed(double speed, Clock::time_point now);

  MatchPlayer& m_player;
  Pacer m_pacer;
  double m_speed, m_now;  // times real time: wanted, at present
  double m_kept = 0.0, m_looks = 0.0;
  Clock::time_point m_looked{}, m_followed{};
};

namespace {

using namespace std::chrono_literals;
constexpr auto lookInterval = 50ms;
constexpr auto glance = 20ms;  // between two looks whether the programs are there

std::string nameOf(const SimulatedMatch& match, const ProcessStatus& program) {
  const auto index = match.simulation().indexOf(program.robot);
  return (index ? match.simulation().state().robots[*index].name() : std::string()) + ' ' +
         program.name;
}

}  // namespace

/// Error NotFound if a program of a robot died again and again, or has died and does not run: the
/// match was not played by the robots that were asked for.
Result<void> programsSurvived(const SimulatedMatch& match) {
  for (const ProcessStatus& one : match.robots().processes().statuses()) {
    if (!one.keepsDying()) continue;
    return failure(ErrorCode::NotFound, nameOf(match, one) + " died " + std::to_string(one.deaths) +
                                            (one.deaths == 1 ? " time: " : " times: ") +
                                            one.lastDeath);
  }
  return {};
}

Result<void> TeamPrograms::missing() const {
  const SimulatedMatch& match = m_player.match();
  for (const ProcessStatus& one : match.robots().processes().statuses()) {
    // One that runs and attaches nothing may have another way to see its robot.
    if (!one.isTeamProgram || (one.state == ProcessState::Running && one.restarts == 0) ||
        match.pace().hasAttached(one)) {
      continue;
    }
    return failure(ErrorCode::NotFound,
                   nameOf(match, one) + " does not run" +
                       (one.detail.empty() ? "" : ": " + one.detail) +
                       (one.lastLines.empty() ? "" : "; last output: " + one.lastLines.back()));
  }
  return {};
}

Result<void> TeamPrograms::begin(const std::atomic<bool>* cancelled) {
  SimulatedMatch& match = m_player.match();
  match.pace().setPlaying(m_speed, false, Clock::now());
  while (m_player.awaitPrograms(Clock::now())) {
    if (cancelled && *cancelled) return {};
    m_player.lookAfterProcesses(Clock::now());
    std::this_thread::sleep_for(glance);
  }
  TRY(missing());
  m_looked = m_followed = Clock::now();
  setSpeed(match.pace().teamProgramPace(m_speed, m_speed), m_looked);
  return {};
}

void TeamPrograms::setSpeed(double speed, Clock::time_point now) {
  m_now = speed;
  SimulatedMatch& match = m_player.match();
  match.pace().slowTo(speed, now);
  m_pacer.start(now, m_player.currentTick(), speed * match.simulation().state().settings.tickRate);
}

void TeamPrograms::look(Clock::time_point now) {
  SimulatedMatch& match = m_player.match();
  m_looked = now;
  m_player.lookAfterProcesses(now);
  const auto slowest = match.pace().slowestTeamProgram();
  m_kept += slowest ? std::min(1.0, *slowest / m_now) : 1.0;
  m_looks += 1.0;
  if (now - m_followed < ProcessPace::paceInterval) return;
  m_followed = now;
  const double speed = match.pace().teamProgramPace(m_speed, m_now);
  if (speed != m_now) setSpeed(speed, now);
}

void TeamPrograms::wait() {
  auto now = Clock::now();
  while (m_pacer.target(now) <= m_player.currentTick()) {
    if (now - m_looked >= lookInterval) look(now);
    std::this_thread::sleep_until(m_pacer.wake(now, m_player.currentTick()));
    now = Clock::now();
  }
  if (now - m_looked >= lookInterval) look(now);
  m_pacer.forgive(now, m_player.currentTick());
}

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
using WallClock = std::chrono::steady_clock;
constexpr auto timeBetweenLooks = std::chrono::milliseconds(50);
constexpr std::uint64_t ticksBetweenLooks = 64;  // at the clock and at who cancels

sim::RobotIdentity const* robotNamed(const sim::WorldState& world, std::string_view name) {
  const auto found =
      std::ranges::find_if(world.robots, [&](const auto& robot) { return robot.name() == name; });
  return found == world.robots.end() ? nullptr : &*found;
}

/// Moves by hand whose time has come.
class Hand {
 public:
  Hand(const std::vector<PlacedByHand>& placed, MatchPlayer& player)
      : m_placed(placed), m_player(player) {}

  Result<void> act() {
    if (m_next >= m_placed.size()) return {};
    sim::Simulation& simulation = m_player.match().simulation();
    const double now =
        static_cast<double>(simulation.state().tick) / simulation.state().settings.tickRate;
    bool acted = false;
    for (; m_next < m_placed.size() && m_placed[m_next].time <= now + 1e-9; ++m_next) {
      const PlacedByHand& one = m_placed[m_next];
      const sim::RobotIdentity* robot = robotNamed(simulation.state(), one.who);
      if (one.who == "ball") {
        TRY(simulation.placeBall(one.pose.position, one.velocity));
      } else if (robot) {
        TRY(simulation.placeRobot(robot->id, one.pose));
      }
      acted = true;
    }
    if (acted) m_player.worldChanged();
    return {};
  }

 private:
  const std::vector<PlacedByHand>& m_placed;
  MatchPlayer& m_player;
  std::size_t m_next = 0;
};

}  // namespace

struct RunPlayer::Recording {
  std::string path, program;
};

RunPlayer::RunPlayer(const Experiment& experiment, PlaySettings settings,
                     std::unique_ptr<Check> success)
    : m_experiment(&experiment), m_settings(std::move(settings)), m_success(std::move(success)) {}
RunPlayer::RunPlayer(RunPlayer&&) noexcept = default;
RunPlayer::~RunPlayer() = default;

Result<RunPlayer> RunPlayer::create(const Experiment& experiment, PlaySettings settings) {
  auto success = TRY(Check::parse(experiment.success, Check::Over::Run, metricsOf(experiment)));
  return RunPlayer(experiment, std::move(settings), std::make_unique<Check>(std::move(success)));
}

Result<RunResult> RunPlayer::play(std::size_t number) {
  return playOne(number, nullptr);
}

Result<RunResult> RunPlayer::record(std::size_t number, const std::string& path,
                                    const std::string& program) {
  const Recording recording{path, program};
  return playOne(number, &recording);
}

Result<RunResult> RunPlayer::playOne(std::size_t number, const Recording* recording) {
  const Experiment& e = *m_experiment;
  const RunPlace run = placeOf(e, number);
  const auto scenario = TRY(scenarioOf(e, run));
  MatchOptions options;
  options.cognition = e.separateProcesses ? Cognition::Separate : Cognition::Inline;
  options.robotProgram = m_settings.robotProgram;
  options.newBoards = true;
  options.process.keepsMemory = false;  // a run does not depend on another one
  const bool teamPrograms = e.conditions[run.condition].teamPrograms;
  options.speed = teamPrograms ? e.speed : MatchPlayer::unlimitedSpeed;
  auto match = TRY(SimulatedMatch::create(scenario, options));

  const auto begin = WallClock::now();
  MatchPlayer player(std::move(match));
  player.match().pace().setPlaying(MatchPlayer::unlimitedSpeed, false, begin);
  std::shared_ptr<MatchRecorder> recorder;
  if (recording) {
    telemetry::SessionWriterOptions writing;
    writing.waitWhenFull = true;
    writing.replace = m_settings.replace;
    auto writer = TRY(telemetry::SessionWriter::create(
        recording->path,
        sessionInfo(player.match(), recording->program, telemetry::LiveClock().now()), writing));
    const std::shared_ptr<telemetry::SessionWriter> shared = std::move(writer);
    attachMatch(*shared, player.match().scenario(), VariableCatalog::published());
    const auto every = std::make_shared<MatchSampler>();
    recorder = std::make_shared<MatchRecorder>(shared, every);
    player.observe(every);
    player.observe(recorder);
  }
  const auto rows = std::make_shared<LatestRows>();
  const double rate = scenario.settings.tickRate;
  const auto sampler = std::make_shared<MatchSampler>(
      rows, MatchSamplerOptions{std::max(1, static_cast<int>(std::lround(e.sampleEvery * rate)))});
  const auto tally = std::make_shared<RowTally>(scenario.settings.field);
  const auto counting = std::make_shared<MatchSampler>(
      tally, MatchSamplerOptions{std::max(1, static_cast<int>(std::lround(tallyStep * rate)))});
  const auto measure = std::make_shared<RunMeasure>(e, run, rows, tally);
  const auto rules = e.rules.empty() ? nullptr : std::make_shared<RuleCounter>(e.rules);
  if (rules) {
    player.observe(std::make_shared<MatchSampler>(rules->rows()));
    player.observe(rules);
  }
  player.observe(counting);
  player.observe(sampler);
  player.observe(measure);
  if (measure->problem()) return tl::unexpected(*measure->problem());

  std::optional<TeamPrograms> own;
  if (teamPrograms) own.emplace(player, e.speed);
  TRY(own ? own->begin(m_settings.cancelled) : Result<void>());
  const auto firstTick = player.currentTick();
  const auto first = WallClock::now();
  TRY(loop(player, *measure, run.condition, own ? &*own : nullptr));
  counting->ticked(player.match(), {});  // the last moment, whenever it is
  RunResult result =
      measure->result(player.match(), rules ? rules->finish() : std::vector<double>());
  std::vector<double> values;
  for (const Check::Name& name : m_success->names()) values.push_back(result.values[name.metric]);
  result.values[static_cast<std::size_t>(TeamValue::Success)] = m_success->holds(values);
  m_timesRealTime.reset();
  if (e.separateProcesses || own) {
    const double took = std::chrono::duration<double>(WallClock::now() - first).count();
    const auto ticks = static_cast<double>(player.currentTick() - firstTick);
    m_timesRealTime = ticks / rate / std::max(took, 1e-9);
  }
  if (e.hasTeamPrograms()) {
    result.values.push_back(own ? *m_timesRealTime : unknown);
    result.values.push_back(own ? own->keptUp() : unknown);
  }
  m_wall = std::chrono::duration<double>(WallClock::now() - begin).count();
  m_simulated = static_cast<double>(result.ticks) / rate;
  if (recorder) {
    TRY(recorder->finish());
  }
  player.lookAfterProcesses(WallClock::now());
  TRY(programsSurvived(player.match()));
  return result;
}

/// Until the run is over.
Result<void> RunPlayer::loop(MatchPlayer& player, const RunMeasure& measure, std::size_t condition,
                             TeamPrograms* own) {
  const Experiment& e = *m_experiment;
  Hand hand(e.conditions[condition].placed, player);
  auto looked = WallClock::now();
  const bool separate = !player.match().robots().processes().statuses().empty();
  while (measure.endedBy().empty() && !player.match().finished()) {
    TRY(hand.act());
    if (own) own->wait();
    player.tick();
    if (!own && player.currentTick() % ticksBetweenLooks != 0) continue;
    if (m_settings.cancelled && *m_settings.cancelled) {
      return failure(ErrorCode::Conflict, "cancelled");
    }
    if (own || !separate) continue;
    if (const auto now = WallClock::now(); now - looked >= timeBetweenLooks) {
      looked = now;
      player.lookAfterProcesses(now);
    }
  }
  return {};
}

std::string sessionPath(const std::string& folder, std::size_t number) {
  char name[40];
  std::snprintf(name, sizeof name, "run-%06zu.mcap", number);
  return (std::filesystem::path(folder) / sessionsFolder / name).string();
}

Result<RunResult> recordAgain(const std::string& folder, const Experiment& experiment,
                              std::size_t number, const std::string& path,
                              const PlaySettings& settings) {
  const auto before = TRY(resultOf(folder, experiment, number));
  std::error_code ignored;
  if (const auto parent = std::filesystem::path(path).parent_path(); !parent.empty()) {
    std::filesystem::create_directories(parent, ignored);
  }
  auto player = TRY(RunPlayer::create(experiment, settings));
  auto result = player.record(number, path, settings.program);
  if (!result || result->hash == before.hash || !before.match.repeatable) return result;
  TRY(markUnrepeatable(folder, experiment, number));
  return failure(
      ErrorCode::Conflict,
      "run " + std::to_string(number) +
          " ended in a different state than in the results, which say now that it is not "
          "repeatable; were they played by another version?",
      path);
}

std::optional<bool> isRunRepeatable(const std::string& session) {
  const std::filesystem::path file(session);
  const std::string folder = file.parent_path().parent_path().string();
  std::size_t number = 0;
  if (std::sscanf(file.filename().c_str(), "run-%zu.mcap", &number) != 1 ||
      file != std::filesystem::path(sessionPath(folder, number))) {
    return std::nullopt;
  }
  const auto experiment = experimentOf(folder);
  if (!experiment) return std::nullopt;
  const auto result = resultOf(folder, *experiment, number);
  return result ? std::optional(result->match.repeatable) : std::nullopt;
}

namespace {

/// Runs that cannot be played again are recorded while they are played, those that are wanted when
/// they have failed as well.
Result<RunResult> playAndKeep(RunPlayer& player, const Experiment& e, std::size_t number,
                              const PlaySettings& settings) {
  const bool mayBeWanted = isRecorded(e, number, true) || isRecorded(e, number, false);
  if (!e.conditions[placeOf(e, number).condition].teamPrograms || settings.folder.empty() ||
      !mayBeWanted)
    return player.play(number);
  const std::filesystem::path path = sessionPath(settings.folder, number);
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  std::filesystem::remove(path, ignored);  // of a run that was interrupted
  auto result = player.record(number, path.string(), settings.program);
  const bool wanted =
      result &&
      isRecorded(e, number, result->values[static_cast<std::size_t>(TeamValue::Success)] != 0.0);
  if (!wanted) std::filesystem::remove(path, ignored);
  return result;
}

}  // namespace

Result<void> playRuns(const Experiment& experiment, std::span<const std::size_t> numbers,
                      std::size_t jobs, const PlaySettings& settings,
                      const std::function<Result<void>(PlayedRun)>& take) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> over{false};
  std::mutex mutex;
  std::optional<Error> problem;
  const auto fail = [&](const Error& error) {  // with the mutex
    if (!problem) problem = error;
    over = true;
  };
  const auto isCancelled = [&settings] { return settings.cancelled && *settings.cancelled; };
  const auto work = [&] {
    auto player = RunPlayer::create(experiment, settings);
    if (!player) {
      const std::lock_guard lock(mutex);
      return fail(player.error());
    }
    while (!over && !isCancelled()) {
      const std::size_t mine = next++;
      if (mine >= numbers.size()) return;
      auto result = playAndKeep(*player, experiment, numbers[mine], settings);
      if (!result && isCancelled()) return;
      const std::lock_guard lock(mutex);
      if (!result) {
        Error error = result.error();
        error.context = "run " + std::to_string(numbers[mine]) +
                        (error.context.empty() ? "" : ": " + error.context);
        return fail(error);
      }
      if (over) return;
      auto taken = take({std::move(*result), player->wallSeconds(), player->simulatedSeconds(),
                         player->timesRealTime()});
      if (!taken) fail(taken.error());
    }
  };
  std::vector<std::thread> threads;
  const std::size_t count =
      std::clamp<std::size_t>(jobs, 1, std::max<std::size_t>(1, numbers.size()));
  threads.reserve(count);
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (problem) return tl::unexpected(*problem);
  return {};
}

}  // namespace pitchboard::link

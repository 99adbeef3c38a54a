// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A recording of a robot with hidden numbers, drawn from the prior of calibrate(), and what
// calibrate() says of it. For the program calibration_proof.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <base/angles.h>
#include <robotlink/calibrate/calibrate.h>
#include <robotlink/match/match_player.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/row_slot.h>
#include <robotlink/session/row_walk.h>
#include <simcore/world/parameters.h>
#include <telemetry/series/series_store.h>

namespace pitchboard::link {

struct CalibrationTrial {
  Calibration calibration;
  sim::RobotModel hidden;
  double rolling = 0.0;
  double squares = 0.0, squaresBase = 0.0;  ///< m², errors of predictions against the truth
  std::size_t windows = 0;
  double rms() const { return std::sqrt(squares / static_cast<double>(windows)); }
  double rmsBase() const { return std::sqrt(squaresBase / static_cast<double>(windows)); }
  /// The hidden number of a key.
  double truth(const std::string& key) const {
    const auto find = [&](const auto& parameters, const auto& values, const std::string& name) {
      for (const auto& parameter : parameters) {
        if (name == parameter.key) return values.*parameter.member;
      }
      return std::nan("");
    };
    if (key == "field.rolling_deceleration") return rolling;
    return key.starts_with("noise.") ? find(sim::noiseParameters, hidden.noise, key.substr(6))
                                     : find(sim::robotModelParameters, hidden, key);
  }
};

/// Draws every number of calibrationKeys() round the base model.
inline sim::RobotModel hiddenModel(const sim::RobotModel& base, std::uint64_t seed,
                                   double& rolling) {
  std::mt19937_64 random(seed * 7919 + 17);
  std::normal_distribution<double> normal;
  sim::RobotModel model = base;
  const auto within = [&](const auto& parameters, auto& values, const std::string& key,
                          double sigma, bool rate) {
    for (const auto& parameter : parameters) {
      if (key != parameter.key) continue;
      double& value = values.*parameter.member;
      if (rate) {
        constexpr double weight = 8.0;
        std::gamma_distribution<double> a(weight * value), b(weight * (1.0 - value));
        const double x = a(random), y = b(random);
        value = x / (x + y);
      } else {
        value *= std::exp(sigma * normal(random));
      }
    }
  };
  rolling = 0.3;
  for (const std::string& key : calibrationKeys()) {
    if (key == "field.rolling_deceleration") {
      rolling *= std::exp(0.35 * normal(random));
      continue;
    }
    const bool rate = key == "noise.landmark_probability" || key == "noise.missed_detection";
    if (key.starts_with("noise.")) {
      within(sim::noiseParameters, model.noise, key.substr(6), 0.7, rate);
    } else {
      const bool view = key == "field_of_view" || key == "vision_range";
      within(sim::robotModelParameters, model, key, view ? 0.25 : 0.35, false);
    }
  }
  model.kickContact = std::min(model.kickContact, model.kickTime - 0.02);
  return model;
}

struct RecordingOptions {
  int everyNth = 1;  ///< ticks per row
  /// Before each tick.
  std::function<void(SimulatedMatch&, std::uint64_t tick)> at;
};

/// Plays a scenario into memory.
inline Result<std::shared_ptr<telemetry::SeriesStore>> recorded(
    const Scenario& scenario, const RecordingOptions& recording = {}) {
  auto match = SimulatedMatch::create(scenario, {});
  if (!match) return tl::unexpected(match.error());
  telemetry::SeriesOptions options;
  options.memoryBudget = std::size_t{1} << 30;
  const auto rows = std::make_shared<telemetry::SeriesStore>(options);
  const auto sampler =
      std::make_shared<MatchSampler>(rows, MatchSamplerOptions{recording.everyNth});
  MatchPlayer player(std::move(*match));
  player.observe(sampler);
  while (!player.match().finished()) {
    if (recording.at) recording.at(player.match(), player.currentTick());
    player.tick();
  }
  player.stopObserving(sampler);
  return rows;
}

/// Adds the squared errors of the predictions of 5 s, by the truth that the rows of a session hold.
inline void comparePredictions(const telemetry::SeriesStore& rows, std::size_t session,
                               CalibrationTrial& trial) {
  std::vector<std::array<double, 3>> truth;
  forEachRow(rows, {-1e18, 1e18}, [&](auto, const telemetry::GroupInfo& group, const auto& row) {
    if (group.name != "B1") return;
    truth.push_back(
        {row.time, findSlot(group, {"TRUE_X"}).read(row), findSlot(group, {"TRUE_Y"}).read(row)});
  });
  const auto at = [&](double time) {
    const auto found = std::ranges::lower_bound(
        truth, time - 1e-6, {}, [](const std::array<double, 3>& one) { return one[0]; });
    return found == truth.end() ? truth.back() : *found;
  };
  for (const PredictedWindow& window : trial.calibration.check.windows) {
    if (window.session != session || window.places.empty()) continue;
    const auto& last = window.places.back();
    const auto& first = window.places.front();
    // The way since the first place, so that an error of the first place counts for neither.
    const auto begin = at(first.time), end = at(last.time);
    const double x = end[1] - begin[1] + first.recorded.x, y = end[2] - begin[2] + first.recorded.y;
    const auto square = [&](const Point& p) {
      return (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y);
    };
    trial.squares += square(last.calibrated);
    trial.squaresBase += square(last.base);
    ++trial.windows;
  }
}

/// A scenario that a trial records, and for how long (s); 0: as long as the scenario says.
struct TrialPart {
  std::string scenario;
  double seconds = 0.0;
};

/// A recording of each part, of the robot number `seed`. All other robots are of the base model.
inline Result<CalibrationTrial> playCalibrationTrial(std::uint64_t seed,
                                                     const std::vector<TrialPart>& parts) {
  const auto base = loadRobotModel("kid-size");
  if (!base) return tl::unexpected(base.error());
  CalibrationTrial trial;
  trial.hidden = hiddenModel(*base, seed, trial.rolling);
  std::vector<CalibrationLog> logs;
  std::vector<std::shared_ptr<telemetry::SeriesStore>> played;
  for (const auto& [name, seconds] : parts) {
    const auto asWritten = loadScenario(name);
    if (!asWritten) return tl::unexpected(asWritten.error());
    ScenarioOverrides overrides;
    overrides.noise = "robot";
    auto scenario = changed(*asWritten, overrides);
    if (!scenario) return tl::unexpected(scenario.error());
    // The noise of a tick depends on the seed alone: all recordings would have the same.
    scenario->settings.seed = seed + 1'000'000 * played.size();
    scenario->settings.field.surface.deceleration = trial.rolling;
    for (ScenarioRobot& robot : scenario->robots) robot.model = *base;
    scenario->robots.front().model = trial.hidden;
    if (seconds > 0.0) scenario->stop.duration = seconds;
    auto rows = recorded(*scenario);
    if (!rows) return tl::unexpected(rows.error());
    played.push_back(*rows);
    // Calibration knows the size of the field, not how the ball rolls on it.
    sim::FieldSpec field = scenario->settings.field;
    field.surface.deceleration = 0.3;
    auto log = readCalibrationLog(**rows, field, name, "B1");
    if (!log) return tl::unexpected(log.error());
    logs.push_back(std::move(*log));
  }
  auto calibration = calibrate(logs, *base);
  if (!calibration) return tl::unexpected(calibration.error());
  trial.calibration = std::move(*calibration);
  for (std::size_t i = 0; i < played.size(); ++i) comparePredictions(*played[i], i, trial);
  return trial;
}

/// The drill, and kicks for `kickSeconds` unless it is 0.
inline Result<CalibrationTrial> playCalibrationTrial(std::uint64_t seed,
                                                     double kickSeconds = 240.0) {
  std::vector<TrialPart> parts{{"calibration-drill"}};
  if (kickSeconds > 0.0) parts.push_back({"calibration-kicks", kickSeconds});
  return playCalibrationTrial(seed, parts);
}

/// Sums over trials.
class CalibrationTally {
 public:
  struct Row {
    int covered = 0, below = 0;
    double width = 0.0;
    /// Of every interval: by how many half-widths the truth is above the estimate, on the scale of
    /// logarithms; 1 is the end of the interval.
    std::vector<double> off;
    int estimated() const { return static_cast<int>(off.size()); }
    /// By which factor the intervals should have been wider to hold 95 % of the truths.
    double factor() const {
      std::vector<double> sizes;
      for (const double one : off) sizes.push_back(std::abs(one));
      std::ranges::sort(sizes);
      const auto rank = static_cast<std::size_t>(0.95 * static_cast<double>(sizes.size()));
      return sizes[std::min(rank, sizes.size() - 1)];
    }
    /// How often the truth was in each tenth of the posterior, taken as normal: even if it is
    /// right.
    std::string ranks() const {
      std::array<int, 10> counts{};
      for (const double one : off) {
        const double share = 0.5 * std::erfc(-1.96 * one / std::sqrt(2.0));
        ++counts[static_cast<std::size_t>(std::clamp(share * 10.0, 0.0, 9.0))];
      }
      std::string out;
      for (const int count : counts) out += (out.empty() ? "" : " ") + std::to_string(count);
      return out;
    }
  };
  void add(const CalibrationTrial& trial) {
    for (const CalibratedValue& value : trial.calibration.values) {
      const double truth = trial.truth(value.key);
      Row& row = m_rows[value.key];
      const double least = 1e-12;
      const double off = std::log(std::max(least, truth) / std::max(least, value.value));
      const double end = truth > value.value ? value.high : value.low;
      const double half = std::abs(std::log(std::max(least, end) / std::max(least, value.value)));
      row.off.push_back(off / std::max(least, half));
      if (truth >= value.low && truth <= value.high) ++row.covered;
      if (truth < value.low) ++row.below;
      row.width += 0.5 * (value.high - value.low) / std::max(least, value.value);
    }
    if (trial.windows > 0) {
      ++m_predicted;
      if (trial.rms() < trial.rmsBase()) ++m_better;
      m_rms += trial.rms();
      m_rmsBase += trial.rmsBase();
    }
  }
  int intervals() const {
    int sum = 0;
    for (const auto& [key, row] : m_rows) sum += row.estimated();
    return sum;
  }
  int covered() const {
    int sum = 0;
    for (const auto& [key, row] : m_rows) sum += row.covered;
    return sum;
  }
  int predicted() const { return m_predicted; }
  int better() const { return m_better; }

  void print() const {
    std::printf("%-28s %5s %8s %6s %6s %8s  %s\n", "key", "n", "covered", "below", "factor",
                "width", "ranks");
    for (const auto& [key, row] : m_rows) {
      std::printf("%-28s %5d %6.1f %% %6d %6.2f %6.2f %%  %s\n", key.c_str(), row.estimated(),
                  100.0 * row.covered / row.estimated(), row.below, row.factor(),
                  100.0 * row.width / row.estimated(), row.ranks().c_str());
    }
    std::printf("all: %d intervals, %.2f %% covered\n", intervals(),
                100.0 * covered() / std::max(1, intervals()));
    std::printf("prediction better in %d of %d; mean rms %.3f m, base %.3f m\n", m_better,
                m_predicted, m_rms / std::max(1, m_predicted),
                m_rmsBase / std::max(1, m_predicted));
    std::fflush(stdout);
  }

 private:
  int m_predicted = 0, m_better = 0;
  double m_rms = 0.0, m_rmsBase = 0.0;
  std::map<std::string, Row> m_rows;
};

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Recorded matches for tests of reruns. The main thread of a test.

#include <QTemporaryDir>
#include <QtTest>

#include <string>

#include <robotlink/match/match_player.h>
#include <robotlink/rerun/rerun.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/match_sampler.h>

namespace rerun_rig {

using namespace pitchboard;
using namespace pitchboard::link;

struct Recorded {
  Scenario scenario;
  double seconds = 20.0;
  int everyNth = 1;  ///< ticks per row
  MatchOptions options{};
};

/// Plays a match and records it; `change` is called before each tick.
inline std::string record(const QTemporaryDir& folder, const QString& name, const Recorded& how,
                          const std::function<void(MatchPlayer&)>& change = {}) {
  const std::string path = folder.filePath(name + ".mcap").toStdString();
  auto match = SimulatedMatch::create(how.scenario, how.options);
  if (!match) qFatal("%s", match.error().text().c_str());
  MatchPlayer player(std::move(*match));
  auto sampler = std::make_shared<MatchSampler>(nullptr, MatchSamplerOptions{how.everyNth});
  RecorderOptions options;
  options.writer.waitWhenFull = true;
  options.writer.sync = false;
  auto recorder =
      MatchRecorder::create(path, how.scenario, VariableCatalog::published(), sampler, options);
  if (!recorder) qFatal("%s", recorder.error().text().c_str());
  player.observe(sampler);
  player.observe(*recorder);
  const auto ticks = static_cast<std::uint64_t>(how.seconds * how.scenario.settings.tickRate);
  while (player.currentTick() < ticks) {
    if (change) change(player);
    player.tick();
  }
  player.stopObserving(*recorder);
  if (auto done = (*recorder)->finish(); !done) qFatal("%s", done.error().text().c_str());
  return path;
}

inline Scenario scenarioWith(const char* name, const char* noise, std::uint64_t seed = 7) {
  Scenario scenario = loadScenario(name).value();
  scenario.settings.noise = noisePreset(noise).value();
  scenario.settings.seed = seed;
  scenario.stop = {};
  return scenario;
}

inline telemetry::SessionReader opened(const std::string& path) {
  auto session = telemetry::SessionReader::open(path);
  if (!session) qFatal("%s", session.error().text().c_str());
  return std::move(*session);
}

inline RerunOptions optionsFor(const char* robot, std::vector<RerunProcess> processes) {
  RerunOptions options;
  options.robot = robot;
  options.processes = std::move(processes);
  return options;
}

/// The variables that differ, each with its first difference.
inline QString shown(const RerunResult& result) {
  QStringList lines;
  for (const ComparedVariable& one : result.variables) {
    if (one.unequal == 0) continue;
    lines << QString("%1: %2 of %3 values")
                 .arg(one.column.name.c_str())
                 .arg(one.unequal)
                 .arg(one.compared);
    if (!one.stretches.empty()) {
      lines.back() += QString(", at %1 ").arg(one.stretches[0].begin) +
                      QString::fromStdString(differenceText(one, one.stretches[0]));
    }
  }
  for (const std::string& note : result.notes) lines << QString::fromStdString(note);
  return lines.join('\n');
}

inline const ComparedVariable& variable(const RerunResult& result, const char* name) {
  for (const ComparedVariable& one : result.variables) {
    if (one.column.name == name) return one;
  }
  qFatal("%s is no output", name);
}

}  // namespace rerun_rig

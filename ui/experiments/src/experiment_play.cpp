// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment_play.h"

#include <QDir>
#include <algorithm>
#include <chrono>
#include <thread>

#include <robotlink/experiment/run_player.h>
#include <robotlink/processes/team_program.h>

namespace pitchboard::ui {
namespace {

using WallClock = std::chrono::steady_clock;
constexpr auto progressInterval = std::chrono::milliseconds(100);
constexpr int mostFolders = 100'000;

link::PlaySettings settingsWith(const std::atomic<bool>& cancelled) {
  return {link::besideTeamProgram("pitchboard-robot"), {}, {}, &cancelled};
}

/// "name-1", the first that is free.
QString newFolder(const QString& folders, const QString& name) {
  for (int i = 1; i < mostFolders; ++i) {
    QString path = QStringLiteral("%1/%2-%3").arg(folders, name).arg(i);
    if (!QDir(path).exists()) return path;
  }
  return folders + QLatin1Char('/') + name;
}

}  // namespace

ExperimentPlay::ExperimentPlay(QObject* parent) : QObject(parent) {}

ExperimentPlay::~ExperimentPlay() {
  m_cancelled = true;
  m_worker.waitForDone();
}

void ExperimentPlay::start(link::Experiment experiment, const QString& folders) {
  m_cancelled = false;
  m_playing = true;
  const QString folder = newFolder(folders, QString::fromStdString(experiment.name));
  m_worker.start([this, e = std::move(experiment), folder] { play(e, folder); });
}

void ExperimentPlay::cancel() {
  m_cancelled = true;
}

void ExperimentPlay::fail(const Error& error) {
  m_ui.post([this, sentence = QString::fromStdString(error.text())] {
    m_playing = false;
    emit failed(sentence);
  });
}

// In the worker's thread.
void ExperimentPlay::play(const link::Experiment& experiment, const QString& folder) {
  auto results = link::ExperimentFolder::begin(folder.toStdString(), experiment, false);
  if (!results) return fail(results.error());
  std::vector<std::size_t> numbers(experiment.allRuns());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i + 1;
  // In turn, so that a cancelled experiment has runs of every condition.
  std::ranges::stable_sort(numbers, {}, [&experiment](std::size_t number) {
    return link::placeOf(experiment, number).index;
  });
  link::PlaySettings settings = settingsWith(m_cancelled);
  settings.folder = folder.toStdString();
  settings.program = "pitchboard";
  const auto begin = WallClock::now();
  auto reported = begin;
  const auto played =
      link::playRuns(experiment, numbers, std::max(1U, std::thread::hardware_concurrency()),
                     settings, [&](const link::PlayedRun& run) -> Result<void> {
                       if (auto added = results->add(run.result, run.timesRealTime); !added)
                         return added;
                       const auto now = WallClock::now();
                       if (now - reported < progressInterval && !results->complete()) return {};
                       reported = now;
                       m_ui.post([this, done = results->finishedCount(), all = numbers.size(),
                                  seconds = std::chrono::duration<double>(now - begin).count()] {
                         emit progressed(done, all, seconds);
                       });
                       return {};
                     });
  if (!played) return fail(played.error());
  if (auto finished = results->finish(); !finished) return fail(finished.error());
  auto table = link::resultsOf(folder.toStdString(), experiment);
  if (!table) return fail(table.error());
  auto summary = link::summarize(experiment, *table);
  const PlayedPtr all = std::make_shared<PlayedExperiment>(
      PlayedExperiment{experiment, folder, std::move(*table), std::move(summary)});
  m_ui.post([this, all] {
    m_playing = false;
    emit ended(all);
  });
}

// In the worker's thread.
Result<QString> ExperimentPlay::recordOne(const PlayedExperiment& of, std::size_t number) {
  const QString path = QString::fromStdString(link::sessionPath(of.folder.toStdString(), number));
  if (QFileInfo::exists(path)) return path;
  link::PlaySettings settings = settingsWith(m_cancelled);
  settings.program = "pitchboard";
  const auto result = link::recordAgain(of.folder.toStdString(), of.experiment, number,
                                        path.toStdString(), settings);
  if (!result) return tl::unexpected(result.error());
  return path;
}

void ExperimentPlay::record(PlayedPtr of, std::vector<std::size_t> numbers) {
  m_cancelled = false;
  m_worker.start([this, of = std::move(of), numbers = std::move(numbers)] {
    QStringList sessions;
    for (const std::size_t number : numbers) {
      const auto path = recordOne(*of, number);
      if (!path) return fail(path.error());
      sessions << *path;
    }
    m_ui.post([this, sessions] { emit recorded(sessions); });
  });
}

}  // namespace pitchboard::ui

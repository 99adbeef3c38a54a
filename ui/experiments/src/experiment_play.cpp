// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment_play.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <algorithm>
#include <chrono>
#include <thread>

#include <robotlink/experiment/run_player.h>
#include <robotlink/processes/team_program.h>

namespace pitchboard::ui {
namespace {

using WallClock = std::chrono::steady_clock;
constexpr auto progressInterval = std::chrono::milliseconds(100);
constexpr int maxFolders = 100'000;

link::PlaySettings settingsWith(const std::atomic<bool>& cancelled) {
  link::PlaySettings settings;
  settings.robotProgram = link::besideTeamProgram("pitchboard-robot");
  settings.cancelled = &cancelled;
  return settings;
}

QString folderPath(const QString& folders, const QString& name, int number) {
  return QStringLiteral("%1/%2-%3").arg(folders, name).arg(number);
}

/// The number of the first folder "name-1", "name-2", … that is free.
int freeNumber(const QString& folders, const QString& name) {
  int number = 1;
  while (number < maxFolders && QDir(folderPath(folders, name, number)).exists()) ++number;
  return number;
}

}  // namespace

ExperimentPlay::ExperimentPlay(QObject* parent) : QObject(parent) {}

ExperimentPlay::~ExperimentPlay() {
  m_cancelled = true;
  m_worker.waitForDone();
}

void ExperimentPlay::start(link::Experiment experiment, const QString& folders) {
  const QString name = QString::fromStdString(experiment.name);
  const QString folder = folderPath(folders, name, freeNumber(folders, name));
  begin(std::move(experiment), folder, false);
}

void ExperimentPlay::resume(link::Experiment experiment, const QString& folder) {
  begin(std::move(experiment), folder, true);
}

void ExperimentPlay::begin(link::Experiment experiment, const QString& folder, bool resume) {
  m_cancelled = false;
  m_playing = true;
  m_worker.start([this, e = std::move(experiment), folder, resume] { play(e, folder, resume); });
}

QString ExperimentPlay::unfinished(const link::Experiment& experiment, const QString& folders) {
  const QString name = QString::fromStdString(experiment.name);
  const int number = freeNumber(folders, name) - 1;
  if (number < 1) return {};
  const QString folder = folderPath(folders, name, number);
  const auto file = [&folder](const char* part) {
    return QDir(folder).filePath(QLatin1String(part));
  };
  // The reports are written after the last run.
  if (!QFileInfo::exists(file(link::runsFile)) || QFileInfo::exists(file("report.html"))) return {};
  QFile known(file(link::experimentFile));
  if (!known.open(QIODevice::ReadOnly)) return {};
  return known.readAll() == QByteArray::fromStdString(experiment.text) ? folder : QString();
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
void ExperimentPlay::play(const link::Experiment& experiment, const QString& folder, bool resume) {
  auto results = link::ExperimentFolder::begin(folder.toStdString(), experiment, resume);
  if (!results) return fail(results.error());
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < experiment.allRuns(); ++i) {
    if (results->finished()[i] == 0) numbers.push_back(i + 1);
  }
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
                       m_ui.post([this, done = results->finishedCount(), all = experiment.allRuns(),
                                  asked = numbers.size(),
                                  seconds = std::chrono::duration<double>(now - begin).count()] {
                         emit progressed(done, all, seconds / double(done + asked - all));
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_scan.h"

#include <QDir>
#include <QElapsedTimer>
#include <QSet>
#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <telemetry/session/recording_files.h>

namespace pitchboard::ui {
namespace {

constexpr int reportMilliseconds = 150, keepMilliseconds = 10'000;
constexpr unsigned maxReaders = 4;

std::string indexPath(const QString& folder) {
  return (folder + QStringLiteral("/index.jsonl")).toStdString();
}

}  // namespace

struct LibraryScan::Found {
  std::vector<LibraryRowPtr> known;
  std::vector<std::pair<std::string, link::RecordingStamp>> unknown;
  QStringList problems;
};

/// What the threads that read have in common.
struct LibraryScan::Reading {
  std::mutex mutex;
  std::condition_variable ended;
  // Guarded by the mutex:
  std::size_t next = 0, done = 0, readers = 0;
  std::vector<LibraryRowPtr> rows;
};

LibraryScan::LibraryScan(QString folder, QObject* parent)
    : QObject(parent), m_folder(std::move(folder)) {}

LibraryScan::~LibraryScan() {
  ++m_job;
  m_worker.waitForDone();
}

void LibraryScan::start(const QStringList& folders) {
  const std::uint64_t job = ++m_job;
  m_isRunning = true;
  m_isCancelled = false;
  m_unknown = m_read = 0;
  m_worker.start([this, folders, job] { scan(folders, job); });
  emit changed();
}

void LibraryScan::cancel() {
  if (!m_isRunning) return;
  ++m_job;
  m_isRunning = false;
  m_isCancelled = true;
  emit changed();
}

void LibraryScan::post(std::uint64_t job, std::function<void()> call) {
  m_ui.post([this, job, call = std::move(call)] {
    if (job == m_job) call();
  });
}

// On the worker.
void LibraryScan::scan(const QStringList& folders, std::uint64_t job) {
  const auto goOn = [this, job] { return job == m_job; };
  if (!goOn()) return;
  if (!std::exchange(m_hasIndex, true)) {
    for (link::IndexedSession& session : link::readSessionIndex(indexPath(m_folder))) {
      const std::string path = session.path;
      m_known[path] = libraryRow(std::move(session));
    }
  }
  const Found found = find(folders, goOn);
  if (!goOn()) return;
  const bool hasVanished = found.known.size() < m_known.size();
  m_known.clear();
  for (const LibraryRowPtr& row : found.known) m_known[row->session.path] = row;
  post(job, [this, rows = found.known, unknown = found.unknown.size(), problems = found.problems] {
    m_unknown = unknown;
    m_problems = problems;
    emit listed(rows);
    emit changed();
  });
  readUnknown(found, job);
  if (hasVanished || !found.unknown.empty()) {
    keep();
    removeOldPictures();
  }
  post(job, [this] {
    m_isRunning = false;
    emit changed();
  });
}

LibraryScan::Found LibraryScan::find(const QStringList& folders,
                                     const std::function<bool()>& goOn) const {
  Found found;
  std::map<std::string, link::RecordingStamp> files;
  for (const QString& folder : folders) {
    const auto paths = telemetry::recordingsIn(folder.toStdString(), goOn);
    if (!paths) {
      // The folder for recordings is made with the first one.
      if (QDir(folder).exists()) found.problems << QString::fromStdString(paths.error().text());
      continue;
    }
    for (const std::string& path : *paths) {
      if (files.size() == maxSessions) {
        found.problems << QStringLiteral(
                              "Only %1 sessions are listed. Remove a folder to see the "
                              "others.")
                              .arg(maxSessions);
        break;
      }
      if (const auto stamp = link::stampOf(path)) files.try_emplace(path, *stamp);
    }
  }
  for (const auto& [path, stamp] : files) {
    const auto known = m_known.find(path);
    if (known != m_known.end() && known->second->session.stamp == stamp) {
      found.known.push_back(known->second);
    } else {
      found.unknown.emplace_back(path, stamp);
    }
  }
  return found;
}

void LibraryScan::readUnknown(const Found& found, std::uint64_t job) {
  const auto goOn = [this, job] { return job == m_job; };
  Reading reading;
  const auto take = [&]() -> std::optional<std::size_t> {
    const std::lock_guard lock(reading.mutex);
    if (goOn() && reading.next < found.unknown.size()) return reading.next++;
    return {};
  };
  const auto read = [&] {
    while (const auto at = take()) {
      const auto& [path, stamp] = found.unknown[*at];
      link::SessionOverview overview = link::overviewOf(path, goOn);
      if (!goOn()) break;
      LibraryRowPtr row = libraryRow({path, stamp, std::move(overview)});
      const std::lock_guard lock(reading.mutex);
      reading.rows.push_back(std::move(row));
      ++reading.done;
    }
    const std::lock_guard lock(reading.mutex);
    --reading.readers;
    reading.ended.notify_one();
  };
  QElapsedTimer sinceKeep;
  sinceKeep.start();
  const auto report = [&](std::vector<LibraryRowPtr> rows, std::size_t done) {
    for (const LibraryRowPtr& row : rows) m_known[row->session.path] = row;
    if (sinceKeep.elapsed() > keepMilliseconds) {
      keep();
      sinceKeep.start();
    }
    post(job, [this, rows = std::move(rows), done] {
      m_read = done;
      emit came(rows);
      emit changed();
    });
  };
  const std::size_t most = std::min<std::size_t>(
      {std::max(1U, std::thread::hardware_concurrency()), maxReaders, found.unknown.size()});
  reading.readers = most;
  std::vector<std::thread> readers;
  for (std::size_t i = 0; i < most; ++i) readers.emplace_back(read);
  bool isDone = most == 0;
  while (!isDone) {
    std::unique_lock lock(reading.mutex);
    isDone = reading.ended.wait_for(lock, std::chrono::milliseconds(reportMilliseconds),
                                    [&reading] { return reading.readers == 0; });
    std::vector<LibraryRowPtr> rows = std::exchange(reading.rows, {});
    const std::size_t done = reading.done;
    lock.unlock();
    report(std::move(rows), done);
  }
  for (std::thread& reader : readers) reader.join();
}

void LibraryScan::keep() const {
  if (!QDir().mkpath(m_folder)) return;
  std::vector<link::IndexedSession> sessions;
  sessions.reserve(m_known.size());
  for (const auto& [path, row] : m_known) sessions.push_back(row->session);
  // A list that could not be kept is made again at the next start.
  (void)link::writeSessionIndex(indexPath(m_folder), sessions);
}

void LibraryScan::removeOldPictures() const {
  QSet<QString> wanted;
  for (const auto& [path, row] : m_known) {
    for (const bool isDark : {false, true}) wanted.insert(pictureName(row->session, isDark));
  }
  QDir folder(m_folder);
  for (const QString& name : folder.entryList({QStringLiteral("*.png")}, QDir::Files)) {
    if (!wanted.contains(name)) folder.remove(name);
  }
}

}  // namespace pitchboard::ui

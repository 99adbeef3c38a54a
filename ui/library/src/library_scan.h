// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds the sessions of folders and reads what is not known of them yet, on threads of its own.
// What it knows is kept in an index file between starts; one that is damaged is made again. UI
// thread only.

#include <QObject>
#include <QStringList>
#include <atomic>
#include <map>
#include <memory>

#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

#include "library_row.h"

namespace pitchboard::ui {

class LibraryScan : public QObject {
  Q_OBJECT
 public:
  static constexpr std::size_t maxSessions = 50'000;  ///< further files are not listed

  /// `folder` is where the index and the pictures are kept; it is made when needed.
  LibraryScan(QString folder, QObject* parent);
  ~LibraryScan() override;  ///< cancels

  /// Looks at these folders again; a scan that runs ends.
  void start(const QStringList& folders);
  /// Stops reading; what was read is kept.
  void cancel();

  bool isRunning() const { return m_isRunning; }
  bool isCancelled() const { return m_isCancelled; }
  /// Sessions that were not known, and how many of them have been read.
  std::size_t unknown() const { return m_unknown; }
  std::size_t read() const { return m_read; }
  const QStringList& problems() const { return m_problems; }

 signals:
  /// All that is known of what the folders contain now.
  void listed(const std::vector<pitchboard::ui::LibraryRowPtr>& rows);
  /// These were read meanwhile.
  void came(const std::vector<pitchboard::ui::LibraryRowPtr>& rows);
  /// Progress, problems, or the end.
  void changed();

 private:
  using Known = std::map<std::string, LibraryRowPtr>;
  struct Found;
  struct Reading;

  void scan(const QStringList& folders, std::uint64_t job);
  Found find(const QStringList& folders, const std::function<bool()>& goOn) const;
  void readUnknown(const Found& found, std::uint64_t job);
  void keep() const;
  void removeOldPictures() const;
  void post(std::uint64_t job, std::function<void()> call);

  const QString m_folder;
  bool m_isRunning = false, m_isCancelled = false;
  std::size_t m_unknown = 0, m_read = 0;
  QStringList m_problems;
  std::atomic<std::uint64_t> m_job = 0;  // the scan that is wanted
  // Of the worker:
  Known m_known;
  bool m_hasIndex = false;
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

}  // namespace pitchboard::ui

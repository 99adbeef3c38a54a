// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Describes a stretch on a worker thread, one order at a time. UI thread only; owned by the panel.

#include <QObject>
#include <QString>
#include <QStringList>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <telemetry/query/stretch_table.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

namespace pitchboard::ui {

/// A session whose rows are described: a file, or rows in memory.
struct StretchSource {
  std::string name;  ///< in tables
  std::string path;  ///< of the file; empty: rows in memory
  std::shared_ptr<const telemetry::SeriesStore> rows = nullptr;
  std::vector<telemetry::SessionEvent> events = {};  ///< of rows in memory
  double offset = 0.0;  ///< s, time of its second 0 in the source that is shown
  int number = 0;       ///< of a compared session (session_mark.h); 0: the source that is shown
};

struct StretchOrder {
  std::vector<StretchSource> sources = {};
  telemetry::StretchQuestion question = {};
  /// s of the source that is shown; nothing: everything.
  std::optional<telemetry::TimeRange> range = {};
  /// Only from each event of the first kind to the next of the second.
  std::optional<std::pair<std::string, std::string>> between = {};
};

struct StretchResult {
  std::vector<telemetry::StretchLine> lines;  ///< times are those of their session
  std::vector<double> offsets;                ///< of each line's session, s
  std::vector<int> numbers;                   ///< of each line's session, as in StretchSource
  QStringList problems;
  bool isCompared = false;   ///< with another curve
  std::size_t sessions = 0;  ///< how many were described
  bool isEmpty() const { return lines.empty(); }
};

class StretchWork : public QObject {
  Q_OBJECT
 public:
  explicit StretchWork(QObject* parent);
  ~StretchWork() override;

  /// Starts; an order in progress is cancelled.
  void start(StretchOrder order);
  void cancel();
  bool isRunning() const { return m_running != nullptr; }
  /// Returns the progress of the order, 0 to 1.
  double progress() const { return m_progress; }
  /// Returns the result of the last order that was finished; null if there is none.
  const std::shared_ptr<const StretchResult>& result() const { return m_result; }
  /// Returns how long the last finished order took, in s.
  double duration() const { return m_duration; }

 signals:
  void progressed();
  void finished();

 private:
  using Flag = std::shared_ptr<std::atomic<bool>>;
  StretchResult describe(const StretchOrder& order, const Flag& cancelled);

  double m_progress = 0.0, m_duration = 0.0;
  std::shared_ptr<const StretchResult> m_result;
  Flag m_running;  // set to cancel it; null: none runs
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

}  // namespace pitchboard::ui

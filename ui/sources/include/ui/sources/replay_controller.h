// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A recorded session as a source. It shows and plays moments, and reads rows into memory for
// variables and plots while the first moment is already shown. UI thread only; files are read on
// worker threads.

#include <atomic>
#include <span>

#include <telemetry/session/drawn_notes.h>
#include <telemetry/session/session_types.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class ReplayPages;

class ReplayController : public FrameSource {
  Q_OBJECT
 public:
  explicit ReplayController(QObject* parent = nullptr);
  ~ReplayController() override;

  /// Opens a file; returns immediately. `opened` or `failed` follows; after a failure the previous
  /// session stays open. Calling open() again replaces a request that has not finished. If the file
  /// is a copy of a recording with more in it, such as a rerun, `recording` is the path of that.
  void open(const QString& path, const QString& recording = {});
  void close();
  bool isOpen() const { return m_file != nullptr; }
  bool isOpening() const { return m_opening; }
  const QString& path() const { return m_path; }
  /// Returns the recording that is shown: path(), or what that file is a copy of. It gives the
  /// session its name and has its bookmarks.
  QString recording() const;
  telemetry::SessionInfo info() const;
  /// Returns whether the file is truncated or damaged and can be repaired.
  bool isBroken() const;
  /// Returns whether the file was still being recorded when it was opened.
  bool isGrowing() const;
  /// Returns whether the file is a run of an experiment that would end differently if it were
  /// played again.
  bool isUnrepeatable() const;
  /// Returns the notes that were drawn on the recording when it was opened.
  std::span<const telemetry::DrawnNote> drawnNotes() const;
  /// Returns the scenario of the session as JSON; empty if it has none.
  std::string attachedScenario() const;
  /// Returns the groups of the file as soon as it is open, before series() has their rows.
  std::vector<telemetry::GroupInfo> groups() const;

  const SourceKind& kind() const override { return SourceKind::Replay; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override;
  QString emptyText() const override;
  FramePtr frameAt(double time) const override;
  std::optional<QDateTime> clock() const override;
  std::optional<telemetry::TimeRange> available() const override;
  double standsAt() const override { return m_time; }
  /// Shows the moment at this time, limited to available().
  void standAt(double time) override;

  /// Returns the share of rows in memory, 0 to 1; 1 if nothing is being read.
  double loaded() const { return m_loaded; }
  /// Keeps a bookmark, or its changed note, beside the file (session_notes.h). `notKept` follows if
  /// that fails.
  void keepBookmark(const link::MatchEvent& bookmark);
  /// Limits the memory for rows, in bytes. If a session does not fit, memory contains a coarse
  /// overview and the rows around the visible range; if the file has no overview (truncated, or
  /// older than 0.3), memory contains its end, and noted() says so.
  void setMemoryBudget(std::size_t bytes);

 signals:
  void opened();
  void failed(const QString& sentence);
  /// Another program recorded this file, so that it is not opened.
  void foreignFound(const QString& path);
  /// A bookmark could not be written, as a sentence.
  void notKept(const QString& sentence);
  /// Remarks about the file, such as parts that could not be read.
  void noted(const QStringList& sentences);
  /// Damage found while reading the rest of the file.
  void damageFound(const QStringList& sentences);
  void loadedChanged(double part);

 private:
  struct File;  // what is open
  void take(std::shared_ptr<File> file);
  void dropPages();
  void readMoment();
  void load();
  void page();
  void reportRecorded();
  void noteWhatDoesNotFit();

  std::shared_ptr<File> m_file;
  std::shared_ptr<ReplayPages> m_pages;  // null while all rows are in memory
  QString m_path;
  double m_time = 0.0;  // at which it stands
  FramePtr m_frame;
  bool m_opening = false;
  double m_loaded = 1.0;
  std::size_t m_budget = std::size_t{1} << 30;
  std::optional<double> m_wanted;  // the moment to be shown next
  bool m_reading = false;          // a worker reads a moment
  /// Of the file that is open or opening, and of the loading in progress.
  std::atomic<std::uint64_t> m_generation = 0, m_loading = 0;
  UiQueue m_toUi;
  Workers m_seeker, m_loader;  // one thread each: a reader belongs to one thread
};

}  // namespace pitchboard::ui

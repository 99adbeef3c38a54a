// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A recorded session as a source: shows its moments, plays, and reads its rows into memory for
// inspector and plots while the first moment is already on the screen. UI thread only; files are
// read on worker threads.

#include <atomic>

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

  /// Opens this file; returns at once. `opened` or `failed` follows; on failure what was open
  /// stays. Opening again supersedes.
  void open(const QString& path);
  void close();
  bool isOpen() const { return m_file != nullptr; }
  bool isOpening() const { return m_opening; }
  const QString& path() const { return m_path; }
  telemetry::SessionInfo info() const;
  /// The file broke off or is damaged: repair makes a whole one of it.
  bool isBroken() const;
  /// JSON text of what the session was played with; empty when it has none.
  std::string attachedScenario() const;
  /// What the file has rows of, from the moment it is open; series() gets them while it is read.
  std::vector<telemetry::GroupInfo> groups() const;

  SourceKind kind() const override { return SourceKind::Replay; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override;
  QString emptyText() const override;
  FramePtr frameAt(double time) const override;
  std::optional<QDateTime> clock() const override;
  Playback* playback() const override { return m_playback; }

  /// Part of the rows that are in memory, 0 to 1; 1 also when nothing is being read.
  double loaded() const { return m_loaded; }
  /// Bytes that rows may take. Of a session that does not fit, a coarse picture of everything and
  /// the rows around what is looked at are in memory; of one that has no such picture (it broke
  /// off, or is older than 0.3) the end is, and noted() says so.
  void setMemoryBudget(std::size_t bytes);

 signals:
  void opened();
  void failed(const QString& sentence);
  /// What the file has that could not be understood or is damaged, in sentences.
  void noted(const QStringList& sentences);
  /// Reading the rest of the file has met damage: what and where, in sentences.
  void damageFound(const QStringList& sentences);
  void loadedChanged(double part);

 private:
  struct File;  // what is open
  void take(std::shared_ptr<File> file);
  void dropPages();
  void wantMoment(double time);
  void readMoment();
  void load();
  void page();
  void tellRecorded();
  void noteWhatDoesNotFit();

  std::shared_ptr<File> m_file;
  std::shared_ptr<ReplayPages> m_pages;  // null while all rows are in memory
  QString m_path;
  Playback* m_playback;
  FramePtr m_frame;
  bool m_opening = false;
  double m_loaded = 1.0;
  std::size_t m_budget = std::size_t{1} << 30;
  std::optional<double> m_wanted;  // the moment to be shown next
  bool m_reading = false;          // a worker reads a moment
  /// Of the file that is open or opening, and of the loading that goes on.
  std::atomic<std::uint64_t> m_generation = 0, m_loading = 0;
  UiQueue m_toUi;
  Workers m_seeker, m_loader;  // one thread each: a reader belongs to one thread
};

}  // namespace pitchboard::ui

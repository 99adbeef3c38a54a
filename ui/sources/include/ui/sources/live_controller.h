// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The live match as a source. It owns the LiveWatch, which receives and decodes on its own threads,
// and passes on its frames, events and log entries. After start() it runs even while another source
// is shown. It sends nothing, except the monitor request if that is turned on. UI thread only.

#include <memory>

#include <robotlink/live/live_rows.h>
#include <robotlink/live/live_watch.h>
#include <robotlink/session/live_memory.h>
#include <robotlink/session/recorded_frame.h>
#include <ui/base/beat.h>
#include <ui/base/ui_queue.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class LiveController : public FrameSource {
  Q_OBJECT
 public:
  explicit LiveController(QObject* parent = nullptr);
  ~LiveController() override;

  /// Starts to listen; does nothing if it already listens.
  void start();
  /// Stops listening and forgets everything.
  void stop();
  bool isListening() const { return m_watch != nullptr; }

  const link::LiveOptions& options() const { return m_options; }
  /// Takes effect immediately; robots and counters are kept. If the options are not valid, emits
  /// `errorOccurred` and keeps the old ones.
  void setOptions(const link::LiveOptions& options);
  /// Sets our team by its number at the referee; 0: none.
  void setOurTeam(int number);
  /// Requests monitor mode from this referee; empty: from nobody.
  void setMonitor(std::optional<telemetry::Address> referee);
  /// Limits the memory for rows, in bytes; the oldest are dropped first.
  void setMemoryBudget(std::size_t bytes);
  /// Forgets robots, referee and counters, and continues to listen.
  void clear();
  /// Forgets a robot, or one of two programs that send the same number. Its curves are kept.
  void forget(RobotUid robot);

  const SourceKind& kind() const override { return SourceKind::Live; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return m_series; }
  QString emptyText() const override;
  /// Rebuilds the frame from the datagrams in memory.
  FramePtr frameAt(double time) const override;
  /// Null while it does not listen.
  std::shared_ptr<const link::LiveMemory> memory() const { return m_memory; }
  /// Returns the time of day at 0 s, in nanoseconds.
  telemetry::WallTime began() const;
  std::optional<QDateTime> clock() const override;

  /// Returns ports, senders and errors. They are copied, so do not call it for every frame.
  link::LiveDetails details() const;
  /// Returns text such as "UDP 1241–1256".
  QString portsText() const;
  void observe(std::shared_ptr<link::LiveObserver> observer);
  void stopObserving(const std::shared_ptr<link::LiveObserver>& observer);

 signals:
  void optionsChanged();
  void errorOccurred(const QString& sentence);

 private:
  void deliver();
  void keepRows();

  UiQueue m_toUi;
  link::LiveOptions m_options;
  std::vector<std::shared_ptr<link::LiveObserver>> m_observers;
  std::unique_ptr<link::LiveWatch> m_watch;
  FramePtr m_frame;
  std::unique_ptr<Beat::Part> m_news, m_rowNews;
  std::size_t m_memoryBudget = std::size_t{1} << 30;
  std::shared_ptr<link::LiveMemory> m_memory;
  std::unique_ptr<link::LiveMoments> m_moments;
  std::unique_ptr<link::RecordedFrames> m_boardFrames;
  std::shared_ptr<telemetry::SeriesStore> m_series;
};

}  // namespace pitchboard::ui

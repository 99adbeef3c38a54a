// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio's hold on the live match: owns the watch (which receives and decodes on threads of its
// own) and hands its frames, events and log lines on as values. It runs from start() on, also while
// another source is shown. It sends nothing but the monitor request, when that is turned on. UI
// thread only.

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

  /// Begins to listen; does nothing when it already does.
  void start();
  /// Forgets everything and listens no more.
  void stop();
  bool isListening() const { return m_watch != nullptr; }

  const link::LiveOptions& options() const { return m_options; }
  /// Takes effect at once; robots and counters stay. Options that are not valid are refused with
  /// `errorOccurred`, and the old ones stay.
  void setOptions(const link::LiveOptions& options);
  /// The referee's number of our team; 0: none.
  void setOurTeam(int number);
  /// Asks this referee for monitor mode, or nobody any more.
  void setMonitor(std::optional<telemetry::Address> referee);
  /// Bytes that rows may take; the oldest leave first.
  void setMemoryBudget(std::size_t bytes);
  /// Forgets robots, referee and counters, and goes on listening.
  void clear();
  /// Forgets one robot, or one of two programs that send its number; its curves stay.
  void forget(const RobotKey& robot);

  SourceKind kind() const override { return SourceKind::Live; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return m_series; }
  QString emptyText() const override;
  /// Made again from the datagrams that are kept.
  FramePtr frameAt(double time) const override;
  /// Null while nothing is listened to.
  std::shared_ptr<const link::LiveMemory> memory() const { return m_memory; }
  /// The time of day at 0 s, to the nanosecond.
  telemetry::WallTime began() const;
  std::optional<QDateTime> clock() const override;

  /// Ports, senders, errors: copied from the watch, so not for every frame.
  link::LiveDetails details() const;
  /// "UDP 1241–1256".
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
  std::unique_ptr<Beat::Part> m_news;
  std::size_t m_memoryBudget = std::size_t{1} << 30;
  std::shared_ptr<link::LiveMemory> m_memory;
  std::unique_ptr<link::LiveMoments> m_moments;
  std::unique_ptr<link::RecordedFrames> m_boardFrames;
  std::shared_ptr<telemetry::SeriesStore> m_series;
};

}  // namespace pitchboard::ui

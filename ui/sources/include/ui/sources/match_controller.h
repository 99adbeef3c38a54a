// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The simulated match as a source. It opens and closes matches, plays, pauses and steps them, and
// passes on frames, events and log entries in the next beat of the display. Edits by the user are
// in MatchEdits, the recorded past in MatchMemory; the controller owns both. UI thread only.
// Matches are started and ended on a worker thread; no function blocks, except where it says that
// it waits for the tick in progress.

#include <QObject>
#include <QString>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <robotlink/match/match_runner.h>
#include <ui/base/beat.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/event_filter.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class MatchEdits;
class MatchMemory;
struct RetiredMatch;

/// An order that is carried out on the match's thread between two ticks. The other two functions
/// are called on the UI thread afterwards, unless another match has been opened.
struct MatchOrder {
  QString whatFailed;  ///< first part of the message in errorOccurred; the reason follows
  std::function<Result<void>(link::SimulatedMatch&)> carryOut;
  std::function<void()> onFailure = {};
  std::function<void()> onSuccess = {};
  link::Changed changes = link::Changed::Yes;  ///< whether a success changes the match
};

enum class Trouble {
  Refused,  ///< a request failed; the notice disappears with the next successful one
  Lasting   ///< the match does not play as requested, or not at all
};

class MatchController : public FrameSource {
  Q_OBJECT
 public:
  explicit MatchController(link::MatchOptions options, QObject* parent = nullptr);
  ~MatchController() override;

  MatchEdits* edits() const { return m_edits; }
  MatchMemory* memory() const { return m_memory; }

  /// Ends the running match and starts this one on a worker thread; returns immediately. Until
  /// `opened` is emitted, isOpening() is true and there is no frame; orders reach the new match,
  /// and edits that can be undone are ignored. Calling open() again replaces a match that has not
  /// been started yet. After a failure there is no match, and whyNotOpened() returns the reason. If
  /// separate processes are not possible (a key is in use), processes run inside the studio, and
  /// `errorOccurred` says so.
  void open(const link::Scenario& scenario, bool paused = false);
  /// The same for MatchEdits::replaceMatch(): returns the previous match as it is now. `between`
  /// runs on the worker thread after the old match has ended and before the new one is made. Waits
  /// for the tick in progress.
  std::shared_ptr<RetiredMatch> replace(const link::Scenario& scenario, bool paused,
                                        std::function<void()> between = {});
  /// Continues a match that replace() returned. It has its rows and events if it was the last one
  /// replaced. Returns the match that was played until now.
  std::shared_ptr<RetiredMatch> bringBack(const std::shared_ptr<RetiredMatch>& retired);
  /// Ends the match, its processes and blackboards on the worker thread. restart() plays it again.
  void close();
  bool isOpen() const { return m_runner != nullptr; }
  bool isOpening() const { return m_opening; }
  /// Returns the scenario with which the match was opened.
  const link::Scenario& scenario() const { return m_scenario; }
  /// Returns the scenario that restart() plays: from the beginning, with what was set up by hand.
  link::Scenario beginning() const;
  const SourceKind& kind() const override { return SourceKind::Simulate; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override;
  QString emptyText() const override;
  /// Returns why the last match could not be started; empty while there is a match.
  const QString& whyNotOpened() const { return m_whyNotOpened; }
  FramePtr frameAt(double time) const override;
  /// Returns where the robots' processes run: as requested, or Inline if that was not possible.
  link::Cognition cognition() const { return m_cognition; }
  /// Returns the options of the next match.
  const link::MatchOptions& options() const { return m_options; }
  // For the next match: where the robots' processes run, and its number on this computer (empty:
  // the next free one).
  void setCognition(link::Cognition where) { m_options.cognition = where; }
  void setMatchNumber(std::optional<int> number) { m_options.match = number; }
  /// Sets the catalog of the blackboards from the next match on; the default is the published one.
  void setCatalog(std::shared_ptr<const link::VariableCatalog> catalog);
  const link::VariableCatalog& nextCatalog() const { return *m_nextCatalog; }
  /// Returns the catalog of the match that is open or being opened.
  const link::VariableCatalog& catalog() const { return *m_catalog; }

  // Transport.
  void setPaused(bool paused);
  void stepOnce();
  /// Plays as fast as possible up to this tick, then pauses; for repeatable pictures.
  void runTo(std::uint64_t tick);
  // Play as fast as possible until the next kick-off, or the next event that passes the filter, for
  // at most 20 minutes of the match; then continue as before.
  void skipToKickOff();
  void skipToEvent(const EventFilter& shown);
  /// link::MatchRunner::unlimitedSpeed means as fast as possible. If a program's profile asks for
  /// real time and the speed is not ×1, emits `askedForSpeed` instead and waits for answerSpeed().
  void setSpeed(double timesRealTime);
  /// What to do with programs that use real time when the speed is not ×1.
  enum class RealTimePrograms { RestartWithMatchTime, LeaveBehind };
  void answerSpeed(double timesRealTime, RealTimePrograms what);
  double speed() const { return m_speed; }
  /// Sets how separate reference processes keep time at ×1, now and in later matches.
  void setPace(link::RobotsPace pace);
  link::RobotsPace pace() const { return m_options.pace; }
  /// Sets whether the match slows down for team programs that cannot keep up.
  void setWaitForTeamPrograms(bool on);
  bool waitsForTeamPrograms() const { return m_options.waitForTeamPrograms; }
  bool isPaused() const { return m_paused; }
  /// Plays beginning(), which can be undone. Does nothing if MatchEdits::allowsChange() is false.
  /// See replace() for `between`.
  void restart(std::function<void()> between = {});

  // Orders to the match, or to the one that is being opened. For changes by the user, call
  // MatchEdits::order() instead, which refuses them while the past is shown.
  void post(link::MatchRunner::Command command);
  /// After a failure, calls `onFailure` and emits errorOccurred.
  void post(MatchOrder order);
  /// Adds an observer of all ticks until stopObserving() or `ending`. Returns false without a
  /// match.
  bool observe(const std::shared_ptr<link::TickObserver>& observer);
  /// Waits for the tick in progress.
  void stopObserving(const std::shared_ptr<link::TickObserver>& observer);

  /// Returns the current moment as a scenario. Waits for the tick in progress.
  link::Scenario currentMoment();
  /// Waits for the tick in progress and passes on its frame, events and log entries.
  void settle();
  /// Returns the hash of the simulation's state. Waits for the tick in progress.
  std::uint64_t stateHash();

 signals:
  void ending();  ///< the match is about to end; last chance for its observers
  /// Emitted before `ending` if the match may come back. Receivers add what they keep of it.
  void retiring(pitchboard::ui::RetiredMatch& match);
  /// A match was brought back with the rows and events that it had.
  void broughtBack(const pitchboard::ui::RetiredMatch& match);
  /// Emitted while another match is prepared. Receivers may add observers, which see all of it.
  void preparing(std::vector<std::shared_ptr<pitchboard::link::TickObserver>>& observers);
  void scenarioChanged();   ///< another match is being opened, or none; `restarted` follows
  void opened();            ///< the match has been started, or could not be
  void transportChanged();  ///< paused, speed, or whether there is a match
  /// These programs use real time and cannot follow this speed; see answerSpeed().
  void askedForSpeed(const QStringList& programs, double timesRealTime);
  void errorOccurred(const QString& sentence, pitchboard::ui::Trouble trouble = Trouble::Lasting);
  void obeyed();  ///< an order succeeded, the first one after a failure

 private:
  struct Opening;  ///< what the worker made
  void poll();
  void openAfter(const link::Scenario& scenario, bool paused, std::function<void()> between,
                 const std::shared_ptr<RetiredMatch>& from = {});
  std::shared_ptr<RetiredMatch> remember();
  /// Forgets the match; the worker ends it.
  std::shared_ptr<link::MatchRunner> retire();
  void take(Opening& opening);
  void refuse(const QString& sentence);
  /// Reports once in a match which programs do not follow its pauses and speed.
  void warnAboutRealTimePrograms();
  QStringList realTimePrograms() const;
  void changeSpeed(double timesRealTime);
  void skip(std::function<bool(const link::MatchEvent&)> wanted);
  void reportRealTimePrograms(std::span<const link::MatchEvent> events);

  link::MatchOptions m_options, m_openedWith;
  std::shared_ptr<RetiredMatch> m_lastRetired;  // the one that keeps its rows
  link::Cognition m_cognition = link::Cognition::Inline;
  link::Scenario m_scenario, m_beginning;
  std::shared_ptr<const link::VariableCatalog> m_nextCatalog, m_catalog;
  std::shared_ptr<link::MatchRunner> m_runner;  // keeps its catalog
  FramePtr m_frame;
  QString m_whyNotOpened;
  double m_speed = 1.0;
  bool m_paused = false;
  bool m_opening = false;
  bool m_warnedAboutRealTime = false;
  std::optional<std::uint64_t> m_runTo;  // once it is open
  std::vector<link::MatchRunner::Command> m_whenOpen;
  std::atomic<std::uint64_t> m_generation = 0;  // of the match; grows with every open() and close()
  UiQueue m_toUi;
  Workers m_worker;                     // one thread: matches end and start in order
  std::atomic<bool> m_refused = false;  // by the last order
  std::unique_ptr<Beat::Part> m_news;
  MatchEdits* m_edits;
  MatchMemory* m_memory;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio's hold on the match being simulated: opens and ends it, plays, pauses and steps it,
// takes what is new in the next beat of the display, and hands frames, events and log lines to
// docks and field as values. What is done to it by hand is MatchEdits, what is kept of it
// MatchMemory; both end with it. UI thread only. Matches are made and ended on a worker thread;
// only currentMoment() and stateHash() wait, for the tick in progress.

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

/// What is carried out on the match's thread between two ticks, and what follows from it in the
/// window, unless another match was opened meanwhile.
struct MatchOrder {
  QString whatFailed;  ///< stands before the reason in errorOccurred
  std::function<Result<void>(link::SimulatedMatch&)> carryOut;
  std::function<void()> onFailure = {};
  std::function<void()> onSuccess = {};
  link::Changed changes = link::Changed::Yes;  ///< when it is carried out
};

enum class Trouble {
  Refused,  ///< something was asked for and not done; over with the next thing that is done
  Lasting   ///< the match plays otherwise than asked for, or not at all
};

class MatchController : public FrameSource {
  Q_OBJECT
 public:
  explicit MatchController(link::MatchOptions options, QObject* parent = nullptr);
  ~MatchController() override;

  MatchEdits* edits() const { return m_edits; }
  MatchMemory* memory() const { return m_memory; }

  /// Ends the running match and starts this one, both on a worker thread: returns at once. Until
  /// `opened` there is no frame and isOpening() holds; orders given meanwhile reach the new match,
  /// edits that can be undone are ignored. Opening again supersedes what was not started yet.
  /// On failure the old match is gone and whyNotOpened() tells why. When separate processes cannot
  /// be had (a key is in use), the match plays with inline processes on heap blackboards and
  /// `errorOccurred` says so.
  void open(const link::Scenario& scenario, bool paused = false);
  /// The same, for MatchEdits::replaceMatch(): returns the match that was played, as it is now.
  /// `between` runs on the worker thread when the old match is gone and the new one is not made
  /// yet. Waits for the tick in progress.
  std::shared_ptr<RetiredMatch> replace(const link::Scenario& scenario, bool paused,
                                        std::function<void()> between = {});
  /// The match goes on where replace() took it, with its rows and events, as long as it is the one
  /// that was replaced last. Returns the match that was played until now.
  std::shared_ptr<RetiredMatch> bringBack(const std::shared_ptr<RetiredMatch>& retired);
  /// Ends the match; its processes and blackboards go, on the worker thread. restart() plays it
  /// again.
  void close();
  bool isOpen() const { return m_runner != nullptr; }
  bool isOpening() const { return m_opening; }
  /// What this match was opened with.
  const link::Scenario& scenario() const { return m_scenario; }
  /// What restart() plays: the scenario from its beginning, with the physics model chosen since.
  link::Scenario beginning() const;
  SourceKind kind() const override { return SourceKind::Simulate; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override;
  QString emptyText() const override;
  /// Why the match that was asked for last could not be made; empty while there is one.
  const QString& whyNotOpened() const { return m_whyNotOpened; }
  FramePtr frameAt(double time) const override;
  /// Where the robots' processes run: as asked for, or Inline when that was not possible.
  link::Cognition cognition() const { return m_cognition; }
  /// What the next match is made with.
  const link::MatchOptions& options() const { return m_options; }
  /// For the next match: where the robots' processes run, and its number on this computer (nothing:
  /// the next free one).
  void setCognition(link::Cognition where) { m_options.cognition = where; }
  void setMatchNumber(std::optional<int> number) { m_options.match = number; }
  /// Names of the blackboards' words, for the next match on; the published ones at first.
  void setCatalog(std::shared_ptr<const link::VariableCatalog> catalog);
  const link::VariableCatalog& nextCatalog() const { return *m_nextCatalog; }
  /// Those of the match that is open or being opened.
  const link::VariableCatalog& catalog() const { return *m_catalog; }

  // Transport.
  void setPaused(bool paused);
  void stepOnce();
  /// Plays at full speed up to this tick of the match, then pauses; for repeatable pictures.
  void runTo(std::uint64_t tick);
  /// Plays at full speed until the ball may be kicked off next, or an event that the filter shows,
  /// for 20 minutes of the match at most; then it goes on as before.
  void skipToKickOff();
  void skipToEvent(const EventFilter& shown);
  /// link::MatchRunner::unlimitedSpeed = maximum. Not at once if a program keeps real time because
  /// its profile asks for it, and the speed is not ×1: then `askedForSpeed` follows, and
  /// answerSpeed().
  void setSpeed(double timesRealTime);
  /// What becomes of programs that keep real time at another speed than ×1.
  enum class RealTimePrograms { RestartWithMatchTime, LeaveBehind };
  void answerSpeed(double timesRealTime, RealTimePrograms what);
  double speed() const { return m_speed; }
  /// How separate reference processes keep time at ×1, from now on and in later matches.
  void setPace(link::RobotsPace pace);
  link::RobotsPace pace() const { return m_options.pace; }
  /// Whether the match slows down to what a team's own programs manage.
  void setWaitForTeamPrograms(bool on);
  bool waitsForTeamPrograms() const { return m_options.waitForTeamPrograms; }
  bool isPaused() const { return m_paused; }
  /// Plays beginning(), which can be undone. Refused as an edit is (MatchEdits::allowsChange()).
  /// `between`: see replace().
  void restart(std::function<void()> between = {});

  // Orders to the match, or to the one that is being opened. A change by hand goes through
  // MatchEdits::order() instead, which refuses it while the past is shown.
  void post(link::MatchRunner::Command command);
  /// A failure is told by errorOccurred, after `onFailure` has run.
  void post(MatchOrder order);
  /// Sees every tick from now on, until stopObserving() or `ending`. False: there is no match.
  bool observe(std::shared_ptr<link::TickObserver> observer);
  /// Waits for the tick in progress.
  void stopObserving(const std::shared_ptr<link::TickObserver>& observer);

  /// The present moment as a scenario, for saving. Waits for the tick in progress.
  link::Scenario currentMoment();
  /// Waits for the tick in progress and passes on its frame, events and log lines: a match that is
  /// paused then has nothing more to tell.
  void settle();
  /// Hash of the simulation's state at the present tick. Waits for the tick in progress.
  std::uint64_t stateHash();

 signals:
  void ending();  ///< the match goes now: its observers see it for the last time
  /// It may come back: whoever keeps something of it adds it. Before `ending`.
  void retiring(pitchboard::ui::RetiredMatch& match);
  void scenarioChanged();   ///< another match is being opened, or none; `restarted` follows
  void opened();            ///< it is there, or failed
  void transportChanged();  ///< paused, speed, or whether there is a match
  /// These programs keep real time: they cannot go at this speed as they are.
  void askedForSpeed(const QStringList& programs, double timesRealTime);
  void errorOccurred(const QString& sentence, pitchboard::ui::Trouble trouble = Trouble::Lasting);
  void obeyed();  ///< an order was carried out, the first one after a refusal

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
  /// Says once in a match which robots do not stop or hurry with it.
  void tellWhoWillNotFollow();
  QStringList realTimePrograms() const;
  void changeSpeed(double timesRealTime);
  void skip(std::function<bool(const link::MatchEvent&)> wanted);
  void tellWhoKeepsRealTime(std::span<const link::MatchEvent> events);

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
  bool m_toldWhoWillNotFollow = false;
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

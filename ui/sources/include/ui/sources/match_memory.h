// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is kept of the match being simulated: rows of its variables, exact states of the recent
// past, and frames rebuilt from them. Belongs to the MatchController and ends with it. UI thread
// only; the match's thread writes rows and states.

#include <QObject>
#include <cstddef>
#include <memory>
#include <vector>

#include <robotlink/match/moment.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/state_archive.h>
#include <ui/sources/match_controller.h>

namespace pitchboard::link {
class MatchSampler;
}
namespace pitchboard::telemetry {
class RowSink;
}

namespace pitchboard::ui {

class MatchRows;

/// What a match leaves behind when it goes on from an earlier moment.
struct MatchBranch {
  double from = 0.0;  ///< where it was left, s
  std::shared_ptr<const telemetry::SeriesStore> rows;
  std::size_t bytes = 0;                 ///< of rows that the match has no more
  std::vector<link::MatchEvent> events;  ///< later than `from`, as the timeline had them
};

class MatchMemory : public QObject {
  Q_OBJECT
 public:
  explicit MatchMemory(MatchController* match);
  ~MatchMemory() override;

  /// What of a match can be kept while another one is played.
  struct Kept {
    std::shared_ptr<MatchRows> rows;
    std::shared_ptr<link::MatchSampler> sampler;
    std::shared_ptr<link::StateArchive> archive;
    std::shared_ptr<link::DrawingMemory> drawings;
  };

  // The controller: another match is being made, or one comes back with what was kept of it, or
  // there is none.
  void begin(Kept kept);
  void forget();
  const Kept& kept() const { return m_kept; }
  /// Emits `continuedWithout` when processes of the robots begin anew at this moment. `where` they
  /// run.
  void tellWhatIsLost(const link::Moment& moment, link::Cognition where);
  /// What has to watch the match from its first tick, for its rows and states.
  std::vector<std::shared_ptr<link::TickObserver>> observers() const;

  std::shared_ptr<const telemetry::SeriesStore> series() const;
  /// Rebuilt from the rows; null when they do not hold that time (s).
  FramePtr frameAt(double time) const;
  /// Bytes that the rows of a match may take; the oldest leave first. At once and for matches to
  /// come.
  void setMemoryBudget(std::size_t bytes);
  std::size_t memoryBudget() const { return m_budget; }
  /// Rows are kept of every n-th tick (1: each), from now on. Waits for the tick in progress.
  void setSampling(int everyNth);
  int sampling() const { return m_everyNth; }
  /// Of the match that is open: whoever wants its rows is added to it, on the match's thread.
  std::shared_ptr<link::MatchSampler> sampler() const { return m_kept.sampler; }
  /// Where other blackboards of this computer are sampled to: others after the controller's
  /// `restarted`; null while there is no match.
  std::shared_ptr<telemetry::RowSink> rowsBeside() const;
  /// The match's time for these rows, s; any thread.
  std::function<double()> timeBeside() const;
  /// The exact states of the recent past; another one after `restarted`, null while there is no
  /// match.
  std::shared_ptr<const link::StateArchive> archive() const { return m_kept.archive; }
  /// What programs have drawn in the recent past; as archive().
  std::shared_ptr<const link::LiveHistory> drawn() const;
  /// Puts the match back to this moment (s) exactly, with what the processes inside it remembered,
  /// pauses, and forgets what came after it and what could be undone. `branching`, the controller's
  /// `rewound` and `branched` follow, or its `errorOccurred` when memory does not hold the moment
  /// any more.
  void continueFrom(double time);

 signals:
  void failed(const QString& sentence);
  /// The match goes on, but not with all that its robots knew: what is lost.
  void continuedWithout(const QString& sentence);
  /// Whoever keeps something of the future that is left adds it. Before `rewound`.
  void branching(pitchboard::ui::MatchBranch& left);
  void branched(const pitchboard::ui::MatchBranch& left);

 private:
  MatchController* m_match;
  std::size_t m_budget = std::size_t{1} << 30;
  int m_everyNth = 1;
  Kept m_kept;
  mutable link::DrawingMoments m_drawn;
  mutable std::unique_ptr<link::RecordedFrames> m_past;  // rebuilds frames; made when asked for
};

}  // namespace pitchboard::ui

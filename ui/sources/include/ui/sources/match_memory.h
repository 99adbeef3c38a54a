// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The recorded past of the simulated match: rows of its variables, exact states of the recent past,
// and frames rebuilt from rows. Owned by MatchController. UI thread only; the match's thread writes
// rows and states.

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

/// What a match leaves behind when it continues from an earlier moment.
struct MatchBranch {
  double from = 0.0;  ///< s, the moment from which the match continues
  std::shared_ptr<const telemetry::SeriesStore> rows;
  std::size_t bytes = 0;                 ///< size of rows that only the branch has
  std::vector<link::MatchEvent> events;  ///< events of the timeline after `from`
};

class MatchMemory : public QObject {
  Q_OBJECT
 public:
  explicit MatchMemory(MatchController* match);
  ~MatchMemory() override;

  /// What can be kept of a match while another one is played.
  struct Kept {
    std::shared_ptr<MatchRows> rows;
    std::shared_ptr<link::MatchSampler> sampler;
    std::shared_ptr<link::StateArchive> archive;
    std::shared_ptr<link::DrawingMemory> drawings;
    /// Of each robot, with the times (s) from which on it had them.
    struct Thinking {
      double from = 0.0;
      std::string behaviour;
      std::vector<std::string> programs;
    };
    std::map<RobotUid, std::vector<Thinking>> thinking;
  };

  // Called by the controller when a match is made or comes back, and when there is none.
  void begin(Kept kept);
  void forget();
  const Kept& kept() const { return m_kept; }
  /// Emits `continuedWithout` if processes of the robots lose their memory at this moment. `where`
  /// is where they run.
  void reportLosses(const link::Moment& moment, link::Cognition where);
  /// Returns the observers that have to see the match from its first tick.
  std::vector<std::shared_ptr<link::TickObserver>> observers() const;

  std::shared_ptr<const telemetry::SeriesStore> series() const;
  /// Returns the frame at this time (s), rebuilt from rows; null if they do not reach back so far.
  FramePtr frameAt(double time) const;
  /// Limits the memory for the rows of this and later matches, in bytes; the oldest rows are
  /// dropped first.
  void setMemoryBudget(std::size_t bytes);
  std::size_t memoryBudget() const { return m_budget; }
  /// Samples every n-th tick from now on. Waits for the tick in progress.
  void setSampling(int everyNth);
  int sampling() const { return m_everyNth; }
  /// Returns the sampler of the open match, to which others can be added on the match's thread.
  std::shared_ptr<link::MatchSampler> sampler() const { return m_kept.sampler; }
  /// Returns where to write rows of attached blackboards; null without a match. It is another
  /// object after the controller's `restarted`.
  std::shared_ptr<telemetry::RowSink> rowsBeside() const;
  /// Returns a function for the match's time (s) of these rows, which any thread may call.
  std::function<double()> timeBeside() const;
  /// Returns the exact states of the recent past; null without a match. It is another object after
  /// `restarted`.
  std::shared_ptr<const link::StateArchive> archive() const { return m_kept.archive; }
  /// Returns what programs have drawn in the recent past; see archive().
  std::shared_ptr<const link::LiveHistory> drawn() const;
  /// Restores the exact state of this time (s), including what processes inside the studio
  /// remember, and pauses. Drops the later past and the undo stack. `branching`, the controller's
  /// `rewound` and `branched` follow; or its `errorOccurred` if the state is no longer in memory.
  void continueFrom(double time);

 signals:
  void failed(const QString& sentence);
  /// The match continues from `time` (s), but its robots have lost what `sentence` says.
  void continuedWithout(const QString& sentence, double time);
  /// Emitted before `rewound`. Receivers add what they keep of the abandoned future.
  void branching(pitchboard::ui::MatchBranch& left);
  void branched(const pitchboard::ui::MatchBranch& left);

 private:
  void noteThinking(const link::MatchFrame& frame);

  MatchController* m_match;
  std::size_t m_budget = std::size_t{1} << 30;
  int m_everyNth = 1;
  Kept m_kept;
  mutable link::DrawingMoments m_drawn;
  mutable std::unique_ptr<link::RecordedFrames> m_past;  // rebuilds frames; made when asked for
};

}  // namespace pitchboard::ui

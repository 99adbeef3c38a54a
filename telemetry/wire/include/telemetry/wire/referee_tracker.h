// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which of the referee packets that arrive is the one to show, and what robots reply to it.

#include <cstdint>
#include <optional>
#include <vector>

#include <telemetry/wire/datagram.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::telemetry {

/// Follows one referee. Controllers of 2014-2016 send an old v7 packet beside each v8 or v9 one,
/// and a second controller may run by mistake: while the shown source is fresh, lower versions and
/// other senders are counted and not shown, so that the display does not flicker. Not thread-safe.
class RefereeTracker {
 public:
  struct Options {
    Duration hold = std::chrono::seconds(3);      ///< a source silent for so long may be replaced
    Duration timeout = std::chrono::seconds(10);  ///< the referee counts as gone
    int version = 0;                              ///< the only one to be shown; 0: the highest
  };
  struct Counts {
    std::uint64_t shown = 0;
    std::uint64_t compatibility = 0;   ///< lower versions beside a higher one
    std::uint64_t otherSenders = 0;    ///< a second controller
    std::uint64_t otherVersions = 0;   ///< not the one that was chosen
    std::uint64_t trueData = 0;        ///< RGTD
    std::uint64_t lost = 0;            ///< gaps of the packet number
    std::uint64_t replies = 0;         ///< of robots
    std::uint64_t refusedReplies = 0;  ///< of more robots than are kept
  };
  /// What a robot told the referee last.
  struct Reply {
    RobotReply reply;
    Address robot;
    WallTime time{};
  };
  static constexpr std::size_t maxReplies = 64;

  RefereeTracker();
  explicit RefereeTracker(Options options);

  /// True when the packet became the shown state. True data (RGTD) never does.
  bool accept(const RefereeState& state, const Sender& sender, WallTime time);

  /// A robot's reply that came from, or of, this address.
  void accept(const RobotReply& reply, Address robot, WallTime time);
  /// From the next packet on; another version is a new beginning.
  void setOptions(Options options);

  /// The last shown state; empty before the first.
  const std::optional<RefereeState>& state() const { return m_state; }
  /// The last true data, which only a monitor receives.
  const std::optional<RefereeState>& trueData() const { return m_trueData; }
  WallTime trueDataTime() const { return m_trueDataTime; }
  /// The last reply of each robot, by team and player.
  const std::vector<Reply>& replies() const { return m_replies; }
  std::optional<Sender> sender() const;
  /// Time since the shown state arrived; empty before the first, never negative.
  std::optional<Duration> age(WallTime now) const;
  bool timedOut(WallTime now) const;
  /// A second controller was heard within the hold time.
  bool conflict(WallTime now) const;
  const Counts& counts() const { return m_counts; }

 private:
  void countLoss(const RefereeState& next);

  Options m_options;
  std::optional<RefereeState> m_state, m_trueData;
  Sender m_sender;
  WallTime m_time{}, m_trueDataTime{};
  std::vector<Reply> m_replies;
  std::optional<WallTime> m_otherSender;
  Counts m_counts;
};

}  // namespace pitchboard::telemetry

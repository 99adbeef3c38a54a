// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Chooses which of the arriving referee packets is shown, and keeps the replies of robots.

#include <cstdint>
#include <optional>
#include <vector>

#include <telemetry/wire/datagram.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::telemetry {

/// Follows one referee. Controllers of 2014 to 2016 send an old packet of version 7 beside each one
/// of version 8 or 9, and a second controller may run by mistake. While the shown source is fresh,
/// lower versions and other senders are counted but not shown. Plain value; not thread-safe.
class RefereeTracker {
 public:
  struct Options {
    Duration hold =
        std::chrono::seconds(3);  ///< a source that sent nothing for this time may be replaced
    Duration timeout = std::chrono::seconds(10);  ///< after this time the referee counts as offline
    int version = 0;                              ///< show only this version; 0: the highest
  };
  struct Counts {
    std::uint64_t shown = 0;
    std::uint64_t compatibility = 0;   ///< packets of lower versions
    std::uint64_t otherSenders = 0;    ///< packets of a second controller
    std::uint64_t otherVersions = 0;   ///< packets of versions that were not chosen
    std::uint64_t trueData = 0;        ///< packets with true data (RGTD)
    std::uint64_t lost = 0;            ///< gaps of the packet number
    std::uint64_t replies = 0;         ///< replies of robots
    std::uint64_t refusedReplies = 0;  ///< replies of more robots than are kept
  };
  /// The last reply of a robot to the referee.
  struct Reply {
    RobotReply reply;
    Address robot;
    WallTime time{};
  };
  static constexpr std::size_t maxReplies = 64;

  RefereeTracker();
  explicit RefereeTracker(Options options);

  /// Takes a packet. Returns true if it became the shown state; true data (RGTD) never does.
  bool accept(const RefereeState& state, const Sender& sender, WallTime time);

  /// Takes a robot's reply. The address is the robot's, also if a referee forwarded the reply.
  void accept(const RobotReply& reply, Address robot, WallTime time);
  /// Changes the options from the next packet on. Another version starts over.
  void setOptions(Options options);

  /// Returns the shown state; empty before the first packet.
  const std::optional<RefereeState>& state() const { return m_state; }
  /// Returns the last true data, which only monitors receive.
  const std::optional<RefereeState>& trueData() const { return m_trueData; }
  WallTime trueDataTime() const { return m_trueDataTime; }
  /// Returns the last reply of each robot, by team and player.
  const std::vector<Reply>& replies() const { return m_replies; }
  std::optional<Sender> sender() const;
  /// Returns the time since the shown state arrived; never negative, empty before the first packet.
  std::optional<Duration> age(WallTime now) const;
  bool timedOut(WallTime now) const;
  /// Returns whether a second controller sent a packet within the hold time.
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Chooses which of the arriving referee packets is shown, and keeps the replies of robots.

#include <cstdint>
#include <optional>
#include <vector>

#include <telemetry/referee/gamecontroller.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// Follows one referee. Controllers of 2014 to 2016 send an old packet of version 7 beside each one
/// of version 8 or 9, and a second controller may run by mistake. While the shown source is fresh,
/// lower versions and other senders are counted but not shown, and neither are packets that arrive
/// after a newer one of the same program (the same broadcast over cable and Wi-Fi). A program that
/// was started again may count from any number: it is recognized by its new source port, by a
/// number that is far off, by a silence, or because nothing newer comes for a while. Plain value;
/// not thread-safe.
class RefereeTracker {
 public:
  struct Options {
    Duration hold =
        std::chrono::seconds(3);  ///< a source that sent nothing for this time may be replaced
    Duration timeout = std::chrono::seconds(10);  ///< after this time the referee counts as offline
    int version = 0;                              ///< show only this version; 0: the highest
    /// Lower numbers that come for this time, and nothing newer, are a program started again.
    Duration restart = std::chrono::seconds(1);
    /// A simulated referee is shown until the first packet of a real one, and never again.
    bool prefersReal = false;
  };
  /// A packet is late if its number is at most this far below that of the shown one.
  static constexpr int maxLate = 20;
  /// What became of a packet.
  enum class Verdict : std::uint8_t {
    Shown,          ///< it is the shown state now
    Repeated,       ///< equals the shown packet, whose age begins anew
    Late,           ///< older than the shown packet
    Compatibility,  ///< of a lower version
    OtherSender,    ///< of a second controller
    Simulated,      ///< of a simulated referee, and a real one was received
    OtherVersion,   ///< of a version that was not chosen
    TrueData        ///< true data (RGTD), which are never shown
  };
  struct Counts {
    std::uint64_t shown = 0;
    std::uint64_t repeated = 0;
    std::uint64_t late = 0;            ///< packets that arrived after a newer one
    std::uint64_t compatibility = 0;   ///< packets of lower versions
    std::uint64_t otherSenders = 0;    ///< packets of a second controller
    std::uint64_t simulated = 0;       ///< packets of a simulated referee beside a real one
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

  Verdict accept(const RefereeState& state, const Sender& sender, WallTime time);

  /// Takes a robot's reply. The address is the robot's, also if a referee forwarded the reply.
  void accept(const RobotReply& reply, Address robot, WallTime time);
  /// Changes the options from the next packet on. Another version starts over.
  void setOptions(Options options);

  /// Returns the shown state; empty before the first packet.
  const std::optional<RefereeState>& state() const { return m_state; }
  /// Returns what it says of the game; empty before the first packet.
  const std::optional<Game>& game() const { return m_game; }
  /// Returns the game of the last true data, which only monitors receive.
  const std::optional<Game>& trueGame() const { return m_trueGame; }
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
  /// Returns when the first of the late packets arrived that nothing newer has followed yet.
  const std::optional<WallTime>& lateSince() const { return m_lateSince; }

 private:
  std::optional<Verdict> refuse(const RefereeState& state, const Sender& sender, WallTime time);
  void countLoss(const RefereeState& next);

  Options m_options;
  std::optional<RefereeState> m_state;
  std::optional<Game> m_game, m_trueGame;
  Sender m_sender;
  WallTime m_time{}, m_trueDataTime{};
  std::vector<Reply> m_replies;
  std::optional<WallTime> m_otherSender, m_lateSince;
  std::uint16_t m_formerPort = 0;  // of the program that ran before; 0: none
  WallTime m_portSince{};
  Counts m_counts;
};

}  // namespace pitchboard::telemetry

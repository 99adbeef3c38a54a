// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/referee/referee_tracker.h>

#include <algorithm>
#include <tuple>

namespace pitchboard::telemetry {

RefereeTracker::RefereeTracker() : RefereeTracker(Options{}) {}
RefereeTracker::RefereeTracker(Options options) : m_options(options) {}

RefereeTracker::Verdict RefereeTracker::accept(const RefereeState& state, const Sender& sender,
                                               WallTime time) {
  if (state.trueData()) {
    ++m_counts.trueData;
    m_trueGame = gameOf(state);
    m_trueDataTime = time;
    return Verdict::TrueData;
  }
  if (m_options.version != 0 && state.version != m_options.version) {
    ++m_counts.otherVersions;
    return Verdict::OtherVersion;
  }
  const bool isOtherKind = m_options.prefersReal && m_state &&
                           isSimulated(sender.address) != isSimulated(m_sender.address);
  if (isOtherKind && isSimulated(sender.address)) {
    ++m_counts.simulated;
    return Verdict::Simulated;
  }
  if (m_state && !isOtherKind && time - m_time < m_options.hold) {
    if (const auto refused = refuse(state, sender, time)) return *refused;
  } else {
    m_formerPort = 0;
  }
  m_lateSince.reset();
  m_state = state;
  m_game = gameOf(state);
  m_sender = sender;
  m_time = time;
  ++m_counts.shown;
  return Verdict::Shown;
}

/// Beside a fresh state: returns why the packet is not shown, or nothing if it is.
std::optional<RefereeTracker::Verdict> RefereeTracker::refuse(const RefereeState& state,
                                                              const Sender& sender, WallTime time) {
  // One controller sends its two versions from two sockets: only the address tells controllers
  // apart.
  if (sender.address != m_sender.address) {
    ++m_counts.otherSenders;
    m_otherSender = time;
    return Verdict::OtherSender;
  }
  if (state.version < m_state->version) {
    ++m_counts.compatibility;
    return Verdict::Compatibility;
  }
  if (state.version > m_state->version) return std::nullopt;
  if (sender.port != m_sender.port) {
    if (sender.port != m_formerPort) {
      m_formerPort = m_sender.port;
      m_portSince = time;
      return std::nullopt;
    }
    if (time - m_portSince < m_options.restart) {
      ++m_counts.late;
      return Verdict::Late;
    }
    // It has not ended: two programs of one computer.
    ++m_counts.otherSenders;
    m_otherSender = time;
    return Verdict::OtherSender;
  }
  if (!state.packetNumber || !m_state->packetNumber) return std::nullopt;
  // Other content with the same number is new: not every program counts each packet.
  if (state == *m_state) {
    ++m_counts.repeated;
    m_time = time;
    m_lateSince.reset();
    return Verdict::Repeated;
  }
  const int behind = (*m_state->packetNumber - *state.packetNumber) & 0xff;
  if (behind >= 1 && behind <= maxLate) {
    if (!m_lateSince) m_lateSince = time;
    if (time - *m_lateSince < m_options.restart) {
      ++m_counts.late;
      return Verdict::Late;
    }
    return std::nullopt;
  }
  countLoss(state);
  return std::nullopt;
}

void RefereeTracker::accept(const RobotReply& reply, Address robot, WallTime time) {
  ++m_counts.replies;
  const auto place = std::lower_bound(m_replies.begin(), m_replies.end(), reply,
                                      [](const Reply& known, const RobotReply& wanted) {
                                        return std::tie(known.reply.team, known.reply.player) <
                                               std::tie(wanted.team, wanted.player);
                                      });
  if (place != m_replies.end() && place->reply.team == reply.team &&
      place->reply.player == reply.player) {
    *place = {reply, robot, time};
  } else if (m_replies.size() < maxReplies) {
    m_replies.insert(place, {reply, robot, time});
  } else {
    ++m_counts.refusedReplies;
  }
}

void RefereeTracker::setOptions(Options options) {
  if (options.version != m_options.version) {
    m_state.reset();
    m_game.reset();
  }
  m_options = options;
}

void RefereeTracker::countLoss(const RefereeState& next) {
  const int gap = (*next.packetNumber - *m_state->packetNumber) & 0xff;
  // Half a turn of the counter or more is a restarted controller, not a hundred lost packets.
  if (gap > 1 && gap < 128) m_counts.lost += static_cast<std::uint64_t>(gap - 1);
}

std::optional<Sender> RefereeTracker::sender() const {
  if (!m_state) return std::nullopt;
  return m_sender;
}

std::optional<Duration> RefereeTracker::age(WallTime now) const {
  if (!m_state) return std::nullopt;
  return std::max(now - m_time, Duration::zero());
}

bool RefereeTracker::timedOut(WallTime now) const {
  const auto since = age(now);
  return since && *since >= m_options.timeout;
}

bool RefereeTracker::conflict(WallTime now) const {
  return m_otherSender && now - *m_otherSender < m_options.hold;
}

}  // namespace pitchboard::telemetry

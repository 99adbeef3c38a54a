// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/referee_tracker.h>

#include <algorithm>
#include <tuple>

namespace pitchboard::telemetry {

RefereeTracker::RefereeTracker() : RefereeTracker(Options{}) {}
RefereeTracker::RefereeTracker(Options options) : m_options(options) {}

bool RefereeTracker::accept(const RefereeState& state, const Sender& sender, WallTime time) {
  if (state.trueData()) {
    ++m_counts.trueData;
    m_trueData = state;
    m_trueDataTime = time;
    return false;
  }
  if (m_options.version != 0 && state.version != m_options.version) {
    ++m_counts.otherVersions;
    return false;
  }
  const bool fresh = m_state && time - m_time < m_options.hold;
  // One controller sends its two versions from two sockets: only the address tells controllers
  // apart.
  if (fresh && sender.address != m_sender.address) {
    ++m_counts.otherSenders;
    m_otherSender = time;
    return false;
  }
  if (fresh && state.version < m_state->version) {
    ++m_counts.compatibility;
    return false;
  }
  if (fresh) countLoss(state);
  m_state = state;
  m_sender = sender;
  m_time = time;
  ++m_counts.shown;
  return true;
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
  if (options.version != m_options.version) m_state.reset();
  m_options = options;
}

void RefereeTracker::countLoss(const RefereeState& next) {
  if (next.version != m_state->version || !next.packetNumber || !m_state->packetNumber) return;
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_replay.h"

#include <base/try.h>

namespace pitchboard::ui {
namespace {

constexpr double farAhead = 5.0;  // s: more than plays between two looks at the highest speed

}  // namespace

Result<std::shared_ptr<SharedReplay>> SharedReplay::open(const std::string& path) {
  auto session = TRY(telemetry::SessionReader::open(path));
  if (!session.range()) return failure(ErrorCode::NotFound, "The recording is empty.", path);
  // Not make_shared: its constructor is private.
  return std::shared_ptr<SharedReplay>(new SharedReplay(std::move(session)));
}

Result<std::shared_ptr<telemetry::FoxgloveServer>> SharedReplay::listen(
    telemetry::FoxgloveServerOptions options) {
  const telemetry::TimeRange range = *m_session.range();
  options.playback = {m_session.logTime(range.begin), m_session.logTime(range.end)};
  m_server = TRY(telemetry::FoxgloveServer::start(options));
  return m_server;
}

void SharedReplay::follow(const Moment& moment,
                          const std::vector<telemetry::FoxglovePlaybackControl>& asked) {
  if (!m_served) m_served.emplace(m_session, *m_server);
  const bool jumps =
      !m_told || moment.time < m_served->time() || moment.time > m_served->time() + farAhead;
  if (jumps) {
    m_served->show(moment.time);
  } else if (moment.time > m_served->time()) {
    m_served->playTo(moment.time, [this] { return !m_isCancelled; });
  }
  for (const auto& one : asked) tell(moment, jumps || one.seek, one.requestId);
  const bool isTold = m_told && m_told->plays == moment.plays && m_told->speed == moment.speed;
  if (asked.empty() && (jumps || !isTold)) tell(moment, jumps, {});
}

void SharedReplay::tell(const Moment& moment, bool didSeek, const std::string& requestId) {
  telemetry::FoxglovePlaybackState state = m_served->playback(moment.plays, moment.speed);
  state.didSeek = didSeek;
  state.requestId = requestId;
  m_server->setPlayback(state);
  m_told = moment;
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/live_moments.h>

#include <array>
#include <cmath>

#include <robotlink/live/live_state.h>

namespace pitchboard::link {
namespace {

using telemetry::SessionStream;
using telemetry::WallTime;

constexpr std::array snapshotsOnly{SessionStream::LiveState};
constexpr std::array everything{SessionStream::Telemetry, SessionStream::RefereeRaw,
                                SessionStream::LiveState};
constexpr double defaultStep = 20.0;  // s; a snapshot is kept every 15
constexpr double lateness = 2.0;      // s; what was kept later may have come so much earlier
constexpr double farAway = 1e9;       // s; no source lasts so long
constexpr double tolerance = 5e-10;   // s; files keep whole nanoseconds

telemetry::Duration duration(double seconds) {
  constexpr double nanoseconds = 1e9, most = 9e18;
  return telemetry::Duration(
      static_cast<std::int64_t>(std::clamp(std::round(seconds * nanoseconds), -most, most)));
}

WallTime at(double seconds) {
  return WallTime(duration(seconds));
}

}  // namespace

void SessionHistory::walk(std::span<const SessionStream> streams, telemetry::TimeRange range,
                          const std::function<bool(const LiveRecord&)>& visit) const {
  LiveRecord record;
  m_session.messages(streams, range, [&](SessionStream stream, double time, std::string_view json) {
    record.stream = stream;
    record.time = time;
    if (stream == SessionStream::Telemetry || stream == SessionStream::RefereeRaw) {
      auto datagram = telemetry::sessionDatagram(json);
      if (!datagram) return true;
      record.datagram = std::move(*datagram);
    } else {
      record.json = json;
    }
    return visit(record);
  });
}

double SessionHistory::begin() const {
  const auto range = m_session.range();
  return range ? range->begin : 0.0;
}

struct LiveMoments::Impl {
  std::optional<LiveState::Read> known;
  double time = 0.0;  // of `known`

  void take(const LiveRecord& record) {
    if (record.stream == SessionStream::LiveState) {
      if (auto read = LiveState::read(record.json, WallTime{})) known = std::move(*read);
      return;
    }
    if (!known) return;
    const telemetry::SessionDatagram& kept = record.datagram;
    const telemetry::DatagramView datagram{at(kept.time), kept.sender, kept.localPort, false,
                                           kept.payload};
    if (record.stream == SessionStream::Telemetry) {
      (void)known->state.takeRobot(datagram, kept.time);
    } else if (const auto packet = telemetry::decodeReferee(kept.payload)) {
      known->state.takeReferee(*packet, datagram);
    }
  }
};

LiveMoments::LiveMoments() : m_impl(std::make_unique<Impl>()) {}
LiveMoments::~LiveMoments() = default;

bool LiveMoments::goTo(const LiveHistory& history, double time) {
  Impl& impl = *m_impl;
  // What a file has of this moment may be rounded to just after it.
  const double until = time + tolerance;
  if (impl.known && time >= impl.time && time - impl.time <= defaultStep) {
    const double before = impl.time + tolerance;
    history.walk(everything, {before, until}, [&](const LiveRecord& record) {
      if (record.time > before && record.time <= until) impl.take(record);
      return true;
    });
    impl.time = time;
    return true;
  }
  std::optional<double> start;
  for (double reach = defaultStep; !start; reach *= 8.0) {
    history.walk(snapshotsOnly, {time - reach, until}, [&](const LiveRecord& record) {
      if (record.time <= until) start = record.time;
      return true;
    });
    if (time - reach < history.begin()) break;
  }
  impl.known.reset();
  bool begun = false;
  if (!start) {
    if (time < history.begin()) return false;
    // They were lost with a part of the file: who is received from its beginning on is shown, as
    // the next ones say what the datagrams mean.
    history.walk(snapshotsOnly, {until, farAway}, [&](const auto& record) {
      impl.take(record);
      return !impl.known;
    });
    if (!impl.known) return false;
    impl.known->state.clear(impl.known->options);
    start = history.begin();
    begun = true;
  }
  history.walk(everything, {*start - lateness, until}, [&](const LiveRecord& record) {
    begun = begun || (record.stream == SessionStream::LiveState &&
                      std::abs(record.time - *start) <= tolerance);
    if (begun && record.time <= until) impl.take(record);
    return true;
  });
  impl.time = time;
  return impl.known.has_value();
}

std::optional<MatchFrame> LiveMoments::frameAt(const LiveHistory& history, double time) {
  if (!goTo(history, time)) return {};
  LiveState::Read& now = *m_impl->known;
  MatchFrame frame = now.state.frame(now.options, now.state.monitor.status(at(time)), time);
  frame.origin = FrameOrigin::Recorded;
  frame.paused = true;
  return frame;
}

std::optional<std::string> LiveMoments::snapshotAt(const LiveHistory& history, double time) {
  if (!goTo(history, time)) return {};
  return m_impl->known->state.text(m_impl->known->options, time, WallTime{});
}

std::vector<std::pair<SessionStream, std::string>> openingAt(
    const telemetry::SessionReader& session, double time) {
  const auto range = session.range();
  if (session.count(SessionStream::LiveState) == 0 || !range || time <= range->begin) return {};
  LiveMoments moments;
  auto state = moments.snapshotAt(SessionHistory(session), time);
  if (!state) return {};
  return {{SessionStream::LiveState, std::move(*state)}};
}

}  // namespace pitchboard::link

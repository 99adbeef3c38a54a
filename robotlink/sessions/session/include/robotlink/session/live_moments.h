// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rebuilds moments of a live match as they were shown, from a LiveState and the datagrams that
// followed, wherever these are kept. Times are seconds of the source.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

/// A record of a live match: a datagram, or a JSON message.
struct LiveRecord {
  telemetry::SessionStream stream = telemetry::SessionStream::Telemetry;
  double time = 0.0;
  telemetry::SessionDatagram datagram;  ///< for Telemetry and RefereeRaw
  std::string json;                     ///< for other streams
};

/// Where records are kept. One thread at a time, unless a class says otherwise.
class LiveHistory {
 public:
  virtual ~LiveHistory() = default;
  /// Visits the records of these streams in the closed range, in the order in which they were kept,
  /// until the visitor returns false.
  virtual void walk(std::span<const telemetry::SessionStream> streams, telemetry::TimeRange range,
                    const std::function<bool(const LiveRecord&)>& visit) const = 0;
  /// Returns the time of the oldest record.
  virtual double begin() const = 0;
};

/// The records of a session file. The reader belongs to the caller and must outlive this.
class SessionHistory : public LiveHistory {
 public:
  explicit SessionHistory(const telemetry::SessionReader& session) : m_session(session) {}
  void walk(std::span<const telemetry::SessionStream> streams, telemetry::TimeRange range,
            const std::function<bool(const LiveRecord&)>& visit) const override;
  double begin() const override;

 private:
  const telemetry::SessionReader& m_session;
};

/// Returns the messages with which a part of a live session must begin, so that its moments are
/// those of the session (telemetry::ExportSelection); nothing for other sessions.
std::vector<std::pair<telemetry::SessionStream, std::string>> openingAt(
    const telemetry::SessionReader& session, double time);

/// Rebuilds moments of one history; fast if they follow each other. One thread at a time.
class LiveMoments {
 public:
  LiveMoments();
  ~LiveMoments();

  /// Returns the frame of this moment, with the origin Recorded and serial 0. Nothing before the
  /// first state.
  std::optional<MatchFrame> frameAt(const LiveHistory& history, double time);
  /// Returns the state of this moment, as LiveState::text().
  std::optional<std::string> snapshotAt(const LiveHistory& history, double time);

 private:
  struct Impl;
  bool goTo(const LiveHistory& history, double time);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::link

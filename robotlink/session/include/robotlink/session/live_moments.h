// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Moments of a live match as they were seen: made again from the datagrams, on top of what was
// known before them (LiveState), wherever both are kept. Times are seconds of the source.

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

/// Something that was kept of a live match: a datagram, or a message that is JSON.
struct LiveRecord {
  telemetry::SessionStream stream = telemetry::SessionStream::Telemetry;
  double time = 0.0;
  telemetry::SessionDatagram datagram;  ///< of Telemetry and RefereeRaw
  std::string json;                     ///< of other streams
};

/// Where they are kept. One thread, unless a class says otherwise.
class LiveHistory {
 public:
  virtual ~LiveHistory() = default;
  /// What there is of these streams in the closed range, in the order in which it was kept, until
  /// the visitor says false.
  virtual void walk(std::span<const telemetry::SessionStream> streams, telemetry::TimeRange range,
                    const std::function<bool(const LiveRecord&)>& visit) const = 0;
  /// Nothing is older.
  virtual double begin() const = 0;
};

/// Of a session file. The reader belongs to the caller and stays.
class SessionHistory : public LiveHistory {
 public:
  explicit SessionHistory(const telemetry::SessionReader& session) : m_session(session) {}
  void walk(std::span<const telemetry::SessionStream> streams, telemetry::TimeRange range,
            const std::function<bool(const LiveRecord&)>& visit) const override;
  double begin() const override;

 private:
  const telemetry::SessionReader& m_session;
};

/// What a part of a session must open with, so that its moments are those of the session
/// (telemetry::ExportSelection); nothing for other sessions than live ones.
std::vector<std::pair<telemetry::SessionStream, std::string>> openingAt(
    const telemetry::SessionReader& session, double time);

/// Goes through one history; fast when moments follow each other. One thread.
class LiveMoments {
 public:
  LiveMoments();
  ~LiveMoments();

  /// The frame of this moment; origin is Recorded, the serial is left at 0. Nothing before the
  /// first books.
  std::optional<MatchFrame> frameAt(const LiveHistory& history, double time);
  /// The books of this moment, as LiveState::text().
  std::optional<std::string> snapshotAt(const LiveHistory& history, double time);

 private:
  struct Impl;
  bool goTo(const LiveHistory& history, double time);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::link

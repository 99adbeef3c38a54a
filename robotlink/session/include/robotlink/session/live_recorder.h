// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records what is heard of real robots into a session file: rows, every message and referee packet
// as it arrived, referee packets decoded, events; the profile is attached. Nothing
// waits for the disk (SessionWriter).

#include <memory>
#include <optional>
#include <string>

#include <robotlink/live/live_watch.h>
#include <robotlink/session/live_memory.h>
#include <robotlink/session/match_recorder.h>

namespace pitchboard::link {

/// How the referee stands in a session: one JSON object with "time", the packet (names:
/// docs/live.md) and what RefereeView makes of it ("sender", "ourTeam", the teams' "playersLeft",
/// ...).
std::string refereeToJson(const telemetry::RefereeState& packet, const RefereeView& referee,
                          double time);

/// What a session of live robots says about itself; `zero` as in LiveRecorder::create().
telemetry::SessionInfo liveSessionInfo(const LiveOptions& live, telemetry::WallTime zero,
                                       const std::string& program);

class LiveRecorder : public LiveRecords {
 public:
  /// `zero`: the moment that counts as 0 s, as in LiveObserver's times. Errors as
  /// SessionWriter::create(). Hand it to observe() of a watch or a pipeline, which makes its rows.
  static Result<std::shared_ptr<LiveRecorder>> create(const std::string& path,
                                                      const LiveOptions& live,
                                                      telemetry::WallTime zero,
                                                      const RecorderOptions& options = {});
  ~LiveRecorder() override;

  // The watch's thread.
  void happened(const MatchEvent& event) override;
  std::shared_ptr<telemetry::RowSink> rows() override { return m_writer; }

  // Any thread.
  telemetry::SessionStatus status() const { return m_writer->status(); }
  const std::string& path() const { return m_writer->path(); }
  void append(const MatchEvent& event) { happened(event); }
  /// Call after LiveWatch::stopObserving().
  Result<void> finish() { return m_writer->finish(); }

 protected:
  void keep(LiveRecord record) override;

 private:
  explicit LiveRecorder(std::shared_ptr<telemetry::SessionWriter> writer)
      : m_writer(std::move(writer)) {}

  std::shared_ptr<telemetry::SessionWriter> m_writer;
};

/// A record of any kind, into a session.
void appendRecord(telemetry::SessionWriter& writer, const LiveRecord& record);

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records live robots into a session file: rows, every message and referee packet as it arrived,
// the referee's packets decoded, events, and the profile as an attachment. Nothing waits for the
// disk (SessionWriter).

#include <memory>
#include <optional>
#include <string>

#include <robotlink/live/live_watch.h>
#include <robotlink/session/live_memory.h>
#include <robotlink/session/match_recorder.h>

namespace pitchboard::link {

/// Returns the referee's state as in a session: a JSON object with "time", the packet (names in
/// docs/live.md) and what the frame, which must have a game, adds to it ("sender", "ourTeam", the
/// teams' "playersLeft", ...).
std::string refereeToJson(const telemetry::RefereeState& packet, const MatchFrame& frame);

/// Returns the description of a live session; `zero` as in LiveRecorder::create().
telemetry::SessionInfo liveSessionInfo(const LiveOptions& live, telemetry::WallTime zero,
                                       const std::string& program);

class LiveRecorder : public LiveRecords {
 public:
  /// Creates the file. `zero` is the moment that counts as 0 s, as in LiveObserver. Fails as
  /// SessionWriter::create() does. Pass it to observe() of a watch or a pipeline.
  static Result<std::shared_ptr<LiveRecorder>> create(const std::string& path,
                                                      const LiveOptions& live,
                                                      telemetry::WallTime zero,
                                                      const RecorderOptions& options = {});
  ~LiveRecorder() override;

  // Called on the watch's thread.
  void happened(const MatchEvent& event) override;
  void logged(const LogLine& line) override { m_writer->append(line); }
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

/// Writes a record of any kind into a session.
void appendRecord(telemetry::SessionWriter& writer, const LiveRecord& record);

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records a simulated match into a session: rows of every robot and of the match, events, log lines,
// and a checkpoint a second with what the robots were told in between, so that every recorded moment
// can be entered again exactly. Lives on the match's thread; the session writer has its own.

#include <map>
#include <memory>

#include <telemetry/session_writer.h>

#include <robotlink/match_sampler.h>
#include <robotlink/state_archive.h>

namespace pitchboard::link {

class MatchRecorder : public TickObserver {
 public:
  explicit MatchRecorder(std::shared_ptr<telemetry::SessionWriter> writer,
                         MatchSamplerOptions options = {});
  ~MatchRecorder() override;

  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void happened(std::span<const sim::Event> events) override;
  void worldChanged(const SimulatedMatch& match) override;
  void logged(const LogLine& line) override;
  /// Records the checkpoint in the making; to be called on the match's thread, or when it has ended.
  void finish();

 private:
  void keep(std::optional<StateSegment> segment);

  std::shared_ptr<telemetry::SessionWriter> m_writer;
  MatchSampler m_sampler;
  StateSegmenter m_segmenter;
  std::map<RobotId, std::string> m_names;
  double m_tickRate = 60.0;
};

/// What a session of this match says of itself; its source was at 0 s when `now` minus the match's
/// time.
telemetry::SessionInfo sessionInfo(const SimulatedMatch& match, std::string_view program,
                                   telemetry::WallTime now);
/// The scenario and the catalog, as files of the session.
void attachMatch(telemetry::SessionWriter& writer, const SimulatedMatch& match,
                 const VariableCatalog& catalog = VariableCatalog::published());

}  // namespace pitchboard::link

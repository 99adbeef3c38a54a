// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records a simulated match into a session file while it is played: rows, events, log lines, and
// checkpoints that can be restored exactly. Scenario and catalog are attachments. The match never
// waits, because the file has a thread of its own (SessionWriter).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/session/live_memory.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/state_archive.h>
#include <telemetry/formats/profile.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_writer.h>

namespace pitchboard::link {

/// Names of the attachments of a session.
inline constexpr const char* scenarioAttachment = "scenario.json";
inline constexpr const char* catalogAttachment = "catalog.json";
inline constexpr const char* profileAttachment = "profile.json";

struct RecorderOptions {
  telemetry::SessionWriterOptions writer;
  /// Name and version of the program, which are written into the file.
  std::string program = "pitchboard";
};

/// Returns the description of a simulated match: title, seed, start.
telemetry::SessionInfo sessionInfo(const Scenario& scenario, const RecorderOptions& options);

/// The same for a match that has been playing; its second 0 was at `now` minus its time in wall
/// time.
telemetry::SessionInfo sessionInfo(const SimulatedMatch& match, std::string_view program,
                                   telemetry::WallTime now);
/// Attaches scenario and catalog to a session.
void attachMatch(telemetry::SessionWriter& writer, const Scenario& scenario,
                 const VariableCatalog& catalog);

class MatchRecorder : public TickObserver {
 public:
  /// Creates the file. Fails with Conflict if it exists, with SystemError if it cannot be created.
  /// Pass it to MatchRunner::observe() (or make it one of the first observers): it records from
  /// then on. Its rows are those of `sampler`, which must observe the same match before it.
  static Result<std::shared_ptr<MatchRecorder>> create(const std::string& path,
                                                       const Scenario& scenario,
                                                       const VariableCatalog& catalog,
                                                       std::shared_ptr<MatchSampler> sampler,
                                                       const RecorderOptions& options = {});
  /// Records into a session that the caller created and described.
  MatchRecorder(std::shared_ptr<telemetry::SessionWriter> writer,
                std::shared_ptr<MatchSampler> sampler);
  ~MatchRecorder() override;

  // Called on the match's thread.
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void happened(std::span<const MatchEvent> events) override;
  void drew(std::span<const ReceivedDrawing> drawings) override;
  void worldChanged(const SimulatedMatch& match) override;
  void logged(const LogLine& line) override;
  void left() override;

  // Any thread.
  telemetry::SessionStatus status() const { return m_writer->status(); }
  const std::string& path() const { return m_writer->path(); }
  /// Records a bookmark or another event of the user.
  void append(const MatchEvent& event);
  /// Call after MatchRunner::stopObserving(): writes the last piece and the summary.
  Result<void> finish();

 private:
  void keep(std::optional<StateSegment> ended);
  void writeEvents();

  std::shared_ptr<telemetry::SessionWriter> m_writer;
  std::shared_ptr<MatchSampler> m_sampler;
  bool m_getsRows = false;
  StateSegmenter m_segmenter;
  std::vector<MatchEvent> m_events;  // since the last tick
  std::vector<ReceivedDrawing> m_drawings;
};

/// What is in memory of a source, for saveRecent().
struct RecentPast {
  const telemetry::SeriesStore* rows = nullptr;
  const StateArchive* archive = nullptr;  ///< null for a live source
  const LiveMemory* received = nullptr;   ///< null for a simulated source
  const LiveHistory* drawn = nullptr;     ///< drawings of a simulated match; null if there are none
  std::vector<MatchEvent> events;
  std::vector<LogLine> log;
  std::string scenario, catalog, profile;  ///< JSON texts; empty if there is none
};
/// Saves the last `seconds` from memory into a new session file: rows of the store, checkpoints of
/// the archive, events and log lines. Times stay those of the source. Fails as
/// SessionWriter::create() does, and with NotFound if there is no row yet.
Result<telemetry::SessionStatus> saveRecent(const std::string& path, double seconds,
                                            const RecentPast& past,
                                            const telemetry::SessionInfo& info,
                                            telemetry::SessionWriterOptions options = {});

}  // namespace pitchboard::link

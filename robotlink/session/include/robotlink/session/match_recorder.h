// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Records a simulated match into a session file while it is played: rows, events, log lines, and
// pieces that can be entered again exactly; the scenario and the
// catalog are attached. The match never waits: the file has a thread of its own (SessionWriter).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/session/live_memory.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/state_archive.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_writer.h>
#include <telemetry/wire/profile.h>

namespace pitchboard::link {

/// Names of what is attached to a session.
inline constexpr const char* scenarioAttachment = "scenario.json";
inline constexpr const char* catalogAttachment = "catalog.json";
inline constexpr const char* profileAttachment = "profile.json";

struct RecorderOptions {
  telemetry::SessionWriterOptions writer;
  /// Name and version of the program, for the file.
  std::string program = "pitchboard";
};

/// What the session is to say of a simulated match: title, seed, start.
telemetry::SessionInfo sessionInfo(const Scenario& scenario, const RecorderOptions& options);

/// The same of a match that may have been played already; its source was at 0 s when `now` minus
/// its time.
telemetry::SessionInfo sessionInfo(const SimulatedMatch& match, std::string_view program,
                                   telemetry::WallTime now);
/// The scenario and the catalog, as files of the session.
void attachMatch(telemetry::SessionWriter& writer, const Scenario& scenario,
                 const VariableCatalog& catalog);

class MatchRecorder : public TickObserver {
 public:
  /// Error Conflict when the file exists, SystemError when it cannot be made. Hand it to
  /// MatchRunner::observe() (or make it one of the first observers); it records from that moment
  /// on. Its rows are those of `sampler`, which observes the same match before it.
  static Result<std::shared_ptr<MatchRecorder>> create(const std::string& path,
                                                       const Scenario& scenario,
                                                       const VariableCatalog& catalog,
                                                       std::shared_ptr<MatchSampler> sampler,
                                                       const RecorderOptions& options = {});
  /// Into a session that was made and described by the caller.
  MatchRecorder(std::shared_ptr<telemetry::SessionWriter> writer,
                std::shared_ptr<MatchSampler> sampler);
  ~MatchRecorder() override;

  // The match's thread.
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void happened(std::span<const MatchEvent> events) override;
  void drew(std::span<const ReceivedDrawing> drawings) override;
  void worldChanged(const SimulatedMatch& match) override;
  void logged(const LogLine& line) override;
  void left() override;

  // Any thread.
  telemetry::SessionStatus status() const { return m_writer->status(); }
  const std::string& path() const { return m_writer->path(); }
  /// A bookmark or another event of the user's.
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

/// What has just happened, from memory into a new session file: the rows of the last `seconds` of
/// the store, the pieces of the archive, the events and log lines of that time. Times stay those of
/// the source. Errors as SessionWriter::create(); NotFound when there is no row yet.
struct RecentPast {
  const telemetry::SeriesStore* rows = nullptr;
  const StateArchive* archive = nullptr;  ///< null: a live source
  const LiveMemory* received = nullptr;   ///< null: a simulated one
  const LiveHistory* drawn = nullptr;     ///< by programs of a simulated match; null: nothing
  std::vector<MatchEvent> events;
  std::vector<LogLine> log;
  std::string scenario, catalog, profile;  ///< JSON texts; empty: there is none
};
Result<telemetry::SessionStatus> saveRecent(const std::string& path, double seconds,
                                            const RecentPast& past,
                                            const telemetry::SessionInfo& info,
                                            telemetry::SessionWriterOptions options = {});

}  // namespace pitchboard::link

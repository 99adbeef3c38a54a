// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/match_recorder.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include <base/file_target.h>
#include <base/try.h>
#include <robotlink/session/drawing_moments.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/row_walk.h>
#include <robotlink/session/session_checkpoint.h>
#include <robotlink/session/session_events.h>
#include <simcore/world/action_codes.h>

namespace pitchboard::link {
namespace {

/// What was known when it began, and what came later.
void appendReceived(telemetry::SessionWriter& writer, const LiveMemory& received, double begin) {
  using telemetry::SessionStream;
  LiveMoments moments;
  const double first = std::max(begin, received.begin());
  if (const auto state = moments.snapshotAt(received, first)) {
    writer.appendJson(SessionStream::LiveState, first, *state);
  }
  constexpr std::array streams{SessionStream::Telemetry, SessionStream::RefereeRaw,
                               SessionStream::Referee, SessionStream::LiveState};
  received.walk(streams, {first, std::numeric_limits<double>::infinity()},
                [&writer, first](const LiveRecord& record) {
                  if (record.time > first) appendRecord(writer, record);
                  return true;
                });
}

double timeOf(const sim::WorldState& state) {
  return static_cast<double>(state.tick) / state.settings.tickRate;
}

}  // namespace

telemetry::SessionInfo sessionInfo(const Scenario& scenario, const RecorderOptions& options) {
  telemetry::SessionInfo info;
  info.program = options.program;
  info.source = "simulation";
  info.title = scenario.title.empty() ? scenario.name : scenario.title;
  info.seed = scenario.settings.seed;
  info.created = std::chrono::system_clock::now();
  info.start = info.created;
  return info;
}

telemetry::SessionInfo sessionInfo(const SimulatedMatch& match, std::string_view program,
                                   telemetry::WallTime now) {
  const sim::WorldState& state = match.simulation().state();
  RecorderOptions options;
  options.program = program;
  telemetry::SessionInfo info = sessionInfo(match.scenario(), options);
  info.created = now;
  info.start = now - std::chrono::duration_cast<telemetry::Duration>(
                         std::chrono::duration<double>(timeOf(state)));
  return info;
}

void attachMatch(telemetry::SessionWriter& writer, const Scenario& scenario,
                 const VariableCatalog& catalog) {
  writer.attach(scenarioAttachment, "application/json", scenarioToJson(scenario));
  writer.attach(catalogAttachment, "application/json", catalog.toJson());
}

Result<std::shared_ptr<MatchRecorder>> MatchRecorder::create(const std::string& path,
                                                             const Scenario& scenario,
                                                             const VariableCatalog& catalog,
                                                             std::shared_ptr<MatchSampler> sampler,
                                                             const RecorderOptions& options) {
  auto writer =
      TRY(telemetry::SessionWriter::create(path, sessionInfo(scenario, options), options.writer));
  attachMatch(*writer, scenario, catalog);
  return std::make_shared<MatchRecorder>(std::move(writer), std::move(sampler));
}

MatchRecorder::MatchRecorder(std::shared_ptr<telemetry::SessionWriter> writer,
                             std::shared_ptr<MatchSampler> sampler)
    : m_writer(std::move(writer)), m_sampler(std::move(sampler)) {}

MatchRecorder::~MatchRecorder() {
  (void)finish();
}

void MatchRecorder::ticked(const SimulatedMatch& match, std::chrono::nanoseconds /*tickTime*/) {
  keep(m_segmenter.ticked(match));
  if (!std::exchange(m_getsRows, true)) m_sampler->add(m_writer, match);
  writeEvents();
}

// Behind the row of their tick: it is the row that tells the file that the source was put back.
void MatchRecorder::writeEvents() {
  for (const MatchEvent& event : m_events) m_writer->append(sessionEvent(event));
  m_events.clear();
  for (const ReceivedDrawing& drawing : m_drawings) appendRecord(*m_writer, drawingRecord(drawing));
  m_drawings.clear();
}

void MatchRecorder::happened(std::span<const MatchEvent> events) {
  m_events.insert(m_events.end(), events.begin(), events.end());
}

void MatchRecorder::drew(std::span<const ReceivedDrawing> drawings) {
  m_drawings.insert(m_drawings.end(), drawings.begin(), drawings.end());
}

void MatchRecorder::append(const MatchEvent& event) {
  m_writer->append(sessionEvent(event));
}

void MatchRecorder::worldChanged(const SimulatedMatch& match) {
  keep(m_segmenter.worldChanged(match));
}

void MatchRecorder::logged(const LogLine& line) {
  m_writer->append(line);
}

void MatchRecorder::left() {
  m_sampler->remove(m_writer);
}

void MatchRecorder::keep(std::optional<StateSegment> ended) {
  if (ended) appendCheckpoint(*m_writer, *ended);
}

Result<void> MatchRecorder::finish() {
  writeEvents();
  keep(m_segmenter.finish());
  return m_writer->finish();
}

Result<telemetry::SessionStatus> saveRecent(const std::string& path, double seconds,
                                            const RecentPast& past,
                                            const telemetry::SessionInfo& info,
                                            telemetry::SessionWriterOptions options) {
  const auto range = past.rows->range();
  if (!range) {
    return failure(ErrorCode::NotFound, "there is nothing to save yet: no row has been kept");
  }
  // Nothing may be left out here; the disk is waited for.
  options.waitWhenFull = true;
  auto target = TRY(FileTarget::at(path, IfExists::Refuse));
  auto writer = telemetry::SessionWriter::create(target.partPath(), info, options);
  if (!writer) return tl::unexpected(writer.error());
  for (const auto& [name, text] :
       {std::pair{scenarioAttachment, &past.scenario}, std::pair{catalogAttachment, &past.catalog},
        std::pair{profileAttachment, &past.profile}}) {
    if (!text->empty()) (*writer)->attach(name, "application/json", *text);
  }
  const double begin = std::max(range->begin, range->end - seconds);
  if (past.archive) {
    if (const auto ticks = past.archive->range()) {
      const auto first = static_cast<std::uint64_t>(std::max(0.0, begin * ticks->tickRate));
      for (const auto& segment : past.archive->segments(first, ticks->last)) {
        appendCheckpoint(**writer, *segment);
      }
    }
  }
  forEachRow(*past.rows, {begin, range->end},
             [&, ids = std::map<telemetry::GroupId, telemetry::GroupId>()](
                 telemetry::GroupId id, const telemetry::GroupInfo& group,
                 const telemetry::RowView& row) mutable {
               const auto [known, isNew] = ids.try_emplace(id, 0U);
               if (isNew) known->second = (*writer)->addGroup(group);
               (*writer)->append(known->second, row);
             });
  if (past.received) appendReceived(**writer, *past.received, begin);
  if (past.drawn) {
    constexpr std::array drawings{telemetry::SessionStream::Telemetry};
    past.drawn->walk(drawings, {begin, range->end}, [&writer](const LiveRecord& record) {
      appendRecord(**writer, record);
      return true;
    });
  }
  for (const auto& event : past.events) {
    if (event.time >= begin) (*writer)->append(sessionEvent(event));
  }
  for (const auto& line : past.log) {
    if (line.time >= begin) (*writer)->append(line);
  }
  TRY((*writer)->finish());
  TRY(target.commit());
  return (*writer)->status();
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/match_recorder.h>

#include <algorithm>
#include <map>

#include <base/actions.h>
#include <base/file_target.h>
#include <robotlink/session/row_walk.h>

#include "session_checkpoint.h"

namespace pitchboard::link {
namespace {

std::string robotName(const sim::WorldState& state, RobotId id) {
  for (const sim::RobotIdentity& robot : state.robots) {
    if (robot.id == id) return robot.name();
  }
  return id.value == 0 ? std::string() : "robot " + std::to_string(id.value);
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

telemetry::SessionEvent sessionEvent(const sim::Event& event, const sim::WorldState& state) {
  telemetry::SessionEvent out;
  out.time = static_cast<double>(event.tick) / state.settings.tickRate;
  out.group = robotName(state, event.robot);
  switch (event.kind) {
    case sim::EventKind::Goal:
      out.kind = "goal";
      out.text = event.value == 0 ? "goal for the left side" : "goal for the right side";
      break;
    case sim::EventKind::BallOut:
      out.kind = "ball-out";
      out.text = "the ball is out";
      break;
    case sim::EventKind::Kick:
      out.kind = "kick";
      out.text = out.group + ": " + actionWords(event.value);
      break;
    case sim::EventKind::Fall:
      out.kind = "fall";
      out.text = out.group + " fell";
      break;
    case sim::EventKind::GotUp:
      out.kind = "got-up";
      out.text = out.group + " got up";
      break;
    case sim::EventKind::UnknownAction:
      out.kind = "unknown-action";
      out.text = out.group + ": unknown action " + std::to_string(event.value);
      break;
  }
  return out;
}

Result<std::shared_ptr<MatchRecorder>> MatchRecorder::create(const std::string& path,
                                                             const Scenario& scenario,
                                                             const VariableCatalog& catalog,
                                                             const RecorderOptions& options) {
  auto writer =
      telemetry::SessionWriter::create(path, sessionInfo(scenario, options), options.writer);
  if (!writer) return tl::unexpected(writer.error());
  attachMatch(**writer, scenario, catalog);
  return std::make_shared<MatchRecorder>(std::move(*writer), options.everyNth);
}

MatchRecorder::MatchRecorder(std::shared_ptr<telemetry::SessionWriter> writer, int everyNth)
    : m_writer(std::move(writer)), m_sampler(m_writer, {everyNth}) {}

MatchRecorder::~MatchRecorder() {
  (void)finish();
}

void MatchRecorder::ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) {
  keep(m_segmenter.ticked(match));
  m_sampler.ticked(match, tickTime);
  const sim::WorldState& state = match.simulation().state();
  for (const sim::Event& event : m_events) m_writer->append(sessionEvent(event, state));
  m_events.clear();
  noteProcesses(match, timeOf(state));
}

void MatchRecorder::happened(std::span<const sim::Event> events) {
  m_events.insert(m_events.end(), events.begin(), events.end());
}

void MatchRecorder::worldChanged(const SimulatedMatch& match) {
  keep(m_segmenter.worldChanged(match));
}

void MatchRecorder::logged(const LogLine& line) {
  m_writer->append(line);
}

void MatchRecorder::keep(std::optional<StateSegment> ended) {
  if (ended) appendCheckpoint(*m_writer, *ended);
}

void MatchRecorder::noteProcesses(const SimulatedMatch& match, double time) {
  const auto& children = match.supervisor().children();
  for (std::size_t i = 0; i < children.size(); ++i) {
    const bool isNew = i >= m_children.size();
    if (isNew) m_children.push_back(children[i].state);
    const ChildState before = std::exchange(m_children[i], children[i].state);
    if (!isNew && before == children[i].state) continue;
    const std::string robot = robotName(match.simulation().state(), children[i].spec.robot);
    std::string text = robot + ' ' + children[i].spec.name;
    switch (children[i].state) {
      case ChildState::Running:
        text += " started (process " + std::to_string(children[i].pid) + ')';
        break;
      case ChildState::Ended:
        text += " ended: " + children[i].detail;
        break;
      case ChildState::Failed:
        text += " died: " + children[i].detail;
        break;
    }
    m_writer->append(telemetry::SessionEvent{time, "process", robot, std::move(text)});
  }
}

Result<void> MatchRecorder::finish() {
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
  auto target = FileTarget::at(path, IfExists::Refuse);
  if (!target) return tl::unexpected(target.error());
  auto writer = telemetry::SessionWriter::create(target->partPath(), info, options);
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
  for (const auto& event : past.events) {
    if (event.time >= begin) (*writer)->append(event);
  }
  for (const auto& line : past.log) {
    if (line.time >= begin) (*writer)->append(line);
  }
  if (auto finished = (*writer)->finish(); !finished) return tl::unexpected(finished.error());
  if (auto named = target->commit(); !named) return tl::unexpected(named.error());
  return (*writer)->status();
}

}  // namespace pitchboard::link

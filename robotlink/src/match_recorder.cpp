// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match_recorder.h>

#include <array>

#include <robotlink/session_checkpoint.h>

namespace pitchboard::link {
namespace {

struct EventWords {
  const char* kind;
  const char* words;
};
/// By sim::EventKind.
constexpr std::array<EventWords, 6> eventWords{{{"goal", "goal"},
                                                {"ball-out", "ball out"},
                                                {"kick", "kick"},
                                                {"fall", "fall"},
                                                {"got-up", "got up"},
                                                {"unknown-action", "unknown action"}}};

std::string textOf(const sim::Event& event) {
  const EventWords& words = eventWords[static_cast<std::size_t>(event.kind)];
  switch (event.kind) {
    case sim::EventKind::Goal:
      return std::string(words.words) + (event.value == 0 ? " of the left side" : " of the right side");
    case sim::EventKind::Kick:
    case sim::EventKind::UnknownAction:
      return std::string(words.words) + " (action " + std::to_string(event.value) + ")";
    default: return words.words;
  }
}

}  // namespace

MatchRecorder::MatchRecorder(std::shared_ptr<telemetry::SessionWriter> writer,
                             MatchSamplerOptions options)
    : m_writer(std::move(writer)), m_sampler(m_writer, options) {}

MatchRecorder::~MatchRecorder() = default;

void MatchRecorder::ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) {
  const sim::WorldState& state = match.simulation().state();
  m_tickRate = state.settings.tickRate;
  if (m_names.size() != state.robots.size()) {
    m_names.clear();
    for (const auto& robot : state.robots) {
      m_names[robot.id] =
          std::string(info(robot.team).letter) + std::to_string(robot.number);
    }
  }
  m_sampler.ticked(match, tickTime);
  keep(m_segmenter.ticked(match));
}

void MatchRecorder::happened(std::span<const sim::Event> events) {
  for (const sim::Event& event : events) {
    const auto name = m_names.find(event.robot);
    m_writer->append(telemetry::SessionEvent{
        static_cast<double>(event.tick) / m_tickRate,
        eventWords[static_cast<std::size_t>(event.kind)].kind,
        name == m_names.end() ? std::string() : name->second, textOf(event)});
  }
}

void MatchRecorder::worldChanged(const SimulatedMatch& match) {
  m_names.clear();
  m_sampler.worldChanged(match);
  keep(m_segmenter.worldChanged(match));
}

void MatchRecorder::logged(const LogLine& line) {
  m_writer->append(telemetry::SessionLogLine{line.time, line.warning ? 3 : 2, line.origin, line.text});
}

void MatchRecorder::finish() { keep(m_segmenter.finish()); }

void MatchRecorder::keep(std::optional<StateSegment> segment) {
  if (!segment) return;
  m_writer->appendJson(telemetry::SessionStream::Checkpoints,
                       static_cast<double>(segment->firstTick()) / segment->tickRate(),
                       checkpointToJson(*segment));
}

telemetry::SessionInfo sessionInfo(const SimulatedMatch& match, std::string_view program,
                                   telemetry::WallTime now) {
  const sim::WorldState& state = match.simulation().state();
  telemetry::SessionInfo out;
  out.program = program;
  out.source = "simulation";
  out.title = match.scenario().name;
  out.seed = state.settings.seed;
  out.created = now;
  out.start = now - std::chrono::duration_cast<telemetry::Duration>(std::chrono::duration<double>(
                        static_cast<double>(state.tick) / state.settings.tickRate));
  out.more["physics"] = state.settings.physics;
  return out;
}

void attachMatch(telemetry::SessionWriter& writer, const SimulatedMatch& match,
                 const VariableCatalog& catalog) {
  writer.attach("scenario.json", "application/json", scenarioToJson(match.scenario()));
  writer.attach("catalog.json", "application/json", catalog.toJson());
}

}  // namespace pitchboard::link

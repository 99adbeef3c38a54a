// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/try.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/state_archive.h>
#include <telemetry/session/session_reader.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/scenario_behind.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

Result<sim::WorldState> nothingKnown() {
  return failure(ErrorCode::NotFound, "this state of the match is no longer in memory");
}

Result<sim::WorldState> recordedState(const ReplayController& replay,
                                      const link::MatchFrame& frame) {
  const auto session = TRY(telemetry::SessionReader::open(replay.path().toStdString()));
  return link::stateOfFrame(session, frame);
}

}  // namespace

std::optional<link::Scenario> scenarioBehind(const ShownMoment& shown, const MatchController& match,
                                             const ReplayController& replay) {
  const FramePtr frame = shown.frame();
  if (shown.source() == &match) {
    link::Scenario scenario = match.scenario();
    const auto archive = match.memory()->archive();
    const auto state = frame && archive ? archive->restore(frame->snapshot.tick) : nothingKnown();
    link::setGameOf(state, scenario);
    return scenario;
  }
  if (shown.source() != &replay || replay.attachedScenario().empty()) return {};
  auto read = link::scenarioFromJson(replay.attachedScenario(), "the session's scenario");
  if (!read) return {};
  link::setGameOf(frame ? recordedState(replay, *frame) : nothingKnown(), *read);
  return std::move(*read);
}

}  // namespace pitchboard::ui

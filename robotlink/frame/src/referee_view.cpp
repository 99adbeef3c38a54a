// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/referee_view.h>

namespace pitchboard::link {
namespace {

using telemetry::RefereePlayer;
using telemetry::RefereeState;
using telemetry::RefereeTeam;

/// The set play and the phase as text. Some versions have one field for both, others have two.
void describeSetPlay(const RefereeState& state, std::string& setPlay, std::string& phase) {
  constexpr int normal = 0, shootout = 1, overtime = 2;
  if (state.secState && *state.secState != normal) {
    const std::string label(telemetry::setPlayLabel(telemetry::League::Humanoid, *state.secState));
    (*state.secState == overtime || *state.secState == shootout ? phase : setPlay) = label;
  }
  if (state.gamePhase && *state.gamePhase != 0) {
    phase = telemetry::gamePhaseLabel(*state.gamePhase);
  }
  if (state.setPlay && *state.setPlay != 0) {
    setPlay = telemetry::setPlayLabel(state.league, *state.setPlay);
  }
}

/// Who takes the set play and how far it is (docs/live.md, "Referee").
void describeTaking(const RefereeState& state, RefereeView& view) {
  constexpr int firstOfSetPlays = 4;       // of the secondary state: free kicks and what follows
  constexpr int sizeWithThreeSteps = 688;  // until 2018 there were two, counted the other way
  if (state.secState && *state.secState >= firstOfSetPlays && *state.secState < 255 &&
      state.secStateInfo) {
    const auto& info = *state.secStateInfo;
    if (state.team(info[0]) != nullptr) view.performingTeam = info[0];
    if (state.size >= sizeWithThreeSteps) {
      view.setPlayStep = info[1] == 0 ? "stop" : info[1] == 1 ? "prepare" : "ready";
    } else {
      view.setPlayStep = info[1] == 1 ? "stop" : "prepare";
    }
  } else if (state.setPlay.value_or(0) != 0) {
    view.performingTeam = state.kickOffTeam;
    if (view.stopped) view.setPlayStep = "stop";
  }
}

/// What the secondary time counts down to.
std::string countdownOf(const RefereeView& view) {
  if (view.secondaryTime.value_or(0) == 0) return {};
  if (view.setPlay == "timeout" || view.phase == "timeout") return "timeout over";
  if (view.state == "READY") return "set";
  if (view.state == "INITIAL" || view.state == "FINISHED") return "next half";
  if (view.setPlay.empty()) return view.state == "PLAYING" ? "ball free" : "";
  return view.setPlayStep == "prepare" ? "ready" : "ball free";
}

RefereeTeamView teamView(const RefereeState& state, const RefereeTeam& team) {
  RefereeTeamView view{
      team.number, std::string(telemetry::colourLabel(team.colour)), team.score, 0, {}};
  for (const RefereePlayer& player : team.players()) {
    // Slots without a player are substitutes, and so are those who wait.
    if (player.unreliable || telemetry::isSubstitute(state, player)) continue;
    view.playersLeft += player.penalty == 0 ? 1 : 0;
    view.players.push_back(
        {player.number, std::string(telemetry::penaltyLabel(state, player)), player.secondsLeft,
         player.warnings.value_or(0), player.yellow.value_or(0), player.red.value_or(0),
         player.cautions.value_or(0),
         player.goalkeeper.value_or(0) != 0 || team.goalkeeper == player.number});
  }
  return view;
}

}  // namespace

RefereeView viewOf(const RefereeState& packet, const Teams& teams) {
  RefereeView view;
  view.packet = packet;
  view.version = packet.version;
  view.state = telemetry::stateName(packet.state);
  describeSetPlay(packet, view.setPlay, view.phase);
  view.firstHalf = packet.firstHalf != 0;
  view.stopped = packet.stopped.value_or(0) != 0;
  view.secondsLeft = packet.secsRemaining;
  view.secondaryTime = packet.secondaryTime;
  describeTaking(packet, view);
  view.countdown = countdownOf(view);
  view.kickOffTeam = packet.kickOffTeam;
  for (std::size_t i = 0; i < view.teams.size(); ++i) {
    view.teams[i] = teamView(packet, packet.teams[i]);
    view.teams[i].name = teamName(packet.teams[i].number, teams);
  }
  return view;
}

RefereeTruth truthOf(const RefereeState& trueData) {
  RefereeTruth truth;
  truth.state = telemetry::stateName(trueData.state);
  std::string phase;
  describeSetPlay(trueData, truth.setPlay, phase);
  if (truth.setPlay.empty()) truth.setPlay = phase;
  truth.secondsLeft = trueData.secsRemaining;
  truth.secondaryTime = trueData.secondaryTime;
  truth.scores = {trueData.teams[0].score, trueData.teams[1].score};
  return truth;
}

std::optional<Penalty> penaltyOf(const RefereeState& packet, int team, int player) {
  const RefereeTeam* own = packet.team(team);
  if (own == nullptr) return std::nullopt;
  for (const RefereePlayer& one : own->players()) {
    if (one.number != player || one.penalty == 0 || one.unreliable) continue;
    return Penalty{std::string(telemetry::penaltyLabel(packet, one)), one.secondsLeft};
  }
  return std::nullopt;
}

}  // namespace pitchboard::link

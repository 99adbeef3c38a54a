// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/process_registry.h>

#include <algorithm>
#include <array>

#include <base/try.h>
#include <robotlink/cognition/naive_decision.h>

#include "process_makers.h"
#include "soccer/behaviour.h"

namespace pitchboard::link {
namespace {

struct NamedBehaviour {
  BehaviourInfo info;
  ProcessMaker* make;
};

constexpr std::array behaviourList{
    NamedBehaviour{
        {"striker", "goes for the ball and scores, leaves the ball to a nearer team-mate", true},
        makeSoccerDecision<Striker>},
    NamedBehaviour{{"supporter", "plays like a striker, but starts behind it", true},
                   makeSoccerDecision<Supporter>},
    NamedBehaviour{{"keeper", "stays between the ball and its own goal, clears the ball", true},
                   makeSoccerDecision<Keeper>},
    NamedBehaviour{{"idle", "stands", true}, makeSoccerDecision<Idle>},
    NamedBehaviour{{"naive", "as published: turn to the ball, walk to it, kick it", false},
                   makeNaiveDecision},
};

constexpr auto behaviourInfos = [] {
  std::array<BehaviourInfo, behaviourList.size()> infos;
  std::transform(behaviourList.begin(), behaviourList.end(), infos.begin(),
                 [](const NamedBehaviour& behaviour) { return behaviour.info; });
  return infos;
}();

Result<std::unique_ptr<CognitiveProcess>> makeDecision(const ProcessOptions& options) {
  TRY(validate(options.parameters));
  std::string known;
  for (const NamedBehaviour& behaviour : behaviourList) {
    if (behaviour.info.name == options.behaviour) return behaviour.make(options);
    known += (known.empty() ? "" : ", ") + std::string(behaviour.info.name);
  }
  return failure(ErrorCode::NotFound,
                 "there is no behaviour '" + options.behaviour + "'; the behaviours are: " + known);
}

constexpr std::array processes{
    ProcessInfo{"localization", "estimates where the robot is", makeLocalization,
                "pitchboard-robot localization --robot 1"},
    ProcessInfo{"team", "shares pose, ball and intention with team-mates", makeTeamTalk,
                "pitchboard-robot team --robot 1 --team 0"},
    ProcessInfo{"decision", "chooses the robot's action", makeDecision,
                "pitchboard-robot decision --robot 1 --behaviour striker"},
    ProcessInfo{"planning", "walks to the target of decision and avoids obstacles", makePlanning,
                "pitchboard-robot planning --robot 1"},
    ProcessInfo{"communication", "receives the referee, sends telemetry and team messages by UDP",
                makeCommunication,
                "pitchboard-robot communication --robot 1 --udp-address 127.0.0.1"},
};

}  // namespace

void ProcessOptions::setMatch(MatchNumber match) {
  telemetryPortBase = match.telemetryPortBase();
  teamPortBase = match.teamPortBase();
  refereePort = match.refereePort();
  channelPortBase = match.channelPortBase();
}

std::span<const ProcessInfo> cognitiveProcesses() {
  return processes;
}

std::span<const BehaviourInfo> behaviours() {
  return behaviourInfos;
}

const BehaviourInfo* findBehaviour(std::string_view name) {
  const auto found = std::ranges::find(behaviourInfos, name, &BehaviourInfo::name);
  return found == behaviourInfos.end() ? nullptr : &*found;
}

}  // namespace pitchboard::link

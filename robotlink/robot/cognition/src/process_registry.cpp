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

// What decision and advisor make a world model of.
constexpr std::string_view worldReads =
    "COM_REFEREE COM_SET_PLAY COM_SET_PLAY_OURS IMU_STATE IMU_EULER_Z LOCALIZATION_X "
    "LOCALIZATION_Y LOCALIZATION_THETA LOCALIZATION_RBT*_X LOCALIZATION_RBT*_Y CONTROL_ACTION "
    "DECISION_ACTION_B ADVISOR_ASIDE VISION_LOST VISION_BALL_DIST VISION_PAN_DEG "
    "VISION_RBT*_DIST VISION_RBT*_ANGLE COM_STATE_ROBOT* COM_POS_ROBOT* COM_ACTION_ROBOT* "
    "COM_POS_BALL_ROBOT*";

constexpr std::array behaviourList{
    NamedBehaviour{
        {"striker", "goes for the ball and scores, leaves the ball to a nearer team-mate", true,
         worldReads},
        makeSoccerDecision<Striker>},
    NamedBehaviour{{"supporter", "plays like a striker, but starts behind it", true, worldReads},
                   makeSoccerDecision<Supporter>},
    NamedBehaviour{
        {"keeper", "stays between the ball and its own goal, clears the ball", true, worldReads},
        makeSoccerDecision<Keeper>},
    NamedBehaviour{{"idle", "stands", true, worldReads}, makeSoccerDecision<Idle>},
    NamedBehaviour{{"naive", "as published: turn to the ball, walk to it, kick it", false,
                    "COM_REFEREE VISION_LOST VISION_PAN_DEG VISION_BALL_DIST"},
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
                "pitchboard-robot localization --robot 1",
                "CONTROL_ACTION DECISION_ACTION_B VISION_*_LANDMARK_DEG IMU_EULER_Z", ""},
    ProcessInfo{"team", "shares pose, ball and intention with team-mates", makeTeamTalk,
                "pitchboard-robot team --robot 1 --team 0",
                "LOCALIZATION_X LOCALIZATION_Y LOCALIZATION_THETA LOCALIZATION_RBT01_X "
                "DECISION_STATE IMU_STATE LOCALIZATION_BALL_*",
                "messages of team-mates"},
    ProcessInfo{"decision", "chooses the robot's action", makeDecision,
                "pitchboard-robot decision --robot 1 --behaviour striker", worldReads, ""},
    ProcessInfo{"planning", "walks to the target of decision and avoids obstacles", makePlanning,
                "pitchboard-robot planning --robot 1",
                "DECISION_TARGET* LOCALIZATION_X LOCALIZATION_Y LOCALIZATION_THETA "
                "LOCALIZATION_RBT*_X LOCALIZATION_RBT*_Y LOCALIZATION_OPP* COM_POS_ROBOT* "
                "COM_STATE_ROBOT*",
                ""},
    ProcessInfo{"communication", "receives the referee, sends telemetry and team messages by UDP",
                makeCommunication,
                "pitchboard-robot communication --robot 1 --udp-address 127.0.0.1",
                "*_WORKING CONTROL_MESSAGES DECISION_RBT*_DIST_BALL VISION_LOST VISION_BALL_DIST "
                "VISION_PAN_DEG LOCALIZATION_X LOCALIZATION_Y LOCALIZATION_THETA "
                "LOCALIZATION_RBT01_X DECISION_ACTION_A IMU_EULER_Z VOLTAGE",
                "packets of the referee"},
    ProcessInfo{"advisor", "learns where the opponents aim, for the keeper", makeAdvisor,
                "pitchboard-robot advisor --robot 1 --behaviour keeper", worldReads, ""},
};

}  // namespace

void ProcessOptions::setMatch(MatchNumber match) {
  telemetryPortBase = match.telemetryPortBase();
  teamPortBase = match.teamPortBase();
  refereePort = match.refereePort();
  channelPortBase = match.channelPortBase();
}

std::span<const ProcessInfo> referenceProcesses() {
  return processes;
}

const ProcessInfo* findProcess(std::string_view name) {
  const auto found = std::ranges::find(processes, name, &ProcessInfo::name);
  return found == processes.end() ? nullptr : &*found;
}

std::span<const BehaviourInfo> behaviours() {
  return behaviourInfos;
}

const BehaviourInfo* findBehaviour(std::string_view name) {
  const auto found = std::ranges::find(behaviourInfos, name, &BehaviourInfo::name);
  return found == behaviourInfos.end() ? nullptr : &*found;
}

}  // namespace pitchboard::link

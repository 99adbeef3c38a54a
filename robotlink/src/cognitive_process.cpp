// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognitive_process.h>

#include <algorithm>
#include <array>

#include <robotlink/naive_decision.h>

#include "communication.h"

namespace pitchboard::link {
namespace {

using Maker = Result<std::unique_ptr<CognitiveProcess>> (*)(const ProcessOptions& options);

struct Behaviour {
  BehaviourInfo info;
  Maker make;
};

constexpr std::array behaviourList{
    Behaviour{{"naive", "as published: turn to the ball, walk to it, kick it"}, makeNaiveDecision},
};

constexpr auto behaviourInfos = [] {
  std::array<BehaviourInfo, behaviourList.size()> infos;
  std::transform(behaviourList.begin(), behaviourList.end(), infos.begin(),
                 [](const Behaviour& behaviour) { return behaviour.info; });
  return infos;
}();

Result<std::unique_ptr<CognitiveProcess>> makeDecision(const ProcessOptions& options) {
  std::string known;
  for (const Behaviour& behaviour : behaviourList) {
    if (behaviour.info.name == options.behaviour) return behaviour.make(options);
    known += (known.empty() ? "" : ", ") + std::string(behaviour.info.name);
  }
  return failure(ErrorCode::NotFound, "there is no behaviour '" + options.behaviour +
                                          "'; the behaviours are: " + known);
}

constexpr std::array processes{
    ProcessInfo{"decision", "chooses the robot's action", makeDecision, true, true,
                "pitchboard-robot decision --robot 1 --behaviour naive --distance-to-kick 25"},
    ProcessInfo{"communication", "sends telemetry and team messages by UDP", makeCommunication,
                false, false,
                "pitchboard-robot communication --robot 1 --udp-address 127.0.0.1"},
};

}  // namespace

std::span<const ProcessInfo> cognitiveProcesses() { return processes; }

const ProcessInfo* findProcess(std::string_view name) {
  const auto found = std::find_if(processes.begin(), processes.end(),
                                  [name](const ProcessInfo& info) { return info.name == name; });
  return found == processes.end() ? nullptr : &*found;
}

std::span<const BehaviourInfo> behaviours() { return behaviourInfos; }

}  // namespace pitchboard::link

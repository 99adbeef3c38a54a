// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as lines for `simulate --stdio`: every line gets one line of JSON, and memory and time
// stay within the limits. The seed makes its own worlds.
#include <robotlink/capi/world_lines.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

using namespace pitchboard::link;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  // Nobody thinks, and few ticks: lines are to be read here, not matches to be played.
  static const Scenario usual = [] {
    Scenario scenario = loadScenario("one-robot").value();
    for (ScenarioRobot& robot : scenario.robots) robot.behaviour = noBehaviour;
    return scenario;
  }();
  WorldLines::Limits limits;
  limits.worlds = 2;
  limits.ticks = 4;
  limits.files = false;
  limits.snapshots = 3;
  WorldLines lines(usual, limits);
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  for (int i = 0; i < 20 && !rest.empty(); ++i) {
    const std::size_t end = rest.find('\n');
    const std::string answer = lines.answer(rest.substr(0, end));
    if (answer.find('\n') != std::string::npos) std::abort();
    const auto json = nlohmann::json::parse(answer, nullptr, false);
    if (!json.is_object() || !json.contains("ok")) std::abort();
    if (json["ok"] == false && !json.contains("error")) std::abort();
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  return 0;
}

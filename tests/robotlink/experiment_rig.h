// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A short experiment for tests, and changes of its text.

#include <string>
#include <vector>

#include <base/file_target.h>

namespace experiment_rig {

using namespace pitchboard;
using namespace pitchboard::link;

/// Two conditions of a short match: three seconds, or until the ball is out.
inline const std::string shortMatch = R"({
  "version": 1, "name": "short", "scenario": {
    "version": 1, "ball": {"x": 0.3, "y": 0},
    "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": "naive"}],
    "writes": [{"variable": "COM_REFEREE", "value": 2}]
  },
  "runs": 4, "seed": 7,
  "conditions": [
    {"name": "plain", "set": {"noise": "none"}},
    {"name": "noisy", "set": {"noise": "paper", "noise.forward": 0.01}}
  ],
  "starts": {"robots": {"x": 0.1, "y": 0.1, "heading": 5}},
  "metrics": [{"name": "nearest_cm", "unit": "cm", "expression": "B1.TRUE_BALL_DIST", "reduce": "min"}],
  "stop": {"duration": 3},
  "success": "nearest_cm < 25",
  "assertions": ["p95(nearest_cm) < 60", {"check": "time_s == 3", "condition": "plain"}]
})";

inline Experiment experimentFrom(const std::string& text) {
  auto made = experimentFromJson(text, "test.json");
  if (!made) qFatal("%s", made.error().text().c_str());
  return std::move(*made);
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) qFatal("no %s", what.c_str());
  return text.replace(at, what.size(), by);
}

inline std::vector<std::size_t> numbers(std::size_t from, std::size_t to, std::size_t step = 1) {
  std::vector<std::size_t> out;
  for (std::size_t n = from; n <= to; n += step) out.push_back(n);
  return out;
}

}  // namespace experiment_rig

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The drawings that are visible on the field at a moment: the layers of all robots, each for as
// long as it lives. Memory is bounded by DrawingLimits. A plain value, not thread-safe. Times are
// seconds of the source and are arguments; no clock is read.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <base/robot_key.h>
#include <telemetry/drawings/drawings.h>

namespace pitchboard::telemetry {

/// A robot sends under another key from now on.
struct Renaming {
  RobotKey from, to;
};

/// The layers of one robot, sorted by name. The layers themselves never change.
struct RobotDrawings {
  RobotKey robot;  ///< key of the first sender of that number
  std::vector<std::shared_ptr<const DrawingLayer>> layers;
  bool operator==(const RobotDrawings& other) const;
};

class DrawingStore {
 public:
  /// Adds a drawing that arrived at `time` from a robot of `team` (RobotKey::team). Fails as
  /// parseDrawing() does, or if the robot would exceed its limits; then nothing changes and the
  /// drawing is counted as refused.
  Result<void> take(std::string_view text, double time, int team = 0);
  Result<void> take(Drawing drawing, double time, int team = 0);

  /// Returns the visible layers by robot; robots without a layer are left out.
  std::vector<RobotDrawings> at(double time) const;

  std::uint64_t refused() const { return m_refused; }
  /// Returns why the last drawing was refused; empty if none was.
  const std::string& lastProblem() const { return m_lastProblem; }
  void clear() { *this = {}; }
  /// The layers follow their robots to other keys, all at the same time.
  void rename(const std::vector<Renaming>& renamings);
  /// Removes the layers of the robots for which `which` returns true.
  void forget(const std::function<bool(const RobotKey& robot)>& which) {
    std::erase_if(m_robots, [&](const auto& robot) { return which(robot.first); });
  }

  /// A layer as its text with its time. Taking all pages again restores the store.
  struct Page {
    double time = 0.0;
    int team = 0;
    std::string text;
  };
  std::vector<Page> pages(double time) const;

 private:
  struct Shown {
    std::shared_ptr<const DrawingLayer> layer;
    double since = 0.0;
    bool isThere(double time) const;
  };
  using Layers = std::map<std::string, Shown>;
  void forgetOld(double time);

  std::map<RobotKey, Layers> m_robots;
  std::uint64_t m_refused = 0;
  std::string m_lastProblem;
};

}  // namespace pitchboard::telemetry

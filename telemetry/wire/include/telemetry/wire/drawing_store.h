// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is drawn on the field at a moment: the layers of all robots, as their datagrams so far say
// it, each for as long as it lives. Bounded by DrawingLimits. Not thread-safe; a plain value for
// its owner. Times are seconds of the source and are handed in.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <base/robot_key.h>
#include <telemetry/wire/drawings.h>

namespace pitchboard::telemetry {

/// The layers of one robot, by name; what is pointed to never changes.
struct RobotDrawings {
  RobotKey robot;  ///< of the first sender of its number
  std::vector<std::shared_ptr<const DrawingLayer>> layers;
  bool operator==(const RobotDrawings& other) const;
};

class DrawingStore {
 public:
  /// A drawing that was heard at this time, of a robot of `team` (RobotKey::team). Errors as
  /// parseDrawing(), and what is more than the limits allow a robot; they are counted, and nothing
  /// has changed then.
  Result<void> take(std::string_view text, double time, int team = 0);
  Result<void> take(Drawing drawing, double time, int team = 0);

  /// By robot; none without a layer.
  std::vector<RobotDrawings> at(double time) const;

  std::uint64_t refused() const { return m_refused; }
  /// Why the last one was refused; empty: none was.
  const std::string& lastProblem() const { return m_lastProblem; }
  void clear() { *this = {}; }
  void rename(const std::vector<Renaming>& renamings) { pitchboard::rename(m_robots, renamings); }
  /// Drops the layers of the robots for which it says true.
  void forget(const std::function<bool(const RobotKey& robot)>& which) {
    std::erase_if(m_robots, [&](const auto& robot) { return which(robot.first); });
  }

  /// What makes this book again, layer by layer: the text, and when it was heard.
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

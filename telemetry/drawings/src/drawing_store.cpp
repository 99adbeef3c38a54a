// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/drawings/drawing_store.h>

#include <algorithm>

#include <telemetry/formats/text_decoder.h>

namespace pitchboard::telemetry {
namespace {

using Limits = DrawingLimits;

constexpr double tolerance = 1e-6;  // s; files keep whole nanoseconds
// A match that was put back leaves layers of its future behind.
constexpr double oddestClock = 2 * Limits::maxLife;

}  // namespace

bool RobotDrawings::operator==(const RobotDrawings& other) const {
  return robot == other.robot &&
         std::ranges::equal(layers, other.layers,
                            [](const auto& a, const auto& b) { return a == b || *a == *b; });
}

bool DrawingStore::Shown::isThere(double time) const {
  return since <= time + tolerance && time < since + layer->life - tolerance;
}

void DrawingStore::forgetOld(double time) {
  for (auto& [robot, layers] : m_robots) {
    std::erase_if(layers, [time](const auto& named) {
      const Shown& shown = named.second;
      return time >= shown.since + shown.layer->life || shown.since > time + oddestClock;
    });
  }
  std::erase_if(m_robots, [](const auto& robot) { return robot.second.empty(); });
}

void DrawingStore::rename(const std::vector<Renaming>& renamings) {
  std::map<RobotKey, Layers> now;
  for (auto& [robot, layers] : m_robots) {
    const auto found = std::ranges::find(renamings, robot, &Renaming::from);
    now[found == renamings.end() ? robot : found->to] = std::move(layers);
  }
  m_robots = std::move(now);
}

Result<void> DrawingStore::take(std::string_view text, double time, int team) {
  auto drawing = parseDrawing(text);
  if (!drawing) {
    ++m_refused;
    m_lastProblem = drawing.error().text();
    return tl::unexpected(std::move(drawing.error()));
  }
  return take(std::move(*drawing), time, team);
}

Result<void> DrawingStore::take(Drawing drawing, double time, int team) {
  forgetOld(time);
  const RobotKey robot{team, drawing.robot};
  const auto refuse = [this, robot](const std::string& sentence) {
    ++m_refused;
    const std::string whose = "drawing of robot " + std::to_string(robot.number);
    m_lastProblem = whose + ": " + sentence;
    return failure(ErrorCode::InvalidArgument, sentence, whose);
  };
  const auto known = m_robots.find(robot);
  if (known == m_robots.end() && m_robots.size() == Limits::robots) {
    return refuse("64 robots are already drawing");
  }
  Layers layers = known == m_robots.end() ? Layers() : known->second;
  for (DrawingLayer& layer : drawing.layers) {
    const auto before = layers.find(layer.name);
    if (layer.adds && before != layers.end() && before->second.isThere(time)) {
      const DrawingLayer& old = *before->second.layer;
      layer.shapes.insert(layer.shapes.begin(), old.shapes.begin(), old.shapes.end());
      if (layer.shapes.size() > Limits::shapes || layer.points() > Limits::points) {
        return refuse("layer \"" + layer.name + "\" has more than " +
                      std::to_string(Limits::shapes) + " shapes or " +
                      std::to_string(Limits::points) + " points; draw less, or on several layers");
      }
    }
    layer.adds = false;
    if (layer.shapes.empty()) {
      layers.erase(layer.name);
      continue;
    }
    const std::string name = layer.name;
    layers[name] = {std::make_shared<const DrawingLayer>(std::move(layer)), time};
  }
  std::size_t points = 0;
  for (const auto& [name, shown] : layers) points += shown.layer->points();
  if (layers.size() > Limits::layers || points > Limits::robotPoints) {
    return refuse("it draws more than " + std::to_string(Limits::layers) + " layers or " +
                  std::to_string(Limits::robotPoints) + " points");
  }
  m_robots[robot] = std::move(layers);
  return {};
}

std::vector<RobotDrawings> DrawingStore::at(double time) const {
  std::vector<RobotDrawings> all;
  for (const auto& [robot, layers] : m_robots) {
    RobotDrawings one;
    one.robot = robot;
    for (const auto& [name, shown] : layers) {
      if (shown.isThere(time)) one.layers.push_back(shown.layer);
    }
    if (!one.layers.empty()) all.push_back(std::move(one));
  }
  return all;
}

std::vector<DrawingStore::Page> DrawingStore::pages(double time) const {
  std::vector<Page> pages;
  for (const auto& [robot, layers] : m_robots) {
    for (const auto& [name, shown] : layers) {
      if (!shown.isThere(time)) continue;
      Drawing drawing;
      drawing.robot = robot.number;
      drawing.layers = {*shown.layer};
      pages.push_back({shown.since, robot.team, drawingText(drawing)});
    }
  }
  std::ranges::sort(pages, {}, &Page::time);
  return pages;
}

}  // namespace pitchboard::telemetry

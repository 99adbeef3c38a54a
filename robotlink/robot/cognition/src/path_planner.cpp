// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/path_planner.h>

#include <base/repeatable_math.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pitchboard::link {
namespace {

constexpr int corners = 10;
constexpr double rim = 1e-3;  // m, kept between a corner and the circle it goes round

bool finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Directions from an obstacle's centre to the corners round it.
const std::array<Point, corners>& cornerDirections() {
  static const std::array<Point, corners> all = [] {
    std::array<Point, corners> out;
    for (int i = 0; i < corners; ++i) {
      const auto [s, c] = repeatable::sinCos(2.0 * std::numbers::pi * i / corners);
      out[static_cast<std::size_t>(i)] = {c, s};
    }
    return out;
  }();
  return all;
}

/// The open disc is crossed by the segment from a to b, which is `length` long.
bool crosses(const Obstacle& o, const Point& a, const Point& b, double length) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double cx = o.centre.x - a.x, cy = o.centre.y - a.y;
  // Most are beside it; the margin is far above what the exact way rounds.
  if (std::abs(cx * dy - cy * dx) > (o.radius + 1e-6) * length) return false;
  const double length2 = dx * dx + dy * dy;
  const double along = cx * dx + cy * dy;
  const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  return distance({a.x + t * dx, a.y + t * dy}, o.centre) < o.radius;
}

/// One search, in memory that the next one uses again.
class PathSearch {
 public:
  Path plan(const Point& start, const Point& target, std::span<const Obstacle> obstacles,
            double halfLength, double halfWidth);

 private:
  struct Node {
    Point point;
    double toTarget = 0.0, cost = 0.0;  // m
    int parent = -1;
    bool open = false, closed = false;
  };
  struct Near {
    double distance;  // of its centre, m
    int obstacle;
  };
  bool within(const Point& p) const;
  void sortObstacles(const Point& from);
  int firstHit(const Point& from, const Point& to, double length) const;
  void activate(std::size_t obstacle);
  Point freeTarget(const Point& target, const Point& start, bool& free) const;
  bool search();
  void addPoints(Path& path);

  double m_halfLength = 0.0, m_halfWidth = 0.0;
  std::vector<Obstacle> m_obstacles;
  double m_largest = 0.0;    // radius of an obstacle
  std::vector<Near> m_near;  // all of them, the nearest to the node that is expanded first
  std::vector<char> m_active;
  std::vector<Node> m_nodes;     // 0 start, 1 target, then corners
  std::vector<int> m_hit;        // obstacles that stood in the way of the last search
  std::vector<int> m_pathNodes;  // nodes of the path, the last first
  int m_end = 1;                 // node where the last search ended
};

bool PathSearch::within(const Point& p) const {
  return std::abs(p.x) <= m_halfLength && std::abs(p.y) <= m_halfWidth;
}

void PathSearch::sortObstacles(const Point& from) {
  m_near.clear();
  for (std::size_t i = 0; i < m_obstacles.size(); ++i) {
    m_near.push_back({distance(from, m_obstacles[i].centre), static_cast<int>(i)});
  }
  std::ranges::sort(m_near, [](const Near& a, const Near& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.obstacle < b.obstacle;
  });
}

/// The obstacle nearest to `from` that the segment crosses, or -1.
int PathSearch::firstHit(const Point& from, const Point& to, double length) const {
  const double reach = length + m_largest + 1e-6;
  for (const auto& [centre, obstacle] : m_near) {
    if (centre > reach) break;
    if (crosses(m_obstacles[static_cast<std::size_t>(obstacle)], from, to, length)) return obstacle;
  }
  return -1;
}

void PathSearch::activate(std::size_t obstacle) {
  if (m_active[obstacle]) return;
  m_active[obstacle] = 1;
  const Obstacle& o = m_obstacles[obstacle];
  // Circumscribed, so that an edge between two neighbours does not cut the circle.
  static const double halfCorner = repeatable::cos(std::numbers::pi / corners);
  const double radius = o.radius / halfCorner + rim;
  for (const Point& to : cornerDirections()) {
    const Point p{o.centre.x + radius * to.x, o.centre.y + radius * to.y};
    const auto covering = std::ranges::find_if(
        m_obstacles, [&](const Obstacle& c) { return distance(p, c.centre) < c.radius; });
    if (covering != m_obstacles.end()) {
      // The two overlap: who goes round one has to go round the other.
      activate(static_cast<std::size_t>(covering - m_obstacles.begin()));
    } else if (within(p)) {
      m_nodes.push_back({.point = p});
    }
  }
}

Point PathSearch::freeTarget(const Point& target, const Point& start, bool& free) const {
  Point p = target;
  // Leaving one obstacle may lead into its neighbour; a few rounds settle all but hopeless cases.
  for (std::size_t round = 0; round <= m_obstacles.size() && round < 8; ++round) {
    const auto inside = std::ranges::find_if(
        m_obstacles, [&](const Obstacle& o) { return distance(p, o.centre) < o.radius; });
    if (inside == m_obstacles.end()) break;
    free = false;
    Point away{p.x - inside->centre.x, p.y - inside->centre.y};
    if (length(away) < rim) {
      away = {start.x - inside->centre.x, start.y - inside->centre.y};
    }
    const double gap = length(away);
    if (gap < rim) away = {1.0, 0.0};
    const double scale = (inside->radius + rim) / std::max(gap, rim);
    p = {inside->centre.x + away.x * scale, inside->centre.y + away.y * scale};
  }
  return p;
}

/// A* over the present corners. Notes the obstacles that stood in the way.
bool PathSearch::search() {
  const Point target = m_nodes[1].point;
  for (Node& node : m_nodes) {
    node = {.point = node.point, .toTarget = distance(node.point, target)};
  }
  m_nodes[0].open = true;
  int nearest = 0;
  for (;;) {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < m_nodes.size(); ++i) {
      if (!m_nodes[i].open) continue;
      const double estimate = m_nodes[i].cost + m_nodes[i].toTarget;
      if (estimate < least) {
        least = estimate;
        best = static_cast<int>(i);
      }
    }
    if (best < 0) break;
    Node& node = m_nodes[static_cast<std::size_t>(best)];
    node.open = false;
    node.closed = true;
    if (node.toTarget < m_nodes[static_cast<std::size_t>(nearest)].toTarget) nearest = best;
    if (best == 1) {
      m_end = 1;
      return true;
    }
    sortObstacles(node.point);
    for (std::size_t i = 1; i < m_nodes.size(); ++i) {
      Node& other = m_nodes[i];
      if (other.closed) continue;
      const double length = distance(node.point, other.point);
      const double cost = node.cost + length;
      if (other.open && other.cost <= cost) continue;
      const int blocker = firstHit(node.point, other.point, length);
      if (blocker >= 0) {
        m_hit.push_back(blocker);
        continue;
      }
      other.cost = cost;
      other.parent = best;
      other.open = true;
    }
  }
  m_end = nearest;
  return false;
}

Path PathSearch::plan(const Point& start, const Point& target, std::span<const Obstacle> obstacles,
                      double halfLength, double halfWidth) {
  m_halfLength = halfLength;
  m_halfWidth = halfWidth;
  Path path;
  if (!finite(start) || !finite(target)) return path;
  m_obstacles.clear();
  m_largest = 0.0;
  for (Obstacle o : obstacles) {
    if (!finite(o.centre) || !std::isfinite(o.radius)) continue;
    o.radius = std::min(o.radius, distance(o.centre, start) - rim);
    if (o.radius <= 0.0) continue;
    m_obstacles.push_back(o);
    m_largest = std::max(m_largest, o.radius);
  }
  m_active.assign(m_obstacles.size(), 0);
  m_nodes.clear();
  m_nodes.push_back({.point = start});
  m_nodes.push_back({.point = freeTarget(target, start, path.targetFree)});

  for (;;) {
    m_hit.clear();
    path.complete = search();
    if (path.complete) {
      // Corners of obstacles beside this path cannot make it shorter: it is free, and every edge
      // that was dropped for a blocked one leads round an obstacle that has corners already.
      const bool allActive = std::ranges::all_of(
          m_hit, [&](int i) { return m_active[static_cast<std::size_t>(i)] != 0; });
      if (allActive) break;
    }
    const std::size_t before = m_nodes.size();
    bool news = false;
    for (const int i : m_hit) {
      news = news || !m_active[static_cast<std::size_t>(i)];
      activate(static_cast<std::size_t>(i));
    }
    if (!news || (m_nodes.size() == before && path.complete)) break;
  }

  addPoints(path);
  return path;
}

void PathSearch::addPoints(Path& path) {
  m_pathNodes.clear();
  for (int i = m_end; i >= 0; i = m_nodes[static_cast<std::size_t>(i)].parent) {
    m_pathNodes.push_back(i);
  }
  Point last = m_nodes[static_cast<std::size_t>(m_pathNodes.back())].point;
  if (m_pathNodes.size() == 1) path.points.push_back(last);
  for (std::size_t i = m_pathNodes.size(); i-- > 0;) {
    const Point& point = m_nodes[static_cast<std::size_t>(m_pathNodes[i])].point;
    path.length += distance(last, point);
    if (!path.points.full()) path.points.push_back(point);
    last = point;
  }
}

}  // namespace

Path PathPlanner::plan(const Point& start, const Point& target,
                       std::span<const Obstacle> obstacles) const {
  static thread_local PathSearch search;
  return search.plan(start, target, obstacles, m_halfLength, m_halfWidth);
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/path_planner.h>

#include <QtTest>

#include <cmath>
#include <limits>
#include <numbers>

#include <base/random.h>

namespace tst_path_planner {

using namespace pitchboard;
using link::Obstacle;
using link::Path;

namespace {

double distanceToSegment(const Point& c, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
  const double t = l > 0 ? std::clamp(((c.x - a.x) * dx + (c.y - a.y) * dy) / l, 0.0, 1.0) : 0.0;
  return distance({a.x + t * dx, a.y + t * dy}, c);
}

bool isFree(const Path& path, const std::vector<Obstacle>& obstacles) {
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    for (const Obstacle& o : obstacles) {
      if (distanceToSegment(o.centre, path.points[i - 1], path.points[i]) < o.radius - 1e-9)
        return false;
    }
  }
  return true;
}

}  // namespace

class TestPathPlanner : public QObject {
  Q_OBJECT
 private slots:
  void freeLineIsStraight() {
    link::PathPlanner planner(5.2, 3.7);
    const Path path = planner.plan({-1, 0}, {2, 1}, {});
    QCOMPARE(path.points.size(), 2U);
    QVERIFY(path.complete && path.targetFree);
    QCOMPARE(path.length, std::hypot(3.0, 1.0));
  }

  void goesRoundOneCircleByTheShorterSide() {
    link::PathPlanner planner(5.2, 3.7);
    const std::vector<Obstacle> obstacles{{{0, 0.1}, 0.5}};
    const Path path = planner.plan({-2, 0}, {2, 0}, obstacles);
    QVERIFY(path.complete);
    QVERIFY(isFree(path, obstacles));
    for (const Point& p : path.points)
      QVERIFY(p.y < 0.01);  // below: the centre lies above the line
    // The exact shortest path: two tangents and an arc.
    const double d = std::hypot(2.0, 0.1), tangent = std::sqrt(d * d - 0.25);
    const double arc = 0.5 * (std::numbers::pi - 2 * std::acos(0.5 / d) - 2 * std::atan2(0.1, 2.0));
    const double exact = 2 * tangent + arc;
    QVERIFY2(path.length > exact - 1e-6 && path.length < 1.03 * exact,
             qPrintable(QString::number(path.length / exact)));
  }

  void startInsideAnObstacleLeadsOut() {
    link::PathPlanner planner(5.2, 3.7);
    const Path path = planner.plan({0.1, 0}, {2, 0}, std::vector<Obstacle>{{{0, 0}, 0.5}});
    QVERIFY(path.complete && path.targetFree);
    QVERIFY(path.next().x > 0.1);
    // In its very centre too.
    QVERIFY(planner.plan({0, 0}, {2, 0}, std::vector<Obstacle>{{{0, 0}, 0.5}}).complete);
  }

  void targetInsideAnObstacleEndsOnItsRim() {
    link::PathPlanner planner(5.2, 3.7);
    const std::vector<Obstacle> obstacles{{{2, 0}, 0.5}};
    for (const Point target : {Point{1.8, 0}, Point{2, 0}, Point{2.3, 0.1}}) {
      const Path path = planner.plan({-2, 0}, target, obstacles);
      QVERIFY(path.complete && !path.targetFree);
      QVERIFY(isFree(path, obstacles));
      const Point end = path.points.back();
      QVERIFY(std::abs(std::hypot(end.x - 2, end.y) - 0.5) < 0.01);
    }
  }

  void withoutAPathItEndsNearest() {
    link::PathPlanner planner(5.2, 3.7);
    std::vector<Obstacle> ring;
    for (int i = 0; i < 12; ++i) {
      const double a = i * std::numbers::pi / 6;
      ring.push_back({{3 + std::cos(a), std::sin(a)}, 0.4});
    }
    const Path path = planner.plan({-2, 0}, {3, 0}, ring);
    QVERIFY(!path.complete);
    QVERIFY(path.points.size() >= 2);
    QVERIFY(isFree(path, ring));
    QVERIFY(std::hypot(path.points.back().x - 3, path.points.back().y) < 1.8);
  }

  void staysInsideTheWalls() {
    link::PathPlanner planner(5.2, 3.7);
    const std::vector<Obstacle> wall{{{0, 3.5}, 0.6}, {{0, 2.6}, 0.6}};
    const Path path = planner.plan({-2, 3.4}, {2, 3.4}, wall);
    QVERIFY(path.complete && isFree(path, wall));
    for (const Point& p : path.points) QVERIFY(std::abs(p.y) <= 3.7);
  }

  void badNumbersGiveNoPathOrAreIgnored() {
    link::PathPlanner planner(5.2, 3.7);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    QVERIFY(planner.plan({nan, 0}, {1, 0}, {}).points.empty());
    QVERIFY(planner.plan({0, 0}, {1, nan}, {}).points.empty());
    const std::vector<Obstacle> odd{{{nan, 0}, 1}, {{0.5, 0}, nan}, {{0.5, 0}, -1}, {{0.5, 0}, 0}};
    QCOMPARE(planner.plan({0, 0}, {1, 0}, odd).points.size(), 2U);
    QCOMPARE(planner.plan({1, 1}, {1, 1}, {}).points.size(), 2U);
  }

  void randomFieldsAreFreeAndNeverShorterThanTheLine() {
    link::PathPlanner planner(5.2, 3.7);
    int bends = 0;
    for (std::uint64_t round = 0; round < 300; ++round) {
      CounterRandom random(7, 1, NoiseStream::Behaviour, round);
      const auto place = [&random] {
        const double x = 10 * random.uniform() - 5;
        return Point{x, 7 * random.uniform() - 3.5};
      };
      std::vector<Obstacle> obstacles;
      const Point start = place(), target = place();
      while (obstacles.size() < 16) {
        const Obstacle o{place(), 0.3};
        const auto clear = [&o](const Point& p) { return distance(p, o.centre) > 0.4; };
        if (clear(start) && clear(target)) obstacles.push_back(o);
      }
      const Path path = planner.plan(start, target, obstacles);
      QVERIFY(isFree(path, obstacles));
      if (!path.complete) continue;
      QVERIFY(path.length >= distance(start, target) - 1e-9);
      bends += static_cast<int>(path.points.size()) - 2;
    }
    QVERIFY(bends > 100);
  }
};

PITCHBOARD_TEST(TestPathPlanner)

}  // namespace tst_path_planner

#include "tst_path_planner.moc"

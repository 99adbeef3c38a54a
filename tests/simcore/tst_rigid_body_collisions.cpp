// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/random.h>

#include <QtTest>

#include "rigid_body_rig.h"

namespace tst_rigid_body_collisions {

using namespace rig;

namespace {

/// Commands that change every second, from the counter-based generator.
void drawCommands(Rig& r, std::uint64_t seed) {
  static constexpr int actions[] = {1, 1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 14, 17, 12};
  const std::uint64_t tick = r.simulation.state().tick;
  if (tick % 60 != 0) return;
  for (std::size_t i = 0; i < r.commands.size(); ++i) {
    CounterRandom random(seed, static_cast<int>(i), NoiseStream::Behaviour, tick);
    r.commands[i].actionA = actions[static_cast<int>(random.uniform() * std::size(actions))];
    r.commands[i].actionB = 10;
  }
}

}  // namespace

class TestRigidBodyCollisions : public QObject {
  Q_OBJECT

 private slots:
  void longPileUpNeverOverlaps_data() {
    QTest::addColumn<double>("rate");
    QTest::addColumn<double>("noise");
    QTest::addColumn<double>("spread");
    QTest::newRow("all over the field") << 60.0 << 0.0 << 1.2;
    QTest::newRow("dense") << 60.0 << 0.0 << 0.3;
    QTest::newRow("dense, noise") << 60.0 << 0.002 << 0.3;
    QTest::newRow("dense, 10 Hz") << 10.0 << 0.0 << 0.3;
    QTest::newRow("dense, 10 Hz, noise") << 10.0 << 0.002 << 0.3;
    QTest::newRow("dense, 240 Hz, noise") << 240.0 << 0.002 << 0.3;
  }
  void longPileUpNeverOverlaps() {
    QFETCH(double, rate);
    QFETCH(double, noise);
    QFETCH(double, spread);
    SimulationSettings settings = atRate(rate);
    settings.noise.forward = settings.noise.sideways = noise;
    settings.noise.rotation = noise;
    Rig r(settings);
    for (int i = 0; i < 22; ++i) {
      const double x = (i % 6 - 2.5) * spread;
      const double y = (i / 6 - 1.5) * spread;
      r.add({{x, y}, std::atan2(-y, -x)});  // facing the middle
    }
    r.placeBall(-4, -2.5);
    double deepest = -1;
    int settling = 0, checked = 0, placings = 0;
    for (int i = 0; i < 6000; ++i) {
      drawCommands(r, 3);
      if (i % 500 == 0) r.placeBall(r.ball().position.x, r.ball().position.y, 5, 4);
      r.step();
      // The rules may put the ball onto a robot; the two then need a moment to part.
      for (const Event& event : r.simulation.events()) {
        const bool placed = event.kind == EventKind::Goal || event.kind == EventKind::BallOut;
        if (placed) settling = static_cast<int>(rate);
        placings += placed ? 1 : 0;
      }
      checked += settling <= 0 ? 1 : 0;
      if (--settling < 0) deepest = std::max(deepest, deepestOverlap(r));
      for (const RigidRobot& robot : r.state().robots) {
        QVERIFY(std::hypot(robot.forwardSpeed, robot.sidewaysSpeed) < 1.0);
      }
    }
    QVERIFY2(deepest < 0.001, qPrintable(QString::number(deepest)));
    qInfo("%d of 6000 ticks checked, ball placed %d times", checked, placings);
    QVERIFY(checked > 3000);
  }

  void walkingIntoEachOtherStops() {
    Rig r;
    r.add({{-0.5, 0}, 0});
    r.add({{0.5, 0}, pi});
    r.placeBall(3, 2);
    r.commands[0].actionA = r.commands[1].actionA = 1;
    r.run(10.0);
    QVERIFY(std::abs(r.robot(0).pose.position.x + 0.13) < 0.002);
    QVERIFY(std::abs(r.robot(1).pose.position.x - 0.13) < 0.002);
  }

  void pushingIsLimited() {
    Rig r;
    r.add({{-0.5, 0}, 0});
    r.add({{0.0, 0}, 0});
    r.placeBall(3, 2);
    r.commands[0].actionA = 1;
    r.run(10.0);
    // A walk of 1.8 m moves the other by at most a tenth of it.
    QVERIFY2(r.robot(1).pose.position.x < 0.18,
             qPrintable(QString::number(r.robot(1).pose.position.x)));
  }

  void obliqueRobotsSlide() {
    Rig r;
    r.add({{-0.5, 0.1}, 0});
    r.add({{0.0, 0}, 0});
    r.placeBall(3, 2);
    r.commands[0].actionA = 1;
    r.run(12.0);
    QVERIFY(r.robot(0).pose.position.x > 0.3);
  }

  void wallsAndPostsStop_data() {
    QTest::addColumn<Pose>("from");
    QTest::newRow("wall right") << Pose{{4.8, 2}, 0};
    QTest::newRow("wall up") << Pose{{2, 3.2}, pi / 2};
    QTest::newRow("post") << Pose{{4.0, 0.9}, 0};
    QTest::newRow("side net from outside") << Pose{{4.9, 1.4}, -pi / 2};
    QTest::newRow("side net from inside") << Pose{{4.9, 0.4}, pi / 2};
    QTest::newRow("corner") << Pose{{4.8, 3.3}, pi / 4};
  }
  void wallsAndPostsStop() {
    QFETCH(Pose, from);
    for (const double rate : {10.0, 60.0, 1000.0}) {
      Rig r(atRate(rate));
      r.add(from);
      r.placeBall(-3, -2);
      r.commands[0].actionA = 1;
      for (int i = 0; i < 10 * static_cast<int>(rate); ++i) {
        r.step();
        QVERIFY(deepestOverlap(r) < 0.001);
      }
      QVERIFY(std::hypot(r.robot().velocity.x, r.robot().velocity.y) < 0.02);
    }
  }

  void draggedOntoAnotherPartsSmoothly_data() {
    QTest::addColumn<Point>("onto");
    QTest::addColumn<double>("rate");
    QTest::newRow("beside") << Point{0.05, 0.02} << 60.0;
    QTest::newRow("exactly") << Point{0.0, 0.0} << 60.0;
    QTest::newRow("exactly, 10 Hz") << Point{0.0, 0.0} << 10.0;
    QTest::newRow("exactly, 1000 Hz") << Point{0.0, 0.0} << 1000.0;
  }
  void draggedOntoAnotherPartsSmoothly() {
    QFETCH(Point, onto);
    QFETCH(double, rate);
    Rig r(atRate(rate));
    r.add({{0, 0}, 0});
    r.add({{2, 0}, 0});
    r.placeBall(0.02, 0);
    r.place(2, {onto, 1});
    double last = deepestOverlap(r);
    for (int i = 0; i < 2 * static_cast<int>(rate); ++i) {
      const Point a = r.robot(0).pose.position, b = r.robot(1).pose.position;
      r.step();
      const Point c = r.robot(0).pose.position, d = r.robot(1).pose.position;
      QVERIFY(std::hypot(c.x - a.x, c.y - a.y) <= 2.0 / rate + 0.005);
      QVERIFY2(std::hypot(d.x - b.x, d.y - b.y) <= 2.0 / rate + 0.005,
               qPrintable(
                   QString("moved %1 m in tick %2").arg(std::hypot(d.x - b.x, d.y - b.y)).arg(i)));
      const double now = deepestOverlap(r);
      QVERIFY(now <= std::max(last, 0.001) + 1e-6);
      last = now;
    }
    QVERIFY(last < 0.001);
    QVERIFY(std::hypot(r.robot(1).pose.position.x, r.robot(1).pose.position.y) < 0.6);
    QVERIFY(std::hypot(r.ball().position.x, r.ball().position.y) < 1.5);
  }

  void aBallInACornerOfRobotsDoesNotExplode() {
    Rig r;
    r.add({{4.6, 3.57}, 0});
    r.add({{5.07, 3.2}, pi / 2});
    r.placeBall(5.1, 3.6);
    r.commands[0].actionA = r.commands[1].actionA = 1;
    for (int i = 0; i < 1200; ++i) {
      r.step();
      QVERIFY(deepestOverlap(r) < 0.001);
      QVERIFY(std::hypot(r.ball().velocity.x, r.ball().velocity.y) < 3);
    }
  }
};

PITCHBOARD_TEST(TestRigidBodyCollisions)

}  // namespace tst_rigid_body_collisions

#include "tst_rigid_body_collisions.moc"

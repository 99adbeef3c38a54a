// SPDX-License-Identifier: GPL-3.0-or-later

// A step is a pure function of the state: saving and restoring, golden hash, and no allocation.

#include <base/random.h>

#include <QtTest>

#include "../support/allocation_counter.h"
#include "rigid_body_rig.h"

using namespace rig;

namespace {

constexpr int actions[] = {1, 1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 14, 17, 12};

/// Ten robots round the ball, all of them walking into it, with noise, falls and a vision delay.
Rig pileUp(double rate = 60.0) {
  SimulationSettings settings = atRate(rate);
  settings.seed = 77;
  settings.rigidBody.falls = true;
  settings.noise.forward = settings.noise.sideways = 0.001;
  settings.noise.rotation = 0.002;
  settings.noise.kickSpeed = 0.1;
  settings.noise.kickAngle = 0.05;
  settings.noise.visionDistance = 0.1;
  settings.noise.missedDetection = 0.1;
  settings.noise.visionDelay = 0.1;
  settings.noise.imuWhite = 0.01;
  settings.noise.imuDrift = 0.001;
  Rig r(settings);
  for (int i = 0; i < 10; ++i) {
    const double at = i * pi / 5;
    r.add({{0.6 * std::cos(at), 0.6 * std::sin(at)}, at + pi}, i + 1,
          i % 2 == 0 ? TeamColor::Blue : TeamColor::Red);
    RobotModel weak;
    weak.fallImpulse = 0.3;
    (void)r.simulation.setRobotModel({i + 1}, weak);
  }
  r.placeBall(0.05, 0.02);
  return r;
}

void command(Rig& r) {
  const std::uint64_t tick = r.simulation.state().tick;
  for (std::size_t i = 0; i < r.commands.size(); ++i) {
    CounterRandom random(3, static_cast<int>(i), NoiseStream::Behaviour, tick / 50);
    // Mostly forward, so that they stay in a heap.
    const bool forward = random.uniform() < 0.6;
    const auto pick = static_cast<std::size_t>(random.uniform() * std::size(actions));
    r.commands[i].actionA = forward ? 1 : actions[pick];
    r.commands[i].actionB = 10;
    r.commands[i].searchOn = 1;
    r.commands[i].localizationLook = static_cast<int>(i) % 2;
    r.commands[i].actionVision = static_cast<int>(i) % 3;
  }
}

}  // namespace

class TestRigidBodyRepeat : public QObject {
  Q_OBJECT

 private slots:
  void restoredMomentsGoOnAlike_data() {
    QTest::addColumn<int>("at");
    QTest::addColumn<double>("rate");
    QTest::newRow("in the middle of the heap") << 120 << 60.0;
    QTest::newRow("later") << 700 << 60.0;
    QTest::newRow("10 Hz") << 30 << 10.0;
    QTest::newRow("500 Hz") << 1000 << 500.0;
  }
  void restoredMomentsGoOnAlike() {
    QFETCH(int, at);
    QFETCH(double, rate);
    Rig one = pileUp(rate);
    for (int i = 0; i < at; ++i) {
      command(one);
      one.step();
    }
    const WorldState saved = one.simulation.state();
    Rig other = pileUp(rate);
    QVERIFY(other.simulation.restore(saved).has_value());
    QCOMPARE(other.simulation.hash(), one.simulation.hash());
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 2000; ++i) {
      command(one);
      command(other);
      one.step();
      other.step();
      hashes.push_back(one.simulation.hash());
      QCOMPARE(other.simulation.hash(), hashes.back());
    }
    // The first one has run on; put back, it must do the same again. Written over the state, even
    // the same physics object with its memory of 2000 ticks goes on alike.
    one.simulation.editState() = saved;
    for (const std::uint64_t hash : hashes) {
      command(one);
      one.step();
      QCOMPARE(one.simulation.hash(), hash);
    }
    QVERIFY(one.simulation.state() == other.simulation.state());
  }

  void refusesAStateOfAnotherShape() {
    Rig r = pileUp();
    WorldState broken = r.simulation.state();
    std::get<RigidBodyState>(broken.physics).robots.pop_back();
    QVERIFY(!r.simulation.restore(broken).has_value());
    broken = r.simulation.state();
    std::get<RigidBodyState>(broken.physics).past[3].robots.clear();
    QVERIFY(!r.simulation.restore(broken).has_value());
  }

  void goldenHash() {
    // 10 simulated seconds. A change of this number means that recorded runs no longer repeat:
    // change it only together with the physics, and say so.
    Rig r = pileUp();
    for (int i = 0; i < 600; ++i) {
      command(r);
      r.step();
    }
    QCOMPARE(QString::number(r.simulation.hash(), 16), QStringLiteral("a531a4e9b98cf05b"));
  }

  void aTickAllocatesNothing() {
    if (!countsAllocations) QSKIP("the sanitizer has its own allocation functions");
    Rig r = pileUp();
    for (int i = 0; i < 5; ++i) {
      command(r);
      r.step();
    }
    const long before = allocations;
    for (int i = 0; i < 3000; ++i) {
      command(r);
      r.step();
    }
    QCOMPARE(allocations.load() - before, 0L);
    QVERIFY(theCounterCounts());
  }

  void aRobotsMotionDoesNotDependOnAFarOne() {
    Rig one = pileUp();
    Rig two = pileUp();
    two.add({{-4, -2.5}, 0}, 40);
    for (int i = 0; i < 600; ++i) {
      command(one);
      command(two);
      two.commands[10] = {};
      one.step();
      two.step();
      for (std::size_t k = 0; k < 10; ++k) {
        QCOMPARE(two.robot(k).pose, one.robot(k).pose);
        QCOMPARE(two.robot(k).imuDrift, one.robot(k).imuDrift);
      }
    }
  }
};

QTEST_GUILESS_MAIN(TestRigidBodyRepeat)
#include "tst_rigid_body_repeat.moc"

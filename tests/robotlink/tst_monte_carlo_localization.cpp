// SPDX-License-Identifier: GPL-3.0-or-later
// The filter alone, on perfect and on noisy walks made here; no simulator.
#include "localization/monte_carlo_localization.h"

#include <QtTest>

#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/random.h>

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr double pi = std::numbers::pi;
constexpr Point corners[4] = {{-4.5, 3}, {4.5, 3}, {-4.5, -3}, {4.5, -3}};

/// A robot that walks straight, turns at the border, and senses with the errors of the paper.
struct Walker {
  Pose pose;
  bool facesLeft = false;
  std::uint64_t seed = 1;
  std::uint64_t cycle = 0;
  double imuZero = 0.0;

  LocalizationInput step() {
    CounterRandom random(seed, 99, NoiseStream::Motion, cycle++);
    LocalizationInput input;
    input.seconds = 0.1;
    input.inMotion = true;
    const double ahead = 1.2;
    const double x = pose.position.x + ahead * std::cos(pose.yaw);
    const double y = pose.position.y + ahead * std::sin(pose.yaw);
    if (std::abs(x) > 4.2 || std::abs(y) > 2.7) {
      input.turn = radiansFromDegrees(1.8);
    } else {
      input.forward = 0.018;
    }
    pose.yaw = wrapToPi(pose.yaw + random.normal(input.turn, 0.004));
    const double walked = random.normal(input.forward, 0.005);
    pose.position.x += walked * std::cos(pose.yaw);
    pose.position.y += walked * std::sin(pose.yaw);
    for (std::size_t i = 0; i < 4; ++i) {
      const double bearing = wrapToPi(direction(pose.position, corners[i]) - pose.yaw);
      if (std::abs(bearing) < pi / 2 && random.uniform() < 0.25) {
        input.corners[i] = random.normal(bearing, radiansFromDegrees(5));
      }
    }
    input.imuYaw = wrapToPi(random.normal(pose.yaw + (facesLeft ? pi : 0.0) - imuZero, 0.01));
    return input;
  }
};

double error(const MonteCarloLocalization& filter, const Walker& walker) {
  const Pose& p = filter.belief().pose;
  return distance(p.position, walker.pose.position);
}

}  // namespace

class TestMonteCarloLocalization : public QObject {
  Q_OBJECT
 private slots:
  void findsItselfFromNothing_data() {
    QTest::addColumn<int>("zero");
    QTest::addColumn<bool>("facesLeft");
    QTest::newRow("attacks right, told") << static_cast<int>(ImuZero::Right) << false;
    QTest::newRow("attacks left, told") << static_cast<int>(ImuZero::Left) << true;
    QTest::newRow("attacks right, not told") << static_cast<int>(ImuZero::Unknown) << false;
    QTest::newRow("attacks left, not told") << static_cast<int>(ImuZero::Unknown) << true;
  }
  void findsItselfFromNothing() {
    QFETCH(int, zero);
    QFETCH(bool, facesLeft);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      auto filter =
          MonteCarloLocalization::create({}, {}, static_cast<ImuZero>(zero), seed).value();
      CounterRandom random(seed, 5, NoiseStream::Behaviour, 0);
      Walker walker;
      walker.pose = {{8 * random.uniform() - 4, 5 * random.uniform() - 2.5},
                     6 * random.uniform() - 3};
      walker.facesLeft = facesLeft;
      walker.seed = seed;
      std::vector<double> errors;
      for (int i = 0; i < 600; ++i) {
        filter.update(walker.step());
        if (i >= 200) errors.push_back(error(filter, walker));
      }
      std::sort(errors.begin(), errors.end());
      QVERIFY2(
          errors[errors.size() / 2] < 0.25,
          qPrintable(QString("seed %1: median %2 m").arg(seed).arg(errors[errors.size() / 2])));
      QVERIFY(std::abs(wrapToPi(filter.belief().pose.yaw - walker.pose.yaw)) <
              radiansFromDegrees(10));
    }
  }

  void recoversFromKidnapping() {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      auto filter = MonteCarloLocalization::create({}, {}, ImuZero::Right, seed).value();
      Walker walker;
      walker.pose = {{-3, 1.5}, 0.3};
      walker.seed = seed;
      for (int i = 0; i < 300; ++i) filter.update(walker.step());
      QVERIFY(error(filter, walker) < 0.6);
      walker.pose = {{3, -1.5}, -2.5};
      for (int i = 0; i < 200; ++i) filter.update(walker.step());
      QVERIFY2(error(filter, walker) < 0.5,
               qPrintable(QString("seed %1: %2 m").arg(seed).arg(error(filter, walker))));
    }
  }

  // Many walks: of a filter that goes on believing the IMU, every third is lost, not each.
  void aResetOfTheImuDoesNotLoseIt() {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      auto filter = MonteCarloLocalization::create({}, {}, ImuZero::Right, seed).value();
      Walker walker;
      walker.pose = {{-2, 1}, 1.2};
      walker.seed = seed;
      for (int i = 0; i < 300; ++i) filter.update(walker.step());
      walker.imuZero = walker.pose.yaw;
      for (int i = 0; i < 200; ++i) filter.update(walker.step());
      QVERIFY2(error(filter, walker) < 0.6,
               qPrintable(QString("seed %1: %2 m").arg(seed).arg(error(filter, walker))));
    }
  }

  void numberOfParticlesAdapts() {
    auto filter = MonteCarloLocalization::create({}).value();
    Walker walker;
    walker.pose = {{-2, 1}, 0};
    filter.update(walker.step());
    QVERIFY(filter.size() > 3000);
    int least = filter.size();
    for (int i = 0; i < 400; ++i) {
      filter.update(walker.step());
      QVERIFY(filter.size() >= 200 && filter.size() <= 5000);
      least = std::min(least, filter.size());
    }
    QVERIFY2(least < 600, qPrintable(QString::number(least)));
  }

  void publishedParametersKeepTheirNumber() {
    auto filter =
        MonteCarloLocalization::create({}, LocalizationParameters::published(), ImuZero::Right)
            .value();
    Walker walker;
    walker.pose = {{-2, 1}, 0};
    for (int i = 0; i < 300; ++i) {
      filter.update(walker.step());
      QCOMPARE(filter.size(), 5000);
    }
    QVERIFY(error(filter, walker) < 0.8);
  }

  void sameSeedSameBits() {
    const auto run = [](std::uint64_t seed) {
      auto filter = MonteCarloLocalization::create({}, {}, ImuZero::Unknown, seed).value();
      Walker walker;
      for (int i = 0; i < 100; ++i) filter.update(walker.step());
      return filter.belief();
    };
    QCOMPARE(run(4).pose, run(4).pose);
    QCOMPARE(run(4).sigma, run(4).sigma);
    QVERIFY(!(run(4).pose == run(5).pose));
  }

  void startsFromAKnownPose() {
    auto filter = MonteCarloLocalization::create({}).value();
    filter.reset({{1, 2}, 0.5}, 0.1);
    QVERIFY(std::hypot(filter.belief().pose.position.x - 1, filter.belief().pose.position.y - 2) <
            0.02);
    QVERIFY(std::abs(filter.belief().sigma - 0.1 * std::sqrt(2.0)) < 0.01);
  }

  void nonsenseIsIgnored() {
    auto filter = MonteCarloLocalization::create({}).value();
    LocalizationInput bad;
    bad.forward = std::numeric_limits<double>::quiet_NaN();
    bad.turn = std::numeric_limits<double>::infinity();
    bad.seconds = -5;
    bad.imuYaw = std::numeric_limits<double>::quiet_NaN();
    bad.corners[1] = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i) filter.update(bad);
    QVERIFY(std::isfinite(filter.belief().pose.position.x) && std::isfinite(filter.belief().sigma));
  }

  void badParametersAreRefused() {
    LocalizationParameters none;
    none.leastParticles = 0;
    QVERIFY(!MonteCarloLocalization::create({}, none));
    LocalizationParameters crossed;
    crossed.leastParticles = 600;
    crossed.mostParticles = 500;
    QVERIFY(!MonteCarloLocalization::create({}, crossed));
    LocalizationParameters sharp;
    sharp.bearingSigma = 0;
    QVERIFY(!MonteCarloLocalization::create({}, sharp));
    sim::FieldSpec flat;
    flat.length = 0;
    QVERIFY(!MonteCarloLocalization::create(flat));
  }
};

QTEST_GUILESS_MAIN(TestMonteCarloLocalization)
#include "tst_monte_carlo_localization.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// The filter alone, on perfect and on noisy walks made here; no simulator.
#include "localization/fast_noise.h"
#include "localization/monte_carlo_localization.h"

#include <QtTest>

#include <bit>
#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/random.h>

namespace tst_monte_carlo_localization {

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

/// Particles here and there with uneven weights, and all that kernels write.
struct Crowd {
  explicit Crowd(int count) : n(count) {
    CounterRandom random(7, 1, NoiseStream::Behaviour, 0);
    const auto room = static_cast<std::size_t>(particles::capacityFor(n));
    for (auto* array : {&x, &y, &c, &s, &weight, &turn, &along, &across, &scratch}) {
      array->resize(room);
    }
    cells.resize(room);
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      const double yaw = 2 * pi * random.uniform();
      x[i] = static_cast<float>(8 * random.uniform() - 4);
      y[i] = static_cast<float>(5 * random.uniform() - 2.5);
      c[i] = static_cast<float>(std::cos(yaw));
      s[i] = static_cast<float>(std::sin(yaw));
      weight[i] = static_cast<float>(random.uniform());
    }
    FastNoise noise(3, 1);
    for (auto* array : {&turn, &along, &across}) noise.fillNormal(array->data(), n);
  }
  particles::Poses poses() { return {x.data(), y.data(), c.data(), s.data(), n}; }
  double weightOf(int i) const { return static_cast<double>(weight[static_cast<std::size_t>(i)]); }

  int n;
  std::vector<float> x, y, c, s, weight, turn, along, across, scratch;
  std::vector<std::int32_t> cells;
};

constexpr particles::Motion someWay{0.02F, -0.01F, 0.03F, 0.01F, 0.02F, 5.2F, 3.7F};
constexpr particles::Likelihood someTrust{90.0F, 0.02F};

/// Everything that kernels compute, as bits.
std::vector<std::uint64_t> all(const particles::Kernels& k, int n) {
  Crowd crowd(n);
  std::vector<std::uint64_t> out;
  const auto add = [&out](double value) { out.push_back(std::bit_cast<std::uint64_t>(value)); };
  particles::NoiseLanes lanes;
  for (std::size_t i = 0; i < lanes.x.size(); ++i) {
    const auto seed = static_cast<std::uint32_t>(i);
    lanes.x[i] = 1 + seed;
    lanes.y[i] = 1000003 * (seed + 1);
    lanes.z[i] = 77 + seed;
    lanes.w[i] = 0x9E3779B9U * (seed + 3);
  }
  k.fillNormal(lanes, crowd.along.data(), n);
  k.move(crowd.poses(), someWay, crowd.turn.data(), crowd.along.data(), crowd.across.data());
  k.weighBearing(crowd.poses(), crowd.weight.data(), 4.5F, 3.0F, 0.8F, 0.6F, someTrust);
  for (const int count : {1, 2}) {
    for (const bool bothWays : {false, true}) {
      add(k.weighHeading(crowd.poses(), crowd.weight.data(), crowd.scratch.data(),
                         {{0.6F, -0.8F}, {0.8F, 0.6F}, count, bothWays}, {8.0F, 0.05F}));
    }
  }
  add(k.sum(crowd.weight.data(), n));
  add(k.sumOfSquares(crowd.weight.data(), n));
  const particles::Mean mean = k.meanOf(crowd.poses(), crowd.weight.data());
  const particles::Mean near =
      k.meanNear(crowd.poses(), crowd.weight.data(), crowd.scratch.data(), 0.0F, 0.0F, 2.0F);
  for (const auto& one : {mean, near}) {
    for (const double value : {one.weight, one.x, one.y, one.cosine, one.sine}) add(value);
  }
  const particles::Spread spread = k.spreadAbout(crowd.poses(), crowd.weight.data(), 0.1F, 0.2F);
  add(spread.variance);
  add(spread.farthest);
  k.cellsOf(crowd.poses(), {5.2F, 3.7F, 3.3F, 36, 26}, crowd.cells.data());
  k.scale(crowd.weight.data(), n, 1.25F);
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    for (const auto* array : {&crowd.x, &crowd.y, &crowd.c, &crowd.s, &crowd.weight}) {
      add(static_cast<double>((*array)[i]));
    }
    add(crowd.cells[i]);
  }
  return out;
}

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

  void everySimdLevelGivesTheSameBits_data() {
    QTest::addColumn<int>("level");
    QTest::newRow("avx2") << static_cast<int>(SimdLevel::Avx2);
    QTest::newRow("avx512") << static_cast<int>(SimdLevel::Avx512);
  }
  void everySimdLevelGivesTheSameBits() {
    QFETCH(int, level);
    const particles::Kernels* wide = particles::kernelsOf(static_cast<SimdLevel>(level));
    if (!wide) QSKIP("this processor or compiler lacks this SIMD level");
    for (const int n : {1, 7, 8, 16, 203, 500}) {
      QCOMPARE(all(*wide, n), all(*particles::kernelsOf(SimdLevel::Baseline), n));
    }
  }

  void kernelsFollowTheirFormulas() {
    const particles::Kernels& k = particles::kernels();
    constexpr int n = 101;
    Crowd before(n), crowd(n);
    k.move(crowd.poses(), someWay, crowd.turn.data(), crowd.along.data(), crowd.across.data());
    k.weighBearing(crowd.poses(), crowd.weight.data(), 4.5F, 3.0F, 0.8F, 0.6F, someTrust);
    double sum = 0.0, x = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double yaw = std::atan2(before.s[i], before.c[i]) + 0.03 + 0.02 * before.turn[i];
      const double along = 0.02 + 0.01 * before.along[i], across = -0.01 + 0.01 * before.across[i];
      const double px = before.x[i] + std::cos(yaw) * along - std::sin(yaw) * across;
      const double py = before.y[i] + std::sin(yaw) * along + std::cos(yaw) * across;
      QVERIFY(std::abs(crowd.x[i] - px) < 1e-5 && std::abs(crowd.y[i] - py) < 1e-5);
      QVERIFY(std::abs(wrapToPi(std::atan2(crowd.s[i], crowd.c[i]) - yaw)) < 1e-5);
      const double off = direction({px, py}, {4.5, 3.0}) - yaw - std::atan2(0.6, 0.8);
      const double likelihood = 0.02 + 0.98 * std::exp(90.0 * (std::cos(off) - 1.0));
      QVERIFY(std::abs(crowd.weight[i] - before.weight[i] * likelihood) < 2e-4);
      sum += crowd.weightOf(static_cast<int>(i));
      x += crowd.weightOf(static_cast<int>(i)) * static_cast<double>(crowd.x[i]);
    }
    const particles::Mean mean = k.meanOf(crowd.poses(), crowd.weight.data());
    QVERIFY(std::abs(mean.weight - sum) < 1e-4 && std::abs(mean.x - x / sum) < 1e-4);
    const particles::Spread spread = k.spreadAbout(crowd.poses(), crowd.weight.data(), 1.0F, 0.0F);
    double variance = 0.0, farthest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double dx = static_cast<double>(crowd.x[i]) - 1.0, dy = static_cast<double>(crowd.y[i]);
      variance += crowd.weightOf(static_cast<int>(i)) * (dx * dx + dy * dy);
      farthest = std::max(farthest, dx * dx + dy * dy);
    }
    QVERIFY(std::abs(spread.variance - variance) < 1e-3 * variance);
    QVERIFY(std::abs(spread.farthest - farthest) < 1e-5 * farthest);
    // The yaw weighs each against the others; what the weights were worth before is told.
    const Crowd unweighed = crowd;
    const double reported = k.weighHeading(crowd.poses(), crowd.weight.data(), crowd.scratch.data(),
                                           {{1.0F, 0.0F}, {0.0F, 0.0F}, 1, false}, {8.0F, 0.05F});
    QVERIFY(std::abs(reported - sum) < 1e-4 * sum);
    QVERIFY(std::abs(k.sum(crowd.weight.data(), n) - 1.0) < 1e-5);
    double all = 0.0;
    const auto likely = [&unweighed](std::size_t i) {
      return static_cast<double>(unweighed.weight[i]) *
             (0.05 + 0.95 * std::exp(8.0 * (static_cast<double>(unweighed.c[i]) - 1.0)));
    };
    for (std::size_t i = 0; i < n; ++i) all += likely(i);
    for (std::size_t i = 0; i < n; ++i) {
      QVERIFY(std::abs(crowd.weightOf(static_cast<int>(i)) - likely(i) / all) < 1e-6);
    }
  }

  void theNoiseIsNearlyNormal() {
    constexpr int n = 200'000;
    std::vector<float> values(static_cast<std::size_t>(particles::capacityFor(n)));
    FastNoise(1, 1).fillNormal(values.data(), n);
    double sum = 0.0, squares = 0.0, fourth = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto v = static_cast<double>(values[i]);
      sum += v;
      squares += v * v;
      fourth += v * v * v * v;
      QVERIFY(std::abs(v) < 3.47);
    }
    // Four standard errors; a sum of four uniform numbers has the kurtosis 3 - 6 / (5 * 4).
    QVERIFY(std::abs(sum / n) < 4.0 / std::sqrt(n));
    QVERIFY(std::abs(squares / n - 1.0) < 4.0 * std::sqrt(1.7 / n));
    QVERIFY(std::abs(fourth / n - 2.7) < 0.06);
    std::vector<float> other(values.size());
    FastNoise(1, 2).fillNormal(other.data(), n);
    double together = 0.0;
    for (std::size_t i = 0; i < n; ++i) together += static_cast<double>(values[i] * other[i]);
    QVERIFY(std::abs(together / n) < 4.0 / std::sqrt(n));
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
    none.minParticles = 0;
    QVERIFY(!MonteCarloLocalization::create({}, none));
    LocalizationParameters crossed;
    crossed.minParticles = 600;
    crossed.maxParticles = 500;
    QVERIFY(!MonteCarloLocalization::create({}, crossed));
    LocalizationParameters sharp;
    sharp.bearingSigma = 0;
    QVERIFY(!MonteCarloLocalization::create({}, sharp));
    sim::FieldSpec flat;
    flat.length = 0;
    QVERIFY(!MonteCarloLocalization::create(flat));
  }
};

PITCHBOARD_TEST(TestMonteCarloLocalization)

}  // namespace tst_monte_carlo_localization

#include "tst_monte_carlo_localization.moc"

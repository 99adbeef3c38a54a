// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of a stretch: values worked out on paper, and intervals that hold for series whose
// samples are alike.
#include <QtTest>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <telemetry/statistics/curve_statistics.h>
#include <telemetry/statistics/histogram.h>

namespace tst_curve_statistics {

using namespace pitchboard::telemetry;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool near(double value, double expected, double tolerance = 1e-12) {
  return std::abs(value - expected) <= tolerance;
}

std::vector<Sample> sampled(std::span<const double> values, double step = 1.0) {
  std::vector<Sample> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    out.push_back({static_cast<double>(i) * step, values[i]});
  }
  return out;
}

/// AR(1) with mean 0: each value is `alike` times the one before, plus noise.
std::vector<double> alikeSeries(std::mt19937_64& random, double alike, std::size_t length) {
  std::normal_distribution<double> noise;
  std::vector<double> out(length);
  double value = noise(random) / std::sqrt(1.0 - alike * alike);
  for (double& one : out) {
    one = value;
    value = alike * value + noise(random);
  }
  return out;
}

/// Pearson's coefficient of pairs, straight from its definition.
double pearson(std::span<const double> a, std::span<const double> b) {
  double n = 0.0, meanA = 0.0, meanB = 0.0, ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    n += 1.0;
    meanA += a[i];
    meanB += b[i];
  }
  meanA /= n;
  meanB /= n;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    ab += (a[i] - meanA) * (b[i] - meanB);
    aa += (a[i] - meanA) * (a[i] - meanA);
    bb += (b[i] - meanB) * (b[i] - meanB);
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace

class TestCurveStatistics : public QObject {
  Q_OBJECT

 private slots:
  void valuesOnPaper() {
    // 1, 2, 4, 9: mean 4, squares of the differences 9 + 4 + 0 + 25 = 38.
    const std::vector<Sample> samples{{0, 1}, {1, 2}, {2, nan}, {3, 4}, {4, 9}};
    const CurveSummary s = summaryOf(samples);
    QCOMPARE(s.samples, std::uint64_t{4});
    QCOMPARE(s.missing, std::uint64_t{1});
    QVERIFY(near(s.share, 0.8));  // of five seconds, one is unknown
    QVERIFY(near(s.mean, 4.0));
    QVERIFY(near(s.deviation, std::sqrt(38.0 / 3.0)));
    QVERIFY(near(s.rms, std::sqrt((1.0 + 4.0 + 16.0 + 81.0) / 4.0)));
    QCOMPARE(s.least, 1.0);
    QCOMPARE(s.leastAt, 0.0);
    QCOMPARE(s.most, 9.0);
    QCOMPARE(s.mostAt, 4.0);
    QVERIFY(near(s.quantiles[2], 3.0));                       // between 2 and 4
    QVERIFY(near(s.quantiles[0], 1.0 + 0.05 * 3.0));          // 0.15 of the way to 2
    QVERIFY(near(s.quantiles[4], 4.0 + (0.95 * 3 - 2) * 5));  // 0.85 of the way to 9
  }

  void whatIsUnknownStaysUnknown() {
    for (const std::vector<Sample>& samples :
         {std::vector<Sample>{}, std::vector<Sample>{{0, nan}, {1, nan}}}) {
      const CurveSummary s = summaryOf(samples);
      QCOMPARE(s.samples, std::uint64_t{0});
      QCOMPARE(s.missing, samples.size());
      QVERIFY(std::isnan(s.mean) && std::isnan(s.least) && std::isnan(s.meanLow) &&
              std::isnan(s.quantiles[2]));
      QVERIFY(statesOf(samples)->empty());
      QCOMPARE(errorAgainst(samples, samples).samples, std::uint64_t{0});
      QVERIFY(!correlationOf(samples, samples, 1.0));
    }
    const CurveSummary one = summaryOf(std::vector<Sample>{{5, 7}});
    QCOMPARE(one.mean, 7.0);
    QVERIFY(std::isnan(one.deviation) && std::isnan(one.meanLow));
    // Without spread the mean is certain.
    const CurveSummary same = summaryOf(sampled(std::vector<double>(20, 0.1)));
    QVERIFY(near(same.meanLow, 0.1) && near(same.meanHigh, 0.1));
    const CurveSummary codes = summaryOf(sampled(std::vector<double>{1, 2, nan}), {}, true);
    QCOMPARE(codes.samples, std::uint64_t{2});
    QVERIFY(std::isnan(codes.mean) && std::isnan(codes.most) && near(codes.share, 2.0 / 3.0));
  }

  void whatIsLeftOutIsNotMissing() {
    const std::vector<Sample> samples{{0, 1}, {1, nan}, {2, nan}, {3, 3}};
    const CurveSummary s = summaryOf(samples, {true, false, true, true});
    QCOMPARE(s.samples, std::uint64_t{2});
    QCOMPARE(s.missing, std::uint64_t{1});
    QVERIFY(near(s.share, 2.0 / 3.0));
  }

  void statesAreWeightedWithTime() {
    // 0 for 1 s, 1 for 3 s, unknown for 2 s, 1 for 10 s of a silence of 94 s, 0 for the median.
    const std::vector<Sample> samples{{0, 0}, {1, 1}, {4, nan}, {6, 1}, {100, 0}};
    const std::vector<double> lasting = durationsOf(samples);
    QCOMPARE(lasting, (std::vector<double>{1, 3, 2, 10, 2.5}));
    const auto states = statesOf(samples);
    QCOMPARE(states->size(), std::size_t{2});
    QVERIFY(near((*states)[0].share, 3.5 / 16.5));
    QVERIFY(near((*states)[1].share, 13.0 / 16.5));
    QCOMPARE((*states)[1].samples, std::uint64_t{2});
    QVERIFY(!statesOf(samples, 1));
  }

  void errorsOnPaper() {
    // The other curve holds its value until the next sample.
    const std::vector<Sample> curve{{1, 1}, {2, 5}, {3, nan}, {4, 2}, {20, 2}};
    const std::vector<Sample> other{{0.5, 0}, {2, 2}, {3.5, 6}};
    const CurveError e = errorAgainst(curve, other);
    QCOMPARE(e.samples, std::uint64_t{3});  // 1 - 0, 5 - 2, 2 - 6; at 20 s the other one is too old
    QCOMPARE(e.missing, std::uint64_t{2});
    QVERIFY(near(e.bias, 0.0));
    QVERIFY(near(e.rms, std::sqrt((1.0 + 9.0 + 16.0) / 3.0)));
    QCOMPARE(e.largest, -4.0);
    QCOMPARE(e.largestAt, 4.0);
  }

  void effectiveSamplesOfOddInput() {
    QCOMPARE(effectiveSamples({}), 0.0);
    QCOMPARE(effectiveSamples(std::vector<double>{nan, 3, nan}), 1.0);
    QCOMPARE(effectiveSamples(std::vector<double>(50, 2.0)), 50.0);
    // A ramp is one slow change: its mean is hardly better known than one value.
    std::vector<double> ramp(1000);
    for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<double>(i);
    QVERIFY(effectiveSamples(ramp) < 5.0);
    // What alternates is never more than the samples.
    std::vector<double> wave(1000);
    for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = i % 2 == 0 ? 1.0 : -1.0;
    QCOMPARE(effectiveSamples(wave), 1000.0);
  }

  /// Of AR(1) series, n (1 - phi) / (1 + phi) samples are effective.
  void effectiveSamplesAreThoseOfTheory() {
    std::mt19937_64 random(3);
    for (const double alike : {0.0, 0.5, 0.9}) {
      std::vector<double> found;
      for (int i = 0; i < 101; ++i)
        found.push_back(effectiveSamples(alikeSeries(random, alike, 5000)));
      std::ranges::nth_element(found, found.begin() + 50);
      const double expected = 5000.0 * (1.0 - alike) / (1.0 + alike);
      QVERIFY2(near(found[50] / expected, 1.0, 0.08), qPrintable(QString::number(found[50])));
    }
  }

  void intervalsHold_data() {
    QTest::addColumn<double>("alike");
    QTest::addColumn<int>("length");
    for (const int length : {500, 1000, 4000}) {
      for (const double alike : {0.0, 0.5, 0.8, 0.9, 0.95}) {
        QTest::addRow("phi %g, n %d", alike, length) << alike << length;
      }
    }
  }
  /// 92 to 97 of 100 intervals of 95 % contain the true mean, 0.
  void intervalsHold() {
    QFETCH(const double, alike);
    QFETCH(const int, length);
    std::mt19937_64 random(11);
    constexpr int series = 1500;
    int held = 0;
    for (int i = 0; i < series; ++i) {
      const MeanInterval interval =
          intervalOfMean(alikeSeries(random, alike, static_cast<std::size_t>(length)));
      held += interval.low <= 0.0 && 0.0 <= interval.high;
    }
    const double share = static_cast<double>(held) / series;
    QVERIFY2(share >= 0.92 && share <= 0.97, qPrintable(QString::number(share)));
  }

  /// Gaps at random and gaps of seconds: samples around them are no neighbours.
  void intervalsHoldWithGaps() {
    std::mt19937_64 random(12);
    constexpr int series = 1500;
    for (const bool isLong : {false, true}) {
      int held = 0;
      for (int i = 0; i < series; ++i) {
        std::vector<double> values = alikeSeries(random, 0.9, 2000);
        for (std::size_t at = 0; at < values.size(); ++at) {
          if (isLong ? at / 100 % 3 == 1 : random() % 3 == 0) values[at] = nan;
        }
        const MeanInterval interval = intervalOfMean(values);
        held += interval.low <= 0.0 && 0.0 <= interval.high;
      }
      const double share = static_cast<double>(held) / series;
      QVERIFY2(share >= 0.92 && share <= 0.97, qPrintable(QString::number(share)));
    }
  }

  void delaysAreFound() {
    std::mt19937_64 random(4);
    const std::vector<double> walk = alikeSeries(random, 0.9, 1200);
    std::vector<Sample> curve, later;
    std::vector<double> a, b;
    for (std::size_t i = 0; i + 200 < walk.size(); ++i) {
      const double time = static_cast<double>(i) * 0.02;
      const bool isLost = i % 50 > 40;
      a.push_back(walk[i + 100]);
      b.push_back(isLost ? nan : -2.0 * walk[i + 85] + 1.0);  // 15 steps later, upside down
      curve.push_back({time, a.back()});
      later.push_back({time, b.back()});
    }
    const auto found = correlationOf(curve, later, 1.0);
    QVERIFY(found);
    QVERIFY(near(found->delay, 15 * 0.02, 1e-9));
    QVERIFY(near(found->coefficient, -1.0, 1e-9));
    QCOMPARE(found->byDelay.size(), std::size_t{101});
    const std::span<const double> first(a), second(b);
    for (const int lag : {-50, -7, 0, 3, 50}) {
      const auto off = static_cast<std::size_t>(std::abs(lag));
      const double expected = lag < 0 ? pearson(first.subspan(off), second.first(b.size() - off))
                                      : pearson(first.first(a.size() - off), second.subspan(off));
      QVERIFY(near(found->byDelay[static_cast<std::size_t>(50 + lag)], expected, 1e-9));
    }
    QVERIFY(near(found->atZero, pearson(a, b), 1e-9));
    // The other way around, it comes earlier.
    QVERIFY(near(correlationOf(later, curve, 1.0)->delay, -15 * 0.02, 1e-9));
    // Too short a look, and a curve that does not vary.
    QVERIFY(std::abs(correlationOf(curve, later, 0.1)->delay) <= 0.1);
    for (Sample& sample : later) sample.value = 3.0;
    QVERIFY(!correlationOf(curve, later, 1.0));
  }

  void binsIncludeBothEnds() {
    QCOMPARE(histogram(std::vector<double>{0, 0.1, 0.5, 1, nan, 2}, 0, 1, 2),
             (std::vector<std::size_t>{2, 2}));
    QCOMPARE(histogram(std::vector<double>{3, 3}, 3, 3, 4), (std::vector<std::size_t>{2, 0, 0, 0}));
  }
};

PITCHBOARD_TEST(TestCurveStatistics)

}  // namespace tst_curve_statistics

#include "tst_curve_statistics.moc"

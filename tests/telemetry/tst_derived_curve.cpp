// SPDX-License-Identifier: GPL-3.0-or-later
// Derived curves and statistics against values worked out on paper.

#include <QtTest>

#include <cmath>
#include <numbers>

#include <base/units.h>
#include <telemetry/series/derived_curve.h>

namespace tst_derived_curve {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using Curve = std::vector<Sample>;

namespace {

constexpr double hole = std::numeric_limits<double>::quiet_NaN();

bool near(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) < 1e-12;
}

}  // namespace

class TestDerivedCurve : public QObject {
  Q_OBJECT

  void check(const Curve& found, const Curve& wanted) {
    QCOMPARE(found.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      QVERIFY2(found[i].time == wanted[i].time && near(found[i].value, wanted[i].value),
               qPrintable(QString("sample %1: %2 at %3, wanted %4 at %5")
                              .arg(i)
                              .arg(found[i].value)
                              .arg(found[i].time)
                              .arg(wanted[i].value)
                              .arg(wanted[i].time)));
    }
  }

 private slots:
  void derivative() {
    // 0 → 6 in 2 s: 3 a second; the hole is skipped; two at 4 s: the second gives nothing, and the
    // next counts from it.
    check(derived(Curve{{0, 0}, {2, 6}, {3, hole}, {4, 2}, {4, 10}, {5, 7}}, Derivative()),
          {{0, hole}, {2, 3}, {3, hole}, {4, -2}, {4, hole}, {5, -3}});
  }

  void integral() {
    // Trapezoids: 2·(0+6)/2 = 6; then 1·(6+2)/2 = 4 across the hole; equal times add nothing.
    check(derived(Curve{{0, 0}, {2, 6}, {2.5, hole}, {3, 2}, {3, 8}, {4, 8}}, Integral()),
          {{0, 0}, {2, 6}, {2.5, hole}, {3, 10}, {3, 10}, {4, 18}});
  }

  void movingAverage() {
    // 2 s: at 2 the sample of 0 has just left; at 3 those of 2 and 3 are in, at 10 only itself.
    check(derived(Curve{{0, 3}, {1, 5}, {2, 10}, {3, 2}, {3.5, hole}, {10, 7}}, MovingAverage(2.0)),
          {{0, 3}, {1, 4}, {2, 7.5}, {3, 6}, {3.5, hole}, {10, 7}});
    const Curve same{{0, 3}, {1, 5}};
    check(derived(same, MovingAverage(0.0)), same);
    // A large value that came and went leaves nothing behind.
    const auto after = derived(Curve{{0, 1e17}, {1, 0.1}, {1.5, 0.3}}, MovingAverage(1.0));
    QVERIFY(near(after.back().value, 0.2));
  }

  void wrapAngle_data() {
    QTest::addColumn<double>("half");
    QTest::addColumn<double>("angle");
    QTest::addColumn<double>("wrapped");
    QTest::newRow("inside") << 180.0 << 90.0 << 90.0;
    QTest::newRow("half a turn") << 180.0 << 180.0 << 180.0;
    QTest::newRow("minus half a turn") << 180.0 << -180.0 << 180.0;
    QTest::newRow("beyond") << 180.0 << 190.0 << -170.0;
    QTest::newRow("many turns") << 180.0 << 3610.0 << 10.0;
    QTest::newRow("radians") << std::numbers::pi << 4.0 << 4.0 - 2 * std::numbers::pi;
    QTest::newRow("hole") << 180.0 << hole << hole;
  }
  void wrapAngle() {
    QFETCH(double, half);
    QFETCH(double, angle);
    QFETCH(double, wrapped);
    QVERIFY(near(WrapAngle(half).next({1.0, angle}).value, wrapped));
  }

  void unitConversion() {
    const auto convert = [](std::string_view from, std::string_view to, double value) {
      for (const UnitConversion& c : unitConversionsFrom(from)) {
        if (c.to == to) return c.factor * value;
      }
      return hole;
    };
    QVERIFY(near(convert("cm", "m", 83.2), 0.832));
    QVERIFY(near(convert("m", "cm", 0.832), 83.2));
    QVERIFY(near(convert("°", "rad", 90.0), std::numbers::pi / 2));
    QVERIFY(near(convert("rad", "°", std::numbers::pi), 180.0));
    QVERIFY(near(convert("0.1 V", "V", 124.0), 12.4));
    QVERIFY(unitConversionsFrom("bananas").empty());
    check(derived(Curve{{1, 10}}, LinearConversion{1.8, 32}), {{1, 50}});
    for (const Unit& unit : units) {
      for (const UnitConversion& c : unitConversionsFrom(unit.name)) {
        for (const UnitConversion& back : unitConversionsFrom(c.to)) {
          if (back.to == unit.name) QVERIFY(near(back.factor * c.factor, 1.0));
        }
      }
    }
  }

  void statistics() {
    // 2 4 4 4 5 5 7 9: mean 5, σ 2, RMS √(232/8) = √29.
    Curve curve{{0, 100},
                {1, 2},
                {2, 4},
                {3, 4},
                {4, 4},
                {5, hole},
                {5, 5},
                {6, 5},
                {7, 7},
                {8, 9},
                {8.5, std::numeric_limits<double>::infinity()},
                {9, 100}};
    const auto s = statisticsOf(curve, {1, 8.5});
    QCOMPARE(s.samples, std::uint64_t{8});
    QVERIFY(near(s.mean, 5) && near(s.sigma, 2) && near(s.rms, std::sqrt(29.0)) && s.min == 2 &&
            s.max == 9);
    QCOMPARE(statisticsOf(curve, {8.2, 8.7}).samples, std::uint64_t{0});
    QCOMPARE(statisticsOf(curve, {3, 1}).samples, std::uint64_t{0});
    QCOMPARE(statisticsOf({}, {0, 1}).samples, std::uint64_t{0});
    // A large offset does not swallow the deviation.
    for (Sample& sample : curve) sample.value += 1e9;
    QVERIFY(std::abs(statisticsOf(curve, {1, 8}).sigma - 2) < 1e-6);
  }
};

PITCHBOARD_TEST(TestDerivedCurve)

}  // namespace tst_derived_curve

#include "tst_derived_curve.moc"

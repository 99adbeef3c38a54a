// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/angles.h>
#include <base/random.h>
#include <base/repeatable_math.h>
#include <sleef.h>

#include <QtTest>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace tst_repeatable_math {

using namespace pitchboard;

namespace {

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

bool near(double value, double right, double ulps) {
  return std::abs(value - right) <=
         ulps * std::numeric_limits<double>::epsilon() * std::max(std::abs(right), 1e-300);
}

}  // namespace

class TestRepeatableMath : public QObject {
  Q_OBJECT

 private slots:
  // The vectors of two that are used on x86-64 and the plain C that is used elsewhere.
  void bothVersionsGiveTheSameBits() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> angle(-50.0, 50.0);
    constexpr double none = 0.0, least = std::numeric_limits<double>::denorm_min();
    for (const double y : {none, -none, least, 1e-300, 1.0, -1.0, 9.0, -1e6}) {
      for (const double x : {none, -none, least, -1e-300, 1.0, -1.0, 6.0, -1e6}) {
        QCOMPARE(bits(repeatable::atan2(y, x)), bits(Sleef_cinz_atan2d1_u35purec(y, x)));
      }
      QCOMPARE(bits(repeatable::log(std::abs(y))), bits(Sleef_cinz_logd1_u35purec(std::abs(y))));
    }
    for (int i = 0; i < 200000; ++i) {
      const double a = angle(random), b = angle(random), p = std::exp(angle(random));
      QCOMPARE(bits(repeatable::atan2(a, b)), bits(Sleef_cinz_atan2d1_u35purec(a, b)));
      QCOMPARE(bits(repeatable::log(p)), bits(Sleef_cinz_logd1_u35purec(p)));
      const double x = angle(random);
      const repeatable::SinCos both = repeatable::sinCos(x);
      const Sleef_double_2 plain = Sleef_cinz_sincosd1_u35purec(x);
      QCOMPARE(bits(both.sin), bits(plain.x));
      QCOMPARE(bits(both.cos), bits(plain.y));
    }
  }

  void theyAreNearTheCLibrarys() {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> any(-20.0, 20.0), positive(1e-6, 20.0);
    for (int i = 0; i < 100000; ++i) {
      const double x = any(random), y = any(random), p = positive(random);
      QVERIFY(std::abs(repeatable::sin(x) - std::sin(x)) < 1e-15);
      QVERIFY(std::abs(repeatable::cos(x) - std::cos(x)) < 1e-15);
      QVERIFY(near(repeatable::atan2(y, x), std::atan2(y, x), 6));
      QVERIFY(near(repeatable::exp(x), std::exp(x), 3));
      QVERIFY(std::abs(repeatable::log(p) - std::log(p)) < 2e-15 * (1 + std::abs(std::log(p))));
      QVERIFY(near(repeatable::pow(p, x), std::pow(p, x), 3));
      QVERIFY(near(repeatable::hypot(x, y), std::hypot(x, y), 3));
    }
  }

  // These numbers were worked out once; a computer that gives others breaks the promise.
  void theBitsOfThisProjectForEver() {
    QCOMPARE(bits(repeatable::sin(1.0)), bits(0x1.aed548f090ceep-1));
    QCOMPARE(bits(repeatable::cos(1.0)), bits(0x1.14a280fb5068cp-1));
    QCOMPARE(bits(repeatable::atan2(1.0, 2.0)), bits(0x1.dac670561bb50p-2));
    QCOMPARE(bits(repeatable::exp(1.0)), bits(0x1.5bf0a8b14576ap+1));
    QCOMPARE(bits(repeatable::log(10.0)), bits(0x1.26bb1bbb55515p+1));
  }

  void wrappedAnglesAreRemainders() {
    constexpr double pi = std::numbers::pi;
    std::vector<double> angles{0.0, -0.0, pi, -pi, 2 * pi, -2 * pi, 3 * pi, -3 * pi, 9.0, -9.0};
    for (const double edge : std::vector<double>(angles)) {
      angles.push_back(std::nextafter(edge, 100.0));
      angles.push_back(std::nextafter(edge, -100.0));
    }
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> any(-20.0, 20.0);
    for (int i = 0; i < 100000; ++i) angles.push_back(any(random));
    for (const double angle : angles) {
      const double rest = std::remainder(angle, 2 * pi);
      QCOMPARE(bits(wrapToPi(angle)), bits(rest <= -pi ? pi : rest));
    }
  }

  // The quantile behind a normal draw is the inverse of the normal law, which the C library has.
  void normalNumbersAreQuantiles() {
    for (std::uint64_t tick = 0; tick < 50000; ++tick) {
      CounterRandom one(9, 1, NoiseStream::Motion, tick), other = one;
      const double normal = one.normal(0.0, 1.0);
      const double u = other.uniform() + 0x1p-54;
      QVERIFY(std::abs(0.5 * std::erfc(-normal / std::sqrt(2.0)) - u) < 1e-15 + 1e-14 * u);
    }
  }
};

PITCHBOARD_TEST(TestRepeatableMath)

}  // namespace tst_repeatable_math

#include "tst_repeatable_math.moc"

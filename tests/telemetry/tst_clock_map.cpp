// SPDX-License-Identifier: GPL-3.0-or-later
// The clock of a robot over a network that delays and reorders: true times are known here.

#include <QtTest>
#include <cmath>
#include <random>

#include <telemetry/pb2/clock_map.h>

namespace tst_clock_map {

using pitchboard::telemetry::ClockMap;

namespace {

constexpr double period = 0.05;  // s between datagrams

/// A robot whose clock says `first` (ms) at our 100 s and runs faster by `drift`.
struct Sender {
  std::uint64_t first = 28'622'056;
  double drift = 0.0;
  std::uint64_t at(double time) const {
    return first + static_cast<std::uint64_t>(std::llround((time - 100.0) * 1000 * (1.0 + drift)));
  }
};

/// A wireless network: never faster than 2 ms, 10 ms on average, at times 300 ms.
class Network {
 public:
  double delay() { return 0.002 + (m_slow(m_random) ? 0.3 : m_usual(m_random)); }

 private:
  std::mt19937 m_random{7};
  std::exponential_distribution<double> m_usual{1.0 / 0.010};
  std::bernoulli_distribution m_slow{0.02};
};

}  // namespace

class TestClockMap : public QObject {
  Q_OBJECT

 private slots:
  void theLeastDelayIsFound() {
    ClockMap map;
    Network network;
    const Sender sender;
    for (int i = 0; i < 400; ++i) {
      const double time = 100.0 + i * period;
      const double mapped = map.map(sender.at(time), time + network.delay());
      // Milliseconds are whole, and the least delay cannot be told from the clocks.
      if (i > 50)
        QVERIFY2(std::abs(mapped - time - 0.002) < 0.0015, qPrintable(QString::number(i)));
    }
    QVERIFY(map.jitter() > 0.002 && map.jitter() < 0.1);
    QVERIFY(std::abs(map.offset() - (100.002 - 28'622.056)) < 0.0015);
    QCOMPARE(map.restarts(), 0U);
  }

  /// Two robots whose clocks and networks differ see one moment at one time.
  void curvesOfTwoRobotsLineUp() {
    ClockMap one, other;
    Network network;
    const Sender a{5, 50e-6}, b{9'000'000'000'000, -50e-6};
    for (int i = 0; i < 6000; ++i) {
      const double time = 100.0 + i * period;
      const double first = one.map(a.at(time), time + network.delay());
      const double second = other.map(b.at(time), time + network.delay());
      if (i > 100) QVERIFY(std::abs(first - second) < 0.010);
    }
  }

  void aClockThatDrifts_data() {
    QTest::addColumn<double>("drift");
    QTest::newRow("too fast") << 100e-6;
    QTest::newRow("too slow") << -100e-6;
  }
  void aClockThatDrifts() {
    QFETCH(double, drift);
    ClockMap map;
    Network network;
    const Sender sender{1000, drift};
    for (int i = 0; i < 12'000; ++i) {  // ten minutes
      const double time = 100.0 + i * period;
      const double mapped = map.map(sender.at(time), time + network.delay());
      if (i > 50) QVERIFY2(std::abs(mapped - time) < 0.010, qPrintable(QString::number(i)));
    }
    QCOMPARE(map.restarts(), 0U);
  }

  /// After a reboot the clock counts from 0 again.
  void aReboot() {
    ClockMap map;
    const Sender before, after{3000};
    double last = 0.0;
    for (int i = 0; i < 50; ++i) {
      const double time = 100.0 + i * period;
      last = map.map(before.at(time), time + 0.01);
    }
    QVERIFY(std::abs(last - 102.46) < 0.001);
    for (int i = 0; i < 50; ++i) {
      const double time = 140.0 + i * period;
      const double mapped = map.map(after.at(time), time + 0.01);
      QVERIFY(std::abs(mapped - time - 0.01) < 0.002);
    }
    QCOMPARE(map.restarts(), 1U);
  }

  /// While a computer sleeps, its monotonic clock stands.
  void aSleep() {
    ClockMap map;
    const Sender sender;
    double time = 0.0, mapped = 0.0;
    for (int i = 0; i < 100; ++i) {
      time = 100.0 + i * period;
      map.map(sender.at(time), time);
    }
    for (int i = 100; i < 130; ++i) {
      time = 100.0 + i * period;
      mapped = map.map(sender.at(time), time + 60.0);
      QVERIFY(mapped <= time + 60.0);
    }
    QCOMPARE(map.restarts(), 1U);
    QVERIFY(std::abs(mapped - time - 60.0) < 0.002);
  }

  /// An outage, or a queue that empties itself, is no other clock.
  void aQueueAfterAnOutage() {
    ClockMap map;
    const Sender sender;
    for (int i = 0; i < 100; ++i) map.map(sender.at(100.0 + i * period), 100.0 + i * period);
    for (int i = 100; i < 105; ++i) {
      const double mapped = map.map(sender.at(100.0 + i * period), 108.0);
      QVERIFY(std::abs(mapped - 100.0 - i * period) < 0.001);
    }
    QCOMPARE(map.restarts(), 0U);
  }

  void timesStayInOrder() {
    ClockMap map;
    Network network;
    const Sender sender;
    double last = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double time = 100.0 + i * period;
      const double arrival = time + network.delay();
      const double mapped = map.map(sender.at(time), arrival);
      QVERIFY(mapped >= last && mapped <= std::max(arrival, last));
      last = mapped;
    }
  }

  /// A delay shorter than all before moves the times of what follows back. Rows with one time would
  /// be one row.
  void noTwoSamplesGetOneTime() {
    ClockMap map;
    const Sender sender;
    double last = map.map(sender.at(100.0), 100.4);
    for (int i = 1; i <= 40; ++i) {
      const double time = 100.4 + 0.01 * i;
      const double arrival = time + 0.002;
      const double mapped = map.map(sender.at(time), arrival);
      QVERIFY2(mapped > last && mapped <= arrival, qPrintable(QString::number(i)));
      last = mapped;
    }
    QVERIFY(std::abs(last - 100.802) < 0.001);
    // A sample in several datagrams has one time.
    QCOMPARE(map.map(sender.at(100.8), 100.81), last);
  }

  void largeTimesAreExact() {
    ClockMap map;
    const Sender sender{(std::uint64_t{1} << 63) - 500};
    double mapped = 0.0;
    for (int i = 0; i < 100; ++i) {
      mapped = map.map(sender.at(100.0 + i * period), 100.0 + i * period);
    }
    QVERIFY(std::abs(mapped - 104.95) < 1e-9);
    QCOMPARE(map.restarts(), 0U);
  }
};

PITCHBOARD_TEST(TestClockMap)

}  // namespace tst_clock_map

#include "tst_clock_map.moc"

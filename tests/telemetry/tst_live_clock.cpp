// SPDX-License-Identifier: GPL-3.0-or-later
// The clock of what is received, with clocks made by hand.

#include <QtTest>

#include <telemetry/sockets/live_clock.h>

namespace tst_live_clock {

using namespace pitchboard::telemetry;
using namespace std::chrono_literals;

namespace {

struct Clocks {
  Duration monotonic = 500s;
  WallTime wall{1'700'000'000s};
  void pass(Duration time) {
    monotonic += time;
    wall += time;
  }
  ClockSource source() {
    return {[this] { return monotonic; }, [this] { return wall; }};
  }
};

}  // namespace

class TestLiveClock : public QObject {
  Q_OBJECT

 private slots:
  void whoSetsTheClockMovesNothing_data() {
    QTest::addColumn<int>("step");
    QTest::newRow("an hour on") << 3600;
    QTest::newRow("an hour back") << -3600;
    QTest::newRow("from 1970") << 1'700'000'000;
  }
  void whoSetsTheClockMovesNothing() {
    QFETCH(int, step);
    Clocks clocks;
    const LiveClock clock(clocks.source());
    const WallTime began = clocks.wall;
    clocks.pass(10s);
    QCOMPARE(clock.seconds(clock.now()), 10.0);
    const WallTime before = clock.arrival(clocks.wall - 2ms);
    QVERIFY(before == began + 10s - 2ms);
    const WallTime stampedBefore = clocks.wall;
    clocks.wall += std::chrono::seconds(step);
    QVERIFY(clock.setBy() == std::chrono::seconds(step));
    // Stamped before the step and read after it: now, not an hour off.
    QVERIFY(clock.arrival(stampedBefore) == began + 10s);
    clocks.pass(1s);
    QVERIFY(clock.arrival(clocks.wall - 5ms) == began + 11s - 5ms);
    QVERIFY(clock.now() == began + 11s);
    QVERIFY(clock.began() == began);
  }

  void asleepTimeGoesOn() {
    // What the system's clock says of itself: it is the one that goes on.
    const ClockSource system = ClockSource::system();
    timespec boot{};
    QCOMPARE(clock_gettime(CLOCK_BOOTTIME, &boot), 0);
    const Duration then = std::chrono::seconds(boot.tv_sec);
    QVERIFY(system.monotonic() >= then && system.monotonic() < then + 1h);
  }
};

PITCHBOARD_TEST(TestLiveClock)

}  // namespace tst_live_clock

#include "tst_live_clock.moc"

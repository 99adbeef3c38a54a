// SPDX-License-Identifier: GPL-3.0-or-later
// Messages of live robots become rows.

#include <QtTest>

#include <base/actions.h>
#include <robotlink/live/live_rows.h>
#include <telemetry/series/series_store.h>

using namespace pitchboard::telemetry;
using namespace std::chrono_literals;

namespace {

const WallTime zero{std::chrono::seconds(1'700'000'000)};

struct Rig {
  std::shared_ptr<SeriesStore> store = std::make_shared<SeriesStore>();
  TeamMonitor monitor;
  LiveRows rows{store, {.zero = zero, .name = {}}};

  TeamMonitor::Verdict send(const std::string& text, double time, const char* from = "10.0.0.1") {
    DatagramView datagram;
    datagram.time =
        zero + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(time));
    datagram.sender = {parseAddress(from).value(), 1234};
    datagram.payload = text;
    const auto verdict = monitor.take(datagram);
    if (verdict == TeamMonitor::Verdict::Used)
      rows.take(datagram, monitor.decoded(), monitor.decoder());
    return verdict;
  }
  void report(double time) {
    rows.report(monitor.status(
        zero + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(time))));
  }
  std::shared_ptr<const GroupView> view(const char* group) const {
    const auto id = store->findGroup(group);
    return id ? store->view(*id) : nullptr;
  }
  double latest(const char* group, const char* column) const {
    const auto id = store->find(group, column);
    return id ? store->view(id->group)->latest(id->column)->value : -12345.0;
  }
};

const std::string message = "3 100 200 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 OUT";

}  // namespace

class TestLiveRows : public QObject {
  Q_OBJECT

 private slots:
  void fieldsAreColumns() {
    Rig rig;
    QCOMPARE(rig.send(message, 2.0), TeamMonitor::Verdict::Used);
    const auto view = rig.view("Robot 3");
    QVERIFY(view);
    QCOMPARE(*view->range(), (TimeRange{2.0, 2.0}));
    QCOMPARE(rig.latest("Robot 3", "X"), 100.0);
    QCOMPARE(rig.latest("Robot 3", "BALL_DIST"), 83.2);
    QCOMPARE(rig.latest("Robot 3", "VOLTAGE"), 124.0);
    QCOMPARE(rig.latest("Robot 3", "AGE"), 0.0);
    const GroupInfo& info = view->info();
    QCOMPARE(info.columns[1].unit, std::string("cm"));
    QCOMPARE(info.columns[1].category, std::string("Localization"));
    QVERIFY(info.columns[7].kind == ColumnKind::Flag);
    QVERIFY(info.columns[12].kind == ColumnKind::Enumeration);
    QCOMPARE(info.columns[12].labels.at(8), pitchboard::actionWords(8));
    QCOMPARE(info.attributes.at("number"), std::string("3"));
    QCOMPARE(info.attributes.at("sender"), std::string("10.0.0.1"));
  }

  void silenceIsSeen() {
    Rig rig;
    for (int i = 0; i <= 4; ++i) rig.send(message, i * 1.0);
    rig.report(4.0);
    const auto rows = rig.view("Robot 3")->rows();
    QCOMPARE(rows, std::size_t{5});
    for (int i = 5; i < 60; ++i) rig.report(i);
    QCOMPARE(rig.latest("Robot 3", "X"), 100.0);
    // One row a report until the timeout (10 s) and one that shows it, none after.
    const auto view = rig.view("Robot 3");
    QVERIFY(view->range()->end >= 14.0 && view->range()->end <= 16.0);
    QVERIFY(rig.latest("Robot 3", "AGE") >= 10.0);
    QVERIFY(rig.latest("Robot 3", "RATE") < 1.0);
    rig.send(message, 70.0);
    QCOMPARE(rig.view("Robot 3")->range()->end, 70.0);
  }

  void badFieldsAreHoles() {
    Rig rig;
    QCOMPARE(rig.send("3 100 abc 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 OUT", 1.0),
             TeamMonitor::Verdict::Used);
    rig.report(1.0);
    rig.report(1.5);
    QCOMPARE(rig.latest("Robot 3", "X"), 100.0);
    QVERIFY(std::isnan(rig.latest("Robot 3", "Y")));
    QVERIFY(rig.latest("Robot 3", "ERRORS") >= 1.0);
  }

  void fieldsBeyondTheProfile() {
    Rig rig;
    rig.send("3 100 200 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 55 OUT", 1.0);
    QCOMPARE(rig.latest("Robot 3", "OTHER_1"), 55.0);
    rig.send(message, 2.0);
    QVERIFY(std::isnan(rig.latest("Robot 3", "OTHER_1")));
    QCOMPARE(rig.view("Robot 3")->rows(), std::size_t{2});
  }

  void twoSendersOfOneNumber() {
    Rig rig;
    rig.send(message, 1.0, "10.0.0.1");
    rig.send(message, 1.1, "10.0.0.2");
    QVERIFY(rig.view("Robot 3") && rig.view("Robot 3 (10.0.0.2)"));
  }

  void aClockSetBackALittleKeepsTheRows() {
    Rig rig;
    rig.send(message, 10.0);
    rig.send("3 101 200 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 OUT", 9.0);
    QCOMPARE(rig.view("Robot 3")->rows(), std::size_t{2});
  }
};

QTEST_GUILESS_MAIN(TestLiveRows)
#include "tst_live_rows.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// Messages of live robots become rows.

#include <QtTest>

#include <robotlink/live/live_rows.h>
#include <simcore/world/action_codes.h>
#include <telemetry/series/derived_curve.h>
#include <telemetry/series/series_store.h>

#include "../support/group_facts.h"

namespace tst_live_rows {

using namespace pitchboard::telemetry;
using pitchboard::link::LiveRows;
using namespace std::chrono_literals;

namespace {

const WallTime zero{std::chrono::seconds(1'700'000'000)};

struct Rig {
  std::shared_ptr<SeriesStore> store = std::make_shared<SeriesStore>();
  TeamMonitor monitor{publishedProfile()};
  LiveRows rows{store, {.zero = zero, .teams = {}, .describe = {}}};

  TeamMonitor::Verdict send(const std::string& text, double time, const char* from = "10.0.0.1") {
    DatagramView datagram;
    datagram.time =
        zero + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(time));
    datagram.sender = {parseAddress(from).value(), 1234};
    datagram.payload = text;
    const auto verdict = monitor.take(datagram);
    if (verdict == TeamMonitor::Verdict::Used)
      rows.take(datagram, monitor.decoded(), monitor.decoder(), monitor.used());
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
    QCOMPARE(rig.latest("Robot 3", "LOCALIZATION_X"), 100.0);
    QCOMPARE(rig.latest("Robot 3", "VISION_BALL_DIST"), 83.2);
    QCOMPARE(rig.latest("Robot 3", "VOLTAGE"), 124.0);
    const GroupInfo& info = view->info();
    QCOMPARE(info.columns[1].unit, std::string("cm"));
    QCOMPARE(info.columns[1].category, std::string("Belief"));
    QVERIFY(info.columns[7].kind == ColumnKind::Flag);
    QVERIFY(info.columns[12].kind == ColumnKind::Enumeration);
    QCOMPARE(info.columns[12].labels.at(8), pitchboard::actionLabel(8));
    QCOMPARE(attributesOf(info).at("number"), std::string("3"));
    QCOMPARE(attributesOf(info).at("sender"), std::string("10.0.0.1"));
  }

  void oneRowForEachMessageAtThePublishedRate() {
    // The truth: a robot that walks 12 cm a second and says so once a second for a minute.
    Rig rig;
    for (int i = 0; i < 60; ++i) {
      const std::string x = std::to_string(100 + 12 * i);
      rig.send("3 " + x + " 200 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 OUT", i * 1.0);
      for (int report = 0; report < 4; ++report) rig.report(i + 0.1 + 0.25 * report);
    }
    const auto view = rig.view("Robot 3");
    QCOMPARE(view->rows(), std::size_t{60});
    const auto x = rig.store->find("Robot 3", "LOCALIZATION_X");
    std::vector<Sample> samples;
    QVERIFY(view->samples(x->column, {-1e9, 1e9}, samples));
    Derivative speed;
    QVERIFY(std::isnan(speed.next(samples[0]).value));
    for (std::size_t i = 1; i < samples.size(); ++i) {
      QVERIFY(std::abs(speed.next(samples[i]).value - 12.0) < 1e-6);
    }
    // Mean and sigma of 0, 1, ... 59 times 12.
    const SeriesStatistics all = view->statistics(x->column, {-1e9, 1e9});
    QCOMPARE(all.samples, std::uint64_t{60});
    QVERIFY(std::abs(all.mean - (100.0 + 12.0 * 29.5)) < 1e-9);
    QVERIFY(std::abs(all.sigma - 12.0 * std::sqrt((60.0 * 60.0 - 1.0) / 12.0)) < 1e-6);
  }

  void notSeenIsAHole() {
    Rig rig;
    const char* balls[] = {"83.2", "-1.0", "-1.0", "80.0"};
    for (int i = 0; i < 4; ++i) {
      rig.send("3 100 200 90 12.5 " + std::string(balls[i]) + " -15 1 1 0 1 1 8 1.57 124 OUT",
               i * 1.0);
    }
    const auto ball = rig.store->find("Robot 3", "VISION_BALL_DIST");
    const auto view = rig.view("Robot 3");
    std::vector<Sample> samples;
    QVERIFY(view->samples(ball->column, {-1e9, 1e9}, samples));
    QCOMPARE(samples.size(), std::size_t{4});
    QVERIFY(std::isnan(samples[1].value) && std::isnan(samples[2].value));
    const SeriesStatistics all = view->statistics(ball->column, {-1e9, 1e9});
    QCOMPARE(all.samples, std::uint64_t{2});
    QVERIFY(std::abs(all.mean - 81.6) < 1e-9);
    QCOMPARE(all.min, 80.0);
    // −1 degree is an angle like any other.
    QCOMPARE(rig.latest("Robot 3", "VISION_PAN_DEG"), -15.0);
  }

  void healthHasARateOfItsOwn() {
    Rig rig;
    for (int i = 0; i <= 40; ++i) {
      rig.send(message, i * 0.1);
      rig.report(i * 0.1 + 0.05);
    }
    const auto view = rig.view("Robot 3 link");
    QVERIFY(view);
    QVERIFY(view->rows() >= 4 && view->rows() <= 5);
    QCOMPARE(attributesOf(view->info()).at("link"), std::string("Robot 3"));
    QVERIFY(std::abs(rig.latest("Robot 3 link", "RATE") - 10.0) < 0.01);
    QVERIFY(std::isnan(rig.latest("Robot 3 link", "LOSS")));  // it sends no sequence number
    QVERIFY(!rig.store->find("Robot 3", "RATE"));
  }

  void missingMessagesAreNoticed() {
    Rig rig;
    for (int i = 0; i <= 4; ++i) rig.send(message, i * 1.0);
    for (int i = 4; i < 60; ++i) rig.report(i);
    QCOMPARE(rig.view("Robot 3")->rows(), std::size_t{5});
    // The age grows until the timeout (10 s), one row shows that, none follows.
    const auto view = rig.view("Robot 3 link");
    QCOMPARE(view->range()->end, 14.0);
    QVERIFY(rig.latest("Robot 3 link", "AGE") >= 10.0);
    QVERIFY(rig.latest("Robot 3 link", "RATE") < 1.0);
    rig.send(message, 70.0);
    rig.report(70.1);
    QCOMPARE(rig.view("Robot 3")->range()->end, 70.0);
    QCOMPARE(rig.view("Robot 3 link")->range()->end, 70.1);
  }

  void badFieldsAreHoles() {
    Rig rig;
    QCOMPARE(rig.send("3 100 abc 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 OUT", 1.0),
             TeamMonitor::Verdict::Used);
    rig.report(1.5);
    QCOMPARE(rig.latest("Robot 3", "LOCALIZATION_X"), 100.0);
    QVERIFY(std::isnan(rig.latest("Robot 3", "LOCALIZATION_Y")));
    QCOMPARE(rig.latest("Robot 3 link", "ERRORS"), 1.0);
  }

  void aLongerMessageAddsColumns() {
    Rig rig;
    // More than the 64 rows that are kept row by row, so that columns are widened as well.
    for (int i = 0; i < 100; ++i) rig.send(message, i * 1.0);
    const auto x = *rig.store->find("Robot 3", "LOCALIZATION_X");
    rig.send("3 101 200 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 55 OUT", 100.0);
    rig.send(message, 101.0);
    QCOMPARE(rig.store->find("Robot 3", "LOCALIZATION_X").value(), x);
    const auto view = rig.view("Robot 3");
    QCOMPARE(view->rows(), std::size_t{102});
    const auto other = *rig.store->find("Robot 3", "OTHER_1");
    std::vector<Sample> samples;
    QVERIFY(view->samples(other.column, {-1e9, 1e9}, samples));
    QCOMPARE(samples.size(), std::size_t{102});
    for (std::size_t i = 0; i < samples.size(); ++i) {
      QCOMPARE(std::isnan(samples[i].value), i != 100);
    }
    QCOMPARE(samples[100].value, 55.0);
    QCOMPARE(view->at(x.column, 50.0)->value, 100.0);
    QCOMPARE(view->at(x.column, 100.0)->value, 101.0);
    // Once in the lists.
    int groups = 0;
    for (GroupId id = 0; id < rig.store->groups(); ++id) {
      if (rig.store->view(id)->info().name == "Robot 3") ++groups;
    }
    QCOMPARE(groups, 1);
  }

  void aTextIsAColumnOfLabels() {
    Rig rig;
    Profile profile = publishedProfile();
    profile.fields.push_back({"ROLE", FieldType::Text, "", "Decision"});
    profile.fields.back().labels = {{7, "keeper"}};
    rig.monitor.setProfile(profile);
    const auto send = [&](const std::string& role, double time) {
      rig.send("3 100 200 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 " + role + " OUT", time);
      const auto view = rig.view("Robot 3");
      const auto id = *rig.store->find("Robot 3", "ROLE");
      const ColumnInfo& column = view->info().columns[id.column];
      return column.labels.at(static_cast<int>(view->latest(id.column)->value));
    };
    QCOMPARE(send("striker", 1.0), std::string("striker"));
    QCOMPARE(send("keeper", 2.0), std::string("keeper"));
    QCOMPARE(send("defender", 3.0), std::string("defender"));
    QCOMPARE(send("striker", 4.0), std::string("striker"));
    QCOMPARE(rig.latest("Robot 3", "ROLE"), 8.0);
    QCOMPARE(rig.view("Robot 3")->rows(), std::size_t{4});
    for (std::size_t i = 0; i < LiveRows::maxTexts; ++i)
      send("w" + std::to_string(i), 5.0 + static_cast<double>(i));
    QCOMPARE(send("one-more", 100.0), std::string("other"));
    QCOMPARE(send("striker", 101.0), std::string("striker"));
  }

  void keysMissingInTheProfileBecomeColumns() {
    Rig rig;
    auto profile = parseProfile(R"({"name": "kv", "format": "key=value", "fields": [
        {"name": "N", "type": "int", "meaning": "robot", "key": "id"},
        {"name": "x", "type": "float"}]})",
                                "kv.json");
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    rig.monitor.setProfile(*profile);
    rig.send("id=4 x=1 foo=3 who=me", 1.0);
    rig.send("id=4 bar=5 x=2 foo=4 N=9", 2.0);
    QCOMPARE(rig.latest("Robot 4", "foo"), 4.0);
    QCOMPARE(rig.latest("Robot 4", "bar"), 5.0);
    // A key that is a column's name does not overwrite it.
    QCOMPARE(rig.latest("Robot 4", "N"), 4.0);
    QCOMPARE(rig.rows.refused().values, std::uint64_t{1});
    const auto who = *rig.store->find("Robot 4", "who");
    QVERIFY(rig.view("Robot 4")->info().columns[who.column].kind == ColumnKind::Text);
    QCOMPARE(rig.monitor.status(zero + 2s).robots[0].name(2), std::string("bar"));
    // However many there are, memory is bounded, and what goes beyond is counted.
    std::string many = "id=4";
    for (int i = 0; i < 100; ++i) many += " k" + std::to_string(i) + "=1";
    rig.send(many, 3.0);
    QCOMPARE(rig.latest("Robot 4", "k31"), 1.0);
    QCOMPARE(rig.rows.refused().values, std::uint64_t{1 + 68});
  }

  void anEditedProfileAddsColumns() {
    Rig rig;
    rig.send("3 100 200 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 55 OUT", 1.0);
    Profile edited = publishedProfile();
    std::swap(edited.fields[1], edited.fields[2]);  // the team sends Y before X now
    edited.fields.push_back({"TEMPERATURE", FieldType::Float, "°C", "Motors"});
    rig.monitor.setProfile(edited);
    rig.send("3 200 101 90 12.5 83.2 -15 1 1 0 1 1 8 1.57 124 55.5 OUT", 2.0);
    const auto view = rig.view("Robot 3");
    QCOMPARE(view->rows(), std::size_t{2});
    const auto x = *rig.store->find("Robot 3", "LOCALIZATION_X");
    QCOMPARE(view->at(x.column, 1.0)->value, 100.0);
    QCOMPARE(view->at(x.column, 2.0)->value, 101.0);
    QCOMPARE(rig.latest("Robot 3", "TEMPERATURE"), 55.5);
    QVERIFY(std::isnan(rig.latest("Robot 3", "OTHER_1")));
  }

  void anotherAddressGoesOn() {
    Rig rig;
    for (int i = 0; i < 3; ++i) rig.send(message, i * 1.0, "10.0.0.1");
    for (int i = 3; i < 6; ++i) rig.send(message, i * 1.0, "10.0.0.9");
    QCOMPARE(rig.view("Robot 3")->rows(), std::size_t{6});
    QCOMPARE(attributesOf(rig.view("Robot 3")->info()).at("sender"), std::string("10.0.0.9"));
    QVERIFY(!rig.view("Robot 3 (2)"));
  }

  void twoSendersOfOneNumber() {
    Rig rig;
    for (int i = 0; i < 5; ++i) {
      rig.send(message, i * 1.0, "10.0.0.1");
      rig.send("3 1 2 3 4 5 6 1 1 1 1 1 8 0.5 121 OUT", i * 1.0 + 0.1, "10.0.0.2");
    }
    QCOMPARE(rig.view("Robot 3")->rows(), std::size_t{5});
    QCOMPARE(rig.view("Robot 3 (2)")->rows(), std::size_t{5});
  }

  void whatIsMadeUpIsBounded() {
    // 100 000 valid messages of robots and fields that nobody has, within an hour.
    Rig rig;
    for (int i = 0; i < 100'000; ++i) {
      std::string text = std::to_string(1 + i % 64'000) + " 1 2 3 4 5 6 1 1 1 1 1 8 0.5 120";
      for (int extra = 0; extra < i % 40; ++extra) text += ' ' + std::to_string(i * 7 + extra);
      rig.send(text + " OUT", i * 0.036);
      if (i % 28 == 0) rig.report(i * 0.036);
    }
    QVERIFY(rig.store->groups() <= 2 * MonitorOptions::maxRobots(0));
    for (GroupId id = 0; id < rig.store->groups(); ++id) {
      QVERIFY(rig.store->view(id)->info().columns.size() <= LiveRows::maxColumns);
    }
    QVERIFY2(rig.store->memoryBytes() < 64'000'000,
             qPrintable(QString::number(rig.store->memoryBytes())));
    QVERIFY(rig.rows.refused().rows > 0 && rig.rows.refused().values > 0);
    // A robot that really plays is received all the same.
    QCOMPARE(rig.send(message, 3601.0), TeamMonitor::Verdict::Used);
    QCOMPARE(rig.view("Robot 3")->range()->end, 3601.0);
  }
};

PITCHBOARD_TEST(TestLiveRows)

}  // namespace tst_live_rows

#include "tst_live_rows.moc"

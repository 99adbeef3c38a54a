// SPDX-License-Identifier: GPL-3.0-or-later
// The list of events, the axis, the marks and the moving position: without a window.
#include <QAbstractItemModelTester>
#include <QtTest>
#include <cmath>

#include <ui/base/time_axis.h>
#include <ui/sources/event_list.h>

#include "event_marks.h"

namespace tst_event_list {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

using link::MatchEvent;
using link::MatchEventKind;

MatchEvent at(double time, MatchEventKind kind = MatchEventKind::Kick, std::string detail = {}) {
  MatchEvent event;
  event.kind = kind;
  event.time = time;
  event.detail = std::move(detail);
  return event;
}

std::vector<double> timesOf(const EventList& list) {
  std::vector<double> times;
  for (const MatchEvent& e : list.events()) times.push_back(e.time);
  return times;
}

}  // namespace

class TestEventList : public QObject {
  Q_OBJECT
 private slots:
  void eventsStandInOrderOfTime() {
    EventList list;
    QAbstractItemModelTester tester(&list, QAbstractItemModelTester::FailureReportingMode::QtTest);
    QCOMPARE(list.add(at(2)), 0);
    QCOMPARE(list.add(at(1)), 0);
    QCOMPARE(list.add(at(2, MatchEventKind::Fall)), 2);
    QCOMPARE(list.add(at(std::nan(""))), -1);
    list.add({at(1.5), at(0.5), at(3)});
    QCOMPARE(timesOf(list), (std::vector{0.5, 1.0, 1.5, 2.0, 2.0, 3.0}));
    QCOMPARE(list.at(4).kind, MatchEventKind::Fall);
    list.rewind(1.5);
    QCOMPARE(timesOf(list), (std::vector{0.5, 1.0, 1.5}));
    list.removeEvent(0);
    list.clear();
    QCOMPARE(list.rowCount(), 0);
  }

  void nextAndPreviousAreStrict() {
    EventList list;
    list.add({at(1), at(2), at(3)});
    QCOMPARE(list.next(1.0).value(), 1);
    QCOMPARE(list.next(0.0).value(), 0);
    QVERIFY(!list.next(3.0));
    QCOMPARE(list.previous(3.0).value(), 1);
    QVERIFY(!list.previous(1.0));
  }

  void memoryIsBoundedAndBookmarksStay() {
    EventList list(nullptr, 100);
    QAbstractItemModelTester tester(&list, QAbstractItemModelTester::FailureReportingMode::QtTest);
    list.add(at(0.0, MatchEventKind::Bookmark, "mine"));
    for (int i = 1; i <= 250; ++i) list.add(at(i));
    QCOMPARE(list.rowCount(), 100);
    QCOMPARE(list.dropped(), std::size_t(151));
    QCOMPARE(list.at(0).detail, std::string("mine"));
    QCOMPARE(list.at(99).time, 250.0);
    std::vector<MatchEvent> many;
    for (int i = 300; i < 600; ++i) many.push_back(at(i));
    list.add(std::move(many));
    QCOMPARE(list.rowCount(), 100);
    QCOMPARE(list.at(0).detail, std::string("mine"));
    // Nothing but bookmarks: the oldest go all the same.
    EventList notes(nullptr, 3);
    for (int i = 0; i < 5; ++i) notes.add(at(double(i), MatchEventKind::Bookmark));
    QCOMPARE(timesOf(notes), (std::vector{2.0, 3.0, 4.0}));
  }

  void onlyBookmarksHaveANoteOfOnesOwn() {
    EventList list;
    QAbstractItemModelTester tester(&list, QAbstractItemModelTester::FailureReportingMode::QtTest);
    list.add(at(1.0, MatchEventKind::Bookmark));
    list.add(at(2));
    QSignalSpy changes(&list, &QAbstractItemModel::dataChanged);
    list.setNote(0, QStringLiteral("  a good\n pass "));
    QCOMPARE(list.at(0).detail, std::string("a good pass"));
    QCOMPARE(changes.size(), 1);
    list.setNote(1, QStringLiteral("no"));
    QVERIFY(list.at(1).detail.empty());
    list.setNote(0, QString(1000, QLatin1Char('x')));
    QCOMPARE(list.at(0).detail.size(), std::size_t(EventList::maxNote));
    QVERIFY(list.flags(list.index(0, EventList::Note)) & Qt::ItemIsEditable);
    QVERIFY(!(list.flags(list.index(1, EventList::Note)) & Qt::ItemIsEditable));
  }

  void whatHasNoMarkIsPassedOver() {
    EventList list;
    list.add({at(1), at(2, MatchEventKind::GotUp), at(3)});
    QCOMPARE(list.next(1.0).value(), 2);
    QCOMPARE(list.previous(3.0).value(), 0);
    const auto marks = layOutMarks(list.events(), {{0, 4}, 0, 400}, {10, 8}, QFontMetrics{QFont()});
    QCOMPARE(marks.size(), std::size_t(2));
  }

  void momentsAreWritten_data() {
    QTest::addColumn<double>("seconds");
    QTest::addColumn<int>("decimals");
    QTest::addColumn<QString>("text");
    QTest::newRow("zero") << 0.0 << 0 << "00:00";
    QTest::newRow("cut off") << 59.999 << 0 << "00:59";
    QTest::newRow("tenths") << 0.3 << 3 << "00:00.300";
    QTest::newRow("hours") << 3723.5 << 1 << "1:02:03.5";
    QTest::newRow("before the beginning") << -5.25 << 2 << QString(QChar(0x2212)) + "00:05.25";
    QTest::newRow("not a time") << double(NAN) << 1 << QString(QChar(0x2013));
  }
  void momentsAreWritten() {
    QFETCH(double, seconds);
    QFETCH(int, decimals);
    QTEST(momentText(seconds, decimals), "text");
  }

  void aSignKeepsItsWidth() {
    QCOMPARE(longMomentText(192.4), QStringLiteral("00:03:12"));
    QCOMPARE(longMomentText(3792.0), QStringLiteral("01:03:12"));
    QCOMPARE(longMomentText(36000.0), QStringLiteral("10:00:00"));
  }

  void ticksAreRoundAndFarEnoughApart_data() {
    QTest::addColumn<double>("begin");
    QTest::addColumn<double>("end");
    for (const double span : {0.05, 0.7, 3.0, 17.0, 330.0, 7200.0, 400000.0}) {
      QTest::addRow("%g s", span) << 12.3 << 12.3 + span;
    }
  }
  void ticksAreRoundAndFarEnoughApart() {
    QFETCH(double, begin);
    QFETCH(double, end);
    const TimeAxis axis{{begin, end}, 10, 1000};
    const auto ticks = axisTicks(axis, 60);
    QVERIFY(ticks.size() >= 2);
    QVERIFY(ticks.size() <= 17);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      QVERIFY(ticks[i].time >= begin - 1e-9 && ticks[i].time <= end + 1e-6 * (end - begin));
      if (i > 0) {
        QVERIFY(axis.pixel(ticks[i].time) - axis.pixel(ticks[i - 1].time) >= 59.99);
        QVERIFY(ticks[i].label != ticks[i - 1].label);
      }
    }
  }

  void timesOfDayAreRoundOnTheClock() {
    const QDateTime start(QDate(2026, 7, 1), QTime(14, 11, 37));
    const auto ticks = axisTicks({{0, 780}, 0, 1300}, 60, start);
    QCOMPARE(ticks.front().label, QStringLiteral("14:12"));
    QCOMPARE(ticks.front().time, 23.0);
  }

  void pixelsAndTimesAreTheSame() {
    const TimeAxis axis{{5, 25}, 12, 400};
    QCOMPARE(axis.pixel(5), 12.0);
    QCOMPARE(axis.time(axis.pixel(13.25)), 13.25);
  }

  void marksThatWouldOverlapBecomeTheMostImportant() {
    EventList list;
    for (int i = 0; i < 1000; ++i) list.add(at(i * 0.1));
    list.add(at(50.05, MatchEventKind::Goal));
    const TimeAxis axis{{0, 100}, 0, 500};
    const QFontMetrics font{QFont()};
    const auto marks = layOutMarks(list.events(), axis, {10, 8}, font);
    int events = 0;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      if (i > 0) QVERIFY(marks[i].x - marks[i - 1].x >= 10);
      QVERIFY(marks[i].first <= marks[i].row && marks[i].row <= marks[i].last);
      events += marks[i].merged;
    }
    QCOMPARE(events, 1001);
    QCOMPARE(std::count_if(marks.begin(), marks.end(),
                           [&list](const EventMark& mark) {
                             return list.at(mark.row).kind == MatchEventKind::Goal;
                           }),
             std::ptrdiff_t(1));
  }

  void labelsNeedSpace() {
    EventList list;
    list.add(at(10, MatchEventKind::GameState, "PLAYING"));
    list.add(at(10.5, MatchEventKind::GameState, "SET"));
    const QFontMetrics font{QFont()};
    const auto narrow = layOutMarks(list.events(), {{0, 20}, 0, 800}, {10, 8}, font);
    QCOMPARE(narrow.size(), std::size_t(2));
    QVERIFY(narrow[0].label.isEmpty());
    QCOMPARE(narrow[1].label, QStringLiteral("SET"));
    const auto wide = layOutMarks(list.events(), {{9, 11}, 0, 800}, {10, 8}, font);
    QCOMPARE(wide[0].label, QStringLiteral("PLAYING"));
  }

  /// What ends a match stands at the right edge of the timeline of its recording.
  void theLastLabelStandsWhereItHasRoom() {
    const QFontMetrics font{QFont()};
    const TimeAxis axis{{0, 20}, 0, 800};
    const auto lastOf = [&](double time, double before) {
      EventList list;
      list.add(at(before, MatchEventKind::GameState, "PLAYING"));
      list.add(at(time, MatchEventKind::GameState, "FINISHED"));
      return layOutMarks(list.events(), axis, {10, 8}, font).back();
    };
    for (const double time : {20.0, 19.9, 19.0}) {
      const EventMark mark = lastOf(time, 2.0);
      QCOMPARE(mark.label, QStringLiteral("FINISHED"));
      QVERIFY(mark.labelLeft);
    }
    QVERIFY(!lastOf(15.0, 2.0).labelLeft);
    QCOMPARE(lastOf(15.0, 2.0).label, QStringLiteral("FINISHED"));
    // Not over the label before it.
    QVERIFY(!lastOf(20.0, 18.5).labelLeft);
  }

  void manyMarksShareThePlacesThereAre() {
    EventList list;
    std::vector<MatchEvent> many;
    for (int i = 0; i < 20'000; ++i)
      many.push_back(at(i * 0.37, MatchEventKind(i % int(link::matchEventKindCount))));
    list.add(std::move(many));
    const auto marks =
        layOutMarks(list.events(), {{0, 7400}, 0, 1900}, {10, 8}, QFontMetrics{QFont()});
    QVERIFY(marks.size() <= 191);
  }
};

PITCHBOARD_GUI_TEST(TestEventList)

}  // namespace tst_event_list

#include "tst_event_list.moc"

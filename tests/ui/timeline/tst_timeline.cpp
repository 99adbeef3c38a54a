// SPDX-License-Identifier: GPL-3.0-or-later
// The timeline as a person uses it: real mouse and keys on a source that goes on.
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>
#include <QWheelEvent>
#include <QtTest>

#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>
#include <ui/timeline/timeline_actions.h>
#include <ui/timeline/timeline_dock.h>

#include "../support/robot_keys.h"
#include "field_signs.h"
#include "timeline_strip.h"

namespace tst_timeline {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

/// Robot R2 stands at x = time; memory holds everything since `oldest`.
class TestSource : public FrameSource {
 public:
  double oldest = 0.0;
  bool nobodyPlays = false;
  FramePtr made(double time) const {
    auto frame = std::make_shared<link::MatchFrame>();
    frame->snapshot.time = time;
    frame->snapshot.clockRunning = true;
    frame->nobodyPlays = nobodyPlays;
    link::RobotFrame robot;
    robot.identity.id = RobotId{7};
    robot.identity.team = TeamColor::Red;
    robot.identity.number = 2;
    robot.key = red(2);
    robot.name = "R2";
    robot.pose.position.x = time;
    frame->robots.push_back(robot);
    return frame;
  }
  void goTo(double time) {
    const telemetry::RowView row{time, {}, {}};
    m_store->append(m_group, row);
    m_frame = made(time);
    emit frameReceived(m_frame);
  }
  void happen(double time, link::MatchEventKind kind) {
    link::MatchEvent event{kind, time, link::uidOf(red(2)), "R2"};
    if (kind == link::MatchEventKind::Goal)
      event = {kind, time, {}, {}, link::Side::Right, 0, TeamColor::Red};
    emit eventsReceived({event});
  }
  const SourceKind& kind() const override { return SourceKind::Live; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return m_store; }
  QString emptyText() const override { return {}; }
  FramePtr frameAt(double time) const override { return time < oldest ? nullptr : made(time); }

 private:
  std::shared_ptr<telemetry::SeriesStore> m_store = std::make_shared<telemetry::SeriesStore>();
  telemetry::GroupId m_group = m_store->addGroup({"match", {}, {}});
  FramePtr m_frame;
};

struct Bench {
  TestSource source;
  ShownMoment timeline{&source};
  ShownMoment& shown = timeline;
  LinkedTime plots{&timeline};
  TimelineActions actions{&timeline, &plots, nullptr, nullptr};
  QWidget window;
  QWidget* dock = nullptr;
  TimelineStrip* strip = nullptr;
  QToolButton* now = nullptr;
  Bench() {
    TimelineContext context;
    context.time = &plots;
    context.shown = &timeline;
    context.timelineActions = &actions;
    dock = makeTimelineDock(context, &window);
    strip = dock->findChild<TimelineStrip*>();
    now = dock->findChild<QToolButton*>(QStringLiteral("now"));
    window.resize(1000, 120);
    dock->setGeometry(0, 0, 1000, dock->sizeHint().height());
    window.show();
    for (int i = 0; i <= 100; ++i) source.goTo(i);
  }
  QPoint above(double time) const { return {qRound(strip->axis().pixel(time)), 20}; }
  QPoint inBand(double time) const {
    return {qRound(strip->axis().pixel(time)), strip->bandRect().center().y()};
  }
  double x() const { return shown.frame()->robots[0].pose.position.x; }
  void drag(QPoint from, QPoint to, Qt::MouseButton button = Qt::LeftButton,
            Qt::KeyboardModifiers keys = {}) const {
    QTest::mousePress(strip, button, keys, from);
    for (const double part : {0.3, 0.7, 1.0}) {
      const QPointF at = QPointF(from) + part * QPointF(to - from);
      QMouseEvent move(QEvent::MouseMove, at, strip->mapToGlobal(at), Qt::NoButton, button, keys);
      QApplication::sendEvent(strip, &move);
    }
    QTest::mouseRelease(strip, button, keys, to);
  }
  void wheel(QPointF at, int notches, Qt::KeyboardModifiers keys = {}) const {
    QWheelEvent event(at, strip->mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, keys,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(strip, &event);
  }
};

constexpr double onePixel = 0.2;  // s, at this size

}  // namespace

class TestTimeline : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aClickLooksBackAndNowReturns() {
    Bench b;
    QVERIFY(!b.now->isChecked() && !b.now->isEnabled());
    QTest::mouseClick(b.strip, Qt::LeftButton, {}, b.above(40));
    QVERIFY(b.timeline.isLookingBack());
    QVERIFY(std::abs(b.x() - 40) <= onePixel);
    QVERIFY(b.now->isChecked());
    // The source goes on unseen.
    const double seen = b.x();
    b.source.goTo(101);
    QCOMPARE(b.x(), seen);
    QCOMPARE(b.timeline.now(), 101.0);
    QTest::mouseClick(b.now, Qt::LeftButton);
    QVERIFY(!b.timeline.isLookingBack());
    QCOMPARE(b.x(), 101.0);
    QVERIFY(!b.now->isChecked());
    b.source.goTo(102);
    QCOMPARE(b.x(), 102.0);
  }

  void aDragScrubs() {
    Bench b;
    QSignalSpy frames(&b.shown, &FrameSource::frameReceived);
    b.drag(b.above(20), b.above(70));
    QVERIFY(frames.size() >= 3);
    QVERIFY(std::abs(b.x() - 70) <= onePixel);
    // Dragged beyond now: now.
    b.drag(b.above(20), b.above(150));
    QVERIFY(!b.timeline.isLookingBack());
  }

  void theSignShowsTheTime() {
    Bench b;
    QLabel& sign = *qobject_cast<QLabel*>(makeLookingBackSign(&b.timeline, &b.window));
    QVERIFY(!sign.isVisible());
    b.timeline.seek(62.5);
    QVERIFY(sign.isVisible());
    QCOMPARE(sign.text(), QStringLiteral("Viewing 01:02.50 · press Now to return"));
    b.timeline.goLive();
    QVERIFY(!sign.isVisible());
  }

  void aSignWarnsThatNoRobotPlays() {
    Bench b;
    QLabel& sign = *qobject_cast<QLabel*>(makeNobodyPlaysSign(&b.shown, &b.window));
    b.source.goTo(101);
    QVERIFY(!sign.isVisible());
    b.source.nobodyPlays = true;
    b.source.goTo(102);
    QVERIFY(sign.isVisible() && sign.text().contains(QStringLiteral("told to play")));
    b.source.nobodyPlays = false;
    b.source.goTo(103);
    QVERIFY(!sign.isVisible());
  }

  void aTypedTimeIsShown_data() {
    QTest::addColumn<QString>("typed");
    QTest::addColumn<double>("time");
    QTest::newRow("seconds") << "78.7" << 78.7;
    QTest::newRow("minutes") << "1:18.7" << 78.7;
    QTest::newRow("hours") << " 00:01:18.7" << 78.7;
    QTest::newRow("the beginning") << "0" << 0.0;
  }
  void aTypedTimeIsShown() {
    QFETCH(QString, typed);
    QFETCH(double, time);
    Bench b;
    const auto dialog = [] {
      for (QWidget* top : QApplication::topLevelWidgets()) {
        if (auto* ask = qobject_cast<QInputDialog*>(top); ask && ask->isVisible()) return ask;
      }
      return static_cast<QInputDialog*>(nullptr);
    };
    const auto type = [](QInputDialog* ask, const QString& text) {
      auto* line = ask->findChild<QLineEdit*>();
      line->clear();
      QTest::keyClicks(line, text);
      QTest::keyClick(line, Qt::Key_Return);
    };
    b.actions.findChild<QAction*>(QStringLiteral("goToTime"))->trigger();
    QVERIFY(dialog() != nullptr);
    // What is no time, and what is not there, is refused with a reason and can be corrected.
    type(dialog(), QStringLiteral("soon"));
    QVERIFY(dialog() != nullptr);
    QVERIFY2(dialog()->labelText().contains(QStringLiteral("1:18.7")),
             qPrintable(dialog()->labelText()));
    QCOMPARE(dialog()->textValue(), QStringLiteral("soon"));
    type(dialog(), QStringLiteral("2:30"));
    QVERIFY(dialog() != nullptr && !b.timeline.isLookingBack());
    type(dialog(), typed);
    QVERIFY(dialog() == nullptr);
    QVERIFY(b.timeline.isLookingBack());
    QCOMPARE(b.timeline.time(), time);
  }

  void eventsAreMarkedAndJumpedTo() {
    Bench b;
    b.source.happen(30, link::MatchEventKind::Goal);
    b.source.happen(60, link::MatchEventKind::Fall);
    QCOMPARE(b.timeline.events()->rowCount(), 2);
    QCOMPARE(b.strip->marks().size(), std::size_t(2));
    QCOMPARE(b.strip->marks()[0].label, QStringLiteral("goal RED"));
    // On the mark's icon: exactly its time.
    QTest::mouseClick(b.strip, Qt::LeftButton, {}, b.above(30) + QPoint(3, -6));
    QCOMPARE(b.x(), 30.0);
    b.actions.next()->trigger();
    QCOMPARE(b.x(), 60.0);
    b.actions.next()->trigger();
    QCOMPARE(b.x(), 60.0);
    b.actions.previous()->trigger();
    QCOMPARE(b.x(), 30.0);
  }

  void aBookmarkIsWrittenInItsPlace() {
    Bench b;
    QSignalSpy reported(&b.timeline, &ShownMoment::bookmarked);
    b.timeline.seek(50);
    b.actions.bookmark()->trigger();
    auto* note = b.strip->findChild<QLineEdit*>(QStringLiteral("bookmarkNote"));
    QVERIFY(note && note->isVisible());
    QTest::keyClicks(note, QStringLiteral("slipped turn"));
    QTest::keyClick(note, Qt::Key_Return);
    const EventList* list = b.timeline.events();
    QCOMPARE(list->at(0).detail, std::string("slipped turn"));
    QCOMPARE(list->at(0).time, 50.0);
    QCOMPARE(reported.last().at(0).value<link::MatchEvent>().detail, std::string("slipped turn"));
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    // Again by double-click; Escape keeps what was.
    QTest::mouseDClick(b.strip, Qt::LeftButton, {}, b.above(50) - QPoint(0, 8));
    note = b.strip->findChild<QLineEdit*>(QStringLiteral("bookmarkNote"));
    QVERIFY(note);
    QTest::keyClicks(note, QStringLiteral("x"));
    QTest::keyClick(note, Qt::Key_Escape);
    QCOMPARE(list->at(0).detail, std::string("slipped turn"));
  }

  // Also where the focus does not go.
  void aNoteClosesWithAClickElsewhere() {
    Bench b;
    QWidget outside(&b.window);
    outside.setGeometry(0, 100, 1000, 20);
    outside.show();
    b.timeline.seek(50);
    b.actions.bookmark()->trigger();
    auto* note = b.strip->findChild<QLineEdit*>(QStringLiteral("bookmarkNote"));
    QVERIFY(note && note->isVisible());
    QTest::keyClicks(note, QStringLiteral("odd sock"));
    QTest::mouseClick(note, Qt::LeftButton);
    QVERIFY(note->isVisible());
    QTest::mouseClick(&outside, Qt::LeftButton);
    QVERIFY(!note->isVisible());
    QCOMPARE(b.timeline.events()->at(0).detail, std::string("odd sock"));
  }

  void aNoteIsReadInACrowd() {
    Bench b;
    for (int i = 0; i <= 60; ++i) b.source.happen(20.0 + i, link::MatchEventKind::Kick);
    b.source.happen(50.1, link::MatchEventKind::Goal);
    b.timeline.seek(50);
    b.timeline.addBookmark(QStringLiteral("slipped"));
    const auto shown = [&b] {
      for (const EventMark& mark : b.strip->marks()) {
        if (mark.label == QStringLiteral("slipped")) return true;
      }
      return false;
    };
    QVERIFY(shown());
  }

  void theWindowOfThePlotsIsDragged() {
    Bench b;
    b.plots.refresh();
    b.plots.setRange({40, 60});
    QVERIFY(b.strip->rangeHandle());
    const auto onHandle = [&b](double time) {
      return QPoint(qRound(b.strip->axis().pixel(time)),
                    qRound(b.strip->rangeHandle()->center().y()));
    };
    QVERIFY(b.strip->rangeHandle()->top() > b.strip->bandRect().bottom());
    b.drag(onHandle(50), onHandle(30));
    QVERIFY(std::abs(b.plots.range().begin - 20) < 2 * onePixel);
    QVERIFY(std::abs(b.plots.span() - 20) < 1e-6);
    // By its edge it becomes longer.
    b.drag(onHandle(b.plots.range().end), onHandle(70));
    QVERIFY(std::abs(b.plots.range().end - 70) < 3 * onePixel);
    QVERIFY(std::abs(b.plots.range().begin - 20) < 2 * onePixel);
    QVERIFY(!b.timeline.isLookingBack());
    // Over its other end it does not collapse.
    b.drag(onHandle(b.plots.range().end), onHandle(5));
    QVERIFY(b.plots.span() * b.strip->axis().width / 100 > 8);
    b.plots.setRange({50.0, 50.01});
    QVERIFY(b.strip->rangeHandle()->width() >= 20);
    b.drag(onHandle(50.0), onHandle(60));
    QVERIFY(std::abs(b.plots.range().begin - 60) < 2 * onePixel);
  }

  /// The band is time, also where the playhead stands and where the plots' window is.
  void theBandLooksBackEverywhere() {
    Bench b;
    b.plots.refresh();
    b.plots.setRange({85, 100});
    const auto before = b.plots.range();
    b.drag(b.inBand(100), b.inBand(70));
    QVERIFY(b.timeline.isLookingBack());
    QVERIFY(std::abs(b.x() - 70) <= onePixel);
    for (const double from : {70.0, 85.0, 92.0, 99.8}) {
      b.timeline.seek(from);
      b.drag(b.inBand(from), b.inBand(40));
      QVERIFY(std::abs(b.x() - 40) <= onePixel);
      QCOMPARE(b.plots.range().end - b.plots.range().begin, before.end - before.begin);
    }
  }

  void aRangeIsChosenAndLooped() {
    Bench b;
    b.drag(b.above(20), b.above(30), Qt::LeftButton, Qt::ShiftModifier);
    QVERIFY(b.timeline.selection());
    QVERIFY(std::abs(b.timeline.selection()->begin - 20) <= onePixel);
    QVERIFY(!b.timeline.isLookingBack());
    b.actions.loop()->trigger();
    QVERIFY(b.timeline.isLooping());
    QVERIFY(std::abs(b.x() - 20) <= onePixel);
    b.timeline.setPaused(false);
    b.timeline.setSpeed(16);
    b.timeline.advance(0.5);
    QVERIFY(b.x() > 27 && b.x() < 29);
    b.timeline.advance(0.25);
    QVERIFY2(b.x() > 21 && b.x() < 23, qPrintable(QString::number(b.x())));
    b.timeline.setSelection({});
    QVERIFY(!b.timeline.isLooping());
  }

  void thePastPlaysUntilItHasCaughtUp() {
    Bench b;
    b.timeline.seek(90);
    b.timeline.setSpeed(2);
    b.timeline.setPaused(false);
    b.timeline.advance(1);
    QCOMPARE(b.x(), 92.0);
    b.timeline.advance(10);
    QVERIFY(!b.timeline.isLookingBack());
    QCOMPARE(b.x(), 100.0);
  }

  void actionsStepAndMove() {
    Bench b;
    const auto does = [&b](const char* id) {
      b.actions.findChild<QAction*>(QLatin1String(id))->trigger();
    };
    does("stepBack");
    QVERIFY(b.timeline.isLookingBack());
    QVERIFY(std::abs(b.x() - (100 - 1 / 60.0)) < 1e-9);
    does("stepBack");
    QVERIFY(std::abs(b.x() - (100 - 2 / 60.0)) < 1e-9);
    does("secondBack");
    QVERIFY(std::abs(b.x() - (99 - 2 / 60.0)) < 1e-9);
    does("secondForward");
    QVERIFY(std::abs(b.x() - (100 - 2 / 60.0)) < 1e-9);
    does("oldestMoment");
    QCOMPARE(b.x(), 0.0);
    does("timelineNow");
    QVERIFY(!b.timeline.isLookingBack());
  }

  void theWheelZoomsAtTheCursorAndPans() {
    Bench b;
    const double under = b.strip->axis().time(300);
    b.wheel({300, 20}, 5);
    QVERIFY(!b.strip->showsAll());
    QVERIFY(b.strip->shown().end - b.strip->shown().begin < 50);
    QVERIFY(std::abs(b.strip->axis().time(300) - under) < 1e-6);
    const double begin = b.strip->shown().begin;
    b.wheel({300, 20}, -1, Qt::ShiftModifier);
    QVERIFY(b.strip->shown().begin > begin);
    b.drag({300, 20}, {400, 20}, Qt::MiddleButton);
    QVERIFY(b.strip->shown().begin < begin + 5);
    QTest::mouseDClick(b.strip, Qt::LeftButton, {}, {500, b.strip->height() - 3});
    QVERIFY(b.strip->showsAll());
    // However often: the axis stays sane.
    for (int i = 0; i < 400; ++i) b.wheel({300, 20}, 1);
    QVERIFY(b.strip->shown().end - b.strip->shown().begin >= 0.04);
    for (int i = 0; i < 800; ++i) b.wheel({300, 20}, -1);
    QVERIFY(std::isfinite(b.strip->shown().end));
    b.strip->grab();
  }

  void whatLeavesMemoryIsNotShown() {
    Bench b;
    b.source.oldest = 1000;
    QTest::mouseClick(b.strip, Qt::LeftButton, {}, b.above(40));
    QVERIFY(!b.timeline.isLookingBack());
    QCOMPARE(b.x(), 100.0);
  }

  void anotherMatchForgetsThePast() {
    Bench b;
    b.source.happen(30, link::MatchEventKind::Goal);
    b.timeline.seek(40);
    b.timeline.setSelection(telemetry::TimeRange{10, 20});
    emit b.source.restarted();
    QVERIFY(!b.timeline.isLookingBack());
    QVERIFY(!b.timeline.selection());
    QCOMPARE(b.timeline.events()->rowCount(), 0);
  }

  void eventsOfASourceThatIsNotShownAreKept() {
    Bench b;
    TestSource other;
    b.timeline.add(&other);
    b.shown.choose(&other);
    QCOMPARE(b.timeline.events()->rowCount(), 0);
    b.source.happen(70, link::MatchEventKind::Kick);
    QCOMPARE(b.timeline.events()->rowCount(), 0);
    b.shown.choose(&b.source);
    QCOMPARE(b.timeline.events()->rowCount(), 1);
  }

  void aSecondSessionHasARowOfItsOwn() {
    Bench b;
    EventList other;
    other.add({link::MatchEventKind::Goal, 5.0, {}, "RED"});
    const int before = b.strip->sizeHint().height();
    b.strip->setCompared({{&other, 20.0, QStringLiteral("other")}});
    QVERIFY(b.strip->sizeHint().height() > before);
    const QImage with = b.strip->grab().toImage();
    other.clear();
    QVERIFY(b.strip->grab().toImage() != with);
  }
};

PITCHBOARD_GUI_TEST(TestTimeline)

}  // namespace tst_timeline

#include "tst_timeline.moc"

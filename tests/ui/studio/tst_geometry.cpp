// SPDX-License-Identifier: GPL-3.0-or-later
// How the window shares its room out, in windows of all sizes.

#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QDockWidget>
#include <QGraphicsView>
#include <QLabel>
#include <QTabBar>
#include <QToolBar>
#include <QToolButton>
#include <QtTest>

#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/referee_calls.h>
#include <ui/sources/session_recording.h>

#include "field_scene.h"
#include "geometry.h"
#include "plot_page.h"
#include "plot_pane.h"
#include "scoreboard.h"
#include "value_chart.h"
#include "window_rig.h"

namespace tst_geometry {

using namespace pitchboard;
using namespace pitchboard::ui;
using window_rig::Studio;

/// Height of the panels below the field, with their tabs.
int lowerPanel(Studio& s) {
  const auto* plots = s.find<QDockWidget>("plots");
  int height = plots->height();
  for (const auto* tabs : s.window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    const QRect room = tabs->geometry();
    const bool isBeside = std::abs(room.bottom() + 1 - plots->y()) <= 1 ||
                          std::abs(room.y() - plots->geometry().bottom() - 1) <= 1;
    if (tabs->isVisible() && isBeside &&
        room.intersects(QRect(plots->x(), 0, plots->width(), 9999)))
      height += tabs->height();
  }
  return height;
}

class TestGeometry : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void theFieldHasItsShare_data() {
    QTest::addColumn<QSize>("size");
    QTest::addColumn<double>("share");
    QTest::newRow("960x540") << QSize(960, 540) << 0.45;
    QTest::newRow("960x600") << QSize(960, 600) << 0.5;
    QTest::newRow("1280x800") << QSize(1280, 800) << 0.55;
    QTest::newRow("1440x900") << QSize(1440, 900) << 0.55;
    QTest::newRow("1920x1080") << QSize(1920, 1080) << 0.6;
  }
  void theFieldHasItsShare() {
    QFETCH(QSize, size);
    QFETCH(double, share);
    Studio s(size);
    s.play();
    const auto* canvas = s.window.field()->findChild<QAbstractScrollArea*>();
    const auto enough = [&] { return canvas->height() >= share * size.height(); };
    QTRY_VERIFY2(enough(), qPrintable(QString::number(canvas->height())));
    QCOMPARE(s.window.size(), size);
    // Wider than the panels beside it together.
    QVERIFY2(canvas->width() >= 0.45 * size.width(), qPrintable(QString::number(canvas->width())));
  }

  // Wherever a person drops a panel, by hand.
  void aDroppedPanelLeavesTheFieldItsShare_data() {
    QTest::addColumn<QString>("panel");
    QTest::addColumn<Qt::Edge>("edge");
    for (const char* panel : {"variables", "robots"}) {
      QTest::addRow("%s, top", panel) << QString(panel) << Qt::TopEdge;
      QTest::addRow("%s, bottom", panel) << QString(panel) << Qt::BottomEdge;
    }
  }
  void aDroppedPanelLeavesTheFieldItsShare() {
    QFETCH(QString, panel);
    QFETCH(Qt::Edge, edge);
    Studio s({1280, 800});
    s.play();
    const auto* canvas = s.window.field()->findChild<QAbstractScrollArea*>();
    const auto share = [&] { return double(canvas->height()) / s.window.height(); };
    QTRY_VERIFY(share() >= 0.55);
    auto* dock = s.window.findChild<QDockWidget*>(panel);
    s.window.setAnimated(false);  // a panel that still glides cannot be grabbed
    QWidget* title = dock->titleBarWidget();
    const QPoint grip(30, title->height() / 2);
    const int y = edge == Qt::TopEdge ? s.window.centralWidget()->y() + 3
                                      : s.find<QDockWidget>("timeline")->y() - 3;
    const QPoint to = s.window.mapToGlobal(QPoint(s.window.width() / 2, y));
    QTest::mousePress(title, Qt::LeftButton, {}, grip);
    const QPoint from = title->mapToGlobal(grip);
    bool floated = false;
    for (const double part : {0.1, 0.4, 0.8, 1.0, 1.0}) {
      const QPoint at = from + ((to - from) * part);
      QMouseEvent move(QEvent::MouseMove, title->mapFromGlobal(at), at, Qt::NoButton,
                       Qt::LeftButton, {});
      QApplication::sendEvent(title, &move);
      QCoreApplication::processEvents();
      floated = floated || dock->window() != &s.window;
    }
    QTest::mouseRelease(title, Qt::LeftButton, {}, title->mapFromGlobal(to));
    QVERIFY(floated);
    if (edge == Qt::BottomEdge) QTRY_VERIFY(dock->window() == &s.window);
    for (int i = 0; i < 10; ++i) QCoreApplication::processEvents();
    QTRY_VERIFY(s.window.dockWidgetArea(dock) != Qt::TopDockWidgetArea);
    QVERIFY(dock->isVisible());
    QTRY_VERIFY2(share() >= 0.55, qPrintable(QString::number(share())));
    QCOMPARE(s.window.size(), QSize(1280, 800));
  }

  void theFieldIsFittedWhenAPanelFloats() {
    Studio s({1000, 900});  // narrow: the width decides how large the field is
    s.play();
    const auto* canvas = s.window.field()->findChild<QGraphicsView*>();
    const sim::FieldSpec field = s.controller.frame()->settings->field;
    const auto scale = [canvas] { return canvas->transform().m11(); };
    const auto isWhole = [&] {
      const QPoint corner = canvas->mapFromScene(-field.halfLength(), -field.halfWidth());
      const QPoint other = canvas->mapFromScene(field.halfLength(), field.halfWidth());
      return canvas->viewport()->rect().contains(QRect(corner, other).normalized());
    };
    QTRY_VERIFY(isWhole());
    for (const char* panel : {"robots", "variables"}) {
      const double before = scale();
      s.find<QDockWidget>(panel)->setFloating(true);
      QTRY_VERIFY2(scale() > 1.1 * before && isWhole(), panel);
    }
    const double large = scale();
    s.find<QDockWidget>("variables")->setFloating(false);
    QTRY_VERIFY(scale() < large && isWhole());
  }

  void robotsAreAtLeast18Pixels_data() {
    QTest::addColumn<QString>("scenario");
    for (const char* name : {"kick-off", "match-11v11"}) QTest::newRow(name) << QString(name);
  }
  void robotsAreAtLeast18Pixels() {
    QFETCH(QString, scenario);
    Studio s({1280, 800});
    s.controller.open(link::loadScenario(scenario.toStdString()).value(), true);
    QTRY_VERIFY(s.controller.frame());
    const auto* canvas = s.window.field()->findChild<QGraphicsView*>();
    const auto* scene = static_cast<FieldScene*>(canvas->scene());
    const double radius = scene->radius(s.controller.frame()->robots[0].uid);
    const double wide = 2 * scene->style().drawRadius(radius) * canvas->transform().m11();
    QVERIFY2(wide >= scaled(canvas, 18) - 0.5, qPrintable(QString::number(wide)));
  }

  void robotsKeepTheirSizeInThePast() {
    Studio s({1280, 800});
    s.controller.open(link::loadScenario("kick-off").value(), true);
    s.controller.runTo(60);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 60);
    const sim::RobotSnapshot now = s.controller.frame()->robots[0];
    const RobotUid first = s.controller.frame()->robots[0].uid;
    const auto* canvas = s.window.field()->findChild<QGraphicsView*>();
    const auto* scene = static_cast<FieldScene*>(canvas->scene());
    QVERIFY(now.radius > 0.0);  // its model's, not the field's
    QTRY_COMPARE(scene->radius(first), now.radius);
    s.timeline()->seek(0.5);
    QTRY_COMPARE(scene->frame()->origin, link::FrameOrigin::Recorded);
    const link::RobotFrame* past = scene->frame()->robot(first);
    QCOMPARE(scene->radius(first), now.radius);
    QVERIFY(std::abs(past->fieldOfView - now.fieldOfView) < 1e-9);
    QCOMPARE(past->visionRange, now.visionRange);
  }

  void thePenaltyStripHidesNoRobot() {
    Studio s({960, 600});
    s.controller.open(link::loadScenario("kick-off").value(), true);
    s.controller.runTo(60);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 60);
    std::vector<RobotId> all;
    for (const auto& robot : s.controller.frame()->robots) all.push_back(robot.slot());
    callReferee(s.controller.edits(),
                {.kind = sim::CallKind::Penalise, .penalty = PenaltyKind::Incapable}, all,
                QStringLiteral("penalise"));
    // They are taken to the touch line.
    const auto* strip = s.find<QLabel>("penaltyStrip");
    s.controller.runTo(600);
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t{600});
    // Robots walk below it while its text stays the same.
    QTRY_VERIFY2(strip->isVisible() && !s.window.field()->hasRobotIn(strip->geometry()),
                 qPrintable(strip->text()));
    s.timeline()->seek(3.0);
    const auto* past = s.find<QLabel>("lookingBack");
    QTRY_VERIFY(strip->isVisible() && past->isVisible());
    const QRect box = strip->geometry();
    QVERIFY2(!s.window.field()->hasRobotIn(box), qPrintable(strip->text()));
    QVERIFY(!box.intersects(past->geometry()));
    // Every number is inside, in two lines if need be.
    const QRect text =
        strip->fontMetrics().boundingRect(QRect(0, 0, box.width() - 8, 1000),
                                          strip->wordWrap() ? Qt::TextWordWrap : 0, strip->text());
    QVERIFY2(text.width() <= box.width() && text.height() <= box.height(),
             qPrintable(strip->text()));
  }

  void theSpaceFollowsTheWindow() {
    Studio s({1440, 900});
    s.play();
    const auto* robots = s.find<QDockWidget>("robots");
    QTRY_COMPARE(robots->width(), extentsFor({1440, 900}).left);
    s.window.resize(960, 600);
    QTRY_COMPARE(robots->width(), extentsFor({960, 600}).left);
    s.window.resize(1440, 900);
    QTRY_COMPARE(robots->width(), extentsFor({1440, 900}).left);
    // Until somebody drags an edge.
    const QPoint edge = robots->mapTo(&s.window, QPoint(robots->width() + 1, 100));
    QTest::mousePress(&s.window, Qt::LeftButton, {}, edge);
    const QPointF to = edge + QPoint(40, 0);
    QMouseEvent move(QEvent::MouseMove, to, s.window.mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                     {});
    QApplication::sendEvent(&s.window, &move);
    QTRY_VERIFY(robots->width() > extentsFor({1440, 900}).left + 20);
    QTest::mouseRelease(&s.window, Qt::LeftButton, {}, to.toPoint());
    const int chosen = robots->width();
    s.window.resize(1300, 820);
    QCoreApplication::processEvents();
    QCOMPARE(robots->width(), chosen);
  }

  void aLowWindowHasOneRowThatGrows() {
    Studio s({1100, 700});
    s.play();
    const auto* page = s.window.findChild<PlotsDock*>()->currentPage();
    QCOMPARE(page->panes().size(), 2);
    const PlotPane* lane = page->panes()[1];
    QTRY_VERIFY(!lane->isVisible() && page->panes()[0]->isVisible());
    auto* dock = s.find<QDockWidget>("plots");
    s.window.resizeDocks({dock}, {300}, Qt::Vertical);
    QTRY_VERIFY(lane->isVisible());
  }

  void aPlotAndItsLaneAreSeenAtFirst_data() {
    QTest::addColumn<QSize>("size");
    for (const QSize size : {QSize(1280, 800), QSize(1366, 768), QSize(1440, 900)})
      QTest::addRow("%dx%d", size.width(), size.height()) << size;
  }
  void aPlotAndItsLaneAreSeenAtFirst() {
    QFETCH(QSize, size);
    Studio s(size);
    s.play();
    const auto* page = s.window.findChild<PlotsDock*>()->currentPage();
    QCOMPARE(page->panes().size(), 2);
    const auto* chart = page->panes()[0]->findChild<ValueChart*>();
    QVERIFY(chart);
    const auto curveHeight = [chart] { return chart->plotArea().height(); };
    QTRY_VERIFY2(curveHeight() >= 110, qPrintable(QString::number(curveHeight())));
    QTRY_VERIFY(page->panes()[1]->isVisible());
    const QWidget* lane = page->panes()[1];
    QVERIFY(!lane->visibleRegion().isEmpty());
    QCOMPARE(lane->visibleRegion().boundingRect().height(), lane->height());
  }

  /// Of the log, in front in the first layout.
  void theLogHasSomeRows_data() { aPlotAndItsLaneAreSeenAtFirst_data(); }
  void theLogHasSomeRows() {
    QFETCH(QSize, size);
    Studio s(size);
    s.play();
    auto* dock = s.find<QDockWidget>("log");
    dock->show();
    dock->raise();
    const auto* lines = dock->findChild<QAbstractItemView*>();
    QVERIFY(lines && lines->model()->rowCount() > 0);
    const auto rows = [lines] {
      return lines->viewport()->height() / std::max(1, lines->sizeHintForRow(0));
    };
    QTRY_VERIFY2(rows() >= 5, qPrintable(QString::number(rows())));
  }

  void nothingGrowsTheWindow_data() {
    QTest::addColumn<QSize>("size");
    for (const QSize size : {QSize(960, 540), QSize(960, 600), QSize(1280, 800)}) {
      QTest::newRow(qPrintable(QString::number(size.height()))) << size;
    }
  }
  void nothingGrowsTheWindow() {
    QFETCH(QSize, size);
    Studio s(size);
    s.play();
    const auto same = [&](const char* what) {
      for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
      QVERIFY2(s.window.size() == size, qPrintable(QStringLiteral("%1: %2×%3")
                                                       .arg(QString::fromUtf8(what))
                                                       .arg(s.window.width())
                                                       .arg(s.window.height())));
    };
    for (auto* dock : s.window.findChildren<QDockWidget*>()) {
      if (dock->isHidden()) dock->toggleViewAction()->trigger();
      same(qPrintable(dock->objectName()));
    }
    s.menuAction(QStringLiteral("Reset layout"))->trigger();
    same("reset");
    for (const SourceKind kind : {SourceKind::Live, SourceKind::Replay, SourceKind::Simulate}) {
      s.window.showSource(kind);
      same("source");
    }
  }

  // Whatever the match, the referee and the recording say, nothing in the tool bar moves.
  void barsStandStill_data() {
    QTest::addColumn<QSize>("size");
    QTest::newRow("960") << QSize(960, 600);
    QTest::newRow("1280") << QSize(1280, 800);
  }
  void barsStandStill() {
    QFETCH(QSize, size);
    Studio s(size);
    s.play();
    auto* bar = s.find<QToolBar>("transportBar");
    auto* score = s.window.findChild<Scoreboard*>();
    const auto places = [&] {
      QList<QRect> all{score->geometry()};
      for (const QWidget* each : bar->findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
        if (each->isVisible() && each != score) all << each->geometry();
      }
      return all;
    };
    QTRY_VERIFY(s.find<QToolButton>("record")->isVisible());
    const QList<QRect> before = places();
    ScoreboardState wordy;
    wordy.leftName = QStringLiteral("A TEAM WITH A VERY LONG NAME");
    wordy.rightName = QStringLiteral("ANOTHER ONE");
    wordy.left = 10;
    wordy.state = QStringLiteral("PLAYING · corner kick 12 · 44 s");
    wordy.penalties = QStringLiteral("Penalties: B1 20 · B2 30 · R3 5");
    score->setState(wordy);
    QCoreApplication::processEvents();
    QCOMPARE(score->geometry(), before.front());
    s.window.recording()->start();
    QVERIFY(s.window.recording()->isRecording());
    QCoreApplication::processEvents();
    QCOMPARE(places(), before);
    for (const QRect& place : before) QVERIFY(bar->rect().contains(place));
  }

  // Nothing of the tool bar is behind », in no mode, in the smallest window that is promised.
  void theWholeBarIsSeen_data() {
    QTest::addColumn<SourceKind>("kind");
    QTest::newRow("Simulate") << SourceKind::Simulate;
    QTest::newRow("Live") << SourceKind::Live;
    QTest::newRow("Replay") << SourceKind::Replay;
  }
  void theWholeBarIsSeen() {
    QFETCH(SourceKind, kind);
    Studio s({960, 600});
    s.play();
    s.window.showSource(kind);
    auto* bar = s.find<QToolBar>("transportBar");
    auto* score = s.find<Scoreboard>("scoreboard");
    QCoreApplication::processEvents();
    const auto* more = bar->findChild<QToolButton*>("qt_toolbar_ext_button");
    QTRY_VERIFY(more->isHidden());
    QStringList needed{"restart", "play", "step"};
    for (QWidget* one : bar->findChildren<QWidget*>()) {
      if (one->isHidden() || !one->isVisible() || score == one) continue;
      const QRect place(one->mapTo(bar, QPoint()), one->size());
      QVERIFY2(place.right() <= score->geometry().left(), qPrintable(one->objectName()));
      if (auto* button = qobject_cast<QToolButton*>(one); button && button->defaultAction())
        needed.removeAll(button->defaultAction()->objectName());
    }
    QVERIFY2(needed.isEmpty(), qPrintable(needed.join(QLatin1Char(' '))));
    const auto seen = [&s](const char* name) { return s.find<QWidget>(name)->isVisible(); };
    if (kind == SourceKind::Simulate) QVERIFY(seen("skip") && seen("record"));
    if (kind == SourceKind::Live)
      QVERIFY(seen("livePorts") && seen("ourTeam") && seen("monitorMode") && seen("record"));
  }

  void experimentsHaveSpaceWhileTheyAreOpen() {
    Studio s({1280, 800});
    s.play();
    auto* dock = s.find<QDockWidget>("experiments");
    dock->toggleViewAction()->trigger();
    const auto* form = s.find<QAbstractScrollArea>("experimentForm");
    QTRY_VERIFY2(form->isVisible() && form->viewport()->height() >= scaled(form, 140),
                 qPrintable(QString::number(form->viewport()->height())));
    dock->close();
    s.find<QDockWidget>("plots")->raise();
    QTRY_VERIFY2(std::abs(lowerPanel(s) - extentsFor({1280, 800}).bottom) <= 1,
                 qPrintable(QString::number(lowerPanel(s))));
  }

  void equalWindowsHaveEqualPanels() {
    for (const bool live : {false, true}) {
      Studio s({1280, 800});
      if (live) s.window.showSource(SourceKind::Live);
      s.play();
      if (live) s.window.showSource(SourceKind::Simulate);
      for (const char* id : {"log", "processes", "plots"}) s.find<QDockWidget>(id)->raise();
      QTRY_VERIFY2(std::abs(lowerPanel(s) - extentsFor({1280, 800}).bottom) <= 1,
                   qPrintable(QString::number(lowerPanel(s))));
    }
  }

  void theBarOfReplayOffersItsActions() {
    Studio s({1280, 800});
    const auto shown = [&s](const char* id) {
      for (const auto* button : s.find<QToolBar>("transportBar")->findChildren<QToolButton*>()) {
        if (button->defaultAction() == s.find<QAction>(id)) return button->isVisible();
      }
      return false;
    };
    for (const char* id :
         {"openSession", "compareSession", "exportSession", "previousEvent", "nextEvent"}) {
      QVERIFY2(!shown(id), id);
    }
    s.window.showSource(SourceKind::Replay);
    for (const char* id :
         {"openSession", "compareSession", "exportSession", "previousEvent", "nextEvent"}) {
      QTRY_VERIFY2(shown(id), id);
    }
  }
};

PITCHBOARD_GUI_TEST(TestGeometry)

}  // namespace tst_geometry

#include "tst_geometry.moc"

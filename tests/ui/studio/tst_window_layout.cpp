// SPDX-License-Identifier: GPL-3.0-or-later
// What the window shows in little room, and that its layout is kept.

#include <QDockWidget>
#include <QHeaderView>
#include <QLabel>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <QTabBar>
#include <QTextEdit>
#include <QToolBar>
#include <QToolButton>
#include <QTreeView>
#include <QtTest>

#include <ui/base/notice_bar.h>
#include <ui/base/theme.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "../support/mouse_wheel.h"
#include "alarms.h"
#include "plot_page.h"
#include "plot_pane.h"
#include "scoreboard.h"
#include "window_rig.h"

namespace tst_window_layout {

using namespace pitchboard;
using namespace pitchboard::ui;
using window_rig::Studio;

class TestWindowLayout : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void theLayoutIsKeptWhileItRuns() {
    Studio s;
    s.find<QDockWidget>("processes")->close();
    // As if the studio were killed: what is in the settings by then is what counts.
    QTRY_VERIFY_WITH_TIMEOUT(s.settings.contains(QStringLiteral("window/layout")), 30'000);
    MatchController controller(Studio::options());
    MainWindow again(&controller, &s.settings);
    again.show();
    QVERIFY(again.findChild<QDockWidget*>(QStringLiteral("processes"))->isHidden());
    QVERIFY(!again.findChild<QDockWidget*>(QStringLiteral("plots"))->isHidden());
  }

  // Qt moves a window that begins close to the top of the screen, by the height that the style
  // gives title bars. It was lower after every start, with a frame that is lower than that.
  void itStartsWhereItWas() {
    for (const QPoint place : {QPoint(0, 0), QPoint(40, 7)}) {
      const QSize size(700, 500);
      Studio s(size);
      s.window.move(place);
      QTRY_COMPARE(s.window.pos(), place);
      s.window.close();
      for (int start = 0; start < 2; ++start) {
        MatchController controller(Studio::options());
        MainWindow again(&controller, &s.settings);
        again.show();
        QVERIFY(QTest::qWaitForWindowExposed(&again));
        QCOMPARE(again.pos(), place);
        QCOMPARE(again.size(), size);
        again.close();
      }
    }
  }

  void theScoreStaysInNarrowWindows() {
    Studio s({1000, 700});
    s.play();
    auto* score = s.window.findChild<Scoreboard*>();
    QTRY_VERIFY(score->isVisible() && score->width() >= score->sizeHint().width());
    const QPoint right = score->mapTo(&s.window, QPoint(score->width(), 0));
    QVERIFY(right.x() <= s.window.width());
  }

  void hiddenToolBarButtonsAreOneClickAway() {
    Studio s({720, 600});
    s.play();
    for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
    s.window.resize(720, 600);
    auto* bar = s.find<QToolBar>("transportBar");
    auto* more = bar->findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
    const auto* score = s.window.findChild<Scoreboard*>();
    const auto* record = s.find<QToolButton>("record");
    QTRY_VERIFY(more->isVisible() && !record->isVisible());
    QTRY_VERIFY(!more->geometry().intersects(score->geometry()));
    QVERIFY(bar->rect().contains(more->geometry()));
    const QImage drawn = more->grab().toImage();
    // Its arrow is seen on the ground of the theme.
    const int ground = theme().button.lightness();
    bool any = false;
    for (int x = 2; x < drawn.width() - 2; ++x) {
      for (int y = 2; y < drawn.height() - 2; ++y) {
        any = any || drawn.pixelColor(x, y).lightness() > ground + 60;
      }
    }
    QVERIFY(any);
    QTest::mouseClick(more, Qt::LeftButton);
    QTRY_VERIFY(record->isVisible());
  }

  void namesOfVariablesAndHeadsAreWhole() {
    Studio s({1440, 900});
    s.play();
    const auto* view = s.find<QTreeView>("variablesView");
    QTRY_VERIFY(view->model()->rowCount() > 0);
    const QHeaderView* header = view->header();
    for (int c = 0; c < header->count(); ++c) {
      if (header->isSectionHidden(c)) continue;
      const QString text = view->model()->headerData(c, Qt::Horizontal).toString();
      const int wide = QFontMetrics(header->font()).horizontalAdvance(text);
      QVERIFY2(header->sectionSize(c) >= wide + 4, qPrintable(text));
    }
    // A robot's variables stand on the third level.
    const int margin = view->style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, view) + 1;
    const int room = header->sectionSize(0) - 3 * view->indentation() - 2 * margin;
    const QFontMetrics metrics(view->font());
    const QModelIndex robot = view->model()->index(0, 0);
    int count = 0;
    for (int c = 0; c < view->model()->rowCount(robot); ++c) {
      const QModelIndex category = view->model()->index(c, 0, robot);
      for (int v = 0; v < view->model()->rowCount(category); ++v, ++count) {
        const QString name = view->model()->index(v, 0, category).data().toString();
        QVERIFY2(metrics.horizontalAdvance(name) <= room, qPrintable(name));
      }
    }
    QVERIFY(count > 10);
  }

  // Twice as large on 1920 x 1200, nothing may ask for more than there is.
  void theWindowIsAsNarrowAsHalfAScreen_data() {
    QTest::addColumn<SourceKind>("shown");
    QTest::newRow("simulate") << SourceKind::Simulate;
    QTest::newRow("live") << SourceKind::Live;
    QTest::newRow("replay") << SourceKind::Replay;
  }
  void theWindowIsAsNarrowAsHalfAScreen() {
    QFETCH(SourceKind, shown);
    Studio s({960, 600});
    s.play();
    s.controller.edits()->setBehaviour({RobotId{2}}, QStringLiteral("striker"));
    s.window.showSource(shown);
    for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
    s.window.resize(960, 600);
    QCoreApplication::processEvents();
    QStringList wide;
    for (const QWidget* each : s.window.findChildren<QWidget*>()) {
      const int least = std::max(each->minimumSizeHint().width(), each->minimumWidth());
      if (!each->isVisible() || least < 250) continue;
      wide << QStringLiteral("%1 %2 %3")
                  .arg(QLatin1String(each->metaObject()->className()), each->objectName())
                  .arg(least);
    }
    QVERIFY2(s.window.minimumSizeHint().width() <= 960, qPrintable(wide.join(u'\n')));
    QCOMPARE(s.window.width(), 960);
    auto* score = s.window.findChild<Scoreboard*>();
    QVERIFY(score->isVisible() && score->width() >= score->sizeHint().width());
    QVERIFY(score->mapTo(&s.window, QPoint()).x() >= 0);
    QVERIFY(score->mapTo(&s.window, QPoint(score->width(), 0)).x() <= 960);
  }

  void theWindowFitsASmallScreen() {
    Studio s({1280, 800});
    s.play();
    PaneSpec lane;
    lane.kind = PaneKind::Lane;
    lane.curves << variableCurve(QStringLiteral("B1/DECISION_ACTION_A"));
    auto* plots = s.window.findChild<PlotsDock*>();
    for (int i = 0; i < 24; ++i) plots->currentPage()->insertPane(i, lane);
    QCoreApplication::processEvents();
    QVERIFY2(s.window.minimumSizeHint().height() <= 720,
             qPrintable(QString::number(s.window.minimumSizeHint().height())));
    QCOMPARE(s.window.size(), QSize(1280, 800));
  }

  // What is not asked for is not larger than the screen, also when docks ask for more at first.
  void theFirstWindowFitsItsScreen() {
    Studio s{QSize()};
    const QRect room = s.window.screen()->availableGeometry();
    QVERIFY2(room.width() < 1246 || room.height() < 724, "the screen of this platform is large");
    QTRY_VERIFY(room.contains(s.window.frameGeometry()));
  }

  void theNoisePanelScrollsByWheel() {
    Studio s;
    s.play();
    auto* dock = s.find<QDockWidget>("noise");
    dock->show();
    dock->raise();
    auto* area = qobject_cast<QScrollArea*>(dock->widget());
    QTRY_VERIFY(area->verticalScrollBar()->maximum() > 0);
    auto* slider = area->findChild<QSlider*>();
    const int value = slider->value();
    turnWheel(slider, slider->rect().center(), -240);
    QTRY_VERIFY(area->verticalScrollBar()->value() > 0);
    QCOMPARE(slider->value(), value);
  }

  // Three panels below each other at the right showed a few rows each; among tabs, what the menu
  // opens was behind the others.
  void aPanelThatWasAskedForIsInFront() {
    Studio s;
    s.play();
    const auto inFront = [&s](const char* name) {
      const auto* dock = s.find<QDockWidget>(name);
      const QWidget* seen = s.window.childAt(dock->mapTo(&s.window, dock->rect().center()));
      return seen != nullptr && dock->isAncestorOf(seen);
    };
    QVERIFY(inFront("variables") && inFront("plots"));
    s.menuAction(QStringLiteral("Experiments"))->trigger();
    QTRY_VERIFY(inFront("experiments") && !inFront("plots"));
    // Open behind a tab it comes to the front; only what is seen is closed.
    QVERIFY(!s.find<QDockWidget>("log")->isHidden() && !inFront("log"));
    s.find<QDockWidget>("log")->toggleViewAction()->trigger();
    QTRY_VERIFY(inFront("log") && !inFront("experiments"));
    QVERIFY(s.find<QDockWidget>("log")->toggleViewAction()->isChecked());
    s.find<QDockWidget>("log")->toggleViewAction()->trigger();
    QTRY_VERIFY(s.find<QDockWidget>("log")->isHidden());
    QVERIFY(!s.find<QDockWidget>("log")->toggleViewAction()->isChecked());
    for (const char* name : {"noise", "referee"}) {
      s.find<QDockWidget>(name)->toggleViewAction()->trigger();
      QTRY_VERIFY2(inFront(name), name);
      QVERIFY2(!inFront("variables"), name);
      QVERIFY(s.find<QDockWidget>(name)->height() > s.window.height() / 3);
    }
  }

  void tabNamesAreWholeInANarrowWindow() {
    Studio s({960, 600});
    s.play();
    for (const char* name : {"noise", "explore", "referee"}) {
      s.find<QDockWidget>(name)->toggleViewAction()->trigger();
      QTRY_VERIFY(!s.find<QDockWidget>(name)->isHidden());
    }
    const auto row = [&s]() -> QTabBar* {
      for (QTabBar* bar : s.window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
        for (int i = 0; i < bar->count(); ++i) {
          if (bar->tabText(i) == QStringLiteral("Referee") && bar->isVisible()) return bar;
        }
      }
      return nullptr;
    };
    QTRY_VERIFY(row() != nullptr && row()->count() == 4);
    const auto whole = [&row] {
      for (int i = 0; i < row()->count(); ++i) {
        const QString text = row()->tabText(i);
        if (row()->tabRect(i).width() < row()->fontMetrics().horizontalAdvance(text)) return false;
      }
      return row()->elideMode() == Qt::ElideNone;
    };
    QTRY_VERIFY(whole());
    // The chosen one is in sight.
    QTRY_COMPARE(row()->tabText(row()->currentIndex()), QStringLiteral("Referee"));
    QVERIFY(row()->rect().contains(row()->tabRect(row()->currentIndex()).center()));
  }

  // The panel that stayed behind had neither a tab nor a title.
  void whoStaysBehindAFloatingPanelHasItsTitle() {
    Studio s;
    s.play();
    auto* referee = s.find<QDockWidget>("referee");
    referee->toggleViewAction()->trigger();
    QTRY_VERIFY(!referee->isHidden());
    const auto beside = s.window.tabifiedDockWidgets(referee);
    const auto shown =
        std::ranges::find_if(beside, [](const QDockWidget* dock) { return !dock->isHidden(); });
    QVERIFY(shown != beside.end());
    QDockWidget* const other = *shown;
    QTRY_COMPARE(other->titleBarWidget()->sizeHint().height(), 0);
    referee->setFloating(true);
    QTRY_VERIFY(other->titleBarWidget()->sizeHint().height() > 0);
    QVERIFY(referee->titleBarWidget()->sizeHint().height() > 0);
    // It has a frame, by which it is told from the window.
    QTRY_COMPARE(referee->grab().toImage().pixelColor(0, referee->height() / 2), theme().innerLine);
  }

  void aNoticeIsAsHighAsItsText() {
    Studio s;
    s.play();
    auto* notices = s.window.notices();
    notices->show({QStringLiteral("test")}, QStringLiteral("One line."));
    const auto* label = notices->findChild<QTextEdit*>(QStringLiteral("noticeText"));
    QTRY_VERIFY(notices->isVisible() && label->width() > 200);
    QVERIFY2(notices->height() < 3 * label->fontMetrics().height(),
             qPrintable(QString::number(notices->height())));
  }

  void allToolsOfThePlotsAreSeen() {
    Studio s;
    s.play();
    auto* tools = s.find<QToolBar>("plotTools");
    int seen = 0;
    for (const auto* button : tools->findChildren<QToolButton*>()) {
      if (button->objectName() == QStringLiteral("qt_toolbar_ext_button")) continue;
      QVERIFY2(button->isVisible() && tools->rect().contains(button->geometry()),
               qPrintable(button->toolTip()));
      ++seen;
    }
    QCOMPARE(seen, 8);
  }
};

PITCHBOARD_GUI_TEST(TestWindowLayout)

}  // namespace tst_window_layout

#include "tst_window_layout.moc"

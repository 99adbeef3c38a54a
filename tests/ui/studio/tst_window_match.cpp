// SPDX-License-Identifier: GPL-3.0-or-later
// What the window says and sets about the match that is played, and what of its look it keeps.
#include <QDockWidget>
#include <QLabel>
#include <QMenuBar>
#include <QSettings>
#include <QTabBar>
#include <QTemporaryDir>
#include <QToolButton>
#include <QWindow>
#include <QtTest>
#include <algorithm>

#include <robotlink/blackboard/match_number.h>
#include <robotlink/report/report.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <ui/base/scoreboard_state.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/robots/robot_card.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "../support/menu_entry.h"
#include "../support/own_match_number.h"
#include "../support/robot_keys.h"
#include "field_scene.h"
#include "log_model.h"
#include "menu_actions.h"
#include "plot_page.h"
#include "scoreboard.h"
#include "variables_model.h"

namespace tst_window_match {

using namespace pitchboard;
using namespace pitchboard::ui;

/// How often the log's panel was brought to the front.
class RaiseCounter : public QObject {
  Q_OBJECT
 public:
  int raised = 0;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    const auto* dock = qobject_cast<QDockWidget*>(watched);
    if (event->type() == QEvent::ZOrderChange && dock != nullptr && dock->isFloating() &&
        dock->objectName() == QStringLiteral("log")) {
      ++raised;
    }
    return false;
  }
};

class TestWindowMatch : public QObject {
  Q_OBJECT

  struct Studio {
    MatchController controller;
    MainWindow window;
    explicit Studio(QSettings* settings, link::Cognition where = link::Cognition::Inline,
                    const char* robotProgram = "")
        : controller(options(where, robotProgram)), window(&controller, settings) {
      window.resize(1280, 800);
      window.show();
    }
    static link::MatchOptions options(link::Cognition where, const char* robotProgram) {
      link::MatchOptions made;
      made.robotProgram = robotProgram;
      made.cognition = where;
      return made;
    }
    QMenu* menu(const char* name) {
      for (QAction* top : window.menuBar()->actions()) emit top->menu()->aboutToShow();
      auto* found = window.findChild<QMenu*>(QLatin1String(name));
      if (found != nullptr) emit found->aboutToShow();
      return found;
    }
    QAction* entry(const char* name, const QString& text) {
      return menu_entry::beginning(menu(name)->actions(), text);
    }
    QString facts() {
      menu("matchNumber");
      return window.findChild<QAction*>(QStringLiteral("matchFacts"))->text();
    }
  };

  QTemporaryDir m_folder;
  std::unique_ptr<QSettings> m_settings;

 private slots:
  void init() {
    m_settings = std::make_unique<QSettings>(m_folder.filePath(QStringLiteral("s.ini")),
                                             QSettings::IniFormat);
    m_settings->clear();
    setTheme(*qApp, ThemeChoice::Dark);
  }

  void teamsHaveTheNamesOfTheScenario_data() {
    QTest::addColumn<QString>("referee");
    QTest::newRow("with a referee") << QStringLiteral("humanoid-soccer-2026");
    QTest::newRow("without one") << QString();
  }
  void teamsHaveTheNamesOfTheScenario() {
    QFETCH(QString, referee);
    Studio s(m_settings.get());
    link::Scenario scenario = link::loadScenario("match-3v3").value();
    scenario.settings.teams = {{TeamColor::Blue, 12, "RoboFEI"}, {TeamColor::Red, 5, "Guests"}};
    if (!referee.isEmpty()) {
      scenario.settings.referee = link::refereeRuleSet(referee.toStdString()).value();
    }
    s.controller.open(scenario, true);
    s.controller.runTo(120);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 120);
    const auto* board = s.window.findChild<Scoreboard*>(QStringLiteral("scoreboard"));
    QTRY_COMPARE(board->state().leftName, QStringLiteral("ROBOFEI"));
    QCOMPARE(board->state().rightName, QStringLiteral("GUESTS"));
    const auto* status = s.window.findChild<QLabel*>(QStringLiteral("statusWorld"));
    QTRY_VERIFY2(status->text().startsWith(QStringLiteral("ROBOFEI – GUESTS, 6 robots")),
                 qPrintable(status->text()));
    const auto cards = s.window.findChild<RobotsDock*>()->cards();
    QCOMPARE(cards.front()->state().teamName, QStringLiteral("RoboFEI"));
    QCOMPARE(cards.back()->state().teamName, QStringLiteral("Guests"));
    // So do its past and its report.
    const auto rows = s.controller.memory()->series();
    const FramePtr past = s.controller.frameAt(1.0);
    QVERIFY(past);
    QCOMPARE(scoreboardOf(*past).leftName, QStringLiteral("ROBOFEI"));
    link::ReportContent report;
    report.statistics = link::statisticsOf(*rows, *rows->range());
    const QString page = QString::fromStdString(link::reportHtml(report));
    QVERIFY(page.contains(QStringLiteral("<div class=\"team blue\">RoboFEI<b>")));
    QVERIFY(page.contains(QStringLiteral("<div class=\"team red\">Guests<b>")));
  }

  // None: blackboards are shared, so that the match takes a number, and no process is started.
  void whoDecidesAndTheNumberAreSeenAndSet() {
    const OwnMatchNumber own;
    const int free = own.value();
    Studio s(m_settings.get());
    s.controller.open(link::loadScenario("one-robot").value(), true);
    QTRY_VERIFY(s.controller.frame());
    QCOMPARE(s.facts(), QStringLiteral("Seed 1 · processes inside the studio"));
    QVERIFY(s.entry("whoDecides", QStringLiteral("Inside"))->isChecked());
    QVERIFY(s.entry("matchNumber", QStringLiteral("The next free"))->isChecked());
    s.controller.setMatchNumber(free);
    s.entry("whoDecides", QStringLiteral("Only your team"))->trigger();
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->matchNumber == free);
    QCOMPARE(s.controller.cognition(), link::Cognition::None);
    QCOMPARE(s.facts(), QStringLiteral("Match %1 · seed 1 · team programs only").arg(free));
    QVERIFY(s.entry("whoDecides", QStringLiteral("Only your team"))->isChecked());
    QVERIFY(s.entry("matchNumber", QStringLiteral("Another… (%1)").arg(free))->isChecked());
    QCOMPARE(s.controller.frame()->robots.front().boardKey.value_or(-1), free * 10'000 + 100);
    QVERIFY(s.controller.isPaused());
    s.entry("whoDecides", QStringLiteral("Inside"))->trigger();
    QTRY_VERIFY(s.controller.frame() && !s.controller.frame()->matchNumber);
    // Another source is shown: nothing begins behind it.
    s.window.showSource(SourceKind::Replay);
    QVERIFY(!s.menu("whoDecides")->menuAction()->isEnabled());
    QVERIFY(!s.menu("matchNumber")->menuAction()->isEnabled());
  }

  void allPanelsShowTheSameMoment() {
    Studio s(m_settings.get());
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.controller.runTo(300);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 300);
    auto* variables = s.window.findChild<VariablesModel*>();
    const auto tick = [variables] {
      variables->refreshAll();
      return variables->find(QStringLiteral("match/TICK"))
          .siblingAtColumn(VariablesModel::Value)
          .data()
          .toString();
    };
    const auto status = [&s] {
      return s.window.findChild<QLabel*>(QStringLiteral("statusWorld"))->text();
    };
    const auto* cards = s.window.findChild<RobotsDock*>();
    QTRY_COMPARE(cards->cards().size(), 6);
    const auto card = [cards] { return cards->cards()[4]->state().detail; };
    QTRY_COMPARE(tick(), QStringLiteral("300.00"));
    QTRY_VERIFY(status().contains(QStringLiteral("tick 300")));
    // The cards follow a little later than the rest.
    QTRY_VERIFY2(!card().endsWith(QStringLiteral(" 0.0 m")), qPrintable(card()));
    const QString cardNow = card();
    s.window.shown()->seek(2.0);
    QCOMPARE(s.window.findChild<FieldScene*>()->frame()->snapshot.tick, std::uint64_t(120));
    QCOMPARE(s.window.findChild<LinkedTime*>()->playhead(), std::optional(2.0));
    QTRY_COMPARE(tick(), QStringLiteral("120.00"));
    QTRY_VERIFY2(status().contains(QStringLiteral("tick 120")), qPrintable(status()));
    QTRY_VERIFY2(card() != cardNow, qPrintable(cardNow));  // it has walked less far
    QTest::mouseClick(s.window.findChild<QToolButton*>(QStringLiteral("now")), Qt::LeftButton);
    QTRY_COMPARE(tick(), QStringLiteral("300.00"));
    QCOMPARE(s.window.findChild<FieldScene*>()->frame()->snapshot.tick, std::uint64_t(300));
    QVERIFY(!s.window.shown()->chosenTime());
    QTRY_COMPARE(card(), cardNow);
    QTRY_VERIFY(status().contains(QStringLiteral("tick 300")));
  }

  // Edits while the match stands still are no rows of another second.
  void editsInAPauseAreNoRate() {
    Studio s(m_settings.get());
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.controller.runTo(300);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 300);
    auto* variables = s.window.findChild<VariablesModel*>();
    const auto rate = [variables] {
      variables->refreshAll();
      return variables->find(QStringLiteral("B1"))
          .siblingAtColumn(VariablesModel::Value)
          .data()
          .toString();
    };
    QTRY_COMPARE(rate(), QStringLiteral("60"));
    for (int i = 1; i <= 60; ++i) {
      s.controller.edits()->moveBall({0.01 * i, 1.0});
      s.controller.settle();
    }
    QTRY_VERIFY(std::abs(s.controller.frame()->snapshot.ball.x - 0.6) < 1e-9);
    QVERIFY2(rate() == QStringLiteral("60"), qPrintable(rate()));
  }

  void aRestartIsADividerInTheLog() {
    Studio s(m_settings.get());
    s.controller.open(link::loadScenario("match").value(), true);
    s.controller.runTo(660);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 660);
    const auto* log = s.window.findChild<LogModel*>(QStringLiteral("logModel"));
    const auto dividers = [log] {
      QStringList found;
      for (int row = 0; row < log->rowCount(); ++row) {
        if (!log->index(row, LogModel::Time).data().toString().isEmpty()) continue;
        found << log->index(row, LogModel::Text).data().toString();
      }
      return found;
    };
    QTRY_VERIFY(log->rowCount() > 0);
    QVERIFY(dividers().isEmpty());
    s.window.findChild<QAction*>(QStringLiteral("restart"))->trigger();
    QTRY_COMPARE(dividers().size(), 1);
    QVERIFY2(dividers().front().startsWith(QStringLiteral("Match")),
             qPrintable(dividers().front()));
  }

  void hiddenLayersAndDrawingsAreRemembered() {
    const auto layer = [](Studio& s, FieldLayer which) {
      return s.window.field()->actions().layers[static_cast<std::size_t>(which)];
    };
    const auto scene = [](Studio& s) { return s.window.findChild<FieldScene*>(); };
    {
      Studio s(m_settings.get());
      layer(s, FieldLayer::Trails)->setChecked(false);
      layer(s, FieldLayer::Grid)->setChecked(true);
      s.window.field()->actions().options[2]->setChecked(true);
      scene(s)->changeStyle([](FieldStyle& style) {
        style.drawings.hiddenLayers = {"a / b"};
        style.drawings.hiddenRobots = {red(1)};
        style.drawings.hidden = {{blue(3), "path"}};
      });
      s.window.close();
    }
    m_settings->sync();
    const QSettings file(m_settings->fileName(), QSettings::IniFormat);
    QVERIFY(!file.contains(QStringLiteral("field/layer/belief")));  // as at first
    {
      Studio s(m_settings.get());
      QVERIFY(!layer(s, FieldLayer::Trails)->isChecked());
      QVERIFY(layer(s, FieldLayer::Grid)->isChecked());
      QVERIFY(layer(s, FieldLayer::Belief)->isChecked());
      const FieldStyle& style = scene(s)->style();
      QVERIFY(!style.shows(FieldLayer::Trails) && style.shows(FieldLayer::Grid));
      QCOMPARE(style.eopraGranularity, 6);
      QVERIFY(!style.drawings.shows(blue(1), "a / b") && !style.drawings.shows(red(1), "x"));
      QVERIFY(!style.drawings.shows(blue(3), "path") && style.drawings.shows(blue(2), "path"));
    }
    // Whatever a file says.
    m_settings->setValue(QStringLiteral("field/hiddenDrawings"),
                         QStringList{QStringLiteral("nonsense"), QStringLiteral("/"),
                                     QStringLiteral("x/y"), QStringLiteral("*/")});
    m_settings->setValue(QStringLiteral("field/eopraGranularity"), QStringLiteral("many"));
    Studio s(m_settings.get());
    QCOMPARE(scene(s)->style().eopraGranularity, 4);
    QVERIFY(scene(s)->style().drawings.shows(blue(1), "y"));
  }

  void floatingPanelsComeBack() {
    {
      Studio s(m_settings.get());
      auto* log = s.window.findChild<QDockWidget*>(QStringLiteral("log"));
      log->setFloating(true);
      QTRY_VERIFY(log->isFloating() && log->isVisible());
      s.window.close();
    }
    RaiseCounter order;
    qApp->installEventFilter(&order);
    Studio s(m_settings.get());
    auto* log = s.window.findChild<QDockWidget*>(QStringLiteral("log"));
    QTRY_VERIFY(log->isFloating() && log->isVisible());
    QVERIFY(!s.window.findChild<QDockWidget*>(QStringLiteral("plots"))->isFloating());
    // A tool of the window is what a desktop keeps above it.
    QVERIFY(log->windowFlags().testFlag(Qt::Tool));
    QTRY_COMPARE(log->windowHandle()->transientParent(), s.window.windowHandle());
    QTRY_VERIFY(order.raised > 0);
  }

  void theStatusSaysWhatIsShownAndWhatGoesOn() {
    Studio s(m_settings.get());
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.controller.runTo(600);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 600);
    const auto* pace = s.window.findChild<QLabel*>(QStringLiteral("statusPace"));
    QTRY_COMPARE(pace->text(), QStringLiteral("Simulation paused"));
    auto* timeline = s.window.shown();
    timeline->seek(4.0);
    QTRY_COMPARE(pace->text(), QStringLiteral("Viewing 00:04, the match is paused"));
    s.controller.setPaused(false);
    QTRY_COMPARE(pace->text(), QStringLiteral("Viewing 00:04, the match goes on at ×1.00"));
    timeline->goLive();
    QTRY_VERIFY2(pace->text().startsWith(QStringLiteral("Simulation ")) &&
                     pace->text().endsWith(QStringLiteral("/s, ×1.00")),
                 qPrintable(pace->text()));
  }

  void recentScenariosAndSessionsAreOffered() {
    const QString there = m_folder.filePath(QStringLiteral("semifinal.mcap"));
    QFile file(there);
    QVERIFY(file.open(QIODevice::WriteOnly));
    m_settings->setValue(QStringLiteral("sessions/recent"),
                         QStringList{there, m_folder.filePath(QStringLiteral("gone.mcap"))});
    Studio s(m_settings.get());
    const QString scenario = m_folder.filePath(QStringLiteral("corner.json"));
    s.controller.open(link::loadScenario("one-robot").value(), true);
    QTRY_VERIFY(s.controller.frame());
    s.window.files()->save(scenario);
    s.window.files()->open(scenario);
    QTRY_VERIFY(!s.controller.isOpening() && s.controller.frame());
    QStringList offered;
    for (const MenuAction& each : menuActions(*s.window.menuBar())) {
      if (each.menu == QStringLiteral("File: Open recent")) offered << each.text;
    }
    QCOMPARE(offered, (QStringList{QStringLiteral("corner"), QStringLiteral("semifinal.mcap")}));
  }

  void theToolBarDoesNotJump() {
    Studio s(m_settings.get());
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.controller.runTo(120);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 120);
    auto* speed = s.window.findChild<QWidget*>(QStringLiteral("speed"));
    auto* score = s.window.findChild<Scoreboard*>();
    const auto places = [&] {
      return std::pair(speed->mapTo(&s.window, QPoint()),
                       score->mapTo(&s.window, QPoint(score->width(), 0)));
    };
    QTRY_VERIFY(score->width() > 100);
    const auto before = places();
    s.controller.setSpeed(0.01);
    s.controller.setPaused(false);
    QTRY_VERIFY(!s.controller.frame()->paused);
    QCoreApplication::processEvents();
    QCOMPARE(places(), before);
    s.window.shown()->seek(1.0);
    QCoreApplication::processEvents();
    QCOMPARE(places(), before);
  }

  void tabsOfThePlotsStandInTheRowOfTheDocks() {
    Studio s(m_settings.get());
    auto* plots = s.window.findChild<PlotsDock*>();
    auto* dock = s.window.findChild<QDockWidget*>(QStringLiteral("plots"));
    QWidget* tabs = plots->pageTabs();
    QTRY_VERIFY(qobject_cast<QTabBar*>(tabs->parentWidget()));
    const int height = plots->currentPage()->height();
    QVERIFY(height > 50);
    plots->addPage({QStringLiteral("approach"), {}});
    auto* bar = tabs->findChild<QTabBar*>();
    QTRY_VERIFY(bar->isVisible());
    auto* row = qobject_cast<QTabBar*>(tabs->parentWidget());
    QCOMPARE(plots->currentPage()->height(), height);
    QVERIFY(tabs->x() > row->tabRect(row->count() - 1).right());
    QVERIFY(row->rect().contains(tabs->geometry()));
    QTest::mouseClick(bar, Qt::LeftButton, {}, bar->tabRect(1).center());
    QCOMPARE(plots->currentPage()->name(), QStringLiteral("approach"));
    QTRY_VERIFY(plots->currentPage()->isVisible());
    // They go when something else is in front, and come back with the plots.
    s.window.findChild<QDockWidget*>(QStringLiteral("log"))->raise();
    QTRY_VERIFY(!bar->isVisible());
    dock->raise();
    QTRY_VERIFY(bar->isVisible());
    // Alone, the dock has a title: they stand in it.
    for (const char* other : {"log", "processes"}) {
      s.window.findChild<QDockWidget*>(QLatin1String(other))->close();
    }
    QTRY_VERIFY(dock->titleBarWidget()->isAncestorOf(bar) && bar->isVisible());
    dock->setFloating(true);
    QTRY_VERIFY(dock->titleBarWidget()->isAncestorOf(bar) && bar->isVisible());
    // Whatever happened to them: the order is that of the tabs, and is kept.
    bar->moveTab(1, 0);
    QCOMPARE(plots->layoutSpec().pages[0].name, QStringLiteral("approach"));
    plots->closePage(1);
    QCOMPARE(plots->pages().size(), 1);
    QVERIFY(!bar->isVisible());
  }
};

PITCHBOARD_GUI_TEST(TestWindowMatch)

}  // namespace tst_window_match

#include "tst_window_match.moc"

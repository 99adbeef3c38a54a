// SPDX-License-Identifier: GPL-3.0-or-later
// The menus of the window, opened and clicked as a person does; what they show is what was played.
#include <QComboBox>
#include <QDockWidget>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMenuBar>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTimer>
#include <QtTest>
#include <algorithm>
#include <functional>

#include <robotlink/blackboard/match_number.h>
#include <ui/base/notice_bar.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>

#include "../support/own_match_number.h"
#include "studio_rig.h"

namespace tst_window_menus {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestWindowMenus : public QObject {
  Q_OBJECT

  struct Studio : studio_rig::Studio {
    Studio() : studio_rig::Studio(options()) {
      controller.open(link::loadScenario("one-robot").value(), true);
    }
    static link::MatchOptions options() {
      link::MatchOptions made;
      made.cognition = link::Cognition::Inline;
      made.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
      return made;
    }
    /// Clicks from the menu bar down to the last word; false when there is no such way.
    bool click(const QStringList& way) {
      QWidget* in = window.menuBar();
      for (qsizetype i = 0; i < way.size(); ++i) {
        QAction* found = nullptr;
        for (QAction* action : in->actions()) {
          if (action->text().remove(QLatin1Char('&')).startsWith(way[i])) found = action;
        }
        if (found == nullptr || !found->isEnabled()) return false;
        const QRect place = i == 0 ? window.menuBar()->actionGeometry(found)
                                   : static_cast<QMenu*>(in)->actionGeometry(found);
        QTest::mouseMove(in, place.center());
        QTest::mouseClick(in, Qt::LeftButton, {}, place.center());
        in = found->menu();
        if (in == nullptr) return i + 1 == way.size();
        if (!QTest::qWaitForWindowExposed(in)) return false;
      }
      return false;
    }
    /// The ticked entries of a menu below Simulation, as they are when it is opened.
    QStringList ticked(const char* name) {
      auto* menu = window.findChild<QMenu*>(QLatin1String(name));
      emit menu->aboutToShow();
      QStringList texts;
      for (const QAction* action : menu->actions()) {
        if (action->isChecked()) texts << action->text().remove(QLatin1Char('&'));
      }
      return texts;
    }
  };

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  // In the whole menu bar, whatever is shown.
  void greyCommandsSayWhy_data() {
    QTest::addColumn<SourceKind>("kind");
    QTest::addColumn<bool>("past");
    QTest::newRow("Simulate") << SourceKind::Simulate << false;
    QTest::newRow("its past") << SourceKind::Simulate << true;
    QTest::newRow("Live") << SourceKind::Live << false;
    QTest::newRow("Replay") << SourceKind::Replay << false;
  }
  void greyCommandsSayWhy() {
    QFETCH(const SourceKind, kind);
    QFETCH(const bool, past);
    Studio s;
    s.controller.runTo(60);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 60);
    s.window.showSource(kind);
    if (past) s.window.shown()->seek(0.5);
    QStringList silent;
    int grey = 0;
    const std::function<void(const QList<QAction*>&, const QString&)> look =
        [&](const QList<QAction*>& actions, const QString& way) {
          for (QAction* action : actions) {
            const QString name = way + action->text().remove(QLatin1Char('&'));
            // Statements, not commands.
            if (action->isSeparator() || !action->isVisible() ||
                action->objectName() == "matchFacts" ||
                action->text().startsWith(QStringLiteral("No program is sending")))
              continue;
            if (!action->isEnabled()) {
              ++grey;
              if (action->toolTip() == action->iconText()) silent << name;
            } else if (QMenu* menu = action->menu()) {
              emit menu->aboutToShow();
              menu->ensurePolished();  // as when it is shown
              QVERIFY2(menu->toolTipsVisible(), qPrintable(name));
              look(menu->actions(), name + QStringLiteral(" > "));
              emit menu->aboutToHide();
            }
          }
        };
    look(s.window.menuBar()->actions(), {});
    QVERIFY(grey > 0);
    QVERIFY2(silent.isEmpty(), qPrintable(silent.join(QStringLiteral(", "))));
  }

  void whoDecidesIsChosenByTheMouse() {
    const OwnMatchNumber own;
    const int free = own.value();
    Studio s;
    s.controller.setMatchNumber(free);
    QTRY_VERIFY(s.controller.frame());
    QVERIFY(s.click({QStringLiteral("Simulation"), QStringLiteral("Run robot processes"),
                     QStringLiteral("In separate processes")}));
    QTRY_COMPARE(s.controller.cognition(), link::Cognition::Separate);
    // Programs of the operating system, on the blackboards of this number.
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->matchNumber == free);
    QTRY_VERIFY(!s.controller.frame()->robots.empty() &&
                !s.controller.frame()->robots.front().processes().empty());
    QCOMPARE(s.controller.frame()->robots.front().boardKey.value_or(-1), free * 10'000 + 100);
    QTRY_VERIFY(std::ranges::all_of(s.controller.frame()->robots.front().processes(),
                                    [](const auto& process) { return process.pid > 0; }));
    QCOMPARE(s.ticked("whoDecides"), QStringList{QStringLiteral("In separate processes")});
    QVERIFY(s.click({QStringLiteral("Simulation"), QStringLiteral("Run robot processes"),
                     QStringLiteral("Inside the studio")}));
    QTRY_VERIFY(s.controller.cognition() == link::Cognition::Inline && s.controller.frame() &&
                !s.controller.frame()->matchNumber);
    QCOMPARE(s.ticked("whoDecides"), QStringList{QStringLiteral("Inside the studio")});
  }

  void theMatchNumberIsChosenByTheMouse() {
    // One of those that are listed; nobody else on this computer may have it.
    int free = 9;
    while (free > 0 && !link::MatchClaim::take(free)) --free;
    if (free == 0) QSKIP("every number that the menu lists is taken");
    Studio s;
    QTRY_VERIFY(s.controller.frame());
    QVERIFY(s.click({QStringLiteral("Simulation"), QStringLiteral("Run robot processes"),
                     QStringLiteral("Only your team")}));
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->matchNumber);
    QVERIFY(s.click(
        {QStringLiteral("Simulation"), QStringLiteral("Match number"), QString::number(free)}));
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->matchNumber == free);
    QCOMPARE(s.ticked("matchNumber"), QStringList{QString::number(free)});

    const OwnMatchNumber own;
    const int typed = own.value();
    bool asked = false;
    QTimer answer;
    connect(&answer, &QTimer::timeout, &s.window, [&] {
      auto* dialog = s.window.findChild<QInputDialog*>();
      if (dialog == nullptr || !dialog->isVisible()) return;
      answer.stop();
      asked = true;
      auto* box = dialog->findChild<QSpinBox*>();
      box->selectAll();
      QTest::keyClicks(box, QString::number(typed));
      QTest::keyClick(box, Qt::Key_Return);
    });
    answer.start(20);
    QVERIFY(s.click(
        {QStringLiteral("Simulation"), QStringLiteral("Match number"), QStringLiteral("Another")}));
    QVERIFY(asked);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->matchNumber == typed);
    QCOMPARE(s.ticked("matchNumber"), QStringList{QStringLiteral("Another… (%1)").arg(typed)});
    QVERIFY(s.click({QStringLiteral("Simulation"), QStringLiteral("Match number"),
                     QStringLiteral("The next free one")}));
    QTRY_VERIFY(!s.controller.options().match);
    QCOMPARE(s.ticked("matchNumber"), QStringList{QStringLiteral("The next free one")});
  }

  // Programs cannot be told what they knew; who goes on from the past is told that.
  void continuingReportsLostMemories() {
    Studio s;
    QTRY_VERIFY(s.controller.frame());
    QVERIFY(s.click({QStringLiteral("Simulation"), QStringLiteral("Run robot processes"),
                     QStringLiteral("In separate processes")}));
    QTRY_VERIFY(s.controller.cognition() == link::Cognition::Separate && s.controller.frame() &&
                s.controller.frame()->matchNumber);
    s.controller.runTo(30);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 30);
    s.window.shown()->seek(0.2);
    s.window.findChild<QAction*>(QStringLiteral("continueFromHere"))->trigger();
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(12));
    QTRY_VERIFY2(s.window.notices()->text().contains("with their beliefs of"),
                 qPrintable(s.window.notices()->text()));
    // It is of no use once the match has gone on for a while.
    const auto isGiven = [&s] {
      return s.window.notices()->text().contains("with their beliefs of");
    };
    s.controller.runTo(12 + 9 * 60);
    QTRY_COMPARE_WITH_TIMEOUT(s.controller.frame()->snapshot.tick, std::uint64_t(12 + 9 * 60),
                              60'000);
    QVERIFY(isGiven());
    s.controller.runTo(12 + 11 * 60);
    QTRY_VERIFY_WITH_TIMEOUT(!isGiven(), 60'000);
  }

  void viewIsGrouped() {
    Studio s;
    for (QAction* top : s.window.menuBar()->actions()) {
      if (top->text() != QStringLiteral("&View")) continue;
      QStringList groups;
      int entries = 0;
      for (QAction* each : top->menu()->actions()) {
        if (each->isSeparator()) continue;
        ++entries;
        if (each->menu() != nullptr) groups << each->text().remove(QLatin1Char('&'));
      }
      QVERIFY2(entries <= 13, qPrintable(QString::number(entries)));
      for (const char* group : {"Panels", "Field layers", "Field tools", "Theme", "Alarms"}) {
        QVERIFY2(groups.contains(QString::fromUtf8(group)), group);
      }
      return;
    }
    QFAIL("no View menu");
  }

  void anOpenedPanelTakesTheFocusAndAClosedOneGivesItBack() {
    Studio s;
    QTRY_VERIFY(s.controller.frame());
    s.window.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&s.window));
    s.window.field()->setFocus();
    auto* dock = s.window.findChild<QDockWidget*>(QStringLiteral("log"));
    dock->toggleViewAction()->trigger();
    QTRY_VERIFY(QApplication::focusWidget() != nullptr &&
                dock->isAncestorOf(QApplication::focusWidget()));
    dock->toggleViewAction()->trigger();
    QTRY_VERIFY(dock->isHidden());
    QTRY_COMPARE(QApplication::focusWidget(), s.window.field()->focusProxy());
  }

  void theRefereeDockNamesItsMatch() {
    Studio s;
    QTRY_VERIFY(s.controller.frame());
    auto* dock = s.window.findChild<QDockWidget*>(QStringLiteral("referee"));
    dock->show();
    const auto* state = dock->findChild<QLabel*>(QStringLiteral("refereeSetPlay"));
    const auto* rules = dock->findChild<QComboBox*>(QStringLiteral("refereeRules"));
    QTRY_COMPARE(state->text(),
                 QStringLiteral("This match has no referee. Choose rules below to get one."));
    QVERIFY(rules->isVisible() && rules->isEnabled());
    s.window.showSource(SourceKind::Live);
    QTRY_VERIFY(!rules->isVisible());
    QVERIFY2(state->text().startsWith("Waiting for the referee"), qPrintable(state->text()));
    // It has controls in Simulate only.
    for (const SourceKind kind : {SourceKind::Live, SourceKind::Replay}) {
      s.window.showSource(kind);
      QVERIFY(dock->isVisible());
      QTRY_VERIFY(!rules->isVisible());
      for (const auto* button : dock->widget()->findChildren<QPushButton*>()) {
        QVERIFY2(!button->isVisible() || !button->isEnabled(), qPrintable(button->text()));
      }
    }
    s.window.showSource(SourceKind::Simulate);
    QTRY_COMPARE(state->text(),
                 QStringLiteral("This match has no referee. Choose rules below to get one."));
  }

  void thePaletteLeadsToThePanel() {
    Studio s;
    QTRY_VERIFY(s.controller.frame());
    s.window.showPalette();
    auto* words = s.window.findChild<QLineEdit*>(QStringLiteral("paletteSearch"));
    auto* list = s.window.findChild<QListView*>(QStringLiteral("paletteList"));
    const auto* empty = s.window.findChild<QLabel*>(QStringLiteral("paletteEmpty"));
    // An action that asks for more is as exact as one that does not.
    QTest::keyClicks(words, QStringLiteral("export"));
    QVERIFY(list->currentIndex().data().toString().endsWith(QStringLiteral(": Export…")));
    QVERIFY(list->isVisible() && !empty->isVisible());
    QTest::keyClicks(words, QStringLiteral(" xyz"));
    QVERIFY(!list->isVisible() && empty->isVisible());
    QCOMPARE(empty->text(), QStringLiteral("Nothing matches “export xyz”."));
    words->clear();
    QTest::keyClicks(words, QStringLiteral("view: panels: referee"));
    QCOMPARE(list->currentIndex().data().toString(), QStringLiteral("View: Panels: Referee"));
    QTest::keyClick(words, Qt::Key_Return);
    const auto* dock = s.window.findChild<QDockWidget*>(QStringLiteral("referee"));
    QTRY_VERIFY(dock->isVisible());
  }
};

PITCHBOARD_GUI_TEST(TestWindowMenus)

}  // namespace tst_window_menus

#include "tst_window_menus.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing happens by accident: the wheel changes no control without focus, nothing acts on the
// match while the past is shown, and a card that is dragged out of a floating panel floats.
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QGraphicsView>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <QTabBar>
#include <QTableView>
#include <QTimer>
#include <QUndoStack>
#include <QtTest>

#include <robotlink/models/robot_models.h>
#include <ui/base/theme.h>
#include <ui/field/field_keys.h>
#include <ui/field/field_view.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/shown_moment.h>

#include "../support/menu_entry.h"
#include "../support/mouse_wheel.h"
#include "../support/robot_keys.h"
#include "window_rig.h"

namespace tst_safe_hands {

using namespace pitchboard;
using namespace pitchboard::ui;
using window_rig::Studio;

namespace {

/// What a turn of the wheel could change; invalid for any other widget.
QVariant valueOf(QWidget* widget) {
  if (auto* combo = qobject_cast<QComboBox*>(widget)) return combo->currentIndex();
  if (auto* spin = qobject_cast<QAbstractSpinBox*>(widget)) return spin->text();
  if (auto* tabs = qobject_cast<QTabBar*>(widget)) return tabs->currentIndex();
  if (qobject_cast<QScrollBar*>(widget) != nullptr) return {};
  if (auto* slider = qobject_cast<QAbstractSlider*>(widget)) return slider->value();
  return {};
}

QString nameOf(const QWidget* widget) {
  return QStringLiteral("%1 \"%2\" in %3")
      .arg(QLatin1String(widget->metaObject()->className()), widget->objectName(),
           widget->window()->windowTitle());
}

/// Turns the wheel both ways over every control of it that is seen; how many there are.
int turnOverAll(QWidget* owner) {
  int found = 0;
  for (QWidget* control : owner->findChildren<QWidget*>()) {
    const QVariant before = valueOf(control);
    if (!before.isValid() || !control->isVisible()) continue;
    ++found;
    if (QWidget* focus = QApplication::focusWidget()) focus->clearFocus();
    for (const int delta : {-120, 120, 120, -120}) {
      turnWheel(control, control->rect().center(), delta);
      if (valueOf(control) != before) qWarning() << "changed:" << nameOf(control);
      if (valueOf(control) != before) return -1;
      if (control->hasFocus()) qWarning() << "took the focus:" << nameOf(control);
      if (control->hasFocus()) return -1;
    }
  }
  return found;
}

/// Answers the menu that comes up next.
template <class Answer>
void whenMenuOpens(Answer answer) {
  QTimer::singleShot(0, qApp, [answer] {
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    answer(menu);
    menu->close();
  });
}

}  // namespace

class TestSafeHands : public QObject {
  Q_OBJECT

  /// A match of two seconds in INITIAL and three in READY, paused, with the panel Referee.
  static void playRefereed(Studio& s) {
    s.controller.open(link::loadScenario("match").value(), true);
    s.find<QDockWidget>("referee")->show();
    s.find<QDockWidget>("referee")->raise();
    s.controller.runTo(120);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 120);
    QTRY_VERIFY(s.find<QPushButton>("referee READY"));
    QTest::mouseClick(s.find<QPushButton>("referee READY"), Qt::LeftButton);
    QTRY_COMPARE(s.controller.frame()->game->state, PlayState::Ready);
    s.controller.runTo(300);
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(300));
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void theWheelChangesNothingWithoutFocus() {
    Studio s;
    s.play();
    const std::uint64_t hash = s.controller.stateHash();
    for (const char* dialog : {"Settings and teams", "Attach blackboard", "Export…", "Keyboard"}) {
      QVERIFY2(s.menuAction(QString::fromUtf8(dialog)), dialog);
      s.menuAction(QString::fromUtf8(dialog))->trigger();
    }
    s.window.field()->editPose(inSlot(1));
    int inDialogs = 0, inDocks = 0;
    for (QWidget* top : QApplication::topLevelWidgets()) {
      if (top == &s.window || !top->isVisible()) continue;
      const int found = turnOverAll(top);
      QVERIFY(found >= 0);
      inDialogs += found;
    }
    QVERIFY2(inDialogs > 8, qPrintable(QString::number(inDialogs)));
    qDeleteAll(s.window.findChildren<QDialog*>());
    for (auto* dock : s.window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
      for (const bool floats : {false, true}) {
        dock->setFloating(floats);
        dock->show();
        dock->raise();
        QTRY_VERIFY2(dock->isVisible(), qPrintable(dock->windowTitle()));
        const int found = turnOverAll(dock);
        QVERIFY2(found >= 0, qPrintable(dock->windowTitle()));
        inDocks += found;
      }
      dock->setFloating(false);
    }
    QVERIFY2(inDocks > 60, qPrintable(QString::number(inDocks)));
    QVERIFY(turnOverAll(&s.window) > 10);  // the tool bar, tabs between docks
    QCOMPARE(s.controller.stateHash(), hash);
    QCOMPARE(s.controller.edits()->undoStack()->count(), 0);
  }

  void theWheelChangesWhatHasTheFocusAndScrollsTheRest() {
    Studio s;
    s.play();
    auto* dock = s.find<QDockWidget>("noise");
    dock->show();
    dock->raise();
    s.window.activateWindow();
    QTRY_VERIFY(s.window.isActiveWindow());
    auto* area = qobject_cast<QScrollArea*>(dock->widget());
    QVERIFY(area);
    QTRY_VERIFY(area->verticalScrollBar()->maximum() > 0);
    auto* slider = area->findChild<QSlider*>();
    s.window.field()->setFocus();
    const QWidget* field = QApplication::focusWidget();
    turnWheel(slider, slider->rect().center(), -120);
    QVERIFY(area->verticalScrollBar()->value() > 0);  // what lies behind
    QCOMPARE(QApplication::focusWidget(), field);
    for (QWidget* control : {static_cast<QWidget*>(area->findChild<QAbstractSpinBox*>()),
                             static_cast<QWidget*>(slider),
                             static_cast<QWidget*>(s.find<QComboBox>("refereeRules"))}) {
      if (qobject_cast<QComboBox*>(control) != nullptr) {
        s.find<QDockWidget>("referee")->show();
        s.find<QDockWidget>("referee")->raise();
        QTRY_VERIFY(control->isVisible());
      }
      QVERIFY(control->focusPolicy() != Qt::WheelFocus);
      control->setEnabled(true);
      control->parentWidget()->setEnabled(true);
      control->setFocus();
      QTRY_VERIFY2(control->hasFocus(), qPrintable(nameOf(control)));
      const QVariant before = valueOf(control);
      turnWheel(control, control->rect().center(), 120);
      if (valueOf(control) == before) turnWheel(control, control->rect().center(), -120);
      QVERIFY2(valueOf(control) != before, qPrintable(nameOf(control)));
    }
  }

  // A key that is held for a while is one goal.
  void aHeldKeyCallsOnce() {
    Studio s;
    s.controller.open(link::loadScenario("kick-off").value(), true);
    s.controller.runTo(120);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 120);
    s.menuAction(QStringLiteral("Referee"))->trigger();
    s.window.activateWindow();
    s.window.field()->setFocus();
    constexpr Qt::KeyboardModifiers keys = Qt::ControlModifier | Qt::AltModifier;
    QTest::simulateEvent(&s.window, true, Qt::Key_1, keys, {}, false);
    for (int i = 0; i < 20; ++i) QTest::simulateEvent(&s.window, true, Qt::Key_1, keys, {}, true);
    QTest::simulateEvent(&s.window, false, Qt::Key_1, keys, {}, false);
    QTRY_COMPARE(s.controller.frame()->snapshot.score.left, 1);
    s.controller.settle();
    QTRY_COMPARE(s.controller.edits()->undoStack()->count(), 1);
    QCOMPARE(s.controller.frame()->snapshot.score.left, 1);
  }

  // Undo brings the match back with its game, its rows and its events, and it can be left again.
  void whatEndsAMatchIsUndone_data() {
    QTest::addColumn<QString>("how");
    for (const char* how : {"restart", "play again", "open", "simulate from here"}) {
      QTest::newRow(how) << QString(how);
    }
  }
  void whatEndsAMatchIsUndone() {
    QFETCH(QString, how);
    Studio s;
    playRefereed(s);
    const bool over = how == "play again";
    if (over) {
      s.controller.post([](link::SimulatedMatch& match) {
        match.simulation().editState().game->over = true;
        return link::Changed::Yes;
      });
      QTRY_VERIFY(s.controller.frame()->finished);
    }
    s.controller.settle();
    const std::uint64_t hash = s.controller.stateHash();
    const auto events = s.timeline()->events()->events();
    QVERIFY(!events.empty());
    const auto rows = s.controller.series();
    const auto range = rows->range();
    QUndoStack* stack = s.controller.edits()->undoStack();
    QTRY_COMPARE(stack->count(), 1);  // READY
    if (how == "restart")
      s.find<QAction>("restart")->trigger();
    else if (over)
      s.find<QAction>("play")->trigger();
    else if (how == "open")
      s.window.files()->open(QStringLiteral("match-3v3"));
    else
      s.menuAction(QStringLiteral("Simulate from here"))->trigger();
    QTRY_COMPARE(stack->count(), 2);
    QTRY_VERIFY(s.controller.isOpen() && s.controller.frame());
    QVERIFY(s.controller.series() != rows);
    // Before it a person reads what could not be taken over from the moment.
    if (how != "simulate from here") {
      QVERIFY2(s.window.notices()->text().contains("Ctrl+Z brings the match back"),
               qPrintable(s.window.notices()->text()));
      QCOMPARE(s.window.notices()->tone(), NoticeTone::Success);
    }

    s.window.field()->setFocus();
    s.menuAction(QStringLiteral("Undo"))->trigger();
    QTRY_VERIFY(s.controller.isOpen() && s.controller.frame());
    QTRY_COMPARE(s.controller.stateHash(), hash);
    QCOMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(300));
    QCOMPARE(s.controller.frame()->game->state, PlayState::Ready);
    QCOMPARE(s.controller.series(), rows);
    QCOMPARE(rows->range()->begin, range->begin);
    QCOMPARE(rows->range()->end, range->end);
    // A match that was over says so once more.
    for (const link::MatchEvent& event : events) {
      QVERIFY(std::ranges::count(s.timeline()->events()->events(), event) >= 1);
    }
    QVERIFY(!s.window.notices()->text().contains("Ctrl+Z brings the match back"));
    // The past can be looked at, and the game goes on from where it was.
    s.timeline()->seek(1.0);
    QCOMPARE(s.window.findChild<ShownMoment*>()->frame()->game->state, PlayState::Initial);
    s.timeline()->goLive();
    s.controller.stepOnce();
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, over ? std::uint64_t(300) : 301);
    // What was done before can be undone, too, and everything is done again.
    stack->undo();
    QTRY_COMPARE(s.controller.frame()->game->state, PlayState::Initial);
    stack->redo();
    stack->redo();
    QTRY_VERIFY(s.controller.isOpen() && s.controller.frame());
    QTRY_VERIFY(s.controller.frame()->snapshot.tick < 300 || how == "simulate from here");
    QVERIFY(s.controller.series() != rows);
  }

  // Noise, constants, the clock and the score are undone, and the panel shows what the moment that
  // is shown was played with.
  void noiseIsUndoneAndThePastHasItsOwn() {
    Studio s;
    s.play();
    s.find<QDockWidget>("noise")->show();
    auto* preset = s.find<QComboBox>("noisePreset");
    const QString before = preset->currentText();
    const sim::NoiseParameters noise = s.controller.frame()->settings->noise;
    QUndoStack* stack = s.controller.edits()->undoStack();
    s.controller.edits()->setNoise(link::noisePreset("none").value());
    QTRY_COMPARE(preset->currentText(), QStringLiteral("none"));
    QTRY_COMPARE(stack->count(), 1);
    QTRY_COMPARE(stack->undoText(), QStringLiteral("Change the noise"));
    // It leaves a trace, also while the match stands still: on the timeline, in the log, in files.
    const auto marked = [&s](const char* what) {
      return std::ranges::count_if(s.timeline()->events()->events(), [what](const auto& event) {
        return event.kind == link::MatchEventKind::SettingChanged && event.detail == what &&
               link::isMarked(event);
      });
    };
    QTRY_COMPARE(marked("noise"), 1);
    const auto* log = s.find<QDockWidget>("log")->findChild<QTableView*>()->model();
    const auto reported = log->match(log->index(0, 2), Qt::DisplayRole,
                                     QStringLiteral("noise changed"), -1, Qt::MatchExactly);
    QCOMPARE(reported.size(), 1);
    const QPersistentModelIndex line = reported.first();
    const auto isStruck = [&line] { return line.data(Qt::FontRole).value<QFont>().strikeOut(); };
    QVERIFY(!isStruck());
    s.controller.runTo(360);
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(360));
    s.timeline()->seek(1.0);
    QCOMPARE(preset->currentText(), before);
    s.timeline()->goLive();
    QCOMPARE(preset->currentText(), QStringLiteral("none"));
    stack->undo();
    QTRY_VERIFY(s.controller.frame()->settings->noise == noise);
    QTRY_COMPARE(preset->currentText(), before);
    QTRY_COMPARE(marked("noise"), 0);
    QVERIFY(isStruck());
    stack->redo();
    QTRY_COMPARE(marked("noise"), 1);
    stack->undo();
    QTRY_COMPARE(marked("noise"), 0);

    sim::RigidBodySettings heavy = s.controller.frame()->settings->rigidBody;
    const double usual = heavy.ballMass;
    heavy.ballMass = 0.4;
    s.controller.edits()->setRigidBody(heavy);
    QTRY_COMPARE(s.controller.frame()->settings->rigidBody.ballMass, 0.4);
    QTRY_COMPARE(stack->index(), 1);
    QTRY_COMPARE(marked("physics"), 1);
    // A control that is moved is one step and one event.
    for (const double mass : {0.41, 0.42, 0.43}) {
      heavy.ballMass = mass;
      s.controller.edits()->setRigidBody(heavy);
    }
    QTRY_COMPARE(s.controller.frame()->settings->rigidBody.ballMass, 0.43);
    QTRY_COMPARE(stack->index(), 1);
    QCOMPARE(marked("physics"), 1);
    stack->undo();
    QTRY_COMPARE(s.controller.frame()->settings->rigidBody.ballMass, usual);
    QTRY_COMPARE(marked("physics"), 0);
    // What the match refuses is no step.
    heavy.ballMass = -1.0;
    s.controller.edits()->setRigidBody(heavy);
    QTRY_VERIFY2(s.window.notices()->text().contains("Could not change the physics"),
                 qPrintable(s.window.notices()->text()));
    QCOMPARE(stack->index(), 0);

    const bool running = s.controller.frame()->snapshot.clockRunning;
    s.controller.edits()->setClockRunning(!running);
    QTRY_COMPARE(s.controller.frame()->snapshot.clockRunning, !running);
    QTRY_COMPARE(stack->index(), 1);
    stack->undo();
    QTRY_COMPARE(s.controller.frame()->snapshot.clockRunning, running);
    const double clock = s.controller.frame()->snapshot.clock;
    s.controller.edits()->resetScore();
    QTRY_COMPARE(s.controller.frame()->snapshot.clock, 0.0);
    QTRY_COMPARE(stack->count(), 1);
    QTRY_COMPARE(marked("score and clock"), 1);
    stack->undo();
    QTRY_COMPARE(s.controller.frame()->snapshot.clock, clock);
    QTRY_COMPARE(marked("score and clock"), 0);
    s.controller.edits()->setPhysics(QStringLiteral("published"));
    QTRY_COMPARE(marked("physics"), 1);
    stack->undo();
    QTRY_COMPARE(marked("physics"), 0);
  }

  void nothingActsOnTheMatchWhileThePastIsShown() {
    Studio s;
    playRefereed(s);
    for (const char* dock : {"noise", "referee"}) {
      s.find<QDockWidget>(dock)->show();
      s.find<QDockWidget>(dock)->raise();
    }
    const std::uint64_t hash = s.controller.stateHash();
    const QUndoStack* stack = s.controller.edits()->undoStack();
    const int steps = stack->count();
    auto* state =
        s.find<QDockWidget>("referee")->findChild<QLabel*>(QStringLiteral("refereeState"));
    QTRY_VERIFY2(state->text().startsWith(QStringLiteral("READY")), qPrintable(state->text()));

    const auto lookBack = [&s] {
      if (!s.timeline()->isLookingBack()) s.timeline()->seek(1.0);
    };
    lookBack();
    QVERIFY(s.controller.edits()->isLocked());
    // Who drags a robot there is told why it stays.
    auto* canvas = s.window.field()->findChild<QGraphicsView*>();
    const Pose seen = s.timeline()->frame()->robots[0].pose;
    const QPoint from = canvas->mapFromScene(seen.position.x, seen.position.y);
    QTest::mousePress(canvas->viewport(), Qt::LeftButton, {}, from);
    for (const int step : {10, 30, 60}) {
      QMouseEvent move(QEvent::MouseMove, from + QPoint(step, 0),
                       canvas->viewport()->mapToGlobal(from + QPoint(step, 0)), Qt::NoButton,
                       Qt::LeftButton, {});
      QApplication::sendEvent(canvas->viewport(), &move);
    }
    QTest::mouseRelease(canvas->viewport(), Qt::LeftButton, {}, from + QPoint(60, 0));
    QCOMPARE(s.window.notices()->text(), MatchEdits::lockedText());
    QCOMPARE(s.controller.stateHash(), hash);
    // The panel shows the moment that everything else shows, and says why it is grey.
    QVERIFY2(state->text().startsWith(QStringLiteral("INITIAL")), qPrintable(state->text()));
    auto* detail =
        s.find<QDockWidget>("referee")->findChild<QLabel*>(QStringLiteral("refereeSetPlay"));
    QVERIFY(detail->text().contains(MatchEdits::lockedText()));
    QCOMPARE(s.find<QComboBox>("refereeRules")->currentData().toString(),
             QStringLiteral("humanoid-2021"));

    auto* refereeing = s.find<QDockWidget>("referee");
    s.find<QTableView>("refereeLeftPlayers")->selectRow(0);
    for (auto* button : refereeing->findChildren<QPushButton*>()) {
      QVERIFY2(!button->isEnabled(), qPrintable(button->text()));
      QTest::mouseClick(button, Qt::LeftButton);
    }
    for (QAction* key : refereeing->findChildren<QAction*>()) key->trigger();
    QTest::keyClick(s.find<QComboBox>("refereeRules"), Qt::Key_Down);
    QTest::mouseClick(s.find<QWidget>("refereeAutomatic"), Qt::LeftButton);
    QCOMPARE(s.controller.stateHash(), hash);

    for (auto* slider : s.find<QDockWidget>("noise")->findChildren<QSlider*>()) {
      QVERIFY(!slider->isEnabled());
      QTest::keyClick(slider, Qt::Key_PageUp);
    }
    QTest::keyClick(s.find<QComboBox>("physicsModel"), Qt::Key_Down);

    s.window.field()->setFocus();
    s.window.field()->actions().publishedKeys->setChecked(true);
    for (const FieldKey& key : fieldKeys()) {
      for (int i = 0; i < key.count; ++i) {
        lookBack();
        s.window.field()->select({inSlot(1)});
        QTest::keyClick(s.window.field()->focusProxy(), static_cast<Qt::Key>(key.key + i),
                        key.modifiers);
        if (s.controller.stateHash() != hash) qWarning() << key.shown << "acted on the match";
        QCOMPARE(s.controller.stateHash(), hash);
      }
    }
    lookBack();
    s.window.field()->select({inSlot(1)});
    for (const char* text : {"Seed", "Run robot processes", "Match number", "Reset score", "Speed",
                             "Game clock runs", "Undo"}) {
      QAction* action = s.menuAction(QString::fromUtf8(text));
      if (action != nullptr) QVERIFY2(!action->isEnabled(), text);
    }
    QVERIFY(s.menuAction(QStringLiteral("Reset score")));
    s.menuAction(QStringLiteral("Delete selected robots"))->trigger();
    RobotCard* card = s.window.findChild<RobotsDock*>()->cards().first();
    whenMenuOpens([](QMenu* menu) {
      for (const char* text : {"Order", "Behaviour", "Runtime", "Team", "Remove B1"}) {
        QVERIFY2(menu_entry::called(menu->actions(), QString::fromUtf8(text)), text);
        QVERIFY2(!menu_entry::called(menu->actions(), QString::fromUtf8(text))->isEnabled(), text);
      }
      QVERIFY(menu_entry::called(menu->actions(), QStringLiteral("Follow"))->isEnabled());
    });
    emit card->menuRequested(card->mapToGlobal(QPoint(20, 20)));
    for (const auto order : {&MatchEdits::startProcess, &MatchEdits::stopProcess,
                             &MatchEdits::restartProcess, &MatchEdits::killProcess}) {
      (s.controller.edits()->*order)(1);
    }
    s.controller.restart();
    QCOMPARE(s.controller.stateHash(), hash);
    QCOMPARE(stack->count(), steps);
    QCOMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(300));
    QVERIFY2(s.window.notices()->text().contains(MatchEdits::lockedText()),
             qPrintable(s.window.notices()->text()));

    // At now the same controls work. The keys may have raised another panel.
    s.find<QDockWidget>("referee")->show();
    s.find<QDockWidget>("referee")->raise();
    s.timeline()->goLive();
    QTRY_VERIFY2(state->text().startsWith(QStringLiteral("READY")), qPrintable(state->text()));
    QVERIFY(!detail->text().contains(MatchEdits::lockedText()));
    QTRY_VERIFY(s.find<QPushButton>("referee SET"));
    QTest::mouseClick(s.find<QPushButton>("referee SET"), Qt::LeftButton);
    QTRY_VERIFY(state->text().startsWith(QStringLiteral("SET")));
    QTRY_COMPARE(stack->count(), steps + 1);
    QVERIFY(s.menuAction(QStringLiteral("Reset score"))->isEnabled());
    s.window.field()->select({inSlot(1)});
    const std::size_t robots = s.controller.frame()->robots.size();
    s.menuAction(QStringLiteral("Delete selected robots"))->trigger();
    QTRY_COMPARE(s.controller.frame()->robots.size(), robots - 1);
  }

  void aCardIsDraggedOutOfAFloatingPanel() {
    Studio s;
    s.play();
    auto* panel = s.find<QDockWidget>("robots");
    auto* dock = s.window.findChild<RobotsDock*>();
    panel->setFloating(true);
    QTRY_COMPARE(dock->cards().size(), qsizetype(6));
    QVERIFY(panel->isFloating() && dock->window() != &s.window);
    QTRY_VERIFY(dock->cards()[1]->geometry().top() > dock->cards()[0]->geometry().bottom());
    RobotCard* card = dock->cards()[0];
    const RobotUid first = card->state().id, second = dock->cards()[1]->state().id;
    const QPoint grip(60, 30);
    const QPoint away = card->mapFromGlobal(panel->frameGeometry().topRight() + QPoint(90, 60));
    QTest::mousePress(card, Qt::LeftButton, {}, grip);
    QTest::mouseMove(card, grip + QPoint(30, 0));
    QTest::mouseMove(card, away);
    QTest::mouseRelease(card, Qt::LeftButton, {}, away);
    QVERIFY(dock->floating(first));
    QVERIFY(dock->floating(first)->isFloating() && dock->floating(first)->isVisible());
    QCOMPARE(dock->cards().size(), qsizetype(5));

    whenMenuOpens([](QMenu* menu) {
      QAction* entry = menu_entry::called(menu->actions(), QStringLiteral("Open in a window"));
      QVERIFY(entry);
      entry->trigger();
    });
    RobotCard* other = dock->cards()[0];
    emit other->menuRequested(other->mapToGlobal(QPoint(20, 20)));
    QVERIFY(dock->floating(second));
    QVERIFY(dock->floating(second)->isVisible());
    dock->floating(first)->close();
    QCOMPARE(dock->cards().size(), qsizetype(5));
    QVERIFY(dock->cards()[0]->state().id == first);
  }
};

PITCHBOARD_GUI_TEST(TestSafeHands)

}  // namespace tst_safe_hands

#include "tst_safe_hands.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// The one map of keys, pressed for real: the same wherever the focus is, text fields apart.

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTableView>
#include <QToolButton>
#include <QtTest>
#include <algorithm>
#include <set>

#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/robots/robot_card.h>
#include <ui/sources/match_edits.h>

#include "field_only.h"
#include "help_overlay.h"
#include "key_map.h"
#include "timeline_strip.h"
#include "window_rig.h"

namespace tst_key_map {

using namespace pitchboard;
using namespace pitchboard::ui;
using window_rig::Studio;

namespace {

/// A studio that plays nothing, with a robot selected and an event in its past.
struct Keys : Studio {
  Keys() : Studio(QSize(1280, 800)) {
    play();
    window.activateWindow();
    [this] { QVERIFY(QTest::qWaitForWindowActive(&window)); }();
    field()->select({blue()});
  }
  FieldView* field() { return window.field(); }
  RobotUid blue() { return controller.frame()->robots.front().uid; }
  QAction* action(const char* id) { return find<QAction>(id); }
  /// Where people click before they press a key.
  std::map<QString, QWidget*> places() {
    std::map<QString, QWidget*> all{
        {QStringLiteral("field"), field()->focusProxy()},
        {QStringLiteral("timeline"), find<TimelineStrip>("timelineStrip")},
        {QStringLiteral("card"), window.findChild<RobotCard*>()},
        {QStringLiteral("log"), find<QDockWidget>("log")->findChild<QTableView*>()},
        {QStringLiteral("variables"),
         find<QDockWidget>("variables")->findChild<QAbstractItemView*>()},
        {QStringLiteral("speed"), find<QComboBox>("speed")},
    };
    return all;
  }
  void click(QWidget* focus, const QKeySequence& keys) {
    const QKeyCombination key = keys[0];
    QTest::keyClick(focus, key.key(), key.keyboardModifiers());
  }
};

/// The table in docs/studio.md.
QString documentTable(const KeyMap& keys) {
  QString text, group;
  for (const KeyLine& line : keys.lines(true)) {
    if (line.group != group) {
      text += QStringLiteral("\n**%1**\n\n| keys | action |\n|---|---|\n").arg(line.group);
      group = line.group;
    }
    text += QStringLiteral("| %1 | %2 |\n").arg(line.keys, line.text);
  }
  return text + QLatin1Char('\n');
}

}  // namespace

class TestKeyMap : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void everyKeyIsGivenOnce() {
    Keys k;
    std::set<QString> given;
    for (const KeyRow& row : keyRows()) {
      if (row.id == nullptr) continue;
      QVERIFY2(k.action(row.id), row.id);
      for (const QKeySequence& keys : k.action(row.id)->shortcuts()) {
        QVERIFY2(keys.count() == 1, row.id);
        QVERIFY2(given.insert(keys.toString()).second, qPrintable(keys.toString()));
      }
    }
    QVERIFY(given.size() > 50);
  }

  void theSameWhereverTheFocusIs_data() {
    QTest::addColumn<QString>("place");
    for (const char* place : {"field", "timeline", "card", "log", "variables", "speed"}) {
      QTest::newRow(place) << QString::fromUtf8(place);
    }
  }
  // What each key triggers is counted; what it then does is its action's own matter.
  void theSameWhereverTheFocusIs() {
    QFETCH(QString, place);
    Keys k;
    for (const char* dock : {"log", "variables"}) k.find<QDockWidget>(dock)->raise();
    QWidget* focus = nullptr;
    QTRY_VERIFY((focus = k.places()[place]) != nullptr);
    const std::set<std::string> ends{"quit",      "openFile",   "openSession",  "saveScenario",
                                     "fieldOnly", "fullScreen", "findAnything", "showKeys"};
    for (const KeyRow& row : keyRows()) {
      if (row.id == nullptr || ends.contains(row.id)) continue;
      QAction* action = k.action(row.id);
      action->disconnect();
      action->setEnabled(true);
      for (const QKeySequence& keys : action->shortcuts()) {
        const QSignalSpy done(action, &QAction::triggered);
        action->setEnabled(true);
        focus->setFocus();
        k.click(focus, keys);
        QVERIFY2(done.count() == 1,
                 qPrintable(QStringLiteral("%1 in %2").arg(keys.toString(), place)));
      }
    }
  }

  // Every control of the window and of panels that float that can have the focus, text fields
  // apart.
  void theTimelineHasItsKeysInEveryControl() {
    Keys k;
    k.timeline()->seek(2.0);
    for (auto* dock : k.window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) dock->show();
    k.find<QDockWidget>("noise")->setFloating(true);
    k.window.notices()->show({QStringLiteral("a")}, QStringLiteral("Something."),
                             {{QStringLiteral("Repair"), {}}});
    const char* const ids[] = {"play",          "stepBack",    "stepForward", "nextEvent",
                               "previousEvent", "addBookmark", "escape",      "nudgeLeft",
                               "faster",        "flipSides",   "fitField",    "removeSelected"};
    for (const char* id : ids) k.action(id)->disconnect();
    // A card is there once a frame was shown, and visible once its panel was laid out.
    const auto isVisible = [](const QWidget* widget) { return widget->isVisible(); };
    QTRY_COMPARE(std::size_t(std::ranges::count_if(k.window.findChildren<RobotCard*>(), isVisible)),
                 k.controller.frame()->robots.size());
    QSet<QWidget*> tried;
    for (auto* dock : k.window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
      dock->raise();
      QTRY_VERIFY2(dock->isVisible(), qPrintable(dock->windowTitle()));
      for (auto* widget : k.window.findChildren<QWidget*>()) {
        if (tried.contains(widget) || !widget->isVisible() || !widget->isEnabled() ||
            widget->focusPolicy() == Qt::NoFocus || widget->focusProxy() != nullptr ||
            widget->inherits("QLineEdit") || widget->inherits("QAbstractSpinBox") ||
            (widget->window() != &k.window && !widget->window()->inherits("QDockWidget"))) {
          continue;
        }
        const auto* combo = qobject_cast<QComboBox*>(widget);
        if (combo != nullptr && combo->isEditable()) continue;
        tried.insert(widget);
        for (const char* id : ids) {
          QAction* action = k.action(id);
          for (const QKeySequence& keys : action->shortcuts()) {
            const QSignalSpy done(action, &QAction::triggered);
            action->setEnabled(true);
            widget->window()->activateWindow();
            widget->setFocus();
            k.click(widget, keys);
            const QString where =
                QStringLiteral("%1 in %2 \"%3\" of %4")
                    .arg(keys.toString(), QLatin1String(widget->metaObject()->className()),
                         widget->objectName(), dock->windowTitle());
            if (done.count() != 1) qWarning() << where;
            QVERIFY2(done.count() == 1, qPrintable(where));
          }
        }
      }
    }
    QVERIFY2(tried.size() >= 50, qPrintable(QString::number(tried.size())));
  }

  void textFieldsKeepTheirKeys() {
    Keys k;
    auto* filter = k.find<QDockWidget>("variables")->findChild<QLineEdit*>();
    QVERIFY(filter);
    filter->setFocus();
    const double shown = k.timeline()->time();
    const bool paused = k.controller.isPaused();
    QTest::keyClicks(filter, QStringLiteral("m n 1 -0+a"));
    QCOMPARE(filter->text(), QStringLiteral("m n 1 -0+a"));
    QTest::keyClick(filter, Qt::Key_Home);
    QTest::keyClick(filter, Qt::Key_Right);
    QTest::keyClick(filter, Qt::Key_Delete);
    QCOMPARE(filter->text(), QStringLiteral("mn 1 -0+a"));
    QCOMPARE(k.timeline()->time(), shown);
    QCOMPARE(k.controller.isPaused(), paused);
    QCOMPARE(k.field()->selection(), std::vector{k.blue()});
    QCOMPARE(k.controller.frame()->robots.size(), std::size_t(6));
    // Escape leads back to the keys of the window.
    QTest::keyClick(filter, Qt::Key_Escape);
    QVERIFY(!filter->hasFocus());
  }

  void spaceActsWhenItIsReleasedAndNotAfterADrag() {
    Keys k;
    QVERIFY(k.controller.isPaused());
    auto* canvas = k.window.field()->findChild<QAbstractScrollArea*>();
    QTRY_VERIFY(k.window.findChild<RobotCard*>() != nullptr);
    QWidget* card = k.window.findChild<RobotCard*>();
    card->setFocus();
    QTest::keyPress(card, Qt::Key_Space);
    QVERIFY(k.controller.isPaused());
    QTest::keyRelease(card, Qt::Key_Space);
    QVERIFY(!k.controller.isPaused());
    QTest::keyClick(card, Qt::Key_Space);
    QVERIFY(k.controller.isPaused());
    QTest::keyPress(card, Qt::Key_Space);
    QTest::mousePress(canvas->viewport(), Qt::LeftButton, {}, QPoint(200, 200));
    QTest::mouseMove(canvas->viewport(), QPoint(240, 220));
    QTest::mouseRelease(canvas->viewport(), Qt::LeftButton, {}, QPoint(240, 220));
    QTest::keyRelease(card, Qt::Key_Space);
    QVERIFY(k.controller.isPaused());
    QCOMPARE(k.field()->selection(), std::vector{k.blue()});
  }

  void enterPressesTheFocusedButton() {
    Keys k;
    auto* fold = k.find<QToolButton>("now");
    k.timeline()->seek(2.0);
    fold->setFocus();
    QTest::keyClick(fold, Qt::Key_Return);
    QVERIFY(!k.timeline()->isLookingBack());
    QVERIFY(k.controller.isPaused());
  }

  void escapeGoesStepByStep() {
    Keys k;
    QWidget* focus = k.field()->focusProxy();
    k.find<QAction>("fieldOnly")->trigger();
    QVERIFY(k.window.isFullScreen());
    k.timeline()->setSelection(telemetry::TimeRange{1.0, 2.0});
    k.timeline()->seek(1.5);
    k.field()->actions().tools[1]->trigger();
    const auto steps = [&] {
      return QList<bool>{k.field()->actions().tools[0]->isChecked(),
                         !k.timeline()->selection().has_value(), !k.timeline()->isLookingBack(),
                         !k.window.isFullScreen(), k.field()->selection().empty()};
    };
    const qsizetype all = steps().size();
    for (qsizetype done = 0; done <= all; ++done) {
      QCOMPARE(steps().count(true), done);
      QCOMPARE(steps().mid(0, done).count(true), done);
      QTest::keyClick(focus, Qt::Key_Escape);
    }
  }

  void lettersGiveOrdersOnlyInPublishedKeys() {
    Keys k;
    QWidget* log = k.find<QDockWidget>("log")->findChild<QTableView*>();
    QWidget* sign = k.find<QWidget>("publishedKeysSign");
    QVERIFY(sign && !sign->isVisible());
    QTest::keyClick(k.field()->focusProxy(), Qt::Key_A);
    QTest::keyClick(k.field()->focusProxy(), Qt::Key_B);
    QCOMPARE(k.controller.edits()->undoStack()->count(), 0);
    QTest::keyClick(log, Qt::Key_K, Qt::ControlModifier | Qt::ShiftModifier);
    QVERIFY(k.field()->actions().publishedKeys->isChecked());
    QVERIFY(sign->isVisible());
    // Wherever the focus is, and before the window's own N, M and Ctrl+A.
    QSignalSpy event(k.action("nextEvent"), &QAction::triggered);
    QTest::keyClick(log, Qt::Key_A);
    QTRY_COMPARE(k.controller.frame()->robots.size(), std::size_t(7));
    QTest::keyClick(log, Qt::Key_A, Qt::ControlModifier);
    QTRY_COMPARE(k.controller.frame()->robots.size(), std::size_t(8));
    QTest::keyClick(log, Qt::Key_N);
    QCOMPARE(event.count(), 0);
    QTest::keyClick(log, Qt::Key_N, Qt::ControlModifier);
    QCOMPARE(event.count(), 1);
    QTest::mouseClick(sign, Qt::LeftButton);
    QVERIFY(!k.field()->actions().publishedKeys->isChecked() && !sign->isVisible());
  }

  void theModeIsRemembered() {
    Keys k;
    QVERIFY(!k.field()->actions().publishedKeys->isChecked());
    k.field()->actions().publishedKeys->trigger();
    k.window.close();
    MatchController controller(Studio::options());
    MainWindow again(&controller, &k.settings);
    QVERIFY(again.field()->actions().publishedKeys->isChecked());
  }

  void theKeysLieOverTheWindowUntilAnyKey() {
    Keys k;
    auto* overlay = k.find<QWidget>("helpOverlay");
    QVERIFY(overlay && !overlay->isVisible());
    QTRY_VERIFY(k.window.findChild<RobotCard*>());
    QWidget* card = k.window.findChild<RobotCard*>();
    card->setFocus();
    QTest::keyClick(card, Qt::Key_F1);
    QVERIFY(overlay->isVisible());
    QCOMPARE(overlay->size(), k.window.size());
    QTest::keyClick(card, Qt::Key_Space);
    QVERIFY(!overlay->isVisible());
    QVERIFY(k.controller.isPaused());
  }

  void speedGoesUpAndDownByKeys() {
    Keys k;
    QWidget* focus = k.field()->focusProxy();
    k.controller.setSpeed(1.0);
    QTest::keyClick(focus, Qt::Key_Plus);
    QCOMPARE(k.controller.speed(), 2.0);
    QTest::keyClick(focus, Qt::Key_Minus);
    QTest::keyClick(focus, Qt::Key_Minus);
    QCOMPARE(k.controller.speed(), 0.5);
    k.controller.setSpeed(link::MatchRunner::unlimitedSpeed);
    QTest::keyClick(focus, Qt::Key_Plus);
    QCOMPARE(k.controller.speed(), link::MatchRunner::unlimitedSpeed);
    QTest::keyClick(focus, Qt::Key_Minus);
    QCOMPARE(k.controller.speed(), 10.0);
  }

  // PITCHBOARD_WRITE_DOCS=1 puts the table into the document instead.
  void theDocumentHasTheTable() {
    Keys k;
    const QString table = documentTable(KeyMap(k.window));
    QFile file(QStringLiteral(PITCHBOARD_SOURCE_DIR "/docs/studio.md"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(file.readAll());
    file.close();
    const QString mark = QStringLiteral("<!-- keys -->\n");
    const auto begin = text.indexOf(mark);
    const auto end = text.indexOf(QStringLiteral("<!-- end -->"), begin);
    QVERIFY(begin >= 0 && end >= 0);
    if (qEnvironmentVariableIsSet("PITCHBOARD_WRITE_DOCS")) {
      QString right = text;
      right.replace(begin, end - begin, mark + table);
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(right.toUtf8());
      return;
    }
    QCOMPARE(text.mid(begin + mark.size(), end - begin - mark.size()).split(QLatin1Char('\n')),
             table.split(QLatin1Char('\n')));
  }
};

PITCHBOARD_GUI_TEST(TestKeyMap)

}  // namespace tst_key_map

#include "tst_key_map.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// Simulate from here, others follow: opponents and ball move as before, until they are let go.

#include <QDialogButtonBox>
#include <QListWidget>
#include <QPushButton>
#include <QtTest>

#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>

#include "window_rig.h"

namespace tst_follow {

using namespace pitchboard;
using namespace pitchboard::ui;
using window_rig::Studio;

class TestFollow : public QObject {
  Q_OBJECT
 private slots:
  void opponentsAndBallMoveAsBefore() {
    Studio s;
    s.play();
    s.controller.settle();
    QAction* action = s.menuAction(QStringLiteral("Simulate from here, others follow"));
    QVERIFY(action);
    s.timeline()->seek(1.0);
    QVERIFY(action->isEnabled());
    const FramePtr before = s.controller.frameAt(1.5);
    QVERIFY(before);
    action->trigger();
    QDialog* dialog = nullptr;
    QTRY_VERIFY((dialog = s.window.findChild<QDialog*>("followDialog")));
    QStringList ticked;
    auto* list = dialog->findChild<QListWidget*>();
    for (int i = 0; i < list->count(); ++i) {
      if (list->item(i)->checkState() == Qt::Checked) ticked << list->item(i)->text();
    }
    QCOMPARE(ticked, QStringList({"ball", "R1", "R2", "R3"}));
    for (QPushButton* button : dialog->findChildren<QPushButton*>()) {
      if (button->text() == QLatin1String("Simulate")) button->click();
    }
    QTRY_VERIFY(s.controller.isOpen() && s.controller.frame());
    QTRY_VERIFY(s.controller.frame()->snapshot.tick >= 45 && !s.controller.isPaused());
    s.controller.setPaused(true);
    s.controller.settle();
    const FramePtr after = s.controller.frameAt(0.5);
    QVERIFY(after);
    QCOMPARE(after->snapshot.time, 0.5);
    QVERIFY(distance(after->snapshot.ball, before->snapshot.ball) < 1e-9);
    for (const link::RobotFrame& robot : before->robots) {
      const link::RobotFrame* now = after->robot(robot.slot());
      QVERIFY(now);
      if (robot.identity.team != TeamColor::Red) continue;
      QVERIFY2(distance(now->pose.position, robot.pose.position) < 1e-9, robot.name.c_str());
    }
    // Undone, the first match is there again.
    s.controller.edits()->undoStack()->undo();
    QTRY_VERIFY(s.controller.isOpen() && s.controller.frame() &&
                s.controller.frame()->snapshot.tick == 300);
  }

  /// In the present there is nothing to follow.
  void isRefusedInThePresent() {
    Studio s;
    s.play();
    s.controller.settle();
    QAction* action = s.menuAction(QStringLiteral("Simulate from here, others follow"));
    QVERIFY(!action->isEnabled());
    QVERIFY(action->toolTip().contains("Look back"));
  }
};

PITCHBOARD_GUI_TEST(TestFollow)

}  // namespace tst_follow

#include "tst_follow.moc"

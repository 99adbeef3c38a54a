// SPDX-License-Identifier: GPL-3.0-or-later
// The processes of a robot, chosen with the mouse: my program as its decision, and my robot among
// reference robots.
#include <QDialogButtonBox>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>
#include <QUndoStack>
#include <QtTest>

#include <robotlink/blackboard/system_v.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/robot_menus.h>

#include "../support/menu_entry.h"
#include "../support/segment_keys.h"

namespace tst_runtime_menu {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestRuntimeMenu : public QObject {
  Q_OBJECT
  const int m_base = testKeyBase();

  link::MatchOptions options() const {
    link::MatchOptions made;
    made.cognition = link::Cognition::Separate;
    made.keyBase = m_base;
    made.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    return made;
  }

  /// A program of a team: says its key and which build it is, then thinks.
  static void build(const QString& path, const char* words) {
    const QString fresh = path + QStringLiteral(".new");
    QFile file(fresh);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(QByteArray("#!/bin/sh\necho \"") + words + " $1\"\nexec sleep 600\n");
    file.setPermissions(file.permissions() | QFile::ExeOwner);
    file.close();
    QFile::remove(path);
    QVERIFY(QFile::rename(fresh, path));
  }

  static std::vector<link::ProcessStatus> processesOf(const MatchController& controller,
                                                      int robot) {
    const FramePtr frame = controller.frame();
    const link::RobotFrame* seen = frame ? frame->robot(RobotId{robot}) : nullptr;
    if (!seen) return {};
    const auto all = seen->processes();
    return {all.begin(), all.end()};
  }
  static link::ProcessStatus decisionOf(const MatchController& controller, int robot) {
    for (const link::ProcessStatus& one : processesOf(controller, robot)) {
      if (one.name == "decision") return one;
    }
    return {};
  }

  // Opens the robot's menu and clicks the entry of Runtime, or another part of the menu, that
  // begins like this.
  static void choose(MatchController& controller, int robot, const QString& starts,
                     decltype(&addRuntimeMenu) part = &addRuntimeMenu) {
    QWidget window;
    window.show();
    QMenu menu(&window);
    part(&menu, &controller, {RobotId{robot}});
    QCOMPARE(menu.actions().size(), 1);
    QMenu* runtime = menu.actions().front()->menu();
    runtime->popup(QPoint(20, 20));
    QVERIFY(QTest::qWaitForWindowExposed(runtime));
    QAction* entry = menu_entry::beginning(runtime->actions(), starts);
    QVERIFY2(entry, qPrintable(starts));
    QTest::mouseClick(runtime, Qt::LeftButton, {}, runtime->actionGeometry(entry).center());
  }

 private slots:
  void initTestCase() { QApplication::setAttribute(Qt::AA_DontUseNativeDialogs); }
  void cleanup() {
    for (int n = 1; n <= 6; ++n) removeSegment(m_base + 100 * n);
  }

  void myProgramAsDecision() {
    QTemporaryDir folder;
    const QString program = folder.filePath(QStringLiteral("decide"));
    build(program, "first");
    MatchController controller(options());
    QStringList errors;
    QObject::connect(&controller, &MatchController::errorOccurred, &controller,
                     [&errors](const QString& sentence) { errors << sentence; });
    controller.open(link::loadScenario("match-3v3").value());
    QTRY_VERIFY_WITH_TIMEOUT(decisionOf(controller, 1).pid > 0, 30'000);
    QVERIFY(!decisionOf(controller, 1).isTeamProgram);

    // The menu opens the dialog and waits for it.
    bool typed = false;
    QTimer answer;
    QObject::connect(&answer, &QTimer::timeout, &controller, [&] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (!dialog) return;
      answer.stop();
      auto* name = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
      auto* buttons = dialog->findChild<QDialogButtonBox*>();
      if (!name || !buttons) return dialog->reject();
      // Pasted: letter by letter the completion of paths would join in.
      name->setText(program);
      typed = true;
      QTest::mouseClick(buttons->button(QDialogButtonBox::Open), Qt::LeftButton);
      if (dialog->isVisible()) dialog->reject();
    });
    answer.start(20);
    choose(controller, 1, QStringLiteral("Run my program"));
    QVERIFY(typed);
    const auto hasText = [&](const QString& words) {
      const link::ProcessStatus now = decisionOf(controller, 1);
      const std::string wanted =
          (words + QLatin1Char(' ') + QString::number(m_base + 100)).toStdString();
      return now.isTeamProgram && now.state == link::ProcessState::Running &&
             !now.lastLines.empty() && now.lastLines.back() == wanted;
    };
    QTRY_VERIFY_WITH_TIMEOUT(hasText(QStringLiteral("first")), 30'000);
    // It is watched: what runs beside it is ours and stays, planning is not.
    std::vector<std::string> names;
    for (const link::ProcessStatus& one : processesOf(controller, 1)) names.push_back(one.name);
    QCOMPARE(names,
             (std::vector<std::string>{"localization", "team", "decision", "communication"}));
    // Built again: it starts again.
    const pid_t before = decisionOf(controller, 1).pid;
    build(program, "second");
    QTRY_VERIFY_WITH_TIMEOUT(hasText(QStringLiteral("second")), 30'000);
    QVERIFY(decisionOf(controller, 1).pid != before);
    QVERIFY2(errors.isEmpty(), qPrintable(errors.join(QLatin1Char('\n'))));
  }

  void myRobotAmongReferenceRobots() {
    MatchController controller(options());
    controller.open(link::loadScenario("match-3v3").value());
    QTRY_VERIFY_WITH_TIMEOUT(decisionOf(controller, 6).pid > 0, 30'000);
    choose(controller, 2, QStringLiteral("My robot among"));
    QTRY_VERIFY_WITH_TIMEOUT(processesOf(controller, 2).empty(), 30'000);
    for (const int other : {1, 3, 4, 5, 6}) {
      QTRY_VERIFY_WITH_TIMEOUT(decisionOf(controller, other).pid > 0, 30'000);
    }
    // Its blackboard is there for a program that I start.
    QVERIFY(link::SystemVSegments::open(m_base + 200, link::AttachMode::AttachOnly));
  }

  /// A check box for the whole team; its keeper has the process, and undo stops it.
  void aTeamHasAnAdvisor() {
    MatchController controller(options());
    controller.open(link::loadScenario("match-3v3").value());
    QTRY_VERIFY_WITH_TIMEOUT(decisionOf(controller, 6).pid > 0, 30'000);
    const auto advised = [&controller] {
      std::vector<int> robots;
      for (int robot = 1; robot <= 6; ++robot) {
        for (const link::ProcessStatus& one : processesOf(controller, robot)) {
          if (one.name == "advisor") robots.push_back(robot);
        }
      }
      return robots;
    };
    const std::vector<int> keeper{2}, none;
    QCOMPARE(advised(), none);
    choose(controller, 2, QStringLiteral("Advisor"), &addTeamMenu);
    QTRY_COMPARE_WITH_TIMEOUT(advised(), keeper, 30'000);
    QVERIFY(controller.edits()->isAdvised(TeamColor::Blue));
    QTRY_VERIFY(controller.edits()->undoStack()->canUndo());  // once the match has done it
    controller.edits()->undoStack()->undo();
    QTRY_COMPARE_WITH_TIMEOUT(advised(), none, 30'000);
    controller.edits()->undoStack()->redo();
    QTRY_COMPARE_WITH_TIMEOUT(advised(), keeper, 30'000);
    choose(controller, 3, QStringLiteral("Advisor"), &addTeamMenu);
    QTRY_COMPARE_WITH_TIMEOUT(advised(), none, 30'000);
    QVERIFY(!controller.edits()->isAdvised(TeamColor::Blue));
  }
};

PITCHBOARD_GUI_TEST(TestRuntimeMenu)

}  // namespace tst_runtime_menu

#include "tst_runtime_menu.moc"

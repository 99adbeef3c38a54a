// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrating from a recording in the window, with mouse and keys: from the menu to a robot model
// in a file and in the match, and back.
#include <QComboBox>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <QProgressBar>
#include <QPushButton>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QUndoStack>
#include <QtTest>

#include <robotlink/models/robot_models.h>
#include <robotlink/scenario/scenario.h>
#include <ui/base/theme.h>
#include <ui/calibrate/calibrate_dialog.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/window/main_window.h>

#include "../support/menu_entry.h"
#include "../support/program_run.h"
#include "studio_rig.h"

namespace tst_calibrate_dialog {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestCalibrateDialog : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  QString m_session;

  struct Studio : studio_rig::Studio {
    CalibrateDialog* dialog = nullptr;

    Studio() {
      controller.open(link::loadScenario("calibration-drill").value(), true);
      QAction* entry =
          menu_entry::downFrom(window.menuBar(), {"Robots", "Calibrate from recording…"});
      if (entry != nullptr) entry->trigger();
      dialog = window.findChild<CalibrateDialog*>();
    }
    template <class Widget>
    Widget* find(const char* name) const {
      return dialog->findChild<Widget*>(QLatin1String(name));
    }
    void click(const char* name) const {
      QTest::mouseClick(find<QPushButton>(name), Qt::LeftButton);
    }
    /// Gives a path to the file dialog that a button has opened.
    void answer(const QString& path) const {
      QTRY_VERIFY(dialog->findChild<QFileDialog*>());
      auto* ask = dialog->findChild<QFileDialog*>();
      auto* name = ask->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
      QVERIFY(name);
      name->setText(path);  // typed, its completer would take the Return
      QTest::keyClick(name, Qt::Key_Return);
      QTRY_VERIFY(!dialog->findChild<QFileDialog*>());
    }
    QString message() const { return find<QLabel>("calibrateMessage")->text(); }
    const sim::RobotModel& model(int id) const {
      return controller.edits()->robot(RobotId{id})->model;
    }
    void add(const QString& path) const {
      click("calibrateAdd");
      answer(path);
    }
  };

  /// With PITCHBOARD_PICTURES=FOLDER the pictures are kept, to be looked at.
  static void keepPictures(QWidget* widget, const QString& name) {
    const QString folder = qEnvironmentVariable("PITCHBOARD_PICTURES");
    if (folder.isEmpty()) return;
    for (const auto& [choice, suffix] :
         {std::pair{ThemeChoice::Light, "light"}, std::pair{ThemeChoice::Dark, "dark"}}) {
      setTheme(*qApp, choice);
      QVERIFY(widget->grab().save(folder + '/' + name + '-' + suffix + ".png"));
    }
  }

 private slots:
  void initTestCase() {
    setTheme(*qApp, ThemeChoice::Dark);
    m_session = m_folder.filePath("drill.mcap");
    const ProgramRun run =
        cli({"record", "--scenario", "calibration-drill", "--duration", "60", "-o", m_session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
  }

  void aRecordingBecomesAModelOfTheMatch() {
    Studio s;
    QVERIFY(s.dialog);
    QVERIFY(!s.find<QPushButton>("calibrateStart")->isEnabled());
    s.add(m_session);
    auto* robot = s.find<QComboBox>("calibrateRobot");
    QTRY_COMPARE(robot->count(), 2);
    QCOMPARE(robot->currentText(), QStringLiteral("B1"));
    QCOMPARE(s.find<QListWidget>("calibrateFiles")->count(), 1);
    QVERIFY(!s.find<QPushButton>("calibrateUseRobot")->isEnabled());
    QVERIFY(!s.find<QPushButton>("calibrateSave")->isEnabled());

    QSignalSpy ended(s.dialog, &CalibrateDialog::ended);
    QTest::keyClicks(s.find<QLineEdit>("calibrateTo"), "0:50");
    s.click("calibrateStart");
    QVERIFY(s.find<QProgressBar>("calibrateProgress")->isVisible());
    QCOMPARE(s.find<QPushButton>("calibrateStart")->text(), QStringLiteral("Cancel"));
    QTRY_VERIFY_WITH_TIMEOUT(!ended.isEmpty(), 240'000);
    QVERIFY2(s.dialog->calibration() != nullptr, qPrintable(s.message()));
    QVERIFY(!s.find<QProgressBar>("calibrateProgress")->isVisible());

    // What the report says: a row for every number, and the rest with reasons.
    const auto* values = s.find<QTableWidget>("calibrateValues");
    const auto turn = values->findItems(QStringLiteral("turn"), Qt::MatchExactly);
    QCOMPARE(turn.size(), 1);
    const double degrees = values->item(turn.front()->row(), 1)->text().toDouble();
    QVERIFY2(std::abs(degrees - 40.0) < 2.0, qPrintable(QString::number(degrees)));
    QCOMPARE(values->item(turn.front()->row(), 4)->text(), QStringLiteral("40"));
    // The unit can be read without scrolling.
    QCOMPARE(values->item(turn.front()->row(), 3)->text(), QStringLiteral("°/s"));
    const auto* shown = values->horizontalHeader();
    QVERIFY(shown->sectionViewportPosition(3) + shown->sectionSize(3) <=
            values->viewport()->width());
    QVERIFY(!s.find<QTableWidget>("calibrateKept")
                 ->findItems(QStringLiteral("kick_speed"), Qt::MatchExactly)
                 .isEmpty());
    auto* tabs = s.find<QTabWidget>("calibrateResults");
    for (int i = 0; i < tabs->count(); ++i) {
      QTest::mouseClick(tabs->tabBar(), Qt::LeftButton, {}, tabs->tabBar()->tabRect(i).center());
      QCOMPARE(tabs->currentIndex(), i);
      keepPictures(s.dialog, QStringLiteral("calibrate-%1").arg(i));
    }

    const QString file = m_folder.filePath("b1.json");
    s.click("calibrateSave");
    s.answer(file);
    QTRY_VERIFY(QFile::exists(file));
    const auto saved = link::loadRobotModel(file.toStdString());
    QVERIFY2(saved.has_value(), saved ? "" : saved.error().text().c_str());

    // In the match: one robot, its team, and back.
    QTRY_VERIFY(s.controller.frame());
    const double before = s.model(1).turn;
    QTRY_VERIFY(s.find<QPushButton>("calibrateUseRobot")->isEnabled());
    s.click("calibrateUseRobot");
    QCOMPARE(s.model(1).name, std::string("B1-calibrated"));
    QCOMPARE(s.model(2).name, std::string("kid-size"));
    QTRY_COMPARE(s.controller.edits()->undoStack()->index(), 1);  // once the match has done it
    s.controller.edits()->undoStack()->undo();
    QCOMPARE(s.model(1).turn, before);
    s.click("calibrateUseTeam");
    QCOMPARE(s.model(1).name, std::string("B1-calibrated"));
    QCOMPARE(s.model(2).name, std::string("B1-calibrated"));
    QTRY_COMPARE(s.controller.edits()->undoStack()->index(), 1);
    s.controller.edits()->undoStack()->undo();
    QCOMPARE(s.model(1).name, std::string("kid-size"));
    QCOMPARE(s.model(2).name, std::string("kid-size"));
  }

  void cancelEndsIt() {
    Studio s;
    QVERIFY(s.dialog);
    s.add(m_session);
    QTRY_VERIFY(s.find<QPushButton>("calibrateStart")->isEnabled());
    QSignalSpy ended(s.dialog, &CalibrateDialog::ended);
    s.click("calibrateStart");
    QVERIFY(s.dialog->isCalibrating());
    s.click("calibrateStart");
    QTRY_VERIFY_WITH_TIMEOUT(!ended.isEmpty(), 120'000);
    QCOMPARE(s.message(), QStringLiteral("Calibration cancelled."));
    QVERIFY(!s.dialog->calibration());
    QVERIFY(s.find<QPushButton>("calibrateStart")->isEnabled());
  }

  void whatCannotBeUsedIsReported() {
    Studio s;
    QVERIFY(s.dialog);
    s.add(QStringLiteral(PITCHBOARD_SOURCE_DIR "/README.md"));
    QTRY_VERIFY2(s.message().contains(QStringLiteral("MCAP")), qPrintable(s.message()));
    QCOMPARE(s.find<QListWidget>("calibrateFiles")->count(), 0);
    s.add(m_session);
    QTRY_COMPARE(s.find<QListWidget>("calibrateFiles")->count(), 1);
    QTest::keyClicks(s.find<QLineEdit>("calibrateFrom"), "soon");
    s.click("calibrateStart");
    QVERIFY(!s.dialog->isCalibrating());
    QVERIFY2(s.message().contains(QStringLiteral("1:18.7")), qPrintable(s.message()));
    // Removed by hand: nothing is left to calibrate from.
    auto* files = s.find<QListWidget>("calibrateFiles");
    QTest::mouseClick(files->viewport(), Qt::LeftButton, {},
                      files->visualItemRect(files->item(0)).center());
    s.click("calibrateRemove");
    QCOMPARE(files->count(), 0);
    QVERIFY(!s.find<QPushButton>("calibrateStart")->isEnabled());
  }
};

PITCHBOARD_GUI_TEST(TestCalibrateDialog)

}  // namespace tst_calibrate_dialog

#include "tst_calibrate_dialog.moc"

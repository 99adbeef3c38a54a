// SPDX-License-Identifier: GPL-3.0-or-later
// What runs is not ended without a question or a way to go on, and what is saved is the moment at
// which the key was pressed.

#include <QDialogButtonBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStandardPaths>
#include <QTimer>
#include <QtTest>

#include <robotlink/scenario/scenario.h>
#include <telemetry/session/session_reader.h>
#include <ui/base/notice_bar.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/window/main_window.h>

#include "session_rig.h"

namespace tst_nothing_lost {

using namespace pitchboard;
using namespace pitchboard::ui;
using session_rig::Studio;

namespace {

/// Answers the next file dialog with this path, after `meanwhile`.
class FileAnswer : public QObject {
 public:
  FileAnswer(const QString& path, std::function<void()> meanwhile) {
    connect(&m_timer, &QTimer::timeout, this, [this, path, meanwhile = std::move(meanwhile)] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (dialog == nullptr) return;
      m_timer.stop();
      meanwhile();
      auto* name = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
      name->setText(path);
      QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save),
                        Qt::LeftButton);
      if (dialog->isVisible()) dialog->reject();
    });
    m_timer.start(10);
  }

 private:
  QTimer m_timer;
};

QPushButton* questionButton(const MainWindow& window, const char* name) {
  for (const auto* ask : window.findChildren<QMessageBox*>(QStringLiteral("askToClose"))) {
    if (ask->isVisible()) return ask->findChild<QPushButton*>(QLatin1String(name));
  }
  return nullptr;
}

QPushButton* noticeButton(const MainWindow& window, const QString& text) {
  for (auto* button : window.notices()->findChildren<QPushButton*>()) {
    if (button->isVisible() && button->text() == text) return button;
  }
  return nullptr;
}

}  // namespace

class TestNothingLost : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    QStandardPaths::setTestModeEnabled(true);
    setTheme(*qApp, ThemeChoice::Dark);
    cleanupTestCase();  // what a run that was killed left
  }
  void cleanupTestCase() {
    QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation)).removeRecursively();
  }

  void theMomentOfTheKeyIsSaved() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const Pose before = s.controller.frame()->robots[0].pose;
    const RobotId id = s.controller.frame()->robots[0].identity.id;
    const QString path = s.folder.filePath(QStringLiteral("moment.json"));
    const FileAnswer answer(path, [&] {
      s.controller.edits()->moveRobots({{id, before, {{2.5, -1.5}, 0.0}}});
      QVERIFY(QTest::qWaitFor(
          [&] { return std::abs(s.controller.frame()->robots[0].pose.position.x - 2.5) < 1e-9; }));
    });
    s.window.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&s.window));
    QTest::keySequence(&s.window, s.action("saveScenario")->shortcut());
    const auto saved = link::loadScenario(path.toStdString());
    QVERIFY2(saved, saved ? "" : saved.error().text().c_str());
    QVERIFY(std::abs(saved->robots[0].pose.position.x - before.position.x) < 1e-6);
  }

  void quittingWhileRecordingAsks() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->start();
    QVERIFY(s.window.recording()->isRecording());
    s.window.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&s.window));
    QTest::keySequence(&s.window, s.action("quit")->shortcut());
    QTRY_VERIFY(questionButton(s.window, "stay"));
    QVERIFY(s.window.isVisible());
    const auto* ask = s.window.findChild<QMessageBox*>(QStringLiteral("askToClose"));
    QVERIFY2(ask->text().contains(s.window.recording()->path()), qPrintable(ask->text()));
    // Enter stays, as does Escape.
    QTest::keyClick(questionButton(s.window, "stay"), Qt::Key_Return);
    QTRY_VERIFY(!questionButton(s.window, "stay"));
    QVERIFY(s.window.isVisible() && s.window.recording()->isRecording());
    s.window.close();
    QTRY_VERIFY(questionButton(s.window, "quitNow"));
    QTest::mouseClick(questionButton(s.window, "quitNow"), Qt::LeftButton);
    QTRY_VERIFY(!s.window.isVisible());
  }

  void aSignalClosesWithoutAQuestion() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->start();
    s.window.closeNow();
    QVERIFY(!s.window.isVisible());
  }

  void anExperimentIsAskedForAndContinued() {
    const auto find = [](const MainWindow& window, const char* name) {
      return window.findChild<QPushButton*>(QLatin1String(name));
    };
    const char* const text = R"({
      "version": 1, "name": "quit", "runs": 100000,
      "scenario": {"version": 1, "ball": {"x": 0.3},
        "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": "naive"}],
        "writes": [{"variable": "COM_REFEREE", "value": 2}]},
      "stop": {"duration": 20}})";
    const auto write = [&](const MainWindow& window) {
      auto* dock = window.findChild<QDockWidget*>(QStringLiteral("experiments"));
      dock->show();
      dock->raise();
      auto* edit = window.findChild<QPlainTextEdit*>(QStringLiteral("experimentText"));
      auto* tabs = window.findChild<QTabWidget*>(QStringLiteral("experimentTabs"));
      tabs->setCurrentIndex(tabs->count() - 1);
      edit->setPlainText(QString::fromLatin1(text));
      edit->document()->setModified(true);
      tabs->setCurrentIndex(0);
    };
    const auto message = [](const MainWindow& window) {
      return window.findChild<QLabel*>(QStringLiteral("experimentMessage"))->text();
    };
    int before = 0;  // runs that have ended
    {
      Studio s(0);
      write(s.window);
      QVERIFY(find(s.window, "experimentContinue")->isHidden());
      QTest::mouseClick(find(s.window, "experimentStart"), Qt::LeftButton);
      QTRY_VERIFY_WITH_TIMEOUT(message(s.window).contains(QStringLiteral("runs/s")), 60'000);
      s.window.close();
      QTRY_VERIFY(questionButton(s.window, "quitNow"));
      const auto* ask = s.window.findChild<QMessageBox*>(QStringLiteral("askToClose"));
      QVERIFY2(ask->text().contains(QStringLiteral("of 100000 runs")), qPrintable(ask->text()));
      before = ask->text().section(QLatin1Char('('), 1).section(QLatin1Char(' '), 0, 0).toInt();
      QVERIFY(before > 0);
      QTest::mouseClick(questionButton(s.window, "quitNow"), Qt::LeftButton);
      QTRY_VERIFY(!s.window.isVisible());
    }
    // The next studio goes on where this one ended.
    Studio s(0);
    write(s.window);
    auto* goOn = find(s.window, "experimentContinue");
    QVERIFY(!goOn->isHidden());
    QTest::mouseClick(goOn, Qt::LeftButton);
    QVERIFY(goOn->isHidden());
    // "12 of 100000 runs, 40 runs/s, ...": more than the first studio had.
    QTRY_VERIFY_WITH_TIMEOUT(message(s.window).contains(QStringLiteral("runs/s")) &&
                                 message(s.window).section(QLatin1Char(' '), 0, 0).toInt() > before,
                             60'000);
    QTest::mouseClick(find(s.window, "experimentStart"), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(message(s.window).startsWith(QStringLiteral("Cancelled: ")), 60'000);
    // Into the same folder, which has more runs now and lacks some still.
    QVERIFY2(message(s.window).endsWith(QStringLiteral("quit-1")), qPrintable(message(s.window)));
    QVERIFY2(message(s.window).section(QLatin1Char(' '), 1, 1).toInt() > before,
             qPrintable(message(s.window)));
    QVERIFY(!goOn->isHidden());
  }

  void aRestartIsRecordedIntoTheNextFile() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->start();
    const QString first = s.window.recording()->path();
    s.window.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&s.window));
    QTest::keySequence(&s.window, s.action("restart")->shortcut());
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, 20'000);
    QCOMPARE(saved.at(0).at(0).toString(), first);
    QVERIFY(s.window.recording()->isRecording());
    const QString second = s.window.recording()->path();
    QVERIFY(second != first);
    QTRY_VERIFY2_WITH_TIMEOUT(s.notice().contains(second) && s.notice().contains(first),
                              qPrintable(s.notice()), 20'000);
    QTRY_VERIFY(s.controller.frame());
    s.controller.runTo(120);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(120), 20'000);
    s.window.recording()->stop();
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 2, 20'000);
    QCOMPARE(saved.at(1).at(0).toString(), second);
    // From the first tick of the new match to its last.
    const auto session = telemetry::SessionReader::open(second.toStdString());
    QVERIFY(session);
    QVERIFY(session->range() && session->range()->begin <= 1.0 / 60);
    QVERIFY(session->range()->end >= 2.0);
    // Without another match it ends.
    s.window.recording()->start();
    s.controller.close();
    QVERIFY(!s.window.recording()->isRecording());
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("ended with the match")),
                 qPrintable(s.notice()));
  }

  void aRecordingThatWasKilledIsOffered() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(120);
    QVERIFY(!path.isEmpty());
    QVERIFY(s.window.recording()->drainLost().isEmpty());  // it ended
    // As a studio leaves it that is killed: a truncated file, and its name in the settings.
    QFile file(path);
    QVERIFY(file.resize(file.size() * 2 / 3));
    s.settings.setValue(QStringLiteral("recordings/999999999"), path);
    s.window.offerLostRecordings();
    QVERIFY2(s.notice().contains(path), qPrintable(s.notice()));
    QPushButton* open = noticeButton(s.window, QStringLiteral("Open in Replay"));
    QVERIFY(open && noticeButton(s.window, QStringLiteral("Repair into a new file")));
    QTest::mouseClick(open, Qt::LeftButton);
    QTRY_COMPARE(s.window.replay()->path(), path);
    QVERIFY(s.window.recording()->drainLost().isEmpty());  // once
    // What a running studio writes is not lost.
    s.window.showSource(SourceKind::Simulate);
    s.window.recording()->start();
    QVERIFY(s.settings.childGroups().contains(QStringLiteral("recordings")));
    s.window.recording()->stop();
    QVERIFY(!s.settings.childGroups().contains(QStringLiteral("recordings")));
  }
};

PITCHBOARD_GUI_TEST(TestNothingLost)

}  // namespace tst_nothing_lost

#include "tst_nothing_lost.moc"

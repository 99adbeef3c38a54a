// SPDX-License-Identifier: GPL-3.0-or-later
// Session files in the studio: broken, damaged, newer, removed, dropped on the window.

#include <QMimeData>
#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>
#include <algorithm>

#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_writer.h>
#include <ui/base/notice_bar.h>
#include <ui/field/field_view.h>
#include <ui/mapping/mapping_dialog.h>
#include <ui/session/session_files.h>
#include <ui/sources/event_list.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "../../support/match_recordings.h"
#include "live_rig.h"
#include "session_rig.h"

namespace tst_session_files {

using namespace pitchboard;
using namespace pitchboard::ui;
using session_rig::closeNotice;
using session_rig::Studio;

class TestSessionFiles : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aRemovedFileStopsTheRecordingAndNotTheMatch() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->start();
    QVERIFY(QFile::remove(s.window.recording()->path()));
    QTRY_VERIFY(!s.window.recording()->isRecording());
    QVERIFY(s.notice().contains(QStringLiteral("Recording stopped")));
    QVERIFY(s.controller.isOpen());
  }

  void filesNeverOverwrite() {
    QTemporaryDir folder;
    const QDateTime when(QDate(2026, 7, 1), QTime(14, 23, 5));
    const QString first = sessionFileName(QDir(folder.path()), QStringLiteral("a/b:c"), when);
    QCOMPARE(QFileInfo(first).fileName(), QStringLiteral("a-b-c 2026-07-01 14.23.05.mcap"));
    QFile file(first);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QVERIFY(sessionFileName(QDir(folder.path()), QStringLiteral("a/b:c"), when) != first);
    const QString title = QStringLiteral("Kick-off: 4 against 4");
    QVERIFY(sessionFileName(QDir(folder.path()), title, when)
                .endsWith(QStringLiteral("/Kick-off 4 against 4 2026-07-01 14.23.05.mcap")));
  }

  void recordingsOfOthersAreImported_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("group");
    QTest::newRow("ROS 2") << QStringLiteral("robot_walks.mcap") << QStringLiteral("B3");
    QTest::newRow("sqlite3") << QStringLiteral("ros2/cdr_test.db3") << QStringLiteral("test_topic");
  }
  void recordingsOfOthersAreImported() {
    QFETCH(QString, file);
    QFETCH(QString, group);
    Studio s(0);
    s.window.openSession(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/recordings/") + file);
    QTRY_VERIFY_WITH_TIMEOUT(s.window.replay()->isOpen(), 20'000);
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("was imported")), qPrintable(s.notice()));
    const bool hasImages = file.startsWith(QStringLiteral("robot"));
    QCOMPARE(s.notice().contains(QStringLiteral("/camera/image")), hasImages);
    const auto groups = s.window.replay()->groups();
    QVERIFY(std::ranges::any_of(groups, [&](const telemetry::GroupInfo& one) {
      return QString::fromStdString(one.name) == group;
    }));
    QCOMPARE(s.window.shown()->source(), static_cast<FrameSource*>(s.window.replay()));
    QVERIFY(s.window.findChild<QObject*>(QStringLiteral("importProgress")) == nullptr);
  }

  void aRecordingThatCannotBeImportedIsANotice() {
    Studio s(0);
    const QString path = s.folder.filePath(QStringLiteral("empty.csv"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("\n\n") == 2);
    file.close();
    s.window.openSession(path);
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("Could not import empty.csv")),
                 qPrintable(s.notice()));
    QVERIFY(!s.window.replay()->isOpen());
  }

  void aFileThatIsNoSessionIsANotice_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("text") << QByteArray("this is no session");
    QTest::newRow("zeros") << QByteArray(5000, '\0');
  }
  void aFileThatIsNoSessionIsANotice() {
    QFETCH(QByteArray, bytes);
    Studio s(0);
    const QString path = s.folder.filePath(QStringLiteral("bad.mcap"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(bytes);
    file.close();
    s.window.openSession(path);
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("Could not open")), qPrintable(s.notice()));
    QVERIFY(!s.window.replay()->isOpen());
  }

  void aBrokenFileIsRepairedFromItsNotice() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(600);
    QVERIFY(!path.isEmpty());
    QFile file(path);
    QVERIFY(file.resize(file.size() * 2 / 3));
    QSignalSpy opened(s.window.replay(), &ReplayController::opened);
    s.window.openSession(path);
    QTRY_COMPARE(opened.size(), 1);
    QVERIFY(s.window.replay()->isBroken());
    // Behind the notice of the recording that was saved.
    const auto repairButton = [&s]() -> QPushButton* {
      for (auto* button : s.window.notices()->findChildren<QPushButton*>()) {
        if (button->text().contains(QStringLiteral("Repair")) && button->isVisible()) return button;
      }
      return nullptr;
    };
    for (int i = 0; i < 5 && repairButton() == nullptr; ++i) closeNotice(s.window);
    QVERIFY2(repairButton() != nullptr, qPrintable(s.notice()));
    QTest::mouseClick(repairButton(), Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(opened.size(), 2, 20'000);
    QVERIFY(!s.window.replay()->isBroken());
    QVERIFY(s.window.replay()->path().contains(QStringLiteral("repaired")));
  }

  void aFileThatIsBeingRecordedIsOpenedAsSuch() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->start();
    const QString path = s.window.recording()->path();
    s.controller.runTo(s.controller.frame()->snapshot.tick + 1200);
    QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(path).size() > 50'000, 20'000);
    while (!s.notice().isEmpty()) closeNotice(s.window);
    QSignalSpy opened(s.window.replay(), &ReplayController::opened);
    s.window.openSession(path);
    QTRY_COMPARE(opened.size(), 1);
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("still being recorded")),
                 qPrintable(s.notice()));
    QVERIFY(!s.window.replay()->isBroken() && s.window.replay()->isGrowing());
    for (auto* button : s.window.notices()->findChildren<QPushButton*>()) {
      QVERIFY(!button->isVisible() || !button->text().contains(QStringLiteral("Repair")));
    }
    QVERIFY(s.window.recording()->isRecording());
  }

  void theNoticeOfAFileIsNotShownWithTheMatch() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QVERIFY(!path.isEmpty());
    while (!s.notice().isEmpty()) closeNotice(s.window);
    QFile file(path);
    QVERIFY(file.resize(file.size() * 2 / 3));
    s.window.openSession(path);
    const auto offers = [&s] {
      return s.notice().contains(QStringLiteral("truncated or damaged"));
    };
    QTRY_VERIFY2(offers(), qPrintable(s.notice()));
    s.window.showSource(SourceKind::Simulate);
    QVERIFY2(!offers(), qPrintable(s.notice()));
    s.window.showSource(SourceKind::Replay);
    QTRY_VERIFY2(offers(), qPrintable(s.notice()));
  }

  /// It neither stays nor comes back when what lies over it is closed.
  void theNoticeOfABrokenFileLeavesWithTheFile() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString good = s.recorded(300);
    QVERIFY(!good.isEmpty());
    const QString broken = s.folder.filePath(QStringLiteral("broken.mcap"));
    QVERIFY(QFile::copy(good, broken));
    QFile file(broken);
    QVERIFY(file.resize(file.size() * 2 / 3));
    while (!s.notice().isEmpty()) closeNotice(s.window);
    QSignalSpy opened(s.window.replay(), &ReplayController::opened);
    s.window.openSession(broken);
    QTRY_COMPARE(opened.size(), 1);
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("truncated")), qPrintable(s.notice()));
    s.window.openSession(s.folder.filePath(QStringLiteral("none.mcap")));
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("none.mcap")), qPrintable(s.notice()));
    s.window.openSession(good);
    QTRY_COMPARE(opened.size(), 2);
    QTRY_VERIFY2(s.notice().isEmpty(), qPrintable(s.notice()));
  }

  void damageInsideIsANotice() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(600);
    QVERIFY(!path.isEmpty());
    {
      const auto session = telemetry::SessionReader::open(path.toStdString());
      QVERIFY(session && session->complete() && session->file().contents().chunks.size() > 2);
      QFile file(path);
      QVERIFY(file.open(QIODevice::ReadWrite));
      const telemetry::McapChunkInfo& chunk = session->file().contents().chunks.back();
      QVERIFY(file.seek(static_cast<qint64>(chunk.offset + chunk.length) - 20));
      QVERIFY(file.write("damage") == 6);
    }
    QSignalSpy found(s.window.replay(), &ReplayController::damageFound);
    s.window.openSession(path);
    QTRY_COMPARE_WITH_TIMEOUT(found.size(), 1, 20'000);
    QVERIFY(!s.window.replay()->isBroken());
    const QString reported = found[0][0].toStringList().join(QLatin1Char(' '));
    QVERIFY2(reported.contains(QStringLiteral(" lost, between ")), qPrintable(reported));
    QPushButton* repair = nullptr;
    const auto looked = [&] {
      for (auto* button : s.window.notices()->findChildren<QPushButton*>()) {
        if (button->text().contains(QStringLiteral("Repair")) && button->isVisible()) {
          repair = button;
        }
      }
      return repair != nullptr;
    };
    for (int i = 0; i < 5 && !looked(); ++i) closeNotice(s.window);
    QVERIFY2(repair != nullptr, qPrintable(s.notice()));
    QVERIFY2(s.notice().contains(QStringLiteral("is damaged")), qPrintable(s.notice()));
    QSignalSpy opened(s.window.replay(), &ReplayController::opened);
    QTest::mouseClick(repair, Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(opened.size(), 1, 20'000);
    QVERIFY(s.window.replay()->path().contains(QStringLiteral("repaired")));
  }

  void aNewerFileIsReportedAndShown() {
    Studio s(0);
    const QString path = s.folder.filePath(QStringLiteral("newer.mcap"));
    {
      using namespace pitchboard::telemetry;
      auto file = McapWriter::create(path.toStdString());
      QVERIFY(file.has_value());
      // The check is a CRC-32 over keys and values, each with its final zero
      // (docs/file-formats.md).
      QVERIFY(file->metadata(
          "pitchboard",
          {{"format", "9"}, {"start_ns", "5000000000"}, {"new", "x"}, {"check", "3914321931"}}));
      McapChunk chunk;
      chunk.add(McapSchema{1, "other/msg/Thing", "ros2msg", "int8 a"});
      chunk.add(McapChannel{1, 1, "/other", "cdr", {}});
      chunk.add(McapChannel{2, 0, "/events", "json", {}});
      chunk.add(McapMessage{1, 0, 6'000'000'000, 6'000'000'000, "abc"});
      chunk.add(McapMessage{2, 0, 6'000'000'000, 6'000'000'000,
                            R"({"time":1,"kind":"goal","later":[]})"});
      QVERIFY(file->writeChunk(chunk));
      QVERIFY(file->finish());
    }
    s.window.openSession(path);
    QTRY_VERIFY(s.window.replay()->isOpen());
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("newer version (format 9")),
                 qPrintable(s.notice()));
    QVERIFY(s.notice().contains(QStringLiteral("/other")));
    QCOMPARE(s.window.shown()->events()->rowCount(), 1);
  }

  void aSessionThatDoesNotFitIsReported() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(600);
    QVERIFY(!path.isEmpty());
    s.window.setMemoryBudget(1);
    QCOMPARE(s.window.memoryBudget(), 1);
    QCOMPARE(s.settings.value(QStringLiteral("session/memoryMegabytes")).toInt(), 1);
    while (!s.notice().isEmpty()) closeNotice(s.window);
    s.window.openSession(path);
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("does not fit into memory (1 MB)")),
                 qPrintable(s.notice()));
    // What is not in memory comes from the file.
    s.window.shown()->seek(10.5);
    QTRY_COMPARE(s.window.replay()->frame()->snapshot.tick, std::uint64_t(630));
  }

  // Robots that came late: what was never there is not missed, what was dropped is.
  void robotsThatCameLateAreNotTakenForRowsThatDoNotFit_data() {
    QTest::addColumn<int>("columns");
    QTest::addColumn<bool>("fits");
    QTest::newRow("all rows fit, and fill more than half of the memory") << 110 << true;
    QTest::newRow("some do not") << 400 << false;
  }
  void robotsThatCameLateAreNotTakenForRowsThatDoNotFit() {
    QFETCH(const int, columns);
    QFETCH(const bool, fits);
    constexpr int rows = 600;
    constexpr double came = 60.0, interval = 1.0 / 60.0;  // s
    Studio s(0);
    const QString path = s.folder.filePath(QStringLiteral("late.mcap"));
    telemetry::SessionInfo info;
    info.program = "test";
    info.source = "simulation";
    auto writer = telemetry::SessionWriter::create(path.toStdString(), info);
    QVERIFY(writer);
    (*writer)->append(telemetry::SessionEvent{0.0, "bookmark", "", "before anybody came"});
    telemetry::GroupInfo group{"B1", {}, {}};
    for (int i = 0; i < columns; ++i) {
      group.columns.push_back({"X" + std::to_string(i),
                               telemetry::ColumnType::Float64,
                               "",
                               "",
                               telemetry::ColumnKind::Number,
                               {}});
    }
    (*writer)->addGroup(group);
    std::vector<double> values(static_cast<std::size_t>(columns));
    for (int i = 0; i < rows; ++i) {
      std::ranges::fill(values, i);
      (*writer)->append(0, {came + i * interval, {}, values});
    }
    QVERIFY((*writer)->finish());
    s.window.setMemoryBudget(1);
    while (!s.notice().isEmpty()) closeNotice(s.window);
    s.window.openSession(path);
    QTRY_VERIFY(s.window.replay()->isOpen() && s.window.replay()->loaded() >= 1.0);
    const auto held = s.window.replay()->series()->range();
    QVERIFY(held);
    QCOMPARE(held->begin < came + interval, fits);
    QCOMPARE(s.notice().contains(QStringLiteral("does not fit into memory (1 MB)")), !fits);
  }

  void aDroppedFileOpens() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(60);
    QSignalSpy opened(s.window.replay(), &ReplayController::opened);
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&s.window, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&s.window, &drop);
    QTRY_COMPARE(opened.size(), 1);
  }

  /// The referee's log and a robot's table: both are in the dialog that puts them on one clock.
  void droppedRecordingsOfAMatchAreMapped() {
    Studio s(0);
    const QTemporaryDir folder;
    const QString log = folder.filePath(QStringLiteral("log.yaml"));
    const QString robot = folder.filePath(QStringLiteral("robot3.csv"));
    match_recordings::writeRefereeLog(log.toStdString(), {{1.0, 2, 0}, {20.0, 3, 0}});
    match_recordings::writeRobotTable(robot.toStdString(), 5.0, 9.0, {{5.0, 2, 0}, {7.0, 3, 0}});
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(log), QUrl::fromLocalFile(robot)});
    QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&s.window, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&s.window, &drop);
    auto* dialog = s.window.findChild<MappingDialog*>();
    QVERIFY(drop.isAccepted() && dialog != nullptr);
    auto* times = dialog->findChild<QTableWidget*>(QStringLiteral("mappingTimes"));
    QTRY_VERIFY(dialog->isUpToDate() && times->rowCount() == 2);
    QCOMPARE(times->item(0, 0)->text(), QStringLiteral("log.yaml"));
    QCOMPARE(times->item(1, 0)->text(), QStringLiteral("robot3.csv"));
    dialog->reject();
  }
};

PITCHBOARD_GUI_TEST(TestSessionFiles)

}  // namespace tst_session_files

#include "tst_session_files.moc"

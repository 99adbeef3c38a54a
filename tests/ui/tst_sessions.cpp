// SPDX-License-Identifier: GPL-3.0-or-later
// Recording, looking back and replay in the window: real files of a real match.
#include <QGraphicsView>
#include <QMenu>
#include <QMimeData>
#include <QSettings>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QToolBar>
#include <QToolButton>
#include <QtTest>

#include <field/compared_item.h>
#include <session/compared_session.h>
#include <session/session_files.h>
#include <session/session_recording.h>
#include <shell/notice_bar.h>
#include <telemetry/session_reader.h>
#include <timeline/playback.h>
#include <timeline/timeline.h>
#include <timeline/timeline_strip.h>
#include <ui/field_view.h>
#include <ui/main_window.h>
#include <ui/match_controller.h>
#include <ui/replay_controller.h>
#include <ui/scenario_files.h>

using namespace pitchboard;
using namespace pitchboard::ui;

class TestSessions : public QObject {
  Q_OBJECT

  struct Studio {
    QTemporaryDir folder;
    QSettings settings{folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat};
    MatchController controller;
    MainWindow window;
    explicit Studio(std::uint64_t playTo = 600)
        : controller(options()), window(&controller, &settings) {
      window.recording()->setFolder(folder.filePath(QStringLiteral("new/recordings")));
      window.resize(1280, 800);
      window.show();
      if (playTo == 0) return;
      controller.open(link::loadScenario("match-3v3").value(), true);
      controller.runTo(playTo);
    }
    static link::MatchOptions options() {
      link::MatchOptions made;
      made.cognition = link::Cognition::Inline;
      return made;
    }
    bool played(std::uint64_t tick) const {
      return controller.frame() && controller.frame()->snapshot.tick >= tick;
    }
    QToolButton* record() const {
      return window.findChild<QToolButton*>(QStringLiteral("record"));
    }
    QAction* action(const char* name) const {
      return window.findChild<QAction*>(QLatin1String(name));
    }
    QString notice() const { return window.notices()->text(); }
    /// Records the next `ticks` of the match, with a bookmark; the file.
    QString recorded(std::uint64_t ticks) {
      QSignalSpy saved(window.recording(), &SessionRecording::saved);
      QTest::mouseClick(record(), Qt::LeftButton, {}, {8, 8});
      const std::uint64_t to = controller.frame()->snapshot.tick + ticks;
      controller.runTo(to);
      if (!QTest::qWaitFor([this, to] { return played(to); }, 20'000)) return {};
      window.timeline()->addBookmark(QStringLiteral("recorded"));
      QTest::mouseClick(record(), Qt::LeftButton, {}, {8, 8});
      if (!QTest::qWaitFor([&saved] { return saved.size() == 1; }, 20'000)) return {};
      return saved.at(0).at(0).toString();
    }
  };

  static int ghostsOf(FieldView* field) {
    const auto* view = field->findChild<QGraphicsView*>();
    for (QGraphicsItem* item : view->scene()->items()) {
      if (const auto* compared = dynamic_cast<ComparedItem*>(item)) return compared->robots();
    }
    return -1;
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void lookingBackShowsWhatWas() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    Timeline* timeline = s.window.timeline();
    const FramePtr now = s.controller.frame();
    timeline->seek(2.0);
    QVERIFY(timeline->isLookingBack());
    const FramePtr past = s.window.field() ? s.controller.frameAt(2.0) : nullptr;
    QVERIFY(past);
    QCOMPARE(past->snapshot.tick, std::uint64_t(120));
    QCOMPARE(past->snapshot.robots.size(), std::size_t(6));
    QVERIFY(!(past->snapshot.robots[0].pose.position == now->snapshot.robots[0].pose.position));
    auto* sign = s.window.findChild<QWidget*>(QStringLiteral("lookingBack"));
    QVERIFY(sign->isVisible());
    // The buttons of the tool bar play the past; the match stays where it is.
    s.action("step")->trigger();
    QCOMPARE(timeline->shownTime(), 121.0 / 60);
    QCOMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(600));
    // Nothing can be moved there.
    s.window.field()->setFocus();
    s.window.field()->select({RobotId{1}});
    QTest::keyClick(s.window.field()->focusProxy(), Qt::Key_Delete);
    QTest::qWait(50);
    QCOMPARE(s.controller.frame()->snapshot.robots.size(), std::size_t(6));
    timeline->goLive();
    QVERIFY(!sign->isVisible());
  }

  void theMatchGoesOnFromAnEarlierMoment() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const std::uint64_t end = s.controller.stateHash();
    s.window.timeline()->seek(5.0);
    QVERIFY(s.action("continueFromHere")->isEnabled());
    s.action("continueFromHere")->trigger();
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(300));
    QVERIFY2(s.notice().isEmpty(), qPrintable(s.notice()));
    QVERIFY(!s.window.timeline()->isLookingBack());
    s.controller.stepOnce();
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(301));
    QVERIFY(s.controller.stateHash() != end);
  }

  void aSimulationBeginsFromThePast() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.timeline()->seek(4.0);
    const Point ball = s.controller.frameAt(4.0)->snapshot.ball;
    s.action("simulateTrue")->trigger();
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick < 600);
    const link::Scenario& scenario = s.controller.scenario();
    QCOMPARE(scenario.robots.size(), std::size_t(6));
    QVERIFY(std::abs(scenario.ball.x - ball.x) < 1e-9);
  }

  void recordWritesAFileThatReplays() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QVERIFY(QFile::exists(path));
    QVERIFY(path.startsWith(s.folder.filePath(QStringLiteral("new/recordings"))));
    const double lastX = s.controller.frame()->snapshot.robots[0].pose.position.x;
    QSignalSpy opened(s.window.replay(), &ReplayController::opened);
    QElapsedTimer clock;
    clock.start();
    s.window.openSession(path);
    QTRY_COMPARE(opened.size(), 1);
    QVERIFY2(clock.elapsed() < 1000, qPrintable(QString::number(clock.elapsed())));
    Timeline* timeline = s.window.timeline();
    QVERIFY(timeline->isRecording());
    QVERIFY(std::abs(timeline->available()->begin - 10.0) < 0.1);
    QVERIFY(std::abs(timeline->available()->end - 15.0) < 0.1);
    // The last moment is the match's.
    timeline->seek(timeline->available()->end);
    QTRY_COMPARE(s.window.replay()->frame()->snapshot.tick, std::uint64_t(900));
    QVERIFY(std::abs(s.window.replay()->frame()->snapshot.robots[0].pose.position.x - lastX) < 1e-9);
    QTRY_COMPARE(s.window.replay()->loaded(), 1.0);
    QVERIFY(s.window.replay()->series()->range());
    // It plays with the tool bar's buttons.
    s.action("restart")->trigger();
    s.action("play")->trigger();
    QVERIFY(!timeline->playback()->isPaused());
    QTRY_VERIFY(timeline->shownTime() > 10.2);
    s.action("play")->trigger();
    // From here a simulation begins.
    s.action("simulateTrue")->trigger();
    QTRY_VERIFY(s.controller.frame());
    QCOMPARE(s.controller.scenario().robots.size(), std::size_t(6));
    QVERIFY(!timeline->isRecording());
  }

  void bookmarksAreRecorded() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY(s.window.recording()->isRecording());
    s.controller.stepOnce();
    QTRY_VERIFY(s.played(601));
    s.window.timeline()->addBookmark(QStringLiteral("here"));
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->stop();
    QTRY_COMPARE(saved.size(), 1);
    const auto session =
        telemetry::SessionReader::open(saved.at(0).at(0).toString().toStdString());
    QVERIFY(session);
    bool found = false;
    for (const auto& event : session->events()) {
      found = found || (event.kind == "bookmark" && event.text == "here");
    }
    QVERIFY(found);
  }

  void theRecentPastIsSaved() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->saveLast(3);
    QTRY_VERIFY2(saved.size() == 1, qPrintable(s.notice()));
    const auto session =
        telemetry::SessionReader::open(saved.at(0).at(0).toString().toStdString());
    QVERIFY(session && session->range());
    QVERIFY(std::abs(session->range()->end - 10.0) < 0.1);
    QVERIFY(session->range()->begin >= 5.9);
  }

  void aRecordingEndsWithItsMatch() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->start();
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.controller.restart();
    QVERIFY(!s.window.recording()->isRecording());
    QTRY_COMPARE(saved.size(), 1);
  }

  void aFolderThatCannotBeMadeIsANotice() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->setFolder(QStringLiteral("/proc/nowhere"));
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY(!s.window.recording()->isRecording());
    QVERIFY2(s.notice().contains(QStringLiteral("/proc/nowhere")), qPrintable(s.notice()));
  }

  void aRemovedFileStopsTheRecordingAndNotTheMatch() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->start();
    QVERIFY(QFile::remove(s.window.recording()->path()));
    QTRY_VERIFY(!s.window.recording()->isRecording());
    QVERIFY(s.notice().contains(QStringLiteral("Recording has stopped")));
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
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("not opened")), qPrintable(s.notice()));
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
    QVERIFY(s.window.notices()->waiting() >= 1);
    s.window.sessions()->repair(path);
    QTRY_COMPARE_WITH_TIMEOUT(opened.size(), 2, 20'000);
    QVERIFY(!s.window.replay()->isBroken());
    QVERIFY(s.window.replay()->path().contains(QStringLiteral("repaired")));
  }

  void aSecondSessionIsCompared() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QVERIFY(!path.isEmpty());
    ComparedSession* compared = s.window.compared();
    auto* strip = s.window.findChild<TimelineStrip*>();
    QVERIFY(!s.action("stopComparing")->isEnabled());
    const auto ghosts = [&s] { return ghostsOf(s.window.field()); };
    QSignalSpy changed(compared, &ComparedSession::changed);
    // In Simulate: the match has gone on to where the session begins, and on.
    compared->open(path);
    QTRY_COMPARE(changed.size(), 1);
    QVERIFY(!s.window.timeline()->isRecording());
    QVERIFY(strip->comparedRect().isValid());
    s.window.timeline()->seek(12.0);
    QTRY_COMPARE(ghosts(), 6);
    s.window.timeline()->seek(2.0);
    QTRY_COMPARE(ghosts(), 0);
    // By events: what stands at 11 s there stands at 3 s here.
    compared->alignThere(11.0);
    QCOMPARE(compared->offset(), 0.0);
    compared->alignHere(3.0);
    QCOMPARE(compared->offset(), -8.0);
    QVERIFY2(compared->caption().contains(QStringLiteral("8.00 s")), qPrintable(compared->caption()));
    QTRY_COMPARE(ghosts(), 6);
    // In Replay, of itself: ghosts stand where the robots stand.
    compared->alignByTime();
    s.window.openSession(path);
    QTRY_VERIFY(s.window.timeline()->isRecording());
    s.window.timeline()->seek(11.0);
    QTRY_COMPARE(ghosts(), 6);
    // In Live there is nothing at these times; nothing breaks.
    s.window.showSource(SourceKind::Live);
    QVERIFY(compared->isOn());
    s.window.showSource(SourceKind::Replay);
    QVERIFY(s.action("stopComparing")->isEnabled());
    s.action("stopComparing")->trigger();
    QCOMPARE(ghosts(), 0);
    QVERIFY(!compared->isOn());
    QVERIFY(!strip->comparedRect().isValid());
  }

  void eventsOfTheTimelineAreAlignedFromItsMenu() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QSignalSpy changed(s.window.compared(), &ComparedSession::changed);
    s.window.compared()->open(path);
    QTRY_COMPARE(changed.size(), 1);
    s.window.timeline()->seek(2.0);
    s.window.timeline()->addBookmark(QStringLiteral("mine"));
    auto* strip = s.window.findChild<TimelineStrip*>();
    const auto align = [&](QPoint at) {
      bool found = false;
      QTimer::singleShot(0, &s.window, [&found] {
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        if (menu == nullptr) return;
        if (auto* action = menu->findChild<QAction*>(QStringLiteral("alignHere"))) {
          found = true;
          action->trigger();
        }
        menu->close();
      });
      QContextMenuEvent event(QContextMenuEvent::Mouse, at, strip->mapToGlobal(at));
      QApplication::sendEvent(strip, &event);
      return found;
    };
    QVERIFY(align({qRound(strip->axis().pixel(2.0)), 13}));
    QVERIFY(s.window.compared()->here());
    const double here = *s.window.compared()->here();
    const auto theirs = strip->comparedMarks();
    QVERIFY(!theirs.empty());
    QVERIFY(align({qRound(theirs.front().x), strip->comparedRect().center().y()}));
    QVERIFY(s.window.compared()->there());
    QCOMPARE(s.window.compared()->offset(), here - *s.window.compared()->there());
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
};

QTEST_MAIN(TestSessions)
#include "tst_sessions.moc"

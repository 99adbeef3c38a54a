// SPDX-License-Identifier: GPL-3.0-or-later
// Recording, looking back and replay in the window: real files of a real match.

#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QTableView>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>

#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/experiment/run_player.h>
#include <robotlink/live/live_state.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/state_archive.h>
#include <simcore/rules/game_start.h>
#include <telemetry/formats/text_protocol.h>
#include <telemetry/session/session_reader.h>
#include <ui/base/notice_bar.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/robots/robot_card.h>
#include <ui/session/session_files.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/event_list.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "../support/robot_keys.h"
#include "chart_pane.h"
#include "live_rig.h"
#include "log_model.h"
#include "session_rig.h"
#include "timeline_strip.h"

namespace tst_sessions {

using namespace pitchboard;
using namespace pitchboard::ui;
using session_rig::closeNotice;
using session_rig::Studio;

class TestSessions : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aRunThatIsNotRepeatableIsMarked() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString recorded = s.recorded(60);
    QVERIFY(!recorded.isEmpty());
    const auto* status = s.window.findChild<QLabel*>(QStringLiteral("statusProcesses"));
    s.window.openSession(recorded);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    QCOMPARE(status->text(), QString());
    // The same file as a run of an experiment.
    const QString folder = s.folder.filePath(QStringLiteral("results"));
    const auto experiment = link::loadExperiment("paper-scenario-1");
    QVERIFY(experiment);
    auto results = link::ExperimentFolder::begin(folder.toStdString(), *experiment, false);
    auto player = link::RunPlayer::create(*experiment, {});
    QVERIFY(results && player);
    for (const bool repeatable : {true, false}) {
      const std::size_t number = repeatable ? 1 : 2;
      auto result = player->play(number);
      QVERIFY(result);
      result->match.repeatable = repeatable;
      QVERIFY(results->add(*result));
      const auto path = QString::fromStdString(link::sessionPath(folder.toStdString(), number));
      QVERIFY(QDir().mkpath(QFileInfo(path).path()) && QFile::copy(recorded, path));
      s.window.openSession(path);
      QTRY_COMPARE(s.window.replay()->path(), path);
      QTRY_COMPARE(status->text(),
                   repeatable ? QString() : QStringLiteral("Run is not repeatable"));
      QCOMPARE(status->isVisible(), !repeatable);
    }
  }

  void lookingBackShowsWhatWas() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    ShownMoment* timeline = s.window.shown();
    const FramePtr now = s.controller.frame();
    timeline->seek(2.0);
    QVERIFY(timeline->isLookingBack());
    const FramePtr past = s.window.field() ? s.controller.frameAt(2.0) : nullptr;
    QVERIFY(past);
    QCOMPARE(past->snapshot.tick, std::uint64_t(120));
    QCOMPARE(past->robots.size(), std::size_t(6));
    QVERIFY(!(past->robots[0].pose.position == now->robots[0].pose.position));
    // The same moment looks the same from later on: lamps, too.
    const FramePtr same = s.controller.frameAt(now->snapshot.time);
    QVERIFY(same);
    for (std::size_t i = 0; i < now->robots.size(); ++i) {
      for (std::size_t lamp = 0; lamp < telemetry::processCount; ++lamp) {
        QCOMPARE(same->robots[i].lamps[lamp].state, now->robots[i].lamps[lamp].state);
        QCOMPARE(now->robots[i].lamps[lamp].state, telemetry::HeartbeatState::Working);
      }
    }
    auto* sign = s.window.findChild<QWidget*>(QStringLiteral("lookingBack"));
    QVERIFY(sign->isVisible());
    // The buttons of the tool bar play the past; the match stays where it is.
    s.action("step")->trigger();
    QCOMPARE(timeline->time(), 121.0 / 60);
    QCOMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(600));
    // Nothing can be moved there.
    s.window.field()->setFocus();
    s.window.field()->select({inSlot(1)});
    QTest::keyClick(s.window.field()->focusProxy(), Qt::Key_Delete);
    // Asked of the match itself, behind whatever the key may have told it to do.
    QCOMPARE(s.controller.currentMoment().robots.size(), std::size_t(6));
    timeline->goLive();
    QVERIFY(!sign->isVisible());
  }

  void theMatchGoesOnFromAnEarlierMoment() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const std::uint64_t end = s.controller.stateHash();
    s.window.shown()->seek(5.0);
    QVERIFY(s.action("continueFromHere")->isEnabled());
    s.action("continueFromHere")->trigger();
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(300));
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("abandoned future")), qPrintable(s.notice()));
    QVERIFY(!s.window.shown()->isLookingBack());
    s.controller.stepOnce();
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(301));
    QVERIFY(s.controller.stateHash() != end);
  }

  void theContinuedMomentIsUnchanged() {
    Studio s(300);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(300), 20'000);
    const std::uint64_t then = s.controller.stateHash();
    s.controller.runTo(500);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(500), 20'000);
    s.window.shown()->seek(5.0);
    s.action("continueFromHere")->trigger();
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, std::uint64_t(300));
    QCOMPARE(s.controller.stateHash(), then);
  }

  /// What came after that moment has not happened, wherever it was remembered.
  void theAbandonedFutureEndsAtTheContinuedMoment() {
    Studio s(0);
    s.controller.open(link::loadScenario("match").value(), true);
    constexpr std::uint64_t end = 960;
    s.controller.runTo(900);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(900), 30'000);
    // Its rows go on to the end; at the moment there is no such robot.
    s.controller.edits()->addRobot(TeamColor::Red, {{0.5, 2.0}, {}});
    s.controller.runTo(end);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(end), 30'000);
    ShownMoment* timeline = s.window.shown();
    auto* plots = s.window.findChild<PlotsDock*>();
    auto* log = s.window.findChild<LogModel*>();
    auto* refereeLog = s.window.findChild<QTableView*>(QStringLiteral("refereeLog"));
    QVERIFY(plots && log && refereeLog);
    const auto refereeSaid = [refereeLog] {
      QStringList lines;
      for (int row = 0; row < refereeLog->model()->rowCount(); ++row) {
        lines << refereeLog->model()->index(row, 1).data().toString();
      }
      return lines.join(QLatin1Char('\n'));
    };
    const auto newestLine = [log] {
      double newest = -1.0;
      for (int row = 0; row < log->rowCount(); ++row) {
        newest = std::max(newest, log->index(row, 0).data(LogModel::timeRole).toDouble());
      }
      return newest;
    };
    plots->plotVariables({QStringLiteral("B1/TRUE_X")});
    plots->time()->setRange({12.0, 16.0});
    plots->time()->showMarks(true);
    timeline->setSelection(telemetry::TimeRange{11.0, 15.0});
    timeline->addBookmark(QStringLiteral("in the future"));
    QTRY_VERIFY2(newestLine() > 9.0, qPrintable(QString::number(newestLine())));
    QTRY_VERIFY2(refereeSaid().contains(QStringLiteral("READY")), qPrintable(refereeSaid()));

    auto* strip = s.window.findChild<TimelineStrip*>();
    QTest::mouseClick(strip, Qt::LeftButton, {},
                      {qRound(strip->axis().pixel(5.0)), strip->bandRect().center().y()});
    QTRY_VERIFY(timeline->isLookingBack());
    const double moment = timeline->time();
    QVERIFY(std::abs(moment - 5.0) < 0.5);
    QSignalSpy rewound(&s.controller, &FrameSource::rewound);
    s.action("continueFromHere")->trigger();
    QTRY_COMPARE(rewound.size(), 1);
    QVERIFY2(s.notice().contains(QStringLiteral("abandoned future")), qPrintable(s.notice()));
    constexpr double half = 0.5 / 60;
    const auto tick = static_cast<std::uint64_t>(std::llround(moment * 60));
    QTRY_COMPARE(s.controller.frame()->snapshot.tick, tick);
    const auto rows = s.controller.series();
    for (telemetry::GroupId id = 0; id < rows->groups(); ++id) {
      const auto range = rows->view(id)->range();
      QVERIFY2(!range || range->end < moment + half, rows->view(id)->info().name.c_str());
    }
    QCOMPARE(s.controller.memory()->archive()->range()->last, tick);
    for (const link::MatchEvent& event : timeline->events()->events()) {
      QVERIFY(event.time < moment + half);
    }
    QVERIFY2(newestLine() < moment + half, qPrintable(QString::number(newestLine())));
    QVERIFY2(!refereeSaid().contains(QStringLiteral("READY")), qPrintable(refereeSaid()));
    QVERIFY(!timeline->isLookingBack() && !timeline->selection());
    QVERIFY(!plots->time()->shown()->hasMarks());
    const auto* memory = s.window.findChild<QLabel*>(QStringLiteral("statusRecording"));
    QTRY_VERIFY2(memory->text().contains(QStringLiteral("00:05")) ||
                     memory->text().contains(QStringLiteral("00:04")),
                 qPrintable(memory->text()));

    // The match that goes on is plotted and remembered.
    s.controller.runTo(tick + 180);
    QTRY_COMPARE_WITH_TIMEOUT(s.controller.frame()->snapshot.tick, tick + 180, 30'000);
    const double now = static_cast<double>(tick + 180) / 60;
    QTRY_VERIFY(plots->time()->data() && std::abs(plots->time()->data()->end - now) < half);
    QVERIFY(plots->time()->range().begin <= now && plots->time()->range().end >= now);
    const auto* chart = plots->findChild<ChartPane*>();
    const auto plotted = [&] {
      const auto& traces = chart->traces();
      return !traces.empty() && traces.back().exact && !traces.back().samples.empty() &&
             std::abs(traces.back().samples.back().time - now) < half;
    };
    QTRY_VERIFY(plotted());
    QVERIFY2(memory->text().contains(QStringLiteral("00:0")), qPrintable(memory->text()));
  }

  void aSimulationBeginsFromThePast() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.shown()->seek(4.0);
    const Point ball = s.controller.frameAt(4.0)->snapshot.ball;
    s.action("simulateTrue")->trigger();
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick < 600);
    const link::Scenario& scenario = s.controller.scenario();
    QCOMPARE(scenario.robots.size(), std::size_t(6));
    QVERIFY(std::abs(scenario.ball.x - ball.x) < 1e-9);
  }

  /// To the tick: now, looking back, and of a recording.
  void aSimulationFromHereKeepsTheGame() {
    Studio s(0);
    const link::Scenario scenario = link::loadScenario("match").value();
    s.controller.open(scenario, true);
    constexpr std::uint64_t end = 2400;
    s.controller.runTo(end);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(end), 60'000);
    const QString session = s.recorded(60);
    QVERIFY(!session.isEmpty());
    const auto archive = s.controller.memory()->archive();
    const auto gameAt = [&](std::uint64_t tick) {
      return sim::gameStartOf(archive->restore(tick).value());
    };
    const sim::GameStart early = gameAt(300), late = gameAt(2430), last = gameAt(end + 60);
    QVERIFY(early != late && late.state != PlayState::Initial);
    const auto beginsWith = [&](const sim::GameStart& game) {
      s.action("simulateTrue")->trigger();
      return QTest::qWaitFor([&] { return s.controller.scenario().game == game; });
    };
    const auto again = [&] {
      s.controller.open(scenario, true);
      s.controller.runTo(end + 60);
      return QTest::qWaitFor([&] { return s.played(end + 60); }, 60'000);
    };
    QVERIFY(beginsWith(last));
    QVERIFY(again());
    s.window.shown()->seek(5.0);
    QVERIFY(beginsWith(early));
    s.window.openSession(session);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    s.window.shown()->seek(2430.0 / 60);
    QTRY_VERIFY(s.window.replay()->frame() &&
                s.window.replay()->frame()->snapshot.tick == std::uint64_t(2430));
    QVERIFY(beginsWith(late));
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->game);
    QCOMPARE(s.controller.scenario().settings.referee->name, std::string("humanoid-2021"));
  }

  /// A recording of Live begins with the message of one robot.
  void aLiveSessionOpensWhereAllAreSeen() {
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("live.mcap"));
    const link::LiveOptions options;
    const telemetry::WallTime zero = std::chrono::system_clock::now();
    auto recorder = link::LiveRecorder::create(path.toStdString(), options, zero).value();
    recorder->remembered(0.5, link::LiveState(options).text(options, 0.5, zero));
    const auto send = [&](double time, int port, std::string_view payload) {
      const telemetry::Duration after(static_cast<std::int64_t>(time * 1e9));
      const auto from = static_cast<std::uint16_t>(4000 + port);
      const telemetry::DatagramView datagram{
          zero + after, {{0x7f000001}, from}, static_cast<std::uint16_t>(port), false, payload};
      const auto packet = telemetry::decodeReferee(payload);
      const bool isReferee = port == options.refereePort;
      recorder->received(
          {.time = time, .view = datagram, .teams = {}, .referee = isReferee ? &packet : nullptr});
    };
    for (int robot = 1; robot <= 10; ++robot) {
      telemetry::TextMessage message = live_rig::message(robot);
      send(1.0 + 0.1 * robot, options.portBase + robot, telemetry::encode(message));
    }
    QFile packet(QStringLiteral(PITCHBOARD_TEST_DATA "/gamecontroller/v12hl688_READY.bin"));
    QVERIFY(packet.open(QIODevice::ReadOnly));
    send(2.4, options.refereePort, packet.readAll().toStdString());
    send(9.0, options.portBase + 1, telemetry::encode(live_rig::message(1)));
    QVERIFY(recorder->finish());

    ReplayController replay;
    std::vector<FramePtr> frames;
    connect(&replay, &ReplayController::frameReceived, this,
            [&](const FramePtr& frame) { frames.push_back(frame); });
    replay.open(path);
    QTRY_VERIFY(!frames.empty());
    for (const FramePtr& frame : frames) {
      QCOMPARE(frame->robots.size(), std::size_t(10));
      QVERIFY(frame->game);
      QVERIFY(frame->snapshot.time < 3.0);
    }
  }

  void recordWritesAFileThatReplays() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    QVERIFY(QFile::exists(path));
    QVERIFY(path.startsWith(s.folder.filePath(QStringLiteral("new/recordings"))));
    const double lastX = s.controller.frame()->robots[0].pose.position.x;
    QSignalSpy opened(s.window.replay(), &ReplayController::opened);
    s.window.openSession(path);
    QTRY_COMPARE(opened.size(), 1);
    ShownMoment* timeline = s.window.shown();
    QVERIFY(!timeline->kind().hasPresent);
    QVERIFY(std::abs(timeline->available()->begin - 10.0) < 0.1);
    QVERIFY(std::abs(timeline->available()->end - 15.0) < 0.1);
    // The last moment is the match's.
    timeline->seek(timeline->available()->end);
    QTRY_COMPARE(s.window.replay()->frame()->snapshot.tick, std::uint64_t(900));
    QVERIFY(std::abs(s.window.replay()->frame()->robots[0].pose.position.x - lastX) < 1e-9);
    QTRY_COMPARE(s.window.replay()->loaded(), 1.0);
    QVERIFY(s.window.replay()->series()->range());
    // It plays with the tool bar's buttons.
    s.action("restart")->trigger();
    s.action("play")->trigger();
    QVERIFY(!timeline->isPaused());
    QTRY_VERIFY(timeline->time() > 10.2);
    s.action("play")->trigger();
    // From here a simulation begins.
    s.action("simulateTrue")->trigger();
    QTRY_VERIFY(s.controller.frame());
    QCOMPARE(s.controller.scenario().robots.size(), std::size_t(6));
    QVERIFY(timeline->kind().hasPresent);
  }

  void bookmarksAreRecorded() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY(s.window.recording()->isRecording());
    s.controller.stepOnce();
    QTRY_VERIFY(s.played(601));
    s.window.shown()->addBookmark(QStringLiteral("here"));
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->stop();
    QTRY_COMPARE(saved.size(), 1);
    const auto session = telemetry::SessionReader::open(saved.at(0).at(0).toString().toStdString());
    QVERIFY(session);
    bool found = false;
    for (const auto& event : session->events()) {
      found = found || (event.kind == "bookmark" && event.text == "here");
    }
    QVERIFY(found);
  }

  void bookmarksOfAReplayAreKept() {
    QString path;
    const QString note = QStringLiteral("goalkeeper asleep");
    QTemporaryDir kept;
    const auto notes = [](Studio& s) {
      QStringList found;
      for (const link::MatchEvent& event : s.window.shown()->events()->events()) {
        if (event.kind == link::MatchEventKind::Bookmark) {
          found << QString::fromStdString(event.detail);
        }
      }
      return found;
    };
    const auto open = [&path](Studio& s) {
      s.window.openSession(path);
      return QTest::qWaitFor([&s] { return !s.window.shown()->kind().hasPresent; }, 20'000);
    };
    {
      Studio s;
      QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
      path = kept.filePath(QStringLiteral("match.mcap"));
      QVERIFY(QFile::copy(s.recorded(120), path));
      QVERIFY(open(s));
      s.window.shown()->seek(s.window.shown()->available()->begin + 1.0);
      // As a person does it: M, the note, Enter.
      QTest::keyClick(&s.window, Qt::Key_M);
      auto* edit = s.window.findChild<QLineEdit*>(QStringLiteral("bookmarkNote"));
      QVERIFY(edit);
      QTest::keyClicks(edit, note);
      QTest::keyClick(edit, Qt::Key_Return);
      QCOMPARE(notes(s), (QStringList{note, QStringLiteral("recorded")}));
      QVERIFY2(!s.notice().contains(QStringLiteral("bookmark")), qPrintable(s.notice()));
    }
    {
      Studio s(0);
      QVERIFY(open(s));
      QCOMPARE(notes(s), (QStringList{note, QStringLiteral("recorded")}));
      // The file cannot be written: it says so at once.
      const QString file = path + QStringLiteral(".notes.json");
      QVERIFY(QFile::remove(file) && QDir().mkpath(file));
      s.window.shown()->addBookmark();
      QVERIFY2(s.notice().contains(QStringLiteral("The bookmark will be lost")),
               qPrintable(s.notice()));
    }
  }

  /// After a jump every card said "C no reply" in red, and "paused" while the recording was played.
  void aReplayAccusesNobody() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const QString path = s.recorded(300);
    s.window.openSession(path);
    ShownMoment* timeline = s.window.shown();
    QTRY_VERIFY(!timeline->kind().hasPresent);
    QTRY_COMPARE(s.window.replay()->loaded(), 1.0);
    const auto look = [&](double time) {
      timeline->seek(time);
      if (!QTest::qWaitFor(
              [&] { return std::abs(s.window.replay()->frame()->snapshot.time - time) < 0.02; })) {
        return false;
      }
      return std::ranges::none_of(s.window.replay()->frame()->robots, [](const auto& robot) {
        return std::ranges::any_of(robot.lamps, [](const telemetry::ProcessHeartbeat& lamp) {
          return lamp.state == telemetry::HeartbeatState::NotResponding;
        });
      });
    };
    const double begin = timeline->available()->begin;
    for (const double after : {0.5, 1.0, 1.4, 1.8, 2.2, 2.6, 3.0, 3.4}) {
      QVERIFY2(look(begin + after), qPrintable(QString::number(after)));
    }
    QVERIFY(look(begin + 1.5));
    const auto cards = s.window.findChildren<RobotCard*>();
    QCOMPARE(cards.size(), 6);
    s.action("play")->trigger();
    QTRY_VERIFY(timeline->time() > begin + 2.0);
    // The distance walked, and no state before it.
    for (const RobotCard* card : cards) {
      const QString detail = card->state().detail;
      QVERIFY2(
          !detail.contains(QStringLiteral("paused")) && !detail.contains(QStringLiteral(" · ")),
          qPrintable(detail));
    }
  }

  void theRecentPastIsSaved() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->saveLast(3);
    QTRY_VERIFY2(saved.size() == 1, qPrintable(s.notice()));
    const auto session = telemetry::SessionReader::open(saved.at(0).at(0).toString().toStdString());
    QVERIFY(session && session->range());
    QVERIFY(std::abs(session->range()->end - 10.0) < 0.1);
    QVERIFY(session->range()->begin >= 5.9);
  }

  void aRecordingEndsWithItsMatch() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->start();
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    const QString first = s.window.recording()->path();
    s.controller.restart();
    QTRY_COMPARE(saved.size(), 1);
    QCOMPARE(saved.at(0).at(0).toString(), first);
    // The next match has a file of its own.
    QVERIFY(s.window.recording()->isRecording());
    QVERIFY(s.window.recording()->path() != first);
  }

  void aFolderThatCannotBeMadeIsANotice() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    s.window.recording()->setFolder(QStringLiteral("/proc/nowhere"));
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY(!s.window.recording()->isRecording());
    QVERIFY2(s.notice().contains(QStringLiteral("/proc/nowhere")), qPrintable(s.notice()));
    // Once it records there is nothing to complain about.
    s.window.recording()->setFolder(s.folder.filePath(QStringLiteral("good")));
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY(s.window.recording()->isRecording());
    QVERIFY2(s.notice().isEmpty(), qPrintable(s.notice()));
  }

  void freeDiskSpaceIsShownAndItsEndIsReportedInTime() {
    Studio s;
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    std::atomic<std::uint64_t> free = 52'300'000'000;
    telemetry::SessionWriterOptions writing;
    writing.freeSpace = [&free] { return std::optional<std::uint64_t>(free.load()); };
    s.window.recording()->setWriting(writing);
    s.window.recording()->start();
    const auto* label = s.window.findChild<QLabel*>(QStringLiteral("statusRecording"));
    QTRY_VERIFY2(label->text().contains(QStringLiteral("52.3 GB free")), qPrintable(label->text()));
    QTRY_VERIFY(s.record()->toolTip().contains(s.window.recording()->path()));
    QVERIFY2(s.notice().isEmpty(), qPrintable(s.notice()));
    free = 20'000'000;
    QTRY_VERIFY2(s.notice().contains(QStringLiteral("The disk is nearly full (20 MB free)")),
                 qPrintable(s.notice()));
    QTRY_VERIFY(label->toolTip().contains(QStringLiteral("nearly full")));
    QVERIFY(s.window.recording()->isRecording());
    s.window.recording()->end();
  }

  void theWindowGoesWithEverythingOpen() {
    QTemporaryDir files;
    const QString path = files.filePath(QStringLiteral("all.mcap"));
    {
      Studio s;
      QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
      const QString earlier = s.recorded(60);
      s.window.compared()->open({earlier, earlier});
      QTRY_COMPARE(s.window.compared()->all().size(), 2U);
      s.window.recordInto(path);
      QVERIFY(s.window.recording()->isRecording());
      s.window.live()->setOptions(live_rig::options());
      s.window.overlayLive(true);
      s.window.showExport();
      s.window.openSession(earlier);
      QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
      s.controller.setPaused(false);
    }
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session && session->complete() && session->range());
  }
};

PITCHBOARD_GUI_TEST(TestSessions)

}  // namespace tst_sessions

#include "tst_sessions.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// A person referees a simulated match: buttons, keys, undo, the scoreboard, the log.
#include <QAbstractItemModelTester>
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QTableView>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>

#include <robotlink/session/match_recorder.h>
#include <ui/base/scoreboard_state.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/referee_calls.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/timeline.h>

#include "next_steps.h"
#include "referee_rig.h"

namespace tst_referee_panel {

using namespace pitchboard;
using namespace pitchboard::ui;
using referee_rig::Desk;

namespace {

void sameScoreboard(const link::MatchFrame& now, const link::MatchFrame& past) {
  QCOMPARE(past.origin, link::FrameOrigin::Recorded);
  QVERIFY(past.referee.has_value());
  const ScoreboardState was = scoreboardOf(now), seen = scoreboardOf(past);
  QVERIFY(!was.penalties.isEmpty());
  QCOMPARE(seen.penalties, was.penalties);
  QCOMPARE(seen.clock, was.clock);
  QCOMPARE(seen.left, 0);
  QCOMPARE(seen.right, 1);
  QCOMPARE(seen.leftName, was.leftName);
  QCOMPARE(past.referee->state, now.referee->state);
  QCOMPARE(past.referee->kickOffTeam, now.referee->kickOffTeam);
  QCOMPARE(past.referee->secondaryTime, now.referee->secondaryTime);
  QCOMPARE(past.referee->version, now.referee->version);
  for (std::size_t side = 0; side < 2; ++side) {
    QCOMPARE(past.referee->teams[side].players.size(), now.referee->teams[side].players.size());
    QCOMPARE(past.referee->teams[side].playersLeft, now.referee->teams[side].playersLeft);
  }
}

}  // namespace

class TestRefereePanel : public QObject {
  Q_OBJECT
 private slots:
  void statesByButtonsAndUndo() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.reach("PLAYING");
    desk.undo()->undo();
    QTRY_COMPARE(desk.state(), QString("SET"));
    desk.undo()->redo();
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    QVERIFY(desk.errors.isEmpty());
    auto* log = desk.dock->findChild<QTableView*>("refereeLog");
    desk.controller.stepOnce();
    QTRY_VERIFY(log->model()->rowCount() > 0);
    const QAbstractItemModel* lines = log->model();
    QTRY_VERIFY(lines->index(lines->rowCount() - 1, 1).data().toString().contains("PLAYING"));
  }

  void aRefusedCallIsNoStep() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.reach("PLAYING");
    QTRY_COMPARE(desk.undo()->count(), 3);
    callReferee(desk.controller.edits(),
                {.kind = sim::CallKind::State, .state = sim::PlayState::Set}, "SET");
    QTRY_COMPARE(desk.errors.size(), 1);
    QVERIFY2(desk.errors[0].contains("from PLAYING to SET"), qPrintable(desk.errors[0]));
    QCOMPARE(desk.state(), QString("PLAYING"));
    QCOMPARE(desk.undo()->count(), 3);
    // One of several that is refused: nobody is penalised, and there is no step.
    callReferee(desk.controller.edits(), {.kind = sim::CallKind::Pardon},
                {desk.frame().robots[0].slot(), desk.frame().robots[1].slot()}, "pardon");
    QTRY_COMPARE(desk.errors.size(), 2);
    QCOMPARE(desk.undo()->count(), 3);
  }

  // Gone from the timeline and the panel's log; a redo brings it back.
  void anUndoneGoalIsGone_data() {
    QTest::addColumn<bool>("played");
    QTest::newRow("told before it is undone") << true;
    QTest::newRow("undone while it stands still") << false;
  }
  void anUndoneGoalIsGone() {
    QFETCH(bool, played);
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.reach("PLAYING");
    desk.controller.stepOnce();
    const auto count = [&desk](link::MatchEventKind kind) {
      return std::ranges::count(desk.timeline.events()->events(), kind, &link::MatchEvent::kind);
    };
    QTRY_COMPARE(count(link::MatchEventKind::GameState), 3);
    desk.press("Goal left");
    QTRY_COMPARE(desk.state(), QString("READY"));
    QTRY_COMPARE(desk.undo()->count(), 4);
    // It is told at once, and once.
    QTRY_COMPARE(count(link::MatchEventKind::Goal), 1);
    const auto step = [&desk] {
      const std::uint64_t tick = desk.frame().snapshot.tick;
      desk.controller.stepOnce();
      QTRY_COMPARE(desk.frame().snapshot.tick, tick + 1);
      desk.controller.settle();
    };
    if (played) step();
    QCOMPARE(count(link::MatchEventKind::Goal), 1);
    QCOMPARE(count(link::MatchEventKind::GameState), 4);
    desk.undo()->undo();
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    QTRY_COMPARE(count(link::MatchEventKind::Goal), 0);
    if (played) step();
    QCOMPARE(count(link::MatchEventKind::Goal), 0);
    QCOMPARE(count(link::MatchEventKind::GameState), 3);
    QCOMPARE(count(link::MatchEventKind::Undone), 0);
    desk.undo()->redo();
    QTRY_COMPARE(desk.state(), QString("READY"));
    QTRY_COMPARE(count(link::MatchEventKind::Goal), 1);
    step();
    QCOMPARE(count(link::MatchEventKind::Goal), 1);
  }

  // In every state: what can be pressed is what the match would do, and the rest says why not.
  void onlyLegalCallsCanBePressed_data() {
    QTest::addColumn<int>("steps");
    QTest::addColumn<QString>("state");
    QTest::addRow("INITIAL") << 0 << "INITIAL";
    QTest::addRow("READY") << 1 << "READY";
    QTest::addRow("SET") << 2 << "SET";
    QTest::addRow("PLAYING") << 3 << "PLAYING";
    QTest::addRow("stopped") << 4 << "PLAYING";
    QTest::addRow("corner kick") << 5 << "PLAYING";
    QTest::addRow("FINISHED") << 6 << "FINISHED";
    QTest::addRow("timeout") << 7 << "INITIAL";
  }
  void onlyLegalCallsCanBePressed() {
    QFETCH(int, steps);
    QFETCH(QString, state);
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    using sim::CallKind;
    using sim::PlayState;
    const auto call = [&desk](const sim::RefereeCall& made) {
      callReferee(desk.controller.edits(), made, "call");
    };
    if (steps == 7) call({.kind = CallKind::Timeout, .team = 0});
    const PlayState states[] = {PlayState::Ready, PlayState::Set, PlayState::Playing};
    for (int i = 0; i < std::min(steps, 3) && steps < 7; ++i) {
      call({.kind = CallKind::State, .state = states[i]});
    }
    if (steps == 4) call({.kind = CallKind::Stop});
    if (steps == 5) {
      call({.kind = CallKind::SetPlay, .team = 0, .setPlay = sim::SetPlay::CornerKick});
    }
    if (steps == 6) call({.kind = CallKind::State, .state = PlayState::Finished});
    QTRY_COMPARE(desk.state(), state);
    desk.controller.settle();
    desk.choose(1);
    QTRY_VERIFY(desk.button("Penalise")->isEnabled());
    QTest::qWait(150);  // the panel looks ten times a second
    const auto is = [&desk](const char* name, const sim::RefereeCall& made) {
      const QString why = whyRefused(&desk.frame(), made);
      QPushButton* one = desk.button(name);
      QVERIFY2(one, name);
      QVERIFY2(one->isEnabled() == why.isEmpty(), name);
      QVERIFY2(!one->toolTip().isEmpty(), name);
      if (!why.isEmpty()) QCOMPARE(one->toolTip(), why);
    };
    for (int side = 0; side < 2; ++side) {
      const int team = side;  // blue defends the left goal
      const QString at = side == 0 ? "left" : "right";
      is(qPrintable("Goal " + at), {.kind = CallKind::Goal, .team = team, .value = 1});
      is((QStringLiteral("−1 ") + at).toUtf8(),
         {.kind = CallKind::Goal, .team = team, .value = -1});
      is(qPrintable("Kick-off " + at), {.kind = CallKind::KickOff, .team = team});
      is(qPrintable("Timeout " + at), {.kind = CallKind::Timeout, .team = team});
    }
    is("Give", {.kind = CallKind::SetPlay, .team = 0, .setPlay = sim::SetPlay::DirectFreeKick});
    const RobotId robot = desk.frame().robots[1].slot();
    is("Penalise",
       {.kind = CallKind::Penalise, .robot = robot, .penalty = sim::PenaltyKind::Incapable});
    is("Pardon", {.kind = CallKind::Pardon, .robot = robot});
    const auto offered = nextSteps(*desk.frame().refereedGame);
    QVERIFY(!offered.empty() && offered.size() <= 3);
    for (const NextStep& step : offered) {
      QPushButton* one = desk.dock->findChild<QPushButton*>("referee " + step.text);
      QVERIFY2(one && one->isVisible() && one->isEnabled(), qPrintable(step.text));
      if (step.call)
        QVERIFY2(whyRefused(&desk.frame(), *step.call).isEmpty(), qPrintable(step.text));
    }
    QVERIFY(desk.errors.isEmpty());
  }

  // What is and what comes next first, both teams side by side, the log below.
  void whatHappensNextStandsFirst() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.reach("PLAYING");
    const auto place = [&desk](const QWidget* widget) {
      return QRect(widget->mapTo(desk.dock.get(), QPoint()), widget->size());
    };
    const auto* state = desk.dock->findChild<QLabel*>("refereeState");
    QVERIFY(state->fontMetrics().height() >= 1.5 * desk.dock->fontMetrics().height());
    const auto offered = nextSteps(*desk.frame().refereedGame);
    QVERIFY(offered.size() >= 2 && offered.size() <= 3);
    const auto step = [&] {
      return desk.dock->findChild<QPushButton*>("referee " + offered[0].text);
    };
    QTRY_VERIFY(step() && step()->isVisible());
    const QRect next = place(step());
    QVERIFY(place(state).bottom() < next.top());
    for (const char* what : {"Goal", "Kick-off", "Timeout"}) {
      const QRect left = place(desk.button(qPrintable(QString::fromUtf8(what) + " left")));
      const QRect right = place(desk.button(qPrintable(QString::fromUtf8(what) + " right")));
      QCOMPARE(left.top(), right.top());
      QVERIFY(left.right() < right.left());
      QVERIFY(next.bottom() < left.top());
      // The next steps are larger than everything else.
      QVERIFY(next.height() > left.height());
    }
    const QRect players[] = {place(desk.players(false)), place(desk.players(true))};
    QCOMPARE(players[0].top(), players[1].top());
    QVERIFY(players[0].right() < players[1].left());
    QVERIFY(place(desk.dock->findChild<QTableView*>("refereeLog")).top() > players[0].bottom());
  }

  // Docked in a small window, and as high as it stands beside the field.
  void noWordIsCut_data() {
    QTest::addColumn<QSize>("size");
    QTest::newRow("at 960×600") << QSize(250, 560);
    QTest::newRow("docked") << QSize(320, 480);
    QTest::newRow("floating") << QSize(416, 500);
  }
  void noWordIsCut() {
    QFETCH(QSize, size);
    Desk desk;
    desk.dock->resize(scaled(desk.dock.get(), size.width()),
                      scaled(desk.dock.get(), size.height()));
    desk.reach("PLAYING");
    for (const auto* button : desk.dock->findChildren<QPushButton*>()) {
      if (!button->isVisible()) continue;
      const int words = button->fontMetrics().horizontalAdvance(button->text());
      QVERIFY2(button->width() >= words + 6, qPrintable(button->text()));
    }
    for (const auto* box : desk.dock->findChildren<QComboBox*>()) {
      if (!box->isVisible()) continue;
      const int words = box->fontMetrics().horizontalAdvance(box->currentText());
      QVERIFY2(box->width() >= words + scaled(box, 22), qPrintable(box->currentText()));
    }
    for (const bool right : {false, true}) {
      const QTableView* players = desk.players(right);
      const QFontMetrics metrics(players->font());
      QVERIFY(players->columnWidth(RefereeModel::State) >=
              metrics.horizontalAdvance(QStringLiteral("plays")) + 6);
    }
    // The log is there without scrolling.
    const auto* log = desk.dock->findChild<QTableView*>("refereeLog");
    QVERIFY(log && log->viewport()->visibleRegion().boundingRect().height() >= scaled(log, 72));
    // Nothing reaches beyond the panel, which does not scroll sideways.
    const auto* panel = qobject_cast<QScrollArea*>(desk.dock.get());
    auto* fold = desk.dock->findChild<QToolButton*>("refereeFold");
    if (!fold->isChecked()) fold->click();
    const int wide = panel->widget()->minimumSizeHint().width();
    QVERIFY2(wide <= std::max(panel->viewport()->width(), scaled(panel, 280)),
             qPrintable(QString::number(wide)));
  }

  void aGoalAndTheScoreboard() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.reach("PLAYING");
    desk.controller.edits()->moveBall({}, {2.0, 1.0});
    desk.press("Goal left");
    QTRY_COMPARE(desk.state(), QString("READY"));
    QTRY_COMPARE(scoreboardOf(desk.frame()).left, 1);
    QCOMPARE(desk.frame().snapshot.ball, (Point{0, 0}));
    QTRY_COMPARE(desk.undo()->count(), 5);
    desk.undo()->undo();
    QTRY_COMPARE(scoreboardOf(desk.frame()).left, 0);
    QTRY_COMPARE(desk.frame().snapshot.ball, (Point{2.0, 1.0}));
    QCOMPARE(desk.state(), QString("PLAYING"));
  }

  void theScoreboardShowsGoalsByHalf() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    link::MatchFrame frame = desk.frame();
    QVERIFY(!scoreboardOf(frame).tip.contains("By half"));
    const auto later = std::make_shared<link::RefereedGame>(*frame.refereedGame);
    later->game.half = 2;
    later->game.teams[0].byHalf = {1, 2, 0, 0};
    later->game.teams[1].byHalf = {0, 1, 0, 0};
    frame.refereedGame = later;
    QVERIFY(scoreboardOf(frame).tip.endsWith("By half: 1 : 0, 2 : 1"));
  }

  void aPenaltyOfAChosenRobot() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.choose(1);
    desk.press("Penalise");
    QTRY_COMPARE(desk.shown(1), QString("pickup 30 s"));
    QCOMPARE(scoreboardOf(desk.frame()).penalties, QString("B2 30"));
    QTRY_COMPARE(desk.undo()->count(), 1);
    desk.undo()->undo();
    QTRY_COMPARE(desk.shown(1), QString("plays"));
  }

  void cardsAndSubstitutes() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    const auto show = [&desk](const char* card) {
      auto* menu = desk.dock->findChild<QPushButton*>("refereeCard");
      QTRY_VERIFY(menu->isEnabled());
      for (QAction* action : menu->menu()->actions()) {
        if (action->text() == card) action->trigger();
      }
    };
    desk.choose(2);
    show("Warning");
    QTRY_COMPARE(desk.shown(2), QString("plays · warning"));
    show("Yellow card");
    QTRY_COMPARE(desk.shown(2), QString("plays · warning, yellow"));
    show("Red card");
    QTRY_COMPARE(desk.shown(2), QString("sent off · warning, yellow, red"));
    QTRY_COMPARE(desk.undo()->count(), 3);
    desk.undo()->undo();
    QTRY_COMPARE(desk.shown(2), QString("plays · warning, yellow"));
    // Two at once are one step.
    const int before = desk.undo()->index();
    desk.players()->clearSelection();
    desk.choose(0);
    desk.choose(1, true);
    desk.press("Take off");
    QTRY_VERIFY2(desk.shown(0) == "substitute", qPrintable(desk.errors.join('\n')));
    QTRY_COMPARE(desk.shown(1, RefereeModel::State, true), QString("substitute"));
    QTRY_COMPARE(desk.undo()->index(), before + 1);
    QCOMPARE(desk.shown(2), QString("plays · warning, yellow"));
    desk.press("Pardon");
    QTRY_COMPARE(desk.shown(0), QString("plays"));
    QTRY_COMPARE(desk.shown(1, RefereeModel::State, true), QString("plays"));
    QVERIFY(desk.errors.isEmpty());
  }

  // Every call that has a key, by its key, in the order of a match.
  void everyStateByItsKey() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.dock->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(desk.dock.get()));
    const auto press = [&desk](Qt::Key key) {
      QTest::keyClick(desk.dock.get(), key, Qt::ControlModifier | Qt::AltModifier);
    };
    const auto hasText = [&desk](const char* setPlay) {
      return desk.frame().referee->setPlay == setPlay;
    };
    press(Qt::Key_3);  // blue kicks off
    press(Qt::Key_R);
    QTRY_COMPARE(desk.state(), QString("READY"));
    press(Qt::Key_S);
    QTRY_COMPARE(desk.state(), QString("SET"));
    press(Qt::Key_P);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    press(Qt::Key_X);
    QTRY_VERIFY(desk.frame().referee->stopped);
    press(Qt::Key_G);
    QTRY_VERIFY(!desk.frame().referee->stopped);
    press(Qt::Key_K);
    QTRY_VERIFY(hasText("direct free kick"));
    for (int step = 0; step < 3; ++step) press(Qt::Key_N);
    QTRY_VERIFY(hasText(""));
    press(Qt::Key_D);
    QTRY_COMPARE(desk.state(), QString("READY"));
    press(Qt::Key_S);
    press(Qt::Key_P);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    press(Qt::Key_2);
    QTRY_COMPARE(desk.frame().snapshot.score.right, 1);
    press(Qt::Key_S);
    press(Qt::Key_P);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    press(Qt::Key_F);
    QTRY_COMPARE(desk.state(), QString("FINISHED"));
    press(Qt::Key_I);
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    QVERIFY(!desk.frame().referee->firstHalf);
    QVERIFY2(desk.errors.isEmpty(), qPrintable(desk.errors.join('\n')));
  }

  // What was shown is shown again when a person looks back, and from a recording.
  void thePastShowsTheScoreboard() {
    QTemporaryDir folder;
    const std::string path = folder.filePath("refereed.mcap").toStdString();
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    const auto recorder =
        link::MatchRecorder::create(path, desk.controller.scenario(), desk.controller.catalog(),
                                    desk.controller.memory()->sampler(), {})
            .value();
    desk.controller.observe(recorder);
    desk.reach("PLAYING");
    desk.choose(1);
    desk.press("Penalise");
    desk.press("Goal right");
    QTRY_COMPARE(desk.frame().snapshot.score.right, 1);
    desk.controller.stepOnce();
    QTRY_VERIFY(desk.frame().snapshot.tick > 0);
    const FramePtr now = desk.controller.frame();
    FramePtr past;
    QTRY_VERIFY((past = desk.controller.frameAt(now->snapshot.time)));
    sameScoreboard(*now, *past);
    if (QTest::currentTestFailed()) return;

    desk.controller.stopObserving(recorder);
    QVERIFY(recorder->finish());
    ReplayController replay;
    QSignalSpy opened(&replay, &ReplayController::opened);
    replay.open(QString::fromStdString(path));
    QTRY_COMPARE(opened.count(), 1);
    FramePtr replayed;
    QTRY_VERIFY((replayed = replay.frameAt(now->snapshot.time)));
    sameScoreboard(*now, *replayed);
  }

  void theLogEndsAtTheMomentShown() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.press("READY");
    QTRY_COMPARE(desk.state(), QString("READY"));
    desk.controller.runTo(60);
    QTRY_COMPARE(desk.frame().snapshot.tick, std::uint64_t(60));
    desk.press("SET");
    QTRY_COMPARE(desk.state(), QString("SET"));
    desk.controller.runTo(120);
    QTRY_COMPARE(desk.frame().snapshot.tick, std::uint64_t(120));
    auto* log = desk.dock->findChild<QTableView*>("refereeLog")->model();
    const QAbstractItemModelTester tester(log,
                                          QAbstractItemModelTester::FailureReportingMode::QtTest);
    QTRY_COMPARE(log->rowCount(), 2);
    desk.timeline.seek(0.5);
    QCOMPARE(log->rowCount(), 1);
    desk.timeline.seek(1.5);
    QCOMPARE(log->rowCount(), 2);
    desk.timeline.seek(0.5);
    desk.timeline.goLive();
    QCOMPARE(log->rowCount(), 2);
  }
};

PITCHBOARD_GUI_TEST(TestRefereePanel)

}  // namespace tst_referee_panel

#include "tst_referee_panel.moc"

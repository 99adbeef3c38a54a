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
#include <ui/sources/shown_moment.h>

#include "next_steps.h"
#include "referee_rig.h"

namespace tst_referee_panel {

using namespace pitchboard;
using namespace pitchboard::ui;
using referee_rig::RefereeRig;

namespace {

void sameScoreboard(const link::MatchFrame& now, const link::MatchFrame& past) {
  QCOMPARE(past.origin, link::FrameOrigin::Recorded);
  QVERIFY(past.game.has_value());
  const ScoreboardState was = scoreboardOf(now), seen = scoreboardOf(past);
  QVERIFY(!was.penalties.isEmpty());
  QCOMPARE(seen.penalties, was.penalties);
  QCOMPARE(seen.clock, was.clock);
  QCOMPARE(seen.left, 0);
  QCOMPARE(seen.right, 1);
  QCOMPARE(seen.leftName, was.leftName);
  QCOMPARE(refereeStateText(past), refereeStateText(now));
  QCOMPARE(refereeSetPlayText(past), refereeSetPlayText(now));
  QCOMPARE(past.game->kickOff, now.game->kickOff);
  QCOMPARE(past.rules->packetVersion, now.rules->packetVersion);
  for (const bool right : {false, true}) {
    QCOMPARE(refereeTeamText(past, past.game->teamAt(right)),
             refereeTeamText(now, now.game->teamAt(right)));
    QCOMPARE(past.game->teamAt(right).onField(), now.game->teamAt(right).onField());
  }
}

}  // namespace

class TestRefereePanel : public QObject {
  Q_OBJECT
 private slots:
  void statesByButtonsAndUndo() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.reach("PLAYING");
    rig.undo()->undo();
    QTRY_COMPARE(rig.state(), QString("SET"));
    rig.undo()->redo();
    QTRY_COMPARE(rig.state(), QString("PLAYING"));
    QVERIFY(rig.errors.isEmpty());
    auto* log = rig.dock->findChild<QTableView*>("refereeLog");
    rig.controller.stepOnce();
    QTRY_VERIFY(log->model()->rowCount() > 0);
    const QAbstractItemModel* lines = log->model();
    QTRY_VERIFY(lines->index(lines->rowCount() - 1, 1).data().toString().contains("PLAYING"));
  }

  void aRefusedCallIsNoStep() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.reach("PLAYING");
    QTRY_COMPARE(rig.undo()->count(), 3);
    callReferee(rig.controller.edits(), {.kind = sim::CallKind::State, .state = PlayState::Set},
                "SET");
    QTRY_COMPARE(rig.errors.size(), 1);
    QVERIFY2(rig.errors[0].contains("from PLAYING to SET"), qPrintable(rig.errors[0]));
    QCOMPARE(rig.state(), QString("PLAYING"));
    QCOMPARE(rig.undo()->count(), 3);
    // One of several that is refused: nobody is penalised, and there is no step.
    callReferee(rig.controller.edits(), {.kind = sim::CallKind::Pardon},
                {rig.frame().robots[0].slot(), rig.frame().robots[1].slot()}, "pardon");
    QTRY_COMPARE(rig.errors.size(), 2);
    QCOMPARE(rig.undo()->count(), 3);
  }

  // Gone from the timeline and the panel's log; a redo brings it back.
  void anUndoneGoalIsGone_data() {
    QTest::addColumn<bool>("played");
    QTest::newRow("told before it is undone") << true;
    QTest::newRow("undone while it stands still") << false;
  }
  void anUndoneGoalIsGone() {
    QFETCH(bool, played);
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.reach("PLAYING");
    rig.controller.stepOnce();
    const auto count = [&rig](link::MatchEventKind kind) {
      return std::ranges::count(rig.moment.events()->events(), kind, &link::MatchEvent::kind);
    };
    QTRY_COMPARE(count(link::MatchEventKind::GameState), 3);
    rig.press("Goal left");
    QTRY_COMPARE(rig.state(), QString("READY"));
    QTRY_COMPARE(rig.undo()->count(), 4);
    // It is told at once, and once.
    QTRY_COMPARE(count(link::MatchEventKind::Goal), 1);
    const auto step = [&rig] {
      const std::uint64_t tick = rig.frame().snapshot.tick;
      rig.controller.stepOnce();
      QTRY_COMPARE(rig.frame().snapshot.tick, tick + 1);
      rig.controller.settle();
    };
    if (played) step();
    QCOMPARE(count(link::MatchEventKind::Goal), 1);
    QCOMPARE(count(link::MatchEventKind::GameState), 4);
    rig.undo()->undo();
    QTRY_COMPARE(rig.state(), QString("PLAYING"));
    QTRY_COMPARE(count(link::MatchEventKind::Goal), 0);
    if (played) step();
    QCOMPARE(count(link::MatchEventKind::Goal), 0);
    QCOMPARE(count(link::MatchEventKind::GameState), 3);
    QCOMPARE(count(link::MatchEventKind::Undone), 0);
    rig.undo()->redo();
    QTRY_COMPARE(rig.state(), QString("READY"));
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
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    using sim::CallKind;
    const auto call = [&rig](const sim::RefereeCall& made) {
      callReferee(rig.controller.edits(), made, "call");
    };
    if (steps == 7) call({.kind = CallKind::Timeout, .team = 0});
    const PlayState states[] = {PlayState::Ready, PlayState::Set, PlayState::Playing};
    for (int i = 0; i < std::min(steps, 3) && steps < 7; ++i) {
      call({.kind = CallKind::State, .state = states[i]});
    }
    if (steps == 4) call({.kind = CallKind::Stop});
    if (steps == 5) {
      call({.kind = CallKind::SetPlay, .team = 0, .setPlay = SetPlay::CornerKick});
    }
    if (steps == 6) call({.kind = CallKind::State, .state = PlayState::Finished});
    QTRY_COMPARE(rig.state(), state);
    rig.controller.settle();
    rig.choose(1);
    QTRY_VERIFY(rig.button("Penalise")->isEnabled());
    QTest::qWait(150);  // the panel looks ten times a second
    const auto is = [&rig](const char* name, const sim::RefereeCall& made) {
      const QString why = whyRefused(&rig.frame(), made);
      QPushButton* one = rig.button(name);
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
    is("Give", {.kind = CallKind::SetPlay, .team = 0, .setPlay = SetPlay::DirectFreeKick});
    const RobotId robot = rig.frame().robots[1].slot();
    is("Penalise", {.kind = CallKind::Penalise, .robot = robot, .penalty = PenaltyKind::Incapable});
    is("Pardon", {.kind = CallKind::Pardon, .robot = robot});
    const auto offered = nextSteps(*rig.frame().game, *rig.frame().rules);
    QVERIFY(!offered.empty() && offered.size() <= 3);
    for (const NextStep& step : offered) {
      QPushButton* one = rig.dock->findChild<QPushButton*>("referee " + step.text);
      QVERIFY2(one && one->isVisible() && one->isEnabled(), qPrintable(step.text));
      if (step.call)
        QVERIFY2(whyRefused(&rig.frame(), *step.call).isEmpty(), qPrintable(step.text));
    }
    QVERIFY(rig.errors.isEmpty());
  }

  // What is and what comes next first, both teams side by side, the log below.
  void whatHappensNextStandsFirst() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.reach("PLAYING");
    const auto place = [&rig](const QWidget* widget) {
      return QRect(widget->mapTo(rig.dock.get(), QPoint()), widget->size());
    };
    const auto* state = rig.dock->findChild<QLabel*>("refereeState");
    QVERIFY(state->fontMetrics().height() >= 1.5 * rig.dock->fontMetrics().height());
    const auto offered = nextSteps(*rig.frame().game, *rig.frame().rules);
    QVERIFY(offered.size() >= 2 && offered.size() <= 3);
    const auto step = [&] {
      return rig.dock->findChild<QPushButton*>("referee " + offered[0].text);
    };
    QTRY_VERIFY(step() && step()->isVisible());
    const QRect next = place(step());
    QVERIFY(place(state).bottom() < next.top());
    for (const char* what : {"Goal", "Kick-off", "Timeout"}) {
      const QRect left = place(rig.button(qPrintable(QString::fromUtf8(what) + " left")));
      const QRect right = place(rig.button(qPrintable(QString::fromUtf8(what) + " right")));
      QCOMPARE(left.top(), right.top());
      QVERIFY(left.right() < right.left());
      QVERIFY(next.bottom() < left.top());
      // The next steps are larger than everything else.
      QVERIFY(next.height() > left.height());
    }
    const QRect players[] = {place(rig.players(false)), place(rig.players(true))};
    QCOMPARE(players[0].top(), players[1].top());
    QVERIFY(players[0].right() < players[1].left());
    QVERIFY(place(rig.dock->findChild<QTableView*>("refereeLog")).top() > players[0].bottom());
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
    RefereeRig rig;
    rig.dock->resize(scaled(rig.dock.get(), size.width()), scaled(rig.dock.get(), size.height()));
    rig.reach("PLAYING");
    for (const auto* button : rig.dock->findChildren<QPushButton*>()) {
      if (!button->isVisible()) continue;
      const int words = button->fontMetrics().horizontalAdvance(button->text());
      QVERIFY2(button->width() >= words + 6, qPrintable(button->text()));
    }
    for (const auto* box : rig.dock->findChildren<QComboBox*>()) {
      if (!box->isVisible()) continue;
      const int words = box->fontMetrics().horizontalAdvance(box->currentText());
      QVERIFY2(box->width() >= words + scaled(box, 22), qPrintable(box->currentText()));
    }
    for (const bool right : {false, true}) {
      const QTableView* players = rig.players(right);
      const QFontMetrics metrics(players->font());
      QVERIFY(players->columnWidth(RefereeModel::State) >=
              metrics.horizontalAdvance(QStringLiteral("plays")) + 6);
    }
    // The log is there without scrolling.
    const auto* log = rig.dock->findChild<QTableView*>("refereeLog");
    QVERIFY(log && log->viewport()->visibleRegion().boundingRect().height() >= scaled(log, 72));
    // Nothing reaches beyond the panel, which does not scroll sideways.
    const auto* panel = qobject_cast<QScrollArea*>(rig.dock.get());
    auto* fold = rig.dock->findChild<QToolButton*>("refereeFold");
    if (!fold->isChecked()) fold->click();
    const int wide = panel->widget()->minimumSizeHint().width();
    QVERIFY2(wide <= std::max(panel->viewport()->width(), scaled(panel, 280)),
             qPrintable(QString::number(wide)));
  }

  void aGoalAndTheScoreboard() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.reach("PLAYING");
    rig.controller.edits()->moveBall({2.0, 1.0});
    rig.press("Goal left");
    QTRY_COMPARE(rig.state(), QString("READY"));
    QTRY_COMPARE(scoreboardOf(rig.frame()).left, 1);
    QCOMPARE(rig.frame().snapshot.ball, (Point{0, 0}));
    QTRY_COMPARE(rig.undo()->count(), 5);
    rig.undo()->undo();
    QTRY_COMPARE(scoreboardOf(rig.frame()).left, 0);
    QTRY_COMPARE(rig.frame().snapshot.ball, (Point{2.0, 1.0}));
    QCOMPARE(rig.state(), QString("PLAYING"));
  }

  void theScoreboardTellsThePartOfTheGame() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    link::MatchFrame frame = rig.frame();
    QCOMPARE(scoreboardOf(frame).period, QString("1st"));
    Game& game = *frame.game;
    game.state = PlayState::Playing;
    game.half = 2;
    QCOMPARE(scoreboardOf(frame).period, QString("2nd"));
    game.phase = GamePhase::ExtraTime;
    QCOMPARE(scoreboardOf(frame).period, QString("ET 2"));
    game.phase = GamePhase::ShootOut;
    QCOMPARE(scoreboardOf(frame).period, QString("PEN"));
    // Beyond an hour.
    game.clock = static_cast<int>((3600 + 12 * 60 + 5) * game.tickRate);
    QCOMPARE(scoreboardOf(frame).clock, QString("72:05"));
    // Where there is little room, the set play stays.
    game.restart.kind = SetPlay::DirectFreeKick;
    game.restart.step = Restart::Step::Placing;
    game.restart.team = 0;
    game.teams[0].number = 12;
    const ScoreboardState board = scoreboardOf(frame);
    const QFontMetricsF metrics(themeFont(TypeRole::Secondary, true));
    const double room = metrics.horizontalAdvance("direct free kick 12") + 1;
    QCOMPARE(stateText(board, metrics, room), QString("direct free kick 12"));
    QVERIFY(stateText(board, metrics, 1000).startsWith("PLAYING · direct free kick 12"));
  }

  void theScoreboardShowsGoalsByHalf() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    link::MatchFrame frame = rig.frame();
    QVERIFY(!scoreboardOf(frame).tip.contains("By half"));
    frame.game->half = 2;
    frame.game->teams[0].byHalf = {1, 2, 0, 0};
    frame.game->teams[1].byHalf = {0, 1, 0, 0};
    QVERIFY(scoreboardOf(frame).tip.endsWith("By half: 1 : 0, 2 : 1"));
  }

  void aPenaltyOfAChosenRobot() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.choose(1);
    rig.press("Penalise");
    QTRY_COMPARE(rig.shown(1), QString("pickup 30 s"));
    QCOMPARE(scoreboardOf(rig.frame()).penalties, QString("Penalties: B2 30"));
    QTRY_COMPARE(rig.undo()->count(), 1);
    rig.undo()->undo();
    QTRY_COMPARE(rig.shown(1), QString("plays"));
  }

  void cardsAndSubstitutes() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    const auto show = [&rig](const char* card) {
      auto* menu = rig.dock->findChild<QPushButton*>("refereeCard");
      QTRY_VERIFY(menu->isEnabled());
      for (QAction* action : menu->menu()->actions()) {
        if (action->text() == card) action->trigger();
      }
    };
    rig.choose(2);
    show("Warning");
    QTRY_COMPARE(rig.shown(2), QString("plays · warning"));
    show("Yellow card");
    QTRY_COMPARE(rig.shown(2), QString("plays · warning, yellow"));
    show("Red card");
    QTRY_COMPARE(rig.shown(2), QString("sent off · warning, yellow, red"));
    QTRY_COMPARE(rig.undo()->count(), 3);
    rig.undo()->undo();
    QTRY_COMPARE(rig.shown(2), QString("plays · warning, yellow"));
    // Two at once are one step.
    const int before = rig.undo()->index();
    rig.players()->clearSelection();
    rig.choose(0);
    rig.choose(1, true);
    rig.press("Take off");
    QTRY_VERIFY2(rig.shown(0) == "substitute", qPrintable(rig.errors.join('\n')));
    QTRY_COMPARE(rig.shown(1, RefereeModel::State, true), QString("substitute"));
    QTRY_COMPARE(rig.undo()->index(), before + 1);
    QCOMPARE(rig.shown(2), QString("plays · warning, yellow"));
    rig.press("Pardon");
    QTRY_COMPARE(rig.shown(0), QString("plays"));
    QTRY_COMPARE(rig.shown(1, RefereeModel::State, true), QString("plays"));
    QVERIFY(rig.errors.isEmpty());
  }

  // Every call that has a key, by its key, in the order of a match.
  void everyStateByItsKey() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.dock->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(rig.dock.get()));
    const auto press = [&rig](Qt::Key key) {
      QTest::keyClick(rig.dock.get(), key, Qt::ControlModifier | Qt::AltModifier);
    };
    const auto isGiven = [&rig](SetPlay play) { return rig.frame().game->setPlay() == play; };
    press(Qt::Key_3);  // blue kicks off
    press(Qt::Key_R);
    QTRY_COMPARE(rig.state(), QString("READY"));
    press(Qt::Key_S);
    QTRY_COMPARE(rig.state(), QString("SET"));
    press(Qt::Key_P);
    QTRY_COMPARE(rig.state(), QString("PLAYING"));
    press(Qt::Key_X);
    QTRY_VERIFY(rig.frame().game->stopped);
    press(Qt::Key_G);
    QTRY_VERIFY(!rig.frame().game->stopped);
    press(Qt::Key_K);
    QTRY_VERIFY(isGiven(SetPlay::DirectFreeKick));
    for (int step = 0; step < 3; ++step) press(Qt::Key_N);
    QTRY_VERIFY(isGiven(SetPlay::None));
    press(Qt::Key_D);
    QTRY_COMPARE(rig.state(), QString("READY"));
    press(Qt::Key_S);
    press(Qt::Key_P);
    QTRY_COMPARE(rig.state(), QString("PLAYING"));
    press(Qt::Key_2);
    QTRY_COMPARE(rig.frame().snapshot.score.right, 1);
    press(Qt::Key_S);
    press(Qt::Key_P);
    QTRY_COMPARE(rig.state(), QString("PLAYING"));
    press(Qt::Key_F);
    QTRY_COMPARE(rig.state(), QString("FINISHED"));
    press(Qt::Key_I);
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    QVERIFY(rig.frame().game->half == 2);
    QVERIFY2(rig.errors.isEmpty(), qPrintable(rig.errors.join('\n')));
  }

  // What was shown is shown again when a person looks back, and from a recording.
  void thePastShowsTheScoreboard() {
    QTemporaryDir folder;
    const std::string path = folder.filePath("refereed.mcap").toStdString();
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    const auto recorder =
        link::MatchRecorder::create(path, rig.controller.scenario(), rig.controller.catalog(),
                                    rig.controller.memory()->sampler(), {})
            .value();
    rig.controller.observe(recorder);
    rig.reach("PLAYING");
    rig.choose(1);
    rig.press("Penalise");
    rig.press("Goal right");
    QTRY_COMPARE(rig.frame().snapshot.score.right, 1);
    rig.controller.stepOnce();
    QTRY_VERIFY(rig.frame().snapshot.tick > 0);
    const FramePtr now = rig.controller.frame();
    FramePtr past;
    QTRY_VERIFY((past = rig.controller.frameAt(now->snapshot.time)));
    sameScoreboard(*now, *past);
    if (QTest::currentTestFailed()) return;

    rig.controller.stopObserving(recorder);
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
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.press("READY");
    QTRY_COMPARE(rig.state(), QString("READY"));
    rig.controller.runTo(60);
    QTRY_COMPARE(rig.frame().snapshot.tick, std::uint64_t(60));
    rig.press("SET");
    QTRY_COMPARE(rig.state(), QString("SET"));
    rig.controller.runTo(120);
    QTRY_COMPARE(rig.frame().snapshot.tick, std::uint64_t(120));
    auto* log = rig.dock->findChild<QTableView*>("refereeLog")->model();
    const QAbstractItemModelTester tester(log,
                                          QAbstractItemModelTester::FailureReportingMode::QtTest);
    QTRY_COMPARE(log->rowCount(), 2);
    rig.moment.seek(0.5);
    QCOMPARE(log->rowCount(), 1);
    rig.moment.seek(1.5);
    QCOMPARE(log->rowCount(), 2);
    rig.moment.seek(0.5);
    rig.moment.goLive();
    QCOMPARE(log->rowCount(), 2);
  }
};

PITCHBOARD_GUI_TEST(TestRefereePanel)

}  // namespace tst_referee_panel

#include "tst_referee_panel.moc"

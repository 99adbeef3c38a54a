// SPDX-License-Identifier: GPL-3.0-or-later
// What the referee says, in words and as a table: values made by hand, no network.

#include <QAbstractItemModelTester>
#include <QtTest>

#include <ui/base/referee_text.h>

#include "referee_model.h"

namespace tst_referee_model {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

link::MatchFrame received() {
  link::MatchFrame frame;
  frame.reception.ourTeam = 12;
  Game& game = frame.game.emplace();
  game.state = PlayState::Playing;
  game.clock = 312;
  game.teams[0].number = 12;
  game.teams[0].score = 1;
  game.teams[0].shirts = {1, 2, 0, 4};
  game.teams[0].players[1].penalty = PenaltyKind::Pushing;
  game.teams[0].players[1].ticksLeft = 20;
  game.teams[0].players[1].yellow = 1;
  game.teams[1].number = 5;
  game.teams[1].colour = TeamColor::Red;
  game.teams[1].shirts = {1, 2, 3, 4};
  return frame;
}

/// Shows the first team, with this reply of a robot.
void show(RefereeModel& model, link::MatchFrame frame,
          const std::optional<link::RobotReplyView>& reply = {}) {
  if (reply) frame.reception.replies = {*reply};
  const GameTeam& team = frame.game->teams[0];
  model.update(frame, team, team.onField());
}

}  // namespace

class TestRefereeModel : public QObject {
  Q_OBJECT

 private slots:
  void words() {
    link::MatchFrame frame = received();
    Game& game = *frame.game;
    game.kickOff = Game::noTeam;
    QCOMPARE(refereeStateText(frame), QStringLiteral("PLAYING 05:12, first half"));
    QVERIFY(refereeSetPlayText(frame).isEmpty());
    QVERIFY(refereeTruthText(frame).isEmpty());
    game.restart.step = Restart::Step::Preparing;
    game.restart.kind = SetPlay::CornerKick;
    game.restart.team = 1;
    game.countdown.ticks = 23;
    QCOMPARE(refereeSetPlayText(frame),
             QStringLiteral("corner kick for RED, prepare, ready in 23 s"));
    game.kickOff = 0;
    game.restart = {};
    game.restart.step = Restart::Step::Executed;
    game.countdown.ticks = 8;
    QCOMPARE(refereeSetPlayText(frame), QStringLiteral("kick-off for BLUE, ball free in 8 s"));
    Game& truth = frame.reception.truth.emplace();
    truth.state = PlayState::Playing;
    truth.clock = -7;
    truth.teams[0].score = 2;
    QCOMPARE(refereeTruthText(frame),
             QStringLiteral("True state: PLAYING −00:07, 2 : 0, 0.0 s ago"));
    QCOMPARE(refereeTeamText(frame, game.teams[0]),
             QStringLiteral("Team 12 (blue), ours: 1 goal, 2 players left"));
    QCOMPARE(refereeTeamText(frame, game.teams[1]),
             QStringLiteral("Team 5 (red): 0 goals, 4 players left"));
    game.teams[1].messageBudget = 11873;
    QCOMPARE(refereeTeamText(frame, game.teams[1]),
             QStringLiteral("Team 5 (red): 0 goals, 4 players left, message budget 11873"));
  }

  void whoSitsOutStandsFirst() {
    RefereeModel model;
    const QAbstractItemModelTester tester(&model);
    const auto cell = [&model](int row, RefereeModel::Column column) {
      return model.index(row, column).data().toString();
    };
    show(model, received());
    QCOMPARE(model.rowCount(), 3);
    QCOMPARE(cell(0, RefereeModel::Player), QStringLiteral("2"));
    QCOMPARE(cell(0, RefereeModel::State), QStringLiteral("pushing"));
    QCOMPARE(cell(0, RefereeModel::Left), QStringLiteral("20 s"));
    QCOMPARE(cell(0, RefereeModel::Cards), QStringLiteral("yellow"));
    QCOMPARE(cell(1, RefereeModel::Player), QStringLiteral("1"));
    QCOMPARE(cell(1, RefereeModel::State), QStringLiteral("plays"));
    QVERIFY(cell(1, RefereeModel::Robot).isEmpty());
    link::RobotReplyView reply;
    reply.team = 12;
    reply.player = 1;
    reply.address = "10.0.0.1";
    show(model, received(), reply);
    QCOMPARE(cell(1, RefereeModel::Robot), QStringLiteral("good"));
    reply.fallen = true;
    show(model, received(), reply);
    QCOMPARE(cell(1, RefereeModel::Robot), QStringLiteral("fallen"));
    reply.age = 3.0;
    show(model, received(), reply);
    QCOMPARE(cell(1, RefereeModel::Robot), QStringLiteral("late"));
    reply.age = 4.5;
    show(model, received(), reply);
    QCOMPARE(cell(1, RefereeModel::Robot), QStringLiteral("offline"));
    // Another team's robot of that number.
    reply.team = 5;
    show(model, received(), reply);
    QVERIFY(cell(1, RefereeModel::Robot).isEmpty());
    // Beside controls rows keep their places, and cards stand with the state.
    model.setCompact(true);
    show(model, received());
    QCOMPARE(cell(0, RefereeModel::Player), QStringLiteral("1"));
    QCOMPARE(cell(1, RefereeModel::State), QStringLiteral("pushing 20 s · yellow"));
    // In few words, so that the time fits; the tooltip has all.
    link::MatchFrame other = received();
    other.game->teams[0].players[1].penalty = PenaltyKind::Incapable;
    show(model, other);
    QCOMPARE(cell(1, RefereeModel::State), QStringLiteral("pickup 20 s · yellow"));
    QCOMPARE(model.index(1, RefereeModel::State).data(Qt::ToolTipRole).toString(),
             QStringLiteral("pickup or incapable · yellow"));
    other.game->teams[0].shirts = {};
    show(model, other);
    QCOMPARE(model.rowCount(), 0);
  }
};

PITCHBOARD_GUI_TEST(TestRefereeModel)

}  // namespace tst_referee_model

#include "tst_referee_model.moc"

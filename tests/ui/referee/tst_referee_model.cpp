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

link::RefereeView view() {
  link::RefereeView v;
  v.state = "PLAYING";
  v.secondsLeft = 312;
  v.teams[0] = {12, "blue", 1, 2, {{2, "pushing", 20, 0, 1}, {1, {}, 0}, {4, {}, 0}}};
  v.teams[1] = {5, "red", 0, 4, {}};
  v.ourTeam = 12;
  return v;
}

}  // namespace

class TestRefereeModel : public QObject {
  Q_OBJECT

 private slots:
  void words() {
    link::RefereeView v = view();
    QCOMPARE(refereeStateText(v), QStringLiteral("PLAYING 05:12, first half"));
    QVERIFY(refereeSetPlayText(v).isEmpty());
    QVERIFY(refereeTruthText(v).isEmpty());
    v.setPlay = "corner kick";
    v.performingTeam = 5;
    v.setPlayStep = "prepare";
    v.secondaryTime = 23;
    v.countdown = "ready";
    QCOMPARE(refereeSetPlayText(v), QStringLiteral("corner kick for RED, prepare, ready in 23 s"));
    v = view();
    v.kickOffTeam = 12;
    v.secondaryTime = 8;
    v.countdown = "ball free";
    QCOMPARE(refereeSetPlayText(v), QStringLiteral("kick-off for BLUE, ball free in 8 s"));
    v.truth.emplace();
    v.truth->state = "PLAYING";
    v.truth->secondsLeft = -7;
    v.truth->scores = {2, 0};
    QCOMPARE(refereeTruthText(v), QStringLiteral("True state: PLAYING −00:07, 2 : 0, 0.0 s ago"));
    QCOMPARE(refereeTeamText(v.teams[0], v.ourTeam),
             QStringLiteral("Team 12 (blue), ours: 1 goal, 2 players left"));
    QCOMPARE(refereeTeamText(v.teams[1], v.ourTeam),
             QStringLiteral("Team 5 (red): 0 goals, 4 players left"));
  }

  void whoSitsOutStandsFirst() {
    RefereeModel model;
    const QAbstractItemModelTester tester(&model);
    const auto cell = [&model](int row, RefereeModel::Column column) {
      return model.index(row, column).data().toString();
    };
    model.update(view().teams[0], {});
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
    model.update(view().teams[0], {reply});
    QCOMPARE(cell(1, RefereeModel::Robot), QStringLiteral("good"));
    reply.fallen = true;
    model.update(view().teams[0], {reply});
    QCOMPARE(cell(1, RefereeModel::Robot), QStringLiteral("fallen"));
    reply.age = 3.0;
    model.update(view().teams[0], {reply});
    QCOMPARE(cell(1, RefereeModel::Robot), QStringLiteral("late"));
    reply.age = 4.5;
    model.update(view().teams[0], {reply});
    QCOMPARE(cell(1, RefereeModel::Robot), QStringLiteral("offline"));
    // Another team's robot of that number.
    reply.team = 5;
    model.update(view().teams[0], {reply});
    QVERIFY(cell(1, RefereeModel::Robot).isEmpty());
    // Beside controls rows keep their places, and cards stand with the state.
    model.setCompact(true);
    model.update(view().teams[0], {});
    QCOMPARE(cell(0, RefereeModel::Player), QStringLiteral("1"));
    QCOMPARE(cell(1, RefereeModel::State), QStringLiteral("pushing 20 s · yellow"));
    // In few words, so that the time fits; the tooltip has all.
    link::RefereeTeamView other = view().teams[0];
    other.players[0].penalty = "pickup or incapable";
    model.update(other, {});
    QCOMPARE(cell(1, RefereeModel::State), QStringLiteral("pickup 20 s · yellow"));
    QCOMPARE(model.index(1, RefereeModel::State).data(Qt::ToolTipRole).toString(),
             QStringLiteral("pickup or incapable · yellow"));
    model.update({}, {});
    QCOMPARE(model.rowCount(), 0);
  }
};

PITCHBOARD_GUI_TEST(TestRefereeModel)

}  // namespace tst_referee_model

#include "tst_referee_model.moc"

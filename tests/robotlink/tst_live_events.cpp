// SPDX-License-Identifier: GPL-3.0-or-later
// What two live frames differ in, as events: frames are made by hand, there is no network.
#include <QtTest>

#include <robotlink/live/live_events.h>
#include "../support/robot_keys.h"

namespace tst_live_events {

using namespace pitchboard;
using namespace pitchboard::link;
using Kind = MatchEventKind;

namespace {

struct Stage {
  LiveEvents events;
  MatchFrame frame;

  std::vector<MatchEvent> at(double time) {
    frame.snapshot.time = time;
    return events.compare(frame);
  }
  RobotFrame& robot(int id, TeamColor team = TeamColor::Blue) {
    RobotFrame& seen = frame.robots.emplace_back();
    seen.identity = {{}, team, id, false};
    seen.key = keyOf(seen.identity);
    seen.uid = uidOf(seen.key);
    seen.name = seen.identity.name();
    seen.link.emplace().sender = {*telemetry::parseAddress("192.168.0." + std::to_string(id)),
                                  4000};
    return seen;
  }
  Game& referee() {
    frame.reception.sender = "192.168.0.99:3838";
    frame.reception.version = 17;
    Game& game = frame.game.emplace();
    game.clock = 600;
    game.teams[0].number = 12;
    game.teams[1].number = 5;
    game.teams[1].colour = TeamColor::Unknown;
    return game;
  }
  /// None: normal play.
  void give(SetPlay play) {
    frame.game->restart = {};
    if (play == SetPlay::None) return;
    frame.game->restart.kind = play;
    frame.game->restart.step = Restart::Step::Taking;
  }
};

std::vector<Kind> kindsOf(const std::vector<MatchEvent>& events) {
  std::vector<Kind> kinds;
  for (const MatchEvent& event : events) kinds.push_back(event.kind);
  return kinds;
}

using Kinds = std::vector<Kind>;

}  // namespace

class TestLiveEvents : public QObject {
  Q_OBJECT
 private slots:
  void nothingHappensWhileNothingChanges() {
    Stage s;
    QVERIFY(s.at(0.1).empty());
    s.robot(1);
    s.referee();
    QVERIFY(!s.at(0.2).empty());
    QVERIFY(s.at(0.3).empty());
    s.frame.game->clock = 599;
    s.frame.robots[0].link->age = std::chrono::milliseconds(500);
    QVERIFY(s.at(0.4).empty());
  }

  void aRobotGoesOfflineAndComesBack() {
    Stage s;
    s.robot(3, TeamColor::Red);
    auto reported = s.at(1.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::RobotReceived}));
    QCOMPARE(reported[0].detail, std::string("192.168.0.3:4000"));
    s.frame.robots[0].link->timedOut = true;
    reported = s.at(7.5);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::RobotOffline}));
    QCOMPARE(reported[0].time, 7.5);
    QCOMPARE(reported[0].robot, s.frame.robots[0].uid);
    QCOMPARE(reported[0].name, std::string("R3"));
    QCOMPARE(sentenceOf(reported[0]), std::string("R3 went offline"));
    // The last message came at 1 s, the next one at 38 s.
    s.frame.robots[0].link->age = std::chrono::seconds(30);
    QVERIFY(s.at(31.0).empty());
    s.frame.robots[0].link->timedOut = false;
    s.frame.robots[0].link->age = {};
    reported = s.at(38.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::RobotBack}));
    QCOMPARE(sentenceOf(reported[0]), std::string("R3 is online again after 37 s"));
  }

  void losingTheBallIsReportedOnce() {
    Stage s;
    s.robot(3).ball.emplace();
    (void)s.at(1.0);
    s.frame.robots[0].ball.reset();
    QVERIFY(s.at(2.9).empty());
    const auto lost = s.at(3.0);
    QCOMPARE(kindsOf(lost), (Kinds{Kind::BallLost}));
    QCOMPARE(sentenceOf(lost[0]), std::string("B3 lost the ball: not seen for 2 s"));
    QVERIFY(s.at(9.0).empty());
    s.frame.robots[0].ball.emplace();
    QCOMPARE(kindsOf(s.at(9.1)), (Kinds{Kind::BallSeen}));
    // One that is offline says nothing of the ball.
    s.frame.robots[0].ball.reset();
    s.frame.robots[0].link->timedOut = true;
    QCOMPARE(kindsOf(s.at(20.0)), (Kinds{Kind::RobotOffline}));
  }

  void aForgottenRobotIsReceivedAgain() {
    Stage s;
    s.robot(1);
    (void)s.at(1.0);
    s.frame.robots.clear();
    QVERIFY(s.at(2.0).empty());
    s.robot(1).link->timedOut = true;
    QCOMPARE(kindsOf(s.at(3.0)), (Kinds{Kind::RobotReceived, Kind::RobotOffline}));
  }

  void anotherAddressIsReportedAndTheRobotStays() {
    Stage s;
    s.robot(3);
    (void)s.at(1.0);
    s.frame.robots[0].link->sender.port = 4001;
    QVERIFY(s.at(2.0).empty());  // a new socket is no other address
    s.frame.robots[0].link->sender.address = *telemetry::parseAddress("192.168.0.77");
    const auto reported = s.at(3.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::AddressChanged}));
    QCOMPARE(reported[0].robot, s.frame.robots[0].uid);
    QCOMPARE(reported[0].detail, std::string("192.168.0.3 to 192.168.0.77"));
    QVERIFY(s.at(4.0).empty());
  }

  void aClockThatWasSetIsReportedOnce() {
    using namespace std::chrono_literals;
    LiveEvents events;
    QVERIFY(events.compareClock(0s, 1.0).empty());
    QVERIFY(events.compareClock(40ms, 2.0).empty());  // drift
    const auto reported = events.compareClock(1h, 3.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::ClockSet}));
    QCOMPARE(reported[0].time, 3.0);
    QCOMPARE(reported[0].value, std::optional(3600));
    QVERIFY(events.compareClock(1h + 10ms, 4.0).empty());
    QCOMPARE(events.compareClock(-1h, 5.0).at(0).value, std::optional(-7200));
  }

  void aSecondSenderIsReportedOnce() {
    Stage s;
    s.robot(1);
    (void)s.at(1.0);
    s.frame.robots[0].link->conflict = true;
    const auto reported = s.at(2.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::SecondSender}));
    QCOMPARE(reported[0].detail, std::string("192.168.0.1:4000"));
    QVERIFY(s.at(3.0).empty());
    s.frame.robots[0].link->conflict = false;
    QVERIFY(s.at(4.0).empty());
    s.frame.robots[0].link->conflict = true;
    QCOMPARE(kindsOf(s.at(5.0)), (Kinds{Kind::SecondSender}));
  }

  void aPenaltyBeginsChangesAndEnds() {
    Stage s;
    s.robot(1);
    (void)s.at(1.0);
    s.frame.robots[0].penalty = Penalty{PenaltyKind::Pushing, 30};
    auto reported = s.at(2.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::Penalised}));
    QCOMPARE(reported[0].detail, std::string("pushing"));
    QCOMPARE(reported[0].value, 30);
    QCOMPARE(sentenceOf(reported[0]), std::string("B1 penalised: pushing, 30 s"));
    s.frame.robots[0].penalty->secondsLeft = 12;  // counting down is no event
    QVERIFY(s.at(3.0).empty());
    s.frame.robots[0].penalty->kind = PenaltyKind::PickUp;
    QCOMPARE(kindsOf(s.at(4.0)), (Kinds{Kind::Penalised}));
    s.frame.robots[0].penalty.reset();
    QCOMPARE(kindsOf(s.at(5.0)), (Kinds{Kind::PenaltyOver}));
  }

  void theGameGoesOn() {
    Stage s;
    s.referee();
    auto reported = s.at(1.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::RefereeReceived, Kind::GameState}));
    QCOMPARE(reported[0].value, 17);
    QCOMPARE(reported[1].detail, std::string("INITIAL"));
    s.frame.game->state = PlayState::Playing;
    s.frame.game->clock = 595;
    reported = s.at(2.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::GameState}));
    QCOMPARE(sentenceOf(reported[0]), std::string("PLAYING at 09:55"));
    QCOMPARE(labelOf(reported[0]), std::string("PLAYING"));
    s.give(SetPlay::CornerKick);
    reported = s.at(3.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::SetPlay}));
    QCOMPARE(sentenceOf(reported[0]), std::string("corner kick"));
    s.give(SetPlay::None);
    QCOMPARE(sentenceOf(s.at(4.0).at(0)), std::string("normal play"));
    s.frame.game->stopped = true;
    QCOMPARE(kindsOf(s.at(5.0)), (Kinds{Kind::PlayStopped}));
    s.frame.game->stopped = false;
    QCOMPARE(kindsOf(s.at(6.0)), (Kinds{Kind::PlayGoesOn}));
    s.frame.game->half = 2;
    reported = s.at(7.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::Half}));
    QCOMPARE(reported[0].value, 2);
    s.frame.game->phase = GamePhase::ExtraTime;
    QCOMPARE(kindsOf(s.at(8.0)), (Kinds{Kind::GamePhase}));
  }

  void whatAGameHadBegunWithIsReportedToWhoComesLater() {
    Stage s;
    Game& game = s.referee();
    game.half = 2;
    s.give(SetPlay::GoalKick);
    game.teams[0].score = 2;  // no goal: nobody saw it
    QCOMPARE(kindsOf(s.at(1.0)),
             (Kinds{Kind::RefereeReceived, Kind::GameState, Kind::SetPlay, Kind::Half}));
  }

  void aGoalBelongsToItsTeamOnBothSides() {
    Stage s;
    s.referee();
    (void)s.at(1.0);
    s.frame.game->teams[0].score = 1;
    auto reported = s.at(2.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::Goal}));
    QVERIFY(reported[0].side == Side::Left);
    QCOMPARE(reported[0].team, 12);
    QCOMPARE(reported[0].colour, std::optional(TeamColor::Blue));
    QCOMPARE(reported[0].score, (sim::Score{1, 0}));
    QCOMPARE(sentenceOf(reported[0]), std::string("goal for BLUE, 1 : 0"));
    // At half-time the teams change sides: nobody scored.
    std::swap(s.frame.game->teams[0], s.frame.game->teams[1]);
    QVERIFY(s.at(3.0).empty());
    s.frame.game->teams[0].score = 1;
    reported = s.at(4.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::Goal}));
    QVERIFY(reported[0].side == Side::Left);
    QCOMPARE(reported[0].team, 5);
    QCOMPARE(labelOf(reported[0]), std::string("goal TEAM 5"));
    s.frame.game->teams[0].score = 0;
    reported = s.at(5.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::ScoreCorrected}));
    QCOMPARE(reported[0].score, (sim::Score{0, 1}));
  }

  void theRefereeGoesOfflineAndAnotherOneSends() {
    Stage s;
    s.referee();
    (void)s.at(1.0);
    s.frame.reception.timedOut = true;
    QCOMPARE(kindsOf(s.at(2.0)), (Kinds{Kind::RefereeOffline}));
    s.frame.reception.timedOut = false;
    QCOMPARE(kindsOf(s.at(3.0)), (Kinds{Kind::RefereeBack}));
    s.frame.reception.conflict = true;
    QCOMPARE(kindsOf(s.at(4.0)), (Kinds{Kind::SecondReferee}));
    s.frame.reception.sender = "192.168.0.98:3838";
    const auto reported = s.at(5.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::RefereeReceived}));
    QCOMPARE(reported[0].detail, std::string("192.168.0.98:3838"));
  }

  void portsAreLostAndFoundAgain() {
    LiveEvents events;
    telemetry::ReceiverStatus network;
    network.ports.resize(2);
    network.ports[0].port = 1241;
    network.ports[0].bound = true;
    network.ports[1].port = 1242;
    network.ports[1].problem = "Port 1242 is taken by another program.";
    auto reported = events.comparePorts(network, {}, 1.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::PortLost}));
    QCOMPARE(reported[0].value, 1242);
    QCOMPARE(reported[0].detail, network.ports[1].problem);
    QVERIFY(events.comparePorts(network, {}, 2.0).empty());
    network.ports[1].bound = true;
    network.ports[1].problem.clear();
    reported = events.comparePorts(network, {}, 3.0);
    QCOMPARE(kindsOf(reported), (Kinds{Kind::PortBack}));
    QCOMPARE(sentenceOf(reported[0]), std::string("port 1242 is open now"));
  }

  void afterClearEverythingIsNewAgain() {
    Stage s;
    s.robot(1);
    s.referee();
    const auto first = s.at(1.0);
    s.events = {};
    QCOMPARE(kindsOf(s.at(2.0)), kindsOf(first));
  }

  void aLowBatteryIsReportedOnce() {
    Stage s;
    RobotFrame& robot = s.robot(2);
    const auto volts = [&](double value) {
      robot.battery = telemetry::batteryAt(value, telemetry::defaultBattery);
    };
    volts(16.4);
    s.at(0.0);
    volts(15.9);
    const auto events = s.at(1.0);
    QCOMPARE(kindsOf(events), (Kinds{Kind::BatteryLow}));
    QCOMPARE(events[0].value, std::optional(159));
    QCOMPARE(sentenceOf(events[0]), std::string("B2 has a low battery: 15.9 V"));
    // It trembles around the limit, then another one is put in, which gets low as well.
    for (const double value : {16.1, 15.9, 16.1}) {
      volts(value);
      QVERIFY(s.at(2.0).empty());
    }
    volts(18.0);
    QVERIFY(s.at(3.0).empty());
    volts(15.8);
    QCOMPARE(kindsOf(s.at(4.0)), (Kinds{Kind::BatteryLow}));
  }
};

PITCHBOARD_TEST(TestLiveEvents)

}  // namespace tst_live_events

#include "tst_live_events.moc"

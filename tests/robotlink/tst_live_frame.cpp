// SPDX-License-Identifier: GPL-3.0-or-later
// Frames of received robots, from values made by hand: no network, no clock.

#include <QtTest>

#include <robotlink/frame/build_robot.h>
#include <robotlink/match/match_runner.h>
#include <robotlink/match/referee_packet.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/recorded_frame.h>
#include <simcore/world/published_frame.h>
#include <telemetry/referee/gamecontroller_encoder.h>

#include "../support/group_facts.h"
#include "../support/recorded_packets.h"
#include "../support/robot_keys.h"
#include "live_frame.h"

namespace tst_live_frame {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;
using telemetry::RefereeState;
using telemetry::RefereeTracker;
using telemetry::RobotStatus;
using telemetry::TeamStatus;

namespace {

const telemetry::WallTime start{std::chrono::seconds(1'700'000'000)};
const auto decoder = std::make_shared<const telemetry::TextDecoder>();

/// A robot that said this message (the published order, without the end).
RobotStatus robotSending(const std::string& message) {
  RobotStatus robot;
  const std::string text = message + " OUT";
  telemetry::DecodedText decoded;
  decoder->decode(text, decoded);
  robot.key = {0, decoded.robot, 0};
  robot.sender = {{0x0a000000U + static_cast<std::uint32_t>(decoded.robot)}, 4000};
  robot.decoder = decoder;
  robot.values.assign(decoded.values.begin(),
                      decoded.values.begin() + static_cast<std::ptrdiff_t>(decoded.count));
  for (std::size_t i = 0; i < decoded.count; ++i) robot.texts.emplace_back(decoded.texts[i]);
  return robot;
}

/// n X Y THETA BELIEF BALL_DIST BALL_ANGLE, five flags, ACTION_A IMU_EULER_Z VOLTAGE
const std::string atTheCentre = "450 300 0 20 100 90 1 1 1 0 1 8 0.5 165";

struct Received {
  LiveOptions options;
  TeamStatus team;
  RefereeTracker referee;

  explicit Received(std::vector<RobotStatus> robots) {
    team.time = start;
    team.robots = std::move(robots);
  }
  MatchFrame frame(double time = 3.0) { return liveFrame(options, team, referee, time); }
};

/// What is shown of a game. Packets of some versions name no kick-off once the ball is free, and
/// have no step of a set play.
QString textOf(const Game& game) {
  const auto text = [](auto value) { return QString::fromStdString(std::string(labelOf(value))); };
  const auto numberOf = [&game](int team) {
    return QString::number(team < 0 ? 0 : game.teams[static_cast<std::size_t>(team)].number);
  };
  QStringList out{text(game.state), text(game.setPlay()), text(game.phase),
                  text(game.countdownTo())};
  for (const int value :
       {game.half, int(game.stopped), game.secondsLeft(), game.countdownSeconds()}) {
    out << QString::number(value);
  }
  out << numberOf(game.setPlayTeam());
  if (game.league == League::Humanoid) out << text(game.restart.step) << numberOf(game.kickOff);
  for (const bool right : {false, true}) {
    const GameTeam& team = game.teamAt(right);
    out << QStringLiteral("\nteam %1 %2 %3 %4")
               .arg(team.number)
               .arg(info(team.colour).name.data())
               .arg(team.score)
               .arg(team.playing());
    for (const int shirt : team.onField()) {
      const GamePlayer& p = *team.player(shirt);
      out << QStringLiteral("%1 %2 %3 %4")
                     .arg(shirt)
                     .arg(text(p.penalty))
                     .arg(game.penaltySeconds(p))
                     .arg(game.league == League::HumanoidSoccer  // packets have no cards
                              ? p.warnings + 1000 * p.cautions
                              : p.warnings + 10 * p.yellow + 100 * p.red + 1000 * p.cautions) +
                 (p.goalkeeper ? "g" : "");
    }
  }
  return out.join("; ");
}

RefereeState stateOfGame() {
  RefereeState state;
  state.version = 12;
  state.playersPerTeam = 4;
  state.state = 3;
  state.firstHalf = 1;
  state.secsRemaining = 321;
  for (std::size_t side = 0; side < 2; ++side) {
    telemetry::RefereeTeam& team = state.teams[side];
    team.number = 5 + static_cast<int>(side);
    team.colour = static_cast<int>(side);
    team.score = 2 - static_cast<int>(side);
    team.slotCount = 4;
    for (int player = 0; player < 4; ++player) {
      team.allSlots[static_cast<std::size_t>(player)].number = player + 1;
    }
  }
  return state;
}

}  // namespace

class TestLiveFrame : public QObject {
  Q_OBJECT

 private slots:
  void nothingIsReceived() {
    const MatchFrame frame = Received({}).frame(7.5);
    QVERIFY(frame.origin == FrameOrigin::Live);
    QVERIFY(!frame.truthKnown && !frame.ballKnown);
    QVERIFY(frame.robots.empty() && !frame.game && frame.teamBalls.empty());
    QCOMPARE(frame.snapshot.time, 7.5);
    QVERIFY(frame.robot(receivedAs(1)) == nullptr);
  }

  void aRobotStandsAtItsReportedPose() {
    Received received({robotSending("3 " + atTheCentre)});
    const MatchFrame frame = received.frame();
    QCOMPARE(frame.robots.size(), std::size_t{1});
    const RobotFrame& robot = frame.robots[0];
    QCOMPARE(frame.robot(receivedAs(3)), &robot);
    QCOMPARE(robot.identity.number, 3);
    QVERIFY(robot.poseKnown() && !robot.timedOut());
    const Pose centre =
        sim::published_frame::studioFromLocalization(received.options.field, {450.0, 300.0, 0.0});
    QVERIFY(robot.pose == centre);
    QCOMPARE(robot.headYaw, centre.yaw);
    QCOMPARE(robot.action, 8);
    QVERIFY(robot.link && robot.decided == std::optional(8));
    QCOMPARE(robot.sigma, std::optional(0.2));
    // A metre away, to its left.
    QVERIFY(robot.ball);
    const Point ball = robot.ball->place;
    QVERIFY(std::abs(distance(ball, centre.position) - 1.0) < 1e-9);
    const double direction =
        std::atan2(ball.y - centre.position.y, ball.x - centre.position.x) - centre.yaw;
    QVERIFY(std::abs(std::sin(direction) - 1.0) < 1e-9);
    QCOMPARE(robot.values.size(), std::size_t{15});
    QCOMPARE(robot.values[1].name, std::string("LOCALIZATION_X"));
    QCOMPARE(robot.values[1].text, std::string("450"));
    QCOMPARE(robot.values[1].unit, std::string("cm"));
  }

  void itsLinkIsPassedOnUnchanged() {
    RobotStatus status = robotSending("2 " + atTheCentre);
    status.age = 1500ms;
    status.rate = 1.25;
    status.jitter = 0.02;
    status.loss = 0.5;
    status.messages = 11;
    status.bytes = 900;
    status.errorCount = 4;
    status.recoveries = 2;
    status.lost = 11;
    status.conflict = true;
    status.processes[3] = {telemetry::HeartbeatState::NotResponding, 0.1, 8s};
    status.battery = telemetry::batteryAt(15.9, telemetry::defaultBattery);
    const RobotFrame robot = Received({status}).frame().robots.at(0);
    const telemetry::LinkHealth& health = *robot.link;
    QCOMPARE(health.sender, status.sender);
    QCOMPARE(health.age, status.age);
    QCOMPARE(health.rate, status.rate);
    QCOMPARE(health.jitter, status.jitter);
    QVERIFY(health.loss == status.loss && robot.battery == status.battery);
    QCOMPARE(health.messages, status.messages);
    QCOMPARE(health.bytes, status.bytes);
    QCOMPARE(health.errorCount, status.errorCount);
    QCOMPARE(health.recoveries, status.recoveries);
    QCOMPARE(health.lost, status.lost);
    QVERIFY(health.conflict && robot.battery->low);
    QVERIFY(robot.lamps[3].state == telemetry::HeartbeatState::NotResponding);
    QCOMPARE(robot.lamps[3].since, status.processes[3].since);
  }

  void numbersBeyondTheFieldAreDrawnSomewhere() {
    const MatchFrame frame =
        Received(
            {robotSending("1 2000000000 -2000000000 999999999 1e30 99999 0 1 1 1 1 1 99 0 -5")})
            .frame();
    const RobotFrame& robot = frame.robots.at(0);
    QVERIFY(std::abs(robot.pose.position.x) < 200 && std::abs(robot.pose.position.y) < 200);
    QVERIFY(std::isfinite(robot.pose.yaw));
    QVERIFY(!robot.ball);  // a kilometre away: no ball
    QCOMPARE(robot.values[1].text, std::string("2000000000"));
  }

  void withoutAPositionItIsReceivedButNotShown() {
    RobotStatus status = robotSending("4 " + atTheCentre);
    status.values[1] = std::nan("");
    const MatchFrame frame = Received({status}).frame();
    QVERIFY(!frame.robots.at(0).poseKnown());
    QVERIFY(!frame.robots[0].ball);
  }

  void robotsThatAgreeMakeTheTeamsBall() {
    // The third one sees its ball elsewhere; the fourth has sent nothing for long.
    Received received({robotSending("1 450 300 0 20 100 0 1 1 1 1 1 8 0 165"),
                       robotSending("2 450 290 0 20 100 0 1 1 1 1 1 8 0 165"),
                       robotSending("3 100 100 0 20 100 90 1 1 1 1 1 8 0 165"),
                       robotSending("4 450 300 0 20 100 0 1 1 1 1 1 8 0 165")});
    received.team.robots[3].timedOut = true;
    const MatchFrame frame = received.frame();
    QCOMPARE(frame.teamBalls.size(), std::size_t{1});
    QCOMPARE(frame.teamBalls[0].agree, 2);
    QCOMPARE(frame.teamBalls[0].see, 3);
    QVERIFY(!frame.robots[3].ball);
  }

  void eachTeamAgreesForItself() {
    // Five see the ball left of the centre, four of the other team right of it.
    std::vector<RobotFrame> robots(9);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      robots[i].identity.team = i < 5 ? TeamColor::Blue : TeamColor::Red;
      robots[i].ball = SeenBall{{i < 5 ? -1.0 : 1.0, 0.0}, 1.0, 0.0};
    }
    const std::vector<TeamBall> balls = agreedBalls(robots);
    QCOMPARE(balls.size(), std::size_t{2});
    QVERIFY(balls[0].team == TeamColor::Blue && balls[1].team == TeamColor::Red);
    QCOMPARE(balls[0].agree, 5);
    QCOMPARE(balls[0].see, 5);
    QCOMPARE(balls[1].agree, 4);
    QCOMPARE(balls[1].see, 4);
    QCOMPARE(balls[1].position.x, 1.0);
  }

  void aBlackboardAndAMessageOfTheSameAreSeenAlike() {
    RobotFrame reported = Received({robotSending("3 " + atTheCentre)}).frame().robots.at(0);
    const std::map<std::string, double> variables{
        {"LOCALIZATION_X", 450},      {"LOCALIZATION_Y", 300},   {"LOCALIZATION_THETA", 0},
        {"LOCALIZATION_RBT01_X", 20}, {"VISION_BALL_DIST", 100}, {"VISION_PAN_DEG", 90},
        {"DECISION_ACTION_A", 8},     {"VISION_LOST", 0},        {"VISION_WORKING", 1},
        {"LOCALIZATION_WORKING", 1},  {"DECISION_WORKING", 1},   {"IMU_WORKING", 1},
        {"CONTROL_WORKING", 1},       {"VOLTAGE", 165}};
    telemetry::GroupInfo group{
        "B3", {}, telemetry::facts({{"attached", "1"}, {"robot", "3"}, {"number", "3"}})};
    std::vector<double> row;
    for (const auto& [name, value] : variables) {
      group.columns.emplace_back().name = name;
      row.push_back(value);
    }
    telemetry::SeriesStore store;
    store.append(store.addGroup(group), {1.0, {}, row});
    const std::vector<RobotFrame> read = RecordedFrames().boardsAt(store, 1.0);
    QCOMPARE(read.size(), std::size_t{1});
    QVERIFY(read[0].belief == reported.belief && read[0].pose == reported.pose);
    QVERIFY(read[0].sigma == reported.sigma && read[0].ball == reported.ball && reported.ball);
    QVERIFY(read[0].decided == reported.decided);
    for (const telemetry::ProcessHeartbeat& lamp : read[0].lamps) {
      QVERIFY(lamp.state == telemetry::HeartbeatState::Working);
    }
    // What is lost, or seen by a vision that does not work, is no ball.
    for (const char* name : {"VISION_LOST", "VISION_WORKING"}) {
      telemetry::SeriesStore other;
      std::vector<double> changed = row;
      const auto at = std::distance(variables.begin(), variables.find(name));
      changed[static_cast<std::size_t>(at)] = 1.0 - changed[static_cast<std::size_t>(at)];
      other.append(other.addGroup(group), {1.0, {}, changed});
      QVERIFY(!RecordedFrames().boardsAt(other, 1.0).at(0).ball);
    }
  }

  void aLampStopsRespondingOnlyAfterItHasWorked() {
    using telemetry::FieldMeaning;
    using telemetry::HeartbeatState;
    LampMemory memory;
    double vision = 0.0;
    const RobotReader reader = [&vision](FieldMeaning meaning) -> std::optional<double> {
      if (meaning == FieldMeaning::Vision) return vision;
      return std::nullopt;
    };
    QVERIFY(memory.note(reader, 0.0)[1].state == HeartbeatState::Unknown);
    vision = 1.0;
    QVERIFY(memory.note(reader, 1.0)[1].state == HeartbeatState::Working);
    vision = 0.0;
    QVERIFY(memory.note(reader, 1.9)[1].state == HeartbeatState::Working);
    QVERIFY(memory.note(reader, 2.5)[1].state == HeartbeatState::NotResponding);
    const auto& lamps = memory.note(reader, 10.5);
    QCOMPARE(telemetry::secondsOf(lamps[1].since), 8.0);
    QVERIFY(lamps[0].state == HeartbeatState::Unknown);
    memory.jump();
    QVERIFY(memory.note(reader, 3.0)[1].state == HeartbeatState::NotResponding);
    memory.saw(1, 2.5);
    QVERIFY(memory.note(reader, 3.0)[1].state == HeartbeatState::Working);
  }

  void aCentimetreIsNotCutOff() {
    RobotStatus status = robotSending("4 " + atTheCentre);
    status.values[1] = 450.75;
    const MatchFrame frame = Received({status}).frame();
    QVERIFY(std::abs(frame.robots.at(0).pose.position.x - 0.0075) < 1e-9);
  }

  void twoSendersOfOneNumberAreTwoRobots() {
    RobotStatus first = robotSending("3 " + atTheCentre);
    RobotStatus second = first;
    second.key.sender = 1;
    Received received({first, second});
    const MatchFrame frame = received.frame();
    QCOMPARE(frame.robots[0].key, receivedAs(3));
    QCOMPARE(frame.robots[1].key, receivedAs(3, 1));
    QCOMPARE(frame.robots[1].identity.number, 3);
    // It keeps its key, whoever else is there.
    received.team.robots = {second};
    QCOMPARE(received.frame().robots.at(0).key, receivedAs(3, 1));
  }

  void teamsHaveTheNamesOfTheirSetups() {
    Received received({});
    telemetry::TeamSetup& setup = received.options.team.teams.emplace_back();
    setup.name = "RoboFEI";
    setup.number = 6;
    QVERIFY(received.referee.accept(stateOfGame(), {{1}, 3838}, start) ==
            RefereeTracker::Verdict::Shown);
    const MatchFrame frame = received.frame();
    QVERIFY(teamName(frame.game->teams[0].number, frame.teams).empty());
    QVERIFY(teamName(frame.game->teams[1].number, frame.teams) == "RoboFEI");
  }

  void theRefereeGivesColourScoreAndPenalties() {
    Received received({robotSending("2 " + atTheCentre)});
    received.options.ourTeam = 6;
    received.options.ourColour = TeamColor::Yellow;
    RefereeState state = stateOfGame();
    state.teams[1].allSlots[1].penalty = 1;
    state.teams[1].allSlots[1].secondsLeft = 30;
    QVERIFY(received.referee.accept(state, {{1}, 3838}, start) == RefereeTracker::Verdict::Shown);
    received.team.time = start + 2s;
    const MatchFrame frame = received.frame();
    QVERIFY(frame.game);
    QCOMPARE(frame.reception.ourTeam, 6);
    QCOMPARE(frame.reception.age, 2.0);
    QCOMPARE(frame.game->teams[1].playing(), 3);
    QVERIFY(frame.snapshot.score == (sim::Score{2, 1}));
    QCOMPARE(frame.snapshot.clock, 321.0);
    QVERIFY(frame.snapshot.clockRunning);
    QVERIFY(frame.robots.at(0).identity.team == TeamColor::Red);
    QVERIFY(frame.robots[0].penalty);
    QCOMPARE(frame.robots[0].penalty->secondsLeft, 30);
    // A number that does not play: the colour that the user chose, and nobody's penalty.
    received.options.ourTeam = 9;
    const MatchFrame other = received.frame();
    QCOMPARE(other.reception.ourTeam, 0);
    QVERIFY(other.robots.at(0).identity.team == TeamColor::Yellow);
    QVERIFY(!other.robots[0].penalty);
    // Ten seconds without a word: the state is shown, the clock is not said to run.
    received.team.time = start + 11s;
    const MatchFrame late = received.frame();
    QVERIFY(late.reception.timedOut && !late.snapshot.clockRunning);
  }

  void substitutesThatCameInAreCounted() {
    Received received({});
    RefereeState state = stateOfGame();
    state.playersPerTeam = 3;
    // Player 1 was taken out for player 4; player 2 sits 20 s for pushing.
    state.teams[0].allSlots[0].penalty = 14;
    state.teams[0].allSlots[1].penalty = 31;
    state.teams[0].allSlots[1].secondsLeft = 20;
    state.teams[0].allSlots[1].yellow = 1;
    QVERIFY(received.referee.accept(state, {{1}, 3838}, start) == RefereeTracker::Verdict::Shown);
    const GameTeam team = received.frame().game->teams[0];
    QCOMPARE(team.playing(), 2);
    QCOMPARE(team.onField(), (std::vector<int>{2, 3, 4}));
    QCOMPARE(team.player(2)->penalty, PenaltyKind::Pushing);
    QCOMPARE(team.player(2)->ticksLeft, 20);
    QCOMPARE(team.player(2)->yellow, 1);
    QCOMPARE(team.player(4)->penalty, PenaltyKind::None);
  }

  void whoTakesASetPlayAndHowFarItIs_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<SetPlay>("setPlay");
    QTest::addColumn<int>("team");
    QTest::addColumn<Restart::Step>("step");
    QTest::addColumn<CountdownTo>("countdown");
    using enum SetPlay;
    using Step = Restart::Step;
    // Recorded from the running programs; the last column is what the rules say of the time.
    QTest::newRow("corner") << "v12hl688_CORNER_KICK" << CornerKick << 1 << Step::Placing
                            << CountdownTo::Nothing;
    QTest::newRow("free kick, prepare") << "v12hl688_DIRECT_FREEKICK_sub1" << DirectFreeKick << 2
                                        << Step::Preparing << CountdownTo::Ready;
    QTest::newRow("free kick, ready") << "v12hl688_DIRECT_FREEKICK_sub2" << DirectFreeKick << 2
                                      << Step::Taking << CountdownTo::Nothing;
    QTest::newRow("kick-off") << "v12hl688_PLAYING_1-0" << None << 0 << Step::Executed
                              << CountdownTo::BallFree;
    QTest::newRow("ready") << "v12hl688_READY" << None << 0 << Step::Free << CountdownTo::Set;
    QTest::newRow("timeout") << "v12hl688_TIMEOUT" << None << 0 << Step::Free
                             << CountdownTo::TimeoutOver;
    QTest::newRow("break") << "v20hsl158_FINISHED" << None << 0 << Step::Free
                           << CountdownTo::NextHalf;
  }
  void whoTakesASetPlayAndHowFarItIs() {
    QFETCH(QString, file);
    QFETCH(SetPlay, setPlay);
    QFETCH(int, team);
    QFETCH(Restart::Step, step);
    QFETCH(CountdownTo, countdown);
    const auto decoded = telemetry::decodeReferee(recordedPacket(file));
    QVERIFY(decoded);
    Received received({});
    QVERIFY(received.referee.accept(std::get<RefereeState>(*decoded), {{1}, 3838}, start) ==
            RefereeTracker::Verdict::Shown);
    const Game game = *received.frame().game;
    QCOMPARE(game.setPlay(), setPlay);
    const int taker = game.setPlayTeam();
    QCOMPARE(taker < 0 ? 0 : game.teams[static_cast<std::size_t>(taker)].number, team);
    QCOMPARE(game.restart.step, step);
    QCOMPARE(game.countdownTo(), countdown);
  }

  // A simulated match in words, and its packets as another studio would show them.
  // A received packet, the match that would send it, and its recording.
  void sameViewWhereverItComesFrom_data() {
    QTest::addColumn<QString>("rules");
    for (const char* rules : {"humanoid-2021", "humanoid-soccer-2026"}) {
      QTest::newRow(rules) << QString(rules);
    }
  }
  void sameViewWhereverItComesFrom() {
    QFETCH(QString, rules);
    using sim::CallKind;
    Scenario scenario = loadScenario("match").value();
    scenario.settings.referee = refereeRuleSet(rules.toStdString()).value();
    scenario.settings.referee->automatic = false;
    scenario.settings.teams = {{TeamColor::Blue, 12, "RoboFEI"}, {TeamColor::Red, 5, "Guests"}};
    for (ScenarioRobot& robot : scenario.robots) robot.behaviour = std::string(noBehaviour);
    telemetry::SeriesStore store;
    const auto sampler = std::make_shared<MatchSampler>(
        std::shared_ptr<telemetry::RowSink>(std::shared_ptr<void>(), &store));
    const auto runner =
        MatchRunner::start(scenario, {}, true, VariableCatalog::published(), {sampler}).value();
    std::uint64_t tick = 0;
    QStringList countdowns;
    const auto check = [&](const sim::RefereeCall& call) {
      bool done = false;
      runner->execute([&](SimulatedMatch& match) {
        done = match.simulation().call(call).has_value();
        return Changed::Yes;
      });
      runner->runTo(tick += 30);
      QVERIFY(runner->waitUntilStill(60s));
      QVERIFY(done);
      std::string bytes;
      runner->read([&](const SimulatedMatch& match) {
        bytes =
            telemetry::encodeReferee(refereePacket(match.simulation().state(), 1, true)).value();
      });
      QVERIFY(runner->waitUntilStill(60s));
      Received received({});
      const auto packet = telemetry::decodeReferee(std::string_view(bytes)).value();
      QVERIFY(received.referee.accept(std::get<RefereeState>(packet), {{1}, 3838}, start) ==
              RefereeTracker::Verdict::Shown);
      const MatchFrame live = received.frame(), simulated = *runner->latest();
      RecordedFrames frames;
      const MatchFrame recorded = frames.frameAt(store, static_cast<double>(tick) / 60.0);
      QCOMPARE(textOf(*simulated.game), textOf(*live.game));
      QCOMPARE(textOf(*recorded.game), textOf(*live.game));
      countdowns << QString::fromStdString(std::string(labelOf(live.game->countdownTo())));
      for (const RobotFrame& robot : simulated.robots) {
        const int team = live.game->teamNumbered(robot.identity.team == TeamColor::Blue ? 12 : 5);
        const GameTeam& own = live.game->teams[static_cast<std::size_t>(team)];
        const auto penalty = penaltyOf(*live.game, own.player(robot.identity.number));
        QVERIFY(robot.penalty == penalty);
        QVERIFY(recorded.robot(robot.key)->penalty == penalty);
      }
    };
    using enum PlayState;
    check({.kind = CallKind::KickOff, .team = 1});
    check({.kind = CallKind::State, .state = Ready});
    check({.kind = CallKind::State, .state = Set});
    check({.kind = CallKind::State, .state = Playing});
    check({.kind = CallKind::Penalise, .robot = {2}, .penalty = PenaltyKind::Pushing});
    check({.kind = CallKind::Card, .robot = {4}, .value = 1});
    check({.kind = CallKind::Penalise, .robot = {5}, .penalty = PenaltyKind::Substitute});
    check({.kind = CallKind::Goal, .team = 0, .value = 1});
    check({.kind = CallKind::State, .state = Set});
    check({.kind = CallKind::State, .state = Playing});
    check({.kind = CallKind::SetPlay, .team = 0, .setPlay = SetPlay::CornerKick});
    check({.kind = CallKind::NextStep});
    check({.kind = CallKind::NextStep});
    check({.kind = CallKind::State, .state = Finished});
    check({.kind = CallKind::NextHalf});
    check({.kind = CallKind::Timeout, .team = 1});
    for (const char* waits : {"set", "ball free", "timeout over"})
      QVERIFY(countdowns.contains(waits));
  }

  void monitorModeShowsWhatReallyHappens() {
    Received received({});
    RefereeState hidden = stateOfGame();
    hidden.state = 2;
    QVERIFY(received.referee.accept(hidden, {{1}, 3838}, start) == RefereeTracker::Verdict::Shown);
    RefereeState truth = stateOfGame();
    truth.magic = {'R', 'G', 'T', 'D'};
    truth.secsRemaining = 318;
    QVERIFY(received.referee.accept(truth, {{1}, 3838}, start + 1s) ==
            RefereeTracker::Verdict::TrueData);
    telemetry::RobotReply reply;
    reply.version = 4;
    reply.team = 6;
    reply.player = 2;
    reply.fallen = 1;
    reply.pose = {1500.0F, -2000.0F, 0.5F};
    reply.ballAge = -1.0F;
    received.referee.accept(reply, {0x0a000007}, start + 1s);
    received.team.time = start + 3s;
    const MatchFrame frame = received.frame();
    QCOMPARE(frame.game->state, PlayState::Set);
    const RefereeReception& reception = frame.reception;
    QVERIFY(reception.truth);
    QCOMPARE(reception.truth->state, PlayState::Playing);
    QCOMPARE(reception.truth->secondsLeft(), 318);
    QCOMPARE(reception.truthAge, 2.0);
    QCOMPARE(reception.replies.size(), std::size_t{1});
    QCOMPARE(reception.replies[0].address, std::string("10.0.0.7"));
    QVERIFY(reception.replies[0].fallen && !reception.replies[0].ballAge);
    QCOMPARE(reception.replies[0].pose->position.x, 1.5);
    QCOMPARE(reception.replies[0].age, 2.0);
  }

  void coloursByNumber() {
    Received received({robotSending("1 " + atTheCentre), robotSending("2 " + atTheCentre),
                       robotSending("6 " + atTheCentre)});
    received.options.colourByNumber = true;
    const MatchFrame frame = received.frame();
    QVERIFY(frame.robots[0].identity.team == teamColors[0].color);
    QVERIFY(frame.robots[1].identity.team == teamColors[1].color);
    QVERIFY(frame.robots[2].identity.team == teamColors[0].color);
    QCOMPARE(frame.robots[1].identity.name(), std::string("R2"));
  }
};

PITCHBOARD_TEST(TestLiveFrame)

}  // namespace tst_live_frame

#include "tst_live_frame.moc"

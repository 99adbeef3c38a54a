// SPDX-License-Identifier: GPL-3.0-or-later
// The GameController's packets of a simulated match, in every version: sent in the rhythm of the
// controllers, and obeyed by another match that receives them.
#include <QtTest>

#include <cmath>
#include <map>
#include <set>

#include <robotlink/cognition/referee_orders.h>
#include <robotlink/match/referee_packet.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/rules/referee.h>
#include <simcore/world/referee_parameters.h>
#include <telemetry/referee/gamecontroller_encoder.h>

#include "../support/test_socket.h"

namespace tst_match_packets {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr std::uint32_t loopbackBroadcast = 0x7fffffff;  // 127.255.255.255
constexpr int tickRate = 60;
constexpr bool humanoidSoccer(int version) {
  return version >= 19;
}

/// Robots that stand, refereed by a person.
Scenario scenarioFor(int version, int size) {
  Scenario scenario = loadScenario("match").value();
  for (ScenarioRobot& robot : scenario.robots) robot.behaviour = "idle";
  sim::RefereeRules rules =
      **refereeRuleSet(humanoidSoccer(version) ? "humanoid-soccer-2026" : "humanoid-2021");
  rules.packetVersion = version;
  rules.packetSize = size;
  rules.automatic = false;
  scenario.settings.referee = rules;
  return scenario;
}

SimulatedMatch sending(int version, int size, int port) {
  MatchOptions options;
  options.process.particles = 100;
  options.process.refereePort = port;
  options.sendReferee = true;
  return SimulatedMatch::create(scenarioFor(version, size), options).value();
}

void play(SimulatedMatch& match, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * tickRate); ++i) match.tick();
}

/// Packets by version, since the last time.
std::map<int, int> receivedBy(const TestSocket& socket) {
  std::map<int, int> versions;
  for (std::string text = socket.take(); !text.empty(); text = socket.take()) {
    const auto packet = telemetry::decodeReferee(text);
    if (!packet) qFatal("%s", packet.error().text().c_str());
    ++versions[std::get<telemetry::RefereeState>(*packet).version];
  }
  return versions;
}

}  // namespace

class TestMatchPackets : public QObject {
  Q_OBJECT

  static void everyVersion() {
    QTest::addColumn<int>("version");
    QTest::addColumn<int>("size");
    // All that leagues have sent (reference: gamecontroller.md), not what the code says it knows.
    const int known[][2] = {{7, 116},  {8, 158},  {9, 244},  {10, 588}, {11, 592}, {11, 58},
                            {12, 640}, {12, 688}, {12, 54},  {13, 54},  {14, 62},  {15, 118},
                            {16, 118}, {17, 118}, {18, 118}, {19, 198}, {20, 158}};
    for (const auto& k : known) QTest::addRow("v%d, %d bytes", k[0], k[1]) << k[0] << k[1];
  }

 private slots:
  void everyVersionCanBeChosen() {
    for (const auto& parameter : sim::refereeCounts) {
      if (parameter.member != &sim::RefereeRules::packetVersion) continue;
      for (int version = 0; version < 256; ++version) {
        if (!telemetry::refereePacketSize(version)) continue;
        const bool inside = version >= parameter.least && version <= parameter.most;
        QVERIFY2(inside, qPrintable(QString("version %1 of the packets is outside the range of "
                                            "packet_version: change it in referee_parameters.h")
                                        .arg(version)));
      }
      return;
    }
    QFAIL("packet_version has no row");
  }

  void sentTwiceASecond_data() { everyVersion(); }
  void sentTwiceASecond() {
    QFETCH(int, version);
    QFETCH(int, size);
    const TestSocket socket(loopbackBroadcast);
    QVERIFY(socket.good());
    SimulatedMatch match = sending(version, size, socket.port());
    (void)receivedBy(socket);  // what was sent before the first tick
    play(match, 10.0);
    std::map<int, int> wanted{{version, 20}};
    // The controllers of 2014 to 2016 send one of version 7 behind each of theirs.
    if (version == 8 || version == 9) wanted[7] = 20;
    std::map<int, int> received = receivedBy(socket);
    for (const auto& [which, count] : wanted) {
      QVERIFY2(std::abs(received[which] - count) <= 1,
               qPrintable(QString::number(received[which])));
    }
    QCOMPARE(received.size(), wanted.size());
    if (!humanoidSoccer(version)) return;
    // When play is stopped they say so at once, and then five times a second for a second.
    QVERIFY(match.simulation().call({.kind = sim::CallKind::State, .state = PlayState::Ready}));
    QVERIFY(match.simulation().call({.kind = sim::CallKind::State, .state = PlayState::Set}));
    QVERIFY(match.simulation().call({.kind = sim::CallKind::State, .state = PlayState::Playing}));
    play(match, 20.0);
    (void)receivedBy(socket);
    QVERIFY(match.simulation().call({.kind = sim::CallKind::Stop}));
    match.tick();
    QVERIFY(receivedBy(socket)[version] >= 1);
    play(match, 1.1);
    received = receivedBy(socket);
    QVERIFY2(received[version] >= 5 && received[version] <= 8,
             qPrintable(QString::number(received[version])));
    play(match, 5.0);
    QVERIFY(std::abs(receivedBy(socket)[version] - 10) <= 1);
  }

  // The number of the packet before was repeated while play was stopped (176 176 176 177).
  void everyPacketHasTheNextNumber() {
    const TestSocket socket(loopbackBroadcast);
    SimulatedMatch match = sending(20, 158, socket.port());
    for (const auto state : {PlayState::Ready, PlayState::Set, PlayState::Playing}) {
      QVERIFY(match.simulation().call({.kind = sim::CallKind::State, .state = state}));
    }
    std::optional<int> last;
    int packets = 0;
    bool wrapped = false;
    const auto look = [&] {
      for (std::string text = socket.take(); !text.empty(); text = socket.take()) {
        const auto packet =
            std::get<telemetry::RefereeState>(telemetry::decodeReferee(text).value());
        if (last) QCOMPARE(*packet.packetNumber, (*last + 1) % 256);
        wrapped = wrapped || *packet.packetNumber == 255;
        last = packet.packetNumber;
        ++packets;
      }
    };
    for (int stop = 0; stop < 20; ++stop) {
      play(match, 5.2);
      QVERIFY(match.simulation().call({.kind = sim::CallKind::Stop}));
      play(match, 2.3);
      QVERIFY(match.simulation().call({.kind = sim::CallKind::GoOn}));
      look();
    }
    QVERIFY(packets > 300 && wrapped);
    // Also after a jump back: whoever listens would take lower numbers for late packets.
    const sim::WorldState before = match.simulation().state();
    play(match, 3.0);
    look();
    QVERIFY(match.simulation().restore(before));
    play(match, 3.0);
    look();
  }

  void teamsOfAnyColourNumberAndShirt_data() {
    QTest::addColumn<int>("colour");
    QTest::addColumn<int>("shirt");
    for (const TeamColor colour : {TeamColor::Black, TeamColor::Orange, TeamColor::Yellow}) {
      for (const int shirt : {1, 20, 23}) {
        QTest::addRow("%s, %d", info(colour).name.data(), shirt) << int(colour) << shirt;
      }
    }
  }
  void teamsOfAnyColourNumberAndShirt() {
    QFETCH(int, colour);
    QFETCH(int, shirt);
    Scenario scenario = scenarioFor(20, 158);
    scenario.settings.teams = {{TeamColor::Red, 5, "Guests"},
                               {static_cast<TeamColor>(colour), 12, "RoboFEI"}};
    const RobotId ours{1};
    for (ScenarioRobot& robot : scenario.robots) {
      if (robot.identity.team != TeamColor::Blue) continue;
      robot.identity.team = static_cast<TeamColor>(colour);
      robot.identity.number = robot.identity.id == ours ? shirt : robot.identity.number + 1;
    }
    auto match = SimulatedMatch::create(scenario, {}).value();
    play(match, 0.6);
    const sim::WorldState& world = match.simulation().state();
    const auto word = [&] { return match.blackboard(ours)->read(match.variables().comReferee); };
    // What a robot of team 12 receives, whose communication process nobody has changed.
    const auto received = [&] {
      const auto bytes = telemetry::encodeReferee(refereePacket(world, 1)).value();
      const auto packet = telemetry::decodeReferee(std::string_view(bytes)).value();
      const Game heard = telemetry::gameOf(std::get<telemetry::RefereeState>(packet));
      return RefereeOrders().take(heard, 12, world.game->teams[1].slotOf(shirt)).value_or(-1);
    };
    const auto call = [&](const sim::RefereeCall& one) {
      QVERIFY(match.simulation().call(one));
      play(match, 0.6);
      QCOMPARE(received(), word());
    };
    QCOMPARE(world.game->teams[1].number, 12);
    call({.kind = sim::CallKind::State, .state = PlayState::Ready});
    QCOMPARE(word(), refereeReady);
    call({.kind = sim::CallKind::Penalise, .robot = ours, .penalty = PenaltyKind::Pushing});
    QCOMPARE(word(), refereeStop);
    const sim::RobotIdentity& robot = world.robots[*match.simulation().indexOf(ours)];
    QCOMPARE(world.game->player(robot.team, robot.number)->penalty, PenaltyKind::Pushing);
    call({.kind = sim::CallKind::Pardon, .robot = ours});
    QCOMPARE(word(), refereeReady);
  }

  void aThirdColourIsRefused() {
    Scenario scenario = scenarioFor(20, 158);
    scenario.robots[0].identity.team = TeamColor::Black;
    const auto refused = SimulatedMatch::create(scenario, {});
    QVERIFY(!refused);
    QVERIFY2(refused.error().text().find("is between blue and red. Choose one of these teams") !=
                 std::string::npos,
             refused.error().text().c_str());
  }

  void obeyedByAnotherMatch_data() { everyVersion(); }
  void obeyedByAnotherMatch() {
    QFETCH(int, version);
    QFETCH(int, size);
    const int port = TestSocket().port();  // free, and given back before the match listens
    MatchOptions options;
    options.process.particles = 100;
    options.obeyReferee = port;
    // It has rules of its own; what it receives decides.
    auto obeying = SimulatedMatch::create(scenarioFor(12, 688), options).value();
    SimulatedMatch match = sending(version, size, port);
    const Game& wanted = *match.simulation().state().game;
    const Game& game = *obeying.simulation().state().game;
    const auto agrees = [&](auto&& same) {
      play(match, 0.5);
      obeying.tick();
      return same();
    };
    const auto call = [&](const sim::RefereeCall& one) {
      const auto done = match.simulation().call(one);
      if (!done) qFatal("%s", done.error().text().c_str());
    };
    const auto becomes = [&](PlayState state) {
      call({.kind = sim::CallKind::State, .state = state});
      return QTest::qWaitFor(
          [&] { return agrees([&] { return game.state == state && game.half == wanted.half; }); },
          30'000);
    };
    call({.kind = sim::CallKind::KickOff, .team = 1});
    QVERIFY(becomes(PlayState::Ready));
    QCOMPARE(game.kickOff, 1);
    QVERIFY(becomes(PlayState::Set));
    QVERIFY(becomes(PlayState::Playing));
    QVERIFY(std::abs(game.secondsLeft() - wanted.secondsLeft()) <= 2);

    call({.kind = sim::CallKind::Penalise, .robot = RobotId{2}, .penalty = PenaltyKind::Incapable});
    QTRY_VERIFY(agrees([&] {
      return game.teams[0].players[1].penalty == PenaltyKind::Incapable &&
             obeying.blackboard(RobotId{2})->read(obeying.variables().comReferee) == refereeStop;
    }));
    QCOMPARE(game.teams[0].players[0].penalty, PenaltyKind::None);
    call({.kind = sim::CallKind::Pardon, .robot = RobotId{2}});
    QTRY_VERIFY(agrees([&] { return game.teams[0].players[1].penalty == PenaltyKind::None; }));

    call({.kind = sim::CallKind::Goal, .team = 1, .value = 1});
    QTRY_VERIFY(agrees([&] { return game.teams[1].score == 1 && game.teams[0].score == 0; }));
    QVERIFY(becomes(PlayState::Finished));
    call({.kind = sim::CallKind::NextHalf});
    QTRY_VERIFY(agrees([&] { return game.half == 2 && game.swapped; }));
    QCOMPARE(game.teams[1].score, 1);
  }

  // States, halves, goals and penalties of the packets are events of the match, as those of its own
  // referee are.
  void whatIsObeyedIsReported_data() { everyVersion(); }
  void whatIsObeyedIsReported() {
    QFETCH(int, version);
    QFETCH(int, size);
    const TestSocket controller;
    const int port = TestSocket().port();
    MatchOptions options;
    options.process.particles = 100;
    options.obeyReferee = port;
    Scenario scenario = scenarioFor(12, 688);
    scenario.settings.teams = {{TeamColor::Blue, 1, "RoboFEI"}, {TeamColor::Red, 2, {}}};
    auto match = SimulatedMatch::create(scenario, options).value();
    // A game of this version, whose referee is this test.
    auto world = SimulatedMatch::create(scenarioFor(version, size), {}).value();
    sim::Simulation& game = world.simulation();
    std::vector<MatchEvent> events;
    match.drainEvents(events);
    int number = 0;
    const auto tellAndFind = [&](MatchEventKind kind, const std::string& sentence) {
      telemetry::RefereeState packet = refereePacket(game.state(), number++);
      const auto bytes = telemetry::encodeReferee(packet).value();
      events.clear();
      const auto isReported = [&] {
        match.tick();
        match.drainEvents(events);
        return std::ranges::any_of(events, [&](const MatchEvent& event) {
          return event.kind == kind && sentenceOf(event).starts_with(sentence);
        });
      };
      controller.send(static_cast<std::uint16_t>(port), bytes);
      if (!QTest::qWaitFor(isReported, 20'000)) qWarning("not reported: %s", sentence.c_str());
      return isReported();
    };
    const auto call = [&](const sim::RefereeCall& one) {
      if (const auto done = game.call(one); !done) qFatal("%s", done.error().text().c_str());
    };
    const auto changesTo = [&](PlayState state) {
      call({.kind = sim::CallKind::State, .state = state});
      return tellAndFind(MatchEventKind::GameState, std::string(labelOf(state)));
    };
    using Kind = MatchEventKind;
    QVERIFY(changesTo(PlayState::Ready));
    QVERIFY(changesTo(PlayState::Set));
    game.editState().settings.referee->playingHidden = 0;
    QVERIFY(changesTo(PlayState::Playing));
    const RobotId robot{3};
    call({.kind = sim::CallKind::Penalise, .robot = robot, .penalty = PenaltyKind::Pushing});
    QVERIFY(tellAndFind(Kind::Penalised, "B3 penalised: pushing"));
    call({.kind = sim::CallKind::Pardon, .robot = robot});
    QVERIFY(tellAndFind(Kind::PenaltyOver, "B3"));
    if (humanoidSoccer(version)) {
      call({.kind = sim::CallKind::SetPlay, .team = 1, .setPlay = SetPlay::CornerKick});
      QVERIFY(tellAndFind(Kind::SetPlay, "corner kick for red"));
      call({.kind = sim::CallKind::SetPlay, .team = 1, .setPlay = SetPlay::None});
      QVERIFY(tellAndFind(Kind::SetPlay, "normal play"));
    }
    call({.kind = sim::CallKind::Goal, .team = 0, .value = 1});
    QVERIFY(tellAndFind(Kind::Goal, "goal for RoboFEI, 1 : 0"));
    const auto goal = std::ranges::find(events, Kind::Goal, &MatchEvent::kind);
    QCOMPARE(goal->team, 1);
    QCOMPARE(logLineOf(*goal).origin, std::string("referee"));
    QCOMPARE(std::ranges::count(events, Kind::Goal, &MatchEvent::kind), 1);
    call({.kind = sim::CallKind::Goal, .team = 0, .value = -1});
    QVERIFY(tellAndFind(Kind::ScoreCorrected, "score corrected for RoboFEI, 0 : 0"));
    QVERIFY(changesTo(PlayState::Finished));
    call({.kind = sim::CallKind::NextHalf});
    QVERIFY(tellAndFind(Kind::Half, "second half"));
    call({.kind = sim::CallKind::Timeout, .team = 0});
    QVERIFY(tellAndFind(Kind::GamePhase, "timeout"));
  }

  // The referee alone says what a goal is: a ball in the goal of an obeyed match is out.
  void aBallInTheGoalIsNoGoalBeforeTheRefereeSaysSo() {
    MatchOptions options;
    options.obeyReferee = TestSocket().port();
    Scenario scenario = scenarioFor(20, 158);
    auto match = SimulatedMatch::create(scenario, options).value();
    telemetry::RefereeState packet = refereePacket(match.simulation().state(), 1);
    packet.state = static_cast<int>(PlayState::Playing);
    packet.kickOffTeam.reset();
    packet.kickOffRaw = 255;
    const TestSocket controller;
    controller.send(static_cast<std::uint16_t>(*options.obeyReferee),
                    telemetry::encodeReferee(packet).value());
    const auto plays = [&] {
      match.tick();
      return match.simulation().state().game->state == PlayState::Playing;
    };
    QTRY_VERIFY(plays());
    const double line = scenario.settings.field.halfLength();
    QVERIFY(match.simulation().placeBall({line - 0.2, 0.0}, {2.0, 0.0}));
    std::vector<MatchEvent> events;
    match.drainEvents(events);
    events.clear();
    play(match, 1.0);
    match.drainEvents(events);
    QVERIFY(std::ranges::count(events, MatchEventKind::BallOut, &MatchEvent::kind) >= 1);
    QCOMPARE(std::ranges::count(events, MatchEventKind::Goal, &MatchEvent::kind), 0);
    QCOMPARE(match.simulation().state().score, sim::Score{});
  }

  // By cable and by Wi-Fi: 10, 12, 11, 13. In 11 the goal is not counted yet.
  void aLatePacketChangesNothing() {
    MatchOptions options;
    options.obeyReferee = TestSocket().port();
    auto match = SimulatedMatch::create(scenarioFor(20, 158), options).value();
    telemetry::RefereeState packet = refereePacket(match.simulation().state(), 0);
    const TestSocket controller, restarted;
    const auto tell = [&](const TestSocket& from, int number, PlayState state, int score) {
      packet.packetNumber = number;
      packet.state = static_cast<int>(state);
      packet.teams[0].score = score;
      from.send(static_cast<std::uint16_t>(*options.obeyReferee),
                telemetry::encodeReferee(packet).value());
    };
    std::vector<MatchEvent> events;
    const auto shows = [&](PlayState state, int score) {
      match.tick();
      match.drainEvents(events);
      const Game& game = *match.simulation().state().game;
      return game.state == state && game.teams[0].score == score;
    };
    tell(controller, 10, PlayState::Playing, 0);
    QTRY_VERIFY(shows(PlayState::Playing, 0));
    tell(controller, 12, PlayState::Ready, 1);
    QTRY_VERIFY(shows(PlayState::Ready, 1));
    tell(controller, 11, PlayState::Playing, 0);
    tell(controller, 13, PlayState::Set, 1);
    QTRY_VERIFY(shows(PlayState::Set, 1));
    QCOMPARE(std::ranges::count(events, MatchEventKind::Goal, &MatchEvent::kind), 1);
    QCOMPARE(std::ranges::count(events, MatchEventKind::ScoreCorrected, &MatchEvent::kind), 0);
    // A program that was started again counts from 0.
    tell(restarted, 0, PlayState::Initial, 0);
    QTRY_VERIFY(shows(PlayState::Initial, 0));
  }

  // At ten times real time five seconds of the match go by from one packet to the next.
  void aPenaltyIsTheControllersAtAnySpeed() {
    const int port = TestSocket().port();
    MatchOptions options;
    options.process.particles = 100;
    options.obeyReferee = port;
    auto obeying = SimulatedMatch::create(scenarioFor(12, 688), options).value();
    SimulatedMatch controller = sending(12, 688, port);
    const RobotId robot{2};
    const auto call = [&](const sim::RefereeCall& one) {
      QVERIFY(controller.simulation().call(one));
    };
    const auto penalty = [&](const SimulatedMatch& match) {
      return match.simulation().state().game->teams[0].players[1].penalty;
    };
    const auto receives = [&](PenaltyKind kind) {
      play(controller, 0.5);
      obeying.tick();
      return penalty(obeying) == kind;
    };
    call({.kind = sim::CallKind::State, .state = PlayState::Ready});
    call({.kind = sim::CallKind::State, .state = PlayState::Set});
    call({.kind = sim::CallKind::State, .state = PlayState::Playing});
    call({.kind = sim::CallKind::Penalise, .robot = robot, .penalty = PenaltyKind::Pushing});
    QTRY_VERIFY(receives(PenaltyKind::Pushing));
    play(obeying, 5.0);
    const Pose beside = *obeying.simulation().robotPose(robot);
    QVERIFY(std::abs(beside.position.y) > obeying.simulation().state().settings.field.halfWidth());
    for (int packet = 0; packet < 12; ++packet) {
      play(controller, 0.5);
      // On the other side of the ball as well.
      QVERIFY(obeying.simulation().placeBall({0.0, packet % 2 == 0 ? 1.0 : -1.0}));
      for (int tick = 0; tick < 5 * tickRate; ++tick) {
        obeying.tick();
        QCOMPARE(penalty(obeying), PenaltyKind::Pushing);
      }
      QVERIFY(distance(obeying.simulation().robotPose(robot)->position, beside.position) < 0.05);
    }
    call({.kind = sim::CallKind::Pardon, .robot = robot});
    QTRY_VERIFY(receives(PenaltyKind::None));
  }

  // Of robots that know the extension of the map: whose set play it is, score and time.
  void robotsAreReportedOfTheGame() {
    Scenario scenario = scenarioFor(12, 688);
    scenario.robots[0].behaviour = "striker";
    auto match = SimulatedMatch::create(scenario, {}).value();
    const VariableCatalog& map = VariableCatalog::extended();
    const auto words = [&](int robot) {
      const Blackboard& board = *match.blackboard(RobotId{robot});
      return std::pair(board.read(*map.intVar("COM_SET_PLAY")),
                       board.read(*map.intVar("COM_SET_PLAY_OURS")));
    };
    const auto call = [&](const sim::RefereeCall& one) {
      QVERIFY(match.simulation().call(one));
      play(match, 0.6);
    };
    for (const auto state : {PlayState::Ready, PlayState::Set, PlayState::Playing}) {
      call({.kind = sim::CallKind::State, .state = state});
    }
    QCOMPARE(words(1), std::pair(0, 0));
    const auto game = [&](const char* name) {
      return match.blackboard(RobotId{1})->read(*map.intVar(name));
    };
    const int left = game("COM_SECONDS_LEFT");
    QVERIFY(left > 500 && left <= 600);
    call({.kind = sim::CallKind::Goal, .team = 1, .value = 1});
    QCOMPARE(game("COM_GOALS_OWN"), 0);
    QCOMPARE(game("COM_GOALS_THEIRS"), 1);
    for (const auto state : {PlayState::Set, PlayState::Playing}) {
      call({.kind = sim::CallKind::State, .state = state});
    }
    QVERIFY(game("COM_SECONDS_LEFT") < left);
    call({.kind = sim::CallKind::SetPlay, .team = 0, .setPlay = SetPlay::GoalKick});
    QCOMPARE(words(1), std::pair(5, 1));
    call({.kind = sim::CallKind::SetPlay, .team = 1, .setPlay = SetPlay::ThrowIn});
    QCOMPARE(words(1), std::pair(4, 0));
    call({.kind = sim::CallKind::SetPlay, .team = 0, .setPlay = SetPlay::None});
    QCOMPARE(words(1), std::pair(0, 0));
  }

  // Teams in the order of their colours: only the half tells who defends which goal.
  void version7ChangesSides() {
    SimulatedMatch match = SimulatedMatch::create(scenarioFor(12, 688), {}).value();
    sim::WorldState world = match.simulation().state();
    const auto receives = [&](int half, int state, int secState) {
      telemetry::RefereeState packet = telemetry::asVersion7(refereePacket(world, 1));
      packet.firstHalf = half == 1 ? 1 : 0;
      packet.state = state;
      packet.secState = secState;
      adoptGame(telemetry::gameOf(packet), true, world);
      return world.game->swapped;
    };
    QVERIFY(!receives(1, 3, 0));
    QVERIFY(receives(2, 0, 0));
    QVERIFY(receives(2, 3, 0));
    QVERIFY(world.robots[0].imuStartsAt180);
    // In a shoot-out the sides change with each shot after the first.
    QVERIFY(receives(2, 0, 1));
    QVERIFY(receives(2, 2, 1));
    QVERIFY(receives(2, 3, 1));
    QVERIFY(receives(2, 4, 1));
    QVERIFY(!receives(2, 2, 1));
    QVERIFY(!receives(2, 3, 1));
  }

  void itIsAnswered_data() {
    QTest::addColumn<int>("version");
    QTest::addColumn<int>("size");
    QTest::addColumn<int>("bytes");
    QTest::newRow("v7") << 7 << 116 << 16;
    QTest::newRow("v9") << 9 << 244 << 8;
    QTest::newRow("v12") << 12 << 688 << 8;
    QTest::newRow("v18") << 18 << 118 << 32;
    QTest::newRow("v20") << 20 << 158 << 32;
  }
  void itIsAnswered() {
    QFETCH(int, version);
    QFETCH(int, size);
    QFETCH(int, bytes);
    const TestSocket screen(INADDR_ANY);  // replies go to the address of whoever sends
    const int port = TestSocket().port();
    MatchOptions options;
    options.process.particles = 100;
    options.obeyReferee = port;
    auto silent = SimulatedMatch::create(scenarioFor(12, 688), options).value();
    SimulatedMatch controller = sending(version, size, port);
    const auto isObeyed = [&](SimulatedMatch& match) {
      play(controller, 0.5);
      match.tick();
      return match.simulation().state().refereeMemory.obeyed;
    };
    QTRY_VERIFY(isObeyed(silent));
    QVERIFY(!screen.received());
    options.obeyReferee = TestSocket().port();
    options.answerReferee = screen.port();
    auto answering = SimulatedMatch::create(scenarioFor(12, 688), options).value();
    controller = sending(version, size, *options.obeyReferee);
    QTRY_VERIFY(isObeyed(answering));
    QTRY_VERIFY(screen.received());
    std::set<std::pair<int, int>> robots;
    for (std::string text = screen.take(); !text.empty(); text = screen.take()) {
      QCOMPARE(int(text.size()), bytes);
      const auto reply =
          std::get<telemetry::RobotReply>(telemetry::decodeReferee(std::string_view(text)).value());
      robots.insert({reply.team, reply.player});
      if (reply.message) QCOMPARE(*reply.message, 2);  // alive; others change the game
      if (bytes == 32) {
        QCOMPARE(*reply.fallen, 0);
        // Blue and red see themselves in their own half.
        QVERIFY((*reply.pose)[0] < 0.0F);
        QVERIFY(std::isfinite(*reply.ballAge));
      }
    }
    QCOMPARE(robots.size(), std::size_t{8});
    QVERIFY(robots.contains({1, 1}) && robots.contains({2, 4}));
  }

  // While play is stopped a referee of 2026 sends five packets a second, and wants two replies.
  void itIsAnsweredAtMostTwiceASecond() {
    const TestSocket screen(INADDR_ANY);  // replies go to the address of whoever sends
    MatchOptions options;
    options.obeyReferee = TestSocket().port();
    options.answerReferee = screen.port();
    auto answering = SimulatedMatch::create(scenarioFor(20, 158), options).value();
    SimulatedMatch controller = sending(20, 158, *options.obeyReferee);
    QElapsedTimer timer;
    timer.start();
    int replies = 0;  // of one robot
    const auto replied = [&](int wanted) {
      play(controller, 0.5);  // a packet each time
      answering.tick();
      for (std::string text = screen.take(); !text.empty(); text = screen.take()) {
        const auto reply = std::get<telemetry::RobotReply>(
            telemetry::decodeReferee(std::string_view(text)).value());
        replies += reply.team == 1 && reply.player == 1 ? 1 : 0;
      }
      return replies >= wanted;
    };
    QTRY_VERIFY(replied(4));
    QVERIFY2(timer.elapsed() >= 1500, qPrintable(QString::number(timer.elapsed())));
  }
};

PITCHBOARD_TEST(TestMatchPackets)

}  // namespace tst_match_packets

#include "tst_match_packets.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// The referee's machine of states: the worked match of two controllers, field by field, how halves
// and shoot-outs end, and in which states a game begins.
#include <simcore/rules/check_call.h>
#include <telemetry/referee/gamecontroller_encoder.h>

#include <functional>
#include <set>

#include "../support/referee_game.h"

namespace tst_referee {

using namespace pitchboard;
using sim::CallKind;

namespace {

/// As the worked match is written: "3 2 9[2,1] 420/15" or "3 2 4 1 420/45".
QString written(const telemetry::RefereeState& p) {
  QString text = QString("%1 %2 ").arg(p.state).arg(p.kickOffRaw);
  if (p.version == 12) {
    text += QString::number(*p.secState);
    if (*p.secState >= 4) {
      text += QString("[%1,%2]").arg((*p.secStateInfo)[0]).arg((*p.secStateInfo)[1]);
    }
  } else {
    text += QString("%1 %2").arg(*p.setPlay).arg(*p.stopped);
  }
  return text + QString(" %1/%2").arg(p.secsRemaining).arg(*p.secondaryTime);
}

/// "34, 30" of the third player of team 1.
QString third(const telemetry::RefereeState& p) {
  const telemetry::RefereePlayer& player = p.team(1)->allSlots[2];
  return player.penalty == 0 ? QString("0")
                             : QString("%1, %2").arg(player.penalty).arg(player.secondsLeft);
}

struct Step {
  double time;
  const char* packet;
  std::function<bool(RefereeGame&)> call = {};
  const char* player = nullptr;
  bool leftIsTeam2 = false;
};

void play(RefereeGame& game, const std::vector<Step>& steps) {
  for (const Step& step : steps) {
    game.runTo(step.time);
    if (step.call) QVERIFY2(step.call(game), qPrintable(QString("call at %1 s").arg(step.time)));
    const telemetry::RefereeState sent = game.packet();
    // What robots get: through the bytes.
    const auto bytes = telemetry::encodeReferee(sent);
    QVERIFY2(bytes, bytes ? "" : bytes.error().text().c_str());
    const auto received = std::get<telemetry::RefereeState>(*telemetry::decodeReferee(*bytes));
    QCOMPARE(QString("%1 s: ").arg(step.time) + written(received),
             QString("%1 s: ").arg(step.time) + step.packet);
    if (step.player) QCOMPARE(third(received), QString(step.player));
    QCOMPARE(received.teams[0].number, step.leftIsTeam2 ? 2 : 1);
  }
}

auto to(PlayState state) {
  return [state](RefereeGame& g) { return g.state(state); };
}
auto setPlay(SetPlay play, int team) {
  return [play, team](RefereeGame& g) {
    return g.call({.kind = CallKind::SetPlay, .team = team, .setPlay = play});
  };
}
bool next(RefereeGame& g) {
  return g.call({.kind = CallKind::NextStep});
}
bool goalOfTeam1(RefereeGame& g) {
  return g.call({.kind = CallKind::Goal, .team = 0, .value = 1});
}
bool down(RefereeGame& g) {
  return g.call(
      {.kind = CallKind::Penalise, .robot = RobotId{3}, .penalty = PenaltyKind::Incapable});
}

}  // namespace

class TestReferee : public QObject {
  Q_OBJECT

  /// Every call there is, of these teams and robots.
  static std::vector<sim::RefereeCall> allCalls() {
    std::vector<sim::RefereeCall> calls;
    for (int kind = 0; kind <= static_cast<int>(CallKind::Automatic); ++kind) {
      for (int team = Game::noTeam; team < 2; ++team) {
        for (const int value : {-1, 0, 1}) {
          for (int state = 0; state <= static_cast<int>(lastOf(PlayState{})); ++state) {
            calls.push_back({.kind = static_cast<CallKind>(kind),
                             .state = static_cast<PlayState>(state),
                             .team = team,
                             .robot = RobotId{value + 2},
                             .setPlay = static_cast<SetPlay>(value + 1),
                             .penalty = static_cast<PenaltyKind>(value + 1),
                             .value = value});
          }
        }
      }
    }
    return calls;
  }

 private slots:
  // In every state that a match comes to: what checkCall() refuses changes nothing, and the match
  // says the same.
  void checkReturnsTheErrorOfTheCall() {
    const std::vector<std::function<bool(RefereeGame&)>> way{
        to(PlayState::Ready),
        to(PlayState::Set),
        to(PlayState::Playing),
        setPlay(SetPlay::CornerKick, 0),
        next,
        [](RefereeGame& g) { return g.call({.kind = CallKind::Stop}); },
        [](RefereeGame& g) { return g.call({.kind = CallKind::GoOn}); },
        down,
        goalOfTeam1,
        to(PlayState::Set),
        to(PlayState::Playing),
        to(PlayState::Finished),
        [](RefereeGame& g) { return g.call({.kind = CallKind::NextHalf}); }};
    RefereeGame game("humanoid-2021");
    int refused = 0, allowed = 0;
    for (std::size_t step = 0; step <= way.size(); ++step) {
      for (const sim::RefereeCall& call : allCalls()) {
        sim::Simulation& simulation = *game.simulation;
        const sim::WorldState before = simulation.state();
        const auto checked =
            sim::checkCall(*before.game, *before.settings.referee, before.robots, call);
        const auto done = simulation.call(call);
        QCOMPARE(done.has_value(), checked.has_value());
        if (!done) {
          QCOMPARE(QString::fromStdString(done.error().message),
                   QString::fromStdString(checked.error().message));
          QVERIFY(*simulation.state().game == *before.game);
        }
        ++(done ? allowed : refused);
        QVERIFY(simulation.restore(before));
      }
      if (step < way.size()) QVERIFY2(way[step](game), qPrintable(QString::number(step)));
    }
    QVERIFY(refused > 1000 && allowed > 500);
  }

  void workedMatchOf2024() {
    RefereeGame game("humanoid-2021");
    play(game, {
                   {0, "0 1 0 600/0"},
                   {10, "1 1 0 600/45", to(PlayState::Ready)},
                   {55, "2 1 0 600/0"},
                   {60, "3 1 0 600/10", to(PlayState::Playing)},
                   {66, "3 1 0 594/4"},
                   {70, "3 1 0 590/0"},
                   {120, "1 2 0 540/45", goalOfTeam1},
                   {165, "2 2 0 495/0"},
                   {170, "3 2 0 490/10", to(PlayState::Playing)},
                   {180, "3 2 0 480/0"},
                   {240, "3 2 9[2,0] 420/0", setPlay(SetPlay::ThrowIn, 1)},
                   {245, "3 2 9[2,1] 420/15", next},
                   {260, "3 2 9[2,2] 420/0", next},
                   {261, "3 2 0 420/10", next},
                   {281, "3 2 0 400/0", down, "34, 30"},
                   {311, "3 2 0 370/0", {}, "0"},
                   {400, "3 2 6[1,0] 281/0", setPlay(SetPlay::PenaltyKick, 0)},
                   {405, "3 2 6[1,1] 281/15", next},
                   {420, "3 2 6[1,2] 281/0", next},
                   {421, "3 2 0 281/10", next},
                   {424, "1 2 0 278/45", goalOfTeam1},
                   {469, "2 2 0 233/0"},
                   {474, "3 2 0 228/10", to(PlayState::Playing)},
                   {702, "4 2 0 0/0", to(PlayState::Finished)},
                   {702.5, "0 2 0 600/0", to(PlayState::Initial), nullptr, true},
                   {717, "1 2 0 600/45", to(PlayState::Ready), nullptr, true},
                   {762, "2 2 0 600/0", {}, nullptr, true},
                   {767, "3 2 0 600/10", to(PlayState::Playing), nullptr, true},
                   {777, "3 2 0 590/0", {}, nullptr, true},
                   {1367, "4 2 0 0/0", to(PlayState::Finished), nullptr, true},
               });
    QCOMPARE(game.packet().team(1)->score, 2);
    QCOMPARE(game.packet().firstHalf, 0);
  }

  void workedMatchOf2026() {
    RefereeGame game("humanoid-soccer-2026");
    play(game, {
                   {0, "0 1 0 0 600/0"},
                   {10, "1 1 0 0 600/45", to(PlayState::Ready)},
                   {55, "2 1 0 0 600/0"},
                   {60, "2 1 0 0 600/0", to(PlayState::Playing)},
                   {66, "2 1 0 0 600/0"},
                   {70, "3 255 0 0 590/0"},
                   {120, "1 2 0 0 540/45", goalOfTeam1},
                   {165, "2 2 0 0 495/0"},
                   {170, "2 2 0 0 490/0", to(PlayState::Playing)},
                   {180, "3 255 0 0 480/0"},
                   {240, "3 2 4 1 420/45", setPlay(SetPlay::ThrowIn, 1)},
                   {245, "3 2 4 0 415/45", next},
                   {255, "3 255 0 0 405/0", next},
                   {281, "3 255 0 0 379/0", down, "5, 0"},
                   {284, "3 255 0 0 376/0", {}, "5, 45"},
                   {329, "3 255 0 0 331/0", {}, "0"},
                   {400, "1 1 3 0 260/45", setPlay(SetPlay::PenaltyKick, 0)},
                   {445, "2 1 3 0 215/0"},
                   {450, "2 1 3 0 210/0", to(PlayState::Playing)},
                   {460, "3 1 3 0 200/50"},
                   {464, "1 2 0 0 196/45", goalOfTeam1},
                   {509, "2 2 0 0 151/0"},
                   {514, "2 2 0 0 146/0", to(PlayState::Playing)},
                   {661, "4 255 0 0 -1/600", to(PlayState::Finished)},
                   {961, "0 2 0 0 600/300", to(PlayState::Initial), nullptr, true},
                   {1270, "1 2 0 0 600/45", to(PlayState::Ready), nullptr, true},
                   {1315, "2 2 0 0 600/0", {}, nullptr, true},
                   {1320, "2 2 0 0 600/0", to(PlayState::Playing), nullptr, true},
                   {1330, "3 255 0 0 590/0", {}, nullptr, true},
                   {1921, "4 255 0 0 -1/0", to(PlayState::Finished), nullptr, true},
               });
    QCOMPARE(game.packet().team(1)->score, 2);
  }

  void theTableOfTransitions() {
    // Everything else is refused and changes nothing.
    const auto reach = [](RefereeGame& g, PlayState state) {
      if (state == PlayState::Initial) return;
      QVERIFY(g.state(PlayState::Ready));
      if (state == PlayState::Ready) return;
      QVERIFY(g.state(PlayState::Set));
      if (state == PlayState::Set) return;
      QVERIFY(g.state(PlayState::Playing));
      if (state == PlayState::Playing) return;
      QVERIFY(g.state(PlayState::Finished));
    };
    const std::vector<std::pair<int, int>> allowed{{0, 1}, {1, 2}, {2, 3}, {3, 1},
                                                   {1, 4}, {2, 4}, {3, 4}, {4, 0}};
    for (const char* rules : {"humanoid-2014", "humanoid-2021", "humanoid-soccer-2026"}) {
      for (int from = 0; from < 5; ++from) {
        for (int target = 0; target < 5; ++target) {
          RefereeGame game(rules);
          reach(game, static_cast<PlayState>(from));
          const Game before = game.game();
          const bool may =
              std::find(allowed.begin(), allowed.end(), std::pair(from, target)) != allowed.end();
          QCOMPARE(game.state(static_cast<PlayState>(target)), may);
          if (!may) QVERIFY(game.game() == before);
        }
      }
    }
  }

  void aTieInAKnockoutGoesOnUntilTheShootOutIsDecided() {
    RefereeGame game("humanoid-2021", true);
    sim::RefereeRules rules = *game.simulation->state().settings.referee;
    rules.halfTime = rules.extraHalfTime = 60;
    rules.knockout = true;
    rules.shotTime = 5;
    rules.stillTime = rules.nobodyTime = 0;
    QVERIFY(game.simulation->setReferee(rules));
    std::set<int> phases;
    for (int i = 0; i < 60 * 3000 && !game.game().over; ++i) {
      game.tick();
      phases.insert(static_cast<int>(game.game().phase));
      // The first team scores with its third shot.
      if (game.game().phase == GamePhase::ShootOut && game.game().state == PlayState::Playing &&
          game.game().shooter == 0 && game.game().teams[0].penaltyShots == 3 &&
          game.game().stateTicks == 30) {
        QVERIFY(game.call({.kind = CallKind::Goal, .team = 0, .value = 1}));
      }
    }
    QVERIFY(game.game().over);
    QCOMPARE(phases, (std::set<int>{0, 1, 2}));
    QCOMPARE(game.game().teams[0].singleShots, 4);
    QCOMPARE(game.game().teams[1].singleShots, 0);
    QVERIFY(game.happened(sim::EventKind::FinalWhistle));
  }

  // Three shots each, three of sudden death, then a coin: the same for the same seed.
  void aShootOutOf2026EndsWithACoin() {
    std::set<int> winners;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const auto play = [seed](int shotsThatScore) {
        RefereeGame game("humanoid-soccer-2026", true);
        sim::RefereeRules rules = *game.simulation->state().settings.referee;
        rules.shotTime = 1;
        rules.shotSetTime = rules.beforeHalf = 0;
        game.simulation->editState().settings.seed = seed;
        if (!game.simulation->setReferee(rules) ||
            !game.simulation->startGame({.state = PlayState::Finished, .half = 2}) ||
            !game.call({.kind = CallKind::ShootOut})) {
          qFatal("no shoot-out");
        }
        int scored = 0;
        while (!game.game().over && game.now() < 300.0) {
          game.tick();
          const Game& now = game.game();
          if (now.state != PlayState::Playing || now.stateTicks != 10) continue;
          if (now.teams[std::size_t(now.shooter)].penaltyShots > shotsThatScore) continue;
          if (!game.call({.kind = CallKind::Goal, .team = now.shooter, .value = 1})) qFatal("goal");
          ++scored;
        }
        if (scored != 2 * shotsThatScore) qFatal("%d shots scored", scored);
        return game;
      };
      const int shotsThatScore = seed % 2 == 0 ? 0 : 2;
      const RefereeGame game = play(shotsThatScore);
      QVERIFY(game.game().over);
      for (const GameTeam& team : game.game().teams) {
        QCOMPARE(team.penaltyShots, 6);
        QCOMPARE(team.score, shotsThatScore);
      }
      const auto toss = std::ranges::find(game.events, sim::EventKind::CoinToss, &sim::Event::kind);
      QVERIFY(toss != game.events.end());
      QCOMPARE(sim::tossWinner(game.simulation->state()), std::optional(toss->value));
      QCOMPARE(sim::tossWinner(play(shotsThatScore).simulation->state()),
               std::optional(toss->value));
      winners.insert(toss->value);
    }
    QCOMPARE(winners.size(), std::size_t{2});
  }

  void suddenDeathEndsWhenOneTeamIsAhead() {
    const sim::RefereeRules rules = RefereeGame::named("humanoid-soccer-2026", true);
    Game game;
    const auto decided = [&](int taken0, int scored0, int taken1, int scored1) {
      game.teams[0].penaltyShots = taken0;
      game.teams[0].singleShots = scored0;
      game.teams[1].penaltyShots = taken1;
      game.teams[1].singleShots = scored1;
      return sim::shootOutDecided(game, rules);
    };
    QVERIFY(!decided(3, 0b001, 3, 0b100));
    QVERIFY(!decided(4, 0b1001, 3, 0b100));
    QVERIFY(decided(4, 0b1001, 4, 0b0100));
    QVERIFY(!decided(5, 0b00001, 5, 0b10000));
    QVERIFY(!decided(6, 0b000001, 5, 0b10000));
    QVERIFY(decided(6, 0b000001, 6, 0b010000));
    // The Humanoid League's has no coin.
    sim::RefereeRules older = RefereeGame::named("humanoid-2021", true);
    older.shots = 3;
    QVERIFY(!sim::shootOutDecided(game, older));
  }

  void allShotsOfAShootOutGoToTheSameGoal() {
    RefereeGame game("humanoid-2021", true);
    sim::RefereeRules rules = *game.simulation->state().settings.referee;
    rules.shotTime = 5;
    rules.shots = 3;
    rules.placedAfter = 1;
    QVERIFY(game.simulation->setReferee(rules));
    QVERIFY(game.simulation->startGame({.state = PlayState::Finished, .half = 2}));
    QVERIFY(game.call({.kind = CallKind::ShootOut}));
    std::set<double> marks;
    std::set<int> shooters, leftTeams;
    for (int i = 0; i < 60 * 600 && !game.game().over; ++i) {
      game.tick();
      if (game.game().state != PlayState::Set || game.game().stateTicks != 60) continue;
      marks.insert(std::round(game.simulation->snapshot().ball.x * 10));
      shooters.insert(game.game().shooter);
      leftTeams.insert(int(game.game().leftTeam()));
      // teams[0] of the packets is who defends the left goal: not the side of the shot.
      const int shooter = game.game().teams[std::size_t(game.game().shooter)].number;
      QCOMPARE(game.packet().teams[0].number == shooter, marks.contains(30.0));
    }
    QCOMPARE(shooters.size(), std::size_t{2});
    QCOMPARE(leftTeams.size(), std::size_t{2});
    QCOMPARE(marks.size(), std::size_t{1});
  }

  void aHalfEndsInReady_data() {
    QTest::addColumn<QString>("rules");
    QTest::addColumn<int>("state");
    for (const char* rules : {"humanoid-2014", "humanoid-2021", "humanoid-soccer-2026"}) {
      QTest::addRow("%s, READY", rules) << rules << int(PlayState::Ready);
      QTest::addRow("%s, SET", rules) << rules << int(PlayState::Set);
    }
  }
  void aHalfEndsInReady() {
    QFETCH(QString, rules);
    QFETCH(int, state);
    RefereeGame game(rules.toLatin1().constData(), true);
    sim::GameStart start;
    start.state = PlayState(state);
    start.half = 2;
    start.clock = 1.0;
    QVERIFY(game.simulation->startGame(start));
    game.runTo(3.5);
    QCOMPARE(game.game().state, PlayState::Finished);
    QVERIFY(game.game().clock > -150);
    // A half that has not begun does not run out.
    start.clock.reset();
    QVERIFY(game.simulation->startGame(start));
    const int full = game.game().clock;
    game.runTo(6.5);
    QVERIFY(game.game().state != PlayState::Finished);
    QCOMPARE(game.game().clock, full);
  }

  void theRefereesTimeoutIsLonger() {
    for (const auto& [rules, seconds] :
         {std::pair("humanoid-2014", 120), std::pair("humanoid-2021", 600),
          std::pair("humanoid-soccer-2026", 600)}) {
      RefereeGame game(rules);
      QVERIFY(game.call({.kind = CallKind::Timeout, .team = Game::noTeam}));
      QCOMPARE(game.packet().secondaryTime, std::optional<int>(seconds));
    }
    RefereeGame game("humanoid-2021");
    QVERIFY(game.call({.kind = CallKind::Timeout, .team = 0}));
    QCOMPARE(game.packet().secondaryTime, std::optional<int>(120));
  }

  // A scenario that began in a timeout, or a timeout that a person gave, never ended.
  void theAutomaticRefereeEndsATimeout_data() {
    QTest::addColumn<QString>("rules");
    QTest::addColumn<double>("countdown");  // negative: the scenario does not say it
    QTest::addColumn<bool>("runs");
    QTest::addColumn<double>("ends");
    for (const char* rules : {"humanoid-2014", "humanoid-2021", "humanoid-soccer-2026"}) {
      QTest::addRow("%s", rules) << rules << -1.0 << true << 20.0;
      QTest::addRow("%s, 4 s left", rules) << rules << 4.0 << true << 4.0;
      QTest::addRow("%s, a countdown that stands", rules) << rules << 4.0 << false << 20.0;
    }
  }
  void theAutomaticRefereeEndsATimeout() {
    QFETCH(QString, rules);
    QFETCH(double, countdown);
    QFETCH(bool, runs);
    QFETCH(double, ends);
    sim::RefereeRules with = RefereeGame::named(rules.toLatin1().constData(), true);
    with.timeoutTime = 20;
    RefereeGame game(with);
    sim::GameStart start;
    start.phase = GamePhase::Timeout;
    start.clock = 300;
    start.kickOff = sim::GameStart::KickOff{TeamColor::Red};
    if (countdown >= 0.0) start.countdown = countdown;
    if (!runs) start.countdownRuns = false;
    QVERIFY(game.simulation->startGame(start));
    game.runTo(ends - 0.1);
    QCOMPARE(game.game().phase, GamePhase::Timeout);
    QCOMPARE(game.game().state, PlayState::Initial);
    game.runTo(ends + 0.1);
    QCOMPARE(game.game().phase, GamePhase::Normal);
    QCOMPARE(game.game().state, PlayState::Ready);
    QCOMPARE(game.game().kickOff, 1);
    QCOMPARE(game.packet().secsRemaining, 300);
    QVERIFY(game.happened(sim::EventKind::PhaseChanged));
    // One that a person gave.
    QVERIFY(game.call({.kind = CallKind::Timeout, .team = 0}));
    game.runTo(game.now() + 20.1);
    QCOMPARE(game.game().state, PlayState::Ready);
    // Without the automatic referee it lasts until somebody calls READY.
    sim::WorldState byHand = game.simulation->state();
    byHand.settings.referee->automatic = false;
    QVERIFY(game.simulation->restore(byHand));
    QVERIFY(game.call({.kind = CallKind::Timeout, .team = 1}));
    game.runTo(game.now() + 30);
    QCOMPARE(game.game().phase, GamePhase::Timeout);
  }

  void aTimeoutBeforeAShootOutIsFollowedByTheFirstShot() {
    sim::RefereeRules rules = RefereeGame::named("humanoid-soccer-2026", true);
    rules.timeoutTime = 5;
    RefereeGame game(rules);
    QVERIFY(game.simulation->startGame({.state = PlayState::Finished, .half = 2}));
    QVERIFY(game.call({.kind = CallKind::ShootOut}));
    QVERIFY(game.call({.kind = CallKind::Timeout, .team = 0}));
    game.runTo(5.1);
    QCOMPARE(game.game().phase, GamePhase::ShootOut);
    QCOMPARE(game.game().state, PlayState::Set);
    QCOMPARE(game.game().teams[0].penaltyShots, 1);
    // A shot is not interrupted.
    QVERIFY(!game.call({.kind = CallKind::Timeout, .team = 1}));
  }

  void aTimeoutThatCannotEndIsRefused() {
    RefereeGame game("humanoid-2021", true);
    sim::GameStart start{.state = PlayState::Playing, .phase = GamePhase::Timeout};
    const auto running = game.simulation->startGame(start);
    QVERIFY(!running && running.error().text().find("initial") != std::string::npos);
    start.state = PlayState::Initial;
    start.phaseBefore = GamePhase::Timeout;
    const auto endless = game.simulation->startGame(start);
    QVERIFY(!endless && endless.error().text().find("phase_before") != std::string::npos);
  }

  // 30 s became 28 and 26 while the ball was placed (2026).
  void penaltyTimeWaitsWhilePlayIsStopped() {
    for (const char* rules : {"humanoid-2021", "humanoid-soccer-2026"}) {
      RefereeGame game(rules);
      const auto left = [&game] { return game.game().teams[0].players[2].ticksLeft; };
      sim::GameStart start{.state = PlayState::Playing, .clock = 300};
      start.robots[RobotId{3}] = {
          .penalty = PenaltyKind::Incapable, .left = 30, .outside = true, .counts = true};
      QVERIFY(game.simulation->startGame(start));
      game.runTo(1);
      QCOMPARE(left(), 29 * 60);
      QVERIFY(setPlay(SetPlay::ThrowIn, 1)(game));
      game.runTo(4);
      QCOMPARE(left(), 29 * 60);
      QVERIFY(game.call({.kind = CallKind::SetPlay, .team = 1, .setPlay = SetPlay::None}));
      game.runTo(5);
      QCOMPARE(left(), 28 * 60);
      QVERIFY(game.call({.kind = CallKind::Stop}));
      game.runTo(8);
      QCOMPARE(left(), 28 * 60);
      QVERIFY(game.call({.kind = CallKind::GoOn}));
      QVERIFY(game.state(PlayState::Ready));
      game.runTo(9);
      QCOMPARE(left(), 27 * 60);
      QVERIFY(game.call({.kind = CallKind::Stop}));
      game.runTo(10);
      QCOMPARE(left(), 27 * 60);
    }
    // In 2014 it counts from the call, whatever happens.
    RefereeGame game("humanoid-2014");
    QVERIFY(game.simulation->startGame({.state = PlayState::Playing, .clock = 300}));
    QVERIFY(game.call(
        {.kind = CallKind::Penalise, .robot = RobotId{3}, .penalty = PenaltyKind::Incapable}));
    QVERIFY(game.call({.kind = CallKind::Stop}));
    game.runTo(2);
    QVERIFY(game.game().teams[0].players[2].ticksLeft <= 28 * 60);
  }

  // Motion in SET is a short penalty on the field; motion while play is stopped a removal.
  void motionInStopIsARemoval() {
    RefereeGame game("humanoid-soccer-2026");
    QVERIFY(game.simulation->startGame({.state = PlayState::Playing, .clock = 300}));
    for (const auto& [robot, kind] :
         {std::pair(2, PenaltyKind::MotionInSet), std::pair(3, PenaltyKind::MotionInStop)}) {
      QVERIFY(game.call({.kind = CallKind::Penalise, .robot = RobotId{robot}, .penalty = kind}));
    }
    game.runTo(4);
    const auto robots = game.simulation->snapshot().robots;
    QVERIFY(std::abs(robots[1].pose.position.y) < 3.0);
    QVERIFY(std::abs(robots[2].pose.position.y) > 3.0);
    const auto& players = game.game().teams[0].players;
    QVERIFY(players[1].ticksLeft > 10 * 60 && players[1].ticksLeft <= 15 * 60);
    QVERIFY(players[2].ticksLeft > 40 * 60);
  }

  void readyEndsWhenAllStand() {
    for (const double still : {0.0, 5.0}) {
      sim::RefereeRules rules = RefereeGame::named("humanoid-2021", true);
      rules.readyStillTime = still;
      RefereeGame game(rules);
      QVERIFY(game.simulation->startGame({.state = PlayState::Ready}));
      game.runTo(3);
      // Somebody still turns.
      QVERIFY(game.simulation->placeRobot(RobotId{2}, {{-2.5, 2.0}, 0.5}));
      game.runTo(7.9);
      QCOMPARE(game.game().state, PlayState::Ready);
      game.runTo(8.2);
      QCOMPARE(game.game().state, still > 0.0 ? PlayState::Set : PlayState::Ready);
      // Play waits for a robot that stands in the wrong half.
      QVERIFY(game.simulation->placeRobot(RobotId{2}, {{1.5, 2.0}, 0.5}));
      QVERIFY(game.simulation->startGame({.state = PlayState::Ready}));
      game.runTo(game.now() + 44.9);
      QCOMPARE(game.game().state, PlayState::Ready);
      game.runTo(game.now() + 0.2);
      QCOMPARE(game.game().state, PlayState::Set);
    }
  }

  void goalsAreCountedByHalf() {
    RefereeGame game("humanoid-2021");
    sim::GameStart start;
    start.state = PlayState::Playing;
    start.half = 2;
    start.teams[TeamColor::Blue] = {.score = 1, .byHalf = std::array{1, 0, 0, 0}};
    QVERIFY(game.simulation->startGame(start));
    QVERIFY(goalOfTeam1(game));
    QCOMPARE(game.game().teams[0].byHalf, (std::array{1, 1, 0, 0}));
    const sim::RefereeCall takenBack{.kind = CallKind::Goal, .team = 0, .value = -1};
    QVERIFY(game.call(takenBack) && game.call(takenBack));
    QCOMPARE(game.game().teams[0].byHalf, (std::array{0, 0, 0, 0}));
    QCOMPARE(game.game().teams[0].score, 0);
  }

  void aGameBeginsInAnyState() {
    RefereeGame game("humanoid-soccer-2026", true);
    // A goal kick as by the call: the ball goes to the front corner of the goal area.
    sim::GameStart start;
    start.state = PlayState::Playing;
    start.clock = 60;
    start.setPlay = sim::GameStart::Taking{SetPlay::GoalKick, TeamColor::Blue, {}, Point{-4.6, 2}};
    start.robots[RobotId{5}] = {.penalty = PenaltyKind::SentOff, .red = 1};
    QVERIFY(game.simulation->startGame(start));
    QCOMPARE(game.game().setPlay(), SetPlay::GoalKick);
    QVERIFY(game.game().stopped);
    QCOMPARE(game.packet().secsRemaining, 60);
    game.runTo(6);
    const Point ball = game.simulation->snapshot().ball;
    QVERIFY2(distance(ball, {-3.5, 1.5}) < 0.01,
             qPrintable(QString("%1, %2").arg(ball.x).arg(ball.y)));
    QVERIFY(std::abs(game.simulation->snapshot().robots[4].pose.position.y) > 3.0);
    // A penalty kick has its own READY by these rules.
    start.setPlay = sim::GameStart::Taking{SetPlay::PenaltyKick, TeamColor::Red, {}, {}};
    QVERIFY(game.simulation->startGame(start));
    QCOMPARE(game.game().state, PlayState::Ready);
    QCOMPARE(game.game().setPlayTeam(), 1);
    // The error names the team that does not play, and nothing has changed.
    const Game before = game.game();
    start.left = TeamColor::Orange;
    const auto refused = game.simulation->startGame(start);
    QVERIFY(!refused && refused.error().message.find("orange") != std::string::npos);
    QVERIFY(game.game() == before);
  }

  void aSavedMomentGoesOnAsItDid() {
    RefereeGame game("humanoid-2021", true);
    game.runTo(62);
    QVERIFY(game.simulation->placeBall({0.5, 2.9}, {0.0, 2.0}));
    const sim::WorldState saved = game.simulation->state();
    game.runTo(100);
    const std::uint64_t hash = game.simulation->hash();
    QVERIFY(game.simulation->restore(saved));
    QCOMPARE(game.now(), 62.0);
    game.runTo(100);
    QCOMPARE(game.simulation->hash(), hash);
    sim::WorldState damaged = saved;
    damaged.game->restart.team = 7;
    QVERIFY(!game.simulation->restore(damaged));
  }

  void aMatchWithoutRefereeRefusesCalls() {
    auto plain = sim::Simulation::create({}).value();
    const auto called = plain.call({.kind = CallKind::DropBall});
    QVERIFY(!called);
    QVERIFY(QString::fromStdString(called.error().text()).contains("no referee"));
  }
};

PITCHBOARD_TEST(TestReferee)

}  // namespace tst_referee

#include "tst_referee.moc"

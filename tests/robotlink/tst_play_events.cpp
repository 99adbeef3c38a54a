// SPDX-License-Identifier: GPL-3.0-or-later
// Passes, shots, ball wins, set plays and penalties that a tally finds: in made moments, and in
// simulated matches against what the simulation knows.
#include <QtTest>

#include "../support/play_truth.h"

namespace tst_play_events {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

/// B1, B2 and R1 on the published field of 9 m × 6 m, ten moments a second; blue attacks the right
/// goal, whose posts are at y = ±0.9 m. The ball loses 5 % of its speed in 1/60 s, so one that is
/// kicked with v rolls 0.317 s · v.
struct Pitch {
  Pitch() {
    for (const char* name : {"B1", "B2", "R1"}) {
      TallyRobot& robot = now.robots.emplace_back();
      robot.uid = {static_cast<std::uint32_t>(now.robots.size())};
      robot.name = name;
      robot.team = name[0] == 'B' ? TeamColor::Blue : TeamColor::Red;
      robot.place = Point{-4.0, static_cast<double>(now.robots.size()) - 3.0};
      robot.kicks = 0.0;
      robot.tellsKicks = true;
    }
    now.ball = Point{};
    for (const TeamColor team : {TeamColor::Blue, TeamColor::Red}) {
      now.teams[team].attacksRight = team == TeamColor::Blue;
      now.teams[team].score = 0;
    }
    play(0.1);
  }
  void play(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(10.0 * seconds)); ++i) {
      for (TallyRobot& robot : now.robots) robot.ballDistance = distance(*robot.place, *now.ball);
      tally.add(now);
      now.time += tallyStep;
    }
  }
  /// The robot stands behind the ball, kicks, and the ball rolls with this velocity per moment.
  void kick(std::size_t robot, const Point& from, const Point& step, int moments) {
    now.ball = from;
    now.robots[robot].place = Point{from.x - 0.22, from.y};
    play(0.3);
    *now.robots[robot].kicks += 1.0;
    for (int i = 1; i <= moments; ++i) {
      now.ball = Point{from.x + step.x * i, from.y + step.y * i};
      play(0.1);
    }
  }
  void stand(std::size_t robot, double seconds) {
    now.robots[robot].place = Point{now.ball->x + 0.22, now.ball->y};
    play(seconds);
  }
  std::vector<PlayEvent> plays() const { return tally.statistics({0.0, now.time}).plays; }
  const PlayEvent* only(PlayKind kind) {
    events = plays();
    const auto is = [kind](const PlayEvent& play) { return play.kind == kind; };
    return std::ranges::count_if(events, is) == 1 ? &*std::ranges::find_if(events, is) : nullptr;
  }

  TallyMoment now;
  MatchTally tally;
  std::vector<PlayEvent> events;
};

}  // namespace

class TestPlayEvents : public QObject {
  Q_OBJECT
 private slots:
  void passesSayWhoAndWhere() {
    Pitch pitch;
    pitch.kick(0, {0.0, 0.0}, {0.1, 0.0}, 15);
    pitch.stand(1, 0.2);
    const PlayEvent* pass = pitch.only(PlayKind::Pass);
    QVERIFY(pass);
    QVERIFY(pass->outcome == PlayOutcome::Completed);
    QCOMPARE(pass->name, std::string("B1"));
    QCOMPARE(pass->otherName, std::string("B2"));
    QVERIFY(std::abs(distance(*pass->from, *pass->to) - 1.5) < 0.05);
    QCOMPARE(sentenceOf(*pass), std::string("B1 passes to B2 (1.5 m)"));
    pitch.kick(1, {0.0, 1.0}, {0.1, 0.0}, 12);
    pitch.stand(2, 0.2);
    const MatchStatistics all = pitch.tally.statistics({0.0, pitch.now.time});
    QCOMPARE(all.robot("B1")->plays.passes, 1U);
    QCOMPARE(all.robot("B2")->plays.intercepted, 1U);
    QCOMPARE(all.team(TeamColor::Blue)->plays.passes, 1U);
  }

  /// A ball at 4 m/s rolls 1.27 m; the line is 1 m away.
  void shotsAreSavedWideOrGoals_data() {
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("stepX");
    QTest::addColumn<int>("goals");
    QTest::addColumn<QString>("outcome");
    QTest::newRow("saved") << 0.0 << 0.3 << 0 << "saved";
    QTest::newRow("goal") << 0.0 << 0.3 << 1 << "goal";
    QTest::newRow("wide") << 1.2 << 0.3 << 0 << "wide";
    QTest::newRow("past the goal by far") << 2.0 << 0.3 << 0 << "";
    QTest::newRow("too slow") << 0.0 << 0.1 << 0 << "";
    QTest::newRow("away from the goal") << 0.0 << -0.3 << 0 << "";
  }
  void shotsAreSavedWideOrGoals() {
    QFETCH(double, y);
    QFETCH(double, stepX);
    QFETCH(int, goals);
    QFETCH(QString, outcome);
    Pitch pitch;
    pitch.kick(0, {3.5, y}, {stepX, 0.0}, std::abs(stepX) > 0.2 ? 2 : 7);
    pitch.now.isInPlay = false;
    pitch.now.teams[TeamColor::Blue].score = goals;
    pitch.play(0.2);
    const PlayEvent* shot = pitch.only(PlayKind::Shot);
    QCOMPARE(shot != nullptr, !outcome.isEmpty());
    if (shot) QCOMPARE(QString::fromLatin1(nameOf(shot->outcome).data()), outcome);
    const MatchStatistics all = pitch.tally.statistics({0.0, pitch.now.time});
    QCOMPARE(all.goals.size(), static_cast<std::size_t>(goals));
    QCOMPARE(pitch.only(PlayKind::Goal) != nullptr, goals == 1);
    if (goals == 1) {
      QCOMPARE(all.goals[0].goal.name, std::string("B1"));
      QVERIFY(std::abs(all.goals[0].goal.from->x - 3.5) < 1e-9);
      QVERIFY(all.goals[0].ball.size() >= 3);
    }
  }

  void theBallIsWonByWhoKeepsIt() {
    Pitch pitch;
    pitch.stand(0, 2.0);
    pitch.now.robots[0].place = Point{-0.6, 0.0};
    pitch.stand(2, 0.3);  // not long enough
    pitch.now.robots[2].place = Point{3.0, 0.0};
    pitch.stand(0, 1.0);
    QVERIFY(!pitch.only(PlayKind::BallWon));
    pitch.now.robots[0].place = Point{-0.6, 0.0};
    const double time = pitch.now.time;
    pitch.stand(2, 1.0);
    const PlayEvent* won = pitch.only(PlayKind::BallWon);
    QVERIFY(won);
    QCOMPARE(won->name + won->otherName, std::string("R1B1"));
    QVERIFY(std::abs(won->time - time) < 1e-6);
  }

  void setPlaysSayWhatCameOfThem() {
    Pitch pitch;
    const auto call = [&pitch] {
      pitch.now.isInPlay = false;
      pitch.now.restart = TallyRestart{SetPlay::CornerKick, TeamColor::Blue};
      pitch.play(2.0);
      pitch.now.restart.reset();
      pitch.now.isInPlay = true;
    };
    call();
    pitch.stand(1, 16.0);
    const PlayEvent* corner = pitch.only(PlayKind::SetPlay);
    QVERIFY(corner && corner->outcome == PlayOutcome::Kept);
    QCOMPARE(sentenceOf(*corner), std::string("corner kick for blue, taken by B2: kept the ball"));
    call();
    pitch.play(1.0);
    pitch.now.robots[1].place = Point{-4.0, 0.0};
    pitch.stand(2, 1.0);
    const auto plays = pitch.plays();
    QVERIFY(plays.back().outcome == PlayOutcome::Lost ||
            plays[plays.size() - 2].outcome == PlayOutcome::Lost);
  }

  void penaltiesLast() {
    Pitch pitch;
    pitch.now.robots[2].penalised = true;
    pitch.now.robots[2].penalty = PenaltyKind::Pushing;
    pitch.play(30.0);
    QVERIFY(pitch.only(PlayKind::Penalty)->outcome == PlayOutcome::GoesOn);
    pitch.now.robots[2].penalised = false;
    pitch.play(1.0);
    const PlayEvent* penalty = pitch.only(PlayKind::Penalty);
    QVERIFY(penalty && penalty->outcome == PlayOutcome::None);
    QVERIFY(std::abs(penalty->end - penalty->time - 30.0) < 1e-6);
    QCOMPARE(sentenceOf(*penalty), std::string("R1 is penalised: pushing, 30 s"));
  }

  /// Red plays to the left, so its robot at −4 m is near the goal that it attacks.
  void heatMapsShowBothTeamsPlayingToTheRight() {
    Pitch pitch;
    pitch.play(5.0);
    const MatchStatistics all = pitch.tally.statistics({0.0, pitch.now.time});
    const auto columnOf = [&all](const char* name) {
      const HeatMap& heat = all.robot(name)->heat;
      const auto most = std::ranges::max_element(heat.seconds);
      return static_cast<int>(most - heat.seconds.begin()) % heat.columns;
    };
    // 10.4 m in squares of half a metre, from x = -5.2 m.
    QCOMPARE(all.robot("B1")->heat.columns, 21);
    QCOMPARE(columnOf("B1"), 2);
    QCOMPARE(columnOf("R1"), 18);
  }

  /// A fast part of what the benchmark play_proof measures (docs/statistics.md).
  void simulatedMatchesAgreeWithTheTruth() {
    PlayScore all;
    for (const std::uint64_t seed : {4U, 7U, 14U}) {
      Scenario scenario = loadScenario("match-3v3").value();
      scenario.settings.seed = seed;
      auto match = SimulatedMatch::create(scenario, {}).value();
      const PlayTrial trial(match, 400.0);
      for (const PlayScore& one : {trial.withCounters.completed, trial.withCounters.intercepted,
                                   trial.withCounters.shots}) {
        all.truth += one.truth;
        all.found += one.found;
        all.invented += one.invented;
      }
    }
    qInfo("%d passes and shots, found %.1f %%, invented %.1f %%", all.truth,
          100.0 * all.foundShare(), 100.0 * all.inventedShare());
    QVERIFY(all.truth >= 35);
    QVERIFY(all.foundShare() >= 0.95);
    QVERIFY(all.inventedShare() <= 0.05);
  }

  void tablesForOtherPrograms() {
    PlayEvent pass;
    pass.outcome = PlayOutcome::Completed;
    pass.time = 1.25;
    pass.end = 2.0;
    pass.name = "B1";
    pass.otherName = "B2";
    pass.from = Point{-1.0, 0.5};
    QCOMPARE(playCsv({pass}),
             std::string("time,end,kind,outcome,team,robot,other,x,y,to_x,to_y,sigma,detail\n"
                         "1.250,2.000,pass,completed,blue,B1,B2,-1.000,0.500,,,0.000,\n"));
  }
};

PITCHBOARD_TEST(TestPlayEvents)

}  // namespace tst_play_events

#include "tst_play_events.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// One tally of a match: the same numbers while it is played, from its recording and by an
// experiment; and what counts as a pass, a way and time at the ball, in made moments.
#include <QtTest>

#include <robotlink/experiment/run_player.h>
#include <robotlink/report/report.h>
#include <robotlink/report/session_tally.h>
#include <robotlink/session/match_sampler.h>

#include "experiment_rig.h"
#include "run_layout.h"

namespace tst_match_tally {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace experiment_rig;

namespace {

/// Ends between two moments of the tally.
const std::string experiment = R"({
  "version": 1, "name": "tally", "scenario": "match-3v3", "runs": 1, "seed": 5,
  "conditions": [{"name": "plain", "set": {"noise": "realistic"}}],
  "stop": {"duration": 60.05}
})";

struct Played {
  explicit Played(const QString& folder) {
    const Experiment e = experimentFrom(experiment);
    path = folder.toStdString() + "/run.mcap";
    auto player = RunPlayer::create(e, {});
    result = player->record(1, path, "test").value();
    robots = robotsOf(e);

    auto match = SimulatedMatch::create(scenarioOf(e, placeOf(e, 1)).value(), {}).value();
    const auto tally = std::make_shared<RowTally>(match.scenario().settings.field);
    MatchSampler sampler(tally);
    sampler.ticked(match, {});
    while (match.simulation().state().tick < result.ticks) {
      match.tick();
      sampler.ticked(match, std::chrono::nanoseconds(1000));
    }
    if (match.simulation().hash() != result.hash) qFatal("another match");
    range = {0.0, match.simulation().snapshot().time};
    played = tally->statistics(range);
    const auto session = telemetry::SessionReader::open(path).value();
    recorded = statisticsOf(session, range);
  }
  double value(TeamValue which) const { return result.values[static_cast<std::size_t>(which)]; }

  std::string path;
  telemetry::TimeRange range;
  RunResult result;
  std::vector<std::string> robots;
  MatchStatistics played, recorded;
};

bool isNear(double a, double b, double most = 1e-9) {
  return std::abs(a - b) <= most;
}

/// B1, B2 and R1 beside the ball, ten moments a second.
struct Made {
  Made() {
    for (const char* name : {"B1", "B2", "R1"}) {
      TallyRobot& robot = now.robots.emplace_back();
      robot.uid = {static_cast<std::uint32_t>(now.robots.size())};
      robot.name = name;
      robot.team = name[0] == 'B' ? TeamColor::Blue : TeamColor::Red;
      robot.place = Point{5.0, static_cast<double>(now.robots.size())};
      robot.kicks = 0.0;
    }
    now.ball = Point{};
    play(0.1);
  }
  void play(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(10.0 * seconds)); ++i) {
      for (TallyRobot& robot : now.robots) {
        robot.ballDistance = distance(*robot.place, *now.ball);
      }
      tally.add(now);
      now.time += tallyStep;
    }
  }
  /// B1 kicks at `from`; the ball comes to `to`, where nobody is yet.
  void kick(const Point& from, const Point& to) {
    now.ball = from;
    now.robots[0].place = Point{from.x - 0.2, from.y};
    play(0.2);
    *now.robots[0].kicks += 1.0;
    play(0.1);
    now.robots[0].place = Point{5.0, 1.0};
    for (int i = 1; i <= 5; ++i) {
      now.ball = Point{from.x + (to.x - from.x) * i / 5, from.y + (to.y - from.y) * i / 5};
      play(0.1);
    }
    play(0.2);
  }
  void come(std::size_t robot, const Point& to) {
    const auto before = now.robots[robot].place;
    now.robots[robot].place = to;
    play(0.2);
    now.robots[robot].place = before;
    play(0.1);
  }
  std::uint32_t passes() const {
    return tally.statistics({0.0, now.time}).robot("B1")->plays.passes;
  }

  TallyMoment now;
  MatchTally tally;
};

}  // namespace

class TestMatchTally : public QObject {
  Q_OBJECT
 private slots:
  /// From its last message to the next one; and one that has not come back.
  void outagesHaveTheirLength() {
    TallyMoment now;
    TallyRobot& robot = now.robots.emplace_back();
    robot.uid = {1};
    robot.name = "B1";
    robot.link.emplace();
    MatchTally tally;
    const auto look = [&](double time, double lastMessage) {
      now.time = time;
      robot.link->age = std::chrono::duration_cast<telemetry::Duration>(
          std::chrono::duration<double>(time - lastMessage));
      robot.link->timedOut = time - lastMessage >= 10.0;
      tally.add(now);
    };
    for (int i = 0; i <= 40; ++i) look(i, std::min<double>(i, 5));  // silent from 5 s on
    for (int i = 41; i <= 70; ++i) look(i, std::min(40.5 + (i - 41), 50.5));
    const MatchStatistics statistics = tally.statistics({0.0, 70.0});
    const auto& link = statistics.robot("B1")->link;
    QVERIFY(link);
    QCOMPARE(link->outages.size(), std::size_t{2});
    QVERIFY(link->outages[0].isOver);
    QVERIFY(isNear(link->outages[0].begin, 5.0, 1e-6) && isNear(link->outages[0].end, 40.5, 1e-6));
    QVERIFY(!link->outages[1].isOver);
    QVERIFY(isNear(link->outages[1].begin, 50.5, 1e-6) && isNear(link->outages[1].end, 70.0));
    ReportContent content;
    content.statistics = tally.statistics({0.0, 70.0});
    const std::string page = reportHtml(content);
    for (const char* text : {"<h2>Outages</h2>", "0:05.0", "0:40.5", "35 s", "not back"})
      QVERIFY2(page.find(text) != std::string::npos, text);
  }

  void everyWayOfReadingGivesTheSameNumbers() {
    const QTemporaryDir folder;
    const Played match(folder.path());
    // While it is played, and from its recording.
    QCOMPARE(match.recorded.robots.size(), std::size_t{6});
    QCOMPARE(match.played.robots.size(), std::size_t{6});
    for (const RobotSummary& one : match.recorded.robots) {
      const RobotSummary* other = match.played.robot(one.name);
      QVERIFY2(other != nullptr, one.name.c_str());
      QCOMPARE(one.kicks, other->kicks);
      QCOMPARE(one.falls, other->falls);
      QVERIFY(one.plays == other->plays);
      QCOMPARE(one.penalties, other->penalties);
      QCOMPARE(*one.distance, *other->distance);
      QCOMPARE(one.ballSeconds, other->ballSeconds);
      QCOMPARE(one.seconds, other->seconds);
      QVERIFY(one.uptime == other->uptime);
      // Files keep a belief error to 1/256 cm.
      QVERIFY(isNear(*one.errorMean, *other->errorMean, 0.005));
      QVERIFY(isNear(*one.errorMedian, *other->errorMedian, 0.005));
      QVERIFY(isNear(*one.error90, *other->error90, 0.005));
      QVERIFY(isNear(*one.errorEnd, *other->errorEnd, 0.005));
    }
    for (const TeamSummary& one : match.recorded.teams) {
      const TeamSummary* other = match.played.team(one.team);
      QVERIFY(other != nullptr);
      QCOMPARE(one.score, other->score);
      QCOMPARE(one.scored, other->scored);
      QCOMPARE(one.byHalf, other->byHalf);
      QCOMPARE(one.ballSeconds, other->ballSeconds);
      QCOMPARE(one.distance, other->distance);
      QVERIFY(one.ballCurve == other->ballCurve);
    }
    // While it is played, and by an experiment.
    const TeamSummary &blue = *match.played.team(TeamColor::Blue),
                      &red = *match.played.team(TeamColor::Red);
    QVERIFY(blue.ballSeconds + red.ballSeconds > 1.0);
    QVERIFY(blue.distance > 1.0);
    QCOMPARE(match.value(TeamValue::Goals), double(blue.scored));
    QCOMPARE(match.value(TeamValue::GoalsAgainst), double(red.scored));
    QCOMPARE(match.value(TeamValue::Kicks), double(blue.kicks));
    QCOMPARE(match.value(TeamValue::Falls), double(blue.falls));
    QCOMPARE(match.value(TeamValue::Penalties), double(blue.penalties));
    QCOMPARE(match.value(TeamValue::Passes), double(blue.plays.passes + red.plays.passes));
    QCOMPARE(match.value(TeamValue::PassesOwn), double(blue.plays.passes));
    QCOMPARE(match.value(TeamValue::Walked), blue.distance);
    QVERIFY(isNear(match.value(TeamValue::Possession),
                   blue.ballSeconds / (blue.ballSeconds + red.ballSeconds)));
    for (std::size_t i = 0; i < match.robots.size(); ++i) {
      const RobotSummary* robot = match.played.robot(match.robots[i]);
      QVERIFY(robot != nullptr);
      const auto value = [&](RobotValue which) {
        return match.result
            .values[teamValueCount + i * robotValueCount + static_cast<std::size_t>(which)];
      };
      QCOMPARE(value(RobotValue::Walked), *robot->distance);
      QCOMPARE(value(RobotValue::Kicks), double(robot->kicks));
      QVERIFY(isNear(value(RobotValue::BeliefError), *robot->errorMean / 100.0));
    }
  }

  void passesAreCounted() {
    Made made;
    made.kick({0.0, 0.0}, {1.5, 0.0});
    made.come(1, {1.4, 0.0});
    QCOMPARE(made.passes(), 1U);
    made.kick({0.0, 0.0}, {1.5, 0.0});
    made.come(2, {1.4, 0.0});  // an opponent has it
    made.come(1, {1.4, 0.0});
    QCOMPARE(made.passes(), 1U);
    made.kick({0.0, 0.0}, {0.4, 0.0});  // hardly left
    made.come(1, {0.4, 0.0});
    QCOMPARE(made.passes(), 1U);
    made.kick({0.0, 0.0}, {1.5, 0.0});
    made.play(16.0);  // who finds it later
    made.come(1, {1.4, 0.0});
    QCOMPARE(made.passes(), 1U);
    made.kick({0.0, 0.0}, {1.5, 0.0});
    made.come(0, {1.4, 0.0});  // who runs after its own kick
    made.come(1, {1.4, 0.0});
    QCOMPARE(made.passes(), 1U);
    made.kick({0.0, 0.0}, {1.5, 0.0});
    made.now.isInPlay = false;  // a whistle between
    made.play(0.3);
    made.now.isInPlay = true;
    made.come(1, {1.4, 0.0});
    QCOMPARE(made.passes(), 1U);
  }

  void theNearestRobotHasTheBall() {
    Made made;
    made.now.robots[0].place = Point{0.4, 0.0};
    made.now.robots[2].place = Point{0.3, 0.0};
    made.play(2.0);
    made.now.robots[2].place = Point{0.6, 0.0};
    made.play(1.0);
    const MatchStatistics all = made.tally.statistics({0.0, made.now.time});
    QVERIFY(isNear(all.robot("R1")->ballSeconds, 2.0));
    QVERIFY(isNear(all.robot("B1")->ballSeconds, 1.0));
    QVERIFY(isNear(all.team(TeamColor::Red)->ballSeconds, 2.0));
  }

  /// 0.5 m/s for ten seconds; in the middle it believes for a second to be 4 m away.
  void jumpsAreNoWay() {
    MatchTally tally;
    TallyMoment now;
    now.robots.emplace_back().name = "B1";
    for (int i = 0; i <= 100; ++i) {
      now.time = 0.1 * i;
      TallyRobot& robot = now.robots[0];
      robot.place = Point{0.05 * i, i >= 50 && i < 60 ? 4.0 : 0.0};
      robot.placeTime = now.time;
      tally.add(now);
    }
    const double walked = *tally.statistics({0.0, 10.0}).robot("B1")->distance;
    QVERIFY2(walked > 4.3 && walked <= 5.0, std::to_string(walked).c_str());
  }

  /// A counter that starts again goes on, and what was so before the range is not of it.
  void countersAndStatesBeginWithTheRange() {
    MatchTally tally;
    TallyMoment now;
    TallyRobot& robot = now.robots.emplace_back();
    robot.name = "B1";
    robot.kicks = 7.0;
    robot.penalised = true;
    tally.begin(now);
    for (const double kicks : {7.0, 9.0, 0.0, 1.0}) {
      now.time += 0.1;
      robot.kicks = kicks;
      robot.penalised = kicks > 8.0 || kicks == 7.0;
      tally.add(now);
    }
    now.time += 0.1;
    robot.penalised = true;
    tally.add(now);
    const MatchStatistics all = tally.statistics({0.0, 1.0});
    QCOMPARE(all.robot("B1")->kicks, 3U);
    QCOMPARE(all.robot("B1")->penalties, 1U);
  }
};

PITCHBOARD_TEST(TestMatchTally)

}  // namespace tst_match_tally

#include "tst_match_tally.moc"

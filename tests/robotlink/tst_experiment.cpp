// SPDX-License-Identifier: GPL-3.0-or-later

// Experiments: files and their errors, runs that depend on their number only, folders whose bytes
// do not depend on how they were filled, separate processes that end in the same state.

#include <QtTest>
#include <algorithm>
#include <filesystem>
#include <map>

#include <base/file_target.h>
#include <base/read_file.h>
#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/experiment/run_player.h>
#include <robotlink/experiment/situation_test.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/referee_rule_sets.h>

#include "../support/frame_settings.h"
#include "experiment_rig.h"

namespace tst_experiment {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace experiment_rig;

namespace {

std::map<std::string, std::string> filesIn(const std::string& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    out[entry.path().filename()] = readFile(entry.path(), 1 << 24).value();
  }
  return out;
}

Result<void> playInto(ExperimentFolder& folder, const Experiment& experiment,
                      const std::vector<std::size_t>& numbers, std::size_t jobs) {
  auto played = playRuns(experiment, numbers, jobs, {},
                         [&](const PlayedRun& run) { return folder.add(run.result); });
  if (!played) return played;
  return folder.finish();
}

bool same(const RunResult& a, const RunResult& b) {
  return a.number == b.number && a.seed == b.seed && a.match == b.match && a.hash == b.hash &&
         a.ticks == b.ticks && a.paths == b.paths &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
                    [](double x, double y) { return x == y || (x != x && y != y); });
}

}  // namespace

class TestExperiment : public QObject {
  Q_OBJECT

 private slots:
  void runsDependOnTheirNumberOnly();
  void folderDoesNotShowHowItWasFilled();
  void folderOfAnotherExperimentIsRefused();
  void resultsAreDiscarded();
  void aPlacedRobotStandsThere();
  void stuckRobotsEndTheRun();
  void goalsAreCountedForTheTeam();
  void metricsLeaveUnknownValuesOut();
  void assertionsAndMetricsAgreeOnUnknownValues();
  void theBallsPathHasAGapAfterAGoal();
  void recordedRunEndsInTheSameState();
  void aRunThatEndsDifferentlyIsMarked();
  void conditionsWithoutAnEffectAreNamed();
  void separateProcessesEndInTheSameState();
  void aSituationStartsInAnyState_data();
  void aSituationStartsInAnyState();
  void aSituationKeepsTheGame();
};

void TestExperiment::runsDependOnTheirNumberOnly() {
  const Experiment e = experimentFrom(shortMatch);
  std::map<std::size_t, RunResult> one, many;
  const auto into = [](std::map<std::size_t, RunResult>& results) {
    return [&results](const PlayedRun& run) -> Result<void> {
      results[run.result.number] = run.result;
      return {};
    };
  };
  QVERIFY(playRuns(e, numbers(1, 8), 1, {}, into(one)).has_value());
  std::vector<std::size_t> backwards = numbers(1, 8);
  std::reverse(backwards.begin(), backwards.end());
  QVERIFY(playRuns(e, backwards, 3, {}, into(many)).has_value());
  QCOMPARE(one.size(), std::size_t{8});
  for (const auto& [number, result] : one) QVERIFY(same(result, many[number]));
  QVERIFY(one[1].hash != one[2].hash);
  QVERIFY(one[1].hash != one[5].hash);
  const auto metrics = metricsOf(e);
  QCOMPARE(one[1].values.size(), metrics.size());
  QCOMPARE(metrics.back().name, std::string("nearest_cm"));
  QVERIFY(one[1].values.back() > 5.0 && one[1].values.back() < 45.0);
  QCOMPARE(one[1].paths.size(), std::size_t{2});  // the ball and B1
}

void TestExperiment::folderDoesNotShowHowItWasFilled() {
  const QTemporaryDir dir;
  const Experiment e = experimentFrom(shortMatch);
  const auto in = [&dir](const char* name) { return dir.filePath(name).toStdString(); };
  {
    auto whole = ExperimentFolder::begin(in("whole"), e, false);
    QVERIFY(whole.has_value());
    QVERIFY(playInto(*whole, e, numbers(1, 8), 1).has_value());
    QVERIFY(whole->complete());
  }
  {  // some runs, then a program that was killed in the middle of a line
    auto begun = ExperimentFolder::begin(in("resumed"), e, false);
    QVERIFY(playInto(*begun, e, {5, 2, 8}, 2).has_value());
    QVERIFY(!begun->complete());
  }
  QVERIFY(!std::filesystem::exists(in("resumed/report.md")));
  {
    QFile lines(QString::fromStdString(in("resumed/runs.jsonl")));
    QVERIFY(lines.open(QIODevice::Append));
    lines.write("{\"run\":3,\"seed\":9,\"en");
  }
  {
    auto resumed = ExperimentFolder::begin(in("resumed"), e, true);
    QVERIFY(resumed.has_value());
    QCOMPARE(resumed->finishedCount(), std::size_t{3});
    QVERIFY(playInto(*resumed, e, {7, 6, 4, 3, 1}, 3).has_value());
    QVERIFY(resumed->complete());
  }
  for (const std::size_t shard : {1U, 2U, 3U}) {
    auto part = ExperimentFolder::begin(in("part") + std::to_string(shard), e, false);
    QVERIFY(playInto(*part, e, numbers(shard, 8, 3), 2).has_value());
  }
  {
    const auto merged = mergeFolders({in("part3"), in("part1"), in("part2")}, in("merged"), e);
    QVERIFY2(merged.has_value(), merged ? "" : merged.error().text().c_str());
    QVERIFY(merged->complete());
  }
  const auto whole = filesIn(in("whole"));
  QCOMPARE(whole.size(), std::size_t{7});
  QVERIFY(filesIn(in("resumed")) == whole);
  QVERIFY(filesIn(in("merged")) == whole);
  QVERIFY(whole.at("report.md").find("p95(nearest_cm) < 60") != std::string::npos);
  QVERIFY(whole.at("report.html").find("<svg") != std::string::npos);
  QCOMPARE(std::count(whole.at("runs.csv").begin(), whole.at("runs.csv").end(), '\n'), 9);
  const auto again = experimentOf(in("whole"));
  QVERIFY(again.has_value());
  QCOMPARE(again->text, e.text);
}

void TestExperiment::folderOfAnotherExperimentIsRefused() {
  const QTemporaryDir dir;
  const std::string path = dir.filePath("results").toStdString();
  const Experiment e = experimentFrom(shortMatch);
  const Experiment other = experimentFrom(replaced(shortMatch, "\"seed\": 7", "\"seed\": 8"));
  {
    auto folder = ExperimentFolder::begin(path, e, false);
    QVERIFY(folder.has_value());
    QCOMPARE(ExperimentFolder::begin(path, e, true).error().message,
             std::string("another program is playing this experiment"));
  }
  QCOMPARE(ExperimentFolder::begin(path, e, false).error().code, ErrorCode::Conflict);
  QCOMPARE(ExperimentFolder::begin(path, other, true).error().code, ErrorCode::Conflict);
  QVERIFY(ExperimentFolder::begin(path, e, true).has_value());
  for (const auto& [experiment, resume] : {std::pair{&e, false}, {&other, true}}) {
    const auto refused = ExperimentFolder::begin(path, *experiment, resume);
    QVERIFY(refused.error().message.find("--force to start over") != std::string::npos);
  }
  QCOMPARE(mergeFolders({path}, dir.filePath("m").toStdString(), other).error().code,
           ErrorCode::Conflict);
}

/// Only what belongs to the results goes.
void TestExperiment::resultsAreDiscarded() {
  const QTemporaryDir dir;
  const std::string path = dir.filePath("results").toStdString();
  QVERIFY(discardResults(path).has_value());  // nothing is there yet
  const Experiment e = experimentFrom(shortMatch);
  const std::string session = sessionPath(path, 1);
  {
    auto folder = ExperimentFolder::begin(path, e, false);
    QVERIFY(folder.has_value());
    QCOMPARE(discardResults(path).error().message,
             std::string("another program is playing this experiment"));
    QVERIFY(folder->finish().has_value());
  }
  std::filesystem::create_directories(std::filesystem::path(session).parent_path());
  for (const std::string& file : {session, path + "/notes.txt", path + "/report.html"}) {
    QVERIFY(writeFile(file, "text", IfExists::Refuse).has_value());
  }
  QVERIFY(discardResults(path).has_value());
  QCOMPARE(QDir(QString::fromStdString(path)).entryList(QDir::AllEntries | QDir::NoDotAndDotDot),
           QStringList{"notes.txt"});
  const Experiment other = experimentFrom(replaced(shortMatch, "\"seed\": 7", "\"seed\": 8"));
  QVERIFY(ExperimentFolder::begin(path, other, false).has_value());
}

void TestExperiment::aPlacedRobotStandsThere() {
  const Experiment e = experimentFrom(R"({
    "version": 1, "scenario": "one-robot", "runs": 1, "set": {"noise": "none"},
    "placed": [{"time": 1, "who": "B1", "x": 2, "y": 1}, {"time": 1, "who": "ball", "x": -3, "y": -2}],
    "metrics": [{"name": "far", "expression": "B1.TRUE_X", "reduce": "max"},
                {"name": "ball", "expression": "match.BALL_X", "reduce": "last"}],
    "stop": {"duration": 1.2}})");
  auto player = RunPlayer::create(e, {});
  const auto result = player->play(1);
  QVERIFY2(result.has_value(), result ? "" : result.error().text().c_str());
  QVERIFY(std::abs(result->values[result->values.size() - 2] - 2.0) < 0.1);
  QVERIFY(std::abs(result->values.back() + 3.0) < 0.1);
  QCOMPARE(result->ticks, std::uint64_t{72});
}

void TestExperiment::stuckRobotsEndTheRun() {
  const Experiment e =
      experimentFrom(replaced(replaced(shortMatch, "\"naive\"", "\"none\""), "\"duration\": 3",
                              "\"duration\": 100, \"stuck\": 2"));
  auto player = RunPlayer::create(e, {});
  const auto result = player->play(1);
  QVERIFY(result.has_value());
  QCOMPARE(result->match.endedBy, std::string("stuck"));
  QCOMPARE(result->ticks, std::uint64_t{120});
}

void TestExperiment::goalsAreCountedForTheTeam() {
  const std::string shot = R"({
    "version": 1, "team": "TEAM", "scenario": {"version": 1, "ball": {"x": 4, "y": 0, "vx": 8},
      "robots": [{"team": "blue", "number": 1, "x": -3, "y": 2, "behaviour": "none"},
                 {"team": "red", "number": 1, "x": 3, "y": 2, "behaviour": "none"}]},
    "stop": {"duration": 3, "goal": true, "goal_against": true}})";
  for (const auto& [team, end] : {std::pair{"blue", "goal"}, std::pair{"red", "goal_against"}}) {
    const Experiment e = experimentFrom(replaced(shot, "TEAM", team));
    auto player = RunPlayer::create(e, {});
    const auto result = player->play(1);
    QVERIFY(result.has_value());
    QCOMPARE(result->match.endedBy, std::string(end));
  }
}

/// Before a robot has seen the ball, its blackboard says 0 cm, and a plot shows a gap.
void TestExperiment::metricsLeaveUnknownValuesOut() {
  const Experiment e =
      experimentFrom(replaced(shortMatch, "B1.TRUE_BALL_DIST", "min(1000, B1.VISION_BALL_DIST)"));
  auto player = RunPlayer::create(e, {});
  const auto result = player->play(1);
  QVERIFY2(result.has_value(), result ? "" : result.error().text().c_str());
  QVERIFY2(result->values.back() > 5.0 && result->values.back() < 45.0,
           std::to_string(result->values.back()).c_str());

  // A robot that never sees it: there is no value, not one of 0.
  const Experiment blind =
      experimentFrom(replaced(replaced(shortMatch, "B1.TRUE_BALL_DIST", "B1.VISION_BALL_DIST"),
                              R"("x": 0.3)", R"("x": -4.0)"));
  auto blindPlayer = RunPlayer::create(blind, {});
  const auto none = blindPlayer->play(1);
  QVERIFY(none.has_value());
  QVERIFY2(std::isnan(none->values.back()), std::to_string(none->values.back()).c_str());
}

/// A goal that was never scored has no time: neither a metric nor a condition makes a number of it.
void TestExperiment::assertionsAndMetricsAgreeOnUnknownValues() {
  for (const auto& [success, holds] : {std::pair{"min(time_to_goal_s, 100) < 200", false},
                                       {"min(100, time_to_goal_s) < 200", false},
                                       {"time_to_goal_s ? 1 : 1", false},
                                       {"!(time_to_goal_s < 5)", false},
                                       {"known(time_to_goal_s) ? time_to_goal_s < 5 : 1", true}}) {
    const Experiment e = experimentFrom(replaced(shortMatch, "nearest_cm < 25", success));
    auto player = RunPlayer::create(e, {});
    const auto result = player->play(1);
    QVERIFY2(result.has_value(), success);
    const auto metrics = metricsOf(e);
    const auto at = std::ranges::find(metrics, std::string("success"), &MetricInfo::name);
    const double value = result->values[static_cast<std::size_t>(at - metrics.begin())];
    QVERIFY2((value != 0.0) == holds, success);
  }
}

void TestExperiment::theBallsPathHasAGapAfterAGoal() {
  const Experiment e = experimentFrom(R"({
    "version": 1, "name": "goal", "scenario": {"version": 1, "ball": {"x": 4, "y": 0, "vx": 8},
      "robots": [{"team": "blue", "number": 1, "x": -3, "y": 2, "behaviour": "none"}]},
    "sample": 0.5, "stop": {"duration": 3}})");
  auto player = RunPlayer::create(e, {});
  const auto result = player->play(1);
  QVERIFY2(result.has_value(), result ? "" : result.error().text().c_str());
  std::vector<std::vector<Point>> pieces;
  for (const RunPath& path : result->paths) {
    if (path.who == "ball") pieces.push_back(path.points);
  }
  QCOMPARE(pieces.size(), std::size_t{2});
  QVERIFY(pieces[0].back().x > 4.3);             // as far as it went
  QVERIFY(std::abs(pieces[1].front().x) < 0.5);  // where it was put
  QCOMPARE(result->paths.size(), std::size_t{3});
  // They go through the file.
  const QTemporaryDir dir;
  const std::string out = dir.filePath("out").toStdString();
  auto folder = ExperimentFolder::begin(out, e, false);
  QVERIFY(playInto(*folder, e, numbers(1, e.allRuns()), 1).has_value());
  const auto table = resultsOf(out, e);
  QVERIFY(table.has_value());
  QVERIFY(table->conditions[0].drawn.at(0).paths == result->paths);
}

void TestExperiment::recordedRunEndsInTheSameState() {
  const QTemporaryDir dir;
  const Experiment e = experimentFrom(shortMatch);
  auto player = RunPlayer::create(e, {});
  const auto played = player->play(6);
  const auto recorded = player->record(6, dir.filePath("run.mcap").toStdString(), "test");
  QVERIFY2(recorded.has_value(), recorded ? "" : recorded.error().text().c_str());
  QVERIFY(same(*played, *recorded));
  QVERIFY(QFileInfo(dir.filePath("run.mcap")).size() > 1000);
}

void TestExperiment::aRunThatEndsDifferentlyIsMarked() {
  const QTemporaryDir dir;
  const Experiment e = experimentFrom(shortMatch);
  const std::string out = dir.filePath("out").toStdString(), session = sessionPath(out, 6);
  {
    auto folder = ExperimentFolder::begin(out, e, false);
    QVERIFY(playInto(*folder, e, numbers(1, 8), 1).has_value());
  }
  QVERIFY(recordAgain(out, e, 6, session, {}).has_value());
  QCOMPARE(summarize(e, *resultsOf(out, e)).conditions[1].unrepeatable, std::size_t{0});
  // As if the match had depended on something else.
  auto lines = readFile(out + '/' + runsFile, 1 << 20).value();
  char hash[24];
  std::snprintf(hash, sizeof hash, "0x%016llx",
                static_cast<unsigned long long>(resultOf(out, e, 6)->hash));
  QVERIFY(writeFile(out + '/' + runsFile, replaced(lines, hash, "0x0123456789abcdef"),
                    IfExists::Replace)
              .has_value());
  std::filesystem::remove(session);
  const auto again = recordAgain(out, e, 6, session, {});
  QCOMPARE(again.error().code, ErrorCode::Conflict);
  QVERIFY(!resultOf(out, e, 6)->match.repeatable && resultOf(out, e, 5)->match.repeatable);
  const auto files = filesIn(out);
  QVERIFY(files.at("runs.csv").find(",0x0123456789abcdef,0,") != std::string::npos);
  QVERIFY(files.at("summary.json").find("\"not_repeatable\": 1") != std::string::npos);
  QVERIFY(files.at("report.md").find("Not repeatable") != std::string::npos);
  std::filesystem::remove(session);
  QVERIFY(recordAgain(out, e, 6, session, {}).has_value());  // nobody expects it any more
}

void TestExperiment::conditionsWithoutAnEffectAreNamed() {
  const auto played = [](const std::string& text) {
    const QTemporaryDir dir;
    const Experiment e = experimentFrom(text);
    const std::string out = dir.filePath("out").toStdString();
    auto folder = ExperimentFolder::begin(out, e, false);
    if (!playInto(*folder, e, numbers(1, 8), 1)) qFatal("not played");
    const auto report = filesIn(out).at("report.md");
    return std::pair{identicalTexts(summarize(e, *resultsOf(out, e))), report};
  };
  const auto [same, sameReport] =
      played(replaced(shortMatch, R"("set": {"noise": "paper", "noise.forward": 0.01})",
                      R"("set": {"noise": "none", "writes[0].value": 2})"));
  QCOMPARE(same, std::vector<std::string>{
                     R"("plain" and "noisy" played identically: all 4 runs end in the same state. )"
                     "What differs between them has no effect in this scenario."});
  QVERIFY(sameReport.find("all 4 runs end in the same state") != std::string::npos);
  const auto [different, report] = played(shortMatch);
  QVERIFY(different.empty() && report.find("identically") == std::string::npos);
}

void TestExperiment::separateProcessesEndInTheSameState() {
  const Experiment inside = experimentFrom(shortMatch);
  const Experiment separate = experimentFrom(
      replaced(shortMatch, "\"runs\": 4", "\"processes\": \"separate\", \"runs\": 4"));
  PlaySettings settings;
  settings.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
  std::map<std::size_t, std::uint64_t> hashes;
  // Two at a time: each has its own match number, so that they do not hear each other.
  const auto played =
      playRuns(separate, numbers(5, 6), 2, settings, [&](const PlayedRun& run) -> Result<void> {
        hashes[run.result.number] = run.result.hash;
        return {};
      });
  QVERIFY2(played.has_value(), played ? "" : played.error().text().c_str());
  auto player = RunPlayer::create(inside, {});
  for (const std::size_t number : {5U, 6U}) QCOMPARE(hashes[number], player->play(number)->hash);
}

void TestExperiment::aSituationStartsInAnyState_data() {
  QTest::addColumn<QString>("game");
  QTest::addColumn<QString>("wanted");
  QTest::newRow("a penalty kick")
      << R"({"state": "playing", "clock": 300, "set_play": {"kind": "penalty_kick", "team": "blue"}})"
      << "penalty kick";
  QTest::newRow("a goal kick")
      << R"({"state": "playing", "clock": 300, "set_play": {"kind": "goal_kick", "team": "red"}})"
      << "goal kick";
  QTest::newRow("one minute left") << R"({"state": "playing", "clock": 60, "half": 2})"
                                   << "";
}
void TestExperiment::aSituationStartsInAnyState() {
  QFETCH(QString, game);
  QFETCH(QString, wanted);
  // Two are sent off, by a patch of the scenario's JSON.
  const Experiment experiment = experimentFrom(
      R"({"version": 1, "name": "state", "scenario": "match", "runs": 1, "stop": {"duration": 5},
          "set": {"game": )" +
      game.toStdString() +
      R"(, "robots[B2].penalty.kind": "sent_off", "robots[R3].penalty.kind": "sent_off"}})");
  const Scenario& scenario = experiment.conditions.front().scenario;
  QVERIFY(scenario.settings.referee && scenario.game);
  auto match = SimulatedMatch::create(scenario, {});
  QVERIFY2(match.has_value(), match ? "" : match.error().text().c_str());
  for (int i = 0; i < 60 * 5; ++i) match->tick();
  const Game& now = *match->simulation().state().game;
  QCOMPARE(QString::fromUtf8(labelOf(now.setPlay()).data()), wanted);
  if (wanted.isEmpty()) QCOMPARE(now.secondsLeft(), 55);
  const sim::Snapshot seen = match->simulation().snapshot();
  for (const auto& [colour, shirt] :
       {std::pair(TeamColor::Blue, 2), std::pair(TeamColor::Red, 3)}) {
    QCOMPARE(now.player(colour, shirt)->penalty, PenaltyKind::SentOff);
    for (const sim::RobotSnapshot& robot : seen.robots) {
      if (robot.identity.team != colour || robot.identity.number != shirt) continue;
      QVERIFY(std::abs(robot.pose.position.y) > scenario.settings.field.halfWidth());
    }
  }
}

void TestExperiment::aSituationKeepsTheGame() {
  MatchFrame frame;
  ownSettings(frame).physics = "rigid-body";
  frame.snapshot.ball = {1.0, 0.5};
  frame.snapshot.ballVelocity = {-0.5, 0.25};
  frame.snapshot.clock = 33.0;
  for (const int id : {1, 2}) {
    RobotFrame robot;
    robot.identity.id = {id};
    robot.identity.number = id;
    robot.pose = {{-1.0 * id, 0.25}, 0.5};
    frame.robots.push_back(robot);
  }
  Scenario base;
  base.settings.referee = **refereeRuleSet("humanoid-2021");
  sim::GameStart& game = base.game.emplace();
  game.state = PlayState::Ready;
  game.countdown = 12.0;
  game.robots[RobotId{2}] = {.penalty = PenaltyKind::Pushing, .left = 20.0};
  base.writes = {{{}, "COM_REFEREE", 2, 0.0}};
  MomentOptions options;
  options.base = &base;
  SituationTest situation;
  situation.name = experimentNameFrom("ready, set");
  QCOMPARE(situation.name, std::string("ready--set"));
  situation.scenario = situationScenario(frame, options).scenario;
  QVERIFY(!situationToJson(situation).has_value());  // nothing must hold
  situation.assertions = {"goal_rate >= 0.8"};
  situation.stop.duration = 12;
  situation.stop.goal = true;
  const auto text = situationToJson(situation);
  QVERIFY2(text.has_value(), text ? "" : text.error().text().c_str());
  const Experiment read = experimentFrom(*text);
  const Scenario& scenario = read.conditions.front().scenario;
  QVERIFY(scenario.settings.referee == base.settings.referee);
  QVERIFY(scenario.game == base.game);
  QCOMPARE(scenario.robots.size(), std::size_t{2});
  QCOMPARE(scenario.robots[1].pose.position, (Point{-2.0, 0.25}));
  QCOMPARE(scenario.ball, (Point{1.0, 0.5}));
  QCOMPARE(scenario.ballVelocity, (Velocity{-0.5, 0.25}));
  QVERIFY(scenario.writes.empty());  // the match tells its robots
  QCOMPARE(read.stop.duration, 12.0);
  QVERIFY(read.stop.goal && !read.stop.goalAgainst);
  // What is offered can be used.
  for (const SituationTemplate& one : situationTemplates()) {
    situation.assertions = {one.assertion};
    QVERIFY2(situationToJson(situation).has_value(), one.text);
  }
}

PITCHBOARD_TEST(TestExperiment)

}  // namespace tst_experiment

#include "tst_experiment.moc"

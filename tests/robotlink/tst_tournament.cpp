// SPDX-License-Identifier: GPL-3.0-or-later

// Tournaments: files and their errors, who plays whom on which side with which seed, the table and
// its interval, folders that do not show how they were filled.

#include <QtTest>
#include <cmath>
#include <filesystem>
#include <map>

#include <base/read_file.h>
#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/experiment/junit_report.h>
#include <robotlink/experiment/run_player.h>

#include "experiment_rig.h"

namespace tst_tournament {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace experiment_rig;

namespace {

/// Two seconds with two robots a side; blue begins beside the ball.
const std::string shortTournament = R"({
  "version": 1, "name": "two", "matches": 4, "seed": 7, "stop": {"duration": 2},
  "scenario": {
    "version": 1, "noise": "realistic", "ball": {"x": 0.3, "y": 0},
    "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": "none"},
               {"team": "blue", "number": 2, "x": -2, "y": 1, "behaviour": "none"},
               {"team": "red", "number": 1, "x": 2, "y": 0, "behaviour": "none"},
               {"team": "red", "number": 2, "x": 2, "y": 1, "behaviour": "none"}],
    "writes": [{"variable": "COM_REFEREE", "value": 2}]
  },
  "teams": [
    {"name": "walks", "number": 12, "robots": {"*": {"behaviour": "naive"}}},
    {"name": "stands", "number": 8}
  ],
  "assertions": ["low95(goal_difference) >= 0",
                 {"check": "mean(goals) > 100", "team": "stands", "opponent": "walks"}]
})";

std::map<std::string, std::string> bytesIn(const std::string& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file())
      out[entry.path().filename()] = readFile(entry.path(), 1 << 24).value();
  }
  return out;
}

Result<void> playRange(const std::string& folder, const Experiment& e,
                       const std::vector<std::size_t>& numbers, bool resume) {
  auto into = ExperimentFolder::begin(folder, e, resume);
  if (!into) return tl::unexpected(into.error());
  auto played =
      playRuns(e, numbers, 2, {}, [&](const PlayedRun& run) { return into->add(run.result); });
  return played ? into->finish() : played;
}

/// A run that ended like this for the two colours.
RunResult ended(const Experiment& e, std::size_t number, int blue, int red) {
  RunResult out;
  out.number = number;
  out.match.endedBy = "full_time";
  out.match.teams[1].colour = TeamColor::Red;
  out.match.teams[0].score = blue;
  out.match.teams[1].score = red;
  out.values.assign(metricsOf(e).size(), 0.0);
  return out;
}

}  // namespace

class TestTournament : public QObject {
  Q_OBJECT

 private slots:
  void sidesAreSwappedWithTheSameSeed();
  void theTableAddsUp();
  void aCoinDecides();
  void theIntervalIsThatOfPairs();
  void aFolderDoesNotShowHowItWasFilled();
  void wrongMatchesFail();
  void madeByAProgram();
  void againstVersion08();
  void theAdvisorsProof();
  void teamsHaveAdvisors();
  void wrongFilesAreExplained_data();
  void wrongFilesAreExplained();
};

void TestTournament::sidesAreSwappedWithTheSameSeed() {
  const Experiment e = experimentFrom(shortTournament);
  QCOMPARE(e.allRuns(), std::size_t{4});
  QCOMPARE(e.conditions.size(), std::size_t{2});
  QCOMPARE(e.conditions[0].name, std::string("walks (blue) against stands (red)"));
  QCOMPARE(e.conditions[1].name, std::string("stands (blue) against walks (red)"));
  for (const std::size_t number : {1U, 2U}) {
    QCOMPARE(seedOf(e, placeOf(e, number)), seedOf(e, placeOf(e, number + 2)));
    QCOMPARE(seedOf(e, placeOf(e, number)), std::uint64_t{6} + number);
  }
  for (const std::size_t side : {0U, 1U}) {
    const Scenario& scenario = e.conditions[side].scenario;
    QCOMPARE(scenario.settings.teams.size(), std::size_t{2});
    QCOMPARE(scenario.settings.teams[side].name, std::string("walks"));
    QCOMPARE(scenario.settings.teams[side].number, 12);
    for (const ScenarioRobot& robot : scenario.robots) {
      const bool walks = (robot.identity.team == TeamColor::Blue) == (side == 0);
      QCOMPARE(robot.behaviour, std::string(walks ? "naive" : "none"));
    }
  }
  auto player = RunPlayer::create(e, {});
  const auto result = player->play(3);
  QVERIFY2(result.has_value(), result ? "" : result.error().text().c_str());
  QCOMPARE(result->match.of(TeamColor::Blue)->name, std::string("stands"));
  QVERIFY(result->match.repeatable);
}

void TestTournament::theTableAddsUp() {
  const Experiment e =
      experimentFrom(replaced(replaced(shortTournament, "\"stands\", \"number\": 8}",
                                       "\"stands\", \"number\": 8},"
                                       "{\"name\": \"third\"}"),
                              "\"opponent\": \"walks\"", "\"opponent\": \"third\""));
  QCOMPARE(e.tournament->pairings.size(), std::size_t{3});
  QCOMPARE(e.allRuns(), std::size_t{12});
  ResultTable results(e);
  // walks against stands: 2:0, 1:1; stands plays blue: 0:3, 2:1.
  results.add(e, ended(e, 1, 2, 0));
  results.add(e, ended(e, 2, 1, 1));
  results.add(e, ended(e, 3, 0, 3));
  results.add(e, ended(e, 4, 2, 1));
  results.add(e, ended(e, 9, 0, 1));  // stands against third
  const TournamentTable table = tableOf(e, results);
  QCOMPARE(table.teams[0].name, std::string("walks"));
  const MatchTotals& walks = table.teams[0].totals;
  QCOMPARE(walks.played(), std::size_t{4});
  QCOMPARE(walks.won, std::size_t{2});
  QCOMPARE(walks.drawn, std::size_t{1});
  QCOMPARE(walks.lost, std::size_t{1});
  QCOMPARE(walks.goals, 7);
  QCOMPARE(walks.goalsAgainst, 3);
  QCOMPARE(walks.difference, 1.0);
  QCOMPARE(walks.points(), std::size_t{7});
  // As many points; the better difference is first.
  QCOMPARE(table.teams[1].name, std::string("stands"));
  QCOMPARE(table.teams[1].totals.points(), std::size_t{4});
  QCOMPARE(table.teams[2].name, std::string("third"));
  QCOMPARE(table.teams[2].totals.points(), std::size_t{3});
  QCOMPARE(table.pairings[0].totals.goals, 7);
  QCOMPARE(table.pairings[1].totals.played(), std::size_t{0});
  QCOMPARE(table.pairings[2].totals.lost, std::size_t{1});
  const ExperimentSummary summary = summarize(e, results);
  QCOMPARE(summary.assertions.size(), std::size_t{2});
  QCOMPARE(summary.assertions[1].condition, std::string("stands against third"));
  QCOMPARE(summary.assertions[1].values, std::string("mean(goals) = 0"));
  QVERIFY(!summary.assertions[1].holds && !summary.holds());
}

/// Of a shoot-out: the other team has lost, and the table says how it was won.
void TestTournament::aCoinDecides() {
  const Experiment e = experimentFrom(shortTournament);
  ResultTable results(e);
  RunResult first = ended(e, 1, 2, 2), second = ended(e, 3, 1, 1);
  first.match.teams[0].wonToss = true;   // walks plays blue
  second.match.teams[0].wonToss = true;  // stands plays blue
  results.add(e, first);
  results.add(e, ended(e, 2, 1, 1));
  results.add(e, second);
  const TournamentTable table = tableOf(e, results);
  for (const auto& [name, totals] : table.teams) {
    QCOMPARE(totals.won, std::size_t{1});
    QCOMPARE(totals.wonByCoin, std::size_t{1});
    QCOMPARE(totals.drawn, std::size_t{1});
    QCOMPARE(totals.lost, std::size_t{1});
    QCOMPARE(totals.difference, 0.0);
  }
  QVERIFY(tableCsv(table).find("points,won_by_coin\n") != std::string::npos);
}

/// The two matches of a seed differ by the sides alone: drawn together their difference has no
/// spread, drawn one by one it would have.
void TestTournament::theIntervalIsThatOfPairs() {
  const Experiment e =
      experimentFrom(replaced(shortTournament, "\"matches\": 4", "\"matches\": 20"));
  ResultTable results(e);
  for (std::size_t i = 1; i <= 10; ++i) {
    results.add(e, ended(e, i, 3, 0));       // who plays blue wins by three,
    results.add(e, ended(e, i + 10, 1, 0));  // and loses the other one
  }
  const MatchTotals totals = tableOf(e, results).teams[0].totals;
  QCOMPARE(totals.difference, 1.0);
  QCOMPARE(*totals.difference95, (Interval{1.0, 1.0}));
  QVERIFY(summarize(e, results).assertions[0].holds);
}

void TestTournament::aFolderDoesNotShowHowItWasFilled() {
  const QTemporaryDir dir;
  const auto in = [&dir](const char* name) { return dir.filePath(name).toStdString(); };
  const Experiment e = experimentFrom(shortTournament);
  QVERIFY(playRange(in("whole"), e, {1, 2, 3, 4}, false).has_value());
  QVERIFY(playRange(in("resumed"), e, {4, 1}, false).has_value());
  QVERIFY(!std::filesystem::exists(in("resumed") + "/table.csv"));
  QVERIFY(playRange(in("resumed"), e, {3, 2}, true).has_value());
  QVERIFY(playRange(in("part1"), e, {1, 3}, false).has_value());
  QVERIFY(playRange(in("part2"), e, {2, 4}, false).has_value());
  // What a folder holds is enough to go on with it.
  const auto again = experimentOf(in("part1"));
  QVERIFY2(again.has_value(), again ? "" : again.error().text().c_str());
  QCOMPARE(again->text, e.text);
  QVERIFY(mergeFolders({in("part2"), in("part1")}, in("merged"), *again).has_value());
  const auto whole = bytesIn(in("whole"));
  QVERIFY(bytesIn(in("resumed")) == whole);
  QVERIFY(bytesIn(in("merged")) == whole);
  QVERIFY(whole.at("table.csv").find("\nwalks,4,") != std::string::npos);
  // On both sides the values are those of the first of the pairing, here the one that walks.
  QVERIFY(whole.at("runs.csv").find(",stands,walks,") == std::string::npos);
  const ResultTable table = resultsOf(in("whole"), e).value();
  for (std::size_t side = 0; side < 2; ++side) {
    const std::vector<double> walked = valuesOf("walked_m", table, side).value();
    QVERIFY(std::ranges::all_of(walked, [](double metres) { return metres > 0.0; }));
  }
  QCOMPARE(valuesOf("2 * time_s + kicks - kicks", table, 1).value(), (std::vector<double>{4, 4}));
  QVERIFY(!valuesOf("walked", table, 0));
  QVERIFY(whole.at("report.md").find("| walks | 4 |") != std::string::npos);
  QVERIFY(whole.at("junit.xml").find("low95(goal_difference)") != std::string::npos);
  QVERIFY(whole.at("junit.xml").find("failures=\"1\"") != std::string::npos);
}

void TestTournament::wrongMatchesFail() {
  const Experiment e = experimentFrom(R"({"version": 1, "name": "league", "matches": 2,
    "scenario": "match", "teams": [{"name": "a"}, {"name": "b"}]})");
  QVERIFY(e.tournament->wholeMatches);
  QVERIFY(e.stop.duration > 3600.0);
  ResultTable results(e);
  results.add(e, ended(e, 1, 1, 0));
  QVERIFY(summarize(e, results).holds());
  RunResult cut = ended(e, 2, 1, 0);
  const auto metrics = metricsOf(e);
  const auto timeout = std::ranges::find(metrics, "timeout", &MetricInfo::name);
  cut.values[static_cast<std::size_t>(timeout - metrics.begin())] = 1.0;
  results.add(e, cut);
  const ExperimentSummary summary = summarize(e, results);
  QVERIFY(!summary.holds());
  QCOMPARE(summary.tournament->wrong.size(), std::size_t{1});
  QVERIFY(junitReport(e, summary).find("<failure message=\"no final whistle\"") !=
          std::string::npos);
}

/// As another command would: without a file.
void TestTournament::madeByAProgram() {
  const std::string scenario = R"({"version": 1, "ball": {"x": 0.3, "y": 0}, "noise": "none",
    "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0},
               {"team": "red", "number": 1, "x": 2, "y": 0}]})";
  Tournament tournament;
  tournament.teams.resize(2);
  tournament.teams[0].name = "old";
  tournament.teams[0].robots = {{1, {"behaviour", "\"naive\"", 1}}};
  tournament.teams[1].name = "new";
  tournament.teams[1].robots = {{0, {"behaviour", "\"none\"", 1}}};
  tournament.pairings = {{0, 1}};
  Experiment how;
  how.seed = 3;
  how.stop.duration = 1;
  auto e = tournamentExperiment(tournament, scenario, 2, how);
  QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
  ResultTable results(*e);
  const auto played = playRuns(*e, numbers(1, 2), 1, {}, [&](const PlayedRun& run) -> Result<void> {
    results.add(*e, run.result);
    return {};
  });
  QVERIFY(played.has_value());
  QCOMPARE(tableOf(*e, results).teams[0].totals.played(), std::size_t{2});
  tournament.teams[0].robots[0].shirt = 5;
  e = tournamentExperiment(tournament, scenario, 2, how);
  QVERIFY(!e && e.error().text().find("team old") != std::string::npos);
}

/// What scripts/team_0_8.sh puts beside its program.
void TestTournament::againstVersion08() {
  const std::string folder = PITCHBOARD_SOURCE_DIR "/tests/data/teams/";
  const auto e = loadExperiment(folder + "against-0.8.json");
  QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
  QCOMPARE(e->allRuns(), std::size_t{100});
  QVERIFY(!e->hasTeamPrograms());  // they take turns
  QCOMPARE(e->conditions[0].scenario.runtimes.at(TeamColor::Red).profile, folder + "team-0.8.json");
  const auto programs = loadRuntime({folder + "team-0.8-programs.json", {}, {}});
  QVERIFY2(programs.has_value(), programs ? "" : programs.error().text().c_str());
  QVERIFY(programs->hasOwn());
}

/// The proof of the advisor: a keeper that has learned, and one without.
void TestTournament::theAdvisorsProof() {
  const auto e =
      loadExperiment(PITCHBOARD_SOURCE_DIR "/tests/data/teams/advisor-learns-striker.json");
  QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
  QCOMPARE(e->allRuns(), std::size_t{800});
  std::size_t advised = 0;
  for (const Condition& condition : e->conditions) advised += condition.scenario.advisors.size();
  QCOMPARE(advised, std::size_t{2});  // in both colours
}

/// As the file or the command line says, whichever colour they play in; the folder keeps it.
void TestTournament::teamsHaveAdvisors() {
  const auto advisedIn = [](const Experiment& e, std::size_t condition) {
    std::vector<TeamColor> out;
    for (const auto& [colour, options] : e.conditions[condition].scenario.advisors) {
      out.push_back(colour);
    }
    return out;
  };
  using Colours = std::vector<TeamColor>;
  const auto usual = experimentFromJson(shortTournament, "two").value();
  QVERIFY(advisedIn(usual, 0).empty() && advisedIn(usual, 1).empty());
  ExperimentChanges changes;
  changes.advised = {"stands"};
  const auto given = experimentFromJson(shortTournament, "two", {}, changes).value();
  QCOMPARE(advisedIn(given, 0), Colours{TeamColor::Red});
  QCOMPARE(advisedIn(given, 1), Colours{TeamColor::Blue});
  const auto kept = experimentFromJson(given.text, "kept").value();
  QCOMPARE(advisedIn(kept, 0), Colours{TeamColor::Red});
  std::string file = shortTournament;
  file.insert(file.find("\"number\": 12"), "\"advisor\": {\"memory\": \"seen.json\"}, ");
  const auto read = experimentFromJson(file, "two").value();
  QCOMPARE(advisedIn(read, 0), Colours{TeamColor::Blue});
  QCOMPARE(read.conditions[1].scenario.advisors.at(TeamColor::Red).memory,
           std::string("seen.json"));
  changes.advised = {"sits"};
  const auto wrong = experimentFromJson(shortTournament, "two", {}, changes);
  QVERIFY(!wrong && wrong.error().text().find("sits") != std::string::npos);
}

void TestTournament::wrongFilesAreExplained_data() {
  QTest::addColumn<QString>("what");
  QTest::addColumn<QString>("by");
  QTest::addColumn<QString>("words");
  const auto row = [](const char* name, const char* what, const char* by, const char* words) {
    QTest::newRow(name) << QString(what) << QString(by) << QString(words);
  };
  row("odd", "\"matches\": 4", "\"matches\": 5", "test.json:2: matches: is 5, but with swapped");
  row("same name", "\"stands\",", "\"walks\",", "another team has this name");
  row("same number", "\"number\": 8", "\"number\": 12", "is also the number of walks");
  row("one team", ",\n    {\"name\": \"stands\", \"number\": 8}", "", "two teams or more");
  row("shirt", "\"*\"", "\"7\"", "has no robot 7");
  row("who", "\"*\"", "\"B1\"", "must be the number on a shirt");
  row("key", "{\"behaviour\": \"naive\"}", "{\"x\": 3}", "behaviour, a model and a runtime");
  row("behaviour", "\"naive\"", "\"naiv\"", "did you mean \"naive\"");
  row("opponent", "\"team\": \"stands\"", "\"team\": \"stand\"", "did you mean \"stands\"");
  row("check", "low95(goal_difference)", "low95(goal_diff)", "goal_difference");
  row("pairs", "\"matches\": 4", "\"matches\": 4, \"pairs\": [[\"walks\"]]", "two teams");
  row("runs", "\"matches\": 4", "\"matches\": 4, \"runs\": 3", "runs");
  row("runtime", "\"number\": 8", "\"number\": 8, \"runtime\": \"referense\"", "reference");
  row("no matches", "\"matches\": 4,", "", "matches");
}
void TestTournament::wrongFilesAreExplained() {
  QFETCH(QString, what);
  QFETCH(QString, by);
  QFETCH(QString, words);
  const auto e = experimentFromJson(replaced(shortTournament, what.toStdString(), by.toStdString()),
                                    "test.json");
  QVERIFY(!e);
  const QString reported = QString::fromStdString(e.error().text());
  QVERIFY2(reported.contains(words) && reported.contains("test.json"), qPrintable(reported));
}

PITCHBOARD_TEST(TestTournament)

}  // namespace tst_tournament

#include "tst_tournament.moc"

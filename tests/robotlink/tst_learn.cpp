// SPDX-License-Identifier: GPL-3.0-or-later

// What `pitchboard-cli learn` does with a file: which numbers, matches and seeds it tries, what it
// chooses, that it continues where it was interrupted and shares its work, and what it refuses.

#include <QTemporaryDir>
#include <QtTest>
#include <atomic>
#include <filesystem>
#include <map>
#include <set>
#include <thread>

#include <base/file_target.h>
#include <base/read_file.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/learn/learn.h>

#include "experiment_rig.h"

namespace tst_learn {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace experiment_rig;

namespace {

/// A naive robot kicks a ball that it sees closer than `distance_to_kick`: the larger, the farther
/// away the ball stays.
const std::string kicksEarly = R"({
  "version": 1, "name": "kicks-early", "stop": {"duration": 8}, "swap_sides": false,
  "scenario": {
    "version": 1, "noise": "none", "ball": {"x": 0.3, "y": 0},
    "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": "naive"},
               {"team": "red", "number": 1, "x": 3, "y": 2, "behaviour": "none"}],
    "writes": [{"variable": "COM_REFEREE", "value": 2}]
  },
  "metrics": [{"name": "nearest", "unit": "cm", "expression": "B1.TRUE_BALL_DIST", "reduce": "min"}],
  "objective": "nearest",
  "parameters": ["distance_to_kick"],
  "ranges": {"distance_to_kick": {"from": 20, "to": 29}},
  "opponents": [{"name": "stands"}],
  "matches": 1, "search": {"population": 6, "generations": 3, "sigma": 0.3},
  "choose": {"last": 2, "best": 1, "matches": 2}, "validate": {"matches": 2}
})";

/// Two robots a side, whose matches differ with the seed.
const std::string noisy = R"({
  "version": 1, "name": "noisy", "stop": {"duration": 1.5},
  "scenario": {
    "version": 1, "noise": "realistic", "ball": {"x": 0.3, "y": 0},
    "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0},
               {"team": "blue", "number": 2, "x": -2, "y": 1, "behaviour": "keeper"},
               {"team": "red", "number": 1, "x": 0.6, "y": 0},
               {"team": "red", "number": 2, "x": 2, "y": 1, "behaviour": "keeper"}],
    "writes": [{"variable": "COM_REFEREE", "value": 2}]
  },
  "objective": "walked_m - 0.1 * kicks",
  "parameters": ["kick_distance", "slow_within", "keeper_line"],
  "opponents": [{"name": "usual"}, {"name": "far", "robots": {"*": {"behaviour.kick_distance": 0.1}}}],
  "matches": 2, "search": {"population": 5, "generations": 2},
  "choose": {"last": 2, "best": 1, "matches": 4},
  "validate": {"opponents": ["usual", {"name": "idle", "robots": {"*": {"behaviour": "idle"}}}],
               "matches": 2, "assertions": ["n(goals) == 4"]}
})";

Learning learningFrom(const std::string& text) {
  auto made = learningFromJson(text, "test.json");
  if (!made) qFatal("%s", made.error().text().c_str());
  return std::move(*made);
}

/// Of the files at the top of a folder.
std::map<std::string, std::string> filesIn(const std::string& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (entry.is_regular_file() && !name.starts_with("journal")) {
      out[name] = readFile(entry.path(), 1 << 24).value();
    }
  }
  return out;
}

std::vector<Candidate> twoCandidates(const Learning& learning) {
  std::vector<Candidate> out;
  for (const double share : {0.25, 0.75}) {
    Candidate& one = out.emplace_back();
    one.name = "candidate-00" + std::to_string(out.size());
    for (const LearnedParameter& parameter : learning.parameters) {
      one.values.push_back(parameter.at(share));
    }
  }
  return out;
}

}  // namespace

class TestLearn : public QObject {
  Q_OBJECT
  QTemporaryDir m_dir;
  std::string in(const std::string& name) const {
    return m_dir.filePath(QString::fromStdString(name)).toStdString();
  }
  LearnSettings into(const std::string& name, bool resume = false) const {
    LearnSettings settings{in(name)};
    settings.jobs = 2;
    settings.resume = resume;
    settings.program = "test";
    return settings;
  }
  LearnedTeam learned(const std::string& text, const LearnSettings& settings) {
    auto team = learn(learningFrom(text), settings);
    if (!team) qFatal("%s", team.error().text().c_str());
    return std::move(*team);
  }

 private slots:
  void betterNumbersAreFound() {
    const LearnedTeam team = learned(kicksEarly, into("kicks"));
    QCOMPARE(team.generations.size(), std::size_t{3});
    QVERIFY2(team.values[0] > 27.5, qPrintable(QString::number(team.values[0])));
    QVERIFY(team.objective > team.objectiveOfStart + 2.0);
    QVERIFY(team.from != "the start");
    // Values belong to the candidates that have them.
    for (const Generation& one : team.generations) {
      for (std::size_t i = 0; i < one.points.size(); ++i) {
        for (std::size_t j = 0; j < one.points.size(); ++j) {
          if (one.points[i][0] > one.points[j][0] + 0.3) QVERIFY(one.values[i] > one.values[j]);
        }
      }
    }
    const auto best = loadBehaviourParameters(in("kicks/best.json"));
    QVERIFY2(best.has_value(), best ? "" : best.error().text().c_str());
    QCOMPARE(best->distanceToKick, team.values[0]);
    QCOMPARE(best->kickDistance, BehaviourParameters{}.kickDistance);
    const auto files = filesIn(in("kicks"));
    for (const char* name : {"learn.json", "curve.csv", "report.html", "junit.xml"}) {
      QVERIFY2(files.contains(name), name);
    }
    QCOMPARE(std::ranges::count(files.at("curve.csv"), '\n'), 4);
    QVERIFY(files.at("report.html").find("distance_to_kick") != std::string::npos);
  }

  /// The files of another run, interrupted anywhere, or shared, are the same.
  void theFolderDoesNotShowHowItWasFilled() {
    const LearnedTeam whole = learned(noisy, into("whole"));
    QCOMPARE(whole.summary.tournament->pairings.size(), std::size_t{2});
    QVERIFY(whole.summary.holds());
    const auto expected = filesIn(in("whole"));
    const Learning learning = learningFrom(noisy);

    // Again and again interrupted, after a few matches each time.
    std::size_t interruptions = 0;
    for (;; ++interruptions) {
      std::atomic<bool> cancelled = false;
      std::atomic<int> matches = 0;
      LearnSettings settings = into("pieces", interruptions > 0);
      settings.play.cancelled = &cancelled;
      settings.progress = [&](const std::string&) {
        if (++matches >= 11) cancelled = true;
      };
      const auto team = learn(learning, settings);
      if (team) break;
      QCOMPARE(team.error().code, ErrorCode::Conflict);
      QVERIFY2(team.error().message.starts_with("interrupted in "), team.error().message.c_str());
      QVERIFY(interruptions < 40);
    }
    QVERIFY2(interruptions > 3, qPrintable(QString::number(interruptions)));
    QVERIFY(filesIn(in("pieces")) == expected);

    // Two programs, one folder.
    std::vector<std::thread> programs;
    std::array<bool, 2> done{};
    for (std::size_t i = 0; i < 2; ++i) {
      programs.emplace_back([&, i] {
        LearnSettings settings = into("shared");
        settings.shard = i + 1;
        settings.shards = 2;
        settings.jobs = 1;
        done[i] = learn(learning, settings).has_value();
      });
    }
    for (std::thread& program : programs) program.join();
    QVERIFY(done[0] && done[1]);
    QVERIFY(filesIn(in("shared")) == expected);
    // Each of them has played its part only.
    QVERIFY(std::filesystem::exists(in("shared/generation-001/1-of-2/runs.jsonl")));
    QVERIFY(std::filesystem::exists(in("shared/generation-001/2-of-2/runs.jsonl")));

    // Without a journal the matches that were played are still there.
    std::filesystem::remove(in("whole/journal.jsonl"));
    bool played = false;
    LearnSettings settings = into("whole");
    settings.progress = [&](const std::string&) { played = true; };
    QVERIFY(learn(learning, settings).has_value());
    QVERIFY(!played);
    QVERIFY(filesIn(in("whole")) == expected);
  }

  void theValidationIsPlayedOnce() {
    (void)learned(kicksEarly, into("once"));
    const auto before = readFile(in("once/validation/1-of-1/runs.jsonl"), 1 << 20).value();
    bool played = false;
    LearnSettings settings = into("once", true);
    settings.progress = [&](const std::string&) { played = true; };
    QVERIFY(learn(learningFrom(kicksEarly), settings).has_value());
    QVERIFY(!played);
    QVERIFY(readFile(in("once/validation/1-of-1/runs.jsonl"), 1 << 20).value() == before);
  }

  void allCandidatesPlayTheSameMatches() {
    const Learning learning = learningFrom(noisy);
    const auto candidates = twoCandidates(learning);
    const auto e = trainingOf(learning, "generation-001", candidates, 4, firstTrainingSeed);
    QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
    // Two candidates against two opponents on two sides, two seeds.
    QCOMPARE(e->conditions.size(), std::size_t{8});
    QCOMPARE(e->runs, std::size_t{2});
    for (std::size_t c = 0; c < 8; ++c) {
      const Condition& condition = e->conditions[c];
      QCOMPARE(condition.team, c % 2 == 0 ? TeamColor::Blue : TeamColor::Red);
      QCOMPARE(seedOf(*e, placeOf(*e, 2 * c + 1)), firstTrainingSeed);
      const Candidate& ours = candidates[c / 4];
      for (const ScenarioRobot& robot : condition.scenario.robots) {
        const bool learns = robot.identity.team == condition.team;
        const bool far = c % 4 >= 2 && !learns;
        QCOMPARE(robot.parameters.kickDistance, learns ? ours.values[0] : far ? 0.1 : 0.025);
        const bool keeps = robot.behaviour == "keeper" && learns;
        QCOMPARE(robot.parameters.keeperLine, keeps ? ours.values[2] : 0.2);
      }
    }
  }

  void seedsAreNeverShared() {
    const Learning learning = learningFrom(noisy);
    const auto validation = validationOf(learning, {"noisy", twoCandidates(learning)[0].values});
    QVERIFY(validation.has_value());
    QCOMPARE(seedOf(*validation, placeOf(*validation, 1)), firstValidationSeed);
    std::map<std::string, std::set<std::uint64_t>> seeds;
    if (!std::filesystem::exists(in("whole"))) (void)learned(noisy, into("whole"));
    for (const auto& entry : std::filesystem::directory_iterator(in("whole"))) {
      if (!entry.is_directory()) continue;
      const std::string folder = entry.path() / "1-of-1";
      const auto e = experimentOf(folder);
      QVERIFY(e.has_value());
      auto& mine = seeds[entry.path().filename()];
      for (std::size_t number = 1; number <= e->allRuns(); ++number) {
        mine.insert(resultOf(folder, *e, number)->seed);
      }
    }
    QVERIFY(seeds.size() >= 5);  // generations, rounds of the choice, validation
    std::set<std::uint64_t> all;
    std::size_t sum = 0;
    for (const auto& [name, some] : seeds) {
      all.insert(some.begin(), some.end());
      sum += some.size();
    }
    QCOMPARE(all.size(), sum);
  }

  void theExampleCanBePlayed() {
    const auto example = loadLearning(PITCHBOARD_SOURCE_DIR "/docs/examples/learn-match-team.json");
    QVERIFY2(example.has_value(), example ? "" : example.error().text().c_str());
    QCOMPARE(learningFrom(example->text).text, example->text);
    const auto e = trainingOf(*example, "one", twoCandidates(*example), 2, 1);
    QVERIFY(e.has_value());
    QVERIFY(e->tournament->wholeMatches);
  }

  void rangesAreAThirdToThreeTimes() {
    const Learning learning = learningFrom(noisy);
    const LearnedParameter& distance = learning.parameters[0];
    QCOMPARE(distance.key, std::string("kick_distance"));
    QCOMPARE(distance.from, 0.00833333);
    QCOMPARE(distance.to, 0.075);
    QCOMPARE(distance.at(distance.shareOf(0.025)), 0.025);
    QVERIFY(std::abs(distance.shareOf(0.025) - 0.5) < 1e-6);
    const LearnedParameter linear{"x", "", 0.0, 2.0, 1.0};
    QCOMPARE(linear.at(0.25), 0.5);
    QCOMPARE(linear.shareOf(0.5), 0.25);
    // All numbers that a robot of the team reads.
    const Learning all = learningFrom(
        replaced(noisy, R"("parameters": ["kick_distance", "slow_within", "keeper_line"],)", ""));
    QCOMPARE(all.parameters.size(), std::size(behaviourParameters) -
                                        3);  // not the naive one's, and not those that start at 0
  }

  void otherFoldersAreRefused() {
    (void)learned(kicksEarly, into("mine"));
    const auto again = learn(learningFrom(kicksEarly), into("mine"));
    QVERIFY(!again && again.error().text().find("--resume") != std::string::npos);
    const auto other = learn(learningFrom(replaced(kicksEarly, "\"sigma\": 0.3", "\"sigma\": 0.4")),
                             into("mine", true));
    QVERIFY(!other && other.error().text().find("learn.json differs") != std::string::npos);
    // A journal whose points nobody would draw.
    const std::string path = in("mine/journal.jsonl");
    const std::string text = readFile(path, 1 << 20).value();
    const std::size_t first = text.find("[[0.") + 4;
    QVERIFY(writeFile(path, std::string(text).replace(first, 1, text[first] == '9' ? "1" : "9"),
                      IfExists::Replace));
    const auto foreign = learn(learningFrom(kicksEarly), into("mine", true));
    QVERIFY(!foreign);
    QVERIFY2(foreign.error().text().find("other points") != std::string::npos,
             foreign.error().text().c_str());
    QVERIFY(writeFile(path, text + "{\"generation\": 4", IfExists::Replace));
    const auto broken = learn(learningFrom(kicksEarly), into("mine", true));
    QVERIFY(!broken && broken.error().text().find("generation 4") != std::string::npos);
  }

  void wrongFilesAreExplained_data() {
    QTest::addColumn<QString>("what");
    QTest::addColumn<QString>("by");
    QTest::addColumn<QString>("words");
    const auto row = [](const char* name, const char* what, const char* by, const char* words) {
      QTest::newRow(name) << QString(what) << QString(by) << QString(words);
    };
    row("key", "\"objective\"", "\"objektive\"", "did you mean \"objective\"");
    row("metric", "walked_m -", "walked -", "walked");
    row("parameter", "\"slow_within\"", "\"slow_withim\"", "did you mean \"slow_within\"");
    row("nobody reads it", "\"slow_within\"", "\"distance_to_kick\"", "no robot of the team reads");
    row("twice", "\"slow_within\"", "\"kick_distance\"", "is given twice");
    row("opponents", "{\"name\": \"far\", \"robots\"", "{\"name\": \"far\", \"robot\"",
        "opponents[1].robot: unknown key");
    row("held out", "[\"usual\", {", "[\"usuel\", {", "there is no opponent \"usuel\"");
    row("odd", "\"matches\": 4}", "\"matches\": 3}", "must be even");
    row("population", "\"population\": 5", "\"population\": 4", "search.population");
    row("seeds", "\"matches\": 2, \"search\": {\"population\": 5, \"generations\": 2",
        "\"matches\": 400, \"search\": {\"population\": 5, \"generations\": 9000",
        "not enough seeds");
    row("range", "\"matches\": 2, \"search\"",
        "\"ranges\": {\"slow_within\": {\"from\": 0.3}}, \"matches\": 2, \"search\"",
        "slow_within begins at 0.12");
    row("start", "\"matches\": 2, \"search\"",
        "\"start\": \"none.json\", \"matches\": 2, \"search\"", "none.json");
    row("team", "\"matches\": 2, \"search\"",
        "\"team\": {\"robots\": {\"9\": {\"behaviour\": \"idle\"}}}, \"matches\": 2, \"search\"",
        "has no robot 9");
    row("assertion", "n(goals)", "n(goal)", "assertions");
  }
  void wrongFilesAreExplained() {
    QFETCH(QString, what);
    QFETCH(QString, by);
    QFETCH(QString, words);
    const auto made =
        learningFromJson(replaced(noisy, what.toStdString(), by.toStdString()), "test.json");
    QVERIFY(!made);
    const QString reported = QString::fromStdString(made.error().text());
    QVERIFY2(reported.contains(words) && reported.contains("test.json"), qPrintable(reported));
  }
};

PITCHBOARD_TEST(TestLearn)

}  // namespace tst_learn

#include "tst_learn.moc"

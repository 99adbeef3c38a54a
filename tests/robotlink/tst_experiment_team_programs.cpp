// SPDX-License-Identifier: GPL-3.0-or-later

// Separate processes in experiments. A team's own: an unchanged Python process in each run, several
// runs at a time that do not hear each other, how fast they were played in all reports, sessions of
// runs that cannot be played again, and what is said of a program that does not run. The reference
// ones: files that do not depend on how they were played, and how fast that was beside them.

#include <unistd.h>

#include <QtTest>
#include <algorithm>
#include <filesystem>
#include <map>

#include <base/read_file.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/experiment/run_player.h>

namespace tst_experiment_team_programs {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

/// A robot half a metre behind the ball, told to play or to stand; the sleeps of its program are as
/// on the field.
constexpr const char* text = R"({
  "version": 1, "name": "own", "processes": "separate", "speed": 8,
  "scenario": {"version": 1, "noise": "none", "ball": {"x": 0, "y": 0},
    "robots": [{"team": "blue", "number": 1, "x": -0.6, "y": 0, "runtime": "PROFILE"}],
    "writes": [{"variable": "COM_REFEREE", "value": 2}]},
  "conditions": [{"name": "plays", "set": {}}, {"name": "stands", "set": {"writes[0].value": 1}}],
  "runs": 2, "stop": {"duration": 25}, "record": "failed", "success": "kicks > 0",
  "assertions": [{"check": "min(kicks) >= 1", "condition": "plays"},
                 {"check": "max(walked_m) < 0.01", "condition": "stands"}]
})";

class Rig {
 public:
  explicit Rig(const QString& program) {
    QFile profile(m_folder.filePath(QStringLiteral("python.json")));
    if (!profile.open(QIODevice::WriteOnly)) qFatal("no profile");
    profile.write(QStringLiteral(R"({"version": 1, "name": "python", "processes": [{
      "name": "decision", "command": ["python3", "%1", "${key}"], "directory": "%2",
      "heartbeat": "DECISION_WORKING"}]})")
                      .arg(program, QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/end_to_end"))
                      .toUtf8());
    std::string filled = text;
    filled.replace(filled.find("PROFILE"), 7, profile.fileName().toStdString());
    m_text = filled;
  }
  Result<Experiment> experiment() const { return experimentFromJson(m_text, "test.json"); }
  const std::string& json() const { return m_text; }
  std::string path(const char* name) const { return m_folder.filePath(name).toStdString(); }

 private:
  QTemporaryDir m_folder;
  std::string m_text;
};

PlaySettings settingsFor(const std::string& folder) {
  PlaySettings settings;
  settings.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
  settings.folder = folder;
  settings.program = "test";
  return settings;
}

}  // namespace

class TestExperimentTeamPrograms : public QObject {
  Q_OBJECT

 private slots:
  void eachRunHasItsProgramAndItsPaceIsReported();
  void aProgramThatDoesNotRunIsNamed();
  void aProgramThatDiesWhileItPlaysIsNamed();
  void theyPlayBesideInlineRobots();
  void referenceProcessesGiveTheSameFilesHoweverTheyWerePlayed();
  void blackboardsThatWereThereAreNotUsed();
};

void TestExperimentTeamPrograms::eachRunHasItsProgramAndItsPaceIsReported() {
  const Rig rig(QStringLiteral("naive_robot.py"));
  const auto e = rig.experiment();
  QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
  QVERIFY(e->conditions[0].teamPrograms && e->hasTeamPrograms());
  const std::string out = rig.path("out");
  auto folder = ExperimentFolder::begin(out, *e, false);
  QVERIFY2(folder.has_value(), folder ? "" : folder.error().text().c_str());
  // One that plays and one that stands, at the same time.
  std::map<std::size_t, RunResult> results;
  const auto played = playRuns(*e, std::vector<std::size_t>{1, 3, 2, 4}, 2, settingsFor(out),
                               [&](const PlayedRun& run) {
                                 results[run.result.number] = run.result;
                                 return folder->add(run.result, run.timesRealTime);
                               });
  QVERIFY2(played.has_value(), played ? "" : played.error().text().c_str());
  QVERIFY(folder->finish().has_value());
  const auto table = resultsOf(out, *e);
  QVERIFY(table.has_value());
  const ExperimentSummary summary = summarize(*e, *table);
  for (const CheckedAssertion& one : summary.assertions) {
    QVERIFY2(one.holds, (one.condition + ": " + one.text + ", " + one.values).c_str());
  }
  // Other programs on this computer have segments of their own.
  for (int number = 0; number <= MatchNumber::most; ++number) {
    for (const SegmentInfo& left : SystemVSegments::list(MatchNumber{number}.keyBase())) {
      QVERIFY2(left.creator != ::getpid(), std::to_string(left.key).c_str());
    }
  }

  // Speed and slowdown are figures of each run, and stand in every report.
  const auto metrics = metricsOf(*e);
  QCOMPARE(metrics[metrics.size() - 2].name, std::string("times_real_time"));
  QCOMPARE(metrics.back().name, std::string("own_programs_kept"));
  for (const auto& [number, result] : results) {
    QVERIFY(result.values[metrics.size() - 2] > 0.0);
    QVERIFY(result.values[metrics.size() - 2] < 9.0);  // it is asked not to be faster than 8
    QVERIFY(result.values.back() > 0.0 && result.values.back() <= 1.0);
  }
  const auto hasText = [&out](const char* file, const char* words) {
    return readFile(out + '/' + file, 1 << 24).value().find(words) != std::string::npos;
  };
  for (const char* file : {"runs.csv", "summary.json"}) {
    QVERIFY(hasText(file, "times_real_time") && hasText(file, "own_programs_kept"));
  }
  for (const char* file : {"report.md", "report.html"}) {
    QVERIFY2(hasText(file, "Speed (times real time)"), file);
    QVERIFY2(hasText(file, "at most 8 times as fast as real time"), file);
  }
  // Only the runs without a kick were wanted, and they were recorded while they were played.
  for (const std::size_t number : {1U, 2U, 3U, 4U}) {
    QCOMPARE(std::filesystem::exists(sessionPath(out, number)), number > 2);
  }
}

void TestExperimentTeamPrograms::aProgramThatDoesNotRunIsNamed() {
  const Rig rig(QStringLiteral("no_such_program.py"));
  const auto e = rig.experiment();
  QVERIFY(e.has_value());
  auto player = RunPlayer::create(*e, settingsFor({}));
  const auto result = player->play(1);
  QVERIFY(!result);
  const QString reported = QString::fromStdString(result.error().text());
  QVERIFY2(reported.startsWith(QStringLiteral("B1 decision does not run")), qPrintable(reported));
  QVERIFY2(reported.contains(QStringLiteral("no_such_program.py")), qPrintable(reported));
}

/// It plays and dies then; a run of a robot that stands still measures nothing.
void TestExperimentTeamPrograms::aProgramThatDiesWhileItPlaysIsNamed() {
  const Rig rig(QStringLiteral("naive_robot.py"));
  std::string dies = rig.json();
  const auto at = dies.find("/python.json");
  const auto begin = dies.rfind('"', at) + 1;
  const std::string profile = dies.substr(begin, dies.find('"', at) - begin);
  std::string command = readFile(profile, 1 << 16).value();
  command.replace(command.find(R"("python3")"), 9, R"("timeout", "4", "python3")");
  command.replace(command.find(R"("heartbeat")"), 0, R"("restart": "never", )");
  const std::string other = rig.path("dies.json");
  {
    QFile file(QString::fromStdString(other));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(command.c_str()) > 0);
  }
  dies.replace(begin, profile.size(), other);
  const auto e = experimentFromJson(dies, "test.json");
  QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
  auto player = RunPlayer::create(*e, settingsFor({}));
  const auto result = player->play(1);
  QVERIFY(!result);
  const QString reported = QString::fromStdString(result.error().text());
  QVERIFY2(reported.startsWith(QStringLiteral("B1 decision died")), qPrintable(reported));
}

/// Conditions differ in who plays: one of ours inside, the team's program beside an inline robot.
void TestExperimentTeamPrograms::theyPlayBesideInlineRobots() {
  const Rig rig(QStringLiteral("naive_robot.py"));
  std::string inside = rig.json();
  const auto change = [&inside](const std::string& what, const std::string& by) {
    inside.replace(inside.find(what), what.size(), by);
  };
  change("\"processes\": \"separate\",", "");
  change("\"}],\n",
         R"("}, {"team": "red", "number": 1, "x": 0.8, "y": 0, "behaviour": "naive"}],
)");
  change(
      R"([{"name": "plays", "set": {}}, {"name": "stands", "set": {"writes[0].value": 1}}])",
      R"([{"name": "plays", "set": {}}, {"name": "ours", "set": {"robots[B1].runtime": "reference"}}])");
  inside.erase(inside.find("\"assertions\""));
  inside.erase(inside.rfind(','));
  inside += '}';
  const auto e = experimentFromJson(inside, "test.json");
  QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
  QVERIFY(e->conditions[0].teamPrograms);
  QVERIFY(!e->conditions[1].teamPrograms);
  auto player = RunPlayer::create(*e, settingsFor({}));
  const auto both = player->play(1), ours = player->play(3);
  QVERIFY2(both.has_value(), both ? "" : both.error().text().c_str());
  QVERIFY2(ours.has_value(), ours ? "" : ours.error().text().c_str());
  const auto metrics = metricsOf(*e);
  const auto value = [&](const RunResult& result, const char* name) {
    const auto found = std::ranges::find(metrics, name, &MetricInfo::name);
    return result.values[static_cast<std::size_t>(found - metrics.begin())];
  };
  QVERIFY(value(*both, "walked_m_B1") > 0.05);  // the program
  QVERIFY(value(*both, "walked_m_R1") > 0.05);  // inside
  QVERIFY(!both->match.repeatable && ours->match.repeatable);
  QVERIFY(value(*both, "times_real_time") > 0.0);
  QVERIFY(std::isnan(value(*ours, "times_real_time")));
}

void TestExperimentTeamPrograms::referenceProcessesGiveTheSameFilesHoweverTheyWerePlayed() {
  const auto e = experimentFromJson(R"({"version": 1, "name": "separate", "processes": "separate",
    "scenario": {"version": 1, "noise": "paper", "ball": {"x": 0.4, "y": 0},
      "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": "naive"}],
      "writes": [{"variable": "COM_REFEREE", "value": 2}]},
    "grid": {"robots[B1].behaviour.distance_to_kick": [25, 40]},
    "runs": 2, "stop": {"duration": 2}})",
                                    "test.json");
  QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
  QTemporaryDir dir;
  const auto pathOf = [&dir](const char* name) { return dir.filePath(name).toStdString(); };
  const auto play = [&](const std::string& path, std::vector<std::size_t> numbers, std::size_t jobs,
                        bool resume) -> Result<void> {
    auto folder = ExperimentFolder::begin(path, *e, resume);
    if (!folder) return tl::unexpected(folder.error());
    auto played = playRuns(*e, numbers, jobs, settingsFor(path), [&](const PlayedRun& run) {
      return folder->add(run.result, run.timesRealTime);
    });
    if (!played) return played;
    return folder->finish();
  };
  const auto whole = play(pathOf("whole"), {1, 2, 3, 4}, 2, false);
  QVERIFY2(whole.has_value(), whole ? "" : whole.error().text().c_str());
  QVERIFY(play(pathOf("resumed"), {3}, 1, false).has_value());
  QVERIFY(play(pathOf("resumed"), {4, 2, 1}, 1, true).has_value());
  QVERIFY(play(pathOf("part1"), {1, 3}, 1, false).has_value());
  QVERIFY(play(pathOf("part2"), {4, 2}, 1, false).has_value());
  QVERIFY(mergeFolders({pathOf("part2"), pathOf("part1")}, pathOf("merged"), *e).has_value());

  const auto bytes = [](const std::filesystem::path& file) {
    return readFile(file.string(), 1 << 24).value();
  };
  std::size_t same = 0;
  for (const auto& file : std::filesystem::directory_iterator(pathOf("whole"))) {
    const std::string name = file.path().filename().string();
    if (name == timesFile) continue;
    for (const char* other : {"resumed", "merged"}) {
      QVERIFY2(bytes(pathOf(other) + '/' + name) == bytes(file.path()), name.c_str());
    }
    ++same;
  }
  QCOMPARE(same, std::size_t{7});
  // How fast each run was played, beside them.
  for (const char* one : {"whole", "resumed", "merged"}) {
    const QStringList rows =
        QString::fromStdString(bytes(pathOf(one) + '/' + timesFile)).trimmed().split('\n');
    QCOMPARE(rows.size(), 5);
    QCOMPARE(rows[0], QStringLiteral("run,times_real_time"));
    QSet<QString> runs;
    for (qsizetype i = 1; i < rows.size(); ++i) {
      runs << rows[i].section(',', 0, 0);
      QVERIFY2(rows[i].section(',', 1).toDouble() > 0.0, qPrintable(rows[i]));
    }
    QCOMPARE(runs, (QSet<QString>{"1", "2", "3", "4"}));
  }
}

/// Of programs that were killed, for example. A run does not depend on them, and leaves them alone.
void TestExperimentTeamPrograms::blackboardsThatWereThereAreNotUsed() {
  const auto e = experimentFromJson(R"({"version": 1, "name": "left", "processes": "separate",
    "scenario": {"version": 1,
      "robots": [{"team": "blue", "number": 1, "id": 64, "x": 0, "y": 0, "behaviour": "naive"}],
      "writes": [{"variable": "COM_REFEREE", "value": 2}]},
    "runs": 1, "stop": {"duration": 1}})",
                                    "test.json");
  QVERIFY2(e.has_value(), e ? "" : e.error().text().c_str());
  const int key = blackboardKey(RobotId{64});  // no other test has keys of this robot
  auto left = SystemVSegments::open(key, AttachMode::AttachOrCreate);
  QVERIFY2(left.has_value() && left->created(), left ? "" : left.error().text().c_str());
  auto player = RunPlayer::create(*e, settingsFor({}));
  const auto result = player->play(1);
  QVERIFY2(result.has_value(), result ? "" : result.error().text().c_str());
  for (int word = 0; word < Blackboard::words; ++word) {
    QCOMPARE(left->read(IntVar{word}), 0);
  }
}

PITCHBOARD_TEST(TestExperimentTeamPrograms)

}  // namespace tst_experiment_team_programs

#include "tst_experiment_team_programs.moc"

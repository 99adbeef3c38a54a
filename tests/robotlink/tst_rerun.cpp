// SPDX-License-Identifier: GPL-3.0-or-later
// A recording runs through our own processes again: the same bits without a change, and with one
// the differences where it matters, and nowhere else.
#include <QtTest>

#include <cmath>
#include <random>
#include <set>

#include <base/wildcard.h>
#include <robotlink/blackboard/variable_meanings.h>
#include <robotlink/cognition/naive_decision.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/match/due_ticks.h>
#include <robotlink/rerun/rerun_check.h>
#include <robotlink/rerun/rerun_text.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/row_slot.h>
#include <robotlink/session/session_events.h>

#include "rerun_rig.h"

namespace tst_rerun {

using namespace rerun_rig;
using Processes = std::vector<RerunProcess>;

namespace {

RerunProcess ours(const char* name) {
  return {name, "reference"};
}

Scenario naiveScenario(const char* noise) {
  Scenario scenario = scenarioWith("match-3v3", noise);
  for (ScenarioRobot& robot : scenario.robots) robot.behaviour = "naive";
  return scenario;
}

/// A row of a robot by the names of its columns.
class Rows {
 public:
  Rows(const telemetry::SessionReader& session, const char* robot) : m_session(session) {
    for (std::size_t i = 0; i < session.groups().size(); ++i) {
      if (session.groups()[i].info.name == robot) m_group = static_cast<telemetry::GroupId>(i);
    }
  }
  double value(const telemetry::RowView& row, const char* name) const {
    return findSlot(m_session.groups()[m_group].info, {name}).read(row);
  }
  void each(const std::function<void(const telemetry::RowView&)>& visit) const {
    const std::array only{m_group};
    m_session.rows({-1e18, 1e18}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
      visit(row);
      return true;
    });
  }

 private:
  const telemetry::SessionReader& m_session;
  telemetry::GroupId m_group = 0;
};

}  // namespace

class TestRerun : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { QVERIFY(m_folder.isValid()); }
  void unchangedCodeGivesTheSameBits_data();
  void unchangedCodeGivesTheSameBits();
  void aRefereedMatchWithTwoHalves();
  void aPartIsAlikeBecauseAllBeforeItIsPlayed();
  void aPlantedChangeIsFoundWhereItMattersAndNowhereElse_data();
  void aPlantedChangeIsFoundWhereItMattersAndNowhereElse();
  void aCoarseRecordingIsNotTheProgramsFault();
  void whatDiffersUnchangedIsLeftOut();
  void theNewSessionHasBothRobots();
  void processesReadWhatTheyDeclare_data();
  void processesReadWhatTheyDeclare();
  void theMapNamesWhoeverWrites();
  void assertionsOverTheOutputs();
  void mistakesAreNamed_data();
  void mistakesAreNamed();
  void aWholeProfileRuns();
  void teamNeedsTeamMates();
  void announcedCyclesRunExactly_data();
  void announcedCyclesRunExactly();
  void aRecordingWithoutInputsIsRefused();
  void cancelling();

 private:
  /// Recorded once; by the name of the scenario and the noise.
  const std::string& match3v3(const char* noise);
  QTemporaryDir m_folder;
  std::map<std::string, std::string> m_recorded;
};

const std::string& TestRerun::match3v3(const char* noise) {
  std::string& path = m_recorded[noise];
  if (path.empty()) {
    path =
        record(m_folder, QString("match-%1").arg(noise), {scenarioWith("match-3v3", noise), 40.0});
  }
  return path;
}

void TestRerun::unchangedCodeGivesTheSameBits_data() {
  QTest::addColumn<QString>("noise");
  QTest::addColumn<QStringList>("processes");
  for (const char* noise : {"none", "paper", "realistic"}) {
    for (const QStringList& processes :
         {QStringList{"decision"}, QStringList{"localization"}, QStringList{"planning"},
          QStringList{"team"}, QStringList{"localization", "decision", "planning"},
          QStringList{"localization", "team", "decision", "planning"}}) {
      QTest::newRow(qPrintable(QString(noise) + ' ' + processes.join('+')))
          << QString(noise) << processes;
    }
  }
}

void TestRerun::unchangedCodeGivesTheSameBits() {
  QFETCH(QString, noise);
  QFETCH(QStringList, processes);
  const auto session = opened(match3v3(qPrintable(noise)));
  // A striker, a keeper, and one of the team that begins at 180 degrees.
  for (const char* robot : {"B1", "B2", "R3"}) {
    Processes chosen;
    for (const QString& name : processes) chosen.push_back(ours(qPrintable(name)));
    const auto result = rerun(session, optionsFor(robot, chosen));
    QVERIFY2(result, result ? "" : result.error().text().c_str());
    QVERIFY2(result->unequal() == 0, qPrintable(QString(robot) + '\n' + shown(*result)));
    QCOMPARE(result->stretches(), std::uint64_t(0));
    QVERIFY2(result->compared() > 2000, qPrintable(shown(*result)));
    QVERIFY2(result->notes.empty(), qPrintable(shown(*result)));
    QVERIFY(result->inLockStep && !result->isTooCoarse());
    if (!processes.contains("decision")) continue;
    // Decision acts itself now and then; otherwise its action would not have been compared.
    QVERIFY(variable(*result, "DECISION_ACTION_A").compared > 0);
  }
}

/// Processes start again when the teams change sides; a referee's orders are inputs, too.
void TestRerun::aRefereedMatchWithTwoHalves() {
  Recorded how{scenarioWith("match", "realistic"), 120.0};
  sim::RefereeRules& rules = *how.scenario.settings.referee;
  rules.halfTime = 30.0;
  rules.breakTime = 5.0;
  rules.beforeHalf = 0.0;
  bool began = false, ended = false;  // whether B1 faces left
  const auto session = opened(record(m_folder, "halves", how, [&](MatchPlayer& player) {
    const bool facesLeft = player.match().simulation().state().robots[0].imuStartsAt180;
    (player.currentTick() == 0 ? began : ended) = facesLeft;
  }));
  QVERIFY2(began != ended, "the teams have not changed sides");
  for (const char* robot : {"B1", "B2", "R3"}) {
    const auto result = rerun(
        session, optionsFor(robot, {ours("localization"), ours("decision"), ours("planning")}));
    QVERIFY2(result, result ? "" : result.error().text().c_str());
    QVERIFY2(result->unequal() == 0, qPrintable(QString(robot) + '\n' + shown(*result)));
    QVERIFY2(result->notes.empty(), qPrintable(shown(*result)));
  }
}

void TestRerun::aPartIsAlikeBecauseAllBeforeItIsPlayed() {
  const auto session = opened(match3v3("realistic"));
  RerunOptions options = optionsFor("B1", {ours("localization")});
  options.from = 20.0;
  options.until = 30.0;
  const auto whole = rerun(session, options);
  QVERIFY2(whole && whole->unequal() == 0, whole ? qPrintable(shown(*whole)) : "");
  QCOMPARE(whole->begin, 20.0);
  QCOMPARE(whole->end, 30.0);
  QCOMPARE(variable(*whole, "LOCALIZATION_X").compared, std::uint64_t(601));
  // Its particles come from before: without them it differs, and says why.
  options.warmUp = 0.0;
  const auto cold = rerun(session, options);
  QVERIFY(cold && cold->unequal() > 0);
  QVERIFY(QString::fromStdString(cold->notes.at(0)).contains("remembers from before"));
  options.warmUp = 10.0;
  const auto warm = rerun(session, options);
  QVERIFY(warm);
  QCOMPARE(warm->begin, 20.0);
}

void TestRerun::aPlantedChangeIsFoundWhereItMattersAndNowhereElse_data() {
  QTest::addColumn<QString>("noise");
  for (const char* noise : {"none", "paper", "realistic"}) QTest::newRow(noise) << QString(noise);
}

/// The naive rule is known: what it does at the recorded percepts follows without a rerun.
void TestRerun::aPlantedChangeIsFoundWhereItMattersAndNowhereElse() {
  QFETCH(QString, noise);
  Recorded how{naiveScenario(qPrintable(noise)), 60.0};
  const auto session = opened(record(m_folder, "naive-" + noise, how));
  int crossings = 0;
  for (const char* robot : {"B1", "B2", "B3", "R1", "R2", "R3"}) {
    const auto same = rerun(session, optionsFor(robot, {ours("decision")}));
    QVERIFY2(same && same->unequal() == 0, same ? qPrintable(shown(*same)) : "");
    const auto changed = rerun(
        session, optionsFor(robot, {{"decision", R"({"name": "naive", "distance_to_kick": 35})"}}));
    QVERIFY2(changed, changed ? "" : changed.error().text().c_str());
    // The moments at which both rules act differently, from the recorded rows alone.
    std::set<double> expected;
    const Rows rows(session, robot);
    std::uint64_t due = nextDueTick(0.25, 0, 60.0);
    rows.each([&](const telemetry::RowView& row) {
      const auto tick = static_cast<std::uint64_t>(std::llround(row.time * 60.0));
      if (tick < due) return;
      due = nextDueTick(0.25, tick, 60.0);
      const auto rule = [&](double distance) {
        return naiveRule(static_cast<int>(rows.value(row, "VISION_LOST")),
                         static_cast<float>(rows.value(row, "VISION_PAN_DEG")),
                         static_cast<float>(rows.value(row, "VISION_BALL_DIST")), distance)
            .actionA;
      };
      if (rule(25.0) != rule(35.0)) expected.insert(std::round(row.time * 60.0));
    });
    const ComparedVariable& action = variable(*changed, "DECISION_ACTION_A");
    std::set<double> found;
    for (const DifferentStretch& one : action.stretches) {
      // A stretch begins at a cycle in which the rules differ.
      QVERIFY2(expected.count(std::round(one.begin * 60.0)) > 0,
               qPrintable(QString("%1 at %2").arg(robot).arg(one.begin)));
      const bool lasts = one.end >= changed->end - 1e-6;  // to the end of the recording
      const double end = std::round(one.end * 60.0) + (lasts ? 1.0 : 0.0);
      for (double tick = std::round(one.begin * 60.0); tick < end; ++tick) found.insert(tick);
    }
    for (const double tick : expected) {
      QVERIFY2(found.count(tick) > 0, qPrintable(QString("%1 at tick %2").arg(robot).arg(tick)));
    }
    QCOMPARE(action.differs(), !expected.empty());
    for (const ComparedVariable& one : changed->variables) {
      const bool follows = one.column.name.starts_with("DECISION_ACTION_");
      QVERIFY2(follows || one.unequal == 0, one.column.name.c_str());
    }
    crossings += static_cast<int>(expected.size());
    if (action.differs()) {
      const QString text = QString::fromStdString(rerunTable(*changed));
      QVERIFY2(
          text.contains(QRegularExpression("DECISION_ACTION_A .*kick (left|right) instead of")),
          qPrintable(text));
    }
  }
  QVERIFY2(crossings > 0, "no robot came near a ball");
}

void TestRerun::aCoarseRecordingIsNotTheProgramsFault() {
  Recorded how{scenarioWith("match-3v3", "paper"), 30.0, 12};
  const auto session = opened(record(m_folder, "coarse", how));
  const auto result = rerun(session, optionsFor("B1", {ours("decision")}));
  QVERIFY2(result, result ? "" : result.error().text().c_str());
  QVERIFY(result->isTooCoarse());
  const auto& inputs = result->sampledInputs;
  // Localization's pose was sampled; what vision saw is played again from the checkpoints.
  QVERIFY(std::ranges::find(inputs, "LOCALIZATION_X") != inputs.end());
  QVERIFY(std::ranges::find(inputs, "VISION_BALL_DIST") == inputs.end());
  QVERIFY(result->unequal() > 0);
  const QString text = QString::fromStdString(rerunTable(*result));
  QVERIFY2(result->stretches() == 0 || text.contains("no evidence about the program"),
           qPrintable(text));
  // Nothing between the rows is missing of what the naive rule reads, but the referee's order.
  how.scenario = naiveScenario("paper");
  const auto naive = opened(record(m_folder, "coarse-naive", how));
  const auto alike = rerun(naive, optionsFor("B1", {ours("decision")}));
  QVERIFY2(alike && alike->unequal() == 0, alike ? qPrintable(shown(*alike)) : "");
  QCOMPARE(alike->sampledInputs, std::vector<std::string>{"COM_REFEREE"});
}

void TestRerun::whatDiffersUnchangedIsLeftOut() {
  const auto session = opened(match3v3("realistic"));
  RerunOptions options = optionsFor("B1", {ours("localization")});
  options.from = 10.0;
  options.warmUp = 0.0;  // its particles are others
  options.exact = true;
  const auto same = rerun(session, options);
  QVERIFY(same && same->stretches() > 0);
  const auto kept = unchangedFromJson(rerunToJson(*same, "match.mcap"), "same.json");
  QVERIFY(kept);
  QCOMPARE(kept->robot, std::string("B1"));
  options.unchanged = kept->variables;
  const auto again = rerun(session, options);
  QVERIFY(again);
  QCOMPARE(again->stretches(), std::uint64_t(0));
  QVERIFY(again->unchangedToo() > 0);
  QVERIFY(QString::fromStdString(rerunTable(*again)).contains("Left out"));
  QVERIFY(!unchangedFromJson("[1, 2]", "same.json"));
  QVERIFY(!unchangedFromJson("{", "same.json"));
}

void TestRerun::theNewSessionHasBothRobots() {
  const auto session = opened(match3v3("none"));
  RerunOptions options = optionsFor("B1", {{"decision", "keeper"}});
  const std::string path = m_folder.filePath("both.mcap").toStdString();
  const auto result = rerunToFile(session, options, path);
  QVERIFY2(result, result ? "" : result.error().text().c_str());
  QVERIFY(result->stretches() > 0);
  const auto refused = rerunToFile(session, options, path);
  QVERIFY(!refused && refused.error().code == ErrorCode::Conflict);
  const auto both = opened(path);
  QVERIFY(both.complete() && both.notes().empty());
  QCOMPARE(both.groups().size(), session.groups().size() + 1);
  std::size_t rows = 0, others = 0;
  for (const telemetry::SessionGroup& group : both.groups()) {
    if (group.info.name == "B1 rerun") rows = group.rows;
    if (group.info.name == "B1") others = group.rows;
  }
  QCOMPARE(rows, others);
  QCOMPARE(both.count(telemetry::SessionStream::Checkpoints),
           session.count(telemetry::SessionStream::Checkpoints));
  // The first difference of each variable is an event at its moment.
  std::set<std::pair<std::string, double>> begun, events;
  for (const ComparedVariable& one : result->variables) {
    for (const DifferentStretch& stretch : one.stretches) {
      begun.emplace(one.column.name, std::round(stretch.begin * 60.0));
    }
  }
  for (const MatchEvent& event : eventsOf(both)) {
    if (event.kind != MatchEventKind::RerunDiffers) continue;
    QCOMPARE(event.name, std::string("B1 rerun"));
    events.emplace(event.detail.substr(0, event.detail.find(':')), std::round(event.time * 60.0));
  }
  QVERIFY(events == begun);
  // The frame shows both where the robot was, and each what it decided.
  RecordedFrames frames(backdropOf(both));
  const double time = begun.begin()->second / 60.0;
  const MatchFrame frame = frames.frameAt(both, time);
  QCOMPARE(frame.robots.size(), std::size_t(7));
  const Rows original(both, "B1"), again(both, "B1 rerun");
  double recorded = 0.0, rerun = 0.0;
  const char* name = begun.begin()->first.c_str();
  original.each([&](const auto& row) {
    if (std::abs(row.time - time) < 1e-6) recorded = original.value(row, name);
  });
  again.each([&](const auto& row) {
    if (std::abs(row.time - time) < 1e-6) rerun = again.value(row, name);
  });
  QVERIFY(recorded != rerun);
}

void TestRerun::processesReadWhatTheyDeclare_data() {
  QTest::addColumn<QString>("process");
  QTest::addColumn<QString>("behaviour");
  QTest::addColumn<QString>("robot");
  QTest::newRow("localization") << "localization"
                                << "striker"
                                << "B1";
  QTest::newRow("striker") << "decision"
                           << "striker"
                           << "B1";
  QTest::newRow("keeper") << "decision"
                          << "keeper"
                          << "B2";
  QTest::newRow("supporter") << "decision"
                             << "supporter"
                             << "B3";
  QTest::newRow("naive") << "decision"
                         << "naive"
                         << "B1";
  QTest::newRow("planning") << "planning"
                            << "striker"
                            << "B1";
  QTest::newRow("advisor") << "advisor"
                           << "keeper"
                           << "B2";
}

/// Other words may hold anything: the outputs stay the same.
void TestRerun::processesReadWhatTheyDeclare() {
  QFETCH(QString, process);
  QFETCH(QString, behaviour);
  QFETCH(QString, robot);
  const auto session = opened(match3v3("realistic"));
  const ProcessInfo* info = findProcess(process.toStdString());
  const std::string_view reads =
      process == "decision" ? findBehaviour(behaviour.toStdString())->reads : info->reads;
  const QStringList patterns = QString::fromUtf8(reads.data(), qsizetype(reads.size())).split(' ');
  const VariableCatalog& map = VariableCatalog::extended();
  const auto wordOf = [](const Variable& one) {
    return one.index + (one.type == VariableType::Float ? Blackboard::floatOffset : 0);
  };
  std::vector<int> outputs, others;
  for (const Variable& one : map.variables()) {
    const VariableWriters writers = VariableMeanings::published().writers(one.name);
    const std::string own = process.toStdString();
    const bool isRead = std::ranges::any_of(patterns, [&](const QString& pattern) {
      return fitsWildcard(pattern.toStdString(), one.name);
    });
    const bool writes = writers.writer == own || writers.alsoBy == own || writers.clearedBy == own;
    if (writes) outputs.push_back(wordOf(one));
    if (!isRead && !writes) others.push_back(wordOf(one));
  }
  QVERIFY(!outputs.empty() && !others.empty());
  ProcessOptions options;
  options.robot = RobotId{robot == "B1" ? 1 : robot == "B2" ? 2 : 3};
  options.behaviour = behaviour.toStdString();
  options.facesLeft = false;
  auto one = info->make(options).value(), two = info->make(options).value();
  Blackboard plain = Blackboard::onHeap(), scrambled = Blackboard::onHeap();
  const Rows rows(session, qPrintable(robot));
  std::uint32_t random = 1;
  int cycles = 0, changes = 0;
  rows.each([&](const telemetry::RowView& row) {
    if (++cycles % 6 != 0) return;
    for (const Variable& variable : map.variables()) {
      const double value = rows.value(row, variable.name.c_str());
      const bool isOutput = std::ranges::find(outputs, wordOf(variable)) != outputs.end();
      const bool isRead = std::ranges::any_of(patterns, [&](const QString& pattern) {
        return fitsWildcard(pattern.toStdString(), variable.name);
      });
      if (std::isnan(value) || (isOutput && !isRead)) continue;
      for (Blackboard* board : {&plain, &scrambled}) {
        if (variable.type == VariableType::Int) {
          board->write(IntVar{variable.index}, static_cast<int>(value));
        } else {
          board->write(FloatVar{variable.index}, static_cast<float>(value));
        }
      }
    }
    for (const int word : others) {
      random = random * 1664525U + 1013904223U;
      scrambled.write(IntVar{word}, static_cast<int>(random >> 3U));
    }
    std::array<std::uint32_t, Blackboard::words> before{}, a{}, b{};
    plain.copyWords(before);
    one->step(plain, {row.time});
    two->step(scrambled, {row.time});
    plain.copyWords(a);
    scrambled.copyWords(b);
    for (const int word : outputs) {
      const auto index = static_cast<std::size_t>(word);
      QVERIFY2(a[index] == b[index], qPrintable(QString("word %1 at %2").arg(word).arg(row.time)));
      changes += a[index] != before[index];
    }
    // And what it writes is in the map.
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool declared = std::ranges::find(outputs, int(i)) != outputs.end();
      QVERIFY2(declared || a[i] == before[i], qPrintable(QString("word %1").arg(i)));
    }
  });
  QVERIFY2(changes > 20 || process == "advisor", QByteArray::number(changes));
}

void TestRerun::theMapNamesWhoeverWrites() {
  const VariableMeanings& meanings = VariableMeanings::published();
  const std::set<std::string> processes{
      "vision", "localization",  "decision", "planning", "control",
      "imu",    "communication", "team",     "advisor",  ""};
  for (const Variable& one : VariableCatalog::extended().variables()) {
    const VariableWriters writers = meanings.writers(one.name);
    QVERIFY2(processes.count(writers.writer) > 0, one.name.c_str());
    const bool shared = one.name == "MATCH_CYCLE" || one.name == "ROBOT_VIEW_ROTATE";
    QVERIFY2(shared || !writers.writer.empty(), one.name.c_str());
  }
  QCOMPARE(meanings.writers("DECISION_ACTION_A"),
           (VariableWriters{"decision", "control", "planning", "DECISION_TARGET"}));
  // A team's own variable, by its prefix.
  QCOMPARE(meanings.writers("VISION_OUR_OWN").writer, std::string("vision"));
  QCOMPARE(meanings.writers("BRAIN_STATE").writer, std::string());
}

void TestRerun::assertionsOverTheOutputs() {
  const auto session = opened(match3v3("none"));
  auto check = RerunCheck::fromJson(R"({
    "name": "walks",
    "measures": {"acts": "DECISION_ACTION_A > 0"},
    "assertions": ["differences == 0", "mean(acts) > 2", {"check": "max(acts) <= 1", "from": "0:10", "until": 20}]
  })",
                                    "check.json");
  QVERIFY2(check, check ? "" : check.error().text().c_str());
  RerunOptions options = optionsFor("B1", {ours("decision")});
  options.compared = [&](double time, auto variables, auto values) {
    check->add(time, variables, values);
  };
  const auto result = rerun(session, options);
  QVERIFY(result);
  const auto judged = check->judge(*result);
  QVERIFY2(judged, judged ? "" : judged.error().text().c_str());
  QCOMPARE(judged->size(), std::size_t(3));
  QVERIFY((*judged)[0].holds);
  QVERIFY(!(*judged)[1].holds);
  QVERIFY((*judged)[2].holds);
  const QString junit = QString::fromStdString(rerunJunit("walks", *judged));
  QVERIFY2(junit.contains("failures=\"1\"") && junit.contains("mean(acts) &gt; 2"),
           qPrintable(junit));

  auto unknown =
      RerunCheck::fromJson(R"({"assertions": ["mean(DECISION_ACTION_X) > 2"]})", "a.json");
  options.compared = [&](double time, auto variables, auto values) {
    unknown->add(time, variables, values);
  };
  const auto second = rerun(session, options);
  const auto refused = unknown->judge(*second);
  QVERIFY(!refused && QString::fromStdString(refused.error().text()).contains("DECISION_ACTION_A"));
  for (const char* text : {"", "[]", "{}", R"({"assertions": []})", R"({"assertions": [3]})",
                           R"({"assertions": [{"check": "1 > 0", "from": "soon"}]})"}) {
    QVERIFY2(!RerunCheck::fromJson(text, "a.json"), text);
  }
}

void TestRerun::mistakesAreNamed_data() {
  QTest::addColumn<QString>("robot");
  QTest::addColumn<QString>("process");
  QTest::addColumn<QString>("program");
  QTest::addColumn<QStringList>("says");
  const auto row = [](const char* name, const char* robot, const char* process, const char* program,
                      const QStringList& says) {
    QTest::newRow(name) << robot << process << program << says;
  };
  row("robot", "B9", "decision", "reference", {"B9", "B1", "R3"});
  row("process", "B1", "thinking", "reference",
      {"thinking", "decision", "localization", "--writes"});
  row("behaviour", "B1", "decision", "strikr", {"strikr", "striker"});
  row("no file", "B1", "decision", "./no-such-program", {"./no-such-program"});
  row("no profile", "B1", "decision", "no-such.json", {"no-such.json"});
  row("senses", "B1", "vision", "reference", {"vision"});
  row("referee", "B1", "communication", "reference",
      {"packets of the referee", "the match itself"});
  row("no whole profile", "B1", "", "no-such.json", {"no-such.json"});
  row("no program", "B1", "decision", "", {"decision=reference"});
}

void TestRerun::mistakesAreNamed() {
  QFETCH(QString, robot);
  QFETCH(QString, process);
  QFETCH(QString, program);
  QFETCH(QStringList, says);
  const auto session = opened(match3v3("none"));
  const auto result = rerun(
      session, optionsFor(qPrintable(robot), {{process.toStdString(), program.toStdString()}}));
  QVERIFY(!result);
  const QString text = QString::fromStdString(result.error().text());
  for (const QString& part : says) QVERIFY2(text.contains(part), qPrintable(text));
}

/// What cannot run of it is named before it starts, and fed as recorded.
void TestRerun::aWholeProfileRuns() {
  const auto session = opened(match3v3("realistic"));
  const RerunOptions options = optionsFor("B1", {rerunProcessFromText("reference").value()});
  const auto plan = planRerun(session, options);
  QVERIFY2(plan, plan ? "" : plan.error().text().c_str());
  const Processes expected{ours("localization"), ours("team"), ours("decision"), ours("planning")};
  QCOMPARE(plan->processes, expected);
  QCOMPARE(plan->recorded, expected);
  QCOMPARE(plan->notes.size(), std::size_t(1));
  QVERIFY2(plan->notes[0].starts_with("communication also gets packets of the referee") &&
               plan->notes[0].ends_with("fed as recorded."),
           plan->notes[0].c_str());
  const auto result = rerun(session, options);
  QVERIFY2(result && result->unequal() == 0, result ? qPrintable(shown(*result)) : "");
  QCOMPARE(result->processes, expected);
  QVERIFY(variable(*result, "COM_POS_ROBOT1").compared > 2000);
  QVERIFY(!rerunProcessFromText("nothing"));
  QCOMPARE(rerunProcessFromText("team.json:side=left").value(),
           (RerunProcess{"", "team.json:side=left"}));
  QCOMPARE(rerunProcessFromText("decision=team.json:side=left").value(),
           (RerunProcess{"decision", "team.json:side=left"}));
}

/// Their messages are made again from their blackboards.
void TestRerun::teamNeedsTeamMates() {
  const auto session = opened(record(m_folder, "alone", {scenarioWith("one-robot", "none"), 3.0}));
  const auto result = rerun(session, optionsFor("B1", {ours("team")}));
  QVERIFY(!result && result.error().code == ErrorCode::Unsupported);
  QVERIFY2(result.error().text().find("no blackboard of a team-mate") != std::string::npos,
           result.error().text().c_str());
}

/// A robot announced its cycles, which came irregularly, while its inputs changed all the time,
/// also within cycles. Its decision process remembers, so that one wrong input or moment changes
/// the rest.
void TestRerun::announcedCyclesRunExactly_data() {
  QTest::addColumn<bool>("announced");
  QTest::addColumn<bool>("clocked");
  QTest::newRow("announced") << true << false;
  QTest::newRow("announced with its clock") << true << true;
  QTest::newRow("only sampled") << false << false;
}

void TestRerun::announcedCyclesRunExactly() {
  QFETCH(bool, announced);
  QFETCH(bool, clocked);
  const VariableCatalog& map = VariableCatalog::published();
  telemetry::GroupInfo group{"B1", {}};
  for (const Variable& variable : map.variables()) {
    group.columns.emplace_back();
    group.columns.back().name = variable.name;
    group.columns.back().type = variable.type == VariableType::Int ? telemetry::ColumnType::Int32
                                                                   : telemetry::ColumnType::Float32;
  }
  const std::size_t ints = static_cast<std::size_t>(
      std::ranges::count(map.variables(), VariableType::Int, &Variable::type));
  const auto addWord = [&](const char* name) {
    telemetry::ColumnInfo word;
    word.name = name;
    word.type = telemetry::ColumnType::Int32;
    group.columns.insert(group.columns.begin() + static_cast<std::ptrdiff_t>(ints), word);
  };
  if (announced) addWord("DECISION_CYCLE");
  if (clocked) addWord("DECISION_CLOCK");
  group.robot.emplace();
  group.robot->slot = group.robot->number = 1;
  group.robot->behaviour = "striker";
  group.robot->sentFrom = "10.0.0.3";
  const std::string path = m_folder.filePath(QTest::currentDataTag()).toStdString();
  telemetry::SessionWriterOptions writing;
  writing.waitWhenFull = true;
  auto writer = telemetry::SessionWriter::create(path, {}, writing).value();
  const auto id = writer->addGroup(group);
  Blackboard board = Blackboard::onHeap();
  ProcessOptions options;
  options.robot = RobotId{1};
  auto decision = findProcess("decision")->make(options).value();
  std::mt19937 random(3);
  const auto between = [&random](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  int clock = 0;  // ms; the process's own, which is not that of the recorder
  const auto write = [&](double time, int cycle) {
    std::vector<std::uint32_t> words;
    for (const Variable& variable : map.variables()) {
      const bool isInt = variable.type == VariableType::Int;
      if (!isInt && words.size() == ints) {
        if (clocked) words.push_back(static_cast<std::uint32_t>(clock));
        if (announced) words.push_back(static_cast<std::uint32_t>(cycle));
      }
      words.push_back(std::bit_cast<std::uint32_t>(
          board.read(IntVar{variable.index + (isInt ? 0 : Blackboard::floatOffset)})));
    }
    writer->append(id, {time, words, {}});
  };
  const RobotVariables v(map);
  const auto sense = [&] {
    board.write(v.visionLost, between(0, 3) == 0 ? 1 : 0);
    board.write(v.visionBallDist, static_cast<float>(between(10, 300)));
    board.write(v.visionPanDeg, static_cast<float>(between(-90, 90)));
    board.write(v.localizationX, between(0, 900));
    board.write(v.localizationY, between(0, 600));
    board.write(v.localizationTheta, between(0, 359));
    board.write(v.localizationBelief, 10.0F);
  };
  board.write(*map.intVar("COM_REFEREE"), 2);
  sense();
  double time = 0.0;
  write(time, 0);
  for (int n = 1; n <= 300; ++n) {
    for (int i = between(1, 4); i > 0; --i) {
      time += 0.001 * between(2, 9);
      sense();
      // As communication does it; the next cycle sets it again.
      if (between(0, 3) == 0) board.write(v.decisionWorking, 0);
      write(time, n == 1 ? 0 : 1 - n);
    }
    time += 0.001 * between(1, 5);
    if (clocked) clock = 7000 + static_cast<int>(1000.0 * time) + between(0, 2);
    write(time, n);
    decision->step(board, Clock{clocked ? clock / 1000.0 : time});
    time += 0.001 * between(1, 5);
    if (between(0, 1) == 0) board.write(v.visionPanDeg, static_cast<float>(between(-90, 90)));
    write(time, -n);
  }
  QVERIFY(writer->finish());
  const auto session = opened(path);
  const auto plan = planRerun(session, optionsFor("B1", {ours("decision")}));
  QVERIFY2(plan, plan ? "" : plan.error().text().c_str());
  const auto result = rerun(session, optionsFor("B1", {ours("decision")}));
  QVERIFY2(result, result ? "" : result.error().text().c_str());
  if (!announced) {
    QVERIFY(result->unequal() > 0 && result->isTooCoarse());
    return;
  }
  QVERIFY2(std::ranges::any_of(plan->notes,
                               [](const std::string& note) {
                                 return note.starts_with("Every cycle of decision was recorded");
                               }),
           plan->notes.empty() ? "no notes" : plan->notes[0].c_str());
  QVERIFY2(result->unequal() == 0, qPrintable(shown(*result)));
  QVERIFY(variable(*result, "DECISION_STATE").compared > 300);
  QVERIFY(variable(*result, "DECISION_WORKING").compared > 300);
  QVERIFY(!result->isTooCoarse());
}

void TestRerun::aRecordingWithoutInputsIsRefused() {
  // A live robot that only sends messages.
  const std::string path = m_folder.filePath("live.mcap").toStdString();
  auto writer = telemetry::SessionWriter::create(path, {}).value();
  telemetry::GroupInfo group;
  group.name = "B1";
  group.columns.resize(2);
  group.columns[0].name = "X";
  group.columns[1].name = "Y";
  group.robot.emplace().number = 1;
  const auto id = writer->addGroup(group);
  for (int i = 0; i < 20; ++i) writer->append(id, {0.5 * i, {}, std::array{1.0, 2.0}});
  QVERIFY(writer->finish());
  const auto session = opened(path);
  const auto refused = rerun(session, optionsFor("B1", {{"decision", "striker"}}));
  QVERIFY(!refused);
  const QString text = QString::fromStdString(refused.error().text());
  QVERIFY2(text.contains("IMU_STATE"), qPrintable(text));
  // Which behaviour it had, no rows say.
  const auto unknown = rerun(session, optionsFor("B1", {ours("decision")}));
  QVERIFY(!unknown && QString::fromStdString(unknown.error().text()).contains("decision=striker"));
}

void TestRerun::cancelling() {
  const auto session = opened(match3v3("none"));
  RerunOptions options = optionsFor("B1", {ours("decision")});
  options.progress = [](double) { return false; };
  const std::string path = m_folder.filePath("cancelled.mcap").toStdString();
  const auto result = rerunToFile(session, options, path);
  QVERIFY(!result && result.error().code == ErrorCode::Conflict);
  QVERIFY(!QFile::exists(QString::fromStdString(path)));
}

PITCHBOARD_TEST(TestRerun)

}  // namespace tst_rerun

#include "tst_rerun.moc"

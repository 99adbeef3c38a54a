// SPDX-License-Identifier: GPL-3.0-or-later

// Numbers of behaviours: one table from which documents, scenarios, experiments and programs
// follow; what a robot does with them; the same match inside and with separate processes.

#include <QFile>
#include <QTemporaryDir>
#include <QtTest>

#include <array>
#include <charconv>
#include <limits>
#include <set>

#include <robotlink/cognition/behaviour_parameters.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/experiment/run_player.h>
#include <robotlink/match/simulated_match.h>

namespace tst_behaviour_parameters {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr int kickRight = 4, kickLeft = 5;

/// Six digits are enough for people.
QString readable(double value) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  return QString::fromLatin1(text.data(), end.ptr - text.data());
}

QString table() {
  const BehaviourParameters usual;
  QString text =
      "| key | name | meaning | of | unit | default | range |\n|---|---|---|---|---|---|---|\n";
  for (const BehaviourParameter& p : behaviourParameters) {
    QStringList of;
    for (const std::string_view name : p.of) {
      if (!name.empty()) of << QString::fromUtf8(name.data(), qsizetype(name.size()));
    }
    text += QString("| `%1` | %2 | %3 | %4 | %5 | %6 | %7 to %8 |\n")
                .arg(p.key, p.name, p.meaning, of.join(", "), p.unit.symbol,
                     readable(p.written(usual.*p.member)), readable(p.least), readable(p.most));
  }
  return text;
}

/// One robot and the ball; `behaviour` is the value of that key.
std::string scenarioWith(const std::string& behaviour) {
  return R"({"version": 1, "ball": {"x": 0.6, "y": 0},
  "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0,
    "behaviour": )" +
         behaviour + R"(}],
  "writes": [{"variable": "COM_REFEREE", "value": 2}]})";
}

Scenario scenarioFrom(const std::string& text) {
  auto scenario = scenarioFromJson(text, "test.json");
  if (!scenario) qFatal("%s", scenario.error().text().c_str());
  return std::move(*scenario);
}

/// How far ball and robot are apart when it decides to kick for the first time; m.
double firstKickFrom(const std::string& behaviour) {
  auto match = SimulatedMatch::create(scenarioFrom(scenarioWith(behaviour)), {}).value();
  for (int i = 0; i < 60 * 60; ++i) {
    match.tick();
    const int action = match.blackboard(RobotId{1})->read(match.variables().decisionActionA);
    if (action != kickRight && action != kickLeft) continue;
    const sim::Snapshot now = match.simulation().snapshot();
    return distance(now.robots[0].pose.position, now.ball);
  }
  return 0.0;
}

/// Where a keeper stands after 30 s, from its goal line; m.
double keeperStands(const std::string& behaviour) {
  Scenario scenario = scenarioFrom(scenarioWith(behaviour));
  scenario.robots[0].pose.position = {-4.0, 0.0};
  scenario.ball = {-2.0, 0.0};
  auto match = SimulatedMatch::create(scenario, {}).value();
  for (int i = 0; i < 30 * 60; ++i) match.tick();
  const sim::Snapshot now = match.simulation().snapshot();
  return now.robots[0].pose.position.x + scenario.settings.field.halfLength();
}

std::string experimentText(const std::string& more) {
  return R"({"version": 1, "name": "numbers", "scenario": )" + scenarioWith("\"striker\"") + R"(,
  "runs": 1, "stop": {"duration": 12},
  )" + more +
         "}";
}

}  // namespace

class TestBehaviourParameters : public QObject {
  Q_OBJECT

 private slots:
  void everyNumberHasOneRowAndAGoodDefault();
  void textKeepsEveryNumber();
  void scenariosKeepThem();
  void aFileGivesNumbersToAll();
  void errorsNameLineAndKey_data();
  void errorsNameLineAndKey();
  void programsRefuseWhatIsOutOfRange();
  void theRobotFollowsItsParameters();
  void experimentsVaryThem();
  void separateProcessesGetThem();
  void theDocumentHasTheTable();
};

void TestBehaviourParameters::everyNumberHasOneRowAndAGoodDefault() {
  const BehaviourParameters usual;
  QVERIFY(validate(usual).has_value());
  std::set<const double*> members;
  std::set<std::string> keys, names;
  for (const BehaviourParameter& p : behaviourParameters) {
    members.insert(&(usual.*p.member));
    keys.insert(p.key);
    names.insert(p.name);
    QVERIFY2(p.least < p.most, p.key);
    for (const std::string_view behaviour : p.of) {
      QVERIFY2(behaviour.empty() || findBehaviour(behaviour), p.key);
    }
  }
  QCOMPARE(members.size(), sizeof(BehaviourParameters) / sizeof(double));
  QCOMPARE(keys.size(), behaviourParameters.size());
  QCOMPARE(names.size(), behaviourParameters.size());
}

void TestBehaviourParameters::textKeepsEveryNumber() {
  for (const BehaviourInfo& info : behaviours()) {
    const std::string name(info.name);
    QCOMPARE(behaviourToText(name, {}), name);
    for (const BehaviourParameter& p : behaviourParameters) {
      for (const double share : {0.0, 0.1, 0.37, 1.0}) {
        BehaviourChoice choice{name, {}};
        choice.parameters.*p.member = p.stored(p.least + share * (p.most - p.least));
        const auto read = behaviourFromText(behaviourToText(name, choice.parameters), "test");
        QVERIFY2(read.has_value(), read ? "" : read.error().text().c_str());
        if (p.isOf(name)) QCOMPARE(read->parameters.*p.member, choice.parameters.*p.member);
        if (!p.isOf(name)) QVERIFY(read->parameters == BehaviourParameters{});
      }
    }
  }
}

void TestBehaviourParameters::scenariosKeepThem() {
  const Scenario scenario = scenarioFrom(
      scenarioWith(R"({"name": "keeper", "clear_within": 2.5, "kick_bearing": 12.5})"));
  QCOMPARE(scenario.robots[0].behaviour, std::string("keeper"));
  QCOMPARE(scenario.robots[0].parameters.clearWithin, 2.5);
  QVERIFY(scenarioFrom(scenarioToJson(scenario)) == scenario);
  // A moment of the match is a scenario with the same numbers.
  auto match = SimulatedMatch::create(scenario, {}).value();
  match.tick();
  QVERIFY(match.toScenario().robots[0].parameters == scenario.robots[0].parameters);
  // Without a name they are a striker's.
  QCOMPARE(scenarioFrom(scenarioWith(R"({"kick_distance": 0.1})")).robots[0].behaviour,
           std::string("striker"));
}

/// Of the numbers of a file each robot takes those that its behaviour reads.
void TestBehaviourParameters::aFileGivesNumbersToAll() {
  QTemporaryDir folder;
  const std::string path = folder.filePath("best.json").toStdString();
  const auto write = [&](const std::string& parameters) {
    QFile file(QString::fromStdString(path));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
    file.write(QByteArray::fromStdString(R"({"version": 1, "name": "best", "learned": {"x": [1]},
  "parameters": )" + parameters + "}"));
  };
  write(R"({"kick_distance": 0.07, "keeper_line": 0.6, "aim_most": 30})");
  const auto loaded = loadBehaviourParameters(path);
  QVERIFY2(loaded.has_value(), loaded ? "" : loaded.error().text().c_str());
  QCOMPARE(loaded->kickDistance, 0.07);
  QCOMPARE(loaded->aimMost, radiansFromDegrees(30.0));
  QCOMPARE(loaded->aimLeast, BehaviourParameters{}.aimLeast);

  const auto numbersOf = [&](const std::string& behaviour) {
    const Scenario scenario = scenarioFrom(scenarioWith(behaviour));
    // What is written reads back to the same.
    if (scenarioFrom(scenarioToJson(scenario)) != scenario) qFatal("another scenario");
    return scenario.robots[0].parameters;
  };
  const std::string from = "\"from\": \"" + path + "\"";
  QCOMPARE(numbersOf("{\"name\": \"striker\", " + from + "}").kickDistance, 0.07);
  QCOMPARE(numbersOf("{\"name\": \"striker\", " + from + "}").keeperLine, 0.2);
  QCOMPARE(numbersOf("{\"name\": \"keeper\", " + from + "}").keeperLine, 0.6);
  QCOMPARE(numbersOf("{\"name\": \"keeper\", \"keeper_line\": 0.3, " + from + "}").keeperLine, 0.3);
  QCOMPARE(numbersOf(R"({"name": "keeper", "from": {"keeper_line": 0.4}})").keeperLine, 0.4);
  QVERIFY(numbersOf("{\"name\": \"none\", " + from + "}") == BehaviourParameters{});
  // As pitchboard-robot has it: --parameters, and what --behaviour names wins.
  const auto chosen = behaviourFromText(R"({"name": "keeper", "keeper_line": 0.9})", "", *loaded);
  QCOMPARE(chosen->parameters.keeperLine, 0.9);
  QCOMPARE(chosen->parameters.kickDistance, 0.07);
  QCOMPARE(behaviourFromText("striker", "", *loaded)->parameters.kickDistance, 0.07);

  const auto refused = [&](const std::string& behaviour) {
    const auto scenario = scenarioFromJson(scenarioWith(behaviour), "test.json");
    return scenario ? QString("was read") : QString::fromStdString(scenario.error().text());
  };
  QVERIFY(refused(R"({"name": "keeper", "from": 3})")
              .contains("test.json:3: robots[0].behaviour.from"));
  QVERIFY(refused(R"({"name": "keeper", "from": {"keeper_lime": 1}})").contains("did you mean"));
  QVERIFY(refused(R"({"name": "keeper", "from": "nowhere.json"})").contains("nowhere.json"));
  write(R"({"kick_distance": 7})");
  QVERIFY(refused("{" + from + "}").contains("best.json:2: parameters.kick_distance"));
}

void TestBehaviourParameters::errorsNameLineAndKey_data() {
  QTest::addColumn<QString>("behaviour");
  QTest::addColumn<QString>("hasText");
  const auto row = [](const char* name, const char* behaviour, const char* hasText) {
    QTest::newRow(name) << behaviour << hasText;
  };
  row("unknown", R"({"name": "striker", "kick_distanze": 0.1})",
      "test.json:3: robots[0].behaviour.kick_distanze");
  row("out of range", R"({"name": "striker",
    "kick_distance": 7})",
      "test.json:4: robots[0].behaviour.kick_distance: must lie between 0 and 1 metres");
  row("of another behaviour", R"({"name": "striker", "keeper_line": 0.1})",
      "test.json:3: robots[0].behaviour.keeper_line");
  row("no number", R"({"name": "naive", "distance_to_kick": "near"})",
      "test.json:3: robots[0].behaviour.distance_to_kick: must be");
  row("no behaviour", R"({"name": "clever"})",
      "test.json:3: robots[0].behaviour.name: there is no behaviour \"clever\"");
  row("a list", "[1]", "test.json:3: robots[0].behaviour: must be the name of a behaviour");
  row("none has none", R"({"name": "none", "kick_distance": 0.1})",
      "test.json:3: robots[0].behaviour.kick_distance");
}

void TestBehaviourParameters::errorsNameLineAndKey() {
  QFETCH(QString, behaviour);
  QFETCH(QString, hasText);
  const auto scenario = scenarioFromJson(scenarioWith(behaviour.toStdString()), "test.json");
  QVERIFY(!scenario);
  QVERIFY2(QString::fromStdString(scenario.error().text()).startsWith(hasText),
           scenario.error().text().c_str());
}

void TestBehaviourParameters::programsRefuseWhatIsOutOfRange() {
  for (const BehaviourParameter& p : behaviourParameters) {
    for (const double bad : {p.least - 1.0, p.most * 1.01 + 1.0, std::nan("")}) {
      ProcessOptions options;
      options.behaviour = std::string(p.of[0]);
      options.parameters.*p.member = p.stored(bad);
      const auto made = findProcess("decision")->make(options);
      QVERIFY2(!made, p.key);
      QCOMPARE(made.error().context, std::string("behaviour.") + p.key);
    }
  }
}

void TestBehaviourParameters::theRobotFollowsItsParameters() {
  const double usual = firstKickFrom(R"("striker")");
  const double far = firstKickFrom(R"({"name": "striker", "kick_distance": 0.12})");
  qInfo("kicks from %.3f m, with 0.12 m from %.3f m", usual, far);
  QVERIFY(usual > 0.2 && usual < 0.26);
  QVERIFY(far > usual + 0.04 && far < 0.36);
  // The published decision, by the distance that it sees.
  const double naive = firstKickFrom(R"({"name": "naive", "distance_to_kick": 40})");
  QVERIFY2(naive > 0.3 && naive < 0.42, qPrintable(QString::number(naive)));
  const double line = keeperStands(R"("keeper")");
  const double out = keeperStands(R"({"name": "keeper", "keeper_line": 0.7})");
  qInfo("the keeper stands at %.3f m, with a line of 0.7 m at %.3f m", line, out);
  QVERIFY(std::abs(out - line - 0.5) < 0.25);
}

void TestBehaviourParameters::experimentsVaryThem() {
  const auto made =
      experimentFromJson(experimentText(R"("set": {"robots[*].behaviour.slow_within": 0.3},
  "grid": {"robots[B1].behaviour.kick_distance": [0.025, 0.12]},
  "random": {"robots[B1].behaviour.aim_most": {"from": 18, "to": 22}})"),
                         "test.json");
  QVERIFY2(made.has_value(), made ? "" : made.error().text().c_str());
  QCOMPARE(made->conditions.size(), std::size_t{2});
  for (std::size_t c = 0; c < 2; ++c) {
    const auto scenario = scenarioOf(*made, placeOf(*made, c + 1));
    QVERIFY(scenario.has_value());
    const BehaviourParameters& numbers = scenario->robots[0].parameters;
    QCOMPARE(scenario->robots[0].behaviour, std::string("striker"));
    QCOMPARE(numbers.slowWithin, 0.3);
    QCOMPARE(numbers.kickDistance, c == 0 ? 0.025 : 0.12);
    QVERIFY(numbers.aimMost >= radiansFromDegrees(18.0));
    QVERIFY(numbers.aimMost <= radiansFromDegrees(22.0));
  }
  const auto wrong = [](const char* more, const QString& hasText) {
    const auto experiment = experimentFromJson(experimentText(more), "test.json");
    if (experiment) return QStringLiteral("was read");
    const QString reported = QString::fromStdString(experiment.error().text());
    return reported.contains(hasText) && reported.contains(QStringLiteral("test.json:6"))
               ? QString()
               : reported;
  };
  QCOMPARE(wrong(R"("grid": {"robots[B1].behaviour.kick_distanze": [0.1]})", "kick_distanze"),
           QString());
  QCOMPARE(wrong(R"("grid": {"robots[B1].behaviour.kick_distance": [0.1, 9]})", "must lie between"),
           QString());
}

void TestBehaviourParameters::separateProcessesGetThem() {
  const std::string number = R"("set": {"robots[B1].behaviour.kick_distance": 0.12,
  "robots[B1].behaviour.kick_bearing": 13.3, "noise": "realistic"})";
  const auto hashOf = [](const std::string& more) {
    const auto experiment = experimentFromJson(experimentText(more), "test.json");
    if (!experiment) qFatal("%s", experiment.error().text().c_str());
    PlaySettings settings;
    settings.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    auto player = RunPlayer::create(*experiment, settings);
    const auto result = player->play(1);
    if (!result) qFatal("%s", result.error().text().c_str());
    return result->hash;
  };
  const std::uint64_t inside = hashOf(number);
  QCOMPARE(hashOf(R"("processes": "separate", )" + number), inside);
  QVERIFY(hashOf(R"("set": {"noise": "realistic"})") != inside);
}

// PITCHBOARD_WRITE_DOCS=1 puts the table into the document instead.
void TestBehaviourParameters::theDocumentHasTheTable() {
  QFile file(QString(PITCHBOARD_SOURCE_DIR) + "/docs/behaviours.md");
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QString text = QString::fromUtf8(file.readAll());
  file.close();
  const QString mark = "<!-- behaviourParameters -->\n";
  const auto begin = text.indexOf(mark);
  const auto end = text.indexOf("<!-- end -->", begin);
  QVERIFY(begin >= 0 && end >= 0);
  if (qEnvironmentVariableIsSet("PITCHBOARD_WRITE_DOCS")) {
    QString right = text;
    right.replace(begin, end - begin, mark + table());
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(right.toUtf8());
    return;
  }
  QCOMPARE(text.mid(begin + mark.size(), end - begin - mark.size()).split('\n'),
           table().split('\n'));
}

PITCHBOARD_TEST(TestBehaviourParameters)

}  // namespace tst_behaviour_parameters

#include "tst_behaviour_parameters.moc"

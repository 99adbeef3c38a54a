// SPDX-License-Identifier: GPL-3.0-or-later
// What a simulated match looks like as rows, against the match itself.

#include <QtTest>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include <base/angles.h>
#include <resources/resources.h>
#include <robotlink/blackboard/variable_meanings.h>
#include <robotlink/live/board_columns.h>
#include <robotlink/match/match_runner.h>
#include <robotlink/session/match_sampler.h>
#include <simcore/world/action_codes.h>
#include <telemetry/series/series_store.h>

#include "../support/group_facts.h"

namespace tst_match_sampler {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::ColumnKind;
using telemetry::SeriesStore;
using std::chrono_literals::operator""us;

namespace {

struct Rig {
  explicit Rig(const char* scenario = "match-3v3", int everyNth = 1)
      : match(SimulatedMatch::create(loadScenario(scenario).value(), {}).value()),
        sampler(store, {.everyNth = everyNth}) {
    sampler.ticked(match, {});
  }
  void play(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      match.tick();
      sampler.ticked(match, 12us);
    }
  }
  double latest(const char* group, const char* column) const {
    const auto id = store->find(group, column);
    if (!id) qFatal("there is no %s of %s", column, group);
    return store->view(id->group)->latest(id->column)->value;
  }
  const telemetry::ColumnInfo& column(const char* group, const char* name) const {
    const auto id = *store->find(group, name);
    return store->view(id.group)->info().columns[id.column];
  }
  std::shared_ptr<SeriesStore> store = std::make_shared<SeriesStore>();
  SimulatedMatch match;
  MatchSampler sampler;
};

}  // namespace

class TestMatchSampler : public QObject {
  Q_OBJECT

 private slots:
  void aBallOutOfViewIsAGapButTheRowKeepsTheValue() {
    using Lost = std::vector<telemetry::LostWhen>;
    Rig rig("kick-off");
    rig.play(60 * 60);
    const auto id = *rig.store->find("B2", "VISION_BALL_DIST");
    const auto lostId = *rig.store->find("B2", "VISION_LOST");
    const auto view = rig.store->view(id.group);
    std::vector<telemetry::Sample> distance, lost;
    view->samples(id.column, {0.0, 60.0}, distance);
    view->samples(lostId.column, {0.0, 60.0}, lost);
    double time = 0.0;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
    int holes = 0, numbers = 0, unset = 0;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      QVERIFY(view->rowAt(distance[i].time, time, words, values));
      // Before vision looked for the ball, its memory holds zeros.
      const bool isUnset = words[id.column] == 0;
      QCOMPARE(std::isnan(distance[i].value), lost[i].value == 1.0 || isUnset);
      unset += isUnset ? 1 : 0;
      (std::isnan(distance[i].value) ? holes : numbers) += 1;
      QVERIFY(std::isfinite(std::bit_cast<float>(words[id.column])));
    }
    QVERIFY2(holes > unset && unset > 0 && numbers > 0,
             qPrintable(QString("%1 %2 %3").arg(holes).arg(unset).arg(numbers)));
    // "-1 = not lately" is no coordinate.
    const telemetry::ColumnInfo& ball = rig.column("B2", "LOCALIZATION_BALL_X");
    QCOMPARE(ball.lost, Lost({{"LOCALIZATION_BALL_X", -1.0}}));
    const Lost neverSeen{{"VISION_LOST", 1.0}, {"VISION_BALL_DIST", 0.0}};
    QCOMPARE(rig.column("B2", "VISION_BALL_DIST").lost, neverSeen);
    QCOMPARE(rig.column("B2", "VISION_BALL_ANGLE").lost, neverSeen);
    // Nor is what behaviours write over an old percept before they look, or a silent team-mate.
    for (const char* name : {"VISION_RBT04_DIST", "VISION_RBT04_ANGLE", "LOCALIZATION_RBT05_Y"}) {
      const telemetry::ColumnInfo& seen = rig.column("B2", name);
      const bool vision = std::string_view(name).starts_with("VISION");
      QCOMPARE(seen.lost, Lost({{vision ? "VISION_RBT04_DIST" : name, vision ? 0.0 : -1.0}}));
    }
    // Sessions of earlier versions do not say it.
    telemetry::GroupInfo old = view->info();
    for (telemetry::ColumnInfo& column : old.columns) column.lost.clear();
    VariableMeanings::published().describeLost(old);
    QVERIFY(old == view->info());
    // What a robot sent later than its first variables; a message has its own rule.
    telemetry::GroupInfo sent{"B2", std::vector<telemetry::ColumnInfo>(2),
                              telemetry::facts({{"sent", "1.2.3.4"}})};
    sent.columns[0].name = "VISION_LOST";
    sent.columns[1].name = "VISION_BALL_DIST";
    VariableMeanings::published().describeLost(sent);
    QCOMPARE(sent.columns[1].lost, neverSeen);
    sent.columns[1].lost.clear();
    sent.robot = telemetry::facts({{"sender", "1.2.3.4"}});
    VariableMeanings::published().describeLost(sent);
    QVERIFY(sent.columns[1].lost.empty());
  }

  /// What advisors have learned is sampled where a team has one, and nowhere else.
  void advisorsAreSampled() {
    Scenario scenario = loadScenario("match-3v3").value();
    scenario.advisors[TeamColor::Blue];
    auto match = SimulatedMatch::create(scenario, {}).value();
    auto store = std::make_shared<SeriesStore>();
    MatchSampler sampler(store, {});
    for (int i = 0; i < 600; ++i) {
      match.tick();
      sampler.ticked(match, 12us);
    }
    const auto latest = [&](const char* name) {
      const auto id = store->find("B1", name);
      return id ? store->view(id->group)->latest(id->column)->value : -1.0;
    };
    const IntVar evidence = *VariableCatalog::extended().intVar("ADVISOR_EVIDENCE1");
    QCOMPARE(latest("ADVISOR_EVIDENCE1"), match.blackboard(RobotId{1})->read(evidence));
    for (const char* name : {"ADVISOR_AIM", "ADVISOR_ASIDE"}) {
      QVERIFY2(store->find("B1", name), name);
    }
    QVERIFY(!Rig().store->find("B1", "ADVISOR_AIM"));
  }

  void oneSampleServesAllReceivers() {
    class Places : public telemetry::RowSink {
     public:
      telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override {
        names.push_back(info.name);
        return static_cast<telemetry::GroupId>(first + names.size());
      }
      void append(telemetry::GroupId group, const telemetry::RowView& row) override {
        rows.push_back(
            {names.at(group - first - 1), row.time, row.words.data(), row.values.data()});
      }
      explicit Places(std::size_t firstId) : first(firstId) {}
      using Row = std::tuple<std::string, double, const std::uint32_t*, const double*>;
      const std::size_t first;  // every sink has ids of its own
      std::vector<std::string> names;
      std::vector<Row> rows;
    };
    Rig rig;
    const auto early = std::make_shared<Places>(10);
    const auto late = std::make_shared<Places>(70);
    rig.sampler.add(early, rig.match);
    QCOMPARE(early->rows.size(), std::size_t{7});  // the match and six robots
    rig.play(10);
    rig.sampler.add(late, rig.match);
    QCOMPARE(early->rows.size(), std::size_t{7 * 11});  // nothing twice for those who were there
    QCOMPARE(late->rows.size(), std::size_t{7});
    QCOMPARE(std::get<double>(late->rows.front()), 10.0 / 60.0);
    early->rows.clear();
    late->rows.clear();
    rig.play(5);
    (void)rig.match.robots().remove(RobotId{2});
    rig.play(5);
    QCOMPARE(late->rows.size(), std::size_t{7 * 5 + 6 * 5});
    QVERIFY(early->rows == late->rows);  // not equal values: the same memory
    rig.sampler.remove(early);
    rig.play(1);
    QCOMPARE(late->rows.size() - early->rows.size(), std::size_t{6});
    QCOMPARE(rig.latest("match", "TICK"), 21.0);
  }

  void everyTickIsARow() {
    Rig rig;
    rig.play(300);
    const sim::Snapshot now = rig.match.simulation().snapshot();
    for (const char* name : {"match", "B1", "B2", "B3", "R1", "R2", "R3"}) {
      const auto id = rig.store->findGroup(name);
      QVERIFY2(id, name);
      const auto view = rig.store->view(*id);
      QCOMPARE(view->rows(), std::size_t{301});
      QCOMPARE(*view->range(), (telemetry::TimeRange{0.0, 5.0}));
    }
    QCOMPARE(rig.latest("match", "TICK"), 300.0);
    QCOMPARE(rig.latest("match", "BALL_X"), now.ball.x);
    QCOMPARE(rig.latest("match", "BALL_VY"), now.ballVelocity.y);
    QCOMPARE(rig.latest("match", "CLOCK"), now.clock);
    QCOMPARE(rig.latest("match", "TICK_TIME"), 12.0);
    for (const sim::RobotSnapshot& robot : now.robots) {
      const std::string name = robot.identity.name();
      QCOMPARE(rig.latest(name.c_str(), "TRUE_X"), robot.pose.position.x);
      QCOMPARE(rig.latest(name.c_str(), "TRUE_Y"), robot.pose.position.y);
      QCOMPARE(rig.latest(name.c_str(), "TRUE_YAW"), degreesFromRadians(robot.pose.yaw));
      QCOMPARE(rig.latest(name.c_str(), "DISTANCE_WALKED"), robot.statistics.distanceWalked);
      const auto view = rig.store->view(*rig.store->findGroup(name));
      QCOMPARE(attributesOf(view->info()).at("robot"), std::to_string(robot.identity.id.value));
      QCOMPARE(attributesOf(view->info()).at("team"), std::string(info(robot.identity.team).name));
      QCOMPARE(attributesOf(view->info()).at("number"), std::to_string(robot.identity.number));
      QCOMPARE(std::stod(attributesOf(view->info()).at("radius")), robot.radius);
      QCOMPARE(std::stod(attributesOf(view->info()).at("vision_range")), robot.visionRange);
      QCOMPARE(attributesOf(view->info()).at("imu180"),
               std::string(robot.identity.imuStartsAt180 ? "1" : "0"));
      // Every word of the blackboard.
      double time = 0.0;
      std::vector<std::uint32_t> words;
      std::vector<double> values;
      QVERIFY(view->rowAt(5.0, time, words, values));
      const Blackboard& board = *rig.match.blackboard(robot.identity.id);
      std::size_t i = 0;
      for (const Variable& variable : VariableCatalog::published().variables()) {
        const std::uint32_t wanted =
            variable.type == VariableType::Int
                ? std::bit_cast<std::uint32_t>(board.read(IntVar{variable.index}))
                : std::bit_cast<std::uint32_t>(board.read(FloatVar{variable.index}));
        // -999 of a landmark says "not seen".
        if (variable.name.ends_with("_LANDMARK_DEG") && std::bit_cast<float>(wanted) == -999.0F) {
          QVERIFY(std::isnan(std::bit_cast<float>(words.at(i))));
        } else {
          QVERIFY2(words.at(i) == wanted, variable.name.c_str());
        }
        QCOMPARE(view->info().columns.at(i).name, variable.name);
        ++i;
      }
      // Those of the extension that are in use: what flows into the processes.
      const VariableCatalog extended = VariableCatalog::published().withExtension();
      QVERIFY(view->info().columns.size() > i);
      bool hasTarget = false;
      for (; i < words.size() && extended.find(view->info().columns[i].name) != nullptr; ++i) {
        const Variable& variable = *extended.find(view->info().columns[i].name);
        const std::uint32_t wanted =
            variable.type == VariableType::Int
                ? std::bit_cast<std::uint32_t>(board.read(IntVar{variable.index}))
                : std::bit_cast<std::uint32_t>(board.read(FloatVar{variable.index}));
        QVERIFY2(words.at(i) == wanted, variable.name.c_str());
        hasTarget = hasTarget || variable.name == "DECISION_TARGET_X";
      }
      QVERIFY(hasTarget);
      QCOMPARE(words.size(), i);
    }
  }

  void errorsOfBeliefAndVision() {
    Rig rig("one-robot");
    const RobotId id = rig.match.simulation().state().robots.front().id;
    const std::string group = rig.match.simulation().state().robots.front().name();
    const char* const name = group.c_str();
    Blackboard& board = *rig.match.blackboard(id);
    const RobotVariables& v = rig.match.variables();
    // The field is 9 m x 6 m: (450, 300) cm is the centre mark.
    QVERIFY(rig.match.simulation().placeRobot(id, {{0.0, 0.0}, 0.0}));
    QVERIFY(rig.match.simulation().placeBall({1.0, 0.0}));
    for (const IntVar variable : {v.localizationX, v.localizationY, v.localizationTheta}) {
      board.write(variable, 0);
    }
    board.write(v.localizationBelief, 0.0F);
    board.write(v.visionLost, 1);
    rig.sampler.ticked(rig.match, {});
    QVERIFY(std::isnan(rig.latest(name, "BELIEF_ERROR")));  // nobody has said anything yet
    QVERIFY(std::isnan(rig.latest(name, "BALL_ERROR")));
    QCOMPARE(rig.latest(name, "TRUE_BALL_DIST"), 100.0);
    QCOMPARE(rig.latest(name, "TRUE_BALL_ANGLE"), 0.0);

    // 30 cm to the right of and 40 cm below the truth (y points down there), turned by 10° too far.
    board.write(v.localizationX, 480);
    board.write(v.localizationY, 340);
    board.write(v.localizationTheta, 10);
    // 100 cm away but 90° to the left: √2 m from where it is.
    board.write(v.visionLost, 0);
    board.write(v.visionBallDist, 100.0F);
    board.write(v.visionPanDeg, 90.0F);
    rig.sampler.ticked(rig.match, {});
    const auto near = [&](const char* column, double wanted) {
      const double found = rig.latest(name, column);
      QVERIFY2(std::abs(found - wanted) < 1e-9,
               qPrintable(QString("%1: %2").arg(column).arg(found)));
    };
    near("BELIEF_X", 0.3);
    near("BELIEF_Y", -0.4);
    near("BELIEF_ERROR", 50.0);
    near("BELIEF_ERROR_YAW", 10.0);
    near("BALL_ERROR", 100.0 * std::numbers::sqrt2);
    near("BALL_DIST_ERROR", 0.0);
    near("BALL_ANGLE_ERROR", 90.0);
  }

  void unitsCategoriesAndLabels() {
    Rig rig;
    QCOMPARE(rig.column("B1", "VISION_BALL_DIST").unit, std::string("cm"));
    QCOMPARE(rig.column("B1", "VISION_BALL_DIST").category, std::string("Vision"));
    QCOMPARE(rig.column("B1", "IMU_EULER_Z").unit, std::string("rad"));
    // The belief is one group, whoever wrote it.
    for (const char* name : {"LOCALIZATION_X", "LOCALIZATION_Y", "LOCALIZATION_THETA",
                             "LOCALIZATION_RBT01_X", "BELIEF_X", "BELIEF_YAW"}) {
      QCOMPARE(rig.column("B1", name).category, std::string("Belief"));
    }
    QCOMPARE(rig.column("B1", "LOCALIZATION_RBT02_X").category, std::string("Localization"));
    QCOMPARE(rig.column("B1", "VOLTAGE").unit, std::string("0.1 V"));
    QVERIFY(rig.column("B1", "VISION_WORKING").kind == ColumnKind::Flag);
    QCOMPARE(rig.column("B1", "VISION_WORKING").category, std::string("Processes"));
    for (const char* name : {"DECISION_ACTION_A", "CONTROL_ACTION", "ACTION"}) {
      const auto& column = rig.column("B1", name);
      QVERIFY(column.kind == ColumnKind::Enumeration);
      QCOMPARE(column.labels.size(), std::size_t{23});
      QCOMPARE(column.labels.at(22), actionLabel(22));
    }
    // What a team-mate told is its intention, not its action.
    const auto& reported = rig.column("B1", "COM_ACTION_ROBOT1");
    QVERIFY(reported.kind == ColumnKind::Enumeration);
    QCOMPARE(reported.labels, rig.column("B1", "DECISION_STATE").labels);
    QCOMPARE(reported.labels.size(), std::size_t{7});
    QCOMPARE(reported.labels.at(3), std::string("at the ball"));
    QCOMPARE(rig.column("B1", "TRUE_X").category, std::string("Truth"));
    QCOMPARE(rig.column("B1", "BELIEF_ERROR").category, std::string("Belief error"));
    for (const auto& column : rig.store->view(*rig.store->findGroup("B1"))->info().columns) {
      QVERIFY2(!column.category.empty() && column.category != "Other", column.name.c_str());
    }
    // Variables of a team's own map go by their beginning.
    telemetry::ColumnInfo own;
    own.name = "VISION_NEW_THING";
    VariableMeanings::published().describe(own);
    QCOMPARE(own.category, std::string("Vision"));
    own = {};
    own.name = "SOMETHING";
    VariableMeanings::published().describe(own);
    QCOMPARE(own.category, std::string("Other"));
  }

  void valuesForNotSeenAreGaps() {
    const VariableCatalog& catalog = VariableCatalog::published();
    const BoardColumns columns(catalog);
    Blackboard board = Blackboard::onHeap();
    board.write(*catalog.floatVar("VISION_RED_LANDMARK_DEG"), -999.0F);
    board.write(*catalog.floatVar("VISION_BLUE_LANDMARK_DEG"), -99.5F);
    board.write(*catalog.floatVar("VISION_PAN_DEG"), -999.0F);
    std::vector<std::uint32_t> words(columns.size());
    columns.read(board, words);
    const auto value = [&](std::string_view name) {
      const auto at = std::ranges::find(columns.columns(), name, &telemetry::ColumnInfo::name);
      return std::bit_cast<float>(
          words.at(static_cast<std::size_t>(at - columns.columns().begin())));
    };
    QVERIFY(std::isnan(value("VISION_RED_LANDMARK_DEG")));
    QCOMPARE(value("VISION_BLUE_LANDMARK_DEG"), -99.5F);
    QCOMPARE(value("VISION_PAN_DEG"), -999.0F);  // an angle as any other
  }

  void theResourceIsSound() {
    QVERIFY(VariableMeanings::parse(resourceText("variables.json"), "variables.json"));
  }

  void meaningsThatMakeNoSense_data() {
    QTest::addColumn<QByteArray>("json");
    QTest::addColumn<QString>("wanted");
    QTest::newRow("no rules") << QByteArray("{}") << "rules";
    QTest::newRow("no name") << QByteArray(R"({"rules": [{"unit": "cm"}]})") << "name";
    QTest::newRow("kind") << QByteArray(R"({"rules": [{"name": "A", "kind": "flagg"}]})") << "flag";
    QTest::newRow("labels") << QByteArray(R"({"rules": [{"name": "A", "labels": {"x": "y"}}]})")
                            << "x";
    QTest::newRow("labels text") << QByteArray(R"({"rules": [{"name": "A", "labels": 3}]})")
                                 << "actions";
    QTest::newRow("key") << QByteArray(R"({"rules": [{"name": "A", "color": "red"}]})") << "color";
    QTest::newRow("not JSON") << QByteArray("{") << "file";
  }
  void meaningsThatMakeNoSense() {
    QFETCH(QByteArray, json);
    QFETCH(QString, wanted);
    const auto read = VariableMeanings::parse(json.toStdString(), "file");
    QVERIFY(!read);
    const QString text = QString::fromStdString(read.error().context + read.error().message);
    QVERIFY2(text.contains(wanted), qPrintable(text));
  }

  void everyNth() {
    Rig rig("match-3v3", 6);
    rig.play(60);
    QCOMPARE(rig.store->view(*rig.store->findGroup("B1"))->rows(), std::size_t{11});
    QCOMPARE(rig.store->view(*rig.store->findGroup("match"))->latest(0)->time, 1.0);
  }

  void robotsComeAndGo() {
    Rig rig("one-robot");
    rig.play(10);
    const auto revision = rig.store->groupsRevision();
    ScenarioRobot robot;
    robot.identity = {RobotId{7}, TeamColor::Red, 7, true};
    robot.pose = {{2.0, 1.0}, 0.0};
    QVERIFY(rig.match.robots().add(robot));
    rig.play(10);
    QVERIFY(rig.store->groupsRevision() > revision);
    const auto red = rig.store->findGroup("R7");
    QVERIFY(red);
    QCOMPARE(rig.store->view(*red)->rows(), std::size_t{10});
    QVERIFY(rig.match.robots().remove(robot.identity.id));
    rig.play(10);
    QCOMPARE(rig.store->view(*red)->rows(), std::size_t{10});  // its past stays
    QCOMPARE(rig.latest("match", "TICK"), 30.0);
  }

  void aMomentPutBack() {
    Rig rig;
    rig.play(100);
    const sim::WorldState moment = rig.match.simulation().state();
    rig.play(100);
    QVERIFY(rig.match.simulation().restore(moment));
    rig.play(20);
    QCOMPARE(rig.store->view(*rig.store->findGroup("B1"))->rows(), std::size_t{121});
    QCOMPARE(rig.latest("match", "TICK"), 120.0);
  }

  /// As the program uses it.
  void besideARunner() {
    auto store = std::make_shared<SeriesStore>();
    auto runner =
        MatchRunner::start(loadScenario("match-3v3").value(), {}, true,
                           VariableCatalog::published(), {std::make_shared<MatchSampler>(store)});
    QVERIFY(runner);
    (*runner)->runTo(200);
    QVERIFY((*runner)->waitUntilStill(std::chrono::seconds(60)));
    QCOMPARE(store->view(*store->findGroup("match"))->latest(0)->value, 200.0);
    QVERIFY(store->view(*store->findGroup("B1"))->rows() >= 201);
  }
};

PITCHBOARD_TEST(TestMatchSampler)

}  // namespace tst_match_sampler

#include "tst_match_sampler.moc"

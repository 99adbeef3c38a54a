// SPDX-License-Identifier: GPL-3.0-or-later
// Robot models as data, and the published decision with the threshold of the real robot (40 cm) on
// robots with a foot.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>
#include <array>
#include <numbers>

#include <base/angles.h>
#include <resources/resources.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/models/robot_models.h>

namespace tst_robot_models {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

struct Played {
  unsigned kicks = 0;
  double way = 0.0;  // of the ball, m
};

/// 25 s of one robot with the naive decision and the ball in front of it.
Played naiveAt40(const sim::RobotModel& model) {
  Scenario scenario = loadScenario("one-robot").value();
  scenario.settings.afterGoal = sim::AfterGoal::StopClock;
  scenario.robots[0].behaviour = "naive";
  scenario.robots[0].model = model;
  scenario.robots[0].pose = {{-4.0, 0.0}, 0.0};
  // Not 50 cm before it: the published rule then gaits in place (naive_decision.h).
  const double start = -3.55;
  scenario.ball = {start, 0.0};
  scenario.robots[0].parameters.distanceToKick = 40.0;
  auto match = SimulatedMatch::create(scenario, {}).value();
  for (int i = 0; i < 25 * 60; ++i) match.tick();
  const sim::Snapshot now = match.simulation().snapshot();
  return {now.robots[0].statistics.kicks, now.ball.x - start};
}

/// What the sources say of each model's kicks.
QJsonObject kickRanges() {
  QFile file(PITCHBOARD_SOURCE_DIR "/tests/data/kick_ranges.json");
  if (!file.open(QIODevice::ReadOnly)) qFatal("no kick_ranges.json");
  return QJsonDocument::fromJson(file.readAll()).object();
}

/// How far a ball rolls that this kick hits squarely, without noise, m.
double rollOf(const QJsonObject& kick) {
  constexpr double inside = 0.05;  // m
  const QMap<QString, int> actions{{"strong", 4}, {"weak", 21}, {"pass", 12}};
  const int action = actions[kick["kick"].toString()];
  Scenario scenario = loadScenario("one-robot").value();
  scenario.settings.field = sim::fieldByName(kick["field"].toString().toStdString()).value();
  scenario.settings.noise = {};
  sim::RobotModel& model = scenario.robots[0].model;
  model = loadRobotModel(kick["model"].toString().toStdString()).value();
  scenario.robots[0].behaviour = noBehaviour;
  scenario.robots[0].pose = {{-4.0, 0.0}, 0.0};
  const double foot = model.kickLaw == sim::KickLaw::Published ? 0.0 : model.footSide;
  const double away = kick["ball_at"].toDouble(model.kickReach - inside);
  scenario.ball = {-4.0 + away, action == 12 ? foot : -foot};
  auto match = SimulatedMatch::create(scenario, {}).value();
  match.blackboard(RobotId{1})->write(match.variables().decisionActionA, action);
  for (int i = 0; i < 15 * 60; ++i) match.tick();
  const sim::Snapshot now = match.simulation().snapshot();
  const bool rolls = std::hypot(now.ballVelocity.x, now.ballVelocity.y) > 1e-9;
  if (rolls || now.robots[0].statistics.kicks != 1U) qWarning("kicked otherwise than once");
  return std::hypot(now.ball.x - scenario.ball.x, now.ball.y - scenario.ball.y);
}

struct Meeting {
  std::array<unsigned, 2> falls{};
  double gap = 9.0;  ///< between their centres at least, m
};

/// Two kid-size robots face each other and do these actions; both slowly where there is a choice.
Meeting meet(int action, int othersAction) {
  Scenario scenario = loadScenario("one-robot").value();
  scenario.settings.field = sim::fieldByName("kid-2020").value();
  scenario.settings.noise = {};
  scenario.settings.rigidBody.falls = true;
  scenario.ball = {3.0, 2.0};
  scenario.robots[0].behaviour = noBehaviour;
  scenario.robots[0].model = loadRobotModel("kid-size").value();
  scenario.robots[0].pose = {{-1.5, 0.0}, 0.0};
  scenario.robots.push_back(scenario.robots[0]);
  scenario.robots[1].identity.id = RobotId{2};
  scenario.robots[1].identity.number = 2;
  scenario.robots[1].pose = {{0.0, 0.0}, std::numbers::pi};
  auto match = SimulatedMatch::create(scenario, {}).value();
  for (const int id : {1, 2}) {
    match.blackboard(RobotId{id})->write(match.variables().decisionActionB, 10);
    match.blackboard(RobotId{id})
        ->write(match.variables().decisionActionA, id == 1 ? action : othersAction);
  }
  Meeting meeting;
  for (int i = 0; i < 15 * 60; ++i) {
    match.tick();
    const auto robots = match.simulation().snapshot().robots;
    meeting.gap = std::min(meeting.gap, distance(robots[0].pose.position, robots[1].pose.position));
    for (const std::size_t one : {0, 1}) meeting.falls[one] = robots[one].statistics.falls;
  }
  return meeting;
}

}  // namespace

class TestRobotModels : public QObject {
  Q_OBJECT

 private slots:
  void theModelDecidesWhenABatteryIsLow() {
    // The usual limits are those of the published robot.
    const auto usual = telemetry::defaultBattery;
    const auto published = batteryLimitsOf(sim::RobotModel());
    for (const double volts : {14.0, 14.7, 15.9, 16.1, 18.9, 20.0}) {
      const auto one = telemetry::batteryAt(volts, published);
      const auto other = telemetry::batteryAt(volts, usual);
      QCOMPARE(one.low, other.low);
      QVERIFY(std::abs(one.fraction - other.fraction) < 1e-9);
    }
    for (const std::string& name : robotModels()) {
      const auto model = robotModelFromText(name, "test").value();
      const auto limits = batteryLimitsOf(model);
      QVERIFY(!telemetry::batteryAt(model.batteryFull, limits).low);
      QVERIFY(telemetry::batteryAt(model.batteryLow - 0.1, limits).low);
      QCOMPARE(telemetry::batteryAt(model.batteryEmpty, limits).fraction, 0.0);
      // A simulated robot measures the voltage of its own battery, which is never low.
      Scenario scenario = loadScenario("one-robot").value();
      scenario.robots[0].model = model;
      auto match = SimulatedMatch::create(scenario, {}).value();
      match.tick();
      const double volts = match.percepts()[0].voltage / 10.0;
      QVERIFY2(volts > model.batteryLow && volts < model.batteryFull, name.c_str());
    }
    QCOMPARE(sim::simulatedVoltage(sim::RobotModel()), 189);
    const auto wrong = robotModelFromText(R"({"base": "kid-size", "battery_low": 17})", "a.json");
    QVERIFY(!wrong);
    QVERIFY2(wrong.error().text().find("battery_low: must lie between") != std::string::npos,
             wrong.error().text().c_str());
  }

  void builtInModelsAreValidAndNameTheirSources() {
    const auto names = robotModels();
    QCOMPARE(names.front(), std::string("published"));
    QVERIFY(*robotModelFromText("published", "") == sim::RobotModel{});
    for (const std::string& name : names) {
      const auto model = robotModelFromText(name, "test");
      QVERIFY2(model, model ? "" : model.error().text().c_str());
      QCOMPARE(model->name, name);
      QVERIFY(!robotModelText(name).title.empty() && !robotModelText(name).description.empty());
      const std::string_view text = resourceText("robots/" + name + ".json");
      QVERIFY(text.find("\"sources\"") != std::string_view::npos);
      QCOMPARE(robotModelToText(*model), name);
    }
  }

  void thePublishedDecisionKicksAsOnTheField_data() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"darwin-op", "kid-size", "adult-size"}) QTest::newRow(name) << name;
  }
  void thePublishedDecisionKicksAsOnTheField() {
    QFETCH(QString, name);
    const Played played = naiveAt40(loadRobotModel(name.toStdString()).value());
    qInfo("%s: %u kicks, %.2f m", qPrintable(name), played.kicks, played.way);
    QVERIFY(played.kicks >= 2);
    // Some tenths of a metre a kick, on a surface on which the ball keeps 95 % in 1/60 s.
    QVERIFY(played.way / played.kicks > 0.25);
    QVERIFY(played.way > 1.0);
  }

  void aKickRollsAsFarAsItsSourceStates_data() {
    QTest::addColumn<QJsonObject>("kick");
    QTest::addColumn<double>("tolerance");
    const QJsonObject file = kickRanges();
    QSet<QString> models;
    for (const QJsonValue& one : file["kicks"].toArray()) {
      const QJsonObject kick = one.toObject();
      models << kick["model"].toString();
      QTest::addRow("%s, %s", qPrintable(kick["model"].toString()),
                    qPrintable(kick["kick"].toString()))
          << kick << file["tolerance"].toDouble();
    }
    for (const std::string& name : robotModels()) {
      QVERIFY2(models.contains(QString::fromStdString(name)), name.c_str());
    }
  }
  void aKickRollsAsFarAsItsSourceStates() {
    QFETCH(QJsonObject, kick);
    QFETCH(double, tolerance);
    const double wanted = kick["metres"].toDouble();
    const double way = rollOf(kick);
    QVERIFY(wanted > 0.0 && !kick["source"].toString().isEmpty());
    QVERIFY2(std::abs(way - wanted) <= tolerance * wanted, qPrintable(QString::number(way)));
  }

  // A foot's kick depends on the surface: on the published one nothing rolls far.
  void onThePublishedFieldAKickRollsLess() {
    const double way = rollOf({{"model", "kid-size"}, {"field", "published"}, {"kick", "strong"}});
    QVERIFY2(way > 0.6 && way < 0.64, qPrintable(QString::number(way)));
  }

  // PITCHBOARD_WRITE_DOCS=1 puts the table into the document instead.
  void theDocumentHasTheKickRanges() {
    QString table =
        "| model | field | kick | its source, m | simulated, m | source |\n"
        "|---|---|---|---|---|---|\n";
    for (const QJsonValue& one : kickRanges()["kicks"].toArray()) {
      const QJsonObject kick = one.toObject();
      table += QStringLiteral("| `%1` | `%2` | %3 | %4 | %5 | %6 |\n")
                   .arg(kick["model"].toString(), kick["field"].toString(), kick["kick"].toString())
                   .arg(kick["metres"].toDouble())
                   .arg(rollOf(kick), 0, 'f', 2)
                   .arg(kick["source"].toString());
    }
    QFile file(PITCHBOARD_SOURCE_DIR "/docs/scenarios.md");
    QVERIFY(file.open(QIODevice::ReadOnly));
    QString text = QString::fromUtf8(file.readAll());
    file.close();
    const QString mark = "<!-- kickRanges -->\n";
    const auto begin = text.indexOf(mark) + mark.size();
    const auto end = text.indexOf("<!-- end -->", begin);
    QVERIFY(begin >= mark.size() && end > begin);
    if (qEnvironmentVariableIsSet("PITCHBOARD_WRITE_DOCS")) {
      text.replace(begin, end - begin, table);
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(text.toUtf8());
      return;
    }
    QCOMPARE(text.mid(begin, end - begin).split('\n'), table.split('\n'));
  }

  // Head-on at full speed both fall. Who is run into while it stands, or is met slowly, is pushed.
  void kidSizeRobotsFallWhenPushedHard_data() {
    QTest::addColumn<int>("action");
    QTest::addColumn<int>("othersAction");
    QTest::addColumn<bool>("fall");
    constexpr int stands = 0, fast = 1, slow = 8;
    QTest::newRow("head-on") << fast << fast << true;
    QTest::newRow("head-on, slowly") << slow << slow << false;
    QTest::newRow("into one that stands") << fast << stands << false;
    QTest::newRow("by one that walks") << stands << fast << false;
  }
  void kidSizeRobotsFallWhenPushedHard() {
    QFETCH(int, action);
    QFETCH(int, othersAction);
    QFETCH(bool, fall);
    const Meeting meeting = meet(action, othersAction);
    QVERIFY2(meeting.gap < 0.45, qPrintable(QString::number(meeting.gap)));
    for (const unsigned falls : meeting.falls) QCOMPARE(falls > 0, fall);
  }

  // Two to twenty falls are what is seen in a match of kid-size robots.
  void aMatchHasAFewFalls() {
    constexpr int matches = 3;
    unsigned falls = 0;
    for (int seed = 1; seed <= matches; ++seed) {
      Scenario scenario = loadScenario("match").value();
      scenario.settings.rigidBody.falls = true;
      scenario.settings.seed = static_cast<std::uint64_t>(seed);
      auto match = SimulatedMatch::create(scenario, {}).value();
      while (!match.finished()) match.tick();
      for (const sim::RobotStatistics& one : match.simulation().state().statistics) {
        falls += one.falls;
      }
    }
    QVERIFY2(falls >= 2 * matches && falls <= 20 * matches, qPrintable(QString::number(falls)));
  }

  void thePublishedForceOnlyPushes() {
    const Played played = naiveAt40({});
    qInfo("published: %u kicks, %.2f m", played.kicks, played.way);
    QVERIFY(played.kicks > 20);
    QVERIFY(played.way / played.kicks < 0.05);
  }

  void aModelComesBackFromItsText() {
    sim::RobotModel model = loadRobotModel("kid-size").value();
    model.name = "mine";
    model.mass = 6.25;
    model.turn = radiansFromDegrees(33);
    model.fromCamera = true;
    model.noise.kickAngle = radiansFromDegrees(7);
    const auto read = robotModelFromText(robotModelToText(model), "test");
    QVERIFY2(read, read ? "" : read.error().text().c_str());
    QVERIFY(*read == model);
  }

  void scenariosNameModels() {
    const auto scenario = scenarioFromJson(R"({"version": 1, "robot_model": "kid-size", "robots": [
        {"team": "blue", "number": 1, "x": 0, "y": 0},
        {"team": "blue", "number": 2, "x": 1, "y": 0, "model": "adult-size"},
        {"team": "red", "number": 1, "x": 2, "y": 0, "model": {"base": "darwin-op", "mass": 3}}]})",
                                           "s");
    QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
    QCOMPARE(scenario->robots[0].model.name, std::string("kid-size"));
    QCOMPARE(scenario->robots[1].model.name, std::string("adult-size"));
    QCOMPARE(scenario->robots[2].model.mass, 3.0);
    QCOMPARE(scenario->robots[2].model.radius, 0.1);
    const auto again = scenarioFromJson(scenarioToJson(*scenario), "s");
    QVERIFY(again && *again == *scenario);
    // The match hands each robot its model, and gives it back with the moment.
    const auto match = SimulatedMatch::create(*scenario, {}).value();
    QCOMPARE(match.robots().model({2})->name, std::string("adult-size"));
    QVERIFY(match.toScenario().robots[2].model == scenario->robots[2].model);
  }

  void scenariosNameFilesOfModels() {
    QTemporaryDir folder;
    const QString path = folder.filePath("b1.json");
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"name": "ours", "base": "kid-size", "mass": 5})");
    file.close();
    const auto scenarioWith = [](const QString& name) {
      return scenarioFromJson(QStringLiteral(R"({"version": 1, "robot_model": "%1",
        "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0}]})")
                                  .arg(name)
                                  .toStdString(),
                              "s");
    };
    const auto scenario = scenarioWith(path);
    QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
    QCOMPARE(scenario->robots[0].model.name, std::string("ours"));
    QCOMPARE(scenario->robots[0].model.mass, 5.0);
    const auto none = scenarioWith("./b2.json");
    QVERIFY(!none && none.error().text().find("s:1: robot_model: ./b2.json") != std::string::npos);
  }

  void filesOfVersion02AreRead() {
    const auto scenario = scenarioFromJson(R"({"version": 1,
        "rigid_body": {"robot_mass": 9, "get_up_time": 7, "ball_mass": 0.3},
        "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0}]})",
                                           "s");
    QVERIFY(scenario);
    QCOMPARE(scenario->robots[0].model.mass, 9.0);
    QCOMPARE(scenario->robots[0].model.getUpFront, 7.0);
    QCOMPARE(scenario->robots[0].model.getUpBack, 7.0);
    QCOMPARE(scenario->settings.rigidBody.ballMass, 0.3);
  }

  void filesOfVersion08KeepTheirSurface_data() {
    QTest::addColumn<QString>("body");
    QTest::addColumn<double>("deceleration");
    QTest::addColumn<double>("kept");
    QTest::newRow("both") << R"("ball_friction": 1, "ball_deceleration": 0.35)" << 0.35 << 1.0;
    QTest::newRow("share") << R"("ball_friction": 0.9)" << 0.0 << 0.9;
    QTest::newRow("deceleration") << R"("ball_deceleration": 0.2)" << 0.2 << 0.95;
    QTest::newRow("neither") << R"("falls": true)" << 0.3 << 1.0;
  }
  void filesOfVersion08KeepTheirSurface() {
    QFETCH(QString, body);
    QFETCH(double, deceleration);
    QFETCH(double, kept);
    const QString text =
        QStringLiteral(R"({"version": 1, "field": "kid-2020", "rigid_body": {%1}})").arg(body);
    const auto scenario = scenarioFromJson(text.toStdString(), "s");
    QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
    QCOMPARE(scenario->settings.field.surface.deceleration, deceleration);
    QCOMPARE(scenario->settings.field.surface.keptPerFrame, kept);
    const std::string written = scenarioToJson(*scenario);
    QVERIFY(written.find("ball_friction") == std::string::npos);
    QVERIFY(scenarioFromJson(written, "s").value() == *scenario);
    const auto wrong =
        scenarioFromJson(R"({"version": 1, "rigid_body": {"ball_friction": 1.5}})", "s");
    QVERIFY(wrong.error().text().find("s:1: rigid_body.ball_friction: ") == 0);
  }

  void aFieldHasASurface() {
    const auto scenario = scenarioFromJson(
        R"({"version": 1, "field": {"base": "kid-2020", "rolling_deceleration": 0.5}})", "s");
    QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
    QVERIFY(scenario->settings.field.surface == (sim::Surface{0.5, 1.0}));
    QVERIFY(scenarioFromJson(scenarioToJson(*scenario), "s").value() == *scenario);
    const auto wrong =
        scenarioFromJson(R"({"version": 1, "field": {"rolling_speed_kept": 2}})", "s");
    QVERIFY(wrong.error().text().find("rolling_speed_kept") != std::string::npos);
  }

  void theBallIsThatOfTheLeague() {
    const auto scenario = scenarioFromJson(R"({"version": 1, "field": "adult-2020"})", "s");
    QCOMPARE(scenario->settings.field.ballRadius, 0.11);
    QCOMPARE(scenario->settings.rigidBody.ballMass, 0.43);
    const auto again = scenarioFromJson(scenarioToJson(*scenario), "s");
    QVERIFY(again && *again == *scenario);
  }

  void complaintsNameLineAndKey_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("error");
    QTest::newRow("range") << "{\n \"mass\": -3}"
                           << "m.json:2: mass: ";
    QTest::newRow("unknown key") << "{\n\n \"maas\": 3}"
                                 << "m.json:3: maas: ";
    QTest::newRow("law") << R"({"kick_law": "head"})"
                         << "m.json:1: kick_law: ";
    QTest::newRow("base") << R"({"base": "kid"})"
                          << "m.json:1: base: ";
    QTest::newRow("noise") << R"({"noise": {"forward": -1}})"
                           << "m.json:1: noise.forward: ";
    QTest::newRow("noise of noise") << R"({"noise": "robot"})"
                                    << "m.json:1: noise: ";
    QTest::newRow("source") << R"({"sources": {"mas": "x"}})"
                            << "m.json:1: sources.mas: ";
    QTest::newRow("no object") << "{\"a\""
                               << "m.json:1";
  }
  void complaintsNameLineAndKey() {
    QFETCH(QString, text);
    QFETCH(QString, error);
    const auto model = robotModelFromText(text.toStdString(), "m.json");
    QVERIFY(!model);
    QVERIFY2(QString::fromStdString(model.error().text()).contains(error),
             model.error().text().c_str());
    QVERIFY(robotModelFromText("kidsize", "").error().text().find("kid-size") !=
            std::string_view::npos);
  }

  void anotherModelWhileTheMatchPlays() {
    auto match = SimulatedMatch::create(loadScenario("one-robot").value(), {}).value();
    for (int i = 0; i < 60; ++i) match.tick();
    QVERIFY(match.robots().setModel({1}, loadRobotModel("adult-size").value()));
    for (int i = 0; i < 60; ++i) match.tick();
    QCOMPARE(match.simulation().snapshot().robots[0].radius, 0.26);
    QVERIFY(!match.robots().setModel({5}, {}));
  }
};

PITCHBOARD_TEST(TestRobotModels)

}  // namespace tst_robot_models

#include "tst_robot_models.moc"

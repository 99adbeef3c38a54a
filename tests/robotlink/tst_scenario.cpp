// SPDX-License-Identifier: GPL-3.0-or-later
#include <QFile>
#include <QtTest>

#include <random>

#include <base/angles.h>
#include <resources/resources.h>
#include <robotlink/scenario/scenario.h>

namespace tst_scenario {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

Result<Scenario> read(const std::string& text) {
  return scenarioFromJson(text, "my.json");
}

std::string robot(const std::string& keys) {
  return "{\"version\": 1,\n\"robots\": [\n{\"team\": \"blue\", \"number\": 1, \"x\": 0, \"y\": "
         "0},\n{" +
         keys + "}\n]}";
}

}  // namespace

class TestScenario : public QObject {
  Q_OBJECT

 private slots:
  void everyBuiltInIsValidAndRoundTrips() {
    QCOMPARE(builtInScenarios().front().name, std::string("match"));
    std::size_t files = 0;
    for (const Resource& resource : resources()) files += resource.path.starts_with("scenarios/");
    QCOMPARE(builtInScenarios().size(), files);
    for (const auto& [name, title] : builtInScenarios()) {
      const auto scenario = loadScenario(name);
      QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
      QCOMPARE(scenario->name, name);
      QVERIFY(!title.empty() && title != name);
      const auto again = read(scenarioToJson(*scenario));
      QVERIFY2(again, again ? "" : again.error().text().c_str());
      QVERIFY(*again == *scenario);
      QVERIFY(sim::Simulation::create(scenario->settings));
    }
  }

  void sizesThatNoVersionHasAreRefused_data() {
    QTest::addColumn<QString>("rules");
    QTest::addColumn<QString>("wrong");
    QTest::newRow("a size that version 12 has") << "\"packet_version\": 12, \"packet_size\": 640"
                                                << "";
    QTest::newRow("a version, its own size") << "\"packet_version\": 13"
                                             << "";
    QTest::newRow("a size that none has") << "\"packet_size\": 100"
                                          << "packet_size";
    QTest::newRow("a size of another version") << "\"packet_version\": 20, \"packet_size\": 688"
                                               << "packet_size";
    QTest::newRow("no whole version") << "\"packet_version\": 12.5"
                                      << "packet_version";
    QTest::newRow("no whole count") << "\"shots\": 2.5"
                                    << "shots";
  }
  void sizesThatNoVersionHasAreRefused() {
    QFETCH(QString, rules);
    QFETCH(QString, wrong);
    const auto scenario = read("{\"version\": 1, \"referee\": {\"rules\": \"humanoid-2021\", " +
                               rules.toStdString() + "}}");
    QCOMPARE(scenario.has_value(), wrong.isEmpty());
    if (!scenario) {
      const QString reported = QString::fromStdString(scenario.error().text());
      QVERIFY2(reported.contains("referee." + wrong), qPrintable(reported));
      return;
    }
    const sim::RefereeRules& read = *scenario->settings.referee;
    QVERIFY(read.packetSize == (read.packetVersion == 12 ? 640 : 54));
  }

  void aGameIsRead() {
    const auto scenario = read(R"({"version": 1, "referee": "humanoid-2021",
      "game": {"state": "playing", "half": 2, "clock": 60, "kick_off": null,
               "score": {"blue": 2, "red": 1}, "by_half": {"blue": [1, 1]},
               "set_play": {"kind": "goal_kick", "team": "red"}},
      "robots": [{"team": "blue", "number": 2, "x": 0, "y": 0,
                  "penalty": {"kind": "sent_off"}, "cards": {"red": 1}},
                 {"team": "red", "number": 5, "x": 1, "y": 0, "goalkeeper": true,
                  "belief": {"x": 1, "y": 0, "heading": 180, "sigma": 0.1}}]})");
    QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
    const sim::GameStart& game = *scenario->game;
    QCOMPARE(game.state, PlayState::Playing);
    QCOMPARE(game.clock, std::optional<double>(60.0));
    QVERIFY(game.kickOff && !game.kickOff->team);
    QCOMPARE(game.teams.at(TeamColor::Blue).score, 2);
    QCOMPARE((*game.teams.at(TeamColor::Blue).byHalf)[1], 1);
    QCOMPARE(game.setPlay->kind, SetPlay::GoalKick);
    QCOMPARE(game.robots.at(RobotId{1}).penalty, PenaltyKind::SentOff);
    QCOMPARE(game.robots.at(RobotId{2}).goalkeeper, std::optional<bool>(true));
    QCOMPARE(scenario->robots[1].belief->sigma, 0.1);
    const auto again = read(scenarioToJson(*scenario));
    QVERIFY2(again, again ? "" : again.error().text().c_str());
    QVERIFY(*again == *scenario);
  }

  void wrongGamesAreNamed_data() {
    QTest::addColumn<QString>("keys");
    QTest::addColumn<QString>("reported");
    const auto row = [](const char* name, const char* keys, const char* reported) {
      QTest::newRow(name) << QString::fromUtf8(keys) << QString::fromUtf8(reported);
    };
    row("no referee", R"("game": {"state": "set"})", "game: a game, penalties and cards need");
    row("state", R"("referee": "humanoid-2021", "game": {"state": "playin"})",
        "game.state: there is no game state \"playin\"; did you mean \"playing\"?");
    row("score twice", R"("referee": "humanoid-2021", "game": {}, "score": {"left": 1})",
        "score: belongs inside \"game\"");
    row("robot", R"("referee": "humanoid-2021", "game": {"touch": {"robot": "B7"}})",
        "game.touch.robot: there is no robot \"B7\"");
    row("place", R"("referee": "humanoid-2021", "game": {"ball_still": {"x": 1}})",
        "game.ball_still.y");
    row("goals", R"("referee": "humanoid-2021", "game": {"by_half": {"red": [-1]}})",
        "game.by_half.red: must be a list of goals");
  }
  void wrongGamesAreNamed() {
    QFETCH(QString, keys);
    QFETCH(QString, reported);
    const auto scenario = read("{\"version\": 1, " + keys.toStdString() + "}");
    QVERIFY(!scenario);
    const QString text = QString::fromStdString(scenario.error().text());
    QVERIFY2(text.contains(reported), qPrintable(text));
  }

  void noisePresetsAreValid() {
    std::size_t files = 0;
    for (const Resource& resource : resources()) files += resource.path.starts_with("noise/");
    QCOMPARE(noisePresets().size(), files);
    for (const std::string& name : noisePresets()) {
      const auto noise = noisePreset(name);
      QVERIFY2(noise, noise ? "" : noise.error().text().c_str());
    }
    QVERIFY(*noisePreset("none") == sim::NoiseParameters{});
    QCOMPARE(noisePreset("paper")->imuWhite, 0.01);
    QCOMPARE(noisePreset("paper")->landmarkBearing, radiansFromDegrees(5));
    QCOMPARE(noisePreset("papr").error().message,
             std::string("there is no noise preset \"papr\"; did you mean \"paper\"?"));
  }

  void anglesSettleAfterOneRoundTrip() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> angle(-6.28, 6.28);
    for (int i = 0; i < 2000; ++i) {
      Scenario scenario;
      scenario.robots.resize(1);
      scenario.robots[0].identity = {RobotId{1}, TeamColor::Red, 7, false};
      scenario.robots[0].pose = {{angle(random) / 2, angle(random) / 2}, angle(random)};
      scenario.settings.noise.imuWhite = std::abs(angle(random)) / 7;
      scenario.robots[0].model.headSpeed = std::abs(angle(random));
      const auto once = read(scenarioToJson(scenario));
      QVERIFY2(once, once ? "" : once.error().text().c_str());
      QVERIFY(std::abs(once->robots[0].pose.yaw - scenario.robots[0].pose.yaw) <= 1e-15 * 8);
      QCOMPARE(once->robots[0].pose.position, scenario.robots[0].pose.position);
      const auto twice = read(scenarioToJson(*once));
      QVERIFY(*twice == *once);
      QCOMPARE(scenarioToJson(*twice), scenarioToJson(*once));
    }
  }

  void everyKeyIsRead() {
    const auto s = read(R"({"version": 1, "name": "n", "title": "T", "description": "D",
      "physics": "published", "tick_rate": 120.5, "seed": 18446744073709551615,
      "after_goal": "stop_clock", "clock_running": false,
      "clock": 61.5, "score": {"left": 2, "right": 1},
      "field": {"name": "mine", "base": "kid-2020", "length": 10},
      "noise": {"preset": "paper", "rotation": 90, "missed_detection": 0.5},
      "rigid_body": {"falls": true, "field_of_view": 90},
      "ball": {"x": 1, "y": -0.5, "vx": 2, "vy": 0.25},
      "robots": [{"team": "red", "number": 3, "x": 1.5, "y": 2, "heading": 90, "id": 9,
                  "behaviour": "none", "blackboard": {"IMU_EULER_Z": 0.5}}],
      "writes": [{"time": 2, "robot": 9, "variable": "COM_REFEREE", "value": -1},
                 {"variable": "COM_REFEREE", "value": 2}],
      "stop": {"duration": 30, "goal": true, "ball_out": true}})");
    QVERIFY2(s, s ? "" : s.error().text().c_str());
    QCOMPARE(s->settings.seed, ~std::uint64_t{0});
    QCOMPARE(s->settings.field.length, 10.0);
    QCOMPARE(s->settings.field.border, 1.0);
    QCOMPARE(s->settings.noise.rotation, radiansFromDegrees(90));
    QCOMPARE(s->settings.noise.forward, 0.002);
    QCOMPARE(s->robots[0].model.fieldOfView, radiansFromDegrees(90));
    QVERIFY(s->settings.afterGoal == sim::AfterGoal::StopClock && !s->clockRunning);
    QCOMPARE(s->clock, 61.5);
    QVERIFY(s->score == (sim::Score{2, 1}));
    QVERIFY(s->robots[0].identity.imuStartsAt180);  // red faces left
    QCOMPARE(s->robots[0].identity.id.value, 9);
    QCOMPARE(s->writes.size(), std::size_t{3});
    QCOMPARE(s->writes[0].variable, std::string("IMU_EULER_Z"));  // in order of time
    QCOMPARE(s->writes[1].robot.value, 0);
    QCOMPARE(s->writes[2].time, 2.0);
    QVERIFY(*read(scenarioToJson(*s)) == *s);
  }

  void teamsComeBackAsTheyWere() {
    const auto s = read(R"({"version": 1, "referee": "humanoid-2021", "teams": [
        {"colour": "black", "number": 12, "name": "RoboFEI"}, {"colour": "blue"}]})");
    QVERIFY2(s, s ? "" : s.error().text().c_str());
    QCOMPARE(s->settings.teams.size(), std::size_t{2});
    QVERIFY(s->settings.teams[0] == (sim::TeamSettings{TeamColor::Black, 12, "RoboFEI"}));
    QCOMPARE(s->settings.teams[1].number, 0);  // one that is free
    QVERIFY(*read(scenarioToJson(*s)) == *s);
  }

  // As many writes as docs/scenarios.md allows, as a program would print them.
  void asManyWritesAsAllowedAreRead() {
    std::string text = "{\n  \"version\": 1,\n  \"writes\": [";
    constexpr int count = 100'000;
    for (int i = 0; i < count; ++i) {
      text += (i > 0 ? ",\n    {" : "\n    {") + std::string("\n      \"time\": ") +
              std::to_string(0.01 * i) +
              ",\n      \"variable\": \"LOCALIZATION_X\",\n      \"value\": " +
              std::to_string(1000 + i) + "\n    }";
    }
    const auto scenario = read(text + "\n  ]\n}\n");
    QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
    QCOMPARE(scenario->writes.size(), std::size_t{count});
  }

  void complaintsNameFileLineAndKey_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("error");
    const auto row = [](const char* name, const std::string& text, const char* error) {
      QTest::newRow(name) << QString::fromStdString(text) << QString(error);
    };
    row("wrong type", robot("\"team\": \"red\",\n\"number\": 1, \"x\": \"0\", \"y\": 0"),
        "my.json:5: robots[1].x: must be a number in metres");
    row("number before a line break", robot("\"team\":\"red\",\"number\":1,\"y\":0,\n\"x\": 99\n"),
        "my.json:5: robots[1].x: must lie between -5.2 and 5.2 metres");
    row("one colour for both teams",
        "{\"version\": 1, \"teams\": [{\"colour\": \"red\"},\n{\"colour\": \"red\"}]}",
        "my.json:2: teams[1].colour: is also used by the other team");
    row("not an object", "[1]", "my.json:1: must be an object in braces");
    row("duration beside stop", "{\"version\": 1,\n \"duration\": 60}",
        "my.json:2: duration: stands in \"stop\": write \"stop\": {\"duration\": 60}");
    row("unknown key", "{\"version\": 1,\n \"sed\": 3}",
        "my.json:2: sed: unknown key; did you mean \"seed\"?");
    row("unknown nested key", robot("\"behavior\": \"naive\""),
        "my.json:4: robots[1].behavior: unknown key; did you mean \"behaviour\"?");
    row("key given twice", "{\"version\": 1,\n\"seed\": 3,\n\"seed\": 4}",
        "my.json:3: seed: is given twice; remove one of them");
    row("no version", "{}", "my.json:1: version: is missing");
    row("wrong version", "{\"version\": 2}",
        "my.json:1: version: is 2, but this program reads version 1; a newer program wrote this");
    row("missing key", robot("\"team\": \"red\", \"number\": 1, \"x\": 1"),
        "my.json:4: robots[1].y: is missing");
    row("duplicate id", robot("\"id\": 1, \"team\": \"red\", \"number\": 1, \"x\": 1, \"y\": 1"),
        "my.json:4: robots[1].id: robot 1 is already robots[0]");
    row("duplicate shirt", robot("\"team\": \"blue\", \"number\": 1, \"x\": 1, \"y\": 1"),
        "my.json:4: robots[1].number: blue already has a robot with number 1: robots[0]");
    row("unknown team", robot("\"team\": \"bleu\", \"number\": 1, \"x\": 1, \"y\": 1"),
        "my.json:4: robots[1].team: there is no team \"bleu\"; did you mean \"blue\"?");
    row("unknown behaviour",
        robot("\"team\": \"red\", \"number\": 1, \"x\": 1, \"y\": 1, \"behaviour\": \"naif\""),
        "my.json:4: robots[1].behaviour: there is no behaviour \"naif\"; did you mean \"naive\"?");
    row("unknown variable",
        "{\"version\":1,\"writes\":[{\"variable\":\"COM_REFERE\",\"value\":1}]}",
        "my.json:1: writes[0].variable: there is no blackboard variable \"COM_REFERE\"; did you "
        "mean "
        "\"COM_REFEREE\"?");
    row("int variable with a fraction",
        "{\"version\":1,\"writes\":[{\"variable\":\"COM_REFEREE\",\"value\":1.5}]}",
        "my.json:1: writes[0].value: must be a whole number from -2147483648 to 2147483647");
    row("write for nobody",
        "{\"version\":1,\"writes\":[{\"robot\":4,\"variable\":\"COM_REFEREE\",\"value\":1}]}",
        "my.json:1: writes[0].robot: there is no robot 4 in this scenario; leave it out to mean "
        "every "
        "robot");
    row("unknown preset", "{\"version\":1,\"noise\":\"papers\"}",
        "my.json:1: noise: there is no noise preset \"papers\"; did you mean \"paper\"?");
    row("noise of the wrong kind", "{\"version\":1,\"noise\":3}",
        "my.json:1: noise: must be the name of a noise preset, in quotes, or an object in braces");
    row("share above 1", "{\"version\":1,\"noise\":{\"missed_detection\":1.1}}",
        "my.json:1: noise.missed_detection: must lie between 0 and 1");
    row("unknown physics", "{\"version\":1,\"physics\":\"rigid\"}",
        "my.json:1: physics: there is no physics model \"rigid\"; did you mean \"rigid-body\"?");
    row("tick rate", "{\"version\":1,\"tick_rate\":0}",
        "my.json:1: tick_rate: must lie between 1 and 10000 ticks per second");
    row("negative seed", "{\"version\":1,\"seed\":-1}",
        "my.json:1: seed: must be a whole number from 0 to 18446744073709551615");
    row("flag", "{\"version\":1,\"clock_running\":1}",
        "my.json:1: clock_running: must be true or false");
    row("name", "{\"version\":1,\"name\":\"a/b\"}",
        "my.json:1: name: must consist of letters, digits, '-', '_' and '.'");
    row("list", "{\"version\":1,\"robots\":{}}",
        "my.json:1: robots: must be a list in square brackets");
    row("field that cannot be played on", "{\"version\":1,\n\"field\":{\"goal_width\":8}}",
        "my.json:2: field: This field cannot be played on: the goal is wider than the field.");
    row("deep", std::string(100, '['), "my.json:1: nested deeper than 64 levels");
    row("large", std::string(32 * 1024 * 1024 + 1, ' '),
        "my.json:1: larger than 32 MiB, the most that is read");
    const auto write = [&](const char* name, const char* variable, const char* value,
                           const char* error) {
      row(name,
          "{\"version\":1,\"writes\":[{\"variable\":\"" + std::string(variable) +
              "\",\"value\":" + value + "}]}",
          ("my.json:1: writes[0].value: must be a number" + std::string(error)).c_str());
    };
    write("label of a code", "COM_REFEREE", "\"play\"", "; write 2 for \"play\"");
    write("mistyped label", "COM_REFEREE", "\"plai\"",
          "; there is no code \"plai\"; did you mean \"play\"?");
    write("text", "VISION_BALL_DIST", "\"far\"", "");
    row("stop", "{\"version\":1,\"stop\":{\"duration\":0}}",
        "my.json:1: stop.duration: must lie between 0.001 and 1000000 seconds");
  }
  void complaintsNameFileLineAndKey() {
    QFETCH(QString, text);
    QFETCH(QString, error);
    const auto scenario = read(text.toStdString());
    QVERIFY(!scenario);
    // What follows from the first error is said behind it.
    QCOMPARE(QString::fromStdString(scenario.error().text()).section('\n', 0, 0), error);
  }

  void everyErrorIsReported() {
    const auto scenario = read(R"({"version": 1, "tick_rate": 0,
"robots": [{"team": "blu", "number": 1, "x": 0, "y": 0},
{"team": "red", "number": 0, "x": 0, "y": 0},
{"team": "red", "number": 1, "x": 0, "y": 0}],
"writes": [{"variable": "NONSENSE", "value": 1}, {"variable": "COM_REFEREE", "value": 2}]})");
    QVERIFY(!scenario);
    const QStringList reported = QString::fromStdString(scenario.error().text()).split('\n');
    QVERIFY2(reported.size() == 4, scenario.error().text().c_str());
    for (int i = 0; i < reported.size(); ++i) {
      const QString place[] = {"my.json:1: tick_rate", "my.json:2: robots[0].team",
                               "my.json:3: robots[1].number", "my.json:5: writes[0].variable"};
      QVERIFY2(reported[i].startsWith(place[i]), qPrintable(reported[i]));
    }
  }

  void whatIsNotJsonIsRefusedWithItsLine_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("empty") << QByteArray("\n\n");
    QTest::newRow("NaN") << QByteArray("{\"version\": 1,\n\n\"tick_rate\": NaN}");
    QTest::newRow("too large a number") << QByteArray("{\"version\": 1,\n\n\"tick_rate\": 1e999}");
    QTest::newRow("cut off") << QByteArray("{\"version\": 1,\n\n\"seed\":");
    QTest::newRow("bad UTF-8") << QByteArray("{\"version\": 1,\n\n\"name\": \"\xff\"}");
    QTest::newRow("trailing text") << QByteArray("{\"version\": 1\n\n} x");
  }
  void whatIsNotJsonIsRefusedWithItsLine() {
    QFETCH(QByteArray, text);
    const auto scenario = read(text.toStdString());
    QVERIFY(!scenario);
    const std::string error = scenario.error().text();
    QVERIFY2(error.starts_with("my.json:3: not valid JSON: ") ||
                 (QTest::currentDataTag() == QByteArray("empty") && error.starts_with("my.json:")),
             error.c_str());
  }

  void changedFilesNeverCrash() {
    const std::string good = scenarioToJson(*loadScenario("scenario-1"));
    std::mt19937 random(7);
    const std::string alphabet = "{}[]\",:0123456789.-eE+tfn\\\n \x80\xff";
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
      std::string text = good;
      for (int change = 0; change < 1 + i % 4; ++change) {
        const std::size_t at = random() % text.size();
        switch (random() % 4) {
          case 0:
            text[at] = alphabet[random() % alphabet.size()];
            break;
          case 1:
            text.erase(at, 1 + random() % 20);
            break;
          case 2:
            text.insert(at, 1, alphabet[random() % alphabet.size()]);
            break;
          default:
            text.insert(at, text.substr(random() % text.size(), random() % 40));
            break;
        }
        if (text.empty()) text = " ";
      }
      const auto scenario = read(text);
      if (scenario) {
        QVERIFY(read(scenarioToJson(*scenario)));
      } else {
        ++refused;
        QVERIFY(scenario.error().context.starts_with("my.json:"));
      }
    }
    QVERIFY(refused > 1000);
  }

  void missingFilesAndNames() {
    QCOMPARE(loadScenario("match-3v").error().message,
             std::string("there is no built-in scenario and no file \"match-3v\"; did you mean "
                         "\"match-3v3\"?"));
    QVERIFY(
        loadScenario("/nonexistent/a.json").error().text().starts_with("/nonexistent/a.json: "));
    QVERIFY(!loadScenario("/"));
  }

  void everyKeyIsDocumented() {
    QFile file(QString(PITCHBOARD_SOURCE_DIR) + "/docs/scenarios.md");
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray text = file.readAll();
    Scenario all;  // every key differs from its default, so that the writer names it
    sim::NoiseParameters& n = all.settings.noise;
    for (double* value :
         {&n.forward, &n.sideways, &n.rotation, &n.kickSpeed, &n.kickAngle, &n.visionDistance,
          &n.visionBearing, &n.robotDistance, &n.robotBearing, &n.landmarkBearing,
          &n.landmarkProbability, &n.missedDetection, &n.visionDelay, &n.imuWhite, &n.imuDrift}) {
      *value = 0.123;
    }
    const QString written = QString::fromStdString(scenarioToJson(all));
    for (const QString& part : written.split('"')) {
      if (part.contains('_')) QVERIFY2(text.contains('`' + part.toUtf8() + '`'), qPrintable(part));
    }
  }
};

PITCHBOARD_TEST(TestScenario)

}  // namespace tst_scenario

#include "tst_scenario.moc"

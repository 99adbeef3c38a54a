// SPDX-License-Identifier: GPL-3.0-or-later

// Calibration from recordings: what is read of them, how it copes with bad ones, the file it makes.
// How often its intervals hold is measured by the program calibration_proof.

#include <QtTest>

#include <cmath>
#include <numbers>
#include <random>

#include <robotlink/calibrate/calibration_file.h>

#include "../support/calibration_trial.h"
#include "../support/group_facts.h"
#include "../support/sanitized.h"
#include "calibration_check.h"
#include "executed_actions.h"
#include "motion_parameters.h"
#include "motion_start.h"
#include "posterior_grid.h"

namespace tst_calibrate {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

sim::RobotModel kidSize() {
  return *loadRobotModel("kid-size");
}

Scenario drill(double duration = 0.0) {
  Scenario scenario = *loadScenario("calibration-drill");
  if (duration > 0.0) scenario.stop.duration = duration;
  return scenario;
}

CalibrationLog logOf(const Scenario& scenario, const RecordingOptions& options = {}) {
  const auto rows = recorded(scenario, options);
  return *readCalibrationLog(**rows, scenario.settings.field, "drill", "B1");
}

bool mentions(const Calibration& calibration, const std::string& words) {
  return std::ranges::any_of(calibration.notes, [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

/// Near enough for a test of how bad rows are coped with.
bool isNear(const Calibration& calibration, const char* key, double truth, double share) {
  const CalibratedValue* value = calibration.find(key);
  if (value == nullptr) qWarning("%s was not estimated", key);
  if (value != nullptr && std::abs(value->value - truth) > share * truth) {
    qWarning("%s is %g, not %g", key, value->value, truth);
  }
  return value != nullptr && std::abs(value->value - truth) <= share * truth;
}

}  // namespace

class TestCalibrate : public QObject {
  Q_OBJECT

 private slots:
  void samplesAreCountedInText() {
    QCOMPARE(samplesText({"turn", 1, 1, 1, 1, "actions"}), std::string("1 action"));
    QCOMPARE(samplesText({"turn", 1, 1, 1, 2, "actions"}), std::string("2 actions"));
    QCOMPARE(samplesText({"noise.landmark_probability", 1, 1, 1, 1, "corners in view"}),
             std::string("1 corner in view"));
  }

  void gridPosteriorsAreThoseOfClosedForms() {
    // A normal likelihood of the logarithm times the prior: normal again.
    const double sigma = 0.35, error = 0.05, median = 2.0, seen = std::log(2.5);
    const auto posterior = positivePosterior(median, sigma, [&](double value) {
      const double z = (std::log(value) - seen) / error;
      return -0.5 * z * z;
    });
    const double precision = 1.0 / (sigma * sigma) + 1.0 / (error * error);
    const double mean = (std::log(median) / (sigma * sigma) + seen / (error * error)) / precision;
    const double half = 1.959964 / std::sqrt(precision);
    QVERIFY(std::abs(std::log(posterior.median) - mean) < 1e-3);
    QVERIFY(std::abs(std::log(posterior.low) - (mean - half)) < 2e-3);
    QVERIFY(std::abs(std::log(posterior.high) - (mean + half)) < 2e-3);
    // A cell that the prior fills evenly: 2.5 % are left off at either end.
    const auto cell = positivePosterior(
        1.0, 10.0, [](double value) { return value > 1.0 && value <= 1.01 ? 0.0 : -1e3; }, 400001);
    QVERIFY(std::abs(cell.low - 1.00025) < 2e-4);
    QVERIFY(std::abs(cell.high - 1.00975) < 2e-4);
  }

  /// The estimators read variables of the blackboard, never a truth column.
  void truthIsNeverRead() {
    const QDir folder(QStringLiteral(PITCHBOARD_SOURCE_DIR "/robotlink/laboratory/calibrate/src"));
    const QStringList files = folder.entryList({"*.cpp", "*.h"});
    QVERIFY(files.size() > 8);
    for (const QString& name : files) {
      QFile file(folder.filePath(name));
      QVERIFY(file.open(QIODevice::ReadOnly));
      const QByteArray text = file.readAll();
      for (const char* column : {"TRUE_", "HEAD_YAW", "\"ACTION\"", "FALLEN\"", "BELIEF_ERROR",
                                 "BELIEF_X", "BALL_VX", "snapshot"}) {
        QVERIFY2(!text.contains(column), qPrintable(name + " names " + column));
      }
    }
  }

  void theDrillIsCalibrated() {
    const auto trial = playCalibrationTrial(10001, 0.0);
    QVERIFY2(trial.has_value(), trial ? "" : trial.error().text().c_str());
    const Calibration& c = trial->calibration;
    for (const char* key : {"forward_fast", "backward_fast", "sideways"}) {
      QVERIFY(isNear(c, key, trial->truth(key), 0.1));
    }
    QVERIFY(isNear(c, "turn", trial->truth("turn"), 0.02));
    QVERIFY(isNear(c, "noise.imu_white", trial->truth("noise.imu_white"), 0.05));
    QVERIFY(isNear(c, "noise.robot_distance", trial->truth("noise.robot_distance"), 0.3));
    QVERIFY(c.kept.contains("kick_speed"));
    QVERIFY(c.kept.contains("mass"));
    QVERIFY(trial->rms() < trial->rmsBase());
    QVERIFY(c.check.windows.size() > 5);
    // Every number is either estimated or listed with the reason.
    for (const std::string& key : calibrationKeys()) {
      QVERIFY2((c.find(key) != nullptr) != c.kept.contains(key), key.c_str());
    }
    for (const CalibratedValue& value : c.values) {
      QVERIFY2(value.low < value.value && value.value < value.high && value.samples > 0,
               value.key.c_str());
    }
    fileAndReport(c);
  }

  /// The robot walks faster than the base model at once, and then turns while its images are late.
  void theStartDependsOnNeitherGaitNorDelay() {
    Scenario scenario = drill(20.0);
    sim::RobotModel fast = kidSize();
    fast.forwardFast *= 1.6;
    fast.noise.visionDelay = 0.2;
    scenario.robots.front().model = fast;
    scenario.writes = {{RobotId{1}, "DECISION_LOCALIZATION", 1.0, 0.0},
                       {RobotId{1}, "DECISION_ACTION_B", 10.0, 0.0},
                       {RobotId{1}, "DECISION_ACTION_A", 1.0, 0.0},
                       {RobotId{1}, "DECISION_ACTION_A", 2.0, 4.0}};
    scenario.robots.front().pose = {{-2.0, -0.5}, 2.0};
    const CalibrationLog log = logOf(scenario);
    const auto actions = executedActions(log, kidSize());
    const Pose truth = scenario.robots.front().pose;
    const auto error = [&](double gaitSpread, double delay) {
      const auto start = startFromCorners(log, actions, kidSize(), gaitSpread, delay, 0);
      return start ? std::hypot(start->pose.position.x - truth.position.x,
                                start->pose.position.y - truth.position.y)
                   : 100.0;
    };
    QVERIFY2(error(speedPrior, 0.2) < 0.15, qPrintable(QString::number(error(speedPrior, 0.2))));
    QVERIFY(error(1e-3, 0.2) > 0.3);        // the gait of the base model is trusted
    QVERIFY(error(speedPrior, 0.0) > 0.3);  // corners are taken to be where they were seen before
  }

  void badRecordings_data() {
    QTest::addColumn<QString>("what");
    for (const char* what : {"20 Hz", "gap", "IMU reset", "carried"}) QTest::newRow(what) << what;
  }
  void badRecordings() {
    QFETCH(QString, what);
    const Scenario scenario = drill();
    RecordingOptions options;
    if (what == "20 Hz") options.everyNth = 3;
    if (what == "IMU reset") {
      options.at = [](SimulatedMatch& match, std::uint64_t tick) {
        if (tick != 7100) return;  // turned away
        Blackboard* board = match.blackboard(RobotId{1});
        writeIfPresent(*board, match.variables().imuReset, 1);
      };
    }
    if (what == "carried") {
      options.at = [](SimulatedMatch& match, std::uint64_t tick) {
        if (tick == 3900) (void)match.simulation().placeRobot(RobotId{1}, {{-2.0, 1.5}, -0.5});
      };
    }
    CalibrationLog log = logOf(scenario, options);
    if (what == "gap") {
      std::erase_if(log.rows,
                    [](const CalibrationRow& row) { return row.time > 66.0 && row.time < 70.0; });
      log.robots.clear();
      log.sightings.clear();
    }
    const auto calibration = calibrate(std::span(&log, 1), kidSize());
    QVERIFY2(calibration.has_value(), calibration ? "" : calibration.error().text().c_str());
    const sim::RobotModel truth = kidSize();
    QVERIFY(isNear(*calibration, "forward_fast", truth.forwardFast, 0.15));
    QVERIFY(isNear(*calibration, "turn", truth.turn, 0.03));
    if (what == "20 Hz") {
      QVERIFY(mentions(*calibration, "20 Hz"));
      QVERIFY(calibration->kept.contains("vision_range"));
    }
    if (what == "gap") QVERIFY(calibration->leftOut.contains("gaps"));
    if (what == "IMU reset") QVERIFY(mentions(*calibration, "Resets of the IMU"));
    if (what == "carried") QVERIFY(mentions(*calibration, "outliers"));
  }

  /// Another robot that it never sees pushes it aside every 12 s: that is no noise of its gait.
  void unseenPushesAreLeftOut() {
#if PITCHBOARD_SANITIZED
    QSKIP("takes minutes; the others run the same code");
#endif
    RecordingOptions options;
    options.at = [](SimulatedMatch& match, std::uint64_t tick) {
      if (tick < 1200 || tick % 720 != 0) return;
      Pose pose = match.simulation().snapshot().robots.front().pose;
      pose.position.x -= 0.3 * std::sin(pose.yaw);
      pose.position.y += 0.3 * std::cos(pose.yaw);
      (void)match.simulation().placeRobot(RobotId{1}, pose);
    };
    const CalibrationLog log = logOf(drill(140.0), options);
    const auto calibration = calibrate(std::span(&log, 1), kidSize());
    QVERIFY2(calibration.has_value(), calibration ? "" : calibration.error().text().c_str());
    const char* unseen = "moved by something that it did not see";
    QVERIFY(calibration->leftOut.contains(unseen));
    QVERIFY(calibration->leftOut.at(unseen).stretches >= 3);
    for (const char* key : {"noise.forward", "noise.sideways"}) {
      const CalibratedValue* noise = calibration->find(key);
      QVERIFY2(noise == nullptr || noise->low < 2.0 * kidSize().noise.forward, key);
    }
    QVERIFY(isNear(*calibration, "forward_fast", kidSize().forwardFast, 0.1));
  }

  /// Others roll the ball away every 15 s: it tells nothing while it rolls.
  void aBallThatOthersMoveTellsNothing() {
#if PITCHBOARD_SANITIZED
    QSKIP("takes minutes; the others run the same code");
#endif
    RecordingOptions options;
    options.at = [](SimulatedMatch& match, std::uint64_t tick) {
      if (tick < 1200 || tick % 900 >= 60) return;
      Point ball = match.simulation().snapshot().ball;
      ball.y += (tick / 900) % 2 == 0 ? 0.01 : -0.01;
      (void)match.simulation().placeBall(ball);
    };
    const CalibrationLog log = logOf(drill(140.0), options);
    const auto calibration = calibrate(std::span(&log, 1), kidSize());
    QVERIFY2(calibration.has_value(), calibration ? "" : calibration.error().text().c_str());
    QVERIFY(mentions(*calibration, "Moves of the ball by others"));
    const sim::NoiseParameters truth = kidSize().noise;
    QVERIFY(isNear(*calibration, "noise.landmark_bearing", truth.landmarkBearing, 0.1));
    QVERIFY(isNear(*calibration, "noise.vision_bearing", truth.visionBearing, 0.1));
    const CalibratedValue* noise = calibration->find("noise.forward");
    QVERIFY(noise == nullptr || noise->low < 2.0 * truth.forward);
  }

  /// A robot that is not at all like its base model: said for what moved, and for nothing else.
  void whatThePriorHardlyAllowsIsSaid() {
    const CalibrationLog log = logOf(drill(140.0));
    sim::RobotModel base = kidSize();
    QVERIFY(beyondPriorTexts(calibrate(std::span(&log, 1), base).value()).empty());
    base.forwardFast *= 3.0;
    const Calibration calibration = calibrate(std::span(&log, 1), base).value();
    const std::vector<std::string> texts = beyondPriorTexts(calibration);
    QVERIFY(!texts.empty());
    QVERIFY2(texts.front().starts_with("forward_fast is 0.3"), texts.front().c_str());
    QVERIFY(std::ranges::count(calibration.notes, texts.front()) == 1);
  }

  /// Walks against a wall for some seconds: that says nothing about its gait.
  void wallsDoNotSlowTheGaitDown() {
    Scenario scenario = drill(140.0);
    scenario.robots.front().pose = {{3.5, -2.0}, 0.0};
    const CalibrationLog log = logOf(scenario);
    const auto calibration = calibrate(std::span(&log, 1), kidSize());
    QVERIFY2(calibration.has_value(), calibration ? "" : calibration.error().text().c_str());
    QVERIFY(isNear(*calibration, "forward_fast", kidSize().forwardFast, 0.1));
    QVERIFY(isNear(*calibration, "backward_fast", kidSize().backwardFast, 0.1));
    const char* touching = "possibly touching the ball, another robot, a goal or a wall";
    QVERIFY(calibration->leftOut.contains(touching));
    QVERIFY(calibration->leftOut.at(touching).stretches >= 1);
    const CalibratedValue* noise = calibration->find("noise.forward");
    QVERIFY(noise == nullptr || noise->value < 2.0 * kidSize().noise.forward);
  }

  /// A team-mate that knows its place says where it sees the robot.
  void sightingsOfTeamMatesLocateTheRobot() {
    telemetry::SeriesStore store;
    const auto groupOf = [&](const char* name, const char* number,
                             const std::vector<const char*>& columns) {
      telemetry::GroupInfo info;
      info.name = name;
      info.robot = telemetry::facts({{"team", "blue"}, {"robot", number}});
      for (const char* column : columns) info.columns.emplace_back().name = column;
      return store.addGroup(info);
    };
    const auto robot = groupOf("B1", "1", {"CONTROL_ACTION"});
    const auto mate = groupOf("B2", "2",
                              {"LOCALIZATION_X", "LOCALIZATION_Y", "LOCALIZATION_THETA",
                               "LOCALIZATION_BELIEF", "VISION_RBT01_DIST", "VISION_RBT01_ANGLE"});
    // At (0.9, 1.2), facing the left goal; the robot is 2 m in front of it and then to its right.
    for (int i = 0; i < 4; ++i) {
      const double action = 0.0;
      store.append(robot, {0.1 * i, {}, {&action, 1}});
      const double lost = i == 3 ? 80.0 : 10.0;  // whoever is lost is no reference
      const std::array<double, 6> row{540.0, 180.0, 180.0, lost, 200.0 + i, i == 2 ? 90.0 : 0.0};
      store.append(mate, {0.1 * i, {}, row});
    }
    const Scenario scenario = drill(60.0);
    const auto withAgreement = readCalibrationLog(store, scenario.settings.field, "two", "B1");
    QVERIFY2(withAgreement.has_value(), withAgreement ? "" : withAgreement.error().text().c_str());
    // The first value may be as old as the blackboard.
    QCOMPARE(withAgreement->sightings.size(), std::size_t(2));
    QVERIFY(std::abs(withAgreement->sightings[0].place.x - (0.9 - 2.01)) < 1e-9);
    QVERIFY(std::abs(withAgreement->sightings[0].place.y - 1.2) < 1e-9);
    QVERIFY(std::abs(withAgreement->sightings[1].place.x - 0.9) < 1e-9);
    QVERIFY(std::abs(withAgreement->sightings[1].place.y - (1.2 + 2.02)) < 1e-9);

    // A robot that sees no corners and does not know where it is any more, but is seen.
    CalibrationLog log = logOf(scenario);
    log.sightings.clear();
    for (std::size_t i = 0; i < log.rows.size(); ++i) {
      CalibrationRow& row = log.rows[i];
      row.corners = {};
      if (row.time < 1.0 || !row.belief) continue;
      if (i % 30 == 0) log.sightings.push_back({i, "B2", row.belief->pose.position, 2.0, 0.1});
      row.belief.reset();
    }
    QVERIFY(log.sightings.size() > 50);
    const auto calibration = calibrate(std::span(&log, 1), kidSize());
    QVERIFY2(calibration.has_value(), calibration ? "" : calibration.error().text().c_str());
    const auto sense = std::ranges::find(calibration->residuals, "seen by team-mates",
                                         &CalibrationResiduals::sense);
    QVERIFY(sense != calibration->residuals.end());
    // Two coordinates every 2 s: what is closer together shares the error of the team-mate's place.
    QVERIFY(sense->count > 20 && sense->count <= 60);
  }

  /// A constant bias is no correlation: independent values stay independent about another mean.
  void residualsOfABiasedSensorAreUncorrelated() {
    for (const double bias : {0.0, 1.0, -5.0}) {
      std::mt19937 random(3);
      std::normal_distribution<double> noise(bias, 1.0);
      MotionFit motion;
      auto& innovations = motion.ofLogs.emplace_back().innovations;
      for (std::uint32_t i = 0; i < 20'000; ++i) {
        innovations.push_back({noise(random), 1.0, i, Sense::BallBearing});
      }
      Calibration out;
      describeResiduals(motion, out);
      QCOMPARE(out.residuals.size(), std::size_t{1});
      QVERIFY(std::abs(out.residuals[0].mean - bias) < 0.05);
      QVERIFY(std::abs(out.residuals[0].deviation - 1.0) < 0.05);
      QVERIFY2(std::abs(out.residuals[0].autocorrelation) < 0.05,
               std::to_string(out.residuals[0].autocorrelation).c_str());
    }
  }

  /// One row a second, as some teams' telemetry: whatever it does not show is listed.
  void oneRowASecond() {
    RecordingOptions options;
    options.everyNth = 60;
    const CalibrationLog log = logOf(drill(), options);
    const auto calibration = calibrate(std::span(&log, 1), kidSize());
    if (!calibration) {
      QCOMPARE(calibration.error().code, ErrorCode::NotFound);
      return;
    }
    for (const char* key : {"vision_range", "field_of_view", "kick_time"}) {
      QVERIFY2(calibration->kept.contains(key), key);
    }
    for (const CalibratedValue& value : calibration->values) {
      QVERIFY2(std::isfinite(value.low) && std::isfinite(value.high), value.key.c_str());
    }
  }

  void whatCannotBeUsedIsAnError() {
    const Scenario scenario = drill(5.0);
    const auto rows = recorded(scenario);
    const auto absent = readCalibrationLog(**rows, scenario.settings.field, "drill", "R7");
    QVERIFY(!absent);
    QCOMPARE(absent.error().code, ErrorCode::NotFound);
    QVERIFY(absent.error().message.find("B1") != std::string::npos);

    telemetry::SeriesStore other;
    telemetry::GroupInfo info;
    info.name = "B1";
    info.columns.resize(1);
    info.columns[0].name = "TEMPERATURE";
    info.robot.emplace().team = TeamColor::Blue;
    const auto group = other.addGroup(info);
    for (int i = 0; i < 10; ++i) {
      const double value = i;
      other.append(group, {0.1 * i, {}, {&value, 1}});
    }
    const auto useless = readCalibrationLog(other, scenario.settings.field, "other", "B1");
    QVERIFY(!useless);
    QCOMPARE(useless.error().code, ErrorCode::InvalidArgument);
    QVERIFY(useless.error().message.find("DECISION_ACTION_A") != std::string::npos);

    // Standing tells of the IMU, and of no speed.
    const auto log = readCalibrationLog(**rows, scenario.settings.field, "drill", "B1");
    const auto stood = calibrate(std::span(&*log, 1), kidSize(), {0.5});
    QVERIFY2(stood.has_value(), stood ? "" : stood.error().text().c_str());
    QVERIFY(stood->kept.contains("forward_fast"));
    QVERIFY(stood->find("noise.imu_white") != nullptr);
    QVERIFY(!calibrate({}, kidSize()).has_value());
    QVERIFY(!calibrate(std::span(&*log, 1), kidSize(), {0.9}).has_value());
    const auto cancelled =
        calibrate(std::span(&*log, 1), kidSize(), {}, [](double) { return false; });
    QVERIFY(!cancelled);
    QCOMPARE(cancelled.error().code, ErrorCode::Conflict);
  }

 private:
  static void fileAndReport(const Calibration& c) {
    const std::string text = calibrationToJson(c, "test");
    const auto model = robotModelFromText(text, "robot.json");
    QVERIFY2(model.has_value(), model ? "" : model.error().text().c_str());
    for (const auto& parameter : sim::robotModelParameters) {
      const double number = c.model.*parameter.member;
      QVERIFY2(std::abs((*model).*parameter.member - number) <= 1e-12 * std::abs(number),
               parameter.key);
    }
    QVERIFY(text.find("\"kept\"") != std::string::npos);
    std::string bad = text;
    bad.replace(bad.find("\"version\": 1"), 12, "\"version\": 2");
    const auto refused = robotModelFromText(bad, "robot.json");
    QVERIFY(!refused);
    QVERIFY(refused.error().text().find("calibration.version") != std::string::npos);
    const std::string page = calibrationReport(c, drill().settings.field);
    for (const char* words : {"<h2>Values</h2>", "forward_fast", "Not estimated", "Residuals",
                              "Simulated trajectories over recorded ones", "</html>"}) {
      QVERIFY2(page.find(words) != std::string::npos, words);
    }
  }
};

}  // namespace tst_calibrate

QTEST_GUILESS_MAIN(tst_calibrate::TestCalibrate)

#include "tst_calibrate.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// Experiment files: what they mean, and what is said of mistakes in them.

#include <QtTest>

#include <algorithm>

#include <robotlink/experiment/situation_test.h>

#include "experiment_rig.h"

namespace tst_experiment_file {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace experiment_rig;

class TestExperimentFile : public QObject {
  Q_OBJECT

 private slots:
  void builtInFilesAreGood();
  void errorsNameTheLineAndTheKey_data();
  void errorsNameTheLineAndTheKey();
  void gridsAreEveryCombination();
  void conditionsShareSeedsAndStarts();
  void drawnSettingsAreInTheirRange();
};

void TestExperimentFile::builtInFilesAreGood() {
  const auto all = builtInExperiments(), situations = builtInSituations();
  QVERIFY(all.size() >= 2);
  QCOMPARE(situations.size(), std::size_t{8});
  for (const auto* list : {&all, &situations}) {
    for (const ExperimentName& one : *list) {
      const auto loaded = loadExperiment(one.name);
      QVERIFY2(loaded.has_value(), loaded ? "" : loaded.error().text().c_str());
      QCOMPARE(loaded->name, one.name);
      QVERIFY(!loaded->title.empty());
    }
  }
  for (const ExperimentName& one : situations) {
    QVERIFY(!loadExperiment(one.name)->assertions.empty());
  }
}

void TestExperimentFile::errorsNameTheLineAndTheKey_data() {
  QTest::addColumn<QString>("what");
  QTest::addColumn<QString>("by");
  QTest::addColumn<QString>("error");
  QTest::newRow("no metric") << "p95(nearest_cm)"
                             << "p95(nearst_cm)"
                             << "there is no metric \"nearst_cm\"; did you mean \"nearest_cm\"?";
  QTest::newRow("range") << "\"runs\": 4"
                         << "\"runs\": 0"
                         << "test.json:7: runs:";
  QTest::newRow("key") << "\"seed\": 7"
                       << "\"sed\": 7"
                       << "test.json:7: sed";
  QTest::newRow("scenario key") << "\"noise.forward\": 0.01"
                                << "\"noise.forwrd\": 0.01"
                                << "test.json:10: condition \"noisy\": noise.forwrd";
  QTest::newRow("scenario value") << "\"noise\": \"none\""
                                  << "\"noise\": \"nome\""
                                  << "test.json:9: condition \"plain\": noise";
  QTest::newRow("robot") << "\"robots\": {\"x\": 0.1"
                         << "\"B2\": {\"x\": 0.1"
                         << "there is no robot \"B2\" in this scenario; there are: B1";
  QTest::newRow("condition") << "\"condition\": \"plain\""
                             << "\"condition\": \"plan\""
                             << "there is no condition plan";
  QTest::newRow("expression") << "B1.TRUE_BALL_DIST"
                              << "B1.TRUE_BALL_DIST +"
                              << "test.json:13: metrics: nearest_cm: the expression is incomplete";
  QTest::newRow("stop key") << "\"noise.forward\""
                            << "\"stop.duration\""
                            << "\"stop\" is set by the experiment itself";
  QTest::newRow("random beyond what is allowed")
      << "\"starts\""
      << "\"random\": {\"noise.forward\": {\"from\": 0, \"to\": 1e9}},\n \"starts\""
      << "test.json:12: random.noise.forward: 381966000 cannot be used in condition \"plain\"";
  QTest::newRow("random that is no whole number")
      << "\"starts\""
      << "\"random\": {\"robots[B1].number\": {\"from\": 1, \"to\": 3}},\n \"starts\""
      << "test.json:12: random.robots[B1].number: 1.763932 cannot be used";
  QTest::newRow("random of nobody")
      << "\"starts\""
      << "\"random\": {\"robots[R4].x\": {\"from\": 1, \"to\": 3}},\n \"starts\""
      << "test.json:12: random.robots[R4].x: 1 cannot be used in condition \"plain\": there is no "
         "robot R4";
  QTest::newRow("name twice") << "\"name\": \"noisy\""
                              << "\"name\": \"plain\""
                              << "another condition has this name";
}

void TestExperimentFile::errorsNameTheLineAndTheKey() {
  QFETCH(QString, what);
  QFETCH(QString, by);
  QFETCH(QString, error);
  const auto made =
      experimentFromJson(replaced(shortMatch, what.toStdString(), by.toStdString()), "test.json");
  QVERIFY(!made);
  const QString text = QString::fromStdString(made.error().text());
  QVERIFY2(text.contains(error), qPrintable(text));
}

void TestExperimentFile::gridsAreEveryCombination() {
  const Experiment e = experimentFrom(replaced(
      replaced(shortMatch, ", \"condition\": \"plain\"", ""), "\"starts\"",
      "\"grid\": {\"physics\": [\"published\", \"rigid-body\"], \"robots[*].y\": [0, 1, 2]}, "
      "\"starts\""));
  QCOMPARE(e.conditions.size(), std::size_t{12});
  QCOMPARE(e.allRuns(), std::size_t{48});
  QCOMPARE(e.conditions[0].name, std::string("plain, physics = published, robots[*].y = 0"));
  QCOMPARE(e.conditions[11].name, std::string("noisy, physics = rigid-body, robots[*].y = 2"));
  QCOMPARE(e.conditions[5].scenario.robots[0].pose.position.y, 2.0);
  QCOMPARE(e.conditions[5].scenario.settings.physics, std::string("rigid-body"));
}

void TestExperimentFile::conditionsShareSeedsAndStarts() {
  const Experiment common = experimentFrom(shortMatch);
  const Experiment apart = experimentFrom(
      replaced(shortMatch, "\"seed\": 7", "\"seed\": 7, \"common_random_numbers\": false"));
  const auto plain = scenarioOf(common, placeOf(common, 2)),
             noisy = scenarioOf(common, placeOf(common, 6));
  QCOMPARE(plain->settings.seed, std::uint64_t{8});
  QCOMPARE(noisy->settings.seed, std::uint64_t{8});
  QCOMPARE(plain->robots[0].pose, noisy->robots[0].pose);
  QVERIFY(plain->robots[0].pose != common.conditions[0].scenario.robots[0].pose);
  QVERIFY(std::abs(plain->robots[0].pose.position.x) <= 0.1);
  QCOMPARE(plain->settings.noise.forward, 0.0);
  QCOMPARE(noisy->settings.noise.forward, 0.01);
  QCOMPARE(seedOf(apart, placeOf(apart, 6)), std::uint64_t{12});
}

void TestExperimentFile::drawnSettingsAreInTheirRange() {
  const Experiment e = experimentFrom(
      replaced(shortMatch, "\"starts\"",
               "\"random\": {\"noise.vision_bearing\": {\"from\": 1, \"to\": 4}}, \"starts\""));
  double least = 10.0, most = 0.0;
  for (std::size_t index = 0; index < 200; ++index) {
    const auto scenario = scenarioOf(e, {1, 0, index});
    QVERIFY(scenario.has_value());
    // Stored in radians.
    const double drawn = scenario->settings.noise.visionBearing * 180.0 / 3.14159265358979323846;
    least = std::min(least, drawn);
    most = std::max(most, drawn);
  }
  QVERIFY(least >= 1.0 && least < 1.1);
  QVERIFY(most <= 4.0 && most > 3.9);
}

PITCHBOARD_TEST(TestExperimentFile)

}  // namespace tst_experiment_file

#include "tst_experiment_file.moc"

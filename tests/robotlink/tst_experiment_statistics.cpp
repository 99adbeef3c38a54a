// SPDX-License-Identifier: GPL-3.0-or-later

// The statistics of experiments against published tables, the paper's own test, and values worked
// out by hand; assertions over metrics.

#include <QtTest>
#include <cmath>
#include <limits>

#include <robotlink/experiment/statistics.h>

#include "checks.h"

namespace tst_experiment_statistics {

using namespace pitchboard::link;

namespace {

bool near(double value, double expected, double tolerance) {
  return std::abs(value - expected) <= tolerance;
}

}  // namespace

class TestExperimentStatistics : public QObject {
  Q_OBJECT

 private slots:
  void momentsAndQuantiles();
  void welchOfThePaper();
  void welchAgainstTables_data();
  void welchAgainstTables();
  void rateThatNeverVaries();
  void bootstrapIsThatOfTheMean();
  void pairsAndHistograms();
  void checksReadStatistics();
  void checksRefuseWhatTheyDoNotKnow();
};

void TestExperimentStatistics::momentsAndQuantiles() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> values{4, nan, 1, 3, 2, 10};
  const SampleMoments moments = momentsOf(values);
  QCOMPARE(moments.count, std::size_t{5});
  QCOMPARE(moments.mean, 4.0);
  QVERIFY(near(moments.deviation, std::sqrt(12.5), 1e-12));  // (0+9+1+4+36)/4
  const std::vector<double> sorted{1, 2, 3, 4, 10};
  QCOMPARE(quantile(sorted, 0.5), 3.0);
  QVERIFY(near(quantile(sorted, 0.95), 8.8, 1e-12));  // between 4 and 10, at 3.8
  QVERIFY(std::isnan(quantile({}, 0.5)));
  QCOMPARE(summaryOf(values).most, 10.0);
}

/// Simulated with errors against the real robot: the paper gives t = 1.37, and the critical values
/// 1.69 and 2.03.
void TestExperimentStatistics::welchOfThePaper() {
  const auto test = welchTest({879.77, 101.40, 30}, {848.40, 42.82, 10});
  QVERIFY(test.has_value());
  QVERIFY(near(test->t, 1.37, 0.005));
  QVERIFY(near(test->criticalOne, 1.69, 0.005));
  QVERIFY(near(test->criticalTwo, 2.03, 0.005));
  QVERIFY(near(test->freedom, 35.5, 0.1));
  QVERIFY(test->p > 0.05);
}

void TestExperimentStatistics::welchAgainstTables_data() {
  QTest::addColumn<int>("n");  // of each sample: 2n - 2 degrees of freedom
  QTest::addColumn<double>("oneTailed");
  QTest::addColumn<double>("twoTailed");
  // Student's t, 5 %: any table.
  QTest::newRow("2") << 2 << 2.920 << 4.303;
  QTest::newRow("10") << 6 << 1.812 << 2.228;
  QTest::newRow("20") << 11 << 1.725 << 2.086;
  QTest::newRow("30") << 16 << 1.697 << 2.042;
  QTest::newRow("120") << 61 << 1.658 << 1.980;
}

void TestExperimentStatistics::welchAgainstTables() {
  QFETCH(int, n);
  QFETCH(double, oneTailed);
  QFETCH(double, twoTailed);
  const auto count = static_cast<std::size_t>(n);
  // A difference of exactly the critical value: p is 5 %.
  const double error = std::sqrt(2.0 * 3.0 * 3.0 / n);
  const auto test = welchTest({twoTailed * error, 3.0, count}, {0.0, 3.0, count});
  QVERIFY(test.has_value());
  QVERIFY(near(test->freedom, 2.0 * n - 2.0, 1e-9));
  QVERIFY(near(test->criticalOne, oneTailed, 0.0006));
  QVERIFY(near(test->criticalTwo, twoTailed, 0.0006));
  QVERIFY(near(test->p, 0.05, 0.0002));
  QVERIFY(near(test->difference95.low, 0.0, 0.01));
  const double small = 1.0 - 3.0 / (4.0 * 2.0 * n - 9.0);
  QVERIFY(near(test->hedgesG, small * twoTailed * error / 3.0, 1e-12));
  QVERIFY(!welchTest({1.0, 0.0, 5}, {2.0, 0.0, 5}));
  QVERIFY(!welchTest({1.0, 1.0, 1}, {2.0, 1.0, 5}));
}

void TestExperimentStatistics::rateThatNeverVaries() {
  // Clopper and Pearson for 0 of 10 and 10 of 10: 1 - 0.025^(1/10) = 0.30850.
  const auto none = intervalOfMean(std::vector<double>(10, 0.0));
  const auto all = intervalOfMean(std::vector<double>(10, 1.0));
  QCOMPARE(none->low, 0.0);
  QVERIFY(near(none->high, 0.30850, 1e-5));
  QVERIFY(near(all->low, 0.69150, 1e-5));
  QCOMPARE(all->high, 1.0);
  const auto flat = intervalOfMean(std::vector<double>(5, 2.5));
  QCOMPARE(flat->low, 2.5);
  QVERIFY(!intervalOfMean(std::vector<double>{1.0}));
}

void TestExperimentStatistics::bootstrapIsThatOfTheMean() {
  std::vector<double> rate(400, 0.0), ramp(400);
  std::fill_n(rate.begin(), 200, 1.0);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = double(i);
  // 1.96 standard errors: 0.5/20, and 399/sqrt(12)/20 of a uniform distribution.
  const auto of = [](const std::vector<double>& values) { return *intervalOfMean(values); };
  QVERIFY(near(of(rate).low, 0.5 - 0.049, 0.006) && near(of(rate).high, 0.5 + 0.049, 0.006));
  QVERIFY(near(of(ramp).low, 199.5 - 11.3, 1.5) && near(of(ramp).high, 199.5 + 11.3, 1.5));
  QVERIFY(of(ramp) == of(ramp));
}

void TestExperimentStatistics::pairsAndHistograms() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> a{1, 2, nan, 4}, b{0, 0, 1, 1};
  const PairedDifference pairs = pairedDifference(a, b);
  QCOMPARE(pairs.pairs, std::size_t{3});
  QCOMPARE(pairs.mean, 2.0);
  QVERIFY(pairs.mean95->low >= 1.0 && pairs.mean95->high <= 3.0);
  QVERIFY(!pairedDifference(b, b).mean95);
  QCOMPARE(histogram(std::vector<double>{0, 0.1, 0.5, 1, nan, 2}, 0, 1, 2),
           (std::vector<std::size_t>{2, 2}));
}

void TestExperimentStatistics::checksReadStatistics() {
  const std::vector<MetricInfo> metrics{{"goal", "", "", true}, {"error_m", "m", "", false}};
  auto check = Check::parse("goal_rate >= 0.5 && p95( error_m ) < 0.3e0 + mean(error_m) * 0",
                            Check::Over::Condition, metrics);
  QVERIFY2(check.has_value(), check ? "" : check.error().text().c_str());
  QCOMPARE(check->names().size(), std::size_t{3});
  QCOMPARE(check->names()[0].written, std::string("goal_rate"));
  QCOMPARE(check->names()[1].statistic, std::string("p95"));
  QCOMPARE(check->names()[1].metric, std::size_t{1});
  QVERIFY(check->holds(std::vector<double>{0.5, 0.29, 1.0}));
  QVERIFY(!check->holds(std::vector<double>{0.49, 0.29, 1.0}));
  QVERIFY(!check->holds(std::vector<double>{0.6, 0.31, 1.0}));
  QVERIFY(!check->holds(std::vector<double>{0.6, std::nan(""), 1.0}));
  const std::vector<double> sorted{1, 2, 3, 4, 10};
  QCOMPARE(statisticOf("median", sorted), 3.0);
  QVERIFY(near(statisticOf("p95", sorted), 8.8, 1e-12));
  QCOMPARE(statisticOf("n", sorted), 5.0);
  QCOMPARE(statisticOf("max", sorted), 10.0);
  auto run = Check::parse("goal && !(error_m > 1)", Check::Over::Run, metrics);
  QVERIFY(run.has_value());
  QVERIFY(run->holds(std::vector<double>{1, 0.5}));
  QVERIFY(!run->holds(std::vector<double>{1, 1.5}));
}

void TestExperimentStatistics::checksRefuseWhatTheyDoNotKnow() {
  const std::vector<MetricInfo> metrics{{"goal", "", "", true}};
  const auto refused = [&](const char* text) {
    return !Check::parse(text, Check::Over::Condition, metrics).has_value();
  };
  for (const char* text : {"goals >= 1", "p96(goal) > 1", "goal = 1", "", "1 > 0",
                           "goal >=", "{mean/goal} > 0", "mean(gaol)", "goal.x > 0"}) {
    QVERIFY2(refused(text), text);
  }
}

PITCHBOARD_TEST(TestExperimentStatistics)

}  // namespace tst_experiment_statistics

#include "tst_experiment_statistics.moc"

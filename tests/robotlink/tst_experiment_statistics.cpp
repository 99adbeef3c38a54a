// SPDX-License-Identifier: GPL-3.0-or-later

// The statistics of experiments against published tables, the paper's own test, and values worked
// out by hand; assertions over metrics.

#include <QtTest>
#include <cmath>
#include <limits>

#include <robotlink/experiment/run_result.h>
#include <robotlink/experiment/statistics.h>
#include <telemetry/statistics/quantile.h>

#include <robotlink/experiment/checks.h>

namespace tst_experiment_statistics {

namespace telemetry = pitchboard::telemetry;
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
  void fisherAgainstOthers_data();
  void fisherAgainstOthers();
  void withoutSpreadThereIsNoTest();
  void ratesAndCountsHaveTheirIntervals();
  void countsAreNotRates();
  void bootstrapIsThatOfTheMean();
  void pairsOfRuns();
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
  QCOMPARE(telemetry::quantile(sorted, 0.5), 3.0);
  QVERIFY(near(telemetry::quantile(sorted, 0.95), 8.8, 1e-12));  // between 4 and 10, at 3.8
  QVERIFY(std::isnan(telemetry::quantile(std::vector<double>{}, 0.5)));
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

void TestExperimentStatistics::fisherAgainstOthers_data() {
  QTest::addColumn<int>("successesA");
  QTest::addColumn<int>("a");
  QTest::addColumn<int>("successesB");
  QTest::addColumn<int>("b");
  QTest::addColumn<double>("p");
  // Examples of R (fisher.test: the lady tasting tea) and scipy (fisher_exact).
  QTest::newRow("R, tea") << 3 << 4 << 1 << 4 << 0.4857142857142857;
  QTest::newRow("scipy, whales and sharks") << 8 << 10 << 1 << 6 << 0.03496503496503497;
  // Worked out with whole numbers: the sum of C(r, k) C(N - r, n - k) over all k for which it is at
  // most that of the table, by C(N, n).
  QTest::newRow("a rate of nearly 1 and one of 1") << 973 << 1000 << 30 << 30 << 1.0;
  QTest::newRow("a rate of nearly 1 and a half") << 973 << 1000 << 5 << 10 << 5.225194520022058e-06;
  QTest::newRow("of the published scenario") << 312 << 1000 << 16 << 30 << 0.015640964475888607;
  QTest::newRow("large and large") << 144 << 1000 << 106 << 1000 << 0.012243492045150978;
  QTest::newRow("rare") << 1 << 200 << 9 << 200 << 0.01996583455543191;
  QTest::newRow("none and all") << 0 << 10 << 10 << 10 << 1.082508822446903e-05;
  QTest::newRow("none and none") << 0 << 10 << 0 << 10 << 1.0;
  QTest::newRow("all and all") << 10 << 10 << 10 << 10 << 1.0;
  QTest::newRow("as probable on the other side") << 7 << 12 << 5 << 12 << 0.6842726529090777;
  QTest::newRow("samples of two sizes") << 2 << 17 << 10 << 20 << 0.017304846559574035;
}

void TestExperimentStatistics::fisherAgainstOthers() {
  QFETCH(int, successesA);
  QFETCH(int, a);
  QFETCH(int, successesB);
  QFETCH(int, b);
  QFETCH(double, p);
  const auto n = [](int value) { return static_cast<std::size_t>(value); };
  QVERIFY(near(fisherTest(n(successesA), n(a), n(successesB), n(b)), p, 1e-9 * p));
  QVERIFY(near(fisherTest(n(successesB), n(b), n(successesA), n(a)), p, 1e-9 * p));
  QVERIFY(near(fisherTest(n(a - successesA), n(a), n(b - successesB), n(b)), p, 1e-9 * p));
  // Rates are compared by it, and by nothing else.
  const auto rate = [](int successes, int of) {
    const double share = double(successes) / of;
    return SampleMoments{share, std::sqrt(share * (1 - share)), static_cast<std::size_t>(of)};
  };
  const Comparison both = compared(rate(successesA, a), rate(successesB, b), true);
  QVERIFY(both.test == Comparison::Test::Fisher && !both.welch);
  QVERIFY(near(both.p, p, 1e-9 * p));
  QCOMPARE(both.testText(), std::string("Fisher"));
}

void TestExperimentStatistics::withoutSpreadThereIsNoTest() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const SampleMoments varies{2.0, 0.5, 200}, still{1.0, 0.0, 200}, rounded{0.3, 1e-17, 200};
  const SampleMoments notGiven{1.0, nan, 30};
  for (const SampleMoments& other : {still, rounded, notGiven}) {
    QVERIFY(!welchTest(varies, other) && !welchTest(other, varies) && !welchTest(other, other));
    const Comparison one = compared(varies, other, false);
    QVERIFY(one.test == Comparison::Test::None && !one.welch && !one.difference95);
    QCOMPARE(one.p, 1.0);
    QCOMPARE(one.difference, varies.mean - other.mean);
  }
  QCOMPARE(compared(varies, still, false).testText(),
           std::string("one side has no spread, so no test"));
  QCOMPARE(compared(still, still, false).testText(),
           std::string("neither side has spread, so no test"));
  QCOMPARE(compared(varies, notGiven, false).testText(),
           std::string("no spread given, so no test"));
  QCOMPARE(compared(varies, {1.0, 0.5, 1}, true).testText(),
           std::string("too few values for a test"));
  QCOMPARE(compared(varies, {1.9, 0.5, 200}, false).testText(), std::string("Welch"));
  // A hundred deviations apart: the runs repeat one another.
  const Comparison repeated = compared({2.0, 0.01, 200}, {1.0, 0.01, 200}, false);
  QVERIFY(repeated.welch && repeated.testText().starts_with("Welch; the runs hardly vary"));
}

void TestExperimentStatistics::ratesAndCountsHaveTheirIntervals() {
  // Clopper and Pearson for 0 of 10 and 10 of 10: 1 - 0.025^(1/10) = 0.30850; for 8 of 10 any
  // table: 0.4439 to 0.9748.
  const auto of = [](double rate) { return *intervalOfRate({rate, 0.0, 10}); };
  QCOMPARE(of(0.0).low, 0.0);
  QVERIFY(near(of(0.0).high, 0.30850, 1e-5));
  QVERIFY(near(of(1.0).low, 0.69150, 1e-5));
  QCOMPARE(of(1.0).high, 1.0);
  QVERIFY(near(of(0.8).low, 0.4439, 5e-5) && near(of(0.8).high, 0.9748, 5e-5));
  const std::vector<double> ones(200, 1.0);
  QVERIFY(near(summaryOf(ones, true).mean95->low, 0.98172, 1e-5));
  // One goal in each of 200 matches is no rate.
  QVERIFY(*summaryOf(ones).mean95 == (Interval{1.0, 1.0}));
  QCOMPARE(intervalOfMean(std::vector<double>(5, 2.5))->low, 2.5);
  QVERIFY(!intervalOfMean(std::vector<double>{1.0}));
  // Newcombe (1998), table II: 56 of 70 and 48 of 80, method 10.
  const Comparison both = compared({0.8, 0.4, 70}, {0.6, 0.5, 80}, true);
  QVERIFY(near(both.difference95->low, 0.0524, 5e-5) &&
          near(both.difference95->high, 0.3339, 5e-5));
}

// One goal in each of ten matches is a count: the interval of a rate would be wrong for it.
void TestExperimentStatistics::countsAreNotRates() {
  std::size_t rates = 0;
  for (const MetricInfo& metric : teamMetrics()) {
    if (!metric.rate) continue;
    ++rates;
    QVERIFY2(metric.title.starts_with("Runs ") || metric.title == "Good runs",
             metric.title.c_str());
  }
  QCOMPARE(rates, std::size_t{7});
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

void TestExperimentStatistics::pairsOfRuns() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> a{1, 2, nan, 4}, b{0, 0, 1, 1};
  const PairedDifference pairs = pairedDifference(a, b);
  QCOMPARE(pairs.pairs, std::size_t{3});
  QCOMPARE(pairs.mean, 2.0);
  QVERIFY(pairs.mean95->low >= 1.0 && pairs.mean95->high <= 3.0);
  QVERIFY(!pairedDifference(b, b).mean95);
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

// SPDX-License-Identifier: GPL-3.0-or-later

// The search of `pitchboard-cli learn`: finds the maximum of known functions, stays in the cube,
// asks for the same points twice, and is led to the same state by what it was told before.

#include <QtTest>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <robotlink/learn/cma_search.h>

namespace tst_learn_search {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

using Function = std::function<double(const std::vector<double>&)>;

double sphere(const std::vector<double>& x) {
  double sum = 0.0;
  for (std::size_t d = 0; d < x.size(); ++d) {
    const double off = x[d] - 0.3 - 0.1 * static_cast<double>(d % 4);
    sum += off * off;
  }
  return -sum;
}

/// Its valley is curved, and the maximum at (0.5, 0.5, ...).
double rosenbrock(const std::vector<double>& x) {
  double sum = 0.0;
  for (std::size_t d = 0; d + 1 < x.size(); ++d) {
    const double a = 2.0 * x[d], b = 2.0 * x[d + 1];
    sum += 100.0 * std::pow(b - a * a, 2) + std::pow(1.0 - a, 2);
  }
  return -sum;
}

double corner(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0);
}

CmaSearch begun(std::size_t dimensions, std::size_t population = 12, std::uint32_t seed = 1) {
  auto search = CmaSearch::create({std::vector<double>(dimensions, 0.9), population, 0.2, seed});
  if (!search) qFatal("%s", search.error().text().c_str());
  return std::move(*search);
}

Generation play(CmaSearch& search, const Function& function) {
  Generation out{search.ask().value(), {}};
  for (const auto& point : out.points) out.values.push_back(function(point));
  if (const auto reported = search.tell(out.values); !reported)
    qFatal("%s", reported.error().text().c_str());
  return out;
}

}  // namespace

class TestLearnSearch : public QObject {
  Q_OBJECT

 private slots:
  void findsTheMaximum_data() {
    QTest::addColumn<int>("which");
    QTest::addColumn<int>("generations");
    QTest::addColumn<double>("least");
    QTest::newRow("sphere") << 0 << 120 << -1e-8;
    QTest::newRow("rosenbrock") << 1 << 250 << -1e-3;
    QTest::newRow("at the bound") << 2 << 150 << 4.0 - 1e-3;
  }
  void findsTheMaximum() {
    QFETCH(int, which);
    QFETCH(int, generations);
    QFETCH(double, least);
    const Function function = which == 0 ? sphere : which == 1 ? rosenbrock : corner;
    CmaSearch search = begun(4);
    double best = -1e9;
    for (int i = 0; i < generations; ++i) {
      const Generation generation = play(search, function);
      best = std::max(best, *std::ranges::max_element(generation.values));
      for (const auto& point : generation.points) {
        QVERIFY(std::ranges::all_of(point, [](double u) { return u >= 0.0 && u <= 1.0; }));
      }
    }
    QVERIFY2(best > least, qPrintable(QString::number(best, 'g', 12)));
    if (which < 2) QVERIFY(function(search.mean()) > 10.0 * least);
  }

  /// Values with noise that is as large as what there is to gain at the start.
  void noiseDoesNotLeadAstray() {
    CmaSearch search = begun(6, 20);
    std::uint64_t state = 7;
    const auto noisy = [&state](const std::vector<double>& x) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      return sphere(x) + 0.2 * (static_cast<double>(state >> 40) / 16777216.0 - 0.5);
    };
    const double before = sphere(search.mean());
    for (int i = 0; i < 60; ++i) play(search, noisy);
    QVERIFY2(sphere(search.mean()) > 0.2 * before, qPrintable(QString::number(before)));
  }

  void beginsAtTheStart() {
    auto search = CmaSearch::create({{0.2, 0.7}, 40, 1e-4, 3});
    QCOMPARE(search->mean(), (std::vector<double>{0.2, 0.7}));
    const auto points = search->ask();
    QCOMPARE(points->size(), std::size_t{40});
    for (const auto& point : *points) {
      QVERIFY(std::abs(point[0] - 0.2) < 1e-3 && std::abs(point[1] - 0.7) < 1e-3);
    }
  }

  void asksTheSamePointsUntilTell() {
    CmaSearch search = begun(3);
    for (int i = 0; i < 4; ++i) {
      const auto points = search.ask();
      QVERIFY(*points == *search.ask());
      QVERIFY(*begun(3, 12, 2).ask() != *points);
      QVERIFY(play(search, sphere).points == *points);
      QVERIFY(*search.ask() != *points);
    }
  }

  /// The points that a search is led to are those that pagmo's own mean gives.
  void theMeanIsThatOfTheNextPoints() {
    auto made = CmaSearch::create({{0.5, 0.5, 0.5}, 60, 0.03, 1});
    CmaSearch& search = *made;
    for (int i = 0; i < 2; ++i) play(search, sphere);
    const auto points = search.ask().value();
    for (std::size_t d = 0; d < 3; ++d) {
      double mean = 0.0, square = 0.0;
      for (const auto& point : points) {
        mean += point[d] / 60.0;
        square += point[d] * point[d] / 60.0;
      }
      const double error = std::sqrt((square - mean * mean) / 60.0);
      QVERIFY2(std::abs(mean - search.mean()[d]) < 4.0 * error, qPrintable(QString::number(error)));
    }
  }

  void resumesAtEveryGeneration() {
    CmaSearch whole = begun(5);
    std::vector<Generation> journal;
    for (int i = 0; i < 25; ++i) {
      CmaSearch resumed = begun(5);
      for (const Generation& one : journal) QVERIFY(resumed.replay(one).has_value());
      QCOMPARE(resumed.generationsDone(), journal.size());
      QVERIFY(resumed.mean() == whole.mean());
      QVERIFY(*resumed.ask() == *whole.ask());
      journal.push_back(play(whole, rosenbrock));
    }
  }

  void refusesTheJournalOfAnotherLearning() {
    CmaSearch other = begun(3, 12, 9);
    const Generation foreign = play(other, sphere);
    CmaSearch search = begun(3);
    const auto refused = search.replay(foreign);
    QVERIFY(!refused && refused.error().code == ErrorCode::Conflict);
    QVERIFY2(refused.error().message.starts_with("generation 1 has other points"),
             refused.error().message.c_str());
    QCOMPARE(search.generationsDone(), std::size_t{0});
    Generation shorter = play(search, sphere);
    CmaSearch again = begun(3);
    shorter.points.pop_back();
    QVERIFY(!again.replay(shorter));
  }

  void wrongSettingsAndValuesAreRefused() {
    QVERIFY(!CmaSearch::create({{}, 12}));
    QVERIFY(!CmaSearch::create({{1.5}, 12}));
    QVERIFY(!CmaSearch::create({{0.5}, 4}));
    QVERIFY(!CmaSearch::create({{0.5}, 12, 0.0}));
    CmaSearch search = begun(2);
    QVERIFY(!search.tell(std::vector<double>(11, 0.0)));
    std::vector<double> bad(12, 0.0);
    bad[3] = std::nan("");
    QVERIFY(!search.tell(bad));
    QCOMPARE(search.generationsDone(), std::size_t{0});
  }
};

PITCHBOARD_TEST(TestLearnSearch)

}  // namespace tst_learn_search

#include "tst_learn_search.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// The series store against a plain implementation, with random rows that hold everything a
// blackboard can: constants, rare changes, noise, NaN, infinities, equal times, a source put back.

#include <QtTest>

#include <atomic>
#include <bit>
#include <random>
#include <thread>

#include <telemetry/series/series_store.h>

#include "naive_series.h"

using namespace pitchboard::telemetry;

namespace {

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

GroupInfo group(const std::string& name = "B1") {
  GroupInfo info;
  info.name = name;
  for (const char* column : {"CONSTANT", "RARE", "NOISE"}) {
    info.columns.push_back({column, ColumnType::Int32, "", "Ints", ColumnKind::Number, {}});
  }
  for (const char* column : {"F_CONSTANT", "F_RARE", "F_NOISE", "F_HOLES"}) {
    info.columns.push_back({column, ColumnType::Float32, "cm", "Floats", ColumnKind::Number, {}});
  }
  for (const char* column : {"D_NOISE", "D_HOLES", "D_NAN"}) {
    info.columns.push_back({column, ColumnType::Float64, "m", "Doubles", ColumnKind::Number, {}});
  }
  return info;
}

class Source {
 public:
  explicit Source(unsigned seed) : m_random(seed) {}

  NaiveRow next() {
    const auto kind = m_random() % 100;
    if (kind >= 10) m_time += 1.0 / 60.0;  // else: the same time again
    if (kind == 99) m_time += 3.0;         // a pause
    return at(m_time);
  }
  NaiveRow at(double time) {
    m_time = time;
    if (m_random() % 97 == 0) m_rare = static_cast<std::int32_t>(m_random() % 5) - 2;
    const double noise = std::normal_distribution<double>(1e6, 3.0)(m_random);
    const auto hole = m_random() % 50;
    const double holes = hole == 0   ? notANumber
                         : hole == 1 ? infinity
                         : hole == 2 ? -infinity
                                     : noise;
    const auto f = [](double v) { return std::bit_cast<std::uint32_t>(static_cast<float>(v)); };
    return {time,
            {7, static_cast<std::uint32_t>(m_rare), static_cast<std::uint32_t>(m_random()), f(-0.0),
             f(m_rare * 0.5), f(noise), f(holes)},
            {noise, holes, notANumber}};
  }

 private:
  std::mt19937 m_random;
  double m_time = 0.0;
  std::int32_t m_rare = 0;
};

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}
bool near(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}

RowView viewOf(const NaiveRow& row) {
  return {row.time, row.words, row.values};
}

}  // namespace

class TestSeriesStore : public QObject {
  Q_OBJECT

  void compare(const GroupView& view, const NaiveSeries& naive, unsigned seed) {
    std::mt19937 random(seed);
    QCOMPARE(view.rows(), naive.rows.size());
    if (naive.rows.empty()) {
      QVERIFY(!view.range());
      return;
    }
    const double first = naive.rows.front().time, last = naive.rows.back().time;
    QCOMPARE(*view.range(), (TimeRange{first, last}));
    std::uniform_real_distribution<double> anywhere(first - 1.0, last + 1.0);
    for (std::uint32_t c = 0; c < naive.info.columns.size(); ++c) {
      const auto latest = view.latest(c);
      QVERIFY(latest && latest->time == last &&
              same(latest->value, naive.value(c, naive.rows.back())));
      QCOMPARE(*view.lastChange(c), naive.lastChange(c));
      for (int repeat = 0; repeat < 4; ++repeat) {
        TimeRange range{anywhere(random), anywhere(random)};
        if (repeat == 1) range = {first, last};
        // Exactly on rows, so that the closed and open ends are told apart.
        if (repeat == 2)
          range = {naive.rows[random() % naive.rows.size()].time,
                   naive.rows[random() % naive.rows.size()].time};
        if (range.end < range.begin) std::swap(range.begin, range.end);

        const NaiveRow* row = naive.at(range.begin);
        const auto at = view.at(c, range.begin);
        QCOMPARE(at.has_value(), row != nullptr);
        if (row) QVERIFY(at->time == row->time && same(at->value, naive.value(c, *row)));

        std::vector<Sample> samples;
        QVERIFY(view.samples(c, range, samples));
        const auto wanted = naive.samples(c, range);
        QCOMPARE(samples.size(), wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) {
          QVERIFY(samples[i].time == wanted[i].time && same(samples[i].value, wanted[i].value));
        }

        const auto a = view.statistics(c, range), b = naive.statistics(c, range);
        QCOMPARE(a.samples, b.samples);
        QVERIFY2(
            near(a.mean, b.mean) && near(a.sigma, b.sigma) && near(a.rms, b.rms) &&
                a.min == b.min && a.max == b.max,
            qPrintable(QString("column %1: σ %2, wanted %3").arg(c).arg(a.sigma).arg(b.sigma)));

        if (!(range.begin < range.end)) continue;
        std::vector<SeriesBucket> buckets(repeat == 0 ? 7 : 300);
        view.buckets(c, range, buckets);
        const auto expected = naive.buckets(c, range, buckets.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
          const SeriesBucket &x = buckets[i], &y = expected[i];
          QVERIFY2(x.samples == y.samples && same(x.first, y.first) && same(x.last, y.last) &&
                       same(x.min, y.min) && same(x.max, y.max),
                   qPrintable(QString("column %1 bucket %2: %3 to %4, wanted %5 to %6")
                                  .arg(c)
                                  .arg(i)
                                  .arg(x.min)
                                  .arg(x.max)
                                  .arg(y.min)
                                  .arg(y.max)));
        }
      }
    }
    double time = 0.0;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
    for (int repeat = 0; repeat < 20; ++repeat) {
      const double when = anywhere(random);
      const NaiveRow* row = naive.at(when);
      QCOMPARE(view.rowAt(when, time, words, values), row != nullptr);
      if (!row) continue;
      QVERIFY(time == row->time && words == row->words && values.size() == row->values.size());
      for (std::size_t i = 0; i < values.size(); ++i) QVERIFY(same(values[i], row->values[i]));
    }
  }

 private slots:
  void agreesWithThePlainOne_data() {
    QTest::addColumn<int>("rows");
    for (const int rows : {0, 1, 2, 63, 64, 65, 128, 500, 4095, 4096, 4097, 4160, 9000}) {
      QTest::addRow("%d rows", rows) << rows;
    }
  }
  void agreesWithThePlainOne() {
    QFETCH(int, rows);
    SeriesStore store;
    NaiveSeries naive(group());
    const GroupId id = store.addGroup(naive.info);
    Source source(static_cast<unsigned>(rows));
    for (int i = 0; i < rows; ++i) {
      const NaiveRow row = source.next();
      store.append(id, viewOf(row));
      naive.append(row);
    }
    compare(*store.view(id), naive, static_cast<unsigned>(rows) + 1);
  }

  void timeGoingBackDropsWhatCameAfter_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<double>("share");
    for (const int rows : {30, 64, 100, 5000, 8192, 9000}) {
      for (const double share : {-1.0, 0.0, 0.3, 0.5, 0.95, 0.999}) {
        QTest::addRow("%d rows, back to %g", rows, share) << rows << share;
      }
    }
  }
  void timeGoingBackDropsWhatCameAfter() {
    QFETCH(int, rows);
    QFETCH(double, share);
    SeriesStore store;
    NaiveSeries naive(group());
    const GroupId id = store.addGroup(naive.info);
    Source source(5);
    double last = 0.0;
    for (int i = 0; i < rows; ++i) {
      const NaiveRow row = source.next();
      store.append(id, viewOf(row));
      naive.append(row);
      last = row.time;
    }
    const auto before = store.view(id);
    NaiveRow row = source.at(share < 0 ? -5.0 : share * last);
    for (int i = 0; i < 200; ++i) {
      store.append(id, viewOf(row));
      naive.append(row);
      row = source.next();
    }
    QCOMPARE(before->rows(), static_cast<std::size_t>(rows));  // a view does not change
    compare(*store.view(id), naive, 3);
  }

  void rowsThatMakeNoSenseAreRefused() {
    SeriesStore store;
    const GroupId id = store.addGroup(group());
    Source source(1);
    NaiveRow row = source.at(1.0);
    store.append(id, viewOf(row));
    for (const double time : {notANumber, infinity, -infinity}) {
      row.time = time;
      store.append(id, viewOf(row));
    }
    row.time = 2.0;
    store.append(id + 1, viewOf(row));
    row.words.pop_back();
    store.append(id, viewOf(row));
    row.words.push_back(0);
    row.values.push_back(0);
    store.append(id, viewOf(row));
    QCOMPARE(store.refusedRows(), std::uint64_t{6});
    QCOMPARE(store.view(id)->rows(), std::size_t{1});
    QVERIFY(!store.view(id + 1));
  }

  void hugeTimesAndSensesOfRanges() {
    SeriesStore store;
    const GroupId id = store.addGroup(group());
    Source source(1);
    for (const double time : {-1.7e308, -1.0, 0.0, 1e-300, 5.0, 1.7e308}) {
      store.append(id, viewOf(source.at(time)));
    }
    const auto view = store.view(id);
    std::vector<SeriesBucket> buckets(10);
    view->buckets(2, {-1.7e308, 1.7e308}, buckets);
    std::uint32_t sum = 0;
    for (const auto& bucket : buckets) sum += bucket.samples;
    QCOMPARE(sum, 5U);  // the end is open
    for (const TimeRange range : {TimeRange{notANumber, 1.0}, TimeRange{0.0, notANumber},
                                  TimeRange{2.0, 1.0}, TimeRange{-infinity, infinity}}) {
      view->buckets(2, range, buckets);
      for (const auto& bucket : buckets) QCOMPARE(bucket.samples, 0U);
    }
    view->buckets(99, {0.0, 1.0}, buckets);
    view->buckets(2, {0.0, 1.0}, {});
    QVERIFY(!view->at(2, notANumber));
    QVERIFY(!view->latest(99));
    std::vector<Sample> samples;
    QVERIFY(view->samples(2, {-infinity, infinity}, samples));
    QCOMPARE(samples.size(), std::size_t{6});
    QVERIFY(!view->samples(2, {-infinity, infinity}, samples, 2));
    QCOMPARE(samples.size(), std::size_t{2});
    QCOMPARE(view->statistics(2, {2.0, 1.0}).samples, std::uint64_t{0});
  }

  void rate() {
    SeriesStore store;
    const GroupId id = store.addGroup(group());
    QCOMPARE(store.view(id)->rate(), 0.0);
    Source source(1);
    for (int i = 0; i < 300; ++i) store.append(id, viewOf(source.at(i * 0.1)));
    for (int i = 0; i <= 120; ++i) store.append(id, viewOf(source.at(40.0 + i / 60.0)));
    QVERIFY(std::abs(store.view(id)->rate() - 60.0) < 0.01);
  }

  void oldestLeaveFirst() {
    SeriesStore store({.memoryBudget = 400'000});
    const GroupId slow = store.addGroup(group("slow")), fast = store.addGroup(group("fast"));
    Source source(1);
    for (int i = 0; i < 60'000; ++i) {
      const NaiveRow row = source.at(i * 0.01);
      store.append(fast, viewOf(row));
      if (i % 10 == 0) store.append(slow, viewOf(row));
      QVERIFY2(store.memoryBytes() <= 400'000 + 2 * 64 * 60, qPrintable(QString::number(i)));
    }
    const auto a = store.view(slow)->range(), b = store.view(fast)->range();
    QVERIFY(a && b && a->begin > 100.0 && b->begin > 100.0);
    // What is left begins about together: a chunk of the slow group is 41 s long.
    QVERIFY2(std::abs(a->begin - b->begin) < 410.0,
             qPrintable(QString::number(a->begin - b->begin)));
    QCOMPARE(b->end, 59'999 * 0.01);
    const auto held = store.view(fast);
    store.setMemoryBudget(1);
    QVERIFY(store.view(fast)->rows() < 64);
    QVERIFY(store.memoryBytes() < 20'000);
    QVERIFY(held->rows() > 1000);
    QVERIFY(held->statistics(7, {0.0, 600.0}).samples > 1000);  // a view keeps its chunks alive
    store.append(fast, viewOf(source.at(700.0)));
    QCOMPARE(store.view(fast)->latest(0)->time, 700.0);
  }

  void groups() {
    SeriesStore store;
    const auto revision = store.groupsRevision();
    GroupInfo info = group();
    const GroupId id = store.addGroup(info);
    QVERIFY(store.groupsRevision() > revision);
    Source source(1);
    store.append(id, viewOf(source.at(1.0)));
    QCOMPARE(store.addGroup(info), id);
    info.attributes["team"] = "blue";
    QCOMPARE(store.addGroup(info), id);
    QCOMPARE(store.view(id)->rows(), std::size_t{1});
    QCOMPARE(store.view(id)->info().attributes.at("team"), std::string("blue"));
    QCOMPARE(*store.find("B1", "D_NOISE"), (SeriesId{id, 7}));
    QVERIFY(!store.find("B1", "NOT_THERE") && !store.find("B2", "NOISE"));

    info.columns.pop_back();
    const GroupId other = store.addGroup(info);
    QVERIFY(other != id);
    QCOMPARE(store.view(id)->rows(), std::size_t{0});
    QCOMPARE(*store.findGroup("B1"), other);
    QCOMPARE(store.view(other)->rows(), std::size_t{0});
    QVERIFY(!store.range());
    NaiveRow row = source.at(2.0);
    row.values.pop_back();
    store.append(other, viewOf(row));
    QCOMPARE(*store.range(), (TimeRange{2.0, 2.0}));
    store.clear();
    QVERIFY(!store.range());
    QCOMPARE(store.groups(), std::size_t{2});
    QCOMPARE(*store.findGroup("B1"), other);
  }

  /// A row's values all follow from its time, so a reader sees at once when it read something torn.
  void readersBesideTheWriter() {
    SeriesStore store({.memoryBudget = 600'000});
    GroupInfo info{"B1",
                   {{"I", ColumnType::Int32, "", "", ColumnKind::Number, {}},
                    {"SLOW", ColumnType::Int32, "", "", ColumnKind::Number, {}},
                    {"D", ColumnType::Float64, "", "", ColumnKind::Number, {}}},
                   {}};
    const GroupId id = store.addGroup(info);
    std::atomic<bool> stop{false};
    std::atomic<int> wrong{0}, looks{0};
    std::vector<std::thread> readers;
    for (int r = 0; r < 3; ++r) {
      readers.emplace_back([&, r] {
        std::vector<Sample> samples;
        std::vector<SeriesBucket> buckets(50);
        std::vector<std::uint32_t> words;
        std::vector<double> values;
        while (!stop) {
          const auto view = store.view(id);
          const auto range = view->range();
          if (!range) continue;
          view->samples(2, {range->end - 100.0 * r, range->end}, samples);
          for (const Sample& s : samples) wrong += s.value != 2.0 * s.time;
          view->buckets(0, *range, buckets);
          for (const auto& b : buckets) {
            wrong += b.samples > 0 && (b.max - b.min != b.samples - 1 || b.first != b.min);
          }
          wrong += view->statistics(2, *range).samples != view->rows();
          double time = 0.0;
          view->rowAt((range->begin + range->end) / 2, time, words, values);
          wrong += words.at(0) != static_cast<std::uint32_t>(time) || values.at(0) != 2.0 * time;
          wrong += store.find("B1", "D") != SeriesId{id, 2};
          if (r == 0) store.setMemoryBudget(looks % 2 == 0 ? 600'000 : 300'000);
          ++looks;
        }
      });
    }
    double time = 0.0;
    for (int i = 0; i < 200'000 || looks < 50; ++i) {
      const std::uint32_t words[] = {static_cast<std::uint32_t>(time),
                                     static_cast<std::uint32_t>(time) / 500};
      const double values[] = {2.0 * time};
      store.append(id, {time, words, values});
      time += 1.0;
      if (i % 30'000 == 29'999) time -= 700.0;
      if (i % 1'000 == 999) {
        store.addGroup({"G" + std::to_string(i % 7), info.columns, {}});
      }
    }
    stop = true;
    for (auto& reader : readers) reader.join();
    QCOMPARE(wrong.load(), 0);
  }

  /// Each thread has a group of its own; a third one forgets everything now and then.
  void severalWriters() {
    SeriesStore store({.memoryBudget = 500'000});
    std::atomic<bool> stop{false};
    std::vector<std::thread> writers;
    for (int w = 0; w < 2; ++w) {
      writers.emplace_back([&, w] {
        const GroupId id = store.addGroup(group("W" + std::to_string(w)));
        Source source(static_cast<unsigned>(w));
        for (int i = 0; i < 20'000; ++i) store.append(id, viewOf(source.next()));
      });
    }
    std::thread clearer([&] {
      while (!stop) {
        store.clear();
        std::this_thread::yield();
      }
    });
    for (auto& writer : writers) writer.join();
    stop = true;
    clearer.join();
    QCOMPARE(store.refusedRows(), std::uint64_t{0});
    QCOMPARE(store.groups(), std::size_t{2});
    store.clear();
    QVERIFY(!store.range());
  }
};

QTEST_GUILESS_MAIN(TestSeriesStore)
#include "tst_series_store.moc"

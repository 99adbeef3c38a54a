// SPDX-License-Identifier: GPL-3.0-or-later
// The series store against a plain implementation, with random rows that hold everything a
// blackboard can: constants, rare changes, noise, NaN, infinities, equal times, a source put back.

#include <QtTest>

#include <telemetry/series/series_store.h>

#include "series_rows.h"

namespace tst_series_store {

using namespace pitchboard::telemetry;

namespace {

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}
bool near(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
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
    // Edits of a match that is paused are rows of one time.
    for (int i = 0; i < 130; ++i) store.append(id, viewOf(source.at(42.0)));
    QVERIFY(std::abs(store.view(id)->rate() - 60.0) < 0.01);
  }

  void aLostValueIsAHoleInViewsOnly() {
    SeriesStore store;
    GroupInfo info = group();
    const GroupId id = store.addGroup(info);
    const auto seen = store.find("B1", "F_SEEN")->column;
    Source source(1);
    constexpr int rows = 4200;  // a chunk, blocks and rows that are not yet a block
    std::vector<std::uint32_t> stale;
    for (int i = 0; i < rows; ++i) {
      NaiveRow row = source.at(i);
      row.words[1] = i % 200 < 100 ? 0 : 1;  // RARE: 1 is lost
      row.words[4] = 0;                      // F_RARE: -1 is lost, too
      stale.push_back(row.words[seen]);
      store.append(id, viewOf(row));
    }
    // Further columns come: what is kept behind all columns stays what it is.
    info.columns.push_back({"D_MORE", ColumnType::Float64, "", "", ColumnKind::Number, {}});
    QCOMPARE(store.addGroup(info), id);
    const auto view = store.view(id);
    double time = 0.0;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
    for (int i = 0; i < rows; ++i) {
      const bool lost = i % 200 >= 100;
      QCOMPARE(std::isnan(view->at(seen, i)->value), lost);
      QVERIFY(view->rowAt(i, time, words, values));
      QCOMPARE(words[seen], stale[static_cast<std::size_t>(i)]);
    }
    QVERIFY(std::isnan(view->latest(seen)->value) == ((rows - 1) % 200 >= 100));
    QCOMPARE(view->statistics(seen, {0.0, 199.0}).samples, std::uint64_t{100});
    QVERIFY(std::isnan(view->at(static_cast<std::uint32_t>(info.columns.size()) - 1, 5.0)->value));
    // Said otherwise, the rows so far are another group's.
    info.columns[seen].lost[0].value = 0;
    QVERIFY(store.addGroup(info) != id);
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
    QCOMPARE(*store.find("B1", "D_NOISE"), (SeriesId{id, 9}));
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

  void aRenamedGroupKeepsItsRows() {
    SeriesStore store;
    GroupInfo info = group();
    const GroupId id = store.addGroup(info);
    Source source(1);
    store.append(id, viewOf(source.at(1.0)));
    info.name = "R1";
    const auto revision = store.groupsRevision();
    QCOMPARE(store.renameGroup("B1", info), id);
    QVERIFY(store.groupsRevision() > revision);
    store.append(id, viewOf(source.at(2.0)));
    QCOMPARE(store.view(id)->rows(), std::size_t{2});
    QCOMPARE(store.findGroup("R1"), std::optional(id));
    QVERIFY(!store.findGroup("B1"));
    // A curve of its former name goes on, until another group has the name.
    QCOMPARE(store.find("B1", "D_NOISE"), std::optional(SeriesId{id, 9}));
    info.name = "B1";
    const GroupId other = store.addGroup(info);
    QVERIFY(other != id);
    QCOMPARE(store.find("B1", "D_NOISE"), std::optional(SeriesId{other, 9}));
    // Where there is a group of the name, that one goes on.
    QCOMPARE(store.renameGroup("R1", info), other);
    QCOMPARE(store.view(id)->rows(), std::size_t{2});
  }
};

PITCHBOARD_TEST(TestSeriesStore)

}  // namespace tst_series_store

#include "tst_series_store.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// The series store against a plain implementation, with random rows that hold everything a
// blackboard can: constants, rare changes, noise, NaN, infinities, equal times, a source put back.

#include <QtTest>
#include <array>

#include <telemetry/series/group_attributes.h>
#include <telemetry/series/robot_names.h>
#include <telemetry/series/series_store.h>

#include "../support/group_facts.h"
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
  void theListenerIsToldOnceUntilItHasHeard() {
    SeriesStore store;
    int told = 0;
    store.setListener([&told] { ++told; });
    GroupInfo info;
    info.name = "B1";
    info.columns.emplace_back().name = "X";
    const GroupId group = store.addGroup(info);
    const std::array<double, 1> values{1.0};
    const auto append = [&](double time) { store.append(group, {time, {}, values}); };
    QCOMPARE(told, 0);
    append(1.0);
    append(2.0);
    QCOMPARE(told, 1);
    store.heard();
    QCOMPARE(told, 1);
    append(3.0);
    QCOMPARE(told, 2);
    store.heard();
    append(std::nan(""));  // is refused
    QCOMPARE(told, 2);
  }

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
    // Described otherwise, the rows so far stay as they were understood.
    info.columns[seen].lost[0].value = 0;
    QCOMPARE(store.addGroup(info), id);
    QCOMPARE(store.view(id)->rows(), static_cast<std::size_t>(rows));
    QCOMPARE(std::isnan(store.view(id)->at(seen, 150.0)->value), true);
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
    info.robot.emplace().team = pitchboard::TeamColor::Blue;
    QCOMPARE(store.addGroup(info), id);
    QCOMPARE(store.view(id)->rows(), std::size_t{1});
    QCOMPARE(attributesOf(store.view(id)->info()).at("team"), std::string("blue"));
    QCOMPARE(*store.find("B1", "D_NOISE"), (SeriesId{id, 9}));
    QVERIFY(!store.find("B1", "NOT_THERE") && !store.find("B2", "NOISE"));

    store.clear();
    QVERIFY(!store.range());
    QCOMPARE(store.groups(), std::size_t{1});
    QCOMPARE(*store.findGroup("B1"), id);
  }

  /// Two kinds of rows of one robot, as of a match whose advisor is switched on and off: columns in
  /// the middle come and go, one changes its type, and their order changes.
  void columnsThatComeAndGoKeepThePast_data() {
    QTest::addColumn<int>("rows");
    // Staged rows, whole blocks, whole chunks.
    for (const int rows : {10, 200, 9000}) QTest::addRow("%d rows", rows) << rows;
  }

  void columnsThatComeAndGoKeepThePast() {
    QFETCH(int, rows);
    const auto column = [](const char* name, ColumnType type) {
      ColumnInfo info;
      info.name = name;
      info.type = type;
      return info;
    };
    using enum ColumnType;
    ColumnInfo seen = column("SEEN", Float32);
    seen.lost = {{"LOST", 1.0}};
    const GroupInfo plain{"B1",
                          {column("ID", Int32), column("LOST", Int32), seen, column("X", Float64),
                           column("Y", Float64)},
                          {}};
    const GroupInfo advised{"B1",
                            {column("ADVICE", Int32), column("LOST", Float32), seen,
                             column("Y", Float64), column("GAIN", Float64), column("X", Float64)},
                            facts({{"behaviour", "advised"}})};
    const auto word = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    SeriesStore store;
    double time = 0.0;
    const auto put = [&](const GroupInfo& info) {
      const GroupId id = store.addGroup(info);
      const bool isAdvised = info == advised;
      for (int i = 0; i < rows; ++i, time += 0.01) {
        const auto number = static_cast<float>(time);
        const bool isLost = i % 7 == 0;
        if (isAdvised) {
          const std::array words{1000000007U + static_cast<unsigned>(i), word(isLost ? 1.0F : 0.0F),
                                 word(number)};
          store.append(id, {time, words, std::array{2.0 * time, 3.0 * time, time}});
        } else {
          const std::array words{7U, isLost ? 1U : 0U, word(number)};
          store.append(id, {time, words, std::array{time, 2.0 * time}});
        }
      }
      return id;
    };
    const GroupId id = put(plain);
    const double on = time;
    QCOMPARE(put(advised), id);
    const double off = time;
    QCOMPARE(put(plain), id);
    QCOMPARE(store.groups(), std::size_t{1});
    const auto view = store.view(id);
    QCOMPARE(view->rows(), static_cast<std::size_t>(3 * rows));
    std::vector<std::string> names;
    for (const ColumnInfo& one : view->info().columns) names.push_back(one.name);
    QCOMPARE(names, (std::vector<std::string>{"ID", "LOST", "SEEN", "X", "Y", "ADVICE", "GAIN"}));
    std::vector<Sample> samples;
    const auto each = [&](const char* name, const auto& wanted) {
      const auto found = store.find("B1", name);
      QVERIFY2(found, name);
      QVERIFY(view->samples(found->column, {-1.0, 1e9}, samples));
      QCOMPARE(samples.size(), static_cast<std::size_t>(3 * rows));
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const double value = wanted(samples[i].time, static_cast<int>(i) % rows);
        QVERIFY2(same(samples[i].value, value), qPrintable(QString("%1 at row %2: %3, wanted %4")
                                                               .arg(name)
                                                               .arg(i)
                                                               .arg(samples[i].value)
                                                               .arg(value)));
      }
    };
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto isOn = [&](double at) { return at >= on && at < off; };
    each("X", [](double at, int) { return at; });
    each("Y", [](double at, int) { return 2.0 * at; });
    each("LOST", [](double, int i) { return i % 7 == 0 ? 1.0 : 0.0; });
    each("SEEN", [](double at, int i) {
      return i % 7 == 0 ? none : static_cast<double>(static_cast<float>(at));
    });
    each("ID", [&](double at, int) { return isOn(at) ? none : 7.0; });
    each("ADVICE", [&](double at, int i) { return isOn(at) ? 1000000007.0 + i : none; });
    each("GAIN", [&](double at, int) { return isOn(at) ? 3.0 * at : none; });
    // Buckets and statistics read what was converted, too.
    const auto advice = store.find("B1", "ADVICE")->column;
    const SeriesStatistics all = view->statistics(advice, {-1.0, 1e9});
    QCOMPARE(all.samples, static_cast<std::uint64_t>(rows));
    QCOMPARE(all.max, 1000000007.0 + rows - 1);
    std::array<SeriesBucket, 1> bucket;
    view->buckets(advice, {0.0, on}, bucket);
    QVERIFY(bucket[0].samples > 0 && std::isnan(bucket[0].max));
    view->buckets(advice, {on, off}, bucket);
    QCOMPARE(bucket[0].max, 1000000007.0 + rows - 1);
  }

  void groupsThatExchangeTheirNamesKeepTheirRows() {
    SeriesStore store;
    const auto groupOf = [](const char* id, const char* name) {
      GroupInfo info = group();
      info.id = id;
      info.name = name;
      return info;
    };
    const GroupId one = store.addGroup(groupOf("1", "B1")),
                  other = store.addGroup(groupOf("2", "R1"));
    Source source(1);
    store.append(one, viewOf(source.at(1.0)));
    const auto revision = store.groupsRevision();
    store.describeGroups(std::array{groupOf("1", "R1"), groupOf("2", "B1")});
    QVERIFY(store.groupsRevision() > revision);
    QCOMPARE(store.groupNames(), (std::vector<std::string>{"R1", "B1"}));
    QCOMPARE(store.findGroup("R1"), std::optional(one));
    QCOMPARE(store.find("B1", "D_NOISE"), std::optional(SeriesId{other, 9}));
    // The rows of a robot go to its group, however it is called.
    QCOMPARE(store.addGroup(groupOf("1", "R1")), one);
    store.append(one, viewOf(source.at(2.0)));
    QCOMPARE(store.view(one)->rows(), std::size_t{2});
    QCOMPARE(store.view(other)->rows(), std::size_t{0});
    // Nobody else's past is found under a name that nobody has.
    store.describeGroups(std::array{groupOf("2", "B2")});
    QVERIFY(!store.find("B1", "D_NOISE"));
  }

  /// What people type means who has the name, and otherwise the one robot that had it.
  void namesOfRobotsAreResolvedInOnePlace() {
    const auto robot = [](std::uint32_t uid, const char* id, const char* name) {
      GroupInfo group;
      group.id = id;
      group.name = name;
      group.robot.emplace().uid = {uid};
      return group;
    };
    GroupInfo one = robot(1, "1", "Robot 1"), variables = robot(1, "1v", "Robot 1"),
              other = robot(2, "2", "B1");
    const auto rename = [](GroupInfo& group, const char* name) {
      GroupInfo now = group;
      now.name = name;
      keepFormerNames(group, now);
      group = now;
    };
    const auto named = [&](std::string_view name) {
      return groupsNamed(name, std::vector<const GroupInfo*>{&one, &variables, &other});
    };
    using Groups = std::vector<GroupId>;
    rename(variables, "Robot 1 variables");
    QVERIFY(named("Robot 1") == Groups{0});
    rename(one, "B1");
    rename(other, "R1");
    QVERIFY(named("Robot 1") == (Groups{0, 1}));  // both are of the same robot
    QVERIFY(named("B1") == Groups{0});            // who has it, not who had it
    rename(one, "R1");
    rename(other, "B1");
    QVERIFY(named("R1") == Groups{0} && named("B1") == Groups{2});
    QCOMPARE(factsOf(one).formerNames, (std::vector<std::string>{"Robot 1", "B1"}));
    QCOMPARE(factsOf(other).formerNames, std::vector<std::string>{"R1"});
    rename(one, "Guest 1");
    rename(other, "Guest 2");
    const auto unclear = named("R1"), unknown = named("R7");
    QVERIFY(!unclear && unclear.error().code == ErrorCode::InvalidArgument);
    QVERIFY(unclear.error().message.find("Guest 1, Guest 2") != std::string::npos);
    QVERIFY(!unknown && unknown.error().code == ErrorCode::NotFound);
    QVERIFY(unknown.error().message.find("Guest 1, Robot 1 variables, Guest 2") !=
            std::string::npos);
    // Former names are kept in files.
    GroupInfo read;
    readAttributes(attributesOf(one), read);
    QVERIFY(factsOf(read) == factsOf(one));
  }
};

PITCHBOARD_TEST(TestSeriesStore)

}  // namespace tst_series_store

#include "tst_series_store.moc"

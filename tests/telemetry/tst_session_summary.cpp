// SPDX-License-Identifier: GPL-3.0-or-later
// Sessions larger than memory: the coarse picture in the file against the rows themselves, and
// views that page.

#include <QtTest>
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include <telemetry/series/series_pages.h>
#include <telemetry/session/session_export.h>
#include <telemetry/session/session_repair.h>

#include "session_rig.h"
#include "session_summary.h"

namespace tst_session_summary {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

namespace {

constexpr int rowCount = 40'000;  // two parts of a summary and the beginning of a third
constexpr double rate = 50.0;

struct Column {
  std::vector<double> times, values;
};

/// All of the file behind it, and a stretch when it is told to.
class Pages : public SeriesPages {
 public:
  explicit Pages(const SessionReader& session) : m_session(session) {
    m_range = {session.range()->begin, session.range()->end};
  }
  std::shared_ptr<const GroupSummary> summary(GroupId group, bool) override {
    return std::make_shared<const GroupSummary>(m_session.summary(group));
  }
  std::optional<Stretch> held(GroupId group, std::optional<TimeRange> range) override {
    if (!m_rows) return std::nullopt;
    if (range && (range->begin < m_held.begin || range->end > m_held.end)) return std::nullopt;
    return Stretch{m_held, m_rows->view(group)};
  }
  void want(TimeRange range) override { wanted = range; }
  bool isReading(TimeRange range) override { return wanted == range; }
  std::optional<SeriesStatistics> statistics(GroupId, std::uint32_t, TimeRange) override {
    return std::nullopt;
  }
  void setListener(std::function<void()>) override {}
  std::uint64_t revision() override { return 1; }
  TimeRange range() override { return m_range; }
  std::size_t bytes() override { return 0; }

  void load(TimeRange range) {
    m_rows = std::make_unique<SeriesStore>();
    for (const SessionGroup& group : m_session.groups()) m_rows->addGroup(group.info);
    m_session.rows(range, {}, [this](GroupId group, const RowView& row) {
      m_rows->append(group, row);
      return true;
    });
    m_held = range;
  }
  std::optional<TimeRange> wanted;

 private:
  const SessionReader& m_session;
  TimeRange m_range;
  std::unique_ptr<SeriesStore> m_rows;
  TimeRange m_held;
};

}  // namespace

class TestSessionSummary : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  std::string m_path;
  Column m_distance;  // of the second robot

  std::unique_ptr<SessionReader> session() const {
    return std::make_unique<SessionReader>(std::move(*SessionReader::open(m_path)));
  }

 private slots:
  void initTestCase() {
    m_path = m_folder.filePath("long.mcap").toStdString();
    SessionWriterOptions options;
    options.waitWhenFull = true;
    options.level = 1;
    auto writer = SessionWriter::create(m_path, sessionInfo(), options);
    QVERIFY(writer);
    const GroupId one = (*writer)->addGroup(robotGroup("B1", 1));
    const GroupId two = (*writer)->addGroup(robotGroup("B2", 2));
    std::mt19937 random(7);
    std::normal_distribution<double> noise(100.0, 20.0);
    for (int i = 0; i < rowCount; ++i) {
      const double time = i / rate;
      auto distance = static_cast<float>(i % 1000 == 3 ? std::nan("") : noise(random));
      // Now and then nothing is seen, and the word is an old one.
      const bool lost = i % 700 == 5;
      const std::uint32_t words[] = {7, lost ? 2U : static_cast<std::uint32_t>(i / 9000 % 2),
                                     std::bit_cast<std::uint32_t>(lost ? 1e6F : distance)};
      if (lost) distance = std::nanf("");
      const double values[] = {std::sin(time), 1.5};
      (*writer)->append(two, {time, words, values});
      m_distance.times.push_back(time);
      m_distance.values.push_back(static_cast<double>(distance));
      if (i < 100) (*writer)->append(one, {time, words, values});
      if (i % 5000 == 0) (*writer)->append(SessionEvent{time, "bookmark", "", "here", {}});
    }
    QVERIFY((*writer)->finish());
  }

  void theFileHoldsExtremesOfEvery256Rows() {
    const auto reader = session();
    QVERIFY(reader->hasSummaries());
    QCOMPARE(reader->summary(0).rows(), std::uint64_t{100});
    const GroupSummary summary = reader->summary(1);
    QCOMPARE(summary.rows(), std::uint64_t{rowCount});
    QCOMPARE(summary.parts.size(), std::size_t{3});
    std::size_t row = 0;
    for (const SummaryPart& part : summary.parts) {
      QCOMPARE(part.columns[0].min, std::vector<float>{7.0F});  // it never changed
      for (std::size_t b = 0; b < part.buckets(); ++b) {
        float low = INFINITY, high = -INFINITY;
        QCOMPARE(part.begin[b], m_distance.times[row]);
        for (std::uint32_t i = 0; i < part.rows[b]; ++i, ++row) {
          const auto value = static_cast<float>(m_distance.values[row]);
          if (std::isnan(value)) continue;
          low = std::min(low, value);
          high = std::max(high, value);
        }
        QCOMPARE(part.end[b], m_distance.times[row - 1]);
        QCOMPARE(part.columns[2].min.at(b), low);
        QCOMPARE(part.columns[2].max.at(b), high);
      }
    }
    QVERIFY(reader->notes().empty());
    QCOMPARE(reader->events().size(), std::size_t{8});
  }

  /// Columns of every kind in any order, short rows, infinities, signed zeros, and unknown values
  /// of several kinds, against a loop that takes one value at a time.
  void bucketsHoldTheExtremesOfAnyColumns() {
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    constexpr std::array types{ColumnType::Int32, ColumnType::Float32, ColumnType::Float64};
    const std::array<double, 8> values{
        1.5,          -2.0,          0.0,  -0.0,
        std::nan(""), -std::nan(""), 1e39, -std::numeric_limits<double>::infinity()};
    std::mt19937 random(48);
    for (int round = 0; round < 30; ++round) {
      GroupInfo group{"B1", {}, {}, {}, {}};
      std::size_t words = 0, doubles = 0;
      for (int c = static_cast<int>(random() % 40); c >= 0; --c) {
        ColumnInfo column{
            "C" + std::to_string(c), types[random() % 3], "", "", ColumnKind::Number, {}};
        if (random() % 6 == 0) column.lost.push_back({"C0", 1.5});
        ++(column.type == ColumnType::Float64 ? doubles : words);
        group.columns.push_back(std::move(column));
      }
      const std::vector<Slot> places = slotsOf(group.columns);
      const std::vector<Losable> losable = losableColumns(group);
      SummaryPart::Column start{{unknown}, {unknown}, {unknown}};
      std::vector<SummaryPart::Column> expected(group.columns.size(), start);
      SummaryBuilder builder(group);
      for (int row = static_cast<int>(random() % 200); row >= 0; --row) {
        std::vector<std::uint32_t> ownWords;
        std::vector<double> ownValues;
        for (std::size_t i = random() % 10 == 0 ? words / 2 : 0; i < words; ++i) {
          const auto value = static_cast<float>(values[random() % values.size()]);
          ownWords.push_back(std::bit_cast<std::uint32_t>(value));
        }
        for (std::size_t i = 0; i < doubles; ++i) {
          ownValues.push_back(values[random() % values.size()]);
        }
        const RowView view{0.02 * row, ownWords, ownValues};
        QVERIFY(!builder.add(view.time, view));
        for (std::size_t c = 0; c < places.size(); ++c) {
          const auto [type, index] = places[c];
          float number = unknown;
          if (type == ColumnType::Float64)
            number = static_cast<float>(ownValues[index]);
          else if (index < ownWords.size() && type == ColumnType::Int32)
            number = static_cast<float>(std::bit_cast<std::int32_t>(ownWords[index]));
          else if (index < ownWords.size())
            number = std::bit_cast<float>(ownWords[index]);
          for (const Losable& one : losable) {
            if (one.column == c && one.isLost(view)) number = unknown;
          }
          float& min = expected[c].min[0];
          float& max = expected[c].max[0];
          if (!std::isnan(number) && !(min <= number)) min = number;
          if (!std::isnan(number) && !(max >= number)) max = number;
          expected[c].last[0] = number;
        }
      }
      const auto part = builder.finish();
      QVERIFY(part);
      const auto bits = [](const SummaryPart::Column& column) {
        return std::array{std::bit_cast<std::uint32_t>(column.min[0]),
                          std::bit_cast<std::uint32_t>(column.max[0]),
                          std::bit_cast<std::uint32_t>(column.last[0])};
      };
      for (std::size_t c = 0; c < places.size(); ++c) {
        QCOMPARE(bits(part->columns[c]), bits(expected[c]));
      }
    }
  }

  void aPagedViewShowsTheWholeLengthAndThenEveryRow() {
    const auto reader = session();
    auto pages = std::make_shared<Pages>(*reader);
    SeriesStore store;
    for (const SessionGroup& group : reader->groups()) store.addGroup(group.info);
    store.setPages(pages);
    const auto id = store.find("B2", "VISION_BALL_DIST");
    QVERIFY(id);
    const double end = (rowCount - 1) / rate;
    QCOMPARE(store.range()->end, end);
    std::vector<SeriesBucket> buckets(40);
    store.view(id->group)->buckets(id->column, {0.0, end}, buckets);
    std::size_t row = 0;
    for (std::size_t b = 0; b < buckets.size(); ++b) {
      // Every extreme of the rows is in what is drawn at their place.
      const double until = end * static_cast<double>(b + 1) / 40.0;
      for (; row < m_distance.times.size() && m_distance.times[row] < until; ++row) {
        if (std::isnan(m_distance.values[row])) continue;
        QVERIFY(buckets[b].min <= m_distance.values[row]);
        QVERIFY(buckets[b].max >= m_distance.values[row]);
      }
      QVERIFY(buckets[b].samples > 0);
    }
    const SeriesStatistics all = store.view(id->group)->statistics(id->column, {0.0, end});
    QCOMPARE(all.samples, std::uint64_t{rowCount});
    QVERIFY(std::abs(all.mean - 100.0) < 10.0);

    // A moment: nothing is made up, it is asked for.
    pages->wanted.reset();
    QVERIFY(!store.view(id->group)->at(id->column, 400.0));
    QVERIFY(pages->wanted && pages->wanted->begin <= 400.0 && pages->wanted->end >= 400.0);
    pages->load({390.0, 420.0});
    const auto view = store.view(id->group);
    QCOMPARE(view->at(id->column, 400.0)->time, 400.0);
    std::vector<Sample> samples;
    QVERIFY(view->samples(id->column, {395.0, 405.0}, samples));
    QCOMPARE(samples.size(), std::size_t{501});
    QCOMPARE(samples.front().value, m_distance.values[19'750]);
    // Beyond the stretch: single rows, and it is said that they are not all.
    QVERIFY(!view->samples(id->column, {0.0, end}, samples));
    QVERIFY(samples.size() > 100 && samples.size() < 200);
    for (const Sample& sample : samples) {
      const auto at = static_cast<std::size_t>(std::lround(sample.time * rate));
      const double value = m_distance.values[at];
      QVERIFY(sample.value == value || (std::isnan(sample.value) && std::isnan(value)));
    }
  }

  void aClipHasSummariesOfItsOwn() {
    const auto whole = session();
    const std::string path = m_folder.filePath("clip.mcap").toStdString();
    QVERIFY(exportFile(*whole, ExportFormat::Mcap, {}, path));
    const auto same = SessionReader::open(path);
    QVERIFY(same->summary(0).parts == whole->summary(0).parts);
    QVERIFY(same->summary(1).parts == whole->summary(1).parts);
    // A part of the time and of the columns.
    const double until = 20'000 / rate;
    ExportSelection part;
    part.range = {0.0, until};
    // Without the variable that says when the ball was lost the old values would count.
    part.variables = {"VISION_BALL_DIST", "VISION_WORKING"};
    const std::string shorter = m_folder.filePath("shorter.mcap").toStdString();
    QVERIFY(exportFile(*whole, ExportFormat::Mcap, part, shorter));
    const auto clip = SessionReader::open(shorter);
    QVERIFY(clip->hasSummaries());
    const GroupSummary summary = clip->summary(1);
    QCOMPARE(summary.rows(), std::uint64_t{20'001});
    QCOMPARE(summary.range()->end, until);
    QCOMPARE(summary.parts[0].columns.size(), std::size_t{2});
    QCOMPARE(summary.parts[0].columns[1].max, whole->summary(1).parts[0].columns[2].max);
    // Again and again.
    const std::string again = m_folder.filePath("again.mcap").toStdString();
    QVERIFY(exportFile(*clip, ExportFormat::Mcap, {}, again));
    QVERIFY(SessionReader::open(again)->summary(1).parts == summary.parts);
  }

  void aRecordingThatBrokeOffShowsItsWholeLength() {
    const std::string broken = m_folder.filePath("broken.mcap").toStdString();
    QFile file(QString::fromStdString(m_path));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray bytes = file.read(file.size() * 85 / 100);
    std::ofstream(broken, std::ios::binary).write(bytes.data(), bytes.size());
    const std::string repaired = m_folder.filePath("repaired.mcap").toStdString();
    QVERIFY(repairSession(broken, repaired));
    for (const std::string& path : {broken, repaired}) {
      const auto reader = SessionReader::open(path);
      QVERIFY(reader && reader->complete() == (path == repaired));
      QVERIFY(reader->hasSummaries());
      for (GroupId group = 0; group < 2; ++group) {
        std::uint64_t rows = 0;
        double end = 0.0;
        const std::array<GroupId, 1> only{group};
        reader->rows({-1e9, 1e9}, only, [&](GroupId, const RowView& row) {
          ++rows;
          end = row.time;
          return true;
        });
        const GroupSummary summary = reader->summary(group);
        QCOMPARE(summary.rows(), rows);
        QVERIFY(rows > (group == 0 ? 99U : std::uint64_t{rowCount} / 2));
        QCOMPARE(summary.range()->end, end);
      }
    }
    // A caller that cancels gets nothing and may ask again.
    const auto reader = SessionReader::open(broken);
    QVERIFY(reader->summary(0, [] { return false; }).parts.empty());
    QCOMPARE(reader->summary(0).rows(), std::uint64_t{100});
  }

  void bytesThatAreNoSummaryAreRefused() {
    const auto reader = session();
    const SummaryPart part = reader->summary(1).parts.front();
    const std::string bytes = session::summaryBytes(part);
    const std::size_t columns = part.columns.size();
    QVERIFY(session::summaryFromBytes(bytes, columns));
    QVERIFY(!session::summaryFromBytes(bytes, columns - 1));
    // A column that came later.
    const auto wide = session::summaryFromBytes(bytes, columns + 1);
    QVERIFY(wide && std::isnan(wide->columns.back().max.front()));
    for (std::size_t length = 0; length < bytes.size(); length += 7) {
      QVERIFY(!session::summaryFromBytes(bytes.substr(0, length), columns));
    }
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
      std::string damaged = bytes;
      damaged[random() % 64] = static_cast<char>(random());
      if (const auto read = session::summaryFromBytes(damaged, columns)) {
        QVERIFY(read->buckets() > 0 && read->columns.size() == columns);
      }
    }
  }

  void aShortSessionHasNone() {
    const std::string path = m_folder.filePath("short.mcap").toStdString();
    auto writer = SessionWriter::create(path, sessionInfo());
    QVERIFY(writer);
    record(**writer, 300);
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    QVERIFY(reader && !reader->hasSummaries());
  }
};

PITCHBOARD_TEST(TestSessionSummary)

}  // namespace tst_session_summary

#include "tst_session_summary.moc"

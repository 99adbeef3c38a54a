// SPDX-License-Identifier: GPL-3.0-or-later
// What is painted of a curve, pixel column by pixel column: every column that has samples, and none
// in a silence, whatever the width of the plot and the length of the range.

#include <QPainter>
#include <QtTest>
#include <cmath>

#include <telemetry/series/series_pages.h>

#include "curve_trace.h"
#include "plot_source.h"

namespace tst_curve_trace {

using namespace pitchboard;
using namespace pitchboard::ui;
using telemetry::TimeRange;

namespace {

/// A session that is larger than memory: only its summary is at hand.
class SummaryOnly : public telemetry::SeriesPages {
 public:
  std::shared_ptr<const telemetry::GroupSummary> summary(telemetry::GroupId, bool) override {
    return all;
  }
  std::optional<Stretch> held(telemetry::GroupId, std::optional<TimeRange>) override { return {}; }
  void want(TimeRange) override {}
  std::optional<telemetry::SeriesStatistics> statistics(telemetry::GroupId, std::uint32_t,
                                                        TimeRange) override {
    return {};
  }
  bool isReading(TimeRange) override { return false; }
  std::uint64_t revision() override { return 1; }
  void setListener(std::function<void()>) override {}
  TimeRange range() override { return all->range().value_or(TimeRange{}); }
  std::size_t bytes() override { return 0; }

  std::shared_ptr<telemetry::GroupSummary> all = std::make_shared<telemetry::GroupSummary>();
};

/// Rows of one number, in memory and as the summary of a file. `isThere` says when there are rows.
struct Rows {
  Rows(double seconds, double rate, const std::function<bool(double)>& isThere) {
    telemetry::GroupInfo info{"B1", {{"X", telemetry::ColumnType::Float64, "", "", {}, {}}}, {}};
    const auto group = store.addGroup(info);
    telemetry::SummaryBuilder builder(info);
    const auto keep = [this](std::optional<telemetry::SummaryPart> part) {
      if (part) pages->all->parts.push_back(std::move(*part));
    };
    for (std::size_t i = 0; static_cast<double>(i) / rate <= seconds; ++i) {
      const double time = static_cast<double>(i) / rate;
      if (!isThere(time)) continue;
      times.push_back(time);
      const double value = 50.0 + 30.0 * std::sin(static_cast<double>(i) * 0.7);
      const telemetry::RowView row{time, {}, std::span(&value, 1)};
      store.append(group, row);
      keep(builder.add(time, row));
    }
    keep(builder.finish());
    inMemory = {store.view(group), 0};
    inFile = {telemetry::pagedView(store.view(group), group, pages), 0};
  }
  /// Whether there are rows in [begin, end).
  bool any(double begin, double end) const {
    const auto next = std::ranges::lower_bound(times, begin);
    return next != times.end() && *next < end;
  }

  telemetry::SeriesStore store;
  std::shared_ptr<SummaryOnly> pages = std::make_shared<SummaryOnly>();
  ColumnView inMemory, inFile;
  std::vector<double> times;
};

/// Which columns of pixels have some ink.
std::vector<bool> paintedColumns(const ColumnView& view, TimeRange range, int width, bool thin) {
  const CurveTrace trace = traceOf(view, range, width);
  QImage image(width, 100, QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::white);
  QPainter painter(&image);
  const TimeAxis time{range, 0.0, static_cast<double>(width)};
  TraceLook look;
  look.color = Qt::black;
  look.thin = thin;
  painter.setClipRect(image.rect());
  paintTrace(painter, trace, polylines(trace, time, {{0.0, 100.0}, 0.0, 100.0}, false), time, look);
  painter.end();
  std::vector<bool> painted(static_cast<std::size_t>(width), false);
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < image.height() && !painted[static_cast<std::size_t>(x)]; ++y) {
      painted[static_cast<std::size_t>(x)] = qGray(image.pixel(x, y)) < 255;
    }
  }
  return painted;
}

}  // namespace

class TestCurveTrace : public QObject {
  Q_OBJECT

 private slots:
  void everyColumnWithSamplesIsPainted_data() {
    QTest::addColumn<double>("seconds");
    QTest::addColumn<double>("rate");
    QTest::addColumn<bool>("inFile");
    for (const bool inFile : {false, true}) {
      for (const auto& [name, seconds, rate] : {std::tuple{"10 s", 10.0, 60.0},
                                                {"one minute", 60.0, 60.0},
                                                {"ten minutes", 600.0, 60.0},
                                                {"two hours", 7200.0, 10.0},
                                                {"two hours, a row a second", 7200.0, 1.0},
                                                {"a day", 86400.0, 2.0},
                                                {"a day, a row in 5 s", 86400.0, 0.2}}) {
        QTest::addRow("%s, %s", name, inFile ? "envelope" : "rows") << seconds << rate << inFile;
      }
    }
  }
  void everyColumnWithSamplesIsPainted() {
    QFETCH(double, seconds);
    QFETCH(double, rate);
    QFETCH(bool, inFile);
    // Rows come without a break, with a silence in the middle, and with only a little between two
    // silences. A bucket of the summary spans silences that lie within it.
    const double unit = std::max(seconds / 10, inFile ? 600.0 / rate : 30.0);
    const auto always = [](double) { return true; };
    const auto once = [&](double t) { return t < seconds / 2 || t > seconds / 2 + unit; };
    const auto little = [&](double t) {
      return t < 0.3 * seconds || t > 0.8 * seconds || std::abs(t - 0.55 * seconds) < 2.0 / rate;
    };
    for (const auto& isThere :
         {std::function<bool(double)>(always), std::function<bool(double)>(once),
          std::function<bool(double)>(little)}) {
      const Rows rows(seconds, rate, isThere);
      for (const int width : {200, 333, 480, 719, 720, 721, 1000, 2000}) {
        for (const bool thin : {false, true}) {
          const TimeRange range{0.0, seconds};
          const auto painted =
              paintedColumns(inFile ? rows.inFile : rows.inMemory, range, width, thin);
          const double pixel = seconds / width;
          for (int x = 0; x < width; ++x) {
            const double begin = x * pixel, end = begin + pixel;
            const bool ink = painted[static_cast<std::size_t>(x)];
            const auto where = [&] {
              return qPrintable(QStringLiteral("column %1 of %2, %3, %4 rows")
                                    .arg(x)
                                    .arg(width)
                                    .arg(thin ? "thin" : "wide")
                                    .arg(rows.times.size()));
            };
            // Columns stand on multiples of their width, up to a pixel beside those of the screen.
            const bool inside = rows.any(begin, end) && rows.any(begin - pixel, begin) &&
                                rows.any(end, end + pixel);
            if (inside) QVERIFY2(ink, where());
            if (rows.any(begin, end) && !ink) {
              const bool beside = (x > 0 && painted[static_cast<std::size_t>(x) - 1]) ||
                                  (x + 1 < width && painted[static_cast<std::size_t>(x) + 1]);
              QVERIFY2(beside, where());
            }
            // A dot reaches a few pixels into a silence; a bridge is at most so long.
            const double reach = 4 * pixel + maxBridge + (inFile ? 256.0 / rate : 0.0);
            if (!rows.any(begin - reach, end + reach)) QVERIFY2(!ink, where());
          }
        }
      }
    }
  }

  /// A silence is one at every zoom at which a pixel is shorter than it.
  void aSilenceIsAGapAtEveryWidth() {
    const Rows rows(7200.0, 10.0, [](double t) { return t < 3000.0 || t > 3060.0; });
    for (const int width : {480, 720, 1000, 2000}) {
      const auto middle = static_cast<std::size_t>(3030.0 / 7200.0 * width);
      for (const bool thin : {false, true}) {
        const auto painted = paintedColumns(rows.inMemory, {0.0, 7200.0}, width, thin);
        QVERIFY2(!painted[middle], qPrintable(QString::number(width)));
      }
    }
  }
};

PITCHBOARD_GUI_TEST(TestCurveTrace)

}  // namespace tst_curve_trace

#include "tst_curve_trace.moc"

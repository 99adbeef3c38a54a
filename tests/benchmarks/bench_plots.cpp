// SPDX-License-Identifier: GPL-3.0-or-later
// Milliseconds for one frame while a plot with 10 curves of a million samples each is panned or
// zoomed, by software rendering: the data, the axes and the painting of the whole panel. And what
// one curve costs with Qt's own line series instead of our painter.

#include <benchmark/benchmark.h>

#include <QApplication>
#include <QChart>
#include <QChartView>
#include <QImage>
#include <QLegend>
#include <QLineSeries>
#include <QValueAxis>

#include <chrono>
#include <cmath>
#include <memory>
#include <random>

#include <telemetry/series/series_store.h>
#include <ui/base/plot_target.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

#include "frame_times.h"
#include "plot_feed.h"
#include "plot_page.h"
#include "without_screen.h"

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

constexpr int rows = 1'000'000;
constexpr int curves = 10;
constexpr double rate = 60.0;

class StoredSource : public FrameSource {
 public:
  StoredSource() : m_store(std::make_shared<telemetry::SeriesStore>()) {
    telemetry::GroupInfo info;
    info.name = "B1";
    for (int c = 0; c < curves; ++c) {
      telemetry::ColumnInfo column;
      column.name = "V" + std::to_string(c);
      info.columns.push_back(column);
    }
    const telemetry::GroupId group = m_store->addGroup(info);
    std::mt19937 engine(1);
    std::normal_distribution<double> noise;
    std::vector<double> values(curves);
    for (int i = 0; i < rows; ++i) {
      for (int c = 0; c < curves; ++c) {
        values[std::size_t(c)] = 10.0 * c + 4.0 * std::sin(i * 1e-4 * (c + 1)) + noise(engine);
      }
      m_store->append(group, {i / rate, {}, values});
    }
  }
  const SourceKind& kind() const override { return SourceKind::Simulate; }
  FramePtr frame() const override { return {}; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return m_store; }
  QString emptyText() const override { return {}; }

 private:
  std::shared_ptr<telemetry::SeriesStore> m_store;
};

struct Bench {
  ShownMoment sources;
  LinkedTime time{&sources};
  PlotTarget target;
  std::unique_ptr<PlotsDock> dock;

  explicit Bench(StoredSource* source, QSize size, int shown = curves) : sources(source) {
    PlotsContext context;
    context.shown = &sources;
    context.time = &time;
    context.plots = &target;
    dock = std::make_unique<PlotsDock>(context, nullptr);
    dock->resize(size);
    dock->show();
    dock->feed()->refresh();
    QStringList names;
    for (int c = 0; c < shown; ++c) names << QStringLiteral("B1/V%1").arg(c);
    dock->currentPage()->addVariables(names);
    QCoreApplication::processEvents();
  }
};

StoredSource& source() {
  static StoredSource stored;
  return stored;
}

/// `span`: seconds visible; all rows are rows / rate = 16 667 s.
void frames(benchmark::State& state, bool zoom) {
  Bench bench(&source(), {int(state.range(0)), int(state.range(1))});
  const double span = double(state.range(2));
  bench.time.setRange({0.0, span});
  QImage screen(bench.dock->size(), QImage::Format_RGB32);
  FrameTimes times(1e-3);
  int i = 0;
  for (auto _ : state) {
    times.begin();
    if (zoom)
      bench.time.zoom(i++ % 20 < 10 ? 0.95 : 1 / 0.95, span / 3);
    else
      bench.time.pan(span / 300 * (i++ % 200 < 100 ? 1 : -1));
    bench.dock->currentPage()->refresh();
    bench.dock->render(&screen);
    times.end();
  }
  times.report(state);
}

/// A chart as Qt makes it, with one line.
struct QtChart {
  QChartView view;
  QLineSeries* line = new QLineSeries;
  QValueAxis* x = new QValueAxis;
  QValueAxis* y = new QValueAxis;

  explicit QtChart(QSize size) {
    view.chart()->legend()->hide();
    view.chart()->addSeries(line);
    view.chart()->addAxis(x, Qt::AlignBottom);
    view.chart()->addAxis(y, Qt::AlignLeft);
    line->attachAxis(x);
    line->attachAxis(y);
    line->setPen(QPen(Qt::red, 0));
    y->setRange(-10, 10);
    view.resize(size);
    view.show();
    QCoreApplication::processEvents();
  }
};

QList<QPointF> allRows(const ColumnView& column, telemetry::TimeRange range) {
  std::vector<telemetry::Sample> samples;
  column.group->samples(column.column, range, samples, rows);
  QList<QPointF> points;
  points.reserve(qsizetype(samples.size()));
  for (const auto& sample : samples) points.emplace_back(sample.time, sample.value);
  return points;
}

QList<QPointF> reduced(const ColumnView& column, telemetry::TimeRange range, int columns) {
  const CurveTrace trace = traceOf(column, range, columns);
  QList<QPointF> points;
  for (const auto& sample : trace.samples) points.emplace_back(sample.time, sample.value);
  for (const auto& c : trace.columns) {
    for (const double value : {c.first, c.min, c.max, c.last}) points.emplace_back(c.time, value);
  }
  return points;
}

/// One curve over all its time, panned: our whole panel, Qt's line series with every row, and Qt's
/// with only the points that our painter takes. The ratios are Qt's time over ours.
void line_series(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  const QSize size(int(state.range(0)), int(state.range(1)));
  Bench ours(&source(), size, 1);
  QtChart every(size), few(size);
  const ColumnView column = ours.dock->currentPage()->panes().first()->curves()[0].view();
  every.line->replace(allRows(column, {0.0, rows / rate}));
  QImage screen(size, QImage::Format_RGB32);
  double seconds[3] = {};
  const auto timed = [&](double& sum, auto frame) {
    const auto begin = Clock::now();
    frame();
    sum += std::chrono::duration<double>(Clock::now() - begin).count();
  };
  double begin = 0.0;
  for (auto _ : state) {
    begin += 50.0;
    const telemetry::TimeRange range{begin, begin + rows / rate};
    timed(seconds[0], [&] {
      ours.time.setRange(range);
      ours.dock->currentPage()->refresh();
      ours.dock->render(&screen);
    });
    timed(seconds[1], [&] {
      every.x->setRange(range.begin, range.end);
      every.view.QWidget::render(&screen);
    });
    timed(seconds[2], [&] {
      few.line->replace(reduced(column, range, size.width()));
      few.x->setRange(range.begin, range.end);
      few.view.QWidget::render(&screen);
    });
  }
  const auto frames = double(state.iterations());
  state.counters["ours_ms"] = seconds[0] / frames * 1e3;
  state.counters["every_row_ms"] = seconds[1] / frames * 1e3;
  state.counters["reduced_ms"] = seconds[2] / frames * 1e3;
  state.counters["every_row_ratio"] = seconds[1] / seconds[0];
  state.counters["reduced_ratio"] = seconds[2] / seconds[0];
}

void pan(benchmark::State& state) {
  frames(state, false);
}
void zoom(benchmark::State& state) {
  frames(state, true);
}

void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"width", "height", "seconds"})
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MinTime(1.0);
  // All of it; a part in columns; about two samples a pixel; few samples.
  for (const int seconds : {16'000, 1'000, 50, 15}) {
    benchmark->Args({1280, 400, seconds})->Args({1920, 1000, seconds});
  }
}

BENCHMARK(pan)->Apply(cases);
BENCHMARK(zoom)->Apply(cases);
BENCHMARK(line_series)
    ->ArgNames({"width", "height"})
    ->Args({1280, 400})
    ->Args({1920, 1000})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(10);

}  // namespace

int main(int argc, char** argv) {
  return runWithoutScreen(argc, argv);
}

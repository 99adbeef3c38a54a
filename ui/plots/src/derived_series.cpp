// SPDX-License-Identifier: GPL-3.0-or-later
#include "derived_series.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <telemetry/expression/expression_unit.h>
#include <telemetry/series/derived_curve.h>
#include <telemetry/series/series_summary.h>
#include <ui/base/workers.h>

#include "expression.h"

namespace pitchboard::ui {
namespace {

using telemetry::Sample;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t rowsAtOnce = 1 << 16;
constexpr std::size_t memoryBudget = std::size_t{256} << 20;  // bytes of one derived curve
// An input without samples for longer is not waited for; its last value holds until its group is
// silent (isSilent()).
constexpr double maxWait = 1.0;  // s
constexpr std::size_t tailRows = 64;

/// One row of inputs to one value; the first input's time is the row's.
using Step = std::function<double(double time, std::span<const double> values)>;

template <class Curve>
Step stepOf(Curve curve) {
  return [curve](double time, std::span<const double> values) mutable {
    return curve.next(Sample{time, values[0]}).value;
  };
}

double halfTurn(const CurveSpec& spec, const std::string& unit) {
  if (spec.parameter > 0.0) return spec.parameter / 2;
  return unit == "rad" ? std::numbers::pi : 180.0;
}

Step makeStep(const CurveSpec& spec, const std::string& unit) {
  switch (spec.kind) {
    case CurveKind::Derivative:
      return stepOf(telemetry::Derivative());
    case CurveKind::Integral:
      return stepOf(telemetry::Integral());
    case CurveKind::MovingAverage:
      return stepOf(telemetry::MovingAverage(spec.parameter));
    case CurveKind::WrapAngle:
      return stepOf(telemetry::WrapAngle(halfTurn(spec, unit)));
    case CurveKind::Conversion:
      return stepOf(telemetry::LinearConversion{spec.parameter, spec.offset});
    case CurveKind::Difference:
      return [](double, std::span<const double> values) { return values[0] - values[1]; };
    case CurveKind::Expression: {
      auto expression = PlotExpression::parse(spec.expression);
      if (!expression) return {};
      auto shared = std::make_shared<PlotExpression>(std::move(*expression));
      return [shared](double time, std::span<const double> values) {
        return shared->evaluate(time, values);
      };
    }
    case CurveKind::Variable:
      break;
  }
  return {};
}

/// As in questions about sessions (telemetry/query).
bool isSilent(const Sample& newest, double time) {
  return time - newest.time > telemetry::SummaryPart::maxSilence;
}

/// "1" for a code, which has none; empty if it is unknown.
std::string unitOf(const ColumnView& view) {
  return view.isCoded() ? "1" : view.info().unit;
}

/// The unit of a derived curve; empty if it is unknown, or if there is none.
std::string unitOf(const CurveSpec& spec, const QStringList& inputs,
                   const std::vector<ColumnView>& views) {
  if (!spec.unit.isEmpty()) return spec.unit.toStdString();
  const std::string input = unitOf(views[0]);
  std::string unit;
  switch (spec.kind) {
    case CurveKind::Derivative:
      unit = telemetry::timesSeconds(input, -1);
      break;
    case CurveKind::Integral:
      unit = telemetry::timesSeconds(input, 1);
      break;
    case CurveKind::Conversion:
      break;
    case CurveKind::Difference:
      if (unitOf(views[1]) == input) unit = input;
      break;
    case CurveKind::Expression: {
      const auto unitOfInput = [&](const std::string& name) -> std::optional<std::string> {
        const qsizetype index = inputs.indexOf(QString::fromStdString(name));
        if (index < 0) return std::nullopt;
        const std::string known = unitOf(views[static_cast<std::size_t>(index)]);
        return known.empty() ? std::nullopt : std::optional(known);
      };
      unit = telemetry::unitOfExpression(spec.expression.toStdString(), unitOfInput).value_or("");
      break;
    }
    default:
      unit = input;
  }
  return unit == "1" ? std::string() : unit;
}

}  // namespace

/// Shared with the job on the worker thread. `step`, `store`'s writing side and `done` belong to
/// the job while `running`, else to the UI thread.
struct DerivedSeries::Work {
  CurveSpec spec;
  QStringList inputs;
  QString fault;
  Step step;
  telemetry::SeriesStore store{{memoryBudget}};
  telemetry::GroupId group = 0;
  std::atomic<bool> running = false;
  std::atomic<bool> cancelled = false;
  double done = -infinity;   ///< time of the newest row computed
  std::vector<Sample> tail;  ///< of the first input: the last ones that were used
  quint64 generation = 0;
  bool behind = false;
  std::optional<telemetry::TimeRange> stretch;  ///< rows are computed for this range only

  void run(const std::vector<ColumnView>& views, double until);
  bool isRewritten(const ColumnView& view) const;
};

void DerivedSeries::Work::run(const std::vector<ColumnView>& views, double until) {
  std::vector<Sample> times;
  std::vector<std::vector<Sample>> others(views.size());
  std::vector<double> values(views.size());
  bool all = false;
  while (!all && !cancelled) {
    times.clear();
    all = views[0].group->samples(views[0].column, {std::nextafter(done, infinity), until}, times,
                                  rowsAtOnce);
    if (times.empty()) break;
    std::vector<std::size_t> next(views.size(), 0);
    std::vector<Sample> held(views.size(), {-infinity, std::nan("")});
    for (std::size_t i = 1; i < views.size(); ++i) {
      held[i] = views[i].group->at(views[i].column, times.front().time).value_or(held[i]);
      others[i].clear();
      views[i].group->samples(views[i].column,
                              {std::nextafter(times.front().time, infinity), times.back().time},
                              others[i]);
    }
    for (const Sample& sample : times) {
      values[0] = sample.value;
      for (std::size_t i = 1; i < views.size(); ++i) {
        while (next[i] < others[i].size() && others[i][next[i]].time <= sample.time) {
          held[i] = others[i][next[i]++];
        }
        values[i] = isSilent(held[i], sample.time) ? std::nan("") : held[i].value;
      }
      const double value = step(sample.time, values);
      store.append(group, {sample.time, {}, std::span(&value, 1)});
    }
    done = times.back().time;
    const double from = times[times.size() - std::min(times.size(), tailRows)].time;
    // Where only every 256th row is at hand, another look may find others.
    if (!views[0].group->samples(views[0].column, {from, done}, tail)) tail.clear();
  }
}

/// The source was put back and has come further than before since: these rows are others.
bool DerivedSeries::Work::isRewritten(const ColumnView& view) const {
  if (tail.empty()) return false;
  std::vector<Sample> now;
  if (!view.group->samples(view.column, {tail.front().time, done}, now)) return false;
  return !std::ranges::equal(now, tail, [](const Sample& a, const Sample& b) {
    return a.time == b.time && (a.value == b.value || (std::isnan(a.value) && std::isnan(b.value)));
  });
}

DerivedSeries::DerivedSeries(const CurveSpec& spec) : m_work(std::make_shared<Work>()) {
  m_work->spec = spec;
  m_work->inputs = spec.inputs;
  if (spec.kind == CurveKind::Expression) {
    const auto expression = PlotExpression::parse(spec.expression);
    if (expression)
      m_work->inputs = expression->variables();
    else
      m_work->fault = QString::fromStdString(expression.error().message);
  }
}

DerivedSeries::~DerivedSeries() {
  m_work->cancelled = true;
  if (m_next) m_next->cancelled = true;
}

bool DerivedSeries::isFaulty() const {
  return !m_work->fault.isEmpty();
}

bool DerivedSeries::isWorking() const {
  return !isFaulty() && (m_work->running || m_work->behind || m_next);
}

std::shared_ptr<DerivedSeries::Work> DerivedSeries::fresh(quint64 generation) const {
  auto work = std::make_shared<Work>();
  work->spec = m_work->spec;
  work->inputs = m_work->inputs;
  work->generation = generation;
  return work;
}

/// Of a session that is larger than memory a curve is computed for what is shown. True: there are,
/// or will be, rows for all of it.
bool DerivedSeries::takeStretch(const std::vector<ColumnView>& views, telemetry::TimeRange shown) {
  if (m_next && !m_next->running) {
    m_work = std::move(m_next);
    m_next.reset();
    m_work->behind = false;
  }
  // A derivative needs the row before, an average the rows of its window, and several inputs the
  // last value of each.
  double lead = views.size() > 1 ? telemetry::SummaryPart::maxSilence : maxWait;
  if (m_work->spec.kind == CurveKind::MovingAverage) lead = std::max(lead, m_work->spec.parameter);
  const double span = shown.end - shown.begin;
  const auto has = [&](double more) {
    const telemetry::TimeRange range{shown.begin - lead - more, shown.end + more};
    return std::ranges::all_of(
        views, [&range](const ColumnView& view) { return view.group->hasEveryRow(range); });
  };
  const auto& known = m_work->stretch;
  if (m_next || (known && known->begin <= shown.begin && shown.end <= known->end)) return true;
  // A little more than is shown, so that little has to be done when time goes on.
  const bool wide = has(span / 2);
  if (!wide && !has(0.0)) return false;
  const double more = wide ? span / 2 : 0.0;
  m_next = fresh(m_work->generation);
  m_next->stretch = {shown.begin - more, shown.end + more};
  m_next->done = shown.begin - more - lead;
  return true;
}

void DerivedSeries::start(std::vector<ColumnView> views, double until) {
  const auto& work = m_next ? m_next : m_work;
  if (work->running) return;
  if (!work->step) {
    work->step = makeStep(work->spec, views[0].info().unit);
    telemetry::GroupInfo info;
    info.name = "derived";
    telemetry::ColumnInfo column;
    column.name = "value";
    column.unit = unitOf(work->spec, work->inputs, views);
    info.columns.push_back(column);
    work->group = work->store.addGroup(info);
  }
  work->running = true;
  sharedWorkers().start([work, views = std::move(views), until] {
    work->run(views, until);
    work->running = false;
  });
}

void DerivedSeries::update(const Lookup& find, quint64 generation, telemetry::TimeRange shown) {
  m_note = m_work->fault;
  m_missing.clear();
  if (isFaulty()) return;
  std::vector<ColumnView> views;
  for (const QString& input : m_work->inputs) {
    views.push_back(find(input));
    if (!views.back()) m_missing << input;
  }
  const auto newest = [&views](std::size_t i) {
    const auto range = views[i].group->range();
    return range ? range->end : -infinity;
  };
  const bool stale = m_work->generation != generation;
  const bool wentBack = !m_work->running && !m_work->stretch && m_missing.isEmpty() &&
                        (newest(0) < m_work->done || m_work->isRewritten(views[0]));
  if (stale || wentBack) {
    // Another source, or one that was put back: nothing computed so far holds.
    m_work->cancelled = true;
    if (m_next) m_next->cancelled = true;
    m_next.reset();
    m_work = fresh(generation);
  }
  if (!m_missing.isEmpty() || views.empty()) return;
  constexpr telemetry::TimeRange everything{-infinity, infinity};
  const bool paged = std::ranges::any_of(
      views, [&](const ColumnView& view) { return !view.group->hasEveryRow(everything); });
  if (paged) {
    if (m_work->spec.kind == CurveKind::Integral) {
      m_note = QStringLiteral("the session does not fit into memory: cannot integrate");
    } else if (!takeStretch(views, shown)) {
      m_note = QStringLiteral("zoom in: the session does not fit into memory");
    } else if (m_next) {
      start(std::move(views), m_next->stretch->end);
    }
    return;
  }
  if (m_work->running) return;
  double until = newest(0);
  const double longAgo = until - maxWait;
  for (std::size_t i = 1; i < views.size(); ++i) until = std::min(until, newest(i));
  until = std::max(until, longAgo);
  m_work->behind = until > m_work->done;
  if (m_work->behind) start(std::move(views), until);
}

ColumnView DerivedSeries::view() const {
  if (!m_work->fault.isEmpty() || m_work->store.groups() == 0) return {};
  auto view = m_work->store.view(0);
  if (!view || !view->range()) return {};
  return {std::move(view), 0};
}

}  // namespace pitchboard::ui

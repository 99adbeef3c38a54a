// SPDX-License-Identifier: GPL-3.0-or-later
#include "stretch_work.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include <base/try.h>

namespace pitchboard::ui {
namespace {

using telemetry::QueryRows;
using telemetry::TimeRange;

constexpr int progressSteps = 100;

/// The ranges of a session, in its own time.
Result<std::vector<TimeRange>> rangesOf(const StretchOrder& order, const StretchSource& source,
                                        const QueryRows& rows,
                                        std::span<const telemetry::SessionEvent> events) {
  const auto all = rows.range();
  if (!all) return failure(ErrorCode::NotFound, "There is no data yet.");
  TimeRange limits = *all;
  if (order.range) {
    limits = {order.range->begin - source.offset, order.range->end - source.offset};
  }
  if (!order.between) return std::vector<TimeRange>{limits};
  std::vector<TimeRange> out;
  const std::vector<TimeRange> between =
      TRY(telemetry::rangesBetween(events, all->end, order.between->first, order.between->second));
  for (TimeRange range : between) {
    range.begin = std::max(range.begin, limits.begin);
    range.end = std::min(range.end, limits.end);
    if (range.begin <= range.end) out.push_back(range);
  }
  return out;
}

Result<telemetry::StretchTable> tableOf(const StretchOrder& order, const StretchSource& source,
                                        const QueryRows& rows,
                                        std::span<const telemetry::SessionEvent> events,
                                        const std::function<bool(double)>& progress) {
  const std::vector<TimeRange> ranges = TRY(rangesOf(order, source, rows, events));
  return telemetry::describeStretch(rows, order.question, ranges, progress);
}

Result<telemetry::StretchTable> tableOf(const StretchOrder& order, const StretchSource& source,
                                        const std::function<bool(double)>& progress) {
  if (source.path.empty()) {
    if (source.rows == nullptr) return failure(ErrorCode::NotFound, "There is no data yet.");
    return tableOf(order, source, QueryRows(*source.rows), source.events, progress);
  }
  telemetry::McapReaderOptions reading;
  reading.progress = [&progress](double) { return progress(0.0); };
  const auto session = TRY(telemetry::SessionReader::open(source.path, reading));
  const bool hasEvents = order.between.has_value();
  const std::vector<telemetry::SessionEvent> events =
      hasEvents ? session.events() : std::vector<telemetry::SessionEvent>();
  return tableOf(order, source, QueryRows(session), events, progress);
}

}  // namespace

StretchWork::StretchWork(QObject* parent) : QObject(parent) {}

StretchWork::~StretchWork() {
  cancel();
}

void StretchWork::cancel() {
  if (m_running) *m_running = true;
  m_running.reset();
}

void StretchWork::start(StretchOrder order) {
  cancel();
  m_progress = 0.0;
  m_running = std::make_shared<std::atomic<bool>>(false);
  m_worker.start([this, order = std::move(order), cancelled = m_running] {
    if (*cancelled) return;
    const auto began = std::chrono::steady_clock::now();
    auto result = std::make_shared<const StretchResult>(describe(order, cancelled));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    m_ui.post([this, result = std::move(result), took = took.count(), cancelled] {
      if (cancelled != m_running) return;
      m_running.reset();
      m_result = result;
      m_duration = took;
      emit finished();
    });
  });
}

/// On the worker.
StretchResult StretchWork::describe(const StretchOrder& order, const Flag& cancelled) {
  StretchResult out;
  out.isCompared = !order.question.against.empty();
  const auto count = static_cast<double>(order.sources.size());
  int shown = -1;
  for (std::size_t s = 0; s < order.sources.size() && !*cancelled; ++s) {
    const StretchSource& source = order.sources[s];
    const auto progress = [&](double part) {
      const double whole = (static_cast<double>(s) + part) / count;
      const int step = static_cast<int>(std::floor(whole * progressSteps));
      if (std::exchange(shown, step) != step) {
        m_ui.post([this, whole, cancelled] {
          if (cancelled != m_running) return;
          m_progress = whole;
          emit progressed();
        });
      }
      return !*cancelled;
    };
    const auto note = [&](const std::string& name, const Error& error) {
      QString text = QString::fromStdString(error.text());
      if (!name.empty() && !text.contains(QString::fromStdString(name))) {
        text = QString::fromStdString(name) + QStringLiteral(": ") + text;
      }
      if (order.sources.size() > 1) {
        text = QString::fromStdString(source.name) + QStringLiteral(": ") + text;
      }
      if (!out.problems.contains(text)) out.problems << text;
    };
    auto table = tableOf(order, source, progress);
    if (!table) {
      note({}, table.error());
      continue;
    }
    ++out.sessions;
    for (const auto& problem : table->problems) note(problem.name, problem.error);
    for (telemetry::StretchLine& line : table->lines) {
      line.session = source.path.empty() ? source.name : source.path;
      out.lines.push_back(std::move(line));
      out.offsets.push_back(source.offset);
      out.numbers.push_back(source.number);
    }
  }
  return out;
}

}  // namespace pitchboard::ui

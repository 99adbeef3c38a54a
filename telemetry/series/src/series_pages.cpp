// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/series_pages.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <telemetry/series/derived_curve.h>

namespace pitchboard::telemetry {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Around a moment, s: what comes next is mostly near.
constexpr double nearby = 5.0;

double valueOf(const std::vector<float>& values, std::size_t bucket) {
  if (values.empty()) return nothing;
  return static_cast<double>(values.size() == 1 ? values.front() : values[bucket]);
}

class PagedView final : public GroupView {
 public:
  PagedView(std::shared_ptr<const GroupView> empty, GroupId group,
            std::shared_ptr<SeriesPages> pages)
      : m_empty(std::move(empty)), m_group(group), m_pages(std::move(pages)) {
    if (auto held = m_pages->held(group)) {
      m_held = held->range;
      m_rows = std::move(held->rows);
    }
  }

  const GroupInfo& info() const override { return m_empty->info(); }
  std::optional<TimeRange> range() const override {
    if (const auto summary = m_pages->summary(m_group, false)) return summary->range();
    return m_rows ? m_rows->range() : std::nullopt;
  }
  std::size_t rows() const override {
    const auto summary = m_pages->summary(m_group, true);
    return summary ? static_cast<std::size_t>(summary->rows()) : 0;
  }
  double rate() const override { return m_rows ? m_rows->rate() : 0.0; }

  std::optional<Sample> latest(std::uint32_t column) const override {
    const auto summary = m_pages->summary(m_group, false);
    if (!summary || summary->parts.empty()) return std::nullopt;
    const SummaryPart& part = summary->parts.back();
    if (column >= part.columns.size()) return std::nullopt;
    return Sample{part.end.back(), valueOf(part.columns[column].last, part.buckets() - 1)};
  }
  std::optional<Sample> at(std::uint32_t column, double time) const override {
    return holds({time, time}) ? m_rows->at(column, time) : std::nullopt;
  }
  bool rowAt(double time, double& rowTime, std::vector<std::uint32_t>& words,
             std::vector<double>& values) const override {
    return holds({time, time}) && m_rows->rowAt(time, rowTime, words, values);
  }
  std::optional<double> lastChange(std::uint32_t column) const override {
    return m_rows ? m_rows->lastChange(column) : std::nullopt;
  }

  void buckets(std::uint32_t column, TimeRange range, std::span<SeriesBucket> out) const override {
    if (holds(range)) return m_rows->buckets(column, range, out);
    std::fill(out.begin(), out.end(), SeriesBucket{nothing, nothing, nothing, nothing, 0});
    const double width = (range.end - range.begin) / static_cast<double>(out.size());
    if (!(width > 0.0)) return;
    each(column, range,
         [&](const SummaryPart& part, const SummaryPart::Column& values, std::size_t bucket) {
           const auto place = [&](double time) {
             return std::clamp((time - range.begin) / width, 0.0,
                               static_cast<double>(out.size() - 1));
           };
           const auto first = static_cast<std::size_t>(place(part.begin[bucket]));
           const auto last = static_cast<std::size_t>(place(part.end[bucket]));
           const std::uint32_t share =
               std::max(1U, part.rows[bucket] / static_cast<std::uint32_t>(last - first + 1));
           for (std::size_t i = first; i <= last; ++i) {
             SeriesBucket& to = out[i];
             const double low = valueOf(values.min, bucket), high = valueOf(values.max, bucket);
             to.min = std::fmin(to.min, low);
             to.max = std::fmax(to.max, high);
             if (to.samples == 0) to.first = valueOf(values.last, bucket);
             to.last = valueOf(values.last, bucket);
             to.samples += share;
           }
         });
  }

  bool samples(std::uint32_t column, TimeRange range, std::vector<Sample>& out,
               std::size_t most) const override {
    if (holds(range)) return m_rows->samples(column, range, out, most);
    out.clear();
    each(column, range,
         [&](const SummaryPart& part, const SummaryPart::Column& values, std::size_t bucket) {
           const double time = part.end[bucket];
           if (time < range.begin || time > range.end || out.size() >= most) return;
           out.push_back({time, valueOf(values.last, bucket)});
         });
    return false;
  }

  SeriesStatistics statistics(std::uint32_t column, TimeRange range) const override {
    if (holds(range)) return m_rows->statistics(column, range);
    std::vector<Sample> some;
    (void)samples(column, range, some, SIZE_MAX);
    SeriesStatistics out = statisticsOf(some, range);
    std::uint64_t rows = 0;
    each(column, range,
         [&](const SummaryPart& part, const SummaryPart::Column& values, std::size_t bucket) {
           rows += part.rows[bucket];
           out.min = std::fmin(out.min, valueOf(values.min, bucket));
           out.max = std::fmax(out.max, valueOf(values.max, bucket));
         });
    out.samples = rows;
    return out;
  }

 private:
  /// Every row of the range is in memory; else they are asked for.
  bool holds(TimeRange range) const {
    const TimeRange all = m_pages->range();
    const TimeRange looked{std::max(range.begin, all.begin), std::min(range.end, all.end)};
    if (looked.begin > looked.end) return false;
    if (m_held && m_rows && m_held->begin <= looked.begin && looked.end <= m_held->end) return true;
    m_pages->want({looked.begin - nearby, looked.end + nearby});
    return false;
  }
  /// Buckets that reach into the range, in order.
  template <class Visit>
  void each(std::uint32_t column, TimeRange range, const Visit& visit) const {
    const auto summary = m_pages->summary(m_group, true);
    if (!summary) return;
    for (const SummaryPart& part : summary->parts) {
      if (part.end.back() < range.begin || part.begin.front() > range.end) continue;
      if (column >= part.columns.size()) continue;
      for (std::size_t i = 0; i < part.buckets(); ++i) {
        if (part.end[i] < range.begin || part.begin[i] > range.end) continue;
        visit(part, part.columns[column], i);
      }
    }
  }

  std::shared_ptr<const GroupView> m_empty;
  const GroupId m_group;
  const std::shared_ptr<SeriesPages> m_pages;
  std::optional<TimeRange> m_held;
  std::shared_ptr<const GroupView> m_rows;
};

}  // namespace

std::shared_ptr<const GroupView> pagedView(std::shared_ptr<const GroupView> empty, GroupId group,
                                           std::shared_ptr<SeriesPages> pages) {
  return std::make_shared<PagedView>(std::move(empty), group, std::move(pages));
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/series_pages.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <telemetry/series/derived_curve.h>

namespace pitchboard::telemetry {
namespace {

constexpr double emptyBucket = std::numeric_limits<double>::quiet_NaN();

double valueOf(const std::vector<float>& values, std::size_t bucket) {
  if (values.empty()) return emptyBucket;
  return static_cast<double>(values.size() == 1 ? values.front() : values[bucket]);
}

class PagedView final : public GroupView {
 public:
  PagedView(std::shared_ptr<const GroupView> empty, GroupId group,
            std::shared_ptr<SeriesPages> pages)
      : m_empty(std::move(empty)), m_group(group), m_pages(std::move(pages)) {
    m_recent = m_pages->held(group, std::nullopt);
  }

  const GroupInfo& info() const override { return m_empty->info(); }
  std::optional<TimeRange> range() const override {
    if (const auto summary = m_pages->summary(m_group, false)) return summary->range();
    return m_recent ? m_recent->rows->range() : std::nullopt;
  }
  std::size_t rows() const override {
    const auto summary = m_pages->summary(m_group, true);
    return summary ? static_cast<std::size_t>(summary->rows()) : 0;
  }
  double rate() const override { return m_recent ? m_recent->rows->rate() : 0.0; }

  std::optional<Sample> latest(std::uint32_t column) const override {
    const auto summary = m_pages->summary(m_group, false);
    if (!summary || summary->parts.empty()) return std::nullopt;
    const SummaryPart& part = summary->parts.back();
    if (column >= part.columns.size()) return std::nullopt;
    return Sample{part.end.back(), valueOf(part.columns[column].last, part.buckets() - 1)};
  }
  std::optional<Sample> at(std::uint32_t column, double time) const override {
    const auto held = read({time, time});
    return held ? held->rows->at(column, time) : std::nullopt;
  }
  bool rowAt(double time, double& rowTime, std::vector<std::uint32_t>& words,
             std::vector<double>& values) const override {
    const auto held = read({time, time});
    return held && held->rows->rowAt(time, rowTime, words, values);
  }
  std::optional<double> lastChange(std::uint32_t column) const override {
    if (!m_recent) return std::nullopt;
    const auto rows = m_recent->rows->range();
    const auto last = m_recent->rows->lastChange(column);
    if (!rows || !last) return std::nullopt;
    // A value that is the same through the stretch may have changed at any time before it.
    const bool known = *last > rows->begin || rows->begin <= m_pages->range().begin;
    return known ? last : std::nullopt;
  }
  bool hasEveryRow(TimeRange range) const override {
    const TimeRange looked = within(range);
    return looked.begin > looked.end || read(range).has_value();
  }

  bool isReading(TimeRange range) const override { return m_pages->isReading(within(range)); }

  void buckets(std::uint32_t column, TimeRange range, std::span<SeriesBucket> out) const override {
    if (const auto held = read(range)) return held->rows->buckets(column, range, out);
    std::fill(out.begin(), out.end(),
              SeriesBucket{emptyBucket, emptyBucket, emptyBucket, emptyBucket, 0});
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
    const bool some = most != SIZE_MAX;
    if (const auto held = some ? find(range) : read(range)) {
      return held->rows->samples(column, range, out, most);
    }
    // The first few of a range lie mostly in the stretch around its beginning.
    if (const auto held = some ? read({range.begin, range.begin}) : std::nullopt) {
      held->rows->samples(column, {range.begin, std::min(range.end, held->range.end)}, out, most);
      return false;
    }
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
    if (const auto held = find(range)) return held->rows->statistics(column, range);
    if (const auto every = m_pages->statistics(m_group, column, within(range))) return *every;
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
    out.reading = true;
    return out;
  }

 private:
  using Stretch = SeriesPages::Stretch;

  /// The part of the range that has rows. After the last row there is nothing but that row.
  TimeRange within(TimeRange range) const {
    const TimeRange all = m_pages->range();
    const double end = std::min(range.end, all.end);
    return {std::clamp(range.begin, all.begin, std::max(all.begin, end)), end};
  }
  /// A stretch with every row of the range.
  std::optional<Stretch> find(TimeRange range) const {
    const TimeRange looked = within(range);
    if (looked.begin > looked.end) return std::nullopt;
    const auto holds = [&looked](const Stretch& held) {
      return held.range.begin <= looked.begin && looked.end <= held.range.end;
    };
    return m_recent && holds(*m_recent) ? m_recent : m_pages->held(m_group, looked);
  }
  /// The same, and requests what is not in memory.
  std::optional<Stretch> read(TimeRange range) const {
    auto held = find(range);
    if (const TimeRange looked = within(range); !held && looked.begin <= looked.end) {
      m_pages->want(looked);
    }
    return held;
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
  std::optional<Stretch> m_recent;
};

}  // namespace

std::shared_ptr<const GroupView> pagedView(std::shared_ptr<const GroupView> empty, GroupId group,
                                           std::shared_ptr<SeriesPages> pages) {
  return std::make_shared<PagedView>(std::move(empty), group, std::move(pages));
}

}  // namespace pitchboard::telemetry

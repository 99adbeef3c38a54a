// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/row_walk.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace pitchboard::link {
namespace {

/// One group of the store on its way through the range.
struct Walk {
  std::shared_ptr<const telemetry::GroupView> view;
  std::vector<telemetry::Sample> times;
  std::size_t next = 0;
};

}  // namespace

void forEachRow(const telemetry::SeriesStore& rows, telemetry::TimeRange range,
                const RowVisitor& visit) {
  std::vector<Walk> walks(rows.groups());
  std::vector<double> times;
  for (std::size_t i = 0; i < walks.size(); ++i) {
    walks[i].view = rows.view(static_cast<telemetry::GroupId>(i));
    if (!walks[i].view || walks[i].view->info().columns.empty()) continue;
    walks[i].view->samples(0, range, walks[i].times);
    for (const auto& sample : walks[i].times) times.push_back(sample.time);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  for (const double time : times) {
    for (std::size_t i = 0; i < walks.size(); ++i) {
      Walk& walk = walks[i];
      if (walk.next >= walk.times.size() || walk.times[walk.next].time != time) continue;
      // Of several rows of one time (changes by hand) the last: the one that counts.
      while (walk.next < walk.times.size() && walk.times[walk.next].time == time) ++walk.next;
      double rowTime = 0.0;
      if (!walk.view->rowAt(time, rowTime, words, values)) continue;
      visit(static_cast<telemetry::GroupId>(i), walk.view->info(), {rowTime, words, values});
    }
  }
}

void forEachRow(const telemetry::SessionReader& session, telemetry::TimeRange range,
                const RowVisitor& visit) {
  const auto groups = session.groups();
  session.rows({range.begin, range.end}, {}, [&](telemetry::GroupId id, const auto& row) {
    visit(id, groups[id].info, row);
    return true;
  });
}

void forEachHeldRow(const telemetry::SeriesStore& rows, double time, const RowVisitor& visit) {
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  for (std::size_t i = 0; i < rows.groups(); ++i) {
    const auto view = rows.view(static_cast<telemetry::GroupId>(i));
    double rowTime = 0.0;
    if (!view || !view->rowAt(time, rowTime, words, values)) continue;
    visit(static_cast<telemetry::GroupId>(i), view->info(), {rowTime, words, values});
  }
}

void forEachHeldRow(const telemetry::SessionReader& session, double time, const RowVisitor& visit) {
  std::vector<telemetry::SessionRow> rows;
  session.rowsAt(time, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].present) continue;
    visit(static_cast<telemetry::GroupId>(i), session.groups()[i].info, rows[i].view());
  }
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trail_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <simcore/world/published_frame.h>

namespace pitchboard::ui {
namespace {

constexpr double perSecond = 10.0;
constexpr double rounding = 1e-6;  // s; files keep whole nanoseconds

}  // namespace

std::vector<TrailItem::Place> trailOf(const telemetry::SeriesStore& rows,
                                      const link::RobotFrame& robot, const sim::FieldSpec& field,
                                      double time) {
  auto x = rows.find(robot.name, "TRUE_X"), y = rows.find(robot.name, "TRUE_Y");
  const bool believed = !x || !y;
  if (believed) {
    x = rows.find(robot.name, "LOCALIZATION_X");
    y = rows.find(robot.name, "LOCALIZATION_Y");
  }
  if (!x || !y || x->group != y->group) return {};
  const auto view = rows.view(x->group);
  const auto known = view ? view->range() : std::nullopt;
  if (!known) return {};
  // Steps are counted from second 0: a trail that grows keeps its places.
  const double from = std::floor((time - TrailItem::seconds) * perSecond) / perSecond;
  const telemetry::TimeRange range{std::max(from, known->begin),
                                   std::min(time + rounding, known->end)};
  if (range.end < range.begin || !view->hasEveryRow(range)) return {};
  std::vector<telemetry::Sample> xs, ys;
  view->samples(x->column, range, xs);
  view->samples(y->column, range, ys);
  std::vector<TrailItem::Place> places;
  double last = -1.0;
  for (std::size_t i = 0; i < std::min(xs.size(), ys.size()); ++i) {
    const double step = std::floor((xs[i].time + rounding) * perSecond);
    if (std::exchange(last, step) != step) {
      const Point at{xs[i].value, ys[i].value};
      if (!std::isfinite(at.x) || !std::isfinite(at.y)) continue;
      const Pose pose = believed
                            ? sim::published_frame::studioFromLocalization(field, {at.x, at.y, 0.0})
                            : Pose{at, 0.0};
      places.push_back({pose.position, xs[i].time});
    }
  }
  return places;
}

}  // namespace pitchboard::ui

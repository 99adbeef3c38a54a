// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <ui/base/session_mark.h>
#include <ui/base/theme.h>

#include "curve.h"

namespace pitchboard::ui {
namespace {

struct Shades {
  const char* dark;
  const char* light;
};

QColor shade(const Shades& shades) {
  return QColor(QLatin1String(isDarkTheme() ? shades.dark : shades.light));
}

// In the order of the lanes below.
constexpr std::array<Shades, 5> lanes{{{"#3f5872", "#bcd4ee"},
                                       {"#5a4c72", "#d8cdf0"},
                                       {"#4d5a46", "#cfe3c8"},
                                       {"#6b4a3c", "#f2cdbb"},
                                       {"#454b53", "#e1e4e8"}}};

}  // namespace

QColor mixedColor(const QColor& a, const QColor& b, double share) {
  const auto part = [share](int x, int y) { return qRound(x + (y - x) * share); };
  return {part(a.red(), b.red()), part(a.green(), b.green()), part(a.blue(), b.blue())};
}

QColor curveColor(int number) {
  static constexpr std::array<Shades, curveColors> curves{{{"#6fb1f2", "#2b74c9"},
                                                           {"#e8a25c", "#c96f16"},
                                                           {"#79c79a", "#2f8f5b"},
                                                           {"#d792bd", "#b0508c"},
                                                           {"#7fd0d6", "#12858d"},
                                                           {"#d6c36a", "#8d7a0f"},
                                                           {"#ef8378", "#b23a2e"},
                                                           {"#c9cfd6", "#4d5763"}}};
  return shade(curves[static_cast<std::size_t>(number % curveColors)]);
}

namespace {
// Line, gap, line, gap, px of the mock.
constexpr std::array<std::array<double, 4>, 5> dashes{
    {{1, 0, 1, 0}, {6, 3, 6, 3}, {2, 2, 2, 2}, {8, 3, 2, 3}, {4, 4, 4, 4}}};
static_assert(dashes.size() == futureDash + 1);
}  // namespace

int curveDash(int number) {
  return number / curveColors % futureDash;
}

ComparedLook comparedLook(const ComparedRows& session, std::size_t curve, const QColor& own,
                          const QColor& base) {
  // Never taken for the present, where they lie close together.
  if (session.isFuture()) return {mixedColor(own, base, comparedPaleness), 1.0, futureDash};
  return {sessionColor(session.number), comparedWidth, static_cast<int>(curve % futureDash)};
}

QList<QLineF> dashedLine(std::span<const QPointF> line, int dash, double pixel, double origin) {
  QList<QLineF> pieces;
  const auto& pattern = dashes[static_cast<std::size_t>(dash)];
  const double period = std::accumulate(pattern.begin(), pattern.end(), 0.0) * pixel;
  // The part of the pattern at x: whether it is drawn, and where it ends.
  const auto partAt = [&](double x) {
    const double turns = std::floor((x - origin) / period);
    double end = origin + turns * period;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      end += pattern[i] * pixel;
      if (x < end) return std::pair(i % 2 == 0, end);
    }
    return std::pair(true, end + pattern[0] * pixel);
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const QPointF a = line[i], b = line[i + 1];
    if (dash == 0) {
      pieces << QLineF(a, b);
      continue;
    }
    const auto [drawn, end] = partAt(a.x());
    if (b.x() <= end) {
      if (drawn) pieces << QLineF(a, b);
      continue;
    }
    const auto at = [&](double x) {
      return QPointF(x, a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
    };
    QPointF from = a;
    while (from.x() < b.x()) {
      const auto [on, until] = partAt(from.x());
      const QPointF to = until < b.x() ? at(until) : b;
      if (on) pieces << QLineF(from, to);
      if (!(to.x() > from.x())) break;
      from = to;
    }
  }
  return pieces;
}

QColor laneColor(const QString& label, int code) {
  static constexpr std::array<std::pair<const char*, std::size_t>, 8> verbs{{{"walk", 0},
                                                                             {"turn", 1},
                                                                             {"stop", 2},
                                                                             {"kick", 3},
                                                                             {"pass", 3},
                                                                             {"gait", 4},
                                                                             {"off", 4},
                                                                             {"on", 0}}};
  for (const auto& [start, lane] : verbs) {
    if (label.startsWith(QLatin1String(start), Qt::CaseInsensitive)) return shade(lanes[lane]);
  }
  const auto count = static_cast<int>(lanes.size());
  return shade(lanes[static_cast<std::size_t>(((code % count) + count) % count)]);
}

}  // namespace pitchboard::ui

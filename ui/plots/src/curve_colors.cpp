// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

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

QColor laneColor(const QString& word, int code) {
  static constexpr std::array<std::pair<const char*, std::size_t>, 8> words{{{"walk", 0},
                                                                             {"turn", 1},
                                                                             {"stop", 2},
                                                                             {"kick", 3},
                                                                             {"pass", 3},
                                                                             {"gait", 4},
                                                                             {"off", 4},
                                                                             {"on", 0}}};
  for (const auto& [start, lane] : words) {
    if (word.startsWith(QLatin1String(start), Qt::CaseInsensitive)) return shade(lanes[lane]);
  }
  const auto count = static_cast<int>(lanes.size());
  return shade(lanes[static_cast<std::size_t>(((code % count) + count) % count)]);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics_text.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

#include <ui/base/robot_text.h>

namespace pitchboard::ui {
namespace {

constexpr int digits = 4;
constexpr double mostWhole = 1e7;  // larger numbers are written with an exponent

}  // namespace

QString shortValueText(double value) {
  if (!std::isfinite(value)) return QStringLiteral("–");
  const bool isWhole = std::abs(value) < mostWhole && value == std::round(value);
  QString text = isWhole ? QString::number(value, 'f', 0) : QString::number(value, 'g', digits);
  return text.replace(QLatin1Char('-'), QChar(0x2212));
}

QString shortValueText(double value, const std::string& unit) {
  const QString text = shortValueText(value);
  if (unit.empty() || !std::isfinite(value)) return text;
  const bool isDegrees = unit == "°";
  return text + (isDegrees ? QString() : QStringLiteral(" ")) + QString::fromStdString(unit);
}

QString intervalText(double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return QStringLiteral("–");
  return QStringLiteral("%1 to %2").arg(shortValueText(low), shortValueText(high));
}

QString percentText(double share) {
  return std::isfinite(share) ? numberText(100.0 * share, 1) + QStringLiteral(" %")
                              : QStringLiteral("–");
}

QString stateName(const telemetry::StretchLine& state) {
  return state.label.empty() ? shortValueText(state.state ? state.state->value : std::nan(""))
                             : QString::fromStdString(state.label);
}

QString statesText(const std::vector<telemetry::StretchLine>& states) {
  std::vector<const telemetry::StretchLine*> sorted;
  for (const telemetry::StretchLine& state : states) sorted.push_back(&state);
  std::ranges::stable_sort(
      sorted, [](const auto* a, const auto* b) { return a->state->share > b->state->share; });
  QStringList texts;
  for (const telemetry::StretchLine* state : sorted) {
    texts << stateName(*state) + QLatin1Char(' ') + percentText(state->state->share);
  }
  return texts.join(QStringLiteral(", "));
}

QString sessionName(const std::string& session) {
  return QString::fromStdString(session.substr(session.find_last_of('/') + 1));
}

}  // namespace pitchboard::ui

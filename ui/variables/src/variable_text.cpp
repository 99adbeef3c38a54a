// SPDX-License-Identifier: GPL-3.0-or-later
#include "variable_text.h"

#include <QLocale>
#include <cmath>
#include <limits>

#include <ui/base/number_box.h>
#include <ui/base/robot_text.h>

namespace pitchboard::ui {
namespace {

using telemetry::ColumnInfo;
using telemetry::ColumnKind;
using telemetry::ColumnType;

int decimalsOf(const ColumnInfo& column) {
  if (column.type == ColumnType::Int32 || column.isWhole || column.kind != ColumnKind::Number)
    return 0;
  struct UnitDecimals {
    const char* unit;
    int decimals;
  };
  static constexpr UnitDecimals known[] = {{"cm", 1}, {"°", 1},  {"m", 3},   {"rad", 3}, {"m/s", 2},
                                           {"V", 1},  {"s", 2},  {"ms", 2},  {"µs", 1},  {"%", 1},
                                           {"/s", 1}, {"Hz", 1}, {"°/s", 1}, {"cm/s", 1}};
  for (const UnitDecimals& entry : known) {
    if (column.unit == entry.unit) return entry.decimals;
  }
  return 2;
}

/// With fixed decimals. A number without a unit may be of any size, so that a small one is written
/// as such; 2.2e-06 cm is 0.
QString numberOf(double value, int decimals, bool hasUnit) {
  constexpr double largest = 1e7;
  const double smallest = hasUnit ? 0.0 : 0.5 * std::pow(10.0, -decimals);
  const double size = std::abs(value);
  if (decimals > 0 && size != 0.0 && (size >= largest || size < smallest)) {
    QString text = QString::number(value, 'g', 3);
    return text.replace(QLatin1Char('-'), QChar(0x2212));
  }
  return numberText(value, decimals);
}

QString name(const ColumnInfo& column) {
  return QString::fromStdString(column.name);
}

auto refuse(const QString& sentence) {
  return failure(ErrorCode::InvalidArgument, sentence.toStdString());
}

}  // namespace

QString valueText(const ColumnInfo& column, double value) {
  if (std::isnan(value)) return QStringLiteral("–");
  if (std::isinf(value)) return value > 0 ? QStringLiteral("∞") : QStringLiteral("−∞");
  return numberOf(value, decimalsOf(column), !column.unit.empty());
}

QString exactText(const ColumnInfo& column, double value) {
  if (!std::isfinite(value)) return valueText(column, value);
  switch (column.type) {
    case ColumnType::Int32:
      return QString::number(value, 'f', 0);
    case ColumnType::Float32: {
      // As few digits as give the same 32 bits back.
      constexpr int longest = std::numeric_limits<float>::max_digits10;
      const float single = static_cast<float>(value);
      for (int digits = std::numeric_limits<float>::digits10; digits < longest; ++digits) {
        QString text = QString::number(value, 'g', digits);
        if (text.toFloat() == single) return text;
      }
      return QString::number(value, 'g', longest);
    }
    case ColumnType::Float64:
      break;
  }
  return QString::number(value, 'g', QLocale::FloatingPointShortest);
}

QString rateText(const ColumnInfo& column, double perSecond) {
  if (!std::isfinite(perSecond)) return {};
  const QString text = numberOf(perSecond, std::max(1, decimalsOf(column)), !column.unit.empty());
  return perSecond > 0 && text.toDouble() != 0.0 ? QLatin1Char('+') + text : text;
}

QString ageText(double seconds) {
  if (!(seconds >= 0)) return {};
  if (seconds < 1) return QStringLiteral("%1 ms").arg(std::lround(seconds * 1000));
  return durationText(seconds, 1);
}

QString attachedKey(const telemetry::GroupInfo& group) {
  const telemetry::RobotFacts& facts = factsOf(group);
  return facts.attached && facts.boardKey ? QStringLiteral("key %1").arg(*facts.boardKey)
                                          : QString();
}

QString labelOf(const ColumnInfo& column, double value) {
  const bool hasLabels = column.kind == ColumnKind::Enumeration || column.kind == ColumnKind::Text;
  if (!hasLabels || !std::isfinite(value)) return {};
  const auto found = column.labels.find(static_cast<std::int32_t>(value));
  return found != column.labels.end() ? QString::fromStdString(found->second) : QString();
}

Result<double> parseValue(const ColumnInfo& column, const QString& text) {
  const QString typed = text.trimmed();
  if (typed.isEmpty()) return refuse(QStringLiteral("Type a value for %1.").arg(name(column)));
  for (const auto& [code, words] : column.labels) {
    if (typed.compare(QString::fromStdString(words), Qt::CaseInsensitive) == 0) return code;
  }
  const auto number = numberFromText(typed);
  const bool isNumber = number.has_value();
  const double value = number.value_or(0.0);
  if (column.kind == ColumnKind::Flag) {
    if (isNumber && (value == 0.0 || value == 1.0)) return value;
    return refuse(QStringLiteral("%1 is a flag: 0 or 1, not “%2”.").arg(name(column), typed));
  }
  if (!isNumber) {
    return refuse((column.labels.empty()
                       ? QStringLiteral("“%1” is not a number.")
                       : QStringLiteral("“%1” is neither a number nor a label of %2."))
                      .arg(typed, name(column)));
  }
  if (column.type == ColumnType::Int32) {
    if (value != std::floor(value)) {
      return refuse(QStringLiteral("%1 takes whole numbers, not “%2”.").arg(name(column), typed));
    }
    using Limits = std::numeric_limits<std::int32_t>;
    if (value < Limits::min() || value > Limits::max()) {
      return refuse(QStringLiteral("%1 takes −2147483648 to 2147483647 (32 bits), not “%2”.")
                        .arg(name(column), typed));
    }
  } else if (std::abs(value) > std::numeric_limits<float>::max()) {
    return refuse(QStringLiteral("“%2” does not fit %1, a 32-bit float (at most 3.4e38).")
                      .arg(name(column), typed));
  }
  return column.type == ColumnType::Float32 ? double(static_cast<float>(value)) : value;
}

}  // namespace pitchboard::ui

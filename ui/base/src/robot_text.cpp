// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/robot_text.h>

#include <cmath>

#include <base/duration_text.h>
#include <simcore/world/action_codes.h>
#include <telemetry/formats/meanings.h>

namespace pitchboard::ui {

QString robotName(const sim::RobotIdentity& identity) {
  return QString::fromStdString(identity.name());
}

QString robotName(const link::RobotFrame& robot) {
  return QString::fromStdString(robot.name);
}

std::optional<telemetry::SeriesId> findVariable(const telemetry::SeriesStore& rows,
                                                const QString& name) {
  const qsizetype slash = name.indexOf(QLatin1Char('/'));
  if (slash <= 0) return {};
  const std::string group = name.left(slash).toStdString();
  const std::string column = name.mid(slash + 1).toStdString();
  const auto id = rows.find(group, column);
  return id ? id : rows.find(group, telemetry::presentName(column));
}

QString actionText(int code) {
  return QString::fromStdString(actionLabel(code));
}

QString capitalised(std::string_view name) {
  QString text = QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

QString numberText(double value, int decimals) {
  QString text = QString::number(std::abs(value), 'f', decimals);
  // −0.00 would make the sign flicker around zero.
  const bool zero = text.toDouble() == 0.0;
  if (value < 0 && !zero) text.prepend(QChar(0x2212));
  return text;
}

QString clockText(double seconds) {
  const auto whole = static_cast<long long>(std::floor(std::abs(seconds)));
  const QLatin1Char zero('0');
  const QString minutes =
      QStringLiteral("%1:%2").arg(whole / 60 % 60, 2, 10, zero).arg(whole % 60, 2, 10, zero);
  const QString text =
      whole < 3600 ? minutes : QString::number(whole / 3600) + QLatin1Char(':') + minutes;
  return seconds < 0 && whole > 0 ? QChar(0x2212) + text : text;
}

QString durationText(double seconds, int decimals) {
  return QString::fromStdString(pitchboard::durationText(seconds, decimals));
}

QString countText(qulonglong value) {
  QString text = QString::number(value);
  for (qsizetype at = text.size() - 3; at > 0; at -= 3) text.insert(at, QChar(0x202f));
  return text;
}

}  // namespace pitchboard::ui

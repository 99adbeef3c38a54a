// SPDX-License-Identifier: GPL-3.0-or-later
#include "moment_box.h"

#include <QRegularExpression>

#include <ui/base/time_axis.h>

namespace pitchboard::ui {

std::optional<double> momentFromText(const QString& text) {
  static const QRegularExpression form(
      QStringLiteral("^([-\u2212]?)(?:(?:(\\d{1,4}):)?(\\d{1,4}):)?(\\d{1,7}(?:[.,]\\d*)?) ?s?$"));
  const QRegularExpressionMatch found = form.match(text.trimmed());
  if (!found.hasMatch()) return {};
  const auto seconds = numberFromText(found.captured(4));
  if (!seconds) return {};
  const double all =
      found.captured(2).toInt() * 3600.0 + found.captured(3).toInt() * 60.0 + *seconds;
  return found.captured(1).isEmpty() ? all : -all;
}

MomentBox::MomentBox(QWidget* parent) : NumberBox(parent) {
  constexpr double longest = 1e7;
  setRange(-longest, longest);
  setDecimals(3);
}

void MomentBox::setMoment(double seconds) {
  setValue(seconds);
  m_moment = seconds;
  m_shown = value();
}

QString MomentBox::textFromValue(double seconds) const {
  return momentText(seconds, decimals());
}

double MomentBox::valueFromText(const QString& text) const {
  return momentFromText(text).value_or(value());
}

QValidator::State MomentBox::validate(QString& input, int&) const {
  if (const auto seconds = momentFromText(input)) {
    return *seconds >= minimum() && *seconds <= maximum() ? QValidator::Acceptable
                                                          : QValidator::Invalid;
  }
  static const QRegularExpression beginning(QStringLiteral("^[-\u2212]?[\\d:.,]*( s?)?$"));
  return beginning.match(input).hasMatch() ? QValidator::Intermediate : QValidator::Invalid;
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "moment_box.h"

#include <QRegularExpression>

#include <base/time_text.h>
#include <ui/base/time_axis.h>

namespace pitchboard::ui {

std::optional<double> momentFromText(const QString& text) {
  QString plain = text.trimmed();
  if (plain.endsWith(u's')) plain = plain.chopped(1).trimmed();
  const QByteArray bytes = plain.replace(u',', u'.').toUtf8();
  return secondsFromText({bytes.constData(), static_cast<std::size_t>(bytes.size())});
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

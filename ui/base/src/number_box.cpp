// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/number_box.h>

#include <QToolTip>
#include <cmath>

namespace pitchboard::ui {
namespace {

constexpr QChar minus(0x2212);

/// As QLocale::c() reads numbers; as long as before.
QString plain(QString number) {
  return number.replace(QLatin1Char(','), QLatin1Char('.')).replace(minus, QLatin1Char('-'));
}

}  // namespace

std::optional<double> numberFromText(const QString& text) {
  bool good = false;
  const double value = QLocale::c().toDouble(plain(text.trimmed()), &good);
  return good && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

NumberBox::NumberBox(QWidget* parent) : QDoubleSpinBox(parent) {
  QLocale locale = QLocale::c();
  locale.setNumberOptions(QLocale::OmitGroupSeparator | QLocale::RejectGroupSeparator);
  setLocale(locale);
}

QString NumberBox::withPoint(const QString& text) const {
  const qsizetype unit = text.endsWith(suffix()) ? suffix().size() : 0;
  return plain(text.chopped(unit)) + text.right(unit);
}

/// A number in full that only the range refuses.
std::optional<double> NumberBox::beyondRange(const QString& input) const {
  QString number = withPoint(input);
  if (number.endsWith(suffix())) number.chop(suffix().size());
  constexpr qsizetype most = 12;
  const qsizetype point = number.indexOf(QLatin1Char('.'));
  const auto value = numberFromText(number);
  const bool fine = point < 0 || number.size() - point - 1 <= decimals();
  const bool beyond = value && (*value > maximum() || *value < minimum());
  return beyond && fine && number.size() <= most && !number.contains(QLatin1Char('e'))
             ? value
             : std::nullopt;
}

QString NumberBox::textFromValue(double value) const {
  return QDoubleSpinBox::textFromValue(value).replace(QLatin1Char('-'), minus);
}

QValidator::State NumberBox::validate(QString& input, int& position) const {
  QString plainInput = withPoint(input);
  const QValidator::State state = QDoubleSpinBox::validate(plainInput, position);
  // Whatever was typed is shown as everywhere else.
  input = plainInput;
  if (input.startsWith(QLatin1Char('-'))) input[0] = minus;
  return state == QValidator::Invalid && beyondRange(input) ? QValidator::Intermediate : state;
}

void NumberBox::fixup(QString& input) const {
  const auto value = beyondRange(input);
  if (!value) return QDoubleSpinBox::fixup(input);
  const bool tooMuch = *value > maximum();
  input = textFromValue(tooMuch ? maximum() : minimum()) + suffix();
  QToolTip::showText(mapToGlobal(rect().bottomLeft()),
                     (tooMuch ? QStringLiteral("%1 is the largest value.")
                              : QStringLiteral("%1 is the smallest value."))
                         .arg(input));
}

double NumberBox::valueFromText(const QString& text) const {
  return QDoubleSpinBox::valueFromText(withPoint(text));
}

}  // namespace pitchboard::ui

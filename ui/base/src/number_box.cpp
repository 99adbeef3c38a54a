// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/number_box.h>

#include <cmath>

namespace pitchboard::ui {
namespace {

/// As QLocale::c() reads numbers; as long as before.
QString plain(QString number) {
  return number.replace(QLatin1Char(','), QLatin1Char('.'))
      .replace(QChar(0x2212), QLatin1Char('-'));
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

QString NumberBox::withPoint(QString text) const {
  const qsizetype unit = text.endsWith(suffix()) ? suffix().size() : 0;
  return plain(text.chopped(unit)) + text.right(unit);
}

QValidator::State NumberBox::validate(QString& input, int& position) const {
  input = withPoint(input);
  return QDoubleSpinBox::validate(input, position);
}

double NumberBox::valueFromText(const QString& text) const {
  return QDoubleSpinBox::valueFromText(withPoint(text));
}

}  // namespace pitchboard::ui

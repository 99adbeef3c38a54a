// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Input of numbers. A decimal comma is accepted like a point, whatever the locale; output always
// has a point. There are no thousands separators: "1,234" is 1.234. Each input of a decimal number
// is a NumberBox or uses numberFromText(). UI thread only.

#include <QDoubleSpinBox>
#include <optional>

namespace pitchboard::ui {

/// Returns nothing if the text is not a number. Also reads the minus sign U+2212.
std::optional<double> numberFromText(const QString& text);

class NumberBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  explicit NumberBox(QWidget* parent = nullptr);

  /// A number beyond the range can be typed; when it is entered, the nearest one is taken and a
  /// tooltip says so.
  QValidator::State validate(QString& input, int& position) const override;
  void fixup(QString& input) const override;
  double valueFromText(const QString& text) const override;
  QString textFromValue(double value) const override;

 private:
  QString withPoint(const QString& text) const;
  std::optional<double> beyondRange(const QString& input) const;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Numbers that people type. A decimal comma is understood like a point, whatever the locale; what
// the studio writes has a point. There are no signs between thousands: "1,234" is 1.234. Every
// entry of a number with decimals is a NumberBox or is read by numberFromText(). UI thread only.

#include <QDoubleSpinBox>
#include <optional>

namespace pitchboard::ui {

/// Nothing when it is not a number. Reads the minus sign of the screen (U+2212), too.
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

 private:
  QString withPoint(QString text) const;
  std::optional<double> beyondRange(const QString& input) const;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A moment of the source that people type, in seconds: written as timeline and plots write it
// ("02:23.683"), and read like that or as plain seconds. UI thread only.

#include <optional>

#include <ui/base/number_box.h>

namespace pitchboard::ui {

/// The seconds of "03:12.25", "1:03:12", "−0:05" or "192.25 s"; nothing when it is no time.
std::optional<double> momentFromText(const QString& text);

class MomentBox : public NumberBox {
  Q_OBJECT
 public:
  explicit MomentBox(QWidget* parent = nullptr);

  /// The box shows milliseconds; who leaves them as they are means the moment itself.
  void setMoment(double seconds);
  double moment() const { return value() == m_shown ? m_moment : value(); }

  QString textFromValue(double seconds) const override;
  double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& input, int& position) const override;

 private:
  double m_moment = 0.0;
  double m_shown = 0.0;  // the same, as the box rounds it
};

}  // namespace pitchboard::ui

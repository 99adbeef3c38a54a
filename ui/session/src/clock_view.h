// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shows by how much each change of a session and of a robot's own recording is apart, over time:
// with the right clock the points lie around zero; a wrong drift tilts them. UI thread only.

#include <QWidget>

#include <robotlink/session/clock_comparison.h>

namespace pitchboard::ui {

class ClockView : public QWidget {
 public:
  explicit ClockView(QWidget* parent);
  void show(const link::ClockAgreement& agreement);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  link::ClockAgreement m_agreement;
};

}  // namespace pitchboard::ui

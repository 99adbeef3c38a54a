// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A sentence in a box that lies on the field and lets the mouse through. UI thread only; belongs to
// what it lies on.

#include <QLabel>

#include <ui/base/theme.h>

namespace pitchboard::ui {

class FieldSign : public QLabel {
 public:
  /// `line`: colour of the box's edge.
  FieldSign(QWidget* canvas, const QString& objectName, QColor ThemeColors::*line);

 protected:
  /// Shows itself where and while it is wanted; called again when the field gets another size.
  virtual void present() = 0;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  QColor ThemeColors::*m_line;
};

}  // namespace pitchboard::ui

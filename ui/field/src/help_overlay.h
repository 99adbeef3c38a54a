// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All keys of the field on one panel over it (F1). Any key or click closes it.

#include <QWidget>

namespace pitchboard::ui {

class HelpOverlay : public QWidget {
  Q_OBJECT
 public:
  explicit HelpOverlay(QWidget* parent);
  void toggle();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All keys of the field on one panel over it (F1), or over the whole window when the field is too
// small for letters that can be read. Any key or click closes it. UI thread only.

#include <QWidget>

namespace pitchboard::ui {

class HelpOverlay : public QWidget {
  Q_OBJECT
 public:
  explicit HelpOverlay(QWidget* field);
  void toggle();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void leave();

  QWidget* m_field;  // has the keys again afterwards
};

}  // namespace pitchboard::ui

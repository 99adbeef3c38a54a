// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The whole map of keys on one panel over the window (F1). Any key (which the KeyGuard passes on)
// or click closes it. UI thread only.

#include <QWidget>
#include <vector>

#include "key_map.h"

namespace pitchboard::ui {

class HelpOverlay : public QWidget {
 public:
  explicit HelpOverlay(QWidget* window);
  void open(std::vector<KeyLine> lines);
  void leave() { hide(); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  std::vector<KeyLine> m_lines;
};

}  // namespace pitchboard::ui

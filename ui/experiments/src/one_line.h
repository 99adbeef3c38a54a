// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A sentence that ends with dots when it is longer than its place is wide; resting the mouse on it
// tells the rest. UI thread.

#include <QLabel>
#include <QPainter>

#include <ui/base/elide_text.h>

namespace pitchboard::ui {

class OneLine : public QLabel {
 public:
  using QLabel::QLabel;

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    const QRect room = contentsRect();
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter,
                     elideText(QFontMetricsF(font()), text(), room.width()));
  }
};

}  // namespace pitchboard::ui

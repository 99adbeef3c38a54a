// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_sign.h"

#include <QEvent>
#include <QPainter>

namespace pitchboard::ui {

FieldSign::FieldSign(QWidget* canvas, const QString& objectName, QColor ThemeColors::*line)
    : QLabel(canvas), m_line(line) {
  setObjectName(objectName);
  setAlignment(Qt::AlignCenter);
  setFont(themeFont(TypeRole::Body, true));
  setAttribute(Qt::WA_TransparentForMouseEvents);
  canvas->installEventFilter(this);
  hide();
}

bool FieldSign::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && isVisible()) present();
  return QLabel::eventFilter(watched, event);
}

void FieldSign::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(theme().*m_line);
  painter.setBrush(theme().window);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
  painter.end();
  QLabel::paintEvent(event);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_overlay.h"

#include <QEvent>
#include <QPainter>
#include <algorithm>
#include <vector>

#include <ui/base/theme.h>
#include "field_style.h"

#include "field_keys.h"

namespace pitchboard::ui {
namespace {

struct Line {
  QString key;  // empty: `text` is a title
  QString text;
};

std::vector<Line> lines() {
  std::vector<Line> all;
  const char* category = nullptr;
  for (const FieldKey& key : fieldKeys()) {
    if (!*key.shown) continue;
    if (category != key.category) {
      if (category) all.push_back({});
      category = key.category;
      all.push_back({{}, QString::fromUtf8(category)});
    }
    all.push_back({QString::fromUtf8(key.shown), QString::fromUtf8(key.meaning)});
  }
  return all;
}

}  // namespace

HelpOverlay::HelpOverlay(QWidget* field) : QWidget(field), m_field(field) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(QStringLiteral("Keys of the field"));
  hide();
}

void HelpOverlay::toggle() {
  if (isVisible()) {
    leave();
    return;
  }
  const QSize least(scaled(this, 720), scaled(this, 560));
  const bool small = m_field->width() < least.width() || m_field->height() < least.height();
  QWidget* over = small ? m_field->window() : m_field;
  setParent(over);
  over->installEventFilter(this);
  setGeometry(over->rect());
  show();
  raise();
  setFocus();
}

void HelpOverlay::leave() {
  hide();
  parentWidget()->removeEventFilter(this);
  setParent(m_field);
  m_field->setFocus();
}

bool HelpOverlay::eventFilter(QObject* watched, QEvent* event) {
  if (watched == parent() && event->type() == QEvent::Resize) {
    setGeometry(parentWidget()->rect());
  }
  return QWidget::eventFilter(watched, event);
}

void HelpOverlay::mousePressEvent(QMouseEvent*) {
  leave();
}

void HelpOverlay::keyPressEvent(QKeyEvent*) {
  leave();
}

void HelpOverlay::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), QColor(0, 0, 0, 90));

  const std::vector<Line> all = lines();
  // As many columns as are needed to stay inside; smaller letters when even that does not fit.
  int pixels = scaled(this, 12);
  int columns = 1, perColumn = 0, columnWidth = 0, rowHeight = 0, keyWidth = 0;
  const int padding = scaled(this, 16);
  const int title = scaled(this, 30);
  for (; pixels >= 6; --pixels) {
    const QFontMetrics plain(fieldFont(pixels, false));
    const QFontMetrics bold(fieldFont(pixels, true));
    rowHeight = plain.height() + 3;
    keyWidth = 0;
    int textWidth = 0;
    for (const Line& line : all) {
      keyWidth = std::max(keyWidth, bold.horizontalAdvance(line.key));
      textWidth = std::max(textWidth, plain.horizontalAdvance(line.text));
    }
    keyWidth += 12;
    columnWidth = keyWidth + textWidth + 24;
    const int rows = std::max(1, (height() - 4 * padding - title) / rowHeight);
    columns = (static_cast<int>(all.size()) + rows - 1) / rows;
    perColumn = (static_cast<int>(all.size()) + columns - 1) / columns;
    if (columns * columnWidth + 4 * padding <= width()) break;
  }
  QRect panel(0, 0, columns * columnWidth + 2 * padding - 24,
              perColumn * rowHeight + 2 * padding + title);
  panel.moveCenter(rect().center());
  painter.setPen(QPen(theme().innerLine, 1));
  painter.setBrush(theme().window);
  painter.drawRoundedRect(panel, 4, 4);

  painter.setFont(fieldFont(pixels + 2, true));
  painter.setPen(theme().text);
  painter.drawText(panel.adjusted(padding, padding - 4, -padding, 0), Qt::AlignLeft | Qt::AlignTop,
                   QStringLiteral("Keys of the field"));
  painter.setFont(fieldFont(pixels, false));
  painter.setPen(theme().secondaryText);
  painter.drawText(panel.adjusted(padding, padding - 2, -padding, 0), Qt::AlignRight | Qt::AlignTop,
                   QStringLiteral("any key closes"));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int column = static_cast<int>(i) / perColumn;
    const int row = static_cast<int>(i) % perColumn;
    const QPoint at(panel.left() + padding + column * columnWidth,
                    panel.top() + padding + title + row * rowHeight);
    const QRect place(at, QSize(columnWidth - 24, rowHeight));
    const bool isTitle = all[i].key.isEmpty();
    painter.setFont(fieldFont(pixels, true));
    painter.setPen(theme().accentLine);
    if (isTitle) {
      painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter, all[i].text);
      continue;
    }
    painter.setPen(theme().text);
    painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter, all[i].key);
    painter.setFont(fieldFont(pixels, false));
    painter.drawText(place.adjusted(keyWidth, 0, 24, 0), Qt::AlignLeft | Qt::AlignVCenter,
                     all[i].text);
  }
}

}  // namespace pitchboard::ui

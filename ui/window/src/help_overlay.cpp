// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_overlay.h"

#include <QEvent>
#include <QPainter>
#include <algorithm>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QFont overlayFont(int pixels, bool bold) {
  QFont font = themeFont(TypeRole::Body, bold);
  font.setPixelSize(pixels);
  return font;
}

/// Lines in columns of equal height. A heading stands above its first line, and again where its
/// group goes on in the next column.
struct Columns {
  struct Entry {
    QString keys, text;  // no keys: a heading
    int column, row;
  };
  std::vector<Entry> entries;
  int count = 1, rows = 0;
};

Columns inColumns(const std::vector<KeyLine>& lines, int maxRows) {
  Columns made;
  int row = 0;
  QString group;
  for (const KeyLine& line : lines) {
    const bool isNew = line.group != group;
    int needed = isNew ? (row > 0 ? 3 : 2) : 1;
    if (isNew) {
      // A short group stays whole.
      constexpr int isShort = 12;
      const auto size = static_cast<int>(std::ranges::count(lines, line.group, &KeyLine::group));
      if (size <= isShort) needed += size - 1;
    }
    if (row > 0 && row + needed > maxRows) {
      ++made.count;
      row = 0;
    }
    if (isNew || row == 0) {
      if (row > 0) ++row;
      made.entries.push_back({{}, line.group, made.count - 1, row++});
      group = line.group;
    }
    made.entries.push_back({line.keys, line.text, made.count - 1, row++});
    made.rows = std::max(made.rows, row);
  }
  return made;
}

}  // namespace

HelpOverlay::HelpOverlay(QWidget* window) : QWidget(window) {
  setObjectName(QStringLiteral("helpOverlay"));
  setAccessibleName(QStringLiteral("Keys"));
  window->installEventFilter(this);
  hide();
}

void HelpOverlay::open(std::vector<KeyLine> lines) {
  m_lines = std::move(lines);
  setGeometry(parentWidget()->rect());
  show();
  raise();
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

void HelpOverlay::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), QColor(0, 0, 0, 90));

  // As many columns as are needed to stay inside; smaller letters when even that does not fit.
  int pixels = scaled(this, 12);
  int rowHeight = 0, columnWidth = 0, keyWidth = 0;
  const int padding = scaled(this, 16), title = scaled(this, 30), gap = scaled(this, 24);
  Columns columns;
  constexpr int smallest = 7;
  for (; pixels >= smallest; --pixels) {
    const QFontMetrics plain(overlayFont(pixels, false)), bold(overlayFont(pixels, true));
    rowHeight = plain.height() + scaled(this, 2);
    int textWidth = 0;
    keyWidth = 0;
    // One long line is cut rather than all columns made wider.
    const int most = pixels * 30;
    for (const KeyLine& line : m_lines) {
      keyWidth = std::max(keyWidth, std::min(bold.horizontalAdvance(line.keys), pixels * 15));
      textWidth = std::max(textWidth, std::min(plain.horizontalAdvance(line.text), most));
    }
    keyWidth += pixels;
    columnWidth = keyWidth + textWidth;
    columns = inColumns(m_lines, std::max(8, (height() - 4 * padding - title) / rowHeight));
    const int wide = columns.count * (columnWidth + gap) - gap;
    if (wide + 4 * padding <= width()) break;
  }
  QRect panel(0, 0, columns.count * (columnWidth + gap) - gap + 2 * padding,
              columns.rows * rowHeight + 2 * padding + title);
  panel.moveCenter(rect().center());
  painter.setPen(QPen(theme().innerLine, 1));
  painter.setBrush(theme().window);
  painter.drawRoundedRect(panel, 4, 4);

  const QRect inside = panel.adjusted(padding, padding - 4, -padding, 0);
  painter.setFont(overlayFont(pixels + 2, true));
  painter.setPen(theme().text);
  painter.drawText(inside, Qt::AlignLeft | Qt::AlignTop, QStringLiteral("Keys"));
  painter.setFont(overlayFont(pixels, false));
  painter.setPen(theme().secondaryText);
  painter.drawText(
      inside, Qt::AlignRight | Qt::AlignTop,
      QStringLiteral("Press any key to close. To search, use Help > Keyboard shortcuts."));
  const auto draw = [&](QRect place, const QString& text, bool bold) {
    const QFontMetrics metrics(overlayFont(pixels, bold));
    painter.setFont(overlayFont(pixels, bold));
    painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(text, Qt::ElideRight, place.width()));
  };
  for (const Columns::Entry& entry : columns.entries) {
    const QRect place(panel.left() + padding + entry.column * (columnWidth + gap),
                      panel.top() + padding + title + entry.row * rowHeight, columnWidth,
                      rowHeight);
    painter.setPen(entry.keys.isEmpty() ? theme().accentLine : theme().text);
    if (entry.keys.isEmpty()) {
      draw(place, entry.text, true);
      continue;
    }
    draw(place.adjusted(0, 0, keyWidth - columnWidth - pixels / 2, 0), entry.keys, true);
    draw(place.adjusted(keyWidth, 0, 0, 0), entry.text, false);
  }
}

}  // namespace pitchboard::ui

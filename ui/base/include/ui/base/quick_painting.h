// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Two things that are painted thousands of times a second, and that Qt's painter works out anew
// each time: words on one line, and boxes with round corners. Words are shaped once and kept
// (QStaticText), a box is four small corners and rectangles. Painting for files (SVG) and at
// fractional scales goes to Qt's painter unchanged. UI thread only. Units: device-independent
// pixels.

#include <QFont>
#include <QPainter>
#include <QString>

namespace pitchboard::ui {

/// One line with the painter's font and pen, cut with an ellipsis where `elide` says so. At the
/// right, elidedWords() cuts: numbers stay whole. In the middle is for names only.
void drawWords(QPainter& painter, const QRectF& box, Qt::Alignment alignment, const QString& words,
               Qt::TextElideMode elide = Qt::ElideNone);
/// As wide as drawWords() paints them.
double wordsWidth(const QFont& font, const QString& words);

/// What QPainter::drawRoundedRect() paints within `box`, edge included, with a pen of one pixel in
/// `edge` (opaque; an invalid color means none). The place is taken to whole pixels.
void drawRoundBox(QPainter& painter, const QRectF& box, double radius, const QColor& fill,
                  const QColor& edge = {});

}  // namespace pitchboard::ui

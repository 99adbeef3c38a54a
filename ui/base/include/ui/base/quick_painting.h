// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fast painting of single-line text and rounded boxes, which are painted thousands of times a
// second. Text layout is cached (QStaticText), and a box is painted as four small corners and
// rectangles. When painting into files (SVG) or at fractional scales, Qt's painter is used
// unchanged. UI thread only. Device-independent pixels.

#include <QFont>
#include <QPainter>
#include <QString>

namespace pitchboard::ui {

/// Draws a line of text with the painter's font and pen, elided as `elide` says. Qt::ElideRight
/// uses elideText(), which keeps numbers whole; use Qt::ElideMiddle for names only.
void drawTextLine(QPainter& painter, const QRectF& box, Qt::Alignment alignment,
                  const QString& text, Qt::TextElideMode elide = Qt::ElideNone);
/// Returns the width that drawTextLine() needs.
double textLineWidth(const QFont& font, const QString& text);

/// Draws what QPainter::drawRoundedRect() draws, with an edge of one pixel inside `box` in the
/// opaque colour `edge` (invalid: no edge). The box is rounded to whole pixels.
void drawRoundBox(QPainter& painter, const QRectF& box, double radius, const QColor& fill,
                  const QColor& edge = {});

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Icons for desktops without an icon theme. Any thread.

#include <QByteArray>
#include <QString>

namespace pitchboard::ui {

/// A plain drawing (SVG, 22 × 22, black) for the icons without which a tool bar would be blank;
/// for any other name a small square, so that a button is never empty.
QByteArray fallbackIcon(const QString& name);

}  // namespace pitchboard::ui

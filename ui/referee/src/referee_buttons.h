// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the parts of the referee's dock share: headings, and buttons with a key that works in the
// whole window while the dock is shown. UI thread; the owner owns what is made.

#include <QKeySequence>
#include <QLabel>
#include <QPushButton>
#include <functional>
#include <string_view>

namespace pitchboard::ui {

QLabel* makeRefereeHeading(const QString& text, QWidget* owner);
QPushButton* makeRefereeButton(QWidget* owner, const QString& text, const QString& tip,
                               const std::function<void()>& pressed, const QKeySequence& key = {});
/// "corner kick" as "Corner kick".
QString asLabel(std::string_view words);

}  // namespace pitchboard::ui

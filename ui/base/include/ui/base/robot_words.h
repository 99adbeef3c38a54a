// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How robots and numbers are written on the screen.

#include <QString>
#include <string_view>

#include <robotlink/frame/robot_frame.h>

namespace pitchboard::ui {

/// "B1": letter of the team and number on the shirt.
QString robotName(const sim::RobotIdentity& identity);
QString robotName(const link::RobotFrame& robot);
/// What was saved as `saved`, GROUP/COLUMN, is this variable: also when the robot was called
/// otherwise then, or the column in version 0.8.
bool isVariable(const QString& saved, const QString& variable);
/// "walk forward, slow", or "action 42" for a code that nobody knows.
QString actionText(int code);
/// "Blue" from "blue".
QString capitalised(std::string_view text);
/// With a real minus sign and fixed decimals.
QString numberText(double value, int decimals);
/// "05:12", hours when there are any.
QString clockText(double seconds);
/// "12 s", "32 min 17 s": how long something has lasted, as base/duration_words.h says it.
QString durationText(double seconds, int decimals = 0);
/// "18 720": thousands set apart by a thin space.
QString countText(qulonglong value);

}  // namespace pitchboard::ui

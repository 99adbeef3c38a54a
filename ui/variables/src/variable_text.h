// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How values of variables are written on the screen, and read back when a person changes one.

#include <QString>
#include <optional>

#include <base/result.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::ui {

/// With a real minus sign and decimals fixed by the unit, so that a value does not jitter; very
/// large and very small ones with an exponent. "NaN", "∞".
QString valueText(const telemetry::ColumnInfo& column, double value);
/// Every digit that the variable has, with ASCII signs: for the clipboard and for editing.
QString exactText(const telemetry::ColumnInfo& column, double value);
/// Change per second, with its sign.
QString rateText(const telemetry::ColumnInfo& column, double perSecond);
/// "12 ms", "3.4 s", "5 min": a time that passed.
QString ageText(double seconds);
/// "key 700" of an attached blackboard; empty for other groups.
QString attachedKey(const telemetry::GroupInfo& group);
/// Returns the label of a code; empty if it has none.
QString labelOf(const telemetry::ColumnInfo& column, double value);

/// Reads what a person typed for a variable of the blackboard: a number of its type, or the words
/// of a code. The error is a sentence to show beside the value.
Result<double> parseValue(const telemetry::ColumnInfo& column, const QString& text);

}  // namespace pitchboard::ui

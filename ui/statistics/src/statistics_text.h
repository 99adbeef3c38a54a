// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Formats the numbers of statistics for the screen. Pure functions; any thread.

#include <QString>
#include <vector>

#include <telemetry/query/stretch_table.h>

namespace pitchboard::ui {

/// Returns a value with four significant digits and the minus sign U+2212; "–" if it is unknown.
QString shortValueText(double value);
/// The same with a unit.
QString shortValueText(double value, const std::string& unit);
/// Returns "1.02 to 1.31"; "–" if it is unknown.
QString intervalText(double low, double high);
/// Returns "12.3 %".
QString percentText(double share);
/// Returns the label of a state, or its number.
QString stateName(const telemetry::StretchLine& state);
/// Returns the states with their shares, the most frequent first: "stop 61.0 %, kick 39.0 %".
QString statesText(const std::vector<telemetry::StretchLine>& states);
/// Returns the name of the session: that of its file without the folder.
QString sessionName(const std::string& session);

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Formats robots and numbers for the screen. Pure functions; any thread.

#include <QString>
#include <optional>
#include <string_view>

#include <robotlink/frame/robot_frame.h>
#include <telemetry/series/series_store.h>

namespace pitchboard::ui {

/// Returns the letter of the team and the number on the shirt: "B1".
QString robotName(const sim::RobotIdentity& identity);
QString robotName(const link::RobotFrame& robot);
/// Finds the variable that `GROUP/COLUMN` in a layout or in settings means: the robot may have had
/// this name earlier (SeriesStore::groupsNamed()), and the column in version 0.8.
std::optional<telemetry::SeriesId> findVariable(const telemetry::SeriesStore& rows,
                                                const QString& name);
/// Returns "walk forward, slow", or "action 42" for an unknown code.
QString actionText(int code);
/// Turns "corner kick" into "Corner kick".
QString capitalised(std::string_view name);
/// Uses a fixed number of decimals and the minus sign U+2212.
QString numberText(double value, int decimals);
/// Returns "05:12", with hours if there are any.
QString clockText(double seconds);
/// Returns a duration such as "12 s" or "32 min 17 s", in the format of base/duration_text.h.
QString durationText(double seconds, int decimals = 0);
/// Returns "18 720", with thin spaces between thousands.
QString countText(qulonglong value);

}  // namespace pitchboard::ui

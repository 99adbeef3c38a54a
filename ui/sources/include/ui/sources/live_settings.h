// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Loads and saves the options of Live in the user's settings. Options that cannot be read keep
// their defaults. Any thread, one at a time for the same settings.

#include <QString>

#include <robotlink/live/live_options.h>

class QSettings;

namespace pitchboard::ui {

struct LiveSettings {
  link::LiveOptions options;
  QString monitorAddress;  ///< referee to ask; monitor mode itself is off at each start
  QString problem;         ///< why an option could not be read, as a sentence; empty: no problem
};

LiveSettings loadLiveSettings(const QSettings& settings);
void saveLiveSettings(QSettings& settings, const LiveSettings& live);
/// Saves only the option with this key of liveOptionTable().
void saveLiveOption(QSettings& settings, std::string_view key, const link::LiveOptions& options);

}  // namespace pitchboard::ui

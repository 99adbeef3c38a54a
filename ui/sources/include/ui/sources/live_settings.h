// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Loads and saves the options of Live in the user's settings. Options that cannot be read keep
// their defaults. Any thread, one at a time for the same settings.

#include <QString>

#include <robotlink/live/live_watch.h>

class QSettings;

namespace pitchboard::ui {

struct LiveSettings {
  link::LiveOptions options;
  QString profileFile;     ///< empty: the published profile
  QString senders;         ///< addresses and networks as typed, separated by commas or spaces
  QString refereeSenders;  ///< the same for the referee
  QString monitorAddress;  ///< referee to ask; monitor mode itself is off at each start
  QString problem;         ///< why an option could not be read, as a sentence; empty: no problem
};

LiveSettings loadLiveSettings(const QSettings& settings);
void saveLiveSettings(QSettings& settings, const LiveSettings& live);
/// Saves only the attached blackboards.
void saveAttachedBoards(QSettings& settings, const std::vector<link::AttachedBoard>& boards);

/// Saves only the catalogs of variables that robots send.
void saveCatalogs(QSettings& settings, const std::vector<std::string>& files);

/// Reads "192.168.0.7, 192.168.1.0/24". Error InvalidArgument names the part that is wrong.
Result<telemetry::SenderFilter> sendersFromText(const QString& text);

}  // namespace pitchboard::ui

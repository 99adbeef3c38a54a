// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Live's options in the user's settings. What cannot be read is left at its default.

#include <QString>

#include <robotlink/live/live_watch.h>

class QSettings;

namespace pitchboard::ui {

struct LiveSettings {
  link::LiveOptions options;
  QString profileFile;     ///< empty: the published profile
  QString senders;         ///< as typed: addresses and networks, separated by commas or blanks
  QString refereeSenders;  ///< the same, of the referee
  QString monitorAddress;  ///< whom to ask; monitor mode itself is off at every start
  QString problem;         ///< why something could not be taken; a sentence
};

LiveSettings loadLiveSettings(const QSettings& settings);
void saveLiveSettings(QSettings& settings, const LiveSettings& live);
/// Of the settings only the robots that are this computer.
void saveAttachedBoards(QSettings& settings, const std::vector<link::AttachedBoard>& boards);

/// Of the settings only the maps of variables that robots send.
void saveCatalogs(QSettings& settings, const std::vector<std::string>& files);

/// Reads "192.168.0.7, 192.168.1.0/24". Error InvalidArgument names the part that is wrong.
Result<telemetry::SenderFilter> sendersFromText(const QString& text);

}  // namespace pitchboard::ui

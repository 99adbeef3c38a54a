// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dialog with the settings of Live: where to listen, accepted senders, message profiles and
// monitor mode. It is not modal, and shows errors itself. UI thread only.

#include <QDialog>

#include <ui/base/option_form.h>
#include <ui/sources/live_settings.h>

class QCheckBox;
class QGroupBox;
class QLabel;
class QLineEdit;

namespace pitchboard::ui {

class LiveController;
class TeamsPage;

class LiveSettingsDialog : public QDialog {
  Q_OBJECT
 public:
  LiveSettingsDialog(LiveController* live, QSettings* settings, QWidget* parent);
  /// Applies the settings. If one is wrong, shows the reason and returns false.
  bool apply();

 private:
  QWidget* makeGeneral();
  QWidget* makeNetwork();
  QWidget* makeReferee();
  QWidget* makeMessages();
  QGroupBox* makeGroup(const char* name);
  void adopt();
  void showProfile();
  void chooseProfile();
  void editProfile();
  bool fail(const QString& sentence);
  bool read(LiveSettings& live);

  LiveController* m_live;
  QSettings* m_settings;
  OptionForm<link::LiveOptions> m_options;
  QCheckBox* m_monitor;
  QLineEdit* m_monitorAddress;
  QLabel *m_profileName, *m_problem;
  TeamsPage* m_teams;
  telemetry::Profile m_profile;
  QString m_profileFile;
};

/// Opens the dialog, or raises it if it is already open.
void showLiveSettings(LiveController* live, QSettings* settings, QWidget* window);

}  // namespace pitchboard::ui

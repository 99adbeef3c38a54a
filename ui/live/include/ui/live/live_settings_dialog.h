// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dialog with the settings of Live: where to listen, accepted senders, message profiles and
// monitor mode. It is not modal, and shows errors itself. UI thread only.

#include <QDialog>

#include <ui/sources/live_settings.h>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QSpinBox;

namespace pitchboard::ui {

class LiveController;
class NetworkChooser;
class NumberBox;
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
  QWidget* makeRobots();
  QWidget* makeReferee();
  QWidget* makeMessages();
  QSpinBox* addNumber(QFormLayout* form, const char* name, const QString& label, int low, int high,
                      const QString& tip);
  NumberBox* addReal(QFormLayout* form, const char* name, const QString& label, double low,
                     double high, int decimals, const QString& unit, const QString& tip);
  void adopt();
  void showProfile();
  void chooseProfile();
  void editProfile();
  bool fail(const QString& sentence);
  bool read(LiveSettings& live);

  LiveController* m_live;
  QSettings* m_settings;
  NetworkChooser* m_bind;
  QSpinBox *m_portBase, *m_robots, *m_variablesPortBase, *m_refereePort, *m_ourTeam, *m_cells;
  QLineEdit *m_senders, *m_refereeSenders;
  NumberBox *m_timeout, *m_full, *m_low, *m_empty;
  QComboBox *m_field, *m_colours, *m_refereeVersion;
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

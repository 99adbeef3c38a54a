// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The part of the tool bar for Live: ports, our team, monitor mode, and a button that imports a
// catalog while robots send unknown variables. UI thread only.

#include <QWidget>

#include <ui/base/beat.h>

class QComboBox;
class QSettings;
class QToolButton;

namespace pitchboard::link {
struct LiveDetails;
}

namespace pitchboard::ui {

class LiveController;

class LiveBar : public QWidget {
  Q_OBJECT
 public:
  /// Both must outlive the bar.
  LiveBar(LiveController* live, QSettings* settings, QWidget* parent);
  enum class Width { Wide, Narrow, Least };
  /// With less room, first the button of the ports loses its text, then the others do.
  void setAvailableWidth(Width width);

 private:
  void refresh();
  void showTeams();
  void offerCatalog(const link::LiveDetails& details);
  void importCatalog();
  void switchMonitor(bool on);

  LiveController* m_live;
  QSettings* m_settings;
  QToolButton* m_ports;
  QComboBox* m_team;
  QToolButton* m_monitor;
  QToolButton* m_catalog;
  std::unique_ptr<Beat::Part> m_refresh;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the tool bar shows in Live: ports, our team, monitor mode. UI thread only.

#include <QWidget>

#include <ui/sources/studio_context.h>

class QComboBox;
class QToolButton;

namespace pitchboard::ui {

class LiveBar : public QWidget {
  Q_OBJECT
 public:
  LiveBar(const StudioContext& context, QWidget* parent);

 private:
  void refresh();
  void showTeams();
  void switchMonitor(bool on);

  StudioContext m_context;
  QToolButton* m_ports;
  QComboBox* m_team;
  QToolButton* m_monitor;
};

}  // namespace pitchboard::ui

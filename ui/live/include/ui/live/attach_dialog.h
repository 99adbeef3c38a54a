// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Robots that are this computer: chooses a System V segment, the robot it belongs to and the
// catalog of its variables, and lets attached ones go. What is attached is kept in the settings.
// Segments are only read. Qt owns it. UI thread only.

#include <QDialog>

#include <robotlink/live/attached_robots.h>

class QComboBox;
class QLabel;
class QPushButton;
class QSettings;
class QSpinBox;
class QTableWidget;

namespace pitchboard::ui {

class LiveController;
class NumberBox;

class AttachDialog : public QDialog {
  Q_OBJECT
 public:
  /// `settings` may be null: nothing is kept.
  AttachDialog(LiveController* live, QSettings* settings, QWidget* parent);

  /// Attaches what is chosen; false when it cannot be, which is then shown.
  bool attach();

 private:
  QWidget* makeForm();
  void refresh();
  void listSegments();
  void listAttached();
  void choose();
  void chooseCatalog(int index);
  void detach();
  void use(const std::vector<link::AttachedBoard>& boards);
  bool say(const QString& sentence, bool bad);

  LiveController* m_live;
  QSettings* m_settings;
  QTableWidget *m_segments, *m_attached;
  QSpinBox *m_key, *m_robot;
  QComboBox *m_team, *m_catalog;
  NumberBox* m_rate;
  QPushButton *m_attach, *m_detach;
  QLabel* m_message;
};

/// Opens the dialog, or brings the open one to the front.
void showAttachDialog(LiveController* live, QSettings* settings, QWidget* window);

}  // namespace pitchboard::ui

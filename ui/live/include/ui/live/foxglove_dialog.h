// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dialog that adds and removes programs whose topics Live shows, such as the Foxglove bridge of
// a robot with ROS 2, and says how each connection is. UI thread only.

#include <QDialog>

class QComboBox;
class QLineEdit;
class QPushButton;
class QSettings;
class QSpinBox;
class QTableWidget;

namespace pitchboard::link {
struct FoxgloveSource;
}

namespace pitchboard::ui {

class InPlaceMessage;
class LiveController;

class FoxgloveDialog : public QDialog {
  Q_OBJECT
 public:
  /// `live` and `settings` must outlive the dialog.
  FoxgloveDialog(LiveController* live, QSettings* settings, QWidget* parent);

  /// Adds the source of the form, or changes the one with its address. On failure, shows the reason
  /// and returns false.
  bool add();

 signals:
  /// Somebody wants to say what the topics of this bridge mean. The file is that of its mapping, or
  /// empty; setMapping() answers.
  void mappingWanted(const QString& address, const QString& file);

 public slots:
  /// Uses the mapping of a file for the bridge with this address.
  void setMapping(const QString& address, const QString& file);

 private:
  QWidget* makeForm();
  QWidget* makeMappingRow();
  void refresh();
  void choose();
  void remove();
  void chooseMapping();
  void editMapping();
  bool use(const std::vector<link::FoxgloveSource>& sources);
  bool showProblem(const QString& sentence);

  LiveController* m_live;
  QSettings* m_settings;
  QTableWidget* m_sources;
  QLineEdit* m_address;
  QSpinBox* m_robot;
  QComboBox* m_team;
  QLineEdit* m_mapping;
  QPushButton* m_remove;
  InPlaceMessage* m_problem;
};

/// Opens the dialog, or raises it if it is already open.
FoxgloveDialog* showFoxgloveDialog(LiveController* live, QSettings* settings, QWidget* window);

}  // namespace pitchboard::ui

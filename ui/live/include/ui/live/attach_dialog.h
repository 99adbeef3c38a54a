// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dialog that attaches and detaches blackboards of this computer: the user chooses a System V
// segment, the robot that it belongs to, and the catalog of its variables. UI thread only.

#include <QDialog>

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QTableWidget;

namespace pitchboard::ui {

class AttachedBoards;
class NumberBox;

class AttachDialog : public QDialog {
  Q_OBJECT
 public:
  /// `boards` must outlive the dialog.
  AttachDialog(AttachedBoards* boards, QWidget* parent);

  /// Attaches the chosen segment. On failure, shows the reason and returns false.
  bool attach();

 private:
  QWidget* makeForm();
  void refresh();
  void listSegments();
  void listAttached();
  void choose();
  void chooseCatalog(int index);
  void detach();
  bool showStatus(const QString& sentence, bool bad);

  AttachedBoards* m_boards;
  QTableWidget *m_segments, *m_attached;
  QSpinBox *m_key, *m_robot;
  QComboBox *m_team, *m_catalog;
  NumberBox* m_rate;
  QPushButton *m_attach, *m_detach;
  QLabel* m_message;
  bool m_wasListed = false;
};

/// Opens the dialog, or raises it if it is already open.
void showAttachDialog(AttachedBoards* boards, QWidget* window);

}  // namespace pitchboard::ui

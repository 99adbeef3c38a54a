// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dialog that shares what the window shows with other programs, and says who looks. UI thread
// only.

#include <QDialog>

class QCheckBox;
class QLabel;
class QPushButton;
class QSettings;
class QSpinBox;

namespace pitchboard::ui {

class InPlaceMessage;
class NetworkShare;

class ShareDialog : public QDialog {
  Q_OBJECT
 public:
  /// `share` and `settings` must outlive the dialog.
  ShareDialog(NetworkShare* share, QSettings* settings, QWidget* parent);

 private:
  void change();
  void refresh();

  NetworkShare* m_share;
  QSettings* m_settings;
  QSpinBox* m_port;
  QCheckBox* m_everyComputer;
  QLabel* m_state;
  InPlaceMessage* m_problem;
  QPushButton* m_change;
  QPushButton* m_copy;
};

/// Returns the address that others connect to, such as "ws://192.168.1.5:8765".
QString addressOf(const NetworkShare& share);

/// Opens the dialog, or raises it if it is already open.
void showShareDialog(NetworkShare* share, QSettings* settings, QWidget* window);

}  // namespace pitchboard::ui

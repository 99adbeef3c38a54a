// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A line inside the panel: which System V key to look at, and how often. UI thread only.

#include <QFrame>

class QSpinBox;

namespace pitchboard::ui {

class NumberBox;

class AttachForm : public QFrame {
  Q_OBJECT
 public:
  explicit AttachForm(QWidget* parent = nullptr);
  void open();

 signals:
  void attachRequested(int key, double rate);  ///< samples per second

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void request();

  QSpinBox* m_key;
  NumberBox* m_rate;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An experiment as a form: what is played, under which conditions, how often, and what must hold.
// The file itself is edited on its own tab. UI thread.

#include <QLabel>
#include <QScrollArea>
#include <QSpinBox>
#include <QTableWidget>

#include <robotlink/experiment/experiment.h>

namespace pitchboard::ui {

class ExperimentForm : public QScrollArea {
  Q_OBJECT
 public:
  explicit ExperimentForm(QWidget* parent);

  /// Shows what the file says, its number of runs included.
  void show(const link::Experiment& experiment);
  /// The file cannot be read: why.
  void showError(const QString& sentence);
  int runs() const { return m_runs->value(); }
  void setEditable(bool on) { m_runs->setEnabled(on); }

 private:
  void showAll();

  QLabel *m_title, *m_description, *m_all, *m_end, *m_assertions;
  QSpinBox* m_runs;
  QTableWidget* m_conditions;
};

}  // namespace pitchboard::ui

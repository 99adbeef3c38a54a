// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An experiment as a form: what is played, under which conditions, how often, and what must hold.
// Seed, runs and conditions are edited here, everything in the file on its own tab. UI thread.

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QTableWidget>

#include <robotlink/experiment/experiment.h>
#include <robotlink/experiment/experiment_edits.h>

namespace pitchboard::ui {

class ExperimentForm : public QScrollArea {
  Q_OBJECT
 public:
  explicit ExperimentForm(QWidget* parent);

  /// Shows what the file says, and what of it can be edited.
  void show(const link::Experiment& experiment, const link::ExperimentEdits& edits);
  /// The file cannot be read: why.
  void showError(const QString& sentence);
  /// As it stands in the form.
  link::ExperimentEdits edits() const;
  void setEditable(bool on);

 signals:
  /// By hand.
  void edited();

 private:
  void showAll();
  void addCondition(const link::ConditionEdit& condition);
  void fitConditions();
  void notifyEdited();

  QLabel *m_title, *m_description, *m_all, *m_end, *m_assertions;
  QLineEdit* m_seed;
  QSpinBox* m_runs;
  QTableWidget* m_conditions;
  QPushButton *m_add, *m_remove;
  int m_listed = 1;  // conditions that are played
  bool m_isGrid = false, m_isEditable = true, m_isShowing = false;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialogs for one curve, and for title and axes of a plot.

#include <QDialog>

#include <ui/plots/plot_layout.h>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace pitchboard::ui {

class NumberBox;
class PlotFeed;

/// What a curve shows and how. Cannot be accepted while the description cannot work; it says why.
class CurveDialog : public QDialog {
  Q_OBJECT
 public:
  CurveDialog(PlotFeed* feed, const CurveSpec& curve, QWidget* parent);
  CurveSpec curve() const;
  /// What is wrong at the moment; empty when nothing is.
  QString problem() const;

 private:
  void showKind();
  void check();

  PlotFeed* m_feed;
  CurveSpec m_curve;
  QFormLayout* m_form;
  QComboBox* m_kind;
  QLineEdit* m_first;
  QLineEdit* m_second;
  QLineEdit* m_expression;
  NumberBox* m_parameter;
  NumberBox* m_offset;
  QLineEdit* m_unit;
  QLineEdit* m_title;
  QLabel* m_problem;
  QPushButton* m_accept;
};

/// Title, axis title and limits of a plot.
class AxesDialog : public QDialog {
  Q_OBJECT
 public:
  /// `shown`: the limits in force, offered when fixed ones are wanted.
  AxesDialog(const PaneSpec& pane, ValueLimits shown, QWidget* parent);
  PaneSpec pane() const;

 private:
  void check();

  PaneSpec m_pane;
  QLineEdit* m_title;
  QLineEdit* m_valueTitle;
  QCheckBox* m_fixed;
  QLineEdit* m_low;
  QLineEdit* m_high;
  QLabel* m_problem;
  QPushButton* m_accept;
};

}  // namespace pitchboard::ui

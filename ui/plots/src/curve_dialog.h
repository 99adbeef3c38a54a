// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialogs for one curve, and for title and axes of a plot.

#include <QDialog>
#include <optional>

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
  /// "B1 has no variable NOSUCH. Did you mean …?" Empty where the source has all of them.
  QString unknownVariable() const;

 private:
  void showKind();
  void check();

  PlotFeed* m_feed;
  CurveSpec m_curve;
  QStringList m_names;  // of variables, to choose from
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
  /// `shown`, `shownRight`: the limits in force, offered when fixed ones are wanted. The second
  /// axis is asked for only when a curve of the plot is read there.
  AxesDialog(const PaneSpec& pane, ValueLimits shown, std::optional<ValueLimits> shownRight,
             QWidget* parent);
  PaneSpec pane() const;

 private:
  /// What is asked about one value axis.
  struct Axis {
    QLineEdit* title = nullptr;
    QCheckBox* fixed = nullptr;
    QLineEdit* low = nullptr;
    QLineEdit* high = nullptr;

    QString problem() const;
    ValueLimits limits() const;
  };
  /// `prefix` stands before the names of its boxes.
  Axis addAxis(const QString& caption, const QString& prefix, const QString& title, bool fixed,
               ValueLimits limits);
  void check();

  PaneSpec m_pane;
  QFormLayout* m_form;
  QLineEdit* m_title;
  Axis m_left, m_right;
  QLabel* m_problem;
  QPushButton* m_accept;
};

}  // namespace pitchboard::ui

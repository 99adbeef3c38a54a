// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Line edit for the value of one variable: says at once, right below itself, what is wrong with
// what is being typed.

#include <QLineEdit>
#include <QPointer>

#include <telemetry/series/series_types.h>

class QLabel;

namespace pitchboard::ui {

class ValueEdit : public QLineEdit {
  Q_OBJECT
 public:
  ValueEdit(const telemetry::ColumnInfo& column, QWidget* parent);
  ~ValueEdit() override;
  /// Shows what is wrong, if anything.
  bool isAcceptable();

 protected:
  void hideEvent(QHideEvent* event) override;

 private:
  telemetry::ColumnInfo m_column;
  QPointer<QLabel> m_problem;  // a child of our parent: it is larger than we are
};

}  // namespace pitchboard::ui

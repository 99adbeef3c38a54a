// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Passes variables from other docks to the plots, by drag and drop or by a call. UI thread only.

#include <QMimeData>
#include <QObject>
#include <QStringList>

namespace pitchboard::ui {

/// Format: UTF-8 text with a `GROUP/COLUMN` on each line, such as `B1/VISION_BALL_DIST`.
inline const QString variablesMimeType = QStringLiteral("application/x-pitchboard-variables");

class PlotTarget : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  /// Shows `GROUP/COLUMN` variables in the plots. Curves of groups that do not exist yet appear
  /// later.
  virtual void plotVariables(const QStringList& names) { emit requested(names); }
  /// Wherever a column of `group` is plotted by its name, draws that of `other` over it, if it is
  /// one of `columns`.
  void plotOver(const QString& group, const QString& other, const QStringList& columns) {
    emit overRequested(group, other, columns);
  }

 signals:
  void requested(const QStringList& names);
  void overRequested(const QString& group, const QString& other, const QStringList& columns);
};

}  // namespace pitchboard::ui

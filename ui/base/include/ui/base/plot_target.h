// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How other docks hand variables to the plots: by drag and drop, or by a call. UI thread only.

#include <QMimeData>
#include <QObject>
#include <QStringList>

namespace pitchboard::ui {

/// UTF-8 text, one `GROUP/COLUMN` a line: `B1/VISION_BALL_DIST`.
inline const QString variablesMimeType = QStringLiteral("application/x-pitchboard-variables");

class PlotTarget : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  /// Shows `GROUP/COLUMN` variables in the plots; groups that do not exist yet are waited for.
  virtual void plotVariables(const QStringList& names) { emit requested(names); }

 signals:
  void requested(const QStringList& names);
};

}  // namespace pitchboard::ui

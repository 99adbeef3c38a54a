// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything about one row of the statistics: distribution, figures, and the comparison with the
// other curve, or its values over the field. Times are links to their moments. UI thread only.

#include <QDateTime>
#include <QWidget>
#include <optional>
#include <utility>

#include <simcore/world/field.h>

#include "statistics_model.h"

class QComboBox;
class QLabel;
class QTabBar;

namespace pitchboard::ui {

class DelayChart;
class DistributionChart;
class FieldMap;

class LineDetails : public QWidget {
  Q_OBJECT
 public:
  explicit LineDetails(QWidget* parent);
  /// Shows a row; null: nothing. `against`: what it is compared with.
  void show(const StatisticsRow* row, const QString& against,
            const std::optional<QDateTime>& clock);
  /// The field whose lines maps have.
  void setField(const sim::FieldSpec& field) { m_field = field; }
  /// Returns the expressions of the place (m) over which values are to be averaged; nothing while
  /// no map is shown.
  std::optional<std::pair<QString, QString>> place() const;

 signals:
  /// A moment was clicked, s of the source that is shown.
  void momentClicked(double time);
  void placeChanged();

 protected:
  void changeEvent(QEvent* event) override;
  QSize sizeHint() const override;

 private:
  void write();

  bool showsMap() const;

  std::optional<StatisticsRow> m_row;
  QString m_against;
  std::optional<QDateTime> m_clock;
  sim::FieldSpec m_field;
  QTabBar* m_views;
  QComboBox* m_place;
  QLabel* m_title;
  DistributionChart* m_distribution;
  QLabel* m_figures;
  QLabel* m_error;
  DelayChart* m_delays;
  FieldMap* m_map;
  QLabel* m_mapNote;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a metric is distributed in each condition: shares of the runs in equal bins. UI thread.

#include <QWidget>

#include "experiment_play.h"

class QComboBox;
class QChart;
class QChartView;

namespace pitchboard::ui {

class DistributionView : public QWidget {
 public:
  explicit DistributionView(QWidget* parent);
  void show(const PlayedPtr& played);
  /// Chooses the metric; stands where the owner puts it.
  QComboBox* chooser() const { return m_metric; }
  /// Where the chart is.
  QWidget* area() const;

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void draw();

  PlayedPtr m_played;
  QComboBox* m_metric;
  QChart* m_chart;
  QChartView* m_view;
};

}  // namespace pitchboard::ui

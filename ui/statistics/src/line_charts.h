// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Charts of one row of the statistics: a histogram, or bars for the shares of states; and the
// correlation over the delay. UI thread only.

#include <QWidget>
#include <optional>

#include "statistics_model.h"

namespace pitchboard::ui {

/// How often the values occur. Shows counts under the pointer.
class DistributionChart : public QWidget {
  Q_OBJECT
 public:
  explicit DistributionChart(QWidget* parent);
  void show(const StatisticsRow& row);
  /// Returns the text for a place of the widget; empty if nothing is there.
  QString textAt(const QPoint& place) const;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QRectF area() const;
  std::size_t shownStates() const;
  void paintBins(QPainter& painter) const;
  void paintStates(QPainter& painter) const;

  StatisticsRow m_row;
};

/// The correlation of two curves at every delay that was tried.
class DelayChart : public QWidget {
  Q_OBJECT
 public:
  explicit DelayChart(QWidget* parent);
  void show(const telemetry::CurveCorrelation& correlation);
  QString textAt(const QPoint& place) const;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QRectF area() const;
  double most() const;  ///< s, the largest delay

  telemetry::CurveCorrelation m_correlation;
};

}  // namespace pitchboard::ui

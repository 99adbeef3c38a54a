// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plots of a calibration: predicted trajectories over recorded ones, and residuals of each
// sense. The same as in the report of pitchboard-cli calibrate. Metres. UI thread.

#include <QWidget>
#include <memory>
#include <vector>

#include <robotlink/calibrate/calibrate.h>

namespace pitchboard::ui {

/// Windows of 5 s: where the robot was, and where both models say it went from the same commands.
class PredictionsView : public QWidget {
 public:
  explicit PredictionsView(QWidget* parent);
  void show(std::shared_ptr<const link::Calibration> calibration, const sim::FieldSpec& field);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::shared_ptr<const link::Calibration> m_calibration;
  sim::FieldSpec m_field;
};

/// For each sense the size of its normalized innovations over time (1 where the model is right) and
/// their quantiles against those of the normal distribution (a straight line).
class ResidualsView : public QWidget {
 public:
  explicit ResidualsView(QWidget* parent);
  void show(std::shared_ptr<const link::Calibration> calibration);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  int rowHeight() const;

  std::shared_ptr<const link::Calibration> m_calibration;
};

}  // namespace pitchboard::ui

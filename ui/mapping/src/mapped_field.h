// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field of a MappingSample: robots where they are, and the balls that they see. UI thread only.

#include <QWidget>

#include <robotlink/import/mapping_sample.h>

namespace pitchboard::ui {

class MappedField : public QWidget {
 public:
  explicit MappedField(QWidget* parent);
  void setSample(const link::MappingSample& sample);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintRobot(QPainter& painter, const link::RobotFrame& robot) const;
  sim::FieldSpec m_field;
  std::vector<link::RobotFrame> m_robots;
};

}  // namespace pitchboard::ui

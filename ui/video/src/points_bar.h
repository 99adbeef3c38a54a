// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The bar with which four points of the field are placed in the picture of a camera: it says which
// point is next, and keeps at most four. UI thread only; owned by the panel.

#include <QWidget>
#include <optional>
#include <vector>

#include "field_overlay.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace pitchboard::ui {

class VideoCamera;

class PointsBar : public QWidget {
  Q_OBJECT
 public:
  explicit PointsBar(QWidget* parent);

  /// Places points of this camera, which may be null, on this field.
  void start(VideoCamera* camera, const sim::FieldSpec& field);
  /// Returns the point that the next click stands for; empty once there are four.
  std::optional<Point> next() const;
  /// The next point is here in the picture.
  void place(const Point& picture);

 signals:
  void nextChanged();
  void done();

 private:
  void showState();
  void goToNext();
  bool isPlaced(const Point& field) const;

  VideoCamera* m_camera = nullptr;
  std::vector<FieldMark> m_marks;
  QComboBox* m_choice;
  QLabel* m_hint;
  QPushButton* m_clear;
};

}  // namespace pitchboard::ui

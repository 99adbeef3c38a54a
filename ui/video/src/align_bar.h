// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The bar that aligns a camera with the session: its pictures are gone through while the session
// stands still, and one of them is declared to be the moment that is shown. UI thread only; owned
// by the panel.

#include <QWidget>
#include <optional>

#include "video_camera.h"

class QLabel;
class QPushButton;
class QSlider;

namespace pitchboard::ui {

class NumberBox;
class ShownMoment;

class AlignBar : public QWidget {
  Q_OBJECT
 public:
  AlignBar(ShownMoment* shown, QWidget* parent);

  /// Aligns this camera, beginning with the picture that it shows; null: none.
  void start(VideoCamera* camera);
  /// Returns the picture that is looked at.
  std::size_t index() const;
  void step(int pictures);
  /// Returns the moment of the session at the first picture by the clock of the camera, s; empty if
  /// one of the clocks is unknown.
  static std::optional<double> beginByClock(const VideoCamera& camera, const ShownMoment& shown);

 signals:
  void indexChanged();
  /// The camera is to be aligned by these moments, which may contradict each other.
  void aligned(const std::vector<pitchboard::telemetry::VideoAnchor>& anchors);
  /// The same, a step of several.
  void shifted(const std::vector<pitchboard::telemetry::VideoAnchor>& anchors);
  void done();

 private:
  void makeRows();
  void showState();
  void declare(bool isSecond);
  void shiftTo(double begin);
  telemetry::VideoAnchor here() const;

  ShownMoment* m_shown;
  VideoCamera* m_camera = nullptr;
  QSlider* m_slider;
  QLabel* m_place;
  QPushButton *m_same, *m_second, *m_clock;
  NumberBox* m_begin;
  QLabel* m_drift;
};

}  // namespace pitchboard::ui

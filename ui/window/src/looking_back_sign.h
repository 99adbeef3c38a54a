// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tells that the field shows the past and not the present. Window thread; the canvas owns it.

#include <QLabel>

namespace pitchboard::ui {

class Timeline;

/// Says at the top of the field that the past is shown: "Looking back: 00:03:12 (live goes on)".
class LookingBackSign : public QLabel {
  Q_OBJECT
 public:
  /// `canvas` is what it lies on.
  LookingBackSign(Timeline* timeline, QWidget* canvas);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void present();
  Timeline* m_timeline;
};

}  // namespace pitchboard::ui

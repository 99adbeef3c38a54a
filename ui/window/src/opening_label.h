// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tells that a match is being opened, which can take seconds. Window thread; the canvas owns it.

#include <QLabel>

namespace pitchboard::ui {

class MatchController;

/// Says on the field that a match is being opened, where the field says that none is.
class OpeningLabel : public QLabel {
  Q_OBJECT
 public:
  /// `canvas` is what it lies on.
  OpeningLabel(MatchController* controller, QWidget* canvas);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void present();
  MatchController* m_controller;
};

}  // namespace pitchboard::ui

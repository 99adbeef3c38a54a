// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Says at the top of the field that the past is shown: "Looking back: 03:12.50 (Now leads back)".
// UI thread only.

#include "field_sign.h"

namespace pitchboard::ui {

class Timeline;

class LookingBackSign : public FieldSign {
 public:
  /// `canvas` is what it lies on.
  LookingBackSign(Timeline* timeline, QWidget* canvas);

 private:
  void present() override;
  Timeline* m_timeline;
};

}  // namespace pitchboard::ui

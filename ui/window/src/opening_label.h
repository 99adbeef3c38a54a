// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Says on the field that a match is being opened, where the field says that none is. UI
// thread only.

#include "field_sign.h"

namespace pitchboard::ui {

class MatchController;

class OpeningLabel : public FieldSign {
 public:
  /// `canvas` is what it lies on.
  OpeningLabel(MatchController* controller, QWidget* canvas);

 private:
  void present() override;
  MatchController* m_controller;
};

}  // namespace pitchboard::ui

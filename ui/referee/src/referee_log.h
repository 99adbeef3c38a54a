// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the referee said up to the moment that is shown, newest last. A view of its events, so that
// undo, looking back and another source need nothing of their own. UI thread.

#include <QTableView>

namespace pitchboard::ui {

class ShownMoment;

class RefereeLog : public QTableView {
 public:
  RefereeLog(ShownMoment* shown, QWidget* parent);
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Rerun: the differences of the last rerun, from the recording or from the rerun before,
// each of which leads to its moment; runs again by hand or when the program changes. UI thread
// only.

#include <functional>

class QWidget;

namespace pitchboard::ui {

class Rerunner;
class ShownMoment;

/// Everything must outlive the dock.
struct RerunDockParts {
  Rerunner* rerunner = nullptr;
  ShownMoment* shown = nullptr;
  std::function<void()> ask;  ///< opens the dialog
};
QWidget* makeRerunDock(const RerunDockParts& parts, QWidget* parent);

}  // namespace pitchboard::ui

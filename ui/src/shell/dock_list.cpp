// SPDX-License-Identifier: GPL-3.0-or-later
#include "dock_list.h"

#include "log_dock.h"
#include "noise_dock.h"
#include "processes_dock.h"
#include "robots/robots_dock.h"
#include "variables/variables_dock.h"

namespace pitchboard::ui {

std::span<const DockInfo> studioDocks() {
  static constexpr DockInfo docks[] = {
      {"robots", "Robots", Qt::LeftDockWidgetArea, true, 256, makeRobotsDock},
      {"variables", "Variables", Qt::RightDockWidgetArea, true, 372, makeVariablesDock},
      {"noise", "Noise and physics", Qt::RightDockWidgetArea, false, 372, makeNoiseDock},
      {"processes", "Processes", Qt::BottomDockWidgetArea, true, 180, makeProcessesDock},
      {"log", "Log", Qt::BottomDockWidgetArea, true, 180, makeLogDock},
  };
  return docks;
}

}  // namespace pitchboard::ui

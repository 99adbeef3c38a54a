// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/window/dock_list.h>

#include <ui/live/bad_messages_dock.h>
#include <ui/log/log_dock.h>
#include <ui/noise/noise_dock.h>
#include <ui/plots/plots_dock.h>
#include <ui/processes/processes_dock.h>
#include <ui/robots/robots_dock.h>
#include <ui/timeline/timeline_dock.h>
#include <ui/variables/variables_dock.h>

namespace pitchboard::ui {

std::span<const DockInfo> studioDocks() {
  static constexpr DockInfo docks[] = {
      {"robots", "Robots", Qt::LeftDockWidgetArea, true, 256, makeRobotsDock},
      {"variables", "Variables", Qt::RightDockWidgetArea, true, 372, makeVariablesDock},
      {"noise", "Noise and physics", Qt::RightDockWidgetArea, false, 372, makeNoiseDock},
      {"plots", "Plots", Qt::BottomDockWidgetArea, true, 248, makePlotsDock},
      {"processes", "Processes", Qt::BottomDockWidgetArea, true, 180, makeProcessesDock},
      {"badMessages", "Bad messages", Qt::BottomDockWidgetArea, false, 180, makeBadMessagesDock},
      {"log", "Log", Qt::BottomDockWidgetArea, true, 180, makeLogDock},
      {"timeline", "Timeline", Qt::BottomDockWidgetArea, true, 56, makeTimelineDock, true},
  };
  return docks;
}

}  // namespace pitchboard::ui

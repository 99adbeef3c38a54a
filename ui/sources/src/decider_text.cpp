// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/decider_text.h>

#include <QStringList>

#include <robotlink/scenario/scenario.h>
#include <ui/base/robot_text.h>

namespace pitchboard::ui {

QString deciderText(const link::RobotFrame& robot) {
  QStringList programs;
  for (const std::string& program : robot.programs) programs << QString::fromStdString(program);
  if (!programs.isEmpty()) return programs.join(QStringLiteral(", "));
  return robot.behaviour == link::noBehaviour ? QStringLiteral("team program")
                                              : capitalised(robot.behaviour);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Frames made up for tests of the field, and a field to show them.

#include <QGraphicsView>
#include <QTest>

#include <cmath>
#include <memory>

#include <robotlink/frame/match_frame.h>
#include <simcore/world/published_frame.h>
#include <ui/field/field_view.h>

namespace made_frames {

using namespace pitchboard;

/// As its localization writes it; whole centimetres and degrees.
inline void believe(const link::MatchFrame& frame, link::RobotFrame& robot, const Pose& pose) {
  namespace published = sim::published_frame;
  auto written = published::localizationFromStudio(frame.settings->field, pose);
  written = {std::round(written.x), std::round(written.y), std::round(written.degrees)};
  robot.belief = published::studioFromLocalization(frame.settings->field, written);
}

inline std::shared_ptr<link::MatchFrame> frameOf(int robots) {
  static std::uint64_t serial = 0;
  auto frame = std::make_shared<link::MatchFrame>();
  frame->serial = ++serial;
  for (int i = 0; i < robots; ++i) {
    link::RobotFrame robot;
    robot.identity.id = {i + 1};
    robot.identity.number = i / 2 + 1;
    robot.identity.team = i % 2 == 0 ? TeamColor::Blue : TeamColor::Red;
    robot.uid = link::uidOf(robot.identity.id);
    robot.key = link::keyOf(robot.identity);
    robot.name = robot.identity.name();
    robot.pose = {{-3.0 + 0.7 * i, 1.5 - 0.5 * i}, 0.4 * i};
    robot.headYaw = robot.pose.yaw;
    robot.boardKey = 0;
    robot.behaviour = "striker";
    believe(*frame, robot, {{robot.pose.position.x + 0.1, robot.pose.position.y}, robot.pose.yaw});
    robot.sigma = 0.3;
    frame->robots.push_back(robot);
  }
  return frame;
}

/// The field alone, on the screen, with the keyboard.
inline std::unique_ptr<ui::FieldView> fieldOnScreen() {
  auto view = std::make_unique<ui::FieldView>(nullptr);
  view->resize(900, 660);
  view->show();
  if (!QTest::qWaitForWindowExposed(view.get())) qFatal("the field is not shown");
  view->findChild<QGraphicsView*>()->setFocus();
  return view;
}

}  // namespace made_frames

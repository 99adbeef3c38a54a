// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A window in Live on ports of its own, and one robot that sends what a test says: real datagrams
// on 127.0.0.1.

#include <QTest>
#include <algorithm>

#include <ui/sources/live_controller.h>
#include <ui/window/main_window.h>

#include "live_rig.h"

namespace live_rig {

class LiveWindow {
 public:
  explicit LiveWindow(pitchboard::ui::MainWindow& window) : m_window(window) {
    m_window.live()->setOptions(m_options);
    m_window.showSource(pitchboard::ui::SourceKind::Live);
  }
  bool isListening() const {
    return QTest::qWaitFor(
        [this] {
          const auto ports = m_window.live()->details().network.ports;
          return !ports.empty() &&
                 std::ranges::all_of(ports, [](const auto& one) { return one.bound; });
        },
        patience_ms);
  }
  /// Sends a message with this distance to the ball (cm) from another place than before, and waits
  /// until the robot is shown there.
  bool say(float ballDistance = 100.0F) {
    pitchboard::telemetry::TextMessage said = message(number);
    said.x = ++m_place;
    said.ballDist = ballDistance;
    return m_robot.sendMessage(said) &&
           QTest::qWaitFor([this] { return place() == m_place; }, patience_ms);
  }
  /// Where the robot is in the newest frame, or in this one, as it says (cm); -1: nowhere.
  int place() const { return placeIn(m_window.live()->frame()); }
  static int placeIn(const pitchboard::ui::FramePtr& frame) {
    if (!frame || frame->robots.size() != 1 || !frame->robots[0].belief) return -1;
    return qRound(100 * (frame->robots[0].belief->position.x + 4.5));
  }

 private:
  static constexpr int number = 3, patience_ms = 30'000;
  pitchboard::ui::MainWindow& m_window;
  pitchboard::link::LiveOptions m_options = options();
  Robot m_robot{m_options, number};
  int m_place = 100;
};

}  // namespace live_rig

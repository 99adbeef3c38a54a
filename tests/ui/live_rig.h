// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Robots and a referee on 127.0.0.1 for tests of Live: real sockets, ports of this process only.

#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QStringList>
#include <algorithm>
#include <string>

#include <robotlink/live/live_watch.h>
#include <telemetry/formats/text_protocol.h>

#include "../support/test_socket.h"

namespace live_rig {

/// Base of ports below those that the system gives away; other test programs use others at this
/// time.
inline int freePortBase() {
  static int next = 0;
  return 12000 + static_cast<int>(getpid() % 180) * 110 + 20 * (next++ % 5);
}

inline pitchboard::link::LiveOptions options(int base = freePortBase()) {
  pitchboard::link::LiveOptions made;
  made.bind = {INADDR_LOOPBACK};
  made.portBase = base;
  made.robots = 16;
  made.refereePort = base + 18;
  made.variablesPortBase = 0;
  return made;
}

/// A healthy robot on the left half.
inline pitchboard::telemetry::TextMessage message(int robot) {
  pitchboard::telemetry::TextMessage m;
  m.robot = robot;
  m.x = 150 + 40 * robot;
  m.y = 200 + 30 * robot;
  m.theta = 10 * robot;
  m.belief = 20.0F;
  m.ballDist = 100.0F;
  m.ballAngle = 5.0F;
  m.control = m.vision = m.localization = m.decision = m.imu = 1;
  m.actionA = 8;
  m.imuEulerZ = 0.25F;
  m.voltage = 165;
  return m;
}

/// One robot's program.
class Robot {
 public:
  Robot(const pitchboard::link::LiveOptions& options, int number)
      : m_port(static_cast<std::uint16_t>(options.portBase + number)), m_number(number) {}

  bool sendMessage(const pitchboard::telemetry::TextMessage& m) const {
    return m_socket.send(m_port, pitchboard::telemetry::encode(m));
  }
  bool sendMessage() const { return sendMessage(message(m_number)); }
  bool sendMessage(std::string_view text) const { return m_socket.send(m_port, text); }
  bool received() const { return m_socket.received(); }
  std::uint16_t port() const { return m_socket.port(); }

 private:
  TestSocket m_socket;
  std::uint16_t m_port;
  int m_number;
};

/// Leaves `options` ports for variables of four robots.
inline void receiveVariables(pitchboard::link::LiveOptions& options) {
  options.robots = 4;
  options.variablesPortBase = options.portBase + options.robots;
}

/// What sends a robot's variables, as pitchboard-agent does.
class Agent {
 public:
  Agent(const pitchboard::link::LiveOptions& options, int number)
      : m_port(static_cast<std::uint16_t>(options.variablesPortBase + number)), m_number(number) {
    m_clock.start();
  }
  /// `fields`: "VOLTAGE=148 IMU_EULER_Z=0.5", a sample later than the last one.
  bool send(const std::string& fields) {
    m_time_ms = std::max<std::int64_t>(m_time_ms + 1, m_clock.elapsed());
    return m_socket.send(m_port, "PB2 " + std::to_string(m_number) + " " +
                                     std::to_string(m_sequence++) + " " +
                                     std::to_string(m_time_ms) + " " + fields + " OUT");
  }

 private:
  TestSocket m_socket;
  std::uint16_t m_port;
  int m_number;
  unsigned m_sequence = 0;
  std::int64_t m_time_ms = 0;
  QElapsedTimer m_clock;
};

/// A recorded packet of tests/data/gamecontroller.
inline std::string packet(const QString& name) {
  QFile file(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/gamecontroller/") + name);
  if (!file.open(QIODevice::ReadOnly)) return {};
  return file.readAll().toStdString();
}

}  // namespace live_rig

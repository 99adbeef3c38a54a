// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the reference processes have in mind, for drawing: the particles of localization, the path
// of decision. It is no part of the Cross Architecture: nothing but a display uses it, and
// unchanged robots have none. Metres and radians in the studio's frame, weights as shares.
//
// Two ways to the reader. Processes that run inside this program are asked
// (CognitiveProcess::sendDebugData). Processes of their own send datagrams to a UDP port of this
// computer's loopback device, five times a second, and only when `--debug-port` names one;
// nothing stays behind when either side dies. A datagram is text; lengths are whole millimetres,
// angles milliradians, weights millionths:
//   PBT1 cloud ROBOT COUNT X Y YAW SIGMA  x y yaw weight  x y yaw weight ...   (at most 500)
//   PBT1 path ROBOT COMPLETE  x y  x y ...                                     (at most 64 points)

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <base/ids.h>
#include <base/result.h>
#include <base/unique_fd.h>
#include <telemetry/wire/udp_sender.h>

namespace pitchboard::link {

struct Particle {
  Point position;       ///< m
  double yaw = 0.0;     ///< rad
  double weight = 0.0;  ///< shares of the sample add up to 1
  bool operator==(const Particle&) const = default;
};

/// What localization believes.
struct ParticleCloud {
  static constexpr std::size_t most = 500;
  std::vector<Particle> particles;  ///< an evenly drawn sample of at most `most`
  int count = 0;                    ///< particles that the filter has
  Pose pose;                        ///< the belief
  double sigma = 0.0;               ///< m
  bool operator==(const ParticleCloud&) const = default;
};

/// Where decision wants to walk.
struct PlannedPath {
  static constexpr std::size_t most = 64;
  std::vector<Point> points;  ///< m, from the robot to the target; empty = it walks nowhere
  bool complete = true;       ///< false: no way to the target, the path ends nearest to it
  bool operator==(const PlannedPath&) const = default;
};

/// The newest of one robot. Cheap to copy: what is pointed to never changes.
struct CognitionDebug {
  RobotId robot;
  std::shared_ptr<const ParticleCloud> cloud;  ///< nothing: none heard of
  std::shared_ptr<const PlannedPath> path;     ///< nothing: none heard of
  double cloudAge = 0.0, pathAge = 0.0;        ///< s since it was told
};

/// The datagrams of what is there, without the line end; at most two.
std::vector<std::string> debugDatagrams(const CognitionDebug& cognitionDebug);
/// Takes over what a datagram says; false, and nothing is changed, when it is not one of these.
bool readDebugDatagram(std::string_view datagram, CognitionDebug& cognitionDebug);

/// Tells a display on this computer. One thread at a time.
class CognitionDebugSender {
 public:
  /// Port 1..65535 of 127.0.0.1.
  static Result<CognitionDebugSender> to(int port);
  /// Never waits; nobody need listen.
  void send(const CognitionDebug& cognitionDebug);

 private:
  CognitionDebugSender(telemetry::UdpSender sender, std::uint16_t port)
      : m_sender(std::move(sender)), m_port(port) {}

  telemetry::UdpSender m_sender;
  std::uint16_t m_port;
};

/// Hears what processes on this computer tell. Use from one thread; poll it at the rate of the
/// display, or the kernel's buffer drops what is older.
class CognitionDebugReceiver {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// On 127.0.0.1; 0 takes a free port.
  static Result<CognitionDebugReceiver> listen(int port = 0);

  int port() const { return m_port; }
  /// Takes what waits. Never blocks.
  void poll(Time now);
  /// Of every robot heard of within the last 3 s, by number, with ages as of `now`.
  std::vector<CognitionDebug> cognitionDebug(Time now) const;
  /// Datagrams that were none of these.
  std::uint64_t strange() const { return m_strange; }

 private:
  struct Received {
    CognitionDebug cognitionDebug;
    Time cloudTime{}, pathTime{};
  };
  CognitionDebugReceiver(UniqueFd socket, int port) : m_socket(std::move(socket)), m_port(port) {}

  UniqueFd m_socket;
  int m_port = 0;
  std::map<RobotId, Received> m_received;
  std::vector<char> m_buffer;
  std::uint64_t m_strange = 0;
};

}  // namespace pitchboard::link

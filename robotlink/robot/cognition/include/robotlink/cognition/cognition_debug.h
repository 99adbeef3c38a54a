// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Debug data of the reference processes for drawing: the particles of localization and the planned
// path of decision. Only displays use it, and real robots do not send it. Metres and radians in the
// studio's frame; weights are shares of 1.
//
// Processes inside this program are asked with CognitiveProcess::sendDebugData(). Separate
// processes send datagrams five times a second to the UDP port of the loopback device that
// `--debug-port` names. A datagram is text; lengths are whole millimetres, angles milliradians,
// weights millionths:
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
#include <telemetry/sockets/udp_sender.h>

namespace pitchboard::link {

struct Particle {
  Point position;       ///< m
  double yaw = 0.0;     ///< rad
  double weight = 0.0;  ///< the weights of a cloud add up to 1
  bool operator==(const Particle&) const = default;
};

/// What localization believes.
struct ParticleCloud {
  static constexpr std::size_t most = 500;
  std::vector<Particle> particles;  ///< a uniform sample of at most `most` particles
  int count = 0;                    ///< number of particles in the filter
  Pose pose;                        ///< the believed pose
  double sigma = 0.0;               ///< m
  bool operator==(const ParticleCloud&) const = default;
};

/// Where decision wants to walk.
struct PlannedPath {
  static constexpr std::size_t most = 64;
  std::vector<Point> points;  ///< m, from the robot to the target; empty: it does not walk
  bool complete = true;       ///< false: the target is out of reach; the path ends close to it
  bool operator==(const PlannedPath&) const = default;
};

/// The newest debug data of a robot. Cheap to copy, because the data are immutable.
struct CognitionDebug {
  RobotId robot;
  std::shared_ptr<const ParticleCloud> cloud;  ///< null: none received
  std::shared_ptr<const PlannedPath> path;     ///< null: none received
  double cloudAge = 0.0, pathAge = 0.0;        ///< s since they were received
};

/// Returns a datagram for the cloud and one for the path, as far as there are any.
std::vector<std::string> debugDatagrams(const CognitionDebug& cognitionDebug);
/// Reads a datagram into `cognitionDebug`. Returns false, without a change, if it is invalid.
bool readDebugDatagram(std::string_view datagram, CognitionDebug& cognitionDebug);

/// Sends debug data to a display on this computer. One thread at a time.
class CognitionDebugSender {
 public:
  /// `port` is 1 to 65535, on 127.0.0.1.
  static Result<CognitionDebugSender> to(int port);
  /// Never blocks, and does not fail if nobody listens.
  void send(const CognitionDebug& cognitionDebug);

 private:
  CognitionDebugSender(telemetry::UdpSender sender, std::uint16_t port)
      : m_sender(std::move(sender)), m_port(port) {}

  telemetry::UdpSender m_sender;
  std::uint16_t m_port;
};

/// Receives the debug data of processes on this computer. Use it on one thread, and poll it at the
/// rate of the display, so that the kernel's buffer does not overflow.
class CognitionDebugReceiver {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Listens on a port of 127.0.0.1; 0 chooses a free one.
  static Result<CognitionDebugReceiver> listen(int port = 0);

  int port() const { return m_port; }
  /// Reads all waiting datagrams. Never blocks.
  void poll(Time now);
  /// Returns the data of robots that sent any within the last 3 s, in order of their ids, with ages
  /// at `now`.
  std::vector<CognitionDebug> cognitionDebug(Time now) const;
  /// Returns the number of invalid datagrams.
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

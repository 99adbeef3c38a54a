// SPDX-License-Identifier: GPL-3.0-or-later
// The text of the datagrams.
#include <robotlink/cognition/cognition_debug.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <base/ids.h>

namespace pitchboard::link {
namespace {

constexpr std::string_view cloudHead = "PBT1 cloud", pathHead = "PBT1 path";
constexpr double maxCoordinateLength = 1000.0;  // m

class Writer {
 public:
  explicit Writer(std::string_view head) : m_text(head) {}
  void whole(long long value) {
    char digits[24];
    const auto end = std::to_chars(digits, digits + sizeof digits, value);
    m_text += ' ';
    m_text.append(digits, end.ptr);
  }
  void thousandths(double value) {
    whole(std::isfinite(value)
              ? std::llround(1000 * std::clamp(value, -maxCoordinateLength, maxCoordinateLength))
              : 0);
  }
  std::string take() { return std::move(m_text); }

 private:
  std::string m_text;
};

/// Whole numbers divided by single blanks; the first fault ends the reading.
class Reader {
 public:
  explicit Reader(std::string_view text) : m_at(text.data()), m_end(text.data() + text.size()) {}
  bool atEnd() const { return m_at == m_end; }
  bool good() const { return m_good; }
  long long whole(long long least, long long most) {
    long long value = least;
    if (!m_good || m_at == m_end || *m_at != ' ') {
      m_good = false;
      return least;
    }
    const auto [next, error] = std::from_chars(m_at + 1, m_end, value);
    m_good = error == std::errc{} && value >= least && value <= most;
    m_at = next;
    return m_good ? value : least;
  }
  double thousandths() {
    constexpr auto most = static_cast<long long>(1000 * maxCoordinateLength);
    return static_cast<double>(whole(-most, most)) / 1000.0;
  }
  Point point() {
    const double x = thousandths();
    return {x, thousandths()};
  }

 private:
  const char* m_at;
  const char* m_end;
  bool m_good = true;
};

std::string cloudText(RobotId robot, const ParticleCloud& cloud) {
  Writer out(cloudHead);
  out.whole(robot.value);
  out.whole(cloud.count);
  for (const double value :
       {cloud.pose.position.x, cloud.pose.position.y, cloud.pose.yaw, cloud.sigma}) {
    out.thousandths(value);
  }
  const std::size_t shown = std::min(cloud.particles.size(), ParticleCloud::most);
  for (std::size_t i = 0; i < shown; ++i) {
    const Particle& p = cloud.particles[i];
    for (const double value : {p.position.x, p.position.y, p.yaw}) out.thousandths(value);
    out.whole(std::llround(1e6 * std::clamp(std::isfinite(p.weight) ? p.weight : 0.0, 0.0, 1.0)));
  }
  return out.take();
}

std::string pathText(RobotId robot, const PlannedPath& path) {
  Writer out(pathHead);
  out.whole(robot.value);
  out.whole(path.complete ? 1 : 0);
  const std::size_t shown = std::min(path.points.size(), PlannedPath::most);
  for (std::size_t i = 0; i < shown; ++i) {
    out.thousandths(path.points[i].x);
    out.thousandths(path.points[i].y);
  }
  return out.take();
}

std::shared_ptr<const ParticleCloud> readCloud(Reader& in) {
  constexpr int maxCounted = 1'000'000;
  auto cloud = std::make_shared<ParticleCloud>();
  cloud->count = static_cast<int>(in.whole(0, maxCounted));
  cloud->pose.position = in.point();
  cloud->pose.yaw = in.thousandths();
  cloud->sigma = in.thousandths();
  while (in.good() && !in.atEnd() && cloud->particles.size() < ParticleCloud::most) {
    Particle p;
    p.position = in.point();
    p.yaw = in.thousandths();
    p.weight = static_cast<double>(in.whole(0, 1'000'000)) / 1e6;
    cloud->particles.push_back(p);
  }
  return in.good() && in.atEnd() && cloud->sigma >= 0.0 ? cloud : nullptr;
}

std::shared_ptr<const PlannedPath> readPath(Reader& in) {
  auto path = std::make_shared<PlannedPath>();
  path->complete = in.whole(0, 1) == 1;
  while (in.good() && !in.atEnd() && path->points.size() < PlannedPath::most) {
    path->points.push_back(in.point());
  }
  return in.good() && in.atEnd() ? path : nullptr;
}

}  // namespace

std::vector<std::string> debugDatagrams(const CognitionDebug& cognitionDebug) {
  std::vector<std::string> datagrams;
  if (cognitionDebug.cloud)
    datagrams.push_back(cloudText(cognitionDebug.robot, *cognitionDebug.cloud));
  if (cognitionDebug.path)
    datagrams.push_back(pathText(cognitionDebug.robot, *cognitionDebug.path));
  return datagrams;
}

bool readDebugDatagram(std::string_view datagram, CognitionDebug& cognitionDebug) {
  const bool cloud = datagram.starts_with(cloudHead);
  if (!cloud && !datagram.starts_with(pathHead)) return false;
  Reader in(datagram.substr(cloud ? cloudHead.size() : pathHead.size()));
  const RobotId robot{static_cast<int>(in.whole(1, highestRobotNumber))};
  if (!in.good()) return false;
  if (cloud) {
    auto received = readCloud(in);
    if (!received) return false;
    cognitionDebug.cloud = std::move(received);
  } else {
    auto received = readPath(in);
    if (!received) return false;
    cognitionDebug.path = std::move(received);
  }
  cognitionDebug.robot = robot;
  return true;
}

}  // namespace pitchboard::link

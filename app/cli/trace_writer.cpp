// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_writer.h"

#include <array>
#include <cerrno>
#include <charconv>

#include <base/angles.h>

#include "output_file.h"

namespace pitchboard::cli {
namespace {

template <class T>
void append(std::string& line, T value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  if (!line.empty()) line += ',';
  line.append(text.data(), end.ptr);
}

constexpr const char* what = "the trace";

}  // namespace

Result<TraceWriter> TraceWriter::create(const std::string& path, bool overwrite,
                                        const sim::Snapshot& first) {
  auto file = openForWriting(path, overwrite, what);
  if (!file) return tl::unexpected(file.error());
  TraceWriter writer(*file, path);
  writer.m_line = "tick,time_s,ball_x,ball_y,ball_vx,ball_vy,score_left,score_right";
  for (const sim::RobotSnapshot& robot : first.robots) {
    const std::string name =
        std::string(info(robot.identity.team).letter) + std::to_string(robot.identity.number) + '_';
    for (const char* column : {"x", "y", "heading_deg", "head_deg", "action"}) {
      writer.m_line += ',' + name + column;
    }
  }
  if (auto written = writer.write(); !written) return tl::unexpected(written.error());
  return writer;
}

Result<void> TraceWriter::add(const sim::Snapshot& snapshot) {
  m_line.clear();
  append(m_line, snapshot.tick);
  append(m_line, snapshot.time);
  for (const double value :
       {snapshot.ball.x, snapshot.ball.y, snapshot.ballVelocity.x, snapshot.ballVelocity.y}) {
    append(m_line, value);
  }
  append(m_line, snapshot.score.left);
  append(m_line, snapshot.score.right);
  for (const sim::RobotSnapshot& robot : snapshot.robots) {
    append(m_line, robot.pose.position.x);
    append(m_line, robot.pose.position.y);
    append(m_line, degreesFromRadians(robot.pose.yaw));
    append(m_line, degreesFromRadians(robot.headYaw));
    append(m_line, robot.action);
  }
  return write();
}

Result<void> TraceWriter::write() {
  m_line += '\n';
  if (std::fwrite(m_line.data(), 1, m_line.size(), m_file.get()) != m_line.size()) {
    return cannotWrite(m_path, errno, what);
  }
  return {};
}

Result<void> TraceWriter::finish() {
  std::FILE* file = m_file.release();
  if (std::fclose(file) != 0) return cannotWrite(m_path, errno, what);
  return {};
}

}  // namespace pitchboard::cli

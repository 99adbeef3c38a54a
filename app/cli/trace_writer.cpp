// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_writer.h"

#include <array>
#include <charconv>

#include <base/angles.h>
#include <base/byte_sizes.h>
#include <base/try.h>

namespace pitchboard::cli {
namespace {

template <class T>
void append(std::string& line, T value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  if (!line.empty()) line += ',';
  line.append(text.data(), end.ptr);
}

constexpr std::size_t mostWaiting = 64 * kibibyte;  // bytes

}  // namespace

Result<TraceWriter> TraceWriter::create(const std::string& path, IfExists ifExists,
                                        const std::string& source, const sim::Snapshot& first) {
  auto target = TRY(FileTarget::at(path, ifExists, source));
  auto file = TRY(target.open());
  TraceWriter writer(std::move(target), std::move(file));
  writer.m_line = "tick,time_s,ball_x,ball_y,ball_vx,ball_vy,score_left,score_right";
  for (const sim::RobotSnapshot& robot : first.robots) {
    const std::string name = robot.identity.name() + '_';
    for (const char* column : {"x", "y", "heading_deg", "head_deg", "action"}) {
      writer.m_line += ',' + name + column;
    }
  }
  TRY(writer.endLine());
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
  return endLine();
}

Result<void> TraceWriter::endLine() {
  m_text += m_line;
  m_text += '\n';
  return m_text.size() < mostWaiting ? Result<void>{} : flush();
}

Result<void> TraceWriter::flush() {
  auto written = m_file.write(m_text);
  m_text.clear();
  return written;
}

Result<void> TraceWriter::finish() {
  TRY(flush());
  TRY(m_file.close());
  return m_target.commit();
}

}  // namespace pitchboard::cli

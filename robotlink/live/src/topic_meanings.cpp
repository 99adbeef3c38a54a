// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/topic_meanings.h>

#include <algorithm>
#include <cmath>

#include <telemetry/referee/gamecontroller.h>
#include <telemetry/referee/gamecontroller_encoder.h>

namespace pitchboard::link {
namespace {

using telemetry::RecordedMessage;
using telemetry::RecordedTopic;

constexpr double maxStampOffset = 60.0;  // s; beyond it, stamp and log time are of two clocks

/// ROS 2 counts levels in tens, ROS 1 in powers of two.
LogLevel logLevelOfCode(std::optional<double> code) {
  if (!code) return LogLevel::Info;
  const bool isRos1 = *code == 1 || *code == 2 || *code == 4 || *code == 8 || *code == 16;
  const double level = isRos1 ? 10.0 * (1.0 + std::log2(*code)) : *code;
  return level >= 50   ? LogLevel::Fatal
         : level >= 40 ? LogLevel::Error
         : level >= 30 ? LogLevel::Warning
         : level >= 20 ? LogLevel::Info
                       : LogLevel::Debug;
}

}  // namespace

TopicLog::TopicLog(const TopicMapping& mapping) {
  for (const MappedLog& log : mapping.log) {
    m_paths.push_back(
        {log.topic, TopicPath(log.text), TopicPath(log.level), TopicPath(log.origin)});
  }
}

std::optional<LogLine> TopicLog::lineOf(const RecordedTopic& topic, const RecordedMessage& message,
                                        double time) const {
  for (const Paths& paths : m_paths) {
    if (paths.topic != topic.name) continue;
    const auto text = paths.text.text(message);
    if (!text) continue;
    LogLine line;
    line.time = time;
    line.text = *text;
    line.origin = paths.origin.text(message).value_or(paths.topic);
    line.level = logLevelOfCode(paths.level.number(message));
    return line;
  }
  return {};
}

TopicReferee::TopicReferee(const MappedReferee& mapped)
    : m_mapped(mapped),
      m_state(mapped.state),
      m_secondsLeft(mapped.secondsLeft),
      m_firstHalf(mapped.firstHalf),
      m_leftScore(mapped.leftScore),
      m_rightScore(mapped.rightScore) {}

std::optional<std::string> TopicReferee::packetOf(const RecordedTopic& topic,
                                                  const RecordedMessage& message) {
  if (m_mapped.topic != topic.name) return {};
  const auto state = m_state.number(message);
  if (!state) return {};
  const auto whole = [&message](const TopicPath& path, int fallback, int most) {
    return static_cast<int>(
        std::lround(std::clamp(path.number(message).value_or(fallback), -1.0 * most, 1.0 * most)));
  };
  telemetry::RefereeState packet;
  packet.version = 12;
  packet.size = telemetry::refereePacketSize(packet.version, 688).value_or(0);
  packet.state = static_cast<int>(std::lround(std::clamp(*state, 0.0, 4.0)));
  packet.firstHalf = whole(m_firstHalf, 1, 1) != 0 ? 1 : 0;
  packet.secsRemaining = whole(m_secondsLeft, 0, 32'767);
  packet.packetNumber = m_packets++ & 0xff;
  packet.secState = packet.gameType = packet.dropInTeam = packet.secondaryTime = 0;
  packet.dropInTime = -1;
  packet.secStateInfo.emplace();
  for (const bool right : {false, true}) {
    telemetry::RefereeTeam& team = packet.teams[right ? 1 : 0];
    team.number = right ? 2 : 1;
    team.colour = telemetry::colourCode(right ? m_mapped.right : m_mapped.left);
    team.score = std::max(0, whole(right ? m_rightScore : m_leftScore, 0, 255));
    team.penaltyShot = team.singleShots = 0;
    team.slotCount = telemetry::refereeSlots(packet.version, packet.size);
    for (std::size_t i = 0; i < team.slotCount; ++i) {
      team.allSlots[i].number = static_cast<int>(i) + 1;
      team.allSlots[i].warnings = team.allSlots[i].yellow = team.allSlots[i].red = 0;
      team.allSlots[i].goalkeeper = 0;
    }
  }
  const auto bytes = telemetry::encodeReferee(packet);
  if (!bytes) return {};
  return *bytes;
}

std::int64_t StampChoice::timeOf(const RecordedMessage& message) {
  if (!message.stamp || *message.stamp <= 0) return message.logTime;
  const double offset =
      std::abs(static_cast<double>(*message.stamp) - static_cast<double>(message.logTime)) / 1e9;
  const bool isNear = offset <= maxStampOffset;
  if (!m_usesStamps) m_usesStamps = isNear;
  if (!*m_usesStamps) return message.logTime;
  if (isNear) return *message.stamp;
  ++m_odd;
  return message.logTime;
}

}  // namespace pitchboard::link

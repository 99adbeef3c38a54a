// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/team_monitor.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "team_monitor_books.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t maxSenders = 64;

constexpr FieldMeaning processFlags[processCount] = {FieldMeaning::Control, FieldMeaning::Vision,
                                                     FieldMeaning::Localization,
                                                     FieldMeaning::Decision, FieldMeaning::Imu};

/// A time span that a clock set back cannot make negative.
Duration since(WallTime now, WallTime then) {
  return std::max(now - then, Duration::zero());
}

}  // namespace

TeamMonitor::TeamMonitor(Profile profile, MonitorOptions options)
    : m_options(std::move(options)),
      m_decoder(std::make_shared<const TextDecoder>(std::move(profile))) {
  m_robots.reserve(MonitorOptions::maxRobots);
}
TeamMonitor::~TeamMonitor() = default;
TeamMonitor::TeamMonitor(TeamMonitor&&) noexcept = default;
TeamMonitor& TeamMonitor::operator=(TeamMonitor&&) noexcept = default;

void TeamMonitor::setProfile(Profile profile) {
  m_decoder = std::make_shared<const TextDecoder>(std::move(profile));
}

void TeamMonitor::setOptions(MonitorOptions options) {
  m_options = std::move(options);
}

void TeamMonitor::clear() {
  m_robots.clear();
  m_senders.clear();
  m_datagrams = m_refusedByFilter = m_refusedRobots = 0;
  m_errors = {};
}

TeamMonitor::SenderRecord* TeamMonitor::findSender(Address address) {
  for (SenderRecord& sender : m_senders) {
    if (sender.status.address == address) return &sender;
  }
  if (m_senders.size() == maxSenders) return nullptr;
  m_senders.emplace_back();
  m_senders.back().status.address = address;
  return &m_senders.back();
}

TeamMonitor::Robot* TeamMonitor::findRobot(int number, const Sender& sender, WallTime time) {
  Robot* restarted = nullptr;
  for (Robot& robot : m_robots) {
    if (robot.number != number || robot.sender.address != sender.address) continue;
    if (robot.sender.port == sender.port) return &robot;
    // A program that was started again, or opens a socket for each message, is the same robot. Two
    // programs on one computer are not: there the earlier port speaks again.
    const bool earlierSpeaksAgain =
        robot.previousPort == sender.port && since(time, robot.last) < m_options.timeout;
    if (!earlierSpeaksAgain) restarted = &robot;
  }
  if (restarted != nullptr) {
    restarted->previousPort = restarted->sender.port;
    restarted->sender = sender;
    return restarted;
  }
  if (m_robots.size() == MonitorOptions::maxRobots) {
    const auto oldest =
        std::min_element(m_robots.begin(), m_robots.end(),
                         [](const Robot& a, const Robot& b) { return a.last < b.last; });
    if (since(time, oldest->last) < m_options.timeout) return nullptr;
    *oldest = Robot{};
    oldest->number = number;
    oldest->serial = ++m_serial;
    oldest->sender = sender;
    return &*oldest;
  }
  m_robots.emplace_back();
  m_robots.back().number = number;
  m_robots.back().serial = ++m_serial;
  m_robots.back().sender = sender;
  return &m_robots.back();
}

TeamMonitor::Verdict TeamMonitor::take(const DatagramView& datagram) {
  ++m_datagrams;
  if (!m_options.senders.allows(datagram.sender.address)) {
    ++m_refusedByFilter;
    m_decoded.count = 0;
    m_decoded.errors = {};
    m_decoded.robot = 0;
    return Verdict::SenderRefused;
  }
  m_decoder->decode(datagram.payload, m_decoded);
  if (datagram.truncated) m_decoded.errors.add(TextError::Truncated);

  SenderRecord* sender = findSender(datagram.sender.address);
  if (sender != nullptr) {
    ++sender->status.datagrams;
    sender->status.bytes += datagram.payload.size();
  }
  const auto tally = [&](Robot* robot) {
    m_errors.add(m_decoded.errors, datagram.payload);
    if (sender != nullptr) sender->status.errors.add(m_decoded.errors, datagram.payload);
    if (robot != nullptr) robot->errors.add(m_decoded.errors, datagram.payload);
  };
  if (!m_decoded.accepted()) {
    // A bad message is counted for a robot that is known, but does not make one.
    const auto known = std::find_if(m_robots.begin(), m_robots.end(), [&](const Robot& robot) {
      return robot.number == m_decoded.robot && robot.sender == datagram.sender;
    });
    Robot* robot = known == m_robots.end() ? nullptr : &*known;
    if (robot != nullptr) robot->bytes += datagram.payload.size();
    tally(robot);
    return Verdict::Refused;
  }
  Robot* robot = findRobot(m_decoded.robot, datagram.sender, datagram.time);
  if (robot == nullptr) {
    ++m_refusedRobots;
    tally(nullptr);
    return Verdict::TooManyRobots;
  }
  robot->bytes += datagram.payload.size();

  const std::size_t hash = std::hash<std::string_view>{}(datagram.payload);
  bool duplicate = robot->messages > 0 && hash == robot->lastHash &&
                   since(datagram.time, robot->lastHashTime) < m_options.duplicateWindow;
  if (const auto number = m_decoder->value(m_decoded, FieldMeaning::Sequence)) {
    duplicate =
        robot->sequence.add(static_cast<std::int64_t>(*number)) == SequenceStats::Step::Duplicate;
  }
  if (duplicate) m_decoded.errors.add(TextError::Duplicate);
  tally(robot);
  if (duplicate) return Verdict::Duplicate;
  robot->lastHash = hash;
  robot->lastHashTime = datagram.time;
  use(*robot, datagram);
  return Verdict::Used;
}

void TeamMonitor::use(Robot& robot, const DatagramView& datagram) {
  if (robot.messages > 0 && since(datagram.time, robot.last) >= m_options.timeout) {
    ++robot.recoveries;
    robot.arrivals = {};
  }
  m_usedSerial = robot.serial;
  ++robot.messages;
  robot.last = datagram.time;
  robot.arrivals.add(datagram.time);
  for (std::size_t i = 0; i < processCount; ++i) {
    const auto flag = m_decoder->value(m_decoded, processFlags[i]);
    if (!flag) continue;
    Robot::Process& process = robot.processes[i];
    const bool before = process.filter.working();
    process.filter.update(*flag != 0.0);
    if (!process.known || process.filter.working() != before) process.since = datagram.time;
    process.known = true;
  }
  if (const auto tenths = m_decoder->value(m_decoded, FieldMeaning::Voltage)) {
    robot.volts = *tenths / 10.0;
    robot.highestVolts = std::max(robot.highestVolts, *robot.volts);
  }
  robot.decoder = m_decoder;
  robot.values.assign(m_decoded.values.begin(),
                      m_decoded.values.begin() + static_cast<std::ptrdiff_t>(m_decoded.count));
  robot.words.resize(m_decoded.count);
  for (std::size_t i = 0; i < m_decoded.count; ++i) {
    // A field of a sane message has few characters; a hostile one keeps its memory bounded.
    robot.words[i].assign(m_decoded.words[i].substr(0, ErrorTally::sampleBytes));
  }
}

RobotStatus TeamMonitor::statusOf(const Robot& robot, WallTime now) const {
  RobotStatus status;
  status.number = robot.number;
  status.serial = robot.serial;
  status.sender = robot.sender;
  status.age = since(now, robot.last);
  status.timedOut = status.age >= m_options.timeout;
  status.lastMessage = robot.last;
  status.messages = robot.messages;
  status.bytes = robot.bytes;
  status.recoveries = robot.recoveries;
  status.rate = robot.arrivals.rate(now);
  status.jitter = robot.arrivals.jitter();
  if (robot.decoder->profile().indexOf(FieldMeaning::Sequence)) {
    status.loss = robot.sequence.loss();
    status.lost = robot.sequence.lost();
  }
  status.errors = robot.errors;
  status.errorCount = robot.errors.total();
  for (std::size_t i = 0; i < processCount; ++i) {
    const Robot::Process& process = robot.processes[i];
    ProcessStatus& out = status.processes[i];
    out.probability = process.filter.probability();
    if (!process.known) continue;
    out.since = since(now, status.timedOut ? robot.last : process.since);
    if (status.timedOut) continue;
    out.state = process.filter.working() ? ProcessState::Working : ProcessState::Silent;
  }
  if (robot.volts) status.battery = batteryAt(*robot.volts, m_options.battery, robot.highestVolts);
  status.decoder = robot.decoder;
  status.values = robot.values;
  status.words = robot.words;
  return status;
}

TeamStatus TeamMonitor::status(WallTime now) const {
  TeamStatus team;
  team.time = now;
  team.robots.reserve(m_robots.size());
  for (const Robot& robot : m_robots) team.robots.push_back(statusOf(robot, now));
  std::sort(team.robots.begin(), team.robots.end(), [](const RobotStatus& a, const RobotStatus& b) {
    return std::tie(a.number, a.sender) < std::tie(b.number, b.sender);
  });
  for (std::size_t i = 0; i < team.robots.size(); ++i) {
    for (std::size_t j = i + 1; j < team.robots.size(); ++j) {
      RobotStatus& a = team.robots[i];
      RobotStatus& b = team.robots[j];
      if (a.number == b.number) noteConflict(a, b);
    }
  }
  for (const SenderRecord& sender : m_senders) team.senders.push_back(sender.status);
  team.datagrams = m_datagrams;
  team.refusedByFilter = m_refusedByFilter;
  team.refusedRobots = m_refusedRobots;
  team.errors = m_errors;
  return team;
}

std::optional<double> RobotStatus::value(FieldMeaning meaning) const {
  const auto place = decoder ? decoder->profile().indexOf(meaning) : std::nullopt;
  if (!place || *place >= values.size() || std::isnan(values[*place])) return std::nullopt;
  return values[*place];
}

}  // namespace pitchboard::telemetry

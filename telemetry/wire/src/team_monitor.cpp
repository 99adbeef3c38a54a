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

/// A time span that messages of two ports, read in another order, cannot make negative.
Duration since(WallTime now, WallTime then) {
  return std::max(now - then, Duration::zero());
}

/// Of a robot that says how full it is, 0 to 1.
Battery batteryOf(double fraction, double volts, const BatteryLimits& limits) {
  Battery battery;
  battery.volts = volts;
  battery.fraction = std::clamp(fraction, 0.0, 1.0);
  battery.low = battery.fraction < (limits.lowPerCell - limits.emptyPerCell) /
                                       (limits.fullPerCell - limits.emptyPerCell);
  return battery;
}

int counterBits(const Profile& profile) {
  const auto counter = profile.indexOf(FieldMeaning::Sequence);
  return counter ? profile.fields[*counter].bits : 0;
}

}  // namespace

TeamMonitor::TeamMonitor(Profile profile, MonitorOptions options)
    : m_options(std::move(options)), m_profile(std::move(profile)) {
  makeRouter();
  m_robots.reserve(m_options.mostRobots());
}
TeamMonitor::~TeamMonitor() = default;
TeamMonitor::TeamMonitor(TeamMonitor&&) noexcept = default;
TeamMonitor& TeamMonitor::operator=(TeamMonitor&&) noexcept = default;

void TeamMonitor::makeRouter() {
  m_router = std::make_unique<const TeamRouter>(m_profile, m_options.teams, m_options.field);
  m_decoder = std::make_shared<const TextDecoder>(m_profile, m_options.field);
}

void TeamMonitor::setProfile(Profile profile) {
  const int bits = counterBits(profile);
  if (bits != counterBits(m_profile)) {
    for (Robot& robot : m_robots) robot.sequence = SequenceStats(bits);
  }
  m_profile = std::move(profile);
  makeRouter();
}

void TeamMonitor::setOptions(MonitorOptions options) {
  const std::size_t before = m_options.teams.size();
  m_options = std::move(options);
  const std::size_t now = m_options.teams.size();
  if (now != before) {
    // A number says less, or other things, with another count of teams.
    const bool same = (now > 1) == (before > 1);
    std::erase_if(m_robots, [&](const Robot& robot) {
      return same ? teamPlace(robot.number, before) >= std::max(now, std::size_t{1})
                  : robot.number >= teamStep;
    });
    m_robots.reserve(m_options.mostRobots());
  }
  makeRouter();
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

/// Its next message should have come.
bool TeamMonitor::isOverdue(const Robot& robot, WallTime time) const {
  const Duration interval = std::clamp<Duration>(
      robot.arrivals.interval().value_or(std::chrono::seconds(1)), std::chrono::milliseconds(20),
      std::max<Duration>(m_options.timeout, std::chrono::milliseconds(20)));
  return since(time, robot.last) >= interval * 3 / 4;
}

TeamMonitor::Robot* TeamMonitor::newRobot(int number, WallTime time) {
  int slot = 0;
  const auto taken = [&](const Robot& robot) {
    return robot.number == number && robot.slot == slot;
  };
  while (std::any_of(m_robots.begin(), m_robots.end(), taken)) ++slot;
  const std::size_t teams = m_options.teams.size();
  Robot* place = nullptr;
  if (!hasOwnPlace(number, slot, teams)) {
    std::size_t others = 0;
    for (Robot& robot : m_robots) {
      if (hasOwnPlace(robot.number, robot.slot, teams)) continue;
      ++others;
      if (place == nullptr || robot.last < place->last) place = &robot;
    }
    if (others < MonitorOptions::otherRobots) {
      place = nullptr;
    } else if (since(time, place->last) < m_options.timeout) {
      return nullptr;
    }
  }
  if (place == nullptr) place = &m_robots.emplace_back();
  *place = Robot();
  place->number = number;
  place->slot = slot;
  place->sequence = SequenceStats(counterBits(m_decoder->profile()));
  return place;
}

/// It was thought to have moved, but where it was it speaks again: there are two programs.
void TeamMonitor::giveBack(Robot& robot, const Sender& sender, WallTime time) {
  const Robot moved = robot;
  robot.sender = sender;
  robot.sequence = robot.previousSequence;
  robot.moved = false;
  robot.previous.reset();
  Robot* other =
      newRobot(robot.number, time);  // within what is reserved: `robot` stays where it is
  if (other == nullptr) return;
  other->sender = moved.sender;
  other->last = moved.last;
  other->messages = 1;
  other->arrivals.add(moved.last);
  other->processes = moved.processes;
  other->volts = moved.volts;
  other->charge = moved.charge;
  other->highestVolts = moved.highestVolts;
  other->decoder = moved.decoder;
  other->values = moved.values;
  other->words = moved.words;
  other->extras = moved.extras;
}

TeamMonitor::Robot* TeamMonitor::findRobot(int number, const Sender& sender, WallTime time) {
  Robot *restarted = nullptr, *moved = nullptr;
  for (Robot& robot : m_robots) {
    if (robot.number != number) continue;
    if (robot.sender == sender) {
      robot.moved = false;
      return &robot;
    }
    if (robot.previous == sender && since(time, robot.last) < m_options.timeout) {
      giveBack(robot, sender, time);
      return &robot;
    }
    // A program that was started again, or opens a socket for each message, is the same robot.
    if (robot.sender.address == sender.address) {
      restarted = &robot;
    } else if (isOverdue(robot, time) && (moved == nullptr || robot.slot < moved->slot)) {
      moved = &robot;
    }
  }
  Robot* same = restarted != nullptr ? restarted : moved;
  if (same != nullptr) {
    same->previous = same->sender;
    same->previousSequence = same->sequence;
    same->sender = sender;
    same->moved = true;
    return same;
  }
  Robot* made = newRobot(number, time);
  if (made != nullptr) made->sender = sender;
  return made;
}

void TeamMonitor::forget(int number, int slot) {
  std::erase_if(m_robots,
                [&](const Robot& robot) { return robot.number == number && robot.slot == slot; });
  if (slot != 0) return;
  Robot* next = nullptr;
  for (Robot& robot : m_robots) {
    if (robot.number == number && (next == nullptr || robot.slot < next->slot)) next = &robot;
  }
  if (next != nullptr) next->slot = 0;
}

TeamMonitor::Verdict TeamMonitor::take(const DatagramView& datagram) {
  ++m_datagrams;
  const bool isAllowed = m_options.senders.allows(datagram.sender.address);
  const auto decoder = isAllowed ? m_router->decode(datagram, m_decoded) : nullptr;
  if (!decoder) {
    ++m_refusedByFilter;
    m_decoded.count = 0;
    m_decoded.errors = {};
    m_decoded.robot = 0;
    return Verdict::SenderRefused;
  }
  m_decoder = decoder;
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
  bool late = false;
  if (const auto number = m_decoder->value(m_decoded, FieldMeaning::Sequence)) {
    const auto step = robot->sequence.add(static_cast<std::int64_t>(*number), robot->moved);
    duplicate = step == SequenceStats::Step::Duplicate;
    late = step == SequenceStats::Step::Late;
  }
  if (duplicate) {
    m_decoded.errors.add(TextError::Duplicate);
    ++robot->duplicates;
  }
  tally(robot);
  if (duplicate) return Verdict::Duplicate;
  robot->lastHash = hash;
  robot->lastHashTime = datagram.time;
  arrive(*robot, datagram.time);
  if (late) return Verdict::Late;
  use(*robot, datagram);
  return Verdict::Used;
}

std::optional<int> TeamMonitor::placeOf(const DatagramView& datagram,
                                        std::optional<int> team) const {
  if (!m_options.senders.allows(datagram.sender.address)) return std::nullopt;
  return m_router->placeOf(datagram, team);
}

void TeamMonitor::arrive(Robot& robot, WallTime time) {
  if (robot.messages > 0 && since(time, robot.last) >= m_options.timeout) {
    ++robot.recoveries;
    robot.arrivals = {};
  }
  ++robot.messages;
  // Of two ports the later message may be read first.
  robot.last = robot.messages == 1 ? time : std::max(robot.last, time);
  robot.arrivals.add(robot.last);
}

void TeamMonitor::use(Robot& robot, const DatagramView& datagram) {
  m_usedSlot = robot.slot;
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
  if (const auto percent = m_decoder->value(m_decoded, FieldMeaning::Charge)) {
    robot.charge = *percent / 100.0;
  }
  robot.decoder = m_decoder;
  robot.values.assign(m_decoded.values.begin(),
                      m_decoded.values.begin() + static_cast<std::ptrdiff_t>(m_decoded.count));
  robot.words.resize(m_decoded.count);
  for (std::size_t i = 0; i < m_decoded.count; ++i) {
    // A field of a sane message has few characters; a hostile one keeps its memory bounded.
    robot.words[i].assign(m_decoded.words[i].substr(0, ErrorTally::sampleBytes));
  }
  const auto keys = m_decoded.extraKeys.begin();
  robot.extras.assign(keys, keys + static_cast<std::ptrdiff_t>(m_decoded.namedExtras));
}

RobotStatus TeamMonitor::statusOf(const Robot& robot, WallTime now) const {
  RobotStatus status;
  status.number = robot.number;
  status.slot = robot.slot;
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
    status.late = robot.sequence.late();
  }
  status.duplicates = robot.duplicates;
  status.errors = robot.errors;
  status.errorCount = robot.errors.messages();
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
  if (robot.charge) {
    status.battery = batteryOf(*robot.charge, robot.volts.value_or(0.0), m_options.battery);
  }
  status.decoder = robot.decoder;
  status.values = robot.values;
  status.words = robot.words;
  status.extras = robot.extras;
  return status;
}

TeamStatus TeamMonitor::status(WallTime now) const {
  TeamStatus team;
  team.time = now;
  team.robots.reserve(m_robots.size());
  for (const Robot& robot : m_robots) team.robots.push_back(statusOf(robot, now));
  std::sort(team.robots.begin(), team.robots.end(), [](const RobotStatus& a, const RobotStatus& b) {
    return std::tie(a.number, a.slot) < std::tie(b.number, b.slot);
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
  const auto index = decoder ? decoder->profile().indexOf(meaning) : std::nullopt;
  if (!index || *index >= values.size() || std::isnan(values[*index])) return std::nullopt;
  return values[*index];
}

std::string RobotStatus::name(std::size_t index) const {
  const auto& fields = decoder->profile().fields;
  if (index < fields.size()) return fields[index].name;
  const std::size_t extra = index - fields.size();
  return extra < extras.size() ? extras[extra] : TextDecoder::otherName(extra);
}

}  // namespace pitchboard::telemetry

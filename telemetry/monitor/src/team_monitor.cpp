// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/monitor/team_monitor.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "team_monitor_snapshot.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t maxSenders = 64, maxOthers = 8;

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

/// Adds a renaming to those of the same call, which happen at the same time.
void noteRenaming(std::vector<Renaming>& renamings, const RobotKey& from, const RobotKey& to) {
  const auto earlier = std::ranges::find(renamings, from, &Renaming::to);
  if (earlier != renamings.end())
    earlier->to = to;
  else
    renamings.push_back({from, to});
}

int counterBits(const Profile& profile) {
  const auto counter = profile.indexOf(FieldMeaning::Sequence);
  return counter ? profile.fields[*counter].bits : 0;
}

}  // namespace

TeamMonitor::TeamMonitor(Profile profile, MonitorOptions options)
    : m_options(std::move(options)), m_profile(std::move(profile)) {
  makeRouter();
  m_robots.reserve(maxPlaces(m_options));
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
  const std::vector<TeamSetup> before = std::exchange(m_options, std::move(options)).teams;
  const std::vector<TeamSetup>& now = m_options.teams;
  m_renamings.clear();
  if (now == before) return makeRouter();
  // A setup that moved takes its robots along; one that was edited keeps them.
  const auto placeOf = [&](int was) {
    if (was == simulatedTeam) return was;
    const TeamSetup* setup = setupAt(was, before);
    if (setup == nullptr) return 0;
    const auto moved = std::ranges::find(now, *setup);
    if (moved != now.end()) return static_cast<int>(moved - now.begin()) + 1;
    const TeamSetup* edited = setupAt(was, now);
    const bool isFree = edited != nullptr && std::ranges::find(before, *edited) == before.end();
    return isFree ? was : 0;
  };
  // All at the same time: a key that one robot leaves may be another one's next.
  std::vector<RobotKey> keys;
  for (const Robot& robot : m_robots) {
    RobotKey key{placeOf(robot.key.team), robot.key.number, robot.key.sender};
    while (std::ranges::find(keys, key) != keys.end()) ++key.sender;
    keys.push_back(key);
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const RobotKey old = std::exchange(m_robots[i].key, keys[i]);
    if (old != keys[i]) m_renamings.push_back({old, keys[i]});
  }
  m_robots.reserve(m_robots.size() + maxPlaces(m_options));
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

RobotKey TeamMonitor::freeKey(int team, int number) const {
  RobotKey key{team, number, 0};
  while (std::ranges::find(m_robots, key, &Robot::key) != m_robots.end()) ++key.sender;
  return key;
}

TeamMonitor::Robot* TeamMonitor::newRobot(int team, int number, WallTime time) {
  const RobotKey key = freeKey(team, number);
  Robot* place = nullptr;
  if (!hasOwnPlace(key)) {
    std::size_t others = 0;
    for (Robot& robot : m_robots) {
      if (hasOwnPlace(robot.key)) continue;
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
  place->key = key;
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
  // Within what is reserved: `robot` stays where it is.
  Robot* other = newRobot(robot.key.team, robot.key.number, time);
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
  other->texts = moved.texts;
  other->extras = moved.extras;
}

/// What was decoded last says what this robot said, its counter apart.
bool TeamMonitor::sendsTheSame(const Robot& robot) const {
  if (!robot.decoder || robot.texts.size() != m_decoded.count) return false;
  if (!(robot.decoder->profile() == m_decoder->profile())) return false;
  const auto counter = m_decoder->profile().indexOf(FieldMeaning::Sequence);
  for (std::size_t i = 0; i < m_decoded.count; ++i) {
    if (i == counter) continue;
    if (robot.texts[i] != m_decoded.texts[i].substr(0, ErrorTally::sampleBytes)) return false;
  }
  return true;
}

TeamMonitor::Robot* TeamMonitor::findRobot(int team, int number, const Sender& sender,
                                           WallTime time) {
  Robot *restarted = nullptr, *moved = nullptr, *first = nullptr;
  for (Robot& robot : m_robots) {
    if (robot.key.team != team || robot.key.number != number) continue;
    if (robot.key.sender == 0) first = &robot;
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
    } else if (isOverdue(robot, time) &&
               (moved == nullptr || robot.key.sender < moved->key.sender)) {
      moved = &robot;
    }
  }
  Robot* same = restarted != nullptr ? restarted : moved;
  // It was received before its team was known.
  if (team != 0 && restarted == nullptr) {
    const auto teamless = std::ranges::find_if(m_robots, [&](const Robot& robot) {
      return robot.key.team == 0 && robot.key.number == number &&
             robot.sender.address == sender.address;
    });
    if (teamless != m_robots.end()) {
      const RobotKey key = freeKey(team, number);
      noteRenaming(m_renamings, teamless->key, key);
      teamless->key = key;
      same = &*teamless;
      if (same->sender == sender) return same;
    }
  }
  if (same != nullptr) {
    same->previous = same->sender;
    same->previousSequence = same->sequence;
    same->sender = sender;
    same->moved = true;
    return same;
  }
  if (first != nullptr && sendsTheSame(*first)) {
    std::erase_if(first->others, [&](const Robot::Other& other) {
      return other.sender == sender || since(time, other.last) >= m_options.timeout;
    });
    if (first->others.size() < maxOthers) first->others.push_back({sender, time});
    return first;
  }
  if (first != nullptr) {
    std::erase_if(first->others, [&](const Robot::Other& other) { return other.sender == sender; });
  }
  Robot* made = newRobot(team, number, time);
  if (made != nullptr) made->sender = sender;
  return made;
}

/// It is not shown any more: a second program, or a robot without a team, that went offline.
bool TeamMonitor::isGone(const Robot& robot, WallTime time) const {
  const bool hasNoTeam = robot.key.team == 0 && !m_options.teams.empty();
  return (robot.key.sender > 0 || hasNoTeam) && since(time, robot.last) >= m_options.timeout;
}

/// A second program is the robot of its number once the first one stops sending; a little before
/// that one times out, so that a robot that is received is always shown.
void TeamMonitor::foldAway(WallTime time) {
  std::erase_if(m_robots, [&](const Robot& robot) { return isGone(robot, time); });
  for (std::size_t i = 0; i < m_robots.size(); ++i) {
    const RobotKey second = m_robots[i].key;
    if (second.sender == 0) continue;
    const RobotKey key{second.team, second.number, 0};
    const auto first = std::ranges::find(m_robots, key, &Robot::key);
    if (first != m_robots.end() && since(time, first->last) < m_options.timeout * 3 / 4) continue;
    m_robots[i].key = key;
    noteRenaming(m_renamings, second, key);
    if (first != m_robots.end()) m_robots.erase(first);
    i = static_cast<std::size_t>(-1);  // places have changed
  }
}

void TeamMonitor::forget(const RobotKey& key) {
  m_renamings.clear();
  std::erase_if(m_robots, [&](const Robot& robot) { return robot.key == key; });
  if (key.sender != 0) return;
  Robot* next = nullptr;
  for (Robot& robot : m_robots) {
    if (robot.key.team != key.team || robot.key.number != key.number) continue;
    if (next == nullptr || robot.key.sender < next->key.sender) next = &robot;
  }
  if (next == nullptr) return;
  m_renamings.push_back({next->key, key});
  next->key = key;
}

TeamMonitor::Verdict TeamMonitor::take(const DatagramView& datagram) {
  ++m_datagrams;
  m_renamings.clear();
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
      return robot.key.number == m_decoded.robot && robot.key.team == m_decoded.place &&
             robot.sender == datagram.sender;
    });
    Robot* robot = known == m_robots.end() ? nullptr : &*known;
    if (robot != nullptr) robot->bytes += datagram.payload.size();
    tally(robot);
    return Verdict::Refused;
  }
  foldAway(datagram.time);
  Robot* robot = findRobot(m_decoded.place, m_decoded.robot, datagram.sender, datagram.time);
  if (robot == nullptr) {
    ++m_refusedRobots;
    tally(nullptr);
    return Verdict::TooManyRobots;
  }
  robot->bytes += datagram.payload.size();
  if (robot->sender != datagram.sender) {  // another program that says the same
    m_decoded.errors.add(TextError::Duplicate);
    ++robot->duplicates;
    tally(robot);
    return Verdict::Duplicate;
  }

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

std::optional<int> TeamMonitor::teamOf(Address sender, int number, int ours) const {
  if (!m_options.senders.allows(sender)) return std::nullopt;
  const std::vector<int> places = m_router->placesOf(sender);
  if (places.empty()) return std::nullopt;
  const auto rank = [&](int place) {
    const bool sends =
        !sender.isLoopback() && std::ranges::any_of(m_robots, [&](const auto& robot) {
          return robot.key.team == place && robot.key.number == number &&
                 robot.sender.address == sender;
        });
    return std::pair(!sends, place != ours);
  };
  return *std::ranges::min_element(places, {}, rank);
}

void TeamMonitor::arrive(Robot& robot, WallTime time) {
  if (robot.messages > 0 && since(time, robot.last) >= m_options.timeout) {
    ++robot.recoveries;
    robot.offline += since(time, robot.last);
    robot.arrivals = {};
  }
  ++robot.messages;
  // Of two ports the later message may be read first.
  robot.last = robot.messages == 1 ? time : std::max(robot.last, time);
  robot.arrivals.add(robot.last);
}

void TeamMonitor::use(Robot& robot, const DatagramView& datagram) {
  m_used = robot.key;
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
  robot.texts.resize(m_decoded.count);
  for (std::size_t i = 0; i < m_decoded.count; ++i) {
    // A field of a sane message has few characters; a hostile one keeps its memory bounded.
    robot.texts[i].assign(m_decoded.texts[i].substr(0, ErrorTally::sampleBytes));
  }
  const auto keys = m_decoded.extraKeys.begin();
  robot.extras.assign(keys, keys + static_cast<std::ptrdiff_t>(m_decoded.namedExtras));
}

RobotStatus TeamMonitor::statusOf(const Robot& robot, WallTime now) const {
  RobotStatus status;
  status.key = robot.key;
  status.sender = robot.sender;
  status.age = since(now, robot.last);
  status.timedOut = status.age >= m_options.timeout;
  status.lastMessage = robot.last;
  for (const Robot::Other& other : robot.others) {
    if (since(now, other.last) < m_options.timeout) status.others.push_back(other.sender);
  }
  status.conflict = !status.others.empty() && !status.timedOut;
  status.messages = robot.messages;
  status.bytes = robot.bytes;
  status.recoveries = robot.recoveries;
  status.offline = robot.offline;
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
    ProcessHeartbeat& out = status.processes[i];
    out.probability = process.filter.probability();
    if (!process.known) continue;
    out.since = since(now, status.timedOut ? robot.last : process.since);
    if (status.timedOut) continue;
    out.state = process.filter.working() ? HeartbeatState::Working : HeartbeatState::NotResponding;
  }
  const BatteryLimits& limits = m_options.batteryOf(robot.key.team);
  if (robot.volts) status.battery = batteryAt(*robot.volts, limits, robot.highestVolts);
  if (robot.charge) {
    status.battery = batteryOf(*robot.charge, robot.volts.value_or(0.0), limits);
  }
  status.decoder = robot.decoder;
  status.values = robot.values;
  status.texts = robot.texts;
  status.extras = robot.extras;
  return status;
}

TeamStatus TeamMonitor::status(WallTime now) const {
  TeamStatus team;
  team.time = now;
  team.robots.reserve(m_robots.size());
  for (const Robot& robot : m_robots) {
    if (!isGone(robot, now)) team.robots.push_back(statusOf(robot, now));
  }
  std::ranges::sort(team.robots, {}, &RobotStatus::key);
  for (std::size_t i = 0; i < team.robots.size(); ++i) {
    for (std::size_t j = i + 1; j < team.robots.size(); ++j) {
      RobotStatus& a = team.robots[i];
      RobotStatus& b = team.robots[j];
      if (a.key.team == b.key.team && a.key.number == b.key.number) noteConflict(a, b);
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/sent_boards.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <base/lined_json.h>
#include <robotlink/blackboard/variable_meanings.h>
#include <robotlink/live/board_columns.h>
#include <telemetry/monitor/arrival_stats.h>
#include <telemetry/monitor/sequence_stats.h>
#include <telemetry/pb2/clock_map.h>

#include "board_meanings.h"

namespace pitchboard::link {
namespace {

using telemetry::Duration;
using telemetry::SequenceStats;
using telemetry::WallTime;

constexpr std::size_t maxSentRows = 4096;     // waiting; older ones are lost
constexpr std::int64_t maxDisorder = 10'000;  // ms; a clock further back is another one

bool isNewer(std::uint32_t sequence, std::uint32_t than) {
  return static_cast<std::int32_t>(sequence - than) > 0;
}

std::uint32_t wordOf(double value, bool isInt) {
  if (!isInt) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  constexpr double least = std::numeric_limits<std::int32_t>::min();
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  if (std::isnan(value)) return 0;
  return static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::clamp(std::round(value), least, most)));
}

/// What BoardColumns makes of it, for a column that not every row has.
telemetry::ColumnInfo lateColumn(const std::string& name, const Variable* variable) {
  telemetry::ColumnInfo column;
  if (variable != nullptr) {
    column = BoardColumns(std::span(variable, 1)).columns().front();
    column.type = telemetry::ColumnType::Float64;
    return column;
  }
  column.name = name;
  VariableMeanings::published().describe(column);
  return column;
}

}  // namespace

struct SentBoards::Robot {
  struct Value {
    double value = 0.0;
    std::uint32_t sequence = 0;  // of the datagram that it came with
    bool hasColumn = false;
    std::optional<double> absent{};  // the value that means "not seen"
  };
  using Values = std::map<std::string, Value, std::less<>>;

  int number = 0, place = 0;
  RobotUid uid;
  telemetry::Sender sender;
  SequenceStats sequence{32};
  telemetry::ArrivalStats arrivals;
  telemetry::ClockMap clock;
  WallTime last{};
  std::uint64_t messages = 0, bytes = 0, restarts = 0, refused = 0;
  std::uint32_t newest = 0;          // sequence
  std::uint64_t newestSent = 0;      // ms
  std::optional<double> sampleTime;  // s, of the newest datagram with values
  telemetry::Pb2Status reported;
  Values values;

  // Once a value was received.
  telemetry::GroupInfo group;
  std::optional<BoardColumns> columns;
  std::optional<double> firstRow;  // s; until its row is taken, it decides which columns are words
  std::vector<const Value*> words, extras;  // in the order of the columns
  BoardMeanings meanings;
  BoardRow row;  // the newest
  LampMemory memory;
  LampMemory::Lamps lamps{};
  std::vector<BoardRow> rows;     // not taken yet
  std::optional<double> unbuilt;  // s, of the newest sample, as long as more of it may come

  /// Of its names, which only become more.
  struct Known {
    std::size_t names = 0;
    const NamedCatalog* catalog = nullptr;
    std::vector<std::string> unknown;
  };
  Known known;

  bool isDescribed() const { return columns.has_value(); }
  bool hasBlackboard() const { return reported.blackboard.value_or(true); }

  /// The program that sends, or its computer, was started again: its numbers mean something else.
  void restart(std::uint32_t next) {
    ++restarts;
    SequenceStats::Counts counts = sequence.counts();
    counts.newest.reset();
    sequence = SequenceStats(counts);
    newest = next - 1;
    for (auto& [key, value] : values) value.sequence = next - 1;
  }
};

SentBoards::SentBoards(std::shared_ptr<RobotUids> uids) : m_uids(std::move(uids)) {
  setCatalogs({{"published", VariableCatalog::published()}});
}
SentBoards::~SentBoards() = default;

void SentBoards::setCatalogs(std::vector<NamedCatalog> catalogs) {
  m_catalogs = std::move(catalogs);
  for (const auto& robot : m_robots) robot->known = {};
}

void SentBoards::clear() {
  m_robots.clear();
}

void SentBoards::forget(int number, telemetry::Address address) {
  std::erase_if(m_robots, [&](const auto& robot) {
    return robot->number == number && robot->sender.address == address;
  });
}

SentBoards::Robot* SentBoards::robotOf(int number, const telemetry::Sender& sender, int place,
                                       WallTime time) {
  Robot *moved = nullptr, *oldest = nullptr;
  for (const auto& robot : m_robots) {
    const bool isOffline = time - robot->last >= m_timeout;
    if (robot->number == number) {
      if (robot->sender.address == sender.address) return robot.get();
      // It changed its address now.
      if (isOffline) moved = robot.get();
    }
    if (isOffline && (oldest == nullptr || robot->last < oldest->last)) oldest = robot.get();
  }
  if (moved == nullptr && m_robots.size() < maxRobots) {
    moved = m_robots.emplace_back(std::make_unique<Robot>()).get();
  } else if (moved == nullptr && oldest != nullptr) {
    *oldest = Robot();
    moved = oldest;
  }
  if (moved == nullptr) return nullptr;
  if (moved->uid == RobotUid{}) {
    const auto isReceived = [this](RobotUid uid) {
      return std::ranges::any_of(m_robots, [uid](const auto& robot) { return robot->uid == uid; });
    };
    moved->uid = m_uids->ofVariables(number, sender.address, place, isReceived);
  } else {
    m_uids->move(moved->uid, sender.address);
  }
  moved->number = number;
  moved->sender = sender;
  if (moved->isDescribed()) moved->group.robot->sentFrom = sender.address.text();
  return moved;
}

const NamedCatalog& SentBoards::catalogOf(Robot& robot) const {
  Robot::Known& known = robot.known;
  if (known.catalog != nullptr && known.names == robot.values.size()) return *known.catalog;
  const auto isIn = [](const NamedCatalog& one, const auto& value) {
    return one.catalog.find(value.first) != nullptr;
  };
  known.names = robot.values.size();
  known.catalog = &*std::ranges::max_element(m_catalogs, {}, [&](const NamedCatalog& one) {
    return std::ranges::count_if(robot.values, [&](const auto& value) { return isIn(one, value); });
  });
  known.unknown.clear();
  for (const auto& value : robot.values) {
    if (!isIn(*known.catalog, value)) known.unknown.push_back(value.first);
  }
  return *known.catalog;
}

/// Variables of the catalog that come with the first sample are words in its order, as on the
/// blackboard. What it does not have, and what comes later, stands behind them, because words
/// cannot say that they are unknown.
void SentBoards::describe(Robot& robot) const {
  std::vector<Variable> known;
  robot.words.clear();
  robot.extras.clear();
  for (auto& [name, value] : robot.values) value.hasColumn = false;
  for (const Variable& variable : catalogOf(robot).catalog.variables()) {
    const auto value = robot.values.find(variable.name);
    if (value == robot.values.end()) continue;
    known.push_back(variable);
    robot.words.push_back(&value->second);
    value->second.hasColumn = true;
  }
  robot.columns.emplace(known);
  robot.group.columns = robot.columns->columns();
  robot.group.name = robot.group.id = groupId(robot.uid, RobotRows::Variables);
  telemetry::RobotFacts& facts = robot.group.robot.emplace();
  facts.sentFrom = robot.sender.address.text();
  facts.uid = robot.uid;
  facts.slot = facts.number = robot.number;
  facts.timeout_s = telemetry::secondsOf(m_timeout);
  robot.meanings = BoardMeanings(robot.group.columns);
}

void SentBoards::append(Robot& robot) const {
  if (!robot.unbuilt) return;
  const double time = *std::exchange(robot.unbuilt, std::nullopt);
  const bool grows = robot.words.size() + robot.extras.size() < robot.values.size();
  if (grows) {
    const VariableCatalog& catalog = catalogOf(robot).catalog;
    for (auto& [name, value] : robot.values) {
      if (std::exchange(value.hasColumn, true)) continue;
      const Variable* variable = catalog.find(name);
      robot.group.columns.push_back(lateColumn(name, variable));
      const bool isFloat = variable != nullptr && variable->type == VariableType::Float;
      value.absent = isFloat ? VariableMeanings::published().absent(name) : std::nullopt;
      robot.extras.push_back(&value);
    }
    robot.meanings = BoardMeanings(robot.group.columns);
  }
  for (BoardRow& before : robot.rows) {
    before.values.resize(robot.extras.size(), std::numeric_limits<double>::quiet_NaN());
  }
  BoardRow& row = robot.row;
  row.time = time;
  row.words.resize(robot.words.size());
  row.values.resize(robot.extras.size());
  for (std::size_t i = 0; i < row.words.size(); ++i) {
    const bool isInt = robot.group.columns[i].type == telemetry::ColumnType::Int32;
    row.words[i] = wordOf(robot.words[i]->value, isInt);
  }
  for (std::size_t i = 0; i < row.values.size(); ++i) row.values[i] = robot.extras[i]->value;
  robot.lamps = robot.memory.note(robot.meanings.reader(row), time);
  if (robot.rows.empty() || robot.rows.back().time != time) {
    if (robot.rows.size() == maxSentRows) {
      robot.rows.erase(robot.rows.begin(), robot.rows.begin() + maxSentRows / 4);
    }
    robot.rows.emplace_back();
  }
  robot.rows.back() = row;
  robot.columns->makeHoles(robot.rows.back().words);
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    const auto& absent = robot.extras[i]->absent;
    if (absent && row.values[i] == *absent) {
      robot.rows.back().values[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

SentBoards::Verdict SentBoards::take(const telemetry::Pb2Message& message,
                                     const telemetry::DatagramView& datagram, int place,
                                     double arrival) {
  Robot* const found = robotOf(message.robot, datagram.sender, place, datagram.time);
  if (found == nullptr) return Verdict::TooManyRobots;
  Robot& robot = *found;
  const bool isFirst = robot.messages == 0;
  robot.place = place;
  robot.bytes += datagram.payload.size();
  const auto later = static_cast<std::int64_t>(message.milliseconds - robot.newestSent);
  const bool isBehind = !isFirst && isNewer(robot.newest, message.sequence);
  // A number from before with a later time: a program that counts from 0 again.
  if ((isBehind && later > 0) || (!isFirst && later < -maxDisorder)) {
    robot.restart(message.sequence);
  }
  const bool hasMoved = robot.sender.port != datagram.sender.port;
  robot.sender = datagram.sender;
  const auto step = robot.sequence.add(message.sequence, hasMoved);
  if (step == SequenceStats::Step::Duplicate) return Verdict::Duplicate;
  if (step == SequenceStats::Step::Restart) robot.restart(message.sequence);
  ++robot.messages;
  robot.last = std::max(robot.last, datagram.time);
  robot.arrivals.add(robot.last);

  if (message.milliseconds != robot.newestSent) append(robot);
  auto next = robot.values.begin();  // names often come in order
  for (const telemetry::Pb2Value& sent : message.values) {
    auto known = next != robot.values.end() && next->first == sent.name
                     ? next
                     : robot.values.find(sent.name);
    next = known;
    if (known != robot.values.end()) ++next;
    if (known == robot.values.end()) {
      if (robot.values.size() == maxVariables) {
        ++robot.refused;
        continue;
      }
      known = robot.values.emplace(sent.name, Robot::Value{}).first;
    } else if (isNewer(known->second.sequence, message.sequence)) {
      continue;
    }
    known->second.value = sent.value;
    known->second.sequence = message.sequence;
  }
  if (step == SequenceStats::Step::Late) return Verdict::Late;

  robot.newest = message.sequence;
  robot.newestSent = message.milliseconds;
  const double time = robot.clock.map(message.milliseconds, arrival);
  const telemetry::Pb2Status& status = message.status;
  if (status.refresh_ms) robot.reported.refresh_ms = status.refresh_ms;
  if (status.waiting) robot.reported.waiting = status.waiting;
  if (status.blackboard) robot.reported.blackboard = status.blackboard;
  if (message.values.empty()) return Verdict::Used;
  // A sample that is too large for one datagram comes in several, with one time.
  if (!robot.isDescribed()) robot.firstRow = time;
  if (robot.firstRow == time)
    describe(robot);
  else
    robot.firstRow.reset();
  robot.unbuilt = time;
  return Verdict::Used;
}

void SentBoards::drainRows(const BoardRowsTaker& take) {
  for (const auto& robot : m_robots) {
    append(*robot);
    if (robot->rows.empty()) continue;
    take(robot->group, robot->rows);
    robot->rows.clear();
    robot->firstRow.reset();
  }
}

void SentBoards::place(const Placing& placeOf) {
  for (const auto& robot : m_robots) {
    if (const auto place = placeOf(robot->number, robot->sender.address)) robot->place = *place;
  }
}

telemetry::LinkHealth SentBoards::linkOf(const Robot& robot, WallTime now) const {
  telemetry::LinkHealth link;
  link.sender = robot.sender;
  link.age = std::max(now - robot.last, Duration::zero());
  link.timedOut = link.age >= m_timeout || !robot.hasBlackboard();
  link.messages = robot.messages;
  link.bytes = robot.bytes;
  link.rate = robot.arrivals.rate(now);
  link.jitter = robot.clock.jitter();
  link.loss = robot.sequence.loss();
  link.lost = robot.sequence.lost();
  link.late = robot.sequence.late();
  link.duplicates = robot.sequence.duplicates();
  return link;
}

std::vector<RobotFrame> SentBoards::robots(WallTime now, const sim::FieldSpec& field,
                                           const telemetry::MonitorOptions& teams) const {
  std::vector<RobotFrame> all;
  for (const auto& robot : m_robots) {
    if (!robot->isDescribed()) continue;
    append(*robot);
    RobotFrame& out = all.emplace_back();
    out.uid = robot->uid;
    out.key = {robot->place, robot->number, 0};
    out.name = robot->group.name;
    out.identity.id = {};
    out.identity.number = robot->number;
    out.link = linkOf(*robot, now);
    if (!out.timedOut()) out.lamps = robot->lamps;
    buildRobot(robot->meanings.reader(robot->row), field, teams.batteryOf(robot->place), false,
               out);
    out.action = out.decided.value_or(0);
    out.board = robot->meanings.contents(robot->row);
  }
  return all;
}

std::vector<SentStatus> SentBoards::status(WallTime now) const {
  std::vector<SentStatus> all;
  for (const auto& robot : m_robots) {
    const NamedCatalog& catalog = catalogOf(*robot);
    SentStatus& out = all.emplace_back();
    out.uid = robot->uid;
    out.robot = {robot->place, robot->number, 0};
    out.link = linkOf(*robot, now);
    out.variables = robot->values.size();
    out.catalog = catalog.name;
    out.unknown = robot->known.unknown;
    out.clockOffset = robot->clock.offset();
    out.restarts = robot->restarts;
    out.refresh_ms = robot->reported.refresh_ms;
    out.waiting = robot->reported.waiting;
    out.blackboard = robot->hasBlackboard();
    out.refused = robot->refused;
  }
  return all;
}

}  // namespace pitchboard::link

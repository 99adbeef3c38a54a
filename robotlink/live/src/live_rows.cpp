// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_rows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include <simcore/world/action_codes.h>

namespace pitchboard::link {

using namespace telemetry;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double never = -std::numeric_limits<double>::infinity();
constexpr std::size_t noColumn = std::numeric_limits<std::size_t>::max();
constexpr double healthPeriod = 1.0;  // s
constexpr double reportSlack = 0.2;   // s; reports do not come on the dot

struct HealthColumn {
  const char *name, *unit;
  double resolution;
};
constexpr std::array<HealthColumn, 10> healthColumns{{{"AGE", "s", 1.0 / 1024},
                                                      {"RATE", "1/s", 1.0 / 1024},
                                                      {"JITTER", "ms", 1.0 / 64},
                                                      {"LOSS", "", 1.0 / 65536},
                                                      {"LOST", "", 0.0},
                                                      {"DUPLICATES", "", 0.0},
                                                      {"LATE", "", 0.0},
                                                      {"ERRORS", "", 0.0},
                                                      {"VOLTS", "V", 1.0 / 1024},
                                                      {"CHARGE", "%", 1.0 / 256}}};

std::array<double, healthColumns.size()> healthValues(const RobotStatus& robot) {
  const bool counts = robot.loss.has_value();
  return {secondsOf(robot.age),
          robot.rate,
          robot.jitter * 1000.0,
          robot.loss.value_or(nothing),
          counts ? static_cast<double>(robot.lost) : nothing,
          static_cast<double>(robot.duplicates),
          counts ? static_cast<double>(robot.late) : nothing,
          static_cast<double>(robot.errorCount),
          robot.battery && robot.battery->volts > 0.0 ? robot.battery->volts : nothing,
          robot.battery && robot.battery->volts == 0.0 ? robot.battery->fraction * 100.0 : nothing};
}

const std::vector<ColumnInfo>& linkColumns() {
  static const std::vector<ColumnInfo> columns = [] {
    std::vector<ColumnInfo> made;
    for (const HealthColumn& column : healthColumns) {
      made.push_back({column.name,
                      ColumnType::Float64,
                      column.unit,
                      linkCategory,
                      ColumnKind::Number,
                      {},
                      column.resolution});
    }
    return made;
  }();
  return columns;
}

ColumnInfo columnOf(const ProfileField& field) {
  ColumnInfo column{field.name,     ColumnType::Float64, field.unit,
                    field.category, ColumnKind::Number,  {}};
  if (field.type == FieldType::Flag) column.kind = ColumnKind::Flag;
  if (field.type == FieldType::Text) {
    column.kind = ColumnKind::Text;
    column.labels = field.labels;
  }
  if (field.meaning == FieldMeaning::Action) {
    column.kind = ColumnKind::Enumeration;
    column.labels = actionLabels();
  }
  return column;
}

/// Returns the code of a text: a new one for each new text, until there are too many of them.
double codeOf(ColumnInfo& column, std::string_view sentText, bool& changed) {
  const auto known = std::ranges::find_if(
      column.labels, [&](const auto& label) { return label.second == sentText; });
  if (known != column.labels.end()) return known->first;
  if (column.labels.size() > LiveRows::maxTexts) return column.labels.rbegin()->first;
  changed = true;
  const int code = column.labels.empty() ? 0 : column.labels.rbegin()->first + 1;
  const bool last = column.labels.size() == LiveRows::maxTexts;
  column.labels.emplace(code, last ? std::string("other") : std::string(sentText));
  return code;
}

}  // namespace

struct LiveRows::Robot {
  /// Where a field of the message goes.
  struct Place {
    std::size_t column = noColumn;
    std::optional<double> absent;
  };
  RobotUid uid;
  RobotKey key;
  bool isGone = false;  // no robot sends under its key, or another one does
  Sender sender;
  std::string name;
  bool hasBoard = false;        // whose rows have the name
  telemetry::RobotFacts facts;  // by the options
  GroupId group = 0, link = 0;
  Profile profile;  // by which `places` were made
  std::vector<Place> places;
  std::vector<ColumnInfo> columns;
  std::vector<double> values;
  double lastTime = never, lastHealth = never;
  bool timedOut = false;
};

LiveRows::LiveRows(std::shared_ptr<RowSink> sink, LiveRowsOptions options,
                   std::shared_ptr<RobotUids> uids)
    : m_sink(std::move(sink)), m_options(std::move(options)), m_uids(std::move(uids)) {}

LiveRows::~LiveRows() = default;

void LiveRows::setOptions(LiveRowsOptions options) {
  options.zero = m_options.zero;
  m_options = std::move(options);
  for (Robot& robot : m_robots) {
    const auto key = m_uids->keyOf(robot.uid);
    robot.isGone = !key;
    if (key) robot.key = *key;
  }
  nameRobots();
  std::vector<GroupInfo> groups;
  for (const Robot& robot : m_robots) {
    groups.push_back(linkOf(robot));
    if (!robot.columns.empty()) groups.push_back(groupOf(robot));
  }
  m_sink->describeGroups(groups);
}

/// Robots that are received have the names and facts that follow from the options. The others
/// keep theirs, because their keys may mean other robots, but give way.
void LiveRows::nameRobots() {
  std::set<std::string> taken;
  for (const auto& [robot, name] : m_options.boards) taken.insert(name);
  for (Robot& robot : m_robots) {
    if (robot.isGone) continue;
    const auto board = m_options.boards.find(robot.uid);
    robot.hasBoard = board != m_options.boards.end();
    robot.name = robot.hasBoard ? board->second : robotName(robot.key, m_options.teams);
    robot.facts = {};
    if (m_options.describe) m_options.describe(robot.key, robot.facts);
    robot.facts.order = orderOf(robot.key, m_options.teams);
    robot.facts.team = colourAt(robot.key.team, m_options.teams);
    taken.insert(robot.name);
  }
  for (Robot& robot : m_robots) {
    if (robot.isGone) robot.name = earlierName(robot.name, taken);
  }
}

LiveRows::Robot* LiveRows::robotOf(const RobotKey& key, const Sender& sender) {
  const RobotUid uid = m_uids->ofMessages(key, sender.address);
  const auto found = std::ranges::find(m_robots, uid, &Robot::uid);
  if (found != m_robots.end()) {
    const bool moved = found->sender.address != sender.address;
    found->sender = sender;
    if (found->isGone || found->key != key) {
      found->key = key;
      setOptions(m_options);
    } else if (moved) {
      addGroups(*found);
    }
    return &*found;
  }
  const auto others = static_cast<std::size_t>(
      std::ranges::count_if(m_robots, [](const Robot& robot) { return !hasOwnPlace(robot.key); }));
  if (!hasOwnPlace(key) && others >= MonitorOptions::otherRobots) return nullptr;
  Robot& robot = m_robots.emplace_back();
  robot.uid = uid;
  robot.key = key;
  robot.sender = sender;
  setOptions(m_options);
  robot.link = m_sink->addGroup(linkOf(robot));
  return &robot;
}

/// Returns the index of the column with this name, which is added if the limit allows it.
std::size_t LiveRows::placeOf(Robot& robot, ColumnInfo column, bool& changed) {
  const auto known = std::ranges::find(robot.columns, column.name, &ColumnInfo::name);
  if (known != robot.columns.end()) return static_cast<std::size_t>(known - robot.columns.begin());
  if (robot.columns.size() == maxColumns) return noColumn;
  changed = true;
  robot.columns.push_back(std::move(column));
  return robot.columns.size() - 1;
}

bool LiveRows::describe(Robot& robot, const Profile& profile) {
  if (robot.profile == profile) return false;
  robot.profile = profile;
  robot.places.clear();
  bool changed = true;
  for (const ProfileField& field : profile.fields) {
    ColumnInfo column = columnOf(field);
    Robot::Place& place = robot.places.emplace_back();
    place.column = placeOf(robot, column, changed);
    place.absent = field.absent;
    if (place.column == noColumn) continue;
    ColumnInfo& known = robot.columns[place.column];
    // Words that came already keep their codes.
    if (known.kind == ColumnKind::Text) column.labels.merge(known.labels);
    known = std::move(column);
  }
  return true;
}

GroupInfo LiveRows::groupOf(const Robot& robot) const {
  GroupInfo group{robot.hasBoard ? robot.name + " telemetry" : robot.name,
                  robot.columns,
                  robot.facts,
                  {},
                  groupId(robot.uid, RobotRows::Messages)};
  group.robot->uid = robot.uid;
  group.robot->number = robot.key.number;
  group.robot->sender = robot.sender.address.text();
  group.robot->live = true;
  if (robot.hasBoard) group.robot->linkOf = robot.name;
  return group;
}

GroupInfo LiveRows::linkOf(const Robot& robot) const {
  GroupInfo group{robot.name + " link",
                  linkColumns(),
                  telemetry::RobotFacts{},
                  {},
                  groupId(robot.uid, RobotRows::Link)};
  group.robot->uid = robot.uid;
  group.robot->linkOf = robot.name;
  group.robot->order = robot.facts.order;
  return group;
}

void LiveRows::addGroups(Robot& robot) {
  robot.group = m_sink->addGroup(groupOf(robot));
}

void LiveRows::take(const DatagramView& datagram, const DecodedText& decoded,
                    const TextDecoder& decoder, const RobotKey& key) {
  Robot* robot = robotOf(key, datagram.sender);
  if (robot == nullptr) {
    ++m_refused.rows;
    return;
  }
  bool changed = describe(*robot, decoder.profile());
  const std::size_t fields = robot->places.size();
  robot->values.assign(maxColumns, nothing);
  m_refused.values += decoded.dropped;
  for (std::size_t i = 0; i < decoded.count; ++i) {
    const std::string_view sentText = decoded.texts[i];
    double value = decoded.values[i];
    std::size_t column = noColumn;
    if (i < fields) {
      column = robot->places[i].column;
      if (robot->places[i].absent == value) value = nothing;
    } else if (i < fields + maxExtras) {
      const bool isText = std::isnan(value) && !sentText.empty();
      ColumnInfo extra{decoder.name(decoded, i),
                       ColumnType::Float64,
                       "",
                       "Other",
                       isText ? ColumnKind::Text : ColumnKind::Number,
                       {}};
      column = placeOf(*robot, std::move(extra), changed);
      // A key that is the name of a field does not overwrite it.
      if (std::ranges::find(robot->places, column, &Robot::Place::column) != robot->places.end()) {
        column = noColumn;
      }
    }
    if (column == noColumn) {
      ++m_refused.values;
      continue;
    }
    ColumnInfo& info = robot->columns[column];
    if (info.kind == ColumnKind::Text && !sentText.empty() && (std::isnan(value) || i >= fields)) {
      value = codeOf(info, sentText, changed);
    }
    robot->values[column] = value;
  }
  robot->values.resize(robot->columns.size());
  if (changed) addGroups(*robot);
  // Of two ports the later message may be read first.
  robot->lastTime = std::max(robot->lastTime, timeOf(datagram.time));
  m_sink->append(robot->group, {robot->lastTime, {}, robot->values});
}

void LiveRows::report(const TeamStatus& status) {
  const double now = timeOf(status.time);
  for (const RobotStatus& received : status.robots) {
    const auto robot = std::ranges::find_if(
        m_robots, [&](const Robot& known) { return !known.isGone && known.key == received.key; });
    if (robot == m_robots.end()) continue;  // nothing of it could be used yet
    const bool wasTimedOut = std::exchange(robot->timedOut, received.timedOut);
    if (received.timedOut && wasTimedOut) continue;
    const bool due = now >= robot->lastHealth + healthPeriod - reportSlack;
    if (!due && received.timedOut == wasTimedOut) continue;
    robot->lastHealth = std::max(robot->lastHealth, now);
    const auto values = healthValues(received);
    m_sink->append(robot->link, {robot->lastHealth, {}, values});
  }
}

}  // namespace pitchboard::link

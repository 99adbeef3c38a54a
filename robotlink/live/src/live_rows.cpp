// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_rows.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <base/actions.h>

namespace pitchboard::telemetry {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

enum Health : std::size_t { Age, Rate, Loss, Errors, Volts, healthColumns };

struct HealthColumn {
  const char *name, *unit;
};
constexpr std::array<HealthColumn, healthColumns> health{
    {{"AGE", "s"}, {"RATE", "1/s"}, {"LOSS", ""}, {"ERRORS", ""}, {"VOLTS", "V"}}};

// A clock that is set back a little must not cost what was recorded since.
constexpr double smallStep = 5.0;

ColumnInfo columnOf(const ProfileField& field) {
  ColumnInfo column{field.name,     ColumnType::Float64, field.unit,
                    field.category, ColumnKind::Number,  {}};
  if (field.type == FieldType::Flag) column.kind = ColumnKind::Flag;
  if (field.meaning == FieldMeaning::Action) {
    column.kind = ColumnKind::Enumeration;
    column.labels = actionLabels();
  }
  return column;
}

}  // namespace

struct LiveRows::Robot {
  int number = 0;
  Sender sender;
  std::string name;
  GroupId group = 0;
  std::uint64_t generation = 0;  // of the profile that the group was made for; 0: none yet
  std::size_t fields = 0;        // columns before those of health
  std::vector<double> values;    // fields, then health
  double lastTime = -std::numeric_limits<double>::infinity();
  bool heard = false;  // since the last report
  bool timedOut = false;
};

LiveRows::LiveRows(std::shared_ptr<RowSink> sink, LiveRowsOptions options)
    : m_sink(std::move(sink)), m_options(std::move(options)) {}

LiveRows::~LiveRows() = default;

void LiveRows::clear() {
  m_robots.clear();
}

LiveRows::Robot& LiveRows::robotOf(int number, const Sender& sender) {
  const auto found = std::ranges::find_if(m_robots, [&](const Robot& robot) {
    return robot.number == number && robot.sender.address == sender.address;
  });
  if (found != m_robots.end()) return *found;
  Robot robot;
  robot.number = number;
  robot.sender = sender;
  robot.name = m_options.name ? m_options.name(number) : "Robot " + std::to_string(number);
  // The number, not the name: a robot whose number is used twice stays itself.
  if (std::ranges::find(m_robots, number, &Robot::number) != m_robots.end()) {
    robot.name += " (" + sender.address.text() + ")";
  }
  m_robots.push_back(std::move(robot));
  return m_robots.back();
}

void LiveRows::describe(Robot& robot, const TextDecoder& decoder, std::size_t values) {
  if (m_generation == 0 || !(m_profile == decoder.profile())) {
    m_profile = decoder.profile();
    ++m_generation;
  }
  const std::size_t fields = std::max(values, m_profile.fields.size());
  // Fields beyond the profile come and go; columns only come, because new columns are a new group.
  if (robot.generation == m_generation && fields <= robot.fields) return;
  robot.generation = m_generation;
  robot.fields = fields;
  robot.values.assign(fields + healthColumns, nothing);
  GroupInfo info{robot.name,
                 {},
                 {{"number", std::to_string(robot.number)},
                  {"sender", robot.sender.address.text()},
                  {"live", "1"}}};
  if (m_options.attributes) info.attributes.merge(m_options.attributes(robot.number));
  for (std::size_t i = 0; i < fields; ++i) {
    if (i < m_profile.fields.size()) {
      info.columns.push_back(columnOf(m_profile.fields[i]));
    } else {
      info.columns.push_back(
          {decoder.name(i), ColumnType::Float64, "", "Other", ColumnKind::Number, {}});
    }
  }
  for (const HealthColumn& column : health) {
    std::string name = column.name;
    while (std::ranges::find(info.columns, name, &ColumnInfo::name) != info.columns.end()) {
      name.insert(0, "LINK_");  // a team's own field keeps its name
    }
    info.columns.push_back(
        {name, ColumnType::Float64, column.unit, linkCategory, ColumnKind::Number, {}});
  }
  robot.group = m_sink->addGroup(info);
}

void LiveRows::take(const DatagramView& datagram, const DecodedText& decoded,
                    const TextDecoder& decoder) {
  Robot& robot = robotOf(decoded.robot, datagram.sender);
  describe(robot, decoder, decoded.count);
  for (std::size_t i = 0; i < robot.fields; ++i) {
    robot.values[i] = i < decoded.count ? decoded.values[i] : nothing;
  }
  robot.values[robot.fields + Age] = 0.0;
  robot.heard = true;
  robot.timedOut = false;
  append(robot, datagram.time);
}

void LiveRows::report(const TeamStatus& status) {
  for (const RobotStatus& now : status.robots) {
    const auto found = std::ranges::find_if(m_robots, [&](const Robot& robot) {
      return robot.number == now.number && robot.sender.address == now.sender.address;
    });
    if (found == m_robots.end()) continue;  // nothing of it could be used yet
    Robot& robot = *found;
    const auto set = [&](Health column, double value) {
      robot.values[robot.fields + column] = value;
    };
    set(Age, secondsOf(now.age));
    set(Rate, now.rate);
    set(Loss, now.loss.value_or(nothing));
    set(Errors, static_cast<double>(now.errors.total()));
    set(Volts, now.battery ? now.battery->volts : nothing);
    const bool silent = !std::exchange(robot.heard, false);
    const bool wasTimedOut = std::exchange(robot.timedOut, now.timedOut);
    if (silent && !wasTimedOut) append(robot, status.time);
  }
}

void LiveRows::append(Robot& robot, WallTime time) {
  double at = secondsOf(time - m_options.zero);
  if (at < robot.lastTime && robot.lastTime - at < smallStep) at = robot.lastTime;
  robot.lastTime = at;
  m_sink->append(robot.group, {at, {}, robot.values});
}

}  // namespace pitchboard::telemetry

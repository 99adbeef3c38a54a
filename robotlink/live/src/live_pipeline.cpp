// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_pipeline.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <utility>

#include <base/lined_json.h>
#include <robotlink/frame/join_boards.h>
#include <robotlink/live/live_teams.h>
#include <telemetry/series/group_order.h>

namespace pitchboard::link {
namespace {

using telemetry::DatagramView;
using telemetry::GroupId;
using telemetry::GroupInfo;
using telemetry::WallTime;

constexpr double reportPeriod = 0.25;  // s
constexpr double snapshotPeriod =
    15.0;  // s; moments of a recording are rebuilt from the last snapshot before them
constexpr double sentReportPeriod = 1.0;  // s
constexpr std::size_t maxQueued = 10'000;

GroupInfo sentHealthGroup() {
  GroupInfo group;
  for (const auto& [name, unit] : {std::pair("AGE", "s"),
                                   {"RATE", "1/s"},
                                   {"JITTER", "ms"},
                                   {"LOSS", ""},
                                   {"LOST", ""},
                                   {"DUPLICATES", ""},
                                   {"LATE", ""},
                                   {"CLOCK_OFFSET", "s"},
                                   {"REFRESH", "ms"},
                                   {"WAITING", ""}}) {
    telemetry::ColumnInfo& column = group.columns.emplace_back();
    column.name = name;
    column.unit = unit;
    column.category = telemetry::linkCategory;
  }
  return group;
}

}  // namespace

void RowFan::remove(const std::shared_ptr<telemetry::RowSink>& sink) {
  std::erase_if(m_sinks, [&sink](const Sink& one) { return one.rows == sink; });
}

std::size_t RowFan::placeOf(std::string_view name) const {
  const auto found = std::ranges::find(m_groups, name, &GroupInfo::name);
  return static_cast<std::size_t>(found - m_groups.begin());
}

GroupId RowFan::addGroup(const GroupInfo& info) {
  const std::size_t place = placeOf(info.name);
  if (place == m_groups.size()) m_groups.emplace_back();
  m_groups[place] = info;
  for (Sink& sink : m_sinks) {
    if (place < sink.groups.size() && sink.groups[place]) {
      sink.groups[place] = sink.rows->addGroup(info);
    }
  }
  return static_cast<GroupId>(place);
}

GroupId RowFan::renameGroup(std::string_view from, const GroupInfo& to) {
  const std::size_t old = placeOf(from);
  const std::size_t known = placeOf(to.name);
  if (old == m_groups.size() || old == known) return addGroup(to);
  const std::size_t place = known == m_groups.size() ? old : known;
  m_groups[old].name.clear();
  m_groups[place] = to;
  for (Sink& sink : m_sinks) {
    if (old >= sink.groups.size() || !std::exchange(sink.groups[old], std::nullopt)) continue;
    sink.groups.resize(m_groups.size());
    sink.groups[place] = sink.rows->renameGroup(from, to);
  }
  return static_cast<GroupId>(place);
}

void RowFan::append(GroupId group, const telemetry::RowView& row) {
  for (Sink& sink : m_sinks) {
    sink.groups.resize(m_groups.size());
    std::optional<GroupId>& known = sink.groups[group];
    if (!known) known = sink.rows->addGroup(m_groups[group]);
    sink.rows->append(*known, row);
  }
}

LivePipeline::LivePipeline(LiveOptions options, WallTime zero)
    : m_options(std::move(options)),
      m_monitorOptions(monitorOptions(m_options)),
      m_zero(zero),
      m_state(m_options),
      m_rows(m_fan, rowsOptions(m_options, m_teams, zero)),
      m_boardRows(m_fan),
      m_sentHealth(m_fan) {
  useCatalogs();
}

/// What a robot sends is recognized by any map that is known.
void LivePipeline::useCatalogs() {
  std::vector<NamedCatalog> known{{"published", VariableCatalog::published()},
                                  {"extended", VariableCatalog::extended()}};
  std::vector<std::string> files = m_options.catalogs;
  for (const AttachedBoard& board : m_options.boards) files.push_back(board.catalogFile);
  for (const std::string& file : files) {
    if (file.empty()) continue;
    // They were valid a moment ago.
    if (auto read = VariableCatalog::fromFile(file)) {
      known.push_back({std::filesystem::path(file).filename().string(), std::move(*read)});
    }
  }
  m_sent.setCatalogs(std::move(known));
  m_sent.setTimeout(m_options.team.timeout);
}

void LivePipeline::setOptions(LiveOptions options, WallTime now) {
  const LiveOptions old = std::exchange(m_options, std::move(options));
  if (!(old.profile == m_options.profile)) m_state.monitor.setProfile(m_options.profile);
  m_monitorOptions = monitorOptions(m_options);
  m_state.setTeams(m_monitorOptions);
  m_state.referee.setOptions(LiveState::refereeOptions(m_options));
  useCatalogs();
  noteTeams(m_state.monitor.renamings());
  sendSnapshot(now);
}

void LivePipeline::clear(WallTime now) {
  m_state.clear(m_options);
  m_sent.clear();
  m_sentRobots.clear();
  m_boardNames.clear();
  m_badVariables = m_refusedVariables = 0;
  m_badReason.clear();
  m_events = {};
  noteTeams({});
  m_rows.clearRefused();
  m_unknownReferee = m_refusedReferees = 0;
  m_unknownReason.clear();
  m_unknownSample.clear();
  sendSnapshot(now);
}

void LivePipeline::forget(const RobotKey& robot, WallTime now) {
  m_state.monitor.forget(robot);
  for (const auto& [sender, key] : m_sentRobots) {
    if (key == robot) m_sent.forget(sender.second, sender.first);
  }
  sendSnapshot(now);
}

void LivePipeline::takeReferee(const DatagramView& datagram) {
  if (!m_options.refereeSenders.allows(datagram.sender.address)) {
    ++m_refusedReferees;
    return;
  }
  const auto packet = telemetry::decodeReferee(datagram.payload);
  if (packet) {
    m_state.takeReferee(*packet, datagram);
    if (m_state.teams(m_options) != m_teams) noteTeams({});
  } else {
    ++m_unknownReferee;
    m_unknownReason = packet.error().message;
    m_unknownSample = telemetry::printable(datagram.payload);
  }
  notify({.time = std::max(0.0, seconds(datagram.time)),
          .view = datagram,
          .teams = m_teams,
          .referee = &packet});
}

void LivePipeline::takeVariables(const DatagramView& datagram) {
  const auto place = m_state.monitor.placeOf(datagram.sender.address);
  if (!place) {
    ++m_refusedVariables;
    return;
  }
  const auto message = telemetry::parsePb2(datagram.payload);
  const double time = std::max(0.0, seconds(datagram.time));
  LiveDatagram taken{.time = time, .view = datagram, .teams = m_teams, .variables = &message};
  if (message) {
    taken.variablesVerdict = m_sent.take(*message, datagram, *place, time);
    if (taken.variablesVerdict == SentBoards::Verdict::TooManyRobots) ++m_refusedVariables;
    const auto known = m_sentRobots.find({datagram.sender.address, message->robot});
    taken.robot = known != m_sentRobots.end() ? known->second : RobotKey{*place, message->robot, 0};
  } else {
    ++m_badVariables;
    m_badReason = message.error().text();
  }
  notify(taken);
}

void LivePipeline::take(const DatagramView& datagram) {
  const int variables = datagram.localPort - m_options.variablesPortBase;
  if (m_options.variablesPortBase > 0 && variables > 0 && variables <= m_options.robots) {
    takeVariables(datagram);
    return;
  }
  if (datagram.localPort == m_options.refereePort ||
      (m_options.monitor && datagram.localPort == telemetry::robotStatesPort)) {
    takeReferee(datagram);
    return;
  }
  const double time = std::max(0.0, seconds(datagram.time));
  const telemetry::TeamMonitor& monitor = m_state.monitor;
  LiveDatagram taken{.time = time, .view = datagram, .teams = m_teams};
  taken.verdict = m_state.takeRobot(datagram, time);
  if (taken.verdict) {
    if (!monitor.renamings().empty()) noteTeams(monitor.renamings());
    taken.decoder = &monitor.decoder();
    taken.decoded = &monitor.decoded();
    taken.robot = {monitor.decoded().place, monitor.decoded().robot, 0};
    if (taken.verdict == LiveDatagram::Verdict::Used) {
      taken.robot = monitor.used();
      if (!m_fan->isEmpty()) {
        m_rows.take(datagram, monitor.decoded(), monitor.decoder(), taken.robot);
      }
    }
  } else if (m_state.lastDrawer) {
    taken.robot = *m_state.lastDrawer;
  } else if (!monitor.placeOf(datagram, {})) {
    return;  // a stranger's drawing
  } else {
    taken.drawingProblem = m_state.drawings.lastProblem();
  }
  notify(taken);
}

MatchFrame LivePipeline::frame(WallTime now, AttachedRobots* boards) {
  const telemetry::TeamStatus team = m_state.monitor.status(now);
  const double time = seconds(now);
  MatchFrame frame = m_state.frame(m_options, team, time);
  frame.serial = ++m_serial;
  std::ranges::move(std::exchange(m_renamings, {}), std::back_inserter(m_news.renamings));
  addBoards(frame, boards, now);
  notify(m_events.compare(frame));
  for (const auto& observer : m_observers) observer->frameMade(frame);
  if (time >= m_nextReport) {
    m_nextReport = time + reportPeriod;
    if (!m_fan->isEmpty()) m_rows.report(team);
  }
  if (time >= m_nextSentReport) reportSent(now);
  if (time >= m_nextSnapshot) sendSnapshot(now);
  return frame;
}

/// Robots whose blackboards are received join the frame, and their rows get their names.
void LivePipeline::addBoards(MatchFrame& frame, AttachedRobots* attached, WallTime now) {
  struct Taken {
    const GroupInfo* group;
    std::vector<BoardRow> rows;
  };
  std::vector<Taken> taken;
  const auto keep = [&taken](const GroupInfo& group, std::span<const BoardRow> rows) {
    taken.push_back({&group, {rows.begin(), rows.end()}});
  };
  // Before the robots: who has rows is then one of them.
  std::vector<RobotFrame> boards;
  if (attached != nullptr) {
    attached->takeRows(keep);
    boards = attached->robots(m_options.field, m_options.team.battery);
  }
  m_sent.takeRows(keep);
  for (RobotFrame& robot : m_sent.robots(now, m_options.field, m_monitorOptions)) {
    robot.identity.team = drawnColour(m_options, robot.key, frame.teams);
    robot.ownName = ownNameOf(m_options, robot.key);
    boards.push_back(std::move(robot));
  }
  std::vector<std::string> known;
  std::vector<SentKey> senders;
  for (const RobotFrame& board : boards) {
    known.push_back(board.name);
    senders.emplace_back(board.link->sender.address, board.key.number);
  }
  const std::vector<RobotKey> keys = joinBoards(frame, std::move(boards));
  std::map<RobotKey, std::string> robots;
  std::map<std::string, BoardRowKeeper::Name> names;
  m_sentRobots.clear();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const RobotFrame& robot = *frame.robot(keys[i]);
    robots[keys[i]] = robot.name;
    m_sentRobots[senders[i]] = keys[i];
    BoardRowKeeper::Name& name = names[known[i]];
    GroupInfo listed;
    telemetry::setOrder(listed, orderOf(keys[i], frame.teams));
    name = {robot.name, std::move(listed.attributes)};
    name.attributes["team"] = info(robot.identity.team).name;
    if (!robot.ownName.empty()) name.attributes["name"] = robot.ownName;
    if (m_monitorOptions.teamBatteries.contains(keys[i].team)) {
      const telemetry::BatteryLimits& limits = m_monitorOptions.batteryOf(keys[i].team);
      name.attributes["battery_full"] = shortest(limits.fullPerCell * limits.cells);
      name.attributes["battery_low"] = shortest(limits.lowPerCell * limits.cells);
      name.attributes["battery_empty"] = shortest(limits.emptyPerCell * limits.cells);
    }
    if (senders[i].first == telemetry::Address{}) continue;
    name.attributes["place"] = std::to_string(keys[i].team);
    name.attributes["sent"] = senders[i].first.text();
  }
  // Messages and variables may exchange their names.
  m_boardRows.releaseNames(names);
  if (robots != m_boardNames) {
    m_boardNames = std::move(robots);
    noteTeams({});
  }
  m_boardRows.rename(names);
  if (m_fan->isEmpty()) return;
  for (const Taken& one : taken) {
    const auto name = names.find(one.group->name);
    if (name != names.end()) m_boardRows.take(name->first, *one.group, name->second, one.rows);
  }
}

/// About once a second: how the variables of each robot arrive.
void LivePipeline::reportSent(WallTime now) {
  static const GroupInfo group = sentHealthGroup();
  m_nextSentReport = seconds(now) + sentReportPeriod;
  if (m_fan->isEmpty()) return;
  const std::vector<SentStatus> all = details(now).sent;
  const auto boardOf = [](const SentStatus& sent) {
    return sent.link.sender.address.text() + " " + std::to_string(sent.robot.number);
  };
  std::map<std::string, BoardRowKeeper::Name> names;
  for (const SentStatus& sent : all) {
    names[boardOf(sent)] = {sent.name + " agent", {{"link", sent.name}}};
  }
  m_sentHealth.releaseNames(names);
  m_sentHealth.rename(names);
  for (const SentStatus& sent : all) {
    const telemetry::LinkHealth& link = sent.link;
    if (link.age >= m_options.team.timeout) continue;
    const auto optionalNumber = [](const std::optional<std::int64_t>& value) {
      return value ? static_cast<double>(*value) : std::numeric_limits<double>::quiet_NaN();
    };
    BoardRow row{seconds(now), {}, {}};
    row.values = {telemetry::secondsOf(link.age),
                  link.rate,
                  link.jitter * 1000.0,
                  link.loss.value_or(0.0),
                  static_cast<double>(link.lost),
                  static_cast<double>(link.duplicates),
                  static_cast<double>(link.late),
                  sent.clockOffset,
                  optionalNumber(sent.refresh_ms),
                  optionalNumber(sent.waiting)};
    m_sentHealth.take(boardOf(sent), group, names.at(boardOf(sent)), {&row, 1});
  }
}

void LivePipeline::noticeClock(telemetry::Duration setBy, double time) {
  notify(m_events.compareClock(setBy, time));
}

void LivePipeline::noticePorts(const telemetry::ReceiverStatus& network, double time) {
  notify(m_events.comparePorts(network, time));
}

LiveDetails LivePipeline::details(WallTime now) const {
  LiveDetails details;
  details.team = m_state.monitor.status(now);
  details.teams = m_teams;
  std::ranges::stable_sort(details.team.robots, {}, [this](const telemetry::RobotStatus& robot) {
    return orderOf(robot.key, m_teams);
  });
  details.referee = m_state.referee.counts();
  details.unknownReferee = m_unknownReferee;
  details.unknownRefereeReason = m_unknownReason;
  details.unknownRefereeSample = m_unknownSample;
  details.refusedReferees = m_refusedReferees;
  details.rows = m_rows.refused();
  details.sent = m_sent.status(now);
  for (SentStatus& sent : details.sent) {
    const auto known = m_sentRobots.find({sent.link.sender.address, sent.robot.number});
    if (known != m_sentRobots.end()) sent.robot = known->second;
    const auto named = m_boardNames.find(sent.robot);
    sent.name = named != m_boardNames.end() ? named->second : robotName(sent.robot, m_teams);
  }
  details.badVariables = m_badVariables;
  details.badVariablesReason = m_badReason;
  details.refusedVariables = m_refusedVariables;
  return details;
}

/// Later calls of the observer are not part of the snapshot.
void LivePipeline::sendSnapshot(WallTime now) {
  const double time = seconds(now);
  m_nextSnapshot = time + snapshotPeriod;
  if (m_observers.empty()) return;
  const std::string text = m_state.text(m_options, time, m_zero);
  for (const auto& observer : m_observers) observer->remembered(time, text);
}

/// Teams may be called otherwise from now on, and these robots have other keys.
void LivePipeline::noteTeams(const std::vector<Renaming>& renamings) {
  m_teams = m_state.teams(m_options);
  pitchboard::rename(m_boardNames, renamings);
  for (auto& [sender, robot] : m_sentRobots) robot = renamed(robot, renamings);
  m_rows.setOptions(rowsOptions(m_options, m_teams, m_zero, m_boardNames), renamings);
  if (renamings.empty()) return;
  m_events.rename(renamings);
  m_renamings.push_back(renamings);
}

void LivePipeline::notify(const LiveDatagram& datagram) {
  for (const auto& observer : m_observers) observer->received(datagram);
}

void LivePipeline::notify(const std::vector<MatchEvent>& events) {
  std::vector<MatchEvent>& queue = m_news.events;
  queue.insert(queue.end(), events.begin(), events.end());
  if (queue.size() > maxQueued) {
    queue.erase(queue.begin(), queue.end() - static_cast<std::ptrdiff_t>(maxQueued));
  }
  for (const auto& observer : m_observers) {
    for (const MatchEvent& event : events) observer->happened(event);
  }
}

void LivePipeline::observe(std::shared_ptr<LiveObserver> observer, WallTime now) {
  observer->remembered(seconds(now), m_state.text(m_options, seconds(now), m_zero));
  if (auto rows = observer->rows()) m_fan->add(std::move(rows));
  m_observers.push_back(std::move(observer));
}

void LivePipeline::stopObserving(const std::shared_ptr<LiveObserver>& observer) {
  if (std::erase(m_observers, observer) != 0) m_fan->remove(observer->rows());
}

}  // namespace pitchboard::link

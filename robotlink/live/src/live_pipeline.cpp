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
#include <telemetry/series/robot_names.h>

namespace pitchboard::link {
namespace {

using telemetry::DatagramView;
using telemetry::GroupId;
using telemetry::GroupInfo;
using telemetry::WallTime;

std::string boardId(int key) {
  return groupId(uidOfBoard(key), RobotRows::Variables);
}

constexpr double reportPeriod = 0.25;  // s
constexpr double snapshotPeriod =
    15.0;  // s; moments of a recording are rebuilt from the last snapshot before them
constexpr double sentReportPeriod = 1.0;                // s
constexpr telemetry::Address topicReferee{0x7f000001};  // of packets that are made of topics

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
    column.category = linkCategory;
  }
  return group;
}

}  // namespace

void LiveNews::add(std::vector<MatchEvent> later) {
  std::ranges::move(later, std::back_inserter(events));
  if (events.size() > maxEvents) {
    events.erase(events.begin(), events.end() - static_cast<std::ptrdiff_t>(maxEvents));
  }
}

void LiveNews::add(std::vector<LogLine> later) {
  std::ranges::move(later, std::back_inserter(lines));
  if (lines.size() > maxLines) {
    lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(maxLines));
  }
}

void RowFan::remove(const std::shared_ptr<telemetry::RowSink>& sink) {
  std::erase_if(m_sinks, [&sink](const Sink& one) { return one.rows == sink; });
}

std::size_t RowFan::indexOf(const GroupInfo& group) const {
  const auto found = std::ranges::find_if(
      m_groups, [&group](const GroupInfo& known) { return isSameGroup(known, group); });
  return static_cast<std::size_t>(found - m_groups.begin());
}

GroupId RowFan::addGroup(const GroupInfo& info) {
  const std::size_t index = indexOf(info);
  GroupInfo now = info;
  if (index == m_groups.size())
    m_groups.emplace_back();
  else
    keepFormerNames(m_groups[index], now);
  m_groups[index] = std::move(now);
  for (Sink& sink : m_sinks) {
    if (index < sink.groups.size() && sink.groups[index]) {
      sink.groups[index] = sink.rows->addGroup(m_groups[index]);
    }
  }
  return static_cast<GroupId>(index);
}

void RowFan::describeGroups(std::span<const GroupInfo> groups) {
  for (const GroupInfo& group : groups) {
    const std::size_t index = indexOf(group);
    if (index == m_groups.size()) continue;
    GroupInfo& known = m_groups[index];
    GroupInfo now{group.name, {}, group.robot};
    keepFormerNames(known, now);
    if (known.name == now.name && known.robot == now.robot) continue;
    known.name = std::move(now.name);
    known.robot = std::move(now.robot);
    m_described.insert(index);
  }
  if (!m_isHeld) release();
}

void RowFan::release() {
  m_isHeld = false;
  const std::set<std::size_t> described = std::exchange(m_described, {});
  for (Sink& sink : m_sinks) {
    std::vector<GroupInfo> changed;
    for (const std::size_t index : described) {
      if (index < sink.groups.size() && sink.groups[index]) changed.push_back(m_groups[index]);
    }
    if (!changed.empty()) sink.rows->describeGroups(changed);
  }
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
      m_rows(m_fan, rowsOptions(m_options, m_teams, zero), m_state.uids),
      m_sent(m_state.uids),
      m_topics(topicOutputs(), zero),
      m_boardRows(m_fan),
      m_sentHealth(m_fan) {
  useCatalogs();
  useSources();
}

LiveTopics::Outputs LivePipeline::topicOutputs() {
  const auto referee = [this](const std::string& packet, WallTime arrival) {
    const auto port = static_cast<std::uint16_t>(m_options.refereePort);
    take(DatagramView{arrival, {topicReferee, port}, port, false, packet});
  };
  const auto decoded = [this](const LiveTopicMessage& message) {
    for (const auto& observer : m_observers) observer->decoded(message);
  };
  return {*m_fan, [this](const LogLine& line) { notify(line); }, referee, decoded};
}

void LivePipeline::useSources() {
  m_topics.setSources(m_options.foxglove, m_options.field,
                      telemetry::secondsOf(m_options.team.timeout));
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
  if (!m_options.simulated) m_state.forgetSimulated(m_options);
  useCatalogs();
  useSources();
  noteTeams();
  std::vector<RobotKey> robots;
  for (const telemetry::RobotStatus& robot : m_state.monitor.status(now).robots) {
    robots.push_back(robot.key);
  }
  m_state.uids->keepOnly(robots);
  sendSnapshot(now);
}

void LivePipeline::clear(WallTime now) {
  m_state.clear(m_options);
  m_sent.clear();
  m_topics.clear();
  m_sentRobots.clear();
  m_boardNames.clear();
  m_badVariables = m_refusedVariables = 0;
  m_badReason.clear();
  m_events = {};
  noteTeams();
  m_rows.clearRefused();
  m_unknownReferee = m_refusedReferees = m_ignoredSimulated = 0;
  m_unknownReason.clear();
  m_unknownSample.clear();
  sendSnapshot(now);
}

void LivePipeline::forget(RobotUid robot, WallTime now) {
  if (const auto key = m_state.uids->keyOf(robot)) m_state.forget(*key);
  m_topics.forget(robot);
  for (const auto& [sender, uid] : m_sentRobots) {
    if (uid == robot) m_sent.forget(sender.second, sender.first);
  }
  noteTeams();
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
    if (m_state.teams(m_options) != m_teams) noteTeams();
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

/// Returns the team of a robot that sends variables: a team knows nothing of the ports to which
/// they come.
std::optional<int> LivePipeline::teamOf(int number, telemetry::Address sender) const {
  const auto ours = std::ranges::find(m_teams, true, &Team::ours);
  return m_state.monitor.teamOf(sender, number, static_cast<int>(ours - m_teams.begin()));
}

void LivePipeline::takeVariables(const DatagramView& datagram) {
  const auto message = telemetry::parsePb2(datagram.payload);
  const auto place = teamOf(message ? message->robot : 0, datagram.sender.address);
  if (!place) {
    ++m_refusedVariables;
    return;
  }
  const double time = std::max(0.0, seconds(datagram.time));
  LiveDatagram taken{.time = time, .view = datagram, .teams = m_teams, .variables = &message};
  if (message) {
    taken.variablesVerdict = m_sent.take(*message, datagram, *place, time);
    if (taken.variablesVerdict == SentBoards::Verdict::TooManyRobots) ++m_refusedVariables;
    const auto known = m_sentRobots.find({datagram.sender.address, message->robot});
    taken.robot = {*place, message->robot, 0};
    if (known != m_sentRobots.end()) {
      taken.robot = m_state.uids->keyOf(known->second).value_or(taken.robot);
    }
  } else {
    ++m_badVariables;
    m_badReason = message.error().text();
  }
  notify(taken);
}

void LivePipeline::take(const DatagramView& received) {
  DatagramView datagram = received;
  // It came while a state was saved that does not contain it. A recording goes on from that state
  // with what came later.
  if (datagram.time <= m_saved) datagram.time = m_saved + telemetry::Duration(1);
  if (!m_options.simulated && telemetry::isSimulated(datagram.sender.address)) {
    ++m_ignoredSimulated;
    return;
  }
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
    if (!monitor.renamings().empty()) noteTeams();
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

MatchFrame LivePipeline::frame(WallTime now, const AttachedRobots* boards) const {
  std::vector<Board> joined;
  return join(m_state.monitor.status(now), boards, now, joined);
}

/// The frame of what is known, and the robots whose blackboards are received.
MatchFrame LivePipeline::join(const telemetry::TeamStatus& team, const AttachedRobots* attached,
                              WallTime now, std::vector<Board>& boards) const {
  MatchFrame frame = m_state.frame(m_options, team, seconds(now));
  frame.serial = m_serial;
  std::vector<RobotFrame> robots;
  if (attached != nullptr) robots = attached->robots(m_options.field, m_options.team.battery);
  for (RobotFrame& robot : m_sent.robots(now, m_options.field, m_monitorOptions)) {
    robot.identity.team = drawnColour(m_options, robot.key, frame.teams);
    robot.ownName = ownNameOf(m_options, robot.key);
    robots.push_back(std::move(robot));
  }
  std::ranges::move(m_topics.robots(seconds(now)), std::back_inserter(robots));
  for (const RobotFrame& robot : robots) {
    boards.push_back(
        {{robot.link->sender.address, robot.key.number}, robot.boardKey, robot.name, {}});
  }
  const std::vector<RobotUid> uids = joinBoards(frame, std::move(robots));
  for (std::size_t i = 0; i < uids.size(); ++i) boards[i].robot = uids[i];
  return frame;
}

MatchFrame LivePipeline::advance(WallTime now, AttachedRobots* attached) {
  struct Taken {
    std::string id;  // of the group
    const GroupInfo* group;
    std::vector<BoardRow> rows;
  };
  std::vector<Taken> taken;
  const auto keep = [&taken](const GroupInfo& group, std::span<const BoardRow> rows) {
    const std::optional<int>& key = factsOf(group).boardKey;
    taken.push_back({key ? boardId(*key) : group.id, &group, {rows.begin(), rows.end()}});
  };
  // Before the robots: who has rows is then one of them.
  if (attached != nullptr) attached->drainRows(keep);
  m_sent.drainRows(keep);
  m_topics.drainRows(keep);
  ++m_serial;
  const telemetry::TeamStatus team = m_state.monitor.status(now);
  std::vector<Board> boards;
  MatchFrame frame = join(team, attached, now, boards);
  nameBoards(frame, boards, now);
  for (const Taken& one : taken) {
    const auto known = m_boardFacts.find(one.id);
    if (!m_fan->isEmpty() && known != m_boardFacts.end()) {
      m_boardRows.take(one.id, *one.group, known->second, one.rows);
    }
  }
  notify(m_topics.drainEvents());
  std::vector<MatchEvent> events = m_events.compare(frame);
  for (MatchEvent& event : events) {
    if (event.kind != MatchEventKind::RobotReceived) continue;
    const std::string source = m_topics.sourceOf(event.robot);
    if (!source.empty()) event.detail = source;
  }
  notify(events);
  for (const auto& observer : m_observers) observer->frameMade(frame);
  const double time = seconds(now);
  if (time >= m_nextReport) {
    m_nextReport = time + reportPeriod;
    if (!m_fan->isEmpty()) m_rows.report(team);
  }
  if (time >= m_nextSentReport) reportSent(now);
  if (time >= m_nextSnapshot) sendSnapshot(now);
  return frame;
}

/// The groups of rows of robots whose blackboards are received get the names of the frame.
void LivePipeline::nameBoards(const MatchFrame& frame, const std::vector<Board>& boards,
                              WallTime now) {
  std::map<RobotUid, std::string> robots;
  std::map<std::string, BoardRowKeeper::Facts> facts;
  m_sentRobots.clear();
  for (const Board& board : boards) {
    const RobotFrame& robot = *frame.robot(board.robot);
    robots[board.robot] = robot.name;
    m_sentRobots[board.sender] = board.robot;
    BoardRowKeeper::Facts& named = facts[board.key ? boardId(*board.key) : board.group];
    named.name = robot.name;
    telemetry::RobotFacts& known = named.robot;
    known.order = orderOf(robot.key, frame.teams);
    known.team = robot.identity.team;
    known.name = robot.ownName;
    if (m_monitorOptions.teamBatteries.contains(robot.key.team)) {
      const telemetry::BatteryLimits& limits = m_monitorOptions.batteryOf(robot.key.team);
      known.battery = telemetry::BatteryVolts{limits.fullPerCell * limits.cells,
                                              limits.lowPerCell * limits.cells,
                                              limits.emptyPerCell * limits.cells};
    }
    if (board.sender.first == telemetry::Address{}) continue;
    known.place = robot.key.team;
    known.sentFrom = board.sender.first.text();
  }
  if (std::exchange(m_hasNewNames, false) || facts != m_boardFacts || robots != m_boardNames) {
    m_boardNames = std::move(robots);
    m_boardFacts = std::move(facts);
    nameGroups(now);
  }
}

/// All groups get their names together.
void LivePipeline::nameGroups(WallTime now) {
  m_fan->hold();
  m_rows.setOptions(rowsOptions(m_options, m_teams, m_zero, m_boardNames));
  m_boardRows.describe(m_boardFacts);
  m_sentHealth.describe(agentFacts(details(now).sent));
  m_fan->release();
}

std::map<std::string, BoardRowKeeper::Facts> LivePipeline::agentFacts(
    const std::vector<SentStatus>& all) const {
  std::map<std::string, BoardRowKeeper::Facts> facts;
  for (const SentStatus& sent : all) {
    BoardRowKeeper::Facts& known = facts[groupId(sent.uid, RobotRows::Agent)];
    known.name = sent.name + " agent";
    known.robot.order = orderOf(sent.robot, m_teams);
    known.robot.linkOf = sent.name;
    known.robot.uid = sent.uid;
  }
  return facts;
}

/// About once a second: how the variables of each robot arrive.
void LivePipeline::reportSent(WallTime now) {
  static const GroupInfo group = sentHealthGroup();
  m_nextSentReport = seconds(now) + sentReportPeriod;
  if (m_fan->isEmpty()) return;
  m_topics.report(now);
  const std::vector<SentStatus> all = details(now).sent;
  const std::map<std::string, BoardRowKeeper::Facts> facts = agentFacts(all);
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
    const std::string id = groupId(sent.uid, RobotRows::Agent);
    m_sentHealth.take(id, group, facts.at(id), {&row, 1});
  }
}

void LivePipeline::noticeClock(telemetry::Duration setBy, double time) {
  notify(m_events.compareClock(setBy, time));
}

void LivePipeline::noticePorts(const telemetry::ReceiverStatus& network, double time) {
  notify(m_events.comparePorts(network, sharedPorts(network), time));
}

std::string LivePipeline::sharedPorts(const telemetry::ReceiverStatus& network) const {
  // A referee broadcasts; only monitors get packets of their own.
  std::optional<std::uint16_t> broadcast;
  if (!m_options.monitor) broadcast = static_cast<std::uint16_t>(m_options.refereePort);
  return telemetry::sharedPortsText(network, broadcast);
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
    const RobotUid robot = known != m_sentRobots.end() ? known->second : sent.uid;
    sent.robot = m_state.uids->keyOf(robot).value_or(sent.robot);
    const auto named = m_boardNames.find(robot);
    sent.name = named != m_boardNames.end() ? named->second : robotName(sent.robot, m_teams);
  }
  details.topics = m_topics.status(now);
  details.badVariables = m_badVariables;
  details.badVariablesReason = m_badReason;
  details.refusedVariables = m_refusedVariables;
  details.ignoredSimulated = m_ignoredSimulated;
  return details;
}

/// Later calls of the observer are not part of the snapshot.
void LivePipeline::sendSnapshot(WallTime now) {
  const double time = seconds(now);
  m_nextSnapshot = time + snapshotPeriod;
  m_saved = now;
  if (m_observers.empty()) return;
  const std::string text = m_state.text(m_options, time, m_zero);
  for (const auto& observer : m_observers) observer->remembered(time, text);
}

/// Teams and robots may be called otherwise from now on. The next frame has the new names; groups
/// of rows get them with it.
void LivePipeline::noteTeams() {
  m_teams = m_state.teams(m_options);
  m_hasNewNames = true;
  m_sent.place([this](int number, telemetry::Address sender) { return teamOf(number, sender); });
}

void LivePipeline::notify(const LiveDatagram& datagram) {
  for (const auto& observer : m_observers) observer->received(datagram);
}

void LivePipeline::notify(const std::vector<MatchEvent>& events) {
  m_news.add(events);
  for (const auto& observer : m_observers) {
    for (const MatchEvent& event : events) observer->happened(event);
  }
}

void LivePipeline::notify(const LogLine& line) {
  m_news.add(std::vector<LogLine>{line});
  for (const auto& observer : m_observers) observer->logged(line);
}

void LivePipeline::observe(std::shared_ptr<LiveObserver> observer, WallTime now) {
  m_saved = now;
  observer->remembered(seconds(now), m_state.text(m_options, seconds(now), m_zero));
  if (auto rows = observer->rows()) m_fan->add(std::move(rows));
  m_observers.push_back(std::move(observer));
}

void LivePipeline::stopObserving(const std::shared_ptr<LiveObserver>& observer) {
  if (std::erase(m_observers, observer) != 0) m_fan->remove(observer->rows());
}

}  // namespace pitchboard::link

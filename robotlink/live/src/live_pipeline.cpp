// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_pipeline.h>

#include <algorithm>

#include <robotlink/frame/build_robot.h>
#include <robotlink/live/live_teams.h>

namespace pitchboard::link {
namespace {

using telemetry::DatagramView;
using telemetry::GroupId;
using telemetry::GroupInfo;
using telemetry::WallTime;

constexpr double reportPeriod = 0.25;  // s
constexpr double snapshotPeriod =
    15.0;  // s; a moment of a recording is made from the books before it
constexpr std::size_t maxQueued = 10'000;

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
      m_zero(zero),
      m_state(m_options),
      m_rows(m_fan, rowsOptions(m_options, m_teams, zero)),
      m_boardRows(m_fan) {}

void LivePipeline::setOptions(LiveOptions options, WallTime now) {
  const LiveOptions old = std::exchange(m_options, std::move(options));
  if (!(old.profile == m_options.profile)) m_state.monitor.setProfile(m_options.profile);
  m_state.setTeams(monitorOptions(m_options));
  m_state.referee.setOptions(LiveState::refereeOptions(m_options));
  noteTeams(m_state.monitor.renamings());
  sendSnapshot(now);
}

void LivePipeline::clear(WallTime now) {
  m_state.clear(m_options);
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
  tell({.time = std::max(0.0, seconds(datagram.time)),
        .view = datagram,
        .teams = m_teams,
        .referee = &packet});
}

void LivePipeline::take(const DatagramView& datagram) {
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
  tell(taken);
}

MatchFrame LivePipeline::frame(WallTime now, AttachedRobots* boards) {
  const telemetry::TeamStatus team = m_state.monitor.status(now);
  const double time = seconds(now);
  MatchFrame frame = m_state.frame(m_options, team, time);
  frame.serial = ++m_serial;
  if (boards != nullptr) {
    boards->addTo(frame);
    frame.sortRobots();
    frame.teamBalls = agreedBalls(frame.robots);
    boards->takeRows([this](const GroupInfo& group, std::span<const BoardRow> rows) {
      if (!m_fan->isEmpty()) m_boardRows.take(group, rows);
    });
  }
  tell(m_events.compare(frame));
  for (const auto& observer : m_observers) observer->frameMade(frame);
  if (time >= m_nextReport) {
    m_nextReport = time + reportPeriod;
    if (!m_fan->isEmpty()) m_rows.report(team);
  }
  if (time >= m_nextSnapshot) sendSnapshot(now);
  return frame;
}

void LivePipeline::noticeClock(telemetry::Duration setBy, double time) {
  tell(m_events.compareClock(setBy, time));
}

void LivePipeline::noticePorts(const telemetry::ReceiverStatus& network, double time) {
  tell(m_events.comparePorts(network, time));
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
  return details;
}

/// What an observer hears after it, is not in the books.
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
  m_rows.setOptions(rowsOptions(m_options, m_teams, m_zero), renamings);
  if (renamings.empty()) return;
  m_events.rename(renamings);
  m_news.renamings.push_back(renamings);
}

void LivePipeline::tell(const LiveDatagram& datagram) {
  for (const auto& observer : m_observers) observer->received(datagram);
}

void LivePipeline::tell(const std::vector<MatchEvent>& events) {
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

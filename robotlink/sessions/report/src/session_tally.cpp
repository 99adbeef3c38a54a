// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/session_tally.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <base/game.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/row_slot.h>
#include <robotlink/session/row_walk.h>
#include <simcore/world/action.h>

namespace pitchboard::link {
namespace {

using telemetry::FieldMeaning;

constexpr double centimetres = 100.0;
constexpr double maxMoments = 36'000;  // of a live match
constexpr double maxAge = 2.5;         // s: a robot without rows for so long had left

std::optional<double> known(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<Point> placeOf(const RowSlot& x, const RowSlot& y, const telemetry::RowView& row) {
  const Point place{x.read(row), y.read(row)};
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return {};
  return place;
}

bool isKick(int code) {
  const sim::Action* action = sim::findAction(code);
  return action && action->kind == ActionKind::Kick;
}

/// 0 and 1, in extra time 2 and 3.
std::optional<std::size_t> halfOf(bool isExtraTime, bool isFirst) {
  return (isExtraTime ? 2U : 0U) + (isFirst ? 0U : 1U);
}

}  // namespace

/// A group of rows: a robot, the match, or what does not count.
struct RowTally::Source {
  explicit Source(const telemetry::GroupInfo& group)
      : info(group),
        x(findSlot(group, {"TRUE_X"})),
        y(findSlot(group, {"TRUE_Y"})),
        walked(findSlot(group, {"DISTANCE_WALKED"})),
        kicks(findSlot(group, {"KICKS"})),
        falls(findSlot(group, {"FALLS"})),
        error(findSlot(group, {"BELIEF_ERROR"})),
        penalty(findSlot(group, {"PENALTY"})),
        ballX(findSlot(group, {"BALL_X"})),
        ballY(findSlot(group, {"BALL_Y"})),
        left(findSlot(group, {"SCORE_LEFT"})),
        right(findSlot(group, {"SCORE_RIGHT"})),
        referee(findSlot(group, {"REFEREE"})),
        state(findSlot(group, {"GAME_STATE"})),
        stopped(findSlot(group, {"PLAY_STOPPED"})),
        phase(findSlot(group, {"GAME_PHASE"})),
        half(findSlot(group, {"HALF"})),
        leftTeam(findSlot(group, {"LEFT_TEAM"})),
        setPlay(findSlot(group, {"SET_PLAY"})),
        setPlayTeam(findSlot(group, {"SET_PLAY_TEAM"})),
        kickOffTeam(findSlot(group, {"KICK_OFF_TEAM"})),
        numbers{findSlot(group, {"TEAM1_NUMBER"}), findSlot(group, {"TEAM2_NUMBER"})},
        colours{findSlot(group, {"TEAM1_COLOUR"}), findSlot(group, {"TEAM2_COLOUR"})},
        flags{findSlot(group, FieldMeaning::Control), findSlot(group, FieldMeaning::Vision),
              findSlot(group, FieldMeaning::Localization), findSlot(group, FieldMeaning::Decision),
              findSlot(group, FieldMeaning::Imu)},
        // Robots without the truth are those of Live.
        isRobot(factsOf(group).slot != 0 && x.present()),
        isMatch(!isRobot && left.present()),
        facesLeft(factsOf(group).imuStartsAt180.value_or(false)) {
    robot.uid = factsOf(group).uid;
    if (robot.uid == RobotUid{}) robot.uid = uidOf(RobotId{factsOf(group).slot});
    robot.name = group.name;
    robot.ownName = factsOf(group).name;
    robot.team = teamOf(group);
    robot.radius = factsOf(group).radius_m.value_or(0.0);
    robot.order = factsOf(group).order.value_or(RobotOrder{true, keyOf(group)});
  }

  void readRobot(const telemetry::RowView& row, TallyMoment& moment) {
    robot.place = placeOf(x, y, row);
    robot.walked = known(walked.read(row));
    robot.kicks = known(kicks.read(row));
    robot.falls = known(falls.read(row));
    robot.beliefError = known(error.read(row));
    const auto kind = static_cast<PenaltyKind>(penalty.readInt(row));
    robot.penalised = kind != PenaltyKind::None && kind != PenaltyKind::Substitute;
    robot.penalty = kind;
    robot.tellsKicks = robot.kicks.has_value();
    for (std::size_t f = 0; f < flags.size(); ++f) {
      if (flags[f].present()) robot.works[f] = flags[f].readOr(row, 0.0) != 0.0;
    }
    moment.robots.push_back(robot);
    moment.teams[robot.team].name = factsOf(info).teamName;
  }

  void readMatch(const telemetry::RowView& row, TallyMoment& moment) {
    moment.ball = placeOf(ballX, ballY, row);
    score = {left.readInt(row), right.readInt(row)};
    moment.isInPlay = true;
    moment.half.reset();
    moment.restart.reset();
    isRefereed = referee.readOr(row, 0.0) != 0.0;
    if (!isRefereed) return;
    const auto part = static_cast<GamePhase>(phase.readInt(row));
    moment.isInPlay = static_cast<PlayState>(state.readInt(row)) == PlayState::Playing &&
                      stopped.readOr(row, 0.0) == 0.0 && part != GamePhase::ShootOut;
    if (part == GamePhase::Normal || part == GamePhase::ExtraTime) {
      moment.half = halfOf(part == GamePhase::ExtraTime, half.readInt(row) == 1);
    }
    const int kind = setPlay.readInt(row);
    const bool isKickOff = static_cast<PlayState>(state.readInt(row)) == PlayState::Set;
    const int taking = kind > 0    ? setPlayTeam.readInt(row, -1)
                       : isKickOff ? kickOffTeam.readInt(row, -1)
                                   : Game::noTeam;
    for (std::size_t i = 0; i < colours.size(); ++i) {
      const int colour = colours[i].readInt(row, -1);
      if (colour < 0 || static_cast<std::size_t>(colour) >= teamColors.size()) continue;
      if (taking == static_cast<int>(i)) {
        moment.restart = TallyRestart{static_cast<SetPlay>(kind), static_cast<TeamColor>(colour)};
      }
      TallyTeam& team = moment.teams[static_cast<TeamColor>(colour)];
      team.attacksRight = leftTeam.readInt(row) == static_cast<int>(i);
      team.number = numbers[i].readInt(row);
      team.score = leftTeam.readInt(row) == static_cast<int>(i) ? score.left : score.right;
    }
  }

  telemetry::GroupInfo info;
  RowSlot x, y, walked, kicks, falls, error, penalty;                                 // of a robot
  RowSlot ballX, ballY, left, right, referee, state, stopped, phase, half, leftTeam;  // a match
  RowSlot setPlay, setPlayTeam, kickOffTeam;
  std::array<RowSlot, 2> numbers, colours;
  std::array<RowSlot, telemetry::processCount> flags;
  bool isRobot, isMatch, facesLeft, isRefereed = false;
  TallyRobot robot;
  sim::Score score;
  std::array<std::optional<double>, telemetry::processCount> flagSeen{};  // s
};

RowTally::RowTally(const sim::FieldSpec& field) : m_tally(field) {}
RowTally::~RowTally() = default;

telemetry::GroupId RowTally::addGroup(const telemetry::GroupInfo& info) {
  const auto found = std::ranges::find_if(
      m_sources, [&](const auto& source) { return source && source->info.name == info.name; });
  const auto index = static_cast<std::size_t>(found - m_sources.begin());
  if (found == m_sources.end()) {
    m_sources.push_back(std::make_unique<Source>(info));
  } else {
    auto next = std::make_unique<Source>(info);
    next->flagSeen = (*found)->flagSeen;
    settle();  // no robot of the moment is that of the old columns
    *found = std::move(next);
  }
  return static_cast<telemetry::GroupId>(index);
}

void RowTally::append(telemetry::GroupId group, const telemetry::RowView& row) {
  ++m_rows;
  if (row.time != m_moment.time) settle();
  Source& source = *m_sources[group];
  m_moment.time = row.time;
  if (source.isMatch) source.readMatch(row, m_moment);
  if (!source.isRobot || std::ranges::find(m_present, &source) != m_present.end()) return;
  source.readRobot(row, m_moment);
  m_present.push_back(&source);
}

/// With what follows from all rows of the moment.
TallyMoment RowTally::complete() const {
  TallyMoment out = m_moment;
  const auto match = std::ranges::find_if(m_sources, [](const auto& one) { return one->isMatch; });
  for (std::size_t i = 0; i < out.robots.size(); ++i) {
    TallyRobot& robot = out.robots[i];
    const Source& source = *m_present[i];
    if (out.ball && robot.place) robot.ballDistance = distance(*robot.place, *out.ball);
    for (std::size_t f = 0; f < robot.works.size(); ++f) {
      // Processes clear the flag and set it again all the time.
      if (robot.works[f] && source.flagSeen[f]) {
        robot.works[f] = *robot.works[f] || out.time - *source.flagSeen[f] <= flagMemory;
      }
    }
    // Without a referee, the yaw of a team's robots at the start shows which side it defends.
    if (match != m_sources.end() && !(*match)->isRefereed) {
      const sim::Score& score = (*match)->score;
      out.teams[robot.team].score = source.facesLeft ? score.right : score.left;
      out.teams[robot.team].attacksRight = !source.facesLeft;
    }
  }
  return out;
}

void RowTally::endMoment() {
  for (std::size_t i = 0; i < m_present.size(); ++i) {
    for (std::size_t f = 0; f < m_present[i]->flagSeen.size(); ++f) {
      if (m_present[i]->robot.works[f].value_or(false)) m_present[i]->flagSeen[f] = m_moment.time;
    }
  }
  m_settled = m_moment.time;
}

void RowTally::settle() {
  if (m_present.empty()) return;
  const auto stepOf = [](double time) { return std::floor(time / tallyStep + 1e-6); };
  if (stepOf(m_moment.time) != stepOf(m_settled)) {
    m_tally.add(complete());
    endMoment();
  }
  m_present.clear();
  m_moment.robots.clear();
}

void RowTally::beginAt(double time) {
  if (m_present.empty()) return;
  TallyMoment moment = complete();
  moment.time = time;
  m_tally.begin(moment);
  endMoment();
  m_settled = time;
  m_present.clear();
  m_moment.robots.clear();
}

MatchStatistics RowTally::statistics(telemetry::TimeRange range) const {
  MatchTally whole = m_tally;
  if (!m_present.empty() && m_moment.time > m_settled) whole.add(complete());
  MatchStatistics out = whole.statistics(range);
  out.rows = m_rows;
  return out;
}

TallyMoment liveMomentOf(const MatchFrame& frame) {
  TallyMoment out;
  out.time = frame.snapshot.time;
  for (const RobotFrame& seen : frame.robots) {
    if (!seen.link) continue;
    TallyRobot& robot = out.robots.emplace_back();
    robot.uid = seen.uid;
    robot.name = seen.name;
    robot.ownName = seen.ownName;
    robot.order = orderOf(seen.key, frame.teams);
    robot.team = seen.identity.team;
    robot.link = seen.link;
    robot.penalised = seen.penalty && !seen.penalty->isSubstitute();
    robot.penalty = seen.penalty ? seen.penalty->kind : PenaltyKind::None;
    robot.kicking = seen.decided && isKick(*seen.decided);
    robot.tellsKicks = seen.decided.has_value();
    robot.sigma = seen.sigma.value_or(0.0);
    robot.radius = seen.radius;
    robot.fallen = seen.fallen;
    if (seen.poseKnown()) robot.place = seen.pose.position;
    robot.placeTime = out.time - telemetry::secondsOf(seen.link->age);
    if (seen.ball) robot.ballDistance = seen.ball->distance;
    if (seen.battery && seen.battery->volts > 0.0) robot.volts = seen.battery->volts;
    for (std::size_t i = 0; i < seen.lamps.size(); ++i) {
      const telemetry::HeartbeatState state = seen.lamps[i].state;
      if (state == telemetry::HeartbeatState::Unknown) continue;
      robot.works[i] = state == telemetry::HeartbeatState::Working;
    }
    const auto place = static_cast<std::size_t>(seen.key.team);
    if (place < frame.teams.size()) out.teams[robot.team].name = frame.teams[place].name;
    // Of those who see it, the nearest one knows best where the ball is.
    const bool isNearest =
        seen.ball && std::ranges::all_of(out.robots, [&](const auto& other) {
          return !other.ballDistance || seen.ball->distance <= *other.ballDistance;
        });
    if (!isNearest) continue;
    out.ball = seen.ball->place;
    out.ballSigma = seen.sigma.value_or(0.0);
  }
  if (!frame.game) return out;
  out.half = frame.game->period();
  out.isInPlay =
      frame.game->state == PlayState::Playing && !frame.game->stopped && out.half.has_value();
  // Both teams, even if no robot of one of them was received.
  for (const GameTeam& side : frame.game->teams) {
    const auto colour = robotColor(side.colour);
    if (!colour) continue;
    TallyTeam& team = out.teams[*colour];
    team.number = side.number;
    team.score = side.score;
    const int index = static_cast<int>(&side - frame.game->teams.data());
    team.attacksRight = frame.game->attacksRight(static_cast<std::size_t>(index));
    const bool isKickOff = frame.game->state == PlayState::Set;
    if (frame.game->setPlay() != SetPlay::None ? frame.game->setPlayTeam() == index
                                               : isKickOff && frame.game->kickOff == index) {
      out.restart = TallyRestart{frame.game->setPlay(), *colour};
    }
    const std::string_view name = teamName(side.number, frame.teams);
    if (!name.empty()) team.name = name;
  }
  return out;
}

namespace {

template <class Rows>
MatchStatistics countRows(const Rows& rows, std::size_t groups, telemetry::TimeRange range,
                          const sim::FieldSpec& field, const auto& infoOf) {
  RowTally tally(field);
  for (std::size_t i = 0; i < groups; ++i) tally.addGroup(infoOf(i));
  forEachHeldRow(rows, range.begin, [&](telemetry::GroupId id, const auto&, const auto& row) {
    if (row.time < range.begin && row.time > range.begin - maxAge) tally.append(id, row);
  });
  tally.beginAt(range.begin);
  forEachRow(rows, range,
             [&](telemetry::GroupId id, const auto&, const auto& row) { tally.append(id, row); });
  return tally.statistics(range);
}

MatchStatistics countFrames(const telemetry::SessionReader& session, telemetry::TimeRange range) {
  const FrameSettings backdrop = backdropOf(session);
  MatchTally tally(backdrop.field);
  RecordedFrames frames(backdrop);  // with the robots that sent variables only
  const auto all = session.range();
  const double length = std::max(0.0, range.end - range.begin);
  const double step = std::max(tallyStep, length / maxMoments);
  const auto count = static_cast<std::uint64_t>(length / step);
  for (std::uint64_t i = 0; i <= count; ++i) {
    // The last one is the end itself: the score that counts may come with the last packet.
    const double time = i == count ? range.end : range.begin + step * static_cast<double>(i);
    const TallyMoment moment = liveMomentOf(frames.frameAt(session, time));
    // What was already so when the range begins is not of the range.
    if (i == 0 && all && all->begin < range.begin) {
      tally.begin(moment);
    } else {
      tally.add(moment);
    }
  }
  MatchStatistics out = tally.statistics(range);
  for (const telemetry::SessionGroup& group : session.groups()) out.rows += group.rows;
  return out;
}

}  // namespace

MatchStatistics statisticsOf(const telemetry::SeriesStore& rows, telemetry::TimeRange range,
                             const sim::FieldSpec& field) {
  return countRows(rows, rows.groups(), range, field, [&](std::size_t i) {
    return rows.view(static_cast<telemetry::GroupId>(i))->info();
  });
}

MatchStatistics statisticsOf(const telemetry::SessionReader& session, telemetry::TimeRange range) {
  const bool isImported = std::ranges::any_of(
      session.groups(), [](const auto& group) { return !factsOf(group.info).recordedBy.empty(); });
  if (isImported || session.count(telemetry::SessionStream::LiveState) > 0) {
    return countFrames(session, range);
  }
  return countRows(session, session.groups().size(), range, backdropOf(session).field,
                   [&](std::size_t i) { return session.groups()[i].info; });
}

}  // namespace pitchboard::link

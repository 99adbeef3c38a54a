// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/session_statistics.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <base/angles.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/report/quantile.h>
#include <robotlink/session/row_slot.h>
#include <telemetry/series/group_order.h>

#include "live_statistics.h"

namespace pitchboard::link {
namespace {

using telemetry::FieldMeaning;

constexpr double longestStep = 2.5;  // s; a longer gap between rows counts as absence
constexpr double centimetres = 100.0;

/// Grows with a counter that may start again.
struct Counted {
  std::optional<double> last;
  double total = 0.0;
  void take(double value) {
    if (!std::isfinite(value)) return;
    if (last && value > *last) total += value - *last;
    last = value;
  }
};

struct RobotColumns {
  explicit RobotColumns(const telemetry::GroupInfo& group)
      : walked(findSlot(group, {"DISTANCE_WALKED"})),
        kicks(findSlot(group, {"KICKS"})),
        falls(findSlot(group, {"FALLS"})),
        trueBall(findSlot(group, {"TRUE_BALL_DIST"})),
        error(findSlot(group, {"BELIEF_ERROR"})),
        flags{findSlot(group, FieldMeaning::Control), findSlot(group, FieldMeaning::Vision),
              findSlot(group, FieldMeaning::Localization), findSlot(group, FieldMeaning::Decision),
              findSlot(group, FieldMeaning::Imu)} {}

  RowSlot walked, kicks, falls, trueBall, error;
  std::array<RowSlot, telemetry::processCount> flags;
};

/// What rows of one robot have said so far.
struct Tally {
  RobotSummary out;
  bool facesLeft = false;
  std::optional<double> lastTime;
  Counted distance, kicked, fell;
  std::array<std::optional<double>, telemetry::processCount> seen;
  std::array<double, telemetry::processCount> worked{};
  std::array<bool, telemetry::processCount> known{};
  std::vector<float> errors;
  std::vector<double> errorSum = std::vector<double>(statisticsParts);
  std::vector<std::uint32_t> errorCount = std::vector<std::uint32_t>(statisticsParts);
};

/// Takes rows in order of time.
class RowStatistics {
 public:
  explicit RowStatistics(telemetry::TimeRange range) : m_range(range), m_sums(range) {}
  void add(telemetry::GroupId id, const telemetry::GroupInfo& group, const telemetry::RowView& row);
  SessionStatistics finish();

 private:
  struct Claim {
    Tally* robot;
    double distance;  // cm
    double seconds;
  };
  struct Source {  // of rows
    RobotColumns columns;
    Tally* robot;
  };
  void settle();
  void addRobot(const RobotColumns& columns, Tally& robot, const telemetry::RowView& row);
  void seeGame(const telemetry::RowView& row);

  telemetry::TimeRange m_range;
  TeamSums m_sums;
  std::map<std::string, Tally> m_robots;  // by name: one robot may change its columns
  std::map<telemetry::GroupId, Source> m_sources;
  std::vector<Claim> m_claims;  // of one time
  double m_claimTime = -1e300;
  std::uint64_t m_rows = 0;
  std::optional<sim::Score> m_firstScore, m_lastScore;
  RowSlot m_scoreLeft, m_scoreRight;
  struct Game {
    explicit Game(const telemetry::GroupInfo& group)
        : referee(findSlot(group, {"REFEREE"})),
          half(findSlot(group, {"HALF"})),
          phase(findSlot(group, {"GAME_PHASE"})),
          leftTeam(findSlot(group, {"LEFT_TEAM"})),
          numbers{findSlot(group, {"TEAM1_NUMBER"}), findSlot(group, {"TEAM2_NUMBER"})},
          colours{findSlot(group, {"TEAM1_COLOUR"}), findSlot(group, {"TEAM2_COLOUR"})} {}
    RowSlot referee, half, phase, leftTeam;
    std::array<RowSlot, 2> numbers, colours;
  };
  std::optional<Game> m_game;  // columns
  struct Refereed {
    int number = 0;
    HalfScores halves;
  };
  std::map<TeamColor, Refereed> m_refereed;
  std::optional<telemetry::GroupId> m_match;
};

/// The nearest robot of one time has the ball.
void RowStatistics::settle() {
  const auto nearest = std::ranges::min_element(m_claims, {}, &Claim::distance);
  if (nearest != m_claims.end()) m_sums.hold(nearest->robot->out, m_claimTime, nearest->seconds);
  m_claims.clear();
}

void RowStatistics::addRobot(const RobotColumns& columns, Tally& r, const telemetry::RowView& row) {
  const double since = r.lastTime ? row.time - *r.lastTime : 0.0;
  const double step = since > 0.0 && since <= longestStep ? since : 0.0;
  r.lastTime = row.time;
  r.out.seconds += step;
  r.distance.take(columns.walked.read(row));
  r.kicked.take(columns.kicks.read(row));
  r.fell.take(columns.falls.read(row));
  if (const double error = columns.error.read(row); std::isfinite(error)) {
    r.errors.push_back(static_cast<float>(error));
    r.errorSum[m_sums.part(row.time)] += error;
    ++r.errorCount[m_sums.part(row.time)];
  }
  for (std::size_t f = 0; f < columns.flags.size(); ++f) {
    r.known[f] = columns.flags[f].present();
    const bool was = r.seen[f] && row.time - *r.seen[f] <= std::max(flagMemory, step);
    if (columns.flags[f].readOr(row, 0.0) != 0.0) r.seen[f] = row.time;
    if (was && step > 0.0) r.worked[f] += step;
  }
  const double distance = columns.trueBall.read(row);
  if (distance <= ballReach * centimetres && step > 0.0) m_claims.push_back({&r, distance, step});
}

void RowStatistics::seeGame(const telemetry::RowView& row) {
  const auto phase = static_cast<sim::GamePhase>(m_game->phase.readInt(row));
  const int half = m_game->half.readInt(row);
  if (half < 1 || half > 2) return;
  for (std::size_t i = 0; i < m_game->colours.size(); ++i) {
    const int colour = m_game->colours[i].readInt(row, -1);
    if (colour < 0 || static_cast<std::size_t>(colour) >= teamColors.size()) continue;
    Refereed& team = m_refereed[static_cast<TeamColor>(colour)];
    team.number = m_game->numbers[i].readInt(row);
    if (phase != sim::GamePhase::Normal && phase != sim::GamePhase::ExtraTime) continue;
    const bool isLeft = m_game->leftTeam.readInt(row) == static_cast<int>(i);
    team.halves.see(
        (phase == sim::GamePhase::ExtraTime ? 2U : 0U) + static_cast<unsigned>(half) - 1,
        isLeft ? m_lastScore->left : m_lastScore->right);
  }
}

void RowStatistics::add(telemetry::GroupId id, const telemetry::GroupInfo& group,
                        const telemetry::RowView& row) {
  if (row.time < m_range.begin || row.time > m_range.end) return;
  ++m_rows;
  if (row.time != m_claimTime) {
    settle();
    m_claimTime = row.time;
  }
  auto known = m_sources.find(id);
  if (known == m_sources.end()) {
    Tally* robot = nullptr;
    // Robots without the truth are those of Live (liveStatistics()).
    if (attributeNumber(group, "robot") != 0 && findSlot(group, {"TRUE_X"}).present()) {
      robot = &m_robots[group.name];
      robot->out.name = group.name;
      robot->out.ownName = attribute(group, "name");
      robot->out.team = teamOf(group);
      const RobotKey key{static_cast<int>(teamOf(group)) + 1, attributeNumber(group, "number"), 0};
      robot->out.order = telemetry::orderOf(group).value_or(RobotOrder{true, key});
      m_sums.team(teamOf(group)).name = attribute(group, "team_name");
      robot->facesLeft = attribute(group, "imu180") == "1";
    } else if (findSlot(group, {"SCORE_LEFT"}).present()) {
      m_match = id;
      m_scoreLeft = findSlot(group, {"SCORE_LEFT"});
      m_scoreRight = findSlot(group, {"SCORE_RIGHT"});
      m_game.emplace(group);
    }
    known = m_sources.emplace(id, Source{RobotColumns(group), robot}).first;
  }
  if (known->second.robot) return addRobot(known->second.columns, *known->second.robot, row);
  if (m_match == id) {
    m_lastScore = sim::Score{m_scoreLeft.readInt(row), m_scoreRight.readInt(row)};
    if (!m_firstScore) m_firstScore = m_lastScore;
    if (m_game->referee.readOr(row, 0.0) != 0.0) seeGame(row);
  }
}

SessionStatistics RowStatistics::finish() {
  settle();
  for (auto& [name, r] : m_robots) {
    RobotSummary& s = r.out;
    s.distance = r.distance.total;
    s.kicks = static_cast<std::uint32_t>(std::min(r.kicked.total, 4e9));
    s.falls = static_cast<std::uint32_t>(std::min(r.fell.total, 4e9));
    if (!r.errors.empty()) {
      std::ranges::sort(r.errors);
      s.errorMedian = quantile(r.errors, 0.5);
      s.error90 = quantile(r.errors, 0.9);
      for (std::size_t i = 0; i < statisticsParts; ++i) {
        s.errorCurve.push_back(r.errorCount[i] > 0 ? r.errorSum[i] / r.errorCount[i]
                                                   : std::nan(""));
      }
    }
    for (std::size_t f = 0; f < r.known.size(); ++f) {
      if (r.known[f] && s.seconds > 0.0) s.uptime[f] = std::min(1.0, r.worked[f] / s.seconds);
    }
    m_sums.add(s);
    // The yaw of a team's robots at the start shows which side it defends.
    if (m_lastScore) {
      TeamSummary& team = m_sums.team(s.team);
      team.score = r.facesLeft ? m_lastScore->right : m_lastScore->left;
      team.scored = *team.score - (r.facesLeft ? m_firstScore->right : m_firstScore->left);
    }
  }
  for (const auto& [colour, refereed] : m_refereed) {
    TeamSummary& team = m_sums.team(colour);
    team.number = refereed.number;
    team.byHalf = refereed.halves.goals();
  }
  const bool truth = !m_robots.empty();
  SessionStatistics out = m_sums.finish();
  out.truthKnown = truth;
  out.rows = m_rows;
  return out;
}

template <class Source>
SessionStatistics walked(const Source& source, telemetry::TimeRange range) {
  RowStatistics statistics(range);
  forEachRow(source, range, [&](telemetry::GroupId id, const auto& group, const auto& row) {
    statistics.add(id, group, row);
  });
  return statistics.finish();
}

}  // namespace

SessionStatistics statisticsOf(const telemetry::SeriesStore& rows, telemetry::TimeRange range) {
  return walked(rows, range);
}
SessionStatistics statisticsOf(const telemetry::SessionReader& session,
                               telemetry::TimeRange range) {
  if (session.count(telemetry::SessionStream::LiveState) > 0) return liveStatistics(session, range);
  return walked(session, range);
}

}  // namespace pitchboard::link

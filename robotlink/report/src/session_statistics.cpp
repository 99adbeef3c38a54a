// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/session_statistics.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <base/angles.h>
#include <robotlink/frame/working_flags.h>
#include <robotlink/session/row_slot.h>

#include "live_statistics.h"

namespace pitchboard::link {
namespace {

using telemetry::FieldMeaning;

constexpr double longestStep = 2.5;  // s; a longer gap between rows counts as absence
constexpr double centimetres = 100.0;

double quantile(std::vector<float>& values, double share) {
  const auto place = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

/// Grows with a counter that may start anew.
struct Counted {
  std::optional<double> last;
  double total = 0.0;
  void take(double value) {
    if (!std::isfinite(value)) return;
    if (last && value > *last) total += value - *last;
    last = value;
  }
};

struct Robot {
  explicit Robot(const telemetry::GroupInfo& group)
      : trueX(findSlot(group, {"TRUE_X"})),
        walked(findSlot(group, {"DISTANCE_WALKED"})),
        kicks(findSlot(group, {"KICKS"})),
        falls(findSlot(group, {"FALLS"})),
        fallen(findSlot(group, {"FALLEN", "IMU_STATE"})),
        trueBall(findSlot(group, {"TRUE_BALL_DIST"})),
        seenBall(findSlot(group, FieldMeaning::BallDistance)),
        lost(findSlot(group, {"VISION_LOST"})),
        error(findSlot(group, {"BELIEF_ERROR"})),
        x(findSlot(group, FieldMeaning::X)),
        y(findSlot(group, FieldMeaning::Y)),
        action(findSlot(group, FieldMeaning::Action)),
        flags{findSlot(group, FieldMeaning::Control), findSlot(group, FieldMeaning::Vision),
              findSlot(group, FieldMeaning::Localization), findSlot(group, FieldMeaning::Decision),
              findSlot(group, FieldMeaning::Imu)} {
    seen.fill(-1e300);
    errorSum.assign(StatisticsBuilder::parts, 0.0);
    errorCount.assign(StatisticsBuilder::parts, 0);
  }

  RowSlot trueX, walked, kicks, falls, fallen, trueBall, seenBall, lost, error, x, y, action;
  std::array<RowSlot, telemetry::processCount> flags;
  RobotSummary out;
  bool facesLeft = false;
  std::optional<double> lastTime;
  Counted distance, kicked, fell;
  std::optional<std::pair<double, double>> anchor;  // cm
  double believedWay = 0.0;                         // cm
  bool wasFallen = false, wasKicking = false;
  std::array<double, telemetry::processCount> seen;
  std::array<double, telemetry::processCount> worked{};
  std::vector<float> errors;
  std::vector<double> errorSum;
  std::vector<std::uint32_t> errorCount;
};

}  // namespace

struct StatisticsBuilder::Impl {
  struct Claim {
    Robot* robot;
    double distance;  // cm
    double seconds;
  };

  telemetry::TimeRange range;
  std::map<std::string, Robot> robots;  // by name: one robot may change its columns
  std::map<telemetry::GroupId, Robot*> byId;
  std::map<TeamColor, std::vector<double>> possession;
  std::vector<Claim> claims;  // of one time
  double claimTime = -1e300;
  std::uint64_t rows = 0;
  bool truth = false;
  std::optional<sim::Score> firstScore, lastScore;
  RowSlot scoreLeft, scoreRight;
  std::optional<telemetry::GroupId> match;

  std::size_t part(double time) const {
    const double length = range.end - range.begin;
    const double share = length > 0 ? (time - range.begin) / length : 0.0;
    return static_cast<std::size_t>(
        std::clamp(share * static_cast<double>(parts), 0.0, static_cast<double>(parts - 1)));
  }
  void settle();
  void hold(Robot& robot, double seconds);
  void addRobot(Robot& robot, const telemetry::RowView& row);
};

/// The nearest robot of one time has the ball.
void StatisticsBuilder::Impl::settle() {
  const auto nearest =
      std::min_element(claims.begin(), claims.end(),
                       [](const auto& a, const auto& b) { return a.distance < b.distance; });
  if (nearest != claims.end()) hold(*nearest->robot, nearest->seconds);
  claims.clear();
}

void StatisticsBuilder::Impl::hold(Robot& robot, double seconds) {
  robot.out.ballSeconds += seconds;
  auto& curve = possession[robot.out.team];
  curve.resize(parts, 0.0);
  curve[part(claimTime)] += seconds;
}

void StatisticsBuilder::Impl::addRobot(Robot& r, const telemetry::RowView& row) {
  const bool hasTruth = r.trueX.present();
  truth = truth || hasTruth;
  const double since = r.lastTime ? row.time - *r.lastTime : 0.0;
  const double step = since > 0.0 && since <= longestStep ? since : 0.0;
  r.lastTime = row.time;
  r.out.seconds += step;

  r.distance.take(r.walked.read(row));
  r.kicked.take(r.kicks.read(row));
  r.fell.take(r.falls.read(row));
  const bool isFallen = r.fallen.readOr(row, 0.0) != 0.0;
  if (!r.falls.present() && isFallen && !r.wasFallen) ++r.out.falls;
  r.wasFallen = isFallen;
  const bool kicking = isKick(r.action.readInt(row));
  if (!r.kicks.present() && kicking && !r.wasKicking) ++r.out.kicks;
  r.wasKicking = kicking;
  if (!r.walked.present() && std::isfinite(r.x.read(row)) && std::isfinite(r.y.read(row))) {
    const std::pair<double, double> here{r.x.read(row), r.y.read(row)};
    if (!r.anchor) r.anchor = here;
    const double way = std::hypot(here.first - r.anchor->first, here.second - r.anchor->second);
    if (way >= leastMove * centimetres) {
      r.believedWay += way;
      r.anchor = here;
    }
  }

  if (const double error = r.error.read(row); std::isfinite(error)) {
    r.errors.push_back(static_cast<float>(error));
    r.errorSum[part(row.time)] += error;
    ++r.errorCount[part(row.time)];
  }
  for (std::size_t f = 0; f < r.flags.size(); ++f) {
    const bool was = row.time - r.seen[f] <= std::max(flagMemory, step);
    if (r.flags[f].readOr(row, 0.0) != 0.0) r.seen[f] = row.time;
    if (was && step > 0.0) r.worked[f] += step;
  }

  const double reach = ballReach * centimetres;
  if (hasTruth) {
    const double distance = r.trueBall.read(row);
    if (distance <= reach && step > 0.0) claims.push_back({&r, distance, step});
  } else {
    const double distance = r.seenBall.read(row);
    if (r.lost.readOr(row, 0.0) == 0.0 && distance > 0.0 && distance <= reach) hold(r, step);
  }
}

StatisticsBuilder::StatisticsBuilder(telemetry::TimeRange range)
    : m_impl(std::make_unique<Impl>()) {
  m_impl->range = range;
}
StatisticsBuilder::~StatisticsBuilder() = default;

void StatisticsBuilder::add(telemetry::GroupId id, const telemetry::GroupInfo& group,
                            const telemetry::RowView& row) {
  Impl& impl = *m_impl;
  if (row.time < impl.range.begin || row.time > impl.range.end) return;
  ++impl.rows;
  if (row.time != impl.claimTime) {
    impl.settle();
    impl.claimTime = row.time;
  }
  auto known = impl.byId.find(id);
  if (known == impl.byId.end()) {
    Robot* robot = nullptr;
    const char* const number = attribute(group, "live") == "1" ? "number" : "robot";
    if (attributeNumber(group, number) != 0) {
      const auto [entry, isNew] = impl.robots.try_emplace(group.name, group);
      robot = &entry->second;
      if (!isNew) {
        // The same robot with other columns (another catalog): its places are looked up anew.
        Robot again(group);
        again.out = robot->out;
        again.distance = robot->distance;
        again.kicked = robot->kicked;
        again.fell = robot->fell;
        again.lastTime = robot->lastTime;
        again.believedWay = robot->believedWay;
        again.worked = robot->worked;
        again.seen = robot->seen;
        again.errors = std::move(robot->errors);
        again.errorSum = std::move(robot->errorSum);
        again.errorCount = std::move(robot->errorCount);
        *robot = std::move(again);
      }
      robot->out.name = group.name;
      robot->out.team = teamOf(group);
      robot->facesLeft = attribute(group, "imu180") == "1";
    } else if (findSlot(group, {"SCORE_LEFT"}).present()) {
      impl.match = id;
      impl.scoreLeft = findSlot(group, {"SCORE_LEFT"});
      impl.scoreRight = findSlot(group, {"SCORE_RIGHT"});
    }
    known = impl.byId.emplace(id, robot).first;
  }
  if (known->second) return impl.addRobot(*known->second, row);
  if (impl.match == id) {
    const sim::Score score{impl.scoreLeft.readInt(row), impl.scoreRight.readInt(row)};
    if (!impl.firstScore) impl.firstScore = score;
    impl.lastScore = score;
  }
}

SessionStatistics StatisticsBuilder::finish() {
  Impl& impl = *m_impl;
  impl.settle();
  SessionStatistics out;
  out.range = impl.range;
  out.truthKnown = impl.truth;
  out.rows = impl.rows;
  std::map<TeamColor, TeamSummary> teams;
  for (auto& [name, r] : impl.robots) {
    RobotSummary& s = r.out;
    if (r.walked.present()) {
      s.distance = r.distance.total;
    } else if (r.anchor) {
      s.distance = r.believedWay / centimetres;
    }
    if (r.kicks.present()) s.kicks = static_cast<std::uint32_t>(std::min(r.kicked.total, 4e9));
    if (r.falls.present()) s.falls = static_cast<std::uint32_t>(std::min(r.fell.total, 4e9));
    if (!r.errors.empty()) {
      s.errorMedian = quantile(r.errors, 0.5);
      s.error90 = quantile(r.errors, 0.9);
      for (std::size_t i = 0; i < parts; ++i) {
        s.errorCurve.push_back(r.errorCount[i] > 0 ? r.errorSum[i] / r.errorCount[i]
                                                   : std::nan(""));
      }
    }
    for (std::size_t f = 0; f < r.flags.size(); ++f) {
      if (r.flags[f].present() && s.seconds > 0.0)
        s.uptime[f] = std::min(1.0, r.worked[f] / s.seconds);
    }
    TeamSummary& team = teams[s.team];
    team.team = s.team;
    team.ballSeconds += s.ballSeconds;
    team.kicks += s.kicks;
    team.falls += s.falls;
    team.distance += s.distance.value_or(0.0);
    // The side that a team defends is told by its robots' heading at the start.
    if (impl.lastScore) {
      team.score = r.facesLeft ? impl.lastScore->right : impl.lastScore->left;
      team.scored = *team.score - (r.facesLeft ? impl.firstScore->right : impl.firstScore->left);
    }
    out.robots.push_back(s);
  }
  const double partLength = (impl.range.end - impl.range.begin) / static_cast<double>(parts);
  for (auto& [color, team] : teams) {
    const auto curve = impl.possession.find(color);
    if (curve != impl.possession.end() && partLength > 0) {
      for (const double seconds : curve->second) {
        team.ballCurve.push_back(std::min(1.0, seconds / partLength));
      }
    }
    out.teams.push_back(std::move(team));
  }
  std::stable_sort(out.robots.begin(), out.robots.end(),
                   [](const auto& a, const auto& b) { return a.team < b.team; });
  return out;
}

namespace {

template <class Source>
SessionStatistics walked(const Source& source, telemetry::TimeRange range) {
  StatisticsBuilder builder(range);
  forEachRow(source, range, [&](telemetry::GroupId id, const auto& group, const auto& row) {
    builder.add(id, group, row);
  });
  return builder.finish();
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Counts a match: goals, kicks, passes, shots, distance, time at the ball, falls, penalties, belief
// error, link quality. Reports, experiments and tournaments use it, so a match has the same numbers
// while it is played, in its recording and in an experiment. Simulated matches are measured by the
// truth, live ones by what robots believed and sent. A tally takes moments, ten a second
// (session_tally.h makes them of rows and frames). Plain values in metres and seconds; one thread
// at a time.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/report/play_follower.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

/// Number of parts of each curve.
inline constexpr std::size_t statisticsParts = 120;

/// How many of its plays there were (play_event.h).
struct PlayCounts {
  std::uint32_t passes = 0;       ///< completed
  std::uint32_t intercepted = 0;  ///< its passes that an opponent got
  std::uint32_t shots = 0, onTarget = 0, wins = 0, losses = 0;
  bool operator==(const PlayCounts&) const = default;
};

/// Where a robot was, seen as if its team always attacked to the right.
struct HeatMap {
  static constexpr double square = 0.5;  ///< m
  int columns = 0, rows = 0;             ///< from the lower left corner of the border
  std::vector<float> seconds;            ///< row by row; empty: its place was never known
};

struct RobotSummary {
  RobotUid uid;
  std::string name;     ///< of its group: "B1"
  std::string ownName;  ///< in its team's setup; may be empty
  RobotOrder order;
  TeamColor team = TeamColor::Blue;
  double seconds = 0.0;            ///< time for which there are values, s
  std::optional<double> distance;  ///< m walked (live: of its believed places, without jumps)
  std::uint32_t kicks = 0;         ///< live: kick actions that were sent
  std::uint32_t falls = 0, penalties = 0;
  PlayCounts plays;
  HeatMap heat;
  double ballSeconds = 0.0;  ///< time with the ball, s; live: by what it saw itself
  /// Of the belief, cm; needs the truth.
  std::optional<double> errorMean, errorMedian, error90, errorEnd;
  /// Share of the time in which the process worked, 0 to 1; empty if nobody tells.
  std::array<std::optional<double>, telemetry::processCount> uptime{};
  std::vector<double> errorCurve;  ///< mean belief error, cm, in equal parts of the time; NaN: none
  /// Time without messages, s: from the last one to the next one, or to the end of the range.
  struct Outage {
    double begin = 0.0, end = 0.0;
    bool isOver = false;
  };
  /// The link of a live robot.
  struct Link {
    double received = 0.0;  ///< share of the time from its first message on, 0 to 1
    std::uint64_t messages = 0;
    std::optional<double> loss;  ///< 0 to 1; empty if its messages have no numbers
    std::vector<Outage> outages;
    std::optional<double> minVolts;
  };
  std::optional<Link> link;
};

struct TeamSummary {
  TeamColor team = TeamColor::Blue;
  std::string name{};           ///< "RoboFEI"; empty: it has none
  std::optional<int> number{};  ///< the referee's; empty without a referee
  std::optional<int> score{};   ///< at the end; empty if unknown
  std::vector<int> byHalf{};    ///< goals of each half; empty if the first half was not seen
  int scored = 0;               ///< goals in this range
  double ballSeconds = 0.0;
  std::uint32_t kicks = 0, falls = 0, penalties = 0;
  PlayCounts plays;
  double distance = 0.0;          ///< m
  std::vector<double> ballCurve;  ///< share of the time with the ball, 0 to 1, in equal parts
};

struct MatchStatistics {
  telemetry::TimeRange range;  ///< s of the source
  bool truthKnown = false;
  std::uint64_t rows = 0;            ///< that were read
  std::vector<RobotSummary> robots;  ///< our team's first, then by team and number
  std::vector<TeamSummary> teams;    ///< those that have robots or a score, in the same order
  sim::FieldSpec field;
  std::vector<PlayEvent> plays;  ///< in order of time
  std::vector<GoalScene> goals;

  /// Null if there is no such robot or team.
  const RobotSummary* robot(std::string_view name) const;
  const TeamSummary* team(TeamColor team) const;
};

class MatchTally {
 public:
  explicit MatchTally(const sim::FieldSpec& field = {}) : m_field(field), m_follower(field) {}
  /// A moment that held when the counted range begins: changes count from it on.
  void begin(const TallyMoment& moment) { take(moment, true); }
  /// Moments must come in order of time.
  void add(const TallyMoment& moment) { take(moment, false); }
  /// What was counted so far. `range` is that of the curves.
  MatchStatistics statistics(telemetry::TimeRange range) const;

 private:
  /// Grows with a counter that may start again.
  struct Counter {
    std::optional<double> first, last;
    double before = 0.0;  ///< of the counts that ended
    void see(std::optional<double> value);
    double total() const { return before + (first ? *last - *first : 0.0); }
  };
  struct Robot {
    RobotSummary out;
    double lastTime = 0.0;
    Counter walked, kicks, falls;
    bool wasKicking = false, wasFallen = false, wasPenalised = false;
    std::optional<Point> anchor;                   ///< of the way of its believed places
    std::optional<std::pair<Point, double>> last;  ///< believed place, and when
    double travelled = 0.0;                        ///< m
    double present = 0.0;                          ///< s since its first message
    std::uint64_t messagesBefore = 0;
    std::uint32_t kicksBefore = 0;  ///< at the last moment
    std::array<double, telemetry::processCount> worked{}, known{};
    std::vector<std::pair<double, double>> errors;  ///< time, cm
    std::uint32_t kickCount() const;
  };
  struct Team {
    TeamSummary out;
    std::optional<int> firstScore;
    std::optional<int> lastInHalf;
  };
  struct Held {
    double time, seconds;
    TeamColor team;
  };
  void take(const TallyMoment& moment, bool isBefore);
  void takeRobot(const TallyMoment& moment, const TallyRobot& seen, bool isBefore);
  void takeWay(const TallyRobot& seen, Robot& robot);
  void takeTeam(const TallyMoment& moment, TeamColor colour, const TallyTeam& seen, bool isBefore);
  void takePlace(const TallyMoment& moment, const TallyRobot& seen, double seconds, HeatMap& heat);
  void followPlay(const TallyMoment& moment, bool isBefore);
  void countPlays(MatchStatistics& out) const;

  sim::FieldSpec m_field;
  PlayFollower m_follower;
  std::map<RobotUid, Robot> m_robots;
  std::map<TeamColor, Team> m_teams;
  std::vector<Held> m_held;
  std::optional<double> m_lastTime;  // s, of the last moment
  bool m_hasTruth = false;
};

}  // namespace pitchboard::link

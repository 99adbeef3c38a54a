// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A rerun in progress. It goes through the session in parts, so that somebody else can write a file
// meanwhile. Private to the module; one thread.

#include <chrono>
#include <map>
#include <memory>
#include <optional>

#include <robotlink/blackboard/match_number.h>
#include <robotlink/match/blackboard_bridge.h>
#include <robotlink/rerun/rerun.h>

#include "message_feed.h"
#include "recorded_cycles.h"
#include "recorded_world.h"
#include "rerun_inputs.h"
#include "rerun_rows.h"
#include "run_comparison.h"
#include "team_mates.h"

namespace pitchboard::link {

class RerunRun {
 public:
  /// `session` must outlive it.
  static Result<std::unique_ptr<RerunRun>> create(const telemetry::SessionReader& session,
                                                  const RerunOptions& options);
  static Result<RerunPlan> plan(const telemetry::SessionReader& session,
                                const RerunOptions& options);

  /// Where new rows and events go; null: nowhere.
  void setWriter(telemetry::SessionWriter* writer);
  /// Plays up to this time of the session, or a little further.
  Result<void> advanceTo(double time);
  Result<RerunResult> finish();
  double end() const { return m_end; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  RerunRun(const telemetry::SessionReader& session, const RerunOptions& options)
      : m_session(session), m_options(options) {}

  Result<void> prepare();
  Result<void> choose();
  Result<std::vector<std::string>> hearMessages();
  Result<void> chooseRange();
  bool hasSeparate() const;
  Result<void> openBoard();
  Result<void> startPrograms();
  void addPieces(double from, double until);
  void note(const std::string& sentence);

  Result<void> read(double from, double until);
  Result<void> begin(const telemetry::RowView& row);
  Result<void> takeRow(const telemetry::RowView& row);
  Result<void> tick(std::uint64_t tick, const telemetry::RowView* row);
  std::vector<std::string> running() const;
  bool hadBegun(const std::string& process) const;
  Result<void> runCycles(const telemetry::RowView& row);
  Result<void> followSides(std::uint64_t tick);
  void planWrites(std::uint64_t tick);
  void compare(const telemetry::RowView& row);
  void writeEvents();
  Result<void> pace();
  void measurePace(Time now);
  double speedNow() const;
  double played(std::uint64_t since) const {
    return static_cast<double>(m_tick - since) / m_recorded.tickRate;
  }
  bool goesOn() const;

  const telemetry::SessionReader& m_session;
  RerunOptions m_options;
  RecordedRobot m_recorded;
  RerunChoices m_chosen;
  RerunInputs m_inputs;
  std::optional<Feed> m_feed;
  RecordedWorld m_world;
  std::optional<BlackboardBridge> m_bridge;
  std::optional<TeamMates> m_mates;
  std::optional<MessageFeed> m_messages;
  bool m_missedWorld = false;
  std::map<std::string, RecordedCycles> m_cycles;    // of processes that announced them
  double m_start = 0.0, m_begin = 0.0, m_end = 0.0;  // s: played from, compared from and until
  double m_read = 0.0;                               // s: everything before it was played
  std::vector<std::string> m_notes;

  // In this order: the programs end before the blackboard is removed.
  std::optional<MatchClaim> m_claim;
  std::optional<Blackboard> m_board;
  std::vector<std::unique_ptr<RerunProgram>> m_programs;  // by their turns

  bool m_begun = false;
  std::uint64_t m_tick = 0, m_firstTick = 0;
  std::size_t m_nextPlanned = 0;  // of RecordedRobot::planned
  std::optional<RunComparison> m_comparison;
  std::optional<RerunRows> m_rows;
  double m_slack = 0.0;

  // Pace.
  double m_speed = 0.0;
  Time m_paceBegin{}, m_looked{}, m_measured{};
  std::uint64_t m_paceTick = 0, m_measuredTick = 0;
  double m_reached = 1.0;
};

}  // namespace pitchboard::link

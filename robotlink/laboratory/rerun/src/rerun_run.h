// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A rerun in progress. It goes through the session in parts, so that somebody else can write a file
// meanwhile. Private to the module; one thread.

#include <chrono>
#include <map>
#include <memory>
#include <optional>

#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/match/blackboard_bridge.h>
#include <robotlink/rerun/rerun.h>
#include <robotlink/scenario/scenario.h>

#include "feed.h"
#include "output_comparer.h"
#include "recorded_world.h"
#include "rerun_program.h"

namespace pitchboard::link {

class RerunRun {
 public:
  /// `session` must outlive it.
  static Result<std::unique_ptr<RerunRun>> create(const telemetry::SessionReader& session,
                                                  const RerunOptions& options);
  static Result<RerunPlan> plan(const telemetry::SessionReader& session,
                                const RerunOptions& options);

  /// Where new rows and events go; null: nowhere.
  void setWriter(telemetry::SessionWriter* writer) { m_writer = writer; }
  /// Plays up to this time of the session, or a little further.
  Result<void> advanceTo(double time);
  Result<RerunResult> finish();
  double end() const { return m_end; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  RerunRun(const telemetry::SessionReader& session, const RerunOptions& options)
      : m_session(session), m_options(options) {}

  Result<void> prepare();
  Result<void> findRobot();
  Result<void> readCatalog();
  Result<void> readScenario();
  Result<void> chooseRange();
  Result<void> chooseProcesses();
  Result<void> checkInputs();
  Result<void> openBoard();
  Result<void> startPrograms();
  void measureRows();
  void addPieces(double from, double until);
  void knowRobot();
  std::vector<std::string> readsOf(const RerunChoice& choice) const;
  void note(const std::string& sentence);

  Result<void> begin(const telemetry::RowView& row);
  Result<void> takeRow(const telemetry::RowView& row);
  Result<void> tick(std::uint64_t tick, const telemetry::RowView* row);
  Result<void> followSides(std::uint64_t tick);
  void planWrites(std::uint64_t tick);
  void compare(const telemetry::RowView& row);
  void compareWithLast(double time);
  void keepOutputs(double time);
  void writeRow(const telemetry::RowView& row);
  void writeEvents();
  RobotUid rerunUid() const;
  Result<void> pace();
  std::uint64_t tickOf(double time) const;
  /// What ran as this process, as RerunProcess::program; empty: the recording does not tell.
  std::string recordedProgram(const std::string& process) const;
  bool goesOn() const;

  const telemetry::SessionReader& m_session;
  RerunOptions m_options;
  telemetry::GroupId m_group = 0;
  VariableCatalog m_catalog = VariableCatalog::extended();
  std::optional<Scenario> m_scenario;
  RerunRobot m_robot;
  std::vector<RerunChoice> m_choices;
  std::optional<Feed> m_feed;
  RecordedWorld m_world;
  std::optional<BlackboardBridge> m_bridge;
  bool m_hasWorld = false;
  bool m_missedWorld = false;
  RuntimeChoice m_runtime;  // programs that the robot had in the recording; not chosen: ours
  double m_tickRate = 100.0;
  double m_rowInterval = 0.0;
  double m_start = 0.0, m_begin = 0.0, m_end = 0.0;  // s: played from, compared from and until
  double m_read = 0.0;                               // s: everything before it was played
  std::vector<std::string> m_notes, m_sampled, m_missing;

  // In this order: the programs end before the blackboard is removed.
  std::optional<MatchClaim> m_claim;
  std::optional<Blackboard> m_board;
  std::vector<std::unique_ptr<RerunProgram>> m_programs;  // by their turns

  bool m_begun = false;
  std::uint64_t m_tick = 0, m_firstTick = 0;
  std::vector<BlackboardWrite> m_planned;  // by time
  std::size_t m_nextPlanned = 0;
  std::optional<OutputComparer> m_comparer;
  std::vector<ComparedValue> m_values, m_lastValues;
  std::optional<OutputComparer> m_sinceLast;
  struct LastOutput {
    const std::vector<RerunOutputs::Change>* changes = nullptr;  // null: the last one had none
    std::size_t next = 0;                                        // of them
  };
  std::vector<LastOutput> m_last;  // for each output
  std::shared_ptr<RerunOutputs> m_outputs;
  std::vector<std::vector<RerunOutputs::Change>*> m_kept;  // in m_outputs, for each output
  std::size_t m_changes = 0;                               // that are kept
  double m_slack = 0.0;

  // Pace.
  double m_speed = 0.0;
  Time m_paceBegin{}, m_looked{}, m_measured{};
  std::uint64_t m_paceTick = 0, m_measuredTick = 0;
  double m_reached = 1.0;

  // Output.
  telemetry::SessionWriter* m_writer = nullptr;
  std::optional<telemetry::GroupId> m_written;
  std::vector<int> m_rowWords;  // of each output: its index in the words of a row; −1: it is new
  std::vector<std::uint32_t> m_words;
  std::vector<double> m_rowValues;
  std::vector<std::size_t> m_keptValues;
};

}  // namespace pitchboard::link

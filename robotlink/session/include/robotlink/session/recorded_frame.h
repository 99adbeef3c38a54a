// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rebuilds what a person saw at a recorded moment from rows: of the series store (looking back) or
// of a session file (replay). Simulated recordings have truth and blackboards, live ones what the
// robots believed. Whatever a recording does not have stays at its default and says so in the
// frame; unknown columns are passed over. Not thread-safe: one object for one source, in one
// thread.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <robotlink/session/drawing_moments.h>
#include <robotlink/session/live_moments.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/wire/profile.h>

namespace pitchboard::link {

/// What rows do not say.
struct FrameBackdrop {
  sim::FieldSpec field;
  sim::NoiseParameters noise;
  std::string physics;
  std::uint64_t seed = 0;
  double tickRate = 60.0;
  std::optional<telemetry::Profile> profile;  ///< what live robots' fields mean
  std::vector<std::string> robots;            ///< only these are shown (session_choice.h)
};

/// From the scenario and the profile that the session holds; the published field where there is
/// none.
FrameBackdrop backdropOf(const telemetry::SessionReader& session,
                         std::vector<std::string> robots = {});

class RecordedFrames {
 public:
  explicit RecordedFrames(FrameBackdrop backdrop = {});
  ~RecordedFrames();

  /// The frame of the rows at or before `time` (s of the source). A robot of a simulation is there
  /// while it has rows; a live robot from its first message on. origin is Recorded, serial grows.
  /// A session that has what was known of a live match (since 0.3) gives the frames that were seen;
  /// of an older one the frame is made of rows, which do not say all.
  MatchFrame frameAt(const telemetry::SeriesStore& rows, double time);
  MatchFrame frameAt(const telemetry::SessionReader& session, double time);
  /// Of the first one only the robots whose blackboard was read on this computer.
  std::vector<RobotFrame> attachedAt(const telemetry::SeriesStore& rows, double time);

 private:
  struct Layout;
  struct Flags;
  template <class LookBack>
  MatchFrame build(double time, LookBack&& lookBack);
  MatchFrame wholeFrameAt(const telemetry::SessionReader& session, double time);
  MatchFrame rowFrameAt(const telemetry::SessionReader& session, double time);
  const Layout& layoutOf(std::size_t group);
  void addGame(std::size_t match, MatchFrame& frame);
  void fillMatch(std::size_t group, MatchFrame& frame);
  void addRobot(std::size_t group, double time, Flags& flags, MatchFrame& frame);
  std::optional<std::size_t> linkGroupOf(const telemetry::GroupInfo& robot) const;
  void addHealth(std::size_t group, double time, const sim::FieldSpec& field, RobotFrame& robot);
  void addBoardHealth(std::size_t group, double time, const sim::FieldSpec& field,
                      RobotFrame& robot);

  FrameBackdrop m_backdrop;
  LiveMoments m_live;
  DrawingMoments m_drawings;
  std::uint64_t m_serial = 0;
  double m_lastTime = 0.0;
  std::vector<const telemetry::GroupInfo*> m_groups;  // of the frame being built
  std::vector<telemetry::SessionRow> m_rows;
  std::vector<std::shared_ptr<const telemetry::GroupView>> m_views;
  std::map<std::size_t, std::unique_ptr<Layout>> m_layouts;
  std::map<std::size_t, Flags> m_flags;
};

}  // namespace pitchboard::link

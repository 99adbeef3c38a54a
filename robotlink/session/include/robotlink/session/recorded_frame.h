// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rebuilds what a person saw at a recorded moment: of a simulated match from its rows (in the
// series store or a session file), of a live match from its datagrams. Whatever a recording does
// not have stays empty in the frame; unknown columns are passed over. Not thread-safe: one object
// for one source, in one thread.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/frame/build_robot.h>
#include <robotlink/session/drawing_moments.h>
#include <robotlink/session/live_moments.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

/// What rows do not say: from the scenario that the session holds, or its field; the published
/// field where there is none.
FrameSettings backdropOf(const telemetry::SessionReader& session);

class RecordedFrames {
 public:
  /// `robots`: of a session only these are shown (session_choice.h); empty: all.
  explicit RecordedFrames(FrameSettings settings = {}, std::vector<std::string> robots = {});
  ~RecordedFrames();

  /// The frame at `time` (s of the source): of a simulation that of the rows at or before it, in
  /// which a robot is there while it has rows; of a live match the one that was seen, made of its
  /// datagrams. origin is Recorded, serial grows.
  MatchFrame frameAt(const telemetry::SeriesStore& rows, double time);
  MatchFrame frameAt(const telemetry::SessionReader& session, double time);
  /// Only the robots whose blackboards were received (attached or sent), for joinBoards().
  std::vector<RobotFrame> boardsAt(const telemetry::SeriesStore& rows, double time);

 private:
  struct Layout;
  template <class LookBack>
  MatchFrame build(double time, LookBack&& lookBack, std::vector<RobotFrame>& boards);
  MatchFrame wholeFrameAt(const telemetry::SessionReader& session, double time);
  MatchFrame rowFrameAt(const telemetry::SessionReader& session, double time,
                        std::vector<RobotFrame>& boards);
  MatchFrame rowFrameAt(const telemetry::SeriesStore& rows, double time,
                        std::vector<RobotFrame>& boards);
  const Layout& layoutOf(std::size_t group);
  void addGame(std::size_t match, MatchFrame& frame);
  void fillMatch(std::size_t group, MatchFrame& frame, FrameSettings& settings);
  RobotFrame robotOf(std::size_t group, double time, LampMemory& lamps, MatchFrame& frame);

  FrameSettings m_given;
  std::vector<std::string> m_robots;
  std::shared_ptr<const FrameSettings> m_settings;
  LiveMoments m_live;
  DrawingMoments m_drawings;
  std::uint64_t m_serial = 0;
  double m_lastTime = 0.0;
  std::vector<const telemetry::GroupInfo*> m_groups;  // of the frame being built
  std::vector<telemetry::SessionRow> m_rows;
  std::vector<std::shared_ptr<const telemetry::GroupView>> m_views;
  std::map<std::size_t, std::unique_ptr<Layout>> m_layouts;
  std::map<std::size_t, LampMemory> m_lamps;
};

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rebuilds the frame of a recorded moment: for a simulated match from its rows (in the series store
// or a session file), for a live match from its datagrams. What a recording does not have stays
// empty in the frame; unknown columns are ignored. Not thread-safe: use one object per source, on
// one thread.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/frame/build_robot.h>
#include <robotlink/session/drawing_moments.h>
#include <robotlink/session/live_moments.h>
#include <robotlink/session/session_choice.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

/// Returns the facts that rows do not contain. They come from the session's scenario or field;
/// without these, the field is the published one.
FrameSettings backdropOf(const telemetry::SessionReader& session);

class RecordedFrames {
 public:
  /// `robots` chooses which robots of a session are shown.
  explicit RecordedFrames(FrameSettings settings = {}, RobotChoice robots = {});
  ~RecordedFrames();

  /// Returns the frame at `time` (s of the source). In a simulation it is that of the rows at or
  /// before `time`, and robots exist while they have rows; in a live match it is the frame that was
  /// shown. Its origin is Recorded, and the serial increases.
  MatchFrame frameAt(const telemetry::SeriesStore& rows, double time);
  MatchFrame frameAt(const telemetry::SessionReader& session, double time);
  /// Builds only robots whose blackboards were received (attached or sent), for joinBoards().
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
  void penaliseImported(MatchFrame& frame) const;
  void addGame(std::size_t match, MatchFrame& frame);
  void fillMatch(std::size_t group, MatchFrame& frame, FrameSettings& settings);
  RobotFrame robotOf(std::size_t group, double time, LampMemory& lamps, MatchFrame& frame);

  FrameSettings m_given;
  RobotChoice m_robots;
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

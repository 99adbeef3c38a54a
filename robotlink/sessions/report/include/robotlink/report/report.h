// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The report of a match, for coaches: a single HTML file with style, curves and pictures inside,
// for any browser, light or dark, a phone, and for printing. Plain values; any thread.

#include <string>
#include <vector>

#include <base/file_target.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/report/session_tally.h>
#include <robotlink/session/session_choice.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::link {

/// A recording of a part of the match beside the page.
struct ReportClip {
  telemetry::TimeRange range;
  std::string href;  ///< relative to the page
};

struct ReportContent {
  std::string title;               ///< title of the match
  telemetry::SessionInfo session;  ///< source, seed, wall time; an empty program is left out
  MatchStatistics statistics;
  std::vector<MatchEvent> events;
  /// A picture of the field: SVG text, or the bytes of a PNG; empty if there is none.
  std::string picture;
  std::string pictureCaption;
  std::vector<ReportClip> clips;   ///< to which moments lead
  std::vector<std::string> notes;  ///< notes for readers, e.g. that the recording was cut off
};

/// Removes other robots, with their figures and events.
void keepRobots(ReportContent& content, const RobotChoice& robots);

/// Returns the page. Texts from files or the network are escaped, and an SVG picture is shown as an
/// image, so that nothing in it can run.
std::string reportHtml(const ReportContent& content);

/// Writes the page. `source` is the session, which is refused as target. Fails as FileTarget does;
/// an existing file is unchanged then.
Result<void> writeReport(const std::string& path, const ReportContent& content,
                         IfExists ifExists = IfExists::Refuse, const std::string& source = {});

}  // namespace pitchboard::link

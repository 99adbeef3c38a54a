// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A match on one page: an HTML file that needs nothing but itself (style, curves and the picture
// are in it), for a browser of any kind, light or dark, and for printing.

#include <span>
#include <string>
#include <vector>

#include <base/file_target.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/report/session_statistics.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::link {

struct ReportContent {
  std::string title;               ///< of the match
  telemetry::SessionInfo session;  ///< source, seed, wall time; an empty program is left out
  SessionStatistics statistics;
  std::vector<MatchEvent> events;
  /// The field at a moment of the caller's choice: SVG text, or the bytes of a PNG. Empty: none.
  std::string picture;
  std::string pictureCaption;
  std::vector<std::string> notes;  ///< what a reader must know, e.g. that the recording broke off
};

/// Takes other robots out of it: their figures and events (session_choice.h).
void keepRobots(ReportContent& content, std::span<const std::string> robots);

/// The page. Everything that came from a file or the network is escaped; an SVG picture is shown as
/// an image, so that nothing in it can run.
std::string reportHtml(const ReportContent& content);

/// Writes it. `source`: the session, which is never the target. Errors as FileTarget; the old file
/// stays then.
Result<void> writeReport(const std::string& path, const ReportContent& content,
                         IfExists ifExists = IfExists::Refuse, const std::string& source = {});

}  // namespace pitchboard::link

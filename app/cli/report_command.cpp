// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_command.h"

#include <algorithm>
#include <cstdio>

#include <robotlink/report/report.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_events.h>

#include "picture_export.h"

namespace pitchboard::cli {

Result<void> exportReport(const telemetry::SessionReader& session, telemetry::TimeRange range,
                          const std::vector<std::string>& robots, const std::string& output) {
  if (output.empty()) {
    return failure(ErrorCode::InvalidArgument, "a report needs a file: add -o FILE.html");
  }
  const auto all = session.range();
  if (!all) return failure(ErrorCode::NotFound, "the recording is empty");
  const telemetry::TimeRange part{std::max(range.begin, all->begin), std::min(range.end, all->end)};
  if (!(part.begin <= part.end)) {
    return failure(ErrorCode::InvalidArgument, "this part of the recording is empty");
  }
  link::ReportContent content;
  content.session = session.info();
  content.title = session.info().title;
  content.statistics = link::statisticsOf(session, part);
  content.events = link::eventsOf(session);
  link::keepRobots(content, robots);
  content.notes = session.notes();
  if (!session.complete()) content.notes.push_back("The recording is truncated.");

  link::RecordedFrames frames(link::backdropOf(session), robots);
  const link::MatchFrame frame = frames.frameAt(session, part.end);
  if (!frame.robots.empty()) {
    if (const auto picture = svgPicture(session, part.end)) {
      content.picture = *picture;
      char caption[96];
      std::snprintf(caption, sizeof caption, "The field at %.1f s%s", part.end,
                    frame.truthKnown ? "; dashed: where the robots believe they are."
                                     : ", as reported by the robots.");
      content.pictureCaption = caption;
    } else {
      content.notes.push_back("Could not paint the field: " + picture.error().text());
    }
  }
  return link::writeReport(output, content, IfExists::Refuse, session.file().contents().name);
}

}  // namespace pitchboard::cli

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes pictures and videos of the field from a session. The studio program paints them without a
// window, so that they look like the studio and this program needs no Qt. Blocks the calling thread
// until the file is complete.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/file_target.h>
#include <telemetry/session/session_export.h>

namespace pitchboard::cli {

/// Returns whether this is "svg", "png", "mp4" or "webm".
bool isPictureFormat(std::string_view format);

struct PictureRequest {
  std::string format;
  std::optional<double> from, until;  ///< s; a picture shows `from`
  double rate = 10.0;                 ///< pictures per second of a video
  std::string output;
  std::vector<std::string> robots = {};  ///< robots to paint; empty: all
  IfExists ifExists = IfExists::Refuse;
};

/// Writes the file, which appears when it is complete. Fails with InvalidArgument, with NotFound if
/// the studio is not installed, with Conflict after an interrupt, or with SystemError and the
/// studio's message.
Result<void> exportPictures(const telemetry::SessionReader& session, const PictureRequest& request,
                            const telemetry::ExportProgress& progress);

/// Returns a picture of a moment (s) as an SVG document.
Result<std::string> svgPicture(const telemetry::SessionReader& session, double time,
                               const std::vector<std::string>& robots = {});

}  // namespace pitchboard::cli

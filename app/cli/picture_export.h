// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pictures and videos of the field from a session. The studio program paints them, offscreen: then
// they look like the studio, and nothing here needs Qt. The command's thread, which waits.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <telemetry/session/session_export.h>

namespace pitchboard::cli {

/// "svg", "png", "mp4", "webm".
bool isPictureFormat(std::string_view format);

struct PictureRequest {
  std::string format;
  std::optional<double> from, until;  ///< s; a picture is of `from`
  double rate = 10.0;                 ///< pictures a second of a video
  std::string output;
  std::vector<std::string> robots = {};  ///< only these; empty: all
};

/// The file appears when it is whole. Error InvalidArgument, NotFound without the studio, Conflict
/// when interrupted, or SystemError with what the studio said.
Result<void> exportPictures(const telemetry::SessionReader& session, const PictureRequest& request,
                            const telemetry::ExportProgress& progress);

/// A picture of a moment (s) as the text of an SVG document.
Result<std::string> svgPicture(const telemetry::SessionReader& session, double time,
                               const std::vector<std::string>& robots = {});

}  // namespace pitchboard::cli

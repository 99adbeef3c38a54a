// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pictures and videos of the field from a session, without a display: drawn as SVG here, made into
// pixels by ffmpeg. The command's thread, which waits.

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
  std::vector<std::string> robots;  ///< only these; empty: all
};

/// The file appears when it is whole. Error InvalidArgument, NotFound without ffmpeg, or as
/// FileTarget.
Result<void> exportPictures(const telemetry::SessionReader& session, const PictureRequest& request,
                            const telemetry::ExportProgress& progress);

}  // namespace pitchboard::cli

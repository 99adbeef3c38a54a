// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes upright RGB pictures of decoded frames: colour space and range as the frame says, rotated
// as a phone was held. One thread at a time; owned by its VideoFile.

#include <memory>

#include <telemetry/video/video_file.h>

struct AVFrame;
struct SwsContext;

namespace pitchboard::telemetry {

struct SwsFree {
  void operator()(SwsContext* context) const;
};

class VideoPixels {
 public:
  /// Fills size and pixels of `picture`: at most width × height pixels, upright, where `info` says
  /// the proportions and the rotation. Returns whether it could.
  bool convert(const AVFrame& frame, const VideoInfo& info, int maxWidth, int maxHeight,
               VideoPicture& picture);

 private:
  std::unique_ptr<SwsContext, SwsFree> m_scaler;
  std::vector<std::uint32_t> m_stored;  // as the camera stored it, with padding
};

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads the pictures of a video file, exact to the frame in any container and codec that FFmpeg's
// libraries read. All packets are looked through once, because only their presentation times can be
// trusted; then the picture shown at a time is decoded from the key frame before it. Seconds since
// the first picture of the video. A VideoFile belongs to one thread at a time, a worker: opening
// reads the whole file. Only info(), times() and
// indexAt() may be called on any thread. It is owned by whoever opened it.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// What a file says of its video.
struct VideoInfo {
  int width = 0, height = 0;        ///< pixels, upright and with square pixels
  int rotation = 0;                 ///< degrees clockwise by which stored pictures are turned
  double duration = 0.0;            ///< s, until the last picture ends
  double picturesPerSecond = 0.0;   ///< on average
  std::string codec;                ///< "h264"
  std::optional<WallTime> created;  ///< time of day at the first picture, as the camera wrote it
};

struct VideoPicture {
  std::size_t index = 0;              ///< of the picture that is shown, from 0
  double time = 0.0;                  ///< s, when it appears
  int width = 0, height = 0;          ///< pixels, upright
  std::vector<std::uint32_t> pixels;  ///< 0xffRRGGBB, line by line from the top
};

class VideoFile {
 public:
  /// Returns false to give up; called now and then with the share that is done.
  using Progress = std::function<bool(double)>;
  static constexpr std::size_t maxPictures = 4'000'000;  ///< 18 hours at 60 a second

  /// Opens a file and reads the times of its pictures. Fails with NotFound, Unsupported (no video,
  /// no presentation times, no decoder), ParseError (damaged), or Conflict if `progress` gave up.
  static Result<VideoFile> open(const std::string& path, const Progress& progress = {});
  VideoFile(VideoFile&&) noexcept;
  VideoFile& operator=(VideoFile&&) noexcept;
  ~VideoFile();

  const VideoInfo& info() const;
  /// Returns when each picture appears, in order; the first at 0 s.
  std::span<const double> times() const;
  /// Returns the picture shown at this time; the first before the video, the last after it.
  std::size_t indexAt(double time) const;
  /// Returns a picture, scaled down so that it fits into this size (pixels; 0: as it is). Of
  /// pictures that the file has lost, it returns the one before. Fails with InvalidArgument for
  /// an index that does not exist, ParseError if nothing can be decoded, or Conflict if `progress`
  /// gave up.
  Result<VideoPicture> picture(std::size_t index, int maxWidth = 0, int maxHeight = 0,
                               const Progress& progress = {});

 private:
  struct Parts;
  explicit VideoFile(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pitchboard::telemetry

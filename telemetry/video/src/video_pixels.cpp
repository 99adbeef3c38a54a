// SPDX-License-Identifier: GPL-3.0-or-later
#include "video_pixels.h"

#include <algorithm>
#include <cmath>

extern "C" {
#include <libavutil/frame.h>
#include <libswscale/swscale.h>
}

namespace pitchboard::telemetry {
namespace {

bool isFullRange(const AVFrame& frame) {
  switch (frame.format) {
    case AV_PIX_FMT_YUVJ420P:
    case AV_PIX_FMT_YUVJ422P:
    case AV_PIX_FMT_YUVJ444P:
    case AV_PIX_FMT_YUVJ440P:
      return true;
    default:
      return frame.color_range == AVCOL_RANGE_JPEG;
  }
}

/// Files without a colour space mean that of their size.
int matrixOf(const AVFrame& frame) {
  constexpr int firstOfHd = 720;  // lines
  if (frame.colorspace != AVCOL_SPC_UNSPECIFIED) return frame.colorspace;
  return frame.height >= firstOfHd ? SWS_CS_ITU709 : SWS_CS_ITU601;
}

/// swscale ignores what the frame says of its colours.
void setColours(SwsContext* scaler, const AVFrame& frame) {
  constexpr int neutral = 1 << 16;
  const int* matrix = sws_getCoefficients(matrixOf(frame));
  sws_setColorspaceDetails(scaler, matrix, isFullRange(frame) ? 1 : 0, matrix, 1, 0, neutral,
                           neutral);
}

/// Copies `from` (lines of `stride` pixels), turned clockwise, to a picture of width × height.
void turn(const std::vector<std::uint32_t>& from, std::size_t stride, int rotation,
          VideoPicture& to) {
  const auto width = static_cast<std::size_t>(to.width),
             height = static_cast<std::size_t>(to.height);
  to.pixels.resize(width * height);
  for (std::size_t y = 0; y < height; ++y) {
    std::uint32_t* line = to.pixels.data() + y * width;
    const std::uint32_t* const all = from.data();
    switch (rotation) {
      case 90:
        for (std::size_t x = 0; x < width; ++x) line[x] = all[(width - 1 - x) * stride + y];
        break;
      case 180:
        for (std::size_t x = 0; x < width; ++x)
          line[x] = all[(height - 1 - y) * stride + (width - 1 - x)];
        break;
      case 270:
        for (std::size_t x = 0; x < width; ++x) line[x] = all[x * stride + (height - 1 - y)];
        break;
      default:
        std::copy_n(all + y * stride, width, line);
    }
  }
}

}  // namespace

void SwsFree::operator()(SwsContext* context) const {
  sws_freeContext(context);
}

bool VideoPixels::convert(const AVFrame& frame, const VideoInfo& info, int maxWidth, int maxHeight,
                          VideoPicture& picture) {
  double scale = 1.0;
  if (maxWidth > 0) scale = std::min(scale, static_cast<double>(maxWidth) / info.width);
  if (maxHeight > 0) scale = std::min(scale, static_cast<double>(maxHeight) / info.height);
  picture.width = std::max(1, static_cast<int>(std::lround(info.width * scale)));
  picture.height = std::max(1, static_cast<int>(std::lround(info.height * scale)));
  const bool lies = info.rotation == 90 || info.rotation == 270;
  const int width = lies ? picture.height : picture.width;
  const int height = lies ? picture.width : picture.height;
  // The same as before, unless the size changed.
  m_scaler.reset(sws_getCachedContext(
      m_scaler.release(), frame.width, frame.height, static_cast<AVPixelFormat>(frame.format),
      width, height, AV_PIX_FMT_RGB32, SWS_BICUBIC | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
  if (m_scaler == nullptr) return false;
  setColours(m_scaler.get(), frame);
  // swscale writes whole vectors, also at the end of a line.
  constexpr std::size_t vector = 16;  // pixels
  const std::size_t stride = (static_cast<std::size_t>(width) + vector - 1) / vector * vector;
  m_stored.assign(stride * static_cast<std::size_t>(height) + vector, 0xff000000u);
  std::uint8_t* const planes[4]{reinterpret_cast<std::uint8_t*>(m_stored.data()), nullptr, nullptr,
                                nullptr};
  const int strides[4]{static_cast<int>(stride * sizeof(std::uint32_t)), 0, 0, 0};
  if (sws_scale(m_scaler.get(), frame.data, frame.linesize, 0, frame.height, planes, strides) <=
      0) {
    return false;
  }
  turn(m_stored, stride, info.rotation, picture);
  return true;
}

}  // namespace pitchboard::telemetry

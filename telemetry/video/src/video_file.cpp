// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/video/video_file.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <thread>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/imgutils.h>
#include <libavutil/parseutils.h>
}

#include <base/try.h>

#include "video_pixels.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t maxKeptBytes = std::size_t{160} << 20;  // of decoded pictures
constexpr std::int64_t maxVideoPixels = std::int64_t{8192} * 8192;
constexpr std::size_t quickerThanSeeking = 8;  // pictures
constexpr int packetsBetweenReports = 64;

struct VideoFree {
  void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};
template <class T>
using Owned = std::unique_ptr<T, VideoFree>;
using DecodedFrame = std::shared_ptr<AVFrame>;

std::string reasonOf(int error) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(error, text, sizeof text);
  return text;
}

Error cancelledVideo(const std::string& path) {
  return {ErrorCode::Conflict, "Reading the video was cancelled.", path};
}

Result<Owned<AVFormatContext>> openFormat(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return failure(ErrorCode::NotFound,
                   "This video does not exist. Move it back, or choose another file.", path);
  }
  if (!std::filesystem::is_regular_file(path, ignored)) {
    return failure(ErrorCode::Unsupported, "This is not a file. Choose a video file.", path);
  }
  AVFormatContext* opened = nullptr;
  AVDictionary* options = nullptr;
  // A play list must not lead to the network.
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  const int error = avformat_open_input(&opened, ("file:" + path).c_str(), nullptr, &options);
  av_dict_free(&options);
  Owned<AVFormatContext> format(opened);
  if (error < 0) {
    return failure(ErrorCode::ParseError,
                   "This file cannot be read as a video (" + reasonOf(error) +
                       "). Choose another file, or convert it to MP4.",
                   path);
  }
  if (avformat_find_stream_info(format.get(), nullptr) < 0) {
    return failure(ErrorCode::ParseError, "The video is damaged. Choose another file.", path);
  }
  return format;
}

Result<Owned<AVCodecContext>> openDecoder(const AVStream& stream, const AVCodec* decoder,
                                          const std::string& path) {
  const char* name = avcodec_get_name(stream.codecpar->codec_id);
  const auto unsupported = [&] {
    return failure(ErrorCode::Unsupported,
                   std::string("There is no decoder for ") + name +
                       " on this computer. Convert the video to MP4 with H.264.",
                   path);
  };
  if (decoder == nullptr) return unsupported();
  Owned<AVCodecContext> codec(avcodec_alloc_context3(decoder));
  if (codec == nullptr || avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0) {
    return unsupported();
  }
  constexpr unsigned mostThreads = 4;
  codec->thread_count =
      static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, mostThreads));
  codec->pkt_timebase = stream.time_base;
  codec->max_pixels = maxVideoPixels;
  if (avcodec_open2(codec.get(), decoder, nullptr) < 0) return unsupported();
  return codec;
}

/// Degrees clockwise by which pictures are turned for display: a multiple of 90.
int rotationOf(const AVStream& stream) {
#if LIBAVCODEC_VERSION_MAJOR >= 61
  const AVPacketSideData* data =
      av_packet_side_data_get(stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data,
                              AV_PKT_DATA_DISPLAYMATRIX);
  const std::uint8_t* matrix = data == nullptr ? nullptr : data->data;
#else
  const std::uint8_t* matrix = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
#endif
  if (matrix == nullptr) return 0;
  const double left = av_display_rotation_get(reinterpret_cast<const std::int32_t*>(matrix));
  if (!std::isfinite(left)) return 0;
  return static_cast<int>(((std::lround(-left / 90.0) * 90) % 360 + 360) % 360);
}

std::optional<WallTime> createdOf(const AVFormatContext& format, const AVStream& stream) {
  // The first one has the time zone, where it exists.
  const std::pair<const AVDictionary*, const char*> places[]{
      {format.metadata, "com.apple.quicktime.creationdate"},
      {stream.metadata, "creation_time"},
      {format.metadata, "creation_time"}};
  constexpr std::int64_t unlikely = 946684800000000;  // µs, the year 2000: a clock that was not set
  for (const auto& [metadata, key] : places) {
    const AVDictionaryEntry* entry = av_dict_get(metadata, key, nullptr, 0);
    std::int64_t micros = 0;
    if (entry == nullptr || av_parse_time(&micros, entry->value, 0) < 0) continue;
    if (micros > unlikely) return WallTime(std::chrono::microseconds(micros));
  }
  return {};
}

VideoInfo infoOf(AVFormatContext& format, AVStream& stream) {
  VideoInfo info;
  info.rotation = rotationOf(stream);
  info.width = stream.codecpar->width;
  info.height = stream.codecpar->height;
  const AVRational aspect = av_guess_sample_aspect_ratio(&format, &stream, nullptr);
  if (aspect.num > 0 && aspect.den > 0) {
    const double wide = std::clamp(av_q2d(aspect), 0.1, 10.0);
    info.width = static_cast<int>(std::lround(info.width * wide));
  }
  if (info.rotation == 90 || info.rotation == 270) std::swap(info.width, info.height);
  info.codec = avcodec_get_name(stream.codecpar->codec_id);
  info.created = createdOf(format, stream);
  return info;
}

/// Where decoding can begin.
struct KeyPicture {
  std::int64_t pts = 0, seekTo = 0;
};

struct PictureIndex {
  std::vector<std::int64_t> pts;  // of all pictures, in order
  std::vector<KeyPicture> keys;   // in order of pts
};

/// Reads all packets. Times that a container says of itself are often wrong.
Result<PictureIndex> readIndex(AVFormatContext& format, int stream, const std::string& path,
                               const VideoFile::Progress& progress) {
  PictureIndex index;
  std::optional<KeyPicture> first;
  std::size_t untimed = 0;
  const Owned<AVPacket> packet(av_packet_alloc());
  const auto size = static_cast<double>(std::max<std::int64_t>(1, avio_size(format.pb)));
  for (std::size_t count = 0; av_read_frame(&format, packet.get()) >= 0; ++count) {
    if (progress && count % packetsBetweenReports == 0 &&
        !progress(std::clamp(static_cast<double>(avio_tell(format.pb)) / size, 0.0, 1.0))) {
      return tl::unexpected(cancelledVideo(path));
    }
    const bool isOurs = packet->stream_index == stream;
    const std::int64_t pts = packet->pts, dts = packet->dts;
    const int flags = packet->flags;
    av_packet_unref(packet.get());
    if (!isOurs) continue;
    if (pts == AV_NOPTS_VALUE) {
      ++untimed;
      continue;
    }
    const KeyPicture here{pts, dts == AV_NOPTS_VALUE ? pts : dts};
    if (!first) first = here;
    if ((flags & AV_PKT_FLAG_KEY) != 0) index.keys.push_back(here);
    // What an editor cut away is only decoded.
    if ((flags & AV_PKT_FLAG_DISCARD) == 0) index.pts.push_back(pts);
    if (index.pts.size() > VideoFile::maxPictures) {
      return failure(ErrorCode::Unsupported,
                     "The video has more than 4 million pictures. Cut it into shorter ones.", path);
    }
  }
  if (index.pts.size() <= untimed) {
    return failure(untimed == 0 ? ErrorCode::ParseError : ErrorCode::Unsupported,
                   untimed == 0 ? "The video has no pictures. Choose another file."
                                : "The video does not say when its pictures are shown. Convert it "
                                  "to MP4.",
                   path);
  }
  if (index.keys.empty()) index.keys.push_back(*first);
  std::ranges::sort(index.keys, {}, &KeyPicture::pts);
  std::ranges::sort(index.pts);
  index.pts.erase(std::unique(index.pts.begin(), index.pts.end()), index.pts.end());
  // Pictures that need others from before the beginning cannot be decoded.
  const auto begin = std::ranges::lower_bound(index.pts, index.keys.front().pts);
  if (begin != index.pts.end()) index.pts.erase(index.pts.begin(), begin);
  return index;
}

std::int64_t timeStampOf(const AVFrame& frame) {
  return frame.pts != AV_NOPTS_VALUE ? frame.pts : frame.best_effort_timestamp;
}

}  // namespace

struct VideoFile::Parts {
  std::string path;
  Owned<AVFormatContext> format;
  Owned<AVCodecContext> codec;
  Owned<AVPacket> packet{av_packet_alloc()};
  int stream = -1;
  VideoInfo info;
  PictureIndex index;
  std::vector<double> times;
  VideoPixels pixels;
  // The decoder stands behind this picture; null after a seek, and before the first.
  DecodedFrame last;
  bool isAtEnd = false, isReading = false;
  std::deque<DecodedFrame> kept;  // in the order in which they were decoded
  std::size_t keptBytes = 0;

  DecodedFrame find(std::int64_t pts) const {
    const auto found = std::ranges::find_if(
        kept, [pts](const DecodedFrame& frame) { return timeStampOf(*frame) == pts; });
    return found == kept.end() ? nullptr : *found;
  }

  static std::size_t bytesOf(const AVFrame& frame) {
    const int bytes = av_image_get_buffer_size(static_cast<AVPixelFormat>(frame.format),
                                               frame.width, frame.height, 1);
    return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
  }

  void keep(const DecodedFrame& frame) {
    kept.push_back(frame);
    keptBytes += bytesOf(*frame);
    while (keptBytes > maxKeptBytes && kept.size() > 2) {
      keptBytes -= bytesOf(*kept.front());
      kept.pop_front();
    }
  }

  /// Gives the decoder the next packet; at the end, that there is none.
  void feed() {
    while (av_read_frame(format.get(), packet.get()) >= 0) {
      const bool isOurs = packet->stream_index == stream;
      // Damaged packets are skipped: later ones may be whole.
      if (isOurs) avcodec_send_packet(codec.get(), packet.get());
      av_packet_unref(packet.get());
      if (isOurs) return;
    }
    avcodec_send_packet(codec.get(), nullptr);
    isAtEnd = true;
  }

  /// Returns the next picture in order of time; null at the end.
  Result<DecodedFrame> next(const Progress& progress) {
    const DecodedFrame frame(av_frame_alloc(), VideoFree());
    for (;;) {
      const int got = avcodec_receive_frame(codec.get(), frame.get());
      if (got == 0) return frame;
      if (got == AVERROR_EOF || isAtEnd) return DecodedFrame();
      if (progress && !progress(0.0)) return tl::unexpected(cancelledVideo(path));
      feed();
    }
  }

  bool seek(const KeyPicture& key) {
    last.reset();
    isAtEnd = false;
    isReading = av_seek_frame(format.get(), stream, key.seekTo, AVSEEK_FLAG_BACKWARD) >= 0;
    avcodec_flush_buffers(codec.get());
    return isReading;
  }

  /// Decodes up to this picture and returns it, or the last one before it. Null: all that came was
  /// later.
  Result<DecodedFrame> decodeTo(std::int64_t pts, const Progress& progress) {
    DecodedFrame shown = last;
    for (;;) {
      DecodedFrame frame = TRY(next(progress));
      if (frame == nullptr) return shown;
      keep(frame);
      last = frame;
      if (timeStampOf(*frame) == pts) return frame;
      if (timeStampOf(*frame) > pts) return shown;
      shown = std::move(frame);
    }
  }

  /// Whether the decoder gets there by going on, sooner than from a key picture.
  bool isAhead(std::int64_t pts, const KeyPicture& key) const {
    if (!isReading || last == nullptr || timeStampOf(*last) >= pts) return false;
    if (key.pts <= timeStampOf(*last)) return true;
    const auto from = std::ranges::lower_bound(index.pts, timeStampOf(*last));
    const auto to = std::ranges::lower_bound(index.pts, pts);
    return static_cast<std::size_t>(to - from) <= quickerThanSeeking;
  }

  Result<DecodedFrame> decode(std::int64_t pts, const Progress& progress) {
    if (DecodedFrame found = find(pts)) return found;
    auto key = std::ranges::upper_bound(index.keys, pts, {}, &KeyPicture::pts);
    if (key != index.keys.begin()) --key;
    if (isAhead(pts, *key)) {
      if (DecodedFrame shown = TRY(decodeTo(pts, progress))) return shown;
    }
    // Once is enough, unless a key picture is damaged.
    for (int attempts = 0; attempts < 4; ++attempts) {
      if (!seek(*key)) break;
      if (DecodedFrame shown = TRY(decodeTo(pts, progress))) return shown;
      if (key == index.keys.begin()) break;
      --key;
    }
    return failure(ErrorCode::ParseError,
                   "The picture cannot be decoded: the video is damaged here. Choose another "
                   "moment.",
                   path);
  }
};

VideoFile::VideoFile(std::unique_ptr<Parts> parts) : m_parts(std::move(parts)) {}
VideoFile::VideoFile(VideoFile&&) noexcept = default;
VideoFile& VideoFile::operator=(VideoFile&&) noexcept = default;
VideoFile::~VideoFile() = default;

Result<VideoFile> VideoFile::open(const std::string& path, const Progress& progress) {
  static std::once_flag once;
  // The library would print every damaged packet.
  std::call_once(once, [] { av_log_set_level(AV_LOG_QUIET); });
  auto parts = std::make_unique<Parts>();
  parts->path = path;
  parts->format = TRY(openFormat(path));
  AVFormatContext& format = *parts->format;
  const AVCodec* decoder = nullptr;
  parts->stream = av_find_best_stream(&format, AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
  if (parts->stream == AVERROR_DECODER_NOT_FOUND) {
    parts->stream = av_find_best_stream(&format, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  }
  if (parts->stream < 0) {
    return failure(ErrorCode::Unsupported, "This file contains no video. Choose another file.",
                   path);
  }
  for (unsigned i = 0; i < format.nb_streams; ++i) {
    if (static_cast<int>(i) != parts->stream) format.streams[i]->discard = AVDISCARD_ALL;
  }
  AVStream& stream = *format.streams[parts->stream];
  parts->codec = TRY(openDecoder(stream, decoder, path));
  parts->info = infoOf(format, stream);
  if (parts->info.width <= 0 || parts->info.height <= 0) {
    return failure(ErrorCode::ParseError, "The video does not say how large its pictures are.",
                   path);
  }
  parts->index = TRY(readIndex(format, parts->stream, path, progress));
  const double second = av_q2d(stream.time_base);
  const std::vector<std::int64_t>& pts = parts->index.pts;
  parts->times.reserve(pts.size());
  for (const std::int64_t one : pts) {
    parts->times.push_back(static_cast<double>(one - pts.front()) * second);
  }
  const double lasts = parts->times.back();
  const double usual = av_q2d(stream.avg_frame_rate);
  parts->info.picturesPerSecond = lasts > 0.0 ? static_cast<double>(pts.size() - 1) / lasts
                                  : usual > 0 ? usual
                                              : 1.0;
  parts->info.duration = lasts + 1.0 / parts->info.picturesPerSecond;
  return VideoFile(std::move(parts));
}

const VideoInfo& VideoFile::info() const {
  return m_parts->info;
}

std::span<const double> VideoFile::times() const {
  return m_parts->times;
}

std::size_t VideoFile::indexAt(double time) const {
  constexpr double rounding = 1e-6;  // s: a time that was computed from that of a picture
  const auto& times = m_parts->times;
  const auto after = std::ranges::upper_bound(times, time + rounding);
  return after == times.begin() ? 0 : static_cast<std::size_t>(after - times.begin()) - 1;
}

Result<VideoPicture> VideoFile::picture(std::size_t index, int maxWidth, int maxHeight,
                                        const Progress& progress) {
  Parts& parts = *m_parts;
  if (index >= parts.index.pts.size()) {
    return failure(ErrorCode::InvalidArgument,
                   "The video has only " + std::to_string(parts.index.pts.size()) + " pictures.",
                   parts.path);
  }
  const DecodedFrame frame = TRY(parts.decode(parts.index.pts[index], progress));
  VideoPicture picture;
  const auto shown = std::ranges::lower_bound(parts.index.pts, timeStampOf(*frame));
  picture.index = std::min(static_cast<std::size_t>(shown - parts.index.pts.begin()),
                           parts.index.pts.size() - 1);
  picture.time = parts.times[picture.index];
  if (!parts.pixels.convert(*frame, parts.info, maxWidth, maxHeight, picture)) {
    return failure(ErrorCode::Unsupported,
                   "The colours of this video cannot be shown. Convert it to MP4 with H.264.",
                   parts.path);
  }
  return picture;
}

}  // namespace pitchboard::telemetry

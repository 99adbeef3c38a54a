// SPDX-License-Identifier: GPL-3.0-or-later
#include "message_decoder.h"

#include <algorithm>
#include <array>

namespace pitchboard::telemetry {

Result<std::unique_ptr<MessageDecoder>> makeDecoder(const MessageSchema& schema) {
  struct Row {
    std::string_view messageEncoding;
    Result<std::unique_ptr<MessageDecoder>> (*make)(const MessageSchema&);
  };
  static constexpr std::array<Row, 4> rows{{{"cdr", makeRosDecoder},
                                            {"ros1", makeRosDecoder},
                                            {"json", makeJsonDecoder},
                                            {"protobuf", makeProtobufDecoder}}};
  const auto row = std::ranges::find(rows, schema.messageEncoding, &Row::messageEncoding);
  if (row != rows.end()) return row->make(schema);
  return failure(ErrorCode::Unsupported, "The encoding \"" +
                                             std::string(schema.messageEncoding.substr(0, 40)) +
                                             "\" is not supported.");
}

std::string shortType(std::string_view type) {
  std::string text(type.substr(0, 200));
  for (const std::string_view middle : {"/msg/", "::msg::", "::msg::dds_::"}) {
    const auto at = text.find(middle);
    if (at != text.npos) return text.substr(0, at) + "/" + text.substr(at + middle.size());
  }
  return text;
}

bool isBulkType(std::string_view type) {
  static constexpr std::array<std::string_view, 18> types{
      "sensor_msgs/Image",
      "sensor_msgs/CompressedImage",
      "sensor_msgs/PointCloud",
      "sensor_msgs/PointCloud2",
      "stereo_msgs/DisparityImage",
      "theora_image_transport/Packet",
      "ffmpeg_image_transport_msgs/FFMPEGPacket",
      "point_cloud_interfaces/CompressedPointCloud2",
      "nav_msgs/OccupancyGrid",
      "foxglove.CompressedImage",
      "foxglove.CompressedVideo",
      "foxglove.RawImage",
      "foxglove.PointCloud",
      "foxglove_msgs/CompressedImage",
      "foxglove_msgs/CompressedVideo",
      "foxglove_msgs/RawImage",
      "foxglove_msgs/PointCloud",
      "audio_common_msgs/AudioData"};
  return std::ranges::find(types, type) != types.end();
}

}  // namespace pitchboard::telemetry

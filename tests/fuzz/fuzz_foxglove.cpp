// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as what a program sends that speaks Foxglove's protocol. The first byte says how: one
// text or binary frame of a server or a client, a source as people write it, or frames (each after
// its kind and two bytes of length) of which Live makes channels, messages and robots.
#include <cstdlib>
#include <memory>
#include <string_view>

#include <robotlink/live/live_pipeline.h>
#include <telemetry/foxglove/foxglove_frames.h>
#include <telemetry/foxglove/foxglove_requests.h>

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

/// What the client makes of frames, without a network: a subscription has the id of its channel.
void converse(std::string_view bytes) {
  link::LiveOptions options;
  const link::FoxgloveSource source = link::parseFoxgloveSource("robot3").value();
  options.foxglove = {source};
  link::LivePipeline pipeline(options, WallTime());
  std::uint64_t session = 0;
  std::int64_t now = 0;
  for (int frames = 0; bytes.size() > 3 && frames < 50; ++frames) {
    const bool isText = (static_cast<unsigned char>(bytes[0]) & 1U) == 0;
    const auto size = static_cast<std::size_t>(static_cast<unsigned char>(bytes[1])) +
                      (static_cast<std::size_t>(static_cast<unsigned char>(bytes[2])) << 8U);
    const std::string_view content = bytes.substr(3, size);
    bytes.remove_prefix(std::min(bytes.size(), 3 + size));
    const WallTime arrival{Duration(now += 10'000'000)};
    const auto frame = isText ? parseFoxgloveText(content) : parseFoxgloveBinary(content);
    if (!frame) continue;
    if (std::holds_alternative<FoxgloveServerInfo>(*frame)) {
      pipeline.take(source, FoxgloveBegun{++session, "server"});
    } else if (const auto* added = std::get_if<FoxgloveAdvertise>(&*frame)) {
      const auto request = pipeline.take(source, FoxgloveChannelsAdded{added->channels});
      if (request.channels.size() > added->channels.size()) std::abort();
    } else if (const auto* removed = std::get_if<FoxgloveUnadvertise>(&*frame)) {
      pipeline.take(source, FoxgloveChannelsRemoved{removed->channels});
    } else if (const auto* message = std::get_if<FoxgloveMessage>(&*frame)) {
      pipeline.take(source, FoxgloveReceived{message->subscription, message->logTime, arrival,
                                             std::string(message->payload)});
    }
    const auto made = pipeline.advance(arrival);
    for (const link::RobotFrame& robot : made.robots) {
      if (!robot.link || robot.name.empty()) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 't':
      (void)parseFoxgloveText(bytes);
      break;
    case 'b':
      (void)parseFoxgloveBinary(bytes);
      break;
    case 's':
      if (const auto source = link::parseFoxgloveSource(bytes)) {
        if (link::parseFoxgloveSource(link::foxgloveSourceText(*source)) != *source) std::abort();
      }
      break;
    case 'q':
      (void)parseFoxgloveRequest(bytes);
      break;
    case 'c':
      (void)parseFoxgloveControl(bytes);
      break;
    default:
      converse(bytes);
      break;
  }
  return 0;
}

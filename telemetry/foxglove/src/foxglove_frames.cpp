// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/foxglove/foxglove_frames.h>

#include <nlohmann/json.hpp>

#include <limits>
#include <optional>

#include <base/base64.h>

namespace pitchboard::telemetry {
namespace {

using Json = nlohmann::json;

tl::unexpected<Error> badFrame(std::string what) {
  return failure(ErrorCode::ParseError, std::move(what));
}

/// Empty if it is missing or is no text.
std::string textAt(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<std::uint32_t> channelIdOf(const Json& json) {
  if (!json.is_number_integer()) return {};
  // Negative numbers are large ones here.
  const auto number = json.get<std::uint64_t>();
  if (number > std::numeric_limits<std::uint32_t>::max()) return {};
  return static_cast<std::uint32_t>(number);
}

/// What servers leave out.
std::string_view usualSchemaEncoding(std::string_view encoding) {
  if (encoding == "cdr") return "ros2msg";
  if (encoding == "ros1") return "ros1msg";
  if (encoding == "json") return "jsonschema";
  return encoding;
}

Result<FoxgloveChannel> channelOf(const Json& json) {
  if (!json.is_object()) return badFrame("A channel in advertise is not an object.");
  const auto id = json.find("id");
  const auto number = id == json.end() ? std::nullopt : channelIdOf(*id);
  if (!number) return badFrame("A channel in advertise has no valid id.");
  FoxgloveChannel channel;
  channel.id = *number;
  channel.topic = textAt(json, "topic");
  channel.encoding = textAt(json, "encoding");
  channel.schemaName = textAt(json, "schemaName");
  channel.schema = textAt(json, "schema");
  channel.schemaEncoding = textAt(json, "schemaEncoding");
  if (channel.topic.empty() || channel.encoding.empty()) {
    return badFrame("Channel " + std::to_string(channel.id) +
                    " in advertise has no topic or no encoding.");
  }
  if (channel.schemaEncoding.empty() && !channel.schema.empty()) {
    channel.schemaEncoding = usualSchemaEncoding(channel.encoding);
  }
  if (channel.schemaEncoding == "protobuf" || channel.schemaEncoding == "flatbuffer") {
    auto bytes = fromBase64(channel.schema);
    if (!bytes) return badFrame("The schema of " + channel.topic + " is not valid Base64.");
    channel.schema = std::move(*bytes);
  }
  return channel;
}

Result<FoxgloveFrame> advertiseOf(const Json& json) {
  const auto list = json.find("channels");
  if (list == json.end() || !list->is_array())
    return badFrame("advertise has no list of channels.");
  FoxgloveAdvertise out;
  for (const Json& one : *list) {
    auto channel = channelOf(one);
    if (channel) {
      out.channels.push_back(std::move(*channel));
    } else {
      ++out.refused;
      out.reason = channel.error().message;
    }
  }
  return out;
}

Result<FoxgloveFrame> unadvertiseOf(const Json& json) {
  const auto list = json.find("channelIds");
  if (list == json.end() || !list->is_array()) return badFrame("unadvertise has no channelIds.");
  FoxgloveUnadvertise out;
  for (const Json& one : *list) {
    const auto id = channelIdOf(one);
    if (!id) return badFrame("unadvertise has an id that is not valid.");
    out.channels.push_back(*id);
  }
  return out;
}

template <class Number>
Number littleEndian(std::string_view bytes) {
  Number number = 0;
  for (std::size_t i = sizeof(Number); i > 0; --i) {
    number = static_cast<Number>(number << 8U) | static_cast<unsigned char>(bytes[i - 1]);
  }
  return number;
}

}  // namespace

Result<FoxgloveFrame> parseFoxgloveText(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return badFrame("A text frame is not valid JSON.");
  if (!json.is_object()) return badFrame("A text frame is not a JSON object.");
  const std::string op = textAt(json, "op");
  if (op.empty()) return badFrame("A text frame has no \"op\".");
  if (op == "serverInfo")
    return FoxgloveServerInfo{textAt(json, "name"), textAt(json, "sessionId")};
  if (op == "advertise") return advertiseOf(json);
  if (op == "unadvertise") return unadvertiseOf(json);
  if (op == "status") {
    FoxgloveStatusText status{0, textAt(json, "message")};
    const auto level = json.find("level");
    if (level != json.end() && level->is_number_integer()) {
      const auto number = level->get<std::int64_t>();
      status.level = number == 1 ? 1 : number == 2 ? 2 : 0;
    }
    return status;
  }
  return FoxgloveOther{};
}

Result<FoxgloveFrame> parseFoxgloveBinary(std::string_view bytes) {
  constexpr char messageData = 1;
  constexpr std::size_t headBytes = 1 + sizeof(std::uint32_t) + sizeof(std::uint64_t);
  if (bytes.empty()) return badFrame("A binary frame is empty.");
  if (bytes[0] != messageData) return FoxgloveOther{};
  if (bytes.size() < headBytes) {
    return badFrame("A message has " + std::to_string(bytes.size()) +
                    " bytes; its head alone has 13.");
  }
  return FoxgloveMessage{littleEndian<std::uint32_t>(bytes.substr(1)),
                         littleEndian<std::uint64_t>(bytes.substr(5)), bytes.substr(headBytes)};
}

std::string foxgloveSubscribe(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs) {
  Json list = Json::array();
  for (const auto& [id, channel] : pairs) list.push_back({{"id", id}, {"channelId", channel}});
  return Json{{"op", "subscribe"}, {"subscriptions", std::move(list)}}.dump();
}

}  // namespace pitchboard::telemetry

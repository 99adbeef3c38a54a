// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/foxglove/foxglove_requests.h>

#include <nlohmann/json.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace pitchboard::telemetry {
namespace {

using RequestJson = nlohmann::json;

constexpr std::uint64_t nanosecondsPerSecond = 1'000'000'000;
constexpr std::size_t maxRequestId = 256;  // bytes

tl::unexpected<Error> badRequest(std::string what) {
  return failure(ErrorCode::ParseError, std::move(what));
}

std::optional<std::uint32_t> idAt(const RequestJson& object, const char* key) {
  const RequestJson* number = &object;
  if (key != nullptr) {
    if (!object.is_object() || !object.contains(key)) return {};
    number = &object[key];
  }
  if (!number->is_number_unsigned()) return {};
  const auto value = number->get<std::uint64_t>();
  if (value > std::numeric_limits<std::uint32_t>::max()) return {};
  return static_cast<std::uint32_t>(value);
}

Result<FoxgloveRequest> subscribeOf(const RequestJson& json) {
  const auto list = json.find("subscriptions");
  if (list == json.end() || !list->is_array()) {
    return badRequest("subscribe has no list of subscriptions.");
  }
  FoxgloveSubscribe out;
  for (const RequestJson& one : *list) {
    const auto id = idAt(one, "id"), channel = idAt(one, "channelId");
    if (!id || !channel) return badRequest("A subscription needs an id and a channelId.");
    out.pairs.emplace_back(*id, *channel);
  }
  return out;
}

Result<FoxgloveRequest> unsubscribeOf(const RequestJson& json) {
  const auto list = json.find("subscriptionIds");
  if (list == json.end() || !list->is_array()) {
    return badRequest("unsubscribe has no subscriptionIds.");
  }
  FoxgloveUnsubscribe out;
  for (const RequestJson& one : *list) {
    const auto id = idAt(one, nullptr);
    if (!id) return badRequest("unsubscribe has an id that is not valid.");
    out.subscriptions.push_back(*id);
  }
  return out;
}

template <class Number>
Number numberAt(std::string_view bytes, std::size_t at) {
  Number number = 0;
  for (std::size_t i = sizeof(Number); i > 0; --i) {
    number = static_cast<Number>(number << 8U) | static_cast<unsigned char>(bytes[at + i - 1]);
  }
  return number;
}

template <class Number>
void put(std::string& out, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    out += static_cast<char>(static_cast<unsigned char>(number >> (8U * i)));
  }
}

RequestJson timeJson(std::uint64_t time) {
  return {{"sec", time / nanosecondsPerSecond}, {"nsec", time % nanosecondsPerSecond}};
}

}  // namespace

Result<FoxgloveRequest> parseFoxgloveRequest(std::string_view text) {
  const RequestJson json = RequestJson::parse(text, nullptr, false);
  if (json.is_discarded()) return badRequest("This text frame is not valid JSON.");
  if (!json.is_object()) return badRequest("This text frame is not a JSON object.");
  const auto found = json.find("op");
  if (found == json.end() || !found->is_string()) {
    return badRequest("This text frame has no \"op\".");
  }
  const auto op = found->get<std::string>();
  if (op == "subscribe") return subscribeOf(json);
  if (op == "unsubscribe") return unsubscribeOf(json);
  return FoxgloveOther{};
}

Result<FoxgloveRequest> parseFoxgloveControl(std::string_view bytes) {
  constexpr char playbackControl = 3;
  constexpr std::size_t headBytes = 1 + 1 + 4 + 1 + 8 + 4;
  if (bytes.empty()) return badRequest("A binary frame is empty.");
  if (bytes[0] != playbackControl) return FoxgloveOther{};
  if (bytes.size() < headBytes) return badRequest("The playback control is too short.");
  const auto command = static_cast<unsigned char>(bytes[1]);
  if (command > 1) return badRequest("The playback control is neither play (0) nor pause (1).");
  FoxglovePlaybackControl out;
  out.plays = command == 0;
  out.speed = static_cast<double>(std::bit_cast<float>(numberAt<std::uint32_t>(bytes, 2)));
  if (!(out.speed > 0.0) || !std::isfinite(out.speed)) {
    return badRequest("The speed of the playback must be a positive number.");
  }
  if (bytes[6] != 0) out.seek = numberAt<std::uint64_t>(bytes, 7);
  const std::size_t length = numberAt<std::uint32_t>(bytes, 15);
  if (length > maxRequestId || length != bytes.size() - headBytes) {
    return badRequest("The playback control has a request id of another length than it says.");
  }
  out.requestId = bytes.substr(headBytes);
  return out;
}

std::string foxgloveServerInfo(
    const FoxgloveServerInfo& info,
    const std::optional<std::pair<std::uint64_t, std::uint64_t>>& playback) {
  RequestJson json{{"op", "serverInfo"},
                   {"name", info.name},
                   {"sessionId", info.sessionId},
                   {"capabilities", {"time"}},
                   {"supportedEncodings", RequestJson::array()},
                   {"metadata", RequestJson::object()}};
  if (playback) {
    json["capabilities"].push_back("playbackControl");
    json["dataStartTime"] = timeJson(playback->first);
    json["dataEndTime"] = timeJson(playback->second);
  }
  return json.dump();
}

std::string foxgloveAdvertise(std::span<const FoxgloveChannel> channels) {
  RequestJson list = RequestJson::array();
  for (const FoxgloveChannel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", channel.encoding},
                    {"schemaName", channel.schemaName},
                    {"schema", channel.schema},
                    {"schemaEncoding", channel.schemaEncoding}});
  }
  return RequestJson{{"op", "advertise"}, {"channels", std::move(list)}}.dump();
}

std::string foxgloveUnadvertise(std::span<const std::uint32_t> channels) {
  return RequestJson{{"op", "unadvertise"},
                     {"channelIds", std::vector(channels.begin(), channels.end())}}
      .dump();
}

std::string foxgloveStatus(const FoxgloveStatusText& status) {
  return RequestJson{{"op", "status"}, {"level", status.level}, {"message", status.text}}.dump(
      -1, ' ', false, RequestJson::error_handler_t::replace);
}

std::string foxgloveMessageFrame(const FoxgloveMessage& message) {
  std::string out(1, char{1});
  put(out, message.subscription);
  put(out, message.logTime);
  out += message.payload;
  return out;
}

std::string foxgloveTimeFrame(std::uint64_t time) {
  std::string out(1, char{2});
  put(out, time);
  return out;
}

std::string foxglovePlaybackFrame(const FoxglovePlaybackState& state) {
  std::string out(1, char{5});
  out += static_cast<char>(state.status);
  put(out, state.time);
  put(out, std::bit_cast<std::uint32_t>(static_cast<float>(state.speed)));
  out += static_cast<char>(state.didSeek ? 1 : 0);
  put(out, static_cast<std::uint32_t>(state.requestId.size()));
  out += state.requestId;
  return out;
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes JSON messages. What they hold is seen in the messages themselves, so a schema is not
// needed.
#include <nlohmann/json.hpp>

#include "message_decoder.h"

namespace pitchboard::telemetry {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t maxJsonMessage = 16U << 20;

/// A time as robots write it: {"sec": 1, "nanosec": 2}, with "nsec" or "secs" and "nsecs", too.
std::optional<std::int64_t> jsonTime(const Json& json) {
  if (!json.is_object() || json.size() != 2) return {};
  const auto part = [&json](std::initializer_list<const char*> names) -> std::optional<double> {
    for (const char* name : names) {
      const auto found = json.find(name);
      if (found != json.end() && found->is_number()) return found->get<double>();
    }
    return {};
  };
  const auto seconds = part({"sec", "secs", "seconds"}),
             nanoseconds = part({"nanosec", "nsec", "nsecs", "nanos"});
  constexpr double most = 9e9;
  if (!seconds || !nanoseconds || !(std::abs(*seconds) < most) || !(std::abs(*nanoseconds) < most))
    return {};
  return static_cast<std::int64_t>(*seconds) * 1'000'000'000 +
         static_cast<std::int64_t>(*nanoseconds);
}

template <class Out>
class JsonWalk {
 public:
  explicit JsonWalk(Out& out) : m_out(out) {}

  bool walk(const Json& json, int depth) {
    if (depth > maxRecordedDepth) return false;
    m_out.mark(static_cast<std::uint32_t>(json.type()));
    if (json.is_object()) return walkObject(json, depth);
    if (json.is_array()) return walkArray(json, depth);
    if (json.is_boolean()) {
      m_out.number(json.get<bool>() ? 1.0 : 0.0, RecordedKind::Flag, noUnit);
    } else if (json.is_number()) {
      m_out.number(json.get<double>(), RecordedKind::Number, noUnit);
    } else if (json.is_string()) {
      m_out.text(json.get_ref<const std::string&>());
    }
    return true;
  }

 private:
  bool walkObject(const Json& json, int depth) {
    if (json.size() > maxRecordedFields) {
      m_out.mark(~std::uint32_t{0});
      m_out.leaveOut(json.size());
      return true;
    }
    m_out.mark(static_cast<std::uint32_t>(json.size()));
    static const std::string seconds = "s";
    for (const auto& [key, value] : json.items()) {
      m_out.mark(key);
      m_out.enter(key);
      const auto time = jsonTime(value);
      m_out.mark(std::uint32_t{time.has_value()});
      if (time) {
        if (isStampName(key)) m_out.stamp(*time);
        m_out.number(secondsFromNs(*time), RecordedKind::Number, seconds);
      } else {
        if (value.is_string() && isElementName(key)) {
          m_out.elementName(value.template get_ref<const std::string&>());
        }
        if (!walk(value, depth + 1)) return false;
      }
      m_out.leave();
    }
    return true;
  }

  bool walkArray(const Json& json, int depth) {
    const bool isKept = json.size() <= maxRecordedElements;
    m_out.mark(isKept ? static_cast<std::uint32_t>(json.size()) : ~std::uint32_t{0});
    if (!isKept) {
      m_out.leaveOut(json.size());
      return true;
    }
    for (std::size_t i = 0; i < json.size(); ++i) {
      m_out.element(i);
      if (!walk(json[i], depth + 1)) return false;
      m_out.leaveElement();
    }
    return true;
  }

  Out& m_out;
};

class JsonDecoder : public MessageDecoder {
 public:
  bool decode(std::string_view message, DecodedMessage& to) override {
    if (message.size() > maxJsonMessage) return false;
    m_json = Json::parse(message, nullptr, false);
    if (m_json.is_discarded()) return false;
    return m_shapes.decode(
        to, [this]<class Out>(Out& out) { return JsonWalk<Out>(out).walk(m_json, 0); });
  }

 private:
  Json m_json;
  MessageShapes m_shapes;
};

}  // namespace

Result<std::unique_ptr<MessageDecoder>> makeJsonDecoder(const MessageSchema&) {
  return std::make_unique<JsonDecoder>();
}

}  // namespace pitchboard::telemetry

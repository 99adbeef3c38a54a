// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The recordings in tests/data/recordings, which official writers made, and the JSON beside each
// that says what is in it.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <telemetry/recordings/recording.h>

namespace recorded_messages {

using namespace pitchboard::telemetry;
using Json = nlohmann::ordered_json;

inline std::string dataPath(const std::string& name) {
  return std::string(PITCHBOARD_SOURCE_DIR "/tests/data/recordings/") + name;
}

/// The values of a message as in the JSON beside the recordings.
struct Message {
  std::string topic;
  std::int64_t time = 0;
  std::optional<std::int64_t> stamp;
  std::map<std::string, std::string> values;
  bool operator==(const Message&) const = default;
};

inline std::string shown(double value) {
  return std::isnan(value) ? "NaN" : Json(value + 0.0).dump();  // JSON of other programs has no -0
}

inline Message messageOf(const RecordedTopic& topic, const RecordedMessage& from) {
  Message message{topic.name, from.logTime, from.stamp, {}};
  std::size_t text = 0;
  for (std::size_t i = 0; i < from.values.size(); ++i) {
    const RecordedField& field = from.shape->fields[i];
    message.values[field.path] =
        field.kind == RecordedKind::Text ? std::string(from.texts[text++]) : shown(from.values[i]);
  }
  return message;
}

inline std::vector<Message> expected(const std::string& name) {
  std::ifstream file(dataPath(name));
  std::vector<Message> out;
  for (const Json& json : Json::parse(file)) {
    Message message{json["topic"], std::stoll(json["time"].get<std::string>()), {}, {}};
    if (json.contains("stamp")) message.stamp = std::stoll(json["stamp"].get<std::string>());
    for (const auto& [path, value] : json["values"].items()) {
      message.values[path] = value.is_string() ? value.get<std::string>() : shown(value);
    }
    out.push_back(std::move(message));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Message& a, const Message& b) { return a.time < b.time; });
  return out;
}

inline std::string textOf(const Message& message) {
  std::string text = message.topic + " " + std::to_string(message.time) + " " +
                     (message.stamp ? std::to_string(*message.stamp) : "-");
  for (const auto& [path, value] : message.values) text += "\n  " + path + " = " + value;
  return text;
}

}  // namespace recorded_messages

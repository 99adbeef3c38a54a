// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/recordings/decoded_topics.h>

#include <algorithm>
#include <utility>

#include "message_decoder.h"

namespace pitchboard::telemetry {

std::string countText(std::uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

DecodedTopics::DecodedTopics() : m_decoded(std::make_unique<DecodedMessage>()) {}
DecodedTopics::~DecodedTopics() = default;
DecodedTopics::DecodedTopics(DecodedTopics&&) noexcept = default;
DecodedTopics& DecodedTopics::operator=(DecodedTopics&&) noexcept = default;

std::uint64_t DecodedTopics::wrong() const {
  std::uint64_t sum = 0;
  for (const State& state : m_states) sum += state.wrong;
  return sum;
}

std::size_t DecodedTopics::add(std::string_view name, const MessageSchema& schema,
                               std::uint64_t messages) {
  std::string key(name);
  for (const std::string_view part :
       {schema.type, schema.schemaEncoding, schema.messageEncoding, schema.schema}) {
    key += '\0';
    key += part;
  }
  const auto [known, isNew] = m_index.try_emplace(std::move(key), m_topics.size());
  if (!isNew) {
    m_topics[known->second].messages += messages;
    return known->second;
  }
  RecordedTopic& topic = m_topics.emplace_back();
  State& state = m_states.emplace_back();
  topic.name = cutText(name, 200);
  topic.type = shortType(schema.type);
  topic.encoding = cutText(schema.messageEncoding, 40);
  topic.messages = messages;
  if (isBulkType(topic.type)) {
    topic.isSkipped = true;
    topic.reason = "Images and point clouds are skipped.";
    return known->second;
  }
  auto decoder = makeDecoder(schema);
  if (decoder) {
    state.decoder = std::move(*decoder);
  } else {
    topic.reason = decoder.error().text();
  }
  return known->second;
}

bool DecodedTopics::decode(std::size_t topic, std::string_view bytes, std::int64_t logTime,
                           RecordedMessage& to) {
  State& state = m_states[topic];
  DecodedMessage& decoded = *m_decoded;
  if (!state.decoder->decode(bytes, decoded)) {
    ++state.wrong;
    return false;
  }
  state.leftOut += decoded.leftOut;
  to.topic = topic;
  to.logTime = logTime;
  to.stamp = decoded.stamp;
  if (to.shape != decoded.shape) to.shape = decoded.shape;
  to.values = decoded.values;
  to.texts = decoded.texts;
  return true;
}

void DecodedTopics::addNotes(std::vector<std::string>& notes) const {
  for (std::size_t i = 0; i < m_topics.size(); ++i) {
    const RecordedTopic& topic = m_topics[i];
    const State& state = m_states[i];
    const std::string name =
        topic.name + (topic.type.empty() ? std::string() : " (" + topic.type + ")") + ": ";
    const std::uint64_t count = std::max(state.passed, topic.messages);
    if (!topic.isUnderstood() && count > 0) {
      notes.push_back(name + countText(count, "message was", "messages were") + " left out. " +
                      topic.reason);
    }
    if (state.wrong > 0) {
      notes.push_back(name + countText(state.wrong, "message does", "messages do") +
                      " not match the schema and " + (state.wrong == 1 ? "was" : "were") +
                      " left out.");
    }
    if (state.leftOut > 0) {
      notes.push_back(name + countText(state.leftOut, "value was", "values were") +
                      " left out, because lists of more than " +
                      std::to_string(maxRecordedElements) + " values and bytes are not variables.");
    }
  }
}

}  // namespace pitchboard::telemetry

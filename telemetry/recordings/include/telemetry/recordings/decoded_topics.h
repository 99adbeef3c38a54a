// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The topics of a recording, or of a program that sends messages, with their decoders, and what
// could not be decoded. It takes one message at a time, so that files and connections are read
// alike. Not thread-safe.

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <telemetry/recordings/recording.h>

namespace pitchboard::telemetry {

/// How messages are written, in the words of MCAP.
struct MessageSchema {
  std::string_view type;             ///< "sensor_msgs/msg/Imu"
  std::string_view schemaEncoding;   ///< "ros2msg", "ros2idl", "ros1msg", "jsonschema", "protobuf"
  std::string_view messageEncoding;  ///< "cdr", "ros1", "json", "protobuf"
  std::string_view schema;
};

class MessageDecoder;
struct DecodedMessage;

class DecodedTopics {
 public:
  DecodedTopics();
  ~DecodedTopics();
  DecodedTopics(DecodedTopics&&) noexcept;
  DecodedTopics& operator=(DecodedTopics&&) noexcept;

  /// Returns the index of a topic, which is added if there is none with this name and schema.
  std::size_t add(std::string_view name, const MessageSchema& schema, std::uint64_t messages);
  /// Returns all topics; indices stay.
  const std::vector<RecordedTopic>& topics() const { return m_topics; }
  bool isWanted(std::size_t topic) const { return m_topics[topic].isUnderstood(); }
  /// Returns how many messages of all topics were not what their schema says.
  std::uint64_t wrong() const;

  /// Decodes a message; the views in `to` are valid until the next call. Returns false if it is
  /// not what its schema says, which is counted.
  bool decode(std::size_t topic, std::string_view bytes, std::int64_t logTime, RecordedMessage& to);
  /// Counts messages that are passed over.
  void passOver(std::size_t topic, std::uint64_t count = 1) { m_states[topic].passed += count; }

  void addNotes(std::vector<std::string>& notes) const;

 private:
  struct State {
    std::unique_ptr<MessageDecoder> decoder;
    std::uint64_t passed = 0, wrong = 0, leftOut = 0;
  };
  std::vector<RecordedTopic> m_topics;
  std::vector<State> m_states;
  std::map<std::string, std::size_t> m_index;  ///< by name and schema
  std::unique_ptr<DecodedMessage> m_decoded;
};

/// Returns "1 message", "5210 messages".
std::string countText(std::uint64_t count, const char* one, const char* many);

}  // namespace pitchboard::telemetry

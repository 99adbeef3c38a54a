// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decodes the messages of one topic by their schema. Private to recordings; one thread.

#include <memory>
#include <string>
#include <string_view>

#include <base/result.h>
#include <telemetry/recordings/decoded_topics.h>

#include "message_shape.h"

namespace pitchboard::telemetry {

class MessageDecoder {
 public:
  virtual ~MessageDecoder() = default;
  /// Returns false if the message is not what its schema says; `to` is then of no use.
  virtual bool decode(std::string_view message, DecodedMessage& to) = 0;
};

/// Fails with Unsupported if nothing here reads such messages, with ParseError if the schema is not
/// what it should be.
Result<std::unique_ptr<MessageDecoder>> makeDecoder(const MessageSchema& schema);

// One function for each kind of message; the list is in message_decoder.cpp.
Result<std::unique_ptr<MessageDecoder>> makeRosDecoder(const MessageSchema& schema);
Result<std::unique_ptr<MessageDecoder>> makeJsonDecoder(const MessageSchema& schema);
Result<std::unique_ptr<MessageDecoder>> makeProtobufDecoder(const MessageSchema& schema);

/// Returns "sensor_msgs/Imu" for "sensor_msgs/msg/Imu".
std::string shortType(std::string_view type);
/// Returns whether messages of this type hold images, point clouds or other bulk data.
bool isBulkType(std::string_view shortType);

}  // namespace pitchboard::telemetry

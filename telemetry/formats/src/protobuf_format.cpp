// SPDX-License-Identifier: GPL-3.0-or-later
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <array>
#include <cmath>
#include <memory>

#include <messages/team_messages.pb.h>

#include "message_readers.h"

namespace pitchboard::telemetry {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr int deepest = 8;
constexpr int maxRepeated = 64;

struct Known {
  std::string_view name;
  const Message& (*prototype)();
};
template <class Type>
const Message& prototype() {
  return Type::default_instance();
}
constexpr std::array<Known, 4> known{{{"robocup", prototype<messages::RobocupMessage>},
                                      {"nubots", prototype<messages::NubotsMessage>},
                                      {"rhoban", prototype<messages::RhobanMessage>},
                                      {"utra", prototype<messages::UtraMessage>}}};

/// Every value of a message with its path. What was not sent is 0 in proto 3; a message that was
/// not sent is not there.
class Walk {
 public:
  explicit Walk(FieldSink& sink) : m_sink(&sink) {}

  void message(const Message& message, const std::string& before, int depth) {
    if (depth == deepest) return;
    const auto* reflection = message.GetReflection();
    const auto* type = message.GetDescriptor();
    for (int i = 0; i < type->field_count(); ++i) {
      const FieldDescriptor* field = type->field(i);
      const std::string path = before + field->name();
      if (field->is_repeated()) {
        const int count = std::min(reflection->FieldSize(message, field), maxRepeated);
        for (int n = 0; n < count; ++n) {
          entry(message, field, n, path + '[' + std::to_string(n) + ']', depth);
        }
      } else if (!field->has_presence() || reflection->HasField(message, field)) {
        value(message, field, path, depth);
      }
    }
  }

 private:
  void value(const Message& message, const FieldDescriptor* field, const std::string& path,
             int depth) {
    const auto* reflection = message.GetReflection();
    switch (field->cpp_type()) {
      case FieldDescriptor::CPPTYPE_MESSAGE:
        return this->message(reflection->GetMessage(message, field), path + '.', depth + 1);
      case FieldDescriptor::CPPTYPE_FLOAT:
        return number(path, static_cast<double>(reflection->GetFloat(message, field)));
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return number(path, reflection->GetDouble(message, field));
      case FieldDescriptor::CPPTYPE_UINT32:
        return number(path, reflection->GetUInt32(message, field));
      case FieldDescriptor::CPPTYPE_INT32:
        return number(path, reflection->GetInt32(message, field));
      case FieldDescriptor::CPPTYPE_UINT64:
        return number(path, static_cast<double>(reflection->GetUInt64(message, field)));
      case FieldDescriptor::CPPTYPE_INT64:
        return number(path, static_cast<double>(reflection->GetInt64(message, field)));
      case FieldDescriptor::CPPTYPE_BOOL:
        return number(path, reflection->GetBool(message, field) ? 1.0 : 0.0);
      default:
        return;  // our messages have no other
    }
  }

  void entry(const Message& message, const FieldDescriptor* field, int n, const std::string& path,
             int depth) {
    const auto* reflection = message.GetReflection();
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      this->message(reflection->GetRepeatedMessage(message, field, n), path + '.', depth + 1);
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_FLOAT) {
      number(path, static_cast<double>(reflection->GetRepeatedFloat(message, field, n)));
    }
  }

  void number(const std::string& path, double value) {
    // A float that is not a number says that there is nothing.
    if (!std::isnan(value)) m_sink->number(path, value);
  }

  FieldSink* m_sink;
};

/// Returns the yaw of an orientation.
void addYaw(const messages::UtraMessage& message, FieldSink& sink) {
  if (!message.pose().has_orientation()) return;
  const auto& q = message.pose().orientation();
  const double x = static_cast<double>(q.x()), y = static_cast<double>(q.y());
  const double z = static_cast<double>(q.z()), w = static_cast<double>(q.w());
  sink.number("pose.yaw", std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)));
}

}  // namespace

bool readProtobuf(const std::string& message, std::string_view bytes, FieldSink& sink) {
  for (const Known& one : known) {
    if (one.name != message) continue;
    const std::unique_ptr<Message> made(one.prototype().New());
    if (bytes.empty() ||
        !made->ParsePartialFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
      return false;
    }
    Walk(sink).message(*made, {}, 0);
    if (one.name == "utra") addYaw(static_cast<const messages::UtraMessage&>(*made), sink);
    return true;
  }
  return false;
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes protobuf messages by the FileDescriptorSet in their schema, with protobuf's reflection.
// Each schema has a pool of its own, because other recordings may define the same names otherwise.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/descriptor_database.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/io/coded_stream.h>

#include <algorithm>

#include "message_decoder.h"

namespace pitchboard::telemetry {
namespace {

namespace pb = google::protobuf;

constexpr std::size_t maxProtobufSchema = 16U << 20;

/// Errors are those of the schema, which is not ours; the library would print them.
class QuietErrors : public pb::DescriptorPool::ErrorCollector {
 public:
  void AddError(const std::string& file, const std::string& element, const pb::Message*,
                ErrorLocation, const std::string& message) override {
    if (first.empty()) first = file + ", " + element + ": " + message;
  }
  std::string first;
};

FieldLabels labelsOf(const pb::EnumDescriptor& from) {
  FieldLabels labels;
  for (int i = 0; i < from.value_count(); ++i) {
    labels.try_emplace(from.value(i)->number(), from.value(i)->name());
  }
  return labels;
}

/// protoc calls the entries of a map after its field: "ScoresEntry" of `scores`. protobufjs calls
/// them otherwise ("Scores"), which the library would refuse.
void nameMapEntries(pb::DescriptorProto& type) {
  for (pb::DescriptorProto& nested : *type.mutable_nested_type()) {
    nameMapEntries(nested);
    if (!nested.options().map_entry()) continue;
    for (pb::FieldDescriptorProto& field : *type.mutable_field()) {
      const std::string& used = field.type_name();
      if (used.substr(used.rfind('.') + 1) != nested.name()) continue;
      std::string name;
      bool isFirst = true;  // of a word
      for (const char c : field.name()) {
        if (c != '_')
          name += isFirst && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        isFirst = c == '_';
      }
      nested.set_name(name + "Entry");
      field.set_type_name(name + "Entry");
      break;
    }
  }
}

/// What the fields of a schema are, looked up once.
class ProtobufNames {
 public:
  const FieldLabels& labels(const pb::EnumDescriptor& type) {
    const auto [entry, isNew] = m_labels.try_emplace(&type);
    if (isNew) entry->second = labelsOf(type);
    return entry->second;
  }

 private:
  std::map<const pb::EnumDescriptor*, FieldLabels> m_labels;
};

std::optional<std::int64_t> protobufTime(const pb::Message& message) {
  const pb::Descriptor& type = *message.GetDescriptor();
  if (type.full_name() != "google.protobuf.Timestamp" &&
      type.full_name() != "google.protobuf.Duration") {
    return {};
  }
  const auto *seconds = type.FindFieldByNumber(1), *nanoseconds = type.FindFieldByNumber(2);
  using Field = pb::FieldDescriptor;
  if (seconds == nullptr || nanoseconds == nullptr || seconds->is_repeated() ||
      nanoseconds->is_repeated() || seconds->cpp_type() != Field::CPPTYPE_INT64 ||
      nanoseconds->cpp_type() != Field::CPPTYPE_INT32) {
    return {};
  }
  const pb::Reflection& read = *message.GetReflection();
  constexpr std::int64_t most = 9'000'000'000;
  return std::clamp<std::int64_t>(read.GetInt64(message, seconds), -most, most) * 1'000'000'000 +
         read.GetInt32(message, nanoseconds);
}

template <class Out>
class ProtobufWalk {
 public:
  ProtobufWalk(Out& out, DecodedMessage& owner, ProtobufNames& names)
      : m_out(out), m_owner(owner), m_names(names) {}

  bool walk(const pb::Message& message, int depth) {
    if (depth > maxRecordedDepth) return false;
    const pb::Descriptor& type = *message.GetDescriptor();
    const pb::Reflection& read = *message.GetReflection();
    for (int i = 0; i < type.field_count(); ++i) {
      const Field& field = *type.field(i);
      if (field.is_repeated()) {
        if (!walkList(message, field, depth)) return false;
        continue;
      }
      // A part that may be missing, and is, has no values. A number of proto3 is 0.
      if (field.has_presence() && !read.HasField(message, &field)) {
        m_out.mark(0U);
        continue;
      }
      m_out.mark(1U);
      m_out.enter(field.name());
      if (!walkOne(message, field, -1, depth)) return false;
      m_out.leave();
    }
    return true;
  }

 private:
  using Field = pb::FieldDescriptor;

  bool walkList(const pb::Message& message, const Field& field, int depth) {
    const int count = message.GetReflection()->FieldSize(message, &field);
    const bool isKept = count <= static_cast<int>(maxRecordedElements);
    m_out.mark(isKept ? static_cast<std::uint32_t>(count) : ~std::uint32_t{0});
    if (!isKept) {
      m_out.leaveOut(static_cast<std::size_t>(count));
      return true;
    }
    m_out.enter(field.name());
    const bool done = field.is_map() ? walkMap(message, field, count, depth)
                                     : walkItems(message, field, count, depth);
    m_out.leave();
    return done;
  }

  bool walkItems(const pb::Message& message, const Field& field, int count, int depth) {
    for (int i = 0; i < count; ++i) {
      m_out.element(static_cast<std::size_t>(i));
      if (!walkOne(message, field, i, depth)) return false;
      m_out.leaveElement();
    }
    return true;
  }

  /// The keys name the values. Of a key that comes twice the last entry counts.
  bool walkMap(const pb::Message& message, const Field& field, int count, int depth) {
    const pb::Reflection& read = *message.GetReflection();
    std::map<std::string, const pb::Message*> entries;
    for (int i = 0; i < count; ++i) {
      const pb::Message& entry = read.GetRepeatedMessage(message, &field, i);
      entries[keyOf(entry)] = &entry;
    }
    const Field* value = field.message_type()->map_value();
    for (const auto& [key, entry] : entries) {
      m_out.mark(key);
      m_out.element(0, key);
      if (!walkOne(*entry, *value, -1, depth)) return false;
      m_out.leaveElement();
    }
    return true;
  }

  static std::string keyOf(const pb::Message& entry) {
    const Field* key = entry.GetDescriptor()->map_key();
    const pb::Reflection& read = *entry.GetReflection();
    switch (key->cpp_type()) {
      case Field::CPPTYPE_STRING:
        return read.GetString(entry, key);
      case Field::CPPTYPE_INT32:
        return std::to_string(read.GetInt32(entry, key));
      case Field::CPPTYPE_UINT32:
        return std::to_string(read.GetUInt32(entry, key));
      case Field::CPPTYPE_INT64:
        return std::to_string(read.GetInt64(entry, key));
      case Field::CPPTYPE_UINT64:
        return std::to_string(read.GetUInt64(entry, key));
      default:
        return read.GetBool(entry, key) ? "true" : "false";
    }
  }

  /// `index` is that of an element of a list, -1 for a single field.
  bool walkOne(const pb::Message& message, const Field& field, int index, int depth) {
    const pb::Reflection& read = *message.GetReflection();
    const auto put = [this](auto value, RecordedKind kind = RecordedKind::Number) {
      m_out.number(static_cast<double>(value), kind, noUnit);
      return true;
    };
    const bool isOne = index < 0;
    switch (field.cpp_type()) {
      case Field::CPPTYPE_INT32:
        return put(isOne ? read.GetInt32(message, &field)
                         : read.GetRepeatedInt32(message, &field, index));
      case Field::CPPTYPE_INT64:
        return put(isOne ? read.GetInt64(message, &field)
                         : read.GetRepeatedInt64(message, &field, index));
      case Field::CPPTYPE_UINT32:
        return put(isOne ? read.GetUInt32(message, &field)
                         : read.GetRepeatedUInt32(message, &field, index));
      case Field::CPPTYPE_UINT64:
        return put(isOne ? read.GetUInt64(message, &field)
                         : read.GetRepeatedUInt64(message, &field, index));
      case Field::CPPTYPE_DOUBLE:
        return put(isOne ? read.GetDouble(message, &field)
                         : read.GetRepeatedDouble(message, &field, index));
      case Field::CPPTYPE_FLOAT:
        return put(isOne ? read.GetFloat(message, &field)
                         : read.GetRepeatedFloat(message, &field, index));
      case Field::CPPTYPE_BOOL:
        return put(
            isOne ? read.GetBool(message, &field) : read.GetRepeatedBool(message, &field, index),
            RecordedKind::Flag);
      case Field::CPPTYPE_ENUM:
        m_out.number(isOne ? read.GetEnumValue(message, &field)
                           : read.GetRepeatedEnumValue(message, &field, index),
                     RecordedKind::Enumeration, noUnit, m_names.labels(*field.enum_type()));
        return true;
      case Field::CPPTYPE_STRING:
        putText(isOne ? read.GetString(message, &field)
                      : read.GetRepeatedString(message, &field, index),
                field);
        return true;
      case Field::CPPTYPE_MESSAGE:
        return walkPart(isOne ? read.GetMessage(message, &field)
                              : read.GetRepeatedMessage(message, &field, index),
                        field, depth);
    }
    return true;
  }

  void putText(std::string text, const Field& field) {
    if (field.type() == Field::TYPE_BYTES) return m_out.leaveOut(1);
    if (isElementName(field.name())) m_out.elementName(text);
    m_out.text(m_owner.ownTexts.emplace_back(std::move(text)));
  }

  bool walkPart(const pb::Message& part, const Field& field, int depth) {
    const auto time = protobufTime(part);
    if (!time) return walk(part, depth + 1);
    static const std::string seconds = "s";
    if (isStampName(field.name())) m_out.stamp(*time);
    m_out.number(secondsFromNs(*time), RecordedKind::Number, seconds);
    return true;
  }

  Out& m_out;
  DecodedMessage& m_owner;
  ProtobufNames& m_names;
};

class ProtobufDecoder : public MessageDecoder {
 public:
  /// Fails if the schema does not define the type.
  Result<void> open(const MessageSchema& schema) {
    pb::FileDescriptorSet set;
    pb::io::CodedInputStream in(reinterpret_cast<const std::uint8_t*>(schema.schema.data()),
                                static_cast<int>(schema.schema.size()));
    if (!set.ParseFromCodedStream(&in) || !in.ConsumedEntireMessage()) {
      return failure(ErrorCode::ParseError, "The schema is not a FileDescriptorSet.");
    }
    // It takes the files in any order.
    for (pb::FileDescriptorProto& file : *set.mutable_file()) {
      for (pb::DescriptorProto& type : *file.mutable_message_type()) nameMapEntries(type);
      m_files.Add(file);
    }
    m_pool = std::make_unique<pb::DescriptorPool>(&m_files, &m_errors);
    const pb::Descriptor* type = m_pool->FindMessageTypeByName(std::string(schema.type));
    if (type == nullptr) {
      return failure(ErrorCode::ParseError,
                     m_errors.first.empty() ? "The schema does not define \"" +
                                                  std::string(schema.type.substr(0, 100)) + "\"."
                                            : "The schema is invalid: " + m_errors.first + ".");
    }
    m_message.reset(m_factory.GetPrototype(type)->New());
    return {};
  }

  bool decode(std::string_view bytes, DecodedMessage& to) override {
    if (bytes.size() > maxProtobufSchema * 4) return false;
    // Fields that should be there may be missing in an old recording.
    if (!m_message->ParsePartialFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
      return false;
    }
    return m_shapes.decode(to, [&]<class Out>(Out& out) {
      return ProtobufWalk<Out>(out, to, m_names).walk(*m_message, 0);
    });
  }

 private:
  // The order in which they go: the message first.
  QuietErrors m_errors;
  pb::SimpleDescriptorDatabase m_files;
  std::unique_ptr<pb::DescriptorPool> m_pool;
  pb::DynamicMessageFactory m_factory;
  std::unique_ptr<pb::Message> m_message;
  ProtobufNames m_names;
  MessageShapes m_shapes;
};

}  // namespace

Result<std::unique_ptr<MessageDecoder>> makeProtobufDecoder(const MessageSchema& schema) {
  if (schema.schemaEncoding != "protobuf") {
    return failure(ErrorCode::Unsupported,
                   "The recording does not have the definition of this type.");
  }
  if (schema.schema.size() > maxProtobufSchema) {
    return failure(ErrorCode::ParseError, "The schema is larger than 16 MiB.");
  }
  // The library prints what is wrong with messages, which are counted here.
  static const pb::LogSilencer* silent = new pb::LogSilencer();
  (void)silent;
  auto decoder = std::make_unique<ProtobufDecoder>();
  if (auto opened = decoder->open(schema); !opened) return tl::unexpected(opened.error());
  return decoder;
}

}  // namespace pitchboard::telemetry

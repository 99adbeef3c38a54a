// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a recording of another program: each format of files, and each kind of messages with
// any schema. The first byte chooses.
#include <sys/mman.h>
#include <unistd.h>
#include <cstdlib>
#include <string>

#include "message_decoder.h"
#include "recording_formats.h"

using namespace pitchboard::telemetry;

namespace {

/// Reads a recording to its end; there is nothing in it that takes long.
void readAll(RecordingReader& reader) {
  std::size_t items = 0;
  for (auto item = reader.next(); item && *item != RecordedItem::End && items < 20'000;
       item = reader.next(), ++items) {
    if (*item != RecordedItem::Message) continue;
    const RecordedMessage& message = reader.message();
    std::size_t texts = 0;
    for (const RecordedField& field : message.shape->fields) {
      texts += field.kind == RecordedKind::Text ? 1U : 0U;
    }
    if (message.values.size() != message.shape->fields.size() || message.texts.size() != texts ||
        message.topic >= reader.topics().size()) {
      std::abort();
    }
  }
  (void)reader.notes();
}

using OpenFormat = OpenedRecording (*)(const std::vector<std::string>&, const RecordingProgress&);

void readFile(OpenFormat open, std::string_view bytes) {
  const int file = ::memfd_create("recording", MFD_CLOEXEC);
  if (file < 0 || ::write(file, bytes.data(), bytes.size()) < 0) return;
  const auto reader = open({"/proc/self/fd/" + std::to_string(file)}, {});
  if (reader) readAll(**reader);
  ::close(file);
}

/// Schema, a zero byte, message.
void decode(std::string_view bytes, MessageSchema schema) {
  const auto end = bytes.find('\0');
  if (end == bytes.npos) return;
  schema.schema = bytes.substr(0, end);
  bytes.remove_prefix(end + 1);
  const auto decoder = makeDecoder(schema);
  if (!decoder) return;
  DecodedMessage message;
  for (const std::string_view part : {bytes, bytes.substr(0, bytes.size() / 2), bytes}) {
    message.clear();
    if ((*decoder)->decode(part, message) &&
        message.values.size() != message.shape->fields.size()) {
      std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 'm':
      readFile(openMcapRecording, bytes);
      break;
    case 'd':
      readFile(openRosbag2Database, bytes);
      break;
    case 'c':
      readFile(openCsvRecording, bytes);
      break;
    case 'y':
      readFile(openRefereeLog, bytes);
      break;
    case '2':
      decode(bytes, {"p/msg/T", "ros2msg", "cdr", {}});
      break;
    case 'i':
      decode(bytes, {"p/msg/T", "ros2idl", "cdr", {}});
      break;
    case '1':
      decode(bytes, {"p/T", "ros1msg", "ros1", {}});
      break;
    case 'p':
      decode(bytes, {"p.T", "protobuf", "protobuf", {}});
      break;
    case 'j':
      decode(std::string(1, '\0') + std::string(bytes), {"", "", "json", {}});
      break;
    default:
      break;
  }
  return 0;
}

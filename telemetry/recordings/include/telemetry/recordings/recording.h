// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads recordings of other programs: one reader for each format (recordingFormats()) behind one
// interface. A reader passes messages and datagrams one after the other, in the order of the times
// at which they were recorded. Every number, flag and short text of a message is a field. What a
// reader does not understand it counts, and names in notes(); a message that differs from its
// schema is left out alone. Times are ns since 1970, or since an unknown moment if the recording
// does not say more. One thread at a time.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

enum class RecordedKind : std::uint8_t { Number, Flag, Enumeration, Text };

struct RecordedField {
  std::string path;  ///< "pose.position.x", "position[3]", "position[left_knee]"
  RecordedKind kind = RecordedKind::Number;
  std::string unit{};  ///< as in base/units.h, and others such as "N·m"; empty if unknown
  std::map<std::int32_t, std::string> labels{};  ///< of an Enumeration
  bool operator==(const RecordedField&) const = default;
};

/// The fields of a message, in the order of its values. Messages of a topic share it while their
/// arrays have the same lengths and names.
struct RecordedShape {
  std::vector<RecordedField> fields;
};

struct RecordedTopic {
  std::string name;            ///< "/robot1/joint_states"
  std::string type;            ///< "sensor_msgs/JointState", without "msg"; empty if unknown
  std::string encoding;        ///< "cdr", "json", ...
  std::uint64_t messages = 0;  ///< as the file says; 0 if it does not
  std::string reason{};        ///< why its messages are not read; empty if they are
  bool isSkipped = false;      ///< with a reason: it has images or point clouds
  bool isUnderstood() const { return reason.empty(); }
};

/// The views are valid until the next item.
struct RecordedMessage {
  std::size_t topic = 0;              ///< index in RecordingReader::topics()
  std::int64_t logTime = 0;           ///< when it was recorded
  std::optional<std::int64_t> stamp;  ///< when it was measured, if the message says so
  std::shared_ptr<const RecordedShape> shape;
  std::span<const double> values;           ///< one for each field; NaN for texts
  std::span<const std::string_view> texts;  ///< one for each field of kind Text, in order
};

/// A datagram that the recorder received.
struct RecordedDatagram {
  std::int64_t time = 0;
  Sender sender;
  std::uint16_t localPort = 0;
  std::string_view payload;
};

enum class RecordedItem : std::uint8_t { Message, Datagram, End };

class RecordingReader {
 public:
  virtual ~RecordingReader() = default;
  /// Returns all topics; further ones can be added behind them while reading.
  virtual const std::vector<RecordedTopic>& topics() const = 0;
  /// Moves to the next item. Fails if the file cannot be read any more.
  virtual Result<RecordedItem> next() = 0;
  const RecordedMessage& message() const { return m_message; }     ///< after Message
  const RecordedDatagram& datagram() const { return m_datagram; }  ///< after Datagram
  /// Returns the share of the recording that was read, 0 to 1.
  virtual double progress() const = 0;
  /// Returns sentences that say what was not understood, with counts. Complete after End.
  virtual std::vector<std::string> notes() const = 0;

 protected:
  RecordedMessage m_message;
  RecordedDatagram m_datagram;
};

/// The row of a format.
struct RecordingFormat {
  const char* name;  ///< "MCAP", "CSV"
  /// Returns whether a file is of this format; `beginning` are its first bytes, up to 4096.
  bool (*recognizes)(const std::string& path, std::string_view beginning);
  /// Opens one recording that was split into these files. `progress` is called from time to time
  /// with 0 to 1, and stops with false. Fails if a file cannot be read.
  Result<std::unique_ptr<RecordingReader>> (*open)(const std::vector<std::string>& files,
                                                   const std::function<bool(double)>& progress);
};
std::span<const RecordingFormat> recordingFormats();

/// Returns the format of a file. Fails with NotFound or SystemError if it cannot be read, with
/// Unsupported if it is of none; the error names all formats.
Result<const RecordingFormat*> recordingFormatOf(const std::string& path);

/// Opens files of any formats; those of one format are one split recording. A folder stands for the
/// recordings in it (as rosbag2 writes them). Fails as recordingFormatOf() and the readers do.
Result<std::vector<std::unique_ptr<RecordingReader>>> openRecordings(
    const std::vector<std::string>& paths, const std::function<bool(double)>& progress = {});

}  // namespace pitchboard::telemetry

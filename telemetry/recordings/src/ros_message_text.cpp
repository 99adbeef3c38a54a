// SPDX-License-Identifier: GPL-3.0-or-later
// Reads ros2msg and ros1msg. Source: rosidl's message definitions (docs.ros.org, "Interfaces"), and
// the sections that rosbag2 and rosbag write: the root type first, each other type behind a line of
// 80 '=' and "MSG: package/Name".
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>

#include <base/try.h>

#include "message_decoder.h"
#include "ros_types.h"

namespace pitchboard::telemetry {
namespace {

struct MessageSection {
  std::string name;  ///< "geometry_msgs/Pose"
  std::string_view text;
  int line = 1;
};

std::string_view trimmed(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view takeLine(std::string_view& text) {
  const auto end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  return line;
}

bool isSeparator(std::string_view line) {
  line = trimmed(line);
  return line.size() >= 10 && line.find_first_not_of('=') == line.npos;
}

std::vector<MessageSection> sectionsOf(std::string_view type, std::string_view text) {
  std::vector<MessageSection> sections{{shortType(type), text.substr(0, 0), 1}};
  const char* begin = text.data();
  int number = 0;
  std::string_view rest = text;
  while (!rest.empty()) {
    const char* lineBegin = rest.data();
    const std::string_view line = takeLine(rest);
    ++number;
    if (!isSeparator(line)) continue;
    sections.back().text = {begin, static_cast<std::size_t>(lineBegin - begin)};
    std::string_view name = trimmed(takeLine(rest));
    ++number;
    for (const std::string_view mark : {"MSG:", "SRV:"}) {
      if (name.starts_with(mark)) name = trimmed(name.substr(mark.size()));
    }
    begin = rest.data();
    sections.push_back({shortType(name), {}, number + 1});
  }
  sections.back().text = {begin, static_cast<std::size_t>(text.data() + text.size() - begin)};
  return sections;
}

/// Where a line `---` begins; npos if there is none.
std::size_t serviceMark(std::string_view text) {
  for (std::string_view rest = text; !rest.empty();) {
    const char* begin = rest.data();
    if (trimmed(takeLine(rest)) == "---") return static_cast<std::size_t>(begin - text.data());
  }
  return std::string_view::npos;
}

/// rosbag2 records calls of a service as messages of the type "package/srv/Name_Event", and writes
/// the definition of the service as their schema.
constexpr std::string_view serviceEventText =
    "uint8 event_type\nbuiltin_interfaces/Time stamp\nuint8[16] client_gid\n"
    "int64 sequence_number\n";

void splitServiceEvent(std::vector<MessageSection>& sections, std::string& rootText) {
  MessageSection& root = sections.front();
  const std::size_t mark = serviceMark(root.text);
  if (mark == root.text.npos || !root.name.ends_with("_Event")) return;
  const std::string service = root.name.substr(0, root.name.size() - 6);
  std::string_view request = root.text.substr(0, mark), response = root.text.substr(mark);
  (void)takeLine(response);
  const int line = 1 + static_cast<int>(std::ranges::count(request, '\n'));
  rootText = service + "_Info info\n" + service + "_Request[<=1] request\n" + service +
             "_Response[<=1] response\n";
  root.text = rootText;
  sections.push_back({service + "_Info", serviceEventText, 1});
  sections.push_back({service + "_Request", request, 1});
  sections.push_back({service + "_Response", response, line + 1});
}

struct RosName {
  std::string_view name;
  RosKind kind;
};
// `byte` and `char` are 0 to 255 in ROS 2; in ROS 1 `byte` is int8 and `char` is uint8.
constexpr std::array rosNames{
    RosName{"bool", RosKind::Bool},       RosName{"byte", RosKind::UInt8},
    RosName{"char", RosKind::UInt8},      RosName{"int8", RosKind::Int8},
    RosName{"uint8", RosKind::UInt8},     RosName{"int16", RosKind::Int16},
    RosName{"uint16", RosKind::UInt16},   RosName{"int32", RosKind::Int32},
    RosName{"uint32", RosKind::UInt32},   RosName{"int64", RosKind::Int64},
    RosName{"uint64", RosKind::UInt64},   RosName{"float32", RosKind::Float32},
    RosName{"float64", RosKind::Float64}, RosName{"string", RosKind::Text},
    RosName{"wstring", RosKind::WideText}};

class MessageText {
 public:
  MessageText(std::string_view type, std::string_view text, bool isRos1)
      : m_sections(sectionsOf(type, text)), m_isRos1(isRos1) {
    splitServiceEvent(m_sections, m_rootText);
  }

  Result<RosTypes> read() {
    for (std::size_t i = 0; i < m_sections.size(); ++i) m_index.try_emplace(m_sections[i].name, i);
    // A definition that comes twice, or a root that comes again, is the same.
    for (const MessageSection& section : m_sections) {
      m_types.structs.push_back({section.name, {}, Extensibility::Unsaid});
    }
    for (std::size_t i = 0; i < m_sections.size(); ++i) TRY(readSection(i));
    TRY(completeRosTypes(m_types));
    return std::move(m_types);
  }

 private:
  Result<void> readSection(std::size_t index) {
    std::string_view rest = m_sections[index].text;
    m_line = m_sections[index].line - 1;
    while (!rest.empty()) {
      ++m_line;
      std::string_view line = takeLine(rest);
      line = trimmed(line.substr(0, line.find('#')));
      if (line.empty()) continue;
      // The definition of a service or an action: what follows is another message.
      if (line == "---") {
        return failure(ErrorCode::Unsupported,
                       "\"" + m_sections[index].name.substr(0, 100) +
                           "\" is the definition of a service, not of a message.");
      }
      TRY(readField(index, line));
    }
    return {};
  }

  tl::unexpected<Error> wrong(std::string_view line) const {
    return failure(ErrorCode::ParseError,
                   "\"" + std::string(line.substr(0, 60)) + "\" is not a field of a message.",
                   "line " + std::to_string(m_line) + " of the schema");
  }

  Result<void> readField(std::size_t index, std::string_view line) {
    if (++m_fields > maxRosFields) return wrong("(too many fields)");
    const auto blank = line.find_first_of(" \t");
    if (blank == line.npos) return wrong(line);
    std::string_view type = line.substr(0, blank);
    std::string_view rest = trimmed(line.substr(blank));
    RosField field;
    const auto end = rest.find_first_of(" \t=");
    field.name = rest.substr(0, end);
    // A constant has "=" behind its name; it is not in messages.
    const std::string_view behind =
        end == rest.npos ? std::string_view() : trimmed(rest.substr(end));
    if (behind.starts_with('=')) return {};
    if (field.name.empty()) return wrong(line);
    if (!readList(type, field) || !readType(index, type, field)) return wrong(line);
    m_types.structs[index].fields.push_back(std::move(field));
    return {};
  }

  /// Takes "[3]", "[]" or "[<=5]" off the type.
  static bool readList(std::string_view& type, RosField& field) {
    if (!type.ends_with(']')) return true;
    const auto open = type.rfind('[');
    if (open == type.npos) return false;
    const std::string_view inside = type.substr(open + 1, type.size() - open - 2);
    type = type.substr(0, open);
    field.list = RosList::Sequence;
    if (inside.empty() || inside.starts_with("<=")) return true;
    field.list = RosList::Array;
    const auto [stop, code] =
        std::from_chars(inside.data(), inside.data() + inside.size(), field.count);
    return code == std::errc() && stop == inside.data() + inside.size();
  }

  bool readType(std::size_t index, std::string_view type, RosField& field) const {
    type = type.substr(0, type.find("<="));  // of a text
    const auto known = std::ranges::find(rosNames, type, &RosName::name);
    if (known != rosNames.end()) {
      field.kind = m_isRos1 && type == "byte" ? RosKind::Int8 : known->kind;
      return true;
    }
    const std::string name = shortType(type);
    if (name == "builtin_interfaces/Time" || (m_isRos1 && type == "time")) {
      field.kind = RosKind::Time;
      return true;
    }
    if (name == "builtin_interfaces/Duration" || (m_isRos1 && type == "duration")) {
      field.kind = RosKind::TimeSpan;
      return true;
    }
    field.kind = RosKind::Struct;
    const std::optional<std::size_t> found = find(index, name);
    if (found) field.type = *found;
    return found.has_value();
  }

  /// A type without a package is of the same package. ROS 1 also knows "Header".
  std::optional<std::size_t> find(std::size_t index, const std::string& name) const {
    std::vector<std::string> candidates{name};
    if (name.find('/') == name.npos) {
      const std::string& own = m_sections[index].name;
      candidates = {own.substr(0, own.find('/') + 1) + name};
      if (name == "Header") candidates.push_back("std_msgs/Header");
      candidates.push_back(name);
    }
    for (const std::string& candidate : candidates) {
      if (const auto found = m_index.find(candidate); found != m_index.end()) return found->second;
    }
    return {};
  }

  std::string m_rootText;  ///< of an event of a service
  std::vector<MessageSection> m_sections;
  std::map<std::string, std::size_t> m_index;
  bool m_isRos1;
  RosTypes m_types;
  int m_line = 0;
  std::size_t m_fields = 0;
};

}  // namespace

Result<RosTypes> rosTypesFromMessage(std::string_view type, std::string_view text, bool isRos1) {
  if (text.size() > maxRosText) {
    return failure(ErrorCode::ParseError, "The schema is larger than 4 MiB.");
  }
  return MessageText(type, text, isRos1).read();
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How decoders make fields of a message. A decoder walks through the message twice at most: each
// time with ValueOut, which takes the values and what distinguishes the shapes of messages (lengths
// of arrays, names of elements, keys), and with PathOut for the first message of each shape, which
// makes the paths of the fields. Both see the same calls. Private to recordings; one thread.

#include <cstring>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <telemetry/recordings/recording.h>

namespace pitchboard::telemetry {

/// Longer arrays are data of sensors, not variables.
inline constexpr std::size_t maxRecordedElements = 256;
inline constexpr std::size_t maxRecordedFields = 4096;  ///< of a message
inline constexpr std::size_t maxRecordedText = 4096;    ///< bytes; longer texts are cut
/// Fields of all shapes of a topic that are kept; then they are forgotten and made again.
inline constexpr std::size_t maxShapeFields = 50'000;
inline constexpr int maxRecordedDepth = 32;

/// A message without its schema.
struct DecodedMessage {
  std::shared_ptr<const RecordedShape> shape;
  std::vector<double> values;
  std::vector<std::string_view> texts;
  std::deque<std::string> ownTexts;  ///< what `texts` refer to besides the message
  std::optional<std::int64_t> stamp;
  std::uint64_t leftOut = 0;  ///< values beyond the limits

  /// The shape stays until there is another.
  void clear() {
    values.clear();
    texts.clear();
    if (!ownTexts.empty()) ownTexts.clear();
    stamp.reset();
    leftOut = 0;
  }
};

/// Returns at most `most` bytes of a UTF-8 text, whole characters only.
inline std::string_view cutText(std::string_view text, std::size_t most = maxRecordedText) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  return text.substr(0, most);
}

/// Returns seconds of ns, as near as a double can be.
inline double secondsFromNs(std::int64_t time) {
  constexpr std::int64_t second = 1'000'000'000;
  return static_cast<double>(time / second) + static_cast<double>(time % second) * 1e-9;
}

using FieldLabels = std::map<std::int32_t, std::string>;
inline const FieldLabels noLabels;
inline const std::string noUnit;

/// Takes the values.
class ValueOut {
 public:
  explicit ValueOut(DecodedMessage& to, std::string& signature)
      : m_to(to), m_signature(signature) {}

  void enter(std::string_view) {}
  void leave() {}
  void element(std::size_t) { ++m_elements; }
  void element(std::size_t, std::string_view) { ++m_elements; }
  void leaveElement() { --m_elements; }
  void mark(std::uint32_t number) {
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    m_signature.append(bytes, sizeof number);
  }
  void mark(std::string_view text) {
    mark(static_cast<std::uint32_t>(text.size()));
    m_signature += text;
  }
  void elementName(std::string_view text) {
    if (m_elements > 0) mark(text);
  }
  void number(double value, RecordedKind, const std::string&, const FieldLabels& = noLabels) {
    if (isFull()) return;
    m_to.values.push_back(value);
  }
  void text(std::string_view text) {
    if (isFull()) return;
    m_to.values.push_back(std::numeric_limits<double>::quiet_NaN());
    m_to.texts.push_back(cutText(text));
  }
  void stamp(std::int64_t time) {
    if (!m_to.stamp) m_to.stamp = time;
  }
  void leaveOut(std::size_t count) { m_to.leftOut += count; }

 private:
  bool isFull() {
    if (m_to.values.size() < maxRecordedFields) return false;
    ++m_to.leftOut;
    return true;
  }
  DecodedMessage& m_to;
  std::string& m_signature;
  int m_elements = 0;
};

/// Makes the paths.
class PathOut {
 public:
  void enter(std::string_view name) {
    m_ends.push_back(m_path.size());
    if (!m_path.empty() && !name.empty()) m_path += '.';
    m_path += cutText(name, 200);
  }
  void leave() {
    m_path.resize(m_ends.back());
    m_ends.pop_back();
  }
  void element(std::size_t index) { element(index, std::to_string(index)); }
  void element(std::size_t, std::string_view name) {
    m_elements.push_back({m_path.size(), m_shape->fields.size(), m_ends.size(), {}});
    m_path += '[';
    m_path += cutText(name, 200);
    m_path += ']';
  }
  /// An element that says what it is called gets its name instead of its index.
  void leaveElement();
  void mark(std::uint32_t) {}
  void mark(std::string_view) {}
  void elementName(std::string_view text) {
    // Not a name somewhere inside the element.
    if (m_elements.empty() || m_ends.size() != m_elements.back().depth + 1) return;
    m_elements.back().name = cutText(text, 200);
  }
  void number(double, RecordedKind kind, const std::string& unit,
              const FieldLabels& labels = noLabels) {
    add({m_path, kind, unit, labels});
  }
  void text(std::string_view) { add({m_path, RecordedKind::Text, {}, {}}); }
  void stamp(std::int64_t) {}
  void leaveOut(std::size_t) {}

  /// Paths that occur twice get a number.
  std::shared_ptr<const RecordedShape> finish();

 private:
  struct Element {
    std::size_t pathBegin, fieldBegin, depth;
    std::string name;
  };
  void add(RecordedField field) {
    if (m_shape->fields.size() < maxRecordedFields) m_shape->fields.push_back(std::move(field));
  }
  std::shared_ptr<RecordedShape> m_shape = std::make_shared<RecordedShape>();
  std::string m_path;
  std::vector<std::size_t> m_ends;
  std::vector<Element> m_elements;
};

/// Passes over what is not kept.
class NoOut {
 public:
  void enter(std::string_view) {}
  void leave() {}
  void element(std::size_t) {}
  void element(std::size_t, std::string_view) {}
  void leaveElement() {}
  void mark(std::uint32_t) {}
  void mark(std::string_view) {}
  void elementName(std::string_view) {}
  void number(double, RecordedKind, const std::string&, const FieldLabels& = noLabels) {}
  void text(std::string_view) {}
  void stamp(std::int64_t) {}
  void leaveOut(std::size_t) {}
};

/// The shapes of a topic that were seen.
class MessageShapes {
 public:
  /// Decodes a message: `walk` is called with a ValueOut, and for a new shape with a PathOut; it
  /// returns false if the message is not what its schema says.
  template <class Walk>
  bool decode(DecodedMessage& to, Walk&& walk) {
    to.clear();
    m_signature.clear();
    ValueOut values(to, m_signature);
    if (!walk(values)) return false;
    if (m_last && m_signature == m_lastSignature) {
      to.shape = m_last;
      return true;
    }
    auto& known = m_known[m_signature];
    if (!known) {
      PathOut paths;
      if (!walk(paths)) return false;
      known = paths.finish();
      m_fields += known->fields.size() + 10 + m_signature.size() / 16;
    }
    m_last = to.shape = known;
    m_lastSignature = m_signature;
    if (m_fields > maxShapeFields) {
      m_known.clear();
      m_fields = 0;
    }
    return to.shape->fields.size() == to.values.size();
  }

 private:
  std::string m_signature, m_lastSignature;
  std::shared_ptr<const RecordedShape> m_last;
  std::unordered_map<std::string, std::shared_ptr<const RecordedShape>> m_known;
  std::size_t m_fields = 0;  ///< of all of `m_known`
};

/// Names of a field by which the elements of a list are called.
bool isElementName(std::string_view field);
/// Names of a list of texts that name the elements of the lists beside it.
bool isNameList(std::string_view field);
/// Names of the time at which a message was measured.
bool isStampName(std::string_view field);

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes messages of ROS: CDR in the versions XCDR1 and XCDR2 (OMG DDS-XTypes 1.3, chapter 7.4) in
// both byte orders, and ROS 1. The first four bytes of CDR say which it is; positions are aligned
// as counted from behind them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

#include <base/try.h>

#include "message_decoder.h"
#include "ros_types.h"

namespace pitchboard::telemetry {
namespace {

constexpr double nanosecond = 1e-9;

/// The bytes of a message. Never reads past the end: then ok() is false, and numbers are 0.
class CdrBytes {
 public:
  CdrBytes(std::string_view bytes, bool isSwapped, std::size_t maxAlignment)
      : m_begin(bytes.data()),
        m_at(bytes.data()),
        m_end(bytes.data() + bytes.size()),
        m_maxAlignment(maxAlignment),
        m_isSwapped(isSwapped) {}

  template <class T>
  T number() {
    align(sizeof(T));
    if (left() < sizeof(T)) {
      fail();
      return T{};
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, m_at, sizeof(T));
    m_at += sizeof(T);
    if (m_isSwapped) std::reverse(bytes, bytes + sizeof(T));
    return std::bit_cast<T>(bytes);
  }
  std::string_view bytes(std::size_t count) {
    if (count > left()) {
      fail();
      return {};
    }
    const std::string_view taken(m_at, count);
    m_at += count;
    return taken;
  }
  void align(std::size_t size) {
    const std::size_t step = std::min(size, m_maxAlignment);
    const std::size_t over = static_cast<std::size_t>(m_at - m_begin) & (step - 1);
    if (over != 0) bytes(step - over);
  }
  /// What follows is aligned as if the message began here.
  const char* beginHere() { return std::exchange(m_begin, m_at); }
  void beginAt(const char* begin) { m_begin = begin; }

  bool ok() const { return m_ok; }
  void fail() {
    m_ok = false;
    m_at = m_end;
  }
  std::size_t left() const { return static_cast<std::size_t>(m_end - m_at); }
  const char* at() const { return m_at; }
  const char* end() const { return m_end; }
  /// The end of the part that is read now; returns the one before.
  const char* limit(const char* end) { return std::exchange(m_end, end); }
  void jump(const char* to) { m_at = to; }

 private:
  const char *m_begin, *m_at, *m_end;
  std::size_t m_maxAlignment;
  bool m_isSwapped;
  bool m_ok = true;
};

void appendUtf8(std::string& out, std::uint32_t c) {
  if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) c = 0xFFFD;
  const auto put = [&out](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xC0 | c >> 6U);
  } else {
    if (c < 0x10000) {
      put(0xE0 | c >> 12U);
    } else {
      put(0xF0 | c >> 18U);
      put(0x80 | (c >> 12U & 0x3FU));
    }
    put(0x80 | (c >> 6U & 0x3FU));
  }
  put(0x80 | (c & 0x3FU));
}

/// How the bytes of a message are laid out.
struct CdrFormat {
  bool isRos1 = false;
  bool isXcdr2 = false;
  bool hasListLengths = true;  ///< of XCDR2: some writers leave them out
  Extensibility unsaid = Extensibility::Final;
};

std::size_t sizeOfRos(RosKind kind) {
  switch (kind) {
    case RosKind::Bool:
    case RosKind::Int8:
    case RosKind::UInt8:
      return 1;
    case RosKind::Int16:
    case RosKind::UInt16:
      return 2;
    case RosKind::Int64:
    case RosKind::UInt64:
    case RosKind::Float64:
      return 8;
    case RosKind::LongDouble:
      return 16;
    default:
      return 4;
  }
}

/// The value of an IEEE quadruple, as near as a double can be.
double fromQuadruple(std::span<const unsigned char, 16> bytes) {  // little-endian
  const int exponent = (bytes[15] & 0x7F) << 8 | bytes[14];
  double fraction = exponent == 0 ? 0.0 : 1.0;
  double scale = 1.0;
  for (int i = 13; i >= 6; --i) fraction += bytes[static_cast<std::size_t>(i)] * (scale /= 256.0);
  const double sign = (bytes[15] & 0x80) != 0 ? -1.0 : 1.0;
  if (exponent == 0x7FFF) {
    return fraction == 1.0 ? sign * std::numeric_limits<double>::infinity()
                           : std::numeric_limits<double>::quiet_NaN();
  }
  return sign * std::ldexp(fraction, exponent - 16383);
}

/// One walk through a message.
template <class Out>
class CdrWalk {
 public:
  CdrWalk(const RosTypes& types, CdrBytes& in, const CdrFormat& format, DecodedMessage& owner,
          Out& out)
      : m_types(types),
        m_in(in),
        m_format(format),
        m_owner(owner),
        m_out(out),
        m_steps(16 * in.left() + 10'000) {}

  bool run() {
    readStruct(m_types.structs[m_types.root], true, m_out);
    return m_in.ok();
  }

 private:
  using Names = std::vector<std::string_view>;

  template <class To>
  void readStruct(const RosStruct& type, bool isRoot, To& to) {
    if (type.fields.empty() && !m_types.isIdl && !m_format.isRos1 && (!isRoot || m_in.left() > 0)) {
      m_in.number<std::uint8_t>();  // C++ has no empty structures
      return;
    }
    const Extensibility kind =
        type.extensibility == Extensibility::Unsaid ? m_format.unsaid : type.extensibility;
    if (!m_format.isXcdr2 || kind == Extensibility::Final) return readFields(type, false, to);
    readPart([&] {
      if (kind == Extensibility::Mutable)
        readMembers(type, to);
      else
        readFields(type, true, to);
    });
  }

  /// A part with its length in front. What a later version added is passed over.
  template <class Read>
  void readPart(Read&& read) {
    const auto length = m_in.template number<std::uint32_t>();
    if (length > m_in.left()) return m_in.fail();
    const char* const end = m_in.at() + length;
    const char* const outer = m_in.limit(end);
    read();
    m_in.limit(outer);
    if (m_in.ok())
      m_in.jump(end);
    else
      m_in.fail();
  }

  template <class To>
  void readFields(const RosStruct& type, bool isPart, To& to) {
    Names names;
    for (const RosField& field : type.fields) {
      if (!m_in.ok()) return;
      // An appendable struct of an earlier version ends before.
      if (isPart && m_in.left() == 0) return to.mark(std::uint32_t{0});
      if (field.isOptional && !readPresence(field, type, to)) continue;
      readField(type, field, names, to);
    }
  }

  /// Whether an optional field is there.
  template <class To>
  bool readPresence(const RosField& field, const RosStruct& type, To& to) {
    if (m_format.isXcdr2) {
      const bool isThere = m_in.template number<std::uint8_t>() != 0;
      to.mark(std::uint32_t{isThere});
      return isThere;
    }
    // XCDR1 writes it as a member with a header and a length.
    m_in.align(4);
    auto id = std::uint32_t{m_in.template number<std::uint16_t>()} & 0x3FFFU;
    std::uint32_t length = m_in.template number<std::uint16_t>();
    constexpr std::uint32_t extendedId = 0x3F01;
    if (id == extendedId) {
      id = m_in.template number<std::uint32_t>();
      length = m_in.template number<std::uint32_t>();
    }
    to.mark(std::uint32_t{length != 0});
    if (length == 0) return false;
    if (length > m_in.left()) {
      m_in.fail();
      return false;
    }
    const char* const end = m_in.at() + length;
    const char* const outer = m_in.limit(end);
    const char* const begin = m_in.beginHere();
    Names names;
    readField(type, field, names, to);
    m_in.beginAt(begin);
    m_in.limit(outer);
    if (m_in.ok())
      m_in.jump(end);
    else
      m_in.fail();
    return false;  // it was read
  }

  /// Members of a mutable struct, each with its number and length.
  template <class To>
  void readMembers(const RosStruct& type, To& to) {
    Names names;
    while (m_in.ok() && m_in.left() >= 4) {
      const auto head = m_in.template number<std::uint32_t>();
      const std::uint32_t id = head & 0x0FFF'FFFFU, code = head >> 28U & 7U;
      std::uint64_t length = std::uint64_t{1} << code;
      if (code >= 4) {
        const char* const before = m_in.at();
        length = m_in.template number<std::uint32_t>();
        // The length is also the one that a list or a part begins with.
        if (code >= 5) m_in.jump(before);
        if (code >= 6) length *= code == 6 ? 4 : 8;
        if (code >= 5) length += 4;
      }
      if (length > m_in.left()) return m_in.fail();
      const char* const end = m_in.at() + length;
      const auto field = std::ranges::find(type.fields, id, &RosField::id);
      to.mark(id);
      if (field != type.fields.end()) {
        const char* const outer = m_in.limit(end);
        readField(type, *field, names, to);
        m_in.limit(outer);
        if (!m_in.ok()) return m_in.fail();
      }
      m_in.jump(end);
      if (m_in.left() >= 4) m_in.align(4);
    }
  }

  bool step() {
    if (m_steps == 0) {
      m_in.fail();
      return false;
    }
    --m_steps;
    return true;
  }

  template <class To>
  void readField(const RosStruct& type, const RosField& field, Names& names, To& to) {
    if (!step()) return;
    if (field.list == RosList::One) {
      to.enter(field.name);
      readOne(type, field, to);
      to.leave();
      return;
    }
    const bool hasLength = m_format.isXcdr2 && m_format.hasListLengths &&
                           (field.kind >= RosKind::Text || field.kind == RosKind::Enumeration);
    if (hasLength) {
      readPart([&] { readList(type, field, names, to); });
    } else {
      readList(type, field, names, to);
    }
  }

  template <class To>
  void readList(const RosStruct& type, const RosField& field, Names& names, To& to) {
    const std::size_t count =
        field.list == RosList::Array ? field.count : m_in.template number<std::uint32_t>();
    if (!m_in.ok()) return;
    if (field.kind <= RosKind::LongDouble) return readNumbers(field, count, names, to);
    if (count > m_steps) return m_in.fail();
    if (field.namesLists) return readNames(count, names, to);
    const bool isKept = count <= maxRecordedElements;
    to.mark(isKept ? static_cast<std::uint32_t>(count) : ~std::uint32_t{0});
    if (!isKept) {
      to.leaveOut(count);
      NoOut nowhere;
      for (std::size_t i = 0; i < count && m_in.ok() && step(); ++i) readOne(type, field, nowhere);
      return;
    }
    to.enter(field.name);
    for (std::size_t i = 0; i < count && m_in.ok() && step(); ++i) {
      to.element(i);
      readOne(type, field, to);
      to.leaveElement();
    }
    to.leave();
  }

  template <class To>
  void readNames(std::size_t count, Names& names, To& to) {
    to.mark(static_cast<std::uint32_t>(std::min(count, maxRecordedElements + 1)));
    names.clear();
    for (std::size_t i = 0; i < count && m_in.ok() && step(); ++i) {
      const std::string_view name = cutText(readText(), 200);
      if (count > maxRecordedElements) continue;
      names.push_back(name);
      to.mark(name);
    }
    // What has no name, or the name of another, is called by its index.
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].empty()) return names.clear();
    }
  }

  template <class To>
  void readNumbers(const RosField& field, std::size_t count, const Names& names, To& to) {
    const std::size_t size = sizeOfRos(field.kind);
    if (count > m_in.left() / size) return m_in.fail();
    if (count > maxRecordedElements) {
      to.mark(~std::uint32_t{0});
      to.leaveOut(count);
      m_in.align(size);
      m_in.bytes(count * size);
      return;
    }
    to.mark(static_cast<std::uint32_t>(count));
    if (count == 0) return;
    to.enter(field.name);
    const bool isNamed = names.size() == count;
    for (std::size_t i = 0; i < count; ++i) {
      if (isNamed) {
        to.element(i, names[i]);
      } else {
        to.element(i);
      }
      readNumber(field, to);
      to.leaveElement();
    }
    to.leave();
  }

  template <class To>
  void readOne(const RosStruct&, const RosField& field, To& to) {
    if (field.kind <= RosKind::LongDouble || field.kind == RosKind::Enumeration) {
      return readNumber(field, to);
    }
    switch (field.kind) {
      case RosKind::Text: {
        const std::string_view text = readText();
        if (field.namesElement) to.elementName(text);
        return to.text(text);
      }
      case RosKind::WideText:
        return to.text(readWideText());
      case RosKind::Time:
      case RosKind::TimeSpan:
        return readTime(field, to);
      default: {
        // A unit is that of all numbers in a struct: of a position's x, y and z.
        const std::string* outer = m_unit;
        if (!field.unit.empty()) m_unit = &field.unit;
        readStruct(m_types.structs[field.type], false, to);
        m_unit = outer;
      }
    }
  }

  template <class To>
  void readNumber(const RosField& field, To& to) {
    const std::string& unit = field.unit.empty() ? *m_unit : field.unit;
    const auto put = [&](auto value) {
      to.number(
          static_cast<double>(value),
          field.kind == RosKind::Enumeration ? RecordedKind::Enumeration : RecordedKind::Number,
          unit, field.labels);
    };
    switch (field.kind) {
      case RosKind::Bool: {
        const auto flag = m_in.template number<std::uint8_t>();
        if (flag > 1) return m_in.fail();
        return to.number(flag, RecordedKind::Flag, unit);
      }
      case RosKind::Int8:
        return put(m_in.template number<std::int8_t>());
      case RosKind::UInt8:
        return put(m_in.template number<std::uint8_t>());
      case RosKind::Int16:
        return put(m_in.template number<std::int16_t>());
      case RosKind::UInt16:
        return put(m_in.template number<std::uint16_t>());
      case RosKind::UInt32:
        return put(m_in.template number<std::uint32_t>());
      case RosKind::Int64:
        return put(m_in.template number<std::int64_t>());
      case RosKind::UInt64:
        return put(m_in.template number<std::uint64_t>());
      case RosKind::Float32:
        return put(m_in.template number<float>());
      case RosKind::Float64:
        return put(m_in.template number<double>());
      case RosKind::LongDouble: {
        // Aligned to 8 at most.
        const auto low = m_in.template number<std::uint64_t>(),
                   high = m_in.template number<std::uint64_t>();
        const std::array<std::uint64_t, 2> words =
            m_isBig ? std::array{high, low} : std::array{low, high};
        const auto bytes = std::bit_cast<std::array<unsigned char, 16>>(words);
        return put(fromQuadruple(bytes));
      }
      default:
        return put(m_in.template number<std::int32_t>());
    }
  }

  std::string_view readText() {
    const auto length = m_in.template number<std::uint32_t>();
    std::string_view text = m_in.bytes(length);
    if (!m_format.isRos1 && text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }

  std::string_view readWideText() {
    const auto count = m_in.template number<std::uint32_t>();
    if (count > m_in.left() / 4) {
      m_in.fail();
      return {};
    }
    std::string& text = m_owner.ownTexts.emplace_back();
    for (std::uint32_t i = 0; i < count; ++i) {
      appendUtf8(text, m_in.template number<std::uint32_t>());
    }
    return text;
  }

  template <class To>
  void readTime(const RosField& field, To& to) {
    const auto first = m_in.template number<std::int32_t>();
    // In ROS 1 a time is unsigned, and a duration is two signed numbers.
    const bool isUnsigned = m_format.isRos1 && field.kind == RosKind::Time;
    const std::int64_t seconds =
        isUnsigned ? std::int64_t{std::bit_cast<std::uint32_t>(first)} : std::int64_t{first};
    const auto part = m_in.template number<std::uint32_t>();
    const std::int64_t nanoseconds = m_format.isRos1 && !isUnsigned
                                         ? std::int64_t{std::bit_cast<std::int32_t>(part)}
                                         : std::int64_t{part};
    if (field.isStamp) to.stamp(seconds * 1'000'000'000 + nanoseconds);
    to.number(static_cast<double>(seconds) + static_cast<double>(nanoseconds) * nanosecond,
              RecordedKind::Number, field.unit);
  }

  const RosTypes& m_types;
  CdrBytes& m_in;
  const CdrFormat& m_format;
  DecodedMessage& m_owner;
  Out& m_out;
  std::size_t m_steps;
  const std::string* m_unit = &noUnit;  ///< of the struct that is read

 public:
  bool m_isBig = false;
};

/// The first four bytes of a CDR message.
struct CdrHead {
  bool isBig = false, isXcdr2 = false, isParameterList = false;
  Extensibility unsaid = Extensibility::Final;
};

/// Nothing for representations that nobody here knows. The codes 0x06 to 0x0b are those of RTPS
/// 2.5, 0x10 to 0x15 those of earlier writers.
std::optional<CdrHead> cdrHead(std::string_view bytes) {
  if (bytes.size() < 4 || bytes[0] != 0) return {};
  const auto code = static_cast<unsigned char>(bytes[1]);
  CdrHead head;
  head.isBig = code % 2 == 0;
  if (code <= 1) return head;
  if (code <= 3) {
    head.isParameterList = true;
    return head;
  }
  head.isXcdr2 = true;
  switch (code / 2) {
    case 3:
    case 8:
      return head;
    case 4:
      head.unsaid = Extensibility::Appendable;
      return head;
    case 5:
    case 9:
      head.unsaid = Extensibility::Mutable;
      return head;
    case 10:
      head.unsaid = Extensibility::Appendable;
      return head;
    default:
      return {};
  }
}

class RosDecoder : public MessageDecoder {
 public:
  RosDecoder(RosTypes types, bool isRos1) : m_types(std::move(types)), m_isRos1(isRos1) {}

  bool decode(std::string_view message, DecodedMessage& to) override {
    CdrFormat format;
    format.isRos1 = m_isRos1;
    bool isBig = false;
    if (!m_isRos1) {
      const auto head = cdrHead(message);
      if (!head || head->isParameterList) return false;
      message.remove_prefix(4);
      isBig = head->isBig;
      format.isXcdr2 = head->isXcdr2;
      format.unsaid = head->unsaid;
      format.hasListLengths = m_hasListLengths;
    }
    if (decodeAs(message, format, isBig, to)) return true;
    if (!format.isXcdr2) return false;
    // RTI's writer leaves out the lengths of lists.
    format.hasListLengths = !format.hasListLengths;
    to.clear();
    if (!decodeAs(message, format, isBig, to)) return false;
    m_hasListLengths = format.hasListLengths;
    return true;
  }

 private:
  bool decodeAs(std::string_view message, const CdrFormat& format, bool isBig, DecodedMessage& to) {
    return m_shapes.decode(to, [&]<class Out>(Out& out) {
      CdrBytes in(message, isBig, format.isRos1 ? 1 : format.isXcdr2 ? 4 : 8);
      CdrWalk<Out> walk(m_types, in, format, to, out);
      walk.m_isBig = isBig;
      // A message may be filled up to a multiple of four.
      return walk.run() && in.left() < 4 && (!format.isRos1 || in.left() == 0);
    });
  }

  RosTypes m_types;
  bool m_isRos1;
  bool m_hasListLengths = true;
  MessageShapes m_shapes;
};

}  // namespace

Result<std::unique_ptr<MessageDecoder>> makeRosDecoder(const MessageSchema& schema) {
  const bool isRos1 = schema.messageEncoding == "ros1";
  if (isRos1 ? schema.schemaEncoding == "ros1msg" : schema.schemaEncoding == "ros2msg") {
    return std::make_unique<RosDecoder>(
        TRY(rosTypesFromMessage(schema.type, schema.schema, isRos1)), isRos1);
  }
  if (!isRos1 && (schema.schemaEncoding == "ros2idl" || schema.schemaEncoding == "omgidl")) {
    return std::make_unique<RosDecoder>(TRY(rosTypesFromIdl(schema.type, schema.schema)), false);
  }
  return failure(ErrorCode::Unsupported,
                 schema.schema.empty()
                     ? std::string("The recording does not have the definition of this type.")
                     : "The schema encoding \"" + std::string(schema.schemaEncoding.substr(0, 40)) +
                           "\" is not supported.");
}

}  // namespace pitchboard::telemetry

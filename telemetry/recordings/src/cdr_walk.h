// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Walks through a message of ROS field by field, as its types say: XCDR1 and XCDR2 in both byte
// orders, and ROS 1. Whatever is found goes to an `Out` of message_shape.h, or to a PlanOut
// (cdr_plan.h), which also gets the places. Private to recordings; one thread.

#include <array>
#include <optional>

#include "cdr_bytes.h"
#include "cdr_plan.h"
#include "message_shape.h"

namespace pitchboard::telemetry {

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
    if (!m_format.isXcdr2) {
      const bool isList = isRoot ? m_format.isParameterList : kind == Extensibility::Mutable;
      if (isList && !type.isUnion && !m_format.isRos1) return readParameters(type, to);
      return readPlain(type, false, to);
    }
    if (kind == Extensibility::Final) return readPlain(type, false, to);
    readPart([&] {
      if (kind == Extensibility::Mutable)
        readMembers(type, to);
      else
        readPlain(type, true, to);
    });
  }

  template <class To>
  void readPlain(const RosStruct& type, bool isPart, To& to) {
    if (type.isUnion)
      readUnion(type, to);
    else
      readFields(type, isPart, to);
  }

  /// The first field of a union says which of the others there is.
  template <class To>
  void readUnion(const RosStruct& type, To& to) {
    Names names;
    const RosField& choice = type.fields.front();
    const char* const before = m_in.at();
    const std::int64_t value = readWhole(choice.kind);
    m_in.jump(before);
    readField(type, choice, names, to);
    if (!m_in.ok()) return;
    const RosField* chosen = nullptr;
    for (std::size_t i = 1; i < type.fields.size(); ++i) {
      const RosField& field = type.fields[i];
      if (std::ranges::find(field.cases, value) != field.cases.end()) {
        chosen = &field;
        break;
      }
      if (field.isDefaultCase) chosen = &field;
    }
    to.mark(chosen == nullptr ? ~std::uint32_t{0}
                              : static_cast<std::uint32_t>(chosen - type.fields.data()));
    if (chosen != nullptr) readField(type, *chosen, names, to);
  }

  std::int64_t readWhole(RosKind kind) {
    switch (kind) {
      case RosKind::Bool:
      case RosKind::UInt8:
        return m_in.template number<std::uint8_t>();
      case RosKind::Int8:
        return m_in.template number<std::int8_t>();
      case RosKind::Int16:
        return m_in.template number<std::int16_t>();
      case RosKind::UInt16:
        return m_in.template number<std::uint16_t>();
      case RosKind::UInt32:
        return m_in.template number<std::uint32_t>();
      case RosKind::Int64:
      case RosKind::UInt64:
        return m_in.template number<std::int64_t>();
      default:
        return m_in.template number<std::int32_t>();
    }
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
    const Parameter head = readParameterHead();
    to.mark(std::uint32_t{head.length != 0});
    if (head.length != 0) readParameter(type, &field, head.length, to);
    return false;  // it was read
  }

  /// A member of XCDR1 with its number and length in front: an optional one, or one of a list.
  struct Parameter {
    std::uint32_t id = 0, length = 0;
    bool isEnd = false;
  };
  Parameter readParameterHead() {
    constexpr std::uint32_t extendedId = 0x3F01, endId = 0x3F02;
    m_in.align(4);
    Parameter head;
    head.id = std::uint32_t{m_in.template number<std::uint16_t>()} & 0x3FFFU;
    head.length = m_in.template number<std::uint16_t>();
    head.isEnd = head.id == endId;
    if (head.id == extendedId) {
      head.id = m_in.template number<std::uint32_t>() & 0x0FFF'FFFFU;
      head.length = m_in.template number<std::uint32_t>();
    }
    return head;
  }

  /// Alignment is counted from where the member begins. Without a field it is passed over.
  template <class To>
  void readParameter(const RosStruct& type, const RosField* field, std::uint32_t length, To& to) {
    if (length > m_in.left()) return m_in.fail();
    const char* const end = m_in.at() + length;
    const char* const outer = m_in.limit(end);
    const char* const begin = m_in.beginHere();
    Names names;
    if (field != nullptr) readField(type, *field, names, to);
    m_in.beginAt(begin);
    m_in.limit(outer);
    if (m_in.ok())
      m_in.jump(end);
    else
      m_in.fail();
  }

  /// A mutable struct of XCDR1: members in any order, until a mark.
  template <class To>
  void readParameters(const RosStruct& type, To& to) {
    while (m_in.ok() && step()) {
      const Parameter head = readParameterHead();
      if (head.isEnd || !m_in.ok()) return;
      const auto field = std::ranges::find(type.fields, head.id, &RosField::id);
      to.mark(head.id);
      readParameter(type, field == type.fields.end() ? nullptr : &*field, head.length, to);
    }
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
    const std::size_t count = field.list == RosList::Array ? field.count : readCount(to);
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
  std::uint32_t readCount(To& to) {
    if constexpr (TakesPlaces<To>) to.expect(m_in.placeOf(4), 4);
    return m_in.template number<std::uint32_t>();
  }

  template <class To>
  void readNames(std::size_t count, Names& names, To& to) {
    to.mark(static_cast<std::uint32_t>(std::min(count, maxRecordedElements + 1)));
    names.clear();
    for (std::size_t i = 0; i < count && m_in.ok() && step(); ++i) {
      const std::string_view name = cutText(readText(to), 200);
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
        const std::string_view text = readText(to);
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
    if constexpr (TakesPlaces<To>) to.at(m_in.placeOf(sizeOfRos(field.kind)), field.kind);
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

  template <class To>
  std::string_view readText(To& to) {
    const std::string_view bytes = m_in.bytes(readCount(to));
    if constexpr (TakesPlaces<To>) to.atText(bytes);
    return rosText(bytes, m_format.isRos1);
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
    if constexpr (TakesPlaces<To>) to.at(m_in.placeOf(4), field.kind);
    const auto first = m_in.template number<std::int32_t>();
    const auto second = m_in.template number<std::uint32_t>();
    const RosTime time = rosTime(field.kind, first, second, m_format.isRos1);
    if (field.isStamp) to.stamp(time.nanoseconds());
    to.number(time.inSeconds(), RecordedKind::Number, field.unit);
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

}  // namespace pitchboard::telemetry

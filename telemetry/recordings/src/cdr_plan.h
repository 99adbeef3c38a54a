// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decodes messages that are laid out as one before: the lengths of its lists and texts, and the
// names of its elements, are compared in a few pieces, and then every number stands at a known
// place. Most topics send such messages. Only plain little-endian CDR of version 1 and ROS 1, whose
// layout depends on nothing else. Private to recordings; one thread.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "message_shape.h"
#include "ros_types.h"

namespace pitchboard::telemetry {

/// Returns whether the layout of such messages follows from lengths and names alone.
bool isPlannable(const RosTypes& types);

class CdrPlan {
 public:
  /// Decodes a message without its head, and returns true; or returns false if the message is laid
  /// out differently, or has a flag that is none. Then `to` is of no use.
  bool decode(std::string_view message, DecodedMessage& to) const;

 private:
  friend class PlanOut;
  struct Piece {
    std::uint32_t place, length;
  };
  /// Values of one kind, one behind the other; or a text with its length in bytes.
  struct Run {
    RosKind kind;
    bool isStamp;
    std::uint32_t place, count, value;
  };
  std::size_t m_size = 0;  ///< of a message
  bool m_isRos1 = false;
  std::vector<Piece> m_pieces;
  std::string m_expected;  ///< the bytes of all pieces
  std::vector<Run> m_runs;
  std::size_t m_values = 0, m_texts = 0;
  std::shared_ptr<const RecordedShape> m_shape;
};

/// Makes a plan, as an `Out` that is told where a value stands before it comes.
class PlanOut {
 public:
  explicit PlanOut(std::string_view message) : m_message(message) {}

  void at(std::size_t place, RosKind kind) {
    m_place = static_cast<std::uint32_t>(place);
    m_kind = kind;
  }
  void atText(std::string_view bytes) {
    m_place = static_cast<std::uint32_t>(bytes.data() - m_message.data());
    m_length = static_cast<std::uint32_t>(bytes.size());
  }
  /// The layout depends on these bytes.
  void expect(std::size_t place, std::size_t length);

  void enter(std::string_view) {}
  void leave() {}
  void element(std::size_t) { ++m_elements; }
  void element(std::size_t, std::string_view) { ++m_elements; }
  void leaveElement() { --m_elements; }
  void mark(std::uint32_t) {}
  void mark(std::string_view) { expect(m_place, m_length); }
  void elementName(std::string_view) {
    if (m_elements > 0) expect(m_place, m_length);
  }
  void number(double, RecordedKind, const std::string&, const FieldLabels& = noLabels);
  void text(std::string_view);
  void stamp(std::int64_t) { m_isStamp = true; }
  void leaveOut(std::size_t) { m_isWhole = false; }

  /// Returns the plan; nothing if such messages are too large for one.
  std::unique_ptr<CdrPlan> finish(std::shared_ptr<const RecordedShape> shape, bool isRos1);

 private:
  void add(CdrPlan::Run run);
  std::string_view m_message;
  std::unique_ptr<CdrPlan> m_plan = std::make_unique<CdrPlan>();
  std::uint32_t m_place = 0, m_length = 0;
  RosKind m_kind = RosKind::Bool;
  bool m_isStamp = false, m_isWhole = true;
  bool m_hasValues = false;  ///< since the last piece
  int m_elements = 0;
};

template <class Out>
concept TakesPlaces = requires(Out out) {
  out.expect(std::size_t{}, std::size_t{});
};

}  // namespace pitchboard::telemetry

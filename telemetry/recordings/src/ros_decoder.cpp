// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes messages of ROS: CDR in the versions XCDR1 and XCDR2 (OMG DDS-XTypes 1.3, chapter 7.4) in
// both byte orders, and ROS 1. The first four bytes of CDR say which it is; positions are aligned
// as counted from behind them.
#include <algorithm>
#include <optional>

#include <base/try.h>

#include "cdr_walk.h"
#include "message_decoder.h"

namespace pitchboard::telemetry {
namespace {

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

/// Layouts of messages of a topic that are kept; several programs can send to one.
constexpr std::size_t maxPlans = 8;

class RosDecoder : public MessageDecoder {
 public:
  RosDecoder(RosTypes types, bool isRos1)
      : m_types(std::move(types)), m_isRos1(isRos1), m_isPlannable(isPlannable(m_types)) {}

  bool decode(std::string_view message, DecodedMessage& to) override {
    CdrFormat format;
    format.isRos1 = m_isRos1;
    bool isBig = false;
    if (!m_isRos1) {
      const auto head = cdrHead(message);
      if (!head) return false;
      message.remove_prefix(4);
      isBig = head->isBig;
      format.isXcdr2 = head->isXcdr2;
      format.isParameterList = head->isParameterList;
      format.unsaid = head->unsaid;
      format.hasListLengths = m_hasListLengths;
    }
    const bool isPlain = m_isPlannable && !isBig && !format.isXcdr2 && !format.isParameterList;
    if (isPlain && decodePlanned(message, to)) return true;
    if (decodeAs(message, format, isBig, to)) {
      if (isPlain) addPlan(message, format, to);
      return true;
    }
    if (!format.isXcdr2) return false;
    // RTI's writer leaves out the lengths of lists.
    format.hasListLengths = !format.hasListLengths;
    if (!decodeAs(message, format, isBig, to)) return false;
    m_hasListLengths = format.hasListLengths;
    return true;
  }

 private:
  template <class Out>
  bool walk(std::string_view message, const CdrFormat& format, bool isBig, DecodedMessage& to,
            Out& out) const {
    CdrBytes in(message, isBig, format.isRos1 ? 1 : format.isXcdr2 ? 4 : 8);
    CdrWalk<Out> walk(m_types, in, format, to, out);
    walk.m_isBig = isBig;
    // A message may be filled up to a multiple of four.
    return walk.run() && in.left() < 4 && (!format.isRos1 || in.left() == 0);
  }

  bool decodeAs(std::string_view message, const CdrFormat& format, bool isBig, DecodedMessage& to) {
    return m_shapes.decode(
        to, [&]<class Out>(Out& out) { return walk(message, format, isBig, to, out); });
  }

  bool decodePlanned(std::string_view message, DecodedMessage& to) {
    for (std::size_t i = 0; i < m_plans.size(); ++i) {
      if (!m_plans[i]->decode(message, to)) continue;
      if (i > 0) std::swap(m_plans[i], m_plans[i - 1]);
      ++m_planned;
      return true;
    }
    return false;
  }

  /// Messages that are different each time do not get a plan for each.
  void addPlan(std::string_view message, const CdrFormat& format, DecodedMessage& to) {
    if (m_made > maxPlans + m_planned / 8) return;
    ++m_made;
    PlanOut out(message);
    if (!walk(message, format, false, to, out)) return;
    auto plan = out.finish(to.shape, m_isRos1);
    if (!plan) return;
    if (m_plans.size() == maxPlans) m_plans.pop_back();
    m_plans.insert(m_plans.begin(), std::move(plan));
  }

  RosTypes m_types;
  bool m_isRos1;
  bool m_isPlannable;
  bool m_hasListLengths = true;
  MessageShapes m_shapes;
  std::vector<std::unique_ptr<CdrPlan>> m_plans;  ///< the ones in use come first
  std::uint64_t m_planned = 0, m_made = 0;
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

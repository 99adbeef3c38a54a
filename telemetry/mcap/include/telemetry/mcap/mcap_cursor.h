// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Goes through the records of one chunk, whose bytes belong to the caller. One thread at a time.

#include <cstdint>
#include <string_view>

#include <telemetry/mcap/mcap_records.h>

namespace pitchboard::telemetry {

/// Walks through the records of a chunk's body; the body must outlive it.
class McapCursor {
 public:
  explicit McapCursor(std::string_view body) : m_body(body) {}

  enum class Kind : std::uint8_t { Schema, Channel, Message, End };
  /// Records of other kinds are passed over. End: nothing more, or damaged() at offset().
  Kind next();
  const McapSchema& schema() const { return m_schema; }
  const McapChannel& channel() const { return m_channel; }
  const McapMessage& message() const { return m_message; }
  bool damaged() const { return m_damaged; }
  std::size_t offset() const { return m_at; }  ///< in the body, of the next record

 private:
  std::string_view m_body;
  std::size_t m_at = 0;
  bool m_damaged = false;
  McapSchema m_schema;
  McapChannel m_channel;
  McapMessage m_message;
};

}  // namespace pitchboard::telemetry

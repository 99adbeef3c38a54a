// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Iterates over the records of an unpacked chunk. The bytes belong to the caller and must outlive
// the cursor. One thread at a time.

#include <cstdint>
#include <string_view>

#include <telemetry/mcap/mcap_records.h>

namespace pitchboard::telemetry {

/// Call next(), then the accessor of the kind that it returned.
class McapCursor {
 public:
  explicit McapCursor(std::string_view body) : m_body(body) {}

  enum class Kind : std::uint8_t { Schema, Channel, Message, End };
  /// Moves to the next schema, channel or message; other records are skipped. Returns End at the
  /// end of the body, or at offset() if the body is damaged() there.
  Kind next();
  const McapSchema& schema() const { return m_schema; }
  const McapChannel& channel() const { return m_channel; }
  const McapMessage& message() const { return m_message; }
  bool damaged() const { return m_damaged; }
  std::size_t start() const { return m_start; }  ///< position of the record that next() returned
  std::size_t offset() const { return m_at; }    ///< position of the next record in the body

 private:
  std::string_view m_body;
  std::size_t m_start = 0, m_at = 0;
  bool m_damaged = false;
  McapSchema m_schema;
  McapChannel m_channel;
  McapMessage m_message;
};

}  // namespace pitchboard::telemetry

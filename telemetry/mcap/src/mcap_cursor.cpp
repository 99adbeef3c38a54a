// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/mcap/mcap_cursor.h>

#include "mcap_bytes.h"
#include "mcap_parse.h"

namespace pitchboard::telemetry {

McapCursor::Kind McapCursor::next() {
  while (m_at < m_body.size()) {
    RecordReader in(m_body.substr(m_at));
    const auto op = static_cast<McapOp>(in.number<std::uint8_t>());
    const auto content = in.bytes(in.number<std::uint64_t>());
    bool whole = in.ok();
    Kind kind = Kind::End;
    if (whole && op == McapOp::Message) {
      const auto message = parseMessage(content);
      whole = message.has_value();
      if (whole) m_message = *message;
      kind = Kind::Message;
    } else if (whole && op == McapOp::Channel) {
      auto channel = parseChannel(content);
      whole = channel.has_value();
      if (whole) m_channel = std::move(*channel);
      kind = Kind::Channel;
    } else if (whole && op == McapOp::Schema) {
      auto schema = parseSchema(content);
      whole = schema.has_value();
      if (whole) m_schema = std::move(*schema);
      kind = Kind::Schema;
    }
    if (!whole) {
      m_damaged = true;
      return Kind::End;
    }
    m_start = m_at;
    m_at += in.offset();
    if (kind != Kind::End) return kind;
  }
  return Kind::End;
}

}  // namespace pitchboard::telemetry

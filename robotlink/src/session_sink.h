// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rows straight into a session file. Private to robotlink.

#include <telemetry/row_sink.h>
#include <telemetry/session_writer.h>

namespace pitchboard::link {

class SessionSink : public telemetry::RowSink {
 public:
  explicit SessionSink(telemetry::SessionWriter& writer) : m_writer(writer) {}
  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override {
    return m_writer.addGroup(info);
  }
  void append(telemetry::GroupId group, const telemetry::RowView& row) override {
    m_writer.append(group, row);
  }

 private:
  telemetry::SessionWriter& m_writer;
};

}  // namespace pitchboard::link

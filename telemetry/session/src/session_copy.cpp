// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_copy.h"

#include <zlib.h>
#include <algorithm>
#include <limits>

#include <telemetry/session/session_writer.h>

#include "export_selection.h"
#include "session_format.h"
#include "session_summary.h"

namespace pitchboard::telemetry {
namespace {

class Copy {
 public:
  Copy(const SessionReader& session, const ExportSelection& selection,
       const std::vector<SelectedGroup>& selected)
      : m_session(session), m_selection(selection), m_selected(selected) {}

  Result<CopyReport> write(NewFile file, const McapWriterOptions& options,
                           const std::function<bool(double)>& progress) {
    auto out = McapWriter::create(std::move(file), options);
    if (!out) return tl::unexpected(out.error());
    if (auto done = writeHead(*out); !done) return tl::unexpected(done.error());
    SessionWriterOptions writing;
    writing.waitWhenFull = true;
    m_writer = SessionWriter::on(std::move(*out), m_session.file().contents().name,
                                 m_session.info(), writing);
    addChannels();
    addOpening();
    bool stopped = false;
    m_session.walkFile(
        m_selection.range,
        [this](const McapMessage& message) {
          add(message);
          return true;
        },
        [&](double part) {
          stopped = progress && !progress(part);
          return !stopped && m_writer->status().recording;
        });
    if (stopped) return exportStopped();
    if (auto done = m_writer->finish(); !done) return tl::unexpected(done.error());
    m_report.bytes = m_writer->status().bytes;
    return std::move(m_report);
  }

 private:
  /// A channel of the session.
  struct Channel {
    std::uint16_t id = 0;  ///< in the new file; 0: it is left out
    bool isKnown = false;
    std::optional<SessionStream> stream{};
    std::optional<session::RowLayout> rows{};
    const SelectedGroup* part = nullptr;  ///< of the columns; null: as they are
    session::RowLayout partLayout{};
    std::size_t values = 0;  ///< of a row with all columns of its group
  };

  Result<void> writeHead(McapWriter& out) {
    for (const McapMetadataInfo& entry : m_session.file().contents().metadata) {
      const auto values = m_session.file().readMetadata(entry);
      if (!values) {
        m_report.missing.push_back(values.error().text());
        continue;
      }
      if (int format = 0;
          entry.name == session::metadataName && !session::infoFromMetadata(*values, format)) {
        m_report.missing.push_back("At byte " + std::to_string(entry.offset) +
                                   ": the description of the session is damaged.");
      }
      if (auto done = out.metadata(entry.name, *values); !done) return done;
    }
    for (const McapAttachmentInfo& entry : m_session.file().contents().attachments) {
      const auto data = m_session.file().readAttachment(entry);
      if (!data) {
        m_report.missing.push_back(data.error().text());
        continue;
      }
      auto done = out.attach(entry.logTime, entry.createTime, entry.name, entry.mediaType, *data);
      if (!done) return done;
    }
    return {};
  }

  /// The schema's number in the new file.
  std::uint16_t schemaOf(std::uint16_t id) {
    const auto found = m_session.file().contents().schemas.find(id);
    if (found == m_session.file().contents().schemas.end()) return 0;
    std::uint16_t& known = m_schemas[id];
    if (known == 0) known = m_writer->addSchema(found->second);
    return known;
  }

  std::uint16_t addChannel(McapChannel channel, const GroupInfo* rows) {
    channel.schema = schemaOf(channel.schema);
    return m_writer->addChannel(channel, rows);
  }

  void addChannels() {
    const auto& channels = m_session.file().contents().channels;
    m_channels.resize(channels.empty() ? 0 : std::size_t{channels.rbegin()->first} + 1);
    for (const auto& [id, channel] : channels) {
      Channel& to = m_channels[id];
      to.isKnown = true;
      if (channel.messageEncoding == session::summaryEncoding) continue;
      const auto& groups = m_session.groups();
      const auto group = std::ranges::find_if(groups, [id = id](const SessionGroup& one) {
        return std::ranges::find(one.channels, id) != one.channels.end();
      });
      if (group != groups.end()) {
        addRows(channel, *group, m_selected[static_cast<std::size_t>(group - groups.begin())], to);
        continue;
      }
      to.stream = session::streamOf(channel);
      // Whose a message of another program is, nobody knows.
      const bool isWanted = m_selection.messages && (to.stream || m_selection.robots.empty());
      if (isWanted) to.id = addChannel(channel, nullptr);
    }
  }

  void addRows(const McapChannel& channel, const SessionGroup& group, const SelectedGroup& selected,
               Channel& to) {
    const auto own = session::groupFromJson(channel.metadata.find(session::groupKey)->second);
    if (!selected.selected || !own) return;
    to.rows = session::RowLayout(*own);
    if (selected.columns.size() == group.info.columns.size()) {
      to.id = addChannel(channel, &*own);
      return;
    }
    // All rows of the group go into one channel.
    GroupInfo part = group.info;
    part.columns.clear();
    for (const SelectedColumn& column : selected.columns) {
      part.columns.push_back(group.info.columns[column.column]);
    }
    to.part = &selected;
    to.partLayout = session::RowLayout(part);
    to.values = session::RowLayout(group.info).values;
    std::uint16_t& id = m_parts[group.channel];
    if (id == 0) {
      McapChannel changed = m_session.file().contents().channels.at(group.channel);
      const auto schema = m_session.file().contents().schemas.find(changed.schema);
      if (schema != m_session.file().contents().schemas.end()) {
        McapSchema shorter = schema->second;
        shorter.data = session::rowSchema(part);
        changed.schema = m_writer->addSchema(shorter);
      }
      changed.metadata.insert_or_assign(std::string(session::groupKey), session::groupToJson(part));
      id = m_writer->addChannel(changed, &part);
    }
    to.id = id;
  }

  /// What moments follow from, and stood before the range.
  void addOpening() {
    const std::uint64_t at = m_session.logTime(m_selection.range.begin);
    for (const auto& [stream, json] : m_selection.opening) {
      const auto to = std::ranges::find_if(m_channels, [stream = stream](const Channel& channel) {
        return channel.id != 0 && channel.stream == stream;
      });
      if (to != m_channels.end()) put({to->id, 0, at, at, json}, nullptr);
    }
  }

  void add(const McapMessage& message) {
    const bool isKnown = message.channel < m_channels.size() && m_channels[message.channel].isKnown;
    if (!isKnown) ++m_report.messagesWithoutChannel;
    if (!isKnown || m_channels[message.channel].id == 0) return;
    const Channel& channel = m_channels[message.channel];
    McapMessage out = message;
    out.channel = channel.id;
    if (channel.stream && m_selection.change) {
      m_text.assign(message.data);
      if (!m_selection.change(*channel.stream, m_text)) return;
      out.data = m_text;
    }
    if (!channel.rows) return put(out, nullptr);
    RowView row;
    const bool isRow = channel.rows->read(message.data, row.time, m_words, m_values);
    row.words = m_words;
    row.values = m_values;
    if (channel.part == nullptr) return put(out, isRow ? &row : nullptr);
    if (!isRow) return;
    m_values.resize(channel.values, std::numeric_limits<double>::quiet_NaN());
    m_partWords.clear();
    m_partValues.clear();
    for (const SelectedColumn& column : channel.part->columns) {
      if (column.type == ColumnType::Float64)
        m_partValues.push_back(m_values[column.index]);
      else
        m_partWords.push_back(m_words[column.index]);
    }
    row.words = m_partWords;
    row.values = m_partValues;
    m_text.resize(channel.partLayout.size);
    channel.partLayout.write(m_text.data(), row);
    out.data = m_text;
    put(out, &row);
  }

  void put(const McapMessage& message, const RowView* row) {
    m_report.channels[message.channel].add(message);
    m_writer->append(message, row);
  }

  const SessionReader& m_session;
  const ExportSelection& m_selection;
  const std::vector<SelectedGroup>& m_selected;
  std::unique_ptr<SessionWriter> m_writer;
  std::map<std::uint16_t, std::uint16_t> m_schemas;  // of the session → of the new file
  std::map<std::uint16_t, std::uint16_t> m_parts;    // the same of channels with fewer columns
  std::vector<Channel> m_channels;
  std::vector<std::uint32_t> m_words, m_partWords;
  std::vector<double> m_values, m_partValues;
  std::string m_text;
  CopyReport m_report;
};

}  // namespace

void ChannelDigest::add(const McapMessage& message) {
  const auto take = [this](const void* bytes, std::size_t size) {
    crc = crc32_z(crc, static_cast<const Bytef*>(bytes), size);
  };
  take(&message.sequence, sizeof message.sequence);
  take(&message.logTime, sizeof message.logTime);
  take(&message.publishTime, sizeof message.publishTime);
  take(message.data.data(), message.data.size());
  ++messages;
}

tl::unexpected<Error> exportStopped() {
  return failure(ErrorCode::Conflict, "The export was stopped.");
}

Result<CopyReport> copySession(const SessionReader& session, const ExportSelection& selection,
                               NewFile file, const McapWriterOptions& options,
                               const std::function<bool(double)>& progress) {
  const auto selected = resolveSelection(session, selection);
  if (!selected) return tl::unexpected(selected.error());
  return Copy(session, selection, *selected).write(std::move(file), options, progress);
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_copy.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include <telemetry/mcap/crc32.h>
#include <telemetry/series/column_merge.h>
#include <telemetry/session/session_writer.h>

#include "export_selection.h"
#include "session_format.h"
#include "session_summary.h"

namespace pitchboard::telemetry {
namespace {

class Copy {
 public:
  Copy(const SessionReader& session, const ExportSelection& selection,
       const std::vector<SelectedGroup>& selected, bool withDigests)
      : m_session(session),
        m_selection(selection),
        m_selected(selected),
        m_withDigests(withDigests) {}

  Result<CopyReport> write(NewFile file, const McapWriterOptions& options,
                           const std::function<bool(double)>& progress) {
    auto out = McapWriter::create(std::move(file), options);
    if (!out) return tl::unexpected(out.error());
    if (auto done = writeHead(*out); !done) return tl::unexpected(done.error());
    SessionWriterOptions writing;
    writing.waitWhenFull = true;
    // Chunks end by their size only, so that a copy has the same bytes every time, and few of them
    // wait, so that their memory is used again.
    writing.chunkInterval = std::chrono::hours(24);
    writing.queueBytes = 4 * writing.chunkBytes;
    m_writer = SessionWriter::on(std::move(*out), m_session.file().contents().name,
                                 m_session.info(), writing);
    addChannels();
    addOpening();
    addHeldRows();
    bool stopped = false;
    m_session.walkFile(
        m_selection.range,
        [&](const McapMessage& message) {
          stopped = !addBeside(message.logTime);
          if (stopped) return false;
          addNotesBefore(message.logTime);
          add(message);
          return true;
        },
        [&](double part) {
          stopped = stopped || (progress && !progress(part));
          return !stopped && m_writer->status().recording;
        });
    if (stopped || !addBeside(m_session.logTime(m_session.range().value_or(TimeRange{}).end))) {
      return exportStopped();
    }
    addNotesBefore(std::numeric_limits<std::uint64_t>::max());
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
    RowMap all{};  ///< to all columns of the group,
    RowMap own{};  ///< and back
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
      if (entry.name == session::factsName && !isWanted(*values)) continue;
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

  /// False: these are facts about a group that is left out.
  bool isWanted(const McapMap& facts) const {
    const auto found = session::factsFromMetadata(facts);
    const auto& groups = m_session.groups();
    for (std::size_t g = 0; found && g < groups.size(); ++g) {
      if (groups[g].info.id == found->first) return m_selected[g].selected;
    }
    return true;
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
      // It is unknown to which robot a message of another program belongs.
      const bool isWanted = m_selection.messages && (to.stream || m_selection.robots.empty());
      if (isWanted) to.id = addChannel(channel, nullptr);
    }
  }

  void addRows(const McapChannel& channel, const SessionGroup& group, const SelectedGroup& selected,
               Channel& to) {
    const auto own = session::groupFromJson(channel.metadata.find(session::groupKey)->second);
    if (!selected.selected || !own) return;
    to.rows = session::RowLayout(*own);
    to.own = RowMap(group.info.columns, own->columns);
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
    std::stable_partition(part.columns.begin(), part.columns.end(), [](const ColumnInfo& column) {
      return column.type != ColumnType::Float64;
    });
    to.part = &selected;
    to.partLayout = session::RowLayout(part);
    to.all = RowMap(own->columns, group.info.columns);
    std::uint16_t& id = m_parts[group.channels.front()];
    if (id == 0) {
      McapChannel changed = m_session.file().contents().channels.at(group.channels.front());
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

  /// The range begins with the values that hold then: rows from before it, repeated there.
  void addHeldRows() {
    const double begin = m_selection.range.begin;
    const std::uint64_t at = m_session.logTime(begin);
    if (begin <= -1e18) return;
    std::vector<SessionRow> rows;
    m_session.rowsAt(begin, rows);
    for (std::size_t g = 0; g < rows.size(); ++g) {
      if (!rows[g].present) continue;
      const Channel& to = m_channels[rows[g].channel];
      if (to.id == 0 || m_session.logTime(rows[g].time) >= at ||
          begin - rows[g].time > Resampling::maxHold) {
        continue;
      }
      const RowView all{begin, rows[g].words, rows[g].values};
      const RowView row =
          to.part == nullptr ? to.own.convert(all, m_words, m_values) : partOf(all, *to.part);
      const session::RowLayout& layout = to.part == nullptr ? *to.rows : to.partLayout;
      m_text.resize(layout.size);
      layout.write(m_text.data(), row);
      put({to.id, 0, at, at, m_text}, &row);
    }
  }

  /// The selected columns of a row that has all columns of its group.
  RowView partOf(const RowView& row, const SelectedGroup& part) {
    m_partWords.clear();
    m_partValues.clear();
    for (const SelectedColumn& column : part.columns) {
      if (column.type == ColumnType::Float64)
        m_partValues.push_back(row.values[column.index]);
      else
        m_partWords.push_back(row.words[column.index]);
    }
    return {row.time, m_partWords, m_partValues};
  }

  /// The bookmarks beside the file become events of the new one, behind those of the same time.
  /// Drawn notes stay beside it: copyDrawnNotes().
  void addNotesBefore(std::uint64_t logTime) {
    const auto& notes = m_session.addedNotes();
    for (; m_selection.messages && m_nextNote < notes.size(); ++m_nextNote) {
      const SessionEvent& event = notes[m_nextNote];
      const std::uint64_t at = m_session.logTime(event.time);
      if (at >= logTime) return;
      if (event.kind == session::noteKind) continue;
      if (event.time < m_selection.range.begin || event.time > m_selection.range.end) continue;
      if (m_noteChannel == 0) m_noteChannel = eventChannel();
      const std::string json = session::toJson(event);
      put({m_noteChannel, 0, at, at, json}, nullptr);
    }
  }

  /// What the caller adds, once for each time.
  bool addBeside(std::uint64_t logTime) {
    if (!m_selection.beside || m_besideTo == logTime) return true;
    m_besideTo = logTime;
    return m_selection.beside(*m_writer, m_session.seconds(logTime));
  }

  std::uint16_t eventChannel() {
    const auto known = std::ranges::find_if(m_channels, [](const Channel& channel) {
      return channel.id != 0 && channel.stream == SessionStream::Events;
    });
    if (known != m_channels.end()) return known->id;
    const session::StreamInfo& info =
        session::streams[static_cast<std::size_t>(SessionStream::Events)];
    const std::uint16_t schema = m_writer->addSchema(
        {0, std::string(info.schemaName), "jsonschema", std::string(info.jsonSchema)});
    return m_writer->addChannel({0, schema, std::string(info.topic), "json", {}}, nullptr);
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
    row = partOf(channel.all.convert(row, m_allWords, m_allValues), *channel.part);
    m_text.resize(channel.partLayout.size);
    channel.partLayout.write(m_text.data(), row);
    out.data = m_text;
    put(out, &row);
  }

  void put(const McapMessage& message, const RowView* row) {
    ChannelDigest& digest = m_report.channels[message.channel];
    if (m_withDigests)
      digest.add(message);
    else
      ++digest.messages;
    m_writer->append(message, row);
  }

  const SessionReader& m_session;
  const ExportSelection& m_selection;
  const std::vector<SelectedGroup>& m_selected;
  const bool m_withDigests;
  std::unique_ptr<SessionWriter> m_writer;
  std::map<std::uint16_t, std::uint16_t> m_schemas;  // of the session → of the new file
  std::map<std::uint16_t, std::uint16_t> m_parts;    // the same of channels with fewer columns
  std::vector<Channel> m_channels;
  std::size_t m_nextNote = 0;
  std::uint16_t m_noteChannel = 0;
  std::optional<std::uint64_t> m_besideTo;
  std::vector<std::uint32_t> m_words, m_allWords, m_partWords;
  std::vector<double> m_values, m_allValues, m_partValues;
  std::string m_text;
  CopyReport m_report;
};

}  // namespace

void ChannelDigest::add(const McapMessage& message) {
  std::array<char, sizeof message.sequence + 2 * sizeof message.logTime> head;
  std::memcpy(head.data(), &message.sequence, 4);
  std::memcpy(head.data() + 4, &message.logTime, 8);
  std::memcpy(head.data() + 12, &message.publishTime, 8);
  crc = extendedCrc(extendedCrc(crc, {head.data(), head.size()}), message.data);
  ++messages;
}

tl::unexpected<Error> exportStopped() {
  return failure(ErrorCode::Conflict, "The export was stopped.");
}

Result<CopyReport> copySession(const SessionReader& session, const ExportSelection& selection,
                               NewFile file, const McapWriterOptions& options,
                               const std::function<bool(double)>& progress, bool withDigests) {
  const auto selected = resolveSelection(session, selection);
  if (!selected) return tl::unexpected(selected.error());
  return Copy(session, selection, *selected, withDigests).write(std::move(file), options, progress);
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "export_clip.h"

#include <algorithm>
#include <cstring>

#include "session_format.h"

namespace pitchboard::telemetry {
namespace {

/// The selected part as a session of its own.
class Clip {
 public:
  Clip(const SessionReader& session, const ExportSelection& selection,
       const std::vector<SelectedGroup>& selected, McapWriter& out)
      : m_session(session), m_selection(selection), m_selected(selected), m_out(out) {}

  Result<ExportReport> write(const ExportProgress& progress) {
    for (const McapMetadataInfo& entry : m_session.file().metadata()) {
      const auto values = m_session.file().readMetadata(entry);
      if (!values) continue;
      if (auto done = m_out.metadata(entry.name, *values); !done)
        return tl::unexpected(done.error());
    }
    for (const McapAttachmentInfo& entry : m_session.attachments()) {
      const auto data = m_session.file().readAttachment(entry);
      if (!data) continue;
      auto done = m_out.attach(entry.logTime, entry.createTime, entry.name, entry.mediaType, *data);
      if (!done) return tl::unexpected(done.error());
    }
    addChannels();
    addOpening();
    bool interrupted = false;
    Result<void> done;
    m_session.walk(
        m_selection.range,
        [&](const SessionItem& item) {
          add(item);
          if (m_chunk.bytes() < chunkBytes) return true;
          done = m_out.writeChunk(m_chunk);
          m_chunk.clear();
          return done.has_value();
        },
        [&](double part) {
          interrupted = progress && !progress(part);
          return !interrupted;
        });
    if (interrupted) return exportStopped();
    if (done) done = m_out.writeChunk(m_chunk);
    if (done) done = m_out.finish();
    if (!done) return tl::unexpected(done.error());
    return ExportReport{m_out.statistics().messages, m_out.bytes()};
  }

 private:
  static constexpr std::size_t chunkBytes = 2U << 20;

  void addChannels() {
    const McapReader& file = m_session.file();
    for (const auto& [id, schema] : file.schemas()) {
      const bool ofRows = schema.encoding == "ros2msg";
      if (!ofRows && m_selection.messages) m_chunk.add(schema);
    }
    m_layouts.resize(m_selected.size());
    for (std::size_t g = 0; g < m_selected.size(); ++g) {
      if (!m_selected[g].selected) continue;
      const SessionGroup& group = m_session.groups()[g];
      GroupInfo part = group.info;
      part.columns.clear();
      for (const SelectedColumn& column : m_selected[g].columns) {
        part.columns.push_back(group.info.columns[column.column]);
      }
      m_layouts[g] = session::RowLayout(part);
      McapChannel channel = file.channels().at(group.channel);
      if (const auto schema = file.schemas().find(channel.schema); schema != file.schemas().end()) {
        McapSchema changed = schema->second;
        changed.data = session::rowSchema(part);
        m_chunk.add(changed);
      }
      channel.metadata.insert_or_assign(std::string(session::groupKey), session::groupToJson(part));
      m_chunk.add(channel);
    }
    if (!m_selection.messages) return;
    for (const auto& [id, channel] : file.channels()) {
      const bool known = std::any_of(session::streams.begin(), session::streams.end(),
                                     [&topic = channel.topic](const session::StreamInfo& stream) {
                                       return stream.topic == topic;
                                     });
      if (known && channel.messageEncoding == "json") m_chunk.add(channel);
    }
  }

  /// What moments follow from, and stood before the range.
  void addOpening() {
    const std::uint64_t at = m_session.logTime(m_selection.range.begin);
    for (const auto& [stream, json] : m_selection.opening) {
      const auto topic = session::streams[static_cast<std::size_t>(stream)].topic;
      for (const auto& [id, channel] : m_session.file().channels()) {
        if (!m_selection.messages || channel.topic != topic) continue;
        m_chunk.add(McapMessage{id, 0, at, at, json});
        break;
      }
    }
  }

  void add(const SessionItem& item) {
    if (!item.isRow) {
      if (m_selection.messages) m_chunk.add(*item.message);
      return;
    }
    const SelectedGroup& group = m_selected[item.group];
    if (!group.selected) return;
    m_words.clear();
    m_values.clear();
    for (const SelectedColumn& column : group.columns) {
      if (column.type == ColumnType::Float64)
        m_values.push_back(item.row.values[column.index]);
      else
        m_words.push_back(item.row.words[column.index]);
    }
    // The row keeps its own time; the session's is in the times of the message.
    double source = item.time;
    std::memcpy(&source, item.message->data.data() + session::RowLayout::timeAt, sizeof source);
    const session::RowLayout& layout = m_layouts[item.group];
    const McapMessage& message = *item.message;
    layout.write(m_chunk.addMessage(m_session.groups()[item.group].channel, message.sequence,
                                    message.logTime, message.publishTime, layout.size),
                 {source, m_words, m_values});
  }

  const SessionReader& m_session;
  const ExportSelection& m_selection;
  const std::vector<SelectedGroup>& m_selected;
  McapWriter& m_out;
  McapChunk m_chunk;
  std::vector<session::RowLayout> m_layouts;
  std::vector<std::uint32_t> m_words;
  std::vector<double> m_values;
};

}  // namespace

tl::unexpected<Error> exportStopped() {
  return failure(ErrorCode::Conflict, "The export was stopped.");
}

Result<ExportReport> writeClip(const SessionReader& session, const ExportSelection& selection,
                               const std::vector<SelectedGroup>& selected, McapWriter& out,
                               const ExportProgress& progress) {
  return Clip(session, selection, selected, out).write(progress);
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_writer.h>

#include <algorithm>
#include <filesystem>

#include "session_writer_impl.h"

namespace pitchboard::telemetry {
namespace {

/// A step back that is smaller than this is disorder on the way here and moves nothing.
constexpr std::uint64_t smallStepBack = 50'000'000;    // ns
constexpr std::uint64_t gapBetweenPasses = 1'000'000;  // ns

std::optional<std::uint64_t> freeSpaceBeside(const std::string& path) {
  std::error_code problem;
  const auto folder = std::filesystem::absolute(path, problem).parent_path();
  const auto space = std::filesystem::space(folder, problem);
  return problem ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

}  // namespace

SessionWriter::SessionWriter(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}

SessionWriter::~SessionWriter() {
  (void)finish();
}

Result<std::unique_ptr<SessionWriter>> SessionWriter::create(const std::string& path,
                                                             const SessionInfo& info,
                                                             const SessionWriterOptions& options) {
  McapWriterOptions fileOptions;
  fileOptions.library = info.program.empty() ? "pitchboard" : info.program;
  fileOptions.level = options.level;
  fileOptions.sync = options.sync;
  auto file = McapWriter::create(path, fileOptions);
  if (!file) return tl::unexpected(file.error());
  if (auto written = file->metadata(session::metadataName, session::toMetadata(info)); !written) {
    return tl::unexpected(written.error());
  }
  if (auto synced = file->sync(); !synced) return tl::unexpected(synced.error());
  return on(std::move(*file), path, info, options);
}

std::unique_ptr<SessionWriter> SessionWriter::on(McapWriter file, std::string path,
                                                 const SessionInfo& info,
                                                 const SessionWriterOptions& options) {
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  impl->info = info;
  impl->options = options;
  if (!options.freeSpace) impl->options.freeSpace = [path] { return freeSpaceBeside(path); };
  impl->state.bytes = file.bytes();
  impl->state.freeBytes = impl->options.freeSpace();
  impl->file = std::move(file);
  std::unique_ptr<SessionWriter> writer(new SessionWriter(std::move(impl)));
  Impl& shared = *writer->m_impl;
  shared.thread = std::thread([&shared] { shared.run(); });
  return writer;
}

GroupId SessionWriter::addGroup(const GroupInfo& info) {
  Impl& impl = *m_impl;
  const std::lock_guard lock(impl.mutex);
  std::size_t sameTopic = 0;
  for (std::size_t i = 0; i < impl.groups.size(); ++i) {
    if (impl.groups[i].info.name != info.name) continue;
    if (impl.groups[i].info.columns == info.columns) return static_cast<GroupId>(i);
    ++sameTopic;
  }
  const std::string suffix = sameTopic > 0 ? std::to_string(sameTopic + 1) : std::string();
  Impl::Group group{.info = info,
                    .layout = session::RowLayout(info),
                    .topic = session::rowTopic(info) + suffix,
                    .summary = SummaryBuilder(info)};
  if (!impl.stop && !impl.error && impl.channels < Impl::mostChannels) {
    const std::uint16_t schema = impl.addSchema(
        impl.current,
        {0, session::rowSchemaName(info) + suffix, "ros2msg", session::rowSchema(info)});
    group.channel = impl.addChannel(
        impl.current, {0,
                       schema,
                       group.topic,
                       "cdr",
                       {{std::string(session::groupKey), session::groupToJson(info)}}});
  }
  impl.groups.push_back(std::move(group));
  return static_cast<GroupId>(impl.groups.size() - 1);
}

GroupId SessionWriter::renameGroup(std::string_view from, const GroupInfo& to) {
  GroupInfo info = to;
  info.attributes[session::wasAttribute] = from;
  return addGroup(info);
}

std::uint16_t SessionWriter::addSchema(const McapSchema& schema) {
  const std::lock_guard lock(m_impl->mutex);
  return m_impl->addSchema(m_impl->current, schema);
}

std::uint16_t SessionWriter::addChannel(const McapChannel& channel, const GroupInfo* rows) {
  Impl& impl = *m_impl;
  const std::lock_guard lock(impl.mutex);
  const std::uint16_t id = impl.addChannel(impl.current, channel);
  const auto stream = session::streamOf(channel);
  Impl::Copied& copied = impl.copied[id];
  copied.isSparse = stream == SessionStream::Events || stream == SessionStream::Log;
  if (rows == nullptr || id == 0) return id;
  copied.group = impl.groups.size();
  impl.groups.push_back({.info = *rows,
                         .layout = {},
                         .topic = channel.topic,
                         .channel = id,
                         .summary = SummaryBuilder(*rows)});
  return id;
}

void SessionWriter::append(const McapMessage& message, const RowView* row) {
  Impl& impl = *m_impl;
  std::unique_lock lock(impl.mutex);
  if (!impl.hasRoom(lock, message.data.size() + 64)) return;
  const Impl::Copied& copied = impl.copied[message.channel];
  (copied.isSparse ? impl.sparse : impl.current).add(message);
  ++(copied.group == Impl::noGroup ? impl.state.messages : impl.state.rows);
  if (copied.group != Impl::noGroup && row != nullptr) {
    impl.summarize(impl.groups[copied.group], message.logTime, *row);
  }
  impl.note(message.logTime);
}

void SessionWriter::append(GroupId id, const RowView& row) {
  Impl& impl = *m_impl;
  std::unique_lock lock(impl.mutex);
  if (id >= impl.groups.size() || impl.groups[id].channel == 0) return;
  if (!impl.hasRoom(lock, impl.groups[id].layout.size + 64)) return;
  Impl::Group& group = impl.groups[id];
  const std::uint64_t publish = session::nanoseconds(impl.info.start, row.time);
  std::uint64_t log = publish + impl.shift;
  if (log < group.lastLog) {
    if (group.lastLog - log > smallStepBack) {
      impl.shift = impl.lastLog + gapBetweenPasses - publish;
      log = publish + impl.shift;
    } else {
      log = group.lastLog;
    }
  }
  group.layout.write(
      impl.current.addMessage(group.channel, group.sequence++, log, publish, group.layout.size),
      row);
  ++impl.state.rows;
  impl.summarize(group, log, row);
  impl.note(log);
}

void SessionWriter::append(const SessionEvent& event) {
  appendJson(SessionStream::Events, event.time, session::toJson(event));
}

void SessionWriter::append(const LogLine& line) {
  appendJson(SessionStream::Log, line.time,
             session::toJson(line, session::nanoseconds(m_impl->info.start, line.time)));
}

void SessionWriter::append(SessionStream stream, const SessionDatagram& datagram) {
  appendJson(stream, datagram.time, session::toJson(datagram));
}

void SessionWriter::appendJson(SessionStream stream, double time, std::string_view json) {
  Impl& impl = *m_impl;
  std::unique_lock lock(impl.mutex);
  if (!impl.hasRoom(lock, json.size() + 64)) return;
  const auto index = static_cast<std::size_t>(stream);
  Impl::Stream& state = impl.streams[index];
  const bool isSparse = stream == SessionStream::Events || stream == SessionStream::Log;
  McapChunk& to = isSparse ? impl.sparse : impl.current;
  if (state.channel == 0) {
    const session::StreamInfo& info = session::streams[index];
    const std::uint16_t schema = impl.addSchema(
        to, {0, std::string(info.schemaName), "jsonschema", std::string(info.jsonSchema)});
    state.channel = impl.addChannel(to, {0, schema, std::string(info.topic), "json", {}});
  }
  const std::uint64_t publish = session::nanoseconds(impl.info.start, time);
  const std::uint64_t log = publish + impl.shift;
  to.add(McapMessage{state.channel, state.sequence++, log, publish, json});
  ++impl.state.messages;
  impl.note(log);
}

void SessionWriter::attach(std::string_view name, std::string_view mediaType,
                           std::string_view data) {
  Impl& impl = *m_impl;
  std::unique_lock lock(impl.mutex);
  if (!impl.hasRoom(lock, data.size())) return;
  const std::uint64_t now =
      impl.lastLog > 0 ? impl.lastLog : session::nanoseconds(impl.info.start, 0.0);
  impl.attachments.push_back({now, std::string(name), std::string(mediaType), std::string(data)});
  impl.waiting += data.size();
  impl.wake.notify_one();
}

SessionStatus SessionWriter::status() const {
  const std::lock_guard lock(m_impl->mutex);
  SessionStatus status = m_impl->state;
  if (m_impl->ended) return status;
  status.owedSeconds = m_impl->file->owedSeconds();
  if (m_impl->writingSince) {
    const std::chrono::duration<double> writing = Impl::Clock::now() - *m_impl->writingSince;
    status.owedSeconds = std::max(status.owedSeconds, writing.count());
  }
  return status;
}

const std::string& SessionWriter::path() const {
  return m_impl->path;
}

Result<void> SessionWriter::finish() {
  Impl& impl = *m_impl;
  {
    const std::lock_guard lock(impl.mutex);
    // A short session is read as it is; of a long one every group has a picture.
    const bool isLong = std::any_of(impl.groups.begin(), impl.groups.end(),
                                    [](const auto& group) { return group.summaryChannel != 0; });
    for (Impl::Group& group : impl.groups) {
      if (impl.stop || impl.error || !isLong) continue;
      if (const auto rest = group.summary.finish()) impl.keep(group, *rest);
    }
    impl.stop = true;
    impl.wake.notify_one();
    impl.room.notify_all();
  }
  if (impl.thread.joinable()) impl.thread.join();
  const std::lock_guard lock(impl.mutex);
  if (impl.error) return tl::unexpected(*impl.error);
  return {};
}

}  // namespace pitchboard::telemetry

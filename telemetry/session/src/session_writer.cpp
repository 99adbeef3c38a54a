// SPDX-License-Identifier: GPL-3.0-or-later
// Those who append fill chunks; the writer's thread closes, compresses and writes them.
#include <telemetry/session/session_writer.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <telemetry/mcap/mcap_writer.h>

#include "session_format.h"
#include "session_summary.h"
#include "write_rate.h"

namespace pitchboard::telemetry {
namespace {

/// A step back that is smaller than this is disorder on the way here and moves nothing.
constexpr std::uint64_t smallStepBack = 50'000'000;    // ns
constexpr std::uint64_t gapBetweenPasses = 1'000'000;  // ns
constexpr std::size_t mostSpareChunks = 4;

std::optional<std::uint64_t> freeSpaceBeside(const std::string& path) {
  std::error_code problem;
  const auto folder = std::filesystem::absolute(path, problem).parent_path();
  const auto space = std::filesystem::space(folder, problem);
  return problem ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

}  // namespace

struct SessionWriter::Impl {
  using Clock = std::chrono::steady_clock;
  static constexpr std::uint16_t mostChannels = 60'000;
  struct Attachment {
    std::uint64_t time;
    std::string name, mediaType, data;
  };

  std::string path;
  SessionInfo info;
  SessionWriterOptions options;
  std::optional<McapWriter> file;  ///< of the writing thread once it runs
  std::thread thread;

  struct Group {
    GroupInfo info;
    session::RowLayout layout;
    std::string topic;
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t lastLog = 0;
    SummaryBuilder summary;
    std::uint16_t summaryChannel = 0;  ///< 0: there is no part yet
    std::uint32_t summaries = 0;
  };

  mutable std::mutex mutex;  ///< of everything below
  std::condition_variable wake, room;
  std::deque<McapChunk> full;
  McapChunk current;
  McapChunk sparse;  ///< events and log lines: who lists them need not read the rows
  std::vector<McapChunk> spare;
  std::deque<Attachment> attachments;
  std::size_t waiting = 0;  ///< bytes in `full`, and what the writing thread has in hand
  bool stop = false;
  std::vector<Group> groups;
  static constexpr std::size_t noGroup = static_cast<std::size_t>(-1);
  struct Copied {
    std::size_t group = noGroup;
    bool isSparse = false;
  };
  std::map<std::uint16_t, Copied> copied;  ///< channels of another file
  struct Stream {
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
  };
  std::array<Stream, sessionStreamCount> streams{};
  std::uint16_t channels = 0, schemas = 0;
  std::uint64_t shift = 0;  ///< ns; how far the file's times are ahead of the source's
  std::optional<std::uint64_t> firstLog;
  std::uint64_t lastLog = 0;
  SessionStatus state;
  std::optional<Clock::time_point> writingSince;  ///< the writing thread has not come back since
  bool ended = false;                             ///< `file` is not to be asked any more
  std::optional<Error> error;

  void run();
  void write(std::deque<McapChunk>& chunks, std::deque<Attachment>& files);
  bool hasSpace(std::unique_lock<std::mutex>& lock, std::size_t bytes);
  void fail(const Error& why);
  void closeCurrent();
  bool isEmpty() const { return current.empty() && sparse.empty(); }
  std::size_t openBytes() const { return current.bytes() + sparse.bytes(); }
  std::uint16_t addSchema(McapChunk& to, McapSchema schema);
  std::uint16_t addChannel(McapChunk& to, McapChannel channel);
  void summarize(Group& group, std::uint64_t log, const RowView& row);
  void keep(Group& group, const SummaryPart& part);
  void note(std::uint64_t log);
};

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
  impl->info = info;
  impl->options = options;
  if (!options.freeSpace) impl->options.freeSpace = [path] { return freeSpaceBeside(path); };
  impl->path = std::move(path);
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
  if (!impl.hasSpace(lock, message.data.size() + 64)) return;
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
  if (!impl.hasSpace(lock, impl.groups[id].layout.size + 64)) return;
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
  if (!impl.hasSpace(lock, json.size() + 64)) return;
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
  if (!impl.hasSpace(lock, data.size())) return;
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
  status.syncLatency = m_impl->file->syncLatency();
  if (m_impl->writingSince) {
    const std::chrono::duration<double> writing = Impl::Clock::now() - *m_impl->writingSince;
    status.syncLatency = std::max(status.syncLatency, writing.count());
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

void SessionWriter::Impl::run() {
  auto next = Clock::now() + options.chunkInterval;
  WriteRate rate;
  std::unique_lock lock(mutex);
  for (;;) {
    wake.wait_until(lock, next, [this] { return stop || !full.empty() || !attachments.empty(); });
    const bool last = stop;
    if ((last || Clock::now() >= next) && !isEmpty()) closeCurrent();
    std::deque<McapChunk> chunks;
    std::deque<Attachment> files;
    chunks.swap(full);
    files.swap(attachments);
    if (isEmpty() || Clock::now() >= next) next = Clock::now() + options.chunkInterval;
    writingSince = Clock::now();
    lock.unlock();
    if (!error) write(chunks, files);
    const auto room_ = options.freeSpace();
    lock.lock();
    writingSince.reset();
    state.freeBytes = room_;
    waiting = 0;
    for (const McapChunk& chunk : full) waiting += chunk.bytes();
    for (const Attachment& file_ : attachments) waiting += file_.data.size();
    for (McapChunk& chunk : chunks) {
      if (spare.size() >= mostSpareChunks) break;
      chunk.clear();
      spare.push_back(std::move(chunk));
    }
    state.bytes = file->bytes();
    rate.note(std::chrono::duration<double>(Clock::now().time_since_epoch()).count(), state.bytes);
    state.bytesPerSecond = rate.bytesPerSecond();
    room.notify_all();
    if (last || error) break;
  }
  ended = true;
  lock.unlock();
  auto finished = file->finish();
  lock.lock();
  if (!finished && !error) fail(finished.error());
  state.bytes = file->bytes();
  state.recording = false;
  full.clear();
  current.clear();
  sparse.clear();
  attachments.clear();
  room.notify_all();
}

void SessionWriter::Impl::write(std::deque<McapChunk>& chunks, std::deque<Attachment>& files) {
  Result<void> done;
  for (const Attachment& attachment : files) {
    if (done) {
      done = file->attach(attachment.time, attachment.time, attachment.name, attachment.mediaType,
                          attachment.data);
    }
  }
  if (done && !files.empty()) done = file->sync();
  for (const McapChunk& chunk : chunks) {
    if (done) done = file->writeChunk(chunk);
  }
  if (done) return;
  const std::lock_guard lock(mutex);
  fail(done.error());
}

/// Needs the lock. Who sees that it stopped sees why.
void SessionWriter::Impl::fail(const Error& why) {
  error = why;
  state.recording = false;
  state.problem =
      "Recording stopped. " + why.message + " Everything recorded before that is in the file.";
}

/// Needs the lock; may let go of it while it waits.
bool SessionWriter::Impl::hasSpace(std::unique_lock<std::mutex>& lock, std::size_t bytes) {
  if (stop || error) return false;
  // Who waits gets through with what is larger than the queue, too.
  const auto fits = [&] {
    const std::size_t before = waiting + openBytes();
    return before + bytes <= options.queueBytes || (options.waitWhenFull && before == 0);
  };
  if (!fits() && options.waitWhenFull) {
    if (!isEmpty()) closeCurrent();
    wake.notify_one();
    room.wait(lock, [&] { return fits() || stop || error; });
    if (stop || error) return false;
  }
  if (fits()) return true;
  ++state.dropped;
  return false;
}

void SessionWriter::Impl::closeCurrent() {
  for (McapChunk* open : {&current, &sparse}) {
    if (open->empty()) continue;
    waiting += open->bytes();
    full.push_back(std::move(*open));
    if (spare.empty()) {
      *open = McapChunk();
    } else {
      *open = std::move(spare.back());
      spare.pop_back();
    }
  }
}

void SessionWriter::Impl::summarize(Group& group, std::uint64_t log, const RowView& row) {
  group.lastLog = log;
  const auto start = static_cast<std::uint64_t>(info.start.time_since_epoch().count());
  const double time = static_cast<double>(static_cast<std::int64_t>(log - start)) / 1e9;
  if (const auto part = group.summary.add(time, row)) keep(group, *part);
}

/// A chunk of its own: who draws a whole day reads these chunks and no others.
void SessionWriter::Impl::keep(Group& group, const SummaryPart& part) {
  McapChunk chunk;
  if (group.summaryChannel == 0) {
    group.summaryChannel = addChannel(chunk, {0,
                                              0,
                                              group.topic + "/summary",
                                              std::string(session::summaryEncoding),
                                              {{std::string(session::summaryKey), group.topic}}});
    if (group.summaryChannel == 0) return;
  }
  // Behind its rows: a recording that breaks off has no summary of rows that it does not have.
  closeCurrent();
  const std::string bytes = session::summaryBytes(part);
  chunk.add(
      McapMessage{group.summaryChannel, group.summaries++, group.lastLog, group.lastLog, bytes});
  waiting += chunk.bytes();
  full.push_back(std::move(chunk));
  wake.notify_one();
}

std::uint16_t SessionWriter::Impl::addSchema(McapChunk& to, McapSchema schema) {
  if (schemas >= mostChannels) return 0;
  schema.id = ++schemas;
  to.add(schema);
  return schema.id;
}

std::uint16_t SessionWriter::Impl::addChannel(McapChunk& to, McapChannel channel) {
  if (channels >= mostChannels) return 0;
  channel.id = ++channels;
  to.add(channel);
  return channel.id;
}

void SessionWriter::Impl::note(std::uint64_t log) {
  if (!firstLog) firstLog = log;
  lastLog = std::max(lastLog, log);
  state.seconds = static_cast<double>(lastLog - *firstLog) * 1e-9;
  if (openBytes() < options.chunkBytes) return;
  closeCurrent();
  wake.notify_one();
}

}  // namespace pitchboard::telemetry

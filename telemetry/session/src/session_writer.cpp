// SPDX-License-Identifier: GPL-3.0-or-later
// append() fills chunks on the caller's thread; the writer's thread compresses and writes them.
#include <telemetry/session/session_writer.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "session_writer_impl.h"

namespace pitchboard::telemetry {
namespace {

/// A step back that is smaller than this is disorder on the way here and moves nothing.
constexpr std::uint64_t smallStepBack = 50'000'000;    // ns
constexpr std::uint64_t gapBetweenPasses = 1'000'000;  // ns
constexpr std::size_t maxSpareChunks = 4;

/// Returns whether a row of one is a row of the other: only descriptions and labels may differ.
bool hasSameRows(const std::vector<ColumnInfo>& a, const std::vector<ColumnInfo>& b) {
  return std::ranges::equal(a, b, [](const ColumnInfo& one, const ColumnInfo& other) {
    return one.name == other.name && one.type == other.type && one.resolution == other.resolution &&
           one.lost == other.lost;
  });
}

/// Returns whether `now` has the same columns, and further Float64 columns behind them.
bool isContinued(const std::vector<ColumnInfo>& before, const std::vector<ColumnInfo>& now) {
  const auto count = static_cast<std::ptrdiff_t>(before.size());
  return now.size() >= before.size() && hasSameRows(before, {now.begin(), now.begin() + count}) &&
         std::all_of(now.begin() + count, now.end(),
                     [](const ColumnInfo& column) { return column.type == ColumnType::Float64; });
}

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
  auto made = options.replace ? NewFile::replace(path) : NewFile::create(path);
  if (!made) return tl::unexpected(made.error());
  auto file = McapWriter::create(std::move(*made), fileOptions);
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
  const auto isWord = [](const ColumnInfo& column) { return column.type != ColumnType::Float64; };
  if (!std::ranges::is_partitioned(info.columns, isWord)) {
    GroupInfo sorted = info;  // rows are the same: words and values stand apart
    std::stable_partition(sorted.columns.begin(), sorted.columns.end(), isWord);
    return addGroup(sorted);
  }
  Impl& impl = *m_impl;
  const std::lock_guard lock(impl.mutex);
  impl.noteFacts(info);
  const std::size_t id = impl.indexOf(info);
  Impl::Group& group = impl.groups[id];
  if (group.channels.empty()) {
    group.info = info;
    impl.openChannel(group, group.openedAt);
    return static_cast<GroupId>(id);
  }
  if (group.info.columns == info.columns) {
    group.info = info;
    return static_cast<GroupId>(id);
  }
  if (!group.held.empty() && !isContinued(group.info.columns, info.columns)) {
    impl.openChannel(group, group.openedAt);
  }
  group.info = info;
  group.takes.reset();
  group.isDescribed = false;
  for (const std::size_t channel : group.channels) {
    const auto& columns = impl.rowChannels[channel].columns;
    if (group.isDescribed || !hasSameRows(columns, info.columns)) continue;
    group.takes = channel;
    group.isDescribed = columns == info.columns;
  }
  return static_cast<GroupId>(id);
}

/// Needs the lock. The channel of a group has the facts from its beginning; what changes is written
/// at once, or as soon as the disk comes back.
void SessionWriter::Impl::noteFacts(const GroupInfo& group) {
  if (group.id.empty() || stop || error) return;
  const GroupFacts now{group.name, group.robot, group.match};
  const auto [known, isNew] = facts.try_emplace(group.id, now);
  if (isNew || known->second == now) return;
  newFacts[group.id] = known->second = now;
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
  if (impl.copied.size() <= id) impl.copied.resize(std::size_t{id} + 1);
  Impl::Copied& copied = impl.copied[id];
  copied.isSparse = stream == SessionStream::Events || stream == SessionStream::Log;
  if (rows == nullptr || id == 0) return id;
  copied.rows = impl.rowChannels.size();
  copied.group = impl.indexOf(*rows);
  impl.rowChannels.push_back({.columns = {},
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
  if (message.channel >= impl.copied.size()) return;
  const Impl::Copied& copied = impl.copied[message.channel];
  (copied.isSparse ? impl.sparse : impl.current).add(message);
  ++(copied.rows ? impl.state.rows : impl.state.messages);
  if (copied.rows && row != nullptr) {
    impl.summarize(impl.groups[copied.group], *copied.rows, message.logTime, *row);
  }
  impl.note(message.logTime);
}

void SessionWriter::append(GroupId id, const RowView& row) {
  Impl& impl = *m_impl;
  std::unique_lock lock(impl.mutex);
  if (id >= impl.groups.size()) return;
  const std::size_t bytes = 64 + 4 * row.words.size() + 8 * row.values.size();
  if (!impl.hasSpace(lock, bytes)) return;
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
  group.lastLog = log;
  if (!group.isDescribed && impl.isDue(group, row.time)) impl.openChannel(group, row.time);
  if (group.takes)
    impl.write(group, log, publish, row);
  else
    impl.hold(group, log, publish, row);
  ++impl.state.rows;
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
    impl.openWhere([](const Impl::Group& group) { return !group.isDescribed; });
    // A short session is read as it is; of a long one every group has a picture.
    const bool isLong = std::ranges::any_of(
        impl.rowChannels, [](const auto& one) { return one.summaryChannel != 0; });
    for (Impl::RowChannel& channel : impl.rowChannels) {
      if (impl.stop || impl.error || !isLong) continue;
      if (const auto rest = channel.summary.finish()) impl.keep(channel, *rest);
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
    if (!last && Clock::now() >= next) {
      // The robot does not send any more; its rows are safe in the file only.
      openWhere([now = Clock::now(), this](const Group& group) {
        return !group.held.empty() && now - group.heldAt >= options.chunkInterval;
      });
    }
    if ((last || Clock::now() >= next) && !isEmpty()) closeCurrent();
    std::deque<McapChunk> chunks;
    std::deque<Attachment> files;
    std::map<std::string, GroupFacts> described;
    chunks.swap(full);
    files.swap(attachments);
    described.swap(newFacts);
    if (isEmpty() || Clock::now() >= next) next = Clock::now() + options.chunkInterval;
    writingSince = Clock::now();
    lock.unlock();
    if (!error) write(chunks, files, described);
    const auto room_ = options.freeSpace();
    lock.lock();
    writingSince.reset();
    state.freeBytes = room_;
    waiting = 0;
    for (const McapChunk& chunk : full) waiting += chunk.bytes();
    for (const Attachment& file_ : attachments) waiting += file_.data.size();
    for (McapChunk& chunk : chunks) {
      if (spare.size() >= maxSpareChunks) break;
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

void SessionWriter::Impl::write(std::deque<McapChunk>& chunks, std::deque<Attachment>& files,
                                const std::map<std::string, GroupFacts>& described) {
  Result<void> done;
  for (const auto& [id, now] : described) {
    if (done) done = file->metadata(session::factsName, session::toMetadata(id, now));
  }
  for (const Attachment& attachment : files) {
    if (done) {
      done = file->attach(attachment.time, attachment.time, attachment.name, attachment.mediaType,
                          attachment.data);
    }
  }
  if (done && !(files.empty() && described.empty())) done = file->sync();
  for (const McapChunk& chunk : chunks) {
    if (done) done = file->writeChunk(chunk);
  }
  if (done) return;
  const std::lock_guard lock(mutex);
  fail(done.error());
}

/// Needs the lock. Stops the recording and keeps the reason.
void SessionWriter::Impl::fail(const Error& why) {
  error = why;
  state.recording = false;
  state.problem =
      "Recording stopped. " + why.message + " Everything recorded before that is in the file.";
}

/// Needs the lock; may let go of it while it waits.
bool SessionWriter::Impl::hasSpace(std::unique_lock<std::mutex>& lock, std::size_t bytes) {
  if (stop || error) return false;
  // With waitWhenFull, even a message that is larger than the queue gets through.
  const auto fits = [&] {
    const std::size_t before = waiting + openBytes() + heldBytes;
    return before + bytes <= options.queueBytes || (options.waitWhenFull && before == 0);
  };
  if (!fits() && heldBytes > 0) {
    openWhere([](const Group& group) { return !group.held.empty(); });
  }
  while (options.waitWhenFull && !fits()) {
    // While the writing thread has work, there is no reason for a chunk that is not full.
    if (waiting == 0 && !isEmpty()) closeCurrent();
    wake.notify_one();
    room.wait(lock);
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

}  // namespace pitchboard::telemetry

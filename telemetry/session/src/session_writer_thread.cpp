// SPDX-License-Identifier: GPL-3.0-or-later
// The thread of a SessionWriter: closes chunks, compresses and writes them.
#include <algorithm>

#include "session_writer_impl.h"
#include "write_rate.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t mostSpareChunks = 4;

}  // namespace

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
      "Recording stopped. " + why.message + " What was recorded until then is in the file.";
}

/// Needs the lock; may let go of it while it waits.
bool SessionWriter::Impl::hasRoom(std::unique_lock<std::mutex>& lock, std::size_t bytes) {
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

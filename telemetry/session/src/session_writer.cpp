// SPDX-License-Identifier: GPL-3.0-or-later
// append() fills chunks on the caller's thread; the writer's thread compresses and writes them.
#include <telemetry/session/session_writer.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
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

/// Texts that were received can be very many, and a newer channel describes them all.
void forgetTexts(std::vector<ColumnInfo>& columns) {
  for (ColumnInfo& column : columns) {
    if (column.kind == ColumnKind::Text) column.labels.clear();
  }
}

std::optional<std::uint64_t> freeSpaceBeside(const std::string& path) {
  std::error_code problem;
  const auto folder = std::filesystem::absolute(path, problem).parent_path();
  const auto space = std::filesystem::space(folder, problem);
  return problem ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

}  // namespace

struct SessionWriter::Impl {
  using Clock = std::chrono::steady_clock;
  static constexpr std::uint16_t maxChannels = 60'000;
  using GroupFacts = session::GroupFacts;
  struct Attachment {
    std::uint64_t time;
    std::string name, mediaType, data;
  };

  std::string path;
  SessionInfo info;
  SessionWriterOptions options;
  std::optional<McapWriter> file;  ///< of the writing thread once it runs
  std::thread thread;

  /// A channel with rows.
  struct RowChannel {
    std::vector<ColumnInfo> columns;
    session::RowLayout layout;
    std::string topic;
    std::uint16_t channel = 0;  ///< 0: there are too many, and its rows are dropped
    std::uint32_t sequence = 0;
    std::uint64_t lastLog = 0;
    SummaryBuilder summary;
    std::uint16_t summaryChannel = 0;  ///< 0: there is no part yet
    std::uint32_t summaries = 0;
  };
  struct HeldRow {
    double time;
    std::uint64_t log, publish;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
  };
  /// A group writes each of its rows into one of its channels. A channel that describes many
  /// columns is as large as thousands of rows; one for each new column or text would be most of the
  /// file. Rows with new columns therefore wait until a channel for all of them is due, and new
  /// texts are described from time to time.
  struct Group {
    GroupInfo info;                      ///< as its rows come now
    std::vector<std::size_t> channels;   ///< of `rowChannels`
    std::optional<std::size_t> takes{};  ///< the channel with the columns of `info`
    bool isDescribed = false;            ///< that channel also has the labels of `info`
    std::optional<std::size_t> last{};   ///< the channel of the last row
    std::uint64_t lastLog = 0;
    double openedAt = -std::numeric_limits<double>::infinity();  ///< s; its newest channel
    double wait = 0.0;                                           ///< s; until the next channel
    std::vector<HeldRow> held{};  ///< their columns are those of `info`, or its first ones
    Clock::time_point heldAt{};
  };
  static std::size_t bytesOf(const HeldRow& row) {
    return sizeof row + 4 * row.words.size() + 8 * row.values.size();
  }
  static constexpr double minWait = 1.0, maxHold = 8.0, maxWait = 64.0;  // s

  mutable std::mutex mutex;  ///< of everything below
  std::condition_variable wake, room;
  std::deque<McapChunk> full;
  McapChunk current;
  McapChunk sparse;  ///< events and log lines: who lists them need not read the rows
  std::vector<McapChunk> spare;
  std::deque<Attachment> attachments;
  std::size_t waiting = 0;  ///< bytes in `full`, and what the writing thread has in hand
  bool stop = false;
  std::vector<RowChannel> rowChannels;
  std::vector<Group> groups;
  std::map<std::string, std::size_t> groupsByKey;
  std::size_t heldBytes = 0;
  std::map<std::string, GroupFacts> facts;     ///< of groups by their ids, as they are known now
  std::map<std::string, GroupFacts> newFacts;  ///< those of them that are not in the file yet
  struct Copied {
    std::optional<std::size_t> rows{};  ///< of `rowChannels`
    std::size_t group = 0;              ///< with rows
    bool isSparse = false;
  };
  std::vector<Copied> copied;  ///< channels of another file, by their number in this one
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
  void write(std::deque<McapChunk>& chunks, std::deque<Attachment>& files,
             const std::map<std::string, GroupFacts>& described);
  void noteFacts(const GroupInfo& info);
  bool hasSpace(std::unique_lock<std::mutex>& lock, std::size_t bytes);
  void fail(const Error& why);
  void closeCurrent();
  bool isEmpty() const { return current.empty() && sparse.empty(); }
  std::size_t openBytes() const { return current.bytes() + sparse.bytes(); }
  std::size_t indexOf(const GroupInfo& of);
  void openChannel(Group& group, double time);
  void openWhere(const std::function<bool(const Group&)>& wanted);
  bool isDue(const Group& group, double time) const;
  void hold(Group& group, std::uint64_t log, std::uint64_t publish, const RowView& row);
  void write(Group& group, std::uint64_t log, std::uint64_t publish, const RowView& row);
  std::uint16_t addSchema(McapChunk& to, McapSchema schema);
  std::uint16_t addChannel(McapChunk& to, McapChannel channel);
  void summarize(Group& group, std::size_t channel, std::uint64_t log, const RowView& row);
  void keep(RowChannel& channel, const SummaryPart& part);
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

/// Needs the lock, as everything below.
std::size_t SessionWriter::Impl::indexOf(const GroupInfo& of) {
  const std::string key = of.id.empty() ? "name " + of.name : "id " + of.id;
  const auto [known, isNew] = groupsByKey.try_emplace(key, groups.size());
  if (isNew) groups.emplace_back();
  return known->second;
}

/// Makes a channel for what `group.info` says now, and writes the rows that wait for it.
void SessionWriter::Impl::openChannel(Group& group, double time) {
  const GroupInfo& of = group.info;
  // Two groups may have had one name, one after the other.
  std::string suffix;
  const auto isTaken = [&](const RowChannel& one) {
    return one.topic == session::rowTopic(of) + suffix;
  };
  for (int i = 2; std::ranges::any_of(rowChannels, isTaken); ++i) suffix = std::to_string(i);
  RowChannel channel{.columns = of.columns,
                     .layout = session::RowLayout(of),
                     .topic = session::rowTopic(of) + suffix,
                     .summary = SummaryBuilder(of)};
  if (!stop && !error && channels < maxChannels) {
    const std::uint16_t schema = addSchema(
        current, {0, session::rowSchemaName(of) + suffix, "ros2msg", session::rowSchema(of)});
    channel.channel =
        addChannel(current, {0,
                             schema,
                             channel.topic,
                             "cdr",
                             {{std::string(session::groupKey), session::groupToJson(of)}}});
  }
  for (const std::size_t before : group.channels) forgetTexts(rowChannels[before].columns);
  group.takes = rowChannels.size();
  group.isDescribed = true;
  group.channels.push_back(rowChannels.size());
  rowChannels.push_back(std::move(channel));
  // Twice as long for columns that keep coming, and soon for a change after a calm time.
  const bool isCalm = !(time - group.openedAt < 2.0 * group.wait);
  group.wait = isCalm ? minWait : std::min(2.0 * group.wait, maxWait);
  group.openedAt = time;
  const std::vector<HeldRow> held = std::exchange(group.held, {});
  const std::size_t values = rowChannels.back().layout.values;
  for (const HeldRow& row : held) {
    heldBytes -= bytesOf(row);
    std::vector<double> all = row.values;
    all.resize(values, std::numeric_limits<double>::quiet_NaN());
    write(group, row.log, row.publish, {row.time, row.words, all});
  }
}

void SessionWriter::Impl::openWhere(const std::function<bool(const Group&)>& wanted) {
  if (stop || error) return;
  for (Group& group : groups) {
    if (!group.channels.empty() && !group.isDescribed && wanted(group)) {
      openChannel(group, group.openedAt + group.wait);
    }
  }
}

bool SessionWriter::Impl::isDue(const Group& group, double time) const {
  const double wait = group.takes ? group.wait : std::min(group.wait, maxHold);
  const bool isLate = time < group.openedAt || time >= group.openedAt + wait;
  return isLate || (!group.held.empty() && heldBytes > options.queueBytes / 4);
}

void SessionWriter::Impl::hold(Group& group, std::uint64_t log, std::uint64_t publish,
                               const RowView& row) {
  group.held.push_back({row.time,
                        log,
                        publish,
                        {row.words.begin(), row.words.end()},
                        {row.values.begin(), row.values.end()}});
  group.heldAt = Clock::now();
  heldBytes += bytesOf(group.held.back());
}

void SessionWriter::Impl::write(Group& group, std::uint64_t log, std::uint64_t publish,
                                const RowView& row) {
  RowChannel& to = rowChannels[*group.takes];
  if (to.channel == 0) {
    ++state.dropped;
    return;
  }
  to.layout.write(current.addMessage(to.channel, to.sequence++, log, publish, to.layout.size), row);
  summarize(group, *group.takes, log, row);
}

void SessionWriter::Impl::summarize(Group& group, std::size_t channel, std::uint64_t log,
                                    const RowView& row) {
  // Buckets of a group's channels do not overlap.
  if (group.last && *group.last != channel) {
    RowChannel& before = rowChannels[*group.last];
    if (const auto part = before.summary.closeBucket()) keep(before, *part);
  }
  group.last = channel;
  RowChannel& to = rowChannels[channel];
  to.lastLog = log;
  const auto start = static_cast<std::uint64_t>(info.start.time_since_epoch().count());
  const double time = static_cast<double>(static_cast<std::int64_t>(log - start)) / 1e9;
  if (const auto part = to.summary.add(time, row)) keep(to, *part);
}

/// A chunk of its own: who draws a whole day reads these chunks and no others.
void SessionWriter::Impl::keep(RowChannel& of, const SummaryPart& part) {
  McapChunk chunk;
  if (of.summaryChannel == 0) {
    of.summaryChannel = addChannel(chunk, {0,
                                           0,
                                           of.topic + "/summary",
                                           std::string(session::summaryEncoding),
                                           {{std::string(session::summaryKey), of.topic}}});
    if (of.summaryChannel == 0) return;
  }
  // Behind its rows: a recording that breaks off has no summary of rows that it does not have.
  closeCurrent();
  const std::string bytes = session::summaryBytes(part);
  chunk.add(McapMessage{of.summaryChannel, of.summaries++, of.lastLog, of.lastLog, bytes});
  waiting += chunk.bytes();
  full.push_back(std::move(chunk));
  wake.notify_one();
}

std::uint16_t SessionWriter::Impl::addSchema(McapChunk& to, McapSchema schema) {
  if (schemas >= maxChannels) return 0;
  schema.id = ++schemas;
  to.add(schema);
  return schema.id;
}

std::uint16_t SessionWriter::Impl::addChannel(McapChunk& to, McapChannel channel) {
  if (channels >= maxChannels) return 0;
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

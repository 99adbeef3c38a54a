// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include <telemetry/mcap/mcap_cursor.h>
#include <telemetry/series/robot_names.h>
#include <telemetry/session/drawn_notes.h>
#include <telemetry/session/session_notes.h>

#include "session_loss.h"
#include "session_reader_impl.h"
#include "session_summary.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t keptChunks = 4;

}  // namespace

SessionReader::SessionReader(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
SessionReader::SessionReader(SessionReader&&) noexcept = default;
SessionReader& SessionReader::operator=(SessionReader&&) noexcept = default;
SessionReader::~SessionReader() = default;

Result<SessionReader> SessionReader::open(const std::string& path,
                                          const McapReaderOptions& options) {
  auto session = of(McapReader::open(path, options));
  if (session) session->m_impl->takeNotes(path);
  return session;
}

void SessionReader::Impl::takeNotes(const std::string& path) {
  const auto add = [this](double time, std::string_view kind, const std::string& text) {
    SessionEvent& event = addedNotes.emplace_back();
    event.time = time;
    event.kind = kind;
    event.text = text;
    event.facts.emplace().detail = text;
  };
  const auto added = readSessionNotes(path);
  if (!added) return note("The bookmarks are not shown: " + added.error().text());
  for (const auto& [time, text] : *added) add(time, session::bookmarkKind, text);
  const auto drawn = readDrawnNotes(path);
  if (!drawn) return note("The drawn notes are not shown: " + drawn.error().text());
  for (const DrawnNote& one : drawn->notes) add(one.time, session::noteKind, labelOf(one));
  if (drawn->unreadable > 0) {
    note("Drawn notes that cannot be read are not shown: " + std::to_string(drawn->unreadable) +
         " in " + sessionNotesPath(path) + ". They stay in the file.");
  }
  std::ranges::stable_sort(addedNotes, {}, &SessionEvent::time);
}

Result<SessionReader> SessionReader::openBytes(std::string bytes,
                                               const McapReaderOptions& options) {
  return of(McapReader::openBytes(std::move(bytes), options));
}

Result<SessionReader> SessionReader::of(Result<McapReader> file) {
  if (!file) return tl::unexpected(file.error());
  auto impl = std::make_unique<Impl>(std::move(*file));
  impl->takeMetadata();
  impl->takeChannels();
  impl->takeFacts();
  impl->takeSummaries();
  impl->takeChunks();
  impl->findStart();
  impl->noteLosses();
  SessionReader session(std::move(impl));
  session.m_impl->noteOthers(session.isForeign());
  return session;
}

void SessionReader::Impl::takeMetadata() {
  notes = file.contents().problems;
  seen.assign(file.contents().chunks.size(), false);
  int format = 0;
  for (const McapMetadataInfo& entry : file.contents().metadata) {
    if (entry.name != session::metadataName || described) continue;
    const auto values = file.readMetadata(entry);
    const auto found = values ? session::infoFromMetadata(*values, format) : std::nullopt;
    if (!found) {
      note("At byte " + std::to_string(entry.offset) +
           ": the description of the session is damaged; it is not used.");
      continue;
    }
    info = *found;
    described = true;
  }
  if (described && format > sessionFormat) {
    note("This file was written by a newer version (format " + std::to_string(format) +
         "; this program reads " + std::to_string(sessionFormat) +
         "); parts that are unknown here are not shown.");
  }
}

/// Without its description: the first row says when its source began; else times begin at the
/// first message.
void SessionReader::Impl::findStart() {
  if (described) return;
  const auto fits = [](std::uint64_t time) {
    return static_cast<std::int64_t>(
        std::min<std::uint64_t>(time, std::numeric_limits<std::int64_t>::max()));
  };
  info.start = WallTime(Duration(fits(file.contents().statistics.start)));
  for (std::size_t i = 0; i < file.contents().chunks.size() && !groups.empty(); ++i) {
    McapCursor cursor(body(i));
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message) continue;
      const Use use = useOf(cursor.message().channel);
      SessionRow row;
      if (use.group == Impl::noGroup || !readRow(use, cursor.message().data, row)) continue;
      const WallTime moment{Duration(fits(cursor.message().publishTime))};
      info.start = WallTime(Duration(fits(session::nanoseconds(moment, -row.time))));
      return;
    }
  }
}

/// Behind findStart(), which says what second of the session a moment is.
void SessionReader::Impl::noteLosses() {
  for (const McapLoss& loss : file.contents().losses) note(lossText(loss, info.start));
  losses.insert(losses.begin(), file.contents().losses.begin(), file.contents().losses.end());
}

bool SessionReader::Impl::readRow(Use use, std::string_view data, SessionRow& row) const {
  const RowMap& map = maps[use.layout];
  if (map.isIdentity()) return layouts[use.layout].read(data, row.time, row.words, row.values);
  if (!layouts[use.layout].read(data, row.time, ownWords, ownValues)) return false;
  (void)map.convert({row.time, ownWords, ownValues}, row.words, row.values);
  return true;
}

/// Versions before 0.24 wrote no former names.
static void keepNames(const GroupInfo& before, GroupInfo& now) {
  if (factsOf(now).formerNames.empty()) keepFormerNames(before, now);
}

void SessionReader::Impl::addGroup(GroupInfo group, std::uint64_t rows, std::uint16_t channel) {
  Use& use = useOfChannel[channel];
  use.layout = layouts.size();
  layouts.emplace_back(group);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    SessionGroup& known = groups[g];
    const bool isRenamed = factsOf(group).was == known.info.name;
    if (!isSameGroup(known.info, group) && !isRenamed) continue;
    keepNames(known.info, group);
    use.group = static_cast<int>(g);
    known.rows += rows;
    known.channels.push_back(channel);
    known.info = {std::move(group.name), mergedColumns(known.info.columns, group.columns),
                  std::move(group.robot), std::move(group.match), std::move(group.id)};
    return;
  }
  use.group = static_cast<int>(groups.size());
  groups.push_back({std::move(group), rows, {channel}});
}

/// Once every channel is known, and with them all columns of each group. The columns of a channel
/// are read again: to keep those of all channels would take much more memory.
void SessionReader::Impl::mapRows() {
  maps.resize(layouts.size());
  for (const SessionGroup& group : groups) {
    for (const std::uint16_t channel : group.channels) {
      const auto& metadata = file.contents().channels.at(channel).metadata;
      const auto own = group.channels.size() == 1
                           ? std::optional(group.info)
                           : session::groupFromJson(metadata.at(std::string(session::groupKey)));
      if (own) maps[useOfChannel[channel].layout] = RowMap(own->columns, group.info.columns);
    }
  }
}

void SessionReader::Impl::takeChannels() {
  const auto& channels = file.contents().channels;
  useOfChannel.resize(channels.empty() ? 0 : std::size_t{channels.rbegin()->first} + 1);
  for (const auto& [id, channel] : channels) {
    const auto counted = file.contents().statistics.perChannel.find(id);
    const std::uint64_t count =
        counted == file.contents().statistics.perChannel.end() ? 0 : counted->second;
    if (const auto found = channel.metadata.find(session::groupKey);
        found != channel.metadata.end() && channel.messageEncoding == "cdr") {
      if (auto group = session::groupFromJson(found->second)) {
        addGroup(std::move(*group), count, id);
        continue;
      }
    }
    if (const auto stream = session::streamOf(channel)) {
      channelsOfStream[static_cast<std::size_t>(*stream)].push_back(id);
      useOfChannel[id].stream = *stream;
      continue;
    }
    if (channel.messageEncoding == session::summaryEncoding) continue;  // takeSummaries()
    otherChannels.push_back(id);
  }
  mapRows();
}

void SessionReader::Impl::noteOthers(bool isForeign) {
  const McapContents& contents = file.contents();
  if (isForeign) {
    const std::string library = contents.library.substr(0, 60);
    return note("Another program recorded this file" +
                (library.empty() ? std::string() : " (" + library + ")") +
                ". Make a session of it: File > Open in the studio, or pitchboard-cli import.");
  }
  for (const std::uint16_t id : otherChannels) {
    const McapChannel& channel = contents.channels.at(id);
    const auto schema = contents.schemas.find(channel.schema);
    const auto counted = contents.statistics.perChannel.find(id);
    const std::uint64_t count =
        counted == contents.statistics.perChannel.end() ? 0 : counted->second;
    note("The channel \"" + channel.topic.substr(0, 80) + "\" (" +
         channel.messageEncoding.substr(0, 20) +
         (schema == contents.schemas.end() ? "" : ", " + schema->second.name.substr(0, 80)) +
         ") is unknown; its " + std::to_string(count) + " messages are left out.");
  }
}

/// A group has the name and the facts that were known last.
void SessionReader::Impl::takeFacts() {
  for (const McapMetadataInfo& entry : file.contents().metadata) {
    if (entry.name != session::factsName) continue;
    const auto values = file.readMetadata(entry);
    auto found = values ? session::factsFromMetadata(*values) : std::nullopt;
    if (!found) {
      note("At byte " + std::to_string(entry.offset) +
           ": the name of a group is damaged; it is not used.");
      continue;
    }
    for (SessionGroup& group : groups) {
      if (group.info.id != found->first) continue;
      GroupInfo now = group.info;
      now.name = found->second.name;
      now.robot = found->second.robot;
      now.match = found->second.match;
      keepNames(group.info, now);
      group.info = std::move(now);
    }
  }
}

void SessionReader::Impl::takeSummaries() {
  for (const auto& [id, channel] : file.contents().channels) {
    const auto of = channel.metadata.find(std::string(session::summaryKey));
    if (channel.messageEncoding != session::summaryEncoding || of == channel.metadata.end())
      continue;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto& channels = groups[g].channels;
      const auto rows = std::ranges::find_if(channels, [&](std::uint16_t one) {
        return file.contents().channels.at(one).topic == of->second;
      });
      if (rows == channels.end()) continue;
      summaryChannels[static_cast<GroupId>(g)][id] = useOfChannel[*rows].layout;
    }
  }
}

void SessionReader::Impl::takeChunks() {
  const auto& chunks = file.contents().chunks;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (chunks[i].end != 0 || chunks[i].loose) byStart.push_back(i);
  }
  std::stable_sort(byStart.begin(), byStart.end(),
                   [&](std::size_t a, std::size_t b) { return chunks[a].start < chunks[b].start; });
  std::uint64_t latest = 0;
  for (const std::size_t chunk : byStart) {
    latest = std::max(latest, chunks[chunk].end);
    latestEnd.push_back(latest);
  }
}

/// Null when it is damaged, which is then noted once.
std::shared_ptr<const std::string> SessionReader::Impl::hold(std::size_t chunk) const {
  const auto found =
      std::find_if(kept.begin(), kept.end(), [&](const Kept& one) { return one.chunk == chunk; });
  if (found != kept.end()) {
    kept.splice(kept.begin(), kept, found);
    return kept.front().body;
  }
  if (damaged.contains(chunk)) return nullptr;
  seen[chunk] = true;
  if (kept.size() < keptChunks) {
    kept.emplace_front();
  } else {
    kept.splice(kept.begin(), kept, std::prev(kept.end()));
  }
  Kept& now = kept.front();
  now.chunk = chunk;
  // Somebody else may still hold the bytes of the chunk whose memory is reused.
  if (!now.body || now.body.use_count() > 1) now.body = std::make_shared<std::string>();
  if (auto read = file.readChunk(file.contents().chunks[chunk], *now.body); !read) {
    losses.push_back(file.lossOf(file.contents().chunks[chunk], read.error().message));
    note(lossText(losses.back(), info.start));
    damaged.insert(chunk);
    kept.pop_front();
    return nullptr;
  }
  return now.body;
}

/// Empty when it is damaged. Valid until `keptChunks` others were read.
std::string_view SessionReader::Impl::body(std::size_t chunk) const {
  const auto held = hold(chunk);
  return held ? std::string_view(*held) : std::string_view();
}

bool SessionReader::check(const std::function<bool(double)>& progress) const {
  const std::size_t chunks = m_impl->seen.size();
  for (std::size_t i = 0; i < chunks; ++i) {
    if (progress && !progress(static_cast<double>(i) / static_cast<double>(chunks))) return false;
    // Without an index every chunk was checked when the file was opened.
    if (!m_impl->seen[i] && m_impl->file.contents().indexed) (void)m_impl->body(i);
  }
  for (const McapAttachmentInfo& one : m_impl->file.contents().attachments) {
    if (const auto data = m_impl->file.readAttachment(one); !data) {
      m_impl->note(data.error().text());
      m_impl->damagedAttachment = true;
    }
  }
  return true;
}

bool SessionReader::isDamaged() const {
  return m_impl->damagedAttachment || !m_impl->losses.empty();
}
const std::vector<McapLoss>& SessionReader::losses() const {
  return m_impl->losses;
}

const SessionInfo& SessionReader::info() const {
  return m_impl->info;
}
bool SessionReader::ours() const {
  return m_impl->described || !m_impl->groups.empty();
}
bool SessionReader::isForeign() const {
  return !ours() && !m_impl->file.contents().library.starts_with("pitchboard");
}
bool SessionReader::isGrowing() const {
  return m_impl->file.contents().growing;
}
std::span<const std::uint16_t> SessionReader::otherChannels() const {
  return m_impl->otherChannels;
}
bool SessionReader::complete() const {
  return m_impl->file.contents().whole;
}
const std::vector<std::string>& SessionReader::notes() const {
  return m_impl->notes;
}
std::span<const SessionGroup> SessionReader::groups() const {
  return m_impl->groups;
}
Result<std::vector<GroupId>> SessionReader::groupsNamed(std::string_view name) const {
  std::vector<const GroupInfo*> infos;
  for (const SessionGroup& group : m_impl->groups) infos.push_back(&group.info);
  return telemetry::groupsNamed(name, infos);
}
const std::vector<SessionEvent>& SessionReader::addedNotes() const {
  return m_impl->addedNotes;
}
const McapReader& SessionReader::file() const {
  return m_impl->file;
}

std::optional<TimeRange> SessionReader::range() const {
  const McapStatistics& statistics = m_impl->file.contents().statistics;
  if (statistics.messages == 0) return std::nullopt;
  return TimeRange{seconds(statistics.start), seconds(statistics.end)};
}

std::uint64_t SessionReader::count(SessionStream stream) const {
  std::uint64_t sum = 0;
  const auto& counts = m_impl->file.contents().statistics.perChannel;
  for (const std::uint16_t id : m_impl->channelsOfStream[static_cast<std::size_t>(stream)]) {
    if (const auto found = counts.find(id); found != counts.end()) sum += found->second;
  }
  return sum;
}

double SessionReader::seconds(std::uint64_t logTime) const {
  const auto start = static_cast<std::uint64_t>(m_impl->info.start.time_since_epoch().count());
  return static_cast<double>(static_cast<std::int64_t>(logTime - start)) / 1e9;
}

std::uint64_t SessionReader::logTime(double time) const {
  return session::nanoseconds(m_impl->info.start, time);
}

Result<std::string> SessionReader::attachment(std::string_view name) const {
  for (const McapAttachmentInfo& one : m_impl->file.contents().attachments) {
    if (one.name == name) return m_impl->file.readAttachment(one);
  }
  return failure(ErrorCode::NotFound, "The session has no such attachment.", std::string(name));
}

std::optional<LogLine> sessionLogLine(std::string_view json) {
  return session::logLineFromJson(json);
}

std::optional<SessionDatagram> sessionDatagram(std::string_view json) {
  return session::datagramFromJson(json);
}

std::string sessionEventJson(const SessionEvent& event) {
  return session::toJson(event);
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
// MCAP files of any program. Chunks that overlap in time are unpacked together, so that messages
// come in the order of their log times, also over the files of a split recording. The next chunks
// are read and unpacked on a thread of their own.
#include <algorithm>
#include <limits>
#include <queue>

#include <base/byte_sizes.h>
#include <base/try.h>
#include <telemetry/mcap/mcap_cursor.h>
#include <telemetry/mcap/mcap_reader.h>
#include <telemetry/recordings/decoded_topics.h>

#include "chunks_ahead.h"
#include "recording_formats.h"

namespace pitchboard::telemetry {
namespace {

/// Unpacked chunks that may be in memory at once; beyond that, messages can be out of order.
constexpr std::size_t maxOpenChunkBytes = 96 * mebibyte;
constexpr std::size_t noTopic = std::numeric_limits<std::size_t>::max();

class McapRecording : public RecordingReader {
 public:
  Result<void> add(const std::string& path, const std::function<bool(double)>& progress) {
    McapReaderOptions options;
    options.progress = progress;
    auto reader = TRY(McapReader::open(path, options));
    const bool isOurs = std::ranges::any_of(
        reader.contents().metadata, [](const auto& entry) { return entry.name == "pitchboard"; });
    if (isOurs) {
      return failure(
          ErrorCode::InvalidArgument,
          "This is a session of Pitchboard already. Open it as it is, beside others with "
          "Timeline > Compare with sessions.",
          path);
    }
    const std::size_t file = m_files.size();
    m_files.push_back({std::move(reader), {}});
    takeChannels(m_files.back());
    const auto& chunks = m_files.back().reader.contents().chunks;
    for (std::size_t i = 0; i < chunks.size(); ++i) addChunk(file, i);
    return {};
  }

  void begin() {
    std::stable_sort(m_chunks.begin(), m_chunks.end(),
                     [](const ListedChunk& a, const ListedChunk& b) { return a.start < b.start; });
    m_ahead.emplace(m_chunks.size(),
                    [this](std::size_t chunk, OpenChunk& to) { read(m_chunks[chunk], to); });
  }

  const std::vector<RecordedTopic>& topics() const override { return m_topics.topics(); }

  double progress() const override {
    return m_chunks.empty()
               ? 1.0
               : static_cast<double>(m_nextChunk) / static_cast<double>(m_chunks.size());
  }

  Result<RecordedItem> next() override {
    for (;;) {
      if (!m_current) {
        openChunks();
        if (m_heads.empty()) return RecordedItem::End;
        m_current = m_heads.top().open;
        m_heads.pop();
      }
      OpenChunk& open = *m_open[*m_current];
      const ChunkEntry& entry = open.entries[open.at++];
      leaveUnlessNext(open);
      if (m_topics.decode(entry.topic, entry.data, toSigned(entry.logTime), m_message)) {
        return RecordedItem::Message;
      }
    }
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    for (const File& file : m_files) {
      const McapContents& contents = file.reader.contents();
      for (const std::string& problem : contents.problems) {
        notes.push_back(contents.name + ": " + problem);
      }
      for (const McapLoss& loss : contents.losses) addLoss(contents.name, loss, notes);
    }
    notes.insert(notes.end(), m_damage.begin(), m_damage.end());
    m_topics.addNotes(notes);
    if (m_unknown > 0) {
      notes.push_back(countText(m_unknown, "message belongs", "messages belong") +
                      " to channels that the recording does not define.");
    }
    return notes;
  }

 private:
  struct File {
    McapReader reader;
    std::vector<std::size_t> topicOfChannel;
  };
  struct ListedChunk {
    std::uint64_t start;
    std::size_t file, index;
  };
  struct Head {
    std::uint64_t logTime;
    std::size_t open;
    bool operator<(const Head& other) const {  // the earliest is on top
      return logTime != other.logTime ? logTime > other.logTime : open > other.open;
    }
  };

  static std::int64_t toSigned(std::uint64_t time) {
    return static_cast<std::int64_t>(
        std::min<std::uint64_t>(time, std::numeric_limits<std::int64_t>::max()));
  }

  static void addLoss(const std::string& name, const McapLoss& loss,
                      std::vector<std::string>& notes) {
    if (notes.size() > 1000) return;
    notes.push_back(name + ": " + std::to_string(loss.bytes) + " bytes at byte " +
                    std::to_string(loss.offset) + " were left out. " + loss.reason);
  }

  /// Goes on with the chunk that is read, unless another one has the next message.
  void leaveUnlessNext(const OpenChunk& open) {
    if (open.at == open.entries.size()) {
      m_finished = m_current;  // its bytes are needed until the next call
      m_current.reset();
      return;
    }
    const std::uint64_t time = open.entries[open.at].logTime;
    const bool isNext = (m_heads.empty() || time < m_heads.top().logTime) &&
                        (m_nextChunk == m_chunks.size() || time < m_chunks[m_nextChunk].start);
    if (isNext) return;
    m_heads.push({time, *m_current});
    m_current.reset();
  }

  void takeChannels(File& file) {
    const McapContents& contents = file.reader.contents();
    if (!contents.channels.empty()) {
      file.topicOfChannel.assign(std::size_t{contents.channels.rbegin()->first} + 1, noTopic);
    }
    for (const auto& [id, channel] : contents.channels) {
      const auto schema = contents.schemas.find(channel.schema);
      const bool isThere = schema != contents.schemas.end();
      const auto counted = contents.statistics.perChannel.find(id);
      const std::uint64_t count =
          counted == contents.statistics.perChannel.end() ? 0 : counted->second;
      const MessageSchema described{isThere ? schema->second.name : std::string_view(),
                                    isThere ? schema->second.encoding : std::string_view(),
                                    channel.messageEncoding,
                                    isThere ? schema->second.data : std::string_view()};
      file.topicOfChannel[id] = m_topics.add(channel.topic, described, count);
    }
  }

  std::size_t topicOf(const File& file, std::uint16_t channel) const {
    return channel < file.topicOfChannel.size() ? file.topicOfChannel[channel] : noTopic;
  }

  /// Chunks that hold nothing but images are not read at all.
  void addChunk(std::size_t file, std::size_t index) {
    const McapChunkInfo& chunk = m_files[file].reader.contents().chunks[index];
    const auto isWanted = [&](std::uint16_t channel) {
      const std::size_t topic = topicOf(m_files[file], channel);
      return topic == noTopic || m_topics.isWanted(topic);
    };
    if (!chunk.channels.empty() && std::ranges::none_of(chunk.channels, isWanted)) return;
    m_chunks.push_back({chunk.start, file, index});
  }

  void openChunks() {
    if (m_finished) {
      m_openBytes -= m_open[*m_finished]->body.size();
      m_ahead->giveBack(std::move(m_open[*m_finished]));
      m_free.push_back(*m_finished);
      m_finished.reset();
    }
    while (m_nextChunk < m_chunks.size() &&
           (m_heads.empty() || (m_chunks[m_nextChunk].start <= m_heads.top().logTime &&
                                m_openBytes < maxOpenChunkBytes))) {
      ++m_nextChunk;
      take(m_ahead->next());
    }
  }

  void take(std::unique_ptr<OpenChunk> open) {
    m_unknown += open->unknown;
    for (const auto& [topic, count] : open->passed) m_topics.passOver(topic, count);
    if (!open->damage.empty() && m_damage.size() < 100) {
      m_damage.insert(m_damage.end(), open->damage.begin(), open->damage.end());
    }
    if (open->entries.empty()) return m_ahead->giveBack(std::move(open));
    if (m_free.empty()) {
      m_free.push_back(m_open.size());
      m_open.emplace_back();
    }
    const std::size_t place = m_free.back();
    m_free.pop_back();
    m_openBytes += open->body.size();
    m_heads.push({open->entries.front().logTime, place});
    m_open[place] = std::move(open);
  }

  /// On the thread of `m_ahead`, which alone reads the files meanwhile.
  void read(const ListedChunk& chunk, OpenChunk& open) const {
    const File& file = m_files[chunk.file];
    const McapChunkInfo& info = file.reader.contents().chunks[chunk.index];
    const auto isWanted = [&](std::uint16_t channel) {
      const std::size_t topic = topicOf(file, channel);
      return topic == noTopic || m_topics.isWanted(topic);
    };
    if (auto done = file.reader.readChunk(info, isWanted, open.body); !done) {
      addLoss(file.reader.contents().name, file.reader.lossOf(info, done.error().message),
              open.damage);
      return;
    }
    takeEntries(file, open);
  }

  void takeEntries(const File& file, OpenChunk& open) const {
    McapCursor cursor(open.body);
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message) continue;
      const McapMessage& message = cursor.message();
      const std::size_t topic = topicOf(file, message.channel);
      if (topic == noTopic) {
        ++open.unknown;
      } else if (m_topics.isWanted(topic)) {
        open.entries.push_back({message.logTime, topic, message.data});
      } else {
        ++open.passed[topic];
      }
    }
    const auto byTime = [](const ChunkEntry& a, const ChunkEntry& b) {
      return a.logTime < b.logTime;
    };
    if (!std::is_sorted(open.entries.begin(), open.entries.end(), byTime)) {
      std::stable_sort(open.entries.begin(), open.entries.end(), byTime);
    }
  }

  std::vector<File> m_files;
  DecodedTopics m_topics;
  std::vector<ListedChunk> m_chunks;  ///< by their start
  std::size_t m_nextChunk = 0;
  std::vector<std::unique_ptr<OpenChunk>> m_open;
  std::vector<std::size_t> m_free;  ///< of m_open
  std::priority_queue<Head> m_heads;
  std::optional<std::size_t> m_current;   ///< of m_open: the chunk that is read, not in m_heads
  std::optional<std::size_t> m_finished;  ///< of m_open: the chunk that was read
  std::size_t m_openBytes = 0;
  std::uint64_t m_unknown = 0;
  std::vector<std::string> m_damage;
  std::optional<ChunksAhead> m_ahead;  ///< last: its thread ends before the rest goes
};

}  // namespace

bool isMcapRecording(const std::string&, std::string_view beginning) {
  return beginning.starts_with(std::string_view(mcapMagic.data(), 5));
}

Result<std::unique_ptr<RecordingReader>> openMcapRecording(
    const std::vector<std::string>& files, const std::function<bool(double)>& progress) {
  auto recording = std::make_unique<McapRecording>();
  for (const std::string& file : files) TRY(recording->add(file, progress));
  recording->begin();
  return recording;
}

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
// MCAP files of any program. Chunks that overlap in time are unpacked together, so that messages
// come in the order of their log times, also over the files of a split recording.
#include <algorithm>
#include <limits>
#include <queue>

#include <base/byte_sizes.h>
#include <base/try.h>
#include <telemetry/mcap/mcap_cursor.h>
#include <telemetry/mcap/mcap_reader.h>
#include <telemetry/recordings/decoded_topics.h>

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
      return failure(ErrorCode::InvalidArgument,
                     "This is a session of Pitchboard already. Open it as it is.", path);
    }
    const std::size_t file = m_files.size();
    m_files.push_back({std::move(reader), {}});
    takeChannels(m_files.back());
    const auto& chunks = m_files.back().reader.contents().chunks;
    for (std::size_t i = 0; i < chunks.size(); ++i) addChunk(file, i);
    return {};
  }

  void sortChunks() {
    std::stable_sort(m_chunks.begin(), m_chunks.end(),
                     [](const Chunk& a, const Chunk& b) { return a.start < b.start; });
  }

  const std::vector<RecordedTopic>& topics() const override { return m_topics.topics(); }

  double progress() const override {
    return m_chunks.empty()
               ? 1.0
               : static_cast<double>(m_nextChunk) / static_cast<double>(m_chunks.size());
  }

  Result<RecordedItem> next() override {
    for (;;) {
      openChunks();
      if (m_heads.empty()) return RecordedItem::End;
      const Head head = m_heads.top();
      m_heads.pop();
      Open& open = *m_open[head.open];
      const Entry entry = open.entries[open.at++];
      if (open.at < open.entries.size()) {
        m_heads.push({open.entries[open.at].logTime, head.open});
      } else {
        m_finished = head.open;  // its bytes are needed until the next call
      }
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
  struct Chunk {
    std::uint64_t start;
    std::size_t file, index;
  };
  struct Entry {
    std::uint64_t logTime;
    std::size_t topic;
    std::string_view data;
  };
  struct Open {
    std::string body;
    std::vector<Entry> entries;
    std::size_t at = 0;
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
      m_free.push_back(*m_finished);
      m_finished.reset();
    }
    while (m_nextChunk < m_chunks.size() &&
           (m_heads.empty() || (m_chunks[m_nextChunk].start <= m_heads.top().logTime &&
                                m_openBytes < maxOpenChunkBytes))) {
      openChunk(m_chunks[m_nextChunk++]);
    }
  }

  void openChunk(const Chunk& chunk) {
    if (m_free.empty()) {
      m_free.push_back(m_open.size());
      m_open.push_back(std::make_unique<Open>());
    }
    const std::size_t place = m_free.back();
    Open& open = *m_open[place];
    open.entries.clear();
    open.at = 0;
    const File& file = m_files[chunk.file];
    const McapChunkInfo& info = file.reader.contents().chunks[chunk.index];
    const auto isWanted = [&](std::uint16_t channel) {
      const std::size_t topic = topicOf(file, channel);
      return topic == noTopic || m_topics.isWanted(topic);
    };
    if (auto read = file.reader.readChunk(info, isWanted, open.body); !read) {
      if (m_damage.size() < 100) {
        addLoss(file.reader.contents().name, file.reader.lossOf(info, read.error().message),
                m_damage);
      }
      return;
    }
    takeEntries(file, open);
    if (open.entries.empty()) return;
    m_free.pop_back();
    m_openBytes += open.body.size();
    m_heads.push({open.entries.front().logTime, place});
  }

  void takeEntries(const File& file, Open& open) {
    McapCursor cursor(open.body);
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message) continue;
      const McapMessage& message = cursor.message();
      const std::size_t topic = topicOf(file, message.channel);
      if (topic == noTopic) {
        ++m_unknown;
      } else if (m_topics.isWanted(topic)) {
        open.entries.push_back({message.logTime, topic, message.data});
      } else {
        m_topics.passOver(topic);
      }
    }
    const auto byTime = [](const Entry& a, const Entry& b) { return a.logTime < b.logTime; };
    if (!std::is_sorted(open.entries.begin(), open.entries.end(), byTime)) {
      std::stable_sort(open.entries.begin(), open.entries.end(), byTime);
    }
  }

  std::vector<File> m_files;
  DecodedTopics m_topics;
  std::vector<Chunk> m_chunks;  ///< by their start
  std::size_t m_nextChunk = 0;
  std::vector<std::unique_ptr<Open>> m_open;
  std::vector<std::size_t> m_free;  ///< of m_open
  std::priority_queue<Head> m_heads;
  std::optional<std::size_t> m_finished;
  std::size_t m_openBytes = 0;
  std::uint64_t m_unknown = 0;
  std::vector<std::string> m_damage;
};

}  // namespace

bool isMcapRecording(const std::string&, std::string_view beginning) {
  return beginning.starts_with(std::string_view(mcapMagic.data(), 5));
}

Result<std::unique_ptr<RecordingReader>> openMcapRecording(
    const std::vector<std::string>& files, const std::function<bool(double)>& progress) {
  auto recording = std::make_unique<McapRecording>();
  for (const std::string& file : files) TRY(recording->add(file, progress));
  recording->sortChunks();
  return recording;
}

}  // namespace pitchboard::telemetry

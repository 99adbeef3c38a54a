// SPDX-License-Identifier: GPL-3.0-or-later
// Messages come in the order of time from files of any order, in bounded memory.

#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <optional>
#include <random>

#include <telemetry/mcap/mcap_reader.h>
#include <telemetry/mcap/mcap_writer.h>

#include "time_order.h"

namespace tst_time_order {

using namespace pitchboard::telemetry;

namespace {

struct One {
  std::uint64_t time = 0;
  std::uint16_t channel = 1;
  std::uint32_t sequence = 0;
  bool operator==(const One&) const = default;
};
using Chunks = std::vector<std::vector<One>>;

constexpr std::size_t messageBytes = 40;

/// A file with these chunks.
class File {
 public:
  explicit File(const Chunks& chunks) {
    const std::string path = m_folder.filePath("file.mcap").toStdString();
    auto writer = McapWriter::create(path, {"", "test", 3, false});
    if (!writer) qFatal("no file");
    bool defined = false;
    for (const auto& messages : chunks) {
      McapChunk chunk;
      for (std::uint16_t id = 1; id <= 3 && !defined; ++id) {
        chunk.add(McapChannel{id, 0, "/" + std::to_string(id), "json", {}});
      }
      defined = true;
      for (const One& one : messages) {
        const std::string text(messageBytes, static_cast<char>('a' + one.time % 26));
        chunk.add(McapMessage{one.channel, one.sequence, one.time, one.time, text});
      }
      if (!writer->writeChunk(chunk)) qFatal("not written");
    }
    if (!writer->finish()) qFatal("not finished");
    m_reader.emplace(std::move(*McapReader::open(path)));
  }

  std::vector<One> walked(std::size_t memory, std::uint64_t begin = 0,
                          std::uint64_t end = 1'000'000) {
    std::vector<One> out;
    m_reads = m_most = 0;
    TimeOrder order(
        m_reader->contents().chunks, [this](std::size_t i) { return read(i); }, memory);
    const auto hasMessages = [](const McapChunkInfo& chunk) { return chunk.end != 0; };
    const auto all = [](std::uint16_t) { return true; };
    const bool whole =
        order.walk({begin, end, hasMessages, all},
                   [&](const McapMessage& message) {
                     if (message.data !=
                         std::string(messageBytes, static_cast<char>('a' + message.logTime % 26)))
                       qFatal("other bytes");
                     out.push_back({message.logTime, message.channel, message.sequence});
                     return true;
                   },
                   {});
    if (!whole) qFatal("stopped");
    return out;
  }

  std::size_t reads() const { return m_reads; }
  std::size_t most() const { return m_most; }  ///< chunks in memory at the same time

 private:
  std::shared_ptr<const std::string> read(std::size_t i) {
    auto body = std::make_shared<std::string>();
    if (!m_reader->readChunk(m_reader->contents().chunks[i], *body)) return nullptr;
    ++m_reads;
    std::erase_if(m_alive, [](const auto& one) { return one.expired(); });
    m_alive.push_back(body);
    m_most = std::max(m_most, m_alive.size());
    return body;
  }

  QTemporaryDir m_folder;
  std::optional<McapReader> m_reader;
  std::vector<std::weak_ptr<const std::string>> m_alive;
  std::size_t m_reads = 0, m_most = 0;
};

std::vector<One> sorted(const Chunks& chunks) {
  std::vector<One> out;
  for (const auto& chunk : chunks) out.insert(out.end(), chunk.begin(), chunk.end());
  std::ranges::stable_sort(out, {}, &One::time);
  return out;
}

constexpr std::size_t plenty = 1U << 20;

}  // namespace

class TestTimeOrder : public QObject {
  Q_OBJECT

 private slots:
  void chunksThatOverlapAreMerged() {
    // As a recorder leaves them: each chunk begins a little before the last one ends.
    Chunks chunks;
    for (std::uint64_t i = 0; i < 50; ++i) {
      auto& chunk = chunks.emplace_back();
      for (std::uint64_t j = 0; j < 12; ++j) chunk.push_back({i * 10 + j, 1, 0});
    }
    File file(chunks);
    QVERIFY(file.walked(plenty) == sorted(chunks));
    QCOMPARE(file.reads(), chunks.size());
    QVERIFY2(file.most() <= 3, qPrintable(QString::number(file.most())));
  }

  void topicByTopic() {
    Chunks chunks;
    for (std::uint16_t channel = 1; channel <= 3; ++channel) {
      for (std::uint64_t i = 0; i < 20; ++i) {
        auto& chunk = chunks.emplace_back();
        for (std::uint64_t j = 0; j < 10; ++j) chunk.push_back({i * 10 + j, channel, 0});
      }
    }
    File file(chunks);
    QVERIFY(file.walked(plenty) == sorted(chunks));
    QVERIFY2(file.most() <= 6, qPrintable(QString::number(file.most())));
  }

  void backwardsInTheOrderOfSequences() {
    Chunks chunks(1);
    for (std::uint32_t i = 0; i < 100; ++i) chunks[0].push_back({i / 4U, 1, i});
    const auto forwards = chunks[0];
    std::ranges::reverse(chunks[0]);
    QVERIFY(File(chunks).walked(plenty) == forwards);
  }

  void noOrderAtAllInLittleMemory() {
    std::mt19937 random(4);
    Chunks chunks(40);
    for (auto& chunk : chunks) {
      for (int i = 0; i < 100; ++i) {
        chunk.push_back({random() % 5'000, static_cast<std::uint16_t>(1 + random() % 3), 0});
      }
    }
    File file(chunks);
    const auto expected = sorted(chunks);
    QVERIFY(file.walked(plenty) == expected);
    QCOMPARE(file.reads(), chunks.size());
    // Room for 4 of the 40 chunks.
    constexpr std::size_t chunkBytes = 100 * (31 + messageBytes);
    QVERIFY(file.walked(4 * chunkBytes) == expected);
    QVERIFY(file.reads() > chunks.size());
    QVERIFY2(file.most() <= 7, qPrintable(QString::number(file.most())));
    // Even where not a single chunk fits.
    QVERIFY(file.walked(chunkBytes / 2) == expected);

    std::vector<One> part;
    std::ranges::copy_if(expected, std::back_inserter(part),
                         [](const One& one) { return one.time >= 1'000 && one.time <= 2'000; });
    QVERIFY(file.walked(4 * chunkBytes, 1'000, 2'000) == part);
  }

  void manyMessagesOfOneTime() {
    Chunks chunks(40, std::vector<One>(100, One{7, 1, 0}));
    File file(chunks);
    QVERIFY(file.walked(10'000) == sorted(chunks));
    QCOMPARE(file.reads(), chunks.size());
  }
};

PITCHBOARD_TEST(TestTimeOrder)

}  // namespace tst_time_order

#include "tst_time_order.moc"

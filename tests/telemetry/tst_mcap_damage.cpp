// SPDX-License-Identifier: GPL-3.0-or-later
// One flipped bit, wherever it is, costs at most the chunk that it hits, and what it costs is said:
// of a complete file, of one cut in the middle, and of one cut in front of its end mark.

#include <QtTest>
#include <random>
#include <set>

#include <telemetry/mcap/mcap_cursor.h>
#include <telemetry/mcap/mcap_reader.h>
#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_repair.h>

#include "session_rig.h"

namespace tst_mcap_damage {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

namespace {

constexpr std::size_t recordHead = 9;

struct Record {
  std::uint8_t op = 0;
  std::size_t offset = 0, length = 0;  // with its head
};

/// All records of a whole file, by the lengths in it.
std::vector<Record> recordsOf(const std::string& bytes) {
  std::vector<Record> records;
  for (std::size_t at = mcapMagic.size(); at + recordHead < bytes.size();) {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + at + 1, sizeof length);
    records.push_back({static_cast<std::uint8_t>(bytes[at]), at, recordHead + length});
    at += recordHead + length;
  }
  return records;
}

std::string flipped(std::string bytes, std::size_t bit) {
  bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
  return bytes;
}

}  // namespace

class TestMcapDamage : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  std::string m_bytes;
  std::vector<Record> m_records;
  std::vector<Row> m_rows;
  struct Part {
    std::size_t offset, end;     // of the chunk with its indexes
    std::size_t firstRow, rows;  // in m_rows
    std::size_t messages;        // rows and others
  };
  std::vector<Part> m_parts;

  std::size_t dataEnd() const {
    return std::ranges::find(m_records, std::uint8_t{0x0f}, &Record::op)->offset;
  }
  /// How a file that is cut at `size` can be read.
  std::size_t rowsUntil(std::size_t size) const {
    std::size_t rows = 0;
    for (const Part& part : m_parts) {
      const auto chunk = std::ranges::find(m_records, part.offset, &Record::offset);
      if (chunk->offset + chunk->length <= size) rows += part.rows;
    }
    return rows;
  }

  void expectAtMostOnePartLost(const std::string& bytes, std::size_t bit, std::size_t whole);
  void expectHonestRepair(const std::string& bytes, std::size_t bit);

 private slots:
  void initTestCase();
  void everyBitOfEveryHead_data();
  void everyBitOfEveryHead();
  void anyBit_data() { everyBitOfEveryHead_data(); }
  void anyBit();
  void manyDamagedParts();
  void anIndexIsNoEndAndNoMessage();
  void whatIsLostIsNamedInOrder();
  void looseMessages();
};

void TestMcapDamage::initTestCase() {
  const std::string path = m_folder.filePath("small.mcap").toStdString();
  SessionWriterOptions options;
  options.chunkBytes = 1200;
  auto writer = SessionWriter::create(path, sessionInfo(), options);
  QVERIFY(writer);
  (*writer)->attach("a", "text/plain", "some text");
  m_rows = record(**writer, 24);
  QVERIFY((*writer)->finish());
  m_bytes = bytesOf(path);
  m_records = recordsOf(m_bytes);
  const auto reader = McapReader::open(path);
  QVERIFY(reader && reader->contents().indexed);
  std::size_t row = 0;
  std::string body;
  for (const McapChunkInfo& chunk : reader->contents().chunks) {
    QVERIFY(reader->readChunk(chunk, body));
    Part part{chunk.offset, chunk.offset + chunk.length, row, 0, 0};
    McapCursor cursor(body);
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message) continue;
      ++part.messages;
      if (reader->contents().channels.at(cursor.message().channel).messageEncoding == "cdr")
        ++part.rows;
    }
    row += part.rows;
    for (const Record& record : m_records) {
      if (record.op == 0x07 && record.offset == part.end) part.end += record.length;
    }
    m_parts.push_back(part);
  }
  QCOMPARE(row, m_rows.size());
  QVERIFY(m_parts.size() >= 6);
}

/// `whole`: rows that can be read without the flipped bit.
void TestMcapDamage::expectAtMostOnePartLost(const std::string& bytes, std::size_t bit,
                                             std::size_t whole) {
  const auto where = [&](const char* what) {
    return QStringLiteral("bit %1 of byte %2: %3").arg(bit % 8).arg(bit / 8).arg(what);
  };
  const std::vector<Row> all(m_rows.begin(), m_rows.begin() + static_cast<std::ptrdiff_t>(whole));
  const auto session = SessionReader::openBytes(bytes);
  if (!session) {  // only without its first bytes it is no such file
    QVERIFY2(bit / 8 < mcapMagic.size(), qPrintable(where("cannot be opened")));
    return;
  }
  const std::vector<Row> found = rowsOf(*session, everything);
  (void)session->events();
  for (const auto& attachment : session->file().contents().attachments)
    (void)session->attachment(attachment.name);
  QVERIFY(session->check());
  if (found != all) {
    const auto hit = std::ranges::find_if(m_parts, [&](const Part& part) {
      return bit / 8 >= part.offset && bit / 8 < part.end && part.rows > 0;
    });
    QVERIFY2(hit != m_parts.end(), qPrintable(where("rows are lost without need")));
    std::vector<Row> rest = all;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(hit->firstRow),
               rest.begin() + static_cast<std::ptrdiff_t>(hit->firstRow + hit->rows));
    QVERIFY2(found == rest, qPrintable(where("more is lost than the chunk, or there is more")));
    QVERIFY2(session->isDamaged() && !session->notes().empty(), qPrintable(where("not said")));
    const bool reported = std::ranges::any_of(session->notes(), [](const std::string& note) {
      return note.find(" lost, ") != std::string::npos;
    });
    QVERIFY2(reported, qPrintable(where("no time is said")));
  }
  for (const McapLoss& loss : session->file().contents().losses) {
    QVERIFY2(loss.end == 0 || loss.start <= loss.end, qPrintable(where("backwards")));
    QVERIFY2(loss.bytes > 0 && loss.offset + loss.bytes <= bytes.size() && !loss.reason.empty(),
             qPrintable(where("no place")));
    if (found == all) continue;
    const double from = session->seconds(loss.start), to = session->seconds(loss.end);
    for (std::size_t i = 0, at = 0; i < all.size(); ++i) {
      if (at < found.size() && found[at] == all[i]) {
        ++at;
      } else if (loss.offset / 8 == bit / 64) {
        QVERIFY2(loss.start == 0 || all[i].time > from - 1e-6, qPrintable(where("too late")));
        QVERIFY2(loss.end == 0 || all[i].time < to + 1e-6, qPrintable(where("too early")));
      }
    }
  }
}

void TestMcapDamage::expectHonestRepair(const std::string& bytes, std::size_t bit) {
  const std::string broken = m_folder.filePath("broken.mcap").toStdString();
  const std::string repaired = m_folder.filePath("repaired.mcap").toStdString();
  std::ofstream(broken, std::ios::binary | std::ios::trunc) << bytes;
  QFile::remove(QString::fromStdString(repaired));
  const auto report = repairSession(broken, repaired);
  const QString where = QStringLiteral("bit %1 of byte %2").arg(bit % 8).arg(bit / 8);
  if (bit / 8 < mcapMagic.size()) return;
  QVERIFY2(report, qPrintable(where));
  const auto session = SessionReader::open(repaired);
  QVERIFY2(session && session->complete(), qPrintable(where));
  std::size_t messages = 0;
  for (const Part& part : m_parts) messages += part.messages;
  const bool lost = report->messages < messages;
  QVERIFY2(!lost || !report->complete, qPrintable(where));
  QVERIFY2(report->complete || !report->notes.empty(), qPrintable(where));
  QVERIFY2(!lost || report->lostMessages > 0 || report->lostMore || report->brokeOff,
           qPrintable(where));
}

void TestMcapDamage::everyBitOfEveryHead_data() {
  QTest::addColumn<std::size_t>("size");
  QTest::newRow("complete") << m_bytes.size();
  QTest::newRow("cut in the middle") << m_bytes.size() / 2;
  QTest::newRow("cut in front of the end mark") << dataEnd();
}
void TestMcapDamage::everyBitOfEveryHead() {
  QFETCH(std::size_t, size);
  const std::string bytes = m_bytes.substr(0, size);
  const std::size_t whole = rowsUntil(size);
  std::size_t flips = 0;
  for (const Record& record : m_records) {
    for (std::size_t bit = record.offset * 8; bit < (record.offset + recordHead) * 8; ++bit) {
      if (bit / 8 >= size) break;
      const std::string damaged = flipped(bytes, bit);
      expectAtMostOnePartLost(damaged, bit, whole);
      // Repair writes to the disk: each opcode, and some of the lengths.
      if (bit < record.offset * 8 + 8 || flips % 64 == 0) expectHonestRepair(damaged, bit);
      if (QTest::currentTestFailed()) return;
      ++flips;
    }
  }
  QVERIFY(flips > 1000);
}

void TestMcapDamage::anyBit() {
  QFETCH(std::size_t, size);
  const std::string bytes = m_bytes.substr(0, size);
  const std::size_t whole = rowsUntil(size);
  std::mt19937 random(2023);
  for (int i = 0; i < 2000; ++i) {
    const std::size_t bit = random() % (size * 8);
    const std::string damaged = flipped(bytes, bit);
    expectAtMostOnePartLost(damaged, bit, whole);
    if (i % 64 == 0) expectHonestRepair(damaged, bit);
    if (QTest::currentTestFailed()) return;
  }
}

void TestMcapDamage::manyDamagedParts() {
  const std::string path = m_folder.filePath("long.mcap").toStdString();
  SessionWriterOptions options;
  options.chunkBytes = 1000;
  auto writer = SessionWriter::create(path, sessionInfo(), options);
  QVERIFY(writer);
  const std::vector<Row> rows = record(**writer, 1200);
  QVERIFY((*writer)->finish());
  std::string bytes = bytesOf(path);
  const auto chunks = McapReader::openBytes(bytes)->contents().chunks;
  QVERIFY(chunks.size() > 200);
  // Every other chunk loses its opcode: far more places to search behind than 64.
  std::set<std::uint64_t> kept;
  std::size_t damaged = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (i % 2 == 0) {
      kept.insert(chunks[i].offset);
    } else {
      bytes[chunks[i].offset] = 0x16;
      ++damaged;
    }
  }
  QVERIFY(damaged > 100);
  bytes.resize(bytes.rfind(std::string("\x0f\x04\0\0\0\0\0\0\0", 9)));
  const auto reader = McapReader::openBytes(bytes);
  std::set<std::uint64_t> found;
  for (const McapChunkInfo& chunk : reader->contents().chunks) found.insert(chunk.offset);
  QVERIFY(found == kept);
  std::uint64_t lost = 0;
  std::uint64_t before = 0;
  for (const McapLoss& loss : reader->contents().losses) {
    lost += loss.messages.value_or(0);
    QVERIFY(loss.end == 0 || (loss.start <= loss.end && loss.start >= before));
    if (loss.messages.value_or(0) > 0) before = loss.start;
  }
  const auto all = McapReader::open(path)->contents().statistics.messages;
  QCOMPARE(lost + reader->contents().statistics.messages, all);
}

void TestMcapDamage::anIndexIsNoEndAndNoMessage() {
  const std::string bytes = m_bytes.substr(0, dataEnd());
  for (const Record& record : m_records) {
    if (record.op != 0x07 || record.offset >= bytes.size()) continue;
    for (const char op : {'\x0f', '\x05'}) {
      std::string damaged = bytes;
      damaged[record.offset] = op;
      const auto session = SessionReader::openBytes(damaged);
      QVERIFY(rowsOf(*session, everything) == m_rows);
      QVERIFY(session->file().contents().losses.empty());
      QVERIFY(std::ranges::any_of(session->notes(), [](const std::string& note) {
        return note.find("index of messages is damaged") != std::string::npos;
      }));
    }
  }
}

void TestMcapDamage::whatIsLostIsNamedInOrder() {
  // Behind the damaged chunk stands one that reaches far back, as summaries of a session do.
  const std::string path = m_folder.filePath("order.mcap").toStdString();
  const auto chunkOf = [](std::initializer_list<std::uint64_t> times) {
    McapChunk chunk;
    chunk.add(McapChannel{1, 0, "/events", "json", {}});
    for (const std::uint64_t time : times) {
      chunk.add(McapMessage{1, 0, time * 1'000'000'000, time * 1'000'000'000,
                            R"({"time":1,"kind":"goal"})"});
    }
    return chunk;
  };
  auto writer = McapWriter::create(path);
  QVERIFY(writer.has_value());
  QVERIFY(writer->writeChunk(chunkOf({10, 14})));
  QVERIFY(writer->writeChunk(chunkOf({15, 19})));
  QVERIFY(writer->writeChunk(chunkOf({11, 19})));
  QVERIFY(writer->finish());
  std::string bytes = bytesOf(path);
  std::vector<McapChunkInfo> chunks = McapReader::openBytes(bytes)->contents().chunks;
  std::erase_if(chunks, [](const McapChunkInfo& chunk) { return chunk.end == 0; });
  QCOMPARE(chunks.size(), 3U);
  // Head and indexes of the middle one are gone, so that only its neighbours tell its time.
  const auto from = static_cast<std::ptrdiff_t>(chunks[1].offset);
  const auto to = static_cast<std::ptrdiff_t>(chunks[2].offset);
  std::fill(bytes.begin() + from, bytes.begin() + to, '\xff');
  bytes.resize(bytes.rfind(std::string("\x0f\x04\0\0\0\0\0\0\0", 9)));
  const auto session = SessionReader::openBytes(bytes);
  QCOMPARE(session->file().contents().losses.size(), 1U);
  QCOMPARE(session->file().contents().losses[0].start, 11'000'000'000U);
  QCOMPARE(session->file().contents().losses[0].end, 14'000'000'000U);
  const bool reported = std::ranges::any_of(session->notes(), [](const std::string& note) {
    return note.find("lost, between 1.000 s and 4.000 s.") != std::string::npos;
  });
  QVERIFY2(reported, session->notes().front().c_str());
}

void TestMcapDamage::looseMessages() {
  // Other writers may leave messages without chunks in the file.
  const auto number = [](auto value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto recordOf = [&](char op, const std::string& content) {
    return op + number(std::uint64_t{content.size()}) + content;
  };
  std::string bytes(mcapMagic.data(), mcapMagic.size());
  bytes += recordOf('\x01', std::string(8, '\0'));
  const auto channel =
      recordOf('\x04', std::string("\x01\0\0\0", 4) + std::string("\x07\0\0\0/events", 11) +
                           std::string("\x04\0\0\0json", 8) + std::string(4, '\0'));
  bytes += channel;
  std::vector<std::size_t> messages;
  for (std::uint64_t i = 0; i < 8; ++i) {
    messages.push_back(bytes.size());
    bytes +=
        recordOf('\x05', number(std::uint16_t{1}) + number(std::uint32_t{0}) + number(1000 + i) +
                             number(1000 + i) + R"({"time":1,"kind":"goal","text":")" +
                             std::string(i, 'x') + "\"}");
  }
  for (const bool ended : {true, false}) {
    if (ended) bytes += recordOf('\x0f', std::string(4, '\0'));
    for (const std::size_t message : messages) {
      for (std::size_t bit = message * 8; bit < (message + recordHead) * 8; ++bit) {
        const auto session = SessionReader::openBytes(flipped(bytes, bit));
        QVERIFY(session);
        // The message in front is known by what follows it.
        QVERIFY2(session->events().size() >= 6, qPrintable(QString::number(bit)));
        QVERIFY(session->isDamaged());
      }
    }
    if (ended) bytes.resize(bytes.size() - recordHead - 4);
  }
}

PITCHBOARD_TEST(TestMcapDamage)

}  // namespace tst_mcap_damage

#include "tst_mcap_damage.moc"

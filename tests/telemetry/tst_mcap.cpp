// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged and hostile files: cut at every byte, every byte flipped, lengths that lie.

#include <QtTest>
#include <fstream>
#include <random>

#include <telemetry/mcap/mcap_cursor.h>
#include <telemetry/mcap/mcap_reader.h>
#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_repair.h>

#include "session_rig.h"

namespace tst_mcap {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

namespace {

/// Everything that can be read, in order; used to see that nothing invented comes out.
struct Contents {
  std::vector<Row> rows;
  bool complete = false;
  std::size_t notes = 0;
};

Contents contentsOf(const std::string& bytes) {
  Contents out;
  const auto reader = SessionReader::openBytes(bytes);
  if (!reader) return out;
  out.rows = rowsOf(*reader, everything);
  (void)reader->events();
  std::vector<SessionRow> now;
  reader->rowsAt(1.0, now);
  for (const auto& attachment : reader->file().contents().attachments)
    (void)reader->attachment(attachment.name);
  out.complete = reader->complete();
  out.notes = reader->notes().size();
  return out;
}

std::string number64(std::uint64_t value) {
  return {reinterpret_cast<const char*>(&value), 8};
}

}  // namespace

class TestMcap : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  std::string m_bytes;  // a small whole session
  std::vector<Row> m_rows;
  std::vector<std::uint64_t> m_chunkEnds;  // offsets behind the chunks
  std::vector<std::size_t> m_rowsUntil;    // rows in the chunks up to there

 private slots:
  void initTestCase() {
    const std::string path = m_folder.filePath("small.mcap").toStdString();
    SessionWriterOptions options;
    options.chunkBytes = 1200;
    auto writer = SessionWriter::create(path, sessionInfo(), options);
    QVERIFY(writer);
    (*writer)->attach("a", "text/plain", "some text");
    m_rows = record(**writer, 40);
    QVERIFY((*writer)->finish());
    m_bytes = bytesOf(path);
    const auto reader = McapReader::open(path);
    QVERIFY(reader && reader->contents().indexed);
    std::size_t rows = 0;
    std::string body;
    for (const McapChunkInfo& chunk : reader->contents().chunks) {
      QVERIFY(reader->readChunk(chunk, body));
      McapCursor cursor(body);
      for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
        if (kind == McapCursor::Kind::Message &&
            reader->contents().channels.at(cursor.message().channel).messageEncoding == "cdr") {
          ++rows;
        }
      }
      m_chunkEnds.push_back(chunk.offset + chunk.length);
      m_rowsUntil.push_back(rows);
    }
    QCOMPARE(rows, m_rows.size());
    QVERIFY(m_chunkEnds.size() >= 4);
  }

  void walkAndIndexAgree() {
    McapReaderOptions walk;
    walk.ignoreSummary = true;
    const auto walked = McapReader::openBytes(m_bytes, walk);
    const auto indexed = McapReader::openBytes(m_bytes);
    QVERIFY(!walked->contents().indexed && indexed->contents().indexed);
    QVERIFY(walked->contents().problems.empty());
    QVERIFY(walked->contents().schemas == indexed->contents().schemas);
    QVERIFY(walked->contents().channels == indexed->contents().channels);
    QCOMPARE(walked->contents().chunks.size(), indexed->contents().chunks.size());
    for (std::size_t i = 0; i < walked->contents().chunks.size(); ++i) {
      const McapChunkInfo &a = walked->contents().chunks[i], &b = indexed->contents().chunks[i];
      QCOMPARE(a.offset, b.offset);
      QCOMPARE(a.length, b.length);
      QCOMPARE(a.start, b.start);
      QCOMPARE(a.end, b.end);
      QCOMPARE(a.compressedSize, b.compressedSize);
      QVERIFY(a.channels == b.channels);
    }
    QCOMPARE(walked->contents().statistics.messages, indexed->contents().statistics.messages);
    QVERIFY(walked->contents().statistics.perChannel == indexed->contents().statistics.perChannel);
    QCOMPARE(walked->contents().statistics.start, indexed->contents().statistics.start);
    QCOMPARE(walked->contents().attachments.size(), 1U);
    QCOMPARE(walked->contents().metadata.size(), 1U);
  }

  void cutAtEveryByte() {
    for (std::size_t size = 0; size < m_bytes.size(); ++size) {
      const Contents found = contentsOf(m_bytes.substr(0, size));
      std::size_t expected = 0;
      for (std::size_t i = 0; i < m_chunkEnds.size(); ++i) {
        if (m_chunkEnds[i] <= size) expected = m_rowsUntil[i];
      }
      if (found.rows.size() != expected || found.complete ||
          !std::equal(found.rows.begin(), found.rows.end(), m_rows.begin())) {
        QFAIL(qPrintable(QStringLiteral("cut at %1: %2 rows instead of %3")
                             .arg(size)
                             .arg(found.rows.size())
                             .arg(expected)));
      }
    }
  }

  void everyByteFlipped() {
    std::size_t reported = 0;
    for (std::size_t at = 0; at < m_bytes.size(); ++at) {
      std::string bytes = m_bytes;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
      const Contents found = contentsOf(bytes);
      // Rows may be missing, but what is there was recorded.
      auto place = m_rows.begin();
      for (const Row& row : found.rows) {
        place = std::find(place, m_rows.end(), row);
        if (place == m_rows.end()) {
          QFAIL(qPrintable(QStringLiteral("byte %1 flipped: a row that nobody wrote").arg(at)));
        }
        ++place;
      }
      if (found.rows.size() < m_rows.size() && found.notes == 0 && at > 8) {
        const auto reader = SessionReader::openBytes(bytes);
        QVERIFY2(!reader, qPrintable(QStringLiteral("byte %1: silently lost rows").arg(at)));
      }
      reported += found.notes > 0;
    }
    QVERIFY(reported > m_bytes.size() / 2);
  }

  void anyDamagedChunkCostsThatChunk_data() {
    QTest::addColumn<bool>("brokenOff");
    QTest::addColumn<bool>("lengthToo");
    QTest::newRow("indexed") << false << false;
    QTest::newRow("indexed, and its length leads nowhere") << false << true;
    QTest::newRow("broken off") << true << false;
    QTest::newRow("broken off, and its length leads nowhere") << true << true;
  }
  void anyDamagedChunkCostsThatChunk() {
    QFETCH(bool, brokenOff);
    QFETCH(bool, lengthToo);
    const auto whole = McapReader::openBytes(m_bytes);
    for (std::size_t i = 0; i < m_chunkEnds.size(); ++i) {
      const std::uint64_t offset = whole->contents().chunks[i].offset;
      std::string bytes = m_bytes;
      bytes[m_chunkEnds[i] - 20] ^= 0x10;
      if (lengthToo) bytes.replace(offset + 1, 8, number64(0x7fffffffffffffffULL));
      // The indexes of the last chunk's messages stay.
      if (brokenOff) bytes.resize(bytes.rfind("\x0f" + number64(4)));
      const std::size_t before = i == 0 ? 0 : m_rowsUntil[i - 1];
      std::vector<Row> rest = m_rows;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(before),
                 rest.begin() + static_cast<std::ptrdiff_t>(m_rowsUntil[i]));
      const auto where = QStringLiteral("chunk %1 of %2").arg(i).arg(m_chunkEnds.size());
      QVERIFY2(contentsOf(bytes).rows == rest, qPrintable(where));

      const auto reader = SessionReader::openBytes(bytes);
      QVERIFY(reader->check());
      QVERIFY2(!reader->notes().empty(), qPrintable(where));
      // Behind the last chunk nothing tells damage from the end of the recording.
      const bool lastLost = brokenOff && lengthToo && i + 1 == m_chunkEnds.size();
      QVERIFY2(reader->isDamaged() || lastLost, qPrintable(where));

      const std::string broken = m_folder.filePath("broken.mcap").toStdString();
      const std::string repaired = m_folder.filePath("repaired.mcap").toStdString();
      std::ofstream(broken, std::ios::binary | std::ios::trunc) << bytes;
      QFile::remove(QString::fromStdString(repaired));
      const auto report = repairSession(broken, repaired);
      QVERIFY2(report, report ? "" : report.error().text().c_str());
      QVERIFY2(rowsOf(*SessionReader::open(repaired), everything) == rest, qPrintable(where));
      QVERIFY(!report->notes.empty());
      const std::uint64_t lost = whole->contents().statistics.messages - report->messages;
      if (!brokenOff || !lengthToo) {
        QCOMPARE(report->lostMessages, lost);
        QVERIFY(!report->lostMore);
      } else if (lost > 0 && !lastLost) {
        QVERIFY2(report->lostMore, qPrintable(where));
      }
      if (report->lostMessages > 0) {
        QVERIFY(report->summary().find("; " + std::to_string(lost)) != std::string::npos);
        QVERIFY2(report->notes.back().find(" lost, between ") != std::string::npos,
                 report->notes.back().c_str());
      }
    }
  }

  void definitionsAreRepeated() {
    McapReaderOptions walk;
    walk.ignoreSummary = true;
    const auto reader = McapReader::openBytes(m_bytes, walk);
    std::map<std::uint16_t, int> times;
    std::string body;
    for (const McapChunkInfo& chunk : reader->contents().chunks) {
      QVERIFY(reader->readChunk(chunk, body));
      McapCursor cursor(body);
      for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
        if (kind == McapCursor::Kind::Channel) ++times[cursor.channel().id];
      }
    }
    QCOMPARE(times.size(), reader->contents().channels.size());
    for (const auto& [id, count] : times) QVERIFY2(count >= 2, qPrintable(QString::number(id)));
  }

  void repairIsNoTargetForItself() {
    const std::string path = m_folder.filePath("precious.mcap").toStdString();
    std::ofstream(path, std::ios::binary) << m_bytes;
    const auto refused = repairSession(path, m_folder.filePath("./precious.mcap").toStdString());
    QVERIFY(!refused && refused.error().message.find("being read") != std::string::npos);
    QVERIFY(bytesOf(path) == m_bytes);
  }

  void lengthsThatLie_data() {
    QTest::addColumn<QByteArray>("bytes");
    const std::string magic(mcapMagic.data(), 8);
    const auto row = [&](const char* name, const std::string& bytes) {
      QTest::newRow(name) << QByteArray::fromStdString(magic + bytes);
    };
    row("nothing", "");
    row("header without end", "\x01" + number64(~0ULL));
    row("header of 4 GB",
        std::string("\x01") + number64(8) + std::string("\xff\xff\xff\xff....", 8));
    std::string chunk = number64(1) + number64(2) + number64(100ULL << 20) + std::string(4, '\0') +
                        std::string("\x04\0\0\0zstd", 8) + number64(3) + "abc";
    row("chunk that says 100 MB", "\x06" + number64(chunk.size()) + chunk);
    chunk = number64(1) + number64(2) + number64(~0ULL) + std::string(4, '\0') +
            std::string(4, '\0') + number64(~0ULL);
    row("chunk longer than the file", "\x06" + number64(chunk.size()) + chunk);
    std::string many;
    for (int i = 0; i < 20'000; ++i)
      many += "\x06" + number64(60) + std::string(28, 'x') + std::string("\x04\0\0\0zstd", 8) +
              number64(~0ULL) + std::string(16, 'y');
    row("many marks of chunks", "\x00" + many);
    row("a megabyte of zeros", std::string(1 << 20, '\0'));
    std::string empty;
    for (int i = 0; i < 100'000; ++i) empty += "\x85" + number64(0);
    row("many unknown records", empty);
    std::string footer =
        "\x02" + number64(20) + number64(8) + number64(~0ULL) + std::string(4, '\0') + magic;
    row("summary from the beginning", footer);
    footer =
        "\x02" + number64(20) + number64(~0ULL) + number64(~0ULL) + std::string(4, '\0') + magic;
    row("summary behind the end", footer);
  }
  void lengthsThatLie() {
    QFETCH(QByteArray, bytes);
    const Contents found = contentsOf(bytes.toStdString());
    QVERIFY(found.rows.empty());
  }

  void randomBytes() {
    std::mt19937 random(7);
    for (int i = 0; i < 300; ++i) {
      std::string bytes = m_bytes;
      for (int k = 0; k < 20; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      if (i % 3 == 0) bytes.resize(random() % bytes.size());
      (void)contentsOf(bytes);
    }
  }

  void messagesWithoutChunks() {
    // Other writers may leave messages loose in the file.
    std::string bytes(mcapMagic.data(), 8);
    bytes += "\x01" + number64(8) + std::string(8, '\0');
    const std::string channel = std::string("\x01\0\0\0", 4) +
                                std::string("\x07\0\0\0/events", 11) +
                                std::string("\x04\0\0\0json", 8) + std::string(4, '\0');
    bytes += "\x04" + number64(channel.size()) + channel;
    for (int i = 0; i < 3; ++i) {
      const std::string json = R"({"time":1,"kind":"goal"})";
      bytes += "\x05" + number64(22 + json.size()) + std::string("\x01\0\0\0\0\0", 6) +
               number64(1000 + static_cast<std::uint64_t>(i)) + number64(1000) + json;
    }
    const auto reader = SessionReader::openBytes(bytes);
    QVERIFY(reader);
    QCOMPARE(reader->events().size(), 3U);
  }

  void stopsWhenAsked() {
    McapReaderOptions options;
    options.ignoreSummary = true;
    options.progress = [](double) { return false; };
    QVERIFY(!McapReader::openBytes(m_bytes, options));
  }
};

PITCHBOARD_TEST(TestMcap)

}  // namespace tst_mcap

#include "tst_mcap.moc"

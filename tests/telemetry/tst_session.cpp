// SPDX-License-Identifier: GPL-3.0-or-later
// What is recorded is read back bit for bit; what goes wrong is said and never costs what stands.

#include <QtTest>
#include <filesystem>

#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_export.h>
#include <telemetry/session/session_repair.h>

#include "session_rig.h"

namespace tst_session {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

class TestSession : public QObject, private NewSessions {
  Q_OBJECT

 private slots:
  void aGroupThatIsRenamedIsOneGroup() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
    QVERIFY(writer);
    record(**writer, 120);
    const GroupId renamed = (*writer)->renameGroup("B1", robotGroup("R1", 1));
    for (int tick = 120; tick < 240; ++tick) {
      Row row = rowOf(0, tick);
      row.group = renamed;
      append(**writer, row);
    }
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    QVERIFY(reader);
    QCOMPARE(reader->groups().size(), 3U);
    QCOMPARE(reader->groups()[0].info.name, std::string("R1"));
    QCOMPARE(reader->groups()[0].rows, 240U);
    int tick = 0;
    for (const Row& row : rowsOf(*reader, everything)) {
      if (row.group == 0) QVERIFY(row == rowOf(0, tick++));
    }
    QCOMPARE(tick, 240);
  }

  void everythingComesBack() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
    QVERIFY(writer);
    (*writer)->attach("scenario.json", "application/json", "{\"a\":1}");
    const auto rows = record(**writer, 300);
    const SessionDatagram text{1.25, {{0x7f000001}, 4711}, 1241, "RBT 1|x\xff\0y"};
    const SessionDatagram utf8{1.5, {{0xc0a80007}, 9}, 1242, "schön\n\""};
    (*writer)->append(SessionStream::Telemetry, text);
    (*writer)->append(SessionStream::Telemetry, utf8);
    (*writer)->append(
        pitchboard::LogLine{2.0, "B1/decision", "said \"ouch\"", pitchboard::LogLevel::Warning});
    (*writer)->appendJson(SessionStream::Checkpoints, 0.1, R"({"time":0.1})");
    QVERIFY((*writer)->finish());
    const SessionStatus status = (*writer)->status();
    QCOMPARE(status.rows, rows.size());
    QCOMPARE(status.dropped, 0U);
    QVERIFY(!status.recording && status.problem.empty());
    QCOMPARE(status.bytes, std::filesystem::file_size(path));

    const auto reader = SessionReader::open(path);
    QVERIFY(reader);
    QVERIFY(reader->complete() && reader->ours());
    QVERIFY2(reader->notes().empty(), reader->notes().empty() ? "" : reader->notes()[0].c_str());
    QVERIFY(reader->info() == sessionInfo());
    QCOMPARE(reader->groups().size(), 3U);
    QVERIFY(reader->groups()[0].info == robotGroup("B1", 1));
    QVERIFY(reader->groups()[1].info == robotGroup("B2", 2));
    QVERIFY(reader->groups()[2].info == matchGroup());
    QCOMPARE(reader->groups()[2].rows, 300U);
    QVERIFY(rowsOf(*reader, everything) == rows);
    QCOMPARE(reader->events().size(), 5U);
    QCOMPARE(reader->events()[0], (SessionEvent{0.5, "kick", "B1", "kick 30"}));
    QCOMPARE(reader->range()->begin, 0.0);
    QVERIFY(std::abs(reader->range()->end - 299 / 60.0) < 1e-9);
    QCOMPARE(reader->attachment("scenario.json").value(), std::string("{\"a\":1}"));
    QVERIFY(!reader->attachment("other"));
    QCOMPARE(reader->count(SessionStream::Telemetry), 2U);
    QCOMPARE(reader->count(SessionStream::Checkpoints), 1U);
    QCOMPARE(reader->count(SessionStream::Referee), 0U);
    int seen = 0;
    reader->messages(SessionStream::Telemetry, everything, [&](double time, std::string_view json) {
      const SessionDatagram& expected = seen++ == 0 ? text : utf8;
      // Bytes that are not text come back too.
      if (time != expected.time || datagramOf(json) != expected) qFatal("another datagram");
      return true;
    });
    QCOMPARE(seen, 2);
    reader->messages(SessionStream::Checkpoints, everything,
                     [&](double time, std::string_view json) {
                       seen += time == 0.1 && json == R"({"time":0.1})";
                       return true;
                     });
    reader->messages(SessionStream::Log, everything, [&](double, std::string_view json) {
      seen += sessionLogLine(json) == pitchboard::LogLine{2.0, "B1/decision", "said \"ouch\"",
                                                          pitchboard::LogLevel::Warning};
      return true;
    });
    QCOMPARE(seen, 4);
  }

  void momentsAndRanges() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
    const auto rows = record(**writer, 600);
    // A robot that joins late and one that has no row at all.
    const GroupId late = (*writer)->addGroup(robotGroup("B3", 3));
    (*writer)->addGroup(robotGroup("B4", 4));
    Row joined = rowOf(0, 599);
    joined.group = late;
    append(**writer, joined);
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    QVERIFY(reader->file().contents().chunks.size() > 10);
    std::vector<SessionRow> now;
    for (const int tick : {0, 1, 59, 60, 299, 598, 599}) {
      reader->rowsAt(tick / 60.0, now);
      QCOMPARE(now.size(), 5U);
      for (const GroupId group : {0U, 1U, 2U}) {
        QVERIFY(now[group].present);
        QVERIFY((Row{group, now[group].time, now[group].words, now[group].values}) ==
                rowOf(group, tick));
      }
      QCOMPARE(now[3].present, tick == 599);
      QVERIFY(!now[4].present);
    }
    reader->rowsAt(-0.001, now);
    QVERIFY(!now[0].present);
    reader->rowsAt(30.5 / 60.0, now);
    QCOMPARE(now[0].time, 0.5);
    reader->rowsAt(1e6, now);
    QCOMPARE(now[1].time, 599 / 60.0);

    const auto part = rowsOf(*reader, {100 / 60.0, 102 / 60.0});
    QVERIFY(part == std::vector<Row>(rows.begin() + 300, rows.begin() + 309));
    int count = 0;
    const std::vector<GroupId> only{1};
    reader->rows(everything, only,
                 [&](GroupId group, const RowView&) { return group == 1 && ++count < 10; });
    QCOMPARE(count, 10);
  }

  void sourcePutBack() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo());
    const GroupId group = (*writer)->addGroup(matchGroup());
    const std::vector<double> values{1.0, 2.0};
    for (const double time : {0.0, 1.0, 2.0, 0.5, 0.75})
      (*writer)->append(group, {time, {}, values});
    (*writer)->append(group, {0.74, {}, values});  // disorder, not a new pass
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    const auto rows = rowsOf(*reader, everything);
    QCOMPARE(rows.size(), 6U);
    QCOMPARE(rows[2].time, 2.0);
    QVERIFY(rows[3].time > 2.0 && rows[3].time < 2.01);
    QVERIFY(std::abs(rows[4].time - rows[3].time - 0.25) < 1e-8);
    QVERIFY(rows[5].time >= rows[4].time - 1e-8);
    QVERIFY(reader->range()->end > 2.2);
  }

  void columnsThatComeLater() {
    QTemporaryDir folder;
    const std::string path = (folder.path() + "/wide.mcap").toStdString();
    const auto column = [](const char* name) {
      ColumnInfo made;
      made.name = name;
      return made;
    };
    GroupInfo narrow{"Robot 3", {column("X"), column("Y")}, {{"live", "1"}, {"number", "3"}}};
    GroupInfo wide = narrow;
    wide.columns.push_back(column("TEMPERATURE"));
    {
      auto writer = SessionWriter::create(path, rig::sessionInfo());
      QVERIFY(writer);
      const GroupId before = (*writer)->addGroup(narrow);
      for (int i = 0; i < 5; ++i) {
        const std::vector<double> values{1.0 * i, 2.0};
        (*writer)->append(before, {1.0 * i, {}, values});
      }
      const GroupId after = (*writer)->addGroup(wide);
      for (int i = 5; i < 8; ++i) {
        const std::vector<double> values{1.0 * i, 2.0, 36.5};
        (*writer)->append(after, {1.0 * i, {}, values});
      }
      QVERIFY((*writer)->finish());
    }
    const auto session = SessionReader::open(path);
    QVERIFY(session);
    QCOMPARE(session->groups().size(), std::size_t{1});
    QCOMPARE(session->groups()[0].info.columns.size(), std::size_t{3});
    QCOMPARE(session->groups()[0].rows, std::uint64_t{8});
    int rows = 0;
    session->rows({-1.0, 100.0}, {}, [&rows](GroupId group, const RowView& row) {
      const bool hole = std::isnan(row.values[2]);
      const bool good = group == 0 && row.values.size() == 3 && row.values[0] == 1.0 * rows &&
                        hole == (rows < 5) && (hole || row.values[2] == 36.5);
      ++rows;
      return good;
    });
    QCOMPARE(rows, 8);
    std::vector<SessionRow> at;
    session->rowsAt(3.0, at);
    QVERIFY(at[0].present && at[0].values.size() == 3 && std::isnan(at[0].values[2]));
    session->rowsAt(7.0, at);
    QCOMPARE(at[0].values[2], 36.5);
  }

  void fieldNamesAreThoseOfRos() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo());
    GroupInfo group{"Röbot 1", {}, {}};
    for (const char* name : {"VISION__X", "vision_x", "9lives", "Ä", "SOURCE_TIME", "a_", "A"}) {
      group.columns.push_back({name, ColumnType::Float64, "", "", ColumnKind::Number, {}});
    }
    (*writer)->addGroup(group);
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    const std::string text = reader->file().contents().schemas.begin()->second.data;
    for (const char* field :
         {"float64 source_time ", "float64 vision_x ", "float64 vision_x_2 ", "float64 v9lives ",
          "float64 v ", "float64 source_time_2 ", "float64 a ", "float64 a_2 "}) {
      QVERIFY2(text.find(field) != std::string::npos, field);
    }
    QVERIFY(reader->groups()[0].info == group);
  }

  void neverOverwrites() {
    const std::string path = newPath();
    std::ofstream(path) << "precious";
    const auto writer = SessionWriter::create(path, {});
    QVERIFY(!writer);
    QVERIFY(writer.error().code == ErrorCode::Conflict);
    QCOMPARE(bytesOf(path), std::string("precious"));
    const auto nowhere = SessionWriter::create("/no/such/folder/x.mcap", {});
    QVERIFY(!nowhere && nowhere.error().message.find("folder") != std::string::npos);
    const auto kernel = SessionWriter::create("/proc/x.mcap", {});
    QVERIFY(!kernel);
  }

  void newerVersionsAndOtherPrograms() {
    const std::string path = newPath();
    {
      auto file = McapWriter::create(path);
      // The check is a CRC-32 over keys and values, each with its final zero
      // (docs/file-formats.md).
      QVERIFY(file->metadata(
          "pitchboard",
          {{"format", "9"}, {"start_ns", "5000000000"}, {"new", "x"}, {"check", "3914321931"}}));
      McapChunk chunk;
      chunk.add(McapSchema{1, "other/msg/Thing", "ros2msg", "int8 a"});
      chunk.add(McapChannel{1, 1, "/other", "cdr", {}});
      chunk.add(McapChannel{2, 0, "/events", "json", {}});
      chunk.add(McapChannel{3, 0, "/robots/B1/row", "cdr", {{"pitchboard.group", "{\"name\":1}"}}});
      chunk.add(McapMessage{1, 0, 6'000'000'000, 6'000'000'000, "abc"});
      chunk.add(McapMessage{2, 0, 6'000'000'000, 6'000'000'000,
                            R"({"time":1,"kind":"goal","later":[]})"});
      chunk.add(McapMessage{2, 1, 6'000'000'000, 6'000'000'000, "[not an event"});
      QVERIFY(file->writeChunk(chunk));
      QVERIFY(file->finish());
    }
    const auto reader = SessionReader::open(path);
    QVERIFY(reader);
    QCOMPARE(reader->notes().size(), 3U);
    QVERIFY(reader->notes()[0].find("newer version (format 9") != std::string::npos);
    QVERIFY(reader->notes()[1].find("/other") != std::string::npos);
    QCOMPARE(reader->events().size(), 1U);
    QCOMPARE(reader->events()[0].kind, std::string("goal"));
    QCOMPARE(reader->range()->begin, 1.0);
  }

  void messagesOfAnUndeclaredChannel() {
    const std::string whole = newPath(), path = newPath();
    auto writer = SessionWriter::create(whole, sessionInfo(), smallChunks());
    (void)record(**writer, 20);
    QVERIFY((*writer)->finish());
    const auto known = McapReader::open(whole);
    {
      auto file = McapWriter::create(path);
      McapChunk chunk;
      for (const auto& [id, schema] : known->contents().schemas) chunk.add(schema);
      for (const auto& [id, channel] : known->contents().channels) chunk.add(channel);
      chunk.add(McapMessage{60'000, 0, 6'000'000'000, 6'000'000'000, "abc"});
      QVERIFY(file->writeChunk(chunk) && file->finish());
    }
    const auto reader = SessionReader::open(path);
    QVERIFY(reader && !reader->groups().empty());
    std::vector<SessionRow> rows;
    reader->rowsAt(1e9, rows);
    QVERIFY(std::ranges::none_of(rows, &SessionRow::present));
  }

  void notOurs() {
    const auto text = SessionReader::openBytes("this is no container at all");
    QVERIFY(!text && text.error().code == ErrorCode::ParseError);
    const auto later = SessionReader::openBytes(std::string("\x89MCAP1\r\n......"));
    QVERIFY(!later && later.error().code == ErrorCode::Unsupported);
    QVERIFY(SessionReader::open("/no/such/file").error().code == ErrorCode::NotFound);
    QVERIFY(!SessionReader::open("/dev/zero"));
    const std::string path = newPath();
    {
      auto file = McapWriter::create(path, {"ros2", "somebody", 3, false});
      McapChunk chunk;
      chunk.add(McapChannel{1, 0, "/tf", "cdr", {}});
      chunk.add(McapMessage{1, 0, 77, 77, "abc"});
      QVERIFY(file->writeChunk(chunk) && file->finish());
    }
    const auto foreign = SessionReader::open(path);
    QVERIFY(foreign && !foreign->ours());
    QVERIFY(foreign->notes().back().find("somebody") != std::string::npos);
    QVERIFY(foreign->groups().empty());
  }

  /// What nobody here knows goes into clips and repaired files as it is.
  void channelsOfOthersAreCopied() {
    const std::string path = newPath();
    auto file = McapWriter::create(path, {"", "somebody", 3, false});
    McapChunk chunk;
    chunk.add(McapSchema{9, "theirs/Thing", "protobuf", std::string("\x01\0\x02", 3)});
    chunk.add(McapChannel{7, 9, "/theirs", "protobuf", {{"a", "b"}}});
    chunk.add(McapChannel{300, 0, "/raw", "bytes", {}});
    for (std::uint32_t i = 0; i < 10; ++i) {
      chunk.add(McapMessage{7, 40 + i, 1'000'000'000ULL * i, 77, "abc"});
      chunk.add(McapMessage{300, i, 1'000'000'000ULL * i + 1, 0, std::string_view("\0x", 2)});
    }
    QVERIFY(file->writeChunk(chunk) && file->finish());
    const std::string repaired = newPath(), clip = newPath();
    const auto report = repairSession(path, repaired);
    QVERIFY2(report, report ? "" : report.error().text().c_str());
    QCOMPARE(report->messages, std::uint64_t{20});
    const auto session = SessionReader::open(path);
    ExportSelection part;
    part.range = {2.0, 5.0};
    QVERIFY(exportFile(*session, ExportFormat::Mcap, part, clip));
    for (const auto& [made, first, count] :
         {std::tuple{repaired, 0U, 20U}, std::tuple{clip, 2U, 7U}}) {
      const auto copy = SessionReader::open(made);
      QVERIFY(copy->complete());
      std::uint32_t messages = 0, number = first;
      copy->walkFile({-1e18, 1e18}, [&](const McapMessage& message) {
        ++messages;
        const McapChannel& channel = copy->file().contents().channels.at(message.channel);
        const bool theirs = channel.topic == "/theirs";
        if (!theirs) return channel.topic == "/raw" && message.data == std::string_view("\0x", 2);
        const McapSchema& schema = copy->file().contents().schemas.at(channel.schema);
        return channel.metadata.at("a") == "b" && schema.data.size() == 3 &&
               message.sequence == 40 + number && message.publishTime == 77 &&
               message.logTime == 1'000'000'000ULL * number++;
      });
      QCOMPARE(messages, count);
    }
  }

  void repairMakesAWholeFile() {
    const std::string path = newPath(), repaired = newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
    (*writer)->attach("a.txt", "text/plain", "hello");
    const auto rows = record(**writer, 600);
    QVERIFY((*writer)->finish());
    const std::string whole = bytesOf(path);
    std::ofstream(path, std::ios::binary | std::ios::trunc) << whole.substr(0, whole.size() / 2);
    std::vector<double> parts;
    const auto report = repairSession(path, repaired, [&](double part) {
      parts.push_back(part);
      return true;
    });
    QVERIFY2(report, report ? "" : report.error().text().c_str());
    QVERIFY(std::is_sorted(parts.begin(), parts.end()) && parts.size() > 5);
    QCOMPARE(report->notes.size(), 1U);
    const auto reader = SessionReader::open(repaired);
    QVERIFY(reader->complete() && reader->notes().empty());
    QCOMPARE(reader->attachment("a.txt").value(), std::string("hello"));
    QVERIFY(reader->info() == sessionInfo());
    const auto found = rowsOf(*reader, everything);
    QVERIFY(found.size() > 500);
    QVERIFY(std::equal(found.begin(), found.end(), rows.begin()));
    QCOMPARE(report->messages, found.size() + reader->events().size());
    // Nothing is overwritten, and what is stopped leaves nothing behind.
    QVERIFY(repairSession(path, repaired).error().code == ErrorCode::Conflict);
    QVERIFY(SessionReader::open(repaired)->complete());
    const std::string stoppedPath = newPath();
    QVERIFY(!repairSession(path, stoppedPath, [](double part) { return part < 0.6; }));
    QVERIFY(!std::filesystem::exists(stoppedPath));
  }

 private:
  static SessionDatagram datagramOf(std::string_view json);
};

SessionDatagram TestSession::datagramOf(std::string_view json) {
  const auto found = sessionDatagram(json);
  return found ? *found : SessionDatagram{};
}

PITCHBOARD_TEST(TestSession)

}  // namespace tst_session

#include "tst_session.moc"

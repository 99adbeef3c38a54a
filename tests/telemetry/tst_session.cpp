// SPDX-License-Identifier: GPL-3.0-or-later
// What is recorded is read back bit for bit; what goes wrong is said and never costs what stands.

#include <QtTest>
#include <filesystem>

#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_export.h>
#include <telemetry/session/session_repair.h>

#include "../support/group_facts.h"
#include "session_rig.h"

namespace tst_session {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

class TestSession : public QObject, private NewSessions {
  Q_OBJECT

 private slots:
  /// Two robots whose colours a referee corrects, and corrects back.
  void groupsThatExchangeTheirNamesKeepTheirRows() {
    const std::string path = newPath(), copy = newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
    QVERIFY(writer);
    const auto groupOf = [](int robot, const char* name) {
      GroupInfo group = robotGroup(name, robot);
      group.id = "robot " + std::to_string(robot);
      return group;
    };
    const std::array<const char*, 2> names{"B1", "R1"};
    constexpr int ticks = 400;
    for (int tick = 0; tick < ticks; ++tick) {
      for (std::size_t robot = 0; robot < 2; ++robot) {
        const bool isSwapped = tick / 100 % 2 == 1;
        const int number = static_cast<int>(robot) + 1;
        const GroupInfo group = groupOf(number, names[isSwapped ? 1 - robot : robot]);
        Row row = rowOf(static_cast<GroupId>(robot), tick);
        row.group = (*writer)->addGroup(group);
        append(**writer, row);
      }
    }
    QVERIFY((*writer)->finish());
    writer->reset();
    QVERIFY(repairSession(path, copy));
    for (const std::string& file : {path, copy}) {
      const auto reader = SessionReader::open(file);
      QVERIFY(reader);
      QVERIFY(reader->notes().empty());
      QCOMPARE(reader->groups().size(), 2U);
      for (std::size_t robot = 0; robot < 2; ++robot) {
        const SessionGroup& group = reader->groups()[robot];
        // As the names were at the end.
        QCOMPARE(group.info.name, std::string(names[1 - robot]));
        QCOMPARE(group.info.id, "robot " + std::to_string(robot + 1));
        QCOMPARE(group.channels.size(), 1U);
        QCOMPARE(group.rows, std::uint64_t{ticks});
      }
      std::array<int, 2> next{};
      for (const Row& row : rowsOf(*reader, everything)) {
        QVERIFY(row == rowOf(row.group, next.at(row.group)++));
      }
      QCOMPARE(next, (std::array<int, 2>{ticks, ticks}));
    }
  }

  /// Version 0.21 continued a renamed group in another channel, with the attribute "was".
  void aGroupThatWasRenamedInAnOldFileIsOneGroup() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
    QVERIFY(writer);
    record(**writer, 120);
    GroupInfo info = robotGroup("R1", 1);
    info.robot->was = "B1";
    const GroupId renamed = (*writer)->addGroup(info);
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
    GroupInfo narrow{
        "Robot 3", {column("X"), column("Y")}, facts({{"live", "1"}, {"number", "3"}})};
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

 private:
  /// A robot's columns as of a match whose advisor is switched on and off.
  struct Advised {
    GroupInfo plain{"B1",
                    {columnOf("ID", ColumnType::Int32), columnOf("BALL", ColumnType::Float32),
                     columnOf("X", ColumnType::Float64)},
                    facts({{"robot", "1"}})};
    GroupInfo advised{"B1",
                      {columnOf("ID", ColumnType::Int32), columnOf("ADVICE", ColumnType::Int32),
                       columnOf("BALL", ColumnType::Float32), columnOf("X", ColumnType::Float64)},
                      facts({{"robot", "1"}})};
    static ColumnInfo columnOf(const std::string& name, ColumnType type) {
      ColumnInfo column;
      column.name = name;
      column.type = type;
      return column;
    }
    static bool isOn(int row, int each) { return row / each % 2 == 1; }
    /// Its columns change every `each` rows.
    void record(SessionWriter& writer, int rows, int each) const {
      for (int i = 0; i < rows; ++i) {
        const auto number = static_cast<float>(i);
        const auto ball = std::bit_cast<std::uint32_t>(number);
        const auto count = static_cast<unsigned>(i);
        const std::array x{0.5 * i};
        if (isOn(i, each))
          writer.append(writer.addGroup(advised), {0.01 * i, std::array{7U, count, ball}, x});
        else
          writer.append(writer.addGroup(plain), {0.01 * i, std::array{7U, ball}, x});
      }
    }
  };

 private slots:
  void columnsThatComeAndGo() {
    const std::string path = newPath();
    constexpr int rows = 400, each = 100;
    {
      auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
      QVERIFY(writer);
      Advised().record(**writer, rows, each);
      QVERIFY((*writer)->finish());
    }
    const auto check = [&](const SessionReader& session) {
      QCOMPARE(session.groups().size(), std::size_t{1});
      QCOMPARE(session.groups()[0].rows, static_cast<std::uint64_t>(rows));
      QCOMPARE(session.groups()[0].channels.size(), std::size_t{2});
      const GroupInfo& info = session.groups()[0].info;
      QCOMPARE(info.columns.size(), std::size_t{4});
      QCOMPARE(info.columns[3].name, std::string("ADVICE"));
      QCOMPARE(info.columns[3].type, ColumnType::Float64);
      QCOMPARE(info.columns[1].type, ColumnType::Float32);
      int i = 0;
      session.rows({-1.0, 100.0}, {}, [&](GroupId, const RowView& row) {
        const bool isOn = Advised::isOn(i, each);
        const bool good = row.words.size() == 2 && row.words[0] == 7 &&
                          std::bit_cast<float>(row.words[1]) == static_cast<float>(i) &&
                          row.values[0] == 0.5 * i && std::isnan(row.values[1]) != isOn &&
                          (!isOn || row.values[1] == i);
        ++i;
        return good;
      });
      QCOMPARE(i, rows);
    };
    const auto session = SessionReader::open(path);
    QVERIFY(session);
    check(*session);
    std::vector<SessionRow> at;
    session->rowsAt(1.5, at);
    QCOMPARE(at[0].values[1], 150.0);
    session->rowsAt(2.5, at);
    QVERIFY(std::isnan(at[0].values[1]));

    // Every form of export has each column once.
    for (const ExportFormat format :
         {ExportFormat::CsvWide, ExportFormat::CsvEven, ExportFormat::JsonLines}) {
      std::string text;
      QVERIFY(exportText(*session, format, {}, [&text](std::string_view part) {
        text += part;
        return true;
      }));
      const QString head = QString::fromStdString(text).section('\n', 0, 0);
      QCOMPARE(head.count("ADVICE"), 1);
      QCOMPARE(head.count("BALL"), 1);
    }
    const std::string whole = newPath(), part = newPath();
    QVERIFY(exportFile(*session, ExportFormat::Mcap, {}, whole));
    check(SessionReader::open(whole).value());
    ExportSelection some;
    some.variables = {"ADVICE", "BALL"};
    QVERIFY(exportFile(*session, ExportFormat::Mcap, some, part));
    const auto fewer = SessionReader::open(part);
    QVERIFY(fewer);
    QCOMPARE(fewer->groups()[0].info.columns.size(), std::size_t{2});
    int i = 0;
    fewer->rows({-1.0, 100.0}, {}, [&](GroupId, const RowView& row) {
      const bool isOn = Advised::isOn(i, each);
      return std::bit_cast<float>(row.words[0]) == static_cast<float>(i++) &&
             (isOn ? row.values[0] == i - 1 : std::isnan(row.values[0]));
    });
    QCOMPARE(i, rows);
  }

  /// Recorded by 0.21 while an advisor was switched on (0.5 s), off (1 s) and on again (1.5 s).
  void anOldSessionWhoseAdvisorWasSwitched() {
    const auto session = SessionReader::open(PITCHBOARD_TEST_DATA "/sessions/advisor_0.21.mcap");
    QVERIFY(session);
    QCOMPARE(session->groups().size(), std::size_t{2});
    const auto robot = std::ranges::find(session->groups(), std::string("B1"),
                                         [](const SessionGroup& group) { return group.info.name; });
    QVERIFY(robot != session->groups().end());
    QCOMPARE(robot->rows, std::uint64_t{25});
    const auto g = static_cast<std::size_t>(robot - session->groups().begin());
    const auto indexOf = [&](const char* name) {
      const auto& columns = robot->info.columns;
      const auto at = std::ranges::find(columns, name, &ColumnInfo::name);
      return static_cast<std::size_t>(std::count_if(columns.begin(), at, [](const ColumnInfo& one) {
        return one.type == ColumnType::Float64;
      }));
    };
    std::vector<SessionRow> at;
    for (const double time : {0.1, 0.4, 0.7, 0.9, 1.2, 1.4, 1.7, 1.9}) {
      session->rowsAt(time, at);
      QVERIFY(at[g].present && time - at[g].time < 0.15);
      QVERIFY(std::isfinite(at[g].values[indexOf("TRUE_X")]));
      const bool isOn = (time > 0.5 && time < 1.0) || time > 1.5;
      QCOMPARE(std::isfinite(at[g].values[indexOf("ADVISOR_STATE")]), isOn);
    }
    std::string text;
    QVERIFY(exportText(*session, ExportFormat::CsvEven, {}, [&text](std::string_view part) {
      text += part;
      return true;
    }));
    QStringList names = QString::fromStdString(text).section('\n', 0, 0).split(',');
    QVERIFY(names.contains(QStringLiteral("B1.ADVISOR_STATE")));
    QCOMPARE(names.removeDuplicates(), qsizetype{0});
  }

  /// In a long session curves are drawn from summaries; those of several channels of one group are
  /// joined without loss.
  void summariesOfColumnsThatComeAndGo() {
    const std::string path = newPath();
    constexpr int rows = 60'000, each = 1700;  // no whole buckets
    {
      auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
      QVERIFY(writer);
      Advised().record(**writer, rows, each);
      QVERIFY((*writer)->finish());
    }
    const auto session = SessionReader::open(path);
    QVERIFY(session && session->hasSummaries());
    const GroupSummary summary = session->summary(0);
    QCOMPARE(summary.rows(), static_cast<std::uint64_t>(rows));
    double end = -1.0;
    for (const SummaryPart& part : summary.parts) {
      QCOMPARE(part.columns.size(), std::size_t{4});
      for (std::size_t b = 0; b < part.buckets(); ++b) {
        QVERIFY(part.begin[b] > end);
        end = part.end[b];
        const int first = static_cast<int>(std::lround(part.begin[b] / 0.01));
        const auto& advice = part.columns[3].max;
        const float value = advice.size() == 1 ? advice[0] : advice[b];
        QCOMPARE(std::isnan(value), !Advised::isOn(first, each));
      }
    }
  }

  /// Names that appear one by one: a few channels describe them all, every value is there, and what
  /// waits is written when the robot is silent.
  void columnsThatAppearOneByOne() {
    const std::string path = newPath();
    constexpr int rows = 600;
    GroupInfo info{"R10", {}, facts({{"live", "1"}})};
    {
      auto writer = SessionWriter::create(path, sessionInfo());
      QVERIFY(writer);
      std::vector<double> values;
      for (int i = 0; i < rows; ++i) {
        info.columns.push_back(Advised::columnOf("NAME_" + std::to_string(i), ColumnType::Float64));
        values.push_back(i);
        (*writer)->append((*writer)->addGroup(info), {0.05 * i, {}, values});
      }
      const auto inFile = [&path] {
        const auto part = SessionReader::open(path);
        return part && !part->groups().empty() ? part->groups()[0].rows : 0;
      };
      QTRY_COMPARE_WITH_TIMEOUT(inFile(), static_cast<std::uint64_t>(rows), 20'000);
      QCOMPARE((*writer)->status().rows, static_cast<std::uint64_t>(rows));
      QVERIFY((*writer)->finish());
    }
    const auto session = SessionReader::open(path);
    QVERIFY(session);
    QCOMPARE(session->groups().size(), std::size_t{1});
    QCOMPARE(session->groups()[0].info.columns.size(), static_cast<std::size_t>(rows));
    QVERIFY2(session->groups()[0].channels.size() < 12,
             qPrintable(QString::number(session->groups()[0].channels.size())));
    int i = 0;
    session->rows({-1.0, 100.0}, {}, [&](GroupId, const RowView& row) {
      bool good = std::abs(row.time - 0.05 * i) < 1e-9;
      for (int c = 0; c < rows; ++c) {
        const double value = row.values[static_cast<std::size_t>(c)];
        good = good && (c <= i ? value == c : std::isnan(value));
      }
      ++i;
      return good;
    });
    QCOMPARE(i, rows);
  }

  /// Texts that differ in every message are written once each, not with all others each time.
  void textsThatKeepChanging() {
    const std::string path = newPath();
    constexpr int rows = 3000;
    GroupInfo info{"R10", {Advised::columnOf("SAYS", ColumnType::Float64)}, facts({{"live", "1"}})};
    info.columns[0].kind = ColumnKind::Text;
    {
      auto writer = SessionWriter::create(path, sessionInfo());
      QVERIFY(writer);
      for (int i = 0; i < rows; ++i) {
        info.columns[0].labels[i] = "text " + std::to_string(i);
        (*writer)->append((*writer)->addGroup(info), {0.05 * i, {}, std::array{1.0 * i}});
      }
      QVERIFY((*writer)->finish());
    }
    const auto session = SessionReader::open(path);
    QVERIFY(session);
    QCOMPARE(session->groups()[0].rows, static_cast<std::uint64_t>(rows));
    QVERIFY(session->groups()[0].channels.size() < 12);
    QVERIFY(session->groups()[0].info.columns[0].labels == info.columns[0].labels);
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

// SPDX-License-Identifier: GPL-3.0-or-later
// What is exported is what was recorded: every number reads back to the same bits.

#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <charconv>
#include <clocale>
#include <filesystem>

#include <telemetry/session/session_export.h>
#include <telemetry/session/session_notes.h>
#include <telemetry/session/session_repair.h>

#include "session_rig.h"

namespace tst_session_export {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

class TestSessionExport : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  std::string m_path;
  std::vector<Row> m_rows;
  int m_number = 0;

  std::string newPath() { return m_folder.filePath(QString::number(++m_number)).toStdString(); }
  SessionReader session() const { return std::move(*SessionReader::open(m_path)); }

  static QList<QByteArray> textOf(const SessionReader& reader, ExportFormat format,
                                  const ExportSelection& selection = {}) {
    QByteArray text;
    const auto report = exportText(reader, format, selection, [&](std::string_view part) {
      text.append(part.data(), static_cast<qsizetype>(part.size()));
      return true;
    });
    if (!report) qFatal("%s", report.error().text().c_str());
    if (report->bytes != static_cast<std::uint64_t>(text.size())) qFatal("another count of bytes");
    if (report->lines != static_cast<std::uint64_t>(text.count('\n')))
      qFatal("another count of lines");
    text.chop(1);
    return text.split('\n');
  }
  static bool hasLine(const QList<QByteArray>& lines, const char* line) {
    if (lines.contains(line)) return true;
    qWarning() << lines;
    return false;
  }
  static bool same(const QByteArray& text, double value) {
    if (std::isnan(value)) return text.isEmpty();
    double read = 0.0;
    const auto [end, code] = std::from_chars(text.begin(), text.end(), read);
    return code == std::errc() && end == text.end() &&
           std::bit_cast<std::uint64_t>(read) == std::bit_cast<std::uint64_t>(value);
  }
  static double value(const Row& row, std::size_t column) {
    if (column >= row.words.size()) return row.values[column - row.words.size()];
    return column == 2 ? static_cast<double>(std::bit_cast<float>(row.words[2]))
                       : static_cast<std::int32_t>(row.words[column]);
  }

 private slots:
  void initTestCase() {
    // Decimal commas of some languages must not reach the files.
    for (const char* language : {"de_DE.UTF-8", "fr_FR.UTF-8"}) std::setlocale(LC_ALL, language);
    m_path = m_folder.filePath("session.mcap").toStdString();
    SessionWriterOptions options;
    options.chunkBytes = 8'000;
    auto writer = SessionWriter::create(m_path, sessionInfo(), options);
    m_rows = record(**writer, 300);
    (*writer)->attach("scenario.json", "application/json", "{}");
    QVERIFY((*writer)->finish());
  }

  void wide() {
    const auto lines = textOf(session(), ExportFormat::CsvWide);
    QCOMPARE(
        lines[0],
        QByteArray("time,B1.DECISION_ACTION_A,B1.VISION_WORKING,B1.VISION_BALL_DIST,B1.TRUTH_X,"
                   "B1.TRUTH_YAW,B2.DECISION_ACTION_A,B2.VISION_WORKING,B2.VISION_BALL_DIST,"
                   "B2.TRUTH_X,B2.TRUTH_YAW,match.BALL_X,match.ball x"));
    QCOMPARE(lines.size(), 301);
    for (int tick = 0; tick < 300; ++tick) {
      const auto cells = lines[tick + 1].split(',');
      QCOMPARE(cells.size(), 13);
      QVERIFY(same(cells[0], tick / 60.0));
      for (int i = 0; i < 5; ++i) {
        const auto column = static_cast<std::size_t>(i);
        if (column == 2) {
          float shortest = 0.0F;
          std::from_chars(cells[3].begin(), cells[3].end(), shortest);
          const float expected = std::bit_cast<float>(rowOf(0, tick).words[2]);
          QVERIFY(std::isnan(expected) ? cells[3].isEmpty() : shortest == expected);
          continue;
        }
        QVERIFY(same(cells[1 + i], value(rowOf(0, tick), column)));
        QVERIFY(same(cells[6 + i], value(rowOf(1, tick), column)));
      }
      QVERIFY(same(cells[12], -0.0));
    }
  }

  void wideWithGaps() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo());
    (*writer)->addGroup(robotGroup("B1", 1));
    (*writer)->addGroup(robotGroup("B2", 2));
    const GroupId match = (*writer)->addGroup(matchGroup());
    append(**writer, rowOf(0, 1));
    append(**writer, rowOf(1, 2));
    (*writer)->append(match, {2 / 60.0, {}, std::vector<double>{5.0, 6.0}});
    (*writer)->append(match, {2 / 60.0, {}, std::vector<double>{7.0, 8.0}});  // twice at one time
    QVERIFY((*writer)->finish());
    ExportSelection selection;
    selection.variables = {"VISION_W*", "BALL_X"};
    const auto lines = textOf(*SessionReader::open(path), ExportFormat::CsvWide, selection);
    QCOMPARE(lines, (QList<QByteArray>{"time,B1.VISION_WORKING,B2.VISION_WORKING,match.BALL_X",
                                       "0.016666666666666666,1,,", "0.03333333333333333,,0,5",
                                       "0.03333333333333333,,,7"}));
  }

  void longForm() {
    ExportSelection selection;
    selection.robots = {"B2"};
    selection.variables = {"*_X", "DECISION*"};
    selection.range = {1.0, 2.0};
    const auto lines = textOf(session(), ExportFormat::CsvLong, selection);
    QCOMPARE(lines.size(), 1 + 61 * 2);
    QCOMPARE(lines[0], QByteArray("time,robot,variable,value"));
    QCOMPARE(lines[1], QByteArray("1,B2,TRUTH_X,21"));
    QCOMPARE(lines[2], QByteArray("1,B2,DECISION_ACTION_A,-60"));
  }

  void jsonLines() {
    const auto lines = textOf(session(), ExportFormat::JsonLines);
    int rows = 0, events = 0;
    for (const QByteArray& line : lines) {
      const QJsonObject object = QJsonDocument::fromJson(line).object();
      QVERIFY2(object.contains("time"), line.constData());
      if (object.contains("robot")) {
        const Row& row = m_rows[static_cast<std::size_t>(rows++)];
        QCOMPARE(object["time"].toDouble(), row.time);
        if (row.group == 2) continue;
        QCOMPARE(object["values"]["TRUTH_X"].toDouble(), row.values[0]);
        QCOMPARE(object["values"]["TRUTH_YAW"].isNull(), std::isinf(row.values[1]));
      } else {
        QCOMPARE(object["stream"].toString(), QStringLiteral("events"));
        QCOMPARE(object["message"]["kind"].toString(), QStringLiteral("kick"));
        ++events;
      }
    }
    QCOMPARE(rows, 900);
    QCOMPARE(events, 5);
  }

  void clip() {
    ExportSelection selection;
    selection.robots = {"B1", "match"};
    selection.variables = {"TRUTH_YAW", "VISION_BALL_DIST", "ball x"};
    selection.range = {1.0, 3.0};
    const std::string path = newPath();
    const auto report = exportFile(session(), ExportFormat::Mcap, selection, path);
    QVERIFY2(report, report ? "" : report.error().text().c_str());
    const auto reader = SessionReader::open(path);
    QVERIFY(reader->complete() && reader->notes().empty());
    QVERIFY(reader->info() == sessionInfo());
    QCOMPARE(reader->groups().size(), 2U);
    QCOMPARE(reader->groups()[0].info.columns.size(), 2U);
    QVERIFY(reader->groups()[0].info.columns[0] == robotGroup("B1", 1).columns[2]);
    QCOMPARE(reader->events().size(), 2U);
    QVERIFY(reader->attachment("scenario.json"));
    const auto rows = rowsOf(*reader, everything);
    QCOMPARE(rows.size(), 2 * 121U);
    for (const Row& row : rows) {
      const Row whole = rowOf(row.group == 0 ? 0 : 2, static_cast<int>(std::lround(row.time * 60)));
      QCOMPARE(row.time, whole.time);
      if (row.group == 0) {
        QCOMPARE(row.words.at(0), whole.words[2]);
        QCOMPARE(row.values.at(0), whole.values[1]);
      }
    }
  }

  /// Bookmarks that were set in Replay vanished without a word.
  /// Chunks of a copy end by their size and not by the clock, and only few of them wait in memory.
  void aCopyHasTheSameBytesEveryTime() {
    const std::string path = newPath();
    SessionWriterOptions options;
    options.waitWhenFull = true;
    auto writer = SessionWriter::create(path, sessionInfo(), options);
    std::string text(50'000, ' ');
    for (int i = 0; i < 400; ++i) {  // 20 MB, more than may wait
      for (char& c : text) c = static_cast<char>('a' + (c + i) % 23);
      (*writer)->appendJson(
          SessionStream::Telemetry, i / 60.0,
          "{\"time\":" + std::to_string(i / 60.0) + ",\"text\":\"" + text + "\"}");
      append(**writer, rowOf((*writer)->addGroup(robotGroup("B1", 1)), i));
    }
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    QVERIFY(reader);
    QByteArrayList copies;
    for (int i = 0; i < 2; ++i) {
      const std::string to = newPath();
      QVERIFY(exportFile(*reader, ExportFormat::Mcap, {}, to));
      QFile file(QString::fromStdString(to));
      QVERIFY(file.open(QIODevice::ReadOnly));
      copies << file.readAll();
      const auto copy = SessionReader::open(to);
      QVERIFY(copy);
      const auto& chunks = copy->file().contents().chunks;
      QVERIFY(chunks.size() >= 10);
      for (std::size_t c = 0; c + 1 < chunks.size(); ++c) {
        const std::uint64_t size = chunks[c].uncompressedSize;
        QVERIFY2(chunks[c].channels.empty() || size >= options.chunkBytes,
                 qPrintable(QString::number(size)));
      }
    }
    QCOMPARE(copies[0], copies[1]);
  }

  void notesBesideTheFileGoAlong() {
    const std::string path = newPath();
    {
      auto writer = SessionWriter::create(path, sessionInfo(), {});
      record(**writer, 120);
      // A bookmark is recorded when it is set, and again with its note.
      SessionEvent bookmark{1.5, "bookmark", "", "", EventFacts{}};
      (*writer)->append(bookmark);
      bookmark.text = bookmark.facts->detail = "recorded";
      (*writer)->append(bookmark);
      QVERIFY((*writer)->finish());
    }
    const auto bookmarksOf = [](const SessionReader& reader) {
      std::vector<std::pair<double, std::string>> found;
      for (const SessionEvent& event : reader.events()) {
        if (event.kind == "bookmark") found.emplace_back(event.time, event.text);
      }
      return found;
    };
    using Bookmarks = std::vector<std::pair<double, std::string>>;
    QVERIFY(bookmarksOf(*SessionReader::open(path)) == (Bookmarks{{1.5, "recorded"}}));
    QVERIFY(addSessionNote(path, 0.25, ""));
    QVERIFY(addSessionNote(path, 0.25, "why \"here\"?"));
    QVERIFY(addSessionNote(path, 1.5, "changed"));
    const auto reader = SessionReader::open(path);
    QVERIFY(reader->notes().empty());
    const Bookmarks both{{0.25, "why \"here\"?"}, {1.5, "changed"}};
    QVERIFY(bookmarksOf(*reader) == both);
    // A clip has them inside.
    ExportSelection selection;
    selection.range = {0.0, 1.0};
    const std::string clip = newPath();
    QVERIFY(exportFile(*reader, ExportFormat::Mcap, selection, clip));
    QVERIFY(bookmarksOf(*SessionReader::open(clip)) == (Bookmarks{both[0]}));
    const QByteArray lines = textOf(*reader, ExportFormat::JsonLines).join('\n');
    QVERIFY(lines.contains("\"text\":\"why \\\"here\\\"?\""));
    // Each as it was written last.
    QVERIFY2(lines.count("\"bookmark\"") == 2 && !lines.contains("\"recorded\""),
             lines.constData());
    // So has a repaired file.
    const std::string repaired = newPath();
    QVERIFY(repairSession(path, repaired));
    QVERIFY(bookmarksOf(*SessionReader::open(repaired)) == both);
    // What somebody wrote into the file by hand is not destroyed.
    QFile file(QString::fromStdString(sessionNotesPath(path)));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("{\"bookmarks\": oops") > 0);
    file.close();
    QCOMPARE(SessionReader::open(path)->notes().size(), 1U);
    QVERIFY(!addSessionNote(path, 0.5, "lost"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), QByteArray("{\"bookmarks\": oops"));
  }

  void whatCannotBe() {
    ExportSelection selection;
    selection.robots = {"R9"};
    const auto robot = checkSelection(session(), selection);
    QVERIFY(!robot && robot.error().message.find("B1, B2, match") != std::string::npos);
    selection.robots.clear();
    selection.variables = {"NO_*"};
    QVERIFY(checkSelection(session(), selection).error().code == ErrorCode::NotFound);
    QVERIFY(!exportFormat("xls"));

    const std::string path = newPath();
    std::ofstream(path) << "precious";
    QVERIFY(exportFile(session(), ExportFormat::CsvWide, {}, path).error().code ==
            ErrorCode::Conflict);
    QCOMPARE(bytesOf(path), std::string("precious"));
    for (const ExportFormat format : {ExportFormat::CsvLong, ExportFormat::Mcap}) {
      const std::string stopped = newPath();
      QVERIFY(!exportFile(session(), format, {}, stopped, [](double part) { return part < 0.5; }));
      QVERIFY(!std::filesystem::exists(stopped));
    }
    // What is to be replaced stays until the new one is whole, whatever goes wrong.
    ExportSelection unknown;
    unknown.robots = {"nobody"};
    for (const ExportFormat format : {ExportFormat::CsvLong, ExportFormat::Mcap}) {
      QVERIFY(!exportFile(session(), format, unknown, path, {}, IfExists::Replace));
      QVERIFY(!exportFile(
          session(), format, {}, path, [](double part) { return part < 0.5; }, IfExists::Replace));
      QCOMPARE(bytesOf(path), std::string("precious"));
    }
    const std::string original = bytesOf(m_path);
    const std::string symbolic = newPath(), hard = newPath();
    std::filesystem::create_symlink(m_path, symbolic);
    std::filesystem::create_hard_link(m_path, hard);
    for (const std::string& self : {m_path, symbolic, hard}) {
      for (const ExportFormat format : {ExportFormat::CsvLong, ExportFormat::Mcap}) {
        const auto refused = exportFile(session(), format, {}, self, {}, IfExists::Replace);
        QVERIFY(!refused && refused.error().message.find("being read") != std::string::npos);
        QVERIFY(bytesOf(m_path) == original);
      }
    }
    QVERIFY(exportFile(session(), ExportFormat::Mcap, {}, path, {}, IfExists::Replace));
    QVERIFY(SessionReader::open(path)->complete());
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(m_path).parent_path())) {
      QVERIFY2(entry.path().extension() != ".part", entry.path().c_str());
    }
    const auto full = exportFile(session(), ExportFormat::CsvWide, {}, "/dev/full");
    QVERIFY(!full);
    const auto sink =
        exportText(session(), ExportFormat::CsvLong, {}, [](std::string_view) { return false; });
    QVERIFY(!sink);
  }

  void textsAreExportedAsText() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo());
    QVERIFY(writer);
    GroupInfo robot{"Robot 4", {{"ROLE", ColumnType::Float64, "", "", ColumnKind::Text, {}}}, {}};
    // Words come one after the other, as they are received.
    const char* words[] = {"striker", "keeper, \"old\""};
    for (int i = 0; i < 2; ++i) {
      robot.columns[0].labels.emplace(i, words[i]);
      const double code = i;
      (*writer)->append((*writer)->addGroup(robot), {i * 1.0, {}, std::span(&code, 1)});
    }
    const double hole = std::nan("");
    (*writer)->append((*writer)->addGroup(robot), {2.0, {}, std::span(&hole, 1)});
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    QVERIFY(reader);
    QCOMPARE(reader->groups().size(), std::size_t{1});
    QVERIFY(hasLine(textOf(*reader, ExportFormat::CsvWide), "0,striker"));
    QVERIFY(hasLine(textOf(*reader, ExportFormat::CsvWide), "1,\"keeper, \"\"old\"\"\""));
    QVERIFY(hasLine(textOf(*reader, ExportFormat::CsvWide), "2,"));
    QVERIFY(hasLine(textOf(*reader, ExportFormat::CsvLong), "0,Robot 4,ROLE,striker"));
    ExportSelection even;
    even.resampling = {1.0, true};
    QVERIFY(hasLine(textOf(*reader, ExportFormat::CsvEven, even), "0,striker"));
    const auto lines = textOf(*reader, ExportFormat::JsonLines);
    QCOMPARE(QJsonDocument::fromJson(lines[1]).object().value("values")["ROLE"].toString(),
             QString(words[1]));
    QVERIFY(QJsonDocument::fromJson(lines[2]).object().value("values")["ROLE"].isNull());
  }

  void evenTimes() {
    // 300 rows at 60/s: 5 s. Ten lines a second begin with the first row.
    ExportSelection selection;
    selection.robots = {"match", "B2"};
    selection.variables = {"BALL_X", "DECISION_ACTION_A"};
    selection.resampling = {10.0, false};
    auto lines = textOf(session(), ExportFormat::CsvEven, selection);
    QCOMPARE(lines[0], QByteArray("time,match.BALL_X,B2.DECISION_ACTION_A"));
    QCOMPARE(lines.size(), 51);  // 0.0 to 4.9
    // Every sixth row: held and interpolated agree with it.
    QCOMPARE(lines[11].split(',')[0], QByteArray("1"));
    QVERIFY(std::abs(lines[11].split(',')[1].toDouble() - 6.0) < 1e-9);
    // Between rows: seven lines a second.
    selection.resampling = {7.0, false};
    lines = textOf(session(), ExportFormat::CsvEven, selection);
    QVERIFY(std::abs(lines[2].split(',')[1].toDouble() - 0.8) < 1e-9);  // the row at 8/60
    QCOMPARE(lines[2].split(',')[2], QByteArray("-8"));
    selection.resampling.interpolate = true;
    lines = textOf(session(), ExportFormat::CsvEven, selection);
    QVERIFY(std::abs(lines[2].split(',')[1].toDouble() - 6.0 / 7.0) < 1e-9);
    QCOMPARE(lines[2].split(',')[2], QByteArray("-8"));  // a code has nothing between
    selection.resampling.rate = 0.0;
    const auto refused = exportText(session(), ExportFormat::CsvEven, selection,
                                    [](std::string_view) { return true; });
    QVERIFY(!refused);
  }

  /// A robot that sends every 4 s and one that sends five times a second.
  std::string slowAndFast() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo());
    const auto column = [](const char* name) {
      return ColumnInfo{name, ColumnType::Float64, "", "", ColumnKind::Number, {}};
    };
    const GroupId slow = (*writer)->addGroup({"B1", {column("X")}, {}});
    const GroupId fast = (*writer)->addGroup({"B2", {column("X")}, {}});
    for (int i = 0; i < 75; ++i) {
      const double time = 0.013 + 0.2 * i, value = i;
      if (i % 20 == 0) (*writer)->append(slow, {time, {}, std::span(&value, 1)});
      (*writer)->append(fast, {time + 0.002, {}, std::span(&value, 1)});
    }
    if (!(*writer)->finish()) qFatal("not written");
    return path;
  }

  /// Every line of a range is that of the whole session at this time.
  void evenTimesOfARange_data() {
    QTest::addColumn<bool>("interpolate");
    QTest::newRow("held") << false;
    QTest::newRow("interpolated") << true;
  }
  void evenTimesOfARange() {
    QFETCH(bool, interpolate);
    const auto reader = SessionReader::open(slowAndFast());
    ExportSelection selection;
    selection.resampling = {3.0, interpolate};
    const auto whole = textOf(*reader, ExportFormat::CsvEven, selection);
    for (const TimeRange range : {TimeRange{10.0, 12.0}, TimeRange{0.0, 3.0}, TimeRange{13.9, 99.0},
                                  TimeRange{-1e18, 5.0}, TimeRange{6.1, 1e18}}) {
      selection.range = range;
      QList<QByteArray> expected{whole[0]};
      for (const QByteArray& line : whole.mid(1)) {
        const double time = line.split(',')[0].toDouble();
        if (time >= range.begin && time <= range.end) expected << line;
      }
      QVERIFY(expected.size() > 2);
      QCOMPARE(textOf(*reader, ExportFormat::CsvEven, selection), expected);
    }
    // Robots that nobody exports have no part in it.
    selection.robots = {"B2"};
    selection.range = {10.0, 12.0};
    const auto fast = textOf(*reader, ExportFormat::CsvEven, selection);
    QVERIFY(fast[1].startsWith("10.015,"));
  }

  void aClipBeginsWithWhatHeldBefore() {
    const std::string path = newPath();
    ExportSelection selection;
    selection.range = {10.0, 12.0};
    const auto source = SessionReader::open(slowAndFast());
    QVERIFY(exportFile(*source, ExportFormat::Mcap, selection, path));
    const auto clip = SessionReader::open(path);
    QVERIFY(clip->complete());
    QCOMPARE(clip->range()->begin, 10.0);
    QVERIFY(clip->range()->end <= 12.0);
    const auto lines = textOf(*clip, ExportFormat::CsvWide);
    QCOMPARE(lines[1], QByteArray("10,40,49"));
    // A robot that has been silent for long is not there.
    selection.range = {23.0, 24.0};
    const std::string late = newPath();
    QVERIFY(exportFile(*source, ExportFormat::Mcap, selection, late));
    QCOMPARE(rowsOf(*SessionReader::open(late), everything).size(), 1U);
  }

  void timesNeverGoBack() {
    // Rows of one robot arrive later than those of another, events late and in chunks of their own.
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
    (*writer)->addGroup(robotGroup("B1", 1));
    (*writer)->addGroup(robotGroup("B2", 2));
    for (int tick = 0; tick < 400; ++tick) {
      append(**writer, rowOf(0, tick));
      if (tick >= 2) append(**writer, rowOf(1, tick - 2));
      if (tick % 50 == 10) (*writer)->append(SessionEvent{tick / 60.0, "kick", "B1", "kick"});
    }
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    const auto check = [&](ExportFormat format, auto timeOf) {
      double last = -1.0;
      for (const QByteArray& line : textOf(*reader, format)) {
        if (line.startsWith("time")) continue;
        const double time = timeOf(line);
        if (time < last) return false;
        last = time;
      }
      return last > 6.0;
    };
    const auto ofCsv = [](const QByteArray& line) { return line.split(',')[0].toDouble(); };
    const auto ofJson = [](const QByteArray& line) {
      return QJsonDocument::fromJson(line).object()["time"].toDouble();
    };
    QVERIFY(check(ExportFormat::CsvWide, ofCsv));
    QVERIFY(check(ExportFormat::CsvLong, ofCsv));
    QVERIFY(check(ExportFormat::JsonLines, ofJson));
    QCOMPARE(textOf(*reader, ExportFormat::CsvWide).size(), 401);
  }

  void otherOrdersOfMessages_data() {
    QTest::addColumn<bool>("isBackwards");
    QTest::newRow("topic by topic") << false;
    QTest::newRow("backwards") << true;
  }
  void otherOrdersOfMessages() {
    QFETCH(bool, isBackwards);
    const std::string path = newPath(), twice = newPath(), other = newPath();
    // Also with two rows of one time, as changes by hand leave them.
    auto writer = SessionWriter::create(twice, sessionInfo(), smallChunks());
    record(**writer, 200);
    for (const GroupId group : {0U, 1U}) append(**writer, rowOf(group, 199));
    QVERIFY((*writer)->finish());
    rewrite(twice, other, isBackwards ? backwards : topicByTopic);
    const auto before = SessionReader::open(twice), after = SessionReader::open(other);
    QVERIFY(after && after->complete());
    for (const ExportFormat format : {ExportFormat::CsvWide, ExportFormat::CsvEven}) {
      QCOMPARE(textOf(*after, format), textOf(*before, format));
    }
    for (const ExportFormat format : {ExportFormat::CsvLong, ExportFormat::JsonLines}) {
      // Lines of one tick are in the order of the file.
      auto lines = textOf(*after, format), expected = textOf(*before, format);
      std::ranges::sort(lines);
      std::ranges::sort(expected);
      QCOMPARE(lines, expected);
    }
    // A copy of it is a session like any other, with summaries that fit.
    QVERIFY(exportFile(*after, ExportFormat::Mcap, {}, path));
    QCOMPARE(textOf(*SessionReader::open(path), ExportFormat::CsvWide),
             textOf(*before, ExportFormat::CsvWide));
  }

  void columnsInTheOrderOfVariables() {
    ExportSelection selection;
    selection.variables = {"BALL_X", "TRUTH_YAW", "VISION_*", "TRUTH_*"};
    selection.range = {0.0, 0.0};
    const QByteArray head =
        "time,match.BALL_X,B1.TRUTH_YAW,B2.TRUTH_YAW,B1.VISION_WORKING,B1.VISION_BALL_DIST,"
        "B2.VISION_WORKING,B2.VISION_BALL_DIST,B1.TRUTH_X,B2.TRUTH_X";
    for (const ExportFormat format : {ExportFormat::CsvWide, ExportFormat::CsvEven}) {
      QCOMPARE(textOf(session(), format, selection)[0], head);
    }
    const auto rows = textOf(session(), ExportFormat::CsvLong, selection);
    QVERIFY(rows[1].startsWith("0,B1,TRUTH_YAW,"));
    QVERIFY(rows[4].startsWith("0,B1,TRUTH_X,"));
  }

  void unknownCellsAreEmpty() {
    ExportSelection selection;
    selection.robots = {"B1"};
    selection.variables = {"VISION_BALL_DIST", "TRUTH_YAW"};
    selection.range = {0.0, 0.0};
    for (const ExportFormat format : {ExportFormat::CsvWide, ExportFormat::CsvEven}) {
      QCOMPARE(textOf(session(), format, selection)[1], QByteArray("0,,-inf"));
    }
    QCOMPARE(textOf(session(), ExportFormat::CsvLong, selection)[1],
             QByteArray("0,B1,VISION_BALL_DIST,"));
  }

  void timeOfDay() {
    ExportSelection selection;
    selection.robots = {"match"};
    selection.variables = {"BALL_X"};
    selection.clock = true;
    // 1 700 000 000 s after 1970, by the computer's own `date`.
    const auto wide = textOf(session(), ExportFormat::CsvWide, selection);
    QCOMPARE(wide[0], QByteArray("time,clock,match.BALL_X"));
    QVERIFY2(wide[1].startsWith("0,2023-11-14T22:13:20.000Z,"), wide[1].constData());
    QVERIFY2(wide[61].startsWith("1,2023-11-14T22:13:21.000Z,"), wide[61].constData());
    const auto rows = textOf(session(), ExportFormat::CsvLong, selection);
    QCOMPARE(rows[0], QByteArray("time,clock,robot,variable,value"));
    QVERIFY(rows[1].startsWith("0,2023-11-14T22:13:20.000Z,match,BALL_X,"));
  }
};

PITCHBOARD_TEST(TestSessionExport)

}  // namespace tst_session_export

#include "tst_session_export.moc"

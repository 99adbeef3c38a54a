// SPDX-License-Identifier: GPL-3.0-or-later
// A recorded session, a repaired and a clipped one, read by the official TypeScript packages: they
// find every message with the values that were written, and check indexes and checksums.

#include <QProcess>
#include <QtTest>

#include <telemetry/session/session_export.h>
#include <telemetry/session/session_repair.h>

#include "session_rig.h"

namespace tst_mcap_readers {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

namespace {

QByteArray hexOf(double value) {
  if (std::isnan(value)) return "nan";
  return QByteArray::number(static_cast<qulonglong>(std::bit_cast<std::uint64_t>(value)), 16)
      .rightJustified(16, '0');
}

QByteArray times(double time) {
  const auto wall = 1'700'000'000'000'000'000LL + std::llround(time * 1e9);
  return QByteArray::number(wall) + " " + QByteArray::number(wall);
}

QByteArray rowLine(const Row& row, std::uint32_t sequence) {
  const QByteArray topics[] = {"/robots/B1/row", "/robots/B2/row", "/match/row"};
  QByteArray out = "row " + topics[row.group] + " " + QByteArray::number(sequence) + " " +
                   times(row.time) + " " + hexOf(row.time);
  for (std::size_t i = 0; i < row.words.size(); ++i) {
    out += " " + hexOf(i == 2 ? static_cast<double>(std::bit_cast<float>(row.words[i]))
                              : static_cast<std::int32_t>(row.words[i]));
  }
  for (const double value : row.values) out += " " + hexOf(value);
  return out;
}

struct Output {
  QList<QByteArray> lines;
  QByteArray error;
  int code = -1;
};

Output run(const QString& name, const QStringList& arguments) {
  QProcess node;
  // The packages are found beside the script, so it runs as a copy in their folder.
  const QString script = QStringLiteral(MCAP_READERS "/") + name;
  QFile::remove(script);
  QFile::copy(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/mcap_readers/") + name, script);
  node.start("node", QStringList{script} + arguments);
  Output out;
  if (!node.waitForFinished(100'000)) {
    out.error = node.errorString().toUtf8();
    return out;
  }
  out.code = node.exitCode();
  out.error = node.readAllStandardError();
  out.lines = node.readAllStandardOutput().trimmed().split('\n');
  return out;
}

Output readOfficially(const std::string& path) {
  return run("read_session.mjs", {QString::fromStdString(path)});
}

QByteArray exported(const std::string& path, ExportFormat format) {
  const auto reader = SessionReader::open(path);
  QByteArray text;
  const auto done = exportText(*reader, format, {}, [&](std::string_view part) {
    text.append(part.data(), static_cast<qsizetype>(part.size()));
    return true;
  });
  if (!done) qFatal("%s", done.error().text().c_str());
  return text;
}

QList<QByteArray> ofKind(const QList<QByteArray>& lines, const QByteArray& kind) {
  QList<QByteArray> out;
  for (const QByteArray& line : lines) {
    if (line.startsWith(kind + " ")) out << line;
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

class TestMcapReaders : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  std::string m_path;
  std::vector<Row> m_rows;

  static QList<QByteArray> expected(const std::vector<Row>& rows) {
    QList<QByteArray> out;
    std::array<std::uint32_t, 3> sequence{};
    for (const Row& row : rows) out << rowLine(row, sequence[row.group]++);
    std::sort(out.begin(), out.end());
    return out;
  }

 private slots:
  void initTestCase() {
    m_path = m_folder.filePath("session.mcap").toStdString();
    SessionWriterOptions options;
    options.chunkBytes = 20'000;
    auto writer = SessionWriter::create(m_path, sessionInfo(), options);
    QVERIFY(writer);
    m_rows = record(**writer, 600);
    (*writer)->append(SessionStream::Telemetry, {0.5, {{0x7f000001}, 4711}, 1241, "RBT|\xff"});
    (*writer)->append(pitchboard::LogLine{1.0, "B1/decision", "hello"});
    (*writer)->attach("scenario.json", "application/json", "{}");
    QVERIFY((*writer)->finish());
  }

  void recorded() {
    const Output out = readOfficially(m_path);
    QVERIFY2(out.code == 0, out.error.constData());
    QVERIFY(ofKind(out.lines, "row") == expected(m_rows));
    QList<QByteArray> events;
    for (int i = 0; i < 10; ++i) {
      const double time = (60 * i + 30) / 60.0;
      const QByteArray json =
          QStringLiteral(R"({"time":%1,"kind":"kick","group":"B1","text":"kick %2"})")
              .arg(time, 0, 'f', 1)
              .arg(60 * i + 30)
              .toUtf8();
      events << "json /events " + QByteArray::number(i) + " " + times(time) + " " + json.toHex();
    }
    const auto json = ofKind(out.lines, "json");
    QCOMPARE(json.size(), 12);
    for (const QByteArray& event : events) QVERIFY2(json.contains(event), event.constData());
    QVERIFY(ofKind(out.lines, "attachment") ==
            QList<QByteArray>{"attachment scenario.json application/json 7b7d"});
    QVERIFY(out.lines.contains("metadata pitchboard title " + QByteArray("match-3v3").toHex()));
    QVERIFY(
        out.lines.contains("schema /robots/B1/row pitchboard_msgs/msg/RowB1 ros2msg "
                           "float64:source_time int32:decision_action_a int32:vision_working "
                           "float32:vision_ball_dist float64:truth_x float64:truth_yaw"));
  }

  /// Columns with a resolution are single precision there, behind the words and before the doubles.
  void roundedColumns() {
    const std::string path = m_folder.filePath("rounded.mcap").toStdString();
    auto writer = SessionWriter::create(path, sessionInfo());
    QVERIFY(writer);
    const GroupInfo group{
        "match",
        {{"COUNT", ColumnType::Int32, "", "", ColumnKind::Number, {}},
         {"EXACT", ColumnType::Float64, "m", "", ColumnKind::Number, {}},
         {"SPEED", ColumnType::Float64, "m/s", "", ColumnKind::Number, {}, 1.0 / 1024},
         {"ERROR", ColumnType::Float64, "cm", "", ColumnKind::Number, {}, 1.0 / 4}},
        {}};
    const auto id = (*writer)->addGroup(group);
    const std::uint32_t count = 5;
    const std::array values{0.1, 0.1, -7.3};
    (*writer)->append(id, {0.25, {&count, 1}, values});
    QVERIFY((*writer)->finish());
    const Output out = readOfficially(path);
    QVERIFY2(out.code == 0, out.error.constData());
    QVERIFY(out.lines.contains(
        "schema /match/row pitchboard_msgs/msg/Rowmatch ros2msg "
        "float64:source_time int32:count float32:speed float32:error float64:exact"));
    QCOMPARE(
        ofKind(out.lines, "row"),
        QList<QByteArray>{"row /match/row 0 " + times(0.25) + " " + hexOf(0.25) + " " + hexOf(5) +
                          " " + hexOf(102.0 / 1024) + " " + hexOf(-7.25) + " " + hexOf(0.1)});
  }

  void repaired() {
    const std::string whole = bytesOf(m_path);
    const std::string broken = m_folder.filePath("broken.mcap").toStdString();
    const std::string repairedPath = m_folder.filePath("repaired.mcap").toStdString();
    std::ofstream(broken, std::ios::binary) << whole.substr(0, whole.size() * 2 / 3);
    QVERIFY(repairSession(broken, repairedPath));
    const Output out = readOfficially(repairedPath);
    QVERIFY2(out.code == 0, out.error.constData());
    const auto rows = ofKind(out.lines, "row");
    QVERIFY(rows.size() > 500 && rows.size() < static_cast<qsizetype>(m_rows.size()));
    auto first = m_rows;
    first.resize(static_cast<std::size_t>(rows.size()));
    QVERIFY(rows == expected(first));
  }

  /// The official writer can leave messages in any order, and much out of the summary.
  void rewritten_data() {
    QTest::addColumn<QStringList>("how");
    QTest::newRow("topic by topic") << QStringList{"topics"};
    QTest::newRow("backwards") << QStringList{"backwards"};
    QTest::newRow("without chunks") << QStringList{"topics", "useChunks"};
    QTest::newRow("without channels in the summary") << QStringList{"topics", "repeatChannels"};
    QTest::newRow("without schemas in the summary") << QStringList{"topics", "repeatSchemas"};
    QTest::newRow("without metadata in the summary") << QStringList{"topics", "useMetadataIndex"};
    QTest::newRow("without statistics") << QStringList{"topics", "useStatistics"};
    QTest::newRow("without a summary")
        << QStringList{"backwards",     "repeatChannels",   "repeatSchemas",    "useStatistics",
                       "useChunkIndex", "useMetadataIndex", "useSummaryOffsets"};
  }
  void rewritten() {
    QFETCH(QStringList, how);
    const std::string path = m_folder.filePath("rewritten.mcap").toStdString();
    const Output out =
        run("rewrite_session.mjs",
            QStringList{QString::fromStdString(m_path), QString::fromStdString(path)} + how);
    QVERIFY2(out.code == 0, out.error.constData());
    const auto reader = SessionReader::open(path);
    QVERIFY2(reader->notes().empty(), reader->notes().empty() ? "" : reader->notes()[0].c_str());
    QVERIFY(reader->complete() && !reader->isForeign());
    QVERIFY(exported(path, ExportFormat::CsvWide) == exported(m_path, ExportFormat::CsvWide));
    QCOMPARE(exported(path, ExportFormat::CsvWide).count('\n'), 601);
  }

  /// A file of another program is that, whatever the program left out, and not damaged.
  void ofAnotherProgram_data() {
    QTest::addColumn<QStringList>("leftOut");
    QTest::newRow("everything") << QStringList{};
    QTest::newRow("without chunks") << QStringList{"useChunks"};
    QTest::newRow("without channels in the summary") << QStringList{"repeatChannels"};
    QTest::newRow("without a summary") << QStringList{
        "repeatChannels", "repeatSchemas", "useStatistics", "useChunkIndex", "useSummaryOffsets"};
  }
  void ofAnotherProgram() {
    QFETCH(QStringList, leftOut);
    const std::string path = m_folder.filePath("foreign.mcap").toStdString();
    const Output out =
        run("rewrite_session.mjs",
            QStringList{QString::fromStdString(m_path), QString::fromStdString(path), "foreign"} +
                leftOut);
    QVERIFY2(out.code == 0, out.error.constData());
    const auto reader = SessionReader::open(path);
    QVERIFY(reader->isForeign() && !reader->ours());
    QVERIFY(reader->check() && reader->complete() && !reader->isDamaged());
    QCOMPARE(reader->notes().size(), 1U);
    QVERIFY(reader->notes()[0].find("libmcap 1.1.0") != std::string::npos);
    const McapContents& contents = reader->file().contents();
    QCOMPARE(reader->otherChannels().size(), 2U);
    for (const std::uint16_t id : reader->otherChannels()) {
      QCOMPARE(contents.statistics.perChannel.at(id), 1000U);
    }
    const McapChannel& battery = contents.channels.at(reader->otherChannels()[0]);
    QCOMPARE(battery.topic, std::string("/battery"));
    QCOMPARE(contents.schemas.at(battery.schema).name, std::string("std_msgs/msg/Float64"));
  }

  // The check is able to fail: one flipped bit anywhere is found.
  void damaged_data() {
    QTest::addColumn<double>("part");
    QTest::newRow("in a chunk") << 0.5;
    QTest::newRow("in the summary") << 0.99;
  }
  void damaged() {
    QFETCH(double, part);
    std::string bytes = bytesOf(m_path);
    bytes[static_cast<std::size_t>(static_cast<double>(bytes.size()) * part)] ^= 1;
    const std::string path = m_folder.filePath("damaged.mcap").toStdString();
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    QVERIFY(readOfficially(path).code != 0);
  }
};

PITCHBOARD_TEST(TestMcapReaders)

}  // namespace tst_mcap_readers

#include "tst_mcap_readers.moc"

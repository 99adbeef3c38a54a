// SPDX-License-Identifier: GPL-3.0-or-later
// The flight recorder of pitchboard-agent with made-up readings and a made-up clock: what is in its
// files is what was read, whatever happens to blackboard and disk.
#include <QDir>
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include <agent/recorder.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/live/attached_robots.h>
#include <telemetry/session/session_reader.h>

#include "../support/segment_keys.h"
#include "../support/small_disk.h"

namespace tst_agent_recorder {

using namespace pitchboard;
using namespace pitchboard::agent;
using link::VariableCatalog;

namespace {

using Words = std::vector<std::uint32_t>;

constexpr Time begin = std::chrono::hours(7);  // a robot's clock may start anywhere
constexpr Time second = std::chrono::seconds(1);
const std::size_t columns = VariableCatalog::published().variables().size();

struct Reading {
  Time at;
  Words words;
};

/// As a file has them.
Words withHoles(Words words) {
  link::BoardColumns(VariableCatalog::published()).makeHoles(words);
  return words;
}

Result<Recorder> start(RecordOptions options) {
  options.robot = 3;
  options.key = 300;
  // Made-up time is faster than the disk.
  options.writer.waitWhenFull = true;
  options.writer.queueBytes = 60'000;
  return Recorder::start(options, VariableCatalog::published(), {}, begin);
}

std::vector<Reading> rowsOf(const std::string& path) {
  std::vector<Reading> rows;
  const auto session = telemetry::SessionReader::open(path);
  if (!session) return rows;
  session->rows({-1e18, 1e18}, {}, [&](telemetry::GroupId, const telemetry::RowView& row) {
    rows.push_back(
        {begin + Time(std::llround(row.time * 1e6)), {row.words.begin(), row.words.end()}});
    return true;
  });
  return rows;
}

/// Values that change now and then, some together and some often; some are "not seen".
class Script {
 public:
  explicit Script(double rate) : m_step(Time::rep(1e6 / rate)) {}
  const Reading& next() {
    m_now.words.resize(columns);
    if (m_random() % 4 == 0) {
      const std::size_t count = 1 + m_random() % 20;
      for (std::size_t i = 0; i < count; ++i) {
        m_now.words[m_random() % columns] =
            m_random() % 3 == 0 ? notSeen : static_cast<std::uint32_t>(m_random() >> 8);
      }
    }
    m_now.at += m_step;
    return m_now;
  }

 private:
  static constexpr auto notSeen = std::bit_cast<std::uint32_t>(-999.0F);
  Time m_step;
  std::mt19937 m_random{44};
  Reading m_now{begin, {}};
};

/// Why the rows are not these readings; empty if they are.
QString whyOthers(const std::vector<Reading>& rows, const std::vector<Reading>& readings) {
  std::map<Time, Words> read;
  for (const Reading& one : readings) read[one.at] = withHoles(one.words);
  std::size_t next = 0;
  for (const Reading& row : rows) {
    if (!read.contains(row.at)) return QStringLiteral("row at %1 us").arg(row.at.count());
  }
  for (const auto& [at, words] : read) {
    while (next < rows.size() && rows[next].at <= at) ++next;
    if (next == 0) return QStringLiteral("nothing at the beginning");
    if (rows[next - 1].words != words) return QStringLiteral("reading at %1 us").arg(at.count());
  }
  return {};
}

}  // namespace

class TestAgentRecorder : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  int m_number = 0;

  std::string newPath() {
    return m_folder.filePath(QStringLiteral("%1.mcap").arg(++m_number)).toStdString();
  }
  QString newFolder() {
    const QString folder = m_folder.filePath(QString::number(++m_number));
    if (!QDir().mkpath(folder)) qFatal("no folder");
    return folder;
  }

 private slots:
  void everyChangeIsInTheFile_data() {
    QTest::addColumn<int>("rate");
    for (const int rate : {1, 100, 500}) QTest::addRow("%d Hz", rate) << rate;
  }
  void everyChangeIsInTheFile() {
    QFETCH(int, rate);
    RecordOptions options;
    options.path = newPath();
    options.rate = rate;
    options.fileTime = std::chrono::hours(24);
    auto recorder = start(options);
    QVERIFY2(recorder, recorder ? "" : recorder.error().text().c_str());
    Script script(rate);
    std::vector<Reading> readings;
    std::size_t changes = 0;
    for (int i = 0; i < 10'000; ++i) {
      const Words before = readings.empty() ? Words() : readings.back().words;
      readings.push_back(script.next());
      if (readings.back().words != before) ++changes;
      QCOMPARE(recorder->take(readings.back().at, readings.back().words), std::string());
    }
    QVERIFY(recorder->finish());
    const auto rows = rowsOf(options.path);
    QCOMPARE(whyOthers(rows, readings), QString());
    // A change is two rows, the end of the old values and the beginning of the new ones, and time
    // without a change a row a second.
    const auto seconds = static_cast<std::size_t>((readings.back().at - begin) / second);
    QVERIFY(changes > 2000);
    QVERIFY2(rows.size() <= 2 * changes + seconds + 2, qPrintable(QString::number(rows.size())));
    if (rate > 1) QVERIFY(rows.size() < readings.size() / 2);
  }

  void aRobotThatRestsCostsARowASecond() {
    RecordOptions options;
    options.path = newPath();
    auto recorder = start(options);
    QVERIFY(recorder);
    const Words words(columns, 7);
    for (int i = 0; i < 6000; ++i) (void)recorder->take(begin + i * second / 100, words);
    QVERIFY(recorder->finish());
    const auto rows = rowsOf(options.path);
    QVERIFY2(rows.size() >= 60 && rows.size() <= 61, qPrintable(QString::number(rows.size())));
    QVERIFY(rows.back().at >= begin + 59 * second);
  }

  void theGroupIsThatOfAnAttachedBlackboard() {
    RecordOptions options;
    options.path = newPath();
    auto recorder = start(options);
    QVERIFY(recorder);
    (void)recorder->take(begin, Words(columns));
    recorder->note(begin, "reading blackboard 300");
    QVERIFY(recorder->finish());
    const auto session = telemetry::SessionReader::open(options.path);
    QVERIFY(session && session->ours() && session->complete());
    QCOMPARE(session->groups().size(), std::size_t{1});
    telemetry::GroupInfo recorded = session->groups()[0].info;

    const int key = testKeyBase();
    const auto segment = link::SystemVSegments::open(key, link::AttachMode::AttachOrCreate);
    QVERIFY(segment);
    link::AttachedRobots robots([] { return 0.0; });
    link::AttachedBoard board;
    board.key = key;
    board.robot = 3;
    board.rate = 100.0;
    robots.set({board});
    std::optional<telemetry::GroupInfo> attached;
    const auto take = [&](const telemetry::GroupInfo& group, auto) { attached = group; };
    QTRY_VERIFY((robots.drainRows(take), attached));
    QCOMPARE(recorded.name, attached->name);
    QVERIFY(recorded.columns == attached->columns);
    QCOMPARE(recorded.robot->boardKey, std::optional(300));
    // What belongs to the key, and that a row comes only with a change.
    attached->robot->boardKey = recorded.robot->boardKey;
    attached->robot->uid = recorded.robot->uid;
    attached->robot->timeout_s = 2.0;
    QVERIFY(recorded.robot == attached->robot);
    QVERIFY(VariableCatalog::fromJson(*session->attachment("catalog.json"), "") ==
            VariableCatalog::published());
    QCOMPARE(session->info().source, std::string("live"));
    QCOMPARE(session->info().more.at("clock_us"), std::to_string(begin.count()));
    const auto age = std::chrono::system_clock::now() - session->info().start;
    QVERIFY(age >= age.zero() && age < std::chrono::hours(1));
    QCOMPARE(session->count(telemetry::SessionStream::Log), std::uint64_t{1});
  }

  void aBlackboardThatGoesLeavesAGapAndComesBackWhole() {
    RecordOptions options;
    options.path = newPath();
    auto recorder = start(options);
    QVERIFY(recorder);
    const Words words(columns, 7);
    for (int i = 0; i < 1000; ++i) {
      const bool isThere = i < 300 || i >= 700;
      (void)recorder->take(begin + i * second / 100, isThere ? words : Words());
    }
    QVERIFY(recorder->finish());
    const auto rows = rowsOf(options.path);
    const auto isGone = [](const Reading& row) {
      return row.at > begin + 3 * second && row.at < begin + 7 * second;
    };
    QVERIFY(std::ranges::none_of(rows, isGone));
    QVERIFY(std::ranges::any_of(rows, [&](const Reading& row) {
      return row.at == begin + 7 * second && row.words == withHoles(words);
    }));
  }

  void aLargeRecordingIsSeveralFiles() {
    RecordOptions options;
    options.path = newPath();
    options.fileBytes = 150'000;
    options.writer.chunkBytes = 20'000;
    auto recorder = start(options);
    QVERIFY(recorder);
    Script script(100.0);
    std::vector<Reading> readings;
    std::vector<std::string> paths{recorder->path()};
    while (paths.size() < 4) {
      readings.push_back(script.next());
      const std::string said = recorder->take(readings.back().at, readings.back().words);
      if (recorder->path() == paths.back()) continue;
      paths.push_back(recorder->path());
      QCOMPARE(said, "recording to " + paths.back());
    }
    QVERIFY(recorder->finish());
    QCOMPARE(paths[1], options.path.substr(0, options.path.size() - 5) + "-002.mcap");
    std::vector<Reading> all;
    for (const std::string& path : paths) {
      const auto rows = rowsOf(path);
      QVERIFY(!rows.empty() && QFileInfo(QString::fromStdString(path)).size() < 400'000);
      all.insert(all.end(), rows.begin(), rows.end());
      const auto session = telemetry::SessionReader::open(path);
      QVERIFY(session && session->complete());
      QCOMPARE(session->info().start, telemetry::SessionReader::open(paths[0])->info().start);
    }
    QCOMPARE(whyOthers(all, readings), QString());
  }

  // Also those of earlier starts, and nothing else in the folder.
  void theOldestFilesAreDeletedToStayBelow() {
    const QString folder = newFolder();
    QFile other(folder + "/robot30.mcap");
    QVERIFY(other.open(QIODevice::WriteOnly));
    RecordOptions options;
    options.path = folder.toStdString();
    options.fileBytes = 100'000;
    options.writer.chunkBytes = 20'000;
    std::vector<std::string> paths;
    for (int startNumber = 0; startNumber < 2; ++startNumber) {
      options.keepBytes = startNumber == 0 ? 0 : 500'000;
      auto recorder = start(options);
      QVERIFY(recorder);
      Script script(100.0);
      for (int files = 0; files < 8;) {
        if (paths.empty() || paths.back() != recorder->path()) {
          paths.push_back(recorder->path());
          ++files;
        }
        const Reading& one = script.next();
        (void)recorder->take(one.at, one.words);
      }
      QVERIFY(recorder->finish());
    }
    qint64 bytes = 0;
    const auto left = QDir(folder).entryInfoList({"robot3-*.mcap"});
    for (const QFileInfo& one : left) bytes += one.size();
    QVERIFY2(bytes <= 500'000, qPrintable(QString::number(bytes)));
    QVERIFY(left.size() >= 2 && left.size() < 8);
    QVERIFY(!QFile::exists(QString::fromStdString(paths.front())));
    QVERIFY(QFile::exists(QString::fromStdString(paths.back())));
    QVERIFY(other.exists());
  }

  void afterTwoHoursThereIsANewFile() {
    RecordOptions options;
    options.path = newPath();
    auto recorder = start(options);
    QVERIFY(recorder);
    const Words words(columns, 7);
    for (int i = 0; i < 3 * 3600; ++i) (void)recorder->take(begin + i * second, words);
    QVERIFY(recorder->finish());
    QVERIFY(recorder->path().ends_with("-002.mcap"));
  }

  void anExistingFileIsRefusedAndAFolderTakesMany() {
    RecordOptions options;
    options.path = newPath();
    QVERIFY(start(options)->finish());
    const QByteArray before = [&] {
      QFile file(QString::fromStdString(options.path));
      return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }();
    const auto again = start(options);
    QVERIFY(!again);
    QVERIFY(again.error().code == ErrorCode::Conflict);
    const QString error = QString::fromStdString(again.error().text());
    QVERIFY2(error.contains("choose another name, or give a folder"), qPrintable(error));
    QFile file(QString::fromStdString(options.path));
    QVERIFY(file.open(QIODevice::ReadOnly) && file.readAll() == before);

    const QString folder = newFolder();
    options.path = folder.toStdString();
    for (int i = 0; i < 3; ++i) QVERIFY(start(options)->finish());
    QCOMPARE(QDir(folder).entryList({"robot3-*.mcap"}).size(), 3);

    options.path = (folder + "/none/a.mcap").toStdString();
    const auto nowhere = start(options);
    QVERIFY(!nowhere && nowhere.error().code == ErrorCode::SystemError);
  }

  void aDiskThatIsAlmostFullEndsIt() {
    RecordOptions options;
    options.path = newPath();
    std::atomic<std::uint64_t> free = 1'000'000'000;
    options.writer.freeSpace = [&free] { return std::optional<std::uint64_t>(free); };
    options.writer.chunkInterval = std::chrono::milliseconds(1);
    auto recorder = start(options);
    QVERIFY(recorder);
    Script script(100.0);
    std::string said;
    const auto take = [&] {
      const Reading& one = script.next();
      return said += recorder->take(one.at, one.words);
    };
    for (int i = 0; i < 500; ++i) QCOMPARE(take(), std::string());
    free = 63'000'000;
    QTRY_VERIFY((take(), !recorder->isRecording()));
    QVERIFY2(said.find("only 63 MB left") != std::string::npos, said.c_str());
    QVERIFY(recorder->take(script.next().at, Words(columns)).empty());  // nothing, and no harm
    QVERIFY(recorder->finish());
    QVERIFY(rowsOf(options.path).size() > 100);
  }

  void aDiskThatFillsUpEndsItAndTheFileIsWhole() {
    std::optional<SmallDisk> disk(std::in_place, rlim_t{200'000});
    RecordOptions options;
    options.path = newPath();
    options.writer.chunkBytes = 20'000;
    auto recorder = start(options);
    QVERIFY(recorder);
    Script script(100.0);
    std::vector<Reading> readings;
    std::string said;
    while (recorder->isRecording()) {
      readings.push_back(script.next());
      said += recorder->take(readings.back().at, readings.back().words);
    }
    QVERIFY2(said.find("Recording stopped") == 0 && said.find(options.path) != std::string::npos,
             said.c_str());
    (void)recorder->finish();
    disk.reset();
    const auto rows = rowsOf(options.path);
    QVERIFY(rows.size() > 100);
    while (!readings.empty() && readings.back().at > rows.back().at) readings.pop_back();
    QCOMPARE(whyOthers(rows, readings), QString());
  }
};

PITCHBOARD_TEST(TestAgentRecorder)

}  // namespace tst_agent_recorder

#include "tst_agent_recorder.moc"

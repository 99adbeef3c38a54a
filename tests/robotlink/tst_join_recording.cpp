// SPDX-License-Identifier: GPL-3.0-or-later
// A robot's own recording is joined to a live session of the same match.
#include <QtTest>

#include <array>
#include <cmath>
#include <random>

#include <robotlink/live/board_facts.h>
#include <robotlink/session/join_recording.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/row_slot.h>
#include <telemetry/session/session_writer.h>

namespace tst_join_recording {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr double plantedOffset = -12.345, plantedDrift = 80e-6;
constexpr double minutes = 3.0;

/// The rows of one robot of a match, with the columns of its blackboard.
class RobotRows : public telemetry::RowSink {
 public:
  explicit RobotRows(std::string robot) : m_robot(std::move(robot)) {}
  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override {
    m_names.push_back(info.name);
    if (info.name == m_robot) {
      for (const telemetry::ColumnInfo& column : info.columns) {
        if (column.type != telemetry::ColumnType::Float64) columns.push_back(column);
      }
    }
    return static_cast<telemetry::GroupId>(m_names.size() - 1);
  }
  void append(telemetry::GroupId group, const telemetry::RowView& row) override {
    if (m_names[group] != m_robot) return;
    rows.emplace_back(row.time, std::vector(row.words.begin(), row.words.end()));
  }
  std::vector<telemetry::ColumnInfo> columns;
  std::vector<std::pair<double, std::vector<std::uint32_t>>> rows;

 private:
  std::string m_robot;
  std::vector<std::string> m_names;
};

std::shared_ptr<RobotRows> playedBy(const std::string& robot, std::uint64_t seed) {
  Scenario scenario = loadScenario("match-3v3").value();
  scenario.settings.seed = seed;
  scenario.stop = {};
  auto match = SimulatedMatch::create(scenario, {}).value();
  auto rows = std::make_shared<RobotRows>(robot);
  MatchSampler sampler(rows);
  for (int i = 0; i < static_cast<int>(minutes * 60.0 * 60.0); ++i) {
    match.tick();
    sampler.ticked(match, {});
  }
  return rows;
}

telemetry::SessionWriterOptions completely() {
  telemetry::SessionWriterOptions options;
  options.waitWhenFull = true;
  return options;
}

/// As pitchboard-agent records, on a clock that is off.
std::string ownRecording(const QTemporaryDir& folder, const RobotRows& played, int number) {
  const std::string path = folder.filePath("robot.mcap").toStdString();
  auto writer = telemetry::SessionWriter::create(path, {}, completely()).value();
  telemetry::GroupInfo group{"B" + std::to_string(number), played.columns};
  group.robot = factsOfBoard(100 * number, 100.0, number, TeamColor::Blue);
  const auto id = writer->addGroup(group);
  for (const auto& [time, words] : played.rows) {
    writer->append(id, {(time - plantedOffset) / (1.0 + plantedDrift), words, {}});
  }
  if (!writer->finish()) qFatal("not written");
  return path;
}

/// As Live records what was sent: 20 times a second, every fifth datagram is lost, and each comes
/// up to 5 ms late.
std::string liveSession(const QTemporaryDir& folder, const RobotRows& played, int number) {
  const std::string path = folder.filePath("live.mcap").toStdString();
  telemetry::SessionInfo info;
  info.source = "live";
  auto writer = telemetry::SessionWriter::create(path, info, completely()).value();
  telemetry::GroupInfo group{"R" + std::to_string(number), played.columns};
  group.columns.emplace_back().name = "AGENT_LOSS";
  group.robot.emplace();
  group.robot->slot = group.robot->number = number;
  group.robot->sentFrom = "10.0.0.3";
  const auto id = writer->addGroup(group);
  std::mt19937 random(4);
  const std::array<double, 1> loss{0.2};
  for (std::size_t i = 0; i < played.rows.size(); i += 3) {
    if (random() % 5 == 0) continue;
    const double late = 0.005 * static_cast<double>(random() % 1000) / 1000.0;
    writer->append(id, {played.rows[i].first + late, played.rows[i].second, loss});
  }
  writer->append(telemetry::SessionEvent{30.0, "bookmark", "", "here"});
  if (!writer->finish()) qFatal("not written");
  return path;
}

}  // namespace

class TestJoinRecording : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  std::shared_ptr<RobotRows> m_played;
  std::string m_own, m_live;

 private slots:
  void initTestCase() {
    m_played = playedBy("B1", 5);
    m_own = ownRecording(m_folder, *m_played, 1);
    m_live = liveSession(m_folder, *m_played, 1);
  }

  /// A change lies within 50 ms of sampling (100 ms beside a lost datagram), so its time is known
  /// to some 20 ms; the mean of thousands is far better.
  void findsOffsetAndDriftAndKeepsEveryValue() {
    const std::string joined = m_folder.filePath("joined.mcap").toStdString();
    const auto report = joinRecording(m_live, m_own, joined, {});
    if (!report) QFAIL(report.error().text().c_str());
    const ClockFit& clock = report->clock;
    QVERIFY2(std::abs(clock.offset - plantedOffset) < 0.010, report->summary().c_str());
    QVERIFY2(std::abs(clock.drift - plantedDrift) < 20e-6, report->summary().c_str());
    QVERIFY2(clock.residual < 0.030 && clock.changes > 1000, report->summary().c_str());
    QCOMPARE(report->robot, std::string("R1"));
    QCOMPARE(report->rows, m_played->rows.size());
    QVERIFY(report->replaced > 2000);

    const auto session = telemetry::SessionReader::open(joined).value();
    QCOMPARE(session.groups().size(), std::size_t{1});
    const telemetry::GroupInfo& group = session.groups()[0].info;
    QCOMPARE(group.name, std::string("R1"));
    std::size_t next = 0;
    const RowSlot loss = findSlot(group, {"AGENT_LOSS"});
    session.rows({-1e18, 1e18}, {}, [&](telemetry::GroupId, const telemetry::RowView& row) {
      const auto& [time, words] = m_played->rows[next++];
      // Where it was in the match, to some milliseconds.
      if (std::abs(row.time - time) > 0.015) qFatal("%f instead of %f", row.time, time);
      for (std::size_t i = 0; i < words.size(); ++i) {
        if (row.words[i] != words[i]) qFatal("another value of %s", group.columns[i].name.c_str());
      }
      return loss.read(row) == 0.2 || next < 10;
    });
    QCOMPARE(next, m_played->rows.size());
    QCOMPARE(session.events().size(), std::size_t{1});
  }

  void takesOffsetAndDriftThatAreGiven() {
    const std::string joined = m_folder.filePath("given.mcap").toStdString();
    JoinOptions options;
    options.offset = -12.0;
    options.drift = 1e-4;
    const auto report = joinRecording(m_live, m_own, joined, options);
    QVERIFY(report.has_value());
    QVERIFY(QString::fromStdString(report->summary()).contains("as given"));
    const double last = (m_played->rows.back().first - plantedOffset) / (1.0 + plantedDrift);
    const auto session = telemetry::SessionReader::open(joined).value();
    QVERIFY(std::abs(session.range()->end - (last * (1.0 + 1e-4) - 12.0)) < 1e-6);
  }

  /// Where the robot did not record, the received values stay.
  void keepsTheRestOfTheSession() {
    RobotRows part("B1");
    part.columns = m_played->columns;
    part.rows.assign(m_played->rows.begin() + 3600, m_played->rows.begin() + 7200);
    QTemporaryDir folder;
    const std::string joined = folder.filePath("joined.mcap").toStdString();
    const auto report = joinRecording(m_live, ownRecording(folder, part, 1), joined, {});
    if (!report) QFAIL(report.error().text().c_str());
    QVERIFY(std::abs(report->clock.offset - plantedOffset) < 0.015);
    const auto before = telemetry::SessionReader::open(m_live).value();
    const auto after = telemetry::SessionReader::open(joined).value();
    QCOMPARE(after.groups()[0].rows, before.groups()[0].rows - report->replaced + report->rows);
    QCOMPARE(after.range()->begin, before.range()->begin);
    QCOMPARE(after.range()->end, before.range()->end);
  }

  void refusesAnotherMatchOrRobot_data() {
    QTest::addColumn<QString>("robot");
    QTest::addColumn<int>("seed");
    QTest::newRow("another match") << "B1" << 6;
    QTest::newRow("another robot") << "B2" << 5;
  }
  void refusesAnotherMatchOrRobot() {
    QFETCH(QString, robot);
    QFETCH(int, seed);
    QTemporaryDir folder;
    const auto other = playedBy(robot.toStdString(), static_cast<std::uint64_t>(seed));
    const std::string joined = folder.filePath("joined.mcap").toStdString();
    const auto report = joinRecording(m_live, ownRecording(folder, *other, 1), joined, {});
    QVERIFY(!report);
    QVERIFY2(QString::fromStdString(report.error().message).contains("different robots"),
             report.error().text().c_str());
    QVERIFY(!QFile::exists(QString::fromStdString(joined)));
  }

  void namesTheRobotsThereAre() {
    QTemporaryDir folder;
    const std::string joined = folder.filePath("joined.mcap").toStdString();
    const auto wrong = joinRecording(m_live, ownRecording(folder, *m_played, 4), joined, {});
    QVERIFY(!wrong);
    QVERIFY(QString::fromStdString(wrong.error().message).contains("--robot: R1"));
    JoinOptions options;
    options.robot = "R1";
    QVERIFY(joinRecording(m_live, folder.filePath("robot.mcap").toStdString(), joined, options));
  }
};

PITCHBOARD_TEST(TestJoinRecording)

}  // namespace tst_join_recording

#include "tst_join_recording.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// A robot's own recording is joined to a live session of the same match.
#include <QtTest>

#include <robotlink/session/join_recording.h>

#include "../support/joined_recordings.h"

namespace tst_join_recording {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace joined_recordings;

namespace {

constexpr double length = 180.0;  // s

std::string ownRecording(const QTemporaryDir& folder, const PlayedRows& played, int number) {
  const std::string path = folder.filePath("robot.mcap").toStdString();
  writeOwn(path, played, number);
  return path;
}

std::string liveSession(const QTemporaryDir& folder, const PlayedRows& played, int number) {
  const std::string path = folder.filePath("live.mcap").toStdString();
  LiveSession session(path);
  session.addBoard("R" + std::to_string(number), number, played);
  session.finish();
  return path;
}

/// The rows of a group, without those of the columns that only the session has.
struct Values {
  std::vector<double> times;
  std::vector<std::vector<std::uint32_t>> words;
};
Values valuesOf(const std::string& path, const std::string& group) {
  const auto session = telemetry::SessionReader::open(path).value();
  Values all;
  for (telemetry::GroupId id = 0; id < session.groups().size(); ++id) {
    if (session.groups()[id].info.name != group) continue;
    const std::array<telemetry::GroupId, 1> only{id};
    session.rows({-1e18, 1e18}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
      all.times.push_back(row.time);
      all.words.emplace_back(row.words.begin(), row.words.end());
      return true;
    });
  }
  return all;
}

QString message(const Result<JoinReport>& report) {
  return report ? QStringLiteral("no error") : QString::fromStdString(report.error().text());
}

}  // namespace

class TestJoinRecording : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  std::shared_ptr<PlayedRows> m_played;
  std::string m_own, m_live;

 private slots:
  void initTestCase() {
    m_played = playedBy("B1", 5, length);
    m_own = ownRecording(m_folder, *m_played, 1);
    m_live = liveSession(m_folder, *m_played, 1);
  }

  /// A change lies within 50 ms of sampling (100 ms beside a lost datagram), so its time is known
  /// to some 20 ms; the mean of thousands is far better.
  void findsOffsetAndDriftAndKeepsEveryValue() {
    const std::string joined = m_folder.filePath("joined.mcap").toStdString();
    const auto report = joinRecording(m_live, m_own, joined, {});
    if (!report) QFAIL(report.error().text().c_str());
    const RobotClock& clock = report->clock;
    QVERIFY2(std::abs(clock.offset - plantedOffset) < 0.010, report->summary().c_str());
    QVERIFY2(std::abs(clock.drift - plantedDrift) < 20e-6, report->summary().c_str());
    const ClockAgreement& agreed = report->agreement;
    QVERIFY2(agreed.residual < 0.030 && agreed.agree > 1000 && agreed.share() > 0.6,
             report->summary().c_str());
    QVERIFY(report->fit && report->fit->offsetError < 0.002 && report->fit->driftError < 20e-6);
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

  /// Where the robot did not record, the received values stay: before, after, and while it had no
  /// blackboard for ten seconds.
  void keepsTheRestOfTheSession() {
    PlayedRows part = partOf(*m_played, 3600, 7200);
    part.rows.erase(part.rows.begin() + 1200, part.rows.begin() + 1800);
    QTemporaryDir folder;
    const std::string joined = folder.filePath("joined.mcap").toStdString();
    const auto report = joinRecording(m_live, ownRecording(folder, part, 1), joined, {});
    if (!report) QFAIL(report.error().text().c_str());
    QVERIFY(std::abs(report->clock.offset - plantedOffset) < 0.015);
    const Values before = valuesOf(m_live, "R1"), after = valuesOf(joined, "R1");
    QCOMPARE(after.times.size(), before.times.size() - report->replaced + report->rows);
    QCOMPARE(after.times.front(), before.times.front());
    QCOMPARE(after.times.back(), before.times.back());
    const auto count = [](const Values& values, double from, double until) {
      return std::ranges::count_if(values.times, [=](double t) { return t > from && t < until; });
    };
    const double gap = m_played->rows[4800].first + 0.1;
    QVERIFY(count(before, gap, gap + 9.8) > 100);
    QCOMPARE(count(after, gap, gap + 9.8), count(before, gap, gap + 9.8));
  }

  /// Whichever of its files is named. A file of an earlier start, whose clock is another one, and
  /// one that cannot be read do not belong to it.
  void joinsAllFilesOfARecordingAsOne_data() {
    QTest::addColumn<QString>("named");
    QTest::newRow("the first") << "flight.mcap";
    QTest::newRow("another") << "flight-003.mcap";
  }
  void joinsAllFilesOfARecordingAsOne() {
    QFETCH(QString, named);
    QTemporaryDir folder;
    const auto path = [&folder](const char* name) { return folder.filePath(name).toStdString(); };
    writeOwn(path("flight.mcap"), partOf(*m_played, 0, 4000), 1, 1, "5000000");
    // Each file begins with the newest values of the one before.
    writeOwn(path("flight-002.mcap"), partOf(*m_played, 3999, 7000), 1, 2, "5000000");
    writeOwn(path("flight-003.mcap"), partOf(*m_played, 6999, 20000), 1, 3, "5000000");
    writeOwn(path("flight-004.mcap"), partOf(*m_played, 0, 300), 1, 4, "7000000");
    QFile empty(folder.filePath("flight-005.mcap"));
    QVERIFY(empty.open(QIODevice::WriteOnly) && empty.write("nothing") > 0);
    empty.close();
    const std::string joined = path("joined.mcap");
    const auto report = joinRecording(m_live, path(qPrintable(named)), joined, {});
    QVERIFY2(report, qPrintable(message(report)));
    QCOMPARE(report->files, std::size_t{3});
    QCOMPARE(report->rows, m_played->rows.size());
    QCOMPARE(report->notes.size(), std::size_t{1});
    QVERIFY2(report->notes[0].starts_with("flight-005.mcap is left out"), report->notes[0].c_str());
    const Values all = valuesOf(joined, "R1");
    QCOMPARE(all.times.size(), m_played->rows.size());
    for (std::size_t i = 0; i < all.words.size(); ++i) {
      QVERIFY(std::ranges::equal(m_played->rows[i].second, all.words[i]));
      QVERIFY(i == 0 || all.times[i] > all.times[i - 1]);
    }
    // Without the one in the middle, what was received then stays.
    QVERIFY(QFile::remove(folder.filePath("flight-002.mcap")));
    JoinOptions again;
    again.replace = true;
    const auto without = joinRecording(m_live, path(qPrintable(named)), joined, again);
    QVERIFY2(without, qPrintable(message(without)));
    QCOMPARE(without->files, std::size_t{2});
    QCOMPARE(without->notes.size(), std::size_t{2});
    QVERIFY2(without->notes[1].find("flight-003.mcap a file of the recording is missing") !=
                 std::string::npos,
             without->notes[1].c_str());
    const std::uint64_t received = valuesOf(m_live, "R1").times.size();
    QVERIFY(without->replaced > received / 2 && received - without->replaced > 600);
  }

  /// Nobody received the robot's blackboard, but its messages: a few variables, rounded, twice a
  /// second. A robot of the other team has the same number.
  void joinsToTheMessagesOfTheRobot() {
    QTemporaryDir folder;
    const std::string live = folder.filePath("live.mcap").toStdString();
    LiveSession session(live);
    session.addMessages("Red 1", 1, *playedBy("R1", 5, length));
    session.addMessages("Blue 1", 1, *m_played);
    session.finish();
    const std::string joined = folder.filePath("joined.mcap").toStdString();
    const auto report = joinRecording(live, m_own, joined, {});
    QVERIFY2(report, qPrintable(message(report)));
    QCOMPARE(report->robot, std::string("Blue 1"));
    QVERIFY2(std::abs(report->clock.offset - plantedOffset) < 0.03, report->summary().c_str());
    QVERIFY2(std::abs(report->clock.drift - plantedDrift) < 200e-6, report->summary().c_str());
    QVERIFY2(report->replaced == 0 && report->summary().find("beside its messages") > 0,
             report->summary().c_str());
    // As in Live, the variables have the robot's name.
    QCOMPARE(valuesOf(joined, "Blue 1").times.size(), m_played->rows.size());
    QCOMPARE(valuesOf(joined, "Blue 1 telemetry").times, valuesOf(live, "Blue 1").times);
    QCOMPARE(valuesOf(joined, "Red 1").times, valuesOf(live, "Red 1").times);
    const auto made = telemetry::SessionReader::open(joined).value();
    for (const telemetry::SessionGroup& group : made.groups()) {
      if (group.info.name == "Blue 1") {
        QVERIFY(isBoardGroup(group.info));
        QCOMPARE(factsOf(group.info).uid, RobotUid{8});
      } else if (group.info.name == "Blue 1 telemetry") {
        QCOMPARE(factsOf(group.info).linkOf, std::string("Blue 1"));
      }
    }
    // The rest of the recording can be joined to it again.
    QVERIFY(joinRecording(joined, m_own, folder.filePath("again.mcap").toStdString(), {}));
  }

  /// What the dialog shows while somebody sets the clock by hand.
  void tellsHowWellAClockAgrees() {
    const auto session = telemetry::SessionReader::open(m_live).value();
    const auto recording = RobotRecording::open(m_own).value();
    const auto compared = compareTarget(session, recording, {});
    QVERIFY(compared && compared->fit);
    const RobotClock found = compared->fit->clock;
    const ClockAgreement best = compared->comparison.agreement(found);
    QVERIFY(best.points.size() <= ClockAgreement::maxPoints && best.points.size() > 300);
    RobotClock off = found;
    off.offset += 0.1;
    const ClockAgreement later = compared->comparison.agreement(off);
    QVERIFY2(std::abs(later.residual - 0.1) < 0.02, later.text().c_str());
    off.offset += 100.0;
    QVERIFY(compared->comparison.agreement(off).share() < 0.1);
    // A wrong drift tilts the points: 1000 ppm are 180 ms in three minutes.
    RobotClock tilted = found;
    tilted.drift += 1e-3;
    tilted.offset -= 1e-3 * recording.range().begin;
    const auto points = compared->comparison.agreement(tilted).points;
    double first = 0.0, last = 0.0;
    const std::size_t few = points.size() / 10;
    for (std::size_t i = 0; i < few; ++i) {
      first += points[i].apart / static_cast<double>(few);
      last += points[points.size() - 1 - i].apart / static_cast<double>(few);
    }
    QVERIFY2(std::abs(first - last - 0.16) < 0.03, qPrintable(QString::number(first - last)));
    // It can be cancelled while it reads.
    const auto cancelled = compareTarget(session, recording, {}, [] { return false; });
    QVERIFY(!cancelled && cancelled.error().code == ErrorCode::Conflict);
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
    const auto other = playedBy(robot.toStdString(), static_cast<std::uint64_t>(seed), length);
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

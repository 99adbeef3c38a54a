// SPDX-License-Identifier: GPL-3.0-or-later
// How long the disk has room, and what is said of it in time.
#include <QTemporaryDir>
#include <QtTest>

#include <telemetry/session/recording_health.h>

#include "write_rate.h"

namespace tst_recording_health {

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

SessionStatus status(double gigabytesFree, double bytesPerSecond) {
  SessionStatus made;
  made.freeBytes = static_cast<std::uint64_t>(gigabytesFree * 1e9);
  made.bytesPerSecond = bytesPerSecond;
  return made;
}

bool hasText(const SessionStatus& of, const char* words) {
  return troubleText(of).find(words) != std::string::npos;
}

}  // namespace

class TestRecordingHealth : public QObject {
  Q_OBJECT

 private slots:
  void theRateIsThatOfTheLastMinute() {
    WriteRate rate;
    QCOMPARE(rate.bytesPerSecond(), 0.0);
    rate.note(100.0, 1000);
    rate.note(101.0, 5000);
    QCOMPARE(rate.bytesPerSecond(), 0.0);  // too short to judge by
    for (int second = 2; second <= 200; ++second) {
      rate.note(100.0 + second, 5000 + static_cast<std::uint64_t>(second) * 100);
    }
    QVERIFY(std::abs(rate.bytesPerSecond() - 100.0) < 1e-9);
    for (int second = 201; second <= 300; ++second) {
      rate.note(100.0 + second, 25'000 + static_cast<std::uint64_t>(second - 200) * 2000);
    }
    QVERIFY(std::abs(rate.bytesPerSecond() - 2000.0) < 1e-9);
  }

  void theDiskIsFullInMinutes() {
    const SessionStatus soon = status(1.2, 1.2e9 / 600);
    QCOMPARE(secondsLeft(soon).value(), 600.0);
    QCOMPARE(troubleOf(soon), RecordingTrouble::LittleSpace);
    QVERIFY(hasText(soon, "The disk will be full in 10 min (1.2 GB free): free some space"));
    QCOMPARE(troubleOf(status(1.2, 1.2e9 / 3600)), RecordingTrouble::None);
    QCOMPARE(troubleText(status(1.2, 1.2e9 / 3600)), std::string());
    // Little room is enough for a recording that hardly grows, and alarming while that is not
    // known.
    QCOMPARE(troubleOf(status(0.01, 10.0)), RecordingTrouble::None);
    QVERIFY(hasText(status(0.01, 0.0), "The disk is nearly full (10 MB free)"));
    QCOMPARE(troubleOf(SessionStatus()), RecordingTrouble::None);  // the system does not say
  }

  void freeSpaceIsReportedInPlainWords() {
    QCOMPARE(freeSpaceText(SessionStatus()), std::string());
    QCOMPARE(freeSpaceText(status(52.34, 0.0)), std::string("52.3 GB free"));
    QCOMPARE(freeSpaceText(status(0.4, 0.0)), std::string("400 MB free"));
    QCOMPARE(freeSpaceText(status(12.0, 1e6)), std::string("3 h 20 min until the disk is full"));
    QCOMPARE(freeSpaceText(status(0.06, 1e6)), std::string("1 min until the disk is full"));
    QCOMPARE(freeSpaceText(status(0.05, 1e6)),
             std::string("less than a minute until the disk is full"));
    QCOMPARE(freeSpaceText(status(500.0, 1e6)),
             std::string("more than 2 days until the disk is full"));
  }

  void unflushedAndMissingDataAreReported() {
    SessionStatus of = status(100.0, 1e3);
    of.syncLatency = 1.0;
    QCOMPARE(troubleOf(of), RecordingTrouble::None);
    of.syncLatency = 9.6;
    QCOMPARE(troubleOf(of), RecordingTrouble::DiskBehind);
    QVERIFY(hasText(of, "cannot keep up: no write has finished for 10 s"));
    of.dropped = 7;
    QVERIFY(hasText(of, "7 rows and messages are missing"));
    of.syncLatency = 0.0;
    QCOMPARE(troubleOf(of), RecordingTrouble::Dropped);
    QVERIFY(hasText(of, "The disk could not keep up: 7 rows"));
  }

  void aRecordingReportsFreeSpace() {
    const QTemporaryDir folder;
    std::atomic<std::uint64_t> free = 5'000'000'000;
    SessionWriterOptions options;
    options.chunkInterval = std::chrono::milliseconds(10);
    options.freeSpace = [&free] { return std::optional<std::uint64_t>(free.load()); };
    const auto writer =
        SessionWriter::create(folder.filePath(QStringLiteral("a.mcap")).toStdString(), {}, options);
    QVERIFY(writer);
    QCOMPARE((*writer)->status().freeBytes.value(), std::uint64_t(5'000'000'000));
    QCOMPARE(troubleOf((*writer)->status()), RecordingTrouble::None);
    free = 9'000'000;
    QTRY_COMPARE(troubleOf((*writer)->status()), RecordingTrouble::LittleSpace);
    QVERIFY((*writer)->finish());
    // Without a source of one's own the file system is asked.
    const auto real =
        SessionWriter::create(folder.filePath(QStringLiteral("b.mcap")).toStdString(), {});
    QVERIFY(real && (*real)->status().freeBytes.value_or(0) > 0);
  }
};

PITCHBOARD_TEST(TestRecordingHealth)

}  // namespace tst_recording_health

#include "tst_recording_health.moc"

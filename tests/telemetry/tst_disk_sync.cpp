// SPDX-License-Identifier: GPL-3.0-or-later
// A disk that stalls or fails: whoever writes does not wait, and is told.
#include <QtTest>
#include <semaphore>

#include "disk_sync.h"

namespace tst_disk_sync {

using namespace pitchboard;
using pitchboard::telemetry::DiskSync;

class TestDiskSync : public QObject {
  Q_OBJECT

 private slots:
  void aStalledDiskBlocksNoThread() {
    std::counting_semaphore<> begun{0}, answer{0};
    std::atomic<int> calls = 0;
    DiskSync disk([&]() -> Result<void> {
      ++calls;
      begun.release();
      answer.acquire();
      return {};
    });
    QCOMPARE(disk.syncLatency(), 0.0);
    QVERIFY(disk.request());
    begun.acquire();
    // However much is written meanwhile, the disk is asked once more.
    for (int i = 0; i < 1000; ++i) QVERIFY(disk.request());
    QCOMPARE(calls, 1);
    const double owed = disk.syncLatency();
    QVERIFY(owed > 0.0);
    QTRY_VERIFY(disk.syncLatency() > owed);
    answer.release();
    begun.acquire();
    answer.release();
    QTRY_COMPARE(disk.syncLatency(), 0.0);
    QCOMPARE(calls, 2);
  }

  void finishWaitsForWhatWasWritten() {
    std::atomic<int> written = 0, kept = 0;
    DiskSync disk([&]() -> Result<void> {
      kept = written.load();
      return {};
    });
    for (int i = 1; i <= 200; ++i) {
      written = i;
      QVERIFY(disk.finish());
      QCOMPARE(kept, i);
    }
  }

  void anErrorIsReportedAndStays() {
    DiskSync disk(
        []() -> Result<void> { return failure(ErrorCode::SystemError, "The disk is gone."); });
    const auto finished = disk.finish();
    QVERIFY(!finished);
    QCOMPARE(finished.error().message, std::string("The disk is gone."));
    const auto asked = disk.request();
    QVERIFY(!asked);
    QCOMPARE(asked.error().message, std::string("The disk is gone."));
  }
};

PITCHBOARD_TEST(TestDiskSync)

}  // namespace tst_disk_sync

#include "tst_disk_sync.moc"

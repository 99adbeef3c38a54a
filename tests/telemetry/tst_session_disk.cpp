// SPDX-License-Identifier: GPL-3.0-or-later
// A session file while it is written: a full disk, a removed file, a full queue.

#include <unistd.h>
#include <QtTest>
#include <filesystem>
#include <optional>

#include "../support/small_disk.h"
#include "session_rig.h"

namespace tst_session_disk {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

class TestSessionDisk : public QObject, private NewSessions {
  Q_OBJECT

 private slots:
  void diskFull() {
    // A file that may not grow beyond this is what a full disk looks like to a program.
    std::optional<SmallDisk> disk(std::in_place, rlim_t{60'000});
    const std::string path = newPath();
    auto options = smallChunks();
    options.sync = false;
    auto writer = SessionWriter::create(path, sessionInfo(), options);
    options.waitWhenFull = true;
    std::vector<Row> rows = record(**writer, 3000);
    const auto finished = (*writer)->finish();
    disk.reset();
    QVERIFY(!finished);
    const SessionStatus status = (*writer)->status();
    QVERIFY(!status.recording);
    QVERIFY2(status.problem.find("Recording stopped") == 0, status.problem.c_str());
    append(**writer, rows[0]);  // does nothing, and harms nothing
    const auto reader = SessionReader::open(path);
    QVERIFY(reader);
    const auto found = rowsOf(*reader, everything);
    QVERIFY(found.size() > 100 && found.size() < rows.size());
    rows.resize(found.size());
    QVERIFY(found == rows);
  }

  void diskFullOnARealFileSystem() {
    if (geteuid() != 0) QSKIP("only root may mount");
    QTemporaryDir mount;
    const QString folder = mount.path();
    if (QProcess::execute("mount", {"-t", "tmpfs", "-o", "size=400k", "tmpfs", folder}) != 0) {
      QSKIP("this machine does not mount");
    }
    const std::string path = (folder + "/full.mcap").toStdString();
    auto writer = SessionWriter::create(path, sessionInfo(), smallChunks());
    std::vector<Row> rows;
    std::string problem;
    bool complete = false;
    std::vector<Row> found;
    if (writer) {
      rows = record(**writer, 30'000);
      (void)(*writer)->finish();
      problem = (*writer)->status().problem;
      if (const auto reader = SessionReader::open(path)) {
        complete = reader->complete();
        found = rowsOf(*reader, everything);
      }
    }
    QProcess::execute("umount", {folder});
    QVERIFY2(problem.find("The disk is full") != std::string::npos, problem.c_str());
    QVERIFY(complete);  // room for the summary was kept
    QVERIFY(found.size() > 100 && found.size() < rows.size());
    rows.resize(found.size());
    QVERIFY(found == rows);
  }

  void removedFile() {
    const std::string path = newPath();
    auto options = smallChunks();
    options.chunkInterval = std::chrono::milliseconds(10);
    auto writer = SessionWriter::create(path, sessionInfo(), options);
    record(**writer, 10);
    std::filesystem::remove(path);
    int tick = 10;
    QTRY_VERIFY_WITH_TIMEOUT((append(**writer, rowOf(0, tick++)), !(*writer)->status().recording),
                             30000);
    QVERIFY((*writer)->status().problem.find("removed") != std::string::npos);
    QVERIFY(!(*writer)->finish());
  }

  void fullQueueIsCounted() {
    const std::string path = newPath();
    SessionWriterOptions options;
    options.queueBytes = 20'000;
    options.chunkInterval = std::chrono::seconds(1000);
    auto writer = SessionWriter::create(path, sessionInfo(), options);
    const auto rows = record(**writer, 1000);
    const SessionStatus status = (*writer)->status();
    QVERIFY(status.dropped > 1000);
    QVERIFY((*writer)->finish());
    const auto reader = SessionReader::open(path);
    const auto found = rowsOf(*reader, everything);
    QCOMPARE(found.size() + reader->events().size(), status.rows + status.messages);
    auto place = rows.begin();
    for (const Row& row : found) {  // whole rows, in order, with gaps
      place = std::find(place, rows.end(), row);
      QVERIFY(place != rows.end());
      ++place;
    }
  }

  void waitsWhenAskedTo() {
    SessionWriterOptions options = smallChunks();
    options.queueBytes = 10'000;
    options.waitWhenFull = true;
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), options);
    const auto rows = record(**writer, 3000);
    QVERIFY((*writer)->finish());
    QCOMPARE((*writer)->status().dropped, 0U);
    QVERIFY(rowsOf(*SessionReader::open(path), everything) == rows);
  }

  void onDiskWithinASecond() {
    const std::string path = newPath();
    auto writer = SessionWriter::create(path, sessionInfo());
    const auto rows = record(**writer, 10);
    QTRY_VERIFY_WITH_TIMEOUT(rowsOf(*SessionReader::open(path), everything) == rows, 30'000);
    QVERIFY(!SessionReader::open(path)->complete());
  }
};

PITCHBOARD_TEST(TestSessionDisk)

}  // namespace tst_session_disk

#include "tst_session_disk.moc"

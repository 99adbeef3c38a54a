// SPDX-License-Identifier: GPL-3.0-or-later
// A recording process is killed at random moments: every file repairs and lacks the last second at
// most.

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <random>

#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_repair.h>

namespace tst_session_killed {

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

constexpr int killed = 24;
constexpr int atOnce = 6;

struct Shared {
  std::atomic<std::uint64_t> rows;
  std::atomic<double> time;
};

struct Child {
  pid_t process = 0;
  std::string file, repaired;
  Shared* shared = nullptr;
  qint64 end = 0;  // ms
};

}  // namespace

class TestSessionKilled : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  Child start(int number, int stall) {
    Child child;
    const std::string base =
        m_folder.filePath(QStringLiteral("%1-%2").arg(stall).arg(number)).toStdString();
    child.file = base + ".mcap";
    child.repaired = base + "-repaired.mcap";
    const std::string sharedPath = base + ".shared";
    const int descriptor = open(sharedPath.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor < 0 || ftruncate(descriptor, sizeof(Shared)) != 0) return child;
    void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    close(descriptor);
    child.shared = static_cast<Shared*>(memory);
    std::string program = SESSION_RECORDER, file = child.file, shared = sharedPath,
                stalls = std::to_string(stall);
    char* arguments[] = {program.data(), file.data(), shared.data(), stalls.data(), nullptr};
    posix_spawn(&child.process, SESSION_RECORDER, nullptr, nullptr, arguments, environ);
    return child;
  }

 private slots:
  void losesAtMostASecond_data() {
    QTest::addColumn<int>("stall");
    QTest::newRow("a disk as it is") << 0;
    QTest::newRow("a disk that stalls for 10 s") << 10;
  }
  void losesAtMostASecond() {
    QFETCH(int, stall);
    std::mt19937 random(static_cast<unsigned>(QDateTime::currentMSecsSinceEpoch()));
    std::vector<Child> done;
    QElapsedTimer clock;
    clock.start();
    int started = 0;
    std::vector<Child> running;
    const auto due = [&clock](Child& child) {
      if (child.shared->rows == 0) child.end = std::max(child.end, clock.elapsed() + 50);
      if (clock.elapsed() > 60'000) child.end = 0;
      return clock.elapsed() >= child.end;
    };
    while (started < killed || !running.empty()) {
      while (static_cast<int>(running.size()) < atOnce && started < killed) {
        running.push_back(start(started++, stall));
        QVERIFY(running.back().process > 0);
        running.back().end = clock.elapsed() + 50 + static_cast<qint64>(random() % 3000);
      }
      (void)QTest::qWaitFor([&] { return std::any_of(running.begin(), running.end(), due); });
      for (std::size_t i = 0; i < running.size();) {
        Child& child = running[i];
        if (!due(child)) {
          ++i;
          continue;
        }
        kill(child.process, SIGKILL);
        waitpid(child.process, nullptr, 0);
        done.push_back(child);
        running.erase(running.begin() + static_cast<long>(i));
      }
    }
    double mostLost = 0.0;
    for (const Child& child : done) {
      QVERIFY(child.shared->rows > 0);
      const double written = child.shared->time;
      const auto broken = SessionReader::open(child.file);
      QVERIFY2(broken, child.file.c_str());
      QVERIFY(!broken->complete());
      const auto report = repairSession(child.file, child.repaired);
      QVERIFY2(report, report ? "" : report.error().text().c_str());
      const auto reader = SessionReader::open(child.repaired);
      QVERIFY(reader && reader->complete() && reader->notes().empty());
      double last = 0.0;
      std::uint64_t rows = 0;
      bool inOrder = true;
      reader->rows({-1, 1e6}, {}, [&](GroupId, const RowView& row) {
        inOrder = inOrder && row.values[0] == static_cast<double>(rows);
        ++rows;
        last = row.time;
        return true;
      });
      QVERIFY(inOrder);
      QCOMPARE(report->messages, rows);
      QVERIFY2(written - last <= 1.0,
               qPrintable(QStringLiteral("%1 s are lost").arg(written - last)));
      mostLost = std::max(mostLost, written - last);
      munmap(child.shared, sizeof(Shared));
    }
    qInfo("%d recordings killed; at most %.3f s lost", killed, mostLost);
  }
};

PITCHBOARD_TEST(TestSessionKilled)

}  // namespace tst_session_killed

#include "tst_session_killed.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// The clocks of real programs: those that follow the match, and those whose waits hang with it.
#include <QtTest>

#include <robotlink/processes/process_manager.h>

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

using SteadyClock = std::chrono::steady_clock;

ManagedProcess python(std::vector<std::string> arguments) {
  ManagedProcess process;
  arguments.insert(arguments.begin(), "python3");
  process.spec = {RobotId{1}, "own", std::move(arguments)};
  process.spec.foreign = true;
  process.ownTime = true;
  process.restart.policy = RestartPolicy::Never;
  return process;
}

}  // namespace

class TestProcessClocks : public QObject {
  Q_OBJECT
  std::unique_ptr<ProcessManager> m_manager;
  Blackboard m_board = Blackboard::onHeap();
  std::vector<ProcessNews> m_silent;
  std::vector<std::string> m_lines;

  int add(const ManagedProcess& process) {
    const auto id = m_manager->add(process, m_board, SteadyClock::now());
    if (!id) qWarning("%s", id.error().text().c_str());
    return id ? *id : 0;
  }
  void look() {
    (void)m_manager->step(SteadyClock::now());
    for (ProcessNews& one : m_manager->takeNews()) {
      if (one.kind == ProcessNewsKind::Silent) m_silent.push_back(std::move(one));
    }
    for (ProcessLine& one : m_manager->takeLines()) m_lines.push_back(std::move(one.text));
  }
  const ProcessStatus& status(int id) { return *m_manager->status(id); }

 private slots:
  void init() {
    m_manager = std::make_unique<ProcessManager>();
    m_silent.clear();
    m_lines.clear();
  }
  void cleanup() { m_manager.reset(); }

  // A program knows its time by sleeping and by looking at clocks: both follow the speed.
  void aForeignProgramsTimeFollowsTheMatch() {
    if (FakeTime::library().empty()) QSKIP("libfaketime is not installed");
    ManagedProcess process = python({"-u", "-c",
                                     "import time\nt = time.time(); m = time.monotonic()\n"
                                     "while True:\n time.sleep(1)\n print(round(time.time() - t), "
                                     "round(time.monotonic() - m))\n"});
    m_manager->setClocksFollow(true);
    m_manager->setSpeed(50.0, SteadyClock::now());
    const int id = add(process);
    QTRY_VERIFY_WITH_TIMEOUT(m_lines.size() > 60 || (look(), false), 40'000);
    // Sixty sleeps of a second; a busy computer wakes it late, but both of its clocks agree.
    int passed = 0, monotonic = 0;
    QCOMPARE(std::sscanf(m_lines[59].c_str(), "%d %d", &passed, &monotonic), 2);
    QVERIFY2(passed >= 60 && std::abs(passed - monotonic) <= 1, m_lines[59].c_str());
    // Its time stands still while it is stopped, and goes on from there.
    m_manager->setPaused(true, SteadyClock::now());
    look();
    const int before = std::stoi(m_lines.back());
    QTest::qWait(1000);  // 50 s at its speed
    look();
    m_lines.clear();
    m_manager->setPaused(false, SteadyClock::now());
    QTRY_VERIFY((look(), !m_lines.empty()));
    QVERIFY2(std::stoi(m_lines.front()) <= before + 25, m_lines.front().c_str());
    const pid_t pid = status(id).pid;
    m_manager->stop(id);
    QVERIFY(!QFile::exists(QString("/dev/shm/faketime_shm_%1").arg(pid)));
  }

  // Work, and half a second of sleep: at a high speed nothing is left of the sleep.
  void whatAProgramCannotKeepUpWithIsTold() {
    if (FakeTime::library().empty()) QSKIP("libfaketime is not installed");
    ManagedProcess process =
        python({"-c", "import time\nwhile True:\n sum(range(300000))\n time.sleep(0.5)\n"});
    m_manager->setClocksFollow(true);
    const int id = add(process);
    QTRY_VERIFY_WITH_TIMEOUT((look(), status(id).achieved == 1.0), 30'000);
    m_manager->setSpeed(1000.0, SteadyClock::now());
    QCOMPARE(status(id).achieved, 0.0);
    QTRY_VERIFY_WITH_TIMEOUT((look(), status(id).achieved > 0.0 && status(id).achieved < 900.0),
                             20'000);
    QCOMPARE(status(id).speed, 1000.0);
  }

  // libfaketime knows nothing of this wait, which does not return; others that sleep for long do.
  void aProgramWhoseWaitHangsIsNamedWithTheReason_data() {
    QTest::addColumn<bool>("heartbeat");
    QTest::newRow("nobody listens to it") << false;
    QTest::newRow("a heartbeat is expected") << true;
  }
  void aProgramWhoseWaitHangsIsNamedWithTheReason() {
    if (FakeTime::library().empty()) QSKIP("libfaketime is not installed");
    QFETCH(bool, heartbeat);
    m_manager->setClocksFollow(true);
    m_manager->setSpeed(8.0, SteadyClock::now());
    ManagedProcess sleeper = python({"-c", "import time\ntime.sleep(6000)\n"});
    sleeper.silentAfter = RestartRule::Seconds(2);
    const int sleeps = add(sleeper);
    ManagedProcess waiter = python({"-c", "import threading\nthreading.Event().wait(0.5)\n"});
    waiter.silentAfter = RestartRule::Seconds(2);
    if (heartbeat) {
      waiter.watch = ManagedProcess::Watch::Variable;
      waiter.heartbeat = IntVar{10};
    }
    const int waits = add(waiter);
    QTRY_VERIFY((look(), !m_silent.empty()));
    const std::string reason =
        "its timed waits cannot follow \u00d78. Restart the match at \u00d71, or set \"clock\": "
        "\"real\" in its runtime profile.";
    QCOMPARE(m_silent.front().detail, reason);
    QCOMPARE(status(waits).hangs, reason);
    QCOMPARE(status(waits).state, ProcessState::Silent);
    // It stays like this, is told once, and the other one is not suspected.
    const auto later = SteadyClock::now() + std::chrono::seconds(4);
    QTRY_VERIFY((look(), SteadyClock::now() > later));
    QCOMPARE(m_silent.size(), std::size_t{1});
    QCOMPARE(status(waits).state, ProcessState::Silent);
    QCOMPARE(status(sleeps).state, ProcessState::Running);
    QVERIFY(status(sleeps).hangs.empty());
    // Started again at ×1 it works.
    m_manager->setClocksFollow(false);
    m_manager->setSpeed(1.0, SteadyClock::now());
    m_manager->restart(waits, SteadyClock::now());
    QTRY_COMPARE((look(), status(waits).state), ProcessState::Ended);
    QCOMPARE(status(waits).detail, std::string("exit code 0"));
    QVERIFY(status(waits).hangs.empty());
  }
};

QTEST_GUILESS_MAIN(TestProcessClocks)
#include "tst_process_clocks.moc"

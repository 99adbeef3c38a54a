// SPDX-License-Identifier: GPL-3.0-or-later
// The clocks and waits of real programs follow the match, and who cannot follow is named.
#include <QtTest>

#include <robotlink/processes/process_manager.h>

namespace tst_process_clocks {

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
  std::vector<ProcessNews> m_realTime;
  std::vector<std::string> m_lines;

  int add(const ManagedProcess& process) {
    const auto id = m_manager->add(process, m_board, SteadyClock::now());
    if (!id) qWarning("%s", id.error().text().c_str());
    return id ? *id : 0;
  }
  void look() {
    (void)m_manager->step(SteadyClock::now());
    for (ProcessNews& one : m_manager->takeNews()) {
      if (one.kind == ProcessNewsKind::RealTime) m_realTime.push_back(std::move(one));
    }
    for (ProcessLine& one : m_manager->takeLines()) m_lines.push_back(std::move(one.text));
  }
  const ProcessStatus& status(int id) { return *m_manager->status(id); }

 private slots:
  void init() {
    m_manager = std::make_unique<ProcessManager>(PITCHBOARD_BIN "/pitchboard-robot");
    m_realTime.clear();
    m_lines.clear();
  }
  void cleanup() { m_manager.reset(); }

  // A program knows its time by sleeping and by looking at clocks: both follow the speed.
  void aForeignProgramsTimeFollowsTheMatch() {
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
    m_manager->stop(id);
  }

  // Work, and half a second of sleep: at a high speed nothing is left of the sleep.
  void whatAProgramCannotKeepUpWithIsTold() {
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

  // Each line is a way to wait, and how long the program waited by its own clock. A wait that is
  // not scaled lasts 8 times as long as it should at \u00d78, and less than it should after a
  // pause.
  void everyWayToWaitFollowsTheMatch_data() {
    QTest::addColumn<bool>("changes");
    QTest::newRow("at x8") << false;
    QTest::newRow("speed changes and pauses") << true;
  }
  void everyWayToWaitFollowsTheMatch() {
    QFETCH(bool, changes);
    constexpr double seconds = 2.0;
    constexpr std::size_t ways = 30 + 16;  // in C and C++, and in Python
    m_manager->setClocksFollow(true);
    m_manager->setSpeed(8.0, SteadyClock::now());
    ManagedProcess process = python({PITCHBOARD_SOURCE_DIR "/tests/robotlink/all_waits.py", "2"});
    const int inPython = add(process);
    process.spec.command = {(QCoreApplication::applicationDirPath() + "/all_waits").toStdString(),
                            "2"};
    const int compiled = add(process);
    const auto runs = [this](int id) { return status(id).state != ProcessState::Ended; };
    const std::array speeds{8.0, 1.0, 0.0, 4.0};
    for (std::size_t turn = 0; runs(inPython) || runs(compiled); ++turn) {
      const double speed = speeds[turn % speeds.size()];
      if (changes) {
        m_manager->setPaused(speed == 0.0, SteadyClock::now());
        if (speed > 0.0) m_manager->setSpeed(speed, SteadyClock::now());
      }
      look();
      QTest::qWait(60);
    }
    look();
    QCOMPARE(status(inPython).detail, std::string("exit code 0"));
    QCOMPARE(status(compiled).detail, std::string("exit code 0"));
    QCOMPARE(m_lines.size(), ways);
    for (const std::string& line : m_lines) {
      char way[64]{};
      double monotonic = 0.0, wall = 0.0;
      QCOMPARE(std::sscanf(line.c_str(), "%63s %lf %lf", way, &monotonic, &wall), 3);
      QVERIFY2(monotonic > 0.99 * seconds && monotonic < 2.0 * seconds, line.c_str());
      QVERIFY2(std::abs(wall - monotonic) < 0.1, line.c_str());
    }
  }

  // Nothing can be loaded into it.
  void aStaticProgramIsNamedWithTheReason() {
    ManagedProcess process = python({});
    process.spec.command = {
        (QCoreApplication::applicationDirPath() + "/static_sleeper").toStdString()};
    m_manager->setClocksFollow(true);
    m_manager->setSpeed(8.0, SteadyClock::now());
    const int id = add(process);
    QTRY_VERIFY((look(), !m_realTime.empty()));
    QCOMPARE(m_realTime.front().detail, std::string(whyRealTime(ProcessClock::RealNotLoaded)));
    QCOMPARE(status(id).clock, ProcessClock::RealNotLoaded);
    QCOMPARE(status(id).achieved, 1.0);
  }
};

PITCHBOARD_TEST(TestProcessClocks)

}  // namespace tst_process_clocks

#include "tst_process_clocks.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// The manager with real processes: those that die, hang, fork, flood, refuse to end.
#include <poll.h>
#include <unistd.h>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/processes/process_manager.h>

#include "../support/segment_keys.h"

namespace tst_process_manager {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;

namespace {

using SteadyClock = std::chrono::steady_clock;
using Kind = ProcessNewsKind;

ManagedProcess shell(const QByteArray& script, RestartPolicy policy = RestartPolicy::Always) {
  ManagedProcess process;
  process.spec = {RobotId{1}, "own", {"/bin/sh", "-c", script.toStdString()}};
  process.spec.isTeamProgram = true;
  process.restart.policy = policy;
  process.restart.firstWait = RestartRule::Seconds(0.02);
  return process;
}

QByteArray stateOf(pid_t pid) {
  QFile status(QString("/proc/%1/status").arg(pid));
  if (!status.open(QIODevice::ReadOnly)) return {};
  for (const QByteArray& line : status.readAll().split('\n')) {
    if (line.startsWith("State:")) return line.mid(6).trimmed().left(1);
  }
  return {};
}

bool runs(pid_t pid) {
  const QByteArray state = stateOf(pid);
  return !state.isEmpty() && state != "Z" && state != "X";
}

}  // namespace

class TestProcessManager : public QObject {
  Q_OBJECT
  const int m_key = testKeyBase() + 100;
  std::unique_ptr<ProcessManager> m_manager;
  Blackboard m_board = Blackboard::onHeap();
  std::vector<ProcessNews> m_news;
  std::vector<std::string> m_lines;

  int add(const ManagedProcess& process) {
    const auto id = m_manager->add(process, m_board, SteadyClock::now());
    if (!id) qWarning("%s", id.error().text().c_str());
    return id ? *id : 0;
  }
  void look(SteadyClock::time_point now = SteadyClock::now()) {
    (void)m_manager->step(now);
    for (ProcessNews& one : m_manager->drainNews()) m_news.push_back(std::move(one));
    for (ProcessLine& one : m_manager->drainLines()) m_lines.push_back(std::move(one.text));
  }
  int count(Kind kind, SteadyClock::time_point now = SteadyClock::now()) {
    look(now);
    return static_cast<int>(std::count_if(m_news.begin(), m_news.end(),
                                          [kind](const auto& one) { return one.kind == kind; }));
  }
  const ProcessStatus& status(int id) { return *m_manager->status(id); }
  bool wrote(const std::string& text) {
    look();
    return std::find(m_lines.begin(), m_lines.end(), text) != m_lines.end();
  }

 private slots:
  void init() {
    m_manager = std::make_unique<ProcessManager>(PITCHBOARD_BIN "/pitchboard-robot");
    m_news.clear();
    m_lines.clear();
  }
  void cleanup() {
    m_manager.reset();
    removeSegment(m_key);
  }

  void aCrashReportsItsSignalAndLastOutputAndIsRestarted() {
    const int id = add(shell("echo ouch; kill -SEGV $$"));
    QTRY_VERIFY(count(Kind::Restarted) >= 1);
    const auto died = std::find_if(m_news.begin(), m_news.end(),
                                   [](const auto& one) { return one.kind == Kind::Died; });
    QCOMPARE(died->detail, std::string("killed by signal 11 (Segmentation fault)"));
    QCOMPARE(died->lastOutput, std::string("ouch"));
    QCOMPARE(died->restartIn, 0.02);
    QVERIFY(status(id).restarts >= 1);
  }

  // A caller that waits for news does not have to poll.
  void itSignalsWhenAProcessHasNews() {
    const auto reports = [this] {
      pollfd waited{m_manager->descriptor(), POLLIN, 0};
      return ::poll(&waited, 1, 0) == 1;
    };
    const int id =
        add(shell("echo here; read nothing < /dev/null; exec sleep 1000", RestartPolicy::Never));
    QTRY_VERIFY(reports());
    QTRY_VERIFY(wrote("here"));
    look();
    QVERIFY(!reports());
    m_manager->kill(id);
    QTRY_VERIFY(reports());
    QTRY_COMPARE(count(Kind::Died), 1);
    look();
    QVERIFY(!reports());
  }

  void restartPolicies_data() {
    QTest::addColumn<QByteArray>("script");
    QTest::addColumn<int>("policy");
    QTest::addColumn<bool>("again");
    const auto row = [](const char* name, const char* script, RestartPolicy policy, bool again) {
      QTest::newRow(name) << QByteArray(script) << static_cast<int>(policy) << again;
    };
    row("never", "exit 3", RestartPolicy::Never, false);
    row("on failure, ended well", "exit 0", RestartPolicy::OnFailure, false);
    row("on failure, failed", "exit 3", RestartPolicy::OnFailure, true);
    row("always", "exit 0", RestartPolicy::Always, true);
  }
  void restartPolicies() {
    QFETCH(QByteArray, script);
    QFETCH(int, policy);
    QFETCH(bool, again);
    const int id = add(shell(script, static_cast<RestartPolicy>(policy)));
    QTRY_VERIFY(count(Kind::Ended) + count(Kind::Died) > 0);
    if (again) {
      QTRY_VERIFY(count(Kind::Restarted) > 0);
    } else {
      QCOMPARE(status(id).state, ProcessState::Ended);
      QCOMPARE(status(id).pid, 0);
    }
  }

  void whoEndsAtOnceInALoopIsGivenUp() {
    ManagedProcess process = shell("exit 7");
    process.restart.firstWait = process.restart.maxWait = RestartRule::Seconds(0.005);
    process.restart.giveUpAfter = 4;
    const int id = add(process);
    QTRY_COMPARE(count(Kind::GivenUp), 1);
    QCOMPARE(status(id).state, ProcessState::GivenUp);
    QCOMPARE(status(id).restarts, 4);
    QCOMPARE(status(id).deaths, 5);
    QCOMPARE(status(id).lastDeath, std::string("exit code 7"));
    QVERIFY(status(id).keepsDying());
    m_manager->start(id, SteadyClock::now());  // by hand it may try again
    QTRY_COMPARE(count(Kind::GivenUp), 2);
    QCOMPARE(status(id).restarts, 8);  // a start by hand is none
  }

  void waitsGrowUpToALimit() {
    ManagedProcess process = shell("exit 1");
    process.restart.firstWait = RestartRule::Seconds(0.01);
    process.restart.maxWait = RestartRule::Seconds(0.04);
    add(process);
    QTRY_VERIFY(count(Kind::Died) >= 5);
    std::vector<double> waits;
    for (const ProcessNews& one : m_news) {
      if (one.kind == Kind::Died && waits.size() < 5) waits.push_back(one.restartIn);
    }
    QCOMPARE(waits, (std::vector<double>{0.01, 0.02, 0.04, 0.04, 0.04}));
  }

  void aHeartbeatThatStopsIsNoticed_data() {
    QTest::addColumn<bool>("restarts");
    QTest::newRow("started again") << true;
    QTest::newRow("only shown") << false;
  }
  void aHeartbeatThatStopsIsNoticed() {
    QFETCH(bool, restarts);
    ManagedProcess process =
        shell("exec sleep 600", restarts ? RestartPolicy::Always : RestartPolicy::Never);
    process.watch = ManagedProcess::Watch::Variable;
    process.heartbeat = IntVar{104};
    process.clears = true;
    process.responseTimeout = RestartRule::Seconds(0.3);
    const int id = add(process);
    const pid_t first = status(id).pid;
    // While somebody sets it, it lives.
    auto now = SteadyClock::now();  // made up from here: nobody waits
    for (int i = 0; i < 40; ++i) {
      m_board.write(IntVar{104}, 1);
      QCOMPARE(count(Kind::NotResponding, now += 10ms), 0);
    }
    QTRY_COMPARE(count(Kind::NotResponding), 1);
    if (restarts) {
      // Between the end of the old one and the start of the new one it has no pid: only look() ends
      // that.
      QTRY_VERIFY_WITH_TIMEOUT((look(), status(id).pid != 0 && status(id).pid != first), 20000);
      QVERIFY(!runs(first));
    } else {
      QCOMPARE(status(id).state, ProcessState::NotResponding);
      QCOMPARE(status(id).pid, first);
      m_board.write(IntVar{104}, 1);
      look();
      QCOMPARE(status(id).state, ProcessState::Running);
    }
  }

  // It may wait for the kick-off, or for a packet, before its first cycle.
  void whoNeverBeatIsNotKilled() {
    ManagedProcess process = shell("exec sleep 600");
    process.watch = ManagedProcess::Watch::Variable;
    process.heartbeat = IntVar{104};
    process.responseTimeout = RestartRule::Seconds(0.05);
    m_board.write(IntVar{104}, 1);  // left by an earlier one
    const int id = add(process);
    auto now = SteadyClock::now();
    for (int i = 0; i < 30; ++i) QCOMPARE(count(Kind::NotResponding, now += 10ms), 0);
    QCOMPARE(status(id).state, ProcessState::Running);
    m_board.write(IntVar{104}, 1);
    look();
    m_board.write(IntVar{104}, 0);
    QTRY_COMPARE(count(Kind::NotResponding), 1);
  }

  void withoutAHeartbeatAProcessIsNotReported() {
    ManagedProcess process = shell("exec sleep 600");
    process.responseTimeout = RestartRule::Seconds(0.05);
    const int id = add(process);
    auto now = SteadyClock::now();
    for (int i = 0; i < 30; ++i) look(now += 10ms);
    QCOMPARE(status(id).state, ProcessState::Running);
    // But one that somebody stopped is shown as silent, and is not ended for it.
    const pid_t pid = status(id).pid;
    ::kill(pid, SIGSTOP);
    QTRY_COMPARE((look(), status(id).state), ProcessState::NotResponding);
    QCOMPARE(status(id).pid, pid);
    ::kill(pid, SIGCONT);
    QTRY_COMPARE((look(), status(id).state), ProcessState::Running);
  }

  void whatItForkedEndsWithIt_data() {
    QTest::addColumn<QByteArray>("script");
    QTest::newRow("fork") << QByteArray("sleep 600 & echo $!; wait");
    QTest::newRow("own session") << QByteArray("setsid sleep 600 & echo $!; wait");
    QTest::newRow("double fork, own session, parent gone")
        << QByteArray("setsid sh -c 'sleep 600 & echo $!' ; exec sleep 600");
    QTest::newRow("own session, no environment, parent gone")
        << QByteArray("env -i setsid sh -c 'sleep 600 & echo $!' ; exec sleep 600");
  }
  void whatItForkedEndsWithIt() {
    QFETCH(QByteArray, script);
    const int id = add(shell(script));
    QTRY_VERIFY((look(), !m_lines.empty()));
    const pid_t grandchild = std::stoi(m_lines.front());
    QTRY_VERIFY(runs(grandchild));
    // Paused and continued with it, too.
    m_manager->setPaused(true, SteadyClock::now());
    QTRY_COMPARE(stateOf(grandchild), QByteArray("T"));
    m_manager->setPaused(false, SteadyClock::now());
    QTRY_COMPARE(stateOf(grandchild), QByteArray("S"));
    m_manager->stop(id);
    QCOMPARE(status(id).state, ProcessState::Stopped);
    QTRY_VERIFY(!runs(grandchild));
  }

  void whoIgnoresTheEndIsKilled() {
    const int id = add(shell("trap '' TERM; echo ready; while :; do sleep 0.05; done"));
    QTRY_VERIFY(wrote("ready"));
    const pid_t pid = status(id).pid;
    m_manager->stop(id);
    QVERIFY(!runs(pid));
    QCOMPARE(status(id).state, ProcessState::Stopped);
    QCOMPARE(status(id).detail, std::string());
  }

  void aStoppedOneCanBeEnded() {
    const int id = add(shell("trap 'echo bye; exit 0' TERM; echo ready; sleep 60 & wait"));
    QTRY_VERIFY(wrote("ready"));
    m_manager->setPaused(true, SteadyClock::now());
    m_manager->stop(id);
    QVERIFY(wrote("bye"));
  }

  void aProgramThatIsReplacedStartsAgain() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("decide");
    const auto write = [&path](const char* text) {
      QFile fresh(path + ".new");
      QVERIFY(fresh.open(QIODevice::WriteOnly));
      fresh.write(text);
      fresh.setPermissions(fresh.permissions() | QFile::ExeOwner);
      fresh.close();
      QVERIFY(::rename(fresh.fileName().toUtf8(), path.toUtf8()) == 0);
    };
    write("#!/bin/sh\necho one\nexec sleep 600\n");
    ManagedProcess process = shell("");
    process.spec.command = {path.toStdString()};
    process.watchFile = true;
    const int id = add(process);
    QTRY_VERIFY(wrote("one"));
    write("#!/bin/sh\necho two\nexec sleep 600\n");
    QTRY_VERIFY_WITH_TIMEOUT(wrote("two"), 20'000);
    QCOMPARE(status(id).restarts, 1);
  }

  void aFloodOfLinesIsBoundedAndDelaysNoProcess() {
    ManagedProcess process = shell("exec yes");
    const int id = add(process);
    for (int i = 0; i < 30; ++i) look();
    const auto leftOut = [this] { return m_manager->statuses().at(0).linesLeftOut; };
    QTRY_VERIFY((look(), leftOut() > 20'000));
    // What is missing is counted, and the log of the program says so.
    const auto isNotice = [](const std::string& line) { return line.ends_with("keep all of it"); };
    QTRY_VERIFY((look(), std::ranges::any_of(m_lines, isNotice)));
    for (const std::string& line : m_lines) QVERIFY(line == "y" || isNotice(line));
    QCOMPARE(status(id).lastLines.size(), ProcessStatus::maxLastLines);
    QCOMPARE(status(id).lastLines.back(), std::string("y"));
  }

  void startsInOrder() {
    ManagedProcess process = shell("exec sleep 600");
    process.delay = 0.05;
    const std::vector<int> ids{add(process), add(process), add(process)};
    QCOMPARE(status(ids[0]).state, ProcessState::Running);
    QCOMPARE(status(ids[2]).state, ProcessState::Waiting);
    QTRY_COMPARE(count(Kind::Started), 3);
    QVERIFY(status(ids[1]).started >= status(ids[0]).started + std::chrono::milliseconds(50));
    QVERIFY(status(ids[2]).started >= status(ids[1]).started + std::chrono::milliseconds(50));
  }

  void whatItForkedEndsWhenItEndsByItself() {
    add(shell("env -i setsid sleep 600 & echo $!; exit 3", RestartPolicy::Never));
    QTRY_COMPARE(count(Kind::Died), 1);
    QVERIFY(!runs(std::stoi(m_lines.front())));
    QCOMPARE(m_news.back().detail, std::string("exit code 3"));
  }

  void removingARobotConcernsNoOther() {
    const int first = add(shell("exec sleep 600"));
    ManagedProcess process = shell("exec sleep 600");
    process.spec.robot = RobotId{2};
    const int other = add(process);
    m_manager->remove(RobotId{1});
    QVERIFY(!m_manager->status(first));
    look();
    QCOMPARE(status(other).state, ProcessState::Running);
    QVERIFY(runs(status(other).pid));
  }

  void theDestructorEndsAll() {
    const pid_t pid = status(add(shell("exec sleep 600"))).pid;
    QVERIFY(runs(pid));
    m_manager.reset();
    QVERIFY(!runs(pid));
  }

  // Keepers of a studio that is killed end grandchildren, its guard removes segments.
  void nothingSurvivesAKilledManager() {
    QProcess host;
    QList<pid_t> pids;
    startGuarded(host, pids);
    QVERIFY(pids.size() >= hostPids);
    for (const pid_t pid : pids) QTRY_VERIFY(runs(pid));
    QVERIFY(SystemVSegments::info(m_key));
    host.kill();
    QVERIFY(host.waitForFinished());
    for (const pid_t pid : pids) QTRY_VERIFY(!runs(pid));
    QTRY_VERIFY(!SystemVSegments::info(m_key));
  }

  // On a busy computer a killed process holds its segments longer than its environment.
  void aSegmentThatIsStillUsedIsRemovedLater() {
    QProcess host;
    QList<pid_t> pids;
    startGuarded(host, pids);
    QVERIFY(pids.size() >= hostPids);
    {
      const auto used = SystemVSegments::open(m_key, AttachMode::ReadOnly);
      QVERIFY(used);
      host.kill();
      QVERIFY(host.waitForFinished());
      for (const pid_t pid : pids) QTRY_VERIFY(!runs(pid));
      QVERIFY(SystemVSegments::info(m_key));
    }
    QTRY_VERIFY(!SystemVSegments::info(m_key));
  }

 private:
  static constexpr int hostPids = 7;  // of process_host
  /// A manager with a guard and a segment at our key; `pids` of its children, and of theirs.
  void startGuarded(QProcess& host, QList<pid_t>& pids) const {
    host.start(QCoreApplication::applicationDirPath() + "/process_host",
               {PITCHBOARD_BIN "/pitchboard-robot", QString::number(m_key)});
    QByteArray output;
    QTRY_VERIFY((output += host.readAllStandardOutput(), output.count('\n') >= hostPids));
    for (const QByteArray& line : output.trimmed().split('\n')) pids << line.mid(6).toInt();
  }
};

PITCHBOARD_TEST(TestProcessManager)

}  // namespace tst_process_manager

#include "tst_process_manager.moc"

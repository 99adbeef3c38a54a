// SPDX-License-Identifier: GPL-3.0-or-later
// The clocks and waits of real programs follow the match, and who cannot follow is named.
#include <QTemporaryDir>
#include <QtTest>
#include <ctime>
#include <functional>
#include <map>

#include <robotlink/processes/process_manager.h>

#include "../support/setuid_program.h"
#include "time_page.h"

namespace tst_process_clocks {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

using SteadyClock = std::chrono::steady_clock;

ManagedProcess python(std::vector<std::string> arguments) {
  ManagedProcess process;
  arguments.insert(arguments.begin(), "python3");
  process.spec = {RobotId{1}, "own", std::move(arguments)};
  process.spec.isTeamProgram = true;
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
  std::map<int, QString> m_pages;  // the file that a program shares with the manager

  int add(const ManagedProcess& process) {
    const auto id = m_manager->add(process, m_board, SteadyClock::now());
    if (!id) qWarning("%s", id.error().text().c_str());
    return id ? *id : 0;
  }
  void look() {
    (void)m_manager->step(SteadyClock::now());
    for (ProcessNews& one : m_manager->drainNews()) {
      if (one.kind == ProcessNewsKind::RealTime) m_realTime.push_back(std::move(one));
    }
    for (ProcessLine& one : m_manager->drainLines()) m_lines.push_back(std::move(one.text));
  }
  const ProcessStatus& status(int id) { return *m_manager->status(id); }
  static SteadyClock::time_point after(SteadyClock::time_point begin, double seconds) {
    return begin + std::chrono::duration_cast<SteadyClock::duration>(
                       std::chrono::duration<double>(seconds));
  }
  /// What a program shares with the manager; empty until it was started. Its environment is read
  /// once only: it is empty for a moment whenever the program becomes another one, as scripts in
  /// front of an interpreter do.
  std::optional<pitchboard_time_page> page(int id) {
    QString& name = m_pages[id];
    QFile environment(QStringLiteral("/proc/%1/environ").arg(status(id).pid));
    if (name.isEmpty() && environment.open(QIODevice::ReadOnly)) {
      for (const QByteArray& one : environment.readAll().split('\0')) {
        if (one.startsWith(PITCHBOARD_TIME_VARIABLE "="))
          name = QString::fromUtf8(one.mid(one.indexOf('=') + 1));
      }
    }
    QFile file(name);
    pitchboard_time_page read{};
    if (name.isEmpty() || !file.open(QIODevice::ReadOnly) ||
        file.read(reinterpret_cast<char*>(&read), sizeof read) != sizeof read) {
      return {};
    }
    return read;
  }
  /// Returns when `seconds` of the computer have passed for another program. The match, and what is
  /// stopped with it, cannot show that.
  void waitForAnother(const char* seconds) {
    ManagedProcess sleeper;
    sleeper.spec = {RobotId{2}, "sleeper", {"/bin/sleep", seconds}};
    sleeper.restart.policy = RestartPolicy::Never;
    const int id = add(sleeper);
    QTRY_VERIFY((look(), status(id).state == ProcessState::Ended));
  }

  /// By how much the computer's uptime is ahead of its steady clock, s: nothing, but for an
  /// interruption in between, where it was never suspended.
  static double suspendedSeconds() {
    double least = 1e18;
    for (int attempt = 0; attempt < 20; ++attempt) {
      const double steady =
          std::chrono::duration<double>(SteadyClock::now().time_since_epoch()).count();
      timespec t{};
      ::clock_gettime(CLOCK_BOOTTIME, &t);
      least = std::min(least, double(t.tv_sec) + double(t.tv_nsec) * 1e-9 - steady);
    }
    return least;
  }
  /// How long a wait took, s.
  struct Waited {
    double match = 0.0;
    /// CLOCK_MONOTONIC, CLOCK_REALTIME, CLOCK_BOOTTIME, gettimeofday(), time()
    std::array<double, 5> clocks{};
  };
  /// A busy computer wakes a program late, sometimes; nothing wakes it early. Compares the shortest
  /// of several waits, by each of the clocks.
  static bool isRight(const std::vector<Waited>& waits, int seconds) {
    constexpr double most = 0.05;
    const auto isIn = [&](auto measure, double rounding) {
      const double shortest = std::invoke(measure, *std::ranges::min_element(waits, {}, measure));
      return std::abs(shortest - seconds) <= most * seconds + rounding;
    };
    bool right = isIn([](const Waited& one) { return one.match; }, 0.0);
    for (std::size_t i = 0; i < 5; ++i) {
      const double rounding = i == 4 ? 1.0 : 0.0;
      right = right && isIn([i](const Waited& one) { return one.clocks[i]; }, rounding);
    }
    return right;
  }
  /// Programs in C, C++ and Python wait in a match that is played at these speeds, one after the
  /// other, from when all of them are ready.
  void waitInEveryWay(int seconds, const std::vector<std::pair<double, double>>& speeds,
                      bool ownTime, std::map<QByteArray, std::vector<Waited>>& waits) {
    const QTemporaryDir folder;
    const std::string programs = QCoreApplication::applicationDirPath().toStdString();
    const std::vector<std::vector<std::string>> commands{
        {programs + "/all_waits_c"},
        {programs + "/all_waits"},
        {"python3", PITCHBOARD_SOURCE_DIR "/tests/robotlink/all_waits.py"}};
    m_manager = std::make_unique<ProcessManager>(PITCHBOARD_BIN "/pitchboard-robot");
    // The programs tell the uptime, which goes on while the computer is suspended.
    const double suspended = suspendedSeconds();
    const auto uptime = [suspended](SteadyClock::time_point now) {
      return std::chrono::duration<double>(now.time_since_epoch()).count() + suspended;
    };
    std::vector<std::pair<double, double>> played{{uptime(SteadyClock::now()), 0.0}};
    double speed = speeds.front().first;
    // The manager is given the moment up to which the match is played, however late that is.
    const auto play = [&](SteadyClock::time_point now) {
      const auto [before, match] = played.back();
      played.emplace_back(uptime(now), match + speed * (uptime(now) - before));
      if (speed > 0.0) m_manager->setTime(played.back().second, speed, now);
    };
    const auto matchAt = [&played](double moment) {
      const auto after =
          std::ranges::lower_bound(played, moment, {}, &std::pair<double, double>::first);
      if (after == played.begin() || after == played.end()) return played.back().second;
      const auto& [t0, m0] = *(after - 1);
      return m0 + (after->second - m0) * (moment - t0) / (after->first - t0);
    };
    std::map<std::string, QByteArrayList> lines;
    const auto lookAtAll = [&] {
      play(SteadyClock::now());
      (void)m_manager->step(SteadyClock::now());
      for (const ProcessLine& line : m_manager->drainLines()) {
        lines[line.process] << QByteArray::fromStdString(line.text);
      }
    };
    play(SteadyClock::now());
    for (const auto& command : commands) {
      ManagedProcess process = python({});
      process.spec.command = command;
      process.spec.command.push_back(std::to_string(seconds));
      process.spec.command.push_back(folder.filePath("go").toStdString());
      process.spec.name = command.back().substr(command.back().rfind('/') + 1);
      process.ownTime = ownTime;
      QVERIFY(add(process) != 0);
    }
    QTRY_VERIFY((lookAtAll(), lines.size() == commands.size()));
    for (const ProcessStatus& one : m_manager->statuses()) {
      QFile environment(QStringLiteral("/proc/%1/environ").arg(one.pid));
      QVERIFY(environment.open(QIODevice::ReadOnly));
      const QByteArray all = environment.readAll();
      QCOMPARE(all.contains("libpitchboard_time"), ownTime);
      QCOMPARE(all.contains("PITCHBOARD_TIME="), ownTime);
    }
    QFile go(folder.filePath("go"));
    QVERIFY(go.open(QIODevice::WriteOnly));
    const auto over = [this] {
      const auto all = m_manager->statuses();
      return std::ranges::all_of(all,
                                 [](const auto& one) { return one.state == ProcessState::Ended; });
    };
    for (const auto& [next, duration] : speeds) {
      const auto change = SteadyClock::now();
      play(change);
      speed = next;
      if (speed > 0.0) m_manager->setTime(played.back().second, speed, change);
      m_manager->setPaused(speed == 0.0, change);
      const double until = uptime(change) + duration;
      const auto isDone = [&] {
        lookAtAll();
        return over() || played.back().first >= until;
      };
      QVERIFY2(QTest::qWaitFor(isDone, 100'000), "somebody waits for ever");
    }
    for (const ProcessStatus& one : m_manager->statuses()) {
      QCOMPARE(one.detail, std::string("exit code 0"));
    }
    for (const auto& [program, all] : lines) {
      for (const QByteArray& line : all) {
        if (line == "ready") continue;
        char way[64]{};
        double began = 0.0, ended = 0.0, now = 0.0;
        Waited one;
        auto& c = one.clocks;
        QVERIFY2(std::sscanf(line.constData(), "%63s %lf %lf %lf %lf %lf %lf %lf %lf", way, &c[0],
                             &c[1], &c[2], &c[3], &c[4], &began, &ended, &now) == 9,
                 line.constData());
        one.match = matchAt(ended) - matchAt(began);
        // It stays an uptime that a computer may have.
        constexpr double day = 86'400.0;
        QVERIFY2(now > 0.0 && now < ended + day, line.constData());
        waits[QByteArray::fromStdString(program) + ' ' + way].push_back(one);
      }
    }
  }

 private slots:
  void init() {
    m_manager = std::make_unique<ProcessManager>(PITCHBOARD_BIN "/pitchboard-robot");
    m_realTime.clear();
    m_lines.clear();
    m_pages.clear();
  }
  void cleanup() { m_manager.reset(); }

  // A program knows its time by sleeping and by looking at clocks: both follow the speed.
  void aTeamProgramsTimeFollowsTheMatch() {
    constexpr double speed = 50.0;
    ManagedProcess process = python({"-u", "-c",
                                     "import time\nt = time.time(); m = time.monotonic()\n"
                                     "while True:\n time.sleep(1)\n print(round(time.time() - t), "
                                     "round(time.monotonic() - m), time.monotonic())\n"});
    m_manager->setTime(0.0, speed, SteadyClock::now());
    const int id = add(process);
    QTRY_VERIFY_WITH_TIMEOUT(m_lines.size() > 60 || (look(), false), 40'000);
    // Sixty sleeps of a second; a busy computer wakes it late, but both of its clocks agree.
    int passed = 0, monotonic = 0;
    QCOMPARE(std::sscanf(m_lines[59].c_str(), "%d %d", &passed, &monotonic), 2);
    QVERIFY2(passed >= 60 && std::abs(passed - monotonic) <= 1, m_lines[59].c_str());
    // Its time stands still while it is stopped, and goes on from there.
    m_manager->setPaused(true, SteadyClock::now());
    const auto stopped = page(id);
    QVERIFY(stopped && stopped->rate == 0.0);
    const double at = 1e-9 * double(stopped->since + stopped->offset);
    waitForAnother("1");  // 50 s at its speed
    look();
    m_lines.clear();
    const auto goesOn = SteadyClock::now();
    m_manager->setPaused(false, goesOn);
    // The first line may have been on its way when it was stopped.
    QTRY_VERIFY((look(), m_lines.size() >= 2));
    const double since = std::chrono::duration<double>(SteadyClock::now() - goesOn).count();
    double shown = 0.0;
    QCOMPARE(std::sscanf(m_lines[1].c_str(), "%*d %*d %lf", &shown), 1);
    QVERIFY2(shown >= at && shown <= at + speed * since,
             qPrintable(QStringLiteral("%1 s, stopped at %2 s").arg(shown).arg(at)));
    m_manager->stop(id);
  }

  // Work, and half a second of sleep: at a high speed nothing is left of the sleep.
  void whatAProgramCannotKeepUpWithIsReported() {
    ManagedProcess process =
        python({"-c", "import time\nwhile True:\n sum(range(300000))\n time.sleep(0.5)\n"});
    const int id = add(process);
    QTRY_VERIFY_WITH_TIMEOUT((look(), status(id).achieved == 1.0), 30'000);
    m_manager->setTime(0.0, 1000.0, SteadyClock::now());
    QCOMPARE(status(id).achieved, 0.0);
    QCOMPARE(status(id).missedCycles, std::uint64_t{0});
    QTRY_VERIFY_WITH_TIMEOUT((look(), status(id).achieved > 0.0 && status(id).achieved < 900.0),
                             20'000);
    QCOMPARE(status(id).speed, 1000.0);
    // Two cycles in a second of its own would be 2000 a second.
    QTRY_VERIFY((look(), status(id).missedCycles > 100));
    QVERIFY(status(id).cycles > 0);
  }

  // Every wait takes as long in the match as it should, by the match's time and by five of the
  // program's clocks; a second of the computer at least, so that waking up late matters little.
  // What was late only is tried again.
  void everyWayToWaitTakesMatchTime_data() {
    using Speeds = std::vector<std::pair<double, double>>;  // times real time, for how many seconds
    QTest::addColumn<int>("seconds");
    QTest::addColumn<Speeds>("speeds");
    QTest::addColumn<bool>("ownTime");
    const double on = 1e9;
    QTest::newRow("x0.1") << 2 << Speeds{{0.1, on}} << true;
    QTest::newRow("x1") << 4 << Speeds{{1.0, on}} << true;
    QTest::newRow("x8") << 16 << Speeds{{8.0, on}} << true;
    QTest::newRow("a change of speed") << 8 << Speeds{{8.0, 0.3}, {1.0, 1.0}, {4.0, on}} << true;
    // Not in the moment in which an interval ends (docs/robot-programs.md, Time).
    QTest::newRow("a pause of 5 s") << 8 << Speeds{{4.0, 0.85}, {0.0, 5.0}, {2.0, on}} << true;
    QTest::newRow("real time, without the studio's clock") << 4 << Speeds{{1.0, on}} << false;
  }
  void everyWayToWaitTakesMatchTime() {
    using Speeds = std::vector<std::pair<double, double>>;
    QFETCH(int, seconds);
    QFETCH(Speeds, speeds);
    QFETCH(bool, ownTime);
    constexpr std::size_t ways = 24 + 31 + 17, maxAttempts = 10;
    std::map<QByteArray, std::vector<Waited>> waits;  // by program and way
    std::vector<QByteArray> wrong;
    for (std::size_t attempt = 0; attempt < maxAttempts && (attempt == 0 || !wrong.empty());
         ++attempt) {
      waitInEveryWay(seconds, speeds, ownTime, waits);
      if (QTest::currentTestFailed()) return;
      wrong.clear();
      for (const auto& [way, all] : waits) {
        if (!isRight(all, seconds)) wrong.push_back(way);
      }
    }
    QCOMPARE(waits.size(), ways);
    for (const QByteArray& way : wrong) {
      for (const Waited& one : waits[way]) {
        qWarning("%s: %.3f s of the match, by its clocks %.3f %.3f %.3f %.3f %.0f", way.constData(),
                 one.match, one.clocks[0], one.clocks[1], one.clocks[2], one.clocks[3],
                 one.clocks[4]);
      }
    }
    QVERIFY(wrong.empty());
  }

  // Twenty seconds without a sign of life are over after two at ten times the speed; at a tenth,
  // half a second is not.
  void timeoutsCountMatchTime_data() {
    QTest::addColumn<double>("speed");
    QTest::addColumn<bool>("stops");
    QTest::newRow("slow motion") << 0.1 << false;
    QTest::newRow("fast, and it hangs") << 10.0 << true;
  }
  void timeoutsCountMatchTime() {
    QFETCH(double, speed);
    QFETCH(bool, stops);
    ManagedProcess process =
        python({"-u", "-c", "import time\nprint('ready')\ntime.sleep(1000)\n"});
    process.restart.policy = RestartPolicy::Always;
    process.watch = ManagedProcess::Watch::Variable;
    process.heartbeat = IntVar{104};
    process.clears = true;
    process.responseTimeout = RestartRule::Seconds(stops ? 20.0 : 0.5);
    // It is there, with its clock; from then on the times are made up.
    m_manager->setTime(0.0, speed, SteadyClock::now());
    const int id = add(process);
    QTRY_VERIFY((look(), !m_lines.empty()));
    const pid_t pid = status(id).pid;
    const auto begin = SteadyClock::now();
    const auto playTo = [&](double seconds) {  // of the computer
      m_manager->setTime(speed * seconds, speed, after(begin, seconds));
      (void)m_manager->step(after(begin, seconds));
    };
    m_board.write(IntVar{104}, 1);
    playTo(0.0);
    for (int i = 1; i < 40; ++i) playTo(0.05 * i);
    QCOMPARE(status(id).pid, pid);
    QCOMPARE(status(id).state, ProcessState::Running);
    playTo(2.0);
    QCOMPARE(status(id).state, stops ? ProcessState::Restarting : ProcessState::Running);
  }

  // Expirations that a program has not read yet outlast a pause and a change of speed.
  void aTimersExpirationsAreAllCounted() {
    ManagedProcess process = python({"-u", "-c", R"(import ctypes, os, time
libc = ctypes.CDLL(None)
timer = libc.timerfd_create(1, 0)
before = time.monotonic()
libc.timerfd_settime(timer, 0, ctypes.byref((ctypes.c_long * 4)(1, 0, 1, 0)), None)
armed = time.monotonic()
time.sleep(2.4)
print("between two")
for seconds in (3.1, 0.1, 2.5):
    time.sleep(seconds)
    least = time.monotonic() - armed
    count = int.from_bytes(os.read(timer, 8), "little")
    print(count, least, time.monotonic() - before)
)"});
    m_manager->setTime(0.0, 2.0, SteadyClock::now());
    const int id = add(process);
    QTRY_VERIFY((look(), !m_lines.empty()));
    m_manager->setPaused(true, SteadyClock::now());
    waitForAnother("0.7");
    m_manager->setPaused(false, SteadyClock::now());
    QTRY_VERIFY((look(), status(id).state == ProcessState::Ended));
    look();
    QCOMPARE(m_lines.size(), std::size_t{4});
    int all = 0;
    for (std::size_t i = 1; i < m_lines.size(); ++i) {
      constexpr double inexact = 0.02;
      int count = 0;
      double least = 0.0, most = 0.0;
      QCOMPARE(std::sscanf(m_lines[i].c_str(), "%d %lf %lf", &count, &least, &most), 3);
      all += count;
      QVERIFY2(all >= int(least - inexact) && all <= int(most + inexact), m_lines[i].c_str());
    }
  }

  // A match that is slower than it was asked to be takes the program's clock with it.
  void theClockIsSteeredToTheMatch() {
    const auto clock = ProgramClock::create();
    QVERIFY(clock);
    const auto begin = SteadyClock::now();
    const auto at = [begin](double seconds) { return after(begin, seconds); };
    (void)(*clock)->start(8.0, begin);
    QCOMPARE((*clock)->seconds(at(2.0)), 16.0);
    (*clock)->setRate(0.0, at(2.0));
    QCOMPARE((*clock)->seconds(at(7.0)), 16.0);
    (*clock)->setRate(1.0, at(7.0));
    QCOMPARE((*clock)->seconds(at(8.0)), 17.0);
    // Passed through while it is right; else a little faster or slower, and never backwards.
    QCOMPARE(ProgramClock::rateFor(0.019, 1.0), 1.0);
    QCOMPARE(ProgramClock::rateFor(-0.1, 1.0), 0.9);
    QCOMPARE(ProgramClock::rateFor(0.1, 8.0), 8.0);
    QCOMPARE(ProgramClock::rateFor(1.0, 8.0), 9.0);
    QCOMPARE(ProgramClock::rateFor(-100.0, 8.0), 4.0);
    QCOMPARE(ProgramClock::rateFor(100.0, 8.0), 16.0);
  }

  // A match is late now and then, and never early: a correction that ended halfway would leave its
  // programs ahead of it for good, at a high speed by several of their cycles.
  void aCorrectionGoesAllTheWay_data() {
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("late");
    QTest::newRow("x1") << 1.0 << 0.05;
    QTest::newRow("x8") << 8.0 << 0.3;
    QTest::newRow("x8, early") << 8.0 << -0.3;
    QTest::newRow("x50") << 50.0 << 2.0;
  }
  void aCorrectionGoesAllTheWay() {
    QFETCH(double, speed);
    QFETCH(double, late);
    m_manager->setTime(0.0, speed, SteadyClock::now());
    const int id = add(python({"-c", "import time\ntime.sleep(600)\n"}));
    QTRY_VERIFY_WITH_TIMEOUT((look(), page(id)), 60'000);
    // The times are made up: nobody waits.
    const auto begin = SteadyClock::now();
    const auto ahead = [&](SteadyClock::time_point now) {  // of the computer's clock, s
      const pitchboard_time_page read = page(id).value();
      const auto since = double(now.time_since_epoch().count() - read.since);
      return (double(read.offset) + since * (read.rate - 1.0)) * 1e-9;
    };
    double first = 0.0, behind = 0.0;
    for (int i = 0; i <= 400; ++i) {
      const double passed = 0.05 * i;
      const auto now = after(begin, passed);
      const double match = speed * passed - (passed > 1.0 ? late : 0.0);
      m_manager->setTime(match, speed, now);
      if (i == 0) first = ahead(now);
      behind = match - (passed + ahead(now) - first);
    }
    QVERIFY2(std::abs(behind) < 0.004 * speed, qPrintable(QString::number(behind)));
  }

  // Nothing can be loaded into it.
  void aStaticProgramIsNamedWithTheReason() {
    ManagedProcess process = python({});
    process.spec.command = {
        (QCoreApplication::applicationDirPath() + "/static_sleeper").toStdString()};
    m_manager->setTime(0.0, 8.0, SteadyClock::now());
    const int id = add(process);
    QTRY_VERIFY((look(), !m_realTime.empty()));
    QCOMPARE(m_realTime.front().detail, std::string(whyRealTime(ProcessClock::RealNotLoaded)));
    QCOMPARE(status(id).clock, ProcessClock::RealNotLoaded);
    QCOMPARE(status(id).achieved, 1.0);
  }

  // The dynamic linker loads nothing of ours into a program that runs with other rights.
  void aSetuidProgramIsNamedWithTheReason() {
    const QTemporaryDir dir;
    const QString program = setuidSleep(dir);
    if (program.isEmpty()) QSKIP("only root can make a program of another user");
    ManagedProcess process = python({});
    process.spec.command = {program.toStdString(), "600"};
    m_manager->setTime(0.0, 8.0, SteadyClock::now());
    const int id = add(process);
    QTRY_VERIFY((look(), !m_realTime.empty()));
    QCOMPARE(m_realTime.front().detail, std::string(whyRealTime(ProcessClock::RealNotLoaded)));
    QCOMPARE(status(id).clock, ProcessClock::RealNotLoaded);
  }
};

PITCHBOARD_TEST(TestProcessClocks)

}  // namespace tst_process_clocks

#include "tst_process_clocks.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/process_supervisor.h>

#include <fcntl.h>
#include <unistd.h>
#include <QDir>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

namespace tst_process_supervisor {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;

namespace {

ChildSpec shell(const char* script, int robot = 1) {
  return {{robot}, "test", {"sh", "-c", script}};
}

QByteArray statusLine(pid_t pid, const QByteArray& name) {
  QFile file(QString("/proc/%1/status").arg(pid));
  if (!file.open(QIODevice::ReadOnly)) return {};
  for (const QByteArray& line : file.readAll().split('\n')) {
    if (line.startsWith(name + ':')) return line.mid(name.size() + 1).trimmed();
  }
  return {};
}

// A zombie that its new parent has not collected yet does not run any more.
bool runs(pid_t pid) {
  const QByteArray state = statusLine(pid, "State");
  return !state.isEmpty() && state[0] != 'Z' && state[0] != 'X';
}

}  // namespace

class TestProcessSupervisor : public QObject {
  Q_OBJECT

  static bool ended(ProcessSupervisor& supervisor, std::size_t child = 0) {
    supervisor.poll();
    return supervisor.children()[child].state != ChildState::Running;
  }
  static bool wrote(ProcessSupervisor& supervisor, const char* line, std::size_t child = 0) {
    supervisor.poll();
    return supervisor.children()[child].lastOutput == line;
  }

 private slots:
  void ends_data() {
    QTest::addColumn<QByteArray>("script");
    QTest::addColumn<bool>("failed");
    QTest::addColumn<QByteArray>("detail");
    QTest::newRow("well") << QByteArray("exit 0") << false << QByteArray("exit code 0");
    QTest::newRow("code") << QByteArray("exit 3") << true << QByteArray("exit code 3");
    QTest::newRow("crash") << QByteArray("kill -SEGV $$") << true
                           << QByteArray("killed by signal 11 (Segmentation fault)");
    QTest::newRow("SIGTERM of somebody")
        << QByteArray("kill $$") << true << QByteArray("killed by signal 15 (Terminated)");
  }
  void ends() {
    QFETCH(QByteArray, script);
    QFETCH(bool, failed);
    QFETCH(QByteArray, detail);
    ProcessSupervisor supervisor;
    const auto handle = supervisor.start(shell(script.constData()));
    QVERIFY(handle);
    QTRY_VERIFY(ended(supervisor));
    const ChildStatus& child = supervisor.children().front();
    QCOMPARE(child.handle, *handle);
    QCOMPARE(child.state, failed ? ChildState::Failed : ChildState::Ended);
    QCOMPARE(QByteArray::fromStdString(child.detail), detail);
  }

  void collectsLines() {
    ProcessSupervisor supervisor;
    QVERIFY(supervisor.start(shell("printf 'one\\r\\n\\n'; echo two >&2; printf 'no end'")));
    QTRY_VERIFY(ended(supervisor));
    std::vector<std::string> texts;
    for (const ChildLine& line : supervisor.takeLines()) texts.push_back(line.text);
    QCOMPARE(texts, (std::vector<std::string>{"one", "", "two", "no end"}));
    QCOMPARE(supervisor.children().front().lastOutput, std::string("no end"));
    QVERIFY(supervisor.takeLines().empty());
  }

  void cutsLongLinesBetweenCharacters() {
    ProcessSupervisor supervisor;
    QVERIFY(supervisor.start(
        {{1},
         "test",
         {"python3", "-c", "import os; os.write(1, b'x' * 999 + b'\\xc3\\xa9' * 900000)"}}));
    QTRY_VERIFY(ended(supervisor));
    const std::vector<ChildLine> lines = supervisor.takeLines();
    QCOMPARE(lines.size(), std::size_t{1});
    QCOMPARE(lines[0].text, std::string(999, 'x'));
  }

  void floodIsBounded_data() {
    QTest::addColumn<QByteArray>("script");
    QTest::newRow("lines") << QByteArray("exec yes");
    QTest::newRow("one endless line") << QByteArray("printf 'ready\\nx'; exec cat /dev/zero");
  }
  void floodIsBounded() {
    QFETCH(QByteArray, script);
    ProcessSupervisor supervisor;
    QVERIFY(supervisor.start(shell(script.constData())));
    const bool lines = script.contains("yes");
    if (!lines) QTRY_VERIFY(wrote(supervisor, "ready"));
    for (int i = 0; i < 50; ++i) supervisor.poll();  // returns although there is always more
    if (lines) QTRY_VERIFY((supervisor.poll(), supervisor.droppedLines() > 100'000));
    supervisor.stopAll(5s);
    const std::vector<ChildLine> taken = supervisor.takeLines();
    QCOMPARE(taken.size(), lines ? ProcessSupervisor::maxLines : std::size_t{2});
    QVERIFY(taken.back().text.size() <= ProcessSupervisor::maxLineBytes);
  }

  void stopWaitsForAnOrderlyEnd() {
    ProcessSupervisor supervisor;
    QVERIFY(supervisor.start(
        shell("trap 'echo bye; exit 0' TERM; echo ready; while :; do sleep 0.02; done")));
    QTRY_VERIFY(wrote(supervisor, "ready"));
    supervisor.stopAll(20s);
    QCOMPARE(supervisor.children().front().state, ChildState::Ended);
    QCOMPARE(supervisor.children().front().detail, std::string("exit code 0"));
    QCOMPARE(supervisor.children().front().lastOutput, std::string("bye"));
  }

  void stopKillsWhoIgnoresIt() {
    ProcessSupervisor supervisor;
    QVERIFY(supervisor.start(shell("trap '' TERM; echo ready; while :; do sleep 0.05; done")));
    QTRY_VERIFY(wrote(supervisor, "ready"));
    supervisor.stop({1}, 100ms);
    const ChildStatus& child = supervisor.children().front();
    QCOMPARE(child.state, ChildState::Ended);  // we wanted it
    QCOMPARE(child.detail, std::string("killed by signal 9 (Killed)"));
    QVERIFY(!runs(child.pid));
  }

  void stopConcernsOneRobot() {
    ProcessSupervisor supervisor;
    for (const int robot : {1, 2, 1}) QVERIFY(supervisor.start(shell("exec sleep 600", robot)));
    supervisor.stop({1});
    const std::vector<ChildStatus>& children = supervisor.children();
    QCOMPARE(children[0].state, ChildState::Ended);
    QCOMPARE(children[1].state, ChildState::Running);
    QCOMPARE(children[2].state, ChildState::Ended);
    QVERIFY(runs(children[1].pid));
  }

  void destructorEndsAll() {
    pid_t pid = 0;
    {
      ProcessSupervisor supervisor;
      QVERIFY(supervisor.start(shell("exec sleep 600")));
      pid = supervisor.children().front().pid;
      QVERIFY(runs(pid));
    }
    QVERIFY(!runs(pid));
  }

  void grandchildrenEndToo_data() {
    QTest::addColumn<bool>("stopped");
    QTest::newRow("child ends by itself") << false;
    QTest::newRow("child is stopped") << true;
  }
  void grandchildrenEndToo() {
    QFETCH(bool, stopped);
    ProcessSupervisor supervisor;
    QVERIFY(supervisor.start(shell(stopped ? "sleep 600 & echo $!; wait" : "sleep 600 & echo $!")));
    QTRY_VERIFY((supervisor.poll(), !supervisor.children().front().lastOutput.empty()));
    const pid_t grandchild = std::stoi(supervisor.children().front().lastOutput);
    if (stopped) supervisor.stopAll();
    QTRY_VERIFY(ended(supervisor));
    QTRY_VERIFY(!runs(grandchild));
  }

  void inheritsNothing() {
    const int open = ::open("/dev/null", O_RDWR);  // without close-on-exec
    QVERIFY(open >= 0);
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    sigset_t blocked, old;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &blocked, &old);
    ProcessSupervisor supervisor;
    const auto handle = supervisor.start({{1}, "test", {"sleep", "600"}});
    pthread_sigmask(SIG_SETMASK, &old, nullptr);
    std::signal(SIGPIPE, before);
    ::close(open);
    QVERIFY(handle);
    const pid_t pid = supervisor.children().front().pid;
    const QDir descriptors(QString("/proc/%1/fd").arg(pid));
    // It opens and closes files of its own while it begins; what it inherits would stay.
    bool seen = false;
    const auto hasOnlyItsOwn = [&] {
      const QStringList now =
          descriptors.entryList(QDir::AllEntries | QDir::System | QDir::NoDotAndDotDot);
      return seen = seen || now == QStringList{"0", "1", "2"};
    };
    QTRY_VERIFY(hasOnlyItsOwn());
    QCOMPARE(QFile::symLinkTarget(descriptors.filePath("0")), QString("/dev/null"));
    QCOMPARE(statusLine(pid, "SigBlk").toULongLong(nullptr, 16), 0ULL);
    QCOMPARE(statusLine(pid, "SigIgn").toULongLong(nullptr, 16), 0ULL);
    QCOMPARE(::getpgid(pid), pid);
  }

  void leavesNoDescriptors() {
    const auto count = [] {
      return QDir("/proc/self/fd").entryList(QDir::AllEntries | QDir::System).size();
    };
    const auto before = count();
    {
      ProcessSupervisor supervisor;
      QVERIFY(supervisor.start(shell("exit 0")));
      QVERIFY(supervisor.start(shell("exec sleep 600")));
      QVERIFY(!supervisor.start({{1}, "test", {"/no/such/program"}}));
    }
    QCOMPARE(count(), before);
  }

  void refusals() {
    QTemporaryDir folder;
    const auto file = [&folder](const char* name, QFile::Permissions extra) {
      QFile made(folder.filePath(name));
      if (!made.open(QIODevice::WriteOnly)) return std::string();
      made.write("neither a program nor a script\n");
      made.setPermissions(made.permissions() | extra);
      return made.fileName().toStdString();
    };
    const std::string plain = file("plain", {}), bad = file("bad", QFile::ExeOwner);
    const auto expect = [](const std::vector<std::string>& command, ErrorCode code,
                           const char* reason) {
      ProcessSupervisor supervisor;
      const auto handle = supervisor.start({{1}, "test", command});
      QVERIFY(!handle);
      const QByteArray text = QByteArray::fromStdString(handle.error().text());
      QVERIFY2(text.contains(reason) && text.startsWith("cannot start"), text.constData());
      QCOMPARE(handle.error().code, code);
      QVERIFY(supervisor.children().empty());
    };
    expect({"/no/such/program"}, ErrorCode::NotFound, "No such file or directory");
    expect({"no-such-program-at-all"}, ErrorCode::NotFound, "no such program");
    expect({plain}, ErrorCode::SystemError, "Permission denied");
    expect({bad}, ErrorCode::SystemError, "Exec format error");
    expect({folder.path().toStdString()}, ErrorCode::SystemError, "Is a directory");
    expect({}, ErrorCode::InvalidArgument, "no program");
  }

  void nothingSurvivesAKilledParent() {
    QProcess host;
    host.start(QCoreApplication::applicationDirPath() + "/supervisor_host", QStringList());
    QByteArray output;
    QTRY_VERIFY((output += host.readAllStandardOutput(), output.count('\n') >= 3));
    QList<pid_t> pids;
    for (const QByteArray& line : output.trimmed().split('\n')) {
      QVERIFY2(line.startsWith("child "), line.constData());
      pids.append(line.mid(6).toInt());
    }
    QCOMPARE(pids.size(), 3);
    for (const pid_t pid : pids) QVERIFY(runs(pid));
    host.kill();  // SIGKILL: it cannot tidy up
    QVERIFY(host.waitForFinished());
    for (const pid_t pid : pids) QTRY_VERIFY(!runs(pid));
  }
};

PITCHBOARD_TEST(TestProcessSupervisor)

}  // namespace tst_process_supervisor

#include "tst_process_supervisor.moc"

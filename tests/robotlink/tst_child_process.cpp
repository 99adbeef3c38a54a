// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/child_process.h>

#include <fcntl.h>
#include <unistd.h>
#include <QDir>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

namespace tst_child_process {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;

namespace {

ChildSpec shell(const char* script) {
  return {{1}, "test", {"sh", "-c", script}};
}

/// Collects what it writes, and how it ends.
struct Child {
  Result<ChildProcess> process;
  std::vector<std::string> lines;
  std::optional<ChildProcess::End> end;

  explicit Child(const ChildSpec& spec)
      : process(ChildProcess::start(spec, PITCHBOARD_BIN "/pitchboard-robot")) {}
  ~Child() {
    if (!process || end) return;
    process->signal(SIGKILL);
    QTRY_VERIFY(ended());
  }
  bool ended() {
    if (!end) end = process->poll(lines);
    return end.has_value();
  }
  bool wrote(const char* line) {
    (void)ended();
    return !lines.empty() && lines.back() == line;
  }
};

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

class TestChildProcess : public QObject {
  Q_OBJECT

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
    for (const bool isTeamProgram : {false, true}) {
      ChildSpec spec = shell(script.constData());
      spec.isTeamProgram = isTeamProgram;
      Child child(spec);
      QVERIFY(child.process);
      QTRY_VERIFY(child.ended());
      QCOMPARE(child.end->failed, failed);
      QCOMPARE(QByteArray::fromStdString(child.end->detail), detail);
    }
  }

  void collectsLines() {
    Child child(shell("printf 'one\\r\\n\\n'; echo two >&2; printf 'no end'"));
    QTRY_VERIFY(child.ended());
    QCOMPARE(child.lines, (std::vector<std::string>{"one", "", "two", "no end"}));
  }

  void cutsLongLinesBetweenCharacters() {
    Child child({{1},
                 "test",
                 {"python3", "-c", "import os; os.write(1, b'x' * 999 + b'\\xc3\\xa9' * 900000)"}});
    QTRY_VERIFY(child.ended());
    QCOMPARE(child.lines, std::vector<std::string>{std::string(999, 'x')});
  }

  void floodIsBounded_data() {
    QTest::addColumn<QByteArray>("script");
    QTest::newRow("lines") << QByteArray("exec yes");
    QTest::newRow("one endless line") << QByteArray("printf 'ready\\nx'; exec cat /dev/zero");
  }
  void floodIsBounded() {
    QFETCH(QByteArray, script);
    Child child(shell(script.constData()));
    const bool lines = script.contains("yes");
    if (!lines) QTRY_VERIFY(child.wrote("ready"));
    for (int i = 0; i < 50; ++i) QVERIFY(!child.ended());  // returns although there is always more
    if (lines) QTRY_VERIFY((child.ended(), child.lines.size() > 100'000));
    child.process->signal(SIGTERM);
    QTRY_VERIFY(child.ended());
    QVERIFY(lines || child.lines.size() == 2);
    QVERIFY(child.lines.back().size() <= ChildProcess::maxLineBytes);
  }

  void grandchildrenEndToo_data() {
    QTest::addColumn<bool>("stopped");
    QTest::newRow("child ends by itself") << false;
    QTest::newRow("child is stopped") << true;
  }
  void grandchildrenEndToo() {
    QFETCH(bool, stopped);
    Child child(shell(stopped ? "sleep 600 & echo $!; wait" : "sleep 600 & echo $!"));
    QTRY_VERIFY((child.ended(), !child.lines.empty()));
    const pid_t grandchild = std::stoi(child.lines.front());
    if (stopped) child.process->signal(SIGTERM);
    QTRY_VERIFY(child.ended());
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
    Child child({{1}, "test", {"sleep", "600"}});
    pthread_sigmask(SIG_SETMASK, &old, nullptr);
    std::signal(SIGPIPE, before);
    ::close(open);
    QVERIFY(child.process);
    const pid_t pid = child.process->pid();
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
      ChildSpec kept = shell("exec sleep 600");
      kept.isTeamProgram = true;
      Child all[]{Child(shell("exit 0")), Child(shell("exec sleep 600")), Child(kept),
                  Child({{1}, "test", {"/no/such/program"}})};
      QVERIFY(all[2].process && !all[3].process);
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
      for (const bool isTeamProgram : {false, true}) {
        ChildSpec spec{{1}, "test", command};
        spec.isTeamProgram = isTeamProgram;
        const Child child(spec);
        QVERIFY(!child.process);
        const QByteArray text = QByteArray::fromStdString(child.process.error().text());
        QVERIFY2(text.contains(reason) && text.startsWith("cannot start"), text.constData());
        QCOMPARE(child.process.error().code, code);
      }
    };
    expect({"/no/such/program"}, ErrorCode::NotFound, "No such file or directory");
    const std::string here = QDir::currentPath().toStdString();
    expect({"./no/such/program"}, ErrorCode::NotFound,
           ("there is no such file in " + here).c_str());
    expect({"no-such-program-at-all"}, ErrorCode::NotFound, "no such program");
    expect({plain}, ErrorCode::SystemError,
           "Permission denied; make the file executable (chmod +x)");
    expect({bad}, ErrorCode::SystemError, "Exec format error; a script needs a first line");
    expect({folder.path().toStdString()}, ErrorCode::SystemError, "Is a directory");
    expect({}, ErrorCode::InvalidArgument, "no program");
  }
};

PITCHBOARD_TEST(TestChildProcess)

}  // namespace tst_child_process

#include "tst_child_process.moc"

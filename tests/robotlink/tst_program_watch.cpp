// SPDX-License-Identifier: GPL-3.0-or-later
// When a program counts as changed: replaced by rename, written in parts, removed for a moment. The
// clock is the test's own.
#include <QTemporaryDir>
#include <QtTest>

#include <robotlink/rerun/program_watch.h>

namespace tst_program_watch {

using namespace pitchboard::link;
using namespace std::chrono_literals;

class TestProgramWatch : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  ProgramWatch::Time m_now{};

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }
  void write(const char* name, const QByteArray& text) const {
    QFile file(path(name));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write %s", name);
    file.write(text);
  }
  std::vector<RerunProcess> runs(const QString& program) const {
    return {{"decision", program.toStdString()}};
  }
  /// Looks every 50 ms; the first look that tells of a change, or -1.
  int changedAfter(ProgramWatch& watch, int looks = 40) {
    for (int i = 0; i < looks; ++i) {
      m_now += 50ms;
      if (watch.hasChanged(m_now)) return i;
    }
    return -1;
  }

 private slots:
  void filesOfAProgram() {
    QVERIFY(QDir().mkpath(path("robot")));
    write("robot/decide.py", "import helper");
    write("robot/helper.py", "1");
    write("robot/notes.txt", "1");
    write("other.py", "1");
    const auto files = programFiles(runs("python3 " + path("robot/decide.py") + " ${key} 0.1"));
    QCOMPARE(files.size(), std::size_t(2));
    QCOMPARE(files[0], path("robot/decide.py").toStdString());
    QCOMPARE(files[1], path("robot/helper.py").toStdString());
    // The programs of a profile, and itself.
    write("team.json", R"({"version": 1, "name": "team", "processes": [
      {"name": "decision", "command": ["python3", ")" +
                           path("robot/decide.py").toUtf8() + R"(", "${key}"]}]})");
    QCOMPARE(programFiles(runs(path("team.json"))).size(), std::size_t(3));
    QVERIFY(programFiles(runs("reference")).empty());
    QVERIFY(programFiles(runs("/no/such/program")).empty());
    QVERIFY(ProgramWatch(runs("striker")).isEmpty());
  }

  void aChangeCountsOnceItHasSettled() {
    write("decide.py", "a = 1");
    ProgramWatch watch(runs(path("decide.py")));
    QVERIFY(!watch.isEmpty());
    QCOMPARE(changedAfter(watch), -1);
    write("decide.py", "a = 123");
    const int looks = changedAfter(watch);
    QVERIFY2(looks >= 6 && looks <= 8, QByteArray::number(looks));  // 300 ms
    QCOMPARE(watch.changedFile(), std::string("decide.py"));
    QCOMPARE(changedAfter(watch), -1);  // once
  }

  void renamedOverIt() {
    write("decide.py", "a = 1");
    ProgramWatch watch(runs(path("decide.py")));
    write("decide.tmp", "a = 2");  // as long as before
    QVERIFY(::rename(qPrintable(path("decide.tmp")), qPrintable(path("decide.py"))) == 0);
    QVERIFY(changedAfter(watch) >= 0);
  }

  void aFileThatIsMissingOrEmptyIsAwaited() {
    write("decide.py", "a = 1");
    ProgramWatch watch(runs(path("decide.py")));
    QVERIFY(QFile::remove(path("decide.py")));
    QCOMPARE(changedAfter(watch), -1);
    write("decide.py", "");
    QCOMPARE(changedAfter(watch), -1);
    write("decide.py", "a = 2");
    QVERIFY(changedAfter(watch) >= 0);
  }

  void aFileThatGrowsIsAwaited() {
    write("decide.py", "a = 1");
    ProgramWatch watch(runs(path("decide.py")));
    QByteArray text;
    for (int part = 0; part < 10; ++part) {
      text += "more text\n";
      write("decide.py", text);
      QCOMPARE(changedAfter(watch, 4), -1);  // 200 ms are not enough
    }
    QVERIFY(changedAfter(watch) >= 0);
  }

  void aNeighbourCounts() {
    QVERIFY(QDir().mkpath(path("two")));
    write("two/decide.py", "a = 1");
    ProgramWatch watch(runs(path("two/decide.py")));
    write("two/new.py", "b = 1");  // nobody imports it yet
    QCOMPARE(changedAfter(watch), -1);
    write("two/decide.py", "import new");
    QVERIFY(changedAfter(watch) >= 0);
    write("two/new.py", "b = 12");
    QVERIFY(changedAfter(watch) >= 0);
    QCOMPARE(watch.changedFile(), std::string("new.py"));
  }
};

PITCHBOARD_TEST(TestProgramWatch)

}  // namespace tst_program_watch

#include "tst_program_watch.moc"

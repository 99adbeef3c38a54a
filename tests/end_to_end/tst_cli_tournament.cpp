// SPDX-License-Identifier: GPL-3.0-or-later
// `pitchboard-cli tournament`: the table, shards, what is wrong with a file; and teams that are
// played by other programs than ours.
#include <QFile>
#include <QTemporaryDir>
#include <QtTest>

#include "../support/program_run.h"

namespace tst_cli_tournament {

class TestCliTournament : public QObject {
  Q_OBJECT
  QTemporaryDir m_dir;

  QString in(const char* name) const { return m_dir.filePath(QLatin1String(name)); }
  QByteArray bytesOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }
  QString write(const char* name, const QByteArray& text) {
    QFile file(in(name));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
    file.write(text);
    return file.fileName();
  }
  static ProgramRun tournament(const QStringList& arguments) {
    return runProgram("pitchboard-cli", QStringList("tournament") + arguments);
  }
  /// One robot a side, which is told to play; `teams`: JSON.
  QString file(const char* name, const QByteArray& teams, const QByteArray& more = {}) {
    return write(name, R"({"version": 1, "name": "duel", "matches": 2, "stop": {"duration": 3}, )" +
                           more + R"("scenario": {"version": 1, "noise": "none",
      "ball": {"x": 0, "y": 0}, "writes": [{"variable": "COM_REFEREE", "value": 2}],
      "robots": [{"team": "blue", "number": 1, "x": -0.6, "y": 0, "behaviour": "naive"},
                 {"team": "red", "number": 1, "x": 0.6, "y": 0, "behaviour": "naive"}]},
      "teams": )" + teams + "}");
  }

 private slots:
  void theTableIsPrintedAndKept() {
    const QString path = file("duel.json", R"([{"name": "one"},
      {"name": "two", "robots": {"1": {"behaviour.distance_to_kick": 40}}}])",
                              R"("assertions": ["n(goals) == 2"], )");
    const ProgramRun run = tournament({path, "--out", in("whole"), "--junit", in("junit.xml")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.out.startsWith("Team  Played"), run.out.constData());
    QVERIFY2(run.out.contains("holds   one: n(goals) == 2"), run.out.constData());
    QVERIFY(bytesOf(in("junit.xml")).contains("no match had a problem"));
    QCOMPARE(bytesOf(in("whole/table.csv")).count('\n'), 3);

    QVERIFY(tournament({path, "--out", in("p1"), "--shard", "1/2"}).exitCode == 0);
    QVERIFY(tournament({path, "--out", in("p2"), "--shard", "2/2"}).exitCode == 0);
    const ProgramRun merged = runProgram(
        "pitchboard-cli", {"experiment", "merge", in("p1"), in("p2"), "--out", in("all")});
    QVERIFY2(merged.exitCode == 0 && merged.out.startsWith("Team  Played"), merged.err.constData());
    for (const char* name : {"/table.csv", "/runs.csv", "/report.html"}) {
      QCOMPARE(bytesOf(in("all") + name), bytesOf(in("whole") + name));
    }
    const ProgramRun again = tournament({path, "--out", in("whole")});
    QVERIFY(again.exitCode == 2 && again.err.contains("--resume"));
    QCOMPARE(tournament({path, "--out", in("whole"), "--resume"}).exitCode, 0);
    const ProgramRun more = tournament({path, "--out", in("six"), "--matches", "6", "--seed", "9"});
    QVERIFY2(more.exitCode == 1, more.err.constData());  // there are not two any more
    QVERIFY2(more.out.contains("FAILED  one: n(goals) == 2 (n(goals) = 6)"), more.out.constData());
  }

  void whatIsWrongIsReported() {
    const ProgramRun none = tournament({"paper-scenario-1", "--out", in("no")});
    QVERIFY2(none.exitCode == 2 && none.err.contains("it is no tournament"), none.err.constData());
    const QString path = file("bad.json", R"([{"name": "one"}, {"name": "two", "speed": 3}])");
    const ProgramRun bad = tournament({path, "--out", in("no")});
    QVERIFY2(bad.exitCode == 2 && bad.err.contains("bad.json:5: teams[1]"), bad.err.constData());
    QVERIFY(!QFile::exists(in("no")));
  }

  /// A team that is another pitchboard-robot takes its turns beside ours, which play inside: the
  /// same result as of ours alone.
  void anotherProgramTakesTurns() {
    const QByteArray profile = R"({"version": 1, "name": "other", "program": "./other-robot",
      "processes": [{"name": "decision", "reference": "decision", "only_for": "behaviour"}]})";
    write("other.json", profile);
    QVERIFY(QFile::link(PITCHBOARD_BIN "/pitchboard-robot", in("other-robot")));
    const QString path = file("other-duel.json",
                              R"([{"name": "ours"}, {"name": "other", "runtime": "other.json"}])");
    const ProgramRun run = tournament({path, "--out", in("other")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QString alone = file("alone.json", R"([{"name": "ours"}, {"name": "other"}])");
    QVERIFY(tournament({alone, "--out", in("alone")}).exitCode == 0);
    const auto hashes = [this](const char* folder) {
      QList<QByteArray> out;
      for (const QByteArray& line : bytesOf(in(folder) + "/runs.csv").trimmed().split('\n')) {
        out << line.split(',').value(6) + line.split(',').value(7);
      }
      return out;
    };
    QCOMPARE(hashes("other").size(), 3);
    QCOMPARE(hashes("other"), hashes("alone"));
    write("other.json", QByteArray(profile).replace("./other-robot", "./no-robot"));
    const ProgramRun missing = tournament({path, "--out", in("missing")});
    QVERIFY2(missing.exitCode == 2 && missing.err.contains("no-robot"), missing.err.constData());
  }
};

PITCHBOARD_TEST(TestCliTournament)

}  // namespace tst_cli_tournament

#include "tst_cli_tournament.moc"

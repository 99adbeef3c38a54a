// SPDX-License-Identifier: GPL-3.0-or-later
// `pitchboard-cli learn`: what it prints and writes, that a killed one continues, and that
// scenarios, tournaments and robots load the result.
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>

#include "../support/program_run.h"

namespace tst_cli_learn {

class TestCliLearn : public QObject {
  Q_OBJECT
  QTemporaryDir m_dir;

  QString in(const char* name) const { return m_dir.filePath(QLatin1String(name)); }
  QByteArray bytesOf(const QString& path) const {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }
  QString write(const char* name, const QByteArray& text) const {
    QFile file(in(name));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
    file.write(text);
    return file.fileName();
  }
  static ProgramRun cli(const QStringList& arguments) {
    return runProgram("pitchboard-cli", arguments);
  }
  QString file(const char* name, const QByteArray& generations, const QByteArray& more = {}) const {
    return write(name, R"({"version": 1, "name": "duel", "matches": 2, "stop": {"duration": 2},
      "scenario": {"version": 1, "noise": "realistic", "ball": {"x": 0, "y": 0},
      "writes": [{"variable": "COM_REFEREE", "value": 2}],
      "robots": [{"team": "blue", "number": 1, "x": -0.6, "y": 0, "behaviour": "naive"},
                 {"team": "red", "number": 1, "x": 0.6, "y": 0, "behaviour": "naive"}]},
      "opponents": [{"name": "usual"}], "ranges": {"distance_to_kick": {"from": 10, "to": 50}},
      "search": {"population": 6, "generations": )" +
                           generations + R"(}, "choose": {"last": 2, "best": 1, "matches": 2},
      "validate": {"matches": 2)" +
                           more + "}}");
  }

 private slots:
  void theResultIsPrintedKeptAndLoaded() {
    const QString path = file("duel.json", "2");
    const ProgramRun run = cli({"learn", path, "--out", in("whole"), "--progress"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.out.startsWith("Chosen: "), run.out.constData());
    QVERIFY2(run.out.contains("Team   Played"), run.out.constData());
    QVERIFY2(run.err.contains("generation 1 of 2: "), run.err.constData());
    const QString best = in("whole/best.json");
    const double distance = QJsonDocument::fromJson(bytesOf(best))
                                .object()["parameters"]
                                .toObject()["distance_to_kick"]
                                .toDouble();
    QVERIFY(distance >= 10.0 && distance <= 50.0);

    // A scenario with the file is one with its number.
    const auto hashWith = [&](const QByteArray& behaviour) {
      const QString scenario = write(
          "one.json", R"({"version": 1, "name": "one", "noise": "none", "ball": {"x": 0.6, "y": 0},
        "writes": [{"variable": "COM_REFEREE", "value": 2}],
        "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": )" +
                          behaviour + "}]}");
      const ProgramRun played =
          cli({"simulate", "--scenario", scenario, "--duration", "8", "--json"});
      if (played.exitCode != 0) qFatal("%s", played.err.constData());
      return QJsonDocument::fromJson(played.out).object()["state_hash"].toString();
    };
    const QString loaded = hashWith("{\"name\": \"naive\", \"from\": \"" + best.toUtf8() + "\"}");
    QVERIFY(!loaded.isEmpty());
    QCOMPARE(hashWith(R"({"name": "naive", "distance_to_kick": )" +
                      QByteArray::number(distance, 'g', 17) + "}"),
             loaded);
    // So does a tournament.
    const QByteArray tournament =
        R"({"version": 1, "name": "proof", "matches": 2, "stop": {"duration": 1},
      "scenario": {"version": 1, "noise": "none", "ball": {"x": 0, "y": 0},
      "robots": [{"team": "blue", "number": 1, "x": -1, "y": 0, "behaviour": "naive"},
                 {"team": "red", "number": 1, "x": 1, "y": 0, "behaviour": "naive"}]},
      "teams": [{"name": "a"}, {"name": "b", "robots": {"*": {"behaviour.from": "BEST"}}}]})";
    const ProgramRun proof = cli(
        {"tournament", write("proof.json", QByteArray(tournament).replace("BEST", best.toUtf8())),
         "--out", in("proof")});
    QVERIFY2(proof.exitCode == 0, proof.err.constData());

    const ProgramRun again = cli({"learn", path, "--out", in("whole")});
    QVERIFY(again.exitCode == 2 && again.err.contains("--resume"));
    const ProgramRun resumed = cli({"learn", path, "--out", in("whole"), "--resume"});
    QVERIFY2(resumed.exitCode == 0 && resumed.out == run.out, resumed.err.constData());
  }

  void aKilledOneContinues() {
    const QString path = file("long.json", "6");
    QVERIFY(cli({"learn", path, "--out", in("uncut")}).exitCode == 0);
    QProcess killed;
    killed.start(PITCHBOARD_BIN "/pitchboard-cli", {"learn", path, "--out", in("cut")});
    QTRY_VERIFY(bytesOf(in("cut/journal.jsonl")).contains("\"generation\":2,") ||
                killed.state() == QProcess::NotRunning);
    killed.kill();
    QVERIFY(killed.waitForFinished());
    const ProgramRun resumed = cli({"learn", path, "--out", in("cut"), "--resume"});
    QVERIFY2(resumed.exitCode == 0, resumed.err.constData());
    for (const char* name : {"/best.json", "/curve.csv", "/report.html", "/journal.jsonl"}) {
      QCOMPARE(bytesOf(in("cut") + name), bytesOf(in("uncut") + name));
    }
  }

  void whatIsWrongIsReported() {
    const ProgramRun fails =
        cli({"learn", file("fails.json", "1", R"(, "assertions": ["n(goals) == 3"])"), "--out",
             in("fails")});
    QVERIFY2(fails.exitCode == 1, fails.err.constData());
    QVERIFY2(fails.out.contains("FAILED  duel: n(goals) == 3 (n(goals) = 2)"),
             fails.out.constData());
    QVERIFY(bytesOf(in("fails/junit.xml")).contains("<failure"));
    const ProgramRun none = cli({"learn", in("none.json"), "--out", in("no")});
    QVERIFY(none.exitCode == 2 && none.err.contains("none.json"));
    const ProgramRun bad = cli({"learn", file("bad.json", "0"), "--out", in("no")});
    QVERIFY2(bad.exitCode == 2 && bad.err.contains("bad.json:7: search.generations"),
             bad.err.constData());
    QVERIFY(!QFile::exists(in("no")));
  }
};

PITCHBOARD_TEST(TestCliLearn)

}  // namespace tst_cli_learn

#include "tst_cli_learn.moc"

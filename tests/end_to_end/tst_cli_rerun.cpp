// SPDX-License-Identifier: GPL-3.0-or-later
// A recorded match runs through the documented Python programs again, as a user does it.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

#include <cmath>
#include <csignal>
#include <set>

#include "../support/guide_programs.h"
#include "../support/program_run.h"

namespace tst_cli_rerun {

class TestCliRerun : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  QString path(const char* name) const { return m_folder.filePath(name); }
  void write(const char* name, const QByteArray& text) const {
    QFile file(path(name));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write %s", name);
    file.write(text);
  }
  static QByteArray example(const char* name) {
    return contents(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/") + name);
  }
  ProgramRun rerun(const QStringList& more) const {
    return cli(QStringList{"rerun", path("match.mcap"), "--robot", "B1"} + more);
  }
  QJsonObject result(const QStringList& more) const {
    const ProgramRun run = rerun(more + QStringList{"--json"});
    if (run.exitCode != 0) qWarning("%s", run.err.constData());
    return QJsonDocument::fromJson(run.out).object();
  }
  static QJsonObject variable(const QJsonObject& result, const char* name) {
    for (const QJsonValue& one : result["variables"].toArray()) {
      if (one["name"] == name) return one.toObject();
    }
    return {};
  }

 private slots:
  void initTestCase() {
    write("ball_robot.py", example("ball_robot.py"));
    QByteArray changed = example("ball_robot.py");
    changed.replace("KICK_DISTANCE = 25", "KICK_DISTANCE = 35");
    write("changed.py", changed);
    write("team.json", R"({"version": 1, "name": "team", "cycle": "MATCH_CYCLE", "processes": [
      {"name": "decision", "command": ["python3", ")" +
                           path("ball_robot.py").toUtf8() + R"(", "${key}"]}]})");
    const ProgramRun run = cli({"record", "--scenario", "one-robot", "--noise", "realistic",
                                "--seed", "7", "--runtime", "B1=" + path("team.json"), "--speed",
                                "max", "--duration", "40", "-o", path("match.mcap")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
  }

  void theGuideShowsTheProgram() { QCOMPARE(whyNotShown("ball_robot.py", 45), QString()); }

  void theUnchangedProgramGivesTheSameBits() {
    const QJsonObject same = result({"--process", "decision=" + path("ball_robot.py")});
    QVERIFY(same["lock_step"].toBool());
    QVERIFY(same["compared"].toInt() > 2000);
    QCOMPARE(same["unequal"].toInt(-1), 0);
    QCOMPARE(same["notes"].toArray().size(), 0);
    QVERIFY(variable(same, "DECISION_ACTION_A")["compared"].toInt() > 2000);
  }

  /// What the recording says must come out is read from its own rows.
  void aPlantedChangeIsFoundWhereTheRecordingCrossesItAndNowhereElse() {
    const QString csv = path("rows.csv");
    const ProgramRun exported =
        cli({"export", path("match.mcap"), "--to", "csv-wide", "--robots", "B1", "--variables",
             "VISION_LOST,VISION_PAN_DEG,VISION_BALL_DIST", "-o", csv});
    QVERIFY2(exported.exitCode == 0, exported.err.constData());
    const QList<QByteArray> lines = contents(csv).split('\n');
    const QList<QByteArray> head = lines[0].trimmed().split(',');
    const auto column = [&](const char* name) { return head.indexOf(QByteArray("B1.") + name); };
    std::set<int> expected;
    for (qsizetype i = 1; i < lines.size(); ++i) {
      const QList<QByteArray> cells = lines[i].trimmed().split(',');
      if (cells.size() != head.size()) continue;
      const int tick = int(std::lround(cells[0].toDouble() * 60.0));
      const double distance = cells[column("VISION_BALL_DIST")].toDouble();
      const bool decides = tick > 0 && tick % 6 == 0 && cells[column("VISION_LOST")] != "1" &&
                           std::abs(int(cells[column("VISION_PAN_DEG")].toDouble())) <= 40;
      if (decides && distance >= 25.0 && distance < 35.0) expected.insert(tick);
    }
    QVERIFY2(!expected.empty(), "the robot did not come near the ball");
    const QJsonObject changed = result({"--process", "decision=" + path("changed.py")});
    const QJsonObject action = variable(changed, "DECISION_ACTION_A");
    for (const QJsonValue& one : action["stretches"].toArray()) {
      const int begin = int(std::lround(one["begin"].toDouble() * 60.0));
      const int end = int(std::lround(one["end"].toDouble() * 60.0));
      QVERIFY2(expected.count(begin) > 0, QByteArray::number(begin));
      QVERIFY(QStringList({"4", "5"}).contains(QString::number(one["rerun"].toInt())));
      const bool lasts = one["end"].toDouble() >= changed["until"].toDouble() - 1e-6;
      for (int tick = begin; tick < end + (lasts ? 1 : 0); ++tick) expected.erase(tick);
    }
    QVERIFY2(expected.empty(), QByteArray::number(int(expected.size())));
    for (const QJsonValue& one : changed["variables"].toArray()) {
      const bool follows = one["name"].toString().startsWith("DECISION_ACTION_");
      QVERIFY2(follows || one["unequal"].toInt() == 0, qPrintable(one["name"].toString()));
    }
    const ProgramRun table = rerun({"--process", "decision=" + path("changed.py")});
    QVERIFY2(table.out.contains("DECISION_ACTION_A") && table.out.contains("kick"),
             table.out.constData());
  }

  void programsAreFoundBesideTheRecording() {
    QVERIFY(!QFile::exists("changed.py"));
    const QJsonObject changed = result({"--process", "decision=changed.py"});
    QVERIFY(variable(changed, "DECISION_ACTION_A")["unequal"].toInt() > 0);
  }

  void whatDiffersUnchangedIsKeptAndLeftOut() {
    QByteArray random = example("ball_robot.py");
    random.replace("import sys\n", "import random\nimport sys\n");
    random.replace("    if tick % 6 == 0:",
                   "    ints[19] = random.randrange(1000000)\n    if tick % 6 == 0:");
    write("chance.py", random);
    const QStringList process{"--process", "decision=" + path("chance.py")};
    const ProgramRun same = rerun(process + QStringList{"--same"});
    QVERIFY2(same.exitCode == 0, same.err.constData());
    QVERIFY2(same.out.contains("DECISION_STATE"), same.out.constData());
    QVERIFY(!same.out.contains("DECISION_ACTION_A "));
    QVERIFY(QFile::exists(path("match.B1-decision.same.json")));
    const ProgramRun later = rerun(process);
    QVERIFY2(
        later.out.contains("Left out, because it differs without a change, too: DECISION_STATE"),
        later.out.constData());
    const ProgramRun all = rerun(process + QStringList{"--ignore-same"});
    QVERIFY2(!all.out.contains("Left out"), all.out.constData());
    QVERIFY(QFile::remove(path("match.B1-decision.same.json")));
  }

  void assertionsDecideTheExitCode() {
    write(
        "check.json",
        R"({"version": 1, "name": "kicks", "measures": {"kicks": "DECISION_ACTION_A == 4 || DECISION_ACTION_A == 5"},
      "assertions": ["differences == 0", "max(kicks) <= 1"]})");
    const QStringList check{"--check", path("check.json"), "--junit", path("junit.xml")};
    const ProgramRun good =
        rerun(QStringList{"--process", "decision=" + path("ball_robot.py")} + check);
    QVERIFY2(good.exitCode == 0 && good.out.contains("holds   differences == 0"),
             good.out.constData());
    const ProgramRun bad =
        rerun(QStringList{"--process", "decision=" + path("changed.py")} + check);
    QCOMPARE(bad.exitCode, 1);
    QVERIFY2(bad.out.contains("FAILED  differences == 0"), bad.out.constData());
    const QByteArray junit = contents(path("junit.xml"));
    QVERIFY2(junit.contains("failures=\"1\"") && junit.contains("tests=\"2\""), junit.constData());
  }

  void theNewRecordingHasBothRobots() {
    const QStringList process{"--process", "decision=" + path("changed.py"),
                              "--out",     path("both.mcap"),
                              "--report",  path("both.html")};
    QCOMPARE(rerun(process).exitCode, 0);
    const ProgramRun inspected = cli({"inspect", path("both.mcap"), "--events"});
    QVERIFY2(
        inspected.out.contains("B1 rerun decision differs from the recording: DECISION_ACTION_A"),
        inspected.out.constData());
    QVERIFY(contents(path("both.html")).contains("DECISION_ACTION_A"));
    const ProgramRun refused = rerun(process);
    QCOMPARE(refused.exitCode, 2);
    QVERIFY2(refused.err.contains("--force"), refused.err.constData());
    QCOMPARE(rerun(process + QStringList{"--force"}).exitCode, 0);
  }

  /// The example that sleeps between its cycles: the same actions, a little earlier or later.
  void aProgramThatDoesNotCooperateIsComparedOverTime() {
    const QString program =
        "decision=python3 " PITCHBOARD_SOURCE_DIR "/tests/end_to_end/naive_robot.py ${key} 0.1";
    const ProgramRun run = rerun({"--process", program, "--speed", "4", "--until", "8"});
    QVERIFY2(run.exitCode == 0 && run.out.contains("over time"), (run.err + run.out).constData());
    QVERIFY2(run.out.contains("--same first") || run.out.contains("No difference"),
             run.out.constData());
  }

  void manyRecordingsHaveALineEach() {
    QVERIFY(QFile::copy(path("match.mcap"), path("copy.mcap")));
    write("no-session.mcap", "text");
    const ProgramRun run =
        cli({"rerun", path("match.mcap"), path("no-session.mcap"), path("copy.mcap"), "--robot",
             "B1", "--process", "decision=" + path("changed.py")});
    QCOMPARE(run.exitCode, 2);  // the others run anyway
    QVERIFY2(run.err.contains("no-session.mcap"), run.err.constData());
    const QList<QByteArray> lines = run.out.trimmed().split('\n');
    QCOMPARE(lines.size(), 3);
    QVERIFY2(lines[1].contains("match.mcap") && lines[1].contains("kick"), run.out.constData());
    QCOMPARE(lines[2].mid(lines[2].indexOf(".mcap")).simplified(),
             lines[1].mid(lines[1].indexOf(".mcap")).simplified());
    const ProgramRun refused = cli({"rerun", path("match.mcap"), path("copy.mcap"), "--robot", "B1",
                                    "--process", "decision=naive", "--out", path("x.mcap")});
    QVERIFY2(refused.exitCode == 2 && refused.err.contains("--out"), refused.err.constData());
  }

  /// Editors let another file take the name, or write it in parts.
  void watchRunsAgainWhenTheProgramChanges() {
    const auto replace = [this](const QByteArray& text) {
      write("watched.new", text);
      QVERIFY(::rename(qPrintable(path("watched.new")), qPrintable(path("watched.py"))) == 0);
    };
    replace(example("ball_robot.py"));
    QProcess process;
    process.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli"),
                  {"rerun", path("match.mcap"), "--robot", "B1", "--process",
                   "decision=" + path("watched.py"), "--watch", "--out", path("watched.mcap")});
    QByteArray out, err;
    const auto saw = [&](QByteArray& all, const QByteArray& text, int count) {
      return QTest::qWaitFor(
          [&] {
            process.waitForReadyRead(20);
            out += process.readAllStandardOutput();
            err += process.readAllStandardError();
            return all.count(text) >= count || process.state() == QProcess::NotRunning;
          },
          120'000);
    };
    QVERIFY(saw(err, "Waiting for a change", 1));
    QVERIFY2(out.contains("No value differs."), (out + err).constData());
    QVERIFY(!out.contains("Since the last run"));

    QByteArray changed = example("ball_robot.py");
    changed.replace("KICK_DISTANCE = 25", "KICK_DISTANCE = 35");
    replace(changed);
    QVERIFY(saw(err, "Waiting for a change", 2));
    QVERIFY2(err.contains("watched.py has changed."), err.constData());
    QVERIFY2(out.contains("Since the last run, "), out.constData());
    QVERIFY(out.mid(out.indexOf("Since the last run")).contains("DECISION_ACTION_A"));
    QVERIFY(QFile::exists(path("watched.mcap")));

    // One that breaks is reported; the next one is compared with the last that ran.
    replace("import sys\nsys.exit('no idea')\n");
    QVERIFY(saw(err, "Waiting for a change", 3));
    QVERIFY2(err.contains("no idea"), err.constData());
    replace(changed);
    QVERIFY(saw(err, "Waiting for a change", 4));
    QVERIFY2(out.contains("Since the last run: no difference."), out.constData());

    QCOMPARE(::kill(static_cast<pid_t>(process.processId()), SIGINT), 0);
    QVERIFY(process.waitForFinished(30'000));
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 0);
    const ProgramRun ours = rerun({"--process", "decision=reference", "--watch"});
    QCOMPARE(ours.exitCode, 2);
    QVERIFY2(ours.err.contains("no file to watch") || ours.err.contains("behaviour"),
             ours.err.constData());
    const ProgramRun same =
        rerun({"--process", "decision=" + path("watched.py"), "--watch", "--same"});
    QVERIFY2(same.exitCode == 2 && same.err.contains("--same"), same.err.constData());
  }

  void mistakesAreNamed_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QStringList>("says");
    const QString match = "MATCH";
    QTest::newRow("robot") << QStringList{match, "--robot", "B7", "--process", "decision=reference"}
                           << QStringList{"B7", "B1"};
    QTest::newRow("process") << QStringList{match, "--robot", "B1", "--process",
                                            "thinking=reference"}
                             << QStringList{"thinking", "decision", "localization"};
    QTest::newRow("form") << QStringList{match, "--robot", "B1", "--process", "decision"}
                          << QStringList{"PROCESS=PROGRAM"};
    QTest::newRow("program") << QStringList{match, "--robot", "B1", "--process", "decision=strikr"}
                             << QStringList{"striker"};
    QTest::newRow("folders") << QStringList{match, "--robot", "B1", "--process",
                                            "decision=no-such.py"}
                             << QStringList{QDir::currentPath(), "beside the recording"};
    QTest::newRow("not what was recorded")
        << QStringList{match, "--robot", "B1", "--process", "decision=reference", "--same"}
        << QStringList{"team.json", "\"reference\" is not the unchanged program"};
    QTest::newRow("part") << QStringList{match,    "--robot", "B1", "--process", "decision=naive",
                                         "--from", "5:00"}
                          << QStringList{"5:00"};
    QTest::newRow("no recording") << QStringList{"no-such.mcap", "--robot", "B1", "--process",
                                                 "decision=naive"}
                                  << QStringList{"no-such.mcap"};
    QTest::newRow("check") << QStringList{match,         "--robot",        "B1",
                                          "--process",   "decision=naive", "--check",
                                          "no-such.json"}
                           << QStringList{"no-such.json"};
  }
  void mistakesAreNamed() {
    QFETCH(QStringList, arguments);
    QFETCH(QStringList, says);
    arguments.replaceInStrings("MATCH", path("match.mcap"));
    const ProgramRun run = cli(QStringList{"rerun"} + arguments);
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.contains("error: "), run.err.constData());
    for (const QString& part : says) QVERIFY2(run.err.contains(part.toUtf8()), run.err.constData());
  }
};

PITCHBOARD_TEST(TestCliRerun)

}  // namespace tst_cli_rerun

#include "tst_cli_rerun.moc"

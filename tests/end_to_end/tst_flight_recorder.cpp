// SPDX-License-Identifier: GPL-3.0-or-later
// pitchboard-agent records the blackboard of a robot that plays in a match, beside the match. The
// recording has what the match's own has, and the robot's program runs again through it.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

#include <set>

#include "../support/program_run.h"
#include "../support/segment_keys.h"

namespace tst_flight_recorder {

class TestFlightRecorder : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  QString path(const char* name) const { return m_folder.filePath(name); }
  void write(const char* name, const QByteArray& text) const {
    QFile file(path(name));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write %s", name);
    file.write(text);
  }
  /// The values of DECISION_ACTION_A one after the other, each change once.
  QList<QByteArray> actions(const char* session) const {
    const QString csv = path("rows.csv");
    const ProgramRun run = cli({"export", path(session), "--to", "csv-wide", "--robots", "B1",
                                "--variables", "DECISION_ACTION_A", "-o", csv, "--force"});
    if (run.exitCode != 0) qWarning("%s", run.err.constData());
    QList<QByteArray> values;
    for (const QByteArray& line : contents(csv).split('\n').mid(1)) {
      const QList<QByteArray> cells = line.trimmed().split(',');
      if (cells.size() != 2 || (!values.empty() && values.back() == cells[1])) continue;
      values.push_back(cells[1]);
    }
    return values;
  }
  QJsonObject rerun(const char* program) const {
    const ProgramRun run = cli({"rerun", path("flight.mcap"), "--robot", "B1", "--process",
                                "decision=" + path(program), "--slack", "0.5", "--json"});
    if (run.exitCode != 0) qWarning("%s", run.err.constData());
    return QJsonDocument::fromJson(run.out).object();
  }
  static QJsonObject action(const QJsonObject& result) {
    for (const QJsonValue& one : result["variables"].toArray()) {
      if (one["name"] == "DECISION_ACTION_A") return one.toObject();
    }
    return {};
  }
  static double secondsOf(const QJsonObject& variable) {
    double seconds = 0.0;
    for (const QJsonValue& one : variable["stretches"].toArray()) {
      seconds += one["end"].toDouble() - one["begin"].toDouble();
    }
    return seconds;
  }

 private slots:
  void initTestCase() {
    const QByteArray program =
        contents(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/ball_robot.py"));
    write("ball_robot.py", program);
    QByteArray changed = program;
    changed.replace("return 8 ", "return 18");
    QVERIFY(changed != program);
    write("changed.py", changed);
    write("team.json", R"({"version": 1, "name": "team", "cycle": "MATCH_CYCLE", "processes": [
      {"name": "decision", "command": ["python3", ")" +
                           path("ball_robot.py").toUtf8() + R"(", "${key}"]}]})");
    QProcess agent;
    agent.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-agent"),
                {"--robot", "1", "--key", QString::number(testKeyBase() + 100), "--to", "none",
                 "--record", path("flight.mcap"), "--record-rate", "500"});
    QByteArray reported;
    QTRY_VERIFY((reported += agent.readAllStandardError(), reported.contains("waiting for")));
    const ProgramRun match =
        cli({"record", "--scenario", "one-robot", "--noise", "realistic", "--seed", "7",
             "--runtime", "B1=" + path("team.json"), "--key-base", QString::number(testKeyBase()),
             "--speed", "1", "--duration", "20", "-o", path("match.mcap")});
    agent.terminate();
    QVERIFY2(match.exitCode == 0, match.err.constData());
    QVERIFY(agent.waitForFinished() && agent.exitCode() == 0);
    QVERIFY((reported += agent.readAllStandardError()).contains("reading blackboard"));
  }

  void itHasEveryActionOfTheMatch() {
    QList<QByteArray> match = actions("match.mcap"), flight = actions("flight.mcap");
    QVERIFY2(match.size() >= 30, match.join(' ').constData());
    // Before the match the board is empty, and for a moment behind its last row it is still there.
    for (auto* list : {&match, &flight}) {
      while (!list->empty() && list->front() == "0") list->removeFirst();
    }
    QVERIFY(flight.size() >= match.size() && flight.size() <= match.size() + 1);
    QCOMPARE(flight.first(match.size()), match);
  }

  // Its cycles fall between those of the match, so single decisions come out differently.
  void theProgramRunsAgain() {
    const QJsonObject same = action(rerun("ball_robot.py"));
    const QJsonObject changed = action(rerun("changed.py"));
    QVERIFY2(same["compared"].toInt() > 1000, QJsonDocument(same).toJson().constData());
    QVERIFY2(secondsOf(same) < 2.0, QJsonDocument(same).toJson().constData());
    QVERIFY2(secondsOf(changed) > 8.0, QJsonDocument(changed).toJson().constData());
    // What the change brings comes from the changed program alone. Which decision it replaces at
    // the beginning of a difference depends on the cycle.
    int planted = 0;
    for (const QJsonValue& one : changed["stretches"].toArray()) {
      QVERIFY2(one["recorded"] != 18.0, QJsonDocument(changed).toJson().constData());
      planted += one["rerun"] == 18.0 ? 1 : 0;
    }
    QVERIFY2(planted > 0, QJsonDocument(changed).toJson().constData());
  }

  /// A program announces its cycles, each with an input that it has left to it and an output that
  /// follows from that. The recording has each cycle's beginning and end, whatever the rate.
  void announcedCyclesAreRecorded() {
    constexpr std::size_t cycles = 60;
    write("announces.py", R"(
import ctypes, os, sys, time
libc = ctypes.CDLL(None)
libc.shmat.restype = ctypes.c_void_p
address = libc.shmat(libc.shmget(int(sys.argv[1]), 2048, 0), None, 0)
ints = (ctypes.c_int * 512).from_address(address)
futex = {"x86_64": 202, "aarch64": 98}[os.uname().machine]
def announce(value):
    ints[460] = value
    libc.syscall(futex, ctypes.c_void_p(address + 4 * 460), 1, 2**31 - 1, None, None, 0)
for n in range(1, 61):
    ints[19] = 1000 + n          # what it reads
    time.sleep(0.03)
    announce(n)                  # cycle n begins
    time.sleep(0.02)
    ints[18] = 2 * ints[19]      # what it writes
    announce(-n)                 # and is complete
    time.sleep(0.02)
)");
    const int key = testKeyBase() + 300;
    QCOMPARE(cli({"blackboard", "create", "--key", QString::number(key)}).exitCode, 0);
    QProcess agent;
    agent.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-agent"),
                {"--robot", "3", "--key", QString::number(key), "--to", "none", "--record",
                 path("cycles.mcap"), "--record-rate", "2", "--record-cycles", "decision=460"});
    QByteArray reported;
    QTRY_VERIFY((reported += agent.readAllStandardError(), reported.contains("reading ")));
    // The first reading shows a word that is not 0 yet; from then on each change is noticed.
    QProcess program;
    program.start("python3", {path("announces.py"), QString::number(key)});
    QVERIFY(program.waitForFinished() && program.exitCode() == 0);
    agent.terminate();
    QVERIFY(agent.waitForFinished() && agent.exitCode() == 0);
    QCOMPARE(cli({"blackboard", "remove", "--key", QString::number(key)}).exitCode, 0);
    const QString csv = path("cycles.csv");
    QCOMPARE(cli({"export", path("cycles.mcap"), "--to", "csv-wide", "--variables",
                  "DECISION_CYCLE,DECISION_ACTION_B,DECISION_STATE", "-o", csv, "--force"})
                 .exitCode,
             0);
    std::set<int> begun, complete;
    for (const QByteArray& line : contents(csv).split('\n').mid(1)) {
      const QList<QByteArray> cells = line.trimmed().split(',');
      if (cells.size() != 4) continue;
      const int n = cells[1].toInt();
      if (n > 0) {
        begun.insert(n);
        QCOMPARE(cells[3].toInt(), 1000 + n);
      }
      if (n < 0 && complete.insert(-n).second) QCOMPARE(cells[2].toInt(), 2 * (1000 - n));
    }
    // On a busy computer single ones may be missed; at 2 Hz alone 8 would be there.
    QVERIFY2(begun.size() >= cycles * 3 / 4, qPrintable(QString::number(begun.size())));
    QVERIFY2(complete.size() >= cycles * 3 / 4, qPrintable(QString::number(complete.size())));
  }

  /// Our own processes announce theirs with the time of their clock, so that the decision process
  /// runs again exactly.
  void ourOwnCyclesRunAgainExactly() {
    write("cycles.json", R"({"version": 1, "name": "cycles",
      "values": {"announce_cycles": "decision=460:461,localization=462:463"}, "processes": [
        {"name": "localization", "reference": "localization"},
        {"name": "decision", "reference": "decision"},
        {"name": "planning", "reference": "planning"}]})");
    QProcess agent;
    agent.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-agent"),
                {"--robot", "1", "--key", QString::number(testKeyBase() + 100), "--to", "none",
                 "--record", path("own.mcap"), "--record-rate", "500", "--catalog", "extended",
                 "--record-cycles", "decision=460:461,localization=462:463"});
    QByteArray reported;
    QTRY_VERIFY((reported += agent.readAllStandardError(), reported.contains("waiting for")));
    const ProgramRun match =
        cli({"simulate", "--scenario", "one-robot", "--noise", "realistic", "--seed", "7",
             "--runtime", "B1=" + path("cycles.json"), "--key-base", QString::number(testKeyBase()),
             "--speed", "0.5", "--duration", "8"});
    agent.terminate();
    QVERIFY2(match.exitCode == 0, match.err.constData());
    QVERIFY(agent.waitForFinished() && agent.exitCode() == 0);
    const auto rerunAs = [this](const char* decision) {
      const ProgramRun run = cli({"rerun", path("own.mcap"), "--robot", "B1", "--process",
                                  QStringLiteral("decision=") + decision, "--json"});
      if (run.exitCode != 0) qWarning("%s", run.err.constData());
      return QJsonDocument::fromJson(run.out).object();
    };
    const QJsonObject same = rerunAs("striker");
    const QByteArray text = QJsonDocument(same).toJson();
    QVERIFY2(text.contains("Every cycle of decision was recorded (DECISION_CYCLE)"),
             text.constData());
    QVERIFY2(!text.contains("are missing in the recording"), text.constData());
    QVERIFY2(same["compared"].toInt() > 5000 && same["unequal"].toInt() == 0, text.constData());
    // It is not that nothing can differ.
    QVERIFY(rerunAs("naive")["unequal"].toInt() > 1000);
  }
};

}  // namespace tst_flight_recorder

QTEST_GUILESS_MAIN(tst_flight_recorder::TestFlightRecorder)
#include "tst_flight_recorder.moc"

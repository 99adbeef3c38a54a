// SPDX-License-Identifier: GPL-3.0-or-later
// `import` from the command line: a ROS 2 recording becomes a session that the other commands read.
#include <QtTest>

#include "../support/match_recordings.h"
#include "../support/program_run.h"

namespace tst_cli_import {

class TestCliImport : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }
  static QString recording(const char* name) {
    return QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/recordings/") + QLatin1String(name);
  }

 private slots:
  void ros2RecordingIsASession() {
    const ProgramRun run = cli({"import", recording("robot_walks.mcap"), "-o", path("walk.mcap")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.out.contains("robots B3, B7"), run.out.constData());
    QVERIFY2(run.err.contains("note: /camera/image (sensor_msgs/Image): 20 messages were left out"),
             run.err.constData());
    const ProgramRun info = cli({"inspect", path("walk.mcap")});
    QVERIFY2(info.exitCode == 0 && info.out.contains("robot3/joint_states"), info.out.constData());
    const ProgramRun knee = cli({"export", path("walk.mcap"), "--to", "csv-wide", "--robots",
                                 "robot3/joint_states", "--variables", "position[left_knee]"});
    QVERIFY2(knee.out.startsWith("time,robot3/joint_states.position[left_knee]\n"),
             knee.out.constData());
    const ProgramRun plain = cli({"export", path("walk.mcap"), "--to", "csv-wide", "--robots", "B3",
                                  "--variables", "BELIEF_X"});
    QVERIFY2(plain.exitCode == 0, plain.err.constData());
    QVERIFY2(plain.out.startsWith("time,B3.BELIEF_X\n"), plain.out.constData());
    const ProgramRun picture =
        cli({"export", path("walk.mcap"), "--to", "svg", "--from", "5", "-o", path("walk.svg")});
    QVERIFY2(picture.exitCode == 0, picture.err.constData());
    QVERIFY(contents(path("walk.svg")).contains(">3<"));
    const ProgramRun report =
        cli({"export", path("walk.mcap"), "--to", "report", "-o", path("walk.html")});
    QVERIFY2(report.exitCode == 0 && contents(path("walk.html")).contains("B3"),
             report.err.constData());
  }

  void mappingIsPrintedAndUsed() {
    const ProgramRun printed = cli({"import", recording("robot_walks.mcap"), "--print-map"});
    QVERIFY2(printed.exitCode == 0 && printed.out.contains("/robot3/amcl_pose"),
             printed.err.constData());
    QByteArray text = printed.out;
    text.replace("\"blue\"", "\"red\"");
    QFile file(path("team.json"));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
    file.close();
    const ProgramRun run = cli({"import", recording("robot_walks.mcap"), "--map", path("team.json"),
                                "-o", path("red.mcap")});
    QVERIFY2(run.exitCode == 0 && run.out.contains("R3"), run.err.constData());
  }

  void recordingsAreAlignedByTheKickOff() {
    using match_recordings::writeRefereeLog;
    const QString log = path("log.yaml"), late = path("late.yaml"), to = path("match.mcap");
    writeRefereeLog(log.toStdString(), {{1.0, 2, 0}, {20.0, 3, 0}, {40.0, 4, 0}});
    writeRefereeLog(late.toStdString(), {{1.0, 2, 0}, {12.5, 3, 0}, {30.0, 4, 0}});
    const ProgramRun run = cli({"import", log, late, "--align", "kick-off", "-o", to});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const ProgramRun info = cli({"inspect", to});
    QVERIFY2(info.exitCode == 0 && info.out.contains("aligned by kick-off: late.yaml +7.500 s, "
                                                     "log.yaml +0.000 s\n"),
             info.out.constData());
    const ProgramRun json = cli({"inspect", to, "--json"});
    QVERIFY2(json.out.contains("\"aligned_by\":\"kick-off\""), json.out.constData());
    const ProgramRun none = cli(
        {"import", log, recording("json.mcap"), "--align", "kick-off", "-o", path("none.mcap")});
    QVERIFY2(none.exitCode == 2 && none.err.contains("json.mcap") && none.err.contains("by hand"),
             none.err.constData());
    QVERIFY(!QFile::exists(path("none.mcap")));
    QCOMPARE(cli({"import", log, late, "--align", "dawn", "-o", path("x.mcap")}).exitCode, 2);
  }

  void errorsSayWhatToDo() {
    const ProgramRun noOutput = cli({"import", recording("json.mcap")});
    QCOMPARE(noOutput.exitCode, 2);
    QVERIFY2(noOutput.err.startsWith("error: ") && noOutput.err.contains("-o SESSION.mcap"),
             noOutput.err.constData());
    QCOMPARE(cli({"import", recording("json.mcap"), "-o", path("json.mcap")}).exitCode, 0);
    const ProgramRun again = cli({"import", recording("json.mcap"), "-o", path("json.mcap")});
    QVERIFY2(again.exitCode == 2 && again.err.contains("--force"), again.err.constData());
    QCOMPARE(cli({"import", recording("json.mcap"), "-o", path("json.mcap"), "--force"}).exitCode,
             0);
    const ProgramRun none = cli({"import", path("nosuch.mcap"), "-o", path("x.mcap")});
    QVERIFY2(none.exitCode == 2 && none.err.contains("nosuch.mcap"), none.err.constData());
    const ProgramRun clock =
        cli({"import", recording("json.mcap"), "-o", path("y.mcap"), "--time", "sun"});
    QVERIFY2(clock.exitCode != 0, clock.err.constData());
  }
};

PITCHBOARD_TEST(TestCliImport)

}  // namespace tst_cli_import

#include "tst_cli_import.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// `find` and `statistics` on recordings of a match, of another program, and on what is no
// recording.
#include <QtTest>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <cmath>

#include "../support/program_run.h"

namespace tst_cli_find {

class TestCliFind : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }
  static QList<QByteArray> linesOf(const QByteArray& text) {
    return text.isEmpty() ? QList<QByteArray>() : text.trimmed().split('\n');
  }

 private slots:
  void initTestCase() {
    QVERIFY(QDir(m_folder.path()).mkpath(QStringLiteral("matches/old")));
    const auto run = [](const QStringList& arguments) {
      const ProgramRun done = cli(arguments);
      QVERIFY2(done.exitCode == 0, done.err.constData());
    };
    run({"record", "--scenario", "match-3v3", "--duration", "8", "-o", path("matches/b.mcap")});
    run({"record", "--scenario", "one-robot", "--duration", "4", "-o", path("matches/old/c.mcap")});
    run({"import", QStringLiteral(PITCHBOARD_TEST_DATA "/recordings/robot_walks.mcap"), "-o",
         path("matches/a.mcap")});
  }

  /// The same moments as in a table of the same columns.
  void momentsAreThoseOfTheTable() {
    const QString session = path("matches/b.mcap");
    const ProgramRun table = cli({"export", session, "--robots", "B1", "--variables", "TRUE_X"});
    const QList<QByteArray> rows = linesOf(table.out).mid(1);
    double sum = 0.0;
    for (const QByteArray& row : rows) sum += row.split(',')[1].toDouble();
    const double limit = sum / static_cast<double>(rows.size());
    QList<std::pair<double, double>> expected;
    bool held = false;
    for (const QByteArray& row : rows) {
      const double time = row.split(',')[0].toDouble();
      const bool holds = row.split(',')[1].toDouble() > limit;
      if (holds && !held) expected.append({time, time});
      if (held) expected.back().second = time;
      held = holds;
    }
    const QString condition = QStringLiteral("B1.TRUE_X > %1").arg(limit, 0, 'g', 17);
    const ProgramRun found = cli({"find", session, condition, "--json"});
    QCOMPARE(found.exitCode, expected.isEmpty() ? 1 : 0);
    const QList<QByteArray> lines = linesOf(found.out);
    QCOMPARE(lines.size(), expected.size());
    QVERIFY(!lines.isEmpty());
    for (qsizetype i = 0; i < lines.size(); ++i) {
      const QJsonObject moment = QJsonDocument::fromJson(lines[i]).object();
      QCOMPARE(moment["robot"].toString(), QStringLiteral("B1"));
      QCOMPARE(moment["from"].toDouble(), expected[i].first);
      QCOMPARE(moment["until"].toDouble(), expected[i].second);
      QVERIFY(moment["value"].toDouble() > limit);
    }
  }

  void foldersAndExitCodes() {
    const ProgramRun all = cli({"find", path("matches"), "known(TRUE_X)", "--csv"});
    QCOMPARE(all.exitCode, 0);
    const QList<QByteArray> lines = linesOf(all.out);
    QCOMPARE(lines[0], QByteArray("session,robot,from,until,value,value_time"));
    QCOMPARE(lines.size(), 1 + 6 + 1);  // six robots and one, in the order of the files
    QVERIFY(lines[1].contains("b.mcap,") && lines.back().contains("c.mcap,"));
    QVERIFY2(all.err.contains("note: 1 of 3 recordings do not have"), all.err.constData());
    const ProgramRun some = cli({"find", path("matches"), "known(TRUE_X)", "--robots", "B2"});
    QCOMPARE(linesOf(some.out).size(), 1);
    const ProgramRun none = cli({"find", path("matches/b.mcap"), "TRUE_X > 1000"});
    QCOMPARE(none.exitCode, 1);
    QVERIFY(none.out.isEmpty() && none.err.isEmpty());
    const ProgramRun wrong = cli({"find", path("matches"), "TRUE_XX > 1"});
    QCOMPARE(wrong.exitCode, 2);
    QVERIFY2(wrong.err.contains("did you mean TRUE_X"), wrong.err.constData());
    QCOMPARE(cli({"find", path("matches"), "TRUE_X >"}).exitCode, 2);
    QCOMPARE(cli({"find", path("nowhere"), "TRUE_X > 1"}).exitCode, 2);
    QCOMPARE(cli({"find", path("matches")}).exitCode, 2);
  }

  void importedRecordingsAreSearched() {
    const ProgramRun table = cli({"inspect", path("matches/a.mcap"), "--json"});
    QVERIFY(table.out.contains("BELIEF_X"));
    const ProgramRun found = cli({"find", path("matches/a.mcap"), "known(BELIEF_X)"});
    QVERIFY2(found.exitCode == 0, found.err.constData());
    // Before it is imported, it says what to do.
    const ProgramRun foreign =
        cli({"find", QStringLiteral(PITCHBOARD_TEST_DATA "/recordings/robot_walks.mcap"),
             path("matches/b.mcap"), "known(TRUE_X)"});
    QCOMPARE(foreign.exitCode, 0);
    QVERIFY2(foreign.err.contains("pitchboard-cli import"), foreign.err.constData());
  }

  /// A damaged file costs itself; the others are searched.
  void damageCostsTheFile() {
    QVERIFY(QDir(m_folder.path()).mkpath(QStringLiteral("damaged")));
    QFile bad(path("damaged/a.mcap"));
    QVERIFY(bad.open(QIODevice::WriteOnly) && bad.write("no recording") > 0);
    bad.close();
    QVERIFY(QFile::copy(path("matches/b.mcap"), path("damaged/b.mcap")));
    const ProgramRun found = cli({"find", path("damaged"), "B1.TRUE_X > -1000"});
    QCOMPARE(found.exitCode, 2);
    QCOMPARE(linesOf(found.out).size(), 1);
    QVERIFY2(found.err.contains("a.mcap"), found.err.constData());
  }

  void statisticsOfAPart() {
    const QString session = path("matches/b.mcap");
    const auto first = [](const QStringList& arguments) {
      const ProgramRun run = cli(QStringList{"statistics"} + arguments + QStringList{"--json"});
      return run.exitCode == 0 ? QJsonDocument::fromJson(run.out).array()[0].toObject()
                               : QJsonObject{{"error", QString::fromUtf8(run.err)}};
    };
    const QJsonObject part = first({session, "--expr", "TRUE_X * 100", "--robots", "B1", "--from",
                                    "2", "--until", "4", "--while", "known(TRUE_Y) && t >= 3"});
    QVERIFY2(!part.contains("error"), qPrintable(part["error"].toString()));
    QCOMPARE(part["unit"].toString(), QStringLiteral("cm"));
    QVERIFY(std::abs(part["n"].toInt() - 61) <= 1);
    QCOMPARE(part["missing"].toInt(), 0);
    QVERIFY(part["min_time"].toDouble() >= 3.0 && part["max_time"].toDouble() <= 4.0);
    QVERIFY(part["n_effective"].toDouble() <= part["n"].toDouble());
    const QJsonObject events = first({session, "--variables", "TRUE_X", "--between", "x", "y"});
    QVERIFY2(events["error"].toString().contains("There is no event \"x\""),
             qPrintable(events["error"].toString()));
    const ProgramRun text = cli({"statistics", session, "--variables", "DECISION_ACTION_A"});
    QVERIFY2(text.exitCode == 0 && text.out.contains(" %"), text.err.constData());
    const ProgramRun units =
        cli({"statistics", session, "--variables", "TRUE_X", "--against", "TRUE_YAW"});
    QCOMPARE(units.exitCode, 2);
    QCOMPARE(cli({"statistics", session}).exitCode, 2);
    QCOMPARE(cli({"statistics", session, "--variables", "TRUE_Q"}).exitCode, 2);
    QCOMPARE(cli({"statistics", path("none.mcap"), "--variables", "TRUE_X"}).exitCode, 2);
  }
};

PITCHBOARD_TEST(TestCliFind)

}  // namespace tst_cli_find

#include "tst_cli_find.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// Rules in recordings and in the runs of an experiment: the same file, the same numbers.
#include <QtTest>

#include <QJsonDocument>
#include <QJsonObject>
#include <QXmlStreamReader>

#include "../support/program_run.h"

namespace tst_cli_check {

class TestCliCheck : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }
  void write(const char* name, const QByteArray& text) const {
    QFile file(path(name));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
  }
  static QList<QByteArray> linesOf(const QByteArray& text) {
    return text.isEmpty() ? QList<QByteArray>() : text.trimmed().split('\n');
  }

 private slots:
  void initTestCase() {
    write("rules.json", R"json({"version": 1, "rules": [
  {"name": "wrong", "text": "Believes in a wrong place", "when": "BELIEF_ERROR > 25", "for": 0.2,
   "severity": "warning"},
  {"name": "far", "text": "Blue is far from the ball",
   "when": "hypot(TRUE_X - match.BALL_X, TRUE_Y - match.BALL_Y) > 3", "for": 0.5,
   "robots": ["B1", "B2", "B3"]},
  {"name": "never", "when": "TRUE_X > 1000"},
  {"name": "unknown", "when": "NOSUCH > 1"}
]})json");
    write("play.json", R"({"version": 1, "name": "play", "scenario": "match-3v3", "runs": 3,
  "seed": 11, "stop": {"duration": 15}, "record": "all", "rules": "rules.json",
  "placed": [{"time": 6, "who": "ball", "x": 4, "y": 2.5}]})");
    const ProgramRun played =
        cli({"experiment", path("play.json"), "--out", path("results"), "--jobs", "2"});
    QVERIFY2(played.exitCode == 1, played.err.constData());
    QVERIFY2(played.out.contains("FAILED  as the scenario: max(rule_far) == 0"),
             played.out.constData());
    QVERIFY2(played.out.contains("holds   as the scenario: max(rule_never) == 0"),
             played.out.constData());
    // A warning is no assertion; what is not known never holds.
    QVERIFY(!played.out.contains("max(rule_wrong) == 0"));
    QVERIFY2(played.out.contains("FAILED  as the scenario: max(rule_unknown) == 0"),
             played.out.constData());
  }

  void recordedRunsHaveTheSameNumbers() {
    QFile table(path("results/runs.csv"));
    QVERIFY(table.open(QIODevice::ReadOnly));
    const QList<QByteArray> rows = linesOf(table.readAll());
    const QList<QByteArray> names = rows[0].split(',');
    QCOMPARE(rows.size(), qsizetype{4});
    int broken = 0;
    for (int run = 1; run <= 3; ++run) {
      const QString session =
          path("results/sessions/run-%1.mcap").arg(run, 6, 10, QLatin1Char('0'));
      const ProgramRun checked = cli({"check", path("rules.json"), session, "--json"});
      QCOMPARE(checked.exitCode, 1);
      QMap<QString, int> counts;
      for (const QByteArray& line : linesOf(checked.out)) {
        const QJsonObject one = QJsonDocument::fromJson(line).object();
        if (one.contains("not_checked")) continue;
        ++counts[one["rule"].toString()];
        QVERIFY(one["until"].toDouble() - one["from"].toDouble() > 0.19);
      }
      for (const char* rule : {"wrong", "far", "never"}) {
        const qsizetype column = names.indexOf(QByteArray("rule_") + rule);
        QVERIFY(column > 0);
        QCOMPARE(rows[run].split(',')[column].toInt(), counts[rule]);
        broken += counts[rule];
      }
      QCOMPARE(rows[run].split(',')[names.indexOf("rule_unknown")], QByteArray());
    }
    QVERIFY(broken > 10);
  }

  /// A results folder has its rules, wherever their file is now.
  void resultsKeepTheRules() {
    QVERIFY(QFile::rename(path("rules.json"), path("elsewhere.json")));
    const ProgramRun again =
        cli({"experiment", "replay", path("results"), "--run", "2", "-o", path("again.mcap")});
    QVERIFY(QFile::rename(path("elsewhere.json"), path("rules.json")));
    QVERIFY2(again.exitCode == 0, again.err.constData());
    const auto linesIn = [this](const QString& session) {
      const ProgramRun run = cli({"check", path("rules.json"), session, "--csv"});
      QByteArrayList lines;
      for (const QByteArray& line : linesOf(run.out)) lines << line.mid(line.indexOf(','));
      return lines;
    };
    const QByteArrayList lines = linesIn(path("again.mcap"));
    QCOMPARE(lines[0], QByteArray(",rule,severity,robot,from,until,value,value_time"));
    QVERIFY(lines.size() > 2);
    QCOMPARE(lines, linesIn(path("results/sessions/run-000002.mcap")));
  }

  /// The rules may lie beside the situation tests that name them.
  void situationTestsTakeRules() {
    QVERIFY(QDir(m_folder.path()).mkpath(QStringLiteral("situations")));
    QVERIFY(QFile::copy(path("rules.json"), path("situations/rules.json")));
    write("situations/far.json", R"({"version": 1, "name": "far", "scenario": "match-3v3",
  "runs": 1, "seed": 11, "stop": {"duration": 10}, "rules": "rules.json"})");
    write("situations/near.json", R"({"version": 1, "name": "near", "scenario": "match-3v3",
  "runs": 1, "stop": {"duration": 5},
  "rules": [{"name": "out", "when": "abs(TRUE_X) > 20"}]})");
    const ProgramRun run = cli({"test", path("situations")});
    QCOMPARE(run.exitCode, 1);
    QVERIFY2(run.err.isEmpty(), run.err.constData());
    QVERIFY2(run.out.contains("FAILED  far, as the scenario: max(rule_far) == 0"),
             run.out.constData());
    QVERIFY2(run.out.contains("holds   near, as the scenario: max(rule_out) == 0"),
             run.out.constData());
    // A mistake in the rules is one of the test, with both places.
    write("situations/rules.json", "{}");
    const ProgramRun wrong = cli({"test", path("situations/far.json")});
    QCOMPARE(wrong.exitCode, 2);
    QVERIFY2(wrong.err.contains("rules: ") && wrong.err.contains("situations/rules.json:1"),
             wrong.err.constData());
  }

  void junitIsRead() {
    const QString xml = path("results.xml");
    const ProgramRun run =
        cli({"check", path("rules.json"), path("results/sessions"), "--junit", xml});
    QCOMPARE(run.exitCode, 1);
    QVERIFY2(run.err.contains("note: unknown was not checked in 3 of 3 recordings"),
             run.err.constData());
    QFile file(xml);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QXmlStreamReader reader(&file);
    QMap<QString, QStringList> results;  // of each test, over the suites
    QString test;
    int suites = 0;
    while (!reader.atEnd()) {
      if (reader.readNext() != QXmlStreamReader::StartElement) continue;
      const QString name = reader.name().toString();
      const auto attributes = reader.attributes();
      if (name == QLatin1String("testsuite")) {
        ++suites;
        QCOMPARE(attributes.value("tests").toInt(), 4);
        QCOMPARE(attributes.value("skipped").toInt(), 1);
      } else if (name == QLatin1String("testcase")) {
        test = attributes.value("name").toString();
        results[test] << QStringLiteral("passed");
      } else if (name == QLatin1String("failure") || name == QLatin1String("skipped")) {
        results[test].back() = name;
        QVERIFY(!attributes.value("message").isEmpty());
      }
    }
    QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
    QCOMPARE(suites, 3);
    QCOMPARE(results["unknown"], QStringList(3, QStringLiteral("skipped")));
    QCOMPARE(results["never"], QStringList(3, QStringLiteral("passed")));
    QCOMPARE(results["wrong"], QStringList(3, QStringLiteral("passed")));  // only a warning
    QVERIFY(results["far"].contains(QStringLiteral("failure")));
  }

  void exitCodes() {
    const QString session = path("results/sessions/run-000001.mcap");
    const auto check = [this, &session](const char* rules, const QStringList& more = {}) {
      write("one.json", QByteArray("{\"version\": 1, \"rules\": [") + rules + "]}");
      return cli(QStringList{"check", path("one.json"), session} + more);
    };
    const ProgramRun kept = check(R"({"name": "a", "when": "TRUE_X > 1000"})");
    QCOMPARE(kept.exitCode, 0);
    QCOMPARE(kept.out, QByteArray("1 rule, 1 recording: never broken\n"));
    QVERIFY(kept.err.isEmpty());
    const char* const warning = R"({"name": "a", "when": "TRUE_X > -1000", "severity": "warning"})";
    const ProgramRun warned = check(warning);
    QCOMPARE(warned.exitCode, 0);
    QVERIFY2(warned.out.contains("warning a: B1 0.000 to 15.000 s (15.000 s), worst"),
             warned.out.constData());
    const ProgramRun broken = check(R"({"name": "a", "when": "TRUE_X > -1000"})");
    QCOMPARE(broken.exitCode, 1);
    // What nobody can check did not pass.
    const ProgramRun missing = check(R"({"name": "a", "when": "TRUE_XX > 1"})");
    QCOMPARE(missing.exitCode, 2);
    QVERIFY2(missing.err.contains("did you mean TRUE_X"), missing.err.constData());
    const ProgramRun wrong = check(R"({"name": "a", "when": "TRUE_X >"})");
    QCOMPARE(wrong.exitCode, 2);
    QVERIFY2(wrong.err.contains("one.json:1: rules[0].when"), wrong.err.constData());
    write("bad.mcap", "no recording");
    QVERIFY(check(warning, {path("bad.mcap"), "--junit", path("bad.xml")}).exitCode == 2);
    QFile xml(path("bad.xml"));
    QVERIFY(xml.open(QIODevice::ReadOnly));
    QVERIFY(xml.readAll().contains("errors=\"1\""));
    // Another program's recording was not checked, either.
    const QString foreign = QStringLiteral(PITCHBOARD_TEST_DATA "/recordings/robot_walks.mcap");
    QCOMPARE(check(warning, {foreign}).exitCode, 2);
    QCOMPARE(cli({"check", path("none.json"), session}).exitCode, 2);
    QCOMPARE(cli({"check", path("one.json"), path("nowhere")}).exitCode, 2);
    QCOMPARE(cli({"check", path("one.json")}).exitCode, 2);
  }
};

PITCHBOARD_TEST(TestCliCheck)

}  // namespace tst_cli_check

#include "tst_cli_check.moc"

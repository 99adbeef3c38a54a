// SPDX-License-Identifier: GPL-3.0-or-later
// `pitchboard-cli calibrate`: the file and the report that it writes, and what it says of
// recordings that it cannot use.
#include <QtTest>

#include <QJsonDocument>
#include <QJsonObject>

#include "../support/program_run.h"

namespace tst_cli_calibrate {

class TestCliCalibrate : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_session, m_model;

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }

 private slots:
  void initTestCase() {
    m_session = path("drill.mcap");
    m_model = path("b1.json");
    const ProgramRun run =
        cli({"record", "--scenario", "calibration-drill", "--duration", "60", "-o", m_session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
  }

  void aModelAndAReportAreWritten() {
    const ProgramRun run =
        cli({"calibrate", m_session, "--robot", "B1", "-o", m_model, "--report", path("b1.html")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.out.contains("forward_fast"), run.out.constData());
    QVERIFY2(run.out.contains("Not estimated"), run.out.constData());
    const QJsonObject file = QJsonDocument::fromJson(contents(m_model)).object();
    const QJsonObject turn = file["calibration"].toObject()["values"].toObject()["turn"].toObject();
    QVERIFY(turn["low"].toDouble() < 40.0 && turn["high"].toDouble() > 38.0);
    QVERIFY(contents(path("b1.html")).contains("Simulated trajectories"));
    // The file is a robot model like any other.
    const ProgramRun play =
        cli({"simulate", "--scenario", "one-robot", "--robot-model", m_model, "--duration", "2"});
    QVERIFY2(play.exitCode == 0, play.err.constData());
    // An older result is only replaced when asked for.
    const QStringList again{"calibrate", m_session, "--robot", "B1", "-o", m_model};
    QCOMPARE(cli(again).exitCode, 2);
    QCOMPARE(cli(again + QStringList{"--force", "--to", "20"}).exitCode, 0);
  }

  void badRecordingsAreNamed_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("words");
    const QString out = path("no.json");
    const auto row = [&](const char* name, const QStringList& arguments, const char* words) {
      QTest::newRow(name) << (QStringList{"calibrate"} + arguments + QStringList{"-o", out})
                          << QString(words);
    };
    row("no such robot", {m_session, "--robot", "R4"}, "no robot \"R4\"; there are: B1, B2");
    row("another program's", {PITCHBOARD_TEST_DATA "/../../README.md", "--robot", "B1"}, "MCAP");
    row("no file", {path("none.mcap"), "--robot", "B1"}, "none.mcap");
    row("times", {m_session, "--robot", "B1", "--from", "soon"}, "--from must be a time");
    row("model", {m_session, "--robot", "B1", "--base", "kidsize"}, "did you mean");
  }
  void badRecordingsAreNamed() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, words);
    const ProgramRun run = cli(arguments);
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(QString::fromUtf8(run.err).contains(words), run.err.constData());
    QVERIFY(!QFile::exists(path("no.json")));
  }

  void aTruncatedRecordingIsUsedAsFarAsItGoes() {
    const QByteArray whole = contents(m_session);
    QFile cut(path("cut.mcap"));
    QVERIFY(cut.open(QIODevice::WriteOnly));
    cut.write(whole.left(whole.size() * 2 / 3));
    cut.close();
    const ProgramRun run =
        cli({"calibrate", cut.fileName(), "--robot", "B1", "-o", path("cut.json")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.out.contains("truncated"), run.out.constData());
  }
};

}  // namespace tst_cli_calibrate

QTEST_GUILESS_MAIN(tst_cli_calibrate::TestCliCalibrate)

#include "tst_cli_calibrate.moc"

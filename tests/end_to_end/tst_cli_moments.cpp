// SPDX-License-Identifier: GPL-3.0-or-later
// The command line records a match, goes on from a moment of it, and writes its report.
#include <QtTest>

#include <QJsonDocument>
#include <QJsonObject>

#include "../support/program_run.h"

namespace tst_cli_moments {

namespace {

using Run = ProgramRun;

}  // namespace

class TestCliMoments : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_session;

 private slots:
  void initTestCase() {
    m_session = m_folder.filePath("match.mcap");
    const Run run = cli({"record", "--duration", "12", "--noise", "paper", "-o", m_session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const Run again = cli({"record", "--duration", "1", "-o", m_session});
    QCOMPARE(again.exitCode, 2);
  }

  void aMomentIsContinued() {
    const QString moment = m_folder.filePath("moment.json");
    const Run run = cli({"simulate", "--from", m_session, "--at", "5", "--duration", "3", "--json",
                         "--save-moment", moment});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QFile file(moment);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray text = file.readAll();
    QVERIFY2(text.contains("at 8.0 s"), text.left(300).constData());
    // The same again: entered exactly, and played from there without chance.
    const QString second = m_folder.filePath("moment2.json");
    QCOMPARE(cli({"simulate", "--from", m_session, "--at", "0:05", "--duration", "0:03",
                  "--save-moment", second})
                 .exitCode,
             0);
    QFile other(second);
    QVERIFY(other.open(QIODevice::ReadOnly));
    QCOMPARE(other.readAll(), text);
  }

  void badRequestsAreSentences_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("words");
    QTest::newRow("before the beginning")
        << QStringList{"simulate", "--from", "SESSION", "--at", "-3"}
        << "is outside the session, which goes from 0:00 to 0:12";
    QTest::newRow("behind the end")
        << QStringList{"simulate", "--from", "SESSION", "--at", "9999"}
        << "--at: \"9999\" is outside the session, which goes from 0:00 to 0:12";
    QTest::newRow("another day") << QStringList{"simulate", "--from", "SESSION", "--at",
                                                "1999-12-31 14:03:20"}
                                 << "is outside the session";
    QTest::newRow("report of nothing")
        << QStringList{"export", "SESSION", "--to", "report", "-o", "x.html", "--from", "14:03:20"}
        << "for a time of day add its date or --clock";
    QTest::newRow("no time") << QStringList{"simulate", "--from", "SESSION"} << "--at";
    QTest::newRow("both") << QStringList{"simulate", "--from", "SESSION", "--at",
                                         "1",        "--seed", "3"}
                          << "--seed";
    QTest::newRow("no file") << QStringList{"simulate", "--from", "/nonexistent.mcap", "--at", "1"}
                             << "/nonexistent.mcap";
    QTest::newRow("report without a file")
        << QStringList{"export", "SESSION", "--to", "report"} << "-o FILE.html";
  }
  void badRequestsAreSentences() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, words);
    arguments.replaceInStrings("SESSION", m_session);
    const Run run = cli(arguments);
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.startsWith("error: ") && run.err.contains(words.toUtf8()),
             run.err.constData());
  }

  void theReportIsWritten() {
    const QString path = m_folder.filePath("report.html");
    const Run run = cli({"export", m_session, "--to", "report", "-o", path});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray html = file.readAll();
    // The studio paints; a build without it says so.
    const char* picture = QFile::exists(QStringLiteral(PITCHBOARD_BIN "/pitchboard"))
                              ? "data:image/svg+xml;base64,"
                              : "Could not paint the field";
    for (const char* words :
         {"<!DOCTYPE html>", picture, ">B1<", "Belief error", "0:12 of play recorded"}) {
      QVERIFY2(html.contains(words), words);
    }
    QCOMPARE(cli({"export", m_session, "--to", "report", "-o", path}).exitCode, 2);
    if (const QByteArray keep = qgetenv("PITCHBOARD_KEEP_REPORT"); !keep.isEmpty()) {
      QFile::remove(QString::fromUtf8(keep));
      QVERIFY(file.copy(QString::fromUtf8(keep)));
    }
  }
};

PITCHBOARD_TEST(TestCliMoments)

}  // namespace tst_cli_moments

#include "tst_cli_moments.moc"

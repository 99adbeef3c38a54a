// SPDX-License-Identifier: GPL-3.0-or-later
// What `export` makes besides tables of all rows: even times, times of day, pictures and videos.
#include <QtTest>

#include <QImage>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QXmlStreamReader>

#include "../support/program_run.h"

namespace {

ProgramRun cli(const QStringList& arguments) {
  return runProgram("pitchboard-cli", arguments);
}

QByteArray contents(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

class TestCliExport : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  QString m_session;

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }

 private slots:
  void initTestCase() {
    m_session = path("match.mcap");
    const ProgramRun run =
        cli({"record", "--scenario", "match-3v3", "--duration", "6", "-o", m_session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
  }

  void evenTimesAndTimesOfDay() {
    const ProgramRun run = cli({"export", m_session, "--to", "csv-even", "--rate", "4", "--robots",
                                "B1,match", "--variables", "TRUE_X,BALL_X", "--clock"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QList<QByteArray> lines = run.out.trimmed().split('\n');
    QCOMPARE(lines[0], QByteArray("time,clock,match.BALL_X,B1.TRUE_X"));
    QVERIFY2(lines.size() >= 24 && lines.size() <= 26, run.out.constData());
    static const QRegularExpression form(QStringLiteral(
        "^[0-9.e-]+,20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\d\\.\\d\\d\\dZ,-?[0-9.e-]+,"
        "-?[0-9.e-]+$"));
    for (const QByteArray& line : lines.mid(1)) {
      QVERIFY2(form.match(QString::fromLatin1(line)).hasMatch(), line.constData());
    }
    QCOMPARE(cli({"export", m_session, "--to", "csv-even", "--rate", "0"}).exitCode, 2);
  }

  void aPictureAsSvg() {
    const QString to = path("moment.svg");
    QCOMPARE(cli({"export", m_session, "--to", "svg", "--from", "3", "-o", to}).exitCode, 0);
    QXmlStreamReader xml(contents(to));
    int circles = 0;
    while (!xml.atEnd()) {
      if (xml.readNext() == QXmlStreamReader::StartElement && xml.name() == u"circle") ++circles;
    }
    QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
    QVERIFY(circles >= 7);  // six robots and the ball
    // What is there is left alone.
    const QByteArray before = contents(to);
    QCOMPARE(cli({"export", m_session, "--to", "svg", "-o", to}).exitCode, 2);
    QCOMPARE(contents(to), before);
    QCOMPARE(cli({"export", m_session, "--to", "svg"}).exitCode, 2);
  }

  void picturesAndVideosByFfmpeg() {
    if (QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty()) {
      QSKIP("ffmpeg is not installed");
    }
    const QString png = path("moment.png");
    ProgramRun run = cli({"export", m_session, "--to", "png", "--from", "3", "-o", png});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QImage picture(png);
    QVERIFY(picture.width() > 500 && picture.height() > 300);
    const QString mp4 = path("moment.mp4");
    run = cli({"export", m_session, "--to", "mp4", "--from", "2", "--until", "3", "--rate", "10",
               "-o", mp4});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QCOMPARE(contents(mp4).mid(4, 4), QByteArray("ftyp"));
    run = cli({"export", m_session, "--to", "mp4", "--rate", "1000", "-o", path("fast.mp4")});
    QCOMPARE(run.exitCode, 2);
    QVERIFY(!QFile::exists(path("fast.mp4")));
  }
};

QTEST_GUILESS_MAIN(TestCliExport)
#include "tst_cli_export.moc"

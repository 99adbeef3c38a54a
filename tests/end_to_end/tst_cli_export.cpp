// SPDX-License-Identifier: GPL-3.0-or-later
// What `export` makes besides tables of all rows: even times, times of day, pictures and videos;
// and what the commands that write files leave when the disk is full.
#include <QtTest>

#include <QDateTime>
#include <QImage>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QXmlStreamReader>
#include <cmath>

#include "../support/program_run.h"
#include "../support/small_disk.h"

namespace tst_cli_export {

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

  /// One robot of six, in everything that can be written.
  void chosenRobotsOnly() {
    const QString clip = path("one.mcap");
    const auto picture = [&](const QString& session, const QStringList& more, const char* name) {
      const ProgramRun run = cli(
          QStringList{"export", session, "--to", "svg", "--from", "3", "-o", path(name)} + more);
      return run.exitCode == 0 ? contents(path(name)) : QByteArray();
    };
    // The number of each robot stands on it, and where it believes to be.
    const auto robotsIn = [](const QByteArray& svg) {
      static const QRegularExpression label(QStringLiteral(">[1-9]<"));
      auto found = label.globalMatch(QString::fromUtf8(svg));
      int count = 0;
      for (; found.hasNext(); found.next()) ++count;
      return count / 2;
    };
    QCOMPARE(robotsIn(picture(m_session, {}, "all.svg")), 6);
    QCOMPARE(
        cli({"export", m_session, "--to", "mcap", "--robots", "B1,match", "-o", clip}).exitCode, 0);
    QCOMPARE(robotsIn(picture(m_session, {"--robots", "B1"}, "chosen.svg")), 1);
    QCOMPARE(robotsIn(picture(clip, {}, "clip.svg")), 1);
    const ProgramRun report =
        cli({"export", m_session, "--to", "report", "--robots", "B1", "-o", path("chosen.html")});
    QVERIFY2(report.exitCode == 0, report.err.constData());
    QVERIFY(contents(path("chosen.html")).contains("B1"));
    QVERIFY(!contents(path("chosen.html")).contains(">R2<"));
    const ProgramRun lines = cli({"export", m_session, "--to", "jsonl", "--robots", "B1"});
    QVERIFY(lines.out.contains("\"B1\"") && !lines.out.contains("\"R2\""));
    QVERIFY(!lines.out.contains("\"checkpoints\""));
    QCOMPARE(
        cli({"export", m_session, "--to", "svg", "--robots", "B9", "-o", path("no.svg")}).exitCode,
        2);
  }

  void evenTimesAndTimesOfDay() {
    const ProgramRun run = cli({"export", m_session, "--to", "csv-even", "--rate", "4", "--robots",
                                "B1,match", "--variables", "TRUE_X,BALL_X", "--clock"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QList<QByteArray> lines = run.out.trimmed().split('\n');
    QCOMPARE(lines[0], QByteArray("time,clock,B1.TRUE_X,match.BALL_X"));
    QVERIFY2(lines.size() >= 24 && lines.size() <= 26, run.out.constData());
    static const QRegularExpression form(QStringLiteral(
        "^[0-9.e-]+,20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\d\\.\\d\\d\\dZ,-?[0-9.e-]+,"
        "-?[0-9.e-]+$"));
    for (const QByteArray& line : lines.mid(1)) {
      QVERIFY2(form.match(QString::fromLatin1(line)).hasMatch(), line.constData());
    }
    QCOMPARE(cli({"export", m_session, "--to", "csv-even", "--rate", "0"}).exitCode, 2);
  }

  /// The clock that the table prints says where the part begins and ends.
  void aPartIsChosenByTimesOfDay() {
    const auto table = [this](const QStringList& part) {
      const ProgramRun run = cli(QStringList{"export", m_session, "--to", "csv-wide", "--robots",
                                             "match", "--variables", "BALL_X", "--clock"} +
                                 part);
      return run.exitCode == 0 ? run.out.trimmed().split('\n').mid(1) : QList{run.err};
    };
    const QList<QByteArray> all = table({});
    QVERIFY(all.size() > 200);
    const auto clockOf = [](const QByteArray& line) {
      return QString::fromLatin1(line.split(',').value(1));
    };
    const QString from = clockOf(all[60]), until = clockOf(all[180]);
    const auto first = [](const QList<QByteArray>& lines, qsizetype at) {
      return lines.value(at < 0 ? lines.size() + at : at).split(',').value(0).toDouble();
    };
    // Milliseconds are printed, and rows are 16 apart.
    const auto check = [&](const QString& a, const QString& b) {
      const QList<QByteArray> part = table({"--from", a, "--until", b});
      QVERIFY2(std::abs(first(part, 0) - first(all, 60)) < 0.02, part[0].constData());
      QVERIFY2(std::abs(first(part, -1) - first(all, 180)) < 0.02, part[0].constData());
    };
    check(from, until);
    check(from.mid(11), until.mid(11));  // without the day
    const auto local = [](const QString& clock) {
      return QDateTime::fromString(clock, Qt::ISODateWithMs).toLocalTime().toString("HH:mm:ss.zzz");
    };
    check(local(from), local(until));
    const ProgramRun wrong = cli({"export", m_session, "--from", "14:99"});
    QCOMPARE(wrong.exitCode, 2);
    QVERIFY2(wrong.err.contains("--from: \"14:99\" is not a time. Write seconds"), wrong.err);
    QCOMPARE(cli({"export", m_session, "--from", until, "--until", from}).exitCode, 2);
  }

  void optionsThatWouldBeIgnoredAreRefused_data() {
    QTest::addColumn<QStringList>("options");
    QTest::addColumn<QByteArray>("reason");
    const auto row = [](const char* line, const char* reason) {
      QTest::newRow(line) << QString(line).split(' ') << QByteArray(reason);
    };
    row("--interpolate", "--interpolate only works with --to csv-even, not with csv-wide");
    row("--to csv-long --rate 5", "--rate only works with --to csv-even, mp4, webm");
    row("--to csv-wide --rows-only", "--rows-only only works with --to jsonl, mcap");
    row("--to png --variables VOLTAGE -o a.png", "--variables only works with --to csv-wide");
  }
  void optionsThatWouldBeIgnoredAreRefused() {
    QFETCH(QStringList, options);
    QFETCH(QByteArray, reason);
    const ProgramRun run = cli(QStringList{"export", m_session} + options);
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.contains(reason), run.err);
  }

  void aPartIsChosenByMinutesAndSeconds() {
    const auto table = [this](const QString& from, const QString& until) {
      const ProgramRun run =
          cli({"export", m_session, "--robots", "match", "--from", from, "--until", until});
      return run.exitCode == 0 ? run.out : run.err;
    };
    const QByteArray part = table("2.5", "4");
    QVERIFY2(part.count('\n') > 80 && part.count('\n') < 100, part.left(300).constData());
    QCOMPARE(table("0:02.5", "00:04"), part);
    QCOMPARE(table("0:00:02.5", "0:00:04.0"), part);
    QCOMPARE(table("0", "0:06"), table("0", "6"));
  }

  void aPartOutsideIsRefusedWithTheRangeOfTheSession_data() {
    QTest::addColumn<QStringList>("part");
    QTest::newRow("from") << QStringList{"--from", "01:30"};
    QTest::newRow("until") << QStringList{"--until", "100"};
    QTest::newRow("before") << QStringList{"--until", "-5"};
    QTest::newRow("no date") << QStringList{"--from", "14:03:20"};
    QTest::newRow("by the clock") << QStringList{
        "--clock", "--from", QDateTime::currentDateTime().addSecs(-40'000).toString("HH:mm:ss")};
    QTest::newRow("date") << QStringList{"--from", "2001-02-03T14:03:20"};
  }
  void aPartOutsideIsRefusedWithTheRangeOfTheSession() {
    QFETCH(QStringList, part);
    for (const char* format : {"csv-wide", "svg", "mcap", "report"}) {
      const QString to = path("outside");
      const ProgramRun run =
          cli(QStringList{"export", m_session, "--to", QLatin1String(format), "-o", to} + part);
      QCOMPARE(run.exitCode, 2);
      QVERIFY2(run.err.contains("is outside the session, which goes from 0:00 to 0:06"), run.err);
      QVERIFY(!QFile::exists(to));
    }
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
    // Only who was asked for is painted.
    const QString few = path("few.svg");
    QCOMPARE(cli({"export", m_session, "--to", "svg", "--from", "3", "--robots", "B1", "-o", few})
                 .exitCode,
             0);
    QVERIFY(contents(few).size() > 1000 && contents(few).size() < contents(to).size());
    // What is there is left alone.
    const QByteArray before = contents(to);
    QCOMPARE(cli({"export", m_session, "--to", "svg", "-o", to}).exitCode, 2);
    QCOMPARE(contents(to), before);
    QCOMPARE(cli({"export", m_session, "--to", "svg"}).exitCode, 2);
  }

  /// The studio paints; without it there is a sentence, and no file.
  void withoutTheStudioThereIsNoPicture() {
    qputenv("PITCHBOARD_STUDIO", "/nonexistent/pitchboard");
    const QString to = path("none.png");
    const ProgramRun run = cli({"export", m_session, "--to", "png", "-o", to});
    const QString report = path("none.html");
    const ProgramRun page = cli({"export", m_session, "--to", "report", "-o", report});
    qunsetenv("PITCHBOARD_STUDIO");
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.contains("Install the studio"), run.err.constData());
    QVERIFY(!QFile::exists(to));
    QCOMPARE(page.exitCode, 0);
    QVERIFY(contents(report).contains("Could not paint the field"));
  }

  void picturesAndVideosByFfmpeg() {
    if (QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty()) {
      QSKIP("ffmpeg is not installed");
    }
    const QString png = path("moment.png");
    ProgramRun run = cli({"export", m_session, "--to", "png", "--from", "3", "-o", png});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QImage picture(png);
    QCOMPARE(picture.size(), QSize(1280, 910));
    const QString mp4 = path("moment.mp4");
    run = cli({"export", m_session, "--to", "mp4", "--from", "2", "--until", "3", "--rate", "10",
               "-o", mp4});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QCOMPARE(contents(mp4).mid(4, 4), QByteArray("ftyp"));
    // The video's first picture is the one of that moment, but for what the codec loses.
    const QString still = path("still.png"), first = path("first.png");
    QCOMPARE(cli({"export", m_session, "--to", "png", "--from", "2", "-o", still}).exitCode, 0);
    QCOMPARE(
        QProcess::execute("ffmpeg", {"-loglevel", "error", "-i", mp4, "-frames:v", "1", first}), 0);
    const QImage a =
        QImage(still).scaled(320, 228, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    const QImage b =
        QImage(first).scaled(320, 228, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    int other = 0;
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        if (std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > 24) ++other;
      }
    }
    QVERIFY2(other < 40, qPrintable(QString::number(other)));
    run = cli({"export", m_session, "--to", "mp4", "--rate", "1000", "-o", path("fast.mp4")});
    QCOMPARE(run.exitCode, 2);
    QVERIFY(!QFile::exists(path("fast.mp4")));
  }

  /// Whole or not at all: nothing new is left, and nothing old is lost.
  void aFullDiskLeavesNothingHalf_data() {
    QTest::addColumn<QStringList>("arguments");
    for (const char* format :
         {"csv-wide", "csv-even", "csv-long", "jsonl", "mcap", "report", "svg", "png", "mp4"}) {
      QTest::newRow(format) << QStringList{"export", m_session, "--to", QLatin1String(format),
                                           "-o"};
    }
    QTest::newRow("repair") << QStringList{"repair", m_session};
    const QStringList play{"simulate", "--scenario", "match-3v3", "--duration", "1", "--force"};
    QTest::newRow("trace") << play + QStringList{"--trace"};
    QTest::newRow("moment") << play + QStringList{"--save-moment"};
    QTest::newRow("catalog") << QStringList{
        "catalog", "import", QStringLiteral(PITCHBOARD_TEST_DATA "/catalogs/SharedMemory.py"),
        "--json", "-o"};
  }
  void aFullDiskLeavesNothingHalf() {
    QFETCH(QStringList, arguments);
    const QTemporaryDir folder;
    const QString file = folder.filePath("new");
    const auto names = [&folder] {
      return QDir(folder.path()).entryList(QDir::Files | QDir::Hidden);
    };
    const auto onFullDisk = [&] {
      const SmallDisk disk(100);
      return cli(arguments + QStringList{file});
    };
    const ProgramRun failed = onFullDisk();
    QVERIFY2(failed.exitCode > 0, failed.err.constData());
    QVERIFY2(failed.err.contains("error: "), failed.err.constData());
    QVERIFY2(names().isEmpty(), qPrintable(names().join(' ')));
    QFile old(file);
    QVERIFY(old.open(QIODevice::WriteOnly) && old.write("old") == 3);
    old.close();
    QVERIFY(onFullDisk().exitCode > 0);
    QCOMPARE(contents(file), QByteArray("old"));
    QCOMPARE(names(), QStringList("new"));
    // It was the disk: where there is room the same words make the file.
    QVERIFY(QFile::remove(file));
    const ProgramRun good = cli(arguments + QStringList{file});
    QVERIFY2(good.exitCode == 0, good.err.constData());
    QVERIFY(contents(file).size() > 100);
  }

  /// ffmpeg alone takes a video without its end for a good one.
  void aVideoThatDoesNotFitOnTheDiskIsRemoved() {
    if (QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty()) {
      QSKIP("ffmpeg is not installed");
    }
    const QStringList words{"export",  m_session, "--to",   "mp4", "--from", "2",
                            "--until", "3",       "--rate", "30",  "-o"};
    const QString whole = path("whole.mp4"), less = path("less.mp4");
    QVERIFY(cli(words + QStringList{whole}).exitCode == 0);
    ProgramRun run;
    {
      const SmallDisk disk(static_cast<rlim_t>(contents(whole).size() - 1));
      run = cli(words + QStringList{less});
    }
    QVERIFY2(run.exitCode == 2 && run.err.contains("error: "), run.err.constData());
    QVERIFY2(run.err.contains("reached the size limit"), run.err.constData());
    QCOMPARE(QDir(m_folder.path()).entryList({"less*", "*.part"}, QDir::Files | QDir::Hidden),
             QStringList());
  }

#ifdef SLOW_DISK
  /// Without its folder a new file can be gone after a power cut.
  void theFolderOfANewFileIsSynced_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("table") << QStringList{"export", m_session, "--to", "csv-wide", "-o"};
    QTest::newRow("clip") << QStringList{"export", m_session, "--to", "mcap", "-o"};
    QTest::newRow("picture") << QStringList{"export", m_session, "--to", "svg", "-o"};
    QTest::newRow("report") << QStringList{"export", m_session, "--to", "report", "-o"};
    QTest::newRow("repair") << QStringList{"repair", m_session};
    QTest::newRow("recording") << QStringList{"record",     "--scenario", "match-3v3",
                                              "--duration", "1",          "-o"};
  }
  void theFolderOfANewFileIsSynced() {
    QFETCH(QStringList, arguments);
    const QTemporaryDir folder;
    const QString file = folder.filePath("new"), notes = path("synced.txt");
    QFile::remove(notes);
    qputenv("LD_PRELOAD", SLOW_DISK);
    qputenv("SYNCED_FOLDERS", notes.toLocal8Bit());
    const ProgramRun run = cli(arguments + QStringList{file});
    qunsetenv("LD_PRELOAD");
    qunsetenv("SYNCED_FOLDERS");
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QList<QByteArray> lines = contents(notes).split('\n');
    const QByteArray place = QDir(folder.path()).canonicalPath().toLocal8Bit();
    const bool kept = std::any_of(lines.begin(), lines.end(), [&place](const QByteArray& line) {
      const QList<QByteArray> parts = line.split('\t');
      return parts[0] == place && parts.mid(1).contains("new");
    });
    QVERIFY2(kept, contents(notes).constData());
  }
#endif
};

PITCHBOARD_TEST(TestCliExport)

}  // namespace tst_cli_export

#include "tst_cli_export.moc"

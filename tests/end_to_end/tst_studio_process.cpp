// SPDX-License-Identifier: GPL-3.0-or-later
// The studio as a program: pictures, bad arguments, and that nothing outlives it.
#include <QImage>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

#include <robotlink/blackboard/system_v.h>

#include "studio_program.h"

namespace tst_studio_process {

using studio_program::Studio;

class TestStudioProcess : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  QImage m_timeOfSession;  // the timeline of a window with a session

 private slots:
  void aScreenshotHasTheSizeAskedFor() {
    const QString file = m_folder.filePath(QStringLiteral("shot.png"));
    Studio studio(m_folder);
    QVERIFY(
        studio.launch({QStringLiteral("--screenshot-to"), file, QStringLiteral("--after"),
                       QStringLiteral("0.5"), QStringLiteral("--size"), QStringLiteral("1280x800"),
                       QStringLiteral("--theme"), QStringLiteral("dark")}));
    QVERIFY(studio.waitForFinished(30000));
    QCOMPARE(studio.exitCode(), 0);
    QCOMPARE(QImage(file).size(), QSize(1280, 800));
    QTRY_COMPARE(Studio::robotProcesses(), 0);
    QCOMPARE(Studio::segments(), std::size_t(0));
  }

  void aScenarioIsDrawnWithoutAWindow() {
    const QString file = m_folder.filePath(QStringLiteral("field.png"));
    Studio studio(m_folder);
    QVERIFY(studio.launch({QStringLiteral("--render-scenario"), QStringLiteral("match-3v3"),
                           QStringLiteral("--picture"), file, QStringLiteral("--size"),
                           QStringLiteral("800x600")}));
    QVERIFY(studio.waitForFinished(30000));
    QCOMPARE(studio.exitCode(), 0);
    QCOMPARE(QImage(file).size(), QSize(800, 568));  // the field's shape within 800x600
    QCOMPARE(Studio::segments(), std::size_t(0));
  }

  void aSessionFromAShellIsShownInReplay_data() {
    QTest::addColumn<QString>("file");
    QTest::newRow("whole") << QStringLiteral("small.mcap");
    QTest::newRow("broken off") << QStringLiteral("plain_broken_off.mcap");
    QTest::newRow("not there") << QStringLiteral("no-such.mcap");
  }
  void aSessionFromAShellIsShownInReplay() {
    QFETCH(QString, file);
    const QString shot = m_folder.filePath(QStringLiteral("replay.png"));
    Studio studio(m_folder);
    QVERIFY(
        studio.launch({QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/sessions/") + file,
                       QStringLiteral("--screenshot-to"), shot, QStringLiteral("--after"),
                       QStringLiteral("1"), QStringLiteral("--size"), QStringLiteral("1280x800")}));
    QVERIFY(studio.waitForFinished(30000));
    QCOMPARE(studio.exitStatus(), QProcess::NormalExit);
    QCOMPARE(studio.exitCode(), 0);
    const QImage picture(shot);
    QCOMPARE(picture.size(), QSize(1280, 800));
    // The timeline is below: without a session there is no time to show on it.
    const QImage time = picture.copy(0, 690, 1200, 80);
    if (file == QStringLiteral("no-such.mcap"))
      QVERIFY(time != m_timeOfSession);
    else
      m_timeOfSession = time;
    // A session starts no robots.
    QCOMPARE(Studio::robotProcesses(), 0);
    QCOMPARE(Studio::segments(), std::size_t(0));
  }

  void replayStartsAtTheTimeThatIsGiven() {
    const auto timeAt = [this](const QStringList& more) {
      const QString shot = m_folder.filePath(QStringLiteral("at.png"));
      Studio studio(m_folder);
      const bool good =
          studio.launch(QStringList{PITCHBOARD_SOURCE_DIR "/tests/data/sessions/small.mcap",
                                    "--screenshot-to", shot, "--after", "1", "--size", "1280x800"} +
                        more) &&
          studio.waitForFinished(30000) && studio.exitCode() == 0;
      return good ? QImage(shot).copy(0, 690, 1200, 80) : QImage();
    };
    const QImage atBeginning = timeAt({});
    const QImage later = timeAt({"--at", "0:00.1"});
    QVERIFY(!atBeginning.isNull() && !later.isNull());
    QVERIFY(later != atBeginning);
    QCOMPARE(timeAt({"--at", "0.1"}), later);
  }

  void nothingIsLeftAfter_data() {
    QTest::addColumn<int>("signal");
    QTest::addColumn<bool>("clean");
    QTest::newRow("SIGTERM") << SIGTERM << true;
    QTest::newRow("SIGINT") << SIGINT << true;
    QTest::newRow("SIGKILL") << SIGKILL
                             << false;  // a guard does what the studio cannot do any more
  }
  void nothingIsLeftAfter() {
    QFETCH(int, signal);
    QFETCH(bool, clean);
    Studio studio(m_folder);
    QVERIFY(studio.launch({}));
    QTRY_VERIFY_WITH_TIMEOUT(Studio::robotProcesses() > 0, 20000);
    QTRY_COMPARE_WITH_TIMEOUT(Studio::segments(), std::size_t(8), 20000);
    ::kill(static_cast<pid_t>(studio.processId()), signal);
    QVERIFY(studio.waitForFinished(60'000));
    QTRY_COMPARE(Studio::robotProcesses(), 0);
    QTRY_COMPARE(Studio::segments(), std::size_t(0));
    if (!clean) return;
    QCOMPARE(studio.exitStatus(), QProcess::NormalExit);
    QCOMPARE(studio.exitCode(), 0);
  }

  void badArgumentsEndWithASentence_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("hasText");
    const auto row = [](const char* name, const QString& line, const char* hasText) {
      QTest::newRow(name) << line.split(QLatin1Char(' ')) << QString::fromUtf8(hasText);
    };
    row("option", QStringLiteral("--nonsense"), "nonsense");
    row("scenario", QStringLiteral("--scenario no-such"), "no-such");
    row("speed", QStringLiteral("--speed fast"), "--speed");
    row("speed below", QStringLiteral("--speed 0"), "--speed");
    row("size", QStringLiteral("--size 12"), "--size");
    row("size rest", QStringLiteral("--size 800x600x3"), "--size");
    row("theme", QStringLiteral("--theme pink"), "pink");
    row("physics", QStringLiteral("--physics jelly"), "jelly");
    row("noise", QStringLiteral("--noise loud"), "loud");
    const QString session = QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/sessions/small.mcap");
    row("time without a recording", QStringLiteral("--at 1:00"), "name the recording");
    row("time outside", session + QStringLiteral(" --at 9999"), "--at");
    row("no time", session + QStringLiteral(" --at soon"), "1:18.7");
    row("picture missing", QStringLiteral("--render-scenario match-3v3"), "--picture");
  }
  void badArgumentsEndWithASentence() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, hasText);
    Studio studio(m_folder);
    QVERIFY(studio.launch(arguments));
    QVERIFY(studio.waitForFinished(60'000));
    QCOMPARE(studio.exitCode(), 2);
    const QString error = QString::fromUtf8(studio.readAllStandardError());
    QVERIFY2(error.startsWith(QStringLiteral("error: ")), qPrintable(error));
    QVERIFY2(error.contains(hasText), qPrintable(error));
  }

  void helpShowsAnExample() {
    Studio studio(m_folder);
    QVERIFY(studio.launch({QStringLiteral("--help")}));
    QVERIFY(studio.waitForFinished(60'000));
    QCOMPARE(studio.exitCode(), 0);
    QVERIFY(studio.readAllStandardOutput().contains("Examples:\n  pitchboard "));
  }
};

PITCHBOARD_TEST(TestStudioProcess)

}  // namespace tst_studio_process

#include "tst_studio_process.moc"

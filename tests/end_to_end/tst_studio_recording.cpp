// SPDX-License-Identifier: GPL-3.0-or-later
// The studio as a program that records: however it is ended, the file is whole and nothing is left.
#include <QtTest>
#include <csignal>

#include <telemetry/formats/text_protocol.h>
#include <telemetry/session/session_reader.h>

#include "../support/test_socket.h"
#include "studio_program.h"

namespace tst_studio_recording {

using namespace pitchboard;
using studio_program::Studio;

namespace {

constexpr int longWait = 40'000;  // ms, on a machine that is busy otherwise

std::uint64_t rowsIn(const QString& path) {
  const auto session = telemetry::SessionReader::open(path.toStdString());
  if (!session || !session->range()) return 0;
  std::uint64_t rows = 0;
  session->rows(*session->range(), {}, [&rows](telemetry::GroupId, const telemetry::RowView&) {
    ++rows;
    return true;
  });
  return rows;
}

/// Of a robot and of the referee; the port behind the robot's is not the referee's.
std::pair<std::uint16_t, std::uint16_t> freePorts() {
  const TestSocket robot, first, second;
  return {robot.port(), first.port() == robot.port() + 1 ? second.port() : first.port()};
}

/// Nothing is to be missing or odd in it.
QByteArray faultOf(const QString& path) {
  const auto session = telemetry::SessionReader::open(path.toStdString());
  if (!session) return QByteArray::fromStdString(session.error().text());
  if (!session->complete()) return "the file has no index";
  if (!session->notes().empty()) return QByteArray::fromStdString(session->notes().front());
  return rowsIn(path) > 0 ? QByteArray() : QByteArray("the file has no rows");
}

}  // namespace

class TestStudioRecording : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  int m_files = 0;

  QString newPath() { return m_folder.filePath(QStringLiteral("%1.mcap").arg(++m_files)); }

 private slots:
  void itEndsWhileItRecords_data() {
    QTest::addColumn<QString>("mode");
    QTest::addColumn<QByteArray>("way");
    for (const char* mode : {"live", "inline", "separate"}) {
      for (const char* way : {"SIGTERM", "close", "quit"}) {
        QTest::addRow("%s, %s", mode, way) << QString::fromLatin1(mode) << QByteArray(way);
      }
    }
  }
  void itEndsWhileItRecords() {
    QFETCH(QString, mode);
    QFETCH(QByteArray, way);
    const QString path = newPath();
    QStringList arguments{QStringLiteral("--record"), path};
    std::uint16_t robotPort = 0;
    if (mode == QStringLiteral("live")) {
      const auto [free, refereePort] = freePorts();
      robotPort = free;
      arguments << QStringLiteral("--live") << QStringLiteral("--bind")
                << QStringLiteral("127.0.0.1") << QStringLiteral("--robots") << QStringLiteral("2")
                << QStringLiteral("--port-base") << QString::number(robotPort - 1)
                << QStringLiteral("--gamecontroller-port") << QString::number(refereePort);
    } else {
      arguments << QStringLiteral("--cognition") << mode;
    }
    Studio studio(m_folder);
    QVERIFY(studio.launch(arguments));
    const TestSocket robot;
    telemetry::TextMessage message;
    message.x = 150;
    QVERIFY2(QTest::qWaitFor(
                 [&] {
                   if (robotPort != 0) robot.send(robotPort, telemetry::encode(message));
                   return studio.state() != QProcess::Running || rowsIn(path) > 0;
                 },
                 longWait),
             studio.readAllStandardError());
    QCOMPARE(studio.state(), QProcess::Running);
    QCOMPARE(Studio::segments(), std::size_t(mode == QStringLiteral("separate") ? 8 : 0));

    if (way == "SIGTERM")
      studio.terminate();
    else
      studio.write(way + "\nother button\n");  // it asks first, because it records
    QVERIFY(studio.waitForFinished(longWait));
    const QByteArray words = studio.readAllStandardError();
    QVERIFY2(studio.exitStatus() == QProcess::NormalExit, words);
    QVERIFY2(studio.exitCode() == 0, words);
    QCOMPARE(faultOf(path), QByteArray());
    QCOMPARE(Studio::segments(), std::size_t(0));
    QTRY_COMPARE(Studio::robotProcesses(), 0);
  }

  void aMatchIsRecordedFromItsFirstTick() {
    const QString path = m_folder.filePath(QStringLiteral("new folder/first.mcap"));
    Studio studio(m_folder);
    QVERIFY(studio.launch({QStringLiteral("--record"), path, QStringLiteral("--cognition"),
                           QStringLiteral("inline"), QStringLiteral("--speed"),
                           QStringLiteral("max")}));
    QTRY_VERIFY_WITH_TIMEOUT(rowsIn(path) > 0, longWait);
    studio.terminate();
    QVERIFY(studio.waitForFinished(longWait));
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session && session->range());
    QCOMPARE_LE(session->range()->begin, 1.0 / 60 + 1e-9);
  }

  void aFileThatIsThereIsKept() {
    const QString path = newPath();
    QFile old(path);
    QVERIFY(old.open(QIODevice::WriteOnly));
    old.write("the final");
    old.close();
    const QString beside =
        QString(path).replace(QStringLiteral(".mcap"), QStringLiteral(" (2).mcap"));
    Studio studio(m_folder);
    QVERIFY(studio.launch({QStringLiteral("--record"), path, QStringLiteral("--cognition"),
                           QStringLiteral("inline")}));
    QTRY_VERIFY_WITH_TIMEOUT(rowsIn(beside) > 0, longWait);
    studio.terminate();
    QVERIFY(studio.waitForFinished(longWait));
    QCOMPARE(studio.exitCode(), 0);
    QCOMPARE(faultOf(beside), QByteArray());
    QVERIFY(old.open(QIODevice::ReadOnly));
    QCOMPARE(old.readAll(), QByteArray("the final"));
  }

  void whatCannotBeRecordedIsReported_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QByteArray>("hasText");
    QTest::newRow("a session") << QStringList{QStringLiteral("--record"), QStringLiteral("a.mcap"),
                                              QStringLiteral("b.mcap")}
                               << QByteArray("b.mcap is a recording already");
    QTest::newRow("a folder")
        << QStringList{QStringLiteral("--record"), QStringLiteral("/proc/none/a.mcap")}
        << QByteArray("cannot create files in the folder /proc/none; choose another");
  }
  void whatCannotBeRecordedIsReported() {
    QFETCH(QStringList, arguments);
    QFETCH(QByteArray, hasText);
    Studio studio(m_folder);
    QVERIFY(studio.launch(arguments));
    QVERIFY(studio.waitForFinished(longWait));
    QCOMPARE(studio.exitCode(), 2);
    const QByteArray words = studio.readAllStandardError();
    QVERIFY2(words.contains("error: ") && words.contains(hasText), words);
  }

  void aFullDiskEndsTheRecordingOnly() {
    const QString disk = m_folder.filePath(QStringLiteral("disk"));
    QVERIFY(QDir().mkpath(disk));
    Studio studio(m_folder);
    const QStringList arguments =
        studio.with({QStringLiteral("--record"), disk + QStringLiteral("/a.mcap"),
                     QStringLiteral("--cognition"), QStringLiteral("inline"),
                     QStringLiteral("--speed"), QStringLiteral("max")});
    // A disk of its own, which nobody else sees.
    studio.start(QStringLiteral("unshare"),
                 QStringList{QStringLiteral("-rm"), QStringLiteral("sh"), QStringLiteral("-c"),
                             QStringLiteral("mount -t tmpfs -o size=3m disk \"$0\" || exit 77; "
                                            "exec \"$@\""),
                             disk, Studio::program()} +
                     arguments);
    if (!studio.waitForStarted()) QSKIP("unshare is not installed");
    QByteArray words;
    (void)QTest::qWaitFor(
        [&] {
          words += studio.readAllStandardError();
          return words.contains("error: ") || studio.state() != QProcess::Running;
        },
        longWait);
    if (studio.state() != QProcess::Running && studio.exitCode() != 2) {
      QSKIP("no file system can be mounted here");
    }
    QVERIFY2(words.contains("The disk is full"), words);
    QCOMPARE(studio.state(), QProcess::Running);  // the match goes on
    const QString seen =
        QStringLiteral("/proc/%1/root").arg(studio.processId()) + disk + QStringLiteral("/a.mcap");
    QTRY_COMPARE_WITH_TIMEOUT(faultOf(seen), QByteArray(), longWait);
    studio.terminate();
    QVERIFY(studio.waitForFinished(longWait));
    QCOMPARE(studio.exitStatus(), QProcess::NormalExit);
    QCOMPARE(studio.exitCode(), 2);
  }

#ifdef SLOW_DISK
  void aDiskThatStallsCostsAKilledStudioLessThanASecond() {
    const QString path = newPath();
    Studio studio(m_folder);
    QProcessEnvironment environment = studio.processEnvironment();
    environment.insert(QStringLiteral("LD_PRELOAD"), QStringLiteral(SLOW_DISK));
    environment.insert(QStringLiteral("SLOW_DISK_SECONDS"), QStringLiteral("1000"));
    studio.setProcessEnvironment(environment);
    QVERIFY(studio.launch({QStringLiteral("--record"), path, QStringLiteral("--cognition"),
                           QStringLiteral("inline")}));
    // The first piece is being waited for; what comes behind it is in the file all the same.
    const auto secondsIn = [&path] {
      const auto session = telemetry::SessionReader::open(path.toStdString());
      return session && session->range() ? session->range()->end : 0.0;
    };
    QTRY_VERIFY_WITH_TIMEOUT(secondsIn() > 3.0, longWait);
    studio.kill();
    QVERIFY(studio.waitForFinished(longWait));
    QVERIFY(secondsIn() > 3.0);
  }

  void aDiskThatStallsIsReported() {
    const QString path = newPath();
    QProcess recorder;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("LD_PRELOAD"), QStringLiteral(SLOW_DISK));
    environment.insert(QStringLiteral("SLOW_DISK_SECONDS"), QStringLiteral("1000"));
    recorder.setProcessEnvironment(environment);
    const auto [robotPort, refereePort] = freePorts();
    recorder.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli"),
                   {QStringLiteral("record"), QStringLiteral("--live"), QStringLiteral("-o"), path,
                    QStringLiteral("--bind"), QStringLiteral("127.0.0.1"),
                    QStringLiteral("--robots"), QStringLiteral("1"), QStringLiteral("--port-base"),
                    QString::number(robotPort - 1), QStringLiteral("--gamecontroller-port"),
                    QString::number(refereePort), QStringLiteral("--progress")});
    QByteArray words;
    QTRY_VERIFY2_WITH_TIMEOUT(
        (words += recorder.readAllStandardError()).contains("disk cannot keep up"), words,
        longWait);
    QVERIFY2(words.contains("warning: The disk cannot keep up"), words);
    QVERIFY2(words.contains(" free") || words.contains("room for"), words);
    recorder.kill();
    QVERIFY(recorder.waitForFinished());
  }
#endif
};

PITCHBOARD_TEST(TestStudioRecording)

}  // namespace tst_studio_recording

#include "tst_studio_recording.moc"

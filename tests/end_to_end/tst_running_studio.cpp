// SPDX-License-Identifier: GPL-3.0-or-later
// `pitchboard FILE` while studios run: whole programs, in a folder for their sockets that is this
// test's only.
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

#include "studio_program.h"

namespace tst_running_studio {

using studio_program::Studio;

namespace {
constexpr int longWait = 30000;
const QString sessions = QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/sessions/");
const QString first = QStringLiteral("small.mcap");
const QString second = QStringLiteral("plain_broken_off.mcap");
}  // namespace

class TestRunningStudio : public QObject {
  Q_OBJECT

  /// Programs that share a folder for sockets, each started with the arguments given and no others.
  struct Desktop {
    QTemporaryDir folder;
    QString runtime = folder.filePath(QStringLiteral("runtime"));
    Desktop() {
      QDir().mkdir(runtime);
      QFile::setPermissions(runtime, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    }
    QString settings(const QString& name = QStringLiteral("s.ini")) const {
      return folder.filePath(name);
    }
    void start(Studio& studio, const QStringList& arguments) const {
      QProcessEnvironment environment = studio.processEnvironment();
      environment.insert(QStringLiteral("XDG_RUNTIME_DIR"), runtime);
      studio.setProcessEnvironment(environment);
      studio.start(Studio::program(), arguments);
      QVERIFY(studio.waitForStarted());
    }
    void open(Studio& studio, const QString& file, const QStringList& more = {}) const {
      start(studio, QStringList{QStringLiteral("--settings"), settings(), sessions + file} + more);
    }
    QFileInfoList sockets() const {
      return QDir(runtime).entryInfoList({QStringLiteral("*.socket")}, QDir::System);
    }
  };

  static QString seen(Studio& studio) {
    studio.readAllStandardOutput();
    studio.write("look\n");
    while (studio.state() == QProcess::Running && !studio.canReadLine()) {
      if (!studio.waitForReadyRead(longWait)) return {};
    }
    return QString::fromUtf8(studio.readLine());
  }
  /// Handed over: the program ends, and this studio shows the file.
  static void verifyShows(const Desktop& desktop, Studio& studio, const QString& file) {
    Studio opener(desktop.folder);
    desktop.open(opener, file);
    QVERIFY(opener.waitForFinished(longWait));
    QCOMPARE(opener.exitStatus(), QProcess::NormalExit);
    QCOMPARE(opener.exitCode(), 0);
    QTRY_VERIFY2_WITH_TIMEOUT(seen(studio).startsWith(file), qPrintable(seen(studio)), longWait);
  }

 private slots:
  void aFileGoesToTheStudioThatRuns() {
    const Desktop desktop;
    Studio studio(desktop.folder);
    desktop.start(studio, studio.with({QStringLiteral("--cognition"), QStringLiteral("inline")}));
    QTRY_COMPARE_WITH_TIMEOUT(desktop.sockets().size(), 1, longWait);
    studio.write("minimize\n");
    QTRY_VERIFY(seen(studio).startsWith(QStringLiteral("minimized")));
    verifyShows(desktop, studio, first);
    verifyShows(desktop, studio, second);
    // None else may speak to it.
    const auto others = QFile::ReadGroup | QFile::WriteGroup | QFile::ReadOther | QFile::WriteOther;
    QCOMPARE(desktop.sockets().first().permissions() & others, QFile::Permissions());
    studio.terminate();
    QVERIFY(studio.waitForFinished(longWait));
    QCOMPARE(studio.exitCode(), 0);
    QVERIFY(desktop.sockets().isEmpty());
  }

  void aStudioOfItsOwnKeepsItsFile_data() {
    QTest::addColumn<QStringList>("more");
    QTest::newRow("asked for") << QStringList{QStringLiteral("--new-window")};
    QTest::newRow("another theme")
        << QStringList{QStringLiteral("--theme"), QStringLiteral("dark")};
  }
  void aStudioOfItsOwnKeepsItsFile() {
    QFETCH(QStringList, more);
    const Desktop desktop;
    Studio studio(desktop.folder), other(desktop.folder);
    desktop.open(studio, first);
    QTRY_COMPARE_WITH_TIMEOUT(desktop.sockets().size(), 1, longWait);
    desktop.open(other, second, more);
    QTRY_VERIFY_WITH_TIMEOUT(seen(other).startsWith(second), longWait);
    QVERIFY(seen(studio).startsWith(first));
  }

  void otherSettingsAreAnotherStudio() {
    const Desktop desktop;
    Studio studio(desktop.folder), other(desktop.folder);
    desktop.open(studio, first);
    QTRY_COMPARE_WITH_TIMEOUT(desktop.sockets().size(), 1, longWait);
    desktop.start(other, {QStringLiteral("--settings"), desktop.settings(QStringLiteral("t.ini")),
                          sessions + second});
    QTRY_VERIFY_WITH_TIMEOUT(seen(other).startsWith(second), longWait);
    QVERIFY(seen(studio).startsWith(first));
    QCOMPARE(desktop.sockets().size(), 2);
  }

  void aPictureIsMadeByItsOwnProgram() {
    const Desktop desktop;
    Studio studio(desktop.folder), picture(desktop.folder);
    desktop.open(studio, first);
    QTRY_COMPARE_WITH_TIMEOUT(desktop.sockets().size(), 1, longWait);
    const QString file = desktop.folder.filePath(QStringLiteral("shot.png"));
    desktop.open(picture, second,
                 {QStringLiteral("--screenshot-to"), file, QStringLiteral("--after"),
                  QStringLiteral("0.1")});
    QVERIFY(picture.waitForFinished(longWait));
    QCOMPARE(picture.exitCode(), 0);
    QVERIFY(QFile::exists(file));
    QVERIFY(seen(studio).startsWith(first));
  }

  void theSocketOfAKilledStudioIsNoObstacle() {
    const Desktop desktop;
    {
      Studio killed(desktop.folder);
      desktop.open(killed, first);
      QTRY_COMPARE_WITH_TIMEOUT(desktop.sockets().size(), 1, longWait);
      killed.kill();
      QVERIFY(killed.waitForFinished(longWait));
    }
    QCOMPARE(desktop.sockets().size(), 1);
    Studio studio(desktop.folder);
    desktop.open(studio, first);
    QTRY_VERIFY_WITH_TIMEOUT(seen(studio).startsWith(first), longWait);
    verifyShows(desktop, studio, second);
  }

  void anotherStudioTakesThePlaceOfOneThatEnds_data() {
    QTest::addColumn<int>("signal");
    QTest::newRow("ended") << SIGTERM;
    QTest::newRow("killed") << SIGKILL;
  }
  void anotherStudioTakesThePlaceOfOneThatEnds() {
    QFETCH(int, signal);
    const Desktop desktop;
    Studio studio(desktop.folder), other(desktop.folder);
    desktop.open(studio, first);
    QTRY_COMPARE_WITH_TIMEOUT(desktop.sockets().size(), 1, longWait);
    const QDateTime made = desktop.sockets().first().lastModified();
    // Without a file: a studio as always.
    desktop.start(other, other.with({QStringLiteral("--cognition"), QStringLiteral("inline")}));
    QTRY_VERIFY_WITH_TIMEOUT(seen(other).startsWith(QStringLiteral("Pitchboard")), longWait);
    QCOMPARE(desktop.sockets().size(), 1);
    ::kill(static_cast<pid_t>(studio.processId()), signal);
    QVERIFY(studio.waitForFinished(longWait));
    QTRY_VERIFY_WITH_TIMEOUT(
        desktop.sockets().size() == 1 && desktop.sockets().first().lastModified() > made, longWait);
    verifyShows(desktop, other, second);
  }
};

PITCHBOARD_TEST(TestRunningStudio)

}  // namespace tst_running_studio

#include "tst_running_studio.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// `pitchboard-cli explore`: what it prints of a recorded moment, and what it refuses.
#include <QtTest>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "../support/program_run.h"

namespace tst_cli_explore {

namespace {

ProgramRun explore(const QStringList& arguments) {
  return runProgram("pitchboard-cli", QStringList{"explore"} + arguments);
}

}  // namespace

class TestCliExplore : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_session;

 private slots:
  void initTestCase() {
    m_session = m_folder.filePath(QStringLiteral("match.mcap"));
    const ProgramRun run = runProgram("pitchboard-cli", {"record", "--scenario", "match-3v3",
                                                         "--duration", "8", "-o", m_session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
  }

  void aMomentIsExplored() {
    const QStringList arguments{m_session, "--at", "6", "--seconds", "5", "--rollouts", "60"};
    const ProgramRun run = explore(arguments);
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.out.contains("where they believe they are"), run.out.constData());
    QVERIFY2(run.out.contains("60 rollouts of 5 s from 6.00 s"), run.out.constData());
    QVERIFY2(run.out.contains("Goal of the left team"), run.out.constData());
    const ProgramRun json = explore(arguments + QStringList{"--json", "--truth"});
    QVERIFY2(json.exitCode == 0, json.err.constData());
    const QJsonObject out = QJsonDocument::fromJson(json.out).object();
    QVERIFY(out["notes"].toArray()[0].toString().contains("true positions"));
    QCOMPARE(out["robots"].toArray().size(), 6);
    const QJsonArray times = out["heat"].toObject()["times"].toArray();
    QCOMPARE(times.size(), 6);
    double sum = 0.0;
    for (const auto& cell : times[5].toObject()["cells"].toArray()) sum += cell.toDouble();
    QVERIFY(std::abs(sum - 1.0) < 1e-3);
    // The same question has the same answer.
    QCOMPARE(explore(arguments + QStringList{"--json", "--truth"}).out, json.out);
  }

  /// The game is that of the moment, and not that with which the scenario began.
  void theGameIsThatOfTheMoment() {
    const QString session = m_folder.filePath(QStringLiteral("kick-off.mcap"));
    const ProgramRun run = runProgram(
        "pitchboard-cli", {"record", "--scenario", "kick-off", "--duration", "12", "-o", session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    for (const auto& [at, isSet] : {std::pair{"0.3", true}, std::pair{"10", false}}) {
      const ProgramRun told =
          explore({session, "--at", at, "--truth", "--seconds", "1", "--rollouts", "2"});
      QVERIFY2(told.exitCode == 0, told.err.constData());
      QVERIFY2(told.out.contains("The game is in SET") == isSet, told.out.constData());
      QVERIFY2(isSet || !told.out.contains("The game is in"), told.out.constData());
    }
  }

  void badQuestionsAreNamed_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("words");
    QTest::newRow("no such time") << QStringList{m_session, "--at", "60"} << "--at: ";
    QTest::newRow("no time") << QStringList{m_session, "--at", "soon"} << "--at: ";
    QTest::newRow("no file") << QStringList{"none.mcap", "--at", "6"} << "none.mcap";
    QTest::newRow("nothing is known yet")
        << QStringList{m_session, "--at", "0"} << "Choose another moment";
  }
  void badQuestionsAreNamed() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, words);
    const ProgramRun run = explore(arguments);
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.contains(words.toUtf8()), run.err.constData());
  }
};

PITCHBOARD_TEST(TestCliExplore)

}  // namespace tst_cli_explore

#include "tst_cli_explore.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// A team's program that says when it has finished its cycle: the match waits for it.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/match/simulated_match.h>

#include "../support/guide_programs.h"
#include "../support/program_run.h"
#include "../support/segment_keys.h"

namespace tst_cooperation {

using namespace pitchboard;
using namespace pitchboard::link;

class TestCooperation : public QObject {
  Q_OBJECT
  const int m_base = testKeyBase();
  const QTemporaryDir m_folder;

  QString profileOf(const QStringList& command, bool cooperates = true,
                    double responseTimeout = 5.0) const {
    QJsonObject profile{
        {"version", 1},
        {"name", "team"},
        {"processes", QJsonArray{QJsonObject{{"name", "decision"},
                                             {"command", QJsonArray::fromStringList(command)},
                                             {"response_timeout", responseTimeout}}}}};
    if (cooperates) profile["cycle"] = "MATCH_CYCLE";
    QFile file(m_folder.filePath("profile.json"));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
    file.write(QJsonDocument(profile).toJson());
    return file.fileName();
  }

  ProgramRun play(const QString& profile, const char* speed, const char* duration) const {
    return runProgram(
        "pitchboard-cli",
        {"simulate", "--scenario", "one-robot", "--cognition", "separate", "--json", "--runtime",
         profile, "--speed", speed, "--duration", duration, "--key-base", QString::number(m_base)});
  }
  static QJsonObject resultOf(const ProgramRun& run) {
    return QJsonDocument::fromJson(run.out).object();
  }

 private slots:
  void cleanup() { removeSegment(m_base + 100); }

  void theGuideShowsThesePrograms() {
    QCOMPARE(whyNotShown("cycle_robot.py", 25), QString());
    QCOMPARE(whyNotShown("cycle_robot.cpp", 25), QString());
  }

  void theSameMatchAtEverySpeed_data() {
    QTest::addColumn<QStringList>("program");
    QTest::newRow("Python") << QStringList{
        "python3", PITCHBOARD_SOURCE_DIR "/tests/end_to_end/cycle_robot.py", "${key}"};
    QTest::newRow("C++") << QStringList{QCoreApplication::applicationDirPath() + "/cycle_robot",
                                        "${key}"};
  }
  void theSameMatchAtEverySpeed() {
    QFETCH(QStringList, program);
    const QString profile = profileOf(program);
    QSet<QString> hashes;
    for (const char* speed : {"1", "8", "max", "max"}) {
      const ProgramRun run = play(profile, speed, "4");
      QVERIFY2(run.exitCode == 0, run.err.constData());
      const QJsonObject out = resultOf(run);
      QVERIFY2(out["repeatable"].toBool(), run.err.constData());
      QVERIFY(out["robots"].toArray()[0].toObject()["distance_m"].toDouble() > 0.1);
      hashes << out["state_hash"].toString();
    }
    QCOMPARE(hashes.size(), 1);
  }

  // For people, too: what was printed, and what recorded.
  void whatDoesNotRepeatIsReported_data() {
    QTest::addColumn<bool>("cooperates");
    QTest::newRow("cooperates") << true;
    QTest::newRow("does not") << false;
  }
  void whatDoesNotRepeatIsReported() {
    QFETCH(bool, cooperates);
    const QString profile =
        profileOf({"python3", PITCHBOARD_SOURCE_DIR "/tests/end_to_end/cycle_robot.py", "${key}"},
                  cooperates);
    const QStringList match{"--scenario", "one-robot", "--cognition", "separate",
                            "--runtime",  profile,     "--speed",     "8",
                            "--duration", "2",         "--key-base",  QString::number(m_base)};
    const ProgramRun played = runProgram("pitchboard-cli", QStringList{"simulate"} + match);
    QVERIFY2(played.exitCode == 0, played.err.constData());
    QCOMPARE(played.out.contains("  Repeatable no: the match did not wait"), !cooperates);
    const ProgramRun recorded =
        runProgram("pitchboard-cli",
                   QStringList{"record"} + match +
                       QStringList{"-o", m_folder.filePath(cooperates ? "a.mcap" : "b.mcap")});
    QVERIFY2(recorded.exitCode == 0, recorded.err.constData());
    QCOMPARE(recorded.out.contains("; not repeatable\n"), !cooperates);
  }

  // A segment that was there, with the last word of another match.
  void whatAnEarlierProgramLeftIsForgotten() {
    auto board = SystemVSegments::open(m_base + 100, AttachMode::AttachOrCreate).value();
    board.write(IntVar{447}, -100'000);
    const ProgramRun run = play(
        profileOf({QCoreApplication::applicationDirPath() + "/cycle_robot", "${key}"}), "max", "4");
    QVERIFY2(resultOf(run)["repeatable"].toBool(), run.err.constData());
    QVERIFY(resultOf(run)["robots"].toArray()[0].toObject()["distance_m"].toDouble() > 0.1);
    QCOMPARE(board.read(IntVar{447}), -240);
  }

  void aLateOneIsNamed_data() {
    QTest::addColumn<QByteArray>("after");
    QTest::addColumn<bool>("cooperates");
    QTest::addColumn<QByteArray>("reported");
    QTest::newRow("hangs") << QByteArray("time.sleep(1000)") << true
                           << QByteArray(
                                  "no cycle finished for 0.3 s; the match continues without it");
    QTest::newRow("ends") << QByteArray("sys.exit(0)") << true
                          << QByteArray("the match continues without it and is not repeatable");
    QTest::newRow("never cooperates") << QByteArray("pass") << false << QByteArray();
  }
  void aLateOneIsNamed() {
    QFETCH(QByteArray, after);
    QFETCH(bool, cooperates);
    QFETCH(QByteArray, reported);
    QFile program(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/cycle_robot.py");
    QVERIFY(program.open(QIODevice::ReadOnly));
    QByteArray text = program.readAll();
    text.replace("    ints[ACTION_B] = 10\n",
                 "    if tick > 60:\n        " + after + "\n    ints[ACTION_B] = 10\n");
    QFile late(m_folder.filePath("late.py"));
    QVERIFY(late.open(QIODevice::WriteOnly));
    late.write(text);
    late.close();
    const ProgramRun run =
        play(profileOf({"python3", late.fileName(), "${key}"}, cooperates, 0.3), "max", "3");
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QCOMPARE(resultOf(run)["repeatable"], QJsonValue(false));
    QVERIFY2(run.err.contains(reported), run.err.constData());
    QCOMPARE(run.err.contains("B1 did not finish its cycle in time"), !reported.isEmpty());
  }

  // Without the key of the profile, or a program that knows the word, it is the team's.
  void otherMapsAreLeftAlone_data() {
    QTest::addColumn<QString>("runtime");
    QTest::addColumn<int>("before");
    QTest::addColumn<int>("after");
    QTest::newRow("nobody asked for it") << "own" << 123456 << 123456;
    QTest::newRow("nobody knows it") << "own:cycle=MATCH_CYCLE" << 0 << 0;
    QTest::newRow("in another word") << "own:cycle=DECISION_WORKING" << 7 << 7;
    QTest::newRow("cooperates every ten ticks") << "own:cycle=MATCH_CYCLE" << -10 << -10;
  }
  void otherMapsAreLeftAlone() {
    QFETCH(QString, runtime);
    QFETCH(int, before);
    QFETCH(int, after);
    constexpr IntVar word{447};
    Scenario scenario = loadScenario("one-robot").value();
    scenario.robots[0].runtime = runtimeChoiceFromText(runtime.toStdString()).value();
    MatchOptions options;
    options.keyBase = m_base;
    auto match = SimulatedMatch::create(scenario, options).value();
    match.blackboard(RobotId{1})->write(word, before);
    for (int i = 0; i < 10; ++i) match.tick();
    QCOMPARE(match.blackboard(RobotId{1})->read(word), after);
  }

  void anUnknownVariableIsRefused() {
    Scenario scenario = loadScenario("one-robot").value();
    scenario.robots[0].runtime = runtimeChoiceFromText("own:cycle=MATCH_CIRCLE").value();
    MatchOptions options;
    options.keyBase = m_base;
    const auto match = SimulatedMatch::create(scenario, options);
    QVERIFY(!match);
    QVERIFY2(match.error().text().find("waits for \"MATCH_CIRCLE\"") != std::string::npos,
             match.error().text().c_str());
  }
};

PITCHBOARD_TEST(TestCooperation)

}  // namespace tst_cooperation

#include "tst_cooperation.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// Worlds behind lines of JSON: what docs/worlds.md promises, and whatever else a line may hold.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>

#include <robotlink/capi/world_lines.h>

#include "../support/program_run.h"

namespace tst_world_lines {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

Scenario usual() {
  return loadScenario("one-robot").value();
}

QJsonObject ask(WorldLines& lines, const char* request) {
  const std::string answer = lines.answer(request);
  if (answer.find('\n') != std::string::npos) qFatal("an answer of several lines");
  return QJsonDocument::fromJson(QByteArray::fromStdString(answer)).object();
}

/// The lines of a ```json block behind a heading of docs/worlds.md: requests begin with "→ ".
QList<QPair<QByteArray, QByteArray>> conversation() {
  QFile file(QStringLiteral(PITCHBOARD_SOURCE_DIR "/docs/worlds.md"));
  if (!file.open(QIODevice::ReadOnly)) qFatal("no docs/worlds.md");
  QList<QPair<QByteArray, QByteArray>> pairs;
  for (const QByteArray& line : file.readAll().split('\n')) {
    if (line.startsWith("→ ")) pairs.append({line.mid(4), {}});
    if (line.startsWith("← ") && !pairs.isEmpty()) pairs.last().second = line.mid(4);
  }
  return pairs;
}

}  // namespace

class TestWorldLines : public QObject {
  Q_OBJECT

 private slots:
  void theDocumentedConversation() {
    const auto pairs = conversation();
    QVERIFY(pairs.size() >= 8);
    QByteArray input;
    for (const auto& [request, answer] : pairs) input += request + '\n';
    const ProgramRun run = runProgram("pitchboard-cli", {"simulate", "--stdio"}, input);
    QVERIFY2(run.exitCode == 0 && run.err.isEmpty(), run.err.constData());
    const QList<QByteArray> answers = run.out.trimmed().split('\n');
    QCOMPARE(answers.size(), pairs.size());
    for (int i = 0; i < pairs.size(); ++i) QCOMPARE(answers[i], pairs[i].second);
  }

  void theHashIsThatOfTheCommandLine() {
    const ProgramRun cli = runProgram(
        "pitchboard-cli",
        {"simulate", "--json", "--scenario", "match-3v3", "--seed", "8", "--duration", "5"});
    WorldLines lines(usual());
    QVERIFY(ask(lines, R"({"do":"create","scenario":"match-3v3","seed":8,"duration":5})")["ok"]
                .toBool());
    const QJsonObject over = ask(lines, R"({"do":"step","ticks":1000})");
    QCOMPARE(over["finished"].toArray(), QJsonArray{"duration"});
    QCOMPARE(ask(lines, R"({"do":"hashes"})")["hashes"].toArray()[0],
             QJsonDocument::fromJson(cli.out).object()["state_hash"]);
  }

  void aRobotIsSteered() {
    WorldLines lines(usual());
    QCOMPARE(ask(lines, R"({"do":"create","worlds":2})")["robots"].toArray(), QJsonArray{1});
    QVERIFY(ask(lines, R"({"do":"behaviour","robot":1,"behaviour":"none"})")["ok"].toBool());
    QVERIFY(ask(lines, R"({"do":"reset","seed":3})")["ok"].toBool());
    QVERIFY(ask(lines, R"({"do":"write","actions":[[1],[null]]})")["ok"].toBool());
    QVERIFY(ask(lines, R"({"do":"step","ticks":60})")["ok"].toBool());
    const auto robots = ask(lines, R"({"do":"read","what":"robots"})")["values"].toArray();
    QVERIFY(robots[0][0][3].toDouble() > -1.45);
    QCOMPARE(robots[1][0][3].toDouble(), -1.5);
    const int snapshot = ask(lines, R"({"do":"snapshot","world":0})")["snapshot"].toInt();
    QCOMPARE(snapshot, 1);
    QVERIFY(ask(lines, R"({"do":"restore","world":1,"snapshot":1})")["ok"].toBool());
    const auto hashes = ask(lines, R"({"do":"hashes"})")["hashes"].toArray();
    QCOMPARE(hashes[0], hashes[1]);
    QVERIFY(ask(lines, R"({"do":"forget","snapshot":1})")["ok"].toBool());
    QVERIFY(ask(lines, R"({"do":"place_ball","x":1,"y":0.5})")["ok"].toBool());
    QVERIFY(ask(lines, R"({"do":"place_robot","robot":1,"x":0,"y":0,"yaw":0})")["ok"].toBool());
    const auto game = ask(lines, R"({"do":"read","what":"game"})")["values"].toArray();
    QCOMPARE(game[1][6].toDouble(), 1.0);
    const auto seen =
        ask(lines, R"({"do":"read","variables":["CONTROL_ACTION","VISION_BALL_DIST"],"id":"x"})");
    QCOMPARE(seen["values"].toArray()[0].toArray()[0].toArray().size(), 2);
    QCOMPARE(seen["id"].toString(), QString("x"));
    QCOMPARE(ask(lines, R"({"do":"columns"})")["game"].toArray()[0].toObject()["name"], "tick");
  }

  void aBadLineGetsAnErrorAndTheNextOneIsServed_data() {
    QTest::addColumn<QByteArray>("line");
    QTest::addColumn<QString>("hasText");
    const auto row = [](const char* name, const char* line, const char* hasText) {
      QTest::newRow(name) << QByteArray(line) << QString::fromUtf8(hasText);
    };
    row("no JSON", "step", "JSON");
    row("no object", "[1, 2]", "must be an object");
    row("no verb", "{}", "do");
    row("an unknown verb", R"({"do":"stp"})", "did you mean");
    row("an unknown key", R"({"do":"step","tick":1})", "tick");
    row("a key twice", R"({"do":"step","do":"step"})", "twice");
    row("too many ticks", R"({"do":"step","ticks":1000000000000})", "ticks");
    row("text for a number", R"({"do":"step","ticks":"1"})", "ticks");
    row("a world that is not there", R"({"do":"reset","seed":1,"world":7})", "no world 7");
    row("no seed", R"({"do":"reset"})", "seed");
    row("nothing to read", R"({"do":"read"})", "needs");
    row("a variable nobody has", R"({"do":"read","variables":["VISION_BAL_DIST"]})",
        "did you mean");
    row("a variable without a name", R"({"do":"read","variables":[3]})", "variables[0]");
    row("an array of another shape", R"({"do":"write","actions":[1]})", "actions[0]");
    row("half an action", R"({"do":"write","actions":[[1.5]]})", "actions[0][0]");
    row("a number that is too large", R"({"do":"write","actions":[[3000000000]]})", "32-bit");
    row("two things to write", R"({"do":"write","actions":[[1]],"commands":[[[1]]]})", "one of");
    row("nobody", R"({"do":"behaviour","robot":5,"behaviour":"none"})", "no robot 5");
    row("no such behaviour", R"({"do":"behaviour","robot":1,"behaviour":"nonne"})", "did you mean");
    row("no such snapshot", R"({"do":"restore","snapshot":5})", "no snapshot 5");
    row("a name and a text", R"({"do":"create","scenario":"match","text":"{}"})",
        "a name or a text");
    row("no such scenario", R"({"do":"create","scenario":"no-such"})", "no-such");
    // moc loses its way in a raw text with \".
    row("a text that is no scenario",
        "{\"do\":\"create\",\"text\":\"{\\\"version\\\":1,\\\"robots\\\":1}\"}", "robots");
    row("too many worlds", R"({"do":"create","worlds":100000})", "worlds");
    row("no such physics", R"({"do":"create","physics":"chaos"})", "chaos");
    row("bytes that are no text", "{\"do\":\"\xff\xfe\"}", "");
    QTest::newRow("deep") << QByteArray(2000, '[') << QString();
    QTest::newRow("long") << QByteArray(static_cast<qsizetype>(WorldLines::maxLineLength) + 2, ' ')
                          << QStringLiteral("larger");
  }
  void aBadLineGetsAnErrorAndTheNextOneIsServed() {
    QFETCH(QByteArray, line);
    QFETCH(QString, hasText);
    WorldLines lines(usual());
    QVERIFY(ask(lines, R"({"do":"create"})")["ok"].toBool());
    const QJsonObject answer = ask(lines, line.constData());
    QVERIFY(!answer["ok"].toBool());
    const QString error = answer["error"].toString();
    QVERIFY2(error.size() > 8 && error.contains(hasText), qPrintable(error));
    QVERIFY(ask(lines, R"({"do":"step"})")["ok"].toBool());
  }

  void nothingIsThereBeforeCreate() {
    WorldLines lines(usual());
    for (const char* request :
         {R"({"do":"step"})", R"({"do":"hashes"})", R"({"do":"read","what":"game"})",
          R"({"do":"snapshot"})", R"({"do":"write","actions":[]})", R"({"do":"reset","seed":1})",
          R"({"do":"behaviour","robot":1,"behaviour":"none"})",
          R"({"do":"place_ball","x":1,"y":0})", R"({"do":"restore","snapshot":1})"}) {
      const QJsonObject answer = ask(lines, request);
      QVERIFY2(answer["error"].toString().contains("create"), request);
    }
  }

  void limitsHold() {
    WorldLines::Limits limits;
    limits.worlds = 2;
    limits.ticks = 10;
    limits.files = false;
    limits.snapshots = 1;
    limits.values = 500;
    WorldLines lines(usual(), limits);
    QVERIFY(!ask(lines, R"({"do":"create","worlds":3})")["ok"].toBool());
    QVERIFY(!ask(lines, R"({"do":"create","scenario":"/dev/zero"})")["ok"].toBool());
    QVERIFY(ask(lines, R"({"do":"create","worlds":2})")["ok"].toBool());
    QVERIFY(!ask(lines, R"({"do":"step","ticks":6})")["ok"].toBool());
    QVERIFY(ask(lines, R"({"do":"step","ticks":5})")["ok"].toBool());
    QVERIFY(!ask(lines, R"({"do":"read","what":"boards"})")["ok"].toBool());
    QVERIFY(ask(lines, R"({"do":"snapshot"})")["ok"].toBool());
    QVERIFY(!ask(lines, R"({"do":"snapshot"})")["ok"].toBool());
  }

  void theProgramServesPastBadLines() {
    const QByteArray tooLong(static_cast<qsizetype>(WorldLines::maxLineLength) + 5, 'x');
    const ProgramRun run =
        runProgram("pitchboard-cli", {"simulate", "--stdio", "--scenario", "match-3v3"},
                   "nonsense\n\n" + tooLong + "\n{\"do\":\"create\"}");
    QCOMPARE(run.exitCode, 0);
    const QList<QByteArray> answers = run.out.trimmed().split('\n');
    QCOMPARE(answers.size(), 3);
    QVERIFY(answers[0].contains("\"ok\":false") && answers[1].contains("\"ok\":false"));
    QVERIFY(answers[2].contains("\"robots\":[1,2,3,4,5,6]"));
    const ProgramRun both = runProgram("pitchboard-cli", {"simulate", "--stdio", "--json"});
    QCOMPARE(both.exitCode, 2);
    const ProgramRun noScenario =
        runProgram("pitchboard-cli", {"simulate", "--stdio", "--scenario", "no-such"});
    QVERIFY(noScenario.exitCode == 2 && noScenario.err.startsWith("error: "));
  }
};

PITCHBOARD_TEST(TestWorldLines)

}  // namespace tst_world_lines

#include "tst_world_lines.moc"

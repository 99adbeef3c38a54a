// SPDX-License-Identifier: GPL-3.0-or-later
// Situations that users of referee programs have reported, with the real programs: timeouts and
// shoot-outs without an end, penalties while play is stopped, packets that arrive late, and a match
// that obeys a GameController.
#include <QElapsedTimer>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

#include <robotlink/session/session_events.h>
#include <telemetry/referee/gamecontroller.h>
#include <telemetry/referee/gamecontroller_encoder.h>
#include <telemetry/session/session_reader.h>

#include "../support/program_run.h"
#include "../support/test_socket.h"

namespace tst_referee_cases {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::RefereeState;

namespace {

const QString program = QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli");

QString scenario(const char* name) {
  return QStringLiteral(PITCHBOARD_TEST_DATA "/referee/") + QLatin1String(name);
}

/// "game-phase timeout" and so on, of a session that may still be recorded.
QStringList eventsIn(const QString& path) {
  const auto session = telemetry::SessionReader::open(path.toStdString());
  QStringList lines;
  if (!session) return lines;
  for (const MatchEvent& event : eventsOf(*session)) {
    lines << QString::fromStdString(std::string(info(event.kind).name) + ' ' + sentenceOf(event));
  }
  return lines;
}

/// A packet of 2026 of two teams, 12 and 5, of four players.
RefereeState packetOf2026(int state) {
  RefereeState out;
  out.version = 20;
  out.size = 158;
  out.league = League::HumanoidSoccer;
  out.playersPerTeam = 4;
  out.state = state;
  out.firstHalf = 1;
  out.kickOffRaw = 255;
  out.secsRemaining = 600;
  out.competitionPhase = out.competitionType = out.gamePhase = out.setPlay = out.stopped = 0;
  out.secondaryTime = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    telemetry::RefereeTeam& team = out.teams[i];
    team.number = i == 0 ? 12 : 5;
    team.colour = static_cast<int>(i);
    team.goalkeeperColour = 3;
    team.goalkeeper = 1;
    team.penaltyShot = team.singleShots = 0;
    team.messageBudget = 12000;
    team.slotCount = telemetry::RefereeTeam::maxPlayers;
    for (std::size_t slot = 0; slot < team.slotCount; ++slot) {
      constexpr int substitute = 13;
      team.allSlots[slot].number = static_cast<int>(slot) + 1;
      team.allSlots[slot].penalty = slot < 4 ? 0 : substitute;
      team.allSlots[slot].cautions = 0;
    }
  }
  return out;
}

/// Sends packets as the league's program does: each has the next number.
class Controller {
 public:
  explicit Controller(int port) : m_port(static_cast<std::uint16_t>(port)) {}
  void send(RefereeState packet) { sendAs(packet, m_next++); }
  void sendAs(RefereeState packet, int number) {
    packet.packetNumber = number & 0xff;
    const auto bytes = telemetry::encodeReferee(packet);
    if (!bytes) qFatal("%s", bytes.error().text().c_str());
    m_socket.send(m_port, *bytes);
  }
  int next() const { return m_next; }

 private:
  TestSocket m_socket;
  std::uint16_t m_port;
  int m_next = 100;
};

}  // namespace

class TestRefereeCases : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

 private slots:
  void aMatchThatStartsInATimeoutGoesOn() {
    const ProgramRun run =
        cli({"simulate", "--scenario", scenario("timeout.json"), "--speed", "max", "--json"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QJsonObject result = QJsonDocument::fromJson(run.out).object();
    QCOMPARE(result["finished_by"].toString(), QString("full_time"));
    const QString path = m_folder.filePath("timeout.mcap");
    const ProgramRun recorded = cli({"record", "--scenario", scenario("timeout.json"), "--duration",
                                     "6", "--speed", "max", "-o", path});
    QVERIFY2(recorded.exitCode == 0, recorded.err.constData());
    QVERIFY2(eventsIn(path).contains("referee READY at 00:10"),
             qPrintable(eventsIn(path).join('\n')));
  }

  void anExperimentThatStartsInATimeoutGoesOn() {
    QFile file(m_folder.filePath("experiment.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(QJsonDocument(QJsonObject{{"version", 1},
                                         {"name", "timeout"},
                                         {"scenario", scenario("timeout.json")},
                                         {"runs", 1},
                                         {"stop", QJsonObject{{"duration", 3600}}}})
                   .toJson());
    file.close();
    const ProgramRun run =
        cli({"experiment", file.fileName(), "--out", m_folder.filePath("experiment")});
    QVERIFY2(run.exitCode == 0, (run.err + run.out).constData());
    const QByteArray runs = contents(m_folder.filePath("experiment/runs.csv"));
    QVERIFY2(runs.contains("full_time"), runs.constData());
  }

  void aShootOutOf2026Ends() {
    const ProgramRun run = cli({"simulate", "--scenario", scenario("shoot_out.json"), "--seed", "3",
                                "--speed", "max", "--json"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const auto teams = QJsonDocument::fromJson(run.out).object()["teams"].toArray();
    int toss = 0;
    for (const QJsonValue& team : teams) toss += team["won_toss"].toBool() ? 1 : 0;
    // Either one team is ahead, or a coin has decided.
    QCOMPARE(teams[0]["score"] == teams[1]["score"], toss == 1);
    QVERIFY(toss <= 1);
  }

  void penaltyTimeWaitsWhilePlayIsStopped() {
    const QString path = m_folder.filePath("penalty.mcap"), rows = m_folder.filePath("penalty.csv");
    const ProgramRun recorded = cli({"record", "--scenario", scenario("penalty_in_stop.json"),
                                     "--duration", "12", "--speed", "max", "-o", path});
    QVERIFY2(recorded.exitCode == 0, recorded.err.constData());
    const ProgramRun exported =
        cli({"export", path, "--to", "csv-even", "--rate", "2", "--robots", "match,B3",
             "--variables", "PLAY_STOPPED,PENALTY_LEFT", "-o", rows});
    QVERIFY2(exported.exitCode == 0, exported.err.constData());
    const QList<QByteArray> lines = contents(rows).split('\n');
    const auto columnOf = [&](const char* name) {
      const QList<QByteArray> names = lines[0].trimmed().split(',');
      for (qsizetype i = 0; i < names.size(); ++i) {
        if (names[i].contains(name)) return i;
      }
      return qsizetype(-1);
    };
    const qsizetype stopped = columnOf("PLAY_STOPPED"), left = columnOf("PENALTY_LEFT");
    QVERIFY2(stopped >= 0 && left >= 0, lines[0].constData());
    int whileStopped = 0;
    double last = 30.0;
    for (const QByteArray& line : lines.mid(1)) {
      const QList<QByteArray> cells = line.trimmed().split(',');
      if (cells.size() <= std::max(stopped, left) || cells[left].isEmpty()) continue;
      last = cells[left].toDouble();
      if (cells[stopped].toInt() != 1) continue;
      ++whileStopped;
      QCOMPARE(last, 30.0);
    }
    QVERIFY(whileStopped >= 5);
    QVERIFY2(last < 28.0, "the time goes on when play does");
  }

  void aLateRefereePacketChangesNothingInLive() {
    int base = 0, port = 0;
    {
      const TestSocket robots, referee;
      base = robots.port() - 1;
      port = referee.port() == base + 2 ? base + 3 : referee.port();
    }
    QProcess process;
    process.start(program,
                  {"listen", "--json", "--bind", "127.0.0.1", "--robots", "2", "--port-base",
                   QString::number(base), "--gamecontroller-port", QString::number(port)});
    QByteArray err, out;
    QTRY_VERIFY_WITH_TIMEOUT((err += process.readAllStandardError()).contains("listening at"),
                             30'000);
    const auto events = [&] {
      out += process.readAllStandardOutput();
      QStringList kinds;
      for (const QByteArray& line : out.split('\n')) {
        const QJsonObject object = QJsonDocument::fromJson(line).object();
        if (object["type"] == "event") {
          kinds << object["kind"].toString() + ' ' + object["text"].toString();
        }
      }
      return kinds;
    };
    const auto happened = [&](const char* what) {
      return !events().filter(QString::fromUtf8(what)).isEmpty();
    };
    Controller controller(port);
    const RefereeState playing = packetOf2026(3);
    RefereeState goal = packetOf2026(1);
    goal.teams[0].score = 1;
    controller.send(playing);
    QTRY_VERIFY(happened("PLAYING"));
    controller.send(goal);
    QTRY_VERIFY(happened("goal goal"));
    const int old = controller.next() - 2;
    controller.sendAs(playing, old);
    controller.sendAs(playing, old - 1);
    RefereeState set = goal;
    set.state = 2;
    controller.send(set);
    QTRY_VERIFY(happened("SET"));
    const QStringList all = events();
    QCOMPARE(all.filter("PLAYING").size(), 1);
    QCOMPARE(all.filter("goal goal").size(), 1);
    QVERIFY2(!happened("score-corrected"), qPrintable(all.join('\n')));
    // The program is started again, and counts from 0 on another port.
    Controller again(port);
    again.sendAs(packetOf2026(0), 0);
    QTRY_VERIFY(happened("INITIAL"));
    process.terminate();
    QVERIFY(process.waitForFinished(60'000));
  }

  void aMatchThatObeysIsRecordedWithItsEvents() {
    const TestSocket replies;
    const int port = TestSocket().port();
    const QString path = m_folder.filePath("obeyed.mcap");
    QProcess process;
    process.start(program, {"record", "--scenario", scenario("obeyed.json"), "--referee",
                            "humanoid-soccer-2026", "--obey-referee", QString::number(port),
                            "--answer-referee", QString::number(replies.port()), "--duration",
                            "600", "-o", path});
    Controller controller(port);
    QElapsedTimer sinceFirst;
    int answered = 0;  // by the first robot of team 12
    const auto takeReplies = [&] {
      for (std::string text = replies.take(); !text.empty(); text = replies.take()) {
        const auto reply = std::get<telemetry::RobotReply>(telemetry::decodeReferee(text).value());
        answered += reply.team == 12 && reply.player == 1 ? 1 : 0;
      }
    };
    const auto reports = [&](const RefereeState& packet, const QString& event) {
      return QTest::qWaitFor(
          [&] {
            if (!sinceFirst.isValid()) sinceFirst.start();
            controller.send(packet);
            takeReplies();
            return !eventsIn(path).filter(event).isEmpty();
          },
          60'000);
    };
    QVERIFY(reports(packetOf2026(1), "referee READY"));
    QVERIFY(reports(packetOf2026(2), "referee SET"));
    QVERIFY(reports(packetOf2026(3), "referee PLAYING"));
    RefereeState penalty = packetOf2026(3);
    penalty.teams[0].allSlots[2].penalty = 10;
    penalty.teams[0].allSlots[2].secondsLeft = 45;
    QVERIFY(reports(penalty, "penalty B3 penalised: pushing"));
    RefereeState goal = packetOf2026(1);
    goal.teams[0].score = 1;
    QVERIFY(reports(goal, "goal goal for A, 1 : 0"));
    QVERIFY(reports(goal, "penalty-over B3 may play again"));
    RefereeState finished = goal;
    finished.state = 4;
    QVERIFY(reports(finished, "referee FINISHED"));
    RefereeState second = goal;
    second.state = second.firstHalf = 0;
    std::swap(second.teams[0], second.teams[1]);
    QVERIFY(reports(second, "half second half"));
    QVERIFY(reports(second, "referee INITIAL"));
    // As often as we send: at most twice a second.
    QTRY_VERIFY_WITH_TIMEOUT((controller.send(second), takeReplies(), answered >= 4), 60'000);
    QVERIFY2(answered <= 1 + 2 * (sinceFirst.elapsed() + 500) / 1000,
             qPrintable(QString("%1 replies in %2 ms").arg(answered).arg(sinceFirst.elapsed())));
    process.terminate();
    QVERIFY(process.waitForFinished(60'000));
    const QStringList all = eventsIn(path);
    QCOMPARE(all.filter("goal goal").size(), 1);
    QCOMPARE(all.filter("penalty B3").size(), 1);
    const QString report = m_folder.filePath("obeyed.html");
    QCOMPARE(cli({"export", path, "--to", "report", "-o", report}).exitCode, 0);
    QVERIFY(contents(report).contains("goal for A, 1 : 0"));
  }
};

PITCHBOARD_TEST(TestRefereeCases)

}  // namespace tst_referee_cases

#include "tst_referee_cases.moc"

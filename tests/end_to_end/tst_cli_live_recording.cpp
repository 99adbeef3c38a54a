// SPDX-License-Identifier: GPL-3.0-or-later
// `record --live` as people run it: what robots and the referee send stands in the file.

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <algorithm>

#include <telemetry/session/session_reader.h>

#include "../support/program_run.h"
#include "../support/session_values.h"
#include "../support/test_socket.h"

namespace tst_cli_live_recording {

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

const QString program = QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli");
constexpr TimeRange always{-1e9, 1e9};

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

class TestCliLiveRecording : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

 private slots:
  void aRecordingWithoutARobotSaysSo_data() {
    QTest::addColumn<QByteArray>("datagram");
    QTest::addColumn<QByteArray>("says");
    QTest::newRow("nothing") << QByteArray() << QByteArray("nothing arrived");
    QTest::newRow("something else") << QByteArray("hello") << QByteArray("of 1 datagrams none");
  }
  void aRecordingWithoutARobotSaysSo() {
    QFETCH(QByteArray, datagram);
    QFETCH(QByteArray, says);
    const TestSocket socket;
    int referee = 0, base = 0;
    {
      const TestSocket first, second;
      referee = first.port();
      base = second.port() - 1;
    }
    QProcess process;
    process.start(
        program, {"record", "--live", "--bind", "127.0.0.1", "--robots", "1", "--port-base",
                  QString::number(base), "--gamecontroller-port", QString::number(referee),
                  "--variables-port-base", "0", "--force", "-o", m_folder.filePath("nobody.mcap")});
    QByteArray err;
    QTRY_VERIFY_WITH_TIMEOUT((err += process.readAllStandardError()).contains("listening at"),
                             30'000);
    if (!datagram.isEmpty()) {
      QVERIFY(socket.send(static_cast<std::uint16_t>(referee), datagram.toStdString()));
      QTRY_VERIFY_WITH_TIMEOUT(
          [&] {
            const auto session =
                SessionReader::open(m_folder.filePath("nobody.mcap").toStdString());
            return session && session->count(SessionStream::RefereeRaw) == 1;
          }(),
          30'000);
    }
    process.terminate();
    QVERIFY(process.waitForFinished(60'000));
    err += process.readAllStandardError();
    QCOMPARE(process.exitCode(), 0);
    QVERIFY2(err.contains("no robot was recorded") && err.contains(says), err.constData());
  }

  void liveRobotsAreRecorded() {
    TestSocket robot;
    int base = 0, referee = 0;
    {
      const TestSocket first, second;
      base = first.port() - 1;
      referee = second.port() == base + 2 ? base + 3 : second.port();
    }
    const QString path = m_folder.filePath("live.mcap");
    QProcess process;
    process.start(program, {"record", "--live", "--bind", "127.0.0.1", "--robots", "2",
                            "--port-base", QString::number(base), "--gamecontroller-port",
                            QString::number(referee), "-o", path});
    QByteArray err;
    QTRY_VERIFY_WITH_TIMEOUT((err += process.readAllStandardError()).contains("listening at"),
                             30'000);
    const auto robotPort = static_cast<std::uint16_t>(base + 1);
    const auto refereePort = static_cast<std::uint16_t>(referee);
    const QByteArray packet = bytesOf(QStringLiteral(PITCHBOARD_TEST_DATA) +
                                      QStringLiteral("/gamecontroller/v11hl592_FINISHED.bin"));
    QVERIFY(!packet.isEmpty());
    for (int i = 0; i < 40; ++i) {
      const std::string text =
          "1 " + std::to_string(400 + i) + " 300 90 12.5 80.0 10.0 1 1 1 0 1 8 0.5 189 OUT";
      QVERIFY(robot.send(robotPort, text));
    }
    QVERIFY(robot.send(robotPort, "hello\xff there"));
    QVERIFY(
        robot.send(refereePort, std::string_view(packet.constData(), std::size_t(packet.size()))));
    QVERIFY(robot.send(refereePort, "no packet"));
    // A chunk is on the disk after a second: seen from outside while it goes on.
    QTRY_VERIFY_WITH_TIMEOUT(
        [&] {
          const auto session = SessionReader::open(path.toStdString());
          return session && session->count(SessionStream::Telemetry) == 41 &&
                 session->count(SessionStream::RefereeRaw) == 2;
        }(),
        30000);
    process.terminate();
    QVERIFY(process.waitForFinished(60'000));
    err += process.readAllStandardError();
    QVERIFY2(process.exitCode() == 0, err.constData());

    const auto session = SessionReader::open(path.toStdString());
    QVERIFY(session && session->complete() && session->notes().empty());
    QCOMPARE(session->info().source, std::string("live"));
    // The robot, and its link.
    QCOMPARE(session->groups().size(), std::size_t{2});
    const GroupId ofRobot = !factsOf(session->groups()[0].info).linkOf.empty() ? 1 : 0;
    const GroupInfo& info = session->groups()[ofRobot].info;
    std::vector<double> places;
    session->rows(always, {}, [&](GroupId group, const RowView& row) {
      if (group != ofRobot) return true;
      const double x = valueOf(info, row, columnOf(info, "LOCALIZATION_X"));
      if (places.empty() || places.back() != x) places.push_back(x);
      return true;
    });
    QCOMPARE(places.size(), std::size_t{40});
    QCOMPARE(places.front(), 400.0);
    QCOMPARE(places.back(), 439.0);
    std::vector<std::string> payloads;
    session->messages(SessionStream::Telemetry, always, [&](double, std::string_view json) {
      if (const auto datagram = sessionDatagram(json)) payloads.push_back(datagram->payload);
      return true;
    });
    QCOMPARE(payloads.size(), std::size_t{41});
    QCOMPARE(payloads.back(), std::string("hello\xff there"));
    QByteArray state;
    session->messages(SessionStream::Referee, always, [&](double, std::string_view json) {
      state = QByteArray(json.data(), qsizetype(json.size()));
      return true;
    });
    const QJsonObject referees = QJsonDocument::fromJson(state).object();
    QVERIFY2(!referees["stateName"].toString().isEmpty(), state.constData());
    QVERIFY(referees["teams"][0]["players"].isArray() &&
            referees["teams"][1].toObject().contains("playersLeft"));
    QVERIFY(!session->attachment("profile.json")->empty());

    // One name in rows, events, and whatever is made of them.
    QCOMPARE(info.name, std::string("Robot 1"));
    for (const SessionEvent& event : session->events()) {
      if (!event.group.empty()) QCOMPARE(event.group, std::string("Robot 1"));
    }
    const auto exported = [&path](const char* name) {
      return runProgram("pitchboard-cli", {"export", path, "--to", "csv-wide", "--robots", name,
                                           "--variables", "VISION_BALL_DIST"});
    };
    const ProgramRun lines = exported("Robot 1");
    QVERIFY2(lines.exitCode == 0, lines.err.constData());
    QCOMPARE(lines.out.split('\n').first(), QByteArray("time,Robot 1.VISION_BALL_DIST"));
    // It was never called B1: the error lists what is there.
    const ProgramRun guessed = exported("B1");
    QCOMPARE(guessed.exitCode, 2);
    QVERIFY2(guessed.err.contains("There is no robot \"B1\"; there are: Robot 1"),
             guessed.err.constData());
  }

  /// A robot is switched on, and the recording is killed within two seconds: what the disk had been
  /// given is there, from the robot's first datagram on.
  void theFirstSecondsOutliveAKilledRecording() {
    const TestSocket robot;
    int base = 0, variables = 0, referee = 0;
    {
      const TestSocket first, second, third;
      base = first.port() - 1;
      variables = second.port() - 1;
      referee = third.port();
    }
    const QString path = m_folder.filePath("killed.mcap");
    QProcess process;
    process.start(program,
                  {"record", "--live", "--bind", "127.0.0.1", "--robots", "1", "--port-base",
                   QString::number(base), "--variables-port-base", QString::number(variables),
                   "--gamecontroller-port", QString::number(referee), "-o", path});
    QByteArray err;
    QTRY_VERIFY_WITH_TIMEOUT((err += process.readAllStandardError()).contains("listening at"),
                             30'000);
    // Neither of the columns that are compared is sent both as a variable and in messages.
    constexpr int count = 8;
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(i);
      QVERIFY(robot.send(static_cast<std::uint16_t>(variables + 1),
                         "PB2 1 " + number + " " + std::to_string(9000 + 50 * i) +
                             " @REFRESH=2000 COM_REFEREE=" + number + " OUT"));
      QVERIFY(robot.send(static_cast<std::uint16_t>(base + 1),
                         "1 " + number + " 300 90 12.5 80.0 10.0 1 1 1 0 1 8 0.5 189 OUT"));
    }
    const auto recorded = [&path](const char* column) {
      std::vector<double> values;
      const auto session = SessionReader::open(path.toStdString());
      if (!session) return values;
      session->rows(always, {}, [&](GroupId group, const RowView& row) {
        const GroupInfo& info = session->groups()[group].info;
        const auto found = std::ranges::find(info.columns, column, &ColumnInfo::name);
        if (found == info.columns.end()) return true;
        const auto at = static_cast<std::size_t>(found - info.columns.begin());
        values.push_back(valueOf(info, row, at));
        return true;
      });
      return values;
    };
    // A chunk is on the disk within a second; the sender has stopped long before two.
    QTRY_COMPARE_WITH_TIMEOUT(recorded("COM_REFEREE").size(), std::size_t{count}, 30'000);
    process.kill();
    QVERIFY(process.waitForFinished(60'000));
    const auto session = SessionReader::open(path.toStdString());
    QVERIFY(session && !session->complete());
    for (const char* column : {"COM_REFEREE", "LOCALIZATION_X"}) {
      const std::vector<double> values = recorded(column);
      QCOMPARE(values.size(), std::size_t{count});
      for (int i = 0; i < count; ++i) QCOMPARE(values[static_cast<std::size_t>(i)], double(i));
    }
    QCOMPARE(session->count(SessionStream::Telemetry), std::uint64_t{count});
    QVERIFY(std::ranges::any_of(session->events(), [](const SessionEvent& event) {
      return event.kind == "robot-heard" && event.group == "Robot 1";
    }));
  }
};

PITCHBOARD_TEST(TestCliLiveRecording)

}  // namespace tst_cli_live_recording

#include "tst_cli_live_recording.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// A live session by hand, rebuilt from its snapshots.

#include <QtTest>

#include <robotlink/live/live_pipeline.h>
#include <robotlink/report/session_tally.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/moment_scenario.h>
#include <robotlink/session/recorded_frame.h>

namespace tst_recorded_live {

using namespace pitchboard;
using namespace pitchboard::link;

class TestRecordedLive : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

 private slots:
  void jumpsOfTheBeliefAreNotWalked() {
    const std::string path = m_folder.filePath("jumps.mcap").toStdString();
    const LiveOptions live;
    const telemetry::WallTime zero = std::chrono::system_clock::now();
    auto recorder = LiveRecorder::create(path, live, zero).value();
    LivePipeline pipeline(live, zero);
    pipeline.observe(recorder, zero);
    // 10 cm/s, a message a second; for three seconds it believes to be 5 m away.
    for (int second = 1; second <= 20; ++second) {
      const int x = 200 + 10 * second + (second >= 10 && second < 13 ? 500 : 0);
      const std::string text =
          "1 " + std::to_string(x) + " 300 90 12.5 80.0 10.0 1 1 1 0 1 8 0.5 189 OUT";
      telemetry::DatagramView datagram;
      datagram.time = zero + std::chrono::seconds(second);
      datagram.sender = {{0x7f000001}, 5000};
      datagram.localPort = 1241;
      datagram.payload = text;
      pipeline.take(datagram);
      (void)pipeline.advance(datagram.time);
    }
    QVERIFY(recorder->finish());
    const auto session = telemetry::SessionReader::open(path).value();
    const MatchStatistics s = statisticsOf(session, *session.range());
    QCOMPARE(s.robots.size(), std::size_t{1});
    const double walked = s.robots[0].distance.value_or(-1.0);
    QVERIFY2(walked > 1.5 && walked < 2.0, std::to_string(walked).c_str());
  }

  void liveIsRecordedAndSeenAgain() {
    const std::string path = m_folder.filePath("live.mcap").toStdString();
    LiveOptions live;
    const telemetry::WallTime zero = std::chrono::system_clock::now();
    auto recorder = LiveRecorder::create(path, live, zero).value();
    LivePipeline pipeline(live, zero);
    pipeline.observe(recorder, zero + std::chrono::milliseconds(500));
    const auto receive = [&](double time, std::string text) {
      telemetry::DatagramView datagram;
      datagram.time = zero + std::chrono::nanoseconds(static_cast<std::int64_t>(time * 1e9));
      datagram.sender = {{0x7f000001}, 5000};
      datagram.localPort = 1241;
      datagram.payload = text;
      pipeline.take(datagram);
    };
    receive(1.0, "1 450 300 90 12.5 80.0 10.0 1 1 1 0 1 8 0.5 189 OUT");
    (void)pipeline.advance(zero + std::chrono::milliseconds(1500));
    receive(2.0, "1 460 300 90 12.5 80.0 10.0 1 1 1 1 1 8 0.5 189 OUT");
    telemetry::DatagramView packet;
    packet.payload = std::string_view("RGme\0\xff", 6);
    const Result<telemetry::RefereePacket> state = telemetry::RefereeState{};
    recorder->received({.time = 2.0, .view = packet, .teams = {}, .referee = &state});
    MatchFrame frame;
    frame.snapshot.time = 2.0;
    Game& game = frame.game.emplace();
    game.state = PlayState::Playing;
    game.clock = 432;
    game.teams[1].score = 3;
    recorder->frameMade(frame);
    MatchEvent taken;
    taken.kind = MatchEventKind::PortLost;
    taken.time = 2.0;
    taken.value = 1241;
    recorder->happened(taken);
    QVERIFY(recorder->finish());

    const auto session = telemetry::SessionReader::open(path).value();
    QCOMPARE(session.count(telemetry::SessionStream::Telemetry), std::uint64_t{2});
    QCOMPARE(session.count(telemetry::SessionStream::RefereeRaw), std::uint64_t{1});
    // The robot was received, and a port was lost.
    QCOMPARE(session.events().size(), std::size_t{2});
    RecordedFrames frames(backdropOf(session));
    const MatchFrame seen = frames.frameAt(session, 2.1);
    QVERIFY(!seen.truthKnown && !seen.ballKnown);
    QCOMPARE(seen.robots.size(), std::size_t{1});
    const RobotFrame& robot = seen.robots[0];
    QVERIFY(std::hypot(robot.pose.position.x - 0.1, robot.pose.position.y) < 1e-9);
    QVERIFY(robot.lamps[3].state == telemetry::HeartbeatState::Working);
    QVERIFY(robot.link && robot.ball && !robot.timedOut());
    // What it said stands in the frame as it did in Live.
    const telemetry::TeamStatus team =
        pipeline.details(zero + std::chrono::milliseconds(2100)).team;
    QVERIFY(robot.battery && robot.battery == team.robots.at(0).battery);
    QCOMPARE(robot.link->sender.address, team.robots[0].sender.address);
    QCOMPARE(robot.values.size(), team.robots[0].texts.size());
    for (std::size_t i = 0; i < robot.values.size(); ++i) {
      QCOMPARE(std::stod(robot.values[i].text), team.robots[0].values[i]);
      QCOMPARE(robot.values[i].name, team.robots[0].name(i));
    }
    // The packet itself was none that can be read; what others read decoded says nothing here.
    QVERIFY(!seen.game);
    QVERIFY(frames.frameAt(session, 1.1).robots[0].lamps[3].state !=
            telemetry::HeartbeatState::Working);
    QCOMPARE(momentFromSession(session, 2.0, VariableCatalog::published()).error().code,
             ErrorCode::NotFound);
    const MomentScenario made = scenarioFromMoment(seen);
    QVERIFY(SimulatedMatch::create(made.scenario, {}));
  }

  /// The first ones may be lost with a damaged part of the file.
  void momentsBeforeTheFirstSnapshotShowReceivedRobots() {
    const std::string path = m_folder.filePath("lost.mcap").toStdString();
    const LiveOptions live;
    const telemetry::WallTime zero = std::chrono::system_clock::now();
    auto recorder = LiveRecorder::create(path, live, zero).value();
    for (const int second : {1, 2, 3}) {
      const std::string text =
          "1 4" + std::to_string(second) + "0 300 90 12 80 10 1 1 1 1 1 8 0 189 OUT";
      const telemetry::DatagramView datagram{
          zero + std::chrono::seconds(second), {{0x7f000001}, 5000}, 1241, false, text};
      recorder->received({.time = static_cast<double>(second), .view = datagram, .teams = {}});
    }
    recorder->remembered(3.5, LiveState(live).text(live, 3.5, zero));
    QVERIFY(recorder->finish());
    const auto session = telemetry::SessionReader::open(path).value();
    RecordedFrames frames(backdropOf(session));
    const MatchFrame seen = frames.frameAt(session, 2.5);
    QCOMPARE(seen.robots.size(), std::size_t{1});
    QVERIFY(std::abs(seen.robots[0].pose.position.x + 0.3) < 1e-9);
  }
};

PITCHBOARD_TEST(TestRecordedLive)

}  // namespace tst_recorded_live

#include "tst_recorded_live.moc"

// SPDX-License-Identifier: GPL-3.0-or-later
// What is replayed of a live match, from its file and from memory, against the frames that were on
// the screen: real sockets, recorded referee packets, every field.

#include <QTemporaryDir>
#include <QtTest>
#include <mutex>
#include <set>

#include <robotlink/live/live_state.h>
#include <robotlink/report/report.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_choice.h>
#include <robotlink/session/session_events.h>
#include <telemetry/formats/text_protocol.h>

#include "../support/recorded_packets.h"
#include "frame_difference.h"
#include "live_ports.h"

namespace tst_live_replay {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::SessionStream;

namespace {

constexpr int robots = 3;

/// Frames as they were made, and how many datagrams had been taken before each.
class Screen : public LiveObserver {
 public:
  struct Seen {
    MatchFrame frame;
    std::size_t datagrams;
  };
  void received(const LiveDatagram& datagram) override { note(datagram.time); }
  void frameMade(const MatchFrame& frame) override {
    const std::lock_guard lock(m_mutex);
    m_seen.push_back({frame, m_times.size()});
  }
  /// Without those for which a datagram that had arrived was still on its way.
  std::vector<MatchFrame> frames() const {
    const std::lock_guard lock(m_mutex);
    std::vector<MatchFrame> out;
    for (const Seen& seen : m_seen) {
      const auto arrived = std::ranges::count_if(
          m_times, [&](double time) { return time <= seen.frame.snapshot.time; });
      if (static_cast<std::size_t>(arrived) == seen.datagrams) out.push_back(seen.frame);
    }
    return out;
  }
  std::size_t taken() const {
    const std::lock_guard lock(m_mutex);
    return m_times.size();
  }
  MatchFrame last() const {
    const std::lock_guard lock(m_mutex);
    return m_seen.empty() ? MatchFrame{} : m_seen.back().frame;
  }

 private:
  void note(double time) {
    const std::lock_guard lock(m_mutex);
    m_times.push_back(time);
  }
  mutable std::mutex m_mutex;
  std::vector<Seen> m_seen;
  std::vector<double> m_times;
};

}  // namespace

class TestLiveReplay : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  std::shared_ptr<Screen> m_screen = std::make_shared<Screen>();
  std::shared_ptr<LiveMemory> m_memory;
  std::string m_path;
  std::vector<MatchFrame> m_frames;

  static std::string message(int robot, int step) {
    telemetry::TextMessage m;
    m.robot = robot;
    m.x = 300 + 7 * step;
    m.y = 200 + 40 * robot;
    m.theta = 15 * step % 360;
    m.belief = 20.0F + static_cast<float>(step);
    // Two that see one ball from two places.
    m.ballDist = robot == 3 ? -1.0F : 100.0F;
    m.ballAngle = static_cast<float>(-m.theta);
    m.control = m.vision = m.localization = m.decision = m.imu = 1;
    if (robot == 2 && step > 4) m.vision = m.decision = 0;
    m.actionA = 8 + step % 3;
    m.voltage = 165 - 2 * step;
    return telemetry::encode(m);
  }

 private slots:
  void initTestCase() {
    LiveOptions options = freeOptions(robots);
    m_path = m_folder.filePath("live.mcap").toStdString();
    LiveWatch watch(options);
    QTRY_COMPARE(watch.details().network.ports.size(), std::size_t{robots + 1});
    // It has received a robot before recording begins.
    TestSocket robot1, robot2, robot3, twin, referee;
    const auto port = [&](int robot) {
      return static_cast<std::uint16_t>(options.portBase + robot);
    };
    QVERIFY(robot1.send(port(1), message(1, 0)));
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{1});
    auto recorder = LiveRecorder::create(m_path, options, watch.began());
    QVERIFY(recorder);
    m_memory = std::make_shared<LiveMemory>();
    watch.observe(*recorder);
    watch.observe(m_memory);
    watch.observe(m_screen);

    std::size_t sent = 0;
    const auto received = [&] { return m_screen->taken() == sent; };
    const char* const packets[] = {"v12hl640_2017.3_INITIAL", "v12hl640_2017.3_PENALISED"};
    for (int step = 1; step <= 8; ++step) {
      QVERIFY(robot1.send(port(1), message(1, step)));
      QVERIFY(robot2.send(port(2), message(2, step)));
      sent += 2;
      if (step % 3 == 0) {
        QVERIFY(robot3.send(port(3), message(3, step)) && robot3.send(port(3), "3 no message"));
        sent += 2;
      }
      // A second program with the number of the second robot.
      if (step == 4) QVERIFY(twin.send(port(2), message(2, 40)) && ++sent);
      if (step % 2 == 0) {
        QVERIFY(referee.send(static_cast<std::uint16_t>(options.refereePort),
                             recordedPacket(packets[step > 4 ? 1 : 0])));
        ++sent;
      }
      if (step == 5) {
        options.ourTeam = m_screen->last().game->teamAt(true).number;
        watch.setOptions(options);
      }
      QTRY_VERIFY(received());
      // A frame of what has just come, and one of some time later.
      const std::size_t seen = m_screen->frames().size();
      QTRY_VERIFY(m_screen->frames().size() >= seen + 2);
    }
    QTRY_VERIFY(m_screen->last().game && m_screen->last().reception.ourTeam == options.ourTeam);
    watch.stopObserving(m_screen);
    watch.stopObserving(*recorder);
    watch.stopObserving(m_memory);
    QVERIFY((*recorder)->finish());
    m_frames = m_screen->frames();
  }

  void theWatchHadSomethingToShow() {
    QVERIFY(m_frames.size() >= 16);
    const MatchFrame& last = m_frames.back();
    QCOMPARE(last.robots.size(), std::size_t{4});
    QVERIFY(last.game && !last.teamBalls.empty());
    const auto any = [&](auto&& what) { return std::ranges::any_of(last.robots, what); };
    QVERIFY(any([](const RobotFrame& r) { return r.penalty.has_value(); }));
    QVERIFY(any([](const RobotFrame& r) { return r.link->conflict; }));
    QVERIFY(any([](const RobotFrame& r) { return r.link->jitter > 0.0; }));
    QVERIFY(any([](const RobotFrame& r) { return r.link->errorCount > 0; }));
    QVERIFY(any([](const RobotFrame& r) { return r.battery && r.battery->low; }));
    QVERIFY(any([](const RobotFrame& r) {
      return r.lamps[1].state == telemetry::HeartbeatState::NotResponding;
    }));
    // The referee told the colours, which nobody knew at first.
    const RobotFrame& first = m_frames.front().robots[0];
    QVERIFY(any([&](const RobotFrame& r) {
      return r.key.number == first.key.number && r.name != first.name;
    }));
    QVERIFY(m_frames.front().robots[0].link->messages >= 1);
  }

  void theFileShowsWhatWasSeen() {
    const auto session = telemetry::SessionReader::open(m_path);
    QVERIFY(session);
    RecordedFrames frames(backdropOf(*session));
    for (const MatchFrame& seen : m_frames) {
      const MatchFrame replayed = frames.frameAt(*session, seen.snapshot.time);
      QVERIFY(replayed.origin == FrameOrigin::Recorded);
      const QString found = difference(seen, replayed);
      QVERIFY2(found.isEmpty(), qPrintable(found));
    }
  }

  void inAnyOrder() {
    const auto session = telemetry::SessionReader::open(m_path);
    QVERIFY(session);
    RecordedFrames frames(backdropOf(*session));
    for (std::size_t i = 0; i < m_frames.size(); ++i) {
      const MatchFrame& seen = m_frames[(i * 7919) % m_frames.size()];
      const QString found = difference(seen, frames.frameAt(*session, seen.snapshot.time));
      QVERIFY2(found.isEmpty(), qPrintable(found));
    }
  }

  void memoryShowsWhatWasSeen() {
    LiveMoments moments;
    for (const MatchFrame& seen : m_frames) {
      const auto replayed = moments.frameAt(*m_memory, seen.snapshot.time);
      QVERIFY(replayed);
      const QString found = difference(seen, *replayed);
      QVERIFY2(found.isEmpty(), qPrintable(found));
    }
    QVERIFY(!moments.frameAt(*m_memory, m_memory->begin() - 1.0));
  }

  void whatWasSavedOfTheLastSecondsShowsItToo() {
    const MatchFrame& middle = m_frames[m_frames.size() / 2];
    telemetry::SeriesStore rows;
    telemetry::GroupInfo info;
    info.name = "Robot 1";
    info.columns.push_back({"X", telemetry::ColumnType::Float64, "cm", "", {}, {}});
    const auto group = rows.addGroup(info);
    const double end = m_frames.back().snapshot.time;
    for (const double time : {0.0, end}) {
      const double value = 1.0;
      rows.append(group, {time, {}, {&value, 1}});
    }
    RecentPast past;
    past.rows = &rows;
    past.received = m_memory.get();
    const std::string path = m_folder.filePath("last.mcap").toStdString();
    const auto saved = saveRecent(path, end - middle.snapshot.time, past,
                                  liveSessionInfo({}, telemetry::WallTime{}, "test"));
    QVERIFY(saved);
    const auto session = telemetry::SessionReader::open(path);
    QVERIFY(session);
    QVERIFY(session->count(SessionStream::Telemetry) > 0);
    QVERIFY(session->count(SessionStream::RefereeRaw) > 0);
    QVERIFY(session->count(SessionStream::Referee) > 0);
    QVERIFY(session->range()->begin >= middle.snapshot.time - 1e-6);
    RecordedFrames frames(backdropOf(*session));
    for (const MatchFrame& seen : m_frames) {
      if (seen.snapshot.time < middle.snapshot.time) continue;
      const QString found = difference(seen, frames.frameAt(*session, seen.snapshot.time));
      QVERIFY2(found.isEmpty(), qPrintable(found));
    }
    // Its first moment is there also when a sum of seconds is rounded to just before it.
    QVERIFY(frames.frameAt(*session, std::nextafter(session->range()->begin, 0.0)).game);
  }

  void aClipOfOneRobotHoldsNothingOfOthers_data() {
    QTest::addColumn<bool>("fromTheMiddle");
    QTest::newRow("whole") << false;
    QTest::newRow("from the middle") << true;
  }
  void aClipOfOneRobotHoldsNothingOfOthers() {
    QFETCH(bool, fromTheMiddle);
    const auto session = telemetry::SessionReader::open(m_path);
    QVERIFY(session);
    telemetry::ExportSelection selection;
    selection.robots = {"Robot 1"};  // B1, as it was called at first
    if (fromTheMiddle) selection.range.begin = m_frames[m_frames.size() / 2].snapshot.time;
    QVERIFY(chooseRobots(*session, telemetry::ExportFormat::Mcap, selection));
    const std::string path =
        m_folder.filePath(fromTheMiddle ? "one.mcap" : "part.mcap").toStdString();
    const auto report =
        telemetry::exportFile(*session, telemetry::ExportFormat::Mcap, selection, path);
    QVERIFY2(report, report ? "" : report.error().text().c_str());
    const auto clip = telemetry::SessionReader::open(path);
    QVERIFY(clip);
    for (const telemetry::SessionGroup& group : clip->groups()) {
      QVERIFY2(group.info.name.starts_with("B1"), group.info.name.c_str());
    }
    std::size_t datagrams = 0;
    clip->messages(SessionStream::Telemetry, *clip->range(), [&](double, std::string_view json) {
      ++datagrams;
      return telemetry::sessionDatagram(json)->payload.starts_with("1 ");
    });
    QCOMPARE(datagrams, static_cast<std::size_t>(clip->count(SessionStream::Telemetry)));
    QVERIFY(datagrams >= (fromTheMiddle ? 2U : 8U));
    for (const telemetry::SessionEvent& event : clip->events()) {
      QVERIFY2(event.group.empty() || event.group.ends_with("1"), event.group.c_str());
    }
    RecordedFrames frames(backdropOf(*clip)),
        only(backdropOf(*session),
             RobotChoice::of(*session, std::vector<std::string>{"Robot 1"}).value());
    for (const MatchFrame& seen : m_frames) {
      if (seen.snapshot.time < selection.range.begin) continue;
      // Pictures and videos of the session show what the clip shows.
      for (const MatchFrame& frame : {frames.frameAt(*clip, seen.snapshot.time),
                                      only.frameAt(*session, seen.snapshot.time)}) {
        QCOMPARE(frame.robots.size(), std::size_t{1});
        QCOMPARE(frame.robots[0].identity, seen.robots[0].identity);
        QCOMPARE(frame.robots[0].pose, seen.robots[0].pose);
        QCOMPARE(frame.robots[0].link->messages, seen.robots[0].link->messages);
        QCOMPARE(frame.game.has_value(), seen.game.has_value());
        QVERIFY(frame.snapshot.score == seen.snapshot.score);
      }
    }
  }

  void theReportHasRobotsScoreAndLink() {
    const auto session = telemetry::SessionReader::open(m_path);
    QVERIFY(session);
    const auto range = *session->range();
    const MatchStatistics s = statisticsOf(*session, {range.begin, range.end});
    QCOMPARE(s.robots.size(), std::size_t{4});
    const Game& game = *m_frames.back().game;
    std::size_t scored = 0;
    for (const TeamSummary& team : s.teams) {
      for (const GameTeam& side : game.teams) {
        if (team.team != side.colour) continue;
        ++scored;
        QCOMPARE(team.score, std::optional(side.score));
      }
    }
    QCOMPARE(scored, std::size_t{2});
    for (const RobotSummary& robot : s.robots) {
      const auto shown = std::ranges::find_if(
          m_frames.back().robots, [&](const RobotFrame& r) { return r.name == robot.name; });
      QVERIFY2(shown != m_frames.back().robots.end(), robot.name.c_str());
      QVERIFY(robot.link && robot.distance);
      QCOMPARE(robot.link->messages, shown->link->messages);
      QCOMPARE(robot.penalties, shown->penalty ? 1U : 0U);
    }
    // The first robot walked 7 cm a message: what it believes, in steps of at least 10 cm.
    const auto& first = s.robots.front();
    QVERIFY(*first.distance > 0.3 && *first.distance < 0.6);
    QVERIFY(*first.link->minVolts < 15.0);
    ReportContent content;
    content.statistics = s;
    const QString page = QString::fromStdString(reportHtml(content));
    QVERIFY(page.contains(QStringLiteral("Connection")));
    QVERIFY(!page.contains(QStringLiteral("No robot was recorded")));
  }

  void whatHappenedIsInTheFile() {
    const auto session = telemetry::SessionReader::open(m_path);
    QVERIFY(session);
    std::set<MatchEventKind> kinds;
    for (const MatchEvent& event : eventsOf(*session)) kinds.insert(event.kind);
    for (const MatchEventKind kind :
         {MatchEventKind::BatteryLow, MatchEventKind::Penalised, MatchEventKind::SecondSender,
          MatchEventKind::RefereeReceived}) {
      QVERIFY2(kinds.contains(kind), std::string(info(kind).name).c_str());
    }
  }

  void whatIsNoStateIsRefused() {
    for (const char* bad : {"", "[1]", "{\"options\":{}}"}) QVERIFY(!LiveState::read(bad, {}));
    // Every kind of value where another one should be: read as far as it makes sense.
    const char* const odd =
        "{\"options\":{\"profile\":7,\"battery\":[]},\"ids\":[3,{\"number\":\"x\"}],"
        "\"referee\":[{},{\"base64\":\"?\"}],\"robots\":\"{\\\"robots\\\":[7,{\\\"arrivals\\\":{},"
        "\\\"values\\\":[null,\\\"x\\\"],\\\"last\\\":1e300}]}\"}";
    QVERIFY(LiveState::read(odd, {}));
  }
};

PITCHBOARD_TEST(TestLiveReplay)

}  // namespace tst_live_replay

#include "tst_live_replay.moc"

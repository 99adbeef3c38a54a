// SPDX-License-Identifier: GPL-3.0-or-later
// A simulated match and a live stream: source, recorded file, command line and report have one list
// of events.
#include <QFile>
#include <QTemporaryDir>
#include <QtTest>

#include <robotlink/live/live_watch.h>
#include <robotlink/match/match_runner.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/session_events.h>

#include "../support/event_lists.h"
#include "../ui/live_rig.h"

namespace tst_same_events {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;
using Kind = MatchEventKind;

class TestSameEvents : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  static bool has(const std::vector<MatchEvent>& events, Kind kind) {
    return std::any_of(events.begin(), events.end(),
                       [kind](const auto& event) { return event.kind == kind; });
  }
  void compare(const QString& path, const std::vector<MatchEvent>& events) {
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session);
    const auto read = eventsOf(*session);
    const QStringList wanted = event_lists::linesOf(events);
    QCOMPARE(event_lists::linesOf(read), wanted);
    QCOMPARE(read.size(), events.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      MatchEvent same = events[i];
      same.time = read[i].time;
      QVERIFY2(read[i] == same, qPrintable(QString::number(i)));
    }
    QCOMPARE(event_lists::inspected(path), wanted);
    const QString report = path + QStringLiteral(".html");
    event_lists::cli({"export", path, "--to", "report", "-o", report});
    QFile page(report);
    QVERIFY(page.open(QIODevice::ReadOnly));
    QCOMPARE(event_lists::reported(QString::fromUtf8(page.readAll())),
             event_lists::expectedRows(events));
  }

 private slots:
  void ofASimulatedMatch() {
    Scenario scenario = loadScenario("match-3v3").value();
    scenario.stop.duration = 20.0;
    // Over the line in the first second.
    scenario.ball = {scenario.settings.field.halfLength() - 0.3, 0.0};
    scenario.ballVelocity = {2.0, 0.0};
    const QString path = m_folder.filePath(QStringLiteral("simulated.mcap"));
    const auto sampler = std::make_shared<MatchSampler>();
    const RecorderOptions options;
    const auto recorder = MatchRecorder::create(path.toStdString(), scenario,
                                                VariableCatalog::published(), sampler, options)
                              .value();
    auto runner =
        MatchRunner::start(scenario, {}, true, VariableCatalog::published(), {sampler, recorder})
            .value();
    std::vector<MatchEvent> events;
    const auto take = [&] {
      for (MatchEvent& event : runner->drainEvents()) events.push_back(std::move(event));
      return &events;
    };
    for (const char* script : {"exit 0", "echo ouch; exit 3"}) {
      runner->execute([script](SimulatedMatch& match) {
        ManagedProcess process;
        process.spec = {RobotId{2}, "test", {"/bin/sh", "-c", script}};
        process.restart.policy = RestartPolicy::Never;
        (void)match.robots().processes().add(process, *match.blackboard(RobotId{2}),
                                             std::chrono::steady_clock::now());
        return Changed::No;
      });
    }
    QTRY_VERIFY_WITH_TIMEOUT(has(*take(), Kind::ProcessEnded) && has(events, Kind::ProcessDied),
                             20'000);
    runner->runTo(20 * 60);
    QVERIFY(runner->waitUntilStill(60s));
    runner->stopObserving(recorder);
    take();
    QVERIFY(recorder->finish());
    for (const Kind kind : {Kind::GameState, Kind::Goal, Kind::ProcessStarted,
                            Kind::ProcessRestarted, Kind::MatchOver}) {
      QVERIFY2(has(events, kind), info(kind).name.data());
    }
    const auto goal = std::find_if(events.begin(), events.end(),
                                   [](const auto& event) { return event.kind == Kind::Goal; });
    QVERIFY(goal->side == Side::Left);
    QCOMPARE(goal->colour, std::optional(TeamColor::Blue));
    QCOMPARE(goal->score, (sim::Score{1, 0}));
    compare(path, events);
  }

  void ofALiveStream() {
    const LiveOptions options = live_rig::options();
    LiveWatch watch(options);
    QTRY_VERIFY(!watch.details().network.ports.empty());
    const QString path = m_folder.filePath(QStringLiteral("live.mcap"));
    const auto recorder = LiveRecorder::create(path.toStdString(), options, watch.began()).value();
    watch.observe(recorder);
    std::vector<MatchEvent> events;
    const auto received = [&](Kind kind) {
      for (MatchEvent& event : watch.take().events) events.push_back(std::move(event));
      return has(events, kind);
    };
    const live_rig::Robot robot(options, 3);
    const TestSocket referee;
    const auto send = [&](const char* file) {
      return referee.send(static_cast<std::uint16_t>(options.refereePort),
                          live_rig::packet(QLatin1String(file)));
    };
    QVERIFY(robot.sendMessage());
    QTRY_VERIFY(received(Kind::RobotReceived));
    QVERIFY(send("v12hl688_INITIAL.bin"));
    QTRY_VERIFY(received(Kind::RefereeReceived));
    QVERIFY(send("v12hl688_PLAYING_1-0.bin"));
    QTRY_VERIFY(received(Kind::Goal));
    watch.stopObserving(recorder);
    QVERIFY(recorder->finish());
    // None is sent any more: what a slow machine still adds came after the recording.
    const auto read = eventsOf(telemetry::SessionReader::open(path.toStdString()).value());
    QVERIFY(!read.empty());
    QTRY_VERIFY((received(Kind::Goal), events.size() >= read.size()));
    events.resize(read.size());
    compare(path, events);
  }
};

PITCHBOARD_TEST(TestSameEvents)

}  // namespace tst_same_events

#include "tst_same_events.moc"

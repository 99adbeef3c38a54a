// SPDX-License-Identifier: GPL-3.0-or-later
// The watch of real robots, with real sockets on 127.0.0.1: what it hears, to whom it tells it, and
// what it sends.

#include <QtTest>
#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include <robotlink/live/live_pipeline.h>
#include <robotlink/live/live_watch.h>
#include <telemetry/formats/text_protocol.h>
#include <telemetry/series/series_store.h>

#include "../support/recorded_packets.h"
#include "live_ports.h"

namespace tst_live_watch {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

std::uint16_t portOf(const LiveOptions& options, int robot) {
  return static_cast<std::uint16_t>(options.portBase + robot);
}

std::string message(int robot, int x = 300) {
  telemetry::TextMessage m;
  m.robot = robot;
  m.x = x;
  m.y = 200;
  m.control = m.vision = m.localization = m.decision = m.imu = 1;
  return telemetry::encode(m);
}

std::size_t bound(const LiveWatch& watch) {
  std::size_t count = 0;
  for (const auto& port : watch.details().network.ports) count += port.bound ? 1 : 0;
  return count;
}

/// Counts what the watch's thread tells.
class Witness : public LiveObserver {
 public:
  void received(const LiveDatagram& datagram) override {
    if (datagram.state() != nullptr) {
      ++referee;
    } else if (datagram.verdict == LiveDatagram::Verdict::Used) {
      const std::lock_guard lock(mutex);
      ids.push_back(datagram.robot.number);
      numbers.push_back(datagram.decoded->robot);
      times.push_back(datagram.time);
      payloads.emplace_back(datagram.view.payload);
    } else if (!datagram.isFromRefusedSender()) {
      ++unused;
    }
  }
  void frameMade(const MatchFrame&) override { ++frames; }
  std::shared_ptr<telemetry::RowSink> rows() override { return store; }

  std::size_t count() {
    const std::lock_guard lock(mutex);
    return numbers.size();
  }

  std::mutex mutex;
  std::vector<int> ids, numbers;
  std::vector<double> times;
  std::vector<std::string> payloads;
  std::atomic<int> referee = 0, unused = 0, frames = 0;
  std::shared_ptr<telemetry::SeriesStore> store = std::make_shared<telemetry::SeriesStore>();
};

/// Notes the threads on which it is called, as an observer and as a sink of rows.
class ThreadWitness : public LiveObserver,
                      public telemetry::RowSink,
                      public std::enable_shared_from_this<ThreadWitness> {
 public:
  void received(const LiveDatagram&) override { note("received"); }
  void happened(const MatchEvent&) override { note("happened"); }
  void frameMade(const MatchFrame&) override { note("frameMade"); }
  void remembered(double, std::string_view) override { note("remembered"); }
  std::shared_ptr<telemetry::RowSink> rows() override {
    note("rows");
    return shared_from_this();
  }
  telemetry::GroupId addGroup(const telemetry::GroupInfo&) override {
    note("addGroup");
    return m_groups++;
  }
  void describeGroups(std::span<const telemetry::GroupInfo>) override { note("describeGroups"); }
  void append(telemetry::GroupId, const telemetry::RowView&) override { note("append"); }

  bool knows(const char* call) {
    const std::lock_guard lock(m_mutex);
    return m_calls.contains(call);
  }
  std::set<std::thread::id> threads() {
    const std::lock_guard lock(m_mutex);
    return m_threads;
  }

 private:
  void note(const char* call) {
    const std::lock_guard lock(m_mutex);
    m_calls.insert(call);
    m_threads.insert(std::this_thread::get_id());
  }
  std::mutex m_mutex;
  std::set<std::string> m_calls;
  std::set<std::thread::id> m_threads;
  telemetry::GroupId m_groups = 0;
};

/// Keeps the watch's thread in the middle of decoding, at most for some seconds.
class Obstacle : public LiveObserver {
 public:
  void received(const LiveDatagram&) override {
    std::unique_lock lock(m_mutex);
    m_isHeld = true;
    m_changed.notify_all();
    m_changed.wait_for(lock, std::chrono::seconds(10), [this] { return m_isFree; });
  }
  bool waitUntilHeld() {
    std::unique_lock lock(m_mutex);
    return m_changed.wait_for(lock, std::chrono::seconds(10), [this] { return m_isHeld; });
  }
  void free() {
    const std::lock_guard lock(m_mutex);
    m_isFree = true;
    m_changed.notify_all();
  }

 private:
  std::mutex m_mutex;
  std::condition_variable m_changed;
  bool m_isHeld = false, m_isFree = false;
};

/// Counts everything that a pipeline writes.
struct Count : LiveObserver {
  struct Rows : telemetry::RowSink {
    telemetry::GroupId addGroup(const telemetry::GroupInfo&) override { return groups++; }
    void describeGroups(std::span<const telemetry::GroupInfo>) override { ++count; }
    void append(telemetry::GroupId, const telemetry::RowView&) override { ++count; }
    telemetry::GroupId groups = 0;
    int count = 0;
  };
  void happened(const MatchEvent&) override { ++events; }
  void frameMade(const MatchFrame&) override { ++frames; }
  void remembered(double, std::string_view) override { ++snapshots; }
  std::shared_ptr<telemetry::RowSink> rows() override { return sink; }
  std::array<int, 4> all() const { return {sink->count, events, frames, snapshots}; }

  std::shared_ptr<Rows> sink = std::make_shared<Rows>();
  int events = 0, frames = 0, snapshots = 0;
};

}  // namespace

class TestLiveWatch : public QObject {
  Q_OBJECT

 private slots:
  /// The default start and then Live showed eight simulated robots and their referee as real ones.
  void simulatedRobotsAreNotTakenForRealOnes() {
    const telemetry::WallTime zero{std::chrono::seconds(1'000'000)};
    LiveOptions options;
    const auto take = [&](LivePipeline& pipeline, telemetry::Address from, int port,
                          const std::string& text, int millisecond) {
      pipeline.take({zero + std::chrono::milliseconds(millisecond),
                     {from, 4000},
                     static_cast<std::uint16_t>(port),
                     false,
                     text});
    };
    const telemetry::Address real{0xc0a80107};
    const std::string played = recordedPacket("v12hl688_PLAYING_1-0"),
                      other = recordedPacket("v12hl688_PLAYING_1-0");
    {
      LivePipeline pipeline(options, zero);
      take(pipeline, telemetry::simulatedAddress, 1241, message(1), 0);
      take(pipeline, telemetry::simulatedAddress, 3838, played, 0);
      const MatchFrame frame = pipeline.advance(zero + std::chrono::milliseconds(10));
      QVERIFY(frame.robots.empty());
      QVERIFY(!frame.game);
      QCOMPARE(pipeline.details(zero).ignoredSimulated, std::uint64_t{2});
    }
    options.simulated = true;
    LivePipeline pipeline(options, zero);
    take(pipeline, telemetry::simulatedAddress, 1241, message(1), 0);
    take(pipeline, real, 1241, message(1, 500), 1);
    take(pipeline, telemetry::simulatedAddress, 3838, played, 2);
    MatchFrame frame = pipeline.advance(zero + std::chrono::milliseconds(10));
    QCOMPARE(frame.robots.size(), std::size_t{2});
    QCOMPARE(frame.robots[0].name, std::string("Robot 1"));
    QCOMPARE(frame.robots[1].name, std::string("Simulated 1"));
    QVERIFY(!frame.robots[0].link->conflict);
    QVERIFY(frame.reception.sender.starts_with(telemetry::simulatedAddress.text()));
    // The real referee comes, at once; then it is silent for long, and is not replaced.
    take(pipeline, real, 3838, other, 20);
    frame = pipeline.advance(zero + std::chrono::milliseconds(30));
    QVERIFY(frame.reception.sender.starts_with(real.text()));
    take(pipeline, telemetry::simulatedAddress, 3838, played, 60'000);
    frame = pipeline.advance(zero + std::chrono::seconds(60));
    QVERIFY(frame.reception.sender.starts_with(real.text()));
    QVERIFY(frame.reception.timedOut);
    // A recording shows them as they were called.
    const std::string saved = [&] {
      struct Keeper : LiveObserver {
        void remembered(double, std::string_view text) override { kept = text; }
        std::string kept;
      };
      const auto keeper = std::make_shared<Keeper>();
      pipeline.observe(keeper, zero + std::chrono::seconds(1));
      return keeper->kept;
    }();
    auto read = LiveState::read(saved, zero);
    QVERIFY(read);
    const auto status = read->state.monitor.status(zero + std::chrono::seconds(1));
    QCOMPARE(status.robots.back().key, (RobotKey{telemetry::simulatedTeam, 1, 0}));
    // Turned off again.
    options.simulated = false;
    pipeline.setOptions(options, zero + std::chrono::seconds(1));
    frame = pipeline.advance(zero + std::chrono::seconds(1));
    QCOMPARE(frame.robots.size(), std::size_t{1});
    QCOMPARE(frame.robots[0].name, std::string("Robot 1"));
  }

  void portsThatCollideAreRefused() {
    LiveOptions options;
    QVERIFY(validate(options));
    options.refereePort = options.portBase + 1;
    QCOMPARE(validate(options).error().code, ErrorCode::InvalidArgument);
    options.refereePort = 70'000;
    QCOMPARE(validate(options).error().code, ErrorCode::InvalidArgument);
  }

  void messagesOfRobotsAreShown() {
    const LiveOptions options = freeOptions();
    LiveWatch watch(options);
    const auto witness = std::make_shared<Witness>();
    watch.observe(witness);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket one, three;
    QVERIFY(one.send(portOf(options, 1), message(1, 310)));
    QTRY_COMPARE(witness->count(), std::size_t{1});
    QVERIFY(three.send(portOf(options, 3), message(3, 330)));
    QTRY_COMPARE(witness->count(), std::size_t{2});
    QVERIFY(three.send(portOf(options, 3), "nonsense"));
    QTRY_COMPARE(witness->unused.load(), 1);

    QTRY_VERIFY(watch.take().frame);
    QTRY_VERIFY(watch.take().frame->robots.size() == 2);
    const auto frame = watch.take().frame;
    QCOMPARE(frame->origin, FrameOrigin::Live);
    QVERIFY(!frame->truthKnown);
    // No robot can be blamed for what names none.
    QTRY_VERIFY(watch.details().team.errors.messages() > 0);
    const telemetry::TeamStatus team = watch.details().team;
    QCOMPARE(team.robots.size(), std::size_t{2});
    QCOMPARE(team.robots[0].key.number, 1);
    QCOMPARE(team.robots[1].key.number, 3);
    QCOMPARE(team.robots[1].sender.port, three.port());
    QCOMPARE(team.robots[1].errors.messages(), std::uint64_t{0});
    const std::lock_guard lock(witness->mutex);
    QCOMPARE(witness->numbers, (std::vector<int>{1, 3}));
    QCOMPARE(witness->payloads, (std::vector<std::string>{message(1, 310), message(3, 330)}));
    QVERIFY(witness->ids[0] != witness->ids[1]);
    QVERIFY(witness->times[0] <= witness->times[1]);
  }

  void aFrameIsAnnouncedOnceUntilItIsTaken() {
    std::atomic<int> calls = 0;
    LiveWatch watch(freeOptions(), [&calls] { ++calls; });
    const auto witness = std::make_shared<Witness>();
    watch.observe(witness);
    // Frames go on without messages, so that ages and timeouts do.
    QTRY_VERIFY(witness->frames.load() >= 4);
    QCOMPARE(calls.load(), 1);
    const auto first = watch.take().frame;
    QVERIFY(first);
    QTRY_COMPARE(calls.load(), 2);
    QVERIFY(watch.take().frame->serial > first->serial);
  }

  void aRemovedObserverIsNotCalled() {
    const LiveOptions options = freeOptions();
    LiveWatch watch(options);
    const auto gone = std::make_shared<Witness>(), there = std::make_shared<Witness>();
    watch.observe(gone);
    watch.observe(there);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket robot;
    QVERIFY(robot.send(portOf(options, 2), message(2, 300)));
    QTRY_COMPARE(there->count(), std::size_t{1});
    watch.stopObserving(gone);
    const int frames = gone->frames;
    QVERIFY(robot.send(portOf(options, 2), message(2, 301)));
    QTRY_COMPARE(there->count(), std::size_t{2});
    QTRY_VERIFY(there->frames.load() > frames + 1);
    QCOMPARE(gone->count(), std::size_t{1});
    QCOMPARE(gone->frames.load(), frames);
    QCOMPARE(gone.use_count(), 1L);
    // One who joins later gets the rows from then on.
    const auto late = std::make_shared<Witness>();
    watch.observe(late);
    QVERIFY(robot.send(portOf(options, 2), message(2, 302)));
    const auto rowsOf = [](const Witness& one, std::string_view group) {
      const auto id = one.store->findGroup(group);
      return id ? one.store->view(*id)->rows() : std::size_t{0};
    };
    QTRY_COMPARE(rowsOf(*late, "Robot 2"), std::size_t{1});
    QTRY_VERIFY(rowsOf(*late, "Robot 2 link") > 0);
    QCOMPARE(rowsOf(*there, "Robot 2"), std::size_t{3});
    QCOMPARE(rowsOf(*gone, "Robot 2"), std::size_t{1});
  }

  /// stopObserving() made a frame on the caller's thread, and observe() a snapshot.
  void anObserverIsCalledOnOneThread() {
    LiveOptions options = freeOptions();
    options.variablesPortBase = options.refereePort;
    LiveWatch watch(options);
    const auto witness = std::make_shared<ThreadWitness>();
    watch.observe(witness);
    QTRY_COMPARE(bound(watch), std::size_t{7});
    const TestSocket robot;
    QVERIFY(robot.send(portOf(options, 2), message(2)));
    for (const char* call : {"received", "happened", "frameMade", "append"}) {
      QTRY_VERIFY2(witness->knows(call), call);
    }
    const auto variables = static_cast<std::uint16_t>(options.variablesPortBase + 2);
    QVERIFY(robot.send(variables, "PB2 2 1 1000 DECISION_ACTION=8 OUT"));
    watch.setOptions(options);
    QTRY_COMPARE(watch.details().sent.size(), std::size_t{1});
    watch.stopObserving(witness);
    QVERIFY(witness->knows("remembered") && witness->knows("rows"));
    QCOMPARE(witness->threads().size(), std::size_t{1});
    QVERIFY(!witness->threads().contains(std::this_thread::get_id()));
  }

  /// take() and details() waited for the mutex that was held while datagrams were decoded.
  void theScreenDoesNotWaitForDecoding() {
    const LiveOptions options = freeOptions();
    LiveWatch watch(options);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket robot;
    QVERIFY(robot.send(portOf(options, 1), message(1)));
    QTRY_VERIFY(watch.take().frame && watch.take().frame->robots.size() == 1);
    const auto obstacle = std::make_shared<Obstacle>();
    watch.observe(obstacle);
    QVERIFY(robot.send(portOf(options, 2), message(2)));
    QVERIFY(obstacle->waitUntilHeld());
    QElapsedTimer timer;
    timer.start();
    const auto frame = watch.take().frame;
    const LiveDetails details = watch.details();
    watch.setOptions(options);
    watch.forget(frame->robots.at(0).uid);
    const qint64 elapsed = timer.elapsed();
    obstacle->free();
    QVERIFY2(elapsed < 2000, QByteArray::number(elapsed));
    QCOMPARE(frame->robots.size(), std::size_t{1});
    QCOMPARE(details.team.robots.size(), std::size_t{1});
    QTRY_VERIFY(watch.take().frame->robots.size() == 1 &&
                watch.take().frame->robots[0].key.number == 2);
  }

  /// Asking for a frame wrote rows, events and snapshots.
  void askingForAFrameWritesNothing() {
    const LiveOptions options;
    LivePipeline pipeline(options, {});
    const auto at = [](int milliseconds) {
      return telemetry::WallTime(std::chrono::milliseconds(milliseconds));
    };
    const auto count = std::make_shared<Count>();
    pipeline.observe(count, at(0));
    const auto send = [&](int port, const std::string& text, int milliseconds) {
      pipeline.take(
          {at(milliseconds), {{0x0a000001}, 4000}, static_cast<std::uint16_t>(port), false, text});
    };
    send(options.portBase + 1, message(1), 100);
    (void)pipeline.advance(at(110));
    send(options.portBase + 2, message(2), 120);
    send(options.variablesPortBase + 1, "PB2 1 1 1000 DECISION_ACTION=8 OUT", 130);
    const auto before = count->all();
    // A snapshot, reports, timeouts and variables are due.
    const MatchFrame first = pipeline.frame(at(30'000)), again = pipeline.frame(at(30'000));
    QCOMPARE(count->all(), before);
    QVERIFY(pipeline.drainNews().events.size() == std::size_t(before[1]));
    QCOMPARE(first.serial, again.serial);
    QCOMPARE(first.robots.size(), std::size_t{2});
    QCOMPARE(again.robots.size(), std::size_t{2});
    QVERIFY(first.robots[0].link->timedOut);
    (void)pipeline.advance(at(30'000));
    const auto after = count->all();
    for (std::size_t i = 0; i < after.size(); ++i) QVERIFY(after[i] > before[i]);
  }

  void theRefereeIsReceived() {
    const LiveOptions options = freeOptions();
    LiveWatch watch(options);
    const auto witness = std::make_shared<Witness>();
    watch.observe(witness);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket referee;
    const auto port = static_cast<std::uint16_t>(options.refereePort);
    QVERIFY(referee.send(port, recordedPacket("v12hl688_PLAYING_1-0")));
    QTRY_COMPARE(witness->referee.load(), 1);
    LiveNews news;
    std::size_t events = 0;
    QTRY_VERIFY((news = watch.take(), events += news.events.size(), news.frame) &&
                news.frame->game);
    QCOMPARE(news.frame->reception.version, 12);
    QVERIFY(referee.send(port, "no packet"));
    QTRY_COMPARE(watch.details().unknownReferee, std::uint64_t{1});
    QCOMPARE(watch.details().unknownRefereeSample, std::string("no packet"));
    QVERIFY(!watch.details().unknownRefereeReason.empty());
    QCOMPARE(witness->unused.load(), 1);
    // What happened is given once.
    QVERIFY(events > 0);
    QVERIFY(watch.take().events.empty());
  }

  void otherPortsAreListenedTo() {
    const LiveOptions before = freeOptions();
    LiveWatch watch(before);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket robot;
    QVERIFY(robot.send(portOf(before, 1), message(1)));
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{1});
    const LiveOptions after = freeOptions(2);
    watch.setOptions(after);
    QTRY_COMPARE(watch.details().network.ports.size(), std::size_t{3});
    QTRY_COMPARE(bound(watch), std::size_t{3});
    QCOMPARE(watch.details().network.ports[0].port, portOf(after, 1));
    QVERIFY(robot.send(portOf(after, 2), message(2)));
    // The robot of before stays.
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{2});
  }

  void aTakenPortIsNamed() {
    const LiveOptions options = freeOptions();
    const TestSocket other(INADDR_LOOPBACK, portOf(options, 2));
    QVERIFY(other.good());
    LiveWatch watch(options);
    QTRY_COMPARE(bound(watch), std::size_t{3});
    const auto ports = watch.details().network.ports;
    QVERIFY(!ports[1].bound && !ports[1].problem.empty());
  }

  void whatIsClearedIsForgotten() {
    const LiveOptions options = freeOptions();
    LiveWatch watch(options);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket robot;
    QVERIFY(robot.send(portOf(options, 1), message(1)));
    QVERIFY(robot.send(static_cast<std::uint16_t>(options.refereePort), "no packet"));
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{1});
    QTRY_COMPARE(watch.details().unknownReferee, std::uint64_t{1});
    watch.clear();
    QTRY_VERIFY(watch.details().team.robots.empty());
    QCOMPARE(watch.details().unknownReferee, std::uint64_t{0});
    QTRY_VERIFY(watch.take().frame);
    QTRY_VERIFY(watch.take().frame->robots.empty());
    QVERIFY(robot.send(portOf(options, 1), message(1)));
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{1});
  }

  void oneRobotCanBeForgotten() {
    const LiveOptions options = freeOptions();
    LiveWatch watch(options);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket one, two;
    QVERIFY(one.send(portOf(options, 1), message(1)));
    QVERIFY(two.send(portOf(options, 2), message(2)));
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{2});
    std::shared_ptr<const MatchFrame> frame;
    QTRY_VERIFY((frame = watch.take().frame) && frame->robots.size() == 2);
    watch.forget(frame->robot(RobotKey{0, 1, 0})->uid);
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{1});
    QCOMPARE(watch.details().team.robots[0].key.number, 2);
    QVERIFY(one.send(portOf(options, 1), message(1)));
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{2});
  }

  void theListOfSendersIsForRobots() {
    LiveOptions options = freeOptions();
    QVERIFY(options.team.senders.add("10.1.2.3"));
    LiveWatch watch(options);
    const auto witness = std::make_shared<Witness>();
    watch.observe(witness);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket here;
    const auto port = static_cast<std::uint16_t>(options.refereePort);
    QVERIFY(here.send(portOf(options, 1), message(1)));
    QVERIFY(here.send(port, recordedPacket("v12hl688_PLAYING_1-0")));
    QTRY_COMPARE(witness->referee.load(), 1);
    QTRY_COMPARE(watch.details().team.refusedByFilter, std::uint64_t{1});
    QVERIFY(options.refereeSenders.add("10.1.2.4"));
    options.team.senders = {};
    watch.setOptions(options);
    // It is not said when options are in force: asked until they are.
    QTRY_VERIFY(here.send(port, recordedPacket("v12hl688_PLAYING_1-0")) &&
                watch.details().refusedReferees > 0);
    QVERIFY(here.send(portOf(options, 1), message(1)));
    QTRY_COMPARE(witness->count(), std::size_t{1});
  }

  void aVersionCanBeChosen() {
    LiveOptions options = freeOptions();
    options.refereeVersion = 7;
    LiveWatch watch(options);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const TestSocket referee;
    const auto port = static_cast<std::uint16_t>(options.refereePort);
    QVERIFY(referee.send(port, recordedPacket("v8hl158_PLAYING")));
    QTRY_COMPARE(watch.details().referee.otherVersions, std::uint64_t{1});
    QVERIFY(referee.send(port, recordedPacket("v7compat116_from_v8GC_PLAYING_1-0")));
    QTRY_VERIFY(watch.take().frame);
    QTRY_VERIFY(watch.take().frame->game);
    QCOMPARE(watch.take().frame->reception.version, 7);
  }

  void clocksThatAreSetMoveNothing() {
    // The computer's clock by hand; the monotonic one is real, and can sleep.
    struct Hands {
      std::atomic<std::int64_t> set = 0, slept = 0;
    };
    const auto hands = std::make_shared<Hands>();
    const telemetry::ClockSource system = telemetry::ClockSource::system();
    const telemetry::ClockSource source{
        [=] { return system.monotonic() + std::chrono::seconds(hands->slept); },
        [=] {
          return system.wall() + std::chrono::seconds(hands->set) +
                 std::chrono::seconds(hands->slept);
        }};
    const LiveOptions options = freeOptions();
    LiveWatch watch(options, {}, source);
    const auto witness = std::make_shared<Witness>();
    watch.observe(witness);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    const auto began = watch.began();
    const TestSocket robot;
    std::vector<MatchEvent> events;
    const auto gather = [&](MatchEventKind kind) {
      for (const MatchEvent& event : watch.take().events) events.push_back(event);
      return std::any_of(events.begin(), events.end(),
                         [&](const MatchEvent& event) { return event.kind == kind; });
    };
    const auto sendOne = [&](std::size_t messages) {
      return robot.send(portOf(options, 1), message(1, 300 + static_cast<int>(messages))) &&
             QTest::qWaitFor([&] { return witness->count() == messages; });
    };
    QVERIFY(sendOne(1));
    for (const std::int64_t step : {3600, -3600}) {
      events.clear();
      hands->set = step;
      QVERIFY(sendOne(step > 0 ? 2 : 3));
      QTRY_VERIFY(gather(MatchEventKind::ClockSet));
      const auto at = std::ranges::find(events, MatchEventKind::ClockSet, &MatchEvent::kind);
      QVERIFY(at->time < 600.0);  // not an hour off
      QVERIFY(!watch.details().team.robots.at(0).timedOut);
    }
    {
      const std::lock_guard lock(witness->mutex);
      QVERIFY(std::ranges::is_sorted(witness->times));
      QVERIFY(witness->times.back() < 600.0);
    }
    // An hour asleep: time went on, for the robots and for the curves.
    events.clear();
    hands->slept = 3600;
    QTRY_VERIFY(gather(MatchEventKind::RobotOffline));
    QVERIFY(sendOne(4));
    QTRY_VERIFY(gather(MatchEventKind::RobotBack));
    QVERIFY(!gather(MatchEventKind::ClockSet));
    {
      const std::lock_guard lock(witness->mutex);
      QVERIFY(witness->times.back() >= 3600.0 && witness->times.back() < 4200.0);
    }
    for (const MatchEvent& event : events) QVERIFY(event.time >= 3600.0 && event.time < 4200.0);
    QVERIFY(watch.take().frame->snapshot.time >= 3600.0);
    QVERIFY(watch.began() == began);
  }

  void monitorRequestsGoOnlyToTheRefereeAndOnlyIfTurnedOn() {
    const TestSocket referee, robot;
    LiveOptions options = freeOptions();
    options.monitorPort = referee.port();
    LiveWatch watch(options);
    QTRY_COMPARE(bound(watch), std::size_t{4});
    QVERIFY(robot.send(portOf(options, 1), message(1)));
    QTRY_COMPARE(watch.details().team.robots.size(), std::size_t{1});
    QVERIFY(!referee.received());
    options.monitor = telemetry::Address{INADDR_LOOPBACK};
    watch.setOptions(options);
    QTRY_VERIFY(referee.received());
    QCOMPARE(watch.details().monitorProblem, std::string());
    QVERIFY(!robot.received());
  }

  void itEndsWhileAFloodGoesOn() {
    const LiveOptions options = freeOptions();
    const TestSocket robot;
    auto watch = std::make_unique<LiveWatch>(options);
    QTRY_COMPARE(bound(*watch), std::size_t{4});
    for (int i = 0; i < 2000; ++i) {
      QVERIFY(robot.send(portOf(options, 1), message(1, i)));
      if (i == 1000) watch.reset();
    }
    QVERIFY(!watch);
  }
};

PITCHBOARD_TEST(TestLiveWatch)

}  // namespace tst_live_watch

#include "tst_live_watch.moc"

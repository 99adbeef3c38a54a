// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_watch.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include <robotlink/frame/build_robot.h>
#include <robotlink/live/live_books.h>
#include <robotlink/live/live_teams.h>

#include "live_events.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;
using telemetry::DatagramBatch;
using telemetry::DatagramView;
using telemetry::RefereeState;
using telemetry::TeamMonitor;
using telemetry::WallTime;

constexpr auto framePeriod = 16ms;  // at most so often while something arrives
constexpr auto idlePeriod = 100ms;  // ages and timeouts go on without messages
constexpr auto portsPeriod = 500ms;
constexpr auto reportPeriod = 250ms;
constexpr auto booksPeriod = 15s;  // a moment of a recording is made from the books before it
constexpr std::size_t flood = 16;  // datagrams in one go from which on it pays to gather
constexpr std::size_t maxQueued = 10'000;

telemetry::ReceiverOptions receiverOptions(
    const LiveOptions& options, const std::shared_ptr<const telemetry::LiveClock>& clock) {
  telemetry::ReceiverOptions made;
  made.bind = options.bind;
  made.clock = clock;
  const auto ports = telemetry::teamPorts(options.team.teams, options.portBase, options.robots,
                                          options.refereePort);
  if (ports) made.ports = *ports;
  if (options.monitor) made.ports.push_back(telemetry::robotStatesPort);
  return made;
}

void queueUp(std::vector<MatchEvent>& queue, const std::vector<MatchEvent>& items) {
  queue.insert(queue.end(), items.begin(), items.end());
  if (queue.size() > maxQueued) {
    queue.erase(queue.begin(), queue.end() - static_cast<std::ptrdiff_t>(maxQueued));
  }
}

}  // namespace

Result<void> validate(const LiveOptions& options) {
  const auto ports = telemetry::teamPorts(options.team.teams, options.portBase, options.robots,
                                          options.refereePort);
  if (!ports) return tl::unexpected<Error>(ports.error());
  if (const auto good = telemetry::validate(options.profile); !good) return good;
  if (const auto good = validate(options.boards); !good) return good;
  return sim::validate(options.field);
}

struct LiveWatch::Impl {
  Impl(LiveOptions o, std::function<void()> ready, telemetry::ClockSource source)
      : clock(std::make_shared<const telemetry::LiveClock>(std::move(source))),
        options(std::move(o)),
        onFrame(std::move(ready)),
        books(options) {
    boards.set(options.boards);
  }

  double arrival(WallTime time) const { return std::max(0.0, clock->seconds(time)); }

  void listen() {
    {
      const std::lock_guard lock(mutex);
      receiver.reset();  // its ports may be wanted again
    }
    auto started = telemetry::UdpReceiver::start(receiverOptions(options, clock));
    const std::lock_guard lock(mutex);
    networkProblem = started ? std::string() : started.error().text();
    if (started) receiver = std::move(*started);
  }

  void adoptOptions() {
    std::unique_lock lock(mutex);
    if (!pending) return;
    const LiveOptions old = std::exchange(options, std::move(*pending));
    pending.reset();
    if (!(old.profile == options.profile)) monitor.setProfile(options.profile);
    books.setTeams(monitorOptions(options));
    boards.set(options.boards);
    referee.setOptions(LiveBooks::refereeOptions(options));
    noteTeams(monitor.renamings());
    tellBooks();
    monitorProblem.clear();
    const auto before = receiverOptions(old, clock), after = receiverOptions(options, clock);
    if (before.ports == after.ports && before.bind == after.bind && receiver) return;
    lock.unlock();
    listen();
  }

  void forget() {
    const std::lock_guard lock(mutex);
    for (const RobotKey& robot : std::exchange(forgetAsked, {})) {
      monitor.forget(robot);
      tellBooks();
    }
    if (!std::exchange(clearAsked, false)) return;
    books.clear(options);
    happened.clear();
    noteTeams({});
    unknownReferee = refusedReferees = 0;
    unknownReason.clear();
    unknownSample.clear();
    tellBooks();
  }

  void takeReferee(const DatagramView& datagram) {
    if (!options.refereeSenders.allows(datagram.sender.address)) {
      ++refusedReferees;
      return;
    }
    const auto packet = telemetry::decodeReferee(datagram.payload);
    if (!packet || !std::holds_alternative<RefereeState>(*packet)) unused(datagram);
    if (!packet) {
      ++unknownReferee;
      unknownReason = packet.error().message;
      unknownSample = telemetry::printable(datagram.payload);
      return;
    }
    books.takeReferee(*packet, datagram);
    if (books.teams(options) != teams) noteTeams({});
    if (const auto* state = std::get_if<RefereeState>(&*packet)) {
      for (const auto& observer : observers) {
        observer->refereeHeard(arrival(datagram.time), datagram, *state);
      }
    }
  }

  void unused(const DatagramView& datagram) {
    for (const auto& observer : observers) {
      observer->unusedHeard(arrival(datagram.time), datagram);
    }
  }

  void takeAll(const DatagramBatch& batch) {
    const std::lock_guard lock(mutex);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const DatagramView datagram = batch[i];
      if (datagram.localPort == options.refereePort ||
          (options.monitor && datagram.localPort == telemetry::robotStatesPort)) {
        takeReferee(datagram);
        continue;
      }
      const auto verdict = books.takeRobot(datagram, arrival(datagram.time));
      if (verdict && !monitor.renamings().empty()) noteTeams(monitor.renamings());
      if (verdict == TeamMonitor::Verdict::SenderRefused) {
        for (const auto& observer : observers) observer->strangerHeard(datagram);
        continue;
      }
      if (observers.empty()) continue;
      if (verdict != TeamMonitor::Verdict::Used) {
        unused(datagram);
      } else {
        for (const auto& observer : observers) {
          observer->heard(monitor.used(), arrival(datagram.time), datagram, monitor.decoder(),
                          monitor.decoded());
        }
      }
    }
  }

  void makeFrame(Steady::time_point now) {
    const std::lock_guard lock(mutex);
    const telemetry::TeamStatus team = monitor.status(clock->now());
    auto made = std::make_shared<MatchFrame>(books.frame(options, team, clock->seconds(team.time)));
    made->serial = ++serial;
    boards.addTo(*made);
    made->teamBalls = agreedBalls(made->robots);
    boards.takeRows([this](const telemetry::GroupInfo& group, std::span<const BoardRow> rows) {
      for (const auto& observer : observers) observer->sampled(group, rows);
    });
    tell(happened.compare(*made));
    tell(happened.compareClock(clock->setBy(), made->snapshot.time));
    if (receiver && now >= nextPorts) {
      nextPorts = now + portsPeriod;
      tell(happened.comparePorts(receiver->status(), made->snapshot.time));
    }
    for (const auto& observer : observers) {
      observer->frameMade(*made);
      if (now >= nextReport) observer->reported(team);
    }
    if (now >= nextReport) nextReport = now + reportPeriod;
    if (now >= nextBooks) tellBooks();
    news.frame = std::move(made);
    if (!std::exchange(announced, true) && onFrame) onFrame();
  }

  /// Needs the lock: what an observer hears after it, is not in the books.
  void tellBooks() {
    nextBooks = Steady::now() + booksPeriod;
    if (observers.empty()) return;
    const double time = clock->seconds(clock->now());
    const std::string text = books.text(options, time, clock->began());
    for (const auto& observer : observers) observer->remembered(time, text);
  }

  /// Robots are called otherwise from now on, and these have other keys.
  void noteTeams(const std::vector<Renaming>& renamings) {
    teams = books.teams(options);
    for (const auto& observer : observers) observer->adopted(options, teams, renamings);
    if (renamings.empty()) return;
    happened.rename(renamings);
    news.renamings.push_back(renamings);
  }

  void tell(const std::vector<MatchEvent>& what) {
    queueUp(news.events, what);
    for (const auto& observer : observers) {
      for (const MatchEvent& event : what) observer->happened(event);
    }
  }

  /// Only this sends, only to the referee, only while it is turned on.
  void askReferee(Steady::time_point now) {
    if (!options.monitor || now < nextRequest) return;
    nextRequest = now + 1s;
    const auto sent = telemetry::sendMonitorRequest(*options.monitor, options.monitorPort);
    const std::lock_guard lock(mutex);
    monitorProblem = sent ? std::string() : sent.error().text();
  }

  void run(const std::stop_token& stop) {
    listen();
    DatagramBatch batch;
    auto last = Steady::now() - idlePeriod;
    bool fresh = true;
    while (!stop.stop_requested()) {
      adoptOptions();
      forget();
      const auto due = last + (fresh ? framePeriod : idlePeriod);
      const auto wait = std::max<telemetry::Duration>(due - Steady::now(), 0ns);
      if (!receiver) {
        std::this_thread::sleep_for(wait);
      } else if (receiver->take(batch, wait)) {
        takeAll(batch);
        fresh = true;
        // In a flood every datagram would wake this thread; a millisecond gathers many.
        if (batch.size() >= flood) std::this_thread::sleep_for(1ms);
      }
      const auto now = Steady::now();
      askReferee(now);
      if (now < last + (fresh ? framePeriod : idlePeriod)) continue;
      last = now;
      fresh = false;
      makeFrame(now);
    }
  }

  const std::shared_ptr<const telemetry::LiveClock> clock;
  LiveOptions options;  // changed by the thread only
  const std::function<void()> onFrame;
  std::unique_ptr<telemetry::UdpReceiver> receiver;
  Steady::time_point nextRequest{}, nextPorts{}, nextReport{}, nextBooks{};

  mutable std::mutex mutex;  // guards everything below, and changes of `receiver`
  std::optional<LiveOptions> pending;
  bool clearAsked = false;
  std::vector<RobotKey> forgetAsked;
  AttachedRobots boards{[clock = clock] { return clock->seconds(clock->now()); }};
  LiveBooks books;
  TeamMonitor& monitor = books.monitor;
  telemetry::RefereeTracker& referee = books.referee;
  LiveEvents happened;
  Teams teams = books.teams(options);
  std::uint64_t serial = 0, unknownReferee = 0, refusedReferees = 0;
  std::string networkProblem, unknownReason, unknownSample, monitorProblem;
  LiveNews news;
  bool announced = false;
  std::vector<std::shared_ptr<LiveObserver>> observers;
  std::jthread thread;  // last: it uses all of the above
};

LiveWatch::LiveWatch(LiveOptions options, std::function<void()> onFrame,
                     telemetry::ClockSource clock)
    : m_impl(std::make_unique<Impl>(std::move(options), std::move(onFrame), std::move(clock))) {
  Impl* impl = m_impl.get();
  impl->thread = std::jthread([impl](const std::stop_token& stop) { impl->run(stop); });
}

LiveWatch::~LiveWatch() {
  m_impl->thread.request_stop();
  m_impl->thread.join();
}

void LiveWatch::setOptions(LiveOptions options) {
  const std::lock_guard lock(m_impl->mutex);
  m_impl->pending = std::move(options);
}

void LiveWatch::clear() {
  const std::lock_guard lock(m_impl->mutex);
  m_impl->clearAsked = true;
}

void LiveWatch::forget(const RobotKey& robot) {
  const std::lock_guard lock(m_impl->mutex);
  m_impl->forgetAsked.push_back(robot);
}

LiveNews LiveWatch::take() {
  const std::lock_guard lock(m_impl->mutex);
  m_impl->announced = false;
  return std::exchange(m_impl->news, {{}, {}, m_impl->news.frame});
}

LiveDetails LiveWatch::details() const {
  LiveDetails details;
  const std::lock_guard lock(m_impl->mutex);
  details.team = m_impl->monitor.status(m_impl->clock->now());
  if (m_impl->receiver) details.network = m_impl->receiver->status();
  details.networkProblem = m_impl->networkProblem;
  details.referee = m_impl->books.referee.counts();
  details.unknownReferee = m_impl->unknownReferee;
  details.unknownRefereeReason = m_impl->unknownReason;
  details.unknownRefereeSample = m_impl->unknownSample;
  details.boards = m_impl->boards.status();
  details.refusedReferees = m_impl->refusedReferees;
  details.monitorProblem = m_impl->monitorProblem;
  return details;
}

telemetry::WallTime LiveWatch::began() const {
  return m_impl->clock->began();
}

void LiveWatch::observe(std::shared_ptr<LiveObserver> observer) {
  const std::lock_guard lock(m_impl->mutex);
  const double now = m_impl->clock->seconds(m_impl->clock->now());
  observer->remembered(now, m_impl->books.text(m_impl->options, now, m_impl->clock->began()));
  observer->adopted(m_impl->options, m_impl->teams, {});
  m_impl->observers.push_back(std::move(observer));
}

void LiveWatch::stopObserving(const std::shared_ptr<LiveObserver>& observer) {
  const std::lock_guard lock(m_impl->mutex);
  std::erase(m_impl->observers, observer);
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_watch.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include <base/try.h>
#include <robotlink/live/live_pipeline.h>
#include <robotlink/models/robot_models.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;
using telemetry::DatagramBatch;

constexpr auto framePeriod = 16ms;  // at most so often while something arrives
constexpr auto idlePeriod = 100ms;  // ages and timeouts have to advance without messages
constexpr auto portsPeriod = 500ms;
constexpr std::size_t flood = 16;  // datagrams in one go from which on it pays to gather

telemetry::ReceiverOptions receiverOptions(
    const LiveOptions& options, const std::shared_ptr<const telemetry::LiveClock>& clock) {
  telemetry::ReceiverOptions made;
  made.bind = options.bind;
  made.clock = clock;
  made.ports = portsOf(options).value_or(std::vector<std::uint16_t>{});
  return made;
}

}  // namespace

Result<std::vector<std::uint16_t>> portsOf(const LiveOptions& options) {
  auto ports = TRY(telemetry::teamPorts(options.team.teams, options.portBase, options.robots,
                                        options.refereePort));
  if (options.monitor) ports.push_back(telemetry::robotStatesPort);
  if (options.variablesPortBase == 0) return ports;
  for (int port = options.variablesPortBase + 1; port <= options.variablesPortBase + options.robots;
       ++port) {
    if (port < 1 || port > 65535) {
      return failure(ErrorCode::InvalidArgument,
                     "Robots' variables need the UDP ports " +
                         std::to_string(options.variablesPortBase + 1) + " to " +
                         std::to_string(options.variablesPortBase + options.robots) +
                         "; choose a base from 1 to " + std::to_string(65535 - options.robots) +
                         ", or 0 for none.");
    }
    const auto number = static_cast<std::uint16_t>(port);
    if (std::ranges::find(ports, number) != ports.end()) {
      return failure(ErrorCode::InvalidArgument,
                     "UDP " + std::to_string(port) +
                         " cannot be both a port of robots' variables and of messages; choose "
                         "another base.");
    }
    ports.push_back(number);
  }
  return ports;
}

Result<void> validate(const LiveOptions& options) {
  TRY(portsOf(options));
  for (const std::string& file : options.catalogs) TRY(VariableCatalog::fromFile(file));
  TRY(telemetry::validate(options.profile));
  for (const telemetry::TeamSetup& team : options.team.teams) {
    if (team.model.empty()) continue;
    if (auto model = loadRobotModel(team.model); !model) {
      Error error = model.error();
      error.context = team.title() + ", model";
      return tl::unexpected(std::move(error));
    }
  }
  TRY(validate(options.boards));
  return sim::validate(options.field);
}

struct LiveWatch::Impl {
  Impl(LiveOptions o, std::function<void()> ready, telemetry::ClockSource source)
      : clock(std::make_shared<const telemetry::LiveClock>(std::move(source))),
        onFrame(std::move(ready)),
        pipeline(std::move(o), clock->began()) {
    boards.set(options.boards);
  }

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
    const LiveOptions old = options;
    pipeline.setOptions(std::move(*pending), clock->now());
    pending.reset();
    boards.set(options.boards);
    monitorProblem.clear();
    const auto before = receiverOptions(old, clock), after = receiverOptions(options, clock);
    if (before.ports == after.ports && before.bind == after.bind && receiver) return;
    lock.unlock();
    listen();
  }

  void forget() {
    const std::lock_guard lock(mutex);
    for (const RobotKey& robot : std::exchange(forgetAsked, {})) {
      pipeline.forget(robot, clock->now());
    }
    if (std::exchange(clearAsked, false)) pipeline.clear(clock->now());
  }

  void takeAll(const DatagramBatch& batch) {
    const std::lock_guard lock(mutex);
    for (std::size_t i = 0; i < batch.size(); ++i) pipeline.take(batch[i]);
  }

  /// The mutex is held.
  void makeFrame() {
    newest = std::make_shared<const MatchFrame>(pipeline.frame(clock->now(), &boards));
    pipeline.noticeClock(clock->setBy(), newest->snapshot.time);
  }

  void makeNextFrame(Steady::time_point now) {
    const std::lock_guard lock(mutex);
    makeFrame();
    if (receiver && now >= nextPorts) {
      nextPorts = now + portsPeriod;
      pipeline.noticePorts(receiver->status(), newest->snapshot.time);
    }
    if (!std::exchange(announced, true) && onFrame) onFrame();
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
      makeNextFrame(now);
    }
  }

  const std::shared_ptr<const telemetry::LiveClock> clock;
  const std::function<void()> onFrame;
  std::unique_ptr<telemetry::UdpReceiver> receiver;
  Steady::time_point nextRequest{}, nextPorts{};

  mutable std::mutex mutex;  // guards everything below, and changes of `receiver`
  LivePipeline pipeline;
  const LiveOptions& options = pipeline.options();  // changed by the thread only
  std::optional<LiveOptions> pending;
  bool clearAsked = false;
  std::vector<RobotKey> forgetAsked;
  AttachedRobots boards{[clock = clock] { return clock->seconds(clock->now()); }};
  std::string networkProblem, monitorProblem;
  std::shared_ptr<const MatchFrame> newest;
  bool announced = false;
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
  LiveNews news = m_impl->pipeline.takeNews();
  news.frame = m_impl->newest;
  return news;
}

LiveDetails LiveWatch::details() const {
  const std::lock_guard lock(m_impl->mutex);
  LiveDetails details = m_impl->pipeline.details(m_impl->clock->now());
  if (m_impl->receiver) details.network = m_impl->receiver->status();
  details.networkProblem = m_impl->networkProblem;
  details.boards = m_impl->boards.status();
  details.monitorProblem = m_impl->monitorProblem;
  return details;
}

telemetry::WallTime LiveWatch::began() const {
  return m_impl->clock->began();
}

void LiveWatch::observe(std::shared_ptr<LiveObserver> observer) {
  const std::lock_guard lock(m_impl->mutex);
  m_impl->pipeline.observe(std::move(observer), m_impl->clock->now());
}

void LiveWatch::stopObserving(const std::shared_ptr<LiveObserver>& observer) {
  const std::lock_guard lock(m_impl->mutex);
  // Rows of variables wait for the next frame; those that have come belong to the observer.
  m_impl->makeFrame();
  m_impl->pipeline.stopObserving(observer);
}

}  // namespace pitchboard::link

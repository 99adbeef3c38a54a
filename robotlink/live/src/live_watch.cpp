// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_watch.h>

#include <algorithm>
#include <condition_variable>
#include <latch>
#include <mutex>
#include <thread>
#include <utility>

#include <robotlink/live/live_pipeline.h>
#include <telemetry/foxglove/foxglove_client.h>

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
  made.yieldsToFirst = true;
  made.clock = clock;
  made.ports = portsOf(options).value_or(std::vector<std::uint16_t>{});
  return made;
}

}  // namespace

/// The thread owns the pipeline. What others want of it are requests, and what it tells them is
/// published after each frame; the mutex is held for neither.
struct LiveWatch::Impl {
  Impl(LiveOptions o, std::function<void()> ready, telemetry::ClockSource source)
      : clock(std::make_shared<const telemetry::LiveClock>(std::move(source))),
        onFrame(std::move(ready)),
        pipeline(std::move(o), clock->began()) {
    boards.set(options.boards);
  }

  // Any thread.
  void request(std::function<void()> work) {
    {
      const std::lock_guard lock(mutex);
      requests.push_back(std::move(work));
    }
    come.notify_one();
  }

  // What follows is called on the thread only.
  void noteArrival() {
    {
      const std::lock_guard lock(mutex);
      arrived = true;
    }
    come.notify_one();
  }

  void listen() {
    receiver.reset();  // its ports may be wanted again
    auto started =
        telemetry::UdpReceiver::start(receiverOptions(options, clock), [this] { noteArrival(); });
    networkProblem = started ? std::string() : started.error().text();
    if (started) receiver = std::move(*started);
  }

  /// One client for each program with topics.
  struct TopicClient {
    FoxgloveSource source;
    std::unique_ptr<telemetry::FoxgloveClient> client;
  };

  void connectClients() {
    std::erase_if(clients, [this](const TopicClient& known) {
      return std::ranges::find(options.foxglove, known.source) == options.foxglove.end();
    });
    for (const FoxgloveSource& source : options.foxglove) {
      if (std::ranges::find(clients, source, &TopicClient::source) != clients.end()) continue;
      clients.push_back({source, std::make_unique<telemetry::FoxgloveClient>(
                                     source.address, [clock = clock] { return clock->now(); },
                                     [this] { noteArrival(); })});
    }
  }

  /// Returns how much has come.
  std::size_t takeTopics() {
    std::size_t count = 0;
    for (const TopicClient& one : clients) {
      const std::vector<telemetry::FoxgloveEvent> events = one.client->take();
      count += events.size();
      for (const telemetry::FoxgloveEvent& event : events) {
        TopicRequest request = pipeline.take(one.source, event);
        if (request.channels.empty()) continue;
        one.client->subscribe(request.session, std::move(request.channels));
      }
    }
    return count;
  }

  void setOptions(LiveOptions changed) {
    const auto before = receiverOptions(options, clock);
    pipeline.setOptions(std::move(changed), clock->now());
    boards.set(options.boards);
    connectClients();
    monitorProblem.clear();
    const auto after = receiverOptions(options, clock);
    if (before.ports != after.ports || before.bind != after.bind || !receiver) {
      batch.clear();  // of ports that may mean something else now
      listen();
    }
  }

  void runRequests() {
    std::vector<std::function<void()>> all;
    {
      const std::lock_guard lock(mutex);
      all = std::exchange(requests, {});
    }
    for (const auto& one : all) one();
  }

  void wait(telemetry::Duration most) {
    std::unique_lock lock(mutex);
    come.wait_for(lock, most, [this] { return arrived || isEnding || !requests.empty(); });
    arrived = false;
  }

  void takeAll() {
    for (std::size_t i = 0; i < batch.size(); ++i) pipeline.take(batch[i]);
    batch.clear();
  }

  void makeFrame() {
    for (const TopicClient& one : clients) pipeline.note(one.source, one.client->status());
    auto frame = std::make_shared<const MatchFrame>(pipeline.advance(clock->now(), &boards));
    pipeline.noticeClock(clock->setBy(), frame->snapshot.time);
    const auto now = Steady::now();
    if (receiver && now >= nextPorts) {
      nextPorts = now + portsPeriod;
      pipeline.noticePorts(receiver->status(), frame->snapshot.time);
    }
    publish(std::move(frame));
  }

  void publish(std::shared_ptr<const MatchFrame> frame) {
    auto all = std::make_shared<LiveDetails>(pipeline.details(clock->now()));
    if (receiver) all->network = receiver->status();
    all->sharedPorts = pipeline.sharedPorts(all->network);
    all->networkProblem = networkProblem;
    all->boards = boards.status();
    all->monitorProblem = monitorProblem;
    LiveNews made = pipeline.drainNews();
    {
      const std::lock_guard lock(mutex);
      details = std::move(all);
      news.add(std::move(made.events));
      news.add(std::move(made.lines));
      if (frame) news.frame = std::move(frame);
      if (!news.frame || std::exchange(announced, true)) return;
    }
    if (onFrame) onFrame();
  }

  /// Only this sends, only to the referee, only while it is turned on.
  void askReferee(Steady::time_point now) {
    if (!options.monitor || now < nextRequest) return;
    nextRequest = now + 1s;
    const auto sent = telemetry::sendMonitorRequest(*options.monitor, options.monitorPort);
    monitorProblem = sent ? std::string() : sent.error().text();
  }

  void run(const std::stop_token& stop) {
    listen();
    connectClients();
    publish(nullptr);
    auto last = Steady::now() - idlePeriod;
    bool fresh = true;
    while (!stop.stop_requested()) {
      wait(std::max<telemetry::Duration>(last + (fresh ? framePeriod : idlePeriod) - Steady::now(),
                                         0ns));
      // The batch first: an observer that was added before a datagram was sent is told of it.
      if (receiver) receiver->take(batch);
      runRequests();
      const std::size_t events = takeTopics();
      if (batch.size() + events > 0) {
        fresh = true;
        const bool many = batch.size() + events >= flood;
        takeAll();
        // In a flood every datagram would wake this thread; a millisecond gathers many.
        if (many) std::this_thread::sleep_for(1ms);
      }
      const auto now = Steady::now();
      askReferee(now);
      if (now < last + (fresh ? framePeriod : idlePeriod)) continue;
      last = now;
      fresh = false;
      makeFrame();
    }
  }

  const std::shared_ptr<const telemetry::LiveClock> clock;
  const std::function<void()> onFrame;
  LivePipeline pipeline;
  const LiveOptions& options = pipeline.options();
  DatagramBatch batch;
  AttachedRobots boards{[clock = clock] { return clock->seconds(clock->now()); }};
  std::string networkProblem, monitorProblem;
  Steady::time_point nextRequest{}, nextPorts{};

  mutable std::mutex mutex;  // guards what follows, up to the receiver
  std::condition_variable come;
  std::vector<std::function<void()>> requests;
  bool arrived = false, isEnding = false;
  LiveNews news;
  bool announced = false;
  std::shared_ptr<const LiveDetails> details = std::make_shared<LiveDetails>();

  std::unique_ptr<telemetry::UdpReceiver> receiver;  // its thread uses the above
  std::vector<TopicClient> clients;                  // theirs, too
  std::jthread thread;                               // last: it uses all of the above
};

LiveWatch::LiveWatch(LiveOptions options, std::function<void()> onFrame,
                     telemetry::ClockSource clock)
    : m_impl(std::make_unique<Impl>(std::move(options), std::move(onFrame), std::move(clock))) {
  Impl* impl = m_impl.get();
  impl->thread = std::jthread([impl](const std::stop_token& stop) { impl->run(stop); });
}

LiveWatch::~LiveWatch() {
  m_impl->thread.request_stop();
  {
    const std::lock_guard lock(m_impl->mutex);
    m_impl->isEnding = true;
  }
  m_impl->come.notify_one();
  m_impl->thread.join();
}

void LiveWatch::setOptions(LiveOptions options) {
  m_impl->request([impl = m_impl.get(), options = std::move(options)]() mutable {
    impl->setOptions(std::move(options));
  });
}

void LiveWatch::clear() {
  m_impl->request([impl = m_impl.get()] { impl->pipeline.clear(impl->clock->now()); });
}

void LiveWatch::forget(RobotUid robot) {
  m_impl->request(
      [impl = m_impl.get(), robot] { impl->pipeline.forget(robot, impl->clock->now()); });
}

LiveNews LiveWatch::take() {
  const std::lock_guard lock(m_impl->mutex);
  m_impl->announced = false;
  LiveNews news = std::exchange(m_impl->news, {});
  m_impl->news.frame = news.frame;
  return news;
}

LiveDetails LiveWatch::details() const {
  std::unique_lock lock(m_impl->mutex);
  const std::shared_ptr<const LiveDetails> details = m_impl->details;
  lock.unlock();
  return *details;
}

telemetry::WallTime LiveWatch::began() const {
  return m_impl->clock->began();
}

void LiveWatch::observe(std::shared_ptr<LiveObserver> observer) {
  m_impl->request([impl = m_impl.get(), observer = std::move(observer)] {
    impl->pipeline.observe(observer, impl->clock->now());
  });
}

void LiveWatch::stopObserving(const std::shared_ptr<LiveObserver>& observer) {
  std::latch done(1);
  m_impl->request([impl = m_impl.get(), &observer, &done] {
    // What has come belongs to the observer; rows of variables wait for the next frame.
    impl->takeAll();
    impl->takeTopics();
    impl->makeFrame();
    impl->pipeline.stopObserving(observer);
    done.count_down();
  });
  done.wait();
}

}  // namespace pitchboard::link

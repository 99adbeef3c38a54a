// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/match_runner.h>

#include <poll.h>
#include <sys/eventfd.h>
#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <future>
#include <iterator>
#include <mutex>
#include <stop_token>
#include <utility>

#include <base/unique_fd.h>
#include <robotlink/match/match_drawings.h>
#include <robotlink/match/match_player.h>

#include "frame_builder.h"

namespace pitchboard::link {

/// What the thread and the callers share.
struct MatchRunner::Shared {
  static constexpr std::size_t maxQueued = 10'000;

  Shared() : wakeUp(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}
  /// The thread looks at what has changed.
  void wake() const { ::eventfd_write(wakeUp.get(), 1); }
  /// Somebody has to be told of something new; needs the lock. Call what it returns without it.
  std::function<void()> news() { return std::exchange(notified, true) ? nullptr : notify; }

  UniqueFd wakeUp;
  mutable std::mutex mutex;                      // guards everything below
  mutable std::condition_variable_any stillNow;  // for waitUntilStill()
  std::deque<Command> commands;
  bool paused = false;
  int singleSteps = 0;
  bool paceChanged = true;
  bool settled = false;  // stands still, and the latest frame shows it
  double speed = 1.0;
  std::optional<std::uint64_t> runTo;
  struct Skip {
    std::function<bool(const MatchEvent&)> wanted;
    std::uint64_t maxTicks = 0;
    std::uint64_t serial = 0;
  };
  std::optional<Skip> skip;
  std::uint64_t skips = 0;
  std::shared_ptr<const MatchFrame> latest;
  std::deque<MatchEvent> events;
  std::deque<LogLine> log;
  std::uint64_t droppedEvents = 0;
  std::uint64_t droppedLogLines = 0;
  std::function<void()> notify;
  bool notified = false;  // the notification was sent, and nothing was taken since

  MatchPlayer* player = nullptr;  // for commands, which run on its thread
};

namespace {

using namespace std::chrono_literals;

constexpr auto frameInterval = 8ms;
constexpr auto pollInterval = 50ms;
// A match that stands still tells by itself what happens to it, but for what others write to its
// blackboards and draw.
constexpr auto stillInterval = 250ms;
constexpr auto settling = 1s;  // until nothing more is expected of its processes

template <class T>
void pushBounded(std::deque<T>& queue, T value, std::uint64_t& dropped) {
  queue.push_back(std::move(value));
  if (queue.size() > MatchRunner::Shared::maxQueued) {
    queue.pop_front();
    ++dropped;
  }
}

/// Far above what any machine reaches; also keeps the pacer's arithmetic finite.
double limitedSpeed(double timesRealTime) {
  const bool limited = timesRealTime > 0.0 && timesRealTime < 1e6;
  return limited ? timesRealTime : MatchRunner::unlimitedSpeed;
}

/// Frames that are no longer used are filled again, so that playing allocates next to
/// nothing.
class FramePool : public std::enable_shared_from_this<FramePool> {
 public:
  std::shared_ptr<MatchFrame> take();

 private:
  static constexpr std::size_t maxKept = 8;
  void giveBack(std::unique_ptr<MatchFrame> frame);
  std::mutex m_mutex;
  std::vector<std::unique_ptr<MatchFrame>> m_free;
};

std::shared_ptr<MatchFrame> FramePool::take() {
  std::unique_ptr<MatchFrame> frame;
  {
    const std::lock_guard lock(m_mutex);
    if (!m_free.empty()) {
      frame = std::move(m_free.back());
      m_free.pop_back();
    }
  }
  if (!frame) frame = std::make_unique<MatchFrame>();
  return {frame.release(), [pool = weak_from_this()](MatchFrame* used) {
            std::unique_ptr<MatchFrame> owned(used);
            if (const auto alive = pool.lock()) alive->giveBack(std::move(owned));
          }};
}

void FramePool::giveBack(std::unique_ptr<MatchFrame> frame) {
  const std::lock_guard lock(m_mutex);
  if (m_free.size() < maxKept) m_free.push_back(std::move(frame));
}

/// What happened, and what processes wrote, since it was asked last.
class NewEvents : public TickObserver {
 public:
  void ticked(const SimulatedMatch& /*match*/, std::chrono::nanoseconds /*tickTime*/) override {}
  void happened(std::span<const MatchEvent> events) override {
    list.insert(list.end(), events.begin(), events.end());
  }
  void drew(std::span<const ReceivedDrawing> /*drawings*/) override { drawn = true; }
  void logged(const LogLine& line) override { lines.push_back(line); }
  bool drawn = false;
  std::vector<MatchEvent> list;
  std::vector<LogLine> lines;
};

/// What runs on the thread.
class MatchLoop {
 public:
  MatchLoop(MatchRunner::Shared& shared, SimulatedMatch match);
  /// Until stopped.
  void run(const std::stop_token& stop);
  void publish();

 private:
  using Clock = std::chrono::steady_clock;

  bool carryOutCommands();
  /// Plays what is due; says when to look again.
  Clock::time_point play(Clock::time_point now);
  MatchPlayer::Played playUntil(const MatchRunner::Shared::Skip& skip, Clock::time_point now);
  void collectEvents();
  bool isShared() const;
  bool startsProcesses() const;
  bool showsOther();
  void waitUntil(Clock::time_point wake);

  MatchRunner::Shared& m_shared;
  MatchPlayer m_player;
  SimulatedMatch& m_match;  // the player's
  FrameBuilder m_builder;
  std::shared_ptr<FramePool> m_pool = std::make_shared<FramePool>();
  const std::shared_ptr<NewEvents> m_newEvents = std::make_shared<NewEvents>();
  Clock::time_point m_lastPublish;
  Clock::time_point m_nextPoll;
  Clock::time_point m_lastChange;  // by an order
  std::uint64_t m_processVersion = 0;
  std::string m_drawingProblem;
  std::vector<std::array<std::uint32_t, Blackboard::words>> m_boards;
  std::uint64_t m_serial = 0;
  std::uint64_t m_skip = 0, m_skipUntil = 0;  // the running skip, and its last tick
  bool m_still = false;
  bool m_publishWanted = false;
};

MatchLoop::MatchLoop(MatchRunner::Shared& shared, SimulatedMatch match)
    : m_shared(shared), m_player(std::move(match)), m_match(m_player.match()) {
  m_shared.player = &m_player;
  m_player.observe(m_newEvents);
  m_builder.resetSpeed(Clock::now(), m_match.simulation().state().tick);
}

void MatchLoop::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    bool publishNow = carryOutCommands();
    auto now = Clock::now();
    if (publishNow) m_lastChange = now;
    if (now >= m_nextPoll) {
      m_player.lookAfterProcesses(now);
      collectEvents();
      const bool shared = m_still && isShared();
      const bool other = shared && showsOther();
      const bool settles = shared && (now - m_lastChange < settling || startsProcesses());
      m_nextPoll = now + (m_still && !settles ? stillInterval : pollInterval);
      publishNow = publishNow || other || settles;
    }
    const auto wake = play(now);
    if (std::exchange(m_publishWanted, false)) {
      publishNow = true;
      m_lastChange = now;
      m_nextPoll = std::min(m_nextPoll, now + pollInterval);
    }
    now = Clock::now();
    if (publishNow || (!m_still && now - m_lastPublish >= frameInterval)) publish();
    waitUntil(wake);
  }
}

/// Waits until `wake`, until a command arrives, or, in a paused match, until a process has ended or
/// written something.
void MatchLoop::waitUntil(Clock::time_point wake) {
  using namespace std::chrono;
  // No descriptor was left in this process: look now and then.
  if (!m_shared.wakeUp) wake = std::min(wake, Clock::now() + pollInterval);
  const auto rest = duration_cast<nanoseconds>(wake - Clock::now());
  const auto whole = duration_cast<seconds>(rest);
  timespec time{};
  time.tv_sec = std::max<std::int64_t>(whole.count(), 0);
  time.tv_nsec = std::max<std::int64_t>((rest - whole).count(), 0);
  pollfd waited[] = {{m_shared.wakeUp.get(), POLLIN, 0},
                     {m_match.robots().processes().descriptor(), POLLIN, 0}};
  ::ppoll(waited, m_still ? 2 : 1, wake == Clock::time_point::max() ? nullptr : &time, nullptr);
  eventfd_t count = 0;
  if (waited[0].revents != 0) ::eventfd_read(m_shared.wakeUp.get(), &count);
  if (waited[1].revents != 0) m_nextPoll = {};
}

/// With other processes: its own, or those that read its blackboards.
bool MatchLoop::isShared() const {
  if (!m_match.robots().processes().isEmpty()) return true;
  const auto& robots = m_match.simulation().state().robots;
  return std::any_of(robots.begin(), robots.end(), [this](const sim::RobotIdentity& robot) {
    const Blackboard* board = m_match.blackboard(robot.id);
    return board && board->key() != 0;
  });
}

bool MatchLoop::startsProcesses() const {
  return std::ranges::any_of(m_match.robots().processes().statuses(), [](const auto& one) {
    return one.state == ProcessState::Waiting || one.state == ProcessState::Restarting;
  });
}

/// Whether anything that is seen of a match that stands still is not as at the last look.
bool MatchLoop::showsOther() {
  const std::uint64_t version = m_match.robots().processes().version();
  bool other = std::exchange(m_processVersion, version) != version;
  other = std::exchange(m_newEvents->drawn, false) || other;
  if (const MatchDrawings* drawings = m_match.drawings();
      drawings && drawings->problem() != m_drawingProblem) {
    m_drawingProblem = drawings->problem();
    other = true;
  }
  const auto& robots = m_match.simulation().state().robots;
  m_boards.resize(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Blackboard* board = m_match.blackboard(robots[i].id);
    if (board == nullptr || board->key() == 0) continue;
    std::array<std::uint32_t, Blackboard::words> words;
    board->copyWords(words);
    if (words == m_boards[i]) continue;
    m_boards[i] = words;
    other = true;
  }
  return other;
}

bool MatchLoop::carryOutCommands() {
  std::deque<MatchRunner::Command> commands;
  {
    const std::lock_guard lock(m_shared.mutex);
    commands.swap(m_shared.commands);
  }
  if (commands.empty()) return false;
  bool changed = false;
  for (const auto& command : commands) changed = command(m_match) == Changed::Yes || changed;
  if (changed) m_player.worldChanged();
  m_player.reportEvents();
  // Otherwise the next tick shows what they did.
  if (m_still) m_player.showMoment();
  return true;
}

MatchLoop::Clock::time_point MatchLoop::play(Clock::time_point now) {
  const std::uint64_t tick = m_match.simulation().state().tick;
  std::unique_lock lock(m_shared.mutex);
  const bool finished = m_match.finished();
  const int singleSteps = m_shared.singleSteps;
  if (m_shared.runTo && (tick >= *m_shared.runTo || finished)) {
    m_shared.runTo.reset();
    m_shared.paused = true;
  }
  const std::optional<std::uint64_t> runTo = m_shared.runTo;
  if (finished) m_shared.skip.reset();
  const std::optional<MatchRunner::Shared::Skip> skip = m_shared.skip;
  const double speed = runTo || skip ? MatchRunner::unlimitedSpeed : m_shared.speed;
  const bool still = finished || (m_shared.paused && !runTo && !skip);
  if (std::exchange(m_shared.paceChanged, false) || still != m_still) {
    m_player.setSpeed(speed, now);
    m_match.pace().setPlaying(speed, still, now);
    m_builder.resetSpeed(now, tick);
    m_publishWanted = true;
  }
  m_still = still;
  lock.unlock();

  if (singleSteps > 0) {
    const std::chrono::duration<double> tickTime(1.0 /
                                                 m_match.simulation().state().settings.tickRate);
    for (int i = 0; i < singleSteps && !m_match.finished(); ++i) {
      m_player.tick();
      m_match.pace().letTeamProgramsRun(tickTime);
    }
    lock.lock();
    m_shared.singleSteps -= singleSteps;
    lock.unlock();
    m_publishWanted = true;
  }
  if (still) {
    return isShared() ? m_nextPoll : Clock::time_point::max();
  }
  const MatchPlayer::Played played =
      skip ? playUntil(*skip, now) : m_player.play(now, runTo.value_or(MatchPlayer::noLastTick));
  m_builder.addBusy(played.busy, played.ticks);
  collectEvents();
  return played.next;
}

// Tick by tick, so that the match stands at what was looked for.
MatchPlayer::Played MatchLoop::playUntil(const MatchRunner::Shared::Skip& skip,
                                         Clock::time_point now) {
  if (std::exchange(m_skip, skip.serial) != skip.serial) {
    collectEvents();  // what has happened before is not what is looked for
    m_skipUntil = m_player.currentTick() + skip.maxTicks;
  }
  MatchPlayer::Played all{0, {}, now};
  while (Clock::now() - now < frameInterval) {
    const MatchPlayer::Played played = m_player.play(now, m_player.currentTick() + 1);
    all.ticks += played.ticks;
    all.busy += played.busy;
    all.next = played.next;
    m_player.reportEvents();
    const bool found = std::ranges::any_of(m_newEvents->list, skip.wanted);
    const bool over = found || m_player.currentTick() >= m_skipUntil || m_match.finished();
    collectEvents();
    if (over) {
      const std::lock_guard lock(m_shared.mutex);
      if (!m_shared.skip || m_shared.skip->serial != skip.serial) break;
      m_shared.skip.reset();
      m_shared.paceChanged = true;
      m_publishWanted = true;
      break;
    }
    if (played.ticks == 0) break;
  }
  return all;
}

void MatchLoop::collectEvents() {
  m_player.reportEvents();
  if (m_newEvents->list.empty() && m_newEvents->lines.empty()) return;
  std::unique_lock lock(m_shared.mutex);
  for (MatchEvent& event : m_newEvents->list) {
    pushBounded(m_shared.events, std::move(event), m_shared.droppedEvents);
  }
  for (LogLine& line : m_newEvents->lines) {
    pushBounded(m_shared.log, std::move(line), m_shared.droppedLogLines);
  }
  const auto notify = m_shared.news();
  lock.unlock();
  if (notify) notify();
  m_newEvents->list.clear();
  m_newEvents->lines.clear();
}

void MatchLoop::publish() {
  collectEvents();
  const auto now = Clock::now();
  m_lastPublish = now;
  const auto frame = m_pool->take();
  m_builder.fill(m_match, now, m_still, *frame);
  frame->serial = ++m_serial;
  std::shared_ptr<const MatchFrame> replaced = frame;
  std::function<void()> notify;
  {
    const std::lock_guard lock(m_shared.mutex);
    frame->paused = m_shared.paused && !m_shared.runTo && !m_shared.skip;
    frame->droppedEvents = m_shared.droppedEvents;
    frame->droppedLogLines = m_shared.droppedLogLines;
    replaced.swap(m_shared.latest);
    m_shared.settled = m_still && !m_shared.paceChanged && m_shared.singleSteps == 0;
    notify = m_shared.news();
  }
  if (notify) notify();
  if (m_still) m_shared.stillNow.notify_all();
}

}  // namespace

Result<std::unique_ptr<MatchRunner>> MatchRunner::start(
    const Scenario& scenario, const MatchOptions& options, bool paused,
    const VariableCatalog& catalog, std::vector<std::shared_ptr<TickObserver>> observers) {
  auto shared = std::make_shared<Shared>();
  shared->paused = paused;
  shared->speed = limitedSpeed(options.speed);
  std::unique_ptr<MatchRunner> runner(new MatchRunner(shared));
  std::promise<Result<void>> made;
  auto outcome = made.get_future();
  // `scenario` and `options` are only used before the promise is kept, while this call waits.
  runner->m_thread =
      std::jthread([&scenario, &options, &catalog, shared, observers = std::move(observers),
                    promise = std::move(made)](const std::stop_token& stop) mutable {
        auto match = SimulatedMatch::create(scenario, options, catalog);
        if (!match) {
          promise.set_value(tl::unexpected(match.error()));
          return;
        }
        MatchLoop loop(*shared, std::move(*match));
        for (auto& observer : observers) shared->player->observe(std::move(observer));
        loop.publish();
        promise.set_value({});
        loop.run(stop);
      });
  if (auto started = outcome.get(); !started) return tl::unexpected(started.error());
  return runner;
}

MatchRunner::MatchRunner(std::shared_ptr<Shared> shared) : m_shared(std::move(shared)) {}

MatchRunner::~MatchRunner() {
  m_thread.request_stop();
  m_shared->wake();
  if (m_thread.joinable()) m_thread.join();
  // Commands that were not carried out: releases callers that wait in execute().
  const std::lock_guard lock(m_shared->mutex);
  m_shared->commands.clear();
}

void MatchRunner::setPaused(bool paused) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->paused = paused;
  m_shared->runTo.reset();
  m_shared->skip.reset();
  m_shared->paceChanged = true;
  m_shared->settled = false;
  m_shared->wake();
}

void MatchRunner::stepOnce() {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->paused = true;
  m_shared->runTo.reset();
  m_shared->skip.reset();
  ++m_shared->singleSteps;
  m_shared->settled = false;
  m_shared->wake();
}

void MatchRunner::setSpeed(double timesRealTime) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->speed = limitedSpeed(timesRealTime);
  m_shared->paceChanged = true;
  m_shared->settled = false;
  m_shared->wake();
}

void MatchRunner::runTo(std::uint64_t tick) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->runTo = tick;
  m_shared->skip.reset();
  m_shared->paceChanged = true;
  m_shared->settled = false;
  m_shared->wake();
}

void MatchRunner::skip(std::function<bool(const MatchEvent&)> wanted, std::uint64_t maxTicks) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->skip = Shared::Skip{std::move(wanted), maxTicks, ++m_shared->skips};
  m_shared->runTo.reset();
  m_shared->paceChanged = true;
  m_shared->settled = false;
  m_shared->wake();
}

bool MatchRunner::waitUntilStill(std::chrono::milliseconds timeout) const {
  std::unique_lock lock(m_shared->mutex);
  return m_shared->stillNow.wait_for(lock, timeout, [this] { return m_shared->settled; });
}

void MatchRunner::post(Command command) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->commands.push_back(std::move(command));
  m_shared->wake();
}

void MatchRunner::execute(const Command& command) {
  // Broken, and so no longer waited for, when the runner ends first.
  auto done = std::make_shared<std::promise<void>>();
  const auto waited = done->get_future();
  post([&command, done = std::move(done)](SimulatedMatch& match) {
    const Changed changed = command(match);
    done->set_value();
    return changed;
  });
  waited.wait();
}

void MatchRunner::read(const std::function<void(const SimulatedMatch&)>& look) {
  execute([&look](SimulatedMatch& match) {
    look(match);
    return Changed::No;
  });
}

void MatchRunner::observe(const std::shared_ptr<TickObserver>& observer) {
  read([this, &observer](const SimulatedMatch&) { m_shared->player->observe(observer); });
}

void MatchRunner::stopObserving(const std::shared_ptr<TickObserver>& observer) {
  read([this, &observer](const SimulatedMatch&) { m_shared->player->stopObserving(observer); });
}

void MatchRunner::setNews(std::function<void()> notify) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->notify = std::move(notify);
  m_shared->notified = false;
}

std::shared_ptr<const MatchFrame> MatchRunner::latest(std::uint64_t knownSerial) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->notified = false;
  const auto& frame = m_shared->latest;
  return frame && frame->serial != knownSerial ? frame : nullptr;
}

std::vector<MatchEvent> MatchRunner::drainEvents() {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->notified = false;
  std::vector<MatchEvent> events(std::make_move_iterator(m_shared->events.begin()),
                                 std::make_move_iterator(m_shared->events.end()));
  m_shared->events.clear();
  return events;
}

std::vector<LogLine> MatchRunner::drainLog() {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->notified = false;
  std::vector<LogLine> log(std::make_move_iterator(m_shared->log.begin()),
                           std::make_move_iterator(m_shared->log.end()));
  m_shared->log.clear();
  return log;
}

}  // namespace pitchboard::link

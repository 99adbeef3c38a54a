// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/board_sampler.h>

#include <time.h>

#include <algorithm>
#include <cmath>

#include <base/lined_json.h>
#include <base/try.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using SteadyClock =
    std::chrono::steady_clock;  // CLOCK_MONOTONIC in the standard libraries of Linux

constexpr auto longestSleep = 50ms;   // so that stopping takes no longer
constexpr auto lookInterval = 100ms;  // is the segment still the one of this key?
constexpr auto rateWindow = 1s;

void sleepUntil(SteadyClock::time_point until) {
  const auto since = until.time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
  timespec at{};
  at.tv_sec = static_cast<time_t>(seconds.count());
  at.tv_nsec = static_cast<long>(std::chrono::nanoseconds(since - seconds).count());
  // An interrupted sleep is taken up by the caller's loop.
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
}

}  // namespace

struct BoardSampler::Attached {
  Blackboard board;
  int shmid = 0;
};

Result<BoardSampler::Attached> BoardSampler::attach(int key) {
  auto board = TRY(SystemVSegments::open(key, AttachMode::ReadOnly));
  const auto info = TRY(SystemVSegments::info(key));
  return Attached{std::move(board), info.shmid};
}

Result<std::unique_ptr<BoardSampler>> BoardSampler::start(int key,
                                                          std::shared_ptr<telemetry::RowSink> sink,
                                                          const BoardSamplerOptions& options,
                                                          const VariableCatalog& catalog) {
  if (!(options.rate >= BoardSamplerOptions::slowest &&
        options.rate <= BoardSamplerOptions::fastest)) {
    return failure(ErrorCode::InvalidArgument,
                   "the sampling rate must lie between " + shortest(BoardSamplerOptions::slowest) +
                       " and " + shortest(BoardSamplerOptions::fastest) + " samples per second",
                   "blackboard " + std::to_string(key));
  }
  auto attached = TRY(attach(key));
  std::unique_ptr<BoardSampler> sampler(new BoardSampler(key, std::move(sink), options, catalog));
  sampler->m_status.attached = true;
  sampler->m_thread =
      std::jthread([self = sampler.get(), first = std::move(attached)](
                       const std::stop_token& stop) mutable { self->run(stop, std::move(first)); });
  return sampler;
}

BoardSampler::BoardSampler(int key, std::shared_ptr<telemetry::RowSink> sink,
                           const BoardSamplerOptions& options, const VariableCatalog& catalog)
    : m_key(key), m_sink(std::move(sink)), m_options(options), m_columns(catalog) {
  telemetry::GroupInfo info{options.group.empty() ? "key " + std::to_string(key) : options.group,
                            m_columns.columns(),
                            {{"key", std::to_string(key)}, {"attached", "1"}}};
  m_group = m_sink->addGroup(info);
}

BoardSampler::~BoardSampler() = default;

BoardSamplerStatus BoardSampler::status() const {
  const std::lock_guard lock(m_mutex);
  return m_status;
}

void BoardSampler::run(const std::stop_token& stop, Attached attached) {
  const auto period = std::chrono::duration_cast<SteadyClock::duration>(
      std::chrono::duration<double>(1.0 / m_options.rate));
  std::vector<std::uint32_t> words(m_columns.size());
  bool there = true;
  auto due = SteadyClock::now(), nextLook = due + lookInterval, windowStart = due;
  std::uint64_t inWindow = 0;
  while (!stop.stop_requested()) {
    auto now = SteadyClock::now();
    if (now < due) {
      sleepUntil(std::min(due, now + longestSleep));
      continue;
    }
    if (now >= nextLook) {
      nextLook = now + lookInterval;
      const auto info = SystemVSegments::info(m_key);
      if (!info || info->shmid != attached.shmid) {
        // Removed, and perhaps made anew: what we hold is memory that nobody else writes.
        auto again = attach(m_key);
        there = again.has_value();
        if (there) attached = std::move(*again);
        const std::lock_guard lock(m_mutex);
        m_status.attached = there;
        m_status.message = there ? std::string()
                                 : "Blackboard " + std::to_string(m_key) +
                                       " was removed; sampling goes on when it is created again.";
      } else {
        there = true;
      }
    }
    if (there) {
      now = SteadyClock::now();
      m_columns.read(attached.board, words);
      m_sink->append(m_group,
                     {std::chrono::duration<double>(now - m_options.zero).count(), words, {}});
      ++inWindow;
    }
    due += period;
    std::uint64_t missed = 0;
    if (now - due > period) {  // more than one late: they cannot be made up for
      missed = static_cast<std::uint64_t>((now - due) / period);
      due += period * static_cast<SteadyClock::rep>(missed);
    }
    const std::lock_guard lock(m_mutex);
    m_status.samples += there ? 1 : 0;
    m_status.missed += there ? missed : 0;
    const auto elapsed = now - windowStart;
    const bool first = m_status.samples == inWindow;  // the first second is shown as it grows
    if (elapsed >= rateWindow || (first && elapsed > period)) {
      m_status.rate =
          static_cast<double>(inWindow) / std::chrono::duration<double>(elapsed).count();
    }
    if (elapsed >= rateWindow) {
      windowStart = now;
      inWindow = 0;
    }
  }
}

}  // namespace pitchboard::link

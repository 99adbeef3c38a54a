// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/state_archive.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::link {

std::optional<StateSegment> StateSegmenter::begin(const sim::WorldState& state) {
  auto ended = std::exchange(m_open, StateSegment(state));
  // Nothing was played: the new checkpoint takes its place.
  if (ended && ended->firstTick() == state.tick && ended->lastTick() == state.tick) ended.reset();
  return ended;
}

std::optional<StateSegment> StateSegmenter::ticked(const SimulatedMatch& match) {
  const sim::WorldState& state = match.simulation().state();
  if (!m_open) return begin(state);
  if (state.tick == m_open->lastTick()) return {};  // a look at a match that stands still
  const auto commands = match.commands();
  if (state.tick != m_open->lastTick() + 1 || commands.size() != m_open->robots()) {
    return begin(state);
  }
  m_open->add(commands);
  const double ticks = std::max(1.0, std::round(m_interval * state.settings.tickRate));
  if (static_cast<double>(state.tick - m_open->firstTick()) < ticks) return {};
  return begin(state);
}

std::optional<StateSegment> StateSegmenter::worldChanged(const SimulatedMatch& match) {
  return begin(match.simulation().state());
}

StateArchive::StateArchive(ArchiveOptions options)
    : m_options(options), m_segmenter(options.interval) {}

void StateArchive::ticked(const SimulatedMatch& match, std::chrono::nanoseconds /*tickTime*/) {
  const std::lock_guard lock(m_mutex);
  keep(m_segmenter.ticked(match));
}

void StateArchive::worldChanged(const SimulatedMatch& match) {
  const std::lock_guard lock(m_mutex);
  keep(m_segmenter.worldChanged(match));
}

void StateArchive::keep(std::optional<StateSegment> ended) {
  if (ended) {
    m_bytes += ended->bytes();
    m_segments.push_back(std::make_shared<const StateSegment>(std::move(*ended)));
  }
  // The match was put back: what came after never happened.
  const std::uint64_t from = m_segmenter.open()->firstTick();
  while (!m_segments.empty() && m_segments.back()->firstTick() >= from) {
    m_bytes -= m_segments.back()->bytes();
    m_segments.pop_back();
  }
  while (!m_segments.empty() && m_bytes > m_options.memoryBudget) {
    m_bytes -= m_segments.front()->bytes();
    m_segments.pop_front();
  }
}

std::optional<StateArchive::TickRange> StateArchive::range() const {
  const std::lock_guard lock(m_mutex);
  const auto& open = m_segmenter.open();
  if (!open) return {};
  const std::uint64_t first =
      m_segments.empty() ? open->firstTick() : m_segments.front()->firstTick();
  return TickRange{first, open->lastTick(), open->tickRate()};
}

Result<sim::WorldState> StateArchive::reenter(std::uint64_t tick) const {
  StateSegment open;
  std::shared_ptr<const StateSegment> found;
  {
    const std::lock_guard lock(m_mutex);
    if (m_segmenter.open() && m_segmenter.open()->firstTick() <= tick) {
      open = *m_segmenter.open();
      found = std::shared_ptr<const StateSegment>(std::shared_ptr<void>(), &open);
    } else {
      const auto after = std::upper_bound(
          m_segments.begin(), m_segments.end(), tick,
          [](std::uint64_t t, const auto& segment) { return t < segment->firstTick(); });
      if (after != m_segments.begin()) found = *std::prev(after);
    }
  }
  if (!found || tick > found->lastTick()) {
    return failure(
        ErrorCode::NotFound,
        "this moment is not in memory any more; record a session to keep all of a match");
  }
  return found->at(tick);
}

std::vector<std::shared_ptr<const StateSegment>> StateArchive::segments(std::uint64_t first,
                                                                        std::uint64_t last) const {
  const std::lock_guard lock(m_mutex);
  std::vector<std::shared_ptr<const StateSegment>> found;
  for (const auto& segment : m_segments) {
    if (segment->lastTick() >= first && segment->firstTick() <= last) found.push_back(segment);
  }
  if (const auto& open = m_segmenter.open();
      open && open->lastTick() >= first && open->firstTick() <= last) {
    found.push_back(std::make_shared<const StateSegment>(*open));
  }
  return found;
}

std::size_t StateArchive::memoryBytes() const {
  const std::lock_guard lock(m_mutex);
  return m_bytes + (m_segmenter.open() ? m_segmenter.open()->bytes() : 0);
}

}  // namespace pitchboard::link

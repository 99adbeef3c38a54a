// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/state_archive.h>

#include <algorithm>
#include <cmath>

#include <robotlink/match/followed_recording.h>

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
  // What a recording did to the world cannot be recomputed from commands, as a change by hand.
  if (state.tick != m_open->lastTick() + 1 || commands.size() != m_open->robots() ||
      match.followState().moved) {
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
  remember(match);
}

void StateArchive::worldChanged(const SimulatedMatch& match) {
  const std::lock_guard lock(m_mutex);
  keep(m_segmenter.worldChanged(match));
  remember(match);
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

void StateArchive::dropMemory(std::deque<std::shared_ptr<const RobotsMemory>>::iterator memory) {
  m_memoriesBytes -= (*memory)->bytes;
  m_memories.erase(memory);
}

bool StateArchive::remembersRobotsOf(const SimulatedMatch& match) const {
  return std::ranges::equal(m_memories.back()->robots, match.robots().all(),
                            [](const auto& known, const auto& slot) {
                              return known.id == slot->id && known.behaviour == slot->behaviour;
                            });
}

void StateArchive::remember(const SimulatedMatch& match) {
  const sim::WorldState& state = match.simulation().state();
  while (!m_memories.empty() && m_memories.back()->tick > state.tick) {
    dropMemory(std::prev(m_memories.end()));
  }
  if (!m_memories.empty()) {
    if (!remembersRobotsOf(match)) {
      // From here on, not from the next piece on.
      if (m_segmenter.open()->firstTick() != state.tick) keep(m_segmenter.worldChanged(match));
      if (m_memories.back()->tick == state.tick) dropMemory(std::prev(m_memories.end()));
    } else {
      const double ticks = m_options.memoryInterval * state.settings.tickRate;
      if (static_cast<double>(state.tick - m_memories.back()->tick) < ticks) return;
    }
  }
  if (m_segmenter.open()->firstTick() != state.tick) return;
  auto memory = match.robotsMemory();
  if (!memory) return;
  m_memoriesBytes += memory->bytes;
  m_memories.push_back(std::move(memory));
  while (m_memoriesBytes > m_options.robotsBudget) dropMemory(m_memories.begin());
}

std::shared_ptr<const MomentPast> StateArchive::past(std::uint64_t tick) const {
  MomentPast past;
  {
    const std::lock_guard lock(m_mutex);
    const auto after =
        std::upper_bound(m_memories.begin(), m_memories.end(), tick,
                         [](std::uint64_t t, const auto& memory) { return t < memory->tick; });
    if (after == m_memories.begin()) return nullptr;
    past.memory = *std::prev(after);
  }
  const std::uint64_t begin = past.memory->tick;
  const auto pieces = segments(begin, tick);
  std::uint64_t at = begin;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i]->firstTick() < begin) continue;
    const std::uint64_t next = i + 1 < pieces.size() ? pieces[i + 1]->firstTick() : tick;
    const std::uint64_t until = std::min(next, tick);
    if (pieces[i]->firstTick() != at || pieces[i]->lastTick() < until) return nullptr;
    if (until == at) continue;
    auto played = pieces[i]->playedTo(until);
    if (!played) return nullptr;
    past.played.push_back(std::move(*played));
    at = until;
  }
  if (at != tick) return nullptr;
  return std::make_shared<const MomentPast>(std::move(past));
}

std::optional<StateArchive::TickRange> StateArchive::range() const {
  const std::lock_guard lock(m_mutex);
  const auto& open = m_segmenter.open();
  if (!open) return {};
  const std::uint64_t first =
      m_segments.empty() ? open->firstTick() : m_segments.front()->firstTick();
  return TickRange{first, open->lastTick(), open->tickRate()};
}

/// Null when no segment has this tick.
std::shared_ptr<const StateSegment> StateArchive::segmentAt(std::uint64_t tick) const {
  const std::lock_guard lock(m_mutex);
  std::shared_ptr<const StateSegment> found;
  if (m_segmenter.open() && m_segmenter.open()->firstTick() <= tick) {
    found = std::make_shared<const StateSegment>(*m_segmenter.open());
  } else {
    const auto after = std::upper_bound(
        m_segments.begin(), m_segments.end(), tick,
        [](std::uint64_t t, const auto& segment) { return t < segment->firstTick(); });
    if (after != m_segments.begin()) found = *std::prev(after);
  }
  return found && tick <= found->lastTick() ? found : nullptr;
}

Result<sim::WorldState> StateArchive::restore(std::uint64_t tick) const {
  const auto found = segmentAt(tick);
  if (!found) {
    return failure(ErrorCode::NotFound,
                   "this moment is no longer in memory; record a session to keep the whole match");
  }
  return found->at(tick);
}

std::optional<sim::SimulationSettings> StateArchive::settings(std::uint64_t tick) const {
  const auto found = segmentAt(tick);
  if (!found) return {};
  auto state = found->at(found->firstTick());
  if (!state) return {};
  return std::move(state->settings);
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
  return m_bytes + m_memoriesBytes + (m_segmenter.open() ? m_segmenter.open()->bytes() : 0);
}

}  // namespace pitchboard::link

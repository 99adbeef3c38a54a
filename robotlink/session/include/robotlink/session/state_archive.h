// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Remembers a match so that every recent moment can be entered again exactly: a checkpoint a second
// (and after every change by hand), what the robots were told in between, and every ten seconds
// what their processes remember, when these run inside the match. Memory has a budget;
// the oldest seconds go first. Written on the match's thread, read from any.

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <robotlink/match/match_runner.h>
#include <robotlink/match/robots_memory.h>
#include <robotlink/session/state_segment.h>

namespace pitchboard::link {

/// Cuts a running match into segments. Used by the archive and by the recorder, on one thread.
class StateSegmenter {
 public:
  /// `interval`: simulated seconds between checkpoints.
  explicit StateSegmenter(double interval = 1.0) : m_interval(interval) {}

  /// As TickObserver::ticked(). Returns the segment that ended here, when one did.
  std::optional<StateSegment> ticked(const SimulatedMatch& match);
  /// As TickObserver::worldChanged().
  std::optional<StateSegment> worldChanged(const SimulatedMatch& match);
  /// The segment in the making; it goes on afterwards.
  const std::optional<StateSegment>& open() const { return m_open; }
  std::optional<StateSegment> finish() { return std::exchange(m_open, std::nullopt); }

 private:
  std::optional<StateSegment> begin(const sim::WorldState& state);
  double m_interval;
  std::optional<StateSegment> m_open;
};

struct ArchiveOptions {
  double interval = 1.0;                             ///< simulated s between checkpoints
  std::size_t memoryBudget = std::size_t{64} << 20;  ///< bytes; about 10 hours of six robots
  double memoryInterval = 10.0;  ///< simulated s between two looks at what processes remember
  std::size_t robotsBudget = std::size_t{64} << 20;  ///< bytes of these; see docs/studio.md
};

class StateArchive : public TickObserver {
 public:
  explicit StateArchive(ArchiveOptions options = {});

  // The match's thread.
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void worldChanged(const SimulatedMatch& match) override;

  struct TickRange {
    std::uint64_t first = 0, last = 0;
    double tickRate = 60.0;
    bool operator==(const TickRange&) const = default;
  };

  // Any thread.
  /// Nothing before the first tick.
  std::optional<TickRange> range() const;
  /// The state that the match went on from at this tick: after changes by hand, where there were
  /// some. Error NotFound when the tick is not (or no longer) there.
  Result<sim::WorldState> restore(std::uint64_t tick) const;
  /// What the match was played with at this tick; nothing when it is not (or no longer) there.
  std::optional<sim::SimulationSettings> settings(std::uint64_t tick) const;
  /// From what the robots' processes remembered to this tick; null when that is not (or no longer)
  /// there, or when none run inside the match.
  std::shared_ptr<const MomentPast> past(std::uint64_t tick) const;
  /// The pieces that have a tick in [first, last], in order.
  std::vector<std::shared_ptr<const StateSegment>> segments(std::uint64_t first,
                                                            std::uint64_t last) const;
  std::size_t memoryBytes() const;

 private:
  void keep(std::optional<StateSegment> ended);
  std::shared_ptr<const StateSegment> segmentAt(std::uint64_t tick) const;
  void remember(const SimulatedMatch& match);
  void dropMemory(std::deque<std::shared_ptr<const RobotsMemory>>::iterator memory);
  bool remembersRobotsOf(const SimulatedMatch& match) const;
  const ArchiveOptions m_options;
  mutable std::mutex m_mutex;  // guards everything below
  StateSegmenter m_segmenter;
  std::deque<std::shared_ptr<const StateSegment>> m_segments;  // by first tick
  std::size_t m_bytes = 0;
  std::deque<std::shared_ptr<const RobotsMemory>>
      m_memories;  // by tick, each where a segment begins
  std::size_t m_memoriesBytes = 0;
};

}  // namespace pitchboard::link

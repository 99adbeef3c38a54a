// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keeps a match in memory so that every recent moment can be restored exactly: a checkpoint per
// second (and after every change by hand), the commands in between, and every ten seconds what
// processes inside the match remember. Memory has a budget, and the oldest seconds are dropped
// first. The match's thread writes; any thread reads.

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

/// Cuts a running match into segments, for the archive and the recorder. One thread at a time.
class StateSegmenter {
 public:
  /// `interval` is the simulated time in s between checkpoints.
  explicit StateSegmenter(double interval = 1.0) : m_interval(interval) {}

  /// As TickObserver::ticked(). Returns the segment that ended here, if one did.
  std::optional<StateSegment> ticked(const SimulatedMatch& match);
  /// As TickObserver::worldChanged().
  std::optional<StateSegment> worldChanged(const SimulatedMatch& match);
  /// Returns the current segment, which continues afterwards.
  const std::optional<StateSegment>& open() const { return m_open; }
  std::optional<StateSegment> finish() { return std::exchange(m_open, std::nullopt); }

 private:
  std::optional<StateSegment> begin(const sim::WorldState& state);
  double m_interval;
  std::optional<StateSegment> m_open;
};

struct ArchiveOptions {
  double interval = 1.0;                             ///< s of simulated time between checkpoints
  std::size_t memoryBudget = std::size_t{64} << 20;  ///< bytes; about 10 hours of six robots
  double memoryInterval = 10.0;  ///< s of simulated time between two copies of processes
  std::size_t robotsBudget = std::size_t{64} << 20;  ///< bytes for these copies
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
  /// Returns nothing before the first tick.
  std::optional<TickRange> range() const;
  /// Returns the state from which the match continued at this tick, after changes by hand. Fails
  /// with NotFound if the tick is not in memory.
  Result<sim::WorldState> restore(std::uint64_t tick) const;
  /// Returns how the match was played at this tick; nothing if the tick is not in memory.
  std::optional<sim::SimulationSettings> settings(std::uint64_t tick) const;
  /// Returns what the robots' processes remember at this tick; null if that is not in memory, or if
  /// none run inside the match.
  std::shared_ptr<const MomentPast> past(std::uint64_t tick) const;
  /// Returns the segments that contain ticks of [first, last], in order.
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

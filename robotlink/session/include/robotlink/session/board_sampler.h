// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Samples a blackboard of this computer that somebody else writes: attached read-only, the whole
// segment at a fixed rate, in a thread of its own. What changes twice between two samples is not
// seen; the rate that was reached is therefore measured.

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/live/board_columns.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

struct BoardSamplerOptions {
  static constexpr double slowest = 0.1, fastest = 1000.0;
  double rate = 60.0;   ///< samples per second, slowest to fastest
  std::string group{};  ///< name of the group; empty: "key 100"
  /// What counts as 0 s.
  std::chrono::steady_clock::time_point zero = std::chrono::steady_clock::now();
};

struct BoardSamplerStatus {
  bool attached = false;  ///< false: the segment was removed; it is taken up when it comes again
  std::string message;    ///< a sentence while not attached
  double rate = 0.0;      ///< samples per second reached over the last second
  std::uint64_t samples = 0;
  std::uint64_t missed = 0;  ///< samples left out because the computer was busy
};

class BoardSampler {
 public:
  /// Fails, with the reason, when there is no such blackboard or it may not be read
  /// (SystemVSegments::open), and InvalidArgument for a rate out of range. Appends to the sink on
  /// its own thread. The group's attributes: "key", "attached" = "1".
  static Result<std::unique_ptr<BoardSampler>> start(int key,
                                                     std::shared_ptr<telemetry::RowSink> sink,
                                                     const BoardSamplerOptions& options,
                                                     const VariableCatalog& catalog);
  /// Ends within 50 ms.
  ~BoardSampler();

  BoardSamplerStatus status() const;
  int key() const { return m_key; }
  telemetry::GroupId group() const { return m_group; }

 private:
  struct Attached;
  BoardSampler(int key, std::shared_ptr<telemetry::RowSink> sink,
               const BoardSamplerOptions& options, const VariableCatalog& catalog);
  static Result<Attached> attach(int key);
  void run(const std::stop_token& stop, Attached attached);

  const int m_key;
  const std::shared_ptr<telemetry::RowSink> m_sink;
  const BoardSamplerOptions m_options;
  const BoardColumns m_columns;
  telemetry::GroupId m_group = 0;
  mutable std::mutex m_mutex;  // of m_status
  BoardSamplerStatus m_status;
  std::jthread m_thread;  // last: ends before what it uses
};

}  // namespace pitchboard::link

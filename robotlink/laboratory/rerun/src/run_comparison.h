// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a rerun writes, compared with the recording and with what the last rerun wrote, and kept for
// the next one. Private to the module; one thread. Seconds of the session.

#include <memory>
#include <optional>
#include <vector>

#include <robotlink/rerun/rerun.h>

#include "feed.h"
#include "output_comparer.h"

namespace pitchboard::link {

class RunComparison {
 public:
  /// `options` and `feed` outlive it; `begin`: of what is compared.
  RunComparison(const Feed& feed, const RerunOptions& options, double slack, double begin);

  /// Compares the newest row of the feed with what stands on the board, but no outputs of processes
  /// that are `running`.
  void add(double time, const Blackboard& board, const std::vector<std::string>& running);
  void finish();
  const std::vector<ComparedVariable>& variables() const { return m_comparer.variables(); }
  std::vector<OutputComparer::Begun> drainBegun() { return m_comparer.drainBegun(); }
  void putInto(RerunResult& result) const;

 private:
  void compareWithLast(double time);
  void keep(double time);

  const Feed& m_feed;
  const RerunOptions& m_options;
  OutputComparer m_comparer;
  std::optional<OutputComparer> m_sinceLast;
  std::vector<ComparedValue> m_values, m_lastValues;
  struct LastOutput {
    const std::vector<RerunOutputs::Change>* changes = nullptr;  // null: the last one had none
    std::size_t next = 0;                                        // of them
  };
  std::vector<LastOutput> m_last;  // for each output
  std::shared_ptr<RerunOutputs> m_outputs;
  std::vector<std::vector<RerunOutputs::Change>*> m_kept;  // in m_outputs, for each output
  std::size_t m_changes = 0;                               // that are kept
};

}  // namespace pitchboard::link

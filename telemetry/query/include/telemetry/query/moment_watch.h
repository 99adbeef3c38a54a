// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds where conditions hold in rows that are still coming. It finds the moments that
// findMoments() finds in a file with the same rows. Keeps no rows: of each condition and robot, the
// moment that goes on. One thread at a time. Times are seconds of the source.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <telemetry/query/find_moments.h>
#include <telemetry/query/query_rows.h>

namespace pitchboard::telemetry {

class MomentWatch {
 public:
  /// The questions are right (checkQuestion()).
  explicit MomentWatch(std::vector<MomentQuestion> questions);
  MomentWatch(MomentWatch&&) noexcept;
  MomentWatch& operator=(MomentWatch&&) noexcept;
  ~MomentWatch();

  /// Takes the rows after those of the last call up to `until`; none of an earlier time may come
  /// later. The rows may have more groups and columns than before. `progress` is called from time
  /// to time with the share that is done (0 to 1). Returns false if it did; then this object can
  /// only be destroyed.
  bool advance(const QueryRows& rows, double until,
               const std::function<bool(double)>& progress = {});
  /// Removes and returns the moments that have ended, in the order of their beginning.
  std::vector<FoundMoment> takeEnded();
  /// Returns the moments that go on and last long enough already; each ends at its last sample.
  std::vector<FoundMoment> open() const;
  /// Returns the questions that the rows of the last call cannot answer.
  const std::vector<UnansweredQuestion>& unanswered() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry

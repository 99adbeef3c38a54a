// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds where conditions hold, in many sessions at once and on all cores. Reads each session once,
// of it only the groups that the conditions need, and of long sessions only the parts that their
// summaries of minimum and maximum do not rule out. Needs memory for a few chunks of each thread.
// Times are seconds of each session.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::telemetry {

struct MomentQuestion {
  std::string condition;              ///< an expression; see session_query.h
  double least = 0.0;                 ///< s for which it must hold
  std::vector<std::string> robots{};  ///< that `each` stands for; all if empty
};

struct FindOptions {
  std::vector<MomentQuestion> questions;
  unsigned threads = 0;       ///< 0: as many as there are cores
  bool usesSummaries = true;  ///< false: read every row (for measuring and tests)
};

struct FoundMoment {
  std::size_t question = 0;
  std::string robot;  ///< that `each` stands for, or of the first variable
  /// From the first sample at which the condition holds to the next one at which it does not.
  TimeRange range;
  /// If the condition begins with a comparison by < or >: where its left side is farthest beyond
  /// the right side, its value (the difference of both, if neither is a number), and when.
  std::optional<double> value;
  double valueAt = 0.0;
};

/// A question about robots or variables that a session does not have.
struct UnansweredQuestion {
  std::size_t question = 0;
  Error error;
};

struct FileMoments {
  std::vector<FoundMoment> moments;  ///< in order of time
  std::vector<UnansweredQuestion> unanswered{};
  /// The session cannot be read, or the error of the first question if none could be answered.
  std::optional<Error> error;
  std::vector<std::string> notes;  ///< of the session
  bool isDamaged = false;          ///< a part of the file could not be read
  bool isForeign = false;          ///< another program wrote it; it has to be imported
  double share = 1.0;              ///< of the session's time that was read
};

/// Fails with ParseError if the condition is wrong, or with InvalidArgument.
Result<void> checkQuestion(const MomentQuestion& question);

/// Reads the files and calls `report` with the result of each, in their order, on the calling
/// thread. Stops when it returns false. `goOn` is asked from time to time by every thread; after
/// false nothing more is reported. Fails as checkQuestion().
Result<void> findMoments(std::span<const std::string> files, const FindOptions& options,
                         const std::function<bool(std::size_t file, FileMoments&& found)>& report,
                         const std::function<bool()>& goOn = {});

}  // namespace pitchboard::telemetry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is evaluated over rows to answer questions: whether each condition holds and, if it begins
// with a comparison, how far a value is beyond its limit. Private to the library; one thread at a
// time. Times are s.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <telemetry/query/find_moments.h>
#include <telemetry/query/session_query.h>

#include "stretches.h"

namespace pitchboard::telemetry {

struct AskedQuestion {
  QueryText text;
  double least = 0.0;
  bool hasValue = false;
  double sign = 1.0, limit = 0.0;  ///< the excess is sign * (value - limit)
};

std::vector<AskedQuestion> askedOf(std::span<const MomentQuestion> questions);

/// The questions that rows can answer, as one query.
struct AskedQuery {
  std::optional<SessionQuery> query{};   ///< empty: none
  std::vector<std::size_t> questions{};  ///< index of the question, by QueryCurve::value
  std::vector<UnansweredQuestion> unanswered{};

  std::size_t questionOf(std::size_t curve) const {
    return questions[query->curves()[curve].value];
  }
};
AskedQuery resolvedFor(const QueryRows& rows, std::span<const AskedQuestion> asked);

/// Adds the samples of a range to the stretches of each curve. Returns false if `goOn` did.
bool addStretches(const QueryRows& rows, AskedQuery& query, std::span<const AskedQuestion> asked,
                  TimeRange range, std::span<Stretches> out,
                  const std::function<bool(double)>& progress);

/// Appends the stretches that last long enough.
void addMoments(std::span<const Stretches::Found> found, std::size_t question,
                const AskedQuestion& asked, const std::string& robot,
                std::vector<FoundMoment>& out);

}  // namespace pitchboard::telemetry

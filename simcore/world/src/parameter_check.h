// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Holds values against the ranges of the table. Private to the module; any thread.

#include <span>
#include <string>

#include <base/lined_json.h>
#include <simcore/world/parameters.h>

namespace pitchboard::sim {

/// The first value that is not finite or out of its range; no key: all are good.
struct BadParameter {
  std::string key;
  std::string text;  ///< "must lie between 0 and 1 metres per 1/60 s, and is -0.1"
};

template <class Values>
BadParameter firstBad(const Values& values, std::span<const Parameter<Values>> parameters) {
  for (const Parameter<Values>& p : parameters) {
    const double value = values.*p.member;
    if (value >= p.stored(p.least) && value <= p.stored(p.most)) continue;  // not so for NaN
    const std::string unit = *p.unit.name ? std::string(" ") + p.unit.name : std::string();
    return {p.key, "must lie between " + shortest(p.least) + " and " + shortest(p.most) + unit +
                       ", and is " + shortest(p.written(value))};
  }
  return {};
}

}  // namespace pitchboard::sim

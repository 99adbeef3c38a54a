// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads the numbers of parameters.h from a JSON object that people wrote: degrees in files, radians
// in memory. Pure functions; any thread.

#include <array>
#include <string_view>
#include <type_traits>
#include <vector>

#include <base/lined_json.h>
#include <simcore/world/parameters.h>

namespace pitchboard::sim {

template <class Values, class Number>
NumberRange rangeOf(const Parameter<Values, Number>& parameter) {
  return {parameter.least, parameter.most, parameter.unit.name};
}

/// Returns `keys` and the keys of the parameters.
template <class Values, class Number, std::size_t N>
std::vector<std::string_view> withKeys(std::vector<std::string_view> keys,
                                       const std::array<Parameter<Values, Number>, N>& parameters) {
  for (const auto& parameter : parameters) keys.push_back(parameter.key);
  return keys;
}

/// Reads the parameters that the object has into `values`.
template <class Values, class Number, std::size_t N>
void readNumbers(const JsonObject& object,
                 const std::array<Parameter<Values, Number>, N>& parameters, Values& values) {
  for (const auto& parameter : parameters) {
    if (!object.find(parameter.key)) continue;
    if constexpr (std::is_same_v<Number, int>) {
      values.*parameter.member = object.integer(parameter.key, 0, static_cast<int>(parameter.least),
                                                static_cast<int>(parameter.most));
    } else {
      const double written = object.number(parameter.key, 0.0, rangeOf(parameter));
      values.*parameter.member = parameter.stored(written);
    }
  }
}

}  // namespace pitchboard::sim

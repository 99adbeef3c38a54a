// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads JSON that a program wrote and that may have been damaged since. A member that is missing or
// of another type gets its default, and nothing throws. For files that people write, use
// <base/lined_json.h>, which reports errors with their line. `Json` is one of nlohmann's types. Any
// thread.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace pitchboard::lenient {

/// Parses a text. The result is discarded if the text is no JSON or is nested deeper than
/// `deepest`, because destroying it recurses.
template <class Json>
Json parsed(std::string_view text, int deepest = 8) {
  return Json::parse(
      text, [deepest](int depth, typename Json::parse_event_t, Json&) { return depth <= deepest; },
      false);
}

/// Returns the member, or null if there is none.
template <class Json>
const Json* member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

template <class T, class Json>
T whole(const Json& object, const char* key, T fallback = {}) {
  const Json* value = member(object, key);
  if (value == nullptr || !value->is_number_integer()) return fallback;
  if (value->is_number_unsigned()) {
    const auto number = value->template get<std::uint64_t>();
    return std::in_range<T>(number) ? static_cast<T>(number) : fallback;
  }
  const auto number = value->template get<std::int64_t>();
  return std::in_range<T>(number) ? static_cast<T>(number) : fallback;
}

template <class Json>
std::optional<double> number(const Json& object, const char* key) {
  const Json* value = member(object, key);
  return value != nullptr && value->is_number() ? std::optional(value->template get<double>())
                                                : std::nullopt;
}

template <class Json>
std::string text(const Json& object, const char* key) {
  const Json* value = member(object, key);
  return value != nullptr && value->is_string() ? value->template get<std::string>()
                                                : std::string();
}

template <class Json>
bool flag(const Json& object, const char* key, bool fallback = false) {
  const Json* value = member(object, key);
  return value != nullptr && value->is_boolean() ? value->template get<bool>() : fallback;
}

/// Calls `visit(index, element)` for the first `most` elements, if the member is an array.
template <class Json, class Visit>
void each(const Json& object, const char* key, std::size_t most, const Visit& visit) {
  const Json* array = member(object, key);
  if (array == nullptr || !array->is_array()) return;
  for (std::size_t i = 0; i < std::min(array->size(), most); ++i) visit(i, (*array)[i]);
}

}  // namespace pitchboard::lenient

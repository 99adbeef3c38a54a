// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads JSON that a program wrote and that a file may have damaged since: a member that is missing
// or of another kind has its default, and nothing throws. Files that people write are read by
// <base/lined_json.h>, which names the line. `Json` is one of nlohmann's. Any thread.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace pitchboard::telemetry::lenient {

/// Discarded where the text is none, or is nested deeper: destroying it recurses.
template <class Json>
Json parsed(std::string_view text, int deepest = 8) {
  return Json::parse(
      text, [deepest](int depth, typename Json::parse_event_t, Json&) { return depth <= deepest; },
      false);
}

/// Null where there is none.
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

/// The first `most` elements of an array, with their places; nothing where it is none.
template <class Json, class Visit>
void each(const Json& object, const char* key, std::size_t most, const Visit& visit) {
  const Json* array = member(object, key);
  if (array == nullptr || !array->is_array()) return;
  for (std::size_t i = 0; i < std::min(array->size(), most); ++i) visit(i, (*array)[i]);
}

}  // namespace pitchboard::telemetry::lenient

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes the recorded options of a table into a JSON object, by their keys, and reads them. `Json`
// is one of nlohmann's types. Any thread.

#include <optional>
#include <utility>

#include <base/options.h>

namespace pitchboard {

/// Returns the value if it has the type of `like`; a whole number is a real one, too.
template <class Json>
std::optional<OptionValue> optionFromJson(const Json& json, const OptionValue& like) {
  if (std::holds_alternative<bool>(like) && json.is_boolean()) return json.template get<bool>();
  if (std::holds_alternative<double>(like) && json.is_number()) return json.template get<double>();
  if (std::holds_alternative<std::string>(like) && json.is_string()) {
    return json.template get<std::string>();
  }
  if (std::holds_alternative<std::uint64_t>(like) && json.is_number_unsigned()) {
    return json.template get<std::uint64_t>();
  }
  if (std::holds_alternative<int>(like) && json.is_number_integer()) {
    const auto number = json.template get<std::int64_t>();
    return std::in_range<int>(number) ? std::optional<OptionValue>(static_cast<int>(number))
                                      : std::nullopt;
  }
  if (!std::holds_alternative<std::vector<std::string>>(like) || !json.is_array()) return {};
  std::vector<std::string> texts;
  for (const Json& text : json) {
    if (!text.is_string()) return {};
    texts.push_back(text.template get<std::string>());
  }
  return texts;
}

template <class Json, class Values>
void writeOptions(Json& object, std::type_identity_t<std::span<const Option<Values>>> table,
                  const Values& values) {
  for (const Option<Values>& option : table) {
    if (!option.info.isRecorded) continue;
    std::visit([&](const auto& value) { object[option.info.key] = value; },
               option.access.get(values));
  }
}

/// What is missing, or cannot be, keeps its value.
template <class Json, class Values>
void readOptions(const Json& object, std::type_identity_t<std::span<const Option<Values>>> table,
                 Values& values) {
  for (const Option<Values>& option : table) {
    if (!option.info.isRecorded) continue;
    const auto found = object.find(option.info.key);
    if (found == object.end()) continue;
    if (const auto read = optionFromJson(*found, option.access.get(values))) {
      (void)setOption(values, option, *read);
    }
  }
}

}  // namespace pitchboard

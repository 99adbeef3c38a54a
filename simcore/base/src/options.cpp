// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/options.h>

#include <algorithm>
#include <cmath>

#include <base/lined_json.h>

namespace pitchboard {
namespace {

/// 2000000000, not 2e+09.
std::string limitText(double number) {
  constexpr double largest = 1e15;
  const bool isWhole = std::trunc(number) == number && std::abs(number) < largest;
  return isWhole ? std::to_string(static_cast<std::int64_t>(number)) : shortest(number);
}

}  // namespace
std::string optionText(const OptionValue& value) {
  struct Writer {
    std::string operator()(bool on) const { return on ? "on" : ""; }
    std::string operator()(int number) const { return number == 0 ? "" : std::to_string(number); }
    std::string operator()(std::uint64_t number) const {
      return number == 0 ? "" : std::to_string(number);
    }
    std::string operator()(double number) const { return number == 0 ? "" : shortest(number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const std::vector<std::string>& texts) const {
      std::string all;
      for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + text;
      return all;
    }
  };
  return std::visit(Writer{}, value);
}

std::string problemOf(const OptionInfo& option, const OptionValue& value) {
  const bool isRange = std::isfinite(option.min) || std::isfinite(option.max);
  if (option.choices && !isRange) {
    const std::vector<OptionChoice> choices = option.choices();
    if (std::ranges::find(choices, value, &OptionChoice::value) != choices.end()) return {};
    std::string names;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      names += (i == 0                    ? ""
                : i + 1 == choices.size() ? " or "
                                          : ", ") +
               optionText(choices[i].value);
    }
    return "must be " + names + ", not \"" + optionText(value) + '"';
  }
  double number = 0.0;
  if (const auto* whole = std::get_if<int>(&value)) {
    number = *whole;
  } else if (const auto* real = std::get_if<double>(&value)) {
    number = *real;
  } else {
    return {};
  }
  if (number >= option.min && number <= option.max) return {};
  return "must be from " + limitText(option.min) + " to " + limitText(option.max) + ", not " +
         limitText(number);
}

std::vector<std::string> textsOf(std::string_view text) {
  constexpr std::string_view between = ",; \t\n";
  std::vector<std::string> texts;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
    if (text.empty()) return texts;
    const std::string_view one = text.substr(0, text.find_first_of(between));
    texts.emplace_back(one);
    text.remove_prefix(one.size());
  }
}

}  // namespace pitchboard

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Options that people set: each is one row of a table, with its name, type, unit, range, default
// and text. Command lines (<app/option_arguments.h>), settings and dialogs
// (<ui/base/option_form.h>) and JSON (<base/option_json.h>) are made from the rows. The default is
// that of the struct. A table of numbers of the simulation is <simcore/world/parameters.h>.
// Constant data; any thread.

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <base/result.h>

namespace pitchboard {

/// A switch, a number, a text, or several texts.
using OptionValue =
    std::variant<bool, int, std::uint64_t, double, std::string, std::vector<std::string>>;
/// Values of options by their keys or names.
using OptionValues = std::map<std::string, OptionValue>;

/// A value that an option can have, and what dialogs call it.
struct OptionChoice {
  OptionValue value;
  std::string label;
};

/// What is said of an option. Null where it is not said.
struct OptionInfo {
  const char* name = nullptr;   ///< "port-base": on the command line --port-base
  const char* key = nullptr;    ///< "portBase": in settings and JSON, and of its widget
  const char* form = "";        ///< stands for its value in help: "PORT"; empty for a switch
  const char* group = "";       ///< in dialogs
  const char* title = nullptr;  ///< its label in dialogs
  const char* text = "";        ///< what it does, without a full stop
  const char* unit = "";        ///< of a number
  double min = -std::numeric_limits<double>::infinity();  ///< of a number, in the unit
  double max = std::numeric_limits<double>::infinity();
  int decimals = 2;        ///< that dialogs show
  const char* unset = "";  ///< shown for the least number or an empty text: "off", "all senders"
  /// All values that it can have; of a number with a range those that dialogs offer.
  std::vector<OptionChoice> (*choices)() = nullptr;
  bool isRecorded = false;        ///< sessions keep it
  const char* instead = nullptr;  ///< it needs a window: what to do where there is none
};

/// Returns what is wrong with a value as the end of a sentence, "must be from 1 to 64, not 99";
/// empty if nothing is.
std::string problemOf(const OptionInfo& option, const OptionValue& value);
/// Returns the value as people write it; texts of a list are separated by ", ". Empty for the
/// number 0.
std::string optionText(const OptionValue& value);
/// Splits at commas, semicolons and spaces.
std::vector<std::string> textsOf(std::string_view text);

/// Reads and sets one option of `Values`. `set` may be called with values of the type of the
/// default only, that problemOf() does not refuse.
template <class Values>
struct OptionAccess {
  OptionValue (*get)(const Values&);
  Result<void> (*set)(Values&, const OptionValue&);
};

template <class Values>
struct Option {
  OptionInfo info;
  OptionAccess<Values> access;
};

namespace option_detail {
template <class Member>
struct Plain {
  using Type = Member;
  static const Type& value(const Member& member) { return member; }
};
/// Nothing is the default.
template <class Member>
struct Plain<std::optional<Member>> {
  using Type = Member;
  static Type value(const std::optional<Member>& member) { return member.value_or(Member{}); }
};
// clang-format off
template <class Values, auto... path>
OptionValue get(const Values& values) {
  const auto& member = (values .* ... .* path);
  using Member = Plain<std::remove_cvref_t<decltype(member)>>;
  return OptionValue(std::in_place_type<typename Member::Type>, Member::value(member));
}
template <class Values, auto... path>
Result<void> set(Values& values, const OptionValue& value) {
  auto& member = (values .* ... .* path);
  member = std::get<typename Plain<std::remove_cvref_t<decltype(member)>>::Type>(value);
  return {};
}
// clang-format on
}  // namespace option_detail

/// Access to a member, or to a member of a member: `optionMember<LiveOptions,
/// &LiveOptions::robots>`.
template <class Values, auto... path>
inline constexpr OptionAccess<Values> optionMember{&option_detail::get<Values, path...>,
                                                   &option_detail::set<Values, path...>};

/// Sets an option. Fails with InvalidArgument for a value of another type or out of range, and as
/// `set` does.
template <class Values>
Result<void> setOption(Values& values, const Option<Values>& option, const OptionValue& value) {
  const std::string context = option.info.name  ? "--" + std::string(option.info.name)
                              : option.info.key ? option.info.key
                                                : "";
  std::string problem = problemOf(option.info, value);
  if (value.index() != option.access.get(Values{}).index()) problem = "has another type";
  if (!problem.empty()) return failure(ErrorCode::InvalidArgument, std::move(problem), context);
  return option.access.set(values, value);
}

/// Sets the options that are in `given` by name, in the order of the table. Returns the first
/// error.
template <class Values>
Result<void> setOptions(Values& values, std::type_identity_t<std::span<const Option<Values>>> table,
                        const OptionValues& given) {
  for (const Option<Values>& option : table) {
    const auto found = given.find(option.info.name ? option.info.name : "");
    if (found == given.end()) continue;
    auto set = setOption(values, option, found->second);
    if (set) continue;
    if (set.error().context.empty()) set.error().context = "--" + std::string(option.info.name);
    return set;
  }
  return {};
}

}  // namespace pitchboard

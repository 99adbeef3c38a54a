// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/option_arguments.h>

namespace pitchboard::shared {

std::string refuseNegative(const std::string& text) {
  return text.starts_with('-') ? "must be 0 or more, not " + text : std::string();
}

namespace {

struct ArgumentMaker {
  CLI::App& command;
  const std::string name, text;
  std::function<void(OptionValue)> take;

  CLI::Option* operator()(bool) const {
    return command.add_flag_callback(
        name, [take = take] { take(true); }, text);
  }
  CLI::Option* operator()(std::uint64_t) const {
    return add<std::uint64_t>(text)->check(refuseNegative);
  }
  CLI::Option* operator()(const std::vector<std::string>&) const {
    return add<std::vector<std::string>>(text + "; may be repeated");
  }
  template <class Value>
  CLI::Option* operator()(const Value&) const {
    return add<Value>(text);
  }
  template <class Value>
  CLI::Option* add(const std::string& description) const {
    return command.add_option_function<Value>(
        name, [take = take](const Value& value) { take(value); }, description);
  }
};

}  // namespace

CLI::Option* addOption(CLI::App& command, const OptionInfo& option, const OptionValue& usual,
                       std::function<Result<void>(const OptionValue&)> take) {
  const std::string name = "--" + std::string(option.name);
  const auto checked = [name, &option, take = std::move(take)](const OptionValue& value) {
    if (const std::string problem = problemOf(option, value); !problem.empty()) {
      throw CLI::ValidationError(name, problem);
    }
    if (const auto taken = take(value); !taken) {
      throw CLI::ValidationError(name, taken.error().text());
    }
  };
  CLI::Option* made = std::visit(ArgumentMaker{command, name, option.text, checked}, usual);
  if (!std::holds_alternative<bool>(usual)) {
    made->type_name(option.form)->default_str(optionText(usual));
  }
  return made;
}

}  // namespace pitchboard::shared

// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/usage.h>

#include <algorithm>
#include <regex>
#include <vector>

#include <base/documents.h>
#include <base/lined_json.h>
#include <base/nearest_name.h>

namespace pitchboard::shared {

std::string fullName(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  return (parent ? fullName(*parent) + ' ' : std::string()) + app.get_name();
}

namespace {

constexpr std::size_t pageWidth = 80, textColumn = 27;
constexpr const char* commonGroup = "Options";

struct Description {
  std::string summary;
  std::vector<std::string> examples;
};

Description descriptionOf(const CLI::App& app) {
  Description out;
  bool example = false;
  for (std::string line : CLI::detail::split(app.get_description(), '\n')) {
    for (const std::string_view start : {"Example: ", "Examples: "}) {
      if (!line.starts_with(start)) continue;
      example = true;
      line.erase(0, start.size());
    }
    if (!example) {
      out.summary += (out.summary.empty() ? "" : " ") + line;
    } else {
      out.examples.push_back(CLI::detail::trim_copy(line));
    }
  }
  return out;
}

/// Without its full stop.
std::string firstSentence(const std::string& text) {
  const std::size_t end = text.find(". ");
  if (end != std::string::npos) return text.substr(0, end);
  return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
}

/// The text, broken into lines that begin at `column`; the first line is there already up to it.
std::string wrapped(const std::string& text, std::size_t column) {
  std::string out;
  std::size_t at = column;
  for (const std::string& paragraph : CLI::detail::split(text, '\n')) {
    for (const std::string& token : CLI::detail::split(paragraph, ' ')) {
      if (token.empty()) continue;
      if (at > column && at + 1 + token.size() > pageWidth) {
        out += '\n' + std::string(column, ' ');
        at = column;
      }
      if (at > column) {
        out += ' ';
        ++at;
      }
      out += token;
      at += token.size();
    }
  }
  return out;
}

std::string entry(const std::string& name, const std::string& text) {
  std::string out = "  " + name;
  if (text.empty()) return out + '\n';
  if (out.size() + 2 > textColumn) {
    out += '\n' + std::string(textColumn, ' ');
  } else {
    out.resize(textColumn, ' ');
  }
  return out + wrapped(text, textColumn) + '\n';
}

bool isPositional(const CLI::Option& option) {
  return option.get_positional();
}

/// What stands for its value: "FILE". A positional that has no type of ours has its name.
std::string typeOf(const CLI::Option& option) {
  std::string type = option.get_type_name();  // "N:INT in [0 - 45]": validators stand behind
  type.resize(std::min(type.size(), type.find(':')));
  const bool isTheLibrarys = type == "TEXT" || type == "INT" || type == "UINT" || type == "FLOAT";
  return isPositional(option) && isTheLibrarys ? option.get_name(true) : type;
}

/// Remove what CLI11 writes after a flag that is false: "--read-only{false}".
std::string withoutFlagValues(std::string name) {
  for (std::size_t at = name.find('{'); at != std::string::npos; at = name.find('{')) {
    name.erase(at, name.find('}', at) - at + 1);
  }
  return name;
}

std::string entryOf(const CLI::Option& option) {
  std::string name = withoutFlagValues(option.get_name(isPositional(option), true));
  std::ranges::replace(name, ',', '\0');
  for (std::size_t at = 0; (at = name.find('\0', at)) != std::string::npos; at += 2) {
    name.replace(at, 1, ", ");
  }
  if (option.get_items_expected_max() != 0) {
    if (isPositional(option)) {
      name = typeOf(option);
    } else {
      name += ' ' + typeOf(option);
    }
  }
  std::string text = option.get_description();
  const std::string usual = option.get_default_str();
  if (!usual.empty() && option.get_items_expected_max() != 0) text += " [" + usual + ']';
  return entry(name, text);
}

std::vector<const CLI::Option*> optionsOf(const CLI::App& app, const std::string& group) {
  return app.get_options([&group](const CLI::Option* option) {
    return option->get_group() == group && !isPositional(*option);
  });
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

const CLI::App& chosenIn(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : chosenIn(*chosen.front());
}

class Help : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string /*name*/,
                        CLI::AppFormatMode mode) const override {
    return helpText(*app, mode);
  }
};

/// The library's list of what was not expected: unknown options, or too many arguments.
std::string unexpectedText(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App& command = chosenIn(app);
  const auto commands = commandsOf(command);
  const bool isCommand = !commands.empty() && !arguments.front().starts_with("-");
  for (const std::string& token : arguments) {
    if (isCommand || !token.starts_with("-") || token.size() < 2) continue;
    const std::string name = token.substr(0, token.find('='));
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_group().empty()) continue;
      for (const std::string& one : option->get_lnames()) names.push_back("--" + one);
    }
    const std::string_view near =
        nearestName(name, std::vector<std::string_view>(names.begin(), names.end()));
    return "unknown option \"" + name + '"' +
           (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?");
  }
  if (commands.empty()) {
    const bool hasScenario = command.get_option_no_throw("--scenario") != nullptr;
    return "unexpected argument \"" + arguments.front() + '"' +
           (hasScenario ? "; a scenario is chosen with --scenario " + arguments.front() : "");
  }
  std::vector<std::string> names;
  for (const CLI::App* one : commands) names.push_back(one->get_name());
  return unknownName("command", arguments.front(),
                     std::vector<std::string_view>(names.begin(), names.end()));
}

const CLI::Option* find(const CLI::App& app, const std::string& name) {
  return chosenIn(app).get_option_no_throw(name);
}

std::string valueText(const CLI::Option* option) {
  if (!option) return "a value";
  const std::string type = typeOf(*option);
  return type == "N" || type == "PORT" || type == "P" || type == "INT" || type == "UINT"
             ? "a whole number"
             : (type == "FLOAT" || type == "X" ? "a number" : "a value (" + type + ")");
}

}  // namespace

void addGroup(CLI::App& command, const std::string& group,
              std::initializer_list<const char*> options) {
  for (const char* name : options) command.get_option(name)->group(group);
}

std::string helpText(const CLI::App& app, CLI::AppFormatMode mode) {
  const Description description = descriptionOf(app);
  std::string out = wrapped(description.summary, 0) + "\n\n";
  if (!description.examples.empty()) {
    out += description.examples.size() > 1 ? "Examples:\n" : "Example:\n";
    for (const std::string& example : description.examples) out += "  " + example + '\n';
    out += '\n';
  }
  const auto commands = commandsOf(app);
  const auto positionals =
      app.get_options([](const CLI::Option* option) { return isPositional(*option); });
  out += "Usage: " + fullName(app) +
         (commands.empty()      ? ""
          : positionals.empty() ? " COMMAND"
                                : " [COMMAND]") +
         " [OPTIONS]";
  for (const CLI::Option* one : positionals) {
    const std::string name = typeOf(*one) + (one->get_items_expected_max() > 1 ? "..." : "");
    out += one->get_required() ? ' ' + name : " [" + name + ']';
  }
  out += "\n\n";
  if (!positionals.empty()) {
    out += "Arguments:\n";
    for (const CLI::Option* one : positionals) out += entryOf(*one);
    out += '\n';
  }
  if (!commands.empty()) {
    out += "Commands:\n";
    for (const CLI::App* one : commands) {
      out += entry(one->get_name(), firstSentence(descriptionOf(*one).summary));
    }
    out += '\n';
  }
  out += "Options:\n";
  for (const CLI::Option* one : optionsOf(app, commonGroup)) {
    if (one != app.get_help_ptr() && one != app.get_help_all_ptr()) out += entryOf(*one);
  }
  std::string rare;
  for (const std::string& group : app.get_groups()) {
    if (group == commonGroup || group.empty()) continue;
    const auto options = optionsOf(app, group);
    if (options.empty()) continue;
    if (mode == CLI::AppFormatMode::All) {
      rare += '\n' + group + ":\n";
      for (const CLI::Option* one : options) rare += entryOf(*one);
    } else {
      std::string names;
      for (const CLI::Option* one : options) {
        names += (names.empty() ? "" : " ") + withoutFlagValues(one->get_name(false, false));
      }
      rare += entry(group, names);
    }
  }
  out += entry("-h, --help", "Print this page");
  if (!rare.empty()) {
    out += entry("--help-all", "Describe the rare options, too");
    out += mode == CLI::AppFormatMode::All ? rare : "\nRare options (--help-all):\n" + rare;
  }
  if (!commands.empty()) {
    out += "\nRun \"" + fullName(app) + " COMMAND --help\" for the options of a command.\n";
  }
  const std::string page = app.get_parent() == nullptr ? documentationPath() : std::string();
  if (!page.empty()) out += "\nDocumentation: " + page + '\n';
  return out;
}

void addHelp(CLI::App& app) {
  app.formatter(std::make_shared<Help>());
  app.set_help_all_flag("--help-all", "Describe all options");
  for (CLI::App* command : app.get_subcommands({})) addHelp(*command);
}

std::string problemText(const CLI::App& app, const CLI::ParseError& error) {
  std::string message = error.what();
  const std::vector<std::string> unexpected = app.remaining(true);
  const bool isMissing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  if (!unexpected.empty() && (isMissing || dynamic_cast<const CLI::ExtrasError*>(&error))) {
    return unexpectedText(app, unexpected);
  }
  std::smatch part;
  if (isMissing) {
    if (message.starts_with("A subcommand")) return "a command is missing";
    const std::string name = message.substr(0, message.find(" is required"));
    const CLI::Option* option = find(app, name);
    return option && isPositional(*option)
               ? typeOf(*option) + " is missing: " + option->get_description()
               : name + " is missing";
  }
  if (dynamic_cast<const CLI::ExcludesError*>(&error) &&
      std::regex_match(message, part, std::regex("(.*) excludes (.*)"))) {
    return part.str(1) + " and " + part.str(2) + " cannot be used together; leave out one of them";
  }
  if (dynamic_cast<const CLI::RequiresError*>(&error) &&
      std::regex_match(message, part, std::regex("(.*) requires (.*)"))) {
    return part.str(1) + " only works together with " + part.str(2);
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) &&
      std::regex_search(message, part, std::regex("^(-[^ :]*):"))) {
    const CLI::Option* option = find(app, part.str(1));
    return part.str(1) + " needs " + valueText(option);
  }
  if (dynamic_cast<const CLI::ConversionError*>(&error) &&
      std::regex_match(message, part, std::regex("Could not convert: (\\S+) = (.*)"))) {
    return part.str(1) + " must be " + valueText(find(app, part.str(1))) + ", not \"" +
           part.str(2).substr(0, 64) + '"';
  }
  if (std::regex_match(message, part,
                       std::regex("(\\S+): Value (.*) not in range \\[?(\\S+) (?:to|-) "
                                  "([^\\]\\s]+)\\]?"))) {
    return part.str(1) + " must be from " + part.str(3) + " to " + part.str(4) + ", not " +
           part.str(2);
  }
  if (std::regex_match(message, part, std::regex("(\\S+): (.*) not in \\{(.*)\\}"))) {
    std::string names = std::regex_replace(part.str(3), std::regex(","), ", ");
    const std::size_t last = names.rfind(',');
    if (last != std::string::npos) names.replace(last, 1, " or");
    return part.str(1) + " must be " + names + ", not \"" + part.str(2) + '"';
  }
  // What our own checks say.
  if (std::regex_match(message, part, std::regex("(\\S+): (must be .*)"))) {
    return part.str(1) + ' ' + part.str(2);
  }
  return message;
}

namespace {

/// Separated by blanks: the long options of a command, or the names of its commands.
std::string completionsOf(const CLI::App& app) {
  std::string arguments;
  for (const CLI::App* command : commandsOf(app)) arguments += command->get_name() + ' ';
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) arguments += "--" + name + ' ';
  }
  if (!arguments.empty()) arguments.pop_back();
  return arguments;
}

/// A line of the `case` for this command and those below it. Built-in choices such as
/// inline|separate|none complete the value of an option.
void addCompletions(const CLI::App& app, std::string& commands, std::string& values,
                    std::string& names) {
  const std::string name = fullName(app);
  if (app.get_parent()) names += (names.empty() ? "'" : " | '") + name + "'";
  commands += "    '" + name + "') offered='" + completionsOf(app) + "' ;;\n";
  for (const CLI::Option* option : app.get_options()) {
    std::string type = typeOf(*option);
    if (option->get_items_expected_max() == 0 || type.find('|') == std::string::npos ||
        std::ranges::any_of(type, [](unsigned char c) { return std::isupper(c); }) ||
        type.find_first_of("[]{}") != std::string::npos) {
      continue;
    }
    std::ranges::replace(type, '|', ' ');
    for (const std::string& one : option->get_lnames()) {
      values += "    '" + name + " --" + one + "') offered='" + type + "' ;;\n";
    }
  }
  for (const CLI::App* command : commandsOf(app)) {
    addCompletions(*command, commands, values, names);
  }
}

}  // namespace

std::string completionScript(const CLI::App& app, std::string_view shell) {
  if (shell != "bash" && shell != "zsh") return {};
  std::string commands, values, names;
  addCompletions(app, commands, values, names);
  const std::string& program = app.get_name();
  std::string function = "_" + program;
  std::ranges::replace(function, '-', '_');
  const bool bash = shell == "bash";
  std::string out = bash ? "# bash completion of " + program + "\n" : "#compdef " + program + "\n";
  // Finds the command by the arguments that are commands, then offers what belongs to it.
  out += function + "() {\n  local command=" + program + " word offered=''\n";
  out += bash ? "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
                "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
              : "  local current=$words[CURRENT] before=$words[CURRENT-1]\n"
                "  for word in ${words[2,CURRENT-1]}; do\n";
  out += "    case \"$command $word\" in\n";
  if (!names.empty()) out += "      " + names + ") command=\"$command $word\" ;;\n";
  out += "      *) ;;\n    esac\n  done\n  case \"$command $before\" in\n" + values +
         "    *) ;;\n  esac\n  if [[ -z $offered ]]; then case $command in\n" + commands +
         "    *) ;;\n  esac; fi\n";
  out += bash ? "  mapfile -t COMPREPLY < <(compgen -W \"$offered\" -- \"$current\")\n"
                "  [[ ${#COMPREPLY[@]} -gt 0 ]] ||\n"
                "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
                "}\ncomplete -o filenames -F " +
                    function + ' ' + program + '\n'
              : "  compadd -- ${=offered}\n  [[ $current == -* ]] || _files\n}\n" + function +
                    " \"$@\"\n";
  return out;
}

}  // namespace pitchboard::shared

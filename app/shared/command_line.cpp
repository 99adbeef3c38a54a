// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/command_line.h>
#include <app/usage.h>

#include <cerrno>
#include <charconv>
#include <cstdio>

#include <base/system_reason.h>
#include <base/time_text.h>

namespace pitchboard::shared {

int reportError(const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.text().c_str());
  return exitRefused;
}

Error outputError(int reason) {
  return {ErrorCode::SystemError,
          "Cannot write to standard output" +
              (reason == 0 ? std::string() : ": " + systemReason(reason)) +
              ". The output is incomplete.",
          {}};
}

int checkOutput(int exitCode) {
  const bool wasWritten = std::ferror(stdout) == 0;
  const int reason = std::fflush(stdout) == 0 ? 0 : errno;
  // A command that failed has said why, which may be this.
  if ((wasWritten && reason == 0) || exitCode == exitRefused) return exitCode;
  return reportError(outputError(reason));
}

std::optional<int> parse(CLI::App& app, int argc, char** argv,
                         const std::map<std::string, std::string>& window) {
  addHelp(app);
  app.add_option_function<std::string>(
         "--completion",
         [&app](const std::string& shell) {
           std::string script = completionScript(app, shell);
           if (script.empty()) throw CLI::ValidationError("--completion must be bash or zsh");
           script.pop_back();
           throw CLI::CallForVersion(script, 0);  // prints it and ends the program
         },
         "Print a script for bash or zsh that completes commands and options")
      ->type_name("bash|zsh")
      ->group("");
  app.add_option_function<std::string>(
         "--option-list",
         [&](const std::string& name) {
           const CLI::App* listed = name == app.get_name() ? &app : nullptr;
           for (const CLI::App* command : app.get_subcommands({})) {
             if (command->get_name() == name) listed = command;
           }
           if (listed == nullptr) throw CLI::ValidationError("--option-list must be a command");
           std::string lines;
           for (const CLI::Option* option : listed->get_options()) {
             if (option->get_lnames().empty()) continue;
             const auto text = window.find(option->get_name());
             lines += (lines.empty() ? "" : "\n") + option->get_name() +
                      (option->get_items_expected_max() == 0 ? " flag " : " value ") +
                      (text == window.end() ? "" : text->second);
           }
           throw CLI::CallForVersion(lines, 0);
         },
         "Print the options of a command for scripts")
      ->group("");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    std::fprintf(stderr, "error: %s\nRun \"%s --help\" for the options and examples.\n",
                 problemText(app, error).c_str(), fullName(*command).c_str());
    return exitRefused;
  }
  return {};
}

std::optional<double> numberFrom(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || rest != end) return {};
  return value;
}

Result<double> speedFrom(const std::string& text) {
  constexpr double slowest = 0.01, fastest = 1000.0;
  if (text == "max") return 0.0;
  const std::optional<double> speed = numberFrom(text);
  if (speed && *speed >= slowest && *speed <= fastest) return *speed;
  return failure(ErrorCode::InvalidArgument,
                 "--speed must be a number from 0.01 to 1000, or max, not \"" + text + '"');
}

CLI::Option* addDuration(CLI::App& command, const std::string& name, std::optional<double>& seconds,
                         const std::string& description) {
  const auto read = [name, &seconds](const std::string& text) {
    seconds = secondsFromText(text);
    if (!seconds) seconds = numberFrom(text);  // programs write 1e3, too
    if (!seconds) {
      throw CLI::ValidationError(name + " must be a time, not \"" + text.substr(0, 40) +
                                 "\"; write " + timeForms);
    }
    if (!(*seconds > 0.0 && *seconds <= 1e9)) {
      throw CLI::ValidationError(name + " must be above 0 and at most 1e9 seconds");
    }
  };
  return command.add_option_function<std::string>(name, read, description + ". Write " + timeForms)
      ->type_name("T");
}

}  // namespace pitchboard::shared

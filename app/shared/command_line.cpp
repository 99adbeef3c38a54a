// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/command_line.h>

#include <charconv>
#include <cstdio>

namespace pitchboard::shared {

int reportError(const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.text().c_str());
  return exitRefused;
}

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::fprintf(stderr, "error: %s\nRun with --help for the options and an example.\n",
                 error.what());
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

}  // namespace pitchboard::shared

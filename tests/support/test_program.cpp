// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_program.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

namespace {

using Run = int (*)(int argc, char** argv);

std::map<std::string, Run>& registeredTests() {
  static std::map<std::string, Run> tests;
  return tests;
}

}  // namespace

bool pitchboard::tests::registerTest(const char* file, Run run) {
  return registeredTests().emplace(std::filesystem::path(file).stem().string(), run).second;
}

int main(int argc, char** argv) {
  const auto& tests = registeredTests();
  const auto chosen = argc > 1 ? tests.find(argv[1]) : tests.end();
  if (chosen == tests.end()) {
    if (argc > 1) std::fprintf(stderr, "error: there is no test \"%s\" here\n", argv[1]);
    std::fprintf(stderr, "Usage: %s TEST [OPTION OF QTEST...] [FUNCTION...]\nTests:\n", argv[0]);
    for (const auto& test : tests) std::fprintf(stderr, "  %s\n", test.first.c_str());
    return 2;
  }
  argv[1] = argv[0];
  return chosen->second(argc - 1, argv + 1);
}

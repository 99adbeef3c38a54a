// SPDX-License-Identifier: GPL-3.0-or-later
// What is to run: one of our processes, a behaviour, a runtime profile, or a program.
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <base/lined_json.h>
#include <base/system_reason.h>
#include <base/try.h>
#include <robotlink/processes/runtime_profile.h>

#include "rerun_program.h"

namespace pitchboard::link {
namespace {

bool isFile(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
}

bool isInPath(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((folder + '/' + name).c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> out;
  for (std::string word; words >> word;) out.push_back(word);
  return out;
}

/// Fails if there is no such program; a script that is not executable gets its interpreter.
Result<void> findProgram(RerunChoice& choice, const RerunProcess& process) {
  std::string& first = choice.command.front();
  if (isFile(first)) {
    if (first.find('/') == std::string::npos) first.insert(0, "./");
    if (::access(first.c_str(), X_OK) == 0) return {};
    if (first.ends_with(".py")) {
      choice.command.insert(choice.command.begin(), "python3");
      return {};
    }
    return failure(ErrorCode::InvalidArgument,
                   "Cannot run " + first + ": " + systemReason(EACCES) + ". Try chmod +x.",
                   "--process " + process.name);
  }
  if (first.find('/') == std::string::npos && isInPath(first)) return {};
  std::vector<std::string_view> names{referenceProgram};
  if (process.name == "decision") {
    for (const BehaviourInfo& behaviour : behaviours()) names.push_back(behaviour.name);
  }
  return failure(ErrorCode::NotFound,
                 unknownName("program or behaviour", process.program, names) +
                     "; files are looked for in " + std::filesystem::current_path().string() +
                     " and beside the recording.",
                 "--process " + process.name);
}

Result<RerunChoice> fromProfile(RerunChoice choice, const RerunProcess& process) {
  const RuntimeChoice runtime = TRY(runtimeChoiceFromText(process.program));
  const RuntimeProfile profile = TRY(loadRuntime(runtime));
  const auto found = std::ranges::find(profile.processes, process.name, &ProfileProcess::name);
  if (found == profile.processes.end()) {
    std::vector<std::string_view> names;
    for (const ProfileProcess& one : profile.processes) names.push_back(one.name);
    return failure(ErrorCode::NotFound, unknownName("process", process.name, names),
                   "the runtime profile " + profile.name);
  }
  choice.cycle = profile.cycle;
  if (found->isReference()) {
    choice.isInside = true;
    return choice;
  }
  choice.command = found->command;
  choice.directory = found->directory;
  choice.environment = found->environment;
  choice.responseTimeout = found->responseTimeout;
  choice.realClock = found->clock == ProfileProcess::Clock::Real;
  for (std::string& word : choice.command) {
    for (const auto& [name, value] : profile.values) {
      const std::string mark = "${" + name + "}";
      for (std::size_t at = word.find(mark); at != std::string::npos; at = word.find(mark)) {
        word.replace(at, mark.size(), value);
      }
    }
  }
  return choice;
}

}  // namespace

std::string besideRecording(const std::string& program, const std::string& session) {
  if (program.empty() || program.front() == '/' || isFile(program)) return program;
  const auto beside = std::filesystem::absolute(session).parent_path() / program;
  return isFile(beside.string()) ? beside.string() : program;
}

Result<RerunChoice> rerunChoice(const RerunProcess& process, const RerunRobot& robot) {
  RerunChoice choice;
  choice.process = process.name;
  const std::string& text = process.program;
  if (text.empty()) {
    return failure(
        ErrorCode::InvalidArgument,
        "Say what runs as " + process.name + ": " + process.name + "=reference, or a program.",
        "--process");
  }
  const std::size_t colon = text.find(':');
  if (text.substr(0, colon).ends_with(".json") && text.front() != '{') {
    choice = TRY(fromProfile(std::move(choice), process));
    if (!choice.isInside) return choice;
  }
  const bool isBehaviour =
      process.name == "decision" && (text.front() == '{' || findBehaviour(text) != nullptr);
  choice.isInside = choice.isInside || text == referenceProgram || isBehaviour;
  if (choice.isInside && !findProcess(process.name)) {
    std::vector<std::string_view> names;
    for (const ProcessInfo& info : referenceProcesses()) names.push_back(info.name);
    return failure(ErrorCode::NotFound, unknownName("reference process", process.name, names),
                   "--process");
  }
  if (isBehaviour) {
    choice.behaviour = TRY(behaviourFromText(text, "--process decision"));
    choice.hasBehaviour = true;
  }
  if (choice.isInside) {
    if (process.name == "decision" && !choice.hasBehaviour && !findBehaviour(robot.behaviour)) {
      return failure(ErrorCode::InvalidArgument,
                     "The recording does not say which behaviour this robot had; name one, for "
                     "example decision=striker, or a program.",
                     "--process");
    }
    return choice;
  }
  choice.command = isFile(text) ? std::vector<std::string>{text} : wordsOf(text);
  if (choice.command.empty()) choice.command = {text};
  const bool hasValue = text.find("${") != std::string::npos;
  TRY(findProgram(choice, process));
  if (!hasValue) choice.command.emplace_back("${key}");
  return choice;
}

}  // namespace pitchboard::link

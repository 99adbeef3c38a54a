// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/processes/runtime_profile.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>

#include <base/lined_json.h>
#include <base/read_file.h>
#include <base/short_name.h>
#include <base/try.h>
#include <resources/resources.h>
#include <robotlink/blackboard/cycle_words.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t maxProfileBytes = mebibyte;
constexpr std::size_t maxProcesses = 8;  // of a robot
constexpr std::size_t maxArguments = 100;
constexpr std::size_t longestText = 4096;
constexpr std::size_t maxProcessNameLength = 32;
constexpr double maxTime = 3600.0;  // s

constexpr std::array<std::string_view, 3> policies{"never", "on_failure", "always"};
constexpr std::array<std::string_view, 2> clocks{"match", "real"};
constexpr std::array<std::string_view, 2> refereeReaders{"match", "own"};
constexpr std::array<std::string_view, 6> conditions{"everyone", "behaviour", "pose",
                                                     "separate", "target",    "advised"};

const std::vector<std::string_view>& runtimeNames() {
  static const auto all = resourceNames("runtime", {referenceRuntime, ownRuntime});
  return all;
}

struct SignalName {
  std::string_view name;
  int number;
};
constexpr std::array<SignalName, 6> stopSignals{{{"TERM", SIGTERM},
                                                 {"INT", SIGINT},
                                                 {"HUP", SIGHUP},
                                                 {"QUIT", SIGQUIT},
                                                 {"USR1", SIGUSR1},
                                                 {"KILL", SIGKILL}}};

class Reader {
 public:
  Reader(const JsonNode& root, JsonReport& report)
      : m_report(report),
        m_root(report, root, "",
               {"version", "name", "title", "description", "values", "referee", "cycle", "program",
                "processes"}) {}

  RuntimeProfile read() {
    m_root.require("version");
    (void)m_root.integer("version", 1, 1, 1);
    m_root.require("name");
    m_profile.name = readShortName(m_root, "name", "");
    m_profile.title = m_root.text("title", m_profile.name, 200);
    m_profile.description = m_root.text("description", "", 5000);
    for (auto& [name, value] : texts(m_root, "values")) m_profile.values[name] = value;
    m_profile.readsReferee = m_root.choice("referee", refereeReaders, "value") == std::size_t{1};
    m_profile.cycle = m_root.text("cycle", "", 200);
    m_profile.program = m_root.text("program", "", longestText);
    m_root.require("processes");
    const auto* items = m_root.array("processes", maxProcesses);
    for (std::size_t i = 0; items && i < items->size() && !m_report.failed(); ++i) {
      readProcess((*items)[i], m_root.pathOf("processes", i));
    }
    return std::move(m_profile);
  }

 private:
  std::vector<std::pair<std::string, std::string>> texts(const JsonObject& parent,
                                                         std::string_view key) {
    std::vector<std::pair<std::string, std::string>> out;
    const JsonNode* node = parent.find(key);
    if (!node || m_report.failed()) return out;
    const JsonObject object(m_report, *node, parent.pathOf(key));
    if (m_report.failed()) return out;
    for (const auto& [name, value] : object.members()) {
      out.emplace_back(name, object.text(name, "", longestText));
    }
    return out;
  }

  void readProcess(const JsonNode& node, const std::string& path) {
    const JsonObject object(
        m_report, node, path,
        {"name", "reference", "command", "directory", "environment", "delay", "heartbeat",
         "response_timeout", "silent_after", "restart", "first_wait", "longest_wait",
         "steady_after", "give_up_after", "stop_signal", "watch_program", "only_for", "clock"});
    if (m_report.failed()) return;
    ProfileProcess process;
    object.require("name");
    process.name = readShortName(object, "name", "", maxProcessNameLength);
    for (const ProfileProcess& other : m_profile.processes) {
      if (other.name == process.name) object.fail("name", "is listed twice in \"processes\"");
    }
    process.reference = object.text("reference", "", 32);
    readCommand(object, process);
    process.directory = object.text("directory", "", longestText);
    process.environment = texts(object, "environment");
    process.delay = object.number("delay", process.delay, {0, maxTime, "seconds"});
    process.heartbeat = object.text("heartbeat", "", 200);
    // Version 0.8 wrote "silent_after".
    for (const char* key : {"silent_after", "response_timeout"}) {
      process.responseTimeout =
          object.number(key, process.responseTimeout, {0.1, maxTime, "seconds"});
    }
    readRestart(object, process.restart);
    std::vector<std::string_view> names;
    for (const SignalName& signal : stopSignals) names.push_back(signal.name);
    if (const auto signal = object.choice("stop_signal", names, "signal")) {
      process.stopSignal = stopSignals[*signal].number;
    }
    process.watchFile = object.boolean("watch_program", false);
    if (const auto condition = object.choice("only_for", conditions, "condition")) {
      process.onlyFor = static_cast<ProfileProcess::OnlyFor>(*condition);
    }
    if (const auto clock = object.choice("clock", clocks, "clock")) {
      process.clock = static_cast<ProfileProcess::Clock>(*clock);
      if (process.isReference()) {
        object.fail("clock",
                    "is for a process with \"command\"; a reference process takes its "
                    "time from the match");
      }
    }
    m_profile.processes.push_back(std::move(process));
  }

  void readCommand(const JsonObject& object, ProfileProcess& process) {
    const auto* arguments = object.array("command", maxArguments);
    for (std::size_t i = 0; arguments && i < arguments->size(); ++i) {
      const JsonNode& argument = (*arguments)[i];
      if (argument.kind != JsonNode::Kind::Text || argument.text.size() > longestText) {
        m_report.fail(argument.line, object.pathOf("command", i), "must be a text in quotes");
        return;
      }
      process.command.push_back(argument.text);
    }
    if (process.isReference() == !process.command.empty()) {
      object.fail(process.isReference() ? "command" : "name",
                  "needs either \"reference\", a process of pitchboard-robot, or \"command\", a "
                  "list of program and arguments");
    } else if (!process.isReference() && process.command.front().empty()) {
      object.fail("command", "must name a program");
    }
  }

  static void readRestart(const JsonObject& object, RestartRule& rule) {
    if (const auto policy = object.choice("restart", policies, "restart policy")) {
      rule.policy = static_cast<RestartPolicy>(*policy);
    }
    const auto seconds = [&object](std::string_view key, RestartRule::Seconds& value) {
      value = RestartRule::Seconds(object.number(key, value.count(), {0.01, maxTime, "seconds"}));
    };
    seconds("first_wait", rule.firstWait);
    seconds("longest_wait", rule.maxWait);
    seconds("steady_after", rule.steadyAfter);
    rule.giveUpAfter = object.integer("give_up_after", rule.giveUpAfter, 0, 1'000'000);
  }

  JsonReport& m_report;
  JsonObject m_root;
  RuntimeProfile m_profile;
};

Result<RuntimeProfile> named(const std::string& nameOrPath) {
  const std::string name = nameOrPath.empty() ? std::string(referenceRuntime) : nameOrPath;
  if (std::ranges::find(runtimeNames(), name) != runtimeNames().end()) {
    return runtimeProfileFromJson(resourceText("runtime/" + name + ".json"), name);
  }
  if (name.find_first_of("/.") == std::string::npos) {
    return failure(ErrorCode::NotFound,
                   unknownName("built-in runtime profile and no file", name, runtimeNames()));
  }
  // A program without a folder would be looked for in PATH.
  const std::string asProgram = "it is a program, write program=" +
                                (name.find('/') == std::string::npos ? "./" + name : name);
  const bool isProfile = name.ends_with(".json");
  const auto text = readFile(name, maxProfileBytes, "the runtime profile");
  if (!text) {
    if (isProfile) return tl::unexpected(text.error());
    return failure(text.error().code, text.error().message + " If " + asProgram, name);
  }
  auto profile = runtimeProfileFromJson(*text, name);
  if (!profile) {
    if (isProfile) return profile;
    return failure(ErrorCode::ParseError, "is not a runtime profile; if " + asProgram, name);
  }
  // A folder, and a program with a folder, are meant from where the profile lies.
  const std::filesystem::path here = std::filesystem::path(name).parent_path();
  const auto fromHere = [&here](std::string& path) {
    if (!path.empty() && path.front() != '/' && path.front() != '$') path = (here / path).string();
  };
  if (profile->program.find('/') != std::string::npos) fromHere(profile->program);
  for (ProfileProcess& process : profile->processes) {
    fromHere(process.directory);
    if (!process.isReference() && process.command.front().find('/') != std::string::npos) {
      fromHere(process.command.front());
    }
  }
  return profile;
}

}  // namespace

bool RuntimeProfile::hasOwn() const {
  return processes.empty() ||
         std::ranges::any_of(processes, [](const auto& one) { return !one.isReference(); });
}

bool RuntimeProfile::usesExtension() const {
  return std::ranges::any_of(processes,
                             [](const auto& one) { return one.reference == "decision"; });
}

Result<RuntimeProfile> runtimeProfileFromJson(std::string_view text, std::string_view source) {
  JsonReport report(source);
  const auto root = parseJson(text, report, maxProfileBytes);
  if (report.failed()) return tl::unexpected(report.error());
  RuntimeProfile profile = Reader(*root, report).read();
  if (report.failed()) return tl::unexpected(report.error());
  return profile;
}

Result<RuntimeProfile> loadRuntime(const RuntimeChoice& choice) {
  auto profile = named(choice.profile);
  if (!profile) return profile;
  for (const auto& [name, value] : choice.values) {
    const auto known = profile->values.find(name);
    if (known == profile->values.end()) {
      std::vector<std::string_view> names;
      for (const auto& [one, unused] : profile->values) names.push_back(one);
      return failure(
          ErrorCode::NotFound,
          names.empty() ? "has no values to set, so no " + name : unknownName("value", name, names),
          "the runtime profile " + profile->name);
    }
    known->second = value;
  }
  if (const auto words = profile->values.find(announceCyclesValue);
      words != profile->values.end() && !words->second.empty()) {
    TRY(cycleWordsFromText(words->second, announceCyclesValue));
  }
  auto expandedProgram = expanded(profile->program, profile->values);
  if (!expandedProgram) {
    expandedProgram.error().context = "the runtime profile " + profile->name + ", program";
    return tl::unexpected(expandedProgram.error());
  }
  profile->program = std::move(*expandedProgram);
  if (choice.decision.empty()) return profile;
  ProfileProcess program;
  program.name = "decision";
  program.command = {choice.decision, "${key}"};
  program.watchFile = true;
  const auto decision = std::ranges::find(profile->processes, "decision", &ProfileProcess::name);
  if (decision == profile->processes.end()) {
    profile->processes.push_back(std::move(program));
  } else {
    *decision = std::move(program);
  }
  return profile;
}

Result<std::string> expanded(std::string_view text,
                             const std::map<std::string, std::string>& values) {
  std::string out;
  while (true) {
    const std::size_t begin = text.find("${");
    out += text.substr(0, begin);
    if (begin == std::string_view::npos) return out;
    const std::size_t end = text.find('}', begin);
    const std::string name(text.substr(begin + 2, end - begin - 2));
    const auto value = values.find(name);
    if (end == std::string_view::npos || value == values.end()) {
      std::vector<std::string_view> known;
      for (const auto& [one, unused] : values) known.push_back(one);
      return failure(ErrorCode::NotFound, unknownName("value ${...} for", name, known));
    }
    if (value->second.empty() && name == "folder") {
      return failure(ErrorCode::InvalidArgument,
                     "needs to know its folder; add for example :folder=/home/robot");
    }
    out += value->second;
    text.remove_prefix(end + 1);
  }
}

Result<RuntimeChoice> runtimeChoiceFromText(std::string_view text) {
  constexpr std::string_view program = "program=";
  RuntimeChoice choice;
  const auto take = [&choice](std::string_view part) {
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos || equals == 0) return false;
    const std::string name(part.substr(0, equals));
    (name == "program" ? choice.decision : choice.values[name]) = part.substr(equals + 1);
    return true;
  };
  std::string_view rest;
  if (text.starts_with(program)) {
    rest = text;
  } else {
    const std::size_t colon = text.find(':');
    if (text.substr(0, colon) == "program" && colon != std::string_view::npos) {
      return failure(ErrorCode::ParseError, "write program=" + std::string(text.substr(colon + 1)));
    }
    choice.profile = text.substr(0, colon);
    if (colon != std::string_view::npos) rest = text.substr(colon + 1);
  }
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    if (!take(rest.substr(0, comma))) {
      return failure(ErrorCode::ParseError,
                     "\"" + std::string(rest.substr(0, comma)) +
                         "\" does not have the form name=value; write for example "
                         "published-tree:folder=/home/robot");
    }
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (!text.empty() && !choice.isChosen()) {
    return failure(ErrorCode::ParseError,
                   "\"" + std::string(text) +
                       "\" names neither a runtime profile nor a program; write for example "
                       "published-tree:folder=/home/robot");
  }
  return choice;
}

std::string runtimeChoiceToText(const RuntimeChoice& choice) {
  std::string rest;
  const auto add = [&rest](const std::string& name, const std::string& value) {
    rest += (rest.empty() ? "" : ",") + name + '=' + value;
  };
  if (!choice.decision.empty()) add("program", choice.decision);
  for (const auto& [name, value] : choice.values) add(name, value);
  if (rest.empty() || choice.profile.empty()) return choice.profile + rest;
  return choice.profile + ':' + rest;
}

}  // namespace pitchboard::link

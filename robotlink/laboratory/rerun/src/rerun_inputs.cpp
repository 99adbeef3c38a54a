// SPDX-License-Identifier: GPL-3.0-or-later
#include "rerun_inputs.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>

#include <base/try.h>
#include <base/wildcard.h>

#include "message_feed.h"
#include "team_mates.h"

namespace pitchboard::link {
namespace {

constexpr std::size_t maxNamed = 12;

std::vector<std::string> splitNames(std::string_view text) {
  std::istringstream words{std::string(text)};
  std::vector<std::string> out;
  for (std::string word; words >> word;) out.push_back(word);
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < maxNamed; ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > maxNamed) {
    text += " and " + std::to_string(names.size() - maxNamed) + " more";
  }
  return text;
}

/// "There is no robot "B9". There are: B1, B2."
std::string notAmong(const char* what, const std::string& name,
                     const std::set<std::string>& known) {
  std::string text = std::string("There is no ") + what + " \"" + name + "\". There are: ";
  const char* between = "";
  for (const std::string& one : known) text += std::exchange(between, ", ") + one;
  return text + '.';
}

/// The processes that write variables of this map.
std::set<std::string> writersOf(const VariableCatalog& catalog) {
  std::set<std::string> writers;
  for (const Variable& variable : catalog.variables()) {
    auto writer = VariableMeanings::published().writers(variable.name).writer;
    if (!writer.empty()) writers.insert(std::move(writer));
  }
  return writers;
}

/// Why this process of ours cannot run again although it is chosen; empty if it can.
std::string whyNotAgain(const telemetry::SessionReader& session, const RecordedRobot& recorded,
                        const RerunChoice& choice) {
  const std::string_view more = findProcess(choice.process)->receives;
  if (!choice.isInside || more.empty()) return {};
  const std::string gets = choice.process + " also gets " + std::string(more);
  if (choice.process != "team") {
    if (recorded.scenario) {
      return gets + ", which in a simulated match the match itself hands to its robots.";
    }
    return MessageFeed::refereeTeam(session, recorded)
               ? std::string()
               : gets +
                     ", and this recording has none for this robot's team; record --live receives "
                     "them.";
  }
  return TeamMates::areRecorded(session, recorded)
             ? std::string()
             : gets +
                   ", and this recording has no blackboard of a team-mate, from which they "
                   "could be made again; record those, too.";
}

/// Whether a process of a profile ran on this robot.
bool ranHere(const ProfileProcess& process, const RecordedRobot& recorded) {
  using OnlyFor = ProfileProcess::OnlyFor;
  const BehaviourInfo* behaviour = findBehaviour(recorded.robot.behaviour);
  switch (process.onlyFor) {
    case OnlyFor::Everyone:
    case OnlyFor::Separate:
      return true;
    case OnlyFor::Behaviour:
      return behaviour != nullptr;
    case OnlyFor::Pose:
    case OnlyFor::Target:
      return behaviour != nullptr && behaviour->usesPose;
    case OnlyFor::Advised:
      return recorded.scenario && !recorded.scenario->advisors.empty() &&
             recorded.robot.behaviour == "keeper";
  }
  return true;
}

Result<void> addOne(const telemetry::SessionReader& session, const RecordedRobot& recorded,
                    const RerunOptions& options, const RerunProcess& process, bool isWhole,
                    RerunChoices& out) {
  if (std::ranges::find(out.processes, process.name, &RerunProcess::name) != out.processes.end()) {
    return failure(ErrorCode::InvalidArgument, process.name + " is there twice", "--process");
  }
  const std::set<std::string> known = writersOf(recorded.catalog);
  const bool writes = known.count(process.name) > 0;
  if (!writes && options.writes.empty() && !isWhole) {
    return failure(ErrorCode::NotFound,
                   notAmong("process", process.name, known) +
                       " For another one, name its variables with --writes.",
                   "--process");
  }
  RerunChoice choice = TRY(rerunChoice(process, recorded.robot));
  if (std::string why = choice.isInside ? whyNotAgain(session, recorded, choice) : std::string();
      !why.empty()) {
    if (!isWhole) return failure(ErrorCode::Unsupported, why, "--process");
    out.notes.push_back(why + " What it wrote is fed as recorded.");
    return {};
  }
  if (!writes && isWhole && options.writes.empty()) {
    out.notes.push_back("No variable is known to be written by " + process.name +
                        "; name them with --writes if it writes some.");
  }
  const std::string& file = session.file().contents().name;
  const std::string before = recorded.programOf(process.name, file);
  if (options.isUnchanged && choice.isInside && !before.empty() && before != referenceProgram) {
    return failure(ErrorCode::InvalidArgument,
                   "In this recording " + process.name + " was " + before + ", so \"" +
                       process.program + "\" is not the unchanged program.",
                   "--process");
  }
  out.processes.push_back(process);
  out.choices.push_back(std::move(choice));
  return {};
}

/// What a process uses, as patterns; empty: unknown.
std::vector<std::string> readsOf(const RerunChoice& choice, const RerunRobot& robot) {
  if (!choice.isInside) return {};
  const BehaviourInfo* behaviour = choice.process != "decision" ? nullptr
                                   : choice.hasBehaviour ? findBehaviour(choice.behaviour.name)
                                                         : findBehaviour(robot.behaviour);
  return splitNames(behaviour ? behaviour->reads : findProcess(choice.process)->reads);
}

/// The variables that a process uses, all if it is not known.
std::vector<std::string> inputsOf(const RecordedRobot& recorded, const RerunChoice& choice) {
  const std::vector<std::string> reads = readsOf(choice, recorded.robot);
  const bool known = !reads.empty();
  std::vector<std::string> inputs;
  for (const Variable& variable : recorded.catalog.variables()) {
    // What only our processes use is no loss for a team's program, and nobody has written what
    // an advisor writes in a match without one.
    const bool isExtension = !VariableCatalog::published().find(variable.name) &&
                             VariableCatalog::extended().find(variable.name);
    const bool isUnused = recorded.scenario && recorded.scenario->advisors.empty() &&
                          VariableMeanings::published().writers(variable.name).writer == "advisor";
    const bool fits = !known || std::ranges::any_of(reads, [&](const std::string& pattern) {
      return fitsWildcard(pattern, variable.name);
    });
    if (!isUnused && fits && (known || !isExtension)) inputs.push_back(variable.name);
  }
  return inputs;
}

}  // namespace

Result<RerunChoices> chooseProcesses(const telemetry::SessionReader& session,
                                     const RecordedRobot& recorded, const RerunOptions& options) {
  if (options.processes.empty()) {
    return failure(ErrorCode::InvalidArgument,
                   "Say which process runs again, for example --process decision=reference.");
  }
  RerunChoices out;
  for (const RerunProcess& process : options.processes) {
    if (!process.name.empty()) {
      TRY(addOne(session, recorded, options, process, false, out));
      continue;
    }
    const RuntimeChoice runtime = TRY(runtimeChoiceFromText(process.program));
    const RuntimeProfile profile = TRY(loadRuntime(runtime));
    for (const ProfileProcess& one : profile.processes) {
      if (!ranHere(one, recorded)) continue;
      TRY(addOne(session, recorded, options, {one.name, process.program}, true, out));
    }
    if (out.choices.empty()) {
      return failure(ErrorCode::InvalidArgument,
                     "Nothing of the runtime profile " + profile.name + " can run again." +
                         (out.notes.empty() ? std::string() : " " + out.notes.front()),
                     "--process");
    }
  }
  std::ranges::stable_sort(out.choices, {}, [](const RerunChoice& choice) {
    return choice.isInside ? turnOf(choice.process) : lastTurn;
  });
  return out;
}

Result<RerunInputs> checkInputs(const RecordedRobot& recorded,
                                const std::vector<RerunChoice>& choices, const Feed& feed,
                                const std::vector<std::string>& exact) {
  RerunInputs found;
  for (const RerunChoice& choice : choices) {
    const std::vector<std::string> inputs = inputsOf(recorded, choice);
    const auto missing = feed.missing(inputs, recorded.hasWorld);
    const auto sampled = feed.sampled(inputs, recorded.hasWorld);
    if (sampled.empty() && !recorded.hasWorld) {
      const bool known = !readsOf(choice, recorded.robot).empty();
      return failure(ErrorCode::InvalidArgument,
                     "This recording has no variable that " + choice.process + " reads" +
                         (known ? " (" + listed(missing) + ")" : std::string()) +
                         "; record the robot's blackboard, for example with pitchboard-agent.");
    }
    if (!missing.empty()) {
      found.missing.insert(found.missing.end(), missing.begin(), missing.end());
      found.notes.push_back("Not recorded, so " + choice.process + " reads 0: " + listed(missing) +
                            ".");
    }
    const bool isExact = std::ranges::find(exact, choice.process) != exact.end();
    const bool coarse =
        !isExact && (!recorded.hasWorld || recorded.rowInterval > 1.5 / recorded.tickRate);
    if (coarse) found.sampled.insert(found.sampled.end(), sampled.begin(), sampled.end());
  }
  for (const auto& [name, tells] : feed.undecided()) {
    found.notes.push_back(name + " is not compared: two processes write it, and " + tells +
                          ", which tells which one, was not recorded.");
  }
  if (!found.sampled.empty()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0f", 1000.0 * recorded.rowInterval);
    found.notes.push_back(
        "The recording has a row every " + std::string(text) +
        " ms. Changes in between are missing, so differences may come from the recording: " +
        listed(found.sampled) + ".");
  }
  return found;
}

}  // namespace pitchboard::link

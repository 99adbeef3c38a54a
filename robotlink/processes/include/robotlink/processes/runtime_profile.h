// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Who runs for a robot: a list of processes, how each is started, watched and ended. JSON
// (docs/robot-programs.md), built in or a file of a team; separate processes and those that run
// inside understand the same profile. Plain values; times are seconds of the wall. Any thread.

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

enum class RestartPolicy { Never, OnFailure, Always };

/// When a process that ended, or that shows no sign of life, is started again.
struct RestartRule {
  using Seconds = std::chrono::duration<double>;
  RestartPolicy policy = RestartPolicy::Always;
  Seconds firstWait{0.2};     ///< before the first restart; then twice as long every time
  Seconds longestWait{10.0};  ///< and never longer
  Seconds steadyAfter{30.0};  ///< of work: it counts as sound again
  int giveUpAfter = 0;        ///< restarts without such work in between; 0 = never
  bool operator==(const RestartRule&) const = default;
};

struct ProfileProcess {
  /// What must hold for it to be started at all.
  enum class OnlyFor {
    Everyone,
    Behaviour,  ///< not for a robot without a behaviour of ours
    Pose,       ///< only for behaviours that use the pose
    Separate,   ///< not where processes run inside the program
    Target,     ///< only for behaviours of ours, whose decision says where to walk
    Advised     ///< only for robots of a team that thinks ahead
  };
  /// Whose time a team program's clocks tell.
  enum class Clock {
    Match,  ///< the match's, at every speed
    Real    ///< the computer's: nothing is loaded into the program
  };

  std::string name;
  std::string reference;             ///< a process of pitchboard-robot; else `command` is run
  std::vector<std::string> command;  ///< program and arguments, with ${robot} and the like
  std::string directory;             ///< to run in; empty: that of the program that starts it
  std::vector<std::pair<std::string, std::string>> environment;  ///< added
  double delay = 0.0;      ///< s after the start of the one before it
  std::string heartbeat;   ///< variable that it keeps setting; empty: nobody listens for it
  double silentAfter = 5;  ///< s
  RestartRule restart;
  int stopSignal = 15;     ///< SIGTERM
  bool watchFile = false;  ///< starts again when its program is replaced
  OnlyFor onlyFor = OnlyFor::Everyone;
  Clock clock = Clock::Match;
  bool isReference() const { return !reference.empty(); }
  bool operator==(const ProfileProcess&) const = default;
};

struct RuntimeProfile {
  std::string name, title, description;
  std::map<std::string, std::string> values;  ///< of ${...} in commands; a choice may set them
  std::vector<ProfileProcess> processes;      ///< in the order of starting
  bool hearsReferee = false;  ///< one of them writes COM_REFEREE; else a refereed match does
  /// Variable in which one of them says that it has finished its cycle, so that the match waits for
  /// it (docs/robot-programs.md); may hold ${...}; empty: nobody is waited for.
  std::string cycle;
  /// The pitchboard-robot of its reference processes, which are separate then; empty: the match's.
  std::string program;
  /// It has programs that are not ours, or leaves the robot to somebody else's.
  bool hasOwn() const;
  /// Its decision is ours, which knows the extension of the map.
  bool usesExtension() const;
  bool operator==(const RuntimeProfile&) const = default;
};

inline constexpr std::string_view referenceRuntime = "reference";
inline constexpr std::string_view ownRuntime = "own";

/// Which profile, as scenarios, cards and command lines say it.
struct RuntimeChoice {
  std::string profile;                        ///< built-in name or a file; empty: not chosen
  std::map<std::string, std::string> values;  ///< instead of those of the profile
  std::string decision;                       ///< program that runs in place of decision
  bool isChosen() const { return !profile.empty() || !decision.empty(); }
  bool operator==(const RuntimeChoice&) const = default;
};

/// "own", "team.json", "published-tree:folder=/home/robot,python=python2",
/// "program=/home/me/decide".
Result<RuntimeChoice> runtimeChoiceFromText(std::string_view text);
std::string runtimeChoiceToText(const RuntimeChoice& choice);

/// Names of the built-in profiles, the default first.
std::vector<std::string> builtInRuntimes();
/// Errors give file, line and key.
Result<RuntimeProfile> runtimeProfileFromJson(std::string_view text, std::string_view source);
/// A built-in name or a file, with the values of the choice, and its program as decision.
Result<RuntimeProfile> loadRuntime(const RuntimeChoice& choice);

/// `text` with every ${name} replaced; NotFound for a name without a value.
Result<std::string> expanded(std::string_view text,
                             const std::map<std::string, std::string>& values);

}  // namespace pitchboard::link

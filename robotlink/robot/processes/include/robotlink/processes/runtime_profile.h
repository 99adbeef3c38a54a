// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A runtime profile lists the processes of a robot and says how each is started, watched and ended.
// Profiles are JSON (docs/robot-programs.md), built in or files of a team, and apply to separate
// processes and to those inside this program alike. Plain values; times are seconds of real time.
// Any thread.

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

enum class RestartPolicy { Never, OnFailure, Always };

/// When a process that ended or stopped responding is restarted.
struct RestartRule {
  using Seconds = std::chrono::duration<double>;
  RestartPolicy policy = RestartPolicy::Always;
  Seconds firstWait{0.2};     ///< before the first restart; doubles with every restart
  Seconds maxWait{10.0};      ///< upper limit of the wait
  Seconds steadyAfter{30.0};  ///< after this time of work the wait starts with firstWait again
  int giveUpAfter = 0;        ///< restarts without steady work in between; 0: never give up
  bool operator==(const RestartRule&) const = default;
};

struct ProfileProcess {
  /// The condition under which the process is started.
  enum class OnlyFor {
    Everyone,
    Behaviour,  ///< the robot has one of our behaviours
    Pose,       ///< its behaviour uses the pose
    Separate,   ///< processes do not run inside this program
    Target,     ///< it has one of our behaviours, whose decision process sets targets
    Advised     ///< keepers of teams with an advisor
  };
  /// The time that a team program's clocks show.
  enum class Clock {
    Match,  ///< match time, at every speed
    Real    ///< real time; no library is loaded into the program
  };

  std::string name;
  std::string reference;             ///< a process of pitchboard-robot; empty: `command` is run
  std::vector<std::string> command;  ///< program and arguments; ${robot} and the like are expanded
  std::string directory;             ///< working directory; empty: that of the starting program
  std::vector<std::pair<std::string, std::string>> environment;  ///< added to the inherited one
  double delay = 0.0;          ///< s to wait after the start of the previous process
  std::string heartbeat;       ///< variable that the process keeps setting; empty: not watched
  double responseTimeout = 5;  ///< s
  RestartRule restart;
  int stopSignal = 15;     ///< SIGTERM
  bool watchFile = false;  ///< restart when the file of its program is replaced
  OnlyFor onlyFor = OnlyFor::Everyone;
  Clock clock = Clock::Match;
  bool isReference() const { return !reference.empty(); }
  bool operator==(const ProfileProcess&) const = default;
};

struct RuntimeProfile {
  std::string name, title, description;
  std::map<std::string, std::string> values;  ///< defaults for ${...}; a choice may replace them
  std::vector<ProfileProcess> processes;      ///< in the order of starting
  bool readsReferee = false;  ///< a process writes COM_REFEREE; false: a refereed match writes it
  /// Variable in which a process reports the end of each cycle, so that the match waits for it
  /// (docs/robot-programs.md). May contain ${...}; empty: the match waits for no process.
  std::string cycle;
  /// The pitchboard-robot that runs the reference processes, which are then separate; empty: that
  /// of the match.
  std::string program;
  /// Returns whether team programs run for the robot, started by us or by somebody else.
  bool hasOwn() const;
  /// Returns whether its decision process is ours and uses the extension of the variable map.
  bool usesExtension() const;
  bool operator==(const RuntimeProfile&) const = default;
};

inline constexpr std::string_view referenceRuntime = "reference";
inline constexpr std::string_view ownRuntime = "own";

/// Selects a profile, as in scenarios, robot cards and command lines.
struct RuntimeChoice {
  std::string profile;                        ///< built-in name or file; empty: not chosen
  std::map<std::string, std::string> values;  ///< replace values of the profile
  std::string decision;                       ///< program that replaces the decision process
  bool isChosen() const { return !profile.empty() || !decision.empty(); }
  bool operator==(const RuntimeChoice&) const = default;
};

/// Reads texts such as "own", "team.json", "published-tree:folder=/home/robot,python=python2" and
/// "program=/home/me/decide".
Result<RuntimeChoice> runtimeChoiceFromText(std::string_view text);
std::string runtimeChoiceToText(const RuntimeChoice& choice);

/// Reads a profile. Errors name file, line and key.
Result<RuntimeProfile> runtimeProfileFromJson(std::string_view text, std::string_view source);
/// Loads the chosen profile and applies the values and the decision program of the choice.
Result<RuntimeProfile> loadRuntime(const RuntimeChoice& choice);

/// Returns `text` with every ${name} replaced. Error NotFound if a name has no value.
Result<std::string> expanded(std::string_view text,
                             const std::map<std::string, std::string>& values);

}  // namespace pitchboard::link

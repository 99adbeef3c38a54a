// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Runs a recording through a process again: a blackboard of its own gets, at their recorded times,
// all values that other processes wrote; the chosen processes read it and write their outputs,
// which are compared with the recorded ones. What a simulated robot sensed is played again from the
// checkpoints of the session, bit for bit. Our processes and programs that cooperate run in
// lock-step: then unchanged code gives the same outputs to the last bit, if the recording has all
// of its inputs. Times are seconds of the session. Everything is used on one thread, to which
// separate programs belong. Tutorial: docs/tutorial-rerun.md.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/file_target.h>
#include <base/result.h>
#include <robotlink/rerun/compared_variable.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_writer.h>

namespace pitchboard::link {

/// A process that runs again, and what runs as it: "reference" (ours, as it was recorded), a
/// behaviour (decision only), a runtime profile (.json), or a program with its arguments, which may
/// contain ${key} and the like.
struct RerunProcess {
  std::string name;     ///< "decision"; empty: every process of the runtime profile `program`
  std::string program;  ///< "./decide.py"
  bool operator==(const RerunProcess&) const = default;
};

/// Reads "decision=./decide.py", or a runtime profile as runtimeChoiceFromText() does: "team.json".
/// Fails with ParseError.
Result<RerunProcess> rerunProcessFromText(std::string_view text);
/// Returns a RerunProcess::program: the file of that name beside the session's file if there is one
/// and none in the working directory; else the same.
std::string besideRecording(const std::string& program, const std::string& session);

/// What a rerun wrote, from one change of an output to the next, for a comparison with the next
/// rerun of the same recording.
struct RerunOutputs {
  static constexpr std::size_t maxChanges = 4'000'000;  ///< that are kept, of all outputs together
  struct Change {
    double time = 0.0;
    double value = 0.0;
  };
  std::map<std::string, std::vector<Change>, std::less<>> changes;  ///< of each output
  double begin = 0.0, end = 0.0;                                    ///< s, what is known
};

struct RerunOptions {
  std::string robot;  ///< "B1"
  std::vector<RerunProcess> processes;
  std::optional<double> from, until;  ///< what is compared; empty: everything
  /// s before `from` that are played and not compared, because processes remember what happened;
  /// empty: everything in lock-step, otherwise 10 s.
  std::optional<double> warmUp;
  double speed = 0.0;  ///< times real time; 0: as fast as possible
  /// s by which a program may act earlier or later; empty: 0 in lock-step, otherwise 0.5.
  std::optional<double> slack;
  /// The processes are those of the recording; others are refused if the recording tells.
  bool isUnchanged = false;
  bool exact = false;  ///< every distance is a difference, not only those beyond tolerance
  std::vector<std::string> writes;  ///< more variables that the processes write; * for any text
  std::string catalog;              ///< file with the map of variables; empty: that of the session
  std::optional<int> match;  ///< number that gives the key of the blackboard; empty: a free one
  std::string robotProgram;  ///< pitchboard-robot; empty: the one beside this program
  /// Where the unchanged program differs, from an earlier rerun: left out.
  std::vector<ComparedVariable> unchanged;
  /// What the last rerun wrote: RerunResult::sinceLast is the comparison with it. Null: none.
  std::shared_ptr<const RerunOutputs> last;

  /// Called with sentences for people: before the start with what the recording lacks.
  std::function<void(const std::string&)> note;
  /// Called with each line that a separate program prints.
  std::function<void(const std::string&)> print;
  /// Called for each moment that is compared, with a value for each variable.
  std::function<void(double time, std::span<const ComparedVariable>,
                     std::span<const ComparedValue>)>
      compared;
  /// Called about 50 times a second with the share that is done; false cancels.
  std::function<bool(double)> progress;
};

struct RerunResult {
  std::string robot;  ///< "B1"
  std::vector<RerunProcess> processes;
  std::vector<std::string> notes;
  double begin = 0.0, end = 0.0;  ///< what was compared
  bool inLockStep = false;
  double slack = 0.0;
  /// Names of inputs that were recorded less often than the robot's ticks. If there are any, what
  /// differs may come from the recording.
  std::vector<std::string> sampledInputs;
  double rowInterval = 0.0;  ///< s between two rows of the recording
  std::vector<ComparedVariable> variables;
  std::shared_ptr<const RerunOutputs> outputs;  ///< what was written now
  /// Where the outputs differ from those of the last rerun (RerunOptions::last), which stand for
  /// the recorded ones; nothing if there was none.
  std::optional<std::vector<ComparedVariable>> sinceLast;

  std::uint64_t compared() const;      ///< values
  std::uint64_t unequal() const;       ///< of them not the same to the last bit
  std::uint64_t unchangedToo() const;  ///< of them left out because of RerunOptions::unchanged
  std::uint64_t stretches() const;
  /// Returns whether the recording may be the reason for differences.
  bool isTooCoarse() const { return !sampledInputs.empty(); }
};

/// What a rerun would do, as the recording and the map of variables tell before it starts.
struct RerunPlan {
  enum class Known {
    Map,    ///< the published map and its extension name the writer
    Name,   ///< a variable of the team: the beginning of its name does
    Chosen  ///< RerunOptions::writes
  };
  struct Output {
    std::string variable;
    Known known = Known::Map;
    bool isRecorded = false;  ///< otherwise there is nothing to compare it with
  };
  std::string robot;
  std::vector<Output> outputs;          ///< what the processes write, in the order of the map
  std::vector<RerunProcess> processes;  ///< that run; whole profiles as what they consist of
  /// What ran as each of the processes when it was recorded; `program` is empty if it is not known.
  std::vector<RerunProcess> recorded;
  std::vector<std::string> missing;            ///< what they read and was not recorded: they read 0
  std::vector<std::string> notes;              ///< sentences, as RerunOptions::note gets them
  double start = 0.0, begin = 0.0, end = 0.0;  ///< s: played from, compared from and until
};

/// Tells what rerun() would do with these options; starts nothing. Fails as rerun() does before it
/// starts.
Result<RerunPlan> planRerun(const telemetry::SessionReader& session, const RerunOptions& options);

/// Returns the processes that wrote variables of this robot, by name, sorted; empty if the
/// recording has no variable that a rerun could use.
std::vector<std::string> recordedProcesses(const telemetry::GroupInfo& robot);

/// Runs a part of a session again. Fails with NotFound for unknown robots, processes and programs,
/// with the names that are known; with InvalidArgument if the recording has none of the inputs;
/// with SystemError if a program dies, does not answer, or the blackboard is removed; with Conflict
/// after a cancel.
Result<RerunResult> rerun(const telemetry::SessionReader& session, const RerunOptions& options);

/// The same, and writes a session with everything of the first one and the robot "B1 rerun" beside
/// the original, with an event for each difference. After an error there is no new file.
Result<RerunResult> rerunToFile(const telemetry::SessionReader& session,
                                const RerunOptions& options, const std::string& path,
                                IfExists ifExists = IfExists::Refuse);

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The result of a rerun as text for people, as JSON, and as an HTML page. Pure functions; any
// thread. Times are seconds of the session.

#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/rerun/rerun.h>

namespace pitchboard::link {

/// Returns what ran, a table of the variables that differ, and a sentence for what that means.
std::string rerunTable(const RerunResult& result);

/// Returns what the result means, in sentences: "No value differs.", what was left out, or why the
/// differences are no evidence; none if there are differences that the program made.
std::vector<std::string> rerunVerdicts(const RerunResult& result);

/// Returns where the outputs differ from those of the last rerun, as a table or a sentence; empty
/// if there was none.
std::string sinceLastTable(const RerunResult& result);

/// Returns the result as a JSON object; `session` is the name of its file.
std::string rerunToJson(const RerunResult& result, std::string_view session);

/// Returns the result as an HTML page.
std::string rerunReport(const RerunResult& result, std::string_view session);

/// Where an unchanged program differs (--same), as it stands in a file.
struct UnchangedRerun {
  std::string robot;
  std::vector<RerunProcess> processes;
  std::vector<ComparedVariable> variables;  ///< names and stretches
};
/// Reads rerunToJson(). Fails with ParseError, which names `source`.
Result<UnchangedRerun> unchangedFromJson(std::string_view json, std::string_view source);

/// Returns the file beside a session in which `--same` keeps its result:
/// "match.B1-decision.same.json".
std::string unchangedPath(const std::string& session, const RerunOptions& options);
/// Reads that file, for RerunOptions::unchanged; nothing if there is none. Fails as readFile() and
/// unchangedFromJson() do.
Result<std::vector<ComparedVariable>> readUnchanged(const std::string& session,
                                                    const RerunOptions& options);
/// Writes that file; an older one is replaced. Returns its path.
Result<std::string> keepUnchanged(const std::string& session, const RerunOptions& options,
                                  const RerunResult& result);

}  // namespace pitchboard::link

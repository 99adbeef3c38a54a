// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Bookmarks that somebody sets while a recording is replayed. They are kept in a small file beside
// the recording, match.mcap.notes.json, so that the recording itself is never written to.
// SessionReader adds them to the events of the session. Pure functions; any thread.

#include <map>
#include <string>

#include <base/result.h>

namespace pitchboard::telemetry {

/// The notes by their time (s of the session); a bookmark without a note has an empty text.
using SessionNotes = std::map<double, std::string>;

/// Returns the path of the file with the notes of a recording.
std::string sessionNotesPath(const std::string& session);
/// Reads the notes of a recording; none if there is no such file. Fails as readFile() does, and
/// with ParseError if the file is damaged.
Result<SessionNotes> readSessionNotes(const std::string& session);
/// Adds a bookmark to the notes of a recording, or changes its note. Fails as readSessionNotes()
/// and writeFile() do, and then the file is unchanged.
Result<void> addSessionNote(const std::string& session, double time, const std::string& note);

}  // namespace pitchboard::telemetry

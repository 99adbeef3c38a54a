// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Notes that somebody draws at a moment: a text, an arrow or a circle on the field, on a plot or on
// the picture of a video. They are kept in the file of the bookmarks (session_notes.h), which older
// versions of the program rewrite without losing them. Times in seconds of the session. Pure
// functions; any thread.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <base/result.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

enum class NoteShape { Text, Arrow, Circle };
enum class NotePlace { Field, Plot, Video };

struct DrawnNote {
  static constexpr double usualDuration = 3.0;                              ///< s
  static constexpr double shortestDuration = 0.1, longestDuration = 86400;  ///< s
  static constexpr std::size_t maxText = 800;                               ///< bytes

  double time = 0.0;  ///< s; of a plot, where it is drawn
  double duration = usualDuration;
  NoteShape shape = NoteShape::Text;
  NotePlace place = NotePlace::Field;
  /// The variable of a plot, such as "B1/BELIEF_ERROR"; the file of a video, without folder; empty
  /// for the field.
  std::string on = {};
  std::string unit = {};  ///< of the values of a plot; may be empty
  /// Field: m. Plot: x is a time (s), y a value in `unit`. Video: shares of width and height from
  /// the top left. An arrow leads from one to the other, a circle has its centre here,
  Point from = {};
  Point to = {};          ///< and this is on its line; same as `from` for a text
  std::string text = {};  ///< UTF-8; may be empty for arrows and circles

  /// Returns whether it is shown at this time.
  bool isShownAt(double at) const { return at >= time && at <= time + duration; }
  bool operator==(const DrawnNote&) const = default;
};

std::string_view nameOf(NoteShape shape);  ///< "text", "arrow", "circle"
std::string_view nameOf(NotePlace place);  ///< "field", "plot", "video"
/// Returns the text, or what was drawn where: "arrow on the field", "circle on north.mp4".
std::string labelOf(const DrawnNote& note);

struct DrawnNotes {
  static constexpr std::size_t most = 10'000;
  std::vector<DrawnNote> notes;  ///< in order of time
  std::size_t unreadable = 0;    ///< damaged ones, and those of a newer version
};

/// Returns the drawn notes of a recording; none if there is no file. Fails as readSessionNotes()
/// does, and with ParseError if there are more than DrawnNotes::most.
Result<DrawnNotes> readDrawnNotes(const std::string& session);
/// Keeps these notes in place of those that can be read, and leaves the rest of the file as it is.
/// Writes no file if there is nothing to keep. Fails with InvalidArgument if there are more than
/// DrawnNotes::most, and as addSessionNote() does.
Result<void> writeDrawnNotes(const std::string& session, std::span<const DrawnNote> notes);
/// Keeps the notes of one recording that are shown in `range` with another one that is a part of
/// it. Notes that cannot be read are left out: SessionReader::notes() says so. Fails as
/// writeDrawnNotes() does.
Result<void> copyDrawnNotes(const std::string& session, const std::string& part, TimeRange range);

/// Returns a table of the notes as CSV, with a head.
std::string drawnNotesCsv(std::span<const DrawnNote> notes);
/// Returns the notes as a JSON array, as they are in the file.
std::string drawnNotesJson(std::span<const DrawnNote> notes);

}  // namespace pitchboard::telemetry

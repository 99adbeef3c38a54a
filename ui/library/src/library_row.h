// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A session as the library shows it: texts and sort keys are made once, on the thread that reads
// the files, so that a table of many thousands sorts and searches at once. Plain values; any
// thread.

#include <QString>
#include <array>
#include <memory>

#include <robotlink/library/session_index.h>

namespace pitchboard::ui {

struct LibraryRow {
  enum Column { Date, Teams, Score, Length, Robots, Events, File, Notes, columns };

  link::IndexedSession session;
  QString path;
  std::array<QString, columns> texts;
  /// Numbers sort by these; text columns sort by `folded`.
  std::array<double, columns> numbers{};
  std::array<QString, columns> folded;
  QString searched;  ///< what words are looked for in, without case
};
using LibraryRowPtr = std::shared_ptr<const LibraryRow>;

LibraryRowPtr libraryRow(link::IndexedSession session);
constexpr bool isSortedAsText(int column) {
  return column == LibraryRow::Teams || column == LibraryRow::File || column == LibraryRow::Notes;
}
/// Returns the name under which the picture of this version of the session is kept.
QString pictureName(const link::IndexedSession& session, bool isDark);

}  // namespace pitchboard::ui

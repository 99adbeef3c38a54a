// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Library: the sessions of chosen folders in a table that can be searched and sorted,
// with a picture of each. Files are read in the background and remembered in the user's cache. UI
// thread only.

#include <QString>
#include <functional>

class QSettings;
class QWidget;

namespace pitchboard::ui {

class FieldPictures;
class SessionRecording;

/// All must outlive the dock; `settings` may be null.
struct LibraryDockParts {
  QSettings* settings = nullptr;          ///< keeps which folders are listed
  SessionRecording* recording = nullptr;  ///< whose folder is listed unless others were chosen
  const FieldPictures* pictures = nullptr;
  std::function<void(const QString&)> open;     ///< opens a session instead of what is shown
  std::function<void(const QString&)> compare;  ///< shows it beside what is shown
};
QWidget* makeLibraryDock(LibraryDockParts parts, QWidget* parent);

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Saves the moment that is shown, of whatever source, as a test: asks what must hold, writes the
// file, and says so to whoever plays it. UI thread only; owned by the window.

#include <QObject>

class QSettings;
class QWidget;

namespace pitchboard::ui {

class MatchController;
class ReplayController;
class SourceSwitch;

class SituationTests : public QObject {
  Q_OBJECT
 public:
  /// What it is made from; all outlive it, but `settings`, which may be null.
  struct Parts {
    const SourceSwitch* source = nullptr;
    const MatchController* match = nullptr;
    const ReplayController* replay = nullptr;
    QSettings* settings = nullptr;  ///< keeps the folder of the last test
  };
  SituationTests(const Parts& parts, QWidget* window);

  /// There is a robot in the moment shown.
  bool isPossible() const;
  /// A dialog that is about the moment of now, however the source goes on behind it.
  void ask();

 signals:
  /// The file is there, and wanted to be played at once, or only known.
  void saved(const QString& path, bool play);
  /// Why there is no test to be made.
  void failed(const QString& sentence);

 private:
  Parts m_parts;
  QWidget* m_window;
};

}  // namespace pitchboard::ui

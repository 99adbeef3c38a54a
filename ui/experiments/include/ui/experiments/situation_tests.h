// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Saves the moment that is shown, of any source, as a situation test: asks what must hold, writes
// the file and emits `saved`. UI thread only; owned by the window.

#include <QObject>

class QSettings;
class QWidget;

namespace pitchboard::ui {

class MatchController;
class ReplayController;
class ShownMoment;

class SituationTests : public QObject {
  Q_OBJECT
 public:
  /// All must outlive this object; `settings` may be null.
  struct Parts {
    const ShownMoment* shown = nullptr;
    const MatchController* match = nullptr;
    const ReplayController* replay = nullptr;
    QSettings* settings = nullptr;  ///< keeps the folder of the last test
  };
  SituationTests(const Parts& parts, QWidget* window);

  /// Returns why no test can be made of the moment shown; empty if one can.
  QString whyNot() const;
  /// Opens a dialog about the current moment, while the source continues behind it.
  void ask();

 signals:
  /// The file has been written; `play` tells whether to play it immediately.
  void saved(const QString& path, bool play);
  /// No test can be made, for the reason in `sentence`.
  void failed(const QString& sentence);

 private:
  Parts m_parts;
  QWidget* m_window;
};

}  // namespace pitchboard::ui

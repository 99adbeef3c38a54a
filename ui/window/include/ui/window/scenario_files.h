// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Opens and saves scenarios, and exports pictures. Only file dialogs are modal. UI thread only.

#include <QObject>
#include <functional>

class QWidget;

#include <robotlink/scenario/scenario.h>

namespace pitchboard::ui {

class FieldView;
class MatchController;
class ScenarioChooser;

class ScenarioFiles : public QObject {
  Q_OBJECT
 public:
  ScenarioFiles(MatchController* controller, FieldView* field, ScenarioChooser* chooser,
                QWidget* window);

  /// Opens a built-in scenario or a file. On failure, the running match continues and `failed` is
  /// emitted.
  void open(const QString& nameOrPath);
  /// The same, but can be undone.
  void load(const QString& nameOrPath);
  /// Saves the current moment as a scenario.
  void save(const QString& path);
  /// Saves the field as PNG.
  void exportPicture(const QString& path);
  void askAndOpen();
  /// Asks where to save the moment at which this is called.
  void askAndSave();
  /// Asks where to save the picture of the moment at which this is called.
  void askAndExportPicture();
  /// Selects the scenario in the chooser after it was opened elsewhere.
  void showCurrent(const QString& nameOrPath);

 signals:
  void failed(const QString& sentence);

 private:
  void save(const QString& path, link::Scenario moment);
  /// Returns the bytes of a file; empty for a suffix that is not known.
  QByteArray picture(const QString& suffix) const;
  void writePicture(const QString& path, const QByteArray& bytes);
  void read(const QString& nameOrPath, const std::function<void(const link::Scenario&)>& play);

  MatchController* m_controller;
  FieldView* m_field;
  ScenarioChooser* m_chooser;
  QWidget* m_window;
};

}  // namespace pitchboard::ui

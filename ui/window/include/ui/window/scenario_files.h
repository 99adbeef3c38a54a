// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Scenarios and pictures in files: opens, saves, exports. Never modal but for the file dialogs.

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

  /// A built-in name or a path; on failure the running match goes on and `failed` tells why.
  void open(const QString& nameOrPath);
  /// The same, as something that can be undone.
  void load(const QString& nameOrPath);
  /// The present moment.
  void save(const QString& path);
  /// The field as PNG.
  void exportPicture(const QString& path);
  void askAndOpen();
  void askAndSave();
  void askAndExportPicture();
  /// Tells the chooser which scenario a match that was opened elsewhere is.
  void showCurrent(const QString& nameOrPath);

 signals:
  void failed(const QString& sentence);

 private:
  void read(const QString& nameOrPath, const std::function<void(const link::Scenario&)>& play);

  MatchController* m_controller;
  FieldView* m_field;
  ScenarioChooser* m_chooser;
  QWidget* m_window;
};

}  // namespace pitchboard::ui

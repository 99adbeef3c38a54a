// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Drop-down of scenarios: built-in ones, recent files, "Open…". Shows the title of the one that is
// played. Recent files are kept in the settings.

#include <QComboBox>

class QSettings;

namespace pitchboard::ui {

class ScenarioChooser : public QComboBox {
  Q_OBJECT
 public:
  explicit ScenarioChooser(QSettings* settings, QWidget* parent = nullptr);
  /// Name of a built-in scenario, or path of a file (remembered as recent).
  void showCurrent(const QString& nameOrPath, const QString& title);
  /// Paths, newest first, of files that are still there.
  QStringList recentFiles() const;

 signals:
  void chosen(const QString& nameOrPath);
  void openRequested();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void fill();
  QSettings* m_settings;
  QString m_current, m_title;
};

}  // namespace pitchboard::ui

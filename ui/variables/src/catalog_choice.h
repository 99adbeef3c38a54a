// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which catalog names the blackboards' words: the published one, or one read from a team's own
// blackboard.h, SharedMemory.py or JSON. Remembers the file. UI thread only.

#include <QObject>
#include <QString>

class QSettings;

namespace pitchboard::ui {

class InPlaceMessage;
class MatchController;

class CatalogChoice : public QObject {
  Q_OBJECT
 public:
  /// Reads the remembered file at once. `settings` may be null: nothing is remembered then.
  CatalogChoice(MatchController* controller, QSettings* settings, InPlaceMessage* message,
                QObject* parent);

  /// Asks for a file and imports it.
  void askAndImport(QWidget* parent);
  /// On failure says file, line and what is wrong, and keeps the catalog there was.
  void importFile(const QString& file);
  void usePublished();
  bool isPublished() const { return m_file.isEmpty(); }
  /// "Published catalog", "Catalog of blackboard.h".
  QString name() const;

 private:
  void offerRestart(const QString& sentence);

  MatchController* m_controller;
  QSettings* m_settings;
  InPlaceMessage* m_message;
  QString m_file;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "mapping_menu.h"

#include <QAction>
#include <QMenu>

#include <ui/base/file_dialog.h>
#include <ui/live/foxglove_dialog.h>
#include <ui/mapping/mapping_dialog.h>
#include <ui/session/session_files.h>

namespace pitchboard::ui {

namespace {

const QString recordingFilter =
    QStringLiteral("Recordings (*.mcap *.db3 *.csv *.tsv *.txt *.yaml *.yml);;All files (*)");

}  // namespace

void mapRecordings(SessionFiles* sessions, const QStringList& recordings, QWidget* window) {
  auto* dialog = new MappingDialog(mappingSource(recordings), window);
  QObject::connect(dialog, &MappingDialog::used, sessions,
                   [sessions](const QString& file, const QStringList& used) {
                     sessions->importWith(used, file);
                   });
  dialog->show();
}

QAction* addMappingAction(QMenu* menu, SessionFiles* sessions, QWidget* window) {
  QAction* action =
      menu->addAction(QStringLiteral("&Map topics of recordings…"), sessions, [sessions, window] {
        QStringList recordings = sessions->importedRecordings();
        if (recordings.isEmpty()) {
          recordings =
              askToOpenSeveral(window, QStringLiteral("Map topics of recordings"), recordingFilter);
          if (recordings.isEmpty()) return;
        }
        mapRecordings(sessions, recordings, window);
      });
  action->setObjectName(QStringLiteral("mapTopics"));
  action->setToolTip(QStringLiteral(
      "Says which topics of other programs' recordings are robots, ball, log and referee, and puts "
      "the recordings of a match on one clock"));
  QObject::connect(sessions, &SessionFiles::mappingWanted, window,
                   [sessions, window](const QStringList& recordings) {
                     mapRecordings(sessions, recordings, window);
                   });
  return action;
}

void mapBridgesOf(FoxgloveDialog* dialog) {
  QObject::disconnect(dialog, &FoxgloveDialog::mappingWanted, nullptr, nullptr);
  QObject::connect(dialog, &FoxgloveDialog::mappingWanted, dialog,
                   [dialog](const QString& text, const QString& file) {
                     const auto address = telemetry::parseFoxgloveAddress(text.toStdString());
                     if (!address) return;
                     auto* mapping = new MappingDialog(mappingSource(*address, file), dialog);
                     QObject::connect(mapping, &MappingDialog::used, dialog,
                                      [dialog, text](const QString& used, const QStringList&) {
                                        dialog->setMapping(text, used);
                                      });
                     mapping->show();
                   });
}

}  // namespace pitchboard::ui

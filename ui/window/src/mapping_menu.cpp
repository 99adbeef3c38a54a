// SPDX-License-Identifier: GPL-3.0-or-later
#include "mapping_menu.h"

#include <QAction>
#include <QMenu>

#include <ui/live/foxglove_dialog.h>
#include <ui/mapping/mapping_dialog.h>
#include <ui/session/session_files.h>

namespace pitchboard::ui {

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
      menu->addAction(QStringLiteral("&Map topics of a recording…"), sessions, [sessions, window] {
        QStringList recordings = sessions->importedRecordings();
        if (recordings.isEmpty()) {
          const QString path = sessions->askForFile(QStringLiteral("Map topics of a recording"));
          if (path.isEmpty()) return;
          recordings = {path};
        }
        mapRecordings(sessions, recordings, window);
      });
  action->setObjectName(QStringLiteral("mapTopics"));
  action->setToolTip(QStringLiteral(
      "Says which topics of another program's recording are robots, ball, log and referee"));
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

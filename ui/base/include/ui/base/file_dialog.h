// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All file dialogs open in one place: the folder of the file that was chosen or opened last. UI
// thread.

#include <QString>
#include <QStringList>

class QFileDialog;
class QMimeData;
class QSettings;
class QWidget;

namespace pitchboard::ui {

/// Returns the folder in which the next dialog opens.
QString dialogFolder();
/// The next dialog opens in the folder of this file.
void rememberFolderOf(const QString& file);
/// The folder is kept in `settings` from now on; `first` is it at the first start.
void keepDialogFolderIn(QSettings* settings, const QString& first);

// Ask and wait; return an empty path if nothing was chosen. `filter` as of QFileDialog.
QString askToOpen(QWidget* parent, const QString& title, const QString& filter = {});
QStringList askToOpenSeveral(QWidget* parent, const QString& title, const QString& filter = {});
/// `name` is what the file is called unless somebody types another name.
QString askToSave(QWidget* parent, const QString& title, const QString& name,
                  const QString& filter = {});
QString askForFolder(QWidget* parent, const QString& title);

/// For a dialog that nobody waits for: it opens there, and its choice is remembered.
void openInDialogFolder(QFileDialog* dialog);

/// Returns the files of this computer with this suffix ("mcap") that are being dropped.
QStringList droppedFiles(const QMimeData* data, const QString& suffix);

}  // namespace pitchboard::ui

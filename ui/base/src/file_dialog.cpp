// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/file_dialog.h>

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMimeData>
#include <QPointer>
#include <QSettings>
#include <QUrl>

namespace pitchboard::ui {
namespace {

const QString folderKey = QStringLiteral("files/folder");

struct KeptFolder {
  QString path;
  QPointer<QSettings> settings;
};

KeptFolder& keptFolder() {
  static KeptFolder folder;
  return folder;
}

void setFolder(const QString& path) {
  KeptFolder& folder = keptFolder();
  if (folder.path == path) return;
  folder.path = path;
  if (folder.settings) folder.settings->setValue(folderKey, path);
}

QString remembered(const QString& file) {
  if (!file.isEmpty()) rememberFolderOf(file);
  return file;
}

}  // namespace

QString dialogFolder() {
  const QString& path = keptFolder().path;
  return QFileInfo(path).isDir() ? path : QDir::currentPath();
}

void rememberFolderOf(const QString& file) {
  setFolder(QFileInfo(file).absolutePath());
}

void keepDialogFolderIn(QSettings* settings, const QString& first) {
  keptFolder() = {settings->value(folderKey, first).toString(), settings};
}

QString askToOpen(QWidget* parent, const QString& title, const QString& filter) {
  return remembered(QFileDialog::getOpenFileName(parent, title, dialogFolder(), filter));
}

QStringList askToOpenSeveral(QWidget* parent, const QString& title, const QString& filter) {
  const QStringList files = QFileDialog::getOpenFileNames(parent, title, dialogFolder(), filter);
  if (!files.isEmpty()) rememberFolderOf(files.front());
  return files;
}

QString askToSave(QWidget* parent, const QString& title, const QString& name,
                  const QString& filter) {
  return remembered(
      QFileDialog::getSaveFileName(parent, title, QDir(dialogFolder()).filePath(name), filter));
}

QString askForFolder(QWidget* parent, const QString& title) {
  const QString folder = QFileDialog::getExistingDirectory(parent, title, dialogFolder());
  if (!folder.isEmpty()) setFolder(folder);
  return folder;
}

void openInDialogFolder(QFileDialog* dialog) {
  dialog->setDirectory(dialogFolder());
  QObject::connect(dialog, &QFileDialog::filesSelected, dialog, [](const QStringList& files) {
    if (!files.isEmpty()) rememberFolderOf(files.front());
  });
  dialog->open();
}

QStringList droppedFiles(const QMimeData* data, const QString& suffix) {
  QStringList paths;
  for (const QUrl& url : data->urls()) {
    if (!url.isLocalFile()) continue;
    const QString path = url.toLocalFile();
    if (QFileInfo(path).suffix().toLower() == suffix) paths << path;
  }
  return paths;
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording_import.h"

#include <QDir>
#include <QFileInfo>
#include <QProgressDialog>
#include <utility>
#include <vector>

#include <base/try.h>
#include <robotlink/import/import_session.h>
#include <ui/base/cache_folder.h>

namespace pitchboard::ui {
RecordingImport::RecordingImport(QWidget* window) : QObject(window), m_window(window) {}

RecordingImport::~RecordingImport() {
  if (m_cancelled) *m_cancelled = true;
  m_worker.waitForDone();
}

bool RecordingImport::isOfOthers(const QString& path) {
  static const QStringList endings{QStringLiteral("db3"), QStringLiteral("csv"),
                                   QStringLiteral("tsv"), QStringLiteral("yaml"),
                                   QStringLiteral("yml")};
  const QFileInfo file(path);
  return file.isDir() || endings.contains(file.suffix().toLower());
}

void RecordingImport::showProgress(const QString& path) {
  delete m_dialog;
  m_dialog = new QProgressDialog(QStringLiteral("Importing %1…").arg(QFileInfo(path).fileName()),
                                 QStringLiteral("Cancel"), 0, 100, m_window);
  m_dialog->setObjectName(QStringLiteral("importProgress"));
  m_dialog->setWindowTitle(QStringLiteral("Import"));
  m_dialog->setAutoClose(false);
  m_dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(m_dialog, &QProgressDialog::canceled, this,
          [cancelled = m_cancelled] { *cancelled = true; });
}

namespace {

QStringList sentencesOf(const std::vector<std::string>& notes) {
  QStringList sentences;
  for (const std::string& note : notes) sentences << QString::fromStdString(note);
  return sentences;
}

}  // namespace

void RecordingImport::start(const QStringList& recordings, const QString& mappingFile) {
  std::vector<std::string> files;
  for (const QString& path : recordings) files.push_back(path.toStdString());
  run(recordings.first(),
      [files, mapping = mappingFile.toStdString()](const std::string& to,
                                                   const auto& progress) -> Result<QStringList> {
        link::ImportOptions options;
        if (!mapping.empty()) options.mapping = TRY(link::mappingFromFile(mapping));
        const auto report = TRY(link::importRecordings(files, to, options, progress));
        return sentencesOf(report.notes);
      });
}

void RecordingImport::join(const QString& session, const QString& recording,
                           const link::JoinOptions& options) {
  run(recording, [session = session.toStdString(), recording = recording.toStdString(), options](
                     const std::string& to, const auto& progress) {
    return link::joinRecording(session, recording, to, options, progress)
        .map([](const auto& report) {
          std::vector<std::string> sentences = report.notes;
          sentences.insert(sentences.begin(), report.summary() + '.');
          return sentencesOf(sentences);
        });
  });
}

void RecordingImport::run(const QString& path, Work work) {
  if (m_cancelled) *m_cancelled = true;
  if (!m_folder) m_folder = makeCacheFolder(QStringLiteral("import"));
  m_cancelled = std::make_shared<std::atomic<bool>>(false);
  showProgress(path);
  // The window's title and the export dialog call the session by the recording's name.
  const QDir folder(m_folder->filePath(QString::number(++m_count)));
  QDir().mkpath(folder.path());
  // table.csv and table.mcap may be recordings of the same folder.
  const QString ending = QStringLiteral(".mcap");
  const QString name = QFileInfo(path).isDir() ? QDir(path).dirName() : QFileInfo(path).fileName();
  const QString to = folder.filePath(name.endsWith(ending) ? name : name + ending);
  m_worker.start([this, path, to, work = std::move(work), cancelled = m_cancelled] {
    int shown = -1;
    const auto notes = work(to.toStdString(), [&](double share) {
      const int percent = static_cast<int>(share * 100.0);
      if (percent != shown) {
        shown = percent;
        m_toUi.post([this, percent, cancelled] {
          if (cancelled == m_cancelled && m_dialog) m_dialog->setValue(percent);
        });
      }
      return !*cancelled;
    });
    m_toUi.post([this, notes, path, to, cancelled] {
      if (cancelled != m_cancelled) return;  // another one was started
      m_cancelled.reset();
      delete m_dialog;
      if (*cancelled) return;
      if (!notes) {
        emit failed(
            QStringLiteral("Could not import %1: %2")
                .arg(QFileInfo(path).fileName(), QString::fromStdString(notes.error().message)));
        return;
      }
      emit imported(path, to, *notes);
    });
  });
}

}  // namespace pitchboard::ui

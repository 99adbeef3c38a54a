// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Exports part of the session that Replay has open: numbers (CSV, JSON lines), a shorter session, or a
// report. The dialog stays while a worker writes, shows how far it is, and can be cancelled; it never
// stops the window. UI thread only.

#include <QDialog>
#include <QThreadPool>
#include <atomic>
#include <optional>

#include <telemetry/series_store.h>
#include <telemetry/session_export.h>

class QComboBox;
class QDialogButtonBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;

namespace pitchboard::ui {

struct ExportRequest {
  QString session;                       ///< the file that is read
  QString path;                          ///< the file that is written
  telemetry::ExportSelection selection;
};

class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `picture` (PNG bytes, may be empty) stands in a report; `range` is what is chosen at first.
  ExportDialog(const QString& session, telemetry::TimeRange range, QByteArray picture,
               QWidget* parent);
  ~ExportDialog() override;   ///< cancels what is being written

  /// Writes in the chosen form; finished() or failed() follows. Never overwrites.
  void exportTo(const QString& path);
  bool isWriting() const { return m_writing; }
  /// Ending of the chosen form's files: ".csv".
  QString suffix() const;

 signals:
  void written(const QString& path);
  void failed(const QString& sentence);

 private:
  void ask();
  void cancel();
  void tell(const QString& text, bool error);
  void setWriting(bool writing);

  QString m_session;
  QByteArray m_picture;
  QComboBox* m_format;
  QDoubleSpinBox* m_begin;
  QDoubleSpinBox* m_end;
  QLineEdit* m_robots;
  QLineEdit* m_variables;
  QProgressBar* m_progress;
  QLabel* m_message;
  QPushButton* m_export;
  bool m_writing = false;
  std::atomic<bool> m_cancelled = false;
  QThreadPool m_worker;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Exports part of the session that Replay has open, or of what memory holds of the match or of
// Live: numbers (CSV, JSON lines), a shorter session, a report, the field as a picture or a video.
// The dialog stays while a worker writes, shows how far it is, and can be cancelled; it never stops
// the window. UI thread only.

#include <QDateTime>
#include <QDialog>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <telemetry/series/series_store.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/session/export_forms.h>
#include <ui/sources/session_recording.h>

class QCheckBox;
class QComboBox;
class QDateTimeEdit;
class QDialogButtonBox;
class QFormLayout;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTemporaryDir;
class QToolButton;

namespace pitchboard::ui {

class CheckList;
class FieldPictures;
class MomentBox;
class NumberBox;
class VideoExport;

/// What is exported from: a file, or memory.
struct ExportSource {
  QString session;                     ///< the file; empty: memory
  std::function<SessionMaker()> make;  ///< from memory: what writes it (SessionRecording)
  QString folder, name;                ///< of the file that is proposed, without its ending
  /// What can be chosen: the groups of the source.
  std::vector<telemetry::GroupInfo> groups{};
  std::optional<QDateTime> clock{};  ///< time of day at second 0, where there is one
};

class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `range` is what is chosen at first; `pictures` outlives the dialog.
  ExportDialog(ExportSource source, telemetry::TimeRange range, const FieldPictures* pictures,
               QWidget* parent);
  ~ExportDialog() override;  ///< cancels what is being written

  /// Writes in the chosen form; finished() or failed() follows. Never overwrites.
  void exportTo(const QString& path);
  /// What makes videos, instead of "ffmpeg".
  void setVideoProgram(const QString& program) { m_program = program; }
  bool isWriting() const { return m_writing; }
  /// Ending of the chosen form's files: ".csv".
  QString suffix() const;

 signals:
  void written(const QString& path);
  void failed(const QString& sentence);

 private:
  const ExportForm& form() const;
  void showRows();
  void showClock();
  void makeChoices();
  bool takeChoices(telemetry::ExportSelection& selection);
  void ask();
  void write(const ExportRequest& request);
  void writeVideo(const ExportRequest& request);
  void writePicture(const QString& path);
  void succeed(const QString& path);
  void fail(const QString& sentence);
  void cancel();
  void tell(const QString& text, bool error);
  void setWriting(bool writing);

  ExportSource m_source;
  const FieldPictures* m_pictures;
  QComboBox* m_format;
  MomentBox* m_begin;
  MomentBox* m_end;
  QWidget* m_when;  // the range as times of day
  QDateTimeEdit *m_beginClock, *m_endClock;
  CheckList* m_robots;
  CheckList* m_variables;
  NumberBox* m_lines;
  QComboBox* m_between;
  QCheckBox* m_clock;
  QComboBox* m_size;
  QSpinBox* m_rate;
  QFormLayout* m_rows;
  QProgressBar* m_progress;
  QLabel* m_message;
  QPushButton* m_export;
  QToolButton* m_open;
  QToolButton* m_show;
  QString m_written;  // the last file
  QString m_program = QStringLiteral("ffmpeg");
  std::unique_ptr<QTemporaryDir> m_memory;  // holds the session that is written from memory
  std::unique_ptr<VideoExport> m_video;
  bool m_writing = false;
  bool m_showingClock = false;
  std::atomic<bool> m_cancelled = false;
  UiQueue m_toUi;
  Workers m_worker;
};

}  // namespace pitchboard::ui

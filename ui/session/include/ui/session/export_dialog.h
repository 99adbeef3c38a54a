// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The export dialog. It exports part of the session that is open in Replay, or of the match or live
// data in memory, as numbers (CSV, JSON lines), a shorter session, a report, or a picture or video
// of the field. A worker writes while the dialog shows the progress and can cancel; the window is
// never blocked. UI thread only.

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
#include <ui/sources/film_parts.h>
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

/// Where the exported data come from: a file, or memory.
struct ExportSource {
  QString session;                     ///< the file; empty: memory
  std::function<SessionMaker()> make;  ///< writes what is in memory, see SessionRecording
  QString name;                        ///< proposed file name, without suffix
  /// The groups of the source, to choose from.
  std::vector<telemetry::GroupInfo> groups{};
  std::optional<QDateTime> clock{};  ///< time of day at second 0, if known
  FilmParts film{};                  ///< what a video can show beside the field
};

class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `range` is the initial range. `pictures` must outlive the dialog.
  ExportDialog(ExportSource source, telemetry::TimeRange range, const FieldPictures* pictures,
               QWidget* parent);
  ~ExportDialog() override;  ///< cancels a running export

  /// Exports in the chosen format; written() or failed() follows. Never overwrites a file.
  void exportTo(const QString& path);
  bool isWriting() const { return m_writing; }
  /// Returns the suffix of the chosen format, such as ".csv".
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
  /// Returns the picture that the chosen format has, of the moment that is shown now.
  QByteArray picture() const;
  void begin(const QString& path, const QByteArray& picture);
  void write(const ExportRequest& request);
  void writeVideo(const ExportRequest& request);
  void writePicture(const QString& path);
  void succeed(const QString& path);
  void fail(const QString& sentence);
  void cancel();
  void showStatus(const QString& text, bool error);
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
  QCheckBox *m_cameras, *m_curves;
  QFormLayout* m_rows;
  QProgressBar* m_progress;
  QLabel* m_message;
  QPushButton* m_export;
  QToolButton* m_open;
  QToolButton* m_show;
  QString m_written;                        // the last file
  std::unique_ptr<QTemporaryDir> m_memory;  // holds the session that is written from memory
  std::unique_ptr<VideoExport> m_video;
  QByteArray m_picture;  // of the moment at which the export was asked for
  bool m_writing = false;
  bool m_showingClock = false;
  std::atomic<bool> m_cancelled = false;
  UiQueue m_toUi;
  Workers m_worker;
};

}  // namespace pitchboard::ui

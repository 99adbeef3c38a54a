// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Asks what is to run again: robot, process, program and range; and tells before it starts what the
// process writes, how that is known, and what it reads that was not recorded. Shows the progress
// and what went wrong; goes when there is a result. Qt owns it. UI thread only.

#include <QDialog>
#include <QTimer>
#include <atomic>
#include <memory>

#include <base/result.h>
#include <robotlink/rerun/rerun.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/rerun/rerunner.h>

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSettings;
class QTableWidget;
class QVBoxLayout;

namespace pitchboard::ui {

class RobotSelection;
class ShownMoment;

/// Everything must outlive the dialog; `settings` may be null.
struct RerunDialogParts {
  Rerunner* rerunner = nullptr;
  ShownMoment* shown = nullptr;
  RobotSelection* selection = nullptr;
  QSettings* settings = nullptr;
};

class RerunDialog : public QDialog {
  Q_OBJECT
 public:
  RerunDialog(const RerunDialogParts& parts, QWidget* parent);
  ~RerunDialog() override;

  /// Fills in robots, processes and range of the recording that is shown.
  void takeRecording();

 signals:
  void planned();  ///< the tables show what was chosen last

 private:
  struct Reader;  // the recording, on the worker
  /// One more process that runs.
  struct Row {
    QWidget* box = nullptr;
    QComboBox *process = nullptr, *program = nullptr;
  };
  QWidget* makeForm();
  QWidget* makePlan();
  void showProcesses();
  void showPrograms();
  void fillPrograms(QComboBox* box, const QString& process, bool proposesOurs);
  QWidget* makeMore(QWidget* form);
  void addRow();
  void removeRow(const QWidget* box);
  QStringList processes() const;
  bool isWholeProfile() const;
  std::vector<link::RerunProcess> chosenProcesses() const;
  Result<std::vector<link::RerunProcess>> unchangedProcesses() const;
  void browse(QComboBox* program);
  Result<RerunOrder> order() const;
  void planSoon();
  void plan();
  void showPlan(const Result<link::RerunPlan>& plan);
  void start();
  void showState();
  void showMessage(const QString& sentence, bool bad);

  RerunDialogParts m_parts;
  QComboBox *m_robot, *m_process, *m_program, *m_unchanged, *m_speed;
  QLineEdit *m_writes, *m_begin, *m_end, *m_warmUp;
  QCheckBox* m_check;
  QPushButton *m_start, *m_browse, *m_add;
  QVBoxLayout* m_more;
  std::vector<Row> m_rows;  // shown in m_more
  QProgressBar* m_progress;
  QLabel *m_message, *m_notes;
  QTableWidget* m_outputs;
  std::vector<std::pair<QString, QStringList>> m_robots;
  QString m_recording;
  QTimer m_plan;
  int m_plans = 0;  // that were asked for
  bool m_started = false;
  bool m_canRun = true;
  QString m_proposed;                            // as the unchanged program
  std::vector<link::RerunProcess> m_recordedAs;  // of the newest plan
  std::shared_ptr<Reader> m_reader;
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

/// Opens the dialog, or brings the open one to the front.
void showRerunDialog(const RerunDialogParts& parts, QWidget* window);

}  // namespace pitchboard::ui

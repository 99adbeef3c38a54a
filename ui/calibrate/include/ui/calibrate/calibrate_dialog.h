// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Estimates a robot model from recorded sessions, as pitchboard-cli calibrate does: files, robot,
// base model and range; then values, predictions and residuals. The result can be saved, or given
// to robots of the match. A worker computes; the window stays usable. Qt owns it. UI thread only.

#include <QDialog>
#include <atomic>
#include <memory>
#include <vector>

#include <base/ids.h>
#include <base/result.h>
#include <robotlink/calibrate/calibrate.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QProgressBar;
class QPushButton;
class QTableWidget;
class QTabWidget;

namespace pitchboard::ui {

class MatchController;
class PredictionsView;
class ResidualsView;

class CalibrateDialog : public QDialog {
  Q_OBJECT
 public:
  /// `match` must outlive the dialog.
  CalibrateDialog(MatchController* match, QWidget* parent);
  ~CalibrateDialog() override;  ///< cancels and waits

  /// Adds recordings; the robots of the first one can be chosen once it is read.
  void addFiles(const QStringList& paths);
  bool isCalibrating() const { return m_calibrating; }
  /// Returns the result; null before the first calibration, and after another recording was chosen.
  std::shared_ptr<const link::Calibration> calibration() const { return m_calibration; }
  /// Writes the robot model; the dialog shows whether that worked.
  void saveTo(const QString& path);

 signals:
  void ended();  ///< calibrated, cancelled or failed

 private:
  QWidget* makeForm();
  QWidget* makeResults();
  void askForFiles();
  void removeFile();
  void addRobots(const QString& path, const Result<QStringList>& robots);
  void chooseBase(int index);
  void start();
  void finish(const Result<std::shared_ptr<const link::Calibration>>& made,
              const sim::FieldSpec& field);
  void showValues();
  void showButtons();
  /// Returns the robots of the match that have the calibrated robot's name, or those of its whole
  /// team.
  std::vector<RobotId> robotsOfMatch(bool team) const;
  void use(bool team);
  void showStatus(const QString& sentence, bool bad = false);

  MatchController* m_match;
  QListWidget* m_files;
  QComboBox *m_robot, *m_base;
  QLineEdit *m_from, *m_to;
  QPushButton *m_add, *m_remove, *m_start, *m_save, *m_useRobot, *m_useTeam;
  QProgressBar* m_progress;
  QLabel* m_message;
  QTabWidget* m_results;
  QTableWidget *m_values, *m_kept;
  PredictionsView* m_predictions;
  ResidualsView* m_residuals;
  std::shared_ptr<const link::Calibration> m_calibration;
  bool m_calibrating = false;
  std::atomic<bool> m_cancelled = false;
  UiQueue m_toUi;
  Workers m_worker;
};

/// Opens the dialog, or brings the open one to the front.
void showCalibrateDialog(MatchController* match, QWidget* window);

}  // namespace pitchboard::ui

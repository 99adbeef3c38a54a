// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Asks how a robot's own recording is joined to the session that is open: to which robot, and with
// which clock. The clock is estimated in the background; what somebody sets by hand is compared
// there, too. Deletes itself when it closes. UI thread only.

#include <QDialog>
#include <QTimer>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <robotlink/session/join_recording.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QComboBox;
class QLabel;
class QPushButton;

namespace pitchboard::ui {

class ClockView;
class NumberBox;

class JoinDialog : public QDialog {
  Q_OBJECT
 public:
  /// `join` gets the choice once it is made.
  JoinDialog(const QString& session, const QString& recording, QWidget* parent,
             std::function<void(const link::JoinOptions&)> join);
  ~JoinDialog() override;

 private:
  struct Files;  // that are read, on the worker's thread
  struct Read {
    std::vector<link::JoinTarget> targets;
    std::shared_ptr<const link::ComparedTarget> compared;
    std::vector<std::string> notes;
    std::size_t files = 1;
    double length = 0.0;       // s, of the recording
    double clocksApart = 0.0;  // s, as the two computers' clocks say
  };
  void makeRows();
  /// Reads the robot of this name; empty: the proposed one.
  void read(const std::string& robot);
  void show(const Result<Read>& read);
  void showClock(const link::RobotClock& clock);
  link::RobotClock clock() const;
  bool isEstimate() const;
  void compareSoon();
  void compare();
  void showAgreement(const link::ClockAgreement& agreement);
  void showMessage(const QString& sentence, bool bad);

  std::string m_session, m_recording;
  std::shared_ptr<Files> m_files;
  std::shared_ptr<const link::ComparedTarget> m_compared;  // null: not known yet
  std::optional<link::RobotClock> m_estimate;              // as the boxes show it

  QLabel *m_what, *m_offsetEstimate, *m_driftEstimate, *m_agreement, *m_effect, *m_message;
  QComboBox* m_robot;
  NumberBox *m_offset, *m_drift;
  QPushButton *m_useEstimate, *m_join;
  ClockView* m_view;

  QTimer m_compareTimer;
  int m_jobs = 0;                                  // only the newest one's result counts
  std::shared_ptr<std::atomic<bool>> m_cancelled;  // of the reading that goes on
  UiQueue m_toUi;
  Workers m_worker;
};

}  // namespace pitchboard::ui

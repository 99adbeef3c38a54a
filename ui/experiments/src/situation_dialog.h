// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What must hold in a test that starts from a moment, how it is played, and where it is written.
// Says at once what cannot be. UI thread; Qt owns it.

#include <QDialog>
#include <optional>

#include <robotlink/experiment/situation_test.h>
#include <ui/sources/frame_source.h>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;
class QSettings;
class QSpinBox;

namespace pitchboard::ui {

class NumberBox;

class SituationDialog : public QDialog {
  Q_OBJECT
 public:
  /// `settings` may be null: the folder is not kept.
  SituationDialog(FramePtr frame, std::optional<link::Scenario> base, QSettings* settings,
                  QWidget* parent);

 signals:
  void saved(const QString& path, bool play);

 private:
  void makeForm();
  void makeRobotRows(QFormLayout* form);
  QWidget* makeAssertions();
  QWidget* makeEnds();
  QWidget* makeFolder();
  void makeButtons();
  void add(const link::SituationTemplate& one);
  link::SituationTest situation() const;
  QString path() const;
  void check();
  void showStatus(const QString& text, const QColor& colour);
  void save(bool play);

  FramePtr m_frame;
  std::optional<link::Scenario> m_base;
  QSettings* m_settings;
  QLineEdit *m_name, *m_folder;
  QComboBox *m_team, *m_behaviour, *m_poses;
  QPlainTextEdit* m_assertions;
  NumberBox* m_seconds;
  QCheckBox* m_noCalls;
  QCheckBox *m_goal, *m_goalAgainst, *m_ballOut, *m_fell, *m_stuck;
  QSpinBox *m_runs, *m_spread;
  QLabel *m_note, *m_problem;
  QPushButton *m_play = nullptr, *m_save = nullptr;
};

}  // namespace pitchboard::ui

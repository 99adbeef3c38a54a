// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A profile of messages as a table: one row for each field, in the order of the message. Saved as
// JSON, with everything of the profile that the table does not show (format, bytes, ...).
// What is wrong is said under the table. UI thread only.

#include <QDialog>
#include <QString>
#include <memory>
#include <vector>

#include <telemetry/formats/profile.h>

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;

namespace pitchboard::ui {

class Arrivals;
class LiveController;

class ProfileEditor : public QDialog {
  Q_OBJECT
 public:
  /// `file`: where it was read from; empty when there is none yet. With `live`, what the profile
  /// makes of the last message that arrived is shown.
  ProfileEditor(const telemetry::Profile& profile, const QString& file, QWidget* parent,
                LiveController* live = nullptr);
  ~ProfileEditor() override;

  /// What the table says at the moment, valid or not.
  telemetry::Profile profile() const;
  /// False when it is not valid or cannot be written; the reason is shown.
  bool saveTo(const QString& file);

 signals:
  void saved(const pitchboard::telemetry::Profile& profile, const QString& file);

 private:
  void addFrame(QFormLayout* form);
  void showLast();
  void addRow(int row, const telemetry::ProfileField& field);
  telemetry::ProfileField fieldAt(int row) const;
  void moveRow(int by);
  void removeRows();
  void check();
  void askAndSave();
  void showStatus(const QString& sentence, bool bad);

  QString m_file;
  const telemetry::Profile m_opened;
  /// Every field that has been put into a row; the row names its place here.
  std::vector<telemetry::ProfileField> m_fields;
  QLineEdit *m_name, *m_end;
  QComboBox *m_origin, *m_xAxis, *m_yAxis, *m_angles;
  QTableWidget* m_table;
  QLabel *m_last, *m_problem;
  LiveController* m_live;
  std::unique_ptr<Arrivals> m_arrivals;
  QPushButton* m_save;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The team setups of Live (docs/live.md, "Team setups") as a form, and below it what arrives, as
// these setups would read it, before they are put to use. Qt owns it. UI thread only.

#include <QWidget>
#include <vector>

#include <telemetry/monitor/team_setup.h>

#include "arrivals.h"
#include "team_draft.h"
#include "team_preview.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QSpinBox;
class QTableWidget;
class QToolButton;

namespace pitchboard::ui {

class TeamsPage : public QWidget {
  Q_OBJECT
 public:
  TeamsPage(LiveController* live, QWidget* parent);

  void setTeams(const std::vector<telemetry::TeamSetup>& teams);
  /// Errors name the team and what is wrong.
  Result<std::vector<telemetry::TeamSetup>> teams() const;
  /// Adds the setup of a file, and shows it.
  Result<void> load(const QString& path);
  Result<void> save(const QString& path);

 private:
  /// Of the list's row; null: none is chosen.
  TeamDraft* current();
  QLayout* makeList();
  QWidget* makeForm();
  void fillProfiles();
  void add(TeamDraft draft);
  void show(int place);
  void take();
  void name(int place);
  void chooseProfile(int index);
  void ask(bool save);
  void preview();
  void showStatus(const QString& sentence, bool bad);

  LiveController* m_live;
  Arrivals m_arrivals;
  std::vector<KnownFormat> m_known;  ///< the built-in profiles
  std::vector<TeamDraft> m_drafts;
  bool m_filling = false;
  QListWidget* m_list;
  QLabel* m_empty;  // in the list, while there is no team
  QToolButton *m_remove, *m_save;
  QWidget* m_form;
  QLineEdit *m_name, *m_senders, *m_names;
  QSpinBox *m_number, *m_firstPort, *m_lastPort;
  QComboBox *m_colour, *m_profile, *m_attacks;
  QTableWidget* m_table;
  QLabel* m_message;
};

}  // namespace pitchboard::ui

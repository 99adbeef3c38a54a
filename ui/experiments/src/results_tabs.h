// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What came out of an experiment, on tabs behind those that the owner has put first: tables, ways
// on the field, distributions. The corner has what belongs to the tab that is shown: which
// condition, which metric, seeing the chosen runs. UI thread; owned by the dock.

#include <QTabWidget>
#include <vector>

#include "results_model.h"

class QComboBox;
class QLabel;
class QPushButton;
class QTableView;

namespace pitchboard::ui {

class DistributionView;
class TrajectoriesView;

class ResultsTabs : public QTabWidget {
  Q_OBJECT
 public:
  /// `compares`: two runs may be asked for.
  ResultsTabs(bool compares, QWidget* parent);
  /// Adds the tabs, behind those that are there.
  void addTabs();
  void showResults(const PlayedPtr& played);
  /// Before the first results: that there are none, and why.
  void showPlaying(bool playing);

 signals:
  /// One run is to be seen, or two over each other.
  void asked(const std::vector<std::size_t>& numbers);

 private:
  QTableView* addTable(ResultsModel::Kind kind, const QString& title, const QString& name);
  void makeCorner();
  std::size_t numberOf(const QModelIndex& index) const;
  std::vector<std::size_t> chosenRuns() const;
  void showChoices();
  void highlight();
  void cover(QWidget* area, const QString& name);

  bool m_compares;
  QPushButton* m_seeRuns;
  QComboBox* m_condition;
  TrajectoriesView* m_trajectories;
  DistributionView* m_distribution;
  std::vector<ResultsModel*> m_models;
  std::vector<QTableView*> m_tables;
  QTableView* m_runsTable = nullptr;
  std::vector<QLabel*> m_empty;  // say why nothing is shown; in the order of the tabs
  PlayedPtr m_shown;
};

}  // namespace pitchboard::ui

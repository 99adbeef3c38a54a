// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The tree of variables on the screen: keyboard, drag, and a memory by name of what is open and
// selected, which outlasts the source.

#include <QSet>
#include <QTreeView>

class QTimer;

namespace pitchboard::ui {

class VariablesFilter;
class VariablesHeader;
class VariablesModel;

class VariablesView : public QTreeView {
  Q_OBJECT
 public:
  VariablesView(VariablesModel* model, VariablesFilter* filter, QWidget* parent = nullptr);

  VariablesHeader* columns() const { return m_header; }
  /// Rows in sight, as indexes of the model.
  QModelIndexList rowsInSight() const;
  /// Widens the columns of numbers until every number in sight is whole.
  void fitNumbers();
  /// Device pixels of a sparkline; 0 when that column is hidden.
  int sparkPixels() const;
  /// "B1/VISION_LOST" for each selected variable, from top to bottom.
  QStringList selectedVariables() const;
  /// To call after the filter was set: everything found is opened, or what was open before again.
  void followFilter();
  void copySelection() const;
  void requestFavourites() { emit favouriteRequested(selectedInModel()); }
  void editCurrent();
  /// Selects the first variable that is listed, and takes the focus; nothing if there is none.
  void goToFirst();
  void openAll();
  void closeAll();
  bool isEditing() const { return state() == EditingState; }
  /// What was never set in this category (path) is listed, or folded into its last row again.
  void toggleRest(const QString& category);

 signals:
  void plotRequested(const QStringList& names);
  void favouriteRequested(const QModelIndexList& indexes);  ///< of the model
  /// A value that cannot be edited (now) was double-clicked, or F2 pressed on it.
  void editRefused(const QModelIndex& index);  ///< of the model

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void startDrag(Qt::DropActions actions) override;
  void selectionChanged(const QItemSelection& selected, const QItemSelection& gone) override;

 private:
  void editValue(const QModelIndex& index);
  /// Nothing but on the last row of a category.
  bool toggleRestAt(const QModelIndex& index);
  void remember(const QModelIndex& index, bool open);
  void restoreSoon();
  void restore();
  void openAtFirst();
  QModelIndexList selectedInModel() const;

  VariablesModel* m_model;
  VariablesFilter* m_filter;
  VariablesHeader* m_header;
  QTimer* m_restoreTimer;
  QSet<QString> m_open, m_closedWhileFiltering, m_selected;
  QString m_current;
  bool m_remembers = true;  // false while rows come and go by themselves
  bool m_openedAtFirst = false;
};

}  // namespace pitchboard::ui

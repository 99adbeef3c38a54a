// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Header of the tree of variables: widths, which columns are shown, and the order of rows.

#include <QHeaderView>

class QMenu;

namespace pitchboard::ui {

class VariablesHeader : public QHeaderView {
  Q_OBJECT
 public:
  explicit VariablesHeader(QWidget* parent);

  /// To call once the header has its model: first widths, and the order of the catalog.
  void setUpColumns();
  /// One entry for each column that may be hidden, in place of what the menu had.
  void fillColumns(QMenu* menu);
  /// For the next start, without what is hidden for want of room. At the end.
  QByteArray stateToKeep();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  bool m_hidSpark = false;  // for want of room
};

}  // namespace pitchboard::ui

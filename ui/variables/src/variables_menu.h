// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel's menu: columns, what counts as changed, sampling, folding, catalog, other blackboards.
// Keeps what was chosen there in the settings. UI thread only; the panel owns it.

#include <QMenu>

namespace pitchboard::ui {

class CatalogChoice;
class VariablesFilter;
class VariablesView;
struct VariablesContext;

class VariablesMenu : public QMenu {
  Q_OBJECT
 public:
  VariablesMenu(const VariablesContext& context, VariablesView* view, VariablesFilter* filter,
                CatalogChoice* catalog, QWidget* parent);

  /// Seconds of the source within which a value counts as just changed.
  int changedWithin() const { return m_changedWithin; }

 signals:
  void changedWithinChosen();

 private:
  void fillChanged(QMenu* menu);
  void fillSampling(QMenu* menu);
  void addFolding();
  void addBoards();
  void keep(const QString& key, const QVariant& value);

  const VariablesContext& m_context;
  VariablesView* m_view;
  VariablesFilter* m_filter;
  CatalogChoice* m_catalog;
  int m_changedWithin = 5;
};

}  // namespace pitchboard::ui

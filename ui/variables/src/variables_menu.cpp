// SPDX-License-Identifier: GPL-3.0-or-later
#include "variables_menu.h"

#include <QSettings>

#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/shown_moment.h>
#include <ui/variables/variables_dock.h>

#include "catalog_choice.h"
#include "variables_filter.h"
#include "variables_header.h"
#include "variables_view.h"

namespace pitchboard::ui {
namespace {
const QString samplingKey = QStringLiteral("variables/everyNthTick");
const QString changedKey = QStringLiteral("variables/changedWithin");
const QString foldKey = QStringLiteral("variables/foldNeverSet");
}  // namespace

VariablesMenu::VariablesMenu(const VariablesContext& context, VariablesView* view,
                             VariablesFilter* filter, CatalogChoice* catalog, QWidget* parent)
    : QMenu(parent), m_context(context), m_view(view), m_filter(filter), m_catalog(catalog) {
  if (const QSettings* settings = context.settings) {
    m_changedWithin = qBound(1, settings->value(changedKey, m_changedWithin).toInt(), 3600);
    context.controller->memory()->setSampling(
        qBound(1, settings->value(samplingKey, 1).toInt(), 60));
    filter->setFolding(settings->value(foldKey, true).toBool());
  }
  QMenu* columns = addMenu(QStringLiteral("Columns"));
  connect(columns, &QMenu::aboutToShow, this,
          [this, columns] { m_view->columns()->fillColumns(columns); });
  QMenu* changed = addMenu(QStringLiteral("Changed means"));
  connect(changed, &QMenu::aboutToShow, this, [this, changed] { fillChanged(changed); });
  QMenu* sampling = addMenu(QStringLiteral("Sampling"));
  connect(sampling, &QMenu::aboutToShow, this, [this, sampling] { fillSampling(sampling); });
  addSeparator();
  addBoards();
  addSeparator();
  addFolding();
  addAction(QStringLiteral("Open all"), view, &VariablesView::openAll);
  addAction(QStringLiteral("Close all"), view, &VariablesView::closeAll);
}

void VariablesMenu::keep(const QString& key, const QVariant& value) {
  if (m_context.settings) m_context.settings->setValue(key, value);
}

void VariablesMenu::fillChanged(QMenu* menu) {
  menu->clear();
  for (const int seconds : {1, 5, 15, 60}) {
    QAction* action =
        menu->addAction(seconds == 1 ? QStringLiteral("Within the last second")
                                     : QStringLiteral("Within the last %1 s").arg(seconds));
    action->setCheckable(true);
    action->setChecked(seconds == m_changedWithin);
    connect(action, &QAction::triggered, this, [this, seconds] {
      m_changedWithin = seconds;
      keep(changedKey, seconds);
      emit changedWithinChosen();
    });
  }
}

void VariablesMenu::fillSampling(QMenu* menu) {
  menu->clear();
  for (const int ticks : {1, 2, 5, 10, 30, 60}) {
    QAction* action = menu->addAction(ticks == 1 ? QStringLiteral("Each tick")
                                                 : QStringLiteral("Every %1 ticks").arg(ticks));
    action->setCheckable(true);
    action->setChecked(m_context.controller->memory()->sampling() == ticks);
    connect(action, &QAction::triggered, this, [this, ticks] {
      m_context.controller->memory()->setSampling(ticks);
      keep(samplingKey, ticks);
    });
  }
}

void VariablesMenu::addFolding() {
  QAction* fold = addAction(QStringLiteral("Fold variables never set"));
  fold->setObjectName(QStringLiteral("foldNeverSet"));
  fold->setToolTip(
      QStringLiteral("Variables that have been zero or without a value since the start"));
  fold->setCheckable(true);
  fold->setChecked(m_filter->isFolding());
  connect(fold, &QAction::toggled, this, [this](bool on) {
    m_filter->setFolding(on);
    keep(foldKey, on);
  });
}

void VariablesMenu::addBoards() {
  addAction(QStringLiteral("Import catalog…"), this, [this] {
    m_catalog->askAndImport(parentWidget());
  })->setObjectName(QStringLiteral("importCatalog"));
  QAction* reset = addAction(QStringLiteral("Use the published catalog"), this,
                             [this] { m_catalog->usePublished(); });
  reset->setObjectName(QStringLiteral("publishedCatalog"));
  if (m_context.attachBoard) {
    QAction* attach = addAction(QStringLiteral("Attach blackboard…"), this, m_context.attachBoard);
    attach->setObjectName(QStringLiteral("attachBlackboard"));
    attach->setToolTip(QStringLiteral("Samples any System V key of this computer, read-only"));
  }
  connect(this, &QMenu::aboutToShow, this, [this, reset] {
    reset->setEnabled(!m_catalog->isPublished());
    reset->setToolTip(m_catalog->name());
  });
}

}  // namespace pitchboard::ui

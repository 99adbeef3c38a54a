// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout_command.h"

#include <utility>

namespace pitchboard::ui {
namespace {

constexpr qint64 oneChange = 1000;  // ms

int countOfCurves(const PlotLayout& layout) {
  int count = 0;
  for (const PageSpec& page : layout.pages) {
    for (const PaneSpec& pane : page.panes) count += static_cast<int>(pane.curves.size());
  }
  return count;
}

/// Tabs, plots in each, curves in each of them.
QList<QList<qsizetype>> shapeOf(const PlotLayout& layout) {
  QList<QList<qsizetype>> shape;
  for (const PageSpec& page : layout.pages) {
    shape << QList<qsizetype>();
    for (const PaneSpec& pane : page.panes) shape.back() << pane.curves.size();
  }
  return shape;
}

QString wordsFor(const PlotLayout& before, const PlotLayout& after) {
  const int was = countOfCurves(before), is = countOfCurves(after);
  if (is > was) return QStringLiteral("Add to the plots");
  if (is < was) return QStringLiteral("Remove from the plots");
  return QStringLiteral("Change the plots");
}

}  // namespace

LayoutCommand::LayoutCommand(PlotLayout before, PlotLayout after,
                             std::function<void(const PlotLayout&)> put)
    : QUndoCommand(wordsFor(before, after)),
      m_before(std::move(before)),
      m_after(std::move(after)),
      m_put(std::move(put)) {
  m_age.start();
}

void LayoutCommand::undo() {
  m_put(m_before);
}

void LayoutCommand::redo() {
  if (!std::exchange(m_done, false)) m_put(m_after);
}

bool LayoutCommand::mergeWith(const QUndoCommand* next) {
  const auto* other = static_cast<const LayoutCommand*>(next);
  const bool looks =
      shapeOf(m_before) == shapeOf(m_after) && shapeOf(m_after) == shapeOf(other->m_after);
  if (!looks || m_age.elapsed() > oneChange) return false;
  m_after = other->m_after;
  m_age.restart();
  return true;
}

}  // namespace pitchboard::ui

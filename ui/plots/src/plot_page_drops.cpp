// SPDX-License-Identifier: GPL-3.0-or-later
// What happens to variables that are dropped on a page of plots.
#include <QDragEnterEvent>
#include <QMimeData>
#include <QSplitter>

#include <ui/base/plot_target.h>
#include <ui/base/theme.h>

#include "plot_page.h"
#include "time_ruler.h"

namespace pitchboard::ui {
namespace {
constexpr int edge = 14;        // a drop this close to an edge makes a plot of its own
constexpr int mostNames = 200;  // of one drop
}  // namespace

QStringList draggedVariables(const QMimeData* data) {
  if (data == nullptr || !data->hasFormat(variablesMimeType)) return {};
  QStringList names;
  for (const QString& line : QString::fromUtf8(data->data(variablesMimeType)).split('\n')) {
    const QString name = line.trimmed();
    if (name.indexOf(QLatin1Char('/')) > 0 && !names.contains(name) && names.size() < mostNames) {
      names << name;
    }
  }
  return names;
}

PlotPage::Target PlotPage::targetAt(const QPoint& position, qsizetype count) const {
  const QPoint at = m_stack->mapFrom(this, position);
  const int reach = scaled(this, edge);
  Target target;
  target.index = m_panes->count();
  const QList<PlotPane*> all = panes();
  for (qsizetype i = 0; i < all.size(); ++i) {
    const QRect area(all[i]->mapTo(m_stack, QPoint()), all[i]->size());
    if (at.y() < area.top() + reach && at.y() >= area.top() - reach) {
      target.index = static_cast<int>(i);
      target.area = QRect(area.left(), area.top() - reach / 2, area.width(), reach);
      return target;
    }
    if (area.contains(at) && at.y() < area.bottom() - reach) {
      return {Place::OnPane, all[i], static_cast<int>(i), area};
    }
  }
  // Below the last plot, or on an empty page.
  target.area = all.isEmpty()
                    ? m_stack->rect()
                    : QRect(0, m_stack->height() - 2 * reach, m_stack->width(), 2 * reach);
  const int third = m_stack->width() / 3;
  if (count == 2 && at.x() > m_stack->width() - third) {
    target.place = Place::NewXy;
    target.area.setLeft(m_stack->width() - third);
  }
  return target;
}

void PlotPage::drop(const QStringList& names, const QPoint& position) {
  if (names.isEmpty()) return;
  const Target target = targetAt(position, names.size());
  if (target.place == Place::NewXy) {
    PaneSpec xy;
    xy.kind = PaneKind::Xy;
    xy.curves << variableCurve(names[0]);
    xy.curves[0].inputs << names[1];
    // A path on the field is one only when a metre is a metre in both directions.
    const ColumnView x = m_feed->find(names[0]), y = m_feed->find(names[1]);
    xy.equalScales = x && y && !x.info().unit.empty() && x.info().unit == y.info().unit;
    insertPane(m_panes->count(), xy);
    return;
  }
  PaneSpec chart, lane;
  lane.kind = PaneKind::Lane;
  int number = 0;
  for (const QString& name : names) {
    const bool coded = isCoded(name);
    const PaneKind kind = coded ? PaneKind::Lane : PaneKind::Chart;
    if (target.place == Place::OnPane && target.pane->kind() == kind) {
      target.pane->addCurve(variableCurve(name));
      continue;
    }
    CurveSpec curve = variableCurve(name);
    curve.colorNumber = number++;
    (coded ? lane : chart).curves << curve;
  }
  int index = target.place == Place::OnPane ? target.index + 1 : target.index;
  if (!chart.curves.isEmpty()) insertPane(index++, chart);
  if (!lane.curves.isEmpty()) insertPane(index, lane);
}

void PlotPage::dragEnterEvent(QDragEnterEvent* event) {
  if (!draggedVariables(event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void PlotPage::dragMoveEvent(QDragMoveEvent* event) {
  const QStringList names = draggedVariables(event->mimeData());
  if (names.isEmpty()) return;
  event->acceptProposedAction();
  const Target target = targetAt(event->position().toPoint(), names.size());
  const QString words = target.place == Place::OnPane  ? QStringLiteral("add to this plot")
                        : target.place == Place::NewXy ? QStringLiteral("one over the other (XY)")
                                                       : QStringLiteral("new plot");
  m_lines->setHint(DropHint{target.area, words});
}

void PlotPage::dragLeaveEvent(QDragLeaveEvent*) {
  m_lines->setHint({});
}

void PlotPage::dropEvent(QDropEvent* event) {
  m_lines->setHint({});
  const QStringList names = draggedVariables(event->mimeData());
  if (names.isEmpty()) return;
  event->acceptProposedAction();
  drop(names, event->position().toPoint());
}

}  // namespace pitchboard::ui

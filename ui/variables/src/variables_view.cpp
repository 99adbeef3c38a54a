// SPDX-License-Identifier: GPL-3.0-or-later
#include "variables_view.h"

#include <QApplication>
#include <QClipboard>
#include <QDrag>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMimeData>
#include <QPainter>
#include <QTimer>
#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>

#include "variables_delegate.h"
#include "variables_filter.h"
#include "variables_header.h"
#include "variables_model.h"

namespace pitchboard::ui {
namespace {
// Opening more rows than that on every key of a filter would be slow, and helps nobody.
constexpr int openAllUpTo = 1500;
}  // namespace

VariablesView::VariablesView(VariablesModel* model, VariablesFilter* filter, QWidget* parent)
    : QTreeView(parent),
      m_model(model),
      m_filter(filter),
      m_header(new VariablesHeader(this)),
      m_restoreTimer(new QTimer(this)) {
  setObjectName(QStringLiteral("variablesView"));
  setFrameShape(QFrame::NoFrame);
  setAlternatingRowColors(true);
  setUniformRowHeights(true);
  setSelectionMode(ExtendedSelection);
  setEditTriggers(NoEditTriggers);
  setDragEnabled(true);
  setDragDropMode(DragOnly);
  setIndentation(scaled(this, 8));
  setTextElideMode(Qt::ElideMiddle);  // names differ at both ends
  setAnimated(false);
  setExpandsOnDoubleClick(true);
  setItemDelegate(new VariablesDelegate(this));
  m_restoreTimer->setSingleShot(true);
  m_restoreTimer->setInterval(0);
  connect(m_restoreTimer, &QTimer::timeout, this, &VariablesView::restore);
  // Before setModel(): the selection loses rows that go, and must not be remembered without them.
  const auto rest = [this] { m_remembers = false; };
  connect(filter, &QAbstractItemModel::modelAboutToBeReset, this, rest);
  connect(filter, &QAbstractItemModel::rowsAboutToBeRemoved, this, rest);
  setHeader(m_header);
  setModel(filter);
  m_header->setUpColumns();
  setSortingEnabled(true);
  connect(filter, &QAbstractItemModel::modelReset, this, &VariablesView::restoreSoon);
  connect(filter, &QAbstractItemModel::rowsRemoved, this, &VariablesView::restoreSoon);
  connect(filter, &QAbstractItemModel::rowsInserted, this, &VariablesView::restoreSoon);
  connect(this, &QTreeView::clicked, this, [this](const QModelIndex& at) { toggleRestAt(at); });
  connect(this, &QTreeView::expanded, this,
          [this](const QModelIndex& index) { remember(index, true); });
  connect(this, &QTreeView::collapsed, this,
          [this](const QModelIndex& index) { remember(index, false); });
}

void VariablesView::remember(const QModelIndex& index, bool open) {
  if (!m_remembers) return;
  const QString path = index.data(VariablesModel::PathRole).toString();
  if (m_filter->isFiltering()) {
    if (open)
      m_closedWhileFiltering.remove(path);
    else
      m_closedWhileFiltering.insert(path);
  } else if (open) {
    m_open.insert(path);
  } else {
    m_open.remove(path);
  }
}

void VariablesView::selectionChanged(const QItemSelection& selected, const QItemSelection& gone) {
  QTreeView::selectionChanged(selected, gone);
  if (!m_remembers) return;
  const QStringList names = selectedVariables();
  m_selected = QSet<QString>(names.begin(), names.end());
  m_current = currentIndex().siblingAtColumn(0).data(VariablesModel::PathRole).toString();
}

void VariablesView::followFilter() {
  m_closedWhileFiltering.clear();
  restore();
}

// QTreeView's own expandAll() does not say what it opened.
void VariablesView::openAll() {
  m_closedWhileFiltering.clear();
  QSet<QString> categories = m_filter->unfolded();
  for (int g = 0; g < m_model->rowCount(); ++g) {
    const QModelIndex group = m_model->index(g, 0);
    m_open.insert(group.data(VariablesModel::PathRole).toString());
    for (int h = 0; h < m_model->rowCount(group); ++h) {
      categories.insert(m_model->index(h, 0, group).data(VariablesModel::PathRole).toString());
    }
  }
  m_open += categories;
  m_openedAtFirst = true;
  m_filter->setUnfolded(categories);
  restore();
}

void VariablesView::closeAll() {
  m_open.clear();
  m_openedAtFirst = true;
  m_filter->setUnfolded({});
  restore();
}

void VariablesView::toggleRest(const QString& category) {
  QSet<QString> shown = m_filter->unfolded();
  if (!shown.remove(category)) shown.insert(category);
  m_filter->setUnfolded(shown);
}

bool VariablesView::toggleRestAt(const QModelIndex& index) {
  const QModelIndex row = m_filter->mapToSource(index.siblingAtColumn(0));
  if (!row.isValid() || m_model->kindOf(row) != VariablesModel::Kind::Rest) return false;
  toggleRest(row.parent().data(VariablesModel::PathRole).toString());
  return true;
}

void VariablesView::restoreSoon() {
  m_restoreTimer->start();
}

// What a newcomer wants to see is in sight without a click.
void VariablesView::openAtFirst() {
  if (m_openedAtFirst || m_model->rowCount() == 0) return;
  m_openedAtFirst = true;
  const QString first = m_model->index(0, 0).data(VariablesModel::PathRole).toString();
  m_open << first;
  for (const char* category : {"Vision", "Localization", "Decision"}) {
    m_open << first + QLatin1Char('\n') + QLatin1String(category);
  }
}

void VariablesView::restore() {
  m_restoreTimer->stop();
  openAtFirst();
  m_remembers = false;
  setUpdatesEnabled(false);
  const bool filtering = m_filter->isFiltering();
  const bool few = filtering && m_filter->variableCount() <= openAllUpTo;
  const auto wanted = [&](const QModelIndex& index) {
    const QString path = index.data(VariablesModel::PathRole).toString();
    return filtering ? few && !m_closedWhileFiltering.contains(path) : m_open.contains(path);
  };
  for (int g = 0; g < m_filter->rowCount(); ++g) {
    const QModelIndex group = m_filter->index(g, 0);
    if (wanted(group) != isExpanded(group)) setExpanded(group, wanted(group));
    for (int h = 0; h < m_filter->rowCount(group); ++h) {
      const QModelIndex category = m_filter->index(h, 0, group);
      if (wanted(category) != isExpanded(category)) setExpanded(category, wanted(category));
    }
  }
  const auto inView = [this](const QString& path) {
    return m_filter->mapFromSource(m_model->find(path));
  };
  if (!m_current.isEmpty() && !currentIndex().isValid()) {
    if (const QModelIndex current = inView(m_current); current.isValid()) {
      selectionModel()->setCurrentIndex(current, QItemSelectionModel::NoUpdate);
    }
  }
  for (const QString& path : std::as_const(m_selected)) {
    const QModelIndex index = inView(path);
    if (index.isValid() && !selectionModel()->isSelected(index)) {
      selectionModel()->select(index, QItemSelectionModel::Select | QItemSelectionModel::Rows);
    }
  }
  setUpdatesEnabled(true);
  m_remembers = true;
}

QModelIndexList VariablesView::rowsInSight() const {
  QModelIndexList rows;
  const int bottom = viewport()->height();
  for (QModelIndex at = indexAt({0, 0}); at.isValid(); at = indexBelow(at)) {
    if (visualRect(at).top() > bottom) break;
    rows << m_filter->mapToSource(at.siblingAtColumn(0));
  }
  return rows;
}

// Columns do not become narrower again: names would jump while values run.
void VariablesView::fitNumbers() {
  const QModelIndexList rows = rowsInSight();
  constexpr std::array numbers{VariablesModel::Value, VariablesModel::Rate, VariablesModel::Age};
  for (const int column : numbers) {
    if (isColumnHidden(column)) continue;
    int wanted = columnWidth(column);
    for (const QModelIndex& row : rows) {
      const QModelIndex cell = row.siblingAtColumn(column);
      const QVariant own = cell.data(Qt::FontRole);
      const double words =
          textLineWidth(own.isValid() ? own.value<QFont>() : font(), cell.data().toString());
      wanted = std::max(wanted, static_cast<int>(std::ceil(words)) + scaled(this, 10));
    }
    // Names keep something, whatever a value says.
    wanted = std::min(wanted, std::max(columnWidth(column), viewport()->width() / 2));
    if (wanted != columnWidth(column)) setColumnWidth(column, wanted);
  }
}

int VariablesView::sparkPixels() const {
  if (isColumnHidden(VariablesModel::Spark)) return 0;
  constexpr int fewest = 8, most = 2000;
  const int width = columnWidth(VariablesModel::Spark) - 2 * scaled(this, 4);
  return std::clamp(static_cast<int>(width * devicePixelRatioF()), fewest, most);
}

QModelIndexList VariablesView::selectedInModel() const {
  QModelIndexList rows = selectionModel()->selectedRows();
  std::sort(rows.begin(), rows.end(), [this](const QModelIndex& a, const QModelIndex& b) {
    return visualRect(a).top() < visualRect(b).top();
  });
  for (QModelIndex& row : rows) row = m_filter->mapToSource(row);
  return rows;
}

QStringList VariablesView::selectedVariables() const {
  return VariablesModel::variableNames(selectedInModel());
}

void VariablesView::copySelection() const {
  QStringList lines;
  for (const QModelIndex& row : selectedInModel()) {
    if (m_model->kindOf(row) != VariablesModel::Kind::Variable) continue;
    lines << row.data(VariablesModel::PathRole).toString() + QLatin1Char(' ') +
                 row.siblingAtColumn(VariablesModel::Value).data(Qt::EditRole).toString();
  }
  if (!lines.isEmpty()) QApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

void VariablesView::editCurrent() {
  editValue(currentIndex());
}

void VariablesView::goToFirst() {
  QModelIndex at = m_filter->index(0, 0);
  while (at.isValid() && m_model->columnOf(m_filter->mapToSource(at)) == nullptr) {
    if (m_filter->hasChildren(at)) expand(at);
    at = indexBelow(at);
  }
  if (!at.isValid()) return;
  setCurrentIndex(at);
  setFocus(Qt::ShortcutFocusReason);
}

void VariablesView::editValue(const QModelIndex& index) {
  const QModelIndex value = index.siblingAtColumn(VariablesModel::Value);
  if (value.flags().testFlag(Qt::ItemIsEditable)) {
    scrollTo(value);
    edit(value);
  } else {
    emit editRefused(m_filter->mapToSource(value));
  }
}

void VariablesView::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Copy)) {
    copySelection();
    return;
  }
  const QModelIndex current = currentIndex();
  const bool onVariable =
      current.isValid() && m_model->columnOf(m_filter->mapToSource(current)) != nullptr;
  switch (event->key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (isEditing()) break;
      if (const QStringList names = selectedVariables(); !names.isEmpty()) {
        emit plotRequested(names);
      } else if (current.isValid() && !toggleRestAt(current)) {
        setExpanded(current.siblingAtColumn(0), !isExpanded(current.siblingAtColumn(0)));
      }
      return;
    case Qt::Key_Asterisk:  // QTreeView would open everything below
      requestFavourites();
      return;
    case Qt::Key_F2:
      if (onVariable) editCurrent();
      return;
    default:
      break;
  }
  QTreeView::keyPressEvent(event);
}

void VariablesView::mouseDoubleClickEvent(QMouseEvent* event) {
  const QModelIndex index = indexAt(event->position().toPoint());
  if (event->button() == Qt::LeftButton && index.isValid() &&
      m_model->columnOf(m_filter->mapToSource(index)) != nullptr) {
    if (index.column() == VariablesModel::Value)
      editValue(index);
    else
      emit plotRequested({index.siblingAtColumn(0).data(VariablesModel::PathRole).toString()});
    return;
  }
  QTreeView::mouseDoubleClickEvent(event);
}

void VariablesView::startDrag(Qt::DropActions) {
  const QStringList names = selectedVariables();
  if (names.isEmpty()) return;
  // Owned by the drag system while the drag goes on.
  auto* drag = new QDrag(this);
  drag->setMimeData(m_model->mimeData(selectedInModel()));
  const QString label =
      names.size() == 1 ? names.front() : QStringLiteral("%1 variables").arg(names.size());
  const QFontMetrics metrics(font());
  const int gap = scaled(this, 6);
  const QSize size(metrics.horizontalAdvance(label) + 2 * gap, metrics.height() + gap);
  QPixmap picture(size * devicePixelRatioF());
  picture.setDevicePixelRatio(devicePixelRatioF());
  picture.fill(theme().selectedRow);
  QPainter painter(&picture);
  painter.setFont(font());
  painter.setPen(theme().text);
  painter.drawText(QRect(QPoint(), size), Qt::AlignCenter, label);
  painter.end();
  drag->setPixmap(picture);
  drag->exec(Qt::CopyAction);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "variables_delegate.h"

#include <QApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <QTreeView>
#include <algorithm>
#include <cmath>

#include <ui/base/elide_text.h>
#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>

#include "value_edit.h"
#include "variable_text.h"
#include "variables_model.h"

namespace pitchboard::ui {
namespace {

// Through the extremes of every pixel in the order of its samples; NaN leaves a gap, a pixel
// without samples does not.
QPainterPath sparkPath(const QList<telemetry::SeriesBucket>& buckets, const QRectF& area) {
  double low = INFINITY, high = -INFINITY;
  for (const auto& bucket : buckets) {
    if (bucket.samples == 0 || !std::isfinite(bucket.min) || !std::isfinite(bucket.max)) continue;
    low = std::min(low, bucket.min);
    high = std::max(high, bucket.max);
  }
  QPainterPath path;
  if (!(low <= high)) return path;
  const auto yOf = [&](double value) {
    return high > low ? area.bottom() - (value - low) / (high - low) * area.height()
                      : area.center().y();
  };
  const double step = area.width() / static_cast<double>(buckets.size());
  bool pen = false;
  for (qsizetype i = 0; i < buckets.size(); ++i) {
    const auto& bucket = buckets[i];
    if (bucket.samples == 0) continue;
    if (!std::isfinite(bucket.min) || !std::isfinite(bucket.max)) {
      pen = false;
      continue;
    }
    const double x = area.left() + (static_cast<double>(i) + 0.5) * step;
    const bool rises = !(bucket.last < bucket.first);
    for (const double value : {rises ? bucket.min : bucket.max, rises ? bucket.max : bucket.min}) {
      if (pen)
        path.lineTo(x, yOf(value));
      else
        path.moveTo(x, yOf(value));
      pen = true;
    }
  }
  return path;
}

/// Beside the text of a cell, px.
int marginOf(const QStyleOptionViewItem& option) {
  return option.widget->style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, option.widget) +
         1;
}

}  // namespace

QString VariablesDelegate::nameFor(const QModelIndex& index, const QFont& font, double room) {
  QString name = index.data().toString();
  const QString heading = index.parent().data().toString().toUpper() + QLatin1Char('_');
  const bool isUnder = name.startsWith(heading) && name.size() > heading.size();
  // All names of a heading are shortened, or none: where the longest of the published map has room.
  const bool isNarrow =
      room < QFontMetricsF(font).horizontalAdvance(QStringLiteral("VISION_PURPLE_LANDMARK_DEG"));
  return isUnder && isNarrow ? name.mid(heading.size()) : name;
}

QSize VariablesDelegate::sizeHint(const QStyleOptionViewItem& option,
                                  const QModelIndex& index) const {
  QSize size = QStyledItemDelegate::sizeHint(option, index);
  size.setHeight(scaled(option.widget, 20));
  return size;
}

void VariablesDelegate::initStyleOption(QStyleOptionViewItem* option,
                                        const QModelIndex& index) const {
  QStyledItemDelegate::initStyleOption(option, index);
  if (index.column() == VariablesModel::Name && option->rect.isValid()) {
    option->text = nameFor(index, option->font, option->rect.width() - 2 * marginOf(*option));
  }
  // Words of a code begin with what matters: "walk forward, fast".
  if (index.column() != VariablesModel::Name && option->rect.isValid()) {
    option->text = elideText(QFontMetricsF(option->font), option->text,
                             option->rect.width() - 2 * marginOf(*option));
  }
  if (index.column() == VariablesModel::Unit && flowsOver(*option, index)) option->text.clear();
}

bool VariablesDelegate::flowsOver(const QStyleOptionViewItem& option,
                                  const QModelIndex& index) const {
  const auto* tree = qobject_cast<const QTreeView*>(option.widget);
  if (tree == nullptr) return false;
  const QHeaderView* header = tree->header();
  const int unit = header->visualIndex(VariablesModel::Unit),
            spark = header->visualIndex(VariablesModel::Spark);
  if (spark < unit || header->isSectionHidden(VariablesModel::Spark) ||
      header->isSectionHidden(VariablesModel::Unit)) {
    return false;
  }
  for (int between = unit + 1; between < spark; ++between) {
    if (!header->isSectionHidden(header->logicalIndex(between))) return false;
  }
  const QString shown = index.siblingAtColumn(VariablesModel::Unit).data().toString();
  return textLineWidth(themeFont(TypeRole::Secondary), shown) >
         header->sectionSize(VariablesModel::Unit) - scaled(tree, 6);
}

// Both cells are painted by themselves; each shows its part of the same line.
void VariablesDelegate::paintFlowing(QPainter* painter, const QStyleOptionViewItem& option,
                                     const QModelIndex& index) const {
  const auto* tree = static_cast<const QTreeView*>(option.widget);
  const QModelIndex unit = index.siblingAtColumn(VariablesModel::Unit);
  QRect line = tree->visualRect(unit);
  line.setRight(tree->visualRect(index.siblingAtColumn(VariablesModel::Spark)).right());
  line.adjust(scaled(tree, 3), 0, -scaled(tree, 2), 0);
  const QFont font = themeFont(TypeRole::Secondary);
  painter->save();
  painter->setClipRect(option.rect, Qt::IntersectClip);
  painter->setFont(font);
  const QVariant color = unit.data(Qt::ForegroundRole);
  painter->setPen(color.isValid() ? color.value<QColor>() : theme().secondaryText);
  drawTextLine(*painter, line, Qt::AlignVCenter | Qt::AlignLeft, unit.data().toString(),
               Qt::ElideRight);
  painter->restore();
}

void VariablesDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                              const QModelIndex& index) const {
  const bool isUnit = index.column() == VariablesModel::Unit;
  const bool isSpark = index.column() == VariablesModel::Spark;
  const bool flows = (isUnit || isSpark) && flowsOver(option, index);
  constexpr QStyle::State marked =
      QStyle::State_Selected | QStyle::State_MouseOver | QStyle::State_HasFocus;
  if ((option.state & marked) || !(option.state & QStyle::State_Enabled))
    QStyledItemDelegate::paint(painter, option, index);
  else if (!isSpark && !flows)
    paintPlain(painter, option, index);
  if (flows)
    paintFlowing(painter, option, index);
  else if (isSpark)
    paintSpark(painter, option, index);
  if (index.column() == VariablesModel::Name &&
      index.data(VariablesModel::FavouriteRole).toBool()) {
    // In the indent, where the arrow of a robot or heading would be.
    const int side = scaled(option.widget, 12);
    const QRect place(option.rect.left() - side - scaled(option.widget, 2),
                      option.rect.center().y() - side / 2, side, side);
    static const QIcon star = themedIcon(QStringLiteral("starred-symbolic"));
    star.paint(painter, place);
  }
}

// Most cells are text on the row's ground. What is in sight is painted ten times a second, and
// Qt's way through options, style sheet and text layout takes several times as long.
void VariablesDelegate::paintPlain(QPainter* painter, const QStyleOptionViewItem& option,
                                   const QModelIndex& index) const {
  const QString shown = index.data().toString();
  if (shown.isEmpty()) return;
  const QVariant font = index.data(Qt::FontRole), color = index.data(Qt::ForegroundRole);
  painter->setFont(font.isValid() ? font.value<QFont>() : option.font);
  const auto group = option.state & QStyle::State_Active ? QPalette::Normal : QPalette::Inactive;
  painter->setPen(color.isValid() ? color.value<QColor>()
                                  : option.palette.color(group, QPalette::Text));
  const int margin = marginOf(option);
  const QRect room = option.rect.adjusted(margin, 0, -margin, 0);
  const bool isName = index.column() == VariablesModel::Name;
  drawTextLine(*painter, room, Qt::Alignment(index.data(Qt::TextAlignmentRole).toInt()),
               isName ? nameFor(index, painter->font(), room.width()) : shown,
               isName ? option.textElideMode : Qt::ElideRight);
}

void VariablesDelegate::paintSpark(QPainter* painter, const QStyleOptionViewItem& option,
                                   const QModelIndex& index) const {
  const auto buckets =
      index.data(VariablesModel::SparkRole).value<QList<telemetry::SeriesBucket>>();
  if (buckets.isEmpty()) return;
  const int edge = scaled(option.widget, 4);
  const QRectF area = QRectF(option.rect).adjusted(edge, edge, -edge, -edge - 1);
  if (area.width() < 4 || area.height() < 4) return;
  const bool chosen = (option.state & QStyle::State_Selected) != 0;
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setClipRect(option.rect);
  QPen pen(chosen ? theme().accentLine : theme().secondaryText);
  pen.setWidthF(1.0);
  pen.setJoinStyle(Qt::BevelJoin);
  painter->setPen(pen);
  painter->drawPath(sparkPath(buckets, area));
  painter->restore();
}

QWidget* VariablesDelegate::createEditor(QWidget* parent, const QStyleOptionViewItem&,
                                         const QModelIndex& index) const {
  const auto column = index.data(VariablesModel::ColumnRole).value<telemetry::ColumnInfo>();
  return new ValueEdit(column, parent);
}

void VariablesDelegate::setEditorData(QWidget* editor, const QModelIndex& index) const {
  // Values go on changing under the editor; what is being typed stays.
  auto* edit = static_cast<ValueEdit*>(editor);
  if (edit->property("begun").toBool()) return;
  edit->setProperty("begun", true);
  edit->setText(index.data(Qt::EditRole).toString());
  edit->selectAll();
}

void VariablesDelegate::setModelData(QWidget* editor, QAbstractItemModel* model,
                                     const QModelIndex& index) const {
  model->setData(index, static_cast<ValueEdit*>(editor)->text(), Qt::EditRole);
}

void VariablesDelegate::updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                                             const QModelIndex&) const {
  const int least = scaled(option.widget, 90);
  QRect place = option.rect;
  if (place.width() < least) place.setLeft(place.right() - least);
  editor->setGeometry(place);
}

bool VariablesDelegate::eventFilter(QObject* watched, QEvent* event) {
  auto* edit = qobject_cast<ValueEdit*>(watched);
  if (edit == nullptr) return QStyledItemDelegate::eventFilter(watched, event);
  if (event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool commits = key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Tab ||
                         key == Qt::Key_Backtab;
    if (commits && !edit->isAcceptable()) return true;
    if (key == Qt::Key_Tab || key == Qt::Key_Backtab) {
      // The next row of a tree that changes by itself is no place to go on editing.
      emit commitData(edit);
      emit closeEditor(edit, NoHint);
      return true;
    }
  }
  if (event->type() == QEvent::FocusOut && QApplication::activePopupWidget() == nullptr) {
    // Going elsewhere is no decision to write.
    emit closeEditor(edit, RevertModelCache);
    return false;
  }
  return QStyledItemDelegate::eventFilter(watched, event);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "meaning_tree.h"

#include <QDropEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMimeData>
#include <algorithm>

#include <ui/base/theme.h>

#include "topic_tree.h"

namespace pitchboard::ui {
namespace {

enum MeaningColumn { MeaningName, MeaningField, MeaningTopic, meaningColumnCount };
constexpr int slotRole = Qt::UserRole, robotRole = Qt::UserRole + 1;

QString robotTitle(const link::MappedRobot& robot) {
  const QString colour = QString::fromStdString(std::string(info(robot.team).name));
  const QString title = QStringLiteral("Robot %1, %2").arg(robot.number).arg(colour);
  return robot.name.empty()
             ? title
             : title + QStringLiteral(" (%1)").arg(QString::fromStdString(robot.name));
}

QString nameOf(const link::MappingSlotInfo& row) {
  const QString part =
      QString::fromLatin1(row.part.data(), static_cast<qsizetype>(row.part.size()));
  const QString name =
      QString::fromLatin1(row.name.data(), static_cast<qsizetype>(row.name.size()));
  return part.toLower() == name ? part : part + QLatin1Char(' ') + name;
}

}  // namespace

MeaningTree::MeaningTree(QWidget* parent) : QTreeWidget(parent) {
  setObjectName(QStringLiteral("mappingMeanings"));
  setAccessibleName(QStringLiteral("What the fields mean"));
  setColumnCount(meaningColumnCount);
  setHeaderLabels({QStringLiteral("Meaning"), QStringLiteral("Field"), QStringLiteral("Topic")});
  setUniformRowHeights(true);
  setAlternatingRowColors(true);
  setAcceptDrops(true);
  setDropIndicatorShown(true);
  setDragDropMode(QAbstractItemView::DropOnly);
  header()->resizeSection(MeaningName, scaled(this, 190));
  header()->resizeSection(MeaningField, scaled(this, 170));
}

void MeaningTree::setMapping(const link::TopicMapping& mapping,
                             const std::vector<link::MappingProblem>& problems) {
  const auto before = place();
  const auto robotBefore = robot();
  const bool hadSelection = currentItem() != nullptr;
  QSet<QString> closed;
  for (int i = 0; i < topLevelItemCount(); ++i) {
    if (!topLevelItem(i)->isExpanded()) closed << topLevelItem(i)->text(MeaningName);
  }
  const QSignalBlocker quiet(this);
  m_mapping = mapping;
  clear();
  for (std::size_t i = 0; i < mapping.robots.size(); ++i) {
    auto* item = new QTreeWidgetItem(this);
    item->setText(MeaningName, robotTitle(mapping.robots[i]));
    item->setData(0, robotRole, static_cast<qulonglong>(i));
    const bool isWrong = std::ranges::any_of(
        problems, [i](const link::MappingProblem& one) { return one.robot == i; });
    if (isWrong) item->setForeground(MeaningName, theme().warningText);
    addRows(item, i, {});
  }
  for (const char* part : {"Log", "Referee"}) {
    auto* item = new QTreeWidgetItem(this);
    item->setText(MeaningName, QString::fromLatin1(part));
    addRows(item, {}, part);
  }
  for (int i = 0; i < topLevelItemCount(); ++i) {
    topLevelItem(i)->setExpanded(!closed.contains(topLevelItem(i)->text(MeaningName)));
  }
  if (!hadSelection) return;
  for (QTreeWidgetItemIterator row(this); *row != nullptr; ++row) {
    const bool isSame = before ? placeOf(*row) == before
                               : robotBefore && (*row)->parent() == nullptr &&
                                     (*row)->data(0, robotRole).isValid() &&
                                     (*row)->data(0, robotRole).toULongLong() == *robotBefore;
    if (isSame) {
      setCurrentItem(*row);
      break;
    }
  }
}

void MeaningTree::addRows(QTreeWidgetItem* above, std::optional<std::size_t> robot,
                          std::string_view part) {
  for (const link::MappingSlotInfo& row : link::mappingSlots()) {
    if (row.isOfRobot != robot.has_value() || (!part.empty() && row.part != part)) continue;
    const link::TopicField field = link::fieldIn(m_mapping, robot.value_or(0), row.slot);
    auto* item = new QTreeWidgetItem(above);
    item->setText(MeaningName, nameOf(row));
    item->setText(MeaningField, QString::fromStdString(field.path));
    item->setText(MeaningTopic, QString::fromStdString(field.topic));
    item->setToolTip(MeaningField, item->text(MeaningField));
    if (field.isEmpty()) item->setForeground(MeaningName, theme().secondaryText);
    item->setData(0, slotRole, static_cast<int>(row.slot));
    if (robot) item->setData(0, robotRole, static_cast<qulonglong>(*robot));
  }
}

std::optional<MeaningTree::Place> MeaningTree::placeOf(const QTreeWidgetItem* item) {
  if (item == nullptr || !item->data(0, slotRole).isValid()) return {};
  return Place{static_cast<std::size_t>(item->data(0, robotRole).toULongLong()),
               static_cast<link::MappingSlot>(item->data(0, slotRole).toInt())};
}

std::optional<MeaningTree::Place> MeaningTree::place() const {
  return placeOf(currentItem());
}

std::optional<std::size_t> MeaningTree::robot() const {
  const QTreeWidgetItem* item = currentItem();
  if (item == nullptr || !item->data(0, robotRole).isValid()) return {};
  return static_cast<std::size_t>(item->data(0, robotRole).toULongLong());
}

void MeaningTree::select(std::size_t robot) {
  if (robot < static_cast<std::size_t>(topLevelItemCount())) {
    setCurrentItem(topLevelItem(static_cast<int>(robot)));
  }
}

void MeaningTree::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasFormat(QString::fromLatin1(topicFieldMime))) {
    event->acceptProposedAction();
  }
}

void MeaningTree::dragMoveEvent(QDragMoveEvent* event) {
  QTreeWidget::dragMoveEvent(event);  // scrolls, and shows where it would go
  const QTreeWidgetItem* item = itemAt(event->position().toPoint());
  if (placeOf(item)) {
    event->acceptProposedAction();
  } else {
    event->ignore();
  }
}

void MeaningTree::dropEvent(QDropEvent* event) {
  QTreeWidgetItem* item = itemAt(event->position().toPoint());
  const auto place = placeOf(item);
  const link::TopicField field =
      topicFieldFrom(event->mimeData()->data(QString::fromLatin1(topicFieldMime)));
  setState(QAbstractItemView::NoState);
  viewport()->update();
  if (!place || field.isEmpty()) return event->ignore();
  event->acceptProposedAction();
  setCurrentItem(item);
  emit fieldDropped(*place, field);
}

void MeaningTree::keyPressEvent(QKeyEvent* event) {
  const bool clears = event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace;
  if (const auto chosen = place(); clears && chosen) {
    emit cleared(*chosen);
    return;
  }
  QTreeWidget::keyPressEvent(event);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "topic_tree.h"

#include <QHeaderView>
#include <QMimeData>
#include <algorithm>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

enum TopicColumn { NameColumn, TypeColumn, ValueColumn, topicColumnCount };
// Of a row: its topic and path, and its index among the topic's fields, or -1.
constexpr int topicRole = Qt::UserRole, pathRole = Qt::UserRole + 1, fieldRole = Qt::UserRole + 2,
              filledRole = Qt::UserRole + 3;

QString typeText(const telemetry::RecordedField& field) {
  using telemetry::RecordedKind;
  switch (field.kind) {
    case RecordedKind::Flag:
      return QStringLiteral("flag");
    case RecordedKind::Enumeration:
      return QStringLiteral("label");
    case RecordedKind::Text:
      return QStringLiteral("text");
    default:
      return field.unit.empty() ? QStringLiteral("number") : QString::fromStdString(field.unit);
  }
}

/// "pose", "position", "x" of "pose.position.x"; "names", "[3]" of "names[3]".
std::vector<std::string> partsOf(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0, depth = 0;
  for (std::size_t i = 0; i <= path.size(); ++i) {
    const bool isEnd = i == path.size();
    if (!isEnd && path[i] == ']' && depth > 0) --depth;
    if (!isEnd && depth > 0) continue;
    if (isEnd || path[i] == '.' || path[i] == '[') {
      if (i > begin) parts.push_back(path.substr(begin, i - begin));
      begin = !isEnd && path[i] == '.' ? i + 1 : i;
    }
    if (!isEnd && path[i] == '[') ++depth;
  }
  return parts;
}

QTreeWidgetItem* childNamed(QTreeWidgetItem* parent, const QString& name) {
  // Fields come in order: the last one is the usual one.
  for (int i = parent->childCount() - 1; i >= 0; --i) {
    if (parent->child(i)->text(NameColumn) == name) return parent->child(i);
  }
  return nullptr;
}

}  // namespace

QByteArray topicFieldBytes(const link::TopicField& field) {
  return QByteArray::fromStdString(field.topic + '\n' + field.path);
}

link::TopicField topicFieldFrom(const QByteArray& bytes) {
  const auto end = bytes.indexOf('\n');
  if (end <= 0) return {};
  return {bytes.left(end).toStdString(), bytes.mid(end + 1).toStdString()};
}

TopicTree::TopicTree(QWidget* parent) : QTreeWidget(parent) {
  setObjectName(QStringLiteral("mappingTopics"));
  setAccessibleName(QStringLiteral("Topics and fields"));
  setColumnCount(topicColumnCount);
  setHeaderLabels(
      {QStringLiteral("Topic, field"), QStringLiteral("Type"), QStringLiteral("Value")});
  setUniformRowHeights(true);
  setAlternatingRowColors(true);
  setDragEnabled(true);
  setDragDropMode(QAbstractItemView::DragOnly);
  header()->setSectionResizeMode(NameColumn, QHeaderView::Interactive);
  header()->resizeSection(NameColumn, scaled(this, 220));
  header()->resizeSection(TypeColumn, scaled(this, 110));
  connect(this, &QTreeWidget::itemExpanded, this, &TopicTree::fill);
}

void TopicTree::setTopics(const std::vector<link::SampledTopic>& topics) {
  const auto isSame = [](const link::SampledTopic& a, const link::SampledTopic& b) {
    return a.topic.name == b.topic.name && a.fields.size() == b.fields.size();
  };
  const bool isKept = std::ranges::equal(m_topics, topics, isSame);
  m_topics = topics;
  if (!isKept) return rebuild();
  for (int i = 0; i < topLevelItemCount(); ++i) refreshValues(topLevelItem(i));
}

void TopicTree::setFilter(const QString& text) {
  const QStringList words = text.split(QLatin1Char(' '), Qt::SkipEmptyParts);
  if (words == m_words) return;
  m_words = words;
  rebuild();
}

bool TopicTree::matches(const std::string& topic, const std::string& path) const {
  const QString whole = QString::fromStdString(topic + ' ' + path);
  return std::all_of(m_words.begin(), m_words.end(), [&whole](const QString& word) {
    return whole.contains(word, Qt::CaseInsensitive);
  });
}

void TopicTree::rebuild() {
  constexpr int mostOpened = 3;
  clear();
  for (std::size_t t = 0; t < m_topics.size(); ++t) {
    const link::SampledTopic& topic = m_topics[t];
    const bool isShown =
        matches(topic.topic.name, {}) ||
        std::ranges::any_of(topic.fields, [&](const telemetry::RecordedField& field) {
          return matches(topic.topic.name, field.path);
        });
    if (!isShown) continue;
    auto* item = new QTreeWidgetItem(this);
    item->setText(NameColumn, QString::fromStdString(topic.topic.name));
    item->setText(TypeColumn, QString::fromStdString(topic.topic.type));
    item->setData(0, topicRole, static_cast<qulonglong>(t));
    item->setData(0, fieldRole, -1);
    item->setChildIndicatorPolicy(topic.fields.empty() ? QTreeWidgetItem::DontShowIndicator
                                                       : QTreeWidgetItem::ShowIndicator);
    refreshValues(item);
    if (!m_words.isEmpty() && topLevelItemCount() <= mostOpened) item->setExpanded(true);
  }
}

/// Makes the rows of a topic; those of lists stay closed.
void TopicTree::fill(QTreeWidgetItem* item) {
  if (item->parent() != nullptr || item->data(0, filledRole).toBool()) return;
  item->setData(0, filledRole, true);
  const auto& topic = m_topics[item->data(0, topicRole).toULongLong()];
  for (std::size_t f = 0; f < topic.fields.size(); ++f) {
    if (!matches(topic.topic.name, topic.fields[f].path)) continue;
    QTreeWidgetItem* row = item;
    std::string path;
    for (const std::string& part : partsOf(topic.fields[f].path)) {
      path += (path.empty() || part.front() == '[' ? "" : ".") + part;
      const QString name = QString::fromStdString(part);
      QTreeWidgetItem* next = childNamed(row, name);
      if (next == nullptr) {
        next = new QTreeWidgetItem(row);
        next->setText(NameColumn, name);
        next->setData(0, topicRole, item->data(0, topicRole));
        next->setData(0, pathRole, QString::fromStdString(path));
        next->setData(0, fieldRole, -1);
      }
      row = next;
    }
    row->setText(TypeColumn, typeText(topic.fields[f]));
    row->setData(0, pathRole, QString::fromStdString(topic.fields[f].path));
    row->setData(0, fieldRole, static_cast<int>(f));
    row->setToolTip(NameColumn, QString::fromStdString(topic.fields[f].path));
  }
  refreshValues(item);
  for (QTreeWidgetItemIterator row(item); *row != nullptr; ++row) {
    const bool isInside =
        (*row)->parent() != nullptr && (*row)->data(0, topicRole) == item->data(0, topicRole);
    if (!isInside && *row != item) break;
    constexpr int longestOpened = 10;
    if (isInside) (*row)->setExpanded((*row)->childCount() <= longestOpened);
  }
}

void TopicTree::refreshValues(QTreeWidgetItem* item) {
  const auto& topic = m_topics[item->data(0, topicRole).toULongLong()];
  const QString reason = QString::fromStdString(topic.topic.reason);
  item->setText(ValueColumn, !reason.isEmpty() ? reason
                             : topic.messages == 1
                                 ? QStringLiteral("1 message")
                                 : QStringLiteral("%1 messages").arg(topic.messages));
  item->setDisabled(!reason.isEmpty());
  for (QTreeWidgetItemIterator row(item); *row != nullptr; ++row) {
    if (*row != item && (*row)->parent() == nullptr) break;
    const int field = (*row)->data(0, fieldRole).toInt();
    if (*row == item || field < 0) continue;
    (*row)->setText(ValueColumn,
                    QString::fromStdString(topic.values[static_cast<std::size_t>(field)]));
  }
}

link::TopicField TopicTree::fieldOf(const QTreeWidgetItem* item) {
  if (item == nullptr || item->isDisabled()) return {};
  const QTreeWidgetItem* top = item;
  while (top->parent() != nullptr) top = top->parent();
  return {top->text(NameColumn).toStdString(), item->data(0, pathRole).toString().toStdString()};
}

link::TopicField TopicTree::selected() const {
  const auto items = selectedItems();
  return items.isEmpty() ? link::TopicField() : fieldOf(items.first());
}

QStringList TopicTree::mimeTypes() const {
  return {QString::fromLatin1(topicFieldMime)};
}

QMimeData* TopicTree::mimeData(const QList<QTreeWidgetItem*>& items) const {
  const link::TopicField field = items.isEmpty() ? link::TopicField() : fieldOf(items.first());
  if (field.isEmpty()) return nullptr;
  auto* made = new QMimeData;
  made->setData(QString::fromLatin1(topicFieldMime), topicFieldBytes(field));
  return made;
}

}  // namespace pitchboard::ui

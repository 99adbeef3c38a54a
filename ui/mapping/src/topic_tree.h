// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The topics of a recording and the fields of their messages, with types, units and values at a
// moment. Fields and topics can be dragged. Rows of a topic are made when it is opened, so that
// recordings may have many. UI thread only.

#include <QTreeWidget>
#include <vector>

#include <robotlink/import/mapping_sample.h>

namespace pitchboard::ui {

/// What is dragged from a TopicTree.
inline constexpr const char* topicFieldMime = "application/x-pitchboard-topic-field";
QByteArray topicFieldBytes(const link::TopicField& field);
/// Returns an empty field if the bytes are not one.
link::TopicField topicFieldFrom(const QByteArray& bytes);

class TopicTree : public QTreeWidget {
  Q_OBJECT
 public:
  explicit TopicTree(QWidget* parent);

  /// Shows other topics or values; what is open and selected stays so.
  void setTopics(const std::vector<link::SampledTopic>& topics);
  /// Shows only topics and fields whose names contain all words of the text.
  void setFilter(const QString& text);
  /// Returns what is selected; an empty field if nothing can be put into a mapping.
  link::TopicField selected() const;

 protected:
  QMimeData* mimeData(const QList<QTreeWidgetItem*>& items) const override;
  QStringList mimeTypes() const override;

 private:
  bool matches(const std::string& topic, const std::string& path) const;
  void rebuild();
  void fill(QTreeWidgetItem* item);
  void refreshValues(QTreeWidgetItem* topic);
  static link::TopicField fieldOf(const QTreeWidgetItem* item);

  std::vector<link::SampledTopic> m_topics;
  QStringList m_words;
};

}  // namespace pitchboard::ui

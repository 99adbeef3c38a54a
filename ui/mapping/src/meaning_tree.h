// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a mapping says: its robots with pose, ball and battery, the log and the referee. A field of
// a TopicTree can be dropped on each row; Delete clears it. UI thread only.

#include <QTreeWidget>
#include <optional>
#include <vector>

#include <robotlink/import/mapping_slots.h>

namespace pitchboard::ui {

class MeaningTree : public QTreeWidget {
  Q_OBJECT
 public:
  /// A row that takes a field.
  struct Place {
    std::size_t robot = 0;
    link::MappingSlot slot{};
    bool operator==(const Place&) const = default;
  };
  explicit MeaningTree(QWidget* parent);

  void setMapping(const link::TopicMapping& mapping,
                  const std::vector<link::MappingProblem>& problems);
  /// Returns the selected row, if it takes a field.
  std::optional<Place> place() const;
  /// Returns the robot of the selected row.
  std::optional<std::size_t> robot() const;
  void select(std::size_t robot);

 signals:
  void fieldDropped(const Place& place, const link::TopicField& field);
  void cleared(const Place& place);

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void addRows(QTreeWidgetItem* above, std::optional<std::size_t> robot, std::string_view part);
  static std::optional<Place> placeOf(const QTreeWidgetItem* item);

  link::TopicMapping m_mapping;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field's keys as data: those of the published simulator (SYSTEM.md section 9) and our own.
// One table serves the key handler and the overlay that shows them.

#include <QPointF>
#include <QString>
#include <Qt>
#include <functional>
#include <span>

#include <ui/field/field_layers.h>

namespace pitchboard::ui {

class FieldKeyTarget;

struct FieldKey {
  int key = 0;                      ///< Qt::Key
  Qt::KeyboardModifiers modifiers;  ///< exactly these (the keypad's is ignored)
  const char* category;             ///< under which the overlay lists it
  const char* shown;                ///< how the overlay writes the key; empty = not listed
  const char* meaning;
  void (*act)(FieldKeyTarget& target);
};

std::span<const FieldKey> fieldKeys();
/// The entry for a key press, or nullptr.
const FieldKey* findFieldKey(int key, Qt::KeyboardModifiers modifiers);

/// What keys do; the field view carries it out.
class FieldKeyTarget {
 public:
  virtual ~FieldKeyTarget() = default;
  virtual void addRobotAtCursor(int color) = 0;  ///< index into teamColors
  virtual void addRobotByShift() = 0;            ///< left Shift yellow, right Shift orange
  virtual void placeBallAtCursor() = 0;
  virtual void selectRobot(int number) = 0;  ///< RobotKey
  virtual void selectAll() = 0;
  virtual void moveSelectedToCursor() = 0;
  virtual void removeSelected() = 0;
  virtual void commandSelected(int action, int actionB = -1) = 0;
  virtual void searchSelected(bool on) = 0;
  virtual void nudgeSelected(int right, int up, bool coarse) = 0;
  virtual void toggleLayer(FieldLayer layer) = 0;
  virtual void escape() = 0;
  virtual void fit() = 0;
  virtual void toggleHelp() = 0;
  virtual void togglePause() = 0;
  virtual void loadMatch() = 0;
  virtual void reset() = 0;
  virtual void clear() = 0;
};

}  // namespace pitchboard::ui

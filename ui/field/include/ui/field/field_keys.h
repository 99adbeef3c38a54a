// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The keys of the published simulator (system.md section 9) as data. They work while "Published
// keys" is on; the window asks the field to carry them out wherever the focus is. Constant data,
// safe in every thread.

#include <Qt>
#include <optional>
#include <span>

namespace pitchboard::ui {

/// What a key does. All but Select need a match that can be changed.
enum class FieldAction {
  Select,           ///< `value`: RobotId
  AddRobot,         ///< at the cursor; `value`: index into teamColors
  AddRobotByShift,  ///< left Shift yellow, right Shift orange
  PlaceBall,
  MoveHere,  ///< the selected robots to the cursor
  Act,       ///< `value`: action of the selected robots, `other`: DECISION_ACTION_B, -1: unchanged
  Search,    ///< `value`: on or off
  LoadMatch,
  Reset,
  Clear
};

struct FieldOrder {
  FieldAction action;
  int value = 0;
  int other = -1;
};

struct FieldKey {
  int key = 0;                      ///< Qt::Key
  Qt::KeyboardModifiers modifiers;  ///< exactly these (the keypad's is ignored)
  const char* shown;                ///< how people read the key
  const char* meaning;
  FieldOrder order;
  int count = 1;  ///< so many keys in a row, each with the next `value`
};

std::span<const FieldKey> fieldKeys();
/// What a key press asks for; nothing when it is none of these keys.
std::optional<FieldOrder> fieldOrder(int key, Qt::KeyboardModifiers modifiers);

}  // namespace pitchboard::ui

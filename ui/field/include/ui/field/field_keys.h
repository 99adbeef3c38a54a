// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The keys of the published simulator as a table. They work while "Published keys" is on, wherever
// the focus is. Constant data; any thread.

#include <Qt>
#include <optional>
#include <span>

namespace pitchboard::ui {

/// What a key does. All actions except Select need a match that can be changed.
enum class FieldAction {
  Select,           ///< `value`: RobotId
  AddRobot,         ///< at the cursor; `value`: index into teamColors
  AddRobotByShift,  ///< yellow with the left Shift key, orange with the right one
  PlaceBall,
  MoveHere,  ///< the selected robots to the cursor
  Act,       ///< for the selected robots; `value`: action, `other`: DECISION_ACTION_B or -1 (keep)
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
  Qt::KeyboardModifiers modifiers;  ///< exactly these; KeypadModifier is ignored
  const char* shown;                ///< name of the key on the screen
  const char* meaning;
  FieldOrder order;
  int count = 1;  ///< number of successive keys, each with the next `value`
};

std::span<const FieldKey> fieldKeys();
/// Returns what a key press does; empty if it is none of these keys.
std::optional<FieldOrder> fieldOrder(int key, Qt::KeyboardModifiers modifiers);

}  // namespace pitchboard::ui

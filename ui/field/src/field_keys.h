// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field's keys as data: those of the published simulator (SYSTEM.md section 9) and our own.
// One table serves the key handler and the overlay that shows them.

#include <Qt>
#include <optional>
#include <span>

namespace pitchboard::ui {

/// What a key does. Those from AddRobot on need a match that can be changed.
enum class FieldAction {
  Select,  ///< `value`: RobotId
  SelectAll,
  Escape,
  Nudge,  ///< `value`: 0 left, 1 up, 2 right, 3 down; `other`: cm
  Layer,  ///< `value`: FieldLayer
  Fit,
  Help,
  AddRobot,         ///< at the cursor; `value`: index into teamColors
  AddRobotByShift,  ///< left Shift yellow, right Shift orange
  PlaceBall,
  MoveHere,  ///< the selected robots to the cursor
  Remove,
  Act,     ///< `value`: action of the selected robots, `other`: DECISION_ACTION_B, -1: unchanged
  Search,  ///< `value`: on or off
  LoadMatch,
  Reset,
  Clear,
  Pause
};

struct FieldOrder {
  FieldAction action;
  int value = 0;
  int other = -1;
};

struct FieldKey {
  int key = 0;                      ///< Qt::Key
  Qt::KeyboardModifiers modifiers;  ///< exactly these (the keypad's is ignored)
  const char* category;             ///< under which the overlay lists it
  const char* shown;                ///< how the overlay writes the key; empty = not listed
  const char* meaning;
  FieldOrder order;
  int count = 1;  ///< so many keys in a row, each with the next `value`
};

std::span<const FieldKey> fieldKeys();
/// What a key press asks for; nothing when it is none of the field's keys.
std::optional<FieldOrder> fieldOrder(int key, Qt::KeyboardModifiers modifiers);

}  // namespace pitchboard::ui

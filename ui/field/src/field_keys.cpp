// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/field/field_keys.h>

#include <simcore/world/action_codes.h>

namespace pitchboard::ui {
namespace {

using enum FieldAction;

constexpr auto none = Qt::NoModifier;
constexpr auto ctrl = Qt::ControlModifier;
constexpr auto shift = Qt::ShiftModifier;
constexpr auto alt = Qt::AltModifier;

/// What people read for an action everywhere.
template <std::size_t action>
constexpr const char* label = knownActions[action].label.data();

const FieldKey table[] = {
    {Qt::Key_A, none, "A", "Add a blue robot at the cursor", {AddRobot, 0}},
    {Qt::Key_A, ctrl, "Ctrl+A", "Add a red robot", {AddRobot, 1}},
    {Qt::Key_A, alt, "Alt+A", "Add a black robot", {AddRobot, 2}},
    {Qt::Key_A, shift, "Shift+A", "Add a yellow robot (right Shift: orange)", {AddRobotByShift}},
    {Qt::Key_B, none, "B", "Place the ball at the cursor", {PlaceBall}},
    {Qt::Key_Insert, none, "Insert", "Move the selected robots to the cursor", {MoveHere}},
    {Qt::Key_0, ctrl, "Ctrl+0 to Ctrl+6", "Select robot 10 to 16", {Select, 10}, 7},

    {Qt::Key_F, none, "F", label<1>, {Act, 1}},
    {Qt::Key_K, none, "K", label<8>, {Act, 8, 10}},
    {Qt::Key_V, none, "V", label<17>, {Act, 17}},
    {Qt::Key_R, none, "R", label<18>, {Act, 18}},
    {Qt::Key_M, none, "M", label<6>, {Act, 6}},
    {Qt::Key_N, none, "N", label<7>, {Act, 7}},
    {Qt::Key_E, none, "E", label<2>, {Act, 2}},
    {Qt::Key_D, none, "D", label<3>, {Act, 3}},
    {Qt::Key_O, none, "O", label<9>, {Act, 9}},
    {Qt::Key_Q, none, "Q", label<14>, {Act, 14}},
    {Qt::Key_L, none, "L", label<5>, {Act, 5}},
    {Qt::Key_P, none, "P", label<4>, {Act, 4}},
    {Qt::Key_I, none, "I", label<12>, {Act, 12}},
    {Qt::Key_J, none, "J", label<13>, {Act, 13}},
    {Qt::Key_S, none, "S", label<11>, {Act, 11}},
    {Qt::Key_T, none, "T", label<0>, {Act, 0}},
    {Qt::Key_Y, none, "Y", "search for the ball", {Search, 1}},
    {Qt::Key_Z, none, "Z", "stop searching", {Search, 0}},

    {Qt::Key_F2, none, "F2", "Load the match", {LoadMatch}},
    {Qt::Key_F3, none, "F3", "Reset score and load it again", {Reset}},
    {Qt::Key_F4, none, "F4", "Clear the field", {Clear}},
};

}  // namespace

std::span<const FieldKey> fieldKeys() {
  return table;
}

std::optional<FieldOrder> fieldOrder(int key, Qt::KeyboardModifiers modifiers) {
  modifiers &= ~Qt::KeyboardModifiers(Qt::KeypadModifier);
  for (const FieldKey& entry : table) {
    if (key < entry.key || key >= entry.key + entry.count || entry.modifiers != modifiers) continue;
    FieldOrder order = entry.order;
    order.value += key - entry.key;
    return order;
  }
  return {};
}

}  // namespace pitchboard::ui

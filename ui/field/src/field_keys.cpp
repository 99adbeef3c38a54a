// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_keys.h"

#include <base/actions.h>
#include <ui/field/field_layers.h>

namespace pitchboard::ui {
namespace {

using enum FieldAction;

constexpr auto none = Qt::NoModifier;
constexpr auto ctrl = Qt::ControlModifier;
constexpr auto shift = Qt::ShiftModifier;
constexpr auto alt = Qt::AltModifier;

/// What people read for an action everywhere.
template <std::size_t action>
constexpr const char* words = knownActions[action].words.data();

constexpr FieldOrder layer(FieldLayer which) {
  return {Layer, static_cast<int>(which)};
}

const char* const place = "Place";
const char* const choose = "Select";
const char* const act = "Selected robots";
const char* const show = "Show";
const char* const match = "Match";

const FieldKey table[] = {
    {Qt::Key_A, none, place, "A", "add a blue robot at the cursor", {AddRobot, 0}},
    {Qt::Key_A, ctrl, place, "Ctrl+A", "add a red robot", {AddRobot, 1}},
    {Qt::Key_A, alt, place, "Alt+A", "add a black robot", {AddRobot, 2}},
    {Qt::Key_A,
     shift,
     place,
     "Shift+A",
     "add a yellow (left) or orange (right Shift) robot",
     {AddRobotByShift}},
    {Qt::Key_B, none, place, "B", "put the ball at the cursor", {PlaceBall}},
    {Qt::Key_Insert, none, place, "Insert", "move the selected robots to the cursor", {MoveHere}},
    {Qt::Key_Delete, none, place, "Delete", "remove the selected robots", {Remove}},

    {Qt::Key_1, none, choose, "1–9", "select robot 1 to 9", {Select, 1}, 9},
    {Qt::Key_0, ctrl, choose, "Ctrl+0–6", "select robot 10 to 16", {Select, 10}, 7},
    {Qt::Key_A, ctrl | shift, choose, "Ctrl+Shift+A", "select all robots", {SelectAll}},
    {Qt::Key_Escape, none, choose, "Esc", "cancel a drag, select nothing", {Escape}},
    {Qt::Key_Left, none, choose, "Arrows", "move by 1 cm, with Shift by 10 cm", {Nudge, 0, 1}, 4},
    {Qt::Key_Left, shift, choose, "", "", {Nudge, 0, 10}, 4},

    {Qt::Key_F, none, act, "F", words<1>, {Act, 1}},
    {Qt::Key_K, none, act, "K", words<8>, {Act, 8, 10}},
    {Qt::Key_V, none, act, "V", words<17>, {Act, 17}},
    {Qt::Key_R, none, act, "R", words<18>, {Act, 18}},
    {Qt::Key_M, none, act, "M", words<6>, {Act, 6}},
    {Qt::Key_N, none, act, "N", words<7>, {Act, 7}},
    {Qt::Key_E, none, act, "E", words<2>, {Act, 2}},
    {Qt::Key_D, none, act, "D", words<3>, {Act, 3}},
    {Qt::Key_O, none, act, "O", words<9>, {Act, 9}},
    {Qt::Key_Q, none, act, "Q", words<14>, {Act, 14}},
    {Qt::Key_L, none, act, "L", words<5>, {Act, 5}},
    {Qt::Key_P, none, act, "P", words<4>, {Act, 4}},
    {Qt::Key_I, none, act, "I", words<12>, {Act, 12}},
    {Qt::Key_J, none, act, "J", words<13>, {Act, 13}},
    {Qt::Key_S, none, act, "S", words<11>, {Act, 11}},
    {Qt::Key_T, none, act, "T", words<0>, {Act, 0}},
    {Qt::Key_Y, none, act, "Y", "search the ball", {Search, 1}},
    {Qt::Key_Z, none, act, "Z", "stop searching", {Search, 0}},

    {Qt::Key_F1, none, show, "F1", "these keys", {Help}},
    {Qt::Key_F6, none, show, "F6", "field of view", layer(FieldLayer::FieldOfView)},
    {Qt::Key_F7, none, show, "F7", "EOPRA sectors", layer(FieldLayer::Eopra)},
    {Qt::Key_F8, none, show, "F8", "StarVars sectors", layer(FieldLayer::StarVars)},
    {Qt::Key_F9, none, show, "F9", "landmarks", layer(FieldLayer::Landmarks)},
    {Qt::Key_Home, none, show, "Home", "fit the field", {Fit}},

    {Qt::Key_F2, none, match, "F2", "load the match", {LoadMatch}},
    {Qt::Key_F3, none, match, "F3", "reset score and load it again", {Reset}},
    {Qt::Key_F4, none, match, "F4", "clear the field", {Clear}},
    {Qt::Key_F5, none, match, "F5", "pause or go on", {Pause}},
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

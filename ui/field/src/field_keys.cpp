// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_keys.h"

#include <array>

#include <base/actions.h>
#include <ui/field/field_layers.h>

namespace pitchboard::ui {
namespace {

using Target = FieldKeyTarget;

constexpr auto none = Qt::NoModifier;
constexpr auto ctrl = Qt::ControlModifier;
constexpr auto shift = Qt::ShiftModifier;
constexpr auto alt = Qt::AltModifier;

template <int color>
void add(Target& t) {
  t.addRobotAtCursor(color);
}
template <int number>
void select(Target& t) {
  t.selectRobot(number);
}
template <int action, int b = -1>
void command(Target& t) {
  t.commandSelected(action, b);
}
template <FieldLayer layer>
void toggle(Target& t) {
  t.toggleLayer(layer);
}
template <int right, int up, bool coarse>
void nudge(Target& t) {
  t.nudgeSelected(right, up, coarse);
}

/// What people read for an action everywhere.
template <std::size_t action>
constexpr const char* words = knownActions[action].words.data();

const char* const place = "Place";
const char* const choose = "Select";
const char* const act = "Selected robots";
const char* const show = "Show";
const char* const match = "Match";

const std::array table{
    FieldKey{Qt::Key_A, none, place, "A", "add a blue robot at the cursor", add<0>},
    FieldKey{Qt::Key_A, ctrl, place, "Ctrl+A", "add a red robot", add<1>},
    FieldKey{Qt::Key_A, alt, place, "Alt+A", "add a black robot", add<2>},
    FieldKey{Qt::Key_A, shift, place, "Shift+A",
             "add a yellow (left) or orange (right Shift) robot",
             [](Target& t) { t.addRobotByShift(); }},
    FieldKey{Qt::Key_B, none, place, "B", "put the ball at the cursor",
             [](Target& t) { t.placeBallAtCursor(); }},
    FieldKey{Qt::Key_Insert, none, place, "Insert", "move the selected robots to the cursor",
             [](Target& t) { t.moveSelectedToCursor(); }},
    FieldKey{Qt::Key_Delete, none, place, "Delete", "remove the selected robots",
             [](Target& t) { t.removeSelected(); }},

    FieldKey{Qt::Key_1, none, choose, "1–9", "select robot 1 to 9", select<1>},
    FieldKey{Qt::Key_2, none, choose, "", "", select<2>},
    FieldKey{Qt::Key_3, none, choose, "", "", select<3>},
    FieldKey{Qt::Key_4, none, choose, "", "", select<4>},
    FieldKey{Qt::Key_5, none, choose, "", "", select<5>},
    FieldKey{Qt::Key_6, none, choose, "", "", select<6>},
    FieldKey{Qt::Key_7, none, choose, "", "", select<7>},
    FieldKey{Qt::Key_8, none, choose, "", "", select<8>},
    FieldKey{Qt::Key_9, none, choose, "", "", select<9>},
    FieldKey{Qt::Key_0, ctrl, choose, "Ctrl+0–6", "select robot 10 to 16", select<10>},
    FieldKey{Qt::Key_1, ctrl, choose, "", "", select<11>},
    FieldKey{Qt::Key_2, ctrl, choose, "", "", select<12>},
    FieldKey{Qt::Key_3, ctrl, choose, "", "", select<13>},
    FieldKey{Qt::Key_4, ctrl, choose, "", "", select<14>},
    FieldKey{Qt::Key_5, ctrl, choose, "", "", select<15>},
    FieldKey{Qt::Key_6, ctrl, choose, "", "", select<16>},
    FieldKey{Qt::Key_A, ctrl | shift, choose, "Ctrl+Shift+A", "select all robots",
             [](Target& t) { t.selectAll(); }},
    FieldKey{Qt::Key_Escape, none, choose, "Esc", "cancel a drag, select nothing",
             [](Target& t) { t.escape(); }},
    FieldKey{Qt::Key_Left, none, choose, "Arrows", "move by 1 cm, with Shift by 10 cm",
             nudge<-1, 0, false>},
    FieldKey{Qt::Key_Right, none, choose, "", "", nudge<1, 0, false>},
    FieldKey{Qt::Key_Up, none, choose, "", "", nudge<0, 1, false>},
    FieldKey{Qt::Key_Down, none, choose, "", "", nudge<0, -1, false>},
    FieldKey{Qt::Key_Left, shift, choose, "", "", nudge<-1, 0, true>},
    FieldKey{Qt::Key_Right, shift, choose, "", "", nudge<1, 0, true>},
    FieldKey{Qt::Key_Up, shift, choose, "", "", nudge<0, 1, true>},
    FieldKey{Qt::Key_Down, shift, choose, "", "", nudge<0, -1, true>},

    FieldKey{Qt::Key_F, none, act, "F", words<1>, command<1>},
    FieldKey{Qt::Key_K, none, act, "K", words<8>, command<8, 10>},
    FieldKey{Qt::Key_V, none, act, "V", words<17>, command<17>},
    FieldKey{Qt::Key_R, none, act, "R", words<18>, command<18>},
    FieldKey{Qt::Key_M, none, act, "M", words<6>, command<6>},
    FieldKey{Qt::Key_N, none, act, "N", words<7>, command<7>},
    FieldKey{Qt::Key_E, none, act, "E", words<2>, command<2>},
    FieldKey{Qt::Key_D, none, act, "D", words<3>, command<3>},
    FieldKey{Qt::Key_O, none, act, "O", words<9>, command<9>},
    FieldKey{Qt::Key_Q, none, act, "Q", words<14>, command<14>},
    FieldKey{Qt::Key_L, none, act, "L", words<5>, command<5>},
    FieldKey{Qt::Key_P, none, act, "P", words<4>, command<4>},
    FieldKey{Qt::Key_I, none, act, "I", words<12>, command<12>},
    FieldKey{Qt::Key_J, none, act, "J", words<13>, command<13>},
    FieldKey{Qt::Key_S, none, act, "S", words<11>, command<11>},
    FieldKey{Qt::Key_T, none, act, "T", words<0>, command<0>},
    FieldKey{Qt::Key_Y, none, act, "Y", "search the ball",
             [](Target& t) { t.searchSelected(true); }},
    FieldKey{Qt::Key_Z, none, act, "Z", "stop searching",
             [](Target& t) { t.searchSelected(false); }},

    FieldKey{Qt::Key_F1, none, show, "F1", "these keys", [](Target& t) { t.toggleHelp(); }},
    FieldKey{Qt::Key_F6, none, show, "F6", "field of view", toggle<FieldLayer::FieldOfView>},
    FieldKey{Qt::Key_F7, none, show, "F7", "EOPRA sectors", toggle<FieldLayer::Eopra>},
    FieldKey{Qt::Key_F8, none, show, "F8", "StarVars sectors", toggle<FieldLayer::StarVars>},
    FieldKey{Qt::Key_F9, none, show, "F9", "landmarks", toggle<FieldLayer::Landmarks>},
    FieldKey{Qt::Key_Home, none, show, "Home", "fit the field", [](Target& t) { t.fit(); }},

    FieldKey{Qt::Key_F2, none, match, "F2", "load the match", [](Target& t) { t.loadMatch(); }},
    FieldKey{Qt::Key_F3, none, match, "F3", "reset score and load it again",
             [](Target& t) { t.reset(); }},
    FieldKey{Qt::Key_F4, none, match, "F4", "clear the field", [](Target& t) { t.clear(); }},
    FieldKey{Qt::Key_F5, none, match, "F5", "pause or go on", [](Target& t) { t.togglePause(); }},
};

}  // namespace

std::span<const FieldKey> fieldKeys() {
  return table;
}

const FieldKey* findFieldKey(int key, Qt::KeyboardModifiers modifiers) {
  modifiers &= ~Qt::KeyboardModifiers(Qt::KeypadModifier);
  for (const FieldKey& entry : table) {
    if (entry.key == key && entry.modifiers == modifiers) return &entry;
  }
  return nullptr;
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "key_map.h"

#include <QAction>
#include <QWidget>

#include <ui/field/field_keys.h>

namespace pitchboard::ui {
namespace {

const char* const keysOfTime = "Time";
const char* const keysOfWindow = "Window";
const char* const keysOfRobots = "Robots";
const char* const keysOfField = "Field";
const char* const keysOfPlots = "Plots";
const char* const keysOfPanels = "Panels";

constexpr bool whileHeld = true;

const KeyRow keyTable[] = {
    {"play", "Space F5 Ctrl+P", keysOfTime, "Play or pause"},
    {"stepBack", "Left Ctrl+,", keysOfTime, nullptr, nullptr, whileHeld},
    {"stepForward", "Right", keysOfTime, nullptr, nullptr, whileHeld},
    {"secondBack", "Shift+Left", keysOfTime, nullptr, nullptr, whileHeld},
    {"secondForward", "Shift+Right", keysOfTime, nullptr, nullptr, whileHeld},
    {"step", "Ctrl+.", keysOfTime, "Play one tick", nullptr, whileHeld},
    {"nextEvent", "N Ctrl+N", keysOfTime, nullptr, nullptr, whileHeld},
    {"previousEvent", "Shift+N Ctrl+Shift+N", keysOfTime, nullptr, nullptr, whileHeld},
    {"previousPicture", ",", keysOfTime, nullptr, nullptr, whileHeld},
    {"nextPicture", ".", keysOfTime, nullptr, nullptr, whileHeld},
    {"addBookmark", "M Ctrl+B", keysOfTime},
    {"escape", "Esc", keysOfTime},
    {"timelineNow", "Ctrl+End", keysOfTime},
    {"oldestMoment", "Ctrl+Home", keysOfTime},
    {"goToTime", "Ctrl+G", keysOfTime},
    {"slower", "-", keysOfTime, nullptr, nullptr, whileHeld},
    {"faster", "+ =", keysOfTime, nullptr, nullptr, whileHeld},
    {"loopRange", "Ctrl+L", keysOfTime},
    {"timelineZoomIn", "Ctrl++ Ctrl+=", keysOfTime, nullptr, nullptr, whileHeld},
    {"timelineZoomOut", "Ctrl+-", keysOfTime, nullptr, nullptr, whileHeld},
    {"timelineAll", "0", keysOfTime},
    {"skipToEvent", "Ctrl+J", keysOfTime},
    {"skipToKickOff", "Ctrl+Shift+J", keysOfTime},
    {"restart", "Ctrl+R", keysOfTime, "Restart, or to the start of the session"},
    {nullptr, "Click, drag", keysOfTime, "Look back"},
    {nullptr, "Shift+drag", keysOfTime, "Select a range"},
    {nullptr, "Wheel, Shift+wheel", keysOfTime, "Zoom, scroll the timeline"},

    {"nudgeLeft", "Ctrl+Left", keysOfRobots, "Nudge selected robots by 1 cm", "Ctrl+arrows",
     whileHeld},
    {"nudgeRight", "Ctrl+Right", keysOfRobots, nullptr, "", whileHeld},
    {"nudgeUp", "Ctrl+Up", keysOfRobots, nullptr, "", whileHeld},
    {"nudgeDown", "Ctrl+Down", keysOfRobots, nullptr, "", whileHeld},
    {"pushLeft", "Ctrl+Shift+Left", keysOfRobots, "Nudge selected robots by 10 cm",
     "Ctrl+Shift+arrows", whileHeld},
    {"pushRight", "Ctrl+Shift+Right", keysOfRobots, nullptr, "", whileHeld},
    {"pushUp", "Ctrl+Shift+Up", keysOfRobots, nullptr, "", whileHeld},
    {"pushDown", "Ctrl+Shift+Down", keysOfRobots, nullptr, "", whileHeld},
    {"select1", "1", keysOfRobots, "Select robot 1 to 9", "1 to 9"},
    {"select2", "2", keysOfRobots, nullptr, ""},
    {"select3", "3", keysOfRobots, nullptr, ""},
    {"select4", "4", keysOfRobots, nullptr, ""},
    {"select5", "5", keysOfRobots, nullptr, ""},
    {"select6", "6", keysOfRobots, nullptr, ""},
    {"select7", "7", keysOfRobots, nullptr, ""},
    {"select8", "8", keysOfRobots, nullptr, ""},
    {"select9", "9", keysOfRobots, nullptr, ""},
    {"selectAll", "Ctrl+A Ctrl+Shift+A", keysOfRobots},
    {"removeSelected", "Del", keysOfRobots},
    {nullptr, "Drag, Shift+drag", keysOfRobots, "Move, turn a robot; move, kick the ball"},
    {nullptr, "Wheel on a selected robot", keysOfRobots, "Turn it"},
    {nullptr, "Ctrl+Alt+letter", keysOfRobots, "Referee calls; see docs/referee.md"},

    {"fitField", "Home", keysOfField},
    {"flipSides", "Ctrl+F", keysOfField},
    {"layer.fieldOfView", "F6", keysOfField},
    {"layer.eopra", "F7", keysOfField},
    {"layer.starVars", "F8", keysOfField},
    {"layer.landmarks", "F9", keysOfField},
    {"publishedKeys", "Ctrl+Shift+K", keysOfField, "Published keys on or off"},
    {nullptr, "Space+drag, middle-drag", keysOfField, "Pan"},
    {nullptr, "Wheel", keysOfField, "Zoom"},

    {"showKeys", "F1", keysOfWindow},
    {"findAnything", "Ctrl+K", keysOfWindow},
    {"openFile", "Ctrl+O", keysOfWindow},
    {"openSession", "Ctrl+Shift+O", keysOfWindow},
    {"saveScenario", "Ctrl+S", keysOfWindow},
    {"undo", "Ctrl+Z", keysOfWindow, "Undo", nullptr, whileHeld},
    {"redo", "Ctrl+Shift+Z", keysOfWindow, "Redo", nullptr, whileHeld},
    {"fieldOnly", "F11", keysOfWindow},
    {"fullScreen", "Shift+F11", keysOfWindow},
    {"quit", "Ctrl+Q", keysOfWindow},

    {nullptr, "Click", keysOfPlots, "Show that moment everywhere"},
    {nullptr, "Drag, wheel", keysOfPlots, "Move, zoom in time"},
    {nullptr, "Ctrl+wheel, Shift+drag", keysOfPlots, "Zoom the values, zoom into a box"},
    {nullptr, "Double-click", keysOfPlots, "Show everything"},
    {nullptr, "Wheel on the numbers", keysOfPlots, "Scroll the plots"},

    {nullptr, "Tab, Shift+Tab", keysOfPanels, "Next, previous control"},
    {nullptr, "Enter", keysOfPanels, "Press a button, select a robot, plot"},
    {nullptr, "F2, *", keysOfPanels, "Edit the value, mark as favourite (Variables)"},
    {nullptr, "Ctrl+C", keysOfPanels, "Copy the selected lines"},
};

QList<QKeySequence> sequencesOf(const KeyRow& row) {
  QList<QKeySequence> all;
  for (const QString& keys : QString::fromUtf8(row.keys).split(QLatin1Char(' '))) {
    all << QKeySequence(keys, QKeySequence::PortableText);
  }
  return all;
}

QString shownKeys(const KeyRow& row) {
  if (row.shown != nullptr) return QString::fromUtf8(row.shown);
  if (row.id == nullptr) return QString::fromUtf8(row.keys);
  QStringList texts;
  for (const QKeySequence& keys : sequencesOf(row)) texts << keys.toString();
  return texts.join(QStringLiteral(", "));
}

QString withoutMnemonic(QString text) {
  text.remove(QLatin1Char('&'));
  text.remove(QStringLiteral("…"));
  return text;
}

}  // namespace

std::span<const KeyRow> keyRows() {
  return keyTable;
}

KeyMap::KeyMap(QWidget& owner) : m_window(owner) {
  for (const KeyRow& row : keyTable) {
    if (row.id == nullptr) continue;
    QAction* const its = action(row.id);
    its->setShortcuts(sequencesOf(row));
    its->setAutoRepeat(row.repeats);
    its->setToolTip(QStringLiteral("%1 (%2)").arg(its->toolTip(), its->shortcut().toString()));
    // A key of an action counts only where something that shows it is seen; the window always is.
    m_window.addAction(its);
  }
}

QAction* KeyMap::action(const char* id) const {
  auto* found = m_window.findChild<QAction*>(QLatin1String(id));
  if (found == nullptr) qFatal("no action has the name %s", id);
  return found;
}

std::vector<KeyLine> KeyMap::lines(bool published) const {
  std::vector<KeyLine> all;
  for (const KeyRow& row : keyTable) {
    const QString keys = shownKeys(row);
    if (keys.isEmpty()) continue;
    all.push_back({keys,
                   row.text != nullptr ? QString::fromUtf8(row.text)
                                       : withoutMnemonic(action(row.id)->text()),
                   QString::fromUtf8(row.group)});
  }
  if (!published) return all;
  for (const FieldKey& key : fieldKeys()) {
    QString text = QString::fromUtf8(key.meaning);
    text.front() = text.front().toUpper();
    all.push_back({QString::fromUtf8(key.shown), text, QStringLiteral("Published keys")});
  }
  return all;
}

}  // namespace pitchboard::ui

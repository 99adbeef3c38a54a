// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_windows.h"

#include <QApplication>
#include <QDialog>
#include <QGridLayout>
#include <QLabel>
#include <QMainWindow>
#include <QMenuBar>
#include <QScrollArea>
#include <QVBoxLayout>

#include <ui/base/theme.h>

#include "menu_actions.h"

namespace pitchboard::ui {
namespace {

struct Keys {
  const char* keys;  ///< nullptr: `does` is a heading
  const char* does;
};

// What the mouse does and the keys that are no actions of a menu; those are listed by themselves.
constexpr Keys shortcuts[] = {
    {nullptr, "Field"},
    {"Drag, Shift-drag", "move, turn"},
    {"Wheel over a robot, wheel", "turn, zoom"},
    {"Middle-drag, Space-drag", "pan"},
    {"Home", "fit the field"},
    {"Arrows, Delete", "nudge, remove"},
    {"A, B", "add a robot, put the ball under the cursor"},
    {"1 to 9", "select a robot"},
    {nullptr, "Orders to the selected robot"},
    {"F, K, V, R", "forward fast, slow, backward fast, slow"},
    {"M, N, E, D", "walk left, right, turn left, right"},
    {"O, Q", "around the ball, left, right"},
    {"L, P, I, J", "kick left, right, pass left, right"},
    {"S, T", "gait in place, stop"},
    {"Y, Z", "ball search on, off"},
    {nullptr, "As in the published simulator"},
    {"F1", "help over the field"},
    {"F2, F3, F4", "load the match, start it again, clear the field"},
    {"F5", "pause or go on"},
    {"F6, F7, F8", "field of view, EOPRA, StarVars"},
    {nullptr, "Plots"},
    {"Click", "show that moment everywhere"},
    {"Drag, wheel", "move, zoom in time"},
    {"Ctrl+wheel, Shift-drag", "zoom the values, zoom into a box"},
    {"Double click", "show everything"},
    {"Wheel over the numbers", "scroll the plots"},
    {nullptr, "Timeline"},
    {"Click, drag", "look back"},
    {"Left, Right, Shift+Left, Shift+Right", "one tick, one second back or on"},
    {"Home, End", "to the oldest moment, to now"},
    {"Space, L", "play the past, loop the chosen range"},
    {"Shift-drag, Escape", "choose a range, choose none or go back to now"},
    {"+, \xE2\x88\x92, 0, wheel", "zoom, show everything"},
    {nullptr, "Variables"},
    {"Enter, F2, *", "plot, edit the value, favourite"},
    {nullptr, "Log"},
    {"Click, Ctrl+C", "show that moment everywhere, copy"},
};

}  // namespace

void showShortcuts(QMainWindow* parent) {
  auto* dialog = new QDialog(parent);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("shortcuts"));
  dialog->setWindowTitle(QStringLiteral("Keyboard shortcuts"));
  auto* list = new QWidget(dialog);
  auto* grid = new QGridLayout(list);
  grid->setHorizontalSpacing(scaled(parent, 24));
  grid->setVerticalSpacing(scaled(parent, 4));
  int row = 0;
  const auto head = [&](const QString& text) {
    auto* label = new QLabel(text, list);
    label->setFont(themeFont(TypeRole::Body, true));
    label->setContentsMargins(0, row == 0 ? 0 : scaled(parent, 8), 0, 0);
    grid->addWidget(label, row++, 0, 1, 2);
  };
  const auto add = [&](const QString& keys, const QString& text) {
    auto* does = new QLabel(text, list);
    does->setForegroundRole(QPalette::PlaceholderText);
    grid->addWidget(new QLabel(keys, list), row, 0);
    grid->addWidget(does, row++, 1);
  };
  QString menu;
  for (const MenuAction& each : menuActions(*parent->menuBar())) {
    if (each.action->shortcut().isEmpty()) continue;
    const QString top = each.menu.section(QLatin1Char(':'), 0, 0);
    if (top != menu) head(top);
    menu = top;
    QStringList keys;
    for (const QKeySequence& sequence : each.action->shortcuts()) {
      keys << sequence.toString(QKeySequence::NativeText);
    }
    add(keys.join(QStringLiteral(", ")), each.text);
  }
  for (const Keys& line : shortcuts) {
    if (line.keys == nullptr)
      head(QString::fromUtf8(line.does));
    else
      add(QString::fromUtf8(line.keys), QString::fromUtf8(line.does));
  }
  grid->setColumnStretch(1, 1);
  auto* scroll = new QScrollArea(dialog);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(list);
  scroll->setMinimumWidth(list->sizeHint().width() + scaled(parent, 16));
  auto* column = new QVBoxLayout(dialog);
  column->addWidget(scroll);
  dialog->resize(scaled(parent, 500), scaled(parent, 640));
  dialog->show();
}

void showAbout(QWidget* parent) {
  auto* dialog = new QDialog(parent);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(QStringLiteral("About Pitchboard"));
  auto* text = new QLabel(
      QStringLiteral(
          "<b>Pitchboard %1</b><p>A studio for teams whose humanoid soccer robots run the "
          "Cross Architecture: simulate them, watch them, see what they believe.</p>"
          "<p>Free software under the GNU General Public License, version 3 or later. "
          "There is no warranty.</p>")
          .arg(QApplication::applicationVersion()),
      dialog);
  text->setWordWrap(true);
  auto* column = new QVBoxLayout(dialog);
  const int edge = scaled(parent, 16);
  column->setContentsMargins(edge, edge, edge, edge);
  column->addWidget(text);
  dialog->resize(scaled(parent, 400), dialog->sizeHint().height());
  dialog->show();
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_windows.h"

#include <QApplication>
#include <QDialog>
#include <QGridLayout>
#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

struct Keys {
  const char* keys;  ///< nullptr: `does` is a heading
  const char* does;
};

constexpr Keys shortcuts[] = {
    {nullptr, "Window"},
    {"Ctrl+P", "play or pause"},
    {"Ctrl+.", "one tick"},
    {"Ctrl+R", "restart the scenario"},
    {"Ctrl+Z, Ctrl+Shift+Z", "undo, redo"},
    {"Ctrl+O, Ctrl+S", "open a scenario, save this moment"},
    {"Ctrl+Shift+A", "select all robots"},
    {"F11", "full screen"},
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
    {"O, Q", "around the ball, clockwise, anticlockwise"},
    {"L, P, I, J", "kick left, right, pass left, right"},
    {"S, T", "gait in place, stop"},
    {"Y, Z", "ball search on, off"},
    {nullptr, "As in the published simulator"},
    {"F1", "help over the field"},
    {"F2, F3, F4", "load the match, start it again, clear the field"},
    {"F5", "pause or go on"},
    {"F6, F7, F8", "field of view, EOPRA, StarVars"},
};

}  // namespace

void showShortcuts(QWidget* parent) {
  auto* dialog = new QDialog(parent);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(QStringLiteral("Keyboard shortcuts"));
  auto* list = new QWidget(dialog);
  auto* grid = new QGridLayout(list);
  grid->setHorizontalSpacing(scaled(parent, 24));
  grid->setVerticalSpacing(scaled(parent, 4));
  int row = 0;
  for (const Keys& line : shortcuts) {
    auto* does = new QLabel(QString::fromUtf8(line.does), list);
    if (line.keys == nullptr) {
      does->setFont(themeFont(TypeRole::Body, true));
      does->setContentsMargins(0, row == 0 ? 0 : scaled(parent, 8), 0, 0);
      grid->addWidget(does, row++, 0, 1, 2);
      continue;
    }
    grid->addWidget(new QLabel(QString::fromUtf8(line.keys), list), row, 0);
    does->setForegroundRole(QPalette::PlaceholderText);
    grid->addWidget(does, row++, 1);
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

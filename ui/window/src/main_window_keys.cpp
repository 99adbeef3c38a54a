// SPDX-License-Identifier: GPL-3.0-or-later
// What keys do that no menu offers, and the map that gives all actions their keys.
#include <ui/window/main_window.h>

#include <QDockWidget>
#include <QKeyEvent>

#include <ui/field/field_view.h>
#include <ui/sources/note_board.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>
#include <ui/video/video_dock.h>

#include "field_only.h"
#include "help_overlay.h"
#include "key_guard.h"
#include "key_map.h"

namespace pitchboard::ui {

void MainWindow::makeKeys() {
  const auto make = [this](const QString& id, const QString& text, auto act) {
    auto* action = new QAction(text, this);
    action->setObjectName(id);
    connect(action, &QAction::triggered, this, act);
  };
  make(QStringLiteral("escape"), QStringLiteral("Cancel, or back to now"),
       [this] { cancelStepByStep(); });
  struct Direction {
    const char* name;
    double x, y;
  };
  for (const Direction& direction :
       {Direction{"Left", -1, 0}, {"Right", 1, 0}, {"Up", 0, 1}, {"Down", 0, -1}}) {
    const QString name = QLatin1String(direction.name);
    constexpr double fine = 0.01, coarse = 0.1;  // m
    make(QStringLiteral("nudge") + name, QStringLiteral("Nudge selected robots"),
         [this, direction] { m_field->nudge(QPointF(direction.x, direction.y) * fine); });
    make(QStringLiteral("push") + name, QStringLiteral("Nudge selected robots far"),
         [this, direction] { m_field->nudge(QPointF(direction.x, direction.y) * coarse); });
  }
  for (int number = 1; number <= 9; ++number) {
    make(QStringLiteral("select%1").arg(number), QStringLiteral("Select robot %1").arg(number),
         [this, number] { m_field->selectNumber(number); });
  }
  m_keys = std::make_unique<KeyMap>(*this);
  auto* overlay = new HelpOverlay(this);
  connect(m_field->actions().showKeys, &QAction::triggered, overlay, [this, overlay] {
    overlay->open(m_keys->lines(m_field->actions().publishedKeys->isChecked()));
  });
  new KeyGuard(this, m_field, m_keys->action("play"), overlay);
}

// Escape: the first of these that there is.
void MainWindow::cancelStepByStep() {
  const auto* video = findChild<QDockWidget*>(QStringLiteral("video"));
  if (m_noteBoard->cancel() || cancelVideoDrag(video->widget()) || m_field->cancel()) return;
  if (m_shown->selection())
    m_shown->setSelection({});
  else if (m_shown->isLookingBack())
    m_shown->goLive();
  else if (m_fieldOnly->isOn())
    m_fieldOnly->set(false);
  else
    m_selection->set({});
}

// Escape comes here when a text field had no use for it: the field has the keys again.
void MainWindow::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape)
    m_field->setFocus();
  else
    QMainWindow::keyPressEvent(event);
}

}  // namespace pitchboard::ui

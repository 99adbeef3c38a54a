// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_only.h"

#include <QAction>
#include <QDockWidget>
#include <QKeyEvent>
#include <QMainWindow>
#include <QMenuBar>
#include <QStatusBar>
#include <QTimer>
#include <QToolBar>
#include <utility>

#include <ui/base/theme.h>
#include <ui/sources/source_switch.h>

#include "menu_actions.h"
#include "scoreboard.h"

namespace pitchboard::ui {

FieldOnly::FieldOnly(QMainWindow* window, SourceSwitch* source)
    : QObject(window),
      m_window(window),
      m_source(source),
      m_action(new QAction(QStringLiteral("Field on the &whole screen"), this)),
      m_end(new QAction(QStringLiteral("End the whole screen"), this)),
      m_timer(new QTimer(this)) {
  m_action->setObjectName(QStringLiteral("fieldOnly"));
  m_action->setCheckable(true);
  m_action->setShortcut(QKeySequence(Qt::Key_F11));
  connect(m_action, &QAction::triggered, this, &FieldOnly::set);
  m_end->setShortcut(QKeySequence(Qt::Key_Escape));
  m_end->setEnabled(false);
  connect(m_end, &QAction::triggered, this, [this] { set(false); });
  window->addActions({m_action, m_end});
  constexpr int scoreMilliseconds = 100;
  m_timer->setInterval(scoreMilliseconds);
  connect(m_timer, &QTimer::timeout, this, &FieldOnly::place);
}

// A key of an action counts only where something that shows it is seen.
void FieldOnly::keepKeys(bool on) {
  for (const QPointer<QAction>& action : m_kept) {
    if (action) m_window->removeAction(action);
  }
  m_kept.clear();
  if (!on) return;
  QList<QAction*> all;
  for (const MenuAction& each : menuActions(*m_window->menuBar())) all << each.action;
  for (QToolBar* bar : m_window->findChildren<QToolBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    all << bar->actions();
  }
  const QList<QAction*> own = m_window->actions();
  for (QAction* action : std::as_const(all)) {
    if (action->shortcut().isEmpty() || own.contains(action)) continue;
    m_window->addAction(action);
    m_kept << action;
  }
}

void FieldOnly::set(bool on) {
  if (on == m_on) return;
  m_on = on;
  keepKeys(on);
  m_action->setChecked(on);
  m_end->setEnabled(on);
  if (on) {
    m_layout = m_window->saveState();
    m_state = m_window->windowState();
    for (QDockWidget* dock : m_window->findChildren<QDockWidget*>()) dock->hide();
  }
  for (QToolBar* bar : m_window->findChildren<QToolBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    bar->setVisible(!on);
  }
  // A projector's public has no use for tools.
  if (auto* tools = m_window->findChild<QToolBar*>(QStringLiteral("fieldTools"))) {
    tools->setVisible(!on);
  }
  m_window->menuBar()->setVisible(!on);
  m_window->statusBar()->setVisible(!on);
  m_window->setWindowState(on ? m_state | Qt::WindowFullScreen : m_state);
  if (!on) {
    m_timer->stop();
    delete m_scoreboard;
    m_scoreboard = nullptr;
    m_window->centralWidget()->removeEventFilter(this);
    m_window->removeEventFilter(this);
    m_window->restoreState(m_layout);
    return;
  }
  m_scoreboard = new Scoreboard(m_window->centralWidget());
  m_scoreboard->setAutoFillBackground(true);
  m_window->centralWidget()->installEventFilter(this);
  m_window->installEventFilter(this);
  place();
  m_scoreboard->show();
  m_timer->start();
}

void FieldOnly::place() {
  if (const FramePtr frame = m_source->frame()) m_scoreboard->setState(scoreboardOf(*frame));
  const QSize size = m_scoreboard->sizeHint() + QSize(scaled(m_window, 16), scaled(m_window, 8));
  const QWidget* host = m_window->centralWidget();
  m_scoreboard->setGeometry(QRect(QPoint((host->width() - size.width()) / 2, 0), size));
  m_scoreboard->raise();
}

bool FieldOnly::eventFilter(QObject* watched, QEvent* event) {
  if (watched == m_window) {
    // The field asks for Escape before shortcuts do, and lets it go when it has no use for it.
    const bool isKey = event->type() == QEvent::KeyPress;
    if (isKey && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
      set(false);
      return true;
    }
  } else if (event->type() == QEvent::Resize && m_scoreboard != nullptr) {
    place();
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_only.h"

#include <QAction>
#include <QDockWidget>
#include <QEvent>
#include <QMainWindow>
#include <QMenuBar>
#include <QStatusBar>
#include <QToolBar>
#include <utility>

#include <ui/base/theme.h>
#include <ui/sources/shown_moment.h>

#include "scoreboard.h"

namespace pitchboard::ui {

FieldOnly::FieldOnly(QMainWindow* window, ShownMoment* shown)
    : QObject(window),
      m_window(window),
      m_shown(shown),
      m_action(new QAction(QStringLiteral("Field &only"), this)) {
  m_action->setObjectName(QStringLiteral("fieldOnly"));
  m_action->setCheckable(true);
  connect(m_action, &QAction::triggered, this, &FieldOnly::set);
  constexpr Beat::Milliseconds least{100};
  m_place = Beat::display().add(window, least, [this] {
    if (m_on) place();
  });
  connect(shown, &ShownMoment::frameReceived, this, [this] { m_place->want(); });
}

void FieldOnly::set(bool on) {
  if (on == m_on) return;
  m_on = on;
  m_action->setChecked(on);
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
    delete m_scoreboard;
    m_scoreboard = nullptr;
    m_window->centralWidget()->removeEventFilter(this);
    m_window->restoreState(m_layout);
    return;
  }
  m_scoreboard = new Scoreboard(m_window->centralWidget());
  m_scoreboard->setAutoFillBackground(true);
  m_window->centralWidget()->installEventFilter(this);
  place();
  m_scoreboard->show();
}

void FieldOnly::place() {
  if (const FramePtr frame = m_shown->frame()) m_scoreboard->setState(scoreboardOf(*frame));
  const QSize size = m_scoreboard->sizeHint() + QSize(scaled(m_window, 16), scaled(m_window, 8));
  const QWidget* host = m_window->centralWidget();
  m_scoreboard->setGeometry(QRect(QPoint((host->width() - size.width()) / 2, 0), size));
  m_scoreboard->raise();
}

bool FieldOnly::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && m_scoreboard != nullptr) place();
  return QObject::eventFilter(watched, event);
}

}  // namespace pitchboard::ui

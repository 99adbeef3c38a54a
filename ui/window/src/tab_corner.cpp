// SPDX-License-Identifier: GPL-3.0-or-later
#include "tab_corner.h"

#include <QBoxLayout>
#include <QDockWidget>
#include <QEvent>
#include <QMainWindow>
#include <QTabBar>
#include <algorithm>

#include <ui/base/theme.h>

#include "dock_title.h"

namespace pitchboard::ui {
namespace {
constexpr int minWidth = 160;  // px of the mock; with less room tabs could not be read
constexpr int gap = 24;        // to the tabs of the docks
}  // namespace

TabCorner::TabCorner(QDockWidget* dock, QWidget* corner, const std::vector<QDockWidget*>& docks)
    : QObject(dock), m_dock(dock), m_corner(corner) {
  // After the titles, which are folded by the same signals.
  for (QDockWidget* each : docks) {
    for (const auto changed : {&QDockWidget::visibilityChanged, &QDockWidget::topLevelChanged}) {
      connect(each, changed, this, &TabCorner::place, Qt::QueuedConnection);
    }
    connect(each, &QDockWidget::dockLocationChanged, this, &TabCorner::place, Qt::QueuedConnection);
  }
}

// Qt has no way from a dock to its tab; titles of docks are unique.
QTabBar* TabCorner::row() const {
  const auto* window = qobject_cast<QMainWindow*>(m_dock->parentWidget());
  if (window == nullptr || m_dock->isFloating() || m_dock->isHidden()) return nullptr;
  for (QTabBar* bar : window->findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    for (int i = 0; i < bar->count(); ++i) {
      if (bar->tabText(i) == m_dock->windowTitle()) return bar;
    }
  }
  return nullptr;
}

void TabCorner::place() {
  if (!m_corner) return;
  QTabBar* found = row();
  if (m_row != found) {
    if (m_row) {
      m_row->removeEventFilter(this);
      m_row->disconnect(this);
    }
    m_row = found;
    if (m_row) {
      m_row->installEventFilter(this);
      connect(m_row, &QTabBar::currentChanged, this, &TabCorner::place, Qt::QueuedConnection);
      connect(m_row, &QTabBar::tabMoved, this, &TabCorner::place, Qt::QueuedConnection);
    }
  }
  // Where only one dock is left, Qt moves the bar out of the window instead of hiding it.
  const bool seen = m_row && m_row->isVisible() && m_row->count() > 1 &&
                    m_row->parentWidget()->rect().intersects(m_row->geometry());
  if (seen)
    goInto(m_row);
  else
    goHome();
}

void TabCorner::goInto(QTabBar* row) {
  const int left = row->tabRect(row->count() - 1).right() + scaled(row, gap);
  const QRect free(left, 0, row->width() - left, row->height());
  if (free.width() < scaled(row, minWidth)) {
    goHome();
    return;
  }
  if (m_corner->parentWidget() != row) {
    m_corner->setParent(row);
    m_corner->setAutoFillBackground(false);
  }
  m_corner->setGeometry(free);
  const bool inFront = row->tabText(row->currentIndex()) == m_dock->windowTitle();
  m_corner->setVisible(inFront);
}

void TabCorner::goHome() {
  auto* title = qobject_cast<DockTitle*>(m_dock->titleBarWidget());
  if (title != nullptr && title->isVisible()) {
    if (m_corner->parentWidget() != title) title->setCorner(m_corner);
  } else if (m_corner->parentWidget() != m_dock->widget()) {
    qobject_cast<QBoxLayout*>(m_dock->widget()->layout())->insertWidget(0, m_corner);
  }
  m_corner->show();
}

bool TabCorner::eventFilter(QObject* watched, QEvent* event) {
  constexpr QEvent::Type placing[] = {QEvent::Resize, QEvent::Move, QEvent::Show, QEvent::Hide,
                                      QEvent::LayoutRequest};
  if (watched == m_row && std::ranges::find(placing, event->type()) != std::end(placing)) {
    // The tabs have their places only when the row has dealt with it.
    QMetaObject::invokeMethod(this, &TabCorner::place, Qt::QueuedConnection);
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace pitchboard::ui

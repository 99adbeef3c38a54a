// SPDX-License-Identifier: GPL-3.0-or-later
#include "dock_title.h"

#include <QDockWidget>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QToolButton>

#include <ui/base/floating_place.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QToolButton* button(DockTitle* parent, const QString& icon, const QString& name) {
  auto* made = new QToolButton(parent);
  made->setIcon(themedIcon(icon));
  made->setIconSize(QSize(scaled(parent, 12), scaled(parent, 12)));
  made->setToolTip(name);
  made->setAccessibleName(name);
  made->setFocusPolicy(Qt::NoFocus);
  made->setFixedSize(scaled(parent, 20), scaled(parent, 20));
  made->setAutoRaise(true);
  return made;
}

}  // namespace

DockTitle::DockTitle(QDockWidget* dock) : QWidget(dock) {
  auto* label = new QLabel(dock->windowTitle(), this);
  label->setFont(themeFont(TypeRole::Secondary, true));
  label->setForegroundRole(QPalette::PlaceholderText);
  QToolButton* floating =
      button(this, QStringLiteral("window-restore"), QStringLiteral("Float or dock"));
  QToolButton* close = button(this, QStringLiteral("window-close"), QStringLiteral("Close"));
  connect(floating, &QToolButton::clicked, dock, [dock] {
    dock->setFloating(!dock->isFloating());
    if (dock->isFloating()) moveBesideTools(dock);
  });
  connect(close, &QToolButton::clicked, dock, &QDockWidget::close);
  dock->installEventFilter(this);
  m_row = new QHBoxLayout(this);
  m_row->setContentsMargins(scaled(this, 8), 0, scaled(this, 4), 0);
  m_row->setSpacing(0);
  m_row->addWidget(label);
  m_row->addStretch(1);
  m_row->addWidget(floating);
  m_row->addWidget(close);
}

void DockTitle::setCorner(QWidget* corner) {
  m_row->insertWidget(1, corner, 100);
}

QSize DockTitle::sizeHint() const {
  return {QWidget::sizeHint().width(), m_folded ? 0 : scaled(this, 24)};
}

// With a title of its own a floating dock has no frame, and could not be told from the window.
bool DockTitle::eventFilter(QObject* watched, QEvent* event) {
  auto* dock = qobject_cast<QDockWidget*>(watched);
  if (dock != nullptr && event->type() == QEvent::Paint && dock->isFloating()) {
    QPainter painter(dock);
    painter.setPen(theme().innerLine);
    painter.drawRect(dock->rect().adjusted(0, 0, -1, -1));
  }
  return QWidget::eventFilter(watched, event);
}

bool DockTitle::setFolded(bool folded) {
  if (folded == m_folded) return false;
  m_folded = folded;
  setVisible(!folded);
  updateGeometry();
  // A dock asks its title for its size only when the title is set.
  if (auto* dock = qobject_cast<QDockWidget*>(parentWidget())) dock->setTitleBarWidget(this);
  return true;
}

}  // namespace pitchboard::ui

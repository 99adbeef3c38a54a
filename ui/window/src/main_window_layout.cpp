// SPDX-License-Identifier: GPL-3.0-or-later
// Where the window and its docks stand, and how that is kept.
#include <ui/window/main_window.h>

#include <QAbstractButton>
#include <QCloseEvent>
#include <QDockWidget>
#include <QGuiApplication>
#include <QLineEdit>
#include <QMouseEvent>
#include <QScreen>
#include <QSettings>
#include <QTabBar>
#include <QTimer>
#include <algorithm>
#include <map>
#include <utility>

#include <ui/base/notice_bar.h>
#include <ui/field/field_settings.h>
#include <ui/field/field_view.h>

#include "dock_list.h"
#include "dock_title.h"
#include "field_only.h"
#include "geometry.h"

namespace pitchboard::ui {
namespace {
// Raised when docks come or go in a way that older layouts cannot describe.
constexpr int layoutVersion = 2;
const QString geometryKey = QStringLiteral("window/geometry");
const QString placeKey = QStringLiteral("window/place");  // of the frame; the size without it
const QString layoutKey = QStringLiteral("window/layout");
const QString untouchedKey = QStringLiteral("window/layoutFollowsSize");
}  // namespace

// A tab shows the name already, and the timeline its times.
void MainWindow::showTitles() {
  // Names of tabs are whole; a row without room for all of them scrolls.
  for (QTabBar* row : findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    row->setElideMode(Qt::ElideNone);
    row->setUsesScrollButtons(true);
  }
  bool changed = false;
  for (std::size_t i = 0; i < m_docks.size(); ++i) {
    QDockWidget* dock = m_docks[i];
    const QList<QDockWidget*> beside = tabifiedDockWidgets(dock);
    const bool tabs = std::any_of(beside.begin(), beside.end(), [](const QDockWidget* other) {
      return !other->isHidden() && !other->isFloating();
    });
    const bool isNamed = studioDocks()[i].ownRow || tabs;
    auto* title = static_cast<DockTitle*>(dock->titleBarWidget());
    changed = title->setFolded(!dock->isFloating() && isNamed) || changed;
  }
  int needed = 0;
  for (std::size_t i = 0; i < m_docks.size(); ++i) {
    if (!m_docks[i]->isHidden() && !m_docks[i]->isFloating())
      needed = std::max(needed, studioDocks()[i].height);
  }
  changed = std::exchange(m_neededHeight, needed) != needed || changed;
  // A title that comes or goes gives its height to the panel beside it, or takes it from there.
  if (changed) distributeSpaceLater();
}

// Panels report their least sizes after the layout has been activated.
void MainWindow::distributeSpaceLater() {
  QTimer::singleShot(0, this, [this] {
    if (m_followsSize && !m_fieldOnly->isOn()) distributeSpace();
  });
}

void MainWindow::restoreLayout() {
  // A minimum of its own: without one the layout makes the window larger whenever a panel asks for
  // more, beyond the screen if need be.
  const QSize least(scaled(this, minWindow.width()), scaled(this, minWindow.height()));
  setMinimumSize(least.boundedTo(screen()->availableSize()));
  const bool isKept = restoreGeometry(m_settings->value(geometryKey).toByteArray());
  restorePlace();
  if (!isKept) {
    const QSize room = screen()->availableSize();
    resize(qMin(scaled(this, 1440), room.width()), qMin(scaled(this, 900), room.height()));
  }
  resetLayout();
  // Panels that float are windows, and Qt would show them now, before the window they belong to. A
  // window manager that has not seen that one does not know whose they are, and puts it over them
  // at the first click.
  for (QDockWidget* dock : m_docks) dock->setAttribute(Qt::WA_DontShowOnScreen);
  const QByteArray saved = m_settings->value(layoutKey).toByteArray();
  if (!saved.isEmpty() && restoreState(saved, layoutVersion)) {
    m_followsSize = m_settings->value(untouchedKey, false).toBool();
    // Layouts of earlier versions may have panels above the field.
    for (std::size_t i = 0; i < m_docks.size(); ++i) {
      if (dockWidgetArea(m_docks[i]) == Qt::TopDockWidgetArea)
        addDockWidget(studioDocks()[i].area, m_docks[i]);
    }
  } else if (!saved.isEmpty()) {
    resetLayout();
    m_notices->show(
        {QStringLiteral("layout")},
        QStringLiteral("The saved layout is from another version, so the default layout is used."));
  }
  for (QDockWidget* dock : m_docks) {
    if (!dock->isFloating() || !dock->isVisible()) {
      dock->setAttribute(Qt::WA_DontShowOnScreen, false);
    }
  }
  showTitles();  // now: a title that goes later moves everything
  if (!isKept) m_firstSize = size();
  m_savedLayout = saveState(layoutVersion);
  restoreFieldLayers(*m_field, *m_settings);
}

// Qt guesses the height of the title bar from the style, and moves a window that starts closer to
// the top of the screen down to there; the frame itself is known only once the window is shown.
void MainWindow::restorePlace() {
  const QRect kept = m_settings->value(placeKey).toRect();
  if (!kept.isValid() || isMaximized() || isFullScreen()) return;
  const QScreen* on = QGuiApplication::screenAt(kept.center());
  if (on == nullptr || !on->availableGeometry().contains(kept)) return;
  resize(kept.size());
  move(kept.topLeft());
}

// Kept while the studio runs: however it ends, the layout is there.
void MainWindow::saveLayout() {
  if (m_fieldOnly->isOn()) return;
  const QByteArray now = saveState(layoutVersion);
  const QByteArray where = saveGeometry();
  // A file that is written again and again is a disk that is busy.
  if (m_settings->value(geometryKey).toByteArray() != where) {
    m_settings->setValue(geometryKey, where);
  }
  if (const QRect place(pos(), size());
      !isMaximized() && !isFullScreen() && m_settings->value(placeKey).toRect() != place) {
    m_settings->setValue(placeKey, place);
  }
  saveFieldLayers(*m_field, *m_settings);
  if (now == m_savedLayout) return;
  m_savedLayout = now;
  m_settings->setValue(layoutKey, now);
  m_settings->setValue(untouchedKey, m_followsSize);
}

// Panels keep their shares of the window until somebody gives them others.
bool MainWindow::event(QEvent* event) {
  if (event->type() == QEvent::MouseButtonPress &&
      isSeparator(static_cast<QMouseEvent*>(event)->position().toPoint())) {
    m_followsSize = false;
  }
  return QMainWindow::event(event);
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  if (m_followsSize && !m_fieldOnly->isOn()) distributeSpace();
}

void MainWindow::distributeSpace() {
  const double unit = scaled(this, 1000) / 1000.0;
  Extents extents = extentsFor(size() / unit);
  // At most two fifths of the window.
  extents.bottom =
      std::max(extents.bottom, std::min(m_neededHeight, qRound(height() * 0.4 / unit)));
  const auto docksIn = [this](Qt::DockWidgetArea area) {
    QList<QDockWidget*> there;
    for (std::size_t i = 0; i < m_docks.size(); ++i) {
      QDockWidget* dock = m_docks[i];
      if (!studioDocks()[i].ownRow && dockWidgetArea(dock) == area && !dock->isFloating() &&
          !dock->isHidden())
        there << dock;
    }
    return there;
  };
  // Tabs of one place have one size.
  for (const auto& [area, extent] : {std::pair(Qt::LeftDockWidgetArea, extents.left),
                                     std::pair(Qt::RightDockWidgetArea, extents.right)}) {
    if (const auto docks = docksIn(area); !docks.isEmpty())
      resizeDocks({docks.first()}, {scaled(this, extent)}, Qt::Horizontal);
  }
  // Panels that were dropped below each other share the height.
  QList<QDockWidget*> rows;
  for (QDockWidget* dock : docksIn(Qt::BottomDockWidgetArea)) {
    const QList<QDockWidget*> tabs = tabifiedDockWidgets(dock);
    const bool isNew = std::ranges::none_of(
        rows, [&](QDockWidget* row) { return tabs.contains(row) || row->y() == dock->y(); });
    if (isNew) rows << dock;
  }
  if (!rows.isEmpty()) {
    const int each = scaled(this, extents.bottom) / static_cast<int>(rows.size());
    resizeDocks(rows, QList<int>(rows.size(), each), Qt::Vertical);
  }
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (std::exchange(m_wasShown, true)) return;
  QTimer::singleShot(0, this, [this] {
    fitScreen();
    // Docks that were never laid out have no sizes that could be given to them.
    if (m_followsSize) distributeSpace();
    for (QDockWidget* dock : m_docks) {
      if (!dock->isFloating() || !dock->isVisible()) continue;
      dock->hide();
      dock->setAttribute(Qt::WA_DontShowOnScreen, false);
      dock->show();
      dock->raise();
    }
  });
}

void MainWindow::changeEvent(QEvent* event) {
  QMainWindow::changeEvent(event);
  if (event->type() != QEvent::ActivationChange || !isActiveWindow()) return;
  // The desktop has put its frame around the window by now; when it was shown, it had not.
  if (!std::exchange(m_wasActive, true)) QTimer::singleShot(0, this, &MainWindow::fitScreen);
}

// The first window must not be larger than what is there for it, frame included. A size that
// somebody asked for is left alone.
void MainWindow::fitScreen() {
  if (size() != m_firstSize || isMaximized() || isFullScreen()) return;
  const QRect room = screen()->availableGeometry();
  const QSize frame = frameGeometry().size() - size();
  const QSize most = room.size() - frame;
  if (width() > most.width() || height() > most.height()) resize(size().boundedTo(most));
  QRect outer = frameGeometry();
  if (outer.right() > room.right()) outer.moveRight(room.right());
  if (outer.bottom() > room.bottom()) outer.moveBottom(room.bottom());
  if (outer.left() < room.left()) outer.moveLeft(room.left());
  if (outer.top() < room.top()) outer.moveTop(room.top());
  if (outer.topLeft() != frameGeometry().topLeft()) move(outer.topLeft());
  m_firstSize = size();  // for when its frame is known
}

void MainWindow::resetLayout() {
  m_notices->settle(QStringLiteral("layout"));
  setUpdatesEnabled(false);
  const auto infos = studioDocks();
  // Hidden while they are placed: nothing on the way asks for room.
  for (QDockWidget* dock : m_docks) {
    dock->setFloating(false);
    dock->hide();
  }
  // Rows of their own first: next to a tabbed dock a new one would become a tab.
  std::map<Qt::DockWidgetArea, QDockWidget*> lastTab;
  QDockWidget* firstBottom = nullptr;
  for (const bool ownRow : {false, true}) {
    for (std::size_t i = 0; i < infos.size(); ++i) {
      if (infos[i].ownRow != ownRow) continue;
      QDockWidget* dock = m_docks[i];
      QDockWidget*& last = lastTab[infos[i].area];
      addDockWidget(infos[i].area, dock);
      if (ownRow && firstBottom != nullptr) {
        splitDockWidget(firstBottom, dock, Qt::Vertical);
      } else if (!ownRow && last == nullptr && infos[i].area == Qt::BottomDockWidgetArea) {
        firstBottom = dock;
      }
      if (!ownRow && last == nullptr) last = dock;
    }
  }
  // One below the other, three docks at the right would show a few rows each.
  for (std::size_t i = 0; i < infos.size(); ++i) {
    QDockWidget* first = lastTab[infos[i].area];
    if (!infos[i].ownRow && first != m_docks[i]) tabifyDockWidget(first, m_docks[i]);
  }
  for (std::size_t i = 0; i < infos.size(); ++i) m_docks[i]->setVisible(infos[i].shownAtFirst);
  for (const auto& [area, first] : lastTab) first->raise();
  m_followsSize = true;
  distributeSpace();
  setUpdatesEnabled(true);
}

// Screen readers need a name for everything that the keyboard reaches: its own, or its dock's.
void MainWindow::nameForScreenReaders() {
  centralWidget()->setAccessibleName(QStringLiteral("Field"));
  for (QWidget* each : findChildren<QWidget*>()) {
    const auto* button = qobject_cast<QAbstractButton*>(each);
    const bool hasName =
        !each->accessibleName().isEmpty() || (button != nullptr && !button->text().isEmpty());
    if (hasName || each->focusPolicy() == Qt::NoFocus) continue;
    QString name = each->toolTip();
    if (const auto* line = qobject_cast<QLineEdit*>(each)) name = line->placeholderText();
    for (const QWidget* at = each; name.isEmpty() && at != nullptr; at = at->parentWidget()) {
      if (const auto* dock = qobject_cast<const QDockWidget*>(at)) name = dock->windowTitle();
      if (at == centralWidget()) name = at->accessibleName();
    }
    each->setAccessibleName(name);
  }
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (const QStringList running = m_work.sentences(); !m_closesNow && !running.isEmpty()) {
    event->ignore();
    askToClose(running);
    return;
  }
  m_fieldOnly->set(false);
  saveLayout();
  m_settings->setValue(layoutKey, saveState(layoutVersion));
  m_settings->setValue(untouchedKey, m_followsSize);
  QMainWindow::closeEvent(event);
}

}  // namespace pitchboard::ui

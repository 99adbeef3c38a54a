// SPDX-License-Identifier: GPL-3.0-or-later
// The tool strip of the plots.
#include <QAction>
#include <QLayout>
#include <QMenu>
#include <QTabBar>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>

#include <ui/base/theme.h>
#include <ui/plots/plot_menus.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/linked_time.h>

#include "plot_page.h"

namespace pitchboard::ui {
namespace {

QString windowText(double seconds) {
  return seconds < 60 ? QStringLiteral("%1 s").arg(seconds)
                      : QStringLiteral("%1 min").arg(seconds / 60);
}

QToolButton* toolButton(QAction* action, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setDefaultAction(action);
  button->setAutoRaise(true);
  button->setIconSize(QSize(scaled(parent, 16), scaled(parent, 16)));
  button->setFixedHeight(scaled(parent, 24));  // eight of them fit the dock's first height
  button->setFont(themeFont(TypeRole::Secondary));
  if (action->icon().isNull()) button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  if (action->menu() != nullptr) button->setPopupMode(QToolButton::InstantPopup);
  return button;
}

}  // namespace

// Beside the plots, because height is what they lack.
QToolBar* PlotsDock::makeTools() {
  auto* tools = new QToolBar(QStringLiteral("Tools of the plots"), this);
  tools->setOrientation(Qt::Vertical);
  tools->setObjectName(QStringLiteral("plotTools"));
  tools->layout()->setSpacing(1);  // the sheet's, which was asked before it had its name
  tools->setIconSize(QSize(scaled(this, 16), scaled(this, 16)));
  LinkedTime* time = m_context.time;

  m_follow =
      new QAction(themedIcon(QStringLiteral("media-seek-forward")), QStringLiteral("Follow"), this);
  m_follow->setToolTip(QStringLiteral("Follow the newest moment, or the moment shown"));
  m_follow->setCheckable(true);
  m_follow->setChecked(time->isFollowing());
  connect(m_follow, &QAction::triggered, time, &LinkedTime::setFollowing);
  connect(time, &LinkedTime::followingChanged, m_follow, &QAction::setChecked);

  m_window->setObjectName(QStringLiteral("plotWindow"));
  m_window->setToolTip(QStringLiteral("How much is shown while following"));
  m_window->setFont(themeFont(TypeRole::Secondary));
  m_window->setPopupMode(QToolButton::InstantPopup);
  auto* windows = new QMenu(m_window);
  for (const double seconds : LinkedTime::windows) {
    windows->addAction(windowText(seconds), this, [time, seconds] {
      time->setWindow(seconds);
      time->setFollowing(true);
    });
  }
  m_window->setMenu(windows);
  connect(time, &LinkedTime::windowChanged, this, &PlotsDock::showWindow);
  showWindow();

  m_marks = new QAction(QStringLiteral("A|B"), this);
  m_marks->setToolTip(
      QStringLiteral("Marks A and B: differences and statistics between two moments"));
  m_marks->setCheckable(true);
  m_marks->setChecked(time->hasMarks());
  connect(m_marks, &QAction::triggered, time, &LinkedTime::showMarks);
  connect(time, &LinkedTime::marksChanged, m_marks,
          [this, time] { m_marks->setChecked(time->hasMarks()); });

  m_box = new QAction(themedIcon(QStringLiteral("select-rectangular")),
                      QStringLiteral("Zoom into a box"), this);
  m_box->setToolTip(QStringLiteral("Drag a box to zoom into it (also Shift-drag)"));
  m_box->setCheckable(true);
  connect(m_box, &QAction::toggled, this, [this](bool on) {
    for (PlotPage* page : pages()) page->setBoxTool(on);
  });

  auto* fit = new QAction(themedIcon(QStringLiteral("zoom-fit-best")),
                          QStringLiteral("Show everything"), this);
  fit->setToolTip(QStringLiteral("Show all there is (also a double click on a plot)"));
  connect(fit, &QAction::triggered, time, &LinkedTime::fitAll);

  auto* add =
      new QAction(themedIcon(QStringLiteral("list-add")), QStringLiteral("Add curve…"), this);
  add->setToolTip(QStringLiteral("Add a variable, or a curve computed from variables"));
  connect(add, &QAction::triggered, this, [this] { askForCurve(this); });

  auto* more =
      new QAction(themedIcon(QStringLiteral("application-menu")), QStringLiteral("Plots"), this);
  more->setToolTip(QStringLiteral("Tabs, layouts, export"));
  more->setMenu(makePlotsMenu(this));

  auto* newPage =
      new QAction(themedIcon(QStringLiteral("tab-new")), QStringLiteral("New tab"), this);
  connect(newPage, &QAction::triggered, this, [this] {
    addPage({QStringLiteral("Plots %1").arg(m_tabs->count() + 1), {}});
    m_tabs->setCurrentIndex(m_tabs->count() - 1);
  });

  tools->addWidget(toolButton(m_follow, tools));
  tools->addWidget(m_window);
  for (QAction* action : {m_marks, m_box, fit, add, newPage, more}) {
    tools->addWidget(toolButton(action, tools));
  }
  return tools;
}

void PlotsDock::showWindow() {
  const double seconds = m_context.time->window();
  const auto& offered = LinkedTime::windows;
  const bool round = std::find(offered.begin(), offered.end(), seconds) != offered.end();
  m_window->setText(round ? windowText(seconds) : QStringLiteral("%1 s").arg(seconds, 0, 'g', 3));
  m_window->setAccessibleName(QStringLiteral("Time shown: %1").arg(m_window->text()));
  if (!m_restoring) m_saveSoon.start();
}

}  // namespace pitchboard::ui

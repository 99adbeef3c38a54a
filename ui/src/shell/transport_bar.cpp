// SPDX-License-Identifier: GPL-3.0-or-later
#include "transport_bar.h"

#include <QActionGroup>
#include <QComboBox>
#include <QTimer>
#include <QToolButton>
#include <cmath>

#include <ui/match_controller.h>
#include <ui/theme.h>

#include "scenario_chooser.h"
#include "live/live_bar.h"
#include "scoreboard.h"
#include "source_switch.h"

namespace pitchboard::ui {
namespace {

struct Mode {
  SourceKind kind;
  const char* name;
  const char* tip;
};
// The kinds of source that the window can show; a further one is a line here.
constexpr Mode modes[] = {
    {SourceKind::Simulate, "Simulate", "Robots simulated on this computer"},
    {SourceKind::Live, "Live", "Robots and referee as the network tells. Nothing is sent to robots"},
};

constexpr double speeds[] = {0.1, 0.25, 0.5, 1, 2, 5, 10, link::MatchRunner::unlimitedSpeed};

QString speedText(double speed) {
  if (speed == link::MatchRunner::unlimitedSpeed) return QStringLiteral("max");
  return QStringLiteral("%1×").arg(speed, 0, 'f', speed == 0.25 ? 2 : speed < 5 ? 1 : 0);
}

}  // namespace

TransportBar::TransportBar(const StudioContext& context, QSettings* settings, QWidget* parent)
    : QToolBar(tr("Tool bar"), parent), m_context(context),
      m_scenarios(new ScenarioChooser(settings, this)), m_scoreboard(new Scoreboard(this)),
      m_speed(new QComboBox(this)) {
  setObjectName(QStringLiteral("transportBar"));
  setMovable(false);
  toggleViewAction()->setVisible(false);
  setContextMenuPolicy(Qt::PreventContextMenu);
  setIconSize(QSize(scaled(this, 20), scaled(this, 20)));
  // A tool bar takes its padding at the top for its left, too.
  auto* edge = new QWidget(this);
  edge->setFixedWidth(0);
  addWidget(edge);
  addModes();
  addSeparator();
  addControl(SourceKind::Simulate, addWidget(m_scenarios));
  addControl(SourceKind::Simulate, addSeparator());
  addTransport();
  addControl(SourceKind::Live, addWidget(new LiveBar(context, this)));
  auto* stretch = new QWidget(this);
  stretch->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  addWidget(stretch);
  addWidget(m_scoreboard);

  constexpr int scoreMilliseconds = 100;
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] {
    if (const FramePtr frame = m_context.source->frame()) {
      m_scoreboard->setState(scoreboardOf(*frame));
    }
  });
  connect(context.source, &SourceSwitch::changed, this, &TransportBar::showMode);
  showMode();
  timer->start(scoreMilliseconds);
}

void TransportBar::addModes() {
  auto* group = new QActionGroup(this);
  for (const Mode& mode : modes) {
    auto* action = new QAction(tr(mode.name), group);
    action->setCheckable(true);
    action->setToolTip(tr(mode.tip));
    action->setChecked(mode.kind == m_context.source->kind());
    connect(action, &QAction::triggered, this, [this, kind = mode.kind] {
      emit sourceRequested(kind);
      showMode();   // the request may have been refused
    });
    m_modes.push_back({mode.kind, action});
    auto* button = new QToolButton(this);
    button->setObjectName(QStringLiteral("mode"));
    button->setDefaultAction(action);
    addWidget(button);
  }
}

void TransportBar::addTransport() {
  MatchController* controller = m_context.controller;
  m_restart = addAction(themedIcon(QStringLiteral("media-skip-backward")), tr("Restart"),
                        controller, &MatchController::restart);
  m_restart->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_R));
  m_play = addAction(themedIcon(QStringLiteral("media-playback-pause")), tr("Pause"), this,
                     [controller] { controller->setPaused(!controller->isPaused()); });
  m_play->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_P));
  m_step = addAction(themedIcon(QStringLiteral("media-skip-forward")), tr("One tick"), controller,
                     &MatchController::stepOnce);
  m_step->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_Period));
  m_restart->setObjectName(QStringLiteral("restart"));
  m_play->setObjectName(QStringLiteral("play"));
  m_step->setObjectName(QStringLiteral("step"));

  m_speed->setObjectName(QStringLiteral("speed"));
  m_speed->setToolTip(tr("Speed: simulated seconds per second"));
  m_speed->setMinimumWidth(scaled(this, 68));
  for (const double speed : speeds) m_speed->addItem(speedText(speed), speed);
  connect(m_speed, &QComboBox::activated, this, [this] {
    m_context.controller->setSpeed(m_speed->currentData().toDouble());
  });
  for (QAction* action : transportActions()) addControl(SourceKind::Simulate, action);
  addControl(SourceKind::Simulate, addWidget(m_speed));
  connect(controller, &MatchController::transportChanged, this, &TransportBar::showTransport);
  showTransport();
}

void TransportBar::showMode() {
  const SourceKind shown = m_context.source->kind();
  for (const Control& mode : m_modes) mode.action->setChecked(mode.kind == shown);
  for (const Control& control : m_controls) control.action->setVisible(control.kind == shown);
  const FramePtr frame = m_context.source->frame();
  m_scoreboard->setState(frame ? scoreboardOf(*frame) : ScoreboardState{});
  showTransport();
}

void TransportBar::showTransport() {
  const MatchController& controller = *m_context.controller;
  const bool paused = controller.isPaused();
  m_play->setText(paused ? tr("Play") : tr("Pause"));
  m_play->setToolTip(QStringLiteral("%1 (%2)").arg(m_play->text(),
                                                   m_play->shortcut().toString()));
  m_play->setIcon(themedIcon(paused ? QStringLiteral("media-playback-start")
                                    : QStringLiteral("media-playback-pause")));
  for (QAction* action : transportActions()) {
    action->setEnabled((controller.isOpen() || controller.isOpening()) &&
                       m_context.source->kind() == SourceKind::Simulate);
  }
  int at = m_speed->findData(controller.speed());
  if (at < 0) {
    m_speed->addItem(QStringLiteral("%1×").arg(controller.speed()), controller.speed());
    at = m_speed->count() - 1;
  }
  m_speed->setCurrentIndex(at);
}

}  // namespace pitchboard::ui

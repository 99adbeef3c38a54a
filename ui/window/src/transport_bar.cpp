// SPDX-License-Identifier: GPL-3.0-or-later
#include "transport_bar.h"

#include <QActionGroup>
#include <QComboBox>
#include <QEvent>
#include <QLayout>
#include <QMenu>
#include <QPainter>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <ui/base/action_reason.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/live/live_bar.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>

#include "scenario_chooser.h"
#include "scoreboard.h"

namespace pitchboard::ui {
const std::array<double, 8> matchSpeeds{0.1, 0.25, 0.5, 1,
                                        2,   5,    10,  link::MatchRunner::unlimitedSpeed};

QString speedText(double speed) {
  if (speed == link::MatchRunner::unlimitedSpeed) return QStringLiteral("max");
  return QStringLiteral("%1×").arg(speed, 0, 'f', speed == 0.25 ? 2 : speed < 4 ? 1 : 0);
}

TransportBar::TransportBar(const TransportContext& context, QSettings* settings, QWidget* parent)
    : QToolBar(QStringLiteral("Tool bar"), parent),
      m_context(context),
      m_scenarios(new ScenarioChooser(settings, this)),
      m_scoreboard(new Scoreboard(this)),
      m_liveBar(new LiveBar(context.live, settings, this)),
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
  addControl(m_context.controller, addWidget(m_scenarios));
  addControl(m_context.controller, addSeparator());
  addTransport();
  addSeparator();
  addRecord();
  addControl(m_context.live, addWidget(m_liveBar));
  // A choice made by mouse leaves the keys with the field.
  for (QComboBox* box : findChildren<QComboBox*>()) box->setFocusPolicy(Qt::TabFocus);

  constexpr Beat::Milliseconds least{100}, most{500};
  const auto refresh = [this] {
    if (const FramePtr frame = m_context.shown->frame()) {
      m_scoreboard->setState(scoreboardOf(*frame));
    }
    if (isFinished() != m_finished || hasNoReferee() != m_withoutReferee) showTransport();
    if (m_context.recording->isRecording()) showRecord();
  };
  m_refresh = Beat::display().add(this, least, refresh, most);
  connect(context.shown, &ShownMoment::frameReceived, this, [this] { m_refresh->want(); });
  connect(context.shown, &ShownMoment::sourceChosen, this, &TransportBar::showMode);
  showMode();
}

void TransportBar::addModes() {
  auto* group = new QActionGroup(this);
  for (const FrameSource* source : m_context.shown->sources()) {
    const SourceKind& kind = source->kind();
    auto* action = new QAction(QString::fromUtf8(kind.name), group);
    action->setCheckable(true);
    action->setToolTip(QString::fromUtf8(kind.tip));
    connect(action, &QAction::triggered, this, [this, &kind] {
      emit sourceRequested(kind);
      showMode();  // the request may have been refused
    });
    m_modes.push_back({source, action});
    auto* button = new QToolButton(this);
    button->setObjectName(QStringLiteral("mode"));
    button->setDefaultAction(action);
    addWidget(button);
  }
}

void TransportBar::addTransport() {
  m_restart = addAction(themedIcon(QStringLiteral("media-skip-backward")),
                        QStringLiteral("Restart"), this, [this] {
                          if (ShownMoment* past = played())
                            past->toStart();
                          else
                            m_context.controller->restart();
                        });
  m_play = addAction(themedIcon(QStringLiteral("media-playback-pause")), QStringLiteral("Pause"),
                     this, [this] {
                       if (ShownMoment* past = played()) {
                         past->setPaused(!past->isPaused());
                       } else if (isFinished()) {
                         m_context.controller->restart();
                         m_context.controller->setPaused(false);
                       } else {
                         m_context.controller->setPaused(!m_context.controller->isPaused());
                       }
                     });
  m_step = addAction(themedIcon(QStringLiteral("media-skip-forward")), QStringLiteral("One tick"),
                     this, [this] {
                       if (ShownMoment* past = played())
                         past->step(1);
                       else
                         m_context.controller->stepOnce();
                     });
  addSkip();
  m_restart->setObjectName(QStringLiteral("restart"));
  m_play->setObjectName(QStringLiteral("play"));
  m_step->setObjectName(QStringLiteral("step"));

  m_speed->setObjectName(QStringLiteral("speed"));
  connect(m_speed, &QComboBox::activated, this,
          [this] { setSpeed(m_speed->currentData().toDouble()); });
  for (const auto& [id, text, by] :
       {std::tuple("slower", "Slo&wer", -1), std::tuple("faster", "&Faster", 1)}) {
    auto* action = new QAction(QString::fromUtf8(text), this);
    action->setObjectName(QLatin1String(id));
    connect(action, &QAction::triggered, this, [this, by = by] {
      if (m_speed->isEnabled()) setSpeed(nextSpeed(by));
    });
    m_speedSteps << action;
  }
  m_speed->setAccessibleName(QStringLiteral("Speed"));
  addWidget(m_speed);
  connect(m_context.controller, &MatchController::transportChanged, this,
          &TransportBar::showTransport);
  connect(m_context.shown, &ShownMoment::lookingBackChanged, this, &TransportBar::showTransport);
  connect(m_context.shown, &ShownMoment::sourceChanged, this, &TransportBar::showTransport);
  connect(m_context.shown, &ShownMoment::playingChanged, this, &TransportBar::showTransport);
}

void TransportBar::addSkip() {
  const auto make = [this](const char* id, const char* text, const char* tip) {
    auto* action = new QAction(QString::fromUtf8(text), this);
    action->setObjectName(QLatin1String(id));
    action->setToolTip(QString::fromUtf8(tip));
    m_skips << action;
    return action;
  };
  connect(make("skipToKickOff", "Skip to &kick-off", "Plays at full speed until kick-off"),
          &QAction::triggered, m_context.controller, &MatchController::skipToKickOff);
  connect(make("skipToEvent", "Skip to next &event",
               "Plays at full speed until the next event on the timeline"),
          &QAction::triggered, this,
          [this] { m_context.controller->skipToEvent(m_context.shown->filter()); });
  auto* button = new QToolButton(this);
  button->setObjectName(QStringLiteral("skip"));
  button->setIcon(themedIcon(QStringLiteral("media-seek-forward")));
  button->setToolTip(
      QStringLiteral("Skip to kick-off (Ctrl+Shift+J) or to the next event "
                     "(Ctrl+J), at full speed"));
  button->setAccessibleName(QStringLiteral("Skip"));
  auto* menu = new QMenu(button);
  menu->addActions(m_skips);
  button->setMenu(menu);
  button->setPopupMode(QToolButton::InstantPopup);
  addControl(m_context.controller, addWidget(button));
}

void TransportBar::setSpeed(double speed) {
  if (ShownMoment* past = played())
    past->setSpeed(speed);
  else
    m_context.controller->setSpeed(speed);
}

// Of the offered ones; a speed that was typed on the command line may stand between two of them.
double TransportBar::nextSpeed(int by) const {
  const ShownMoment* past = played();
  const std::span<const double> speeds =
      past != nullptr ? ShownMoment::speeds() : std::span<const double>(matchSpeeds);
  const auto rank = [](double speed) {
    return speed == link::MatchRunner::unlimitedSpeed ? std::numeric_limits<double>::max() : speed;
  };
  const double now = past != nullptr ? past->speed() : m_context.controller->speed();
  double next = now;
  for (const double offered : speeds) {
    if (by > 0 && rank(offered) > rank(now)) return offered;
    if (by < 0 && rank(offered) < rank(now)) next = offered;
  }
  return next;
}

void TransportBar::addRecord() {
  m_record = new QToolButton(this);
  m_record->setObjectName(QStringLiteral("record"));
  m_record->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  m_record->setPopupMode(QToolButton::MenuButtonPopup);
  auto* menu = new QMenu(m_record);
  for (const int seconds : {10, 30, 60, 300}) {
    menu->addAction(QStringLiteral("Save the last %1 seconds").arg(seconds), m_context.recording,
                    [this, seconds] { m_context.recording->saveLast(seconds); });
  }
  m_record->setMenu(menu);
  connect(m_record, &QToolButton::clicked, this, [this] {
    if (m_context.recording->isRecording())
      m_context.recording->stop();
    else
      m_context.recording->start();
  });
  m_recordAction = addWidget(m_record);
  connect(m_context.recording, &SessionRecording::changed, this, &TransportBar::showRecord);
  showRecord();
}

// Behind Record, where the Live controls stand in Live.
void TransportBar::addReplayActions(const QList<QAction*>& actions) {
  for (QAction* action : actions) {
    auto* button = new QToolButton(this);
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonIconOnly);
    addControl(m_context.replay, addWidget(button));
  }
  showMode();
}

void TransportBar::showRecord() {
  const bool on = m_context.recording->isRecording();
  const int side = iconSize().height();
  QPixmap dot(side * 2, side * 2);
  dot.setDevicePixelRatio(2);
  dot.fill(Qt::transparent);
  QPainter painter(&dot);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPointF centre(side / 2.0, side / 2.0);
  const double radius = side * 0.22;
  painter.setPen(on ? QPen(Qt::NoPen) : QPen(theme().secondaryText, 1.6));
  painter.setBrush(on ? QBrush(theme().errorText) : QBrush(Qt::NoBrush));
  painter.drawEllipse(centre, radius, radius);
  painter.end();
  m_record->setIcon(QIcon(dot));
  // One width, whatever it says: nothing moves when a recording begins or ends.
  const QString record = QStringLiteral("Record");
  m_record->setText(on ? clockText(m_context.recording->status().seconds) : record);
  m_record->setToolTip(
      on ? QStringLiteral("Stop recording into %1\n%2")
               .arg(m_context.recording->path(),
                    QString::fromStdString(telemetry::freeSpaceText(m_context.recording->status())))
         : QStringLiteral("Record everything into a new file in %1")
               .arg(m_context.recording->folder()));
  const bool possible = on || m_context.recording->isPossible();
  m_record->setEnabled(possible);
  if (!possible) {
    m_record->setToolTip(m_context.shown->source() == m_context.live
                             ? QStringLiteral("Live receives nothing: no port could be opened")
                             : QStringLiteral("No match is open"));
  }
  m_recordAction->setVisible(m_context.shown->kind().hasPresent || on);
}

ShownMoment* TransportBar::played() const {
  return m_context.shown->chosenTime() ? m_context.shown : nullptr;
}

bool TransportBar::hasNoReferee() const {
  const FramePtr frame = m_context.controller->frame();
  return frame && !frame->game;
}

bool TransportBar::isFinished() const {
  if (m_context.shown->source() != m_context.controller) return false;
  const FramePtr frame = m_context.controller->frame();
  return frame && frame->finished;
}

void TransportBar::resizeEvent(QResizeEvent* event) {
  QToolBar::resizeEvent(event);
  // Widths follow the window and nothing else: titles, scores and recordings move nothing.
  constexpr int narrow = 1100, roomy = 1400;  // px of the mock
  const bool isNarrow = width() < scaled(this, narrow);
  for (QToolButton* mode : findChildren<QToolButton*>(QStringLiteral("mode"))) {
    const int padding = scaled(this, isNarrow ? 14 : 26);
    mode->setFixedWidth(mode->fontMetrics().horizontalAdvance(mode->text()) + padding);
    mode->setStyleSheet(isNarrow ? QStringLiteral("padding: 4px 0px;") : QString());
  }
  layout()->setSpacing(scaled(this, isNarrow ? 2 : 4));
  m_scenarios->setFixedWidth(scaled(this, isNarrow                        ? 104
                                          : width() < scaled(this, roomy) ? 196
                                                                          : 266));
  m_liveBar->setAvailableWidth(isNarrow                        ? LiveBar::Width::Least
                               : width() < scaled(this, roomy) ? LiveBar::Width::Narrow
                                                               : LiveBar::Width::Wide);
  m_record->setToolButtonStyle(isNarrow ? Qt::ToolButtonIconOnly : Qt::ToolButtonTextBesideIcon);
  m_record->setFixedWidth(scaled(this, isNarrow ? 44 : 96));
  m_speed->setFixedWidth(scaled(this, isNarrow ? 62 : 68));
  placeScoreboard();
}

void TransportBar::placeScoreboard() {
  const int wide = m_scoreboard->sizeHint().width();
  QMargins margins = layout()->contentsMargins();
  if (margins.right() != wide) {
    margins.setRight(wide);
    layout()->setContentsMargins(margins);
  }
  m_scoreboard->setGeometry(width() - wide, (height() - m_scoreboard->sizeHint().height()) / 2,
                            wide, m_scoreboard->sizeHint().height());
  m_scoreboard->raise();
  // Qt puts what leads to the buttons that have no room at the right edge, under the scoreboard.
  auto* more = findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
  if (more == nullptr || more->isHidden()) return;
  more->move(width() - wide - more->width(), more->y());
}

bool TransportBar::event(QEvent* event) {
  const bool done = QToolBar::event(event);
  if (event->type() == QEvent::LayoutRequest) placeScoreboard();
  return done;
}

void TransportBar::showMode() {
  const FrameSource* shown = m_context.shown->source();
  for (const Control& mode : m_modes) mode.action->setChecked(mode.source == shown);
  for (const Control& control : m_controls) control.action->setVisible(control.source == shown);
  const FramePtr frame = m_context.shown->frame();
  m_scoreboard->setState(frame ? scoreboardOf(*frame) : ScoreboardState{});
  placeScoreboard();
  showTransport();
  showRecord();
}

void TransportBar::showTransport() {
  const MatchController& controller = *m_context.controller;
  const ShownMoment* past = played();
  m_finished = isFinished();
  const bool again = past == nullptr && m_finished;
  const bool paused = past != nullptr ? past->isPaused() : controller.isPaused() || again;
  const bool there = past != nullptr ? past->available().has_value()
                                     : controller.isOpen() || controller.isOpening();
  m_restart->setText(past != nullptr ? QStringLiteral("To the start") : QStringLiteral("Restart"));
  const auto withKey = [](const QAction& action) {
    return QStringLiteral("%1 (%2)").arg(action.text(), action.shortcut().toString());
  };
  m_play->setText(again    ? QStringLiteral("Play the match again")
                  : paused ? QStringLiteral("Play")
                           : QStringLiteral("Pause"));
  m_play->setIcon(themedIcon(paused ? QStringLiteral("media-playback-start")
                                    : QStringLiteral("media-playback-pause")));
  // Live goes on by itself; only its past can be played. The buttons stay all the same, so that
  // nothing jumps when somebody looks back.
  const bool usable = past != nullptr || m_context.shown->source() == m_context.controller;
  const QString why =
      !usable  ? QStringLiteral("Live cannot be paused. Look back on the timeline to play its past")
      : !there ? QStringLiteral("Nothing to play yet")
               : QString();
  const QString whyNoStep =
      why.isEmpty() && again ? QStringLiteral("The match is over. Play it again") : why;
  for (QAction* action : transportActions()) enableUnless(*action, why);
  if (why.isEmpty()) {
    for (QAction* action : {m_restart, m_play}) action->setToolTip(withKey(*action));
  }
  enableUnless(*m_step, whyNoStep);
  const QString whyNoSkip = past != nullptr && usable
                                ? QStringLiteral("Only at the newest moment of a match")
                                : whyNoStep;
  for (QAction* action : m_skips) enableUnless(*action, whyNoSkip);
  m_withoutReferee = hasNoReferee();
  if (whyNoSkip.isEmpty() && m_withoutReferee)
    enableUnless(*m_skips.front(),
                 QStringLiteral("This match has no referee, so there is no kick-off"));
  m_speed->setEnabled(usable);
  const std::span<const double> speeds =
      past != nullptr ? ShownMoment::speeds() : std::span<const double>(matchSpeeds);
  const double speed = past != nullptr ? past->speed() : controller.speed();
  m_speed->clear();
  for (const double offered : speeds) m_speed->addItem(speedText(offered), offered);
  int at = m_speed->findData(speed);
  if (at < 0) {
    m_speed->addItem(QStringLiteral("%1×").arg(speed), speed);
    at = m_speed->count() - 1;
  }
  m_speed->setCurrentIndex(at);
  m_speed->setToolTip(past != nullptr ? QStringLiteral("Speed: recorded seconds per second")
                                      : QStringLiteral("Speed: simulated seconds per second"));
}

}  // namespace pitchboard::ui

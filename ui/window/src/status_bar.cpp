// SPDX-License-Identifier: GPL-3.0-or-later
#include "status_bar.h"

#include <QApplication>
#include <QClipboard>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <ui/base/elide_text.h>
#include <ui/base/robot_text.h>
#include <ui/base/scoreboard_state.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/share/network_share.h>
#include <ui/share/share_dialog.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

/// If it is narrower than its text it ends in "…", instead of asking for a wider window.
class StatusLabel : public QLabel {
 public:
  using QLabel::QLabel;
  QSize minimumSizeHint() const override {
    const QMargins edge = contentsMargins();
    const int least = std::min(QLabel::minimumSizeHint().width(),
                               fontMetrics().averageCharWidth() * 3 + edge.left() + edge.right());
    return {least, QLabel::minimumSizeHint().height()};
  }

 protected:
  void paintEvent(QPaintEvent* event) override {
    const QRect room = contentsRect();
    if (fontMetrics().horizontalAdvance(text()) <= room.width()) {
      QLabel::paintEvent(event);
      return;
    }
    QPainter painter(this);
    painter.setPen(palette().color(foregroundRole()));
    painter.drawText(room, Qt::AlignVCenter | Qt::AlignLeft,
                     elideText(QFontMetricsF(font()), text(), room.width()));
  }
};

}  // namespace

StudioStatusBar::StudioStatusBar(const StatusContext& context, QWidget* parent)
    : QStatusBar(parent), m_context(context) {
  constexpr Beat::Milliseconds least{200}, most{500};
  m_clock.start();
  setSizeGripEnabled(false);
  m_pace = addLabel("statusPace", false);
  m_world = addLabel("statusWorld", false);
  m_processes = addLabel("statusProcesses", false);
  m_recording = addLabel("statusRecording", false);
  m_shared = addLabel("statusShared", false);
  m_cursor = addLabel("statusCursor", true);
  m_selected = addLabel("statusSelected", true);
  m_refresh = Beat::display().add(
      this, least, [this] { refresh(); }, most);
  connect(context.shown, &ShownMoment::frameReceived, this, [this] { m_refresh->want(); });
  connect(this, &QStatusBar::messageChanged, this, [this](const QString& message) {
    if (message.isEmpty()) refresh();
  });
  connect(context.shown, &ShownMoment::sourceChosen, this, &StudioStatusBar::refresh);
  connect(context.shown, &ShownMoment::lookingBackChanged, this, &StudioStatusBar::refresh);
  // Behind a past moment the match pauses and goes on without new frames here.
  connect(context.controller, &MatchController::frameReceived, this, [this] {
    if (m_context.shown->isLookingBack()) m_refresh->want();
  });
  connect(context.selection, &RobotSelection::changed, this, &StudioStatusBar::refresh);
  connect(context.share, &NetworkShare::changed, this, &StudioStatusBar::refresh);
  setContextMenuPolicy(Qt::CustomContextMenu);
  connect(this, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
    QMenu menu(this);
    menu.addAction(QStringLiteral("Copy state hash"), this, &StudioStatusBar::copyStateHash);
    menu.exec(mapToGlobal(at));
  });
  refresh();
}

QLabel* StudioStatusBar::addLabel(const char* name, bool atRight) {
  auto* label = new StatusLabel(this);
  label->setObjectName(QLatin1String(name));
  label->setFont(themeFont(TypeRole::Secondary));
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setContentsMargins(scaled(this, 8), 0, scaled(this, 8), 0);
  if (atRight) {
    addPermanentWidget(label);
    return label;
  }
  auto* line = new QWidget(this);
  line->setFixedSize(1, scaled(this, 14));
  line->setBackgroundRole(QPalette::Mid);
  line->setAutoFillBackground(true);
  addWidget(line);
  addWidget(label);
  m_parts.push_back({line, label});
  return label;
}

// No lines between nothings; and nothing beside a message, which has hidden everything.
void StudioStatusBar::hideEmpty() {
  if (!currentMessage().isEmpty()) return;
  bool first = true;
  for (const Part& part : m_parts) {
    const bool shown = !part.label->text().isEmpty();
    part.label->setVisible(shown);
    part.line->setVisible(shown && !first);
    first = first && !shown;
  }
}

void StudioStatusBar::setCursor(QPointF metres, bool valid) {
  m_cursor->setText(valid ? QStringLiteral("x %1 m  y %2 m")
                                .arg(numberText(metres.x(), 2), numberText(metres.y(), 2))
                          : QString());
}

void StudioStatusBar::copyStateHash() {
  const FramePtr frame = m_context.controller->frame();
  if (!frame) return;
  const QString hash =
      QStringLiteral("%1").arg(m_context.controller->stateHash(), 16, 16, QLatin1Char('0'));
  QApplication::clipboard()->setText(hash);
  note(QStringLiteral("State hash %1 copied").arg(hash));
}

void StudioStatusBar::note(const QString& sentence) {
  constexpr int milliseconds = 4000;
  showMessage(sentence, milliseconds);
}

void StudioStatusBar::refresh() {
  showSource();
  hideEmpty();
}

void StudioStatusBar::showSource() {
  const FramePtr frame = m_context.shown->frame();
  showMemory();
  showShared();
  if (m_context.shown->source() == m_context.live) {
    showLive(frame.get());
    if (frame)
      showSelected(*frame);
    else
      m_selected->clear();
    return;
  }
  m_pace->setToolTip({});
  m_processes->setPalette({});
  m_processes->setToolTip({});
  if (!frame) {
    m_pace->setText(!m_context.shown->kind().hasPresent ? QStringLiteral("No session")
                    : m_context.controller->isOpening() ? QStringLiteral("Opening…")
                                                        : QStringLiteral("No match"));
    for (QLabel* label : {m_world, m_processes, m_selected}) label->clear();
    return;
  }
  if (!m_context.shown->kind().hasPresent) {
    m_pace->setText(
        QStringLiteral("Replay of %1").arg(QFileInfo(m_context.replay->recording()).fileName()));
    m_world->setText(QStringLiteral("%1 of %2")
                         .arg(momentText(m_context.shown->time(), 2, m_context.shown->clock()),
                              momentText(m_context.shown->now(), 0, m_context.shown->clock())));
    const bool unrepeatable = m_context.replay->isUnrepeatable();
    m_processes->setText(unrepeatable ? QStringLiteral("Run is not repeatable") : QString());
    m_processes->setToolTip(
        unrepeatable ? QStringLiteral(
                           "A program took decisions without the match waiting for it. Playing the "
                           "run again gives another result.")
                     : QString());
  } else {
    showMatch(*frame);
  }
  showSelected(*frame);
}

QPalette StudioStatusBar::alarmPalette() const {
  QPalette red = palette();
  red.setColor(QPalette::PlaceholderText, theme().errorText);
  return red;
}

void StudioStatusBar::showMemory() {
  if (m_context.recording->isRecording()) {
    const telemetry::SessionStatus status = m_context.recording->status();
    const QString trouble = QString::fromStdString(telemetry::troubleText(status));
    const QString room = QString::fromStdString(telemetry::freeSpaceText(status));
    QString text = QStringLiteral("recording %1, %2 MB")
                       .arg(longMomentText(status.seconds))
                       .arg(static_cast<double>(status.bytes) / 1e6, 0, 'f', 1);
    if (!room.isEmpty()) text += QStringLiteral(", ") + room;
    const auto kind = telemetry::troubleOf(status);
    if (kind == telemetry::RecordingTrouble::DiskBehind)
      text += QStringLiteral(", disk cannot keep up");
    if (status.dropped > 0) text += QStringLiteral(", %1 rows lost").arg(countText(status.dropped));
    m_recording->setText(text);
    m_recording->setToolTip((trouble.isEmpty() ? QString() : trouble + QLatin1Char('\n')) +
                            m_context.recording->path());
    m_recording->setPalette(trouble.isEmpty() ? QPalette() : alarmPalette());
    return;
  }
  m_recording->setPalette({});
  m_recording->setToolTip({});
  if (!m_context.shown->kind().hasPresent) {
    const double part = m_context.replay->loaded();
    m_recording->setText(part < 1 ? QStringLiteral("Reading %1 %").arg(static_cast<int>(part * 100))
                                  : QString());
    return;
  }
  const auto rows = m_context.shown->series();
  const auto held = rows ? rows->range() : std::nullopt;
  m_recording->setText(held ? QStringLiteral("Memory holds the last %1 (%2 MB)")
                                  .arg(momentText(held->end - held->begin, 0))
                                  .arg(static_cast<double>(rows->memoryBytes()) / 1e6, 0, 'f', 0)
                            : QString());
}

// Who may look is seen all the time, not only in the dialog.
void StudioStatusBar::showShared() {
  const NetworkShare& share = *m_context.share;
  m_shared->setText(share.port() == 0 ? QString()
                                      : QStringLiteral("Shared at %1, %2 connected")
                                            .arg(addressOf(share))
                                            .arg(share.status().clients));
  m_shared->setToolTip(share.options().everyComputer
                           ? QStringLiteral("Every computer in the network may look")
                           : QStringLiteral("Only programs on this computer may look"));
}

void StudioStatusBar::showLive(const link::MatchFrame* frame) {
  const LiveStatusText text = m_live.update(m_context.live->details(), frame,
                                            static_cast<double>(m_clock.elapsed()) / 1000);
  m_pace->setText(text.network);
  m_pace->setToolTip(text.tip);
  m_world->setText(text.referee);
  m_processes->setText(text.trouble);
  m_processes->setPalette(alarmPalette());
  m_processes->setToolTip(text.trouble.isEmpty() ? QString() : text.tip);
}

/// A past moment says nothing of how the match goes on meanwhile.
QString StudioStatusBar::paceText(const link::MatchFrame& now) const {
  if (m_context.shown->isLookingBack()) {
    const QString match =
        now.finished ? QStringLiteral("the match is over")
        : now.paused ? QStringLiteral("the match is paused")
                     : QStringLiteral("the match goes on at ×%1").arg(numberText(now.speed, 2));
    return QStringLiteral("Viewing %1, %2")
        .arg(momentText(m_context.shown->time(), 0, m_context.shown->clock()), match);
  }
  if (now.finished) return QStringLiteral("Simulation finished");
  if (now.paused) return QStringLiteral("Simulation paused");
  return QStringLiteral("Simulation %1/s, ×%2")
      .arg(countText(static_cast<qulonglong>(std::llround(now.ticksPerSecond))),
           numberText(now.speed, 2));
}

void StudioStatusBar::showMatch(const link::MatchFrame& frame) {
  const FramePtr newest = m_context.controller->frame();
  const link::MatchFrame& now = newest ? *newest : frame;
  m_pace->setText(paceText(now));
  const auto robots = frame.robots.size();
  m_world->setText(teamsText(frame) + QStringLiteral("%1, tick %2, seed %3")
                                          .arg(robots == 1
                                                   ? QStringLiteral("1 robot")
                                                   : QStringLiteral("%1 robots").arg(robots),
                                               countText(frame.snapshot.tick))
                                          .arg(frame.settings->seed));
  switch (m_context.controller->cognition()) {
    case link::Cognition::Separate:
      m_processes->setText(
          !now.waitsFor.empty()
              ? QStringLiteral("Lock-step waits for %1").arg(QString::fromStdString(now.waitsFor))
          : now.inLockStep ? QStringLiteral("Separate processes, in lock-step")
                           : QStringLiteral("Separate processes, running freely"));
      break;
    case link::Cognition::Inline:
      m_processes->setText(QStringLiteral("Processes run inside the studio"));
      break;
    case link::Cognition::None:
      m_processes->setText(QStringLiteral("Waiting for team programs"));
      break;
  }
  if (now.slowestTeamProgram) {
    m_processes->setText(QStringLiteral("%1 · team programs reach ×%2")
                             .arg(m_processes->text(), numberText(*now.slowestTeamProgram, 1)));
  }
  if (now.matchNumber.value_or(0) > 0) {
    m_processes->setText(
        QStringLiteral("Match %1 · %2").arg(*now.matchNumber).arg(m_processes->text()));
  }
}

void StudioStatusBar::showSelected(const link::MatchFrame& frame) {
  const auto& selected = m_context.selection->ids();
  QString text;
  if (selected.size() > 1) text = QStringLiteral("%1 robots selected").arg(selected.size());
  if (selected.size() == 1) {
    if (const link::RobotFrame* robot = frame.robot(selected.front())) {
      text = QStringLiteral("%1 selected: %2, %3 m, %4°")
                 .arg(robotName(*robot), numberText(robot->pose.position.x, 2),
                      numberText(robot->pose.position.y, 2),
                      numberText(degreesFromRadians(wrapToPi(robot->pose.yaw)), 0));
    }
  }
  m_selected->setText(text);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/timeline/timeline_actions.h>

#include <QAction>
#include <QMenu>

#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/playback.h>
#include <ui/sources/timeline.h>

namespace pitchboard::ui {
namespace {

QAction* make(QObject* parent, const QString& text, const char* icon, const QKeySequence& keys) {
  auto* action = new QAction(text, parent);
  if (icon != nullptr) action->setIcon(themedIcon(QLatin1String(icon)));
  action->setShortcut(keys);
  return action;
}

}  // namespace

TimelineActions::TimelineActions(Timeline* timeline, LinkedTime* plots, QObject* parent)
    : QObject(parent),
      m_timeline(timeline),
      m_plots(plots),
      m_live(make(this, QStringLiteral("Back to &now"), "media-seek-forward",
                  QKeySequence(Qt::CTRL | Qt::Key_End))),
      m_play(make(this, QStringLiteral("&Play the past"), "media-playback-start",
                  QKeySequence(Qt::CTRL | Qt::Key_Space))),
      m_next(make(this, QStringLiteral("&Next event"), "go-next", QKeySequence(Qt::Key_N))),
      m_previous(make(this, QStringLiteral("&Previous event"), "go-previous",
                      QKeySequence(Qt::SHIFT | Qt::Key_N))),
      m_bookmark(
          make(this, QStringLiteral("Set a &bookmark"), "bookmark-new", QKeySequence(Qt::Key_M))),
      m_back(make(this, QStringLiteral("One tick bac&k"), nullptr,
                  QKeySequence(Qt::CTRL | Qt::Key_Comma))),
      m_on(make(this, QStringLiteral("One tick &on"), nullptr, {})),
      m_selectVisible(make(this, QStringLiteral("&Choose the plots' range"), nullptr, {})),
      m_clearRange(make(this, QStringLiteral("Choose no &range"), nullptr, {})),
      m_loop(make(this, QStringLiteral("&Loop the chosen range"), "media-playlist-repeat",
                  QKeySequence(Qt::CTRL | Qt::Key_L))) {
  m_live->setObjectName(QStringLiteral("timelineLive"));
  m_next->setObjectName(QStringLiteral("nextEvent"));
  m_previous->setObjectName(QStringLiteral("previousEvent"));
  m_bookmark->setObjectName(QStringLiteral("addBookmark"));
  m_loop->setObjectName(QStringLiteral("loopRange"));
  m_loop->setCheckable(true);
  connect(m_live, &QAction::triggered, timeline, &Timeline::goLive);
  connect(m_play, &QAction::triggered, timeline, &Timeline::togglePlay);
  connect(m_next, &QAction::triggered, timeline, &Timeline::goToNextEvent);
  connect(m_previous, &QAction::triggered, timeline, &Timeline::goToPreviousEvent);
  connect(m_bookmark, &QAction::triggered, this,
          [this] { emit bookmarkAdded(m_timeline->addBookmark()); });
  connect(m_back, &QAction::triggered, timeline, [timeline] { timeline->step(-1); });
  connect(m_on, &QAction::triggered, timeline, [timeline] { timeline->step(1); });
  connect(m_selectVisible, &QAction::triggered, this,
          [this] { m_timeline->setSelection(m_plots->range()); });
  connect(m_clearRange, &QAction::triggered, timeline, [timeline] { timeline->setSelection({}); });
  connect(m_loop, &QAction::triggered, this, [this](bool on) {
    if (on && !m_timeline->selection() && m_plots != nullptr) {
      m_timeline->setSelection(m_plots->range());
    }
    m_timeline->setLooping(on);
    refresh();
  });
  connect(timeline, &Timeline::selectionChanged, this, &TimelineActions::refresh);
  connect(timeline, &Timeline::lookingBackChanged, this, &TimelineActions::refresh);
  connect(timeline, &Timeline::sourceChanged, this, &TimelineActions::refresh);
  refresh();
}

void TimelineActions::refresh() {
  const bool past = m_timeline->isLookingBack() || m_timeline->isRecording();
  m_live->setEnabled(m_timeline->isLookingBack());
  m_play->setEnabled(past);
  m_on->setEnabled(past);
  m_clearRange->setEnabled(m_timeline->selection().has_value());
  m_selectVisible->setEnabled(m_plots != nullptr);
  m_loop->setChecked(m_timeline->isLooping());
}

void TimelineActions::fill(QMenu* menu) const {
  menu->addActions({m_live, m_play, m_back, m_on});
  menu->addSeparator();
  menu->addActions({m_next, m_previous, m_bookmark});
  menu->addSeparator();
  menu->addActions({m_selectVisible, m_loop, m_clearRange});
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/timeline/timeline_actions.h>

#include <QAction>
#include <QInputDialog>
#include <QMenu>
#include <chrono>
#include <map>
#include <set>

#include <telemetry/session/session_time.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/abandoned_future.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/playback.h>
#include <ui/sources/timeline.h>

namespace pitchboard::ui {
namespace {

QAction* make(QObject* parent, const char* id, const char* text, const char* icon = nullptr) {
  auto* action = new QAction(QString::fromUtf8(text), parent);
  action->setObjectName(QLatin1String(id));
  if (icon != nullptr) action->setIcon(themedIcon(QLatin1String(icon)));
  return action;
}

}  // namespace

TimelineActions::TimelineActions(Timeline* timeline, LinkedTime* plots, AbandonedFuture* future,
                                 QObject* parent)
    : QObject(parent),
      m_timeline(timeline),
      m_plots(plots),
      m_now(make(this, "timelineNow", "Back to &now", "media-seek-forward")),
      m_oldest(make(this, "oldestMoment", "&Oldest moment")),
      m_goTo(make(this, "goToTime", "&Go to time…", "go-jump")),
      m_next(make(this, "nextEvent", "&Next event", "go-next")),
      m_previous(make(this, "previousEvent", "&Previous event", "go-previous")),
      m_bookmark(make(this, "addBookmark", "Set &bookmark", "bookmark-new")),
      m_steps{make(this, "stepBack", "Step bac&k"), make(this, "stepForward", "Step &forward"),
              make(this, "secondBack", "One second back"),
              make(this, "secondForward", "One second forward")},
      m_selectVisible(make(this, "selectVisible", "&Select the plots' range")),
      m_clearRange(make(this, "clearRange", "Clear &range")),
      m_loop(make(this, "loopRange", "&Loop range", "media-playlist-repeat")),
      m_compareFuture(make(this, "compareFuture", "Compare with the a&bandoned future")),
      m_dropFuture(make(this, "dropFuture", "&Drop the abandoned future")) {
  m_loop->setCheckable(true);
  m_compareFuture->setCheckable(true);
  m_compareFuture->setToolTip(QStringLiteral("Draws its robots over the field"));
  const auto showFuture = [this, future] {
    for (QAction* action : {m_compareFuture, m_dropFuture})
      action->setVisible(future != nullptr && future->isOn());
    m_compareFuture->setChecked(future != nullptr && future->isCompared());
  };
  if (future != nullptr) {
    connect(m_compareFuture, &QAction::triggered, future, &AbandonedFuture::setCompared);
    connect(m_dropFuture, &QAction::triggered, future, &AbandonedFuture::drop);
    connect(future, &AbandonedFuture::changed, this, showFuture);
  }
  showFuture();
  connect(m_now, &QAction::triggered, timeline, &Timeline::goLive);
  connect(m_oldest, &QAction::triggered, timeline, [timeline] {
    if (const auto range = timeline->available()) timeline->seek(range->begin);
  });
  connect(m_goTo, &QAction::triggered, this, [this] { askForTime(); });
  connect(m_next, &QAction::triggered, timeline, &Timeline::goToNextEvent);
  connect(m_previous, &QAction::triggered, timeline, &Timeline::goToPreviousEvent);
  connect(m_bookmark, &QAction::triggered, this,
          [this] { emit bookmarkAdded(m_timeline->addBookmark()); });
  const auto [back, forward, secondBack, secondForward] = m_steps;
  connect(back, &QAction::triggered, timeline, [timeline] { timeline->step(-1); });
  connect(forward, &QAction::triggered, timeline, [timeline] { timeline->step(1); });
  connect(secondBack, &QAction::triggered, timeline,
          [timeline] { timeline->seek(timeline->shownTime() - 1.0); });
  connect(secondForward, &QAction::triggered, timeline,
          [timeline] { timeline->seek(timeline->shownTime() + 1.0); });
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
  m_now->setEnabled(m_timeline->isLookingBack());
  m_steps[1]->setEnabled(past);
  m_steps[3]->setEnabled(past);
  m_clearRange->setEnabled(m_timeline->selection().has_value());
  m_selectVisible->setEnabled(m_plots != nullptr);
  m_loop->setChecked(m_timeline->isLooping());
}

void TimelineActions::askForTime(const QString& typed, const QString& problem) {
  using telemetry::TimeForms;
  auto* ask = new QInputDialog(qobject_cast<QWidget*>(parent()));
  ask->setObjectName(QStringLiteral("goToTime"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setWindowTitle(QStringLiteral("Go to time"));
  const QString forms = m_timeline->clock() ? QStringLiteral("Time of day, such as 15:03:12:")
                                            : QStringLiteral("Time: 78.7, 1:18.7 or 0:01:18.7");
  ask->setLabelText(problem.isEmpty() ? forms : problem);
  ask->setTextValue(typed);
  connect(ask, &QInputDialog::textValueSelected, this, [this](const QString& text) {
    const auto range = m_timeline->available();
    if (!range) return;
    const auto clock = m_timeline->clock();
    const telemetry::WallTime start(
        std::chrono::milliseconds(clock ? clock->toMSecsSinceEpoch() : 0));
    const auto time = telemetry::sessionTime(text.trimmed().toStdString(), start, *range,
                                             clock ? TimeForms::Clock : TimeForms::Session);
    if (time) {
      m_timeline->seek(*time);
    } else {
      askForTime(text, QString::fromStdString(time.error().message));
    }
  });
  ask->open();
}

void TimelineActions::change(const std::function<void(EventFilter&)>& how) {
  EventFilter filter = m_timeline->filter();
  how(filter);
  m_timeline->setFilter(filter);
}

void TimelineActions::fillFilter(QMenu* menu) {
  menu->clear();
  const EventFilter& now = m_timeline->filter();
  std::map<link::MatchEventKind, int> kinds;
  const FramePtr frame = m_timeline->frame();
  std::set<std::string> names = now.robots;
  std::set<std::pair<RobotOrder, std::string>> robots;  // as they are listed
  for (const link::MatchEventKind hidden : now.hidden) kinds[hidden];
  for (const link::MatchEvent& event : m_timeline->events()->events()) {
    if (!link::isMarked(event)) continue;
    ++kinds[event.kind];
    if (event.name.empty()) continue;
    names.erase(event.name);
    robots.emplace(orderOf(event.robot, frame ? frame->teams : link::Teams()), event.name);
  }
  for (const std::string& name : names) robots.emplace(RobotOrder(), name);
  QAction* all =
      menu->addAction(QStringLiteral("&All"), this, [this] { m_timeline->setFilter({}); });
  all->setEnabled(now.isOn());
  menu->addSeparator();
  for (const auto& [kind, count] : kinds) {
    const std::string_view predicate = link::info(kind).predicate;
    const QString name = kind == link::MatchEventKind::GameState ? QStringLiteral("Game state")
                                                                 : capitalised(predicate);
    QAction* action = menu->addAction(QStringLiteral("%1 (%2)").arg(name).arg(count));
    action->setCheckable(true);
    action->setChecked(!now.hidden.contains(kind));
    connect(action, &QAction::toggled, this, [this, kind = kind](bool on) {
      change([&](EventFilter& filter) {
        if (on)
          filter.hidden.erase(kind);
        else
          filter.hidden.insert(kind);
      });
    });
  }
  if (robots.empty()) return;
  menu->addSeparator();
  for (const auto& [order, name] : robots) {
    const std::string& robot = name;
    QAction* action = menu->addAction(QStringLiteral("Only %1").arg(QString::fromStdString(robot)));
    action->setCheckable(true);
    action->setChecked(now.robots.contains(robot));
    connect(action, &QAction::toggled, this, [this, robot](bool on) {
      change([&](EventFilter& filter) {
        if (on)
          filter.robots.insert(robot);
        else
          filter.robots.erase(robot);
      });
    });
  }
}

void TimelineActions::fill(QMenu* menu) {
  menu->addActions({m_now, m_oldest, m_goTo});
  for (QAction* step : m_steps) menu->addAction(step);
  menu->addSeparator();
  menu->addActions({m_next, m_previous, m_bookmark});
  QMenu* shown = menu->addMenu(QStringLiteral("Events sho&wn"));
  shown->setObjectName(QStringLiteral("eventsShown"));
  QObject::connect(shown, &QMenu::aboutToShow, this, [this, shown] { fillFilter(shown); });
  menu->addSeparator();
  menu->addActions({m_selectVisible, m_loop, m_clearRange});
  menu->addSeparator();
  menu->addActions({m_compareFuture, m_dropFuture});
}

}  // namespace pitchboard::ui

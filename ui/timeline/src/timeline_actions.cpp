// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/timeline/timeline_actions.h>

#include <QAction>
#include <QInputDialog>
#include <QMenu>
#include <chrono>
#include <map>
#include <set>

#include <telemetry/session/session_time.h>
#include <ui/base/action_reason.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/abandoned_future.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

QAction* make(QObject* parent, const char* id, const char* text, const char* icon = nullptr) {
  auto* action = new QAction(QString::fromUtf8(text), parent);
  action->setObjectName(QLatin1String(id));
  if (icon != nullptr) action->setIcon(themedIcon(QLatin1String(icon)));
  return action;
}

}  // namespace

TimelineActions::TimelineActions(ShownMoment* shown, LinkedTime* plots, AbandonedFuture* future,
                                 QObject* parent)
    : QObject(parent),
      m_shown(shown),
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
  connect(m_now, &QAction::triggered, shown, &ShownMoment::goLive);
  connect(m_oldest, &QAction::triggered, shown, [shown] {
    if (const auto range = shown->available()) shown->seek(range->begin);
  });
  connect(m_goTo, &QAction::triggered, this, [this] { askForTime(); });
  connect(m_next, &QAction::triggered, shown, &ShownMoment::goToNextEvent);
  connect(m_previous, &QAction::triggered, shown, &ShownMoment::goToPreviousEvent);
  connect(m_bookmark, &QAction::triggered, this,
          [this] { emit bookmarkAdded(m_shown->addBookmark()); });
  const auto [back, forward, secondBack, secondForward] = m_steps;
  connect(back, &QAction::triggered, shown, [shown] { shown->step(-1); });
  connect(forward, &QAction::triggered, shown, [shown] { shown->step(1); });
  connect(secondBack, &QAction::triggered, shown, [shown] { shown->seek(shown->time() - 1.0); });
  connect(secondForward, &QAction::triggered, shown, [shown] { shown->seek(shown->time() + 1.0); });
  connect(m_selectVisible, &QAction::triggered, this,
          [this] { m_shown->setSelection(m_plots->range()); });
  connect(m_clearRange, &QAction::triggered, shown, [shown] { shown->setSelection({}); });
  connect(m_loop, &QAction::triggered, this, [this](bool on) {
    if (on && !m_shown->selection() && m_plots != nullptr) {
      m_shown->setSelection(m_plots->range());
    }
    m_shown->setLooping(on);
    refresh();
  });
  connect(shown, &ShownMoment::selectionChanged, this, &TimelineActions::refresh);
  connect(shown, &ShownMoment::lookingBackChanged, this, &TimelineActions::refresh);
  connect(shown, &ShownMoment::sourceChanged, this, &TimelineActions::refresh);
  refresh();
}

void TimelineActions::refresh() {
  const bool past = m_shown->chosenTime().has_value();
  const QString isNewest = past ? QString() : QStringLiteral("The newest moment is shown already");
  enableUnless(*m_now, !m_shown->kind().hasPresent
                           ? QStringLiteral("A recording is shown, which has no newest moment")
                           : isNewest);
  enableUnless(*m_steps[1], isNewest);
  enableUnless(*m_steps[3], isNewest);
  enableUnless(*m_clearRange, m_shown->selection()
                                  ? QString()
                                  : QStringLiteral("No range is selected. Drag with Shift on the "
                                                   "timeline to select one"));
  m_selectVisible->setEnabled(m_plots != nullptr);
  m_loop->setChecked(m_shown->isLooping());
}

void TimelineActions::askForTime(const QString& typed, const QString& problem) {
  using telemetry::TimeForms;
  auto* ask = new QInputDialog(qobject_cast<QWidget*>(parent()));
  ask->setObjectName(QStringLiteral("goToTime"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setWindowTitle(QStringLiteral("Go to time"));
  const QString forms = m_shown->clock() ? QStringLiteral("Time of day, such as 15:03:12:")
                                         : QStringLiteral("Time: 78.7, 1:18.7 or 0:01:18.7");
  ask->setLabelText(problem.isEmpty() ? forms : problem);
  ask->setTextValue(typed);
  connect(ask, &QInputDialog::textValueSelected, this, [this](const QString& text) {
    const auto range = m_shown->available();
    if (!range) return;
    const auto clock = m_shown->clock();
    const telemetry::WallTime start(
        std::chrono::milliseconds(clock ? clock->toMSecsSinceEpoch() : 0));
    const auto time = telemetry::sessionTime(text.trimmed().toStdString(), start, *range,
                                             clock ? TimeForms::Clock : TimeForms::Session);
    if (time) {
      m_shown->seek(*time);
    } else {
      askForTime(text, QString::fromStdString(time.error().message));
    }
  });
  ask->open();
}

void TimelineActions::change(const std::function<void(EventFilter&)>& how) {
  EventFilter filter = m_shown->filter();
  how(filter);
  m_shown->setFilter(filter);
}

void TimelineActions::fillFilter(QMenu* menu) {
  menu->clear();
  const EventFilter& now = m_shown->filter();
  std::map<link::MatchEventKind, int> kinds;
  const FramePtr frame = m_shown->frame();
  std::map<RobotUid, std::string> names;  // each as it was called last
  for (const link::MatchEventKind hidden : now.hidden) kinds[hidden];
  for (const link::MatchEvent& event : m_shown->events()->events()) {
    if (!link::isMarked(event)) continue;
    ++kinds[event.kind];
    if (event.robot != RobotUid{}) names[event.robot] = event.name;
  }
  std::set<std::pair<RobotOrder, RobotUid>> robots;  // as they are listed
  for (auto& [uid, name] : names) {
    const link::RobotFrame* robot = frame ? frame->robot(uid) : nullptr;
    if (robot != nullptr) name = robot->name;
    robots.emplace(robot != nullptr ? orderOf(robot->key, frame->teams) : RobotOrder(), uid);
  }
  QAction* all = menu->addAction(QStringLiteral("&All"), this, [this] { m_shown->setFilter({}); });
  enableUnless(*all, now.isOn() ? QString() : QStringLiteral("All events are shown"));
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
  for (const auto& [order, uid] : robots) {
    const RobotUid robot = uid;  // clang 14 captures no structured binding
    QAction* action =
        menu->addAction(QStringLiteral("Only %1").arg(QString::fromStdString(names[robot])));
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

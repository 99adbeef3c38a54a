// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_log.h"

#include <QSortFilterProxyModel>

#include <ui/base/table_style.h>
#include <ui/sources/event_list.h>
#include <ui/sources/timeline.h>

namespace pitchboard::ui {
namespace {

/// Events that the referee makes.
bool isOfReferee(link::MatchEventKind kind) {
  using Kind = link::MatchEventKind;
  switch (kind) {
    case Kind::Goal:
    case Kind::ScoreCorrected:
    case Kind::BallOut:
    case Kind::GameState:
    case Kind::MatchOver:
    case Kind::Half:
    case Kind::SetPlay:
    case Kind::GamePhase:
    case Kind::PlayStopped:
    case Kind::PlayGoesOn:
    case Kind::Penalised:
    case Kind::PenaltyOver:
      return true;
    default:
      return false;
  }
}

/// Those of the referee, up to the moment that is shown.
class RefereeEvents : public QSortFilterProxyModel {
 public:
  RefereeEvents(Timeline* timeline, QObject* parent)
      : QSortFilterProxyModel(parent), m_timeline(timeline) {
    connect(timeline, &Timeline::sourceChanged, this, &RefereeEvents::follow);
    connect(timeline, &Timeline::moved, this, &RefereeEvents::look);
    connect(timeline, &Timeline::lookingBackChanged, this, &RefereeEvents::look);
    follow();
  }
  double timeOf(int row) const { return at(mapToSource(index(row, 0)).row()).time; }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& /*parent*/) const override {
    const link::MatchEvent& one = at(row);
    return isOfReferee(one.kind) && (!m_until || one.time <= *m_until);
  }

 private:
  const EventList* list() const { return static_cast<const EventList*>(sourceModel()); }
  const link::MatchEvent& at(int row) const { return list()->at(row); }
  void follow() {
    setSourceModel(m_timeline->events());
    look();
  }
  void look() {
    constexpr double halfATick = 0.005;  // s
    const bool past = m_timeline->isLookingBack() || m_timeline->isRecording();
    const auto until = past ? std::optional(m_timeline->shownTime() + halfATick) : std::nullopt;
    if (until == m_until) return;
    const auto shown = [this](std::optional<double> time) {
      if (!time) return list()->rowCount();
      return list()->next(*time).value_or(list()->rowCount());
    };
    const bool same = shown(until) == shown(m_until);
    m_until = until;
    if (!same) invalidateFilter();
  }

  Timeline* m_timeline;
  std::optional<double> m_until;
};

}  // namespace

RefereeLog::RefereeLog(Timeline* timeline, QWidget* parent) : QTableView(parent) {
  setObjectName(QStringLiteral("refereeLog"));
  auto* events = new RefereeEvents(timeline, this);
  setModel(events);
  styleTable(this);
  horizontalHeader()->hide();
  setColumnHidden(EventList::Note, true);
  horizontalHeader()->setSectionResizeMode(EventList::Time, QHeaderView::ResizeToContents);
  horizontalHeader()->setSectionResizeMode(EventList::What, QHeaderView::Stretch);
  setMinimumHeight(scaled(this, 84));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);  // what is left, at least that
  setToolTip(QStringLiteral("Click a line to show its moment."));
  connect(this, &QTableView::clicked, this, [timeline, events](const QModelIndex& index) {
    timeline->seek(events->timeOf(index.row()));
  });
  for (const auto change : {&QAbstractItemModel::rowsInserted, &QAbstractItemModel::rowsRemoved}) {
    connect(events, change, this, &QTableView::scrollToBottom, Qt::QueuedConnection);
  }
  connect(events, &QAbstractItemModel::modelReset, this, &QTableView::scrollToBottom);
}

}  // namespace pitchboard::ui

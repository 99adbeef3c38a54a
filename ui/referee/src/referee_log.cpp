// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_log.h"

#include <QSortFilterProxyModel>

#include <ui/base/table_style.h>
#include <ui/sources/event_list.h>
#include <ui/sources/shown_moment.h>

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

/// The events of the referee up to the shown moment.
class RefereeEvents : public QSortFilterProxyModel {
 public:
  RefereeEvents(ShownMoment* shown, QObject* parent)
      : QSortFilterProxyModel(parent), m_shown(shown) {
    connect(shown, &ShownMoment::sourceChanged, this, &RefereeEvents::follow);
    connect(shown, &ShownMoment::moved, this, &RefereeEvents::look);
    connect(shown, &ShownMoment::lookingBackChanged, this, &RefereeEvents::look);
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
    setSourceModel(m_shown->events());
    look();
  }
  void look() {
    constexpr double halfATick = 0.005;  // s
    const auto chosen = m_shown->chosenTime();
    const auto until = chosen ? std::optional(*chosen + halfATick) : std::nullopt;
    if (until == m_until) return;
    const auto shown = [this](std::optional<double> time) {
      if (!time) return list()->rowCount();
      return list()->next(*time).value_or(list()->rowCount());
    };
    const bool same = shown(until) == shown(m_until);
    m_until = until;
    if (!same) invalidateFilter();
  }

  ShownMoment* m_shown;
  std::optional<double> m_until;
};

}  // namespace

RefereeLog::RefereeLog(ShownMoment* shown, QWidget* parent) : QTableView(parent) {
  setObjectName(QStringLiteral("refereeLog"));
  auto* events = new RefereeEvents(shown, this);
  setModel(events);
  styleTable(this);
  horizontalHeader()->hide();
  setColumnHidden(EventList::Note, true);
  horizontalHeader()->setSectionResizeMode(EventList::Time, QHeaderView::ResizeToContents);
  horizontalHeader()->setSectionResizeMode(EventList::What, QHeaderView::Stretch);
  setMinimumHeight(scaled(this, 84));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);  // what is left, at least that
  setToolTip(QStringLiteral("Click a line to show its moment."));
  connect(this, &QTableView::clicked, this,
          [shown, events](const QModelIndex& index) { shown->seek(events->timeOf(index.row())); });
  for (const auto change : {&QAbstractItemModel::rowsInserted, &QAbstractItemModel::rowsRemoved}) {
    connect(events, change, this, &QTableView::scrollToBottom, Qt::QueuedConnection);
  }
  connect(events, &QAbstractItemModel::modelReset, this, &QTableView::scrollToBottom);
}

}  // namespace pitchboard::ui

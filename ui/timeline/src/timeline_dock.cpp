// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/timeline/timeline_dock.h>

#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>

#include <ui/base/theme.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/shown_moment.h>
#include <ui/timeline/compared_menu.h>
#include <ui/timeline/timeline_actions.h>

#include "timeline_strip.h"

namespace pitchboard::ui {
namespace {

class TimelineDock : public QWidget {
 public:
  TimelineDock(const TimelineContext& context, QWidget* parent)
      : QWidget(parent),
        m_shown(context.shown),
        m_strip(new TimelineStrip(context.shown, context.time, this)),
        m_now(new QToolButton(this)) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    m_now->setObjectName(QStringLiteral("now"));
    m_now->setText(QStringLiteral("Now"));
    m_now->setCheckable(true);  // checked: filled
    m_now->setFixedWidth(scaled(this, 52));
    m_now->setFixedHeight(scaled(this, 28));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, scaled(this, 12), 0);
    row->setSpacing(scaled(this, 4));
    row->addWidget(m_strip, 1);
    row->addWidget(m_now);
    connect(m_now, &QToolButton::clicked, this, [this] {
      m_shown->goLive();
      showNow();
    });
    connect(m_shown, &ShownMoment::lookingBackChanged, this, &TimelineDock::showNow);
    connect(m_shown, &ShownMoment::sourceChanged, this, &TimelineDock::showNow);
    connect(context.timelineActions, &TimelineActions::bookmarkAdded, m_strip,
            &TimelineStrip::editNote);
    connect(m_strip, &TimelineStrip::menuRequested, this,
            [this, context](QPoint at, const link::MatchEvent* event, int session) {
              QMenu menu(this);
              menu.setObjectName(QStringLiteral("timelineMenu"));
              menu.setToolTipsVisible(true);
              if (context.compared != nullptr)
                addComparison(&menu, context.compared, event, session);
              context.timelineActions->fill(&menu);
              menu.exec(at);
            });
    m_strip->setFuture(context.future);
    m_strip->setRules(context.rules);
    if (context.compared != nullptr) follow(context.compared);
    showNow();
  }

 private:
  void follow(ComparedSessions* compared) {
    connect(compared, &ComparedSessions::changed, this, [this, compared] {
      std::vector<ComparedRow> rows;
      for (const ComparedSession* session : compared->all()) {
        rows.push_back({session->events(), session->offset(), session->caption(), session->number(),
                        session->isOnField(), session->available(), session->id()});
      }
      m_strip->setCompared(std::move(rows));
    });
    const auto at = [compared](int row) { return compared->all()[static_cast<std::size_t>(row)]; };
    connect(m_strip, &TimelineStrip::comparedMoved, compared,
            [at](int row, double offset) { at(row)->setOffset(offset); });
    connect(m_strip, &TimelineStrip::comparedToggled, compared,
            [at](int row) { at(row)->setOnField(!at(row)->isOnField()); });
    connect(m_strip, &TimelineStrip::filesDropped, compared, &ComparedSessions::open);
  }

  /// Of the event and the row that were clicked.
  static void addComparison(QMenu* menu, ComparedSessions* compared, const link::MatchEvent* event,
                            int row) {
    const std::vector<ComparedSession*>& all = compared->all();
    if (all.empty()) return;
    if (row >= 0) {
      ComparedSession* session = all[static_cast<std::size_t>(row)];
      if (event != nullptr) {
        const double time = event->time;
        nameAlignment(menu->addAction(alignText(*event), session,
                                      [session, time] { session->alignThere(time); }));
      }
      fillComparedMenu(menu, compared, session);
    } else if (event != nullptr && all.size() == 1) {
      const double time = event->time;
      nameAlignment(menu->addAction(alignText(*event), all.front(),
                                    [session = all.front(), time] { session->alignHere(time); }));
    } else if (event != nullptr) {
      addChoice(menu->addMenu(alignText(*event)), all, event->time);
    }
    menu->addSeparator();
  }

  /// Which of the sessions is to be aligned at this time of the source that is shown.
  static void addChoice(QMenu* menu, const std::vector<ComparedSession*>& all, double time) {
    nameAlignment(menu->addAction(QStringLiteral("&All sessions"), [all, time] {
      for (ComparedSession* session : all) session->alignHere(time);
    }));
    for (ComparedSession* session : all) {
      QAction* one = menu->addAction(session->markedName(), session,
                                     [session, time] { session->alignHere(time); });
      one->setObjectName(QStringLiteral("alignHere.%1").arg(session->number()));
    }
  }

  static QString alignText(const link::MatchEvent& event) {
    return QStringLiteral("&Align at this event: %1")
        .arg(QString::fromStdString(sentenceOf(event)));
  }
  static void nameAlignment(QAction* action) { action->setObjectName(QStringLiteral("alignHere")); }

  void showNow() {
    m_now->setVisible(m_shown->kind().hasPresent);
    m_now->setChecked(m_shown->isLookingBack());
    m_now->setEnabled(m_shown->isLookingBack());
    m_now->setToolTip(m_shown->isLookingBack()
                          ? QStringLiteral("Back to now (Ctrl+End)")
                          : QStringLiteral("The window shows what happens now"));
  }

  ShownMoment* m_shown;
  TimelineStrip* m_strip;
  QToolButton* m_now;
};

}  // namespace

QWidget* makeTimelineDock(const TimelineContext& context, QWidget* parent) {
  return new TimelineDock(context, parent);
}

}  // namespace pitchboard::ui

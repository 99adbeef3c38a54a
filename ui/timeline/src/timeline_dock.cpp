// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/timeline/timeline_dock.h>

#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>

#include <ui/base/action_reason.h>
#include <ui/base/theme.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/shown_moment.h>
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
            [this, context](QPoint at, const link::MatchEvent* event, bool compared) {
              QMenu menu(this);
              menu.setObjectName(QStringLiteral("timelineMenu"));
              addAlignment(&menu, context.compared, event, compared);
              context.timelineActions->fill(&menu);
              menu.exec(at);
            });
    m_strip->setFuture(context.future);
    m_strip->setRules(context.rules);
    if (context.compared != nullptr) {
      connect(m_strip, &TimelineStrip::comparedMoved, context.compared,
              &ComparedSession::setOffset);
      connect(context.compared, &ComparedSession::changed, this,
              [this, compared = context.compared] {
                m_strip->setCompared(compared->events(), compared->offset(), compared->caption());
              });
    }
    showNow();
  }

 private:
  static void addAlignment(QMenu* menu, ComparedSession* session, const link::MatchEvent* event,
                           bool compared) {
    if (!session->isOn()) return;
    if (event != nullptr) {
      const double time = event->time;
      QAction* align = menu->addAction(QStringLiteral("&Align at this event: %1")
                                           .arg(QString::fromStdString(sentenceOf(*event))),
                                       session, [session, time, compared] {
                                         if (compared)
                                           session->alignThere(time);
                                         else
                                           session->alignHere(time);
                                       });
      align->setObjectName(QStringLiteral("alignHere"));
    }
    QAction* byTime =
        menu->addAction(QStringLiteral("Align by &time"), session, &ComparedSession::alignByTime);
    enableUnless(*byTime, session->isAlignedByTime()
                              ? QStringLiteral("The sessions are aligned by time")
                              : QString());
    menu->addAction(QStringLiteral("St&op comparing"), session, &ComparedSession::stop);
    menu->addSeparator();
  }
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

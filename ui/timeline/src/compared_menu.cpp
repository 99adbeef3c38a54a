// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/timeline/compared_menu.h>

#include <QMenu>

#include <ui/base/action_reason.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>

namespace pitchboard::ui {
namespace {

QString whyNotByKickOff(const ComparedSession& session) {
  const auto offset = session.offsetByKickOff();
  if (!offset) {
    return QStringLiteral("One of the sessions has no kick-off. Align them at another event");
  }
  return session.offset() == *offset ? QStringLiteral("The sessions are aligned by the kick-off")
                                     : QString();
}

}  // namespace

void fillComparedMenu(QMenu* menu, ComparedSessions* all, ComparedSession* session) {
  const auto add = [menu](const char* id, const QString& text, auto&&... to) {
    QAction* action = menu->addAction(text, std::forward<decltype(to)>(to)...);
    action->setObjectName(QLatin1String(id));
    return action;
  };
  QAction* byTime = add("comparedByTime", QStringLiteral("Align by &time"), session,
                        &ComparedSession::alignByTime);
  enableUnless(*byTime, session->isAlignedByTime()
                            ? QStringLiteral("The sessions are aligned by time")
                            : QString());
  QAction* byKickOff = add("comparedByKickOff", QStringLiteral("Align by the &kick-off"), session,
                           &ComparedSession::alignByKickOff);
  enableUnless(*byKickOff, whyNotByKickOff(*session));
  menu->addSeparator();
  QAction* field = add("comparedOnField", QStringLiteral("Show on the &field"));
  field->setCheckable(true);
  field->setChecked(session->isOnField());
  QObject::connect(field, &QAction::triggered, session, &ComparedSession::setOnField);
  QAction* plots = add("comparedInPlots", QStringLiteral("Show in &plots"));
  plots->setCheckable(true);
  plots->setChecked(session->isInPlots());
  QObject::connect(plots, &QAction::triggered, session, &ComparedSession::setInPlots);
  menu->addSeparator();
  QAction* instead = add("comparedInstead", QStringLiteral("&Open in place of the session shown"),
                         all, [all, session] { all->openInstead(session); });
  instead->setToolTip(QStringLiteral("The session shown now is compared with it instead"));
  add("comparedRemove", QStringLiteral("&Remove"), all, [all, session] { all->remove(session); });
  add("comparedRemoveAll", QStringLiteral("St&op comparing"), all, &ComparedSessions::removeAll);
}

}  // namespace pitchboard::ui

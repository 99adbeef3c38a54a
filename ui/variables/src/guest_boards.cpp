// SPDX-License-Identifier: GPL-3.0-or-later
#include "guest_boards.h"

#include <ui/base/in_place_message.h>
#include <ui/sources/attached_boards.h>

#include "attach_form.h"
#include "variables_model.h"

namespace pitchboard::ui {

GuestBoards::GuestBoards(MatchController* controller, VariablesModel* model,
                         InPlaceMessage* message, QWidget* dock)
    : QObject(dock),
      m_model(model),
      m_message(message),
      m_boards(new AttachedBoards(controller, this)),
      m_form(new AttachForm(dock)) {
  connect(m_form, &AttachForm::attachRequested, this, &GuestBoards::attach);
}

void GuestBoards::attach(int key, double rate) {
  if (const Result<void> done = m_boards->attach(key, rate); !done) {
    m_message->say(
        InPlaceMessage::Tone::Error,
        QStringLiteral("Not attached. %1").arg(QString::fromStdString(done.error().text())));
    return;
  }
  m_form->hide();
  m_message->clear();
}

bool GuestBoards::contains(int key) const {
  return m_boards->contains(key);
}

void GuestBoards::detach(int key) {
  m_boards->detach(key);
  m_model->setNote(m_boards->groupName(key), {QStringLiteral("detached"), {}, 0.0});
}

void GuestBoards::refresh() {
  for (const link::AttachedStatus& status : m_boards->status()) {
    const int key = status.board.key;
    const bool isGone = !status.problem.empty();
    const QString group = m_boards->groupName(key);
    m_model->setNote(group,
                     {isGone ? QStringLiteral("removed, waiting") : QString(),
                      status.missed == 0 ? QString()
                                         : QStringLiteral("%1 samples were left out, because the "
                                                          "computer was busy.")
                                               .arg(status.missed),
                      isGone ? 0.0 : status.rate});
    if (isGone && m_removed.insert(key).second) {
      m_message->say(InPlaceMessage::Tone::Warning, QString::fromStdString(status.problem));
    } else if (!isGone) {
      m_removed.erase(key);
    }
  }
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/experiments/situation_tests.h>

#include <QWidget>

#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/scenario_behind.h>
#include <ui/sources/shown_moment.h>

#include "situation_dialog.h"

namespace pitchboard::ui {

SituationTests::SituationTests(const Parts& parts, QWidget* window)
    : QObject(window), m_parts(parts), m_window(window) {}

QString SituationTests::whyNot() const {
  const FramePtr frame = m_parts.shown->frame();
  return frame && !frame->robots.empty() ? QString() : QStringLiteral("No robot is on the field.");
}

void SituationTests::ask() {
  if (const QString why = whyNot(); !why.isEmpty()) {
    emit failed(QStringLiteral("Cannot make a test. ") + why);
    return;
  }
  delete m_window->findChild<SituationDialog*>({}, Qt::FindDirectChildrenOnly);
  auto* dialog = new SituationDialog(
      m_parts.shown->frame(), scenarioBehind(*m_parts.shown, *m_parts.match, *m_parts.replay),
      m_parts.settings, m_window);
  connect(dialog, &SituationDialog::saved, this, &SituationTests::saved);
  dialog->show();
}

}  // namespace pitchboard::ui

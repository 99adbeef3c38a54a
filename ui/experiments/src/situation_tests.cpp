// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/experiments/situation_tests.h>

#include <QWidget>

#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/scenario_behind.h>
#include <ui/sources/source_switch.h>

#include "situation_dialog.h"

namespace pitchboard::ui {

SituationTests::SituationTests(const Parts& parts, QWidget* window)
    : QObject(window), m_parts(parts), m_window(window) {}

bool SituationTests::isPossible() const {
  const FramePtr frame = m_parts.source->frame();
  return frame && !frame->robots.empty();
}

void SituationTests::ask() {
  if (!isPossible()) {
    emit failed(QStringLiteral("Cannot make a test: no robot is on the field."));
    return;
  }
  delete m_window->findChild<SituationDialog*>({}, Qt::FindDirectChildrenOnly);
  auto* dialog = new SituationDialog(
      m_parts.source->frame(), scenarioBehind(*m_parts.source, *m_parts.match, *m_parts.replay),
      m_parts.settings, m_window);
  connect(dialog, &SituationDialog::saved, this, &SituationTests::saved);
  dialog->show();
}

}  // namespace pitchboard::ui

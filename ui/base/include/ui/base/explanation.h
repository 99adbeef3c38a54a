// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Labels that explain a part of a form or panel. UI thread only.

#include <QLabel>

#include <ui/base/theme.h>

namespace pitchboard::ui {

/// Makes a label with small, pale text that wraps.
inline QLabel* makeExplanation(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setFont(themeFont(TypeRole::Secondary));
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setWordWrap(true);
  return label;
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sentences of a form or a panel that explain what stands around them. UI thread only.

#include <QLabel>

#include <ui/base/theme.h>

namespace pitchboard::ui {

/// Small, pale and as many lines as it needs.
inline QLabel* makeExplanation(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setFont(themeFont(TypeRole::Secondary));
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setWordWrap(true);
  return label;
}

}  // namespace pitchboard::ui

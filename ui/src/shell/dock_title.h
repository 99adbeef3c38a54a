// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QDockWidget;

namespace pitchboard::ui {

/// Title of a dock: its name, and buttons to float and to close it, in the theme's own icons.
class DockTitle : public QWidget {
  Q_OBJECT
 public:
  explicit DockTitle(QDockWidget* dock);
};

}  // namespace pitchboard::ui

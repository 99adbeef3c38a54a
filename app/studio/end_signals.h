// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace pitchboard::studio {

/// Turns SIGINT, SIGTERM and SIGHUP into a signal of the event loop, so that the studio ends as if
/// its window had been closed. One per program.
class EndSignals : public QObject {
  Q_OBJECT
 public:
  explicit EndSignals(QObject* parent = nullptr);
  ~EndSignals() override;

 signals:
  void received();
};

}  // namespace pitchboard::studio

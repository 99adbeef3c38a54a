// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An end that the system asks for, told to the event loop. Window thread; one per program, owned by
// its main function.

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

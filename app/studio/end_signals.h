// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Ends the studio when the system asks for it (SIGINT, SIGTERM, SIGHUP). UI thread; owned by
// main().

#include <QObject>

namespace pitchboard::studio {

/// Turns SIGINT, SIGTERM and SIGHUP into a Qt signal, so that the studio ends as if its window had
/// been closed. Create only one.
class EndSignals : public QObject {
  Q_OBJECT
 public:
  explicit EndSignals(QObject* parent = nullptr);
  ~EndSignals() override;

 signals:
  void received();
};

}  // namespace pitchboard::studio

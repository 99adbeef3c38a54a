// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Opens a file in the studio that is already running: `pitchboard FILE` passes FILE through a local
// socket to the user's studio with the same settings. The socket is in the user's runtime folder,
// never on a network. One studio serves; if it ends or is killed, another running one takes over.
// UI thread only.

#include <QLocalServer>
#include <QLocalSocket>
#include <QLockFile>
#include <QObject>
#include <functional>

namespace pitchboard::studio {

struct Arguments;

/// Returns the path of the socket of the studios that share these settings; empty if this one does
/// not take part, because it only makes a picture or has no visible window.
QString studioSocket(const Arguments& arguments);

/// Passes the file to the studio behind this socket. Returns false if there is none, or if it does
/// not answer within seconds.
bool handOver(const QString& socket, const QString& file);

class RunningStudio : public QObject {
  Q_OBJECT
 public:
  /// `open` is called with the absolute path of each file that arrives, and returns false if it can
  /// no longer be opened.
  RunningStudio(const QString& socket, std::function<bool(const QString&)> open);

 private:
  void serve();
  void take(QLocalSocket* caller);

  QString m_socket;
  std::function<bool(const QString&)> m_open;
  QLockFile m_lock;  // held by the studio that serves; recognized as stale if that was killed
  QLocalServer m_server;
  QLocalSocket m_other;  // to the studio that serves, to notice when that ends
};

}  // namespace pitchboard::studio

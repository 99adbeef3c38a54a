// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio that already runs, and files for it: `pitchboard FILE` hands FILE over a local socket
// to the studio of this user with these settings. The socket lies in the user's own folder for such
// things, never on a network. One studio serves; when it ends or is killed, another one that runs
// takes its place. UI thread only.

#include <QLocalServer>
#include <QLocalSocket>
#include <QLockFile>
#include <QObject>
#include <functional>

namespace pitchboard::studio {

struct Arguments;

/// Path of the socket of the studios that share these settings; empty when this one takes no part:
/// it only makes a picture, or nobody can see its window.
QString studioSocket(const Arguments& arguments);

/// Whether the studio behind this socket took the file. No other studio, or one that does not
/// answer within seconds: false.
bool handOver(const QString& socket, const QString& file);

class RunningStudio : public QObject {
  Q_OBJECT
 public:
  /// `open` is called with the absolute path of each file that is handed over; false when it cannot
  /// be taken any more.
  RunningStudio(const QString& socket, std::function<bool(const QString&)> open);

 private:
  void serve();
  void take(QLocalSocket* caller);

  QString m_socket;
  std::function<bool(const QString&)> m_open;
  QLockFile m_lock;  // held by the studio that serves; a killed one's is found stale
  QLocalServer m_server;
  QLocalSocket m_other;  // to the studio that serves: it tells when that one ends
};

}  // namespace pitchboard::studio

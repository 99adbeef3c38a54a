// SPDX-License-Identifier: GPL-3.0-or-later
#include "running_studio.h"

#include <QCryptographicHash>
#include <QDataStream>
#include <QDir>
#include <QFileInfo>
#include <QGuiApplication>
#include <QStandardPaths>
#include <QTimer>

#include "arguments.h"

namespace pitchboard::studio {
namespace {

constexpr int maxAnswer = 5000;       // ms; a studio that is busy opening a window needs a moment
constexpr int tryAgain = 1000;        // ms
constexpr quint32 word = 0x50624f31;  // begins each message
constexpr qint64 maxMessageLength = 1 << 16;

}  // namespace

QString studioSocket(const Arguments& arguments) {
  if (!arguments.screenshotFile.empty()) return {};
  const QString own = QStandardPaths::writableLocation(QStandardPaths::RuntimeLocation);
  if (own.isEmpty()) return {};
  const QDir folder(own);
  if (arguments.settings.empty()) {
    const bool seen = QGuiApplication::platformName() != QLatin1String("offscreen");
    return seen ? folder.filePath(QStringLiteral("pitchboard.socket")) : QString();
  }
  // Other settings are another studio: what a test starts never meets the user's.
  const QByteArray file =
      QFileInfo(QString::fromStdString(arguments.settings)).absoluteFilePath().toUtf8();
  const QByteArray name = QCryptographicHash::hash(file, QCryptographicHash::Sha1).toHex();
  return folder.filePath(
      QStringLiteral("pitchboard-%1.socket").arg(QString::fromLatin1(name.left(16))));
}

bool handOver(const QString& socket, const QString& file) {
  if (socket.isEmpty()) return false;
  QLocalSocket studio;
  studio.connectToServer(socket);
  if (!studio.waitForConnected(maxAnswer)) return false;
  QDataStream stream(&studio);
  stream.setVersion(QDataStream::Qt_6_4);
  stream << word << QFileInfo(file).absoluteFilePath();
  while (studio.bytesAvailable() == 0) {
    if (!studio.waitForReadyRead(maxAnswer)) return false;
  }
  return studio.read(1) == "1";
}

RunningStudio::RunningStudio(const QString& socket, std::function<bool(const QString&)> open)
    : m_socket(socket), m_open(std::move(open)), m_lock(socket + QStringLiteral(".lock")) {
  m_lock.setStaleLockTime(0);
  m_server.setSocketOptions(QLocalServer::UserAccessOption);
  connect(&m_server, &QLocalServer::newConnection, this, [this] {
    while (QLocalSocket* caller = m_server.nextPendingConnection()) {
      connect(caller, &QLocalSocket::disconnected, caller, &QObject::deleteLater);
      connect(caller, &QLocalSocket::readyRead, this, [this, caller] { take(caller); });
      take(caller);
    }
  });
  connect(&m_other, &QLocalSocket::disconnected, this, &RunningStudio::serve, Qt::QueuedConnection);
  connect(&m_other, &QLocalSocket::errorOccurred, this, [this] {
    // Between its lock and its socket, or on its way out.
    if (m_other.state() != QLocalSocket::ConnectedState) {
      QTimer::singleShot(tryAgain, this, &RunningStudio::serve);
    }
  });
  serve();
}

void RunningStudio::serve() {
  if (m_server.isListening()) return;
  if (m_lock.isLocked() || m_lock.tryLock(0)) {
    QLocalServer::removeServer(m_socket);  // of a studio that was killed
    m_server.listen(m_socket);
    return;
  }
  if (m_lock.error() == QLockFile::LockFailedError &&
      m_other.state() == QLocalSocket::UnconnectedState) {
    m_other.connectToServer(m_socket);
  }
}

void RunningStudio::take(QLocalSocket* caller) {
  QDataStream stream(caller);
  stream.setVersion(QDataStream::Qt_6_4);
  stream.startTransaction();
  quint32 begin = 0;
  QString file;
  stream >> begin >> file;
  if (!stream.commitTransaction()) {
    if (caller->bytesAvailable() > maxMessageLength ||
        stream.status() == QDataStream::ReadCorruptData)
      caller->abort();
    return;
  }
  const bool taken = begin == word && m_open(file);
  caller->write(taken ? "1" : "0");
  caller->flush();
}

}  // namespace pitchboard::studio

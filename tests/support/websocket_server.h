// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A WebSocket server for tests that does what it is told, right or wrong: it takes one connection
// after the other, answers the handshake as it should, or otherwise, and sends any bytes. Lives on
// a thread with an event loop.

#include <QCryptographicHash>
#include <QTcpServer>
#include <QTcpSocket>
#include <memory>
#include <string_view>

namespace pitchboard {

class WebSocketServer : public QObject {
 public:
  enum class Answer { Accept, Refuse400, Nothing };

  /// `port` 0: any free one.
  explicit WebSocketServer(QByteArray subprotocol, quint16 port = 0)
      : m_subprotocol(std::move(subprotocol)) {
    connect(&m_server, &QTcpServer::newConnection, this, [this] {
      m_socket = m_server.nextPendingConnection();
      m_input.clear();
      m_isOpen = false;
      ++connections;
      connect(m_socket, &QTcpSocket::readyRead, this, [this, socket = m_socket] {
        if (socket == m_socket) read();
      });
      connect(m_socket, &QTcpSocket::disconnected, this, [this, socket = m_socket] {
        if (socket == m_socket) m_isOpen = false;
        socket->deleteLater();
      });
    });
    if (!m_server.listen(QHostAddress::LocalHost, port)) qFatal("cannot listen");
  }

  quint16 port() const { return m_server.serverPort(); }
  std::string url() const { return "ws://127.0.0.1:" + std::to_string(port()); }
  bool isOpen() const { return m_isOpen; }

  void sendText(const QByteArray& text) { sendFrame(char(0x81), text); }
  void sendBinary(const QByteArray& bytes) { sendFrame(char(0x82), bytes); }
  /// A message of Foxglove's protocol.
  void sendMessage(quint32 subscription, quint64 logTime, const QByteArray& payload) {
    QByteArray bytes(1, char(1));
    for (int i = 0; i < 4; ++i) bytes += char(subscription >> (8 * i) & 0xff);
    for (int i = 0; i < 8; ++i) bytes += char(logTime >> (8 * i) & 0xff);
    sendBinary(bytes + payload);
  }
  /// A frame in parts, with another opcode than usual, or cut.
  void sendRaw(const QByteArray& bytes) {
    m_socket->write(bytes);
    m_socket->flush();
  }
  void sendFrame(char first, const QByteArray& payload) {
    QByteArray head(1, first);
    const auto size = static_cast<quint64>(payload.size());
    if (size < 126) {
      head += char(size);
    } else if (size < 65536) {
      head += char(126);
      for (int i = 1; i >= 0; --i) head += char(size >> (8 * i) & 0xff);
    } else {
      head += char(127);
      for (int i = 7; i >= 0; --i) head += char(size >> (8 * i) & 0xff);
    }
    sendRaw(head + payload);
  }
  void drop() {
    m_isOpen = false;
    if (m_socket != nullptr) m_socket->abort();
  }
  /// From now on the client gets no answer, not even to its pings.
  void stopReading() { m_isDeaf = true; }
  /// Nobody can connect any more.
  void stopListening() { m_server.close(); }
  void listenAgain(quint16 port) {
    if (!m_server.listen(QHostAddress::LocalHost, port)) qFatal("cannot listen again");
  }

  Answer answer = Answer::Accept;
  int connections = 0;
  QByteArray request;       ///< of the last handshake
  QList<QByteArray> texts;  ///< that the client sent
  int otherFrames = 0;      ///< that the client sent: neither texts, pongs nor a close

 private:
  void read() {
    if (m_isDeaf) return;
    m_input += m_socket->readAll();
    if (!m_isOpen) {
      const auto end = m_input.indexOf("\r\n\r\n");
      if (end < 0 || answer == Answer::Nothing) return;
      request = m_input.left(end);
      m_input.remove(0, end + 4);
      greet();
    }
    while (m_isOpen && readFrame()) {
    }
  }

  void greet() {
    if (answer == Answer::Refuse400) {
      sendRaw("HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n");
      return;
    }
    QByteArray key;
    for (const QByteArray& line : request.split('\n')) {
      if (line.toLower().startsWith("sec-websocket-key:")) key = line.mid(18).trimmed();
    }
    const QByteArray hash = QCryptographicHash::hash(key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11",
                                                     QCryptographicHash::Sha1);
    QByteArray reply =
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Accept: " +
        hash.toBase64() + "\r\n";
    if (!m_subprotocol.isEmpty()) reply += "Sec-WebSocket-Protocol: " + m_subprotocol + "\r\n";
    m_isOpen = true;
    sendRaw(reply + "\r\n");
  }

  /// Short frames, which are masked, as all of a client are.
  bool readFrame() {
    const auto* bytes = reinterpret_cast<const unsigned char*>(m_input.constData());
    if (m_input.size() < 6) return false;
    qsizetype size = bytes[1] & 0x7f, head = 2;
    if (size == 126) {
      size = bytes[2] << 8 | bytes[3];
      head = 4;
    } else if (size == 127) {
      qFatal("a client's frame is long");
    }
    if (m_input.size() < head + 4 + size) return false;
    QByteArray payload = m_input.mid(head + 4, size);
    for (qsizetype i = 0; i < size; ++i) {
      payload[i] = static_cast<char>(payload[i] ^ m_input[head + i % 4]);
    }
    const int code = bytes[0] & 0x0f;
    m_input.remove(0, head + 4 + size);
    if (code == 1) {
      texts << payload;
    } else if (code != 8 && code != 9 && code != 10) {
      ++otherFrames;
    }
    if (code == 9) sendFrame(char(0x8a), payload);
    if (code == 8) {
      m_isOpen = false;
      m_socket->disconnectFromHost();
    }
    return true;
  }

  const QByteArray m_subprotocol;
  QTcpServer m_server;
  QTcpSocket* m_socket = nullptr;
  QByteArray m_input;
  bool m_isOpen = false, m_isDeaf = false;
};

}  // namespace pitchboard

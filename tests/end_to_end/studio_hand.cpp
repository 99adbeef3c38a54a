// SPDX-License-Identifier: GPL-3.0-or-later
// A hand at the studio's window for tests that run it as a program: a plugin of Qt that does what
// its standard input says. "close": the window's button; "quit": Ctrl+Q; "minimize". "look" answers
// on standard output with the window's title, and "minimized" before it when it is.
#include <unistd.h>
#include <QGenericPlugin>
#include <QGuiApplication>
#include <QSocketNotifier>
#include <QWindow>
#include <QtTest>

class Hand : public QObject {
  Q_OBJECT
 public:
  Hand() : m_words(STDIN_FILENO, QSocketNotifier::Read) {
    connect(&m_words, &QSocketNotifier::activated, this, &Hand::take);
  }

 private:
  void take() {
    char bytes[64];
    const ssize_t size = read(STDIN_FILENO, bytes, sizeof bytes);
    if (size <= 0) {
      m_words.setEnabled(false);
      return;
    }
    m_line.append(bytes, size);
    if (!m_line.endsWith('\n')) return;
    const QByteArray word = m_line.trimmed();
    m_line.clear();
    for (QWindow* window : QGuiApplication::topLevelWindows()) {
      if (!window->isVisible() || window->transientParent() != nullptr) continue;
      if (word == "look") {
        const bool hidden = window->windowStates().testFlag(Qt::WindowMinimized);
        const QByteArray seen = (hidden ? "minimized " : "") + window->title().toUtf8() + '\n';
        if (write(STDOUT_FILENO, seen.constData(), std::size_t(seen.size())) < 0) return;
      }
      if (word == "minimize") window->setWindowState(Qt::WindowMinimized);
      if (word == "close") window->close();
      if (word == "quit") QTest::keyClick(window, Qt::Key_Q, Qt::ControlModifier);
      return;
    }
  }

  QSocketNotifier m_words;
  QByteArray m_line;
};

class HandPlugin : public QGenericPlugin {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID QGenericPluginFactoryInterface_iid FILE "studio_hand.json")
 public:
  QObject* create(const QString&, const QString&) override { return new Hand; }
};

#include "studio_hand.moc"

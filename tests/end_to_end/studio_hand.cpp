// SPDX-License-Identifier: GPL-3.0-or-later
// A hand at the studio's window for tests that run it as a program: a plugin of Qt that does what
// its standard input says. "close": the window's button; "quit": Ctrl+Q; "minimize"; "other
// button": the button of a question that is not its default. "look" answers on standard output with
// the window's title, and "minimized" before it when it is.
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
    for (qsizetype end; (end = m_line.indexOf('\n')) >= 0; m_line.remove(0, end + 1)) {
      obey(m_line.left(end).trimmed());
    }
  }

  static void obey(const QByteArray& word) {
    QWindow* shown = nullptr;
    for (QWindow* window : QGuiApplication::topLevelWindows()) {
      if (shown == nullptr && window->isVisible() && window->transientParent() == nullptr) {
        shown = window;
      }
    }
    if (word == "look") {
      QByteArray seen = shown ? shown->title().toUtf8() : QByteArray();
      if (shown && shown->windowStates().testFlag(Qt::WindowMinimized)) seen.prepend("minimized ");
      seen += '\n';
      if (write(STDOUT_FILENO, seen.constData(), std::size_t(seen.size())) < 0) return;
    }
    if (word == "other button") {
      for (QWindow* window : QGuiApplication::topLevelWindows()) {
        if (!window->isVisible() || window->transientParent() == nullptr) continue;
        QTest::keyClick(window, Qt::Key_Tab);
        QTest::keyClick(window, Qt::Key_Space);
        return;
      }
    }
    if (shown == nullptr) return;
    if (word == "minimize") shown->setWindowState(Qt::WindowMinimized);
    if (word == "close") shown->close();
    if (word == "quit") QTest::keyClick(shown, Qt::Key_Q, Qt::ControlModifier);
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

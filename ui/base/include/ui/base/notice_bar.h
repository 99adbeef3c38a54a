// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A strip for what a person should know or decide, without stopping anything. One notice at a time,
// the newest one; older ones wait behind it, the same one twice is shown once. Text wraps, buttons
// keep their size: they move below the text where there is little room. UI thread only.

#include <QFrame>
#include <QString>
#include <functional>
#include <vector>

class QBoxLayout;
class QLabel;
class QTimer;

namespace pitchboard::ui {

struct NoticeButton {
  QString text;
  std::function<void()> action;  ///< may be empty: the button only closes the notice
};

enum class NoticeTone { Trouble, Success };

/// What a notice is about. A new notice of a topic takes the place of the older one, and whoever
/// showed it calls settle() when its cause is gone: with the next success, with another file.
struct NoticeTopic {
  QString name;
  NoticeTone tone = NoticeTone::Trouble;
};

class NoticeBar : public QFrame {
  Q_OBJECT
 public:
  explicit NoticeBar(QWidget* parent = nullptr);

  /// Lies over the lower edge of `host` from now on instead of taking room in its layout.
  void floatOver(QWidget* host);
  /// Without buttons it can only be closed. A success leaves by itself.
  void show(const NoticeTopic& topic, const QString& sentence,
            std::vector<NoticeButton> buttons = {});
  /// The cause is gone.
  void settle(const QString& topic);
  NoticeTone tone() const {
    return m_notices.empty() ? NoticeTone::Trouble : m_notices.front().topic.tone;
  }
  QString text() const;

 protected:
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  class Text;
  struct Notice {
    NoticeTopic topic;
    QString sentence;
    std::vector<NoticeButton> buttons;
  };
  bool eventFilter(QObject* watched, QEvent* event) override;
  void place();
  void arrange(int width);
  void present();
  void dismiss();

  std::vector<Notice> m_notices;  // the first is shown
  Text* m_text;
  QLabel* m_more;
  QBoxLayout* m_row;      // the text, and beside or below it:
  QBoxLayout* m_side;     // how many more there are, and
  QBoxLayout* m_buttons;  // the buttons
  QTimer* m_leaving;      // of a success
  bool m_floats = false;
};

}  // namespace pitchboard::ui

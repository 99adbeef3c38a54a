// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A bar that tells or asks the user something without blocking anything. It shows the newest
// notice; older ones wait behind it, where "1 more" leads to, and equal notices are shown once.
// Text wraps into two lines at most; buttons keep their size and move below the text if there is
// little room. UI thread only.

#include <QFrame>
#include <QString>
#include <functional>
#include <utility>
#include <vector>

class QBoxLayout;
class QTimer;
class QToolButton;

namespace pitchboard::ui {

struct NoticeButton {
  QString text;
  std::function<void()> action;  ///< may be empty: the button only closes the notice
};

enum class NoticeTone { Trouble, Success };

/// What a notice is about. A new notice replaces an older one with the same topic. Whoever shows a
/// notice calls settle() when its cause is gone, such as after the next success.
struct NoticeTopic {
  QString name;
  NoticeTone tone = NoticeTone::Trouble;
};

class NoticeBar : public QFrame {
  Q_OBJECT
 public:
  explicit NoticeBar(QWidget* parent = nullptr);

  /// Places the bar over the lower edge of `host` instead of in its layout; as wide as `host`, or
  /// as its window if the text needs that. The window becomes its parent.
  void floatOver(QWidget* host);
  /// Shows a notice. Without buttons it can only be closed. A notice of success disappears by
  /// itself.
  void show(const NoticeTopic& topic, const QString& sentence,
            std::vector<NoticeButton> buttons = {});
  /// Removes the notice of this topic, because its cause is gone.
  void settle(const QString& topic);
  /// Removes the notice if it disappears by itself and its time is over. The bar calls it.
  void removeOver();
  /// The clock for that: milliseconds that never decrease.
  void setClock(std::function<qint64()> milliseconds) { m_clock = std::move(milliseconds); }
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
  void showNext();

  std::vector<Notice> m_notices;  // the first is shown
  Text* m_text;
  QToolButton* m_more;
  QBoxLayout* m_row;      // the text, and beside or below it:
  QBoxLayout* m_side;     // how many more there are, and
  QBoxLayout* m_buttons;  // the buttons
  QTimer* m_leaving;      // of a success
  std::function<qint64()> m_clock;
  qint64 m_leavesAt = 0;
  QWidget* m_host = nullptr;  // over which it floats
};

}  // namespace pitchboard::ui

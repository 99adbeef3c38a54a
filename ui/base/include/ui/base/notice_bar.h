// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A strip above the field for what a person should know or decide, without stopping anything. One
// notice at a time; further ones wait, the same one twice is shown once. UI thread only.

#include <QFrame>
#include <functional>
#include <vector>

class QHBoxLayout;
class QLabel;

namespace pitchboard::ui {

struct NoticeButton {
  QString text;
  std::function<void()> action;  ///< may be empty: the button only closes the notice
};

class NoticeBar : public QFrame {
  Q_OBJECT
 public:
  explicit NoticeBar(QWidget* parent = nullptr);

  /// Without buttons it can only be closed.
  void show(const QString& sentence, std::vector<NoticeButton> buttons = {});
  QString text() const;
  int waiting() const { return m_notices.empty() ? 0 : static_cast<int>(m_notices.size()) - 1; }

 private:
  struct Notice {
    QString sentence;
    std::vector<NoticeButton> buttons;
  };
  void present();
  void dismiss();

  std::vector<Notice> m_notices;  // the first is shown
  QLabel* m_text;
  QLabel* m_more;
  QHBoxLayout* m_buttons;
};

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/notice_bar.h>

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QToolButton>
#include <algorithm>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {
constexpr std::size_t maxNotices = 20;
constexpr int successMilliseconds = 8000;
}  // namespace

NoticeBar::NoticeBar(QWidget* parent)
    : QFrame(parent), m_text(new QLabel(this)), m_more(new QLabel(this)) {
  setObjectName(QStringLiteral("noticeBar"));
  m_text->setObjectName(QStringLiteral("noticeText"));
  m_text->setWordWrap(true);
  m_text->setTextFormat(Qt::PlainText);
  m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  m_more->setFont(themeFont(TypeRole::Secondary));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(scaled(this, 12), scaled(this, 6), scaled(this, 8), scaled(this, 6));
  row->setSpacing(scaled(this, 8));
  row->addWidget(m_text, 1);
  row->addWidget(m_more);
  m_buttons = new QHBoxLayout;
  m_buttons->setSpacing(scaled(this, 4));
  row->addLayout(m_buttons);
  m_leaving = new QTimer(this);
  m_leaving->setSingleShot(true);
  m_leaving->setInterval(successMilliseconds);
  connect(m_leaving, &QTimer::timeout, this, [this] {
    if (tone() == NoticeTone::Success) dismiss();
  });
  hide();
}

void NoticeBar::floatOver(QWidget* host) {
  setParent(host);
  m_floats = true;
  host->installEventFilter(this);
  place();
}

bool NoticeBar::eventFilter(QObject* watched, QEvent* event) {
  if (m_floats && watched == parent() && event->type() == QEvent::Resize) place();
  return QFrame::eventFilter(watched, event);
}

void NoticeBar::place() {
  const QWidget* host = parentWidget();
  if (!m_floats || host == nullptr) return;
  const int wide = host->width();
  // The hint alone is that of a label as high as it is wide.
  const int lines = heightForWidth(wide);
  const int high = lines > 0 ? lines : sizeHint().height();
  setGeometry(0, host->height() - high, wide, high);
  raise();
}

void NoticeBar::show(const QString& sentence, std::vector<NoticeButton> buttons,
                     const NoticeTopic& topic) {
  for (const Notice& notice : m_notices) {
    if (notice.sentence == sentence) return;
  }
  if (!topic.name.isEmpty()) {
    std::erase_if(m_notices, [&](const Notice& old) { return old.topic.name == topic.name; });
  }
  // A flood of errors must not keep a person busy closing them.
  if (m_notices.size() >= maxNotices) m_notices.pop_back();
  m_notices.insert(m_notices.begin(), {sentence, std::move(buttons), topic});
  present();
}

void NoticeBar::settle(const QString& topic) {
  if (std::erase_if(m_notices, [&](const Notice& n) { return n.topic.name == topic; }) > 0) {
    present();
  }
}

QString NoticeBar::text() const {
  return m_notices.empty() ? QString() : m_text->text();
}

void NoticeBar::dismiss() {
  if (!m_notices.empty()) m_notices.erase(m_notices.begin());
  present();
}

void NoticeBar::present() {
  while (QLayoutItem* item = m_buttons->takeAt(0)) {
    item->widget()->hide();
    item->widget()->deleteLater();
    delete item;
  }
  setVisible(!m_notices.empty());
  if (m_notices.empty()) return;
  const Notice& notice = m_notices.front();
  const bool success = notice.topic.tone == NoticeTone::Success;
  if (success)
    m_leaving->start();
  else
    m_leaving->stop();
  m_text->setText(notice.sentence);
  m_more->setText(m_notices.size() > 1 ? QStringLiteral("%1 more").arg(m_notices.size() - 1)
                                       : QString());
  m_more->setVisible(m_notices.size() > 1);
  setStyleSheet(QStringLiteral("#noticeBar { background: %1; border-bottom: 1px solid %2; }"
                               "#noticeBar QLabel { color: %2; }")
                    .arg(success ? theme().workingGround.name() : theme().warningGround.name(),
                         success ? theme().workingText.name() : theme().warningText.name()));
  for (const NoticeButton& wanted : notice.buttons) {
    auto* button = new QPushButton(wanted.text, this);
    connect(button, &QPushButton::clicked, this, [this, action = wanted.action] {
      dismiss();
      if (action) action();
    });
    m_buttons->addWidget(button);
  }
  if (notice.buttons.empty()) {
    auto* close = new QToolButton(this);
    close->setIcon(themedIcon(QStringLiteral("window-close")));
    close->setToolTip(QStringLiteral("Close this notice"));
    close->setAccessibleName(close->toolTip());
    close->setAutoRaise(true);
    connect(close, &QToolButton::clicked, this, &NoticeBar::dismiss);
    m_buttons->addWidget(close);
  }
  place();
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/notice_bar.h>

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QResizeEvent>
#include <QTextDocument>
#include <QTextEdit>
#include <QTimer>
#include <QToolButton>
#include <algorithm>
#include <chrono>
#include <cmath>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {
constexpr std::size_t maxNotices = 20;
constexpr int successMilliseconds = 8000, choiceMilliseconds = 30'000;  // with buttons
constexpr int maxLines = 2;
constexpr int minText = 320;  // px of the mock, beside the buttons
}  // namespace

/// A label that also breaks inside of a word, because a path can be longer than the strip is wide.
/// What does not fit into its lines is left out and stands in the tool tip.
class NoticeBar::Text : public QTextEdit {
 public:
  explicit Text(QWidget* parent) : QTextEdit(parent) {
    setObjectName(QStringLiteral("noticeText"));
    setReadOnly(true);
    setTextInteractionFlags(Qt::TextSelectableByMouse);
    setFocusPolicy(Qt::NoFocus);
    setFrameShape(NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    viewport()->setAutoFillBackground(false);
    setWordWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
    document()->setDocumentMargin(0);
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
  }
  void setSentence(const QString& sentence) {
    m_sentence = sentence;
    fit();
    updateGeometry();
  }
  QSize sizeHint() const override {
    return {fontMetrics().horizontalAdvance(m_sentence), fontMetrics().lineSpacing()};
  }
  QSize minimumSizeHint() const override { return {scaled(this, 60), fontMetrics().lineSpacing()}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override {
    return std::min(heightOf(m_sentence, width), maxHeight());
  }
  bool fitsInto(int width) const { return heightOf(m_sentence, width) <= maxHeight(); }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QTextEdit::resizeEvent(event);
    fit();
  }

 private:
  int heightOf(const QString& text, int width) const {
    QTextDocument laidOut;
    laidOut.setDefaultFont(font());
    laidOut.setDocumentMargin(0);
    laidOut.setDefaultTextOption(document()->defaultTextOption());
    laidOut.setPlainText(text);
    laidOut.setTextWidth(width);
    return static_cast<int>(std::ceil(laidOut.size().height()));
  }
  int maxHeight() const {
    return heightOf(QString(maxLines - 1, QLatin1Char('\n')), QWIDGETSIZE_MAX);
  }
  QString shortened() const {
    const int width = viewport()->width();
    if (fitsInto(width)) return m_sentence;
    const auto cut = [this](qsizetype length) {
      return m_sentence.left(length).trimmed() + QChar(0x2026);
    };
    qsizetype fits = 0, tooLong = m_sentence.size();
    while (tooLong - fits > 1) {
      const qsizetype middle = (fits + tooLong) / 2;
      (heightOf(cut(middle), width) <= maxHeight() ? fits : tooLong) = middle;
    }
    const qsizetype space = m_sentence.lastIndexOf(QLatin1Char(' '), fits);
    return cut(space > fits / 2 ? space : fits);
  }
  void fit() {
    const QString shown = shortened();
    if (shown != toPlainText()) setPlainText(shown);
    setToolTip(shown == m_sentence ? QString() : m_sentence);
  }

  QString m_sentence;
};

NoticeBar::NoticeBar(QWidget* parent)
    : QFrame(parent),
      m_text(new Text(this)),
      m_more(new QToolButton(this)),
      m_row(new QHBoxLayout(this)),
      m_side(new QHBoxLayout),
      m_buttons(new QHBoxLayout) {
  setObjectName(QStringLiteral("noticeBar"));
  m_more->setObjectName(QStringLiteral("moreNotices"));
  m_more->setFont(themeFont(TypeRole::Secondary));
  m_more->setAutoRaise(true);
  m_more->setToolTip(QStringLiteral("Show the next notice"));
  connect(m_more, &QToolButton::clicked, this, &NoticeBar::showNext);
  m_row->setContentsMargins(scaled(this, 12), scaled(this, 6), scaled(this, 8), scaled(this, 6));
  m_row->setSpacing(scaled(this, 8));
  m_side->setSpacing(scaled(this, 8));
  m_buttons->setSpacing(scaled(this, 4));
  m_row->addWidget(m_text, 1, Qt::AlignVCenter);
  m_row->addLayout(m_side);
  m_side->addStretch(1);
  m_side->addWidget(m_more);
  m_side->addLayout(m_buttons);
  m_leaving = new QTimer(this);
  m_leaving->setSingleShot(true);
  connect(m_leaving, &QTimer::timeout, this, &NoticeBar::removeOver);
  m_clock = [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return qint64{std::chrono::duration_cast<std::chrono::milliseconds>(now).count()};
  };
  hide();
}

void NoticeBar::floatOver(QWidget* host) {
  setParent(host->window());
  m_host = host;
  host->window()->installEventFilter(this);
  for (QObject* beside : host->window()->children()) {
    if (beside != this && beside->isWidgetType()) beside->installEventFilter(this);
  }
  place();
}

bool NoticeBar::event(QEvent* event) {
  const bool done = QFrame::event(event);
  // A button's size hint is known only when its style is.
  if (event->type() == QEvent::LayoutRequest) {
    arrange(width());
    place();
  }
  return done;
}

bool NoticeBar::eventFilter(QObject* watched, QEvent* event) {
  const bool isHost = watched == m_host || watched == parentWidget();
  if (isHost && (event->type() == QEvent::Resize || event->type() == QEvent::Move)) place();
  if (event->type() == QEvent::ChildAdded && watched == parentWidget()) {
    QObject* beside = static_cast<QChildEvent*>(event)->child();
    if (beside != this && beside->isWidgetType()) beside->installEventFilter(this);
  }
  // Choosing a tab raises a panel, or the field, over everything else.
  // Afterwards: a dock chooses its tab only while it is the topmost one.
  if (event->type() == QEvent::ZOrderChange && watched != this && isVisible())
    QTimer::singleShot(0, this, &QWidget::raise);
  return QFrame::eventFilter(watched, event);
}

void NoticeBar::place() {
  if (m_host == nullptr) return;
  QRect over(m_host->mapTo(parentWidget(), QPoint()), m_host->size());
  // A text that is too long for the field's width gets that of the window.
  const QMargins margins = m_row->contentsMargins();
  const int beside =
      margins.left() + m_row->spacing() + m_side->sizeHint().width() + margins.right();
  const bool isNarrow = over.width() - beside < scaled(this, minText);
  if (m_text->sizeHint().width() > over.width() - beside &&
      (isNarrow || !m_text->fitsInto(over.width() - beside))) {
    over.setLeft(0);
    over.setWidth(parentWidget()->width());
  }
  arrange(over.width());
  // The hint alone is that of a label as high as it is wide.
  const int lines = heightForWidth(over.width());
  const int high = std::min(lines > 0 ? lines : sizeHint().height(), over.height());
  setGeometry(over.left(), over.bottom() + 1 - high, over.width(), high);
  raise();
}

// Text that is squeezed beside its buttons would have one word in each line.
void NoticeBar::arrange(int width) {
  const int room = width - m_row->contentsMargins().left() - m_row->contentsMargins().right();
  m_buttons->setDirection(QBoxLayout::LeftToRight);
  const int wide = m_side->sizeHint().width();
  const int text = std::min(m_text->sizeHint().width(), scaled(this, minText));
  const bool below = text + m_row->spacing() + wide > room;
  m_row->setDirection(below ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
  if (wide > room) m_buttons->setDirection(QBoxLayout::TopToBottom);
}

void NoticeBar::resizeEvent(QResizeEvent* event) {
  arrange(event->size().width());
  QFrame::resizeEvent(event);
}

void NoticeBar::show(const NoticeTopic& topic, const QString& sentence,
                     std::vector<NoticeButton> buttons) {
  for (const Notice& notice : m_notices) {
    if (notice.sentence == sentence) return;
  }
  std::erase_if(m_notices, [&](const Notice& old) { return old.topic.name == topic.name; });
  // A flood of errors must not keep a person busy closing them.
  if (m_notices.size() >= maxNotices) m_notices.pop_back();
  m_notices.insert(m_notices.begin(), {topic, sentence, std::move(buttons)});
  present();
}

void NoticeBar::settle(const QString& topic) {
  if (std::erase_if(m_notices, [&](const Notice& n) { return n.topic.name == topic; }) > 0) {
    present();
  }
}

QString NoticeBar::text() const {
  return m_notices.empty() ? QString() : m_notices.front().sentence;
}

void NoticeBar::showNext() {
  if (m_notices.size() < 2) return;
  std::ranges::rotate(m_notices, m_notices.begin() + 1);
  present();
}

void NoticeBar::dismiss() {
  if (!m_notices.empty()) m_notices.erase(m_notices.begin());
  present();
}

void NoticeBar::removeOver() {
  if (m_notices.empty() || tone() != NoticeTone::Success) return;
  const qint64 left = m_leavesAt - m_clock();
  if (left > 0)
    m_leaving->start(static_cast<int>(left));
  else
    dismiss();
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
  m_leaving->stop();
  if (success) {
    const int stays = notice.buttons.empty() ? successMilliseconds : choiceMilliseconds;
    m_leavesAt = m_clock() + stays;
    m_leaving->start(stays);
  }
  m_text->setSentence(notice.sentence);
  m_more->setText(m_notices.size() > 1 ? QStringLiteral("%1 more").arg(m_notices.size() - 1)
                                       : QString());
  m_more->setVisible(m_notices.size() > 1);
  setStyleSheet(QStringLiteral("#noticeBar { background: %1; border-bottom: 1px solid %2; }"
                               "#noticeBar #moreNotices { color: %2; }"
                               "#noticeBar QTextEdit { color: %2; background: transparent; }")
                    .arg(success ? theme().workingGround.name() : theme().warningGround.name(),
                         success ? theme().workingText.name() : theme().warningText.name()));
  for (const NoticeButton& wanted : notice.buttons) {
    auto* button = new QPushButton(wanted.text, this);
    connect(button, &QPushButton::clicked, this, [this, action = wanted.action] {
      dismiss();
      if (action) action();
    });
    m_buttons->addWidget(button);
    // A layout takes no room for what it will show by itself later.
    button->show();
  }
  if (notice.buttons.empty()) {
    auto* close = new QToolButton(this);
    close->setIcon(themedIcon(QStringLiteral("window-close")));
    close->setToolTip(QStringLiteral("Close this notice"));
    close->setAccessibleName(close->toolTip());
    close->setAutoRaise(true);
    connect(close, &QToolButton::clicked, this, &NoticeBar::dismiss);
    m_buttons->addWidget(close);
    close->show();
  }
  arrange(width());
  place();
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "time_ruler.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {
constexpr int rulerHeight = 16;  // px of the mock
constexpr int headRow = 14;
constexpr int legendHeight = 18;  // a row of names and the gap to the plot before it
constexpr int headWidth = 14;
constexpr int pixelsPerStep = 64;
constexpr TimeMark bothMarks[] = {TimeMark::A, TimeMark::B};
}  // namespace

std::vector<AxisTick> ticksOf(const TimeAxis& axis, const PlotFeed& feed, const QWidget* widget) {
  return axisTicks(axis, scaled(widget, pixelsPerStep), feed.clock());
}

TimeRuler::TimeRuler(const PlotFeed* feed, std::function<TimeAxis()> axis, QWidget* parent)
    : QWidget(parent), m_feed(feed), m_axis(std::move(axis)) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  for (const auto moved : {&LinkedTime::cursorChanged, &LinkedTime::playheadMoved}) {
    connect(feed->time(), moved, this, qOverload<>(&QWidget::update));
  }
}

QSize TimeRuler::sizeHint() const {
  return {100, scaled(this, rulerHeight)};
}

std::vector<AxisTick> TimeRuler::labels() const {
  std::vector<AxisTick> shown = ticksOf(m_axis(), *m_feed, this);
  const TimeAxis axis = m_axis();
  const std::vector<Tag> covering = tags();
  const QFont font = themeFont(TypeRole::Small);
  // Nothing has a time before the beginning.
  const double first = std::min(0.0, m_feed->time()->data().value_or(axis.shown).begin);
  std::erase_if(shown, [&](const AxisTick& tick) {
    if (!m_feed->clock() && tick.time < first - 1e-9) return true;
    const double wide = textLineWidth(font, tick.label) + scaled(this, 6);
    const QRectF box(axis.pixel(tick.time) - wide / 2, 0, wide, height());
    return std::ranges::any_of(covering,
                               [&box](const Tag& tag) { return tag.box.intersects(box); });
  });
  return shown;
}

void TimeRuler::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setFont(themeFont(TypeRole::Small));
  painter.setPen(theme().secondaryText);
  const TimeAxis axis = m_axis();
  const double half = scaled(this, pixelsPerStep);
  for (const AxisTick& tick : labels()) {
    const double x = axis.pixel(tick.time);
    drawTextLine(painter, QRectF(x - half, 0, 2 * half, height()), Qt::AlignCenter, tick.label);
  }
  for (const Tag& tag : tags()) {
    painter.setPen(theme().innerLine);
    painter.setBrush(tag.isMoment ? theme().accentFill : theme().button);
    painter.drawRoundedRect(tag.box, 2, 2);
    painter.setPen(tag.isMoment ? QColor(Qt::white) : theme().text);
    painter.drawText(tag.box, Qt::AlignCenter, tag.text);
  }
}

std::vector<TimeRuler::Tag> TimeRuler::tags() const {
  std::vector<Tag> all;
  if (m_forPicture) return all;
  const TimeAxis axis = m_axis();
  const QFontMetrics metrics(themeFont(TypeRole::Small));
  const auto add = [&](std::optional<double> time, bool isMoment) {
    const double x = time ? axis.pixel(*time) : -1.0;
    if (!time || x < axis.left - 0.5 || x > axis.right() + 0.5) return;
    constexpr double fine = 0.003, coarse = 0.03;  // s for each pixel
    const double each = axis.secondsPerPixel();
    const QString text = m_feed->timeText(*time, each < fine ? 3 : each < coarse ? 2 : 1);
    const double wide = metrics.horizontalAdvance(text) + scaled(this, 8);
    QRectF box(x - wide / 2, 0.5, wide, height() - 1.0);
    if (box.left() < 0) box.moveLeft(0);
    if (box.right() > width()) box.moveRight(width());
    all.push_back({box, text, isMoment});
  };
  add(m_feed->time()->shown()->chosenTime(), true);
  add(m_feed->time()->cursor(), false);
  return all;
}

MarkHeads::MarkHeads(LinkedTime* time, std::function<TimeAxis()> axis, QWidget* parent)
    : QWidget(parent), m_time(time), m_axis(std::move(axis)) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  setVisible(time->shown()->hasMarks());
  connect(time->shown(), &ShownMoment::marksChanged, this, [this] {
    setVisible(m_time->shown()->hasMarks());
    update();
  });
  connect(time, &LinkedTime::rangeChanged, this, [this] { update(); });
}

QSize MarkHeads::sizeHint() const {
  return {100, scaled(this, headRow)};
}

QRectF MarkHeads::headRect(TimeMark mark) const {
  const auto at = m_time->shown()->mark(mark);
  if (!at) return {};
  const double x = m_axis().pixel(*at);
  const double wide = scaled(this, headWidth);
  return {x - wide / 2, 0.0, wide, static_cast<double>(height())};
}

void MarkHeads::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(themeFont(TypeRole::Small, true));
  const TimeAxis axis = m_axis();
  for (const TimeMark mark : bothMarks) {
    const QRectF head = headRect(mark);
    if (head.center().x() < axis.left - 1 || head.center().x() > axis.right() + 1) continue;
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme().accentFill);
    painter.drawRoundedRect(head, 2, 2);
    painter.setPen(Qt::white);
    painter.drawText(head, Qt::AlignCenter,
                     mark == TimeMark::A ? QStringLiteral("A") : QStringLiteral("B"));
  }
}

void MarkHeads::mousePressEvent(QMouseEvent* event) {
  for (const TimeMark mark : {TimeMark::B, TimeMark::A}) {
    if (headRect(mark).contains(event->position())) {
      m_dragged = mark;
      setCursor(Qt::SplitHCursor);
      return;
    }
  }
}

void MarkHeads::mouseMoveEvent(QMouseEvent* event) {
  if (!m_dragged) return;
  const TimeAxis axis = m_axis();
  m_time->shown()->setMark(*m_dragged,
                           axis.time(std::clamp(event->position().x(), axis.left, axis.right())));
}

void MarkHeads::mouseReleaseEvent(QMouseEvent*) {
  m_dragged.reset();
  unsetCursor();
}

TimeLines::TimeLines(LinkedTime* time, std::function<TimeAxis()> axis, QWidget* parent)
    : QWidget(parent), m_time(time), m_axis(std::move(axis)) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_NoSystemBackground);
  connect(time->shown(), &ShownMoment::marksChanged, this, &TimeLines::follow);
  for (const auto moved :
       {&LinkedTime::cursorChanged, &LinkedTime::playheadMoved, &LinkedTime::rangeChanged}) {
    connect(time, moved, this, &TimeLines::follow);
  }
}

QList<double> TimeLines::places() const {
  const TimeAxis axis = m_axis();
  QList<double> all;
  const auto add = [&](std::optional<double> time) {
    const double x = time ? axis.pixel(*time) : -1.0;
    all << (x >= axis.left - 0.5 && x <= axis.right() + 0.5 ? std::round(x) : -1.0);
  };
  for (const TimeMark mark : bothMarks) add(m_time->shown()->mark(mark));
  add(m_time->playhead());
  add(m_time->cursor());
  return all;
}

void TimeLines::setPlots(const QList<QRect>& plots) {
  if (plots == m_plots) return;
  m_plots = plots;
  update();
}

void TimeLines::setPointed(const std::optional<PointedValue>& value) {
  if (value == m_pointed) return;
  m_pointed = value;
  update();
}

void TimeLines::follow() {
  const QList<double> now = places();
  if (now == m_drawn) return;
  for (const double x : m_drawn + now) {
    if (x >= 0) update(static_cast<int>(x) - 2, 0, 5, height());
  }
  m_drawn = now;
}

void TimeLines::setHint(const std::optional<DropHint>& hint) {
  if (hint == m_hint) return;
  m_hint = hint;
  update();
}

void TimeLines::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const ThemeColors& colors = theme();
  m_drawn = places();
  // In the order of places().
  const QPen mark(colors.accentLine, 1.0, Qt::DashLine), moment(colors.accentLine, 2.0),
      pointer(colors.secondaryText, 1.0);
  const QPen pens[] = {mark, mark, moment, pointer};
  for (qsizetype i = 0; i < m_drawn.size(); ++i) {
    if (m_drawn[i] < 0 || (m_forPicture && i > 1)) continue;
    painter.setPen(pens[i]);
    // A and B come down from their heads; what moves must not strike the names of curves through.
    const int above = i > 1 ? 0 : scaled(this, legendHeight);
    for (const QRect& plot : m_plots) {
      painter.drawLine(QPointF(m_drawn[i], plot.top() - above), QPointF(m_drawn[i], plot.bottom()));
    }
  }
  if (m_pointed && !m_forPicture) {
    const TimeAxis axis = m_axis();
    painter.setPen(QPen(colors.secondaryText, 1.0, Qt::DotLine));
    painter.drawLine(QPointF(axis.left, m_pointed->y), QPointF(axis.right(), m_pointed->y));
    painter.setFont(themeFont(TypeRole::Small));
    const double high = scaled(this, rulerHeight) - 2.0;
    const double wide = painter.fontMetrics().horizontalAdvance(m_pointed->text) + scaled(this, 6);
    const QRectF box(std::max(0.0, axis.left - wide), m_pointed->y - high / 2, wide, high);
    painter.setPen(colors.innerLine);
    painter.setBrush(colors.button);
    painter.drawRoundedRect(box, 2, 2);
    painter.setPen(colors.text);
    painter.drawText(box, Qt::AlignCenter, m_pointed->text);
  }
  if (!m_hint) return;
  QColor ground = colors.accentFill;
  ground.setAlpha(50);
  painter.setPen(QPen(colors.accentLine, 2));
  painter.setBrush(ground);
  painter.drawRect(m_hint->area.adjusted(1, 1, -1, -1));
  painter.setPen(colors.text);
  painter.drawText(m_hint->area, Qt::AlignCenter, m_hint->text);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "timeline_strip.h"

#include <QAction>
#include <QApplication>
#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QMouseEvent>
#include <QScrollBar>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <functional>

#include <ui/base/theme.h>
#include <ui/sources/abandoned_future.h>
#include <ui/sources/event_list.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/rule_watch.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

constexpr double narrowest = 0.05;  // s shown
constexpr double widest = 7 * 86400.0;
constexpr double markReach = 7.0;  // px of the mock
constexpr int narrowestHandle = 26, narrowestWindow = 12;
// What moves by itself moves a pixel or two in that time; more pictures of it only cost.
constexpr Beat::Milliseconds calmly{50};

/// Of the row of broken rules, with the gap below it.
int rulesHeightOf(const QWidget* strip, const RuleWatch* rules) {
  return rules != nullptr && !rules->rules().empty() ? scaled(strip, 9) : 0;
}

}  // namespace

TimelineStrip::TimelineStrip(ShownMoment* shown, LinkedTime* plots, QWidget* parent)
    : QWidget(parent),
      m_shown(shown),
      m_plots(plots),
      m_scroll(new QScrollBar(Qt::Vertical, this)) {
  setObjectName(QStringLiteral("timelineStrip"));
  setAcceptDrops(true);
  connect(m_scroll, &QScrollBar::valueChanged, this, qOverload<>(&QWidget::update));
  m_scroll->setObjectName(QStringLiteral("comparedScroll"));
  m_scroll->setAccessibleName(QStringLiteral("Compared sessions"));
  m_scroll->hide();
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(QStringLiteral("Timeline"));
  m_calm = Beat::display().add(this, calmly, [this] { update(); });
  const auto refresh = [this] {
    fitAxis();
    updateCalmly();
  };
  connect(shown, &ShownMoment::moved, this, refresh);
  connect(shown, &ShownMoment::newestChanged, this, refresh);
  connect(shown, &ShownMoment::sourceChanged, this, [this] {
    finishNote(false);
    m_marksOf = nullptr;
    m_showsAll = true;
    fitAxis();
    update();
  });
  connect(shown, &ShownMoment::selectionChanged, this, qOverload<>(&QWidget::update));
  connect(shown, &ShownMoment::eventFilterChanged, this, [this] {
    m_marksOf = nullptr;
    for (LaidOut& row : m_comparedMarks) row = {};
    update();
  });
  if (plots != nullptr) {
    connect(plots, &LinkedTime::rangeChanged, this, &TimelineStrip::updateCalmly);
    connect(plots, &LinkedTime::cursorChanged, this, qOverload<>(&QWidget::update));
  }
  constexpr double closer = 1 / 1.5, farther = 1.5;
  addZoom("timelineZoomIn", "Zoom timeline in", [this] { zoom(closer, m_shown->time()); });
  addZoom("timelineZoomOut", "Zoom timeline out", [this] { zoom(farther, m_shown->time()); });
  addZoom("timelineAll", "Show the whole timeline", [this] { showAll(); });
  fitAxis();
}

TimelineStrip::~TimelineStrip() = default;

void TimelineStrip::addZoom(const char* id, const char* text, const std::function<void()>& change) {
  auto* action = new QAction(QString::fromUtf8(text), this);
  action->setObjectName(QLatin1String(id));
  connect(action, &QAction::triggered, this, change);
}

// A hand on the timeline or on the plots is followed at once.
void TimelineStrip::updateCalmly() {
  const bool byItself = m_grab == Grab::Nothing && !m_shown->isLookingBack() &&
                        (m_plots == nullptr || m_plots->isFollowing());
  if (!byItself)
    update();
  else
    m_calm->want();
}

void TimelineStrip::setFuture(AbandonedFuture* future) {
  m_future = future;
  if (future == nullptr) return;
  connect(future, &AbandonedFuture::changed, this, [this] {
    updateGeometry();
    fitAxis();
    update();
  });
}

QSize TimelineStrip::sizeHint() const {
  const int rows = visibleRows();
  const int compared = rows > 0 ? scaled(this, 2) + rows * comparedRowHeight() : 0;
  return {scaled(this, 600),
          scaled(this, 56) + compared + branchHeight() + rulesHeightOf(this, m_rules)};
}

void TimelineStrip::setRules(RuleWatch* rules) {
  m_rules = rules;
  if (rules == nullptr) return;
  connect(rules, &RuleWatch::changed, this, [this] {
    if (height() != sizeHint().height()) updateGeometry();
    updateCalmly();
  });
}

int TimelineStrip::lanesTop() const {
  return bandRect().top() - rulesHeightOf(this, m_rules);
}

QRect TimelineStrip::rulesRect() const {
  const int high = rulesHeightOf(this, m_rules);
  if (high == 0) return {};
  const QRect band = bandRect();
  return {band.left(), lanesTop(), band.width(), high - scaled(this, 2)};
}

std::vector<const BrokenRule*> TimelineStrip::brokenAt(double x, quint64 session) const {
  std::vector<const BrokenRule*> out;
  if (m_rules == nullptr) return out;
  constexpr double reach = 2.5;  // px
  for (const BrokenRule& one : m_rules->broken()) {
    if (m_axis.pixel(one.from()) - reach > x) break;  // in order of time
    if (one.session == session && m_axis.pixel(one.until()) + reach >= x) out.push_back(&one);
  }
  std::ranges::stable_sort(out, std::greater(), [this](const BrokenRule* one) {
    return m_rules->ruleOf(*one).severity;
  });
  return out;
}

QString TimelineStrip::rulesTip(double x, quint64 session, QStringList lines) const {
  constexpr std::size_t most = 8;
  const auto all = brokenAt(x, session);
  for (std::size_t i = 0; i < std::min(all.size(), most); ++i) {
    const telemetry::FoundMoment& moment = all[i]->moment;
    QString line =
        QStringLiteral("%1  %2 (%3, %4 s")
            .arg(momentText(all[i]->from(), 2, m_shown->clock()), m_rules->sentenceOf(*all[i]),
                 QString::fromStdString(m_rules->ruleOf(*all[i]).name))
            .arg(moment.range.end - moment.range.begin, 0, 'f', 2);
    if (moment.value) line += QStringLiteral(", worst %1").arg(*moment.value, 0, 'g', 4);
    lines << line.toHtmlEscaped() + QLatin1Char(')');
  }
  if (all.size() > most) {
    lines << QStringLiteral("and %1 more; zoom in to see them").arg(all.size() - most);
  }
  if (all.empty()) lines << QStringLiteral("No rule is broken here");
  return QStringLiteral("<p style='white-space:pre'>") + lines.join(QStringLiteral("<br>")) +
         QStringLiteral("</p>");
}

int TimelineStrip::branchHeight() const {
  return m_future != nullptr && m_future->isOn() ? scaled(this, 16) : 0;
}

QRect TimelineStrip::branchRect() const {
  if (branchHeight() == 0) return {};
  const QRect band = bandRect();
  const int left = std::max(qRound(m_axis.pixel(m_future->begin())), band.left());
  const int right = std::min(qRound(m_axis.pixel(m_future->end())), band.right());
  return {left, lanesTop() - branchHeight(), std::max(right - left, 0), scaled(this, 13)};
}

QSize TimelineStrip::minimumSizeHint() const {
  return {scaled(this, 160), sizeHint().height()};
}

QRect TimelineStrip::bandRect() const {
  const int left = scaled(this, 12);
  const int high = scaled(this, bandHeight);
  return {left, height() - scaled(this, axisHeight) - scaled(this, railHeight) - high,
          std::max(width() - 2 * left, 1), high};
}

QRect TimelineStrip::marksRect() const {
  const QRect band = bandRect();
  return {band.left(), 0, band.width(), comparedTop()};
}

std::optional<QRectF> TimelineStrip::windowRect() const {
  if (m_plots == nullptr || !m_plots->data()) return {};
  const QRect band = bandRect();
  const double left = std::max(m_axis.pixel(m_plots->range().begin), double(band.left()));
  const double right = std::min(m_axis.pixel(m_plots->range().end), double(band.right() + 1));
  if (right <= band.left() || left > band.right()) return {};
  return QRectF(left, band.top(), std::max(right - left, 2.0), band.height());
}

std::optional<QRectF> TimelineStrip::rangeHandle() const {
  const auto window = windowRect();
  if (!window) return {};
  const QRectF band = bandRect();
  const double wide =
      std::min(std::max(window->width(), double(scaled(this, narrowestHandle))), band.width());
  const double left = std::clamp(window->center().x() - wide / 2, band.left(), band.right() - wide);
  return QRectF(left, band.bottom() + 1, wide, scaled(this, railHeight) - 1);
}

void TimelineStrip::clampShown(telemetry::TimeRange& range) const {
  const double span = std::clamp(range.end - range.begin, narrowest, widest);
  const double middle = (range.begin + range.end) / 2;
  range = {middle - span / 2, middle + span / 2};
}

void TimelineStrip::fitAxis() {
  const QRect band = bandRect();
  m_axis.left = band.left();
  m_axis.width = band.width();
  const auto there = m_shown->available();
  double now = std::max(m_shown->now(), there ? there->end : 0.0);
  if (m_showsAll && branchHeight() > 0) now = std::max(now, m_future->end());
  if (m_showsAll) {
    double begin = there ? there->begin : now;
    const auto& events = m_shown->events()->events();
    if (!events.empty()) begin = std::min(begin, events.front().time);
    if (!m_shown->kind().hasPresent) {
      constexpr double nothing = 30.0;  // s, without a session
      m_axis.shown = {begin, there ? std::max(now, begin + narrowest) : begin + nothing};
      return;
    }
    if (begin < 5.0) begin = std::min(begin, 0.0);
    // Grows in round steps, so that marks do not creep while a person looks at them.
    constexpr double room = 1.03, least = 30.0, pieces = 24.0;
    const double wanted = std::max((now - begin) * room, least);
    const double step = roundStep(wanted / pieces);
    m_axis.shown = {begin, begin + std::ceil(wanted / step) * step};
  } else if (!m_shown->chosenTime() && m_grab == Grab::Nothing) {
    // A narrow view in which now stood goes on with now.
    const double span = m_axis.shown.end - m_axis.shown.begin;
    constexpr double margin = 0.1;
    if (now > m_axis.shown.end && now - span * margin < m_axis.shown.end) {
      m_axis.shown = {now - span * (1 - margin), now + span * margin};
    }
  }
}

void TimelineStrip::setShown(telemetry::TimeRange range) {
  if (!std::isfinite(range.begin) || !std::isfinite(range.end)) return;
  clampShown(range);
  m_showsAll = false;
  m_axis.shown = range;
  update();
}

void TimelineStrip::showAll() {
  m_showsAll = true;
  fitAxis();
  update();
}

void TimelineStrip::zoom(double factor, double anchor) {
  const telemetry::TimeRange shown = m_axis.shown;
  setShown({anchor - (anchor - shown.begin) * factor, anchor + (shown.end - anchor) * factor});
}

MarkSizes TimelineStrip::markSizes() const {
  return {double(scaled(this, 10)), double(scaled(this, 9)), double(scaled(this, 72))};
}

const std::vector<EventMark>& TimelineStrip::marks() {
  const EventList* list = m_shown->events();
  if (list != m_marksOf || list->revision() != m_marksRevision || !(m_marksAxis == m_axis)) {
    m_marksOf = list;
    m_marksRevision = list->revision();
    m_marksAxis = m_axis;
    m_marks = layOutMarks(list->events(), m_axis, markSizes(),
                          QFontMetrics(themeFont(TypeRole::Small)), m_shown->filter());
  }
  return m_marks;
}

const EventMark* TimelineStrip::nearest(const std::vector<EventMark>& marks, double x) const {
  const EventMark* found = nullptr;
  double distance = scaled(this, markReach);
  for (const EventMark& mark : marks) {
    const double away = std::abs(mark.x - x);
    if (away <= distance) {
      distance = away;
      found = &mark;
    }
  }
  return found;
}

const EventMark* TimelineStrip::markAt(QPointF at) {
  return marksRect().contains(at.toPoint()) ? nearest(marks(), at.x()) : nullptr;
}

QString TimelineStrip::tipAt(QPointF at) {
  if (branchRect().contains(at.toPoint())) {
    const auto clock = m_shown->clock();
    return QStringLiteral("Abandoned future, %1 to %2")
        .arg(momentText(m_future->begin(), 0, clock), momentText(m_future->end(), 0, clock));
  }
  if (rulesRect().contains(at.toPoint())) return rulesTip(at.x());
  if (rowAt(at) >= 0) return comparedTip(at);
  if (const auto handle = rangeHandle(); handle && handle->contains(at)) {
    return QStringLiteral("Time range of the plots. Drag to move it, drag an end to change it");
  }
  const EventMark* mark = markAt(at);
  if (mark == nullptr) return momentText(m_axis.time(at.x()), 1, m_shown->clock());
  QStringList lines;
  constexpr int most = 8;
  for (int row = mark->first; row <= mark->last && lines.size() < most; ++row) {
    const link::MatchEvent& e = m_shown->events()->at(row);
    if (!m_shown->filter().shows(e)) continue;
    lines << momentText(e.time, 2, m_shown->clock()) + QStringLiteral("  ") +
                 QString::fromStdString(sentenceOf(e)).toHtmlEscaped();
  }
  if (mark->merged > most)
    lines << QStringLiteral("and %1 more; zoom in to see them").arg(mark->merged - most);
  return QStringLiteral("<p style='white-space:pre'>") + lines.join(QStringLiteral("<br>")) +
         QStringLiteral("</p>");
}

bool TimelineStrip::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    auto* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), tipAt(help->pos()), this);
    return true;
  }
  return QWidget::event(event);
}

void TimelineStrip::resizeEvent(QResizeEvent*) {
  fitAxis();
  placeScrollBar();
}

namespace {

constexpr double edgeReach = 7.0;  // px of the mock: where an end of the handle is taken

}  // namespace

TimelineStrip::Grab TimelineStrip::grabAt(QPointF at, Qt::KeyboardModifiers keys) const {
  if (keys & Qt::ShiftModifier) return Grab::Range;
  if (const int row = rowAt(at); row >= 0) {
    return comparedChip(row).contains(at.toPoint()) ? Grab::Chip : Grab::Compared;
  }
  const auto handle = rangeHandle();
  if (!handle || !handle->adjusted(-1, 0, 1, 1).contains(at)) return Grab::Moment;
  const double end = scaled(this, edgeReach);
  if (at.x() < handle->left() + end) return Grab::WindowBegin;
  if (at.x() > handle->right() - end) return Grab::WindowEnd;
  return Grab::Window;
}

void TimelineStrip::showCursorAt(QPointF at, Qt::KeyboardModifiers keys) {
  switch (grabAt(at, keys)) {
    case Grab::WindowBegin:
    case Grab::WindowEnd:
      setCursor(Qt::SizeHorCursor);
      break;
    case Grab::Window:
      setCursor(Qt::OpenHandCursor);
      break;
    case Grab::Compared:
      setCursor(Qt::SizeHorCursor);
      break;
    case Grab::Chip:
      setCursor(Qt::PointingHandCursor);
      break;
    case Grab::Range:
      setCursor(Qt::IBeamCursor);
      break;
    default:
      setCursor(markAt(at) != nullptr ||
                        (rulesRect().contains(at.toPoint()) && !brokenAt(at.x()).empty())
                    ? Qt::PointingHandCursor
                    : Qt::ArrowCursor);
      break;
  }
}

void TimelineStrip::mousePressEvent(QMouseEvent* event) {
  m_pressedAt = event->position();
  m_dragged = false;
  m_grabTime = m_axis.time(m_pressedAt.x());
  if (event->button() == Qt::MiddleButton) {
    m_grab = Grab::View;
    m_grabRange = m_axis.shown;
    setCursor(Qt::ClosedHandCursor);
    return;
  }
  if (event->button() != Qt::LeftButton) return;
  m_grab = grabAt(m_pressedAt, event->modifiers());
  if (m_grab == Grab::Moment) {
    const EventMark* mark = markAt(m_pressedAt);
    const auto broken = rulesRect().contains(m_pressedAt.toPoint())
                            ? brokenAt(m_pressedAt.x())
                            : std::vector<const BrokenRule*>();
    m_shown->seek(!broken.empty()   ? broken.front()->from()
                  : mark != nullptr ? m_shown->events()->at(mark->row).time
                                    : m_grabTime);
  } else if (m_grab == Grab::Compared || m_grab == Grab::Chip) {
    m_grabRow = rowAt(m_pressedAt);
    m_grabOffset = m_compared[static_cast<std::size_t>(m_grabRow)].offset;
  } else if (m_grab != Grab::Range) {
    m_grabRange = m_plots->range();
    setCursor(m_grab == Grab::Window ? Qt::ClosedHandCursor : Qt::SizeHorCursor);
  }
}

void TimelineStrip::mouseMoveEvent(QMouseEvent* event) {
  const QPointF at = event->position();
  if (m_grab == Grab::Nothing) {
    showCursorAt(at, event->modifiers());
    return;
  }
  constexpr double still = 3.0;  // a trembling hand is not a drag
  if (!m_dragged && std::abs(at.x() - m_pressedAt.x()) < still) return;
  m_dragged = true;
  const double time = m_axis.time(at.x());
  const double by = time - m_grabTime;
  switch (m_grab) {
    case Grab::Moment:
      m_shown->seek(time);
      break;
    case Grab::Range:
      m_shown->setSelection({{std::min(m_grabTime, time), std::max(m_grabTime, time)}});
      break;
    case Grab::Window:
    case Grab::WindowBegin:
    case Grab::WindowEnd:
      moveWindow(by);
      break;
    case Grab::View: {
      const double pixels = at.x() - m_pressedAt.x();
      const double seconds = pixels * m_axis.secondsPerPixel();
      setShown({m_grabRange.begin - seconds, m_grabRange.end - seconds});
      break;
    }
    case Grab::Compared:
      if (m_grabRow < comparedRows()) emit comparedMoved(m_grabRow, m_grabOffset + by);
      break;
    case Grab::Chip:
    case Grab::Nothing:
      break;
  }
}

// An end that is dragged over the other one does not leave a range in which nothing can be seen.
void TimelineStrip::moveWindow(double by) {
  telemetry::TimeRange to = m_grabRange;
  const double span = to.end - to.begin;
  const double least = std::min(
      span,
      std::max(LinkedTime::minimumSpan, scaled(this, narrowestWindow) * m_axis.secondsPerPixel()));
  if (m_grab != Grab::WindowEnd) to.begin += by;
  if (m_grab != Grab::WindowBegin) to.end += by;
  if (m_grab == Grab::WindowBegin) to.begin = std::min(to.begin, to.end - least);
  if (m_grab == Grab::WindowEnd) to.end = std::max(to.end, to.begin + least);
  m_plots->setRange(to);
}

void TimelineStrip::mouseReleaseEvent(QMouseEvent* event) {
  const Grab grabbed = m_grab;
  m_grab = Grab::Nothing;
  if (!m_dragged && event->button() == Qt::LeftButton) {
    if (grabbed == Grab::Range) m_shown->setSelection({});
    if (grabbed == Grab::Compared) {
      const auto broken = comparedBrokenAt(m_pressedAt);
      m_shown->seek(broken.empty() ? m_grabTime : broken.front()->from());
    }
    if (grabbed == Grab::Chip && m_grabRow < comparedRows()) emit comparedToggled(m_grabRow);
  }
  showCursorAt(event->position(), event->modifiers());
}

void TimelineStrip::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const EventMark* mark = markAt(event->position())) {
    if (m_shown->events()->at(mark->row).kind == link::MatchEventKind::Bookmark)
      editNote(mark->row);
    return;
  }
  const auto handle = rangeHandle();
  if (handle && handle->contains(event->position())) return;
  if (event->position().y() > bandRect().bottom()) showAll();
}

void TimelineStrip::wheelEvent(QWheelEvent* event) {
  // Over their marks, rows that do not all fit are scrolled.
  const int row = rowAt(event->position());
  if (m_scroll->maximum() > 0 && row >= 0 &&
      comparedChip(row).left() <= event->position().toPoint().x()) {
    QApplication::sendEvent(m_scroll, event);
    return;
  }
  const QPoint angle = event->angleDelta();
  const bool sideways = angle.x() != 0 || (event->modifiers() & Qt::ShiftModifier);
  const double notches = (angle.y() != 0 ? angle.y() : angle.x()) / 120.0;
  if (sideways) {
    constexpr double part = 0.1;
    const double by = -notches * part * (m_axis.shown.end - m_axis.shown.begin);
    setShown({m_axis.shown.begin + by, m_axis.shown.end + by});
  } else {
    constexpr double perNotch = 1.2;
    zoom(std::pow(perNotch, -notches), m_axis.time(event->position().x()));
  }
  event->accept();
}

void TimelineStrip::contextMenuEvent(QContextMenuEvent* event) {
  const QPointF at = event->pos();
  if (const EventMark* mark = markAt(at)) {
    emit menuRequested(event->globalPos(), &m_shown->events()->at(mark->row), -1);
    return;
  }
  const int row = rowAt(at);
  const EventMark* mark = row >= 0 ? nearest(comparedMarks(row), at.x()) : nullptr;
  emit menuRequested(
      event->globalPos(),
      mark != nullptr ? &m_compared[static_cast<std::size_t>(row)].events->at(mark->row) : nullptr,
      row);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "lane_pane.h"

#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <limits>

#include <ui/base/quick_painting.h>
#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>

#include "time_gestures.h"

namespace pitchboard::ui {
namespace {

constexpr int nameHeight = 14;  // px of the mock
constexpr int laneHeight = 18;
constexpr int gap = 4;
constexpr int bareHeight = 13;  // of a lane without the bands of compared sessions
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void extend(std::vector<LaneStretch>& all, double begin, double end, double value, bool mixed) {
  if (!(end > begin)) return;
  if (!all.empty() && same(all.back().value, value) && all.back().mixed == mixed &&
      all.back().end >= begin) {
    all.back().end = end;
    return;
  }
  all.push_back({begin, end, value, mixed});
}

}  // namespace

std::vector<LaneStretch> laneStretches(const ColumnView& view, telemetry::TimeRange range,
                                       int columns) {
  std::vector<LaneStretch> all;
  const auto known = view ? view.group->range() : std::nullopt;
  if (!known || columns < 1 || known->end < range.begin || known->begin > range.end) return all;
  const double width = (range.end - range.begin) / columns;
  std::vector<telemetry::SeriesBucket> buckets(static_cast<std::size_t>(columns));
  view.group->buckets(view.column, range, buckets);
  const auto before = view.group->at(view.column, range.begin);
  double held = before ? before->value : unknown;
  double heldSince = before ? range.begin : known->begin;
  double last = before ? before->time : known->begin;
  const bool exact = view.group->hasEveryRow(range);
  std::vector<telemetry::Sample> inside;
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    const telemetry::SeriesBucket& bucket = buckets[i];
    if (bucket.samples == 0) continue;
    const double begin = range.begin + static_cast<double>(i) * width;
    if (begin - last > maxBridge) {
      extend(all, heldSince, last, held, false);
      held = unknown;
      heldSince = begin;
    }
    last = begin + width;
    const bool steady =
        same(bucket.first, bucket.last) && (std::isnan(bucket.last) || bucket.min == bucket.max);
    if (steady && same(bucket.last, held)) continue;
    // Where the change stands exactly is only worth a look when the column has few samples.
    inside.clear();
    constexpr std::size_t few = 64;
    if (exact && view.group->samples(view.column, {begin, begin + width}, inside, few) && !steady) {
      std::size_t changes = 0;
      for (const telemetry::Sample& sample : inside) {
        if (sample.time >= begin + width) break;
        if (same(sample.value, held)) continue;
        extend(all, heldSince, sample.time, held, false);
        held = sample.value;
        heldSince = sample.time;
        ++changes;
      }
      if (changes <= 2) continue;
    }
    extend(all, heldSince, inside.empty() ? begin : std::max(heldSince, inside.front().time), held,
           false);
    if (!steady) extend(all, std::max(heldSince, begin), begin + width, bucket.last, true);
    held = bucket.last;
    heldSince = steady && !inside.empty() ? std::max(begin, inside.front().time) : begin + width;
  }
  extend(all, heldSince, std::min(range.end, std::max(known->end, heldSince)), held, false);
  std::erase_if(all, [](const LaneStretch& stretch) { return std::isnan(stretch.value); });
  return all;
}

class LanePane::Lanes : public QWidget {
 public:
  explicit Lanes(LanePane* pane) : QWidget(pane), m_pane(pane) { setFocusPolicy(Qt::ClickFocus); }
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    m_pane->paintLanes(painter);
  }
  void resizeEvent(QResizeEvent*) override { m_pane->draw(); }
  bool event(QEvent* event) override {
    if (event->type() != QEvent::ToolTip) return QWidget::event(event);
    const auto* help = static_cast<QHelpEvent*>(event);
    const QString tip = m_pane->tipAt(help->pos());
    if (tip.isEmpty())
      QToolTip::hideText();
    else
      QToolTip::showText(help->globalPos(), tip, this);
    return true;
  }
  void contextMenuEvent(QContextMenuEvent* event) override {
    emit m_pane->menuRequested(m_pane->laneAt(event->pos().y()), event->globalPos());
  }

 private:
  LanePane* m_pane;
};

LanePane::LanePane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent)
    : PlotPane(feed, spec, parent), m_lanes(new Lanes(this)) {
  setSurface(m_lanes);
  m_gestures = new TimeGestures(m_lanes, feed->time(), [this] { return timeAxis(); });
  m_gestures->setHasValues(false);
  connect(m_gestures, &TimeGestures::pointed, this, &PlotPane::pointed);
  fitHeight();
}

QWidget* LanePane::surface() const {
  return m_lanes;
}
void LanePane::setBoxTool(bool on) {
  m_gestures->setBoxTool(on);
}

int LanePane::bandHigh() const {
  const std::size_t sessions = m_feed->compared().size();
  constexpr std::size_t few = 3, some = 8;
  return scaled(this, sessions <= few ? 5 : sessions <= some ? 4 : 3);
}

int LanePane::laneHigh() const {
  const int bands = static_cast<int>(m_feed->compared().size()) * bandHigh();
  return std::max(scaled(this, laneHeight), scaled(this, bareHeight) + bands);
}

int LanePane::rowHigh() const {
  return scaled(this, nameHeight) + laneHigh() + scaled(this, gap);
}

int LanePane::laneAt(double y) const {
  const int lane = static_cast<int>(y) / rowHigh();
  return lane < static_cast<int>(m_curves.size()) ? lane : -1;
}

void LanePane::fitHeight() {
  const int height = rowHigh() * std::max(1, static_cast<int>(m_curves.size()));
  if (height == minimumHeight() && height == maximumHeight()) return;
  setFixedHeight(height);
  emit leftChanged();
}

QList<QRect> LanePane::lineAreas() const {
  QList<QRect> all;
  const int name = scaled(this, nameHeight), height = laneHigh() + scaled(this, gap);
  for (int top = 0; top + name < surface()->height(); top += name + height) {
    all << QRect(0, top + name, surface()->width(), height);
  }
  return all;
}

void LanePane::draw() {
  fitHeight();
  const TimeAxis axis = timeAxis();
  const int columns = std::max(1, static_cast<int>(axis.width * devicePixelRatioF()));
  m_stretches.clear();
  for (const Curve& curve : m_curves) {
    m_stretches.push_back(laneStretches(curve.view(), axis.shown, columns));
  }
  m_comparedStretches.clear();
  for (const ComparedRows& session : m_feed->compared()) {
    for (const Curve& curve : m_curves) {
      std::vector<LaneStretch>& stretches = m_comparedStretches.emplace_back();
      const Curve::Compared* other = curve.compared(session);
      if (other == nullptr) continue;
      stretches = laneStretches(other->view, session.ownTime(axis.shown), columns);
      for (LaneStretch& stretch : stretches) {
        stretch.begin = std::max(stretch.begin + session.offset, session.from);
        stretch.end += session.offset;
      }
    }
  }
  m_lanes->update();
}

const std::vector<LaneStretch>& LanePane::comparedStretches(std::size_t lane,
                                                            std::size_t session) const {
  static const std::vector<LaneStretch> none;
  const std::size_t i = session * m_curves.size() + lane;
  return i < m_comparedStretches.size() ? m_comparedStretches[i] : none;
}

QString LanePane::tipAt(QPointF at) const {
  const int lane = laneAt(at.y());
  const auto& sessions = m_feed->compared();
  if (lane < 0 || sessions.empty()) return {};
  const double foot = (lane + 1) * rowHigh() - scaled(this, gap);
  const double above = foot - static_cast<double>(sessions.size()) * bandHigh();
  const double place = std::floor((at.y() - above) / bandHigh());
  if (place < 0.0 || place >= static_cast<double>(sessions.size())) return {};
  const auto index = static_cast<std::size_t>(place);
  QString tip = sessions[index].caption;
  if (!sessions[index].isFuture())
    tip.prepend(sessionMark(sessions[index].number) + QLatin1Char(' '));
  const double time = timeAxis().time(at.x());
  const Curve::Compared* curve = m_curves[static_cast<std::size_t>(lane)].compared(sessions[index]);
  const ColumnView view = curve != nullptr ? curve->view : ColumnView{};
  for (const LaneStretch& one : comparedStretches(static_cast<std::size_t>(lane), index)) {
    if (time < one.begin || time > one.end) continue;
    tip += QStringLiteral(": ") + (one.mixed ? QStringLiteral("changes often; zoom in to see it")
                                             : codeTextIn(view, one.value));
  }
  return tip;
}

void LanePane::paintLanes(QPainter& painter) const {
  const ThemeColors& colors = theme();
  const TimeAxis axis = timeAxis();
  painter.setFont(themeFont(TypeRole::Small));
  const double padding = scaled(this, 5);
  int y = 0;
  for (std::size_t i = 0; i < m_curves.size(); ++i) {
    const Curve& curve = m_curves[i];
    const QRectF name(axis.left, y, axis.width, scaled(this, nameHeight));
    if (isPointedOut(i)) painter.fillRect(name, colors.selectedRow);
    painter.setPen(curve.isFaulty()    ? colors.errorText
                   : curve.isWaiting() ? colors.disabledText
                                       : colors.text);
    QString text = curve.isWaiting() ? curve.note() : curve.name();
    drawTextLine(painter, name, Qt::AlignLeft | Qt::AlignVCenter, text);
    if (!curve.isWaiting()) {
      const double used = textLineWidth(painter.font(), text) + scaled(this, 8);
      painter.setPen(colors.secondaryText);
      if (m_feed->showsValues()) {
        drawTextLine(painter, name.adjusted(used, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter,
                     curve.valueTextAt(m_feed->time()->readAt()));
      }
      if (curve.view().group->isReading(axis.shown)) {
        drawTextLine(painter, name, Qt::AlignRight | Qt::AlignVCenter, QStringLiteral("reading…"));
      }
    }
    y += scaled(this, nameHeight);
    const double height = laneHigh();
    const auto sessions = static_cast<int>(m_feed->compared().size());
    const double own = sessions > 1 ? height - sessions * bandHigh() : height;
    painter.fillRect(QRectF(axis.left, y, axis.width, height), colors.alternateRow);
    if (i < m_stretches.size()) {
      for (const LaneStretch& stretch : m_stretches[i]) {
        const double from = std::max(axis.pixel(stretch.begin), axis.left);
        const double to = std::min(axis.pixel(stretch.end), axis.right());
        if (to <= from) continue;
        const QRectF box(from, y, to - from, own);
        const QString word = curve.codeText(stretch.value);
        painter.fillRect(box, laneColor(word, static_cast<int>(stretch.value)));
        if (stretch.mixed) {
          painter.fillRect(box, QBrush(colors.secondaryText, Qt::Dense5Pattern));
          continue;
        }
        // The line between neighbours: colours alone must not tell stretches apart.
        painter.fillRect(QRectF(from, y, 1.0, own), colors.view);
        const double room = box.width() - 2 * padding;
        // Dots alone say nothing.
        const QFontMetrics metrics = painter.fontMetrics();
        if (room < std::min(4 * metrics.averageCharWidth(), metrics.horizontalAdvance(word))) {
          continue;
        }
        painter.setPen(colors.text);
        drawTextLine(painter, box.adjusted(padding, 0, -padding, 0),
                     Qt::AlignLeft | Qt::AlignVCenter, word, Qt::ElideRight);
      }
    }
    paintCompared(painter, i, QRectF(axis.left, y, axis.width, height));
    y += static_cast<int>(height) + scaled(this, gap);
  }
}

// One band below the other at the foot of the lane, in the order of the sessions.
void LanePane::paintCompared(QPainter& painter, std::size_t lane, const QRectF& place) const {
  const ThemeColors& colors = theme();
  const TimeAxis axis = timeAxis();
  const auto& sessions = m_feed->compared();
  const double band = bandHigh(), chip = scaled(this, 4);
  double y = place.bottom() - static_cast<double>(sessions.size()) * band;
  for (std::size_t k = 0; k < sessions.size(); ++k, y += band) {
    if (!sessions[k].isFuture() && !sessions[k].isHidden) {
      painter.fillRect(QRectF(place.left() - chip - 2, y + 1, chip, band - 1),
                       sessionColor(sessions[k].number));
    }
    const Curve::Compared* curve = m_curves[lane].compared(sessions[k]);
    if (curve == nullptr || !curve->view) continue;
    for (const LaneStretch& stretch : comparedStretches(lane, k)) {
      const double from = std::max(axis.pixel(stretch.begin), axis.left);
      const double to = std::min(axis.pixel(stretch.end), axis.right());
      if (to <= from) continue;
      const QRectF box(from, y, to - from, band);
      painter.fillRect(box, colors.view);
      painter.fillRect(box.adjusted(1, 1, 0, 0), laneColor(codeTextIn(curve->view, stretch.value),
                                                           static_cast<int>(stretch.value)));
    }
  }
}

}  // namespace pitchboard::ui

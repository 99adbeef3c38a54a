// SPDX-License-Identifier: GPL-3.0-or-later
#include "lane_pane.h"

#include <QContextMenuEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>

#include "time_gestures.h"

namespace pitchboard::ui {
namespace {

constexpr int nameHeight = 14;  // px of the mock
constexpr int laneHeight = 18;
constexpr int gap = 4;
constexpr int comparedHeight = 5;  // at the foot of its lane
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

int LanePane::laneAt(double y) const {
  const int lane = static_cast<int>(y) / scaled(this, nameHeight + laneHeight + gap);
  return lane < static_cast<int>(m_curves.size()) ? lane : -1;
}

void LanePane::fitHeight() {
  const int height =
      scaled(this, nameHeight + laneHeight + gap) * std::max(1, static_cast<int>(m_curves.size()));
  if (height == minimumHeight() && height == maximumHeight()) return;
  setFixedHeight(height);
  emit leftChanged();
}

QList<QRect> LanePane::lineAreas() const {
  QList<QRect> all;
  const int name = scaled(this, nameHeight), height = scaled(this, laneHeight + gap);
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
  m_comparedStretches.clear();
  const double offset = m_feed->comparedOffset();
  for (Curve& curve : m_curves) {
    m_stretches.push_back(laneStretches(curve.view(), axis.shown, columns));
    m_comparedStretches.push_back(laneStretches(
        curve.compared(*m_feed), {axis.shown.begin - offset, axis.shown.end - offset}, columns));
    for (LaneStretch& stretch : m_comparedStretches.back()) {
      stretch.begin = std::max(stretch.begin + offset, m_feed->comparedFrom());
      stretch.end += offset;
    }
  }
  m_lanes->update();
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
    const double height = scaled(this, laneHeight);
    painter.fillRect(QRectF(axis.left, y, axis.width, height), colors.alternateRow);
    if (i < m_stretches.size()) {
      for (const LaneStretch& stretch : m_stretches[i]) {
        const double from = std::max(axis.pixel(stretch.begin), axis.left);
        const double to = std::min(axis.pixel(stretch.end), axis.right());
        if (to <= from) continue;
        const QRectF box(from, y, to - from, height);
        const QString word = curve.codeText(stretch.value);
        painter.fillRect(box, laneColor(word, static_cast<int>(stretch.value)));
        if (stretch.mixed) {
          painter.fillRect(box, QBrush(colors.secondaryText, Qt::Dense5Pattern));
          continue;
        }
        // The line between neighbours: colours alone must not tell stretches apart.
        painter.fillRect(QRectF(from, y, 1.0, height), colors.view);
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
    if (i < m_comparedStretches.size()) {
      const double band = scaled(this, comparedHeight);
      for (const LaneStretch& stretch : m_comparedStretches[i]) {
        const double from = std::max(axis.pixel(stretch.begin), axis.left);
        const double to = std::min(axis.pixel(stretch.end), axis.right());
        if (to <= from) continue;
        const QRectF box(from, y + height - band, to - from, band);
        painter.fillRect(box, colors.view);
        painter.fillRect(box.adjusted(1, 1, 0, 0),
                         laneColor(curve.codeText(stretch.value), static_cast<int>(stretch.value)));
      }
    }
    y += static_cast<int>(height) + scaled(this, gap);
  }
}

}  // namespace pitchboard::ui

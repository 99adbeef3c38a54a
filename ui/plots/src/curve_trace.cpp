// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_trace.h"

#include <QImage>
#include <QPaintEngine>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "curve.h"

namespace pitchboard::ui {
namespace {

using telemetry::Sample;
using telemetry::SeriesBucket;
using telemetry::TimeRange;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// A tall pixel column is filled; lower ones are corners of a smooth line.
constexpr double tall = 2.0;  // px
// Qt strokes a wide line as one area: its cost grows faster than its length.
constexpr qsizetype strokedAtOnce = 24;  // points
constexpr double widestUnjoined = 2.0;   // px; wider lines show whether they have joints
// Single samples get a dot only where dots do not run into each other.
constexpr double dotDistance = 6.0;  // px
// A curve whose samples are mostly farther apart is drawn as dots.
constexpr double slowSamples = 0.9;  // s
constexpr double heldOpacity = 0.55, bandOpacity = 0.35;
constexpr double heldDot = 2.5;  // px of the mock
// Far outside of the picture Qt's line clipping loses precision.
constexpr double farAway = 1e5;  // px

void note(CurveTrace& trace, double value) {
  if (!std::isfinite(value)) return;
  trace.low = trace.any ? std::min(trace.low, value) : value;
  trace.high = trace.any ? std::max(trace.high, value) : value;
  trace.any = true;
}

void takeSamples(CurveTrace& trace, const ColumnView& view, TimeRange range) {
  if (const auto before = view.group->at(view.column, range.begin);
      before && before->time < range.begin) {
    trace.samples.push_back(*before);
  }
  std::vector<Sample> inside;
  view.group->samples(view.column, range, inside);
  trace.samples.insert(trace.samples.end(), inside.begin(), inside.end());
  std::vector<Sample> after;
  const double next = std::nextafter(range.end, std::numeric_limits<double>::infinity());
  view.group->samples(view.column, {next, range.end + maxBridge}, after, 1);
  if (!after.empty()) trace.samples.push_back(after.front());
  for (const Sample& sample : inside) note(trace, sample.value);
  if (!trace.any) {
    // A value that holds through the whole range has no sample inside it.
    for (const Sample& sample : trace.samples) note(trace, sample.value);
  }
}

}  // namespace

namespace {

/// Most of the distances between neighbours are this long; 0 where there are no two.
double defaultDistance(const std::vector<Sample>& samples) {
  std::vector<double> distances;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double distance = samples[i].time - samples[i - 1].time;
    if (distance > 0.0 && distance <= maxBridge) distances.push_back(distance);
  }
  if (distances.empty()) return 0.0;
  const auto middle = distances.begin() + std::ssize(distances) / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace

CurveTrace traceOf(const ColumnView& view, TimeRange range, int columns, double now) {
  CurveTrace trace;
  if (!view || columns < 1) return trace;
  // Columns stand on whole multiples of their width: what scrolls does not shimmer.
  const double width = (range.end - range.begin) / columns;
  const double begin = (std::floor(range.begin / width) - 1.0) * width;
  const auto count = static_cast<std::size_t>(columns) + 3;
  std::vector<SeriesBucket> buckets(count);
  view.group->buckets(view.column, {begin, begin + static_cast<double>(count) * width}, buckets);
  std::size_t samples = 0;
  for (const SeriesBucket& bucket : buckets) samples += bucket.samples;
  // While rows are being read there is an envelope, which must not look like a curve.
  if (samples <= count && view.group->hasEveryRow(range)) {
    takeSamples(trace, view, range);
    trace.held = !view.isCoded() && defaultDistance(trace.samples) >= slowSamples;
    if (trace.held) trace.heldUntil = std::min(now, trace.samples.back().time + maxBridge);
    return trace;
  }
  trace.exact = false;
  trace.columnWidth = width;
  trace.coarse = !view.group->hasEveryRow(range);
  trace.reading = trace.coarse && view.group->isReading(range);
  trace.columns.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SeriesBucket& bucket = buckets[i];
    if (bucket.samples == 0) continue;
    const double time = begin + (static_cast<double>(i) + 0.5) * width;
    const bool empty =
        std::isnan(bucket.first) && std::isnan(bucket.last) && !(bucket.min < bucket.max);
    if (empty || !std::isfinite(bucket.min)) {
      trace.columns.push_back({time, nan, nan, nan, nan});
      continue;
    }
    trace.columns.push_back({time, bucket.first, bucket.min, bucket.max, bucket.last});
    note(trace, bucket.min);
    note(trace, bucket.max);
  }
  return trace;
}

namespace {

/// Whether the line is interrupted between two neighbouring samples or columns, which are
/// `distance` (s) apart. Columns are as wide as a pixel, so the silence between the samples in them
/// is certain to be as long as their distance less one width, however much time a pixel stands for.
bool isSilence(const CurveTrace& trace, double distance) {
  return distance - trace.columnWidth > maxBridge;
}

/// Round what the columns cover, at least a pixel wide and high: forth along the top, back below.
std::vector<QPolygonF> outlines(const CurveTrace& trace, const TimeAxis& time,
                                const ValueScale& values) {
  std::vector<QPolygonF> all;
  QPolygonF top, bottom;
  const double half = (time.pixel(trace.columnWidth) - time.pixel(0.0)) / 2;
  const auto end = [&] {
    if (top.isEmpty()) return;
    // A column covers all of its pixel, also the first and the last one.
    for (QPolygonF* edge : {&top, &bottom}) {
      const QPointF first = edge->first(), last = edge->last();
      edge->prepend(QPointF(first.x() - half, first.y()));
      *edge << QPointF(last.x() + half, last.y());
    }
    std::reverse(bottom.begin(), bottom.end());
    all.push_back(top + bottom);
    top.clear();
    bottom.clear();
  };
  double previous = nan;
  for (const CurveTrace::Column& column : trace.columns) {
    if (!std::isfinite(column.min) || isSilence(trace, column.time - previous)) end();
    previous = column.time;
    if (!std::isfinite(column.min)) continue;
    const double x = std::clamp(time.pixel(column.time), -farAway, farAway);
    const double high = std::clamp(values.toY(column.max), -farAway, farAway);
    const double low = std::clamp(values.toY(column.min), -farAway, farAway);
    const double more = std::max(0.0, 1.0 - (low - high)) / 2;
    top << QPointF(x, high - more);
    bottom << QPointF(x, low + more);
  }
  end();
  return all;
}

}  // namespace

std::vector<QPolygonF> polylines(const CurveTrace& trace, const TimeAxis& time,
                                 const ValueScale& values, bool steps) {
  std::vector<QPolygonF> lines;
  QPolygonF line;
  const auto end = [&] {
    if (!line.isEmpty()) lines.push_back(std::move(line));
    line = {};
  };
  const auto point = [&](double x, double value) {
    const double y = std::clamp(values.toY(value), -farAway, farAway);
    line << QPointF(std::clamp(x, -farAway, farAway), y);
  };
  double previous = nan;
  if (trace.held) steps = true;
  if (trace.exact) {
    for (const Sample& sample : trace.samples) {
      if (!std::isfinite(sample.value) || isSilence(trace, sample.time - previous)) end();
      previous = sample.time;
      if (!std::isfinite(sample.value)) continue;
      const double x = time.pixel(sample.time);
      if (steps && !line.isEmpty()) line << QPointF(x, line.last().y());
      point(x, sample.value);
    }
    if (trace.held && !line.isEmpty() && trace.heldUntil > previous) {
      line << QPointF(std::min(time.pixel(trace.heldUntil), farAway), line.last().y());
    }
    end();
    return lines;
  }
  if (trace.coarse) return outlines(trace, time, values);
  for (const CurveTrace::Column& column : trace.columns) {
    if (!std::isfinite(column.min) || isSilence(trace, column.time - previous)) end();
    previous = column.time;
    if (!std::isfinite(column.min)) continue;
    if (std::isnan(column.first)) end();
    const double x = time.pixel(column.time);
    if (std::abs(values.toY(column.min) - values.toY(column.max)) < tall) {
      point(x, (column.min + column.max) / 2);
    } else {
      const bool rising =
          std::isnan(column.first) || std::isnan(column.last) || column.first <= column.last;
      point(x, rising ? column.min : column.max);
      point(x, rising ? column.max : column.min);
    }
    if (std::isnan(column.last)) end();
  }
  end();
  return lines;
}

namespace {

/// Neighbouring points of a line.
using Stretch = std::span<const QPointF>;

/// The points of a line, ascending in x, that can be seen between two places; some more at both
/// sides, which the first and last to be seen are joined to.
Stretch visiblePart(const QPolygonF& line, double left, double right) {
  constexpr std::ptrdiff_t more = 4;
  const auto before = [](const QPointF& point, double x) { return point.x() < x; };
  const Stretch all(line.constData(), static_cast<std::size_t>(line.size()));
  const auto first = std::lower_bound(all.begin(), all.end(), left, before) - all.begin();
  const auto last = std::lower_bound(all.begin(), all.end(), right, before) - all.begin();
  const auto begin = std::max<std::ptrdiff_t>(first - more, 0);
  const auto end = std::min(last + more, std::ssize(all));
  return all.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
}

/// Columns are rectangles where they are tall, and a thin line where they are flat: both are fast.
void paintColumns(QPainter& painter, Stretch line, QList<QRectF>& rects) {
  const double pixel = 1.0 / painter.device()->devicePixelRatioF();
  QPolygonF flat;
  const auto draw = [&] {
    if (flat.size() > 1) painter.drawPolyline(flat);
    flat.clear();
  };
  double top = 0.0, bottom = 0.0;  // of the column before
  for (std::size_t i = 0; i < line.size(); ++i) {
    const QPointF& at = line[i];
    const bool first = i == 0;
    const bool column = i + 1 < line.size() && line[i + 1].x() == at.x();
    double y0 = at.y(), y1 = column ? line[++i].y() : at.y();
    if (y0 > y1) std::swap(y0, y1);
    // What leaves a gap to the column before reaches for it.
    const double from = first ? y0 : std::min(y0, bottom);
    const double to = first ? y1 : std::max(y1, top);
    if (to - from < tall) {
      flat << QPointF(at.x(), (y0 + y1) / 2);
    } else {
      // Rectangles side by side touch; only a flat stretch is led up to them.
      if (flat.size() > 1) flat << QPointF(at.x(), (y0 + y1) / 2);
      draw();
      const double x = std::floor(at.x() / pixel) * pixel;
      rects << QRectF(x, std::floor(from / pixel) * pixel, pixel,
                      std::ceil((to - from) / pixel) * pixel);
      flat << QPointF(at.x(), (y0 + y1) / 2);
    }
    top = y0;
    bottom = y1;
  }
  draw();
}

/// Fills rectangles on whole pixels. Qt's painter needs longer for a row of one pixel than for its
/// colour, and there are millions of rows.
void fillPixels(QImage& image, const QRect& within, const QTransform& toDevice,
                const QList<QRectF>& rects, QRgb color) {
  auto* const bits = reinterpret_cast<QRgb*>(image.bits());
  const qsizetype stride = image.bytesPerLine() / qsizetype{sizeof(QRgb)};
  const int right = within.x() + within.width(), bottom = within.y() + within.height();
  // Halves go one way, also those that are a little less by rounding: else there would be gaps.
  const auto whole = [](double at) { return std::floor(at + 0.501); };
  for (const QRectF& rect : rects) {
    const QRectF at = toDevice.mapRect(rect);
    const auto x0 = static_cast<int>(std::max<double>(whole(at.left()), within.x()));
    const auto x1 = static_cast<int>(std::min<double>(whole(at.right()), right));
    const auto y0 = static_cast<int>(std::max<double>(whole(at.top()), within.y()));
    const auto y1 = static_cast<int>(std::min<double>(whole(at.bottom()), bottom));
    for (int x = x0; x < x1; ++x) {
      QRgb* pixel = bits + y0 * stride + x;
      for (int y = y0; y < y1; ++y, pixel += stride) *pixel = color;
    }
  }
}

void paintRects(QPainter& painter, const QList<QRectF>& rects, const QColor& color) {
  const bool onImage = painter.paintEngine()->type() == QPaintEngine::Raster &&
                       painter.device()->devType() == QInternal::Image && color.alpha() == 255;
  if (auto* image = onImage ? static_cast<QImage*>(painter.device()) : nullptr;
      image != nullptr && (image->format() == QImage::Format_ARGB32_Premultiplied ||
                           image->format() == QImage::Format_RGB32)) {
    const QTransform toDevice = painter.deviceTransform();
    QRect within = image->rect();
    if (painter.hasClipping()) {
      within &= toDevice.mapRect(painter.clipBoundingRect()).toAlignedRect();
    }
    fillPixels(*image, within, toDevice, rects, color.rgba());
    return;
  }
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  painter.drawRects(rects);
  painter.restore();
}

/// Lines of their own cost the painter half as much as a line with joints, which at this width
/// nobody sees.
void paintNarrow(QPainter& painter, Stretch line) {
  QList<QLineF> pieces;
  pieces.reserve(std::ssize(line));
  for (std::size_t i = 0; i + 1 < line.size(); ++i) pieces << QLineF(line[i], line[i + 1]);
  painter.drawLines(pieces);
}

void paintWide(QPainter& painter, const QPolygonF& line, double left, double right) {
  for (qsizetype i = 0; i + 1 < line.size(); i += strokedAtOnce) {
    const qsizetype count = std::min(strokedAtOnce + 1, line.size() - i);
    if (line[i].x() > right || line[i + count - 1].x() < left) continue;
    painter.drawPolyline(line.constData() + i, static_cast<int>(count));
  }
}

}  // namespace

void paintTrace(QPainter& painter, const CurveTrace& trace, const std::vector<QPolygonF>& lines,
                const TimeAxis& time, const TraceLook& look) {
  const bool held = trace.held && look.style == CurveStyle::Line;
  const bool dots =
      held || look.style == CurveStyle::Points || look.style == CurveStyle::LineAndPoints;
  const double radius = held ? heldDot * look.pixel : std::max(1.8, look.width * 1.2);
  const QRectF clip = painter.hasClipping() ? painter.clipBoundingRect()
                                            : QRectF(-farAway, -farAway, 2 * farAway, 2 * farAway);
  const double reach = std::max(radius, look.width) + 2.0;
  const double left = clip.left() - reach, right = clip.right() + reach;
  painter.setRenderHint(QPainter::Antialiasing, true);
  painter.setBrush(Qt::NoBrush);
  if (trace.coarse) {
    QColor band = look.color;
    band.setAlphaF(static_cast<float>(bandOpacity));
    painter.setPen(Qt::NoPen);
    painter.setBrush(band);
    for (const QPolygonF& outline : lines) painter.drawPolygon(outline);
    return;
  }
  if (look.style != CurveStyle::Points || !trace.exact) {
    QColor ink = look.color;
    if (held) ink.setAlphaF(static_cast<float>(heldOpacity));
    const double width = held ? look.pixel : look.thin ? 0.0 : look.width;
    painter.setPen(QPen(ink, width, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin));
    QList<QRectF> rects;
    // Ends that lie on each other are seen where a line is pale, and when a file is looked at.
    const bool shapes = painter.paintEngine()->type() != QPaintEngine::Raster;
    for (const QPolygonF& line : lines) {
      if (held || (!look.thin && look.dash == 0 &&
                   (look.width > widestUnjoined || shapes || look.color.alpha() < 255))) {
        paintWide(painter, line, left, right);
        continue;
      }
      const Stretch part = visiblePart(line, left, right);
      if (look.dash > 0) {
        painter.drawLines(dashedLine(part, look.dash, look.pixel, time.pixel(0.0)));
        continue;
      }
      if (!look.thin) {
        paintNarrow(painter, part);
        continue;
      }
      if (!trace.exact)
        paintColumns(painter, part, rects);
      else
        painter.drawPolyline(part.data(), static_cast<int>(part.size()));
    }
    if (!rects.isEmpty()) paintRects(painter, rects, look.color);
  }
  const double distance = trace.samples.empty() ? 0.0 : time.width / double(trace.samples.size());
  painter.setPen(Qt::NoPen);
  painter.setBrush(look.color);
  for (const QPolygonF& line : lines) {
    const bool lonely = line.size() == 1;
    if (!lonely && !(dots && trace.exact)) continue;
    if (!lonely && look.style == CurveStyle::LineAndPoints && distance < dotDistance) continue;
    // Steps have a corner between two samples.
    const bool corners = trace.held || look.style == CurveStyle::Steps;
    const Stretch part = visiblePart(line, left, right);
    std::ptrdiff_t number = part.data() - line.constData();
    for (const QPointF& at : part) {
      if (!corners || number++ % 2 == 0) painter.drawEllipse(at, radius, radius);
    }
  }
}

}  // namespace pitchboard::ui

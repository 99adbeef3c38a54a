// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_marks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/elide_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

using Draw = void (*)(QPainter&, QPointF, double);

void polygon(QPainter& painter, QPointF c, double s, std::initializer_list<QPointF> corners) {
  QPolygonF shape;
  for (const QPointF& corner : corners) shape << c + corner * s;
  painter.drawPolygon(shape);
}

void outlined(QPainter& painter) {
  QPen pen = painter.pen();
  pen.setColor(painter.brush().color());
  pen.setStyle(Qt::SolidLine);
  pen.setWidthF(1.4);
  pen.setJoinStyle(Qt::MiterJoin);
  painter.setPen(pen);
  painter.setBrush(Qt::NoBrush);
}

void disc(QPainter& p, QPointF c, double s) {
  p.drawEllipse(c, s * 0.5, s * 0.5);
}
void ring(QPainter& p, QPointF c, double s) {
  outlined(p);
  p.drawEllipse(c, s * 0.42, s * 0.42);
}
void up(QPainter& p, QPointF c, double s) {
  polygon(p, c, s, {{-0.45, 0.42}, {0.45, 0.42}, {0.0, -0.42}});
}
void smallUp(QPainter& p, QPointF c, double s) {
  up(p, c + QPointF(0, s * 0.12), s * 0.78);
}
void down(QPainter& p, QPointF c, double s) {
  polygon(p, c, s, {{-0.45, -0.42}, {0.45, -0.42}, {0.0, 0.42}});
}
void hollowUp(QPainter& p, QPointF c, double s) {
  outlined(p);
  up(p, c, s * 0.9);
}
void hollowDown(QPainter& p, QPointF c, double s) {
  outlined(p);
  down(p, c, s * 0.9);
}
void square(QPainter& p, QPointF c, double s) {
  outlined(p);
  p.drawRect(QRectF(c.x() - s * 0.36, c.y() - s * 0.36, s * 0.72, s * 0.72));
}
void cross(QPainter& p, QPointF c, double s) {
  outlined(p);
  QPen pen = p.pen();
  pen.setWidthF(2.0);
  p.setPen(pen);
  const double d = s * 0.36;
  p.drawLine(c + QPointF(-d, -d), c + QPointF(d, d));
  p.drawLine(c + QPointF(-d, d), c + QPointF(d, -d));
}
void plus(QPainter& p, QPointF c, double s) {
  outlined(p);
  const double d = s * 0.42;
  p.drawLine(c + QPointF(-d, 0), c + QPointF(d, 0));
  p.drawLine(c + QPointF(0, -d), c + QPointF(0, d));
}
void diamond(QPainter& p, QPointF c, double s) {
  polygon(p, c, s, {{-0.45, 0}, {0, -0.45}, {0.45, 0}, {0, 0.45}});
}
void flag(QPainter& p, QPointF c, double s) {
  polygon(p, c, s, {{-0.36, -0.5}, {0.36, -0.5}, {0.36, 0.5}, {0.0, 0.2}, {-0.36, 0.5}});
}

struct Look {
  Draw draw;
  QColor ThemeColors::*color;
};
void nothing(QPainter&, QPointF, double) {}

// In the order of EventShape: no meaning rests on colour alone.
constexpr std::array<Look, link::eventShapeCount> looks{{
    {nothing, &ThemeColors::text},
    {disc, &ThemeColors::text},
    {smallUp, &ThemeColors::secondaryText},
    {down, &ThemeColors::warningText},
    {ring, &ThemeColors::secondaryText},
    {hollowDown, &ThemeColors::secondaryText},
    {square, &ThemeColors::secondaryText},
    {cross, &ThemeColors::errorText},
    {plus, &ThemeColors::secondaryText},
    {up, &ThemeColors::errorText},
    {hollowUp, &ThemeColors::secondaryText},
    {diamond, &ThemeColors::warningText},
    {flag, &ThemeColors::accentLine},
}};

constexpr int noteImportance = 1'000'000;

// Somebody wrote a note to read it again: no event takes its place.
int importanceOf(const link::MatchEvent& event) {
  const bool isNote = event.kind == link::MatchEventKind::Note ||
                      (event.kind == link::MatchEventKind::Bookmark && !event.detail.empty());
  return isNote ? noteImportance : link::info(event.kind).importance;
}

}  // namespace

QColor markColor(link::EventShape shape) {
  return theme().*looks[static_cast<std::size_t>(shape)].color;
}

void drawMark(QPainter& painter, link::EventShape shape, QPointF centre, double size) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(markColor(shape));
  looks[static_cast<std::size_t>(shape)].draw(painter, centre, size);
  painter.restore();
}

std::vector<EventMark> layOutMarks(const std::deque<link::MatchEvent>& events, const TimeAxis& axis,
                                   const MarkSizes& sizes, const QFontMetrics& font,
                                   const EventFilter& filter) {
  const auto before = [](const link::MatchEvent& event, double time) { return event.time < time; };
  const double margin = sizes.spacing * axis.secondsPerPixel();
  auto at = std::lower_bound(events.begin(), events.end(), axis.shown.begin - margin, before);
  const auto end = std::lower_bound(at, events.end(), axis.shown.end + margin, before);

  // One candidate a pixel: what follows costs the width, not the number of events.
  std::vector<EventMark> marks;
  for (; at != end; ++at) {
    if (!filter.shows(*at)) continue;
    const int row = static_cast<int>(at - events.begin());
    const double x = axis.pixel(at->time);
    if (!marks.empty() && std::floor(marks.back().x) == std::floor(x)) {
      EventMark& same = marks.back();
      same.last = row;
      ++same.merged;
      if (importanceOf(*at) > importanceOf(events[static_cast<std::size_t>(same.row)])) {
        same.row = row;
        same.x = x;
      }
      continue;
    }
    marks.push_back({x, row, row, row, 1, {}});
  }
  const auto importance = [&events](const EventMark& mark) {
    return importanceOf(events[static_cast<std::size_t>(mark.row)]);
  };
  // The more important one of two neighbours that overlap takes the other in, until none overlap.
  std::vector<EventMark> kept;
  for (EventMark& mark : marks) {
    const auto room = [&](const EventMark& left) {
      return importance(left) == noteImportance && importance(mark) < noteImportance
                 ? sizes.noteRoom
                 : sizes.spacing;
    };
    while (!kept.empty() && mark.x - kept.back().x < room(kept.back())) {
      EventMark& left = kept.back();
      if (importance(left) >= importance(mark)) {
        left.last = mark.last;
        left.merged += mark.merged;
        mark.merged = 0;
        break;
      }
      mark.first = left.first;
      mark.merged += left.merged;
      kept.pop_back();
    }
    if (mark.merged > 0) kept.push_back(std::move(mark));
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const QString predicate =
        QString::fromStdString(labelOf(events[static_cast<std::size_t>(kept[i].row)]));
    if (predicate.isEmpty()) continue;
    const double stop =
        i + 1 < kept.size() ? kept[i + 1].x - sizes.spacing * 0.6 : axis.left + axis.width;
    const int room = static_cast<int>(stop - kept[i].x - sizes.labelGap);
    constexpr int longest = 160;
    constexpr int shortest = 5;  // characters: less of a longer text says nothing
    const int wanted = std::min(font.horizontalAdvance(predicate), longest);
    // At the right edge there may be room on the other side only.
    if (i + 1 == kept.size() && wanted > room) {
      double begin = axis.left;
      if (i > 0) {
        const EventMark& neighbour = kept[i - 1];
        begin = neighbour.x + sizes.spacing * 0.6;
        if (!neighbour.label.isEmpty())
          begin += sizes.labelGap + font.horizontalAdvance(neighbour.label);
      }
      if (wanted <= kept[i].x - sizes.labelGap - begin) {
        kept[i].label = elideText(font, predicate, wanted + 1);
        kept[i].labelLeft = true;
        break;
      }
    }
    const QString shown = elideText(font, predicate, std::min(room, wanted + 1));
    if (room > 0 && (shown == predicate || shown.size() >= shortest)) kept[i].label = shown;
  }
  return kept;
}

}  // namespace pitchboard::ui

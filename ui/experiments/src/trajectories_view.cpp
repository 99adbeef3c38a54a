// SPDX-License-Identifier: GPL-3.0-or-later
#include "trajectories_view.h"

#include <QPainter>
#include <algorithm>

#include <ui/base/field_ground.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr double path_m = 0.03, ball_m = 0.02;
constexpr int faint = 60, plain = 150, strong = 255;

void paintTrajectory(QPainter& p, const std::vector<Point>& points, QColor colour, int alpha,
                     double width) {
  if (points.empty()) return;
  QPolygonF line;
  for (const Point& point : points) line << QPointF(point.x, point.y);
  colour.setAlpha(alpha);
  p.setPen(QPen(colour, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  p.setBrush(Qt::NoBrush);
  p.drawPolyline(line);
  p.setBrush(colour);
  p.setPen(Qt::NoPen);
  p.drawEllipse(line.last(), 2 * width, 2 * width);
}

/// What the colours mean, where the field leaves room.
void paintLegend(QPainter& p, const QRect& room) {
  const QFont font = themeFont(TypeRole::Secondary);
  p.setFont(font);
  const int line = QFontMetrics(font).height(), gap = line / 2;
  const std::pair<QColor, QString> entries[] = {
      {theme().blueTeam, QStringLiteral("robots, the run ended with a goal")},
      {theme().redTeam, QStringLiteral("robots, it ended otherwise")},
      {theme().ball, QStringLiteral("ball")}};
  int y = room.top() + gap;
  for (const auto& [colour, words] : entries) {
    p.fillRect(QRect(room.left() + gap, y + line / 2 - 1, 2 * line, 3), colour);
    p.setPen(theme().text);
    p.drawText(QRect(room.left() + 2 * gap + 2 * line, y, room.width(), line),
               Qt::AlignLeft | Qt::AlignVCenter, words);
    y += line + gap / 2;
  }
}

}  // namespace

TrajectoriesView::TrajectoriesView(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("experimentTrajectories"));
  setToolTip(QStringLiteral("Select one or more runs in Runs to highlight them."));
}

void TrajectoriesView::show(const PlayedPtr& played, std::size_t condition) {
  m_played = played;
  m_condition = condition;
  m_highlighted.clear();
  update();
}

void TrajectoriesView::highlight(std::vector<std::size_t> numbers) {
  m_highlighted = std::move(numbers);
  update();
}

void TrajectoriesView::paintEvent(QPaintEvent* /*event*/) {
  QPainter p(this);
  p.fillRect(rect(), theme().fieldBorder);
  if (!m_played || m_condition >= m_played->table.conditions.size()) return;
  const sim::FieldSpec& field =
      m_played->experiment.conditions[m_condition].scenario.settings.field;
  const double wide = 2 * (field.halfLength() + field.border);
  const double high = 2 * (field.halfWidth() + field.border);
  const double scale = std::min(width() / wide, height() / high);
  p.setRenderHint(QPainter::Antialiasing);
  p.save();
  p.translate(width() / 2.0, height() / 2.0);
  p.scale(scale, -scale);
  paintGround(p, field, field.lineWidth);
  p.setPen(QPen(theme().fieldLines, field.lineWidth));
  p.setBrush(Qt::NoBrush);
  for (const auto& goal : sim::fieldLines(field, field.lineWidth).goals) p.drawRect(rectOf(goal));
  const auto& runs = m_played->table.conditions[m_condition].drawn;
  const auto stands = [this](std::size_t number) {
    return std::find(m_highlighted.begin(), m_highlighted.end(), number) != m_highlighted.end();
  };
  const bool any =
      std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return stands(run.number); });
  for (const bool front : {false, true}) {
    for (const auto& run : runs) {
      if (stands(run.number) != front) continue;
      const int alpha = front ? strong : any ? faint : plain;
      for (const link::RunPath& path : run.paths) {
        const bool isBall = path.who == "ball";
        const QColor colour = isBall                  ? theme().ball
                              : run.endedBy == "goal" ? theme().blueTeam
                                                      : theme().redTeam;
        paintTrajectory(p, path.points, colour, alpha, isBall ? ball_m : path_m);
      }
    }
  }
  p.restore();
  paintLegend(p, rect());
}

}  // namespace pitchboard::ui

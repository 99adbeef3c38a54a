// SPDX-License-Identifier: GPL-3.0-or-later
#include "distribution_view.h"

#include <QAreaSeries>
#include <QChart>
#include <QChartView>
#include <QComboBox>
#include <QEvent>
#include <QGraphicsLayout>
#include <QLegend>
#include <QLegendMarker>
#include <QLineSeries>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QValueAxis>
#include <algorithm>
#include <limits>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr std::size_t bins = 30, mostConditions = 6;

QColor colourOf(std::size_t condition) {
  const ThemeColors& c = theme();
  const QColor colours[mostConditions] = {c.blueTeam,   c.orangeTeam, c.workingText,
                                          c.accentLine, c.redTeam,    c.yellowTeam};
  return colours[condition % mostConditions];
}

}  // namespace

DistributionView::DistributionView(QWidget* parent)
    : QWidget(parent), m_metric(new QComboBox(this)), m_chart(new QChart) {
  m_view = new QChartView(m_chart, this);
  m_view->setRenderHint(QPainter::Antialiasing);
  m_view->setFrameShape(QFrame::NoFrame);
  m_metric->setObjectName(QStringLiteral("experimentMetric"));
  m_metric->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  m_metric->setAccessibleName(QStringLiteral("Metric"));
  m_chart->setMargins({});
  m_chart->layout()->setContentsMargins(0, 0, 0, 0);
  m_chart->legend()->setAlignment(Qt::AlignRight);
  m_chart->setBackgroundRoundness(0);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(m_view, 1);
  connect(m_metric, &QComboBox::currentIndexChanged, this, [this] { draw(); });
  draw();
}

void DistributionView::show(const PlayedPtr& played) {
  m_played = played;
  const QString before = m_metric->currentText();
  {
    const QSignalBlocker blocker(m_metric);
    m_metric->clear();
    int usual = 0;
    if (played) {
      for (const std::size_t m : link::informativeMetrics(played->summary)) {
        const link::MetricInfo& metric = played->summary.metrics[m];
        if (!metric.rate) m_metric->addItem(QString::fromStdString(metric.title), qulonglong(m));
        if (metric.name == "walked_m") usual = m_metric->count() - 1;
      }
    }
    const int same = m_metric->findText(before);
    m_metric->setCurrentIndex(std::max({0, same >= 0 ? same : usual}));
  }
  draw();
}

QWidget* DistributionView::area() const {
  return m_view->viewport();
}

void DistributionView::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) draw();
}

void DistributionView::draw() {
  m_chart->removeAllSeries();
  for (QAbstractAxis* axis : m_chart->axes()) {
    m_chart->removeAxis(axis);
    delete axis;
  }
  m_chart->setBackgroundBrush(theme().view);
  m_chart->legend()->setLabelColor(theme().text);
  m_chart->legend()->setFont(themeFont(TypeRole::Secondary));
  if (!m_played || m_metric->currentIndex() < 0) return;
  const auto metric = static_cast<std::size_t>(m_metric->currentData().toULongLong());
  const link::ExperimentSummary& s = m_played->summary;
  double low = std::numeric_limits<double>::max(), high = -low, top = 0.0;
  for (const link::ConditionSummary& condition : s.conditions) {
    if (condition.metrics[metric].moments.count == 0) continue;
    low = std::min(low, condition.metrics[metric].least);
    high = std::max(high, condition.metrics[metric].most);
  }
  if (low > high) return;
  if (low == high) high = low + 1.0;
  for (std::size_t c = 0; c < std::min(s.conditions.size(), mostConditions); ++c) {
    const auto counts =
        link::histogram(m_played->table.conditions[c].columns[metric], low, high, bins);
    const double runs = std::max<double>(1.0, static_cast<double>(s.conditions[c].runs));
    auto* line = new QLineSeries;
    for (std::size_t b = 0; b < bins; ++b) {
      const double share = 100.0 * static_cast<double>(counts[b]) / runs;
      const double step = (high - low) / static_cast<double>(bins);
      line->append(low + step * static_cast<double>(b), share);
      line->append(low + step * static_cast<double>(b + 1), share);
      top = std::max(top, share);
    }
    auto* area = new QAreaSeries(line);
    line->setParent(area);
    QColor fill = colourOf(c);
    area->setPen(QPen(fill, 1.5));
    fill.setAlpha(40);
    area->setBrush(fill);
    area->setName(QString::fromStdString(s.conditions[c].name));
    m_chart->addSeries(area);
    for (QLegendMarker* marker : m_chart->legend()->markers(area)) {
      marker->setBrush(colourOf(c));
      marker->setPen(Qt::NoPen);
    }
  }
  const auto axis = [&](double from, double to, int ticks, const QString& title,
                        Qt::Alignment side) {
    auto* one = new QValueAxis;
    one->setRange(from, to);
    one->setTickCount(ticks);
    one->applyNiceNumbers();
    one->setTitleText(title);
    one->setTitleBrush(theme().secondaryText);
    one->setTitleFont(themeFont(TypeRole::Secondary));
    one->setLabelsColor(theme().secondaryText);
    one->setLabelsFont(themeFont(TypeRole::Secondary));
    one->setGridLineColor(theme().innerLine);
    one->setLinePenColor(theme().innerLine);
    one->setLabelFormat(QStringLiteral("%.4g"));
    m_chart->addAxis(one, side);
    for (QAbstractSeries* series : m_chart->series()) series->attachAxis(one);
  };
  const link::MetricInfo& info = s.metrics[metric];
  axis(low, high, 9,
       QString::fromStdString(info.unit.empty() ? info.title : info.title + ", " + info.unit),
       Qt::AlignBottom);
  axis(0.0, top * 1.05, 6, QStringLiteral("% of the runs"), Qt::AlignLeft);
}

}  // namespace pitchboard::ui

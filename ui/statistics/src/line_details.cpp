// SPDX-License-Identifier: GPL-3.0-or-later
#include "line_details.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QTabBar>
#include <QVBoxLayout>
#include <array>
#include <cmath>

#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>

#include "field_map.h"
#include "line_charts.h"
#include "statistics_text.h"

namespace pitchboard::ui {
namespace {

constexpr int linkDecimals = 2;

/// Where a value is drawn, in metres of the studio's frame.
struct PlaceFacts {
  const char* name;
  const char* x;
  const char* y;
};
constexpr std::array<PlaceFacts, 3> placeFacts{{{"true pose", "TRUE_X", "TRUE_Y"},
                                                {"believed pose", "BELIEF_X", "BELIEF_Y"},
                                                {"ball", "match.BALL_X", "match.BALL_Y"}}};

QLabel* textLabel(QWidget* parent, const char* name) {
  auto* label = new QLabel(parent);
  label->setObjectName(QLatin1String(name));
  label->setTextFormat(Qt::RichText);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);
  return label;
}

/// A line of a table of two columns.
QString tableLine(const QString& name, const QString& value) {
  return QStringLiteral("<tr><td style='color:%1; padding-right:12px'>%2</td><td>%3</td></tr>")
      .arg(theme().secondaryText.name(), name.toHtmlEscaped(), value);
}

/// A value and the link to its moment.
QString atMoment(const QString& value, double time, double offset,
                 const std::optional<QDateTime>& clock) {
  if (!std::isfinite(time)) return value.toHtmlEscaped();
  return QStringLiteral("%1 at <a style='color:%2' href='%3'>%4</a>")
      .arg(value.toHtmlEscaped(), theme().accentLine.name(),
           QString::number(time + offset, 'g', 15), momentText(time + offset, linkDecimals, clock));
}

QString figuresOf(const StatisticsRow& row, const std::optional<QDateTime>& clock) {
  const telemetry::CurveSummary& s = row.line.summary;
  const std::string& unit = row.line.unit;
  QString out = QStringLiteral("<table>");
  QString samples = countText(s.samples);
  if (s.missing > 0) {
    samples += QStringLiteral(", %1 unknown (known in %2 of the time)")
                   .arg(countText(s.missing), percentText(s.share));
  }
  out += tableLine(QStringLiteral("Samples"), samples);
  if (!row.line.isCode) {
    out +=
        tableLine(QStringLiteral("Effective"), shortValueText(std::round(s.effective * 10) / 10));
    out += tableLine(QStringLiteral("Mean"), shortValueText(s.mean, unit));
    out += tableLine(QStringLiteral("95 % of the mean"), intervalText(s.meanLow, s.meanHigh));
    out += tableLine(
        QStringLiteral("SD · RMS"),
        QStringLiteral("%1 · %2").arg(shortValueText(s.deviation), shortValueText(s.rms)));
    QStringList quantiles;
    for (const double quantile : s.quantiles) quantiles << shortValueText(quantile);
    out += tableLine(QStringLiteral("Percentiles 5, 25, 50, 75, 95"),
                     quantiles.join(QStringLiteral(" · ")));
    out += tableLine(QStringLiteral("Min"),
                     atMoment(shortValueText(s.least, unit), s.leastAt, row.offset, clock));
    out += tableLine(QStringLiteral("Max"),
                     atMoment(shortValueText(s.most, unit), s.mostAt, row.offset, clock));
  }
  return out + QStringLiteral("</table>");
}

QString comparisonOf(const StatisticsRow& row, const QString& against,
                     const std::optional<QDateTime>& clock) {
  const telemetry::CurveError& e = *row.line.error;
  const std::string& unit = row.line.unit;
  QString out = QStringLiteral("<b>Against %1</b><table>").arg(against.toHtmlEscaped());
  out += tableLine(QStringLiteral("Bias"),
                   QStringLiteral("%1 (%2)").arg(shortValueText(e.bias, unit),
                                                 intervalText(e.biasLow, e.biasHigh)));
  out += tableLine(QStringLiteral("RMS error"), shortValueText(e.rms, unit));
  out += tableLine(QStringLiteral("Largest error"),
                   atMoment(shortValueText(e.largest, unit), e.largestAt, row.offset, clock));
  out += tableLine(QStringLiteral("Samples"), countText(e.samples));
  if (row.line.correlation) {
    const telemetry::CurveCorrelation& c = *row.line.correlation;
    out += tableLine(QStringLiteral("Correlation"), shortValueText(c.atZero));
    out += tableLine(QStringLiteral("Delay"),
                     QStringLiteral("%1, correlation %2")
                         .arg(shortValueText(c.delay, "s"), shortValueText(c.coefficient)));
  } else {
    out += tableLine(QStringLiteral("Correlation"),
                     QStringLiteral("unknown: a curve does not vary, or has too few samples"));
  }
  return out + QStringLiteral("</table>");
}

/// What has to be said of a map, or why there is none.
QString mapNoteOf(const telemetry::StretchLine& line) {
  QString text;
  if (line.isCode) {
    text = QStringLiteral("No map: the values are codes, which have no mean.");
  } else if (!line.map) {
    text =
        QStringLiteral("This place is not known for %1.").arg(QString::fromStdString(line.robot));
  } else if (line.map->outside > 0) {
    text = QStringLiteral("%1 samples lie outside the field.").arg(countText(line.map->outside));
  }
  return QStringLiteral("<span style='color:%1'>%2</span>")
      .arg(theme().secondaryText.name(), text.toHtmlEscaped());
}

}  // namespace

LineDetails::LineDetails(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("statisticsDetails"));
  m_views = new QTabBar(this);
  m_views->setObjectName(QStringLiteral("statisticsViews"));
  m_views->setDrawBase(false);
  m_views->setExpanding(false);
  m_views->addTab(QStringLiteral("Numbers"));
  m_views->addTab(QStringLiteral("Field"));
  m_views->setTabToolTip(1, QStringLiteral("Mean value at each place on the field"));
  m_place = new QComboBox(this);
  m_place->setObjectName(QStringLiteral("statisticsPlace"));
  m_place->setAccessibleName(QStringLiteral("Place"));
  for (const PlaceFacts& facts : placeFacts) {
    m_place->addItem(QStringLiteral("by %1").arg(QString::fromUtf8(facts.name)));
  }
  auto* scroll = new QScrollArea(this);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* form = new QWidget(scroll);
  m_title = textLabel(this, "statisticsTitle");
  m_distribution = new DistributionChart(form);
  m_figures = textLabel(form, "statisticsFigures");
  m_error = textLabel(form, "statisticsComparison");
  m_delays = new DelayChart(form);
  m_map = new FieldMap(form);
  m_mapNote = textLabel(form, "statisticsMapNote");
  const int edge = scaled(this, 6);
  auto* column = new QVBoxLayout(form);
  column->setContentsMargins(edge, 0, edge, edge);
  column->setSpacing(scaled(this, 4));
  for (QWidget* part : std::initializer_list<QWidget*>{m_distribution, m_figures, m_error, m_delays,
                                                       m_map, m_mapNote}) {
    column->addWidget(part);
  }
  column->addStretch(1);
  scroll->setWidget(form);
  auto* head = new QHBoxLayout;
  head->setContentsMargins(edge, 0, edge, 0);
  head->addWidget(m_views);
  head->addStretch(1);
  head->addWidget(m_place);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(scaled(this, 4));
  m_title->setContentsMargins(edge, 0, edge, 0);
  all->addLayout(head);
  all->addWidget(m_title);
  all->addWidget(scroll, 1);
  for (QLabel* label : {m_figures, m_error}) {
    connect(label, &QLabel::linkActivated, this,
            [this](const QString& link) { emit momentClicked(link.toDouble()); });
  }
  connect(m_views, &QTabBar::currentChanged, this, [this] {
    write();
    emit placeChanged();
  });
  connect(m_place, &QComboBox::currentIndexChanged, this, &LineDetails::placeChanged);
  write();
}

bool LineDetails::showsMap() const {
  return m_views->currentIndex() == 1;
}

std::optional<std::pair<QString, QString>> LineDetails::place() const {
  if (!showsMap()) return {};
  const PlaceFacts& facts = placeFacts[static_cast<std::size_t>(m_place->currentIndex())];
  return std::pair(QString::fromUtf8(facts.x), QString::fromUtf8(facts.y));
}

QSize LineDetails::sizeHint() const {
  return {scaled(this, 300), scaled(this, 160)};
}

void LineDetails::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) write();
}

void LineDetails::show(const StatisticsRow* row, const QString& against,
                       const std::optional<QDateTime>& clock) {
  m_row = row != nullptr ? std::optional(*row) : std::nullopt;
  m_against = against;
  m_clock = clock;
  write();
}

void LineDetails::write() {
  const bool isKnown = m_row && !m_row->isMissing;
  const bool hasNumbers = isKnown && !showsMap();
  const bool isCompared = hasNumbers && m_row->line.error.has_value();
  m_place->setVisible(showsMap());
  m_figures->setVisible(hasNumbers);
  m_error->setVisible(isCompared);
  m_delays->setVisible(isCompared && m_row->line.correlation.has_value());
  m_distribution->setVisible(false);
  m_map->setVisible(isKnown && showsMap() && m_row->line.map.has_value());
  m_mapNote->setVisible(isKnown && showsMap());
  if (!isKnown) {
    m_title->setText(m_row ? QString::fromStdString(m_row->line.variable).toHtmlEscaped()
                           : QString());
    return;
  }
  const telemetry::StretchLine& line = m_row->line;
  m_title->setText(QStringLiteral("<b>%1</b> %2")
                       .arg(QString::fromStdString(line.robot).toHtmlEscaped(),
                            QString::fromStdString(line.variable).toHtmlEscaped()));
  if (showsMap()) {
    if (line.map) m_map->show(line.map, line.unit, m_field);
    m_mapNote->setText(mapNoteOf(line));
    return;
  }
  m_distribution->show(*m_row);
  m_figures->setText(figuresOf(*m_row, m_clock));
  if (isCompared) m_error->setText(comparisonOf(*m_row, m_against, m_clock));
  if (isCompared && line.correlation) m_delays->show(*line.correlation);
}

}  // namespace pitchboard::ui

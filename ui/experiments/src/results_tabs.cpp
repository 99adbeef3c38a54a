// SPDX-License-Identifier: GPL-3.0-or-later
#include "results_tabs.h"

#include <QAreaSeries>
#include <QChart>
#include <QChartView>
#include <QComboBox>
#include <QEvent>
#include <QGraphicsLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLegend>
#include <QLegendMarker>
#include <QLineSeries>
#include <QPainter>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QVBoxLayout>
#include <QValueAxis>
#include <QWidget>
#include <algorithm>
#include <limits>
#include <vector>

#include <telemetry/statistics/histogram.h>
#include <ui/base/field_ground.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>

#include "experiment_play.h"

namespace pitchboard::ui {

/// How a metric is distributed in each condition: shares of the runs in equal bins. UI thread.
class DistributionView : public QWidget {
 public:
  explicit DistributionView(QWidget* parent);
  void show(const PlayedPtr& played);
  /// Chooses the metric; stands where the owner puts it.
  QComboBox* chooser() const { return m_metric; }
  /// Where the chart is.
  QWidget* area() const;

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void draw();

  PlayedPtr m_played;
  QComboBox* m_metric;
  QChart* m_chart;
  QChartView* m_view;
};

namespace {

constexpr std::size_t bins = 30, maxConditions = 6;

QColor colourOf(std::size_t condition) {
  const ThemeColors& c = theme();
  const QColor colours[maxConditions] = {c.blueTeam,   c.orangeTeam, c.workingText,
                                         c.accentLine, c.redTeam,    c.yellowTeam};
  return colours[condition % maxConditions];
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
  for (std::size_t c = 0; c < std::min(s.conditions.size(), maxConditions); ++c) {
    const auto counts =
        telemetry::histogram(m_played->table.conditions[c].columns[metric], low, high, bins);
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

/// The ways of robots and ball on the field in the first runs of a condition, as the published
/// figure 5 shows them; of one run or of two to compare, when they are chosen. Metres. UI thread.
class TrajectoriesView : public QWidget {
 public:
  explicit TrajectoriesView(QWidget* parent);

  void show(const PlayedPtr& played, std::size_t condition);
  /// Runs that stand out; the others stay faint. Empty: all are alike.
  void highlight(std::vector<std::size_t> numbers);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  PlayedPtr m_played;
  std::size_t m_condition = 0;
  std::vector<std::size_t> m_highlighted;
};

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
      {theme().blueTeam, QStringLiteral("robots in runs with a goal")},
      {theme().redTeam, QStringLiteral("robots in other runs")},
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

ResultsTabs::ResultsTabs(bool compares, QWidget* parent)
    : QTabWidget(parent),
      m_compares(compares),
      m_seeRuns(new QPushButton(this)),
      m_condition(new QComboBox(this)),
      m_trajectories(new TrajectoriesView(this)),
      m_distribution(new DistributionView(this)) {
  setObjectName(QStringLiteral("experimentTabs"));
  setDocumentMode(true);
}

QTableView* ResultsTabs::addTable(ResultsModel::Kind kind, const QString& title,
                                  const QString& name) {
  auto* model = new ResultsModel(kind, this);
  auto* sorted = new QSortFilterProxyModel(this);
  sorted->setSourceModel(model);
  sorted->setSortRole(Qt::UserRole);
  auto* table = new QTableView(this);
  table->setObjectName(name);
  table->setModel(sorted);
  styleTable(table);
  table->setSortingEnabled(kind == ResultsModel::Kind::Runs);
  m_models.push_back(model);
  m_tables.push_back(table);
  addTab(table, title);
  cover(table->viewport(), name + QStringLiteral("Empty"));
  return table;
}

void ResultsTabs::addTabs() {
  using Kind = ResultsModel::Kind;
  addTable(Kind::Measured, QStringLiteral("Measured"), QStringLiteral("experimentMeasured"));
  addTable(Kind::Differences, QStringLiteral("Differences"),
           QStringLiteral("experimentDifferences"));
  addTable(Kind::Assertions, QStringLiteral("Assertions"), QStringLiteral("experimentAssertions"));
  m_runsTable = addTable(Kind::Runs, QStringLiteral("Runs"), QStringLiteral("experimentTable"));
  m_runsTable->sortByColumn(0, Qt::AscendingOrder);
  connect(m_runsTable, &QTableView::doubleClicked, this,
          [this](const QModelIndex& index) { emit asked({numberOf(index)}); });
  connect(m_runsTable->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    highlight();
    showChoices();
  });
  addTab(m_trajectories, QStringLiteral("Trajectories"));
  addTab(m_distribution, QStringLiteral("Distribution"));
  cover(m_trajectories, QStringLiteral("experimentTrajectoriesEmpty"));
  cover(m_distribution->area(), QStringLiteral("experimentDistributionEmpty"));
  makeCorner();
  connect(this, &QTabWidget::currentChanged, this, [this] { showChoices(); });
  showChoices();
  showPlaying(false);
}

void ResultsTabs::cover(QWidget* area, const QString& name) {
  auto* label = makeEmptyLabel(area, name);
  auto* layout = new QVBoxLayout(area);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(label);
  m_empty.push_back(label);
}

void ResultsTabs::showPlaying(bool playing) {
  if (m_shown) return;
  for (QLabel* label : m_empty) {
    label->setText(playing ? QStringLiteral("Playing the runs. Results appear here when all are "
                                            "done or when you press Cancel.")
                           : QStringLiteral("No results yet. Press Start to play the experiment."));
  }
}

/// Beside the tabs, because height is what field and chart lack.
void ResultsTabs::makeCorner() {
  m_condition->setObjectName(QStringLiteral("experimentCondition"));
  m_condition->setAccessibleName(QStringLiteral("Condition"));
  m_condition->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  connect(m_condition, &QComboBox::currentIndexChanged, this, [this](int index) {
    if (index < 0 || !m_shown) return;
    m_trajectories->show(m_shown, static_cast<std::size_t>(index));
    highlight();
  });
  m_seeRuns->setObjectName(QStringLiteral("experimentSeeRuns"));
  connect(m_seeRuns, &QPushButton::clicked, this, [this] { emit asked(chosenRuns()); });
  auto* choices = new QWidget(this);
  auto* row = new QHBoxLayout(choices);
  row->setContentsMargins(0, scaled(this, 2), scaled(this, 4), scaled(this, 2));
  row->addWidget(m_seeRuns);
  row->addWidget(m_condition);
  row->addWidget(m_distribution->chooser());
  setCornerWidget(choices);
}

std::size_t ResultsTabs::numberOf(const QModelIndex& index) const {
  const auto* proxy = static_cast<const QSortFilterProxyModel*>(m_runsTable->model());
  return m_models.back()->runNumber(proxy->mapToSource(index).row());
}

std::vector<std::size_t> ResultsTabs::chosenRuns() const {
  std::vector<std::size_t> numbers;
  for (const QModelIndex& index : m_runsTable->selectionModel()->selectedRows()) {
    numbers.push_back(numberOf(index));
  }
  return numbers;
}

void ResultsTabs::showChoices() {
  const bool runs = currentWidget() == m_runsTable && m_shown;
  const qsizetype chosen = runs ? m_runsTable->selectionModel()->selectedRows().size() : 0;
  const bool two = chosen == 2 && m_compares;
  m_seeRuns->setVisible(runs);
  m_seeRuns->setEnabled(chosen == 1 || two);
  m_seeRuns->setText(two ? QStringLiteral("Compare on the field")
                         : QStringLiteral("See in Replay"));
  m_seeRuns->setToolTip(m_compares
                            ? QStringLiteral("Choose one run, or two (Ctrl+click) to compare")
                            : QStringLiteral("Choose a run"));
  m_condition->setVisible(currentWidget() == m_trajectories && m_shown);
  m_distribution->chooser()->setVisible(currentWidget() == m_distribution && m_shown);
}

void ResultsTabs::highlight() {
  m_trajectories->highlight(chosenRuns());
}

void ResultsTabs::showResults(const PlayedPtr& played) {
  m_shown = played;
  for (ResultsModel* model : m_models) model->show(played);
  for (QTableView* table : m_tables) table->resizeColumnsToContents();
  m_condition->clear();
  for (const link::ConditionSummary& condition : played->summary.conditions) {
    m_condition->addItem(QString::fromStdString(condition.name));
  }
  m_distribution->show(played);
  for (QLabel* label : m_empty) label->setVisible(false);
  const auto showEmpty = [this](ResultsModel::Kind kind, const QString& words) {
    const auto table = static_cast<std::size_t>(kind);
    m_empty[table]->setText(words);
    m_empty[table]->setVisible(m_models[table]->rowCount() == 0);
  };
  showEmpty(ResultsModel::Kind::Differences,
            QStringLiteral("Nothing to compare: there is only one condition. Add \"conditions\", "
                           "\"grid\" or \"compare\" to the file."));
  showEmpty(ResultsModel::Kind::Assertions,
            QStringLiteral("No assertions. Add \"assertions\" to the file to make it a test, such "
                           "as \"goal_rate >= 0.5\"."));
  showEmpty(ResultsModel::Kind::Runs, QStringLiteral("No run has finished."));
  showChoices();
}

}  // namespace pitchboard::ui

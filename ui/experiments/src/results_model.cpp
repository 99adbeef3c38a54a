// SPDX-License-Identifier: GPL-3.0-or-later
#include "results_model.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr int fixedRunColumns = 5;
const QString minusSign = QStringLiteral("−"), nothing = QStringLiteral("–");

/// How a column of numbers is written, so that their decimal points stand beneath each other.
struct Form {
  bool isRate = false;
  int decimals = 0;
};

/// Four digits of the largest of these values; none behind the point if all are whole numbers.
Form formFor(std::initializer_list<double> values, bool isRate) {
  double largest = 0.0;
  bool isWhole = true;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    largest = std::max(largest, std::abs(value));
    isWhole = isWhole && value == std::floor(value);
  }
  constexpr int digits = 4, most = 6;
  const int before = largest > 0.0 ? static_cast<int>(std::floor(std::log10(largest))) + 1 : 1;
  return {isRate, isRate ? 1 : isWhole ? 0 : std::clamp(digits - before, 0, most)};
}

QString text(double value, const Form& form) {
  if (!std::isfinite(value)) return nothing;
  QString out = form.isRate
                    ? QString::number(100.0 * value, 'f', form.decimals) + QStringLiteral(" %")
                    : QString::number(value, 'f', form.decimals);
  return out.replace(QLatin1Char('-'), minusSign);
}

QString text(const std::optional<link::Interval>& interval, const Form& form) {
  if (!interval) return nothing;
  return QStringLiteral("%1 to %2").arg(text(interval->low, form), text(interval->high, form));
}

/// Of a test: more digits say nothing.
QString statistic(double value) {
  return std::isfinite(value) ? QString::number(value, 'f', 2).replace(QLatin1Char('-'), minusSign)
                              : nothing;
}

QString probability(double p) {
  return p < 0.001 ? QStringLiteral("< 0.001") : QString::number(p, 'f', 3);
}

QString title(const link::MetricInfo& metric) {
  const QString name = QString::fromStdString(metric.title);
  return metric.unit.empty() ? name
                             : name + QStringLiteral(", ") + QString::fromStdString(metric.unit);
}

QString qs(const std::string& text) {
  return QString::fromStdString(text);
}

}  // namespace

ResultsModel::ResultsModel(Kind kind, QObject* parent)
    : QAbstractTableModel(parent), m_kind(kind) {}

void ResultsModel::show(const PlayedPtr& played) {
  beginResetModel();
  m_played = played;
  m_heads.clear();
  m_rows.clear();
  m_runs.clear();
  m_metrics.clear();
  m_decimals.clear();
  if (played) fill();
  endResetModel();
}

void ResultsModel::fill() {
  const link::ExperimentSummary& s = m_played->summary;
  const std::vector<std::size_t> telling = link::informativeMetrics(s);
  switch (m_kind) {
    case Kind::Measured:
      m_heads = {"Metric",          "Condition", "n",      "Mean",
                 "95 % CI of mean", "SD",        "Median", "95th percentile"};
      for (const std::size_t m : telling) {
        for (const link::ConditionSummary& condition : s.conditions) {
          const link::Summary& one = condition.metrics[m];
          const bool isRate = s.metrics[m].rate;
          const Form form =
              formFor({one.moments.mean, one.moments.deviation, one.median, one.p95}, isRate);
          const auto plain = [&](double value) { return isRate ? nothing : text(value, form); };
          m_rows.append({title(s.metrics[m]), qs(condition.name),
                         QString::number(one.moments.count), text(one.moments.mean, form),
                         text(one.mean95, form), plain(one.moments.deviation), plain(one.median),
                         plain(one.p95)});
        }
      }
      break;
    case Kind::Differences:
      m_heads = {"Metric", "Of", "Minus", "Difference", "95 %", "Test", "p", "t", "Hedges' g"};
      for (const link::ConditionDifference& one : s.differences) {
        if (std::find(telling.begin(), telling.end(), one.metric) == telling.end()) continue;
        addComparison(s.metrics[one.metric], s.conditions[one.second].name,
                      s.conditions[one.first].name, one.comparison);
      }
      for (const link::GivenComparison& one : s.comparisons) {
        addComparison(s.metrics[one.metric], s.conditions[one.condition].name,
                      m_played->experiment.given[one.figure].name, one.comparison);
      }
      break;
    case Kind::Assertions:
      m_heads = {"Holds", "Condition", "Assertion", "Measured"};
      for (const link::CheckedAssertion& one : s.assertions) {
        m_rows.append({one.holds ? QStringLiteral("yes") : QStringLiteral("NO"), qs(one.condition),
                       qs(one.text), qs(one.values)});
      }
      break;
    case Kind::Runs:
      m_heads = {"Run", "Condition", "Seed", "Score", "Repeatable"};
      m_metrics = telling;
      for (const std::size_t m : m_metrics) {
        m_heads.append(title(s.metrics[m]));
        int decimals = 0;
        for (const auto& condition : m_played->table.conditions) {
          for (const double value : condition.columns[m]) {
            decimals = std::max(decimals, formFor({value}, false).decimals);
          }
        }
        m_decimals.push_back(decimals);
      }
      for (std::size_t number = 1; number <= m_played->experiment.allRuns(); ++number) {
        const link::RunPlace place = link::placeOf(m_played->experiment, number);
        if (m_played->table.conditions[place.condition].played[place.index])
          m_runs.push_back(number);
      }
      break;
  }
}

void ResultsModel::addComparison(const link::MetricInfo& metric, const std::string& of,
                                 const std::string& minus, const link::Comparison& one) {
  const bool tested = one.test != link::Comparison::Test::None;
  const Form form = formFor({one.difference}, metric.rate);
  m_rows.append({title(metric), qs(of), qs(minus), text(one.difference, form),
                 text(one.difference95, form), qs(one.testText()),
                 tested ? probability(one.p) : nothing,
                 one.welch ? statistic(one.welch->t) : nothing,
                 one.welch ? statistic(one.welch->hedgesG) : nothing});
}

std::size_t ResultsModel::runNumber(int row) const {
  return m_runs[static_cast<std::size_t>(row)];
}

int ResultsModel::rowCount(const QModelIndex& parent) const {
  if (parent.isValid()) return 0;
  return m_kind == Kind::Runs ? static_cast<int>(m_runs.size()) : static_cast<int>(m_rows.size());
}

int ResultsModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_heads.size());
}

QVariant ResultsModel::runCell(int row, int column, bool sorting) const {
  const std::size_t number = runNumber(row);
  const link::RunPlace place = link::placeOf(m_played->experiment, number);
  if (column == 0) return sorting ? QVariant(qulonglong(number)) : QString::number(number);
  if (column == 1) return qs(m_played->summary.conditions[place.condition].name);
  if (column == 2) {
    const qulonglong seed = link::seedOf(m_played->experiment, place);
    return sorting ? QVariant(seed) : QString::number(seed);
  }
  const auto& outcome = m_played->table.conditions[place.condition].outcomes[place.index];
  if (column == 3) {
    if (sorting) return outcome.goals - outcome.goalsAgainst;
    return QStringLiteral("%1 : %2").arg(outcome.goals).arg(outcome.goalsAgainst);
  }
  if (column == 4) return outcome.repeatable ? QStringLiteral("yes") : QStringLiteral("no");
  const auto index = static_cast<std::size_t>(column - fixedRunColumns);
  const std::size_t metric = m_metrics[index];
  const double value = m_played->table.conditions[place.condition].columns[metric][place.index];
  if (sorting) return std::isfinite(value) ? value : -1e300;
  return text(value, {false, m_decimals[index]});
}

bool ResultsModel::isNumeric(int column) const {
  switch (m_kind) {
    case Kind::Measured:
      return column >= 2;
    case Kind::Differences:
      return column >= 3 && column != 5;  // the test's name
    case Kind::Assertions:
      return false;
    case Kind::Runs:
      return column != 1 && column != 4;  // condition, repeatable
  }
  return false;
}

QVariant ResultsModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  if (role == Qt::DisplayRole || role == Qt::UserRole) {
    if (m_kind == Kind::Runs) return runCell(index.row(), index.column(), role == Qt::UserRole);
    return m_rows[index.row()][index.column()];
  }
  if (role == Qt::TextAlignmentRole) return headerData(index.column(), Qt::Horizontal, role);
  if (role == Qt::ForegroundRole && m_kind == Kind::Assertions && index.column() == 0 &&
      m_rows[index.row()][0] == QStringLiteral("NO")) {
    return theme().errorText;
  }
  if (role == Qt::ToolTipRole && m_kind == Kind::Runs) {
    return QStringLiteral("Double-click to view this run in Replay");
  }
  return {};
}

QVariant ResultsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section >= m_heads.size()) return {};
  // A column of numbers stands beneath its title.
  if (role == Qt::TextAlignmentRole && isNumeric(section)) {
    return static_cast<int>(Qt::AlignRight | Qt::AlignVCenter);
  }
  if (role != Qt::DisplayRole) return {};
  return m_heads[section];
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/robot_text.h>
#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>

#include "statistics_text.h"

namespace pitchboard::ui {
namespace {

using telemetry::StretchLine;

constexpr int momentDecimals = 2;

enum class ColumnUse { Always, Sessions, Comparison, Numbers, Codes };

struct ColumnFacts {
  const char* key;
  const char* title;
  const char* tip;
  ColumnUse use;
  bool isShownAtFirst;
  double (*number)(const StretchLine&);  // null: a text
};

double ofError(const StretchLine& line, double telemetry::CurveError::*member) {
  return line.error ? (*line.error).*member : std::nan("");
}
double ofCorrelation(const StretchLine& line, double telemetry::CurveCorrelation::*member) {
  return line.correlation ? (*line.correlation).*member : std::nan("");
}

// In the order of StatisticsModel::Column.
const std::array<ColumnFacts, StatisticsModel::columns> columnFacts{{
    {"session", "Session", "Recording or source of the rows", ColumnUse::Sessions, true, nullptr},
    {"robot", "Robot", "Robot whose value it is", ColumnUse::Always, true, nullptr},
    {"variable", "Variable", "Variable or expression", ColumnUse::Always, true, nullptr},
    {"unit", "Unit", "Unit of the values", ColumnUse::Always, true, nullptr},
    {"bias", "Bias", "Mean of this curve minus the other one", ColumnUse::Comparison, true,
     [](const StretchLine& l) { return ofError(l, &telemetry::CurveError::bias); }},
    {"bias_95", "95 % of the bias", "95 % confidence interval of the bias", ColumnUse::Comparison,
     false, [](const StretchLine& l) { return ofError(l, &telemetry::CurveError::biasLow); }},
    {"error_rms", "RMS error", "Root mean square of the difference", ColumnUse::Comparison, true,
     [](const StretchLine& l) { return ofError(l, &telemetry::CurveError::rms); }},
    {"largest_error", "Largest error", "Largest difference. Click to go there",
     ColumnUse::Comparison, true,
     [](const StretchLine& l) { return ofError(l, &telemetry::CurveError::largest); }},
    {"correlation", "Correlation", "Pearson's coefficient of both curves", ColumnUse::Comparison,
     true,
     [](const StretchLine& l) { return ofCorrelation(l, &telemetry::CurveCorrelation::atZero); }},
    {"delay", "Delay (s)", "How much later the other curve comes", ColumnUse::Comparison, true,
     [](const StretchLine& l) { return ofCorrelation(l, &telemetry::CurveCorrelation::delay); }},
    {"delayed_correlation", "Correlation at delay", "Pearson's coefficient at that delay",
     ColumnUse::Comparison, false,
     [](const StretchLine& l) {
       return ofCorrelation(l, &telemetry::CurveCorrelation::coefficient);
     }},
    {"mean", "Mean", "Mean of the known samples", ColumnUse::Numbers, true,
     [](const StretchLine& l) { return l.summary.mean; }},
    {"mean_95", "95 % of the mean",
     "95 % confidence interval of the mean, from the effective number of samples",
     ColumnUse::Numbers, true, [](const StretchLine& l) { return l.summary.meanLow; }},
    {"sd", "SD", "Standard deviation", ColumnUse::Numbers, true,
     [](const StretchLine& l) { return l.summary.deviation; }},
    {"rms", "RMS", "Root mean square", ColumnUse::Numbers, false,
     [](const StretchLine& l) { return l.summary.rms; }},
    {"min", "Min", "Smallest value. Click to go there", ColumnUse::Numbers, true,
     [](const StretchLine& l) { return l.summary.least; }},
    {"p05", "5th percentile", "5 % of the samples are below", ColumnUse::Numbers, false,
     [](const StretchLine& l) { return l.summary.quantiles[0]; }},
    {"p25", "25th percentile", "25 % of the samples are below", ColumnUse::Numbers, false,
     [](const StretchLine& l) { return l.summary.quantiles[1]; }},
    {"median", "Median", "Half of the samples are below", ColumnUse::Numbers, true,
     [](const StretchLine& l) { return l.summary.quantiles[2]; }},
    {"p75", "75th percentile", "75 % of the samples are below", ColumnUse::Numbers, false,
     [](const StretchLine& l) { return l.summary.quantiles[3]; }},
    {"p95", "95th percentile", "95 % of the samples are below", ColumnUse::Numbers, true,
     [](const StretchLine& l) { return l.summary.quantiles[4]; }},
    {"max", "Max", "Largest value. Click to go there", ColumnUse::Numbers, true,
     [](const StretchLine& l) { return l.summary.most; }},
    {"states", "States", "Share of the known time in each state", ColumnUse::Codes, true, nullptr},
    {"n", "Samples", "Known samples", ColumnUse::Always, true,
     [](const StretchLine& l) { return static_cast<double>(l.summary.samples); }},
    {"missing", "Unknown", "Samples without a known value", ColumnUse::Always, false,
     [](const StretchLine& l) { return static_cast<double>(l.summary.missing); }},
    {"n_effective", "Effective", "Independent samples that would say as much about the mean",
     ColumnUse::Numbers, true, [](const StretchLine& l) { return l.summary.effective; }},
    {"share", "Known", "Share of the time in which the value is known", ColumnUse::Always, false,
     [](const StretchLine& l) { return l.summary.share; }},
}};

const ColumnFacts& factsOf(int column) {
  return columnFacts[static_cast<std::size_t>(column)];
}

/// The moment of a cell, s of the session; nothing if it has none.
std::optional<double> momentOf(const StretchLine& line, int column) {
  const telemetry::CurveSummary& s = line.summary;
  double time = std::nan("");
  if (column == StatisticsModel::Min) time = s.leastAt;
  if (column == StatisticsModel::Max) time = s.mostAt;
  if (column == StatisticsModel::LargestError && line.error) time = line.error->largestAt;
  return std::isfinite(time) ? std::optional(time) : std::nullopt;
}

QString textOf(const StatisticsRow& row, int column) {
  const StretchLine& line = row.line;
  switch (column) {
    case StatisticsModel::Session:
      return row.number > 0 ? sessionMark(row.number) + QLatin1Char(' ') + sessionName(line.session)
                            : sessionName(line.session);
    case StatisticsModel::Robot:
      return QString::fromStdString(line.robot);
    case StatisticsModel::Variable:
      return QString::fromStdString(line.variable);
    case StatisticsModel::Unit:
      return QString::fromStdString(line.unit);
    case StatisticsModel::States:
      return statesText(row.states);
    case StatisticsModel::MeanInterval:
      return intervalText(line.summary.meanLow, line.summary.meanHigh);
    case StatisticsModel::BiasInterval:
      return line.error ? intervalText(line.error->biasLow, line.error->biasHigh)
                        : QStringLiteral("–");
    case StatisticsModel::Count:
      return countText(line.summary.samples);
    case StatisticsModel::Missing:
      return countText(line.summary.missing);
    case StatisticsModel::Known:
      return percentText(line.summary.share);
    case StatisticsModel::Effective:
      return std::isfinite(line.summary.effective) && line.summary.effective >= 10.0
                 ? countText(static_cast<qulonglong>(std::llround(line.summary.effective)))
                 : shortValueText(line.summary.effective);
    default:
      return shortValueText(factsOf(column).number(line));
  }
}

bool isSameRow(const StatisticsRow& a, const StatisticsRow& b) {
  return a.number == b.number && a.line.session == b.line.session && a.line.robot == b.line.robot &&
         a.line.variable == b.line.variable && a.isMissing == b.isMissing;
}

std::vector<StatisticsRow> rowsOf(const StretchResult* result, const QStringList& texts) {
  std::vector<StatisticsRow> rows;
  for (std::size_t i = 0; result != nullptr && i < result->lines.size(); ++i) {
    const StretchLine& line = result->lines[i];
    if (line.state && !rows.empty()) {
      rows.back().states.push_back(line);
    } else {
      rows.push_back({line, {}, result->offsets[i], result->numbers[i], false});
    }
  }
  for (const QString& text : texts) {
    const std::string name = text.toStdString();
    const bool isThere = std::ranges::any_of(
        rows, [&](const StatisticsRow& row) { return row.line.variable == name; });
    if (isThere) continue;
    StatisticsRow row{{}, {}, 0.0, 0, true};
    row.line.variable = name;
    row.line.summary = telemetry::summaryOf({}, {}, true);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

void StatisticsModel::show(const std::shared_ptr<const StretchResult>& result,
                           const QStringList& texts, const std::optional<QDateTime>& clock) {
  std::vector<StatisticsRow> rows = rowsOf(result.get(), texts);
  m_clock = clock;
  const bool isSame = std::ranges::equal(rows, m_rows, isSameRow);
  if (!isSame) beginResetModel();
  m_rows = std::move(rows);
  m_isCompared = result && result->isCompared;
  m_hasSessions = result && result->sessions > 1;
  m_hasCodes = std::ranges::any_of(m_rows, [](const auto& row) { return row.line.isCode; });
  m_hasNumbers = std::ranges::any_of(
      m_rows, [](const auto& row) { return !row.line.isCode && !row.isMissing; });
  if (!isSame) {
    endResetModel();
  } else if (!m_rows.empty()) {
    emit dataChanged(index(0, 0), index(rowCount() - 1, columns - 1));
  }
}

bool StatisticsModel::isUsed(int column) const {
  switch (factsOf(column).use) {
    case ColumnUse::Always:
      return true;
    case ColumnUse::Sessions:
      return m_hasSessions;
    case ColumnUse::Comparison:
      return m_isCompared && m_hasNumbers;
    case ColumnUse::Numbers:
      return m_hasNumbers;
    case ColumnUse::Codes:
      return m_hasCodes;
  }
  return true;
}

QString StatisticsModel::keyOf(int column) {
  return QString::fromLatin1(factsOf(column).key);
}

bool StatisticsModel::isShownAtFirst(int column) {
  return factsOf(column).isShownAtFirst;
}

QString StatisticsModel::spreadsheetText(const std::vector<int>& rows) const {
  const std::vector<telemetry::StretchColumn> numbers = telemetry::stretchColumns(m_isCompared);
  QStringList cells{QStringLiteral("session"), QStringLiteral("robot"), QStringLiteral("variable"),
                    QStringLiteral("unit"), QStringLiteral("label")};
  for (const auto& column : numbers) cells << QString::fromStdString(column.name);
  QString out = cells.join(QLatin1Char('\t')) + QLatin1Char('\n');
  const auto add = [&](const StretchLine& line) {
    cells.clear();
    for (const std::string* text :
         {&line.session, &line.robot, &line.variable, &line.unit, &line.label}) {
      cells << QString::fromStdString(*text).replace(QLatin1Char('\t'), QLatin1Char(' '));
    }
    for (const auto& column : numbers) {
      cells << QString::fromStdString(telemetry::stretchNumber(column.of(line)));
    }
    out += cells.join(QLatin1Char('\t')) + QLatin1Char('\n');
  };
  for (const int row : rows) {
    if (at(row).isMissing) continue;
    add(at(row).line);
    for (const StretchLine& state : at(row).states) add(state);
  }
  return out;
}

int StatisticsModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int StatisticsModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant StatisticsModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const StatisticsRow& row = at(index.row());
  const ColumnFacts& facts = factsOf(index.column());
  const auto moment = momentOf(row.line, index.column());
  switch (role) {
    case Qt::DisplayRole:
      if (row.isMissing && index.column() != Variable) return {};
      return textOf(row, index.column());
    case Qt::TextAlignmentRole:
      return QVariant((facts.number != nullptr ? Qt::AlignRight : Qt::AlignLeft) |
                      Qt::AlignVCenter);
    case Qt::DecorationRole:
      if (index.column() != Session || row.number == 0) return {};
      return sessionColor(row.number);
    case Qt::ForegroundRole:
      if (row.isMissing) return theme().errorText;
      if (moment) return theme().accentLine;
      return {};
    case Qt::ToolTipRole:
      if (row.isMissing) return QStringLiteral("No variable of this name here");
      if (moment) {
        return QStringLiteral("%1 at %2. Click to go there")
            .arg(shortValueText(facts.number(row.line), row.line.unit),
                 momentText(*moment + row.offset, momentDecimals, m_clock));
      }
      return textOf(row, index.column());
    case timeRole:
      return moment ? QVariant(*moment + row.offset) : QVariant();
    case sortRole:
      if (facts.number == nullptr) return textOf(row, index.column());
      return facts.number(row.line);
    default:
      return {};
  }
}

QVariant StatisticsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  const ColumnFacts& facts = factsOf(section);
  if (role == Qt::DisplayRole) return QString::fromUtf8(facts.title);
  if (role == Qt::ToolTipRole) return QString::fromUtf8(facts.tip);
  if (role == Qt::TextAlignmentRole) {
    return QVariant((facts.number != nullptr ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
  }
  return {};
}

bool StatisticsSort::lessThan(const QModelIndex& left, const QModelIndex& right) const {
  const QVariant a = left.data(StatisticsModel::sortRole),
                 b = right.data(StatisticsModel::sortRole);
  if (a.typeId() != QMetaType::Double || b.typeId() != QMetaType::Double) {
    return QString::localeAwareCompare(a.toString(), b.toString()) < 0;
  }
  const double x = a.toDouble(), y = b.toDouble();
  if (std::isnan(x) || std::isnan(y)) {
    // The proxy turns the result around for a descending order.
    return (sortOrder() == Qt::AscendingOrder) ? !std::isnan(x) : std::isnan(x) && !std::isnan(y);
  }
  return x < y;
}

}  // namespace pitchboard::ui

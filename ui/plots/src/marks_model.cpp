// SPDX-License-Identifier: GPL-3.0-or-later
#include "marks_model.h"

#include <algorithm>
#include <cmath>

#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/plots/axis_ticks.h>

namespace pitchboard::ui {
namespace {

constexpr std::array<const char*, MarksModel::columns> headings{"Curve", "A",   "B",   "Δ",  "mean",
                                                                "σ",     "min", "max", "RMS"};

bool sameNumber(std::optional<double> a, std::optional<double> b) {
  if (a.has_value() != b.has_value()) return false;
  return !a || *a == *b || (std::isnan(*a) && std::isnan(*b));
}

}  // namespace

bool MarksRow::operator==(const MarksRow& o) const {
  return name == o.name && session == o.session && unit == o.unit && color == o.color &&
         sameNumber(a, o.a) && sameNumber(b, o.b) && between.samples == o.between.samples &&
         between.mean == o.between.mean && between.min == o.between.min &&
         between.max == o.between.max && between.sigma == o.between.sigma &&
         between.rms == o.between.rms && between.reading == o.between.reading && aText == o.aText &&
         bText == o.bText;
}

namespace {

/// Values at both marks and between them; `measured`: over that instead.
void measure(MarksRow& row, const ColumnView& view, double a, double b,
             std::optional<telemetry::TimeRange> measured) {
  row.a = valueIn(view, a);
  row.b = valueIn(view, b);
  row.between = view.group->statistics(
      view.column, measured.value_or(telemetry::TimeRange{std::min(a, b), std::max(a, b)}));
  if (view.isCoded()) {
    if (row.a) row.aText = codeTextIn(view, *row.a);
    if (row.b) row.bText = codeTextIn(view, *row.b);
  }
}

}  // namespace

MarksRow marksRow(const Curve& curve, double a, double b,
                  std::optional<telemetry::TimeRange> measured) {
  MarksRow row;
  row.name = curve.name();
  row.unit = curve.unit();
  row.color = curve.color();
  if (!curve.isWaiting()) measure(row, curve.view(), a, b, measured);
  return row;
}

std::optional<MarksRow> marksRow(const Curve& curve, const ComparedRows& session, double a,
                                 double b, bool isWhole) {
  const Curve::Compared* other = curve.compared(session);
  if (session.isFuture() || other == nullptr || !other->view) return {};
  MarksRow row;
  row.name = curve.name() + sessionMark(session.number);
  row.unit = curve.unit();
  row.color = sessionColor(session.number);
  row.session = session.caption;
  measure(row, other->view, a - session.offset, b - session.offset,
          isWhole ? other->view.group->range() : std::nullopt);
  return row;
}

void MarksModel::setRows(QList<MarksRow> rows) {
  if (rows == m_rows) return;
  if (rows.size() != m_rows.size()) {
    beginResetModel();
    m_rows = std::move(rows);
    endResetModel();
    return;
  }
  m_rows = std::move(rows);
  if (!m_rows.isEmpty()) {
    emit dataChanged(index(0, 0), index(static_cast<int>(m_rows.size()) - 1, columns - 1));
  }
}

int MarksModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int MarksModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QString MarksModel::cell(const MarksRow& row, int column) const {
  QString none = QStringLiteral("–");
  const bool coded = !row.aText.isEmpty() || !row.bText.isEmpty();
  const auto number = [&none](std::optional<double> value) {
    return value ? valueText(*value) : none;
  };
  const auto between = [&](double value) {
    if (row.between.reading && !coded) return QStringLiteral("…");
    return row.between.samples > 0 && !coded ? valueText(value) : none;
  };
  switch (column) {
    case Name:
      return row.unit.isEmpty() ? row.name : QStringLiteral("%1 [%2]").arg(row.name, row.unit);
    case AtA:
      return coded && row.a ? row.aText : number(row.a);
    case AtB:
      return coded && row.b ? row.bText : number(row.b);
    case Delta: {
      if (!row.a || !row.b || coded) return none;
      const double delta = *row.b - *row.a;
      return delta > 0 ? QLatin1Char('+') + valueText(delta) : valueText(delta);
    }
    case Mean:
      return between(row.between.mean);
    case Sigma:
      return between(row.between.sigma);
    case Min:
      return between(row.between.min);
    case Max:
      return between(row.between.max);
    case Rms:
      return between(row.between.rms);
    default:
      return {};
  }
}

QVariant MarksModel::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) return {};
  const MarksRow& row = m_rows[index.row()];
  switch (role) {
    case Qt::DisplayRole:
      return cell(row, index.column());
    case Qt::ToolTipRole:
      if (index.column() == AtA || index.column() == AtB) return cell(row, index.column());
      if (index.column() != Name) return {};
      return QStringLiteral("%1: %2 samples between A and B%3")
          .arg(row.name)
          .arg(row.between.samples)
          .arg(row.session.isEmpty() ? QString() : QStringLiteral("\nSession: ") + row.session);
    case Qt::DecorationRole:
      return index.column() == Name ? QVariant(row.color) : QVariant();
    case Qt::TextAlignmentRole:
      return index.column() == Name ? int(Qt::AlignLeft | Qt::AlignVCenter)
                                    : int(Qt::AlignRight | Qt::AlignVCenter);
    case Qt::FontRole:
      return themeFont(TypeRole::Secondary);
    default:
      return {};
  }
}

QVariant MarksModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= columns) return {};
  if (role == Qt::DisplayRole)
    return QString::fromUtf8(headings[static_cast<std::size_t>(section)]);
  if (role == Qt::TextAlignmentRole) {
    return section == Name ? int(Qt::AlignLeft | Qt::AlignVCenter)
                           : int(Qt::AlignRight | Qt::AlignVCenter);
  }
  return {};
}

QString MarksModel::text() const {
  QStringList lines;
  QStringList cells;
  for (const char* heading : headings) cells << QString::fromUtf8(heading);
  lines << cells.join(QLatin1Char('\t'));
  for (const MarksRow& row : m_rows) {
    cells.clear();
    for (int column = 0; column < columns; ++column) cells << cell(row, column);
    lines << cells.join(QLatin1Char('\t'));
  }
  return lines.join(QLatin1Char('\n')) + QLatin1Char('\n');
}

}  // namespace pitchboard::ui

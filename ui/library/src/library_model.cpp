// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_model.h"

#include <algorithm>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

struct ColumnText {
  const char *title, *tip;
};
constexpr std::array<ColumnText, LibraryRow::columns> columnTexts{{
    {"Date", "When recording began"},
    {"Teams", "The team that defends the left goal at the end comes first"},
    {"Score", "At the end of the recording"},
    {"Length", "From the first sample to the last one"},
    {"Robots", "How many robots the session has"},
    {"Events", "Goals, kicks, falls and all other events, without bookmarks"},
    {"File", "Name of the recording"},
    {"Notes", "Texts of bookmarks, and what is wrong with the file"},
}};

bool isLess(const LibraryRow& a, const LibraryRow& b, int column) {
  const auto c = static_cast<std::size_t>(column);
  if (isSortedAsText(column)) return a.folded[c] < b.folded[c];
  return a.numbers[c] < b.numbers[c];
}

QString tipOf(const LibraryRow& row) {
  const link::SessionOverview& about = row.session.overview;
  QStringList lines{row.path};
  if (!about.title.empty()) lines << QString::fromStdString(about.title);
  QString robots;
  for (const std::string& robot : about.robots) {
    robots += (robots.isEmpty() ? QString() : QStringLiteral(", ")) + QString::fromStdString(robot);
  }
  if (!robots.isEmpty()) lines << robots;
  for (const std::string& note : about.notes) lines << QString::fromStdString(note);
  if (!about.problem.empty()) lines << QString::fromStdString(about.problem);
  constexpr qsizetype most = 20;
  if (lines.size() > most) lines = lines.mid(0, most) << QStringLiteral("…");
  return lines.join(QLatin1Char('\n'));
}

}  // namespace

void LibraryModel::show(const std::vector<LibraryRowPtr>& rows) {
  if (rows == m_rows) return;
  beginResetModel();
  m_rows = rows;
  m_places.clear();
  for (std::size_t i = 0; i < m_rows.size(); ++i) m_places[m_rows[i]->session.path] = i;
  arrange();
  endResetModel();
}

void LibraryModel::merge(const std::vector<LibraryRowPtr>& rows) {
  if (rows.empty()) return;
  beginResetModel();
  for (const LibraryRowPtr& row : rows) {
    const auto [known, isNew] = m_places.try_emplace(row->session.path, m_rows.size());
    if (isNew) {
      m_rows.push_back(row);
    } else {
      m_rows[known->second] = row;
    }
  }
  arrange();
  endResetModel();
}

void LibraryModel::setFilter(const QString& text) {
  QStringList words = text.toCaseFolded().split(QLatin1Char(' '), Qt::SkipEmptyParts);
  if (words == m_words) return;
  beginResetModel();
  m_words = std::move(words);
  arrange();
  endResetModel();
}

void LibraryModel::sort(int column, Qt::SortOrder order) {
  if (column < 0 || column >= LibraryRow::columns) return;
  beginResetModel();
  m_column = column;
  m_order = order;
  arrange();
  endResetModel();
}

void LibraryModel::arrange() {
  m_shown.clear();
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    const QString& text = m_rows[i]->searched;
    if (std::ranges::all_of(m_words, [&text](const QString& word) { return text.contains(word); }))
      m_shown.push_back(i);
  }
  const bool isDown = m_order == Qt::DescendingOrder;
  std::ranges::stable_sort(m_shown, [this, isDown](std::size_t a, std::size_t b) {
    return isDown ? isLess(*m_rows[b], *m_rows[a], m_column)
                  : isLess(*m_rows[a], *m_rows[b], m_column);
  });
}

void LibraryModel::changedPicture(const LibraryRowPtr& row) {
  const int at = rowOf(row->path);
  if (at >= 0) emit dataChanged(index(at, 0), index(at, 0), {Qt::DecorationRole});
}

int LibraryModel::rowOf(const QString& path) const {
  const auto known = m_places.find(path.toStdString());
  if (known == m_places.end()) return -1;
  const auto found = std::ranges::find(m_shown, known->second);
  return found == m_shown.end() ? -1 : static_cast<int>(found - m_shown.begin());
}

int LibraryModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_shown.size());
}

int LibraryModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : LibraryRow::columns;
}

QVariant LibraryModel::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) return {};
  const LibraryRowPtr& row = at(index.row());
  const auto column = static_cast<std::size_t>(index.column());
  switch (role) {
    case Qt::DisplayRole:
      return row->texts[column];
    case Qt::DecorationRole:
      return index.column() == LibraryRow::Date && m_picture ? pictureOf(row) : QVariant();
    case Qt::ToolTipRole:
      return tipOf(*row);
    case Qt::ForegroundRole:
      if (index.column() != LibraryRow::Notes || row->session.overview.problem.empty()) return {};
      return row->session.overview.isReadable ? theme().warningText : theme().errorText;
    case Qt::TextAlignmentRole: {
      const bool isNumber = !isSortedAsText(index.column()) && index.column() != LibraryRow::Date;
      return QVariant::fromValue((isNumber ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    }
    default:
      return {};
  }
}

QVariant LibraryModel::pictureOf(const LibraryRowPtr& row) const {
  const QPixmap picture = m_picture(row);
  return picture.isNull() ? m_blank : QIcon(picture);
}

QVariant LibraryModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= LibraryRow::columns) return {};
  const ColumnText& text = columnTexts[static_cast<std::size_t>(section)];
  if (role == Qt::DisplayRole) return QString::fromUtf8(text.title);
  if (role == Qt::ToolTipRole) return QString::fromUtf8(text.tip);
  if (role == Qt::TextAlignmentRole && !isSortedAsText(section) && section != LibraryRow::Date) {
    return QVariant::fromValue(Qt::AlignRight | Qt::AlignVCenter);
  }
  return {};
}

}  // namespace pitchboard::ui

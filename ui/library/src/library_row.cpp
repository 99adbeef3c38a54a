// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_row.h"

#include <QCryptographicHash>
#include <QDateTime>
#include <QFileInfo>
#include <QStringList>

#include <ui/base/robot_text.h>

namespace pitchboard::ui {
namespace {

QString textOf(const std::string& text) {
  return QString::fromStdString(text);
}

QString joined(const std::vector<std::string>& texts, const QString& between) {
  QStringList all;
  for (const std::string& text : texts) all << textOf(text).simplified();
  return all.join(between);
}

/// When it was recorded; of a file that does not say it, when that was written.
qint64 millisecondsOf(const link::IndexedSession& session) {
  const auto created = session.overview.created.time_since_epoch().count();
  return (created > 0 ? created : session.stamp.changed) / 1'000'000;
}

}  // namespace

LibraryRowPtr libraryRow(link::IndexedSession session) {
  auto row = std::make_shared<LibraryRow>();
  row->session = std::move(session);
  const link::SessionOverview& about = row->session.overview;
  row->path = textOf(row->session.path);
  const qint64 date = millisecondsOf(row->session);
  row->texts[LibraryRow::Date] =
      QDateTime::fromMSecsSinceEpoch(date).toString(QStringLiteral("yyyy-MM-dd HH:mm"));
  row->numbers[LibraryRow::Date] = static_cast<double>(date);
  row->texts[LibraryRow::File] = QFileInfo(row->path).fileName();
  QString notes = joined(about.notes, QStringLiteral(" · "));
  if (!about.problem.empty()) {
    notes = textOf(about.problem) + (notes.isEmpty() ? QString() : QLatin1Char(' ') + notes);
  }
  row->texts[LibraryRow::Notes] = notes;
  row->numbers[LibraryRow::Score] = row->numbers[LibraryRow::Length] =
      row->numbers[LibraryRow::Robots] = row->numbers[LibraryRow::Events] = -1.0;
  if (about.isReadable) {
    row->texts[LibraryRow::Teams] = textOf(teamsText(about));
    row->texts[LibraryRow::Score] = textOf(scoreText(about));
    if (about.score) {
      constexpr double most = 1000.0;  // goals
      row->numbers[LibraryRow::Score] = about.score->first * most + about.score->second;
    }
    row->texts[LibraryRow::Length] = clockText(about.length);
    row->numbers[LibraryRow::Length] = about.length;
    row->texts[LibraryRow::Robots] = QString::number(about.robots.size());
    row->numbers[LibraryRow::Robots] = static_cast<double>(about.robots.size());
    row->texts[LibraryRow::Events] = countText(about.events);
    row->numbers[LibraryRow::Events] = static_cast<double>(about.events);
  }
  for (int column = 0; column < LibraryRow::columns; ++column) {
    const auto c = static_cast<std::size_t>(column);
    if (isSortedAsText(column)) row->folded[c] = row->texts[c].toCaseFolded();
    row->searched += row->texts[c] + QLatin1Char('\n');
  }
  row->searched += joined(about.robots, QStringLiteral("\n")) + QLatin1Char('\n') +
                   textOf(about.title) + QLatin1Char('\n') + row->path;
  row->searched = row->searched.toCaseFolded();
  return row;
}

QString pictureName(const link::IndexedSession& session, bool isDark) {
  const std::string key = session.path + '\n' + std::to_string(session.stamp.bytes) + ' ' +
                          std::to_string(session.stamp.changed) + (isDark ? " dark" : " light");
  return QString::fromLatin1(
             QCryptographicHash::hash(QByteArray::fromStdString(key), QCryptographicHash::Sha1)
                 .toHex()) +
         QStringLiteral(".png");
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "plays_model.h"

#include <algorithm>

#include <ui/base/robot_text.h>
#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>

namespace pitchboard::ui {

PlayWords wordsOf(const std::vector<link::PlayEvent>& plays) {
  PlayWords words;
  words.reserve(plays.size());
  for (const link::PlayEvent& play : plays) {
    PlayText& text = words.emplace_back();
    text.columns = {
        capitalised(labelOf(play.kind)),
        play.name.empty() ? capitalised(info(play.team).name) : QString::fromStdString(play.name),
        QString::fromStdString(sentenceOf(play))};
    for (const QString& one : text.columns) text.folded += one.toCaseFolded() + QLatin1Char('\n');
  }
  return words;
}

void PlaysModel::show(std::vector<SessionPlays> sessions, const std::optional<QDateTime>& clock) {
  for (SessionPlays& one : sessions) {
    if (one.words.size() != one.plays.size()) one.words = wordsOf(one.plays);
  }
  if (sessions == m_sessions && clock == m_clock) return;  // keeps the selection
  beginResetModel();
  m_sessions = std::move(sessions);
  m_clock = clock;
  m_rows.clear();
  for (std::size_t session = 0; session < m_sessions.size(); ++session) {
    for (std::size_t i = 0; i < m_sessions[session].plays.size(); ++i)
      m_rows.push_back({session, i});
  }
  endResetModel();
}

const SessionPlays& PlaysModel::sessionOf(int row) const {
  return m_sessions[m_rows[static_cast<std::size_t>(row)].first];
}

const link::PlayEvent& PlaysModel::at(int row) const {
  return sessionOf(row).plays[m_rows[static_cast<std::size_t>(row)].second];
}

int PlaysModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int PlaysModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QString PlaysModel::textOf(int row, int column) const {
  return column == Time ? momentText(timeOf(row), 1, m_clock) : wordOf(row, column);
}

const PlayText& PlaysModel::playText(int row) const {
  return sessionOf(row).words[m_rows[static_cast<std::size_t>(row)].second];
}

const QString& PlaysModel::wordOf(int row, int column) const {
  return column == Session ? sessionOf(row).name
                           : playText(row).columns[static_cast<std::size_t>(column - Kind)];
}

bool PlaysModel::contains(int row, const QString& folded) const {
  return playText(row).folded.contains(folded) ||
         sessionOf(row).name.contains(folded, Qt::CaseInsensitive);
}

QVariant PlaysModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const int row = index.row();
  const link::PlayEvent& play = at(row);
  if (role == Qt::DisplayRole) return textOf(row, index.column());
  if (role == sortRole) {
    return index.column() == Time ? QVariant(timeOf(row)) : QVariant(textOf(row, index.column()));
  }
  if (role == Qt::DecorationRole && index.column() == Session && sessionOf(row).number > 0) {
    return sessionColor(sessionOf(row).number);
  }
  if (role == Qt::ToolTipRole && play.sigma > 0.0) {
    return QStringLiteral("Robots report places here to about ±%1 m")
        .arg(QString::number(play.sigma, 'f', 2));
  }
  if (role == Qt::ForegroundRole && index.column() == Time) return theme().secondaryText;
  return {};
}

QVariant PlaysModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  const QString names[] = {QStringLiteral("Time"), QStringLiteral("Session"),
                           QStringLiteral("Kind"), QStringLiteral("Robot"), QStringLiteral("What")};
  return section >= 0 && section < columns ? names[section] : QVariant();
}

bool PlaysFilter::filterAcceptsRow(int row, const QModelIndex& /*parent*/) const {
  const auto* model = static_cast<const PlaysModel*>(sourceModel());
  const link::PlayEvent& play = model->at(row);
  if (m_session && model->sessionOf(row).id != *m_session) return false;
  if (m_kind && play.kind != *m_kind) return false;
  if (m_team && play.team != *m_team) return false;
  if (!m_robot.empty() && play.name != m_robot && play.otherName != m_robot) return false;
  return std::ranges::all_of(words(), [&](const QString& word) {
    return model->contains(row, word) ||
           (isNumeric(word) && model->textOf(row, PlaysModel::Time).contains(word));
  });
}

// Without a QVariant for each comparison.
bool PlaysFilter::lessThan(const QModelIndex& a, const QModelIndex& b) const {
  const auto& model = *static_cast<const PlaysModel*>(sourceModel());
  if (a.column() == PlaysModel::Time) return model.timeOf(a.row()) < model.timeOf(b.row());
  return model.isBefore(a.row(), b.row(), a.column());
}

}  // namespace pitchboard::ui

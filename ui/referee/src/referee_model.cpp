// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_model.h"

#include <algorithm>

#include <ui/base/referee_text.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

// When the controllers call a robot good, late and offline, s.
constexpr double goodUntil = 2.0, lateUntil = 4.0;

QString cardsOf(const GamePlayer& player) {
  QStringList cards;
  const auto add = [&cards](int count, const QString& one, const QString& many) {
    if (count == 1) cards << one;
    if (count > 1) cards << many.arg(count);
  };
  add(player.warnings, QStringLiteral("warning"), QStringLiteral("%1 warnings"));
  add(player.cautions, QStringLiteral("caution"), QStringLiteral("%1 cautions"));
  add(player.yellow, QStringLiteral("yellow"), QStringLiteral("%1 yellow"));
  add(player.red, QStringLiteral("red"), QStringLiteral("%1 red"));
  return cards.join(QStringLiteral(", "));
}

}  // namespace

RefereeModel::Row RefereeModel::rowOf(int shirt, const GamePlayer& player, int secondsLeft,
                                      const link::RobotReplyView* reply) const {
  Row row;
  row.number = shirt;
  const bool waits = player.penalty == PenaltyKind::Substitute;
  row.penalised = player.penalty != PenaltyKind::None && !waits;
  row.texts[Player] = QString::number(shirt);
  if (player.goalkeeper) {
    row.texts[Player] += m_compact ? QStringLiteral(" GK") : QStringLiteral(" (goal)");
  }
  row.texts[State] = row.penalised || waits ? labelText(player.penalty) : QStringLiteral("plays");
  if (row.penalised) row.texts[Left] = durationText(secondsLeft);
  row.texts[Cards] = cardsOf(player);
  row.stateTip = row.texts[State];
  if (m_compact) {
    if (row.penalised) row.texts[State] = penaltyTag({player.penalty, secondsLeft});
    if (!row.texts[Cards].isEmpty()) {
      row.texts[State] += QStringLiteral(" · ") + row.texts[Cards];
      row.stateTip += QStringLiteral(" · ") + row.texts[Cards];
    }
  }
  if (reply == nullptr) return row;
  row.offline = reply->age > lateUntil;
  row.texts[Robot] = row.offline              ? QStringLiteral("offline")
                     : reply->age > goodUntil ? QStringLiteral("late")
                     : reply->fallen          ? QStringLiteral("fallen")
                                              : QStringLiteral("good");
  QStringList tip{QStringLiteral("%1 reported to the referee %2 ago:")
                      .arg(QString::fromStdString(reply->address), durationText(reply->age, 1)),
                  reply->fallen ? QStringLiteral("it has fallen") : QStringLiteral("it stands")};
  if (reply->pose) {
    tip << QStringLiteral("at %1, %2 m, %3 rad (in its own frame)")
               .arg(numberText(reply->pose->position.x, 2), numberText(reply->pose->position.y, 2),
                    numberText(reply->pose->yaw, 2));
  }
  tip << (reply->ballAge ? QStringLiteral("ball seen %1 ago").arg(durationText(*reply->ballAge, 1))
                         : QStringLiteral("no ball seen"));
  row.tip = tip.join(QLatin1Char('\n'));
  return row;
}

void RefereeModel::update(const link::MatchFrame& frame, const GameTeam& team,
                          const std::vector<int>& shirts) {
  const auto& replies = frame.reception.replies;
  std::vector<Row> rows;
  for (const int shirt : shirts) {
    const GamePlayer& player = *team.player(shirt);
    const auto reply = std::find_if(
        replies.begin(), replies.end(),
        [&](const link::RobotReplyView& r) { return r.team == team.number && r.player == shirt; });
    rows.push_back(rowOf(shirt, player, frame.game->penaltySeconds(player),
                         reply == replies.end() ? nullptr : &*reply));
  }
  // Penalised robots come first in the list.
  std::stable_sort(rows.begin(), rows.end(), [this](const Row& a, const Row& b) {
    return !m_compact && a.penalised != b.penalised ? a.penalised : a.number < b.number;
  });
  const bool same = std::equal(rows.begin(), rows.end(), m_rows.begin(), m_rows.end(),
                               [](const Row& a, const Row& b) { return a.number == b.number; });
  if (!same) beginResetModel();
  const bool changed = rows != m_rows;
  m_rows = std::move(rows);
  if (!same) {
    endResetModel();
  } else if (changed) {
    emit dataChanged(index(0, 0), index(rowCount() - 1, columns - 1));
  }
}

int RefereeModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int RefereeModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant RefereeModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const Row& row = m_rows[static_cast<std::size_t>(index.row())];
  switch (role) {
    case Qt::DisplayRole:
      return row.texts[static_cast<std::size_t>(index.column())];
    case numberRole:
      return row.number;
    case Qt::ToolTipRole:
      return index.column() == Robot   ? row.tip
             : index.column() == State ? row.stateTip
                                       : row.texts[static_cast<std::size_t>(index.column())];
    case Qt::ForegroundRole:
      if (index.column() == Robot && row.offline) return theme().errorText;
      if (index.column() == Robot && row.texts[Robot] != QStringLiteral("good")) {
        return theme().warningText;
      }
      if (row.penalised && index.column() != Robot) return theme().warningText;
      return {};
    default:
      return {};
  }
}

QVariant RefereeModel::headerData(int section, Qt::Orientation orientation, int role) const {
  // A hidden header takes room, too: that of its text.
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole || m_compact) return {};
  const QString names[] = {QStringLiteral("Player"), QStringLiteral("State"),
                           QStringLiteral("Left"), QStringLiteral("Cards"),
                           QStringLiteral("Robot")};
  return section >= 0 && section < columns ? names[section] : QVariant();
}

}  // namespace pitchboard::ui

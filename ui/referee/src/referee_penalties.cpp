// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_penalties.h"

#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include <ui/base/robot_words.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "referee_buttons.h"
#include "referee_orders.h"

namespace pitchboard::ui {
namespace {

using sim::CallKind;
using sim::PenaltyKind;

enum Column { Robot, Penalty, Seconds, Cards, columns };
constexpr const char* chosenTip = "The robots chosen in the table";

/// "1 warning, yellow".
QString cardsOf(const link::RefereeView& view, const sim::RobotIdentity& robot) {
  for (const link::RefereeTeamView& team : view.teams) {
    if (team.colour != info(robot.team).name) continue;
    for (const link::RefereePlayerView& player : team.players) {
      if (player.number != robot.number) continue;
      QStringList cards;
      if (player.warnings > 0) cards << QStringLiteral("warned");
      if (player.yellow > 0) cards << QStringLiteral("yellow");
      if (player.red > 0) cards << QStringLiteral("red");
      return cards.join(QStringLiteral(", "));
    }
  }
  return {};
}

}  // namespace

RefereePenalties::RefereePenalties(MatchController* match, QWidget* parent)
    : QWidget(parent), m_match(match) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(scaled(this, 4));
  column->addWidget(makeRefereeHeading(QStringLiteral("Penalties and cards"), this));
  m_kind = new QComboBox(this);
  m_kind->setObjectName(QStringLiteral("refereePenalty"));
  for (int i = 1; i <= static_cast<int>(lastOf(PenaltyKind{})); ++i) {
    const auto kind = static_cast<PenaltyKind>(i);
    // These have buttons of their own.
    if (kind == PenaltyKind::SentOff || kind == PenaltyKind::Substitute) continue;
    m_kind->addItem(asLabel(wordsOf(kind)), i);
  }
  m_kind->setCurrentIndex(m_kind->findData(static_cast<int>(PenaltyKind::Incapable)));
  const QString tip = QString::fromUtf8(chosenTip);
  auto* row = new QHBoxLayout;
  row->addWidget(m_kind, 1);
  row->addWidget(makeRefereeButton(
      this, QStringLiteral("Penalise"), tip,
      [this] {
        callForChosen({.kind = CallKind::Penalise,
                       .penalty = static_cast<PenaltyKind>(m_kind->currentData().toInt())},
                      QStringLiteral("penalty"));
      },
      QKeySequence(QStringLiteral("Ctrl+Alt+A"))));
  row->addWidget(makeRefereeButton(
      this, QStringLiteral("Pardon"), tip,
      [this] { callForChosen({.kind = CallKind::Pardon}, QStringLiteral("pardon")); },
      QKeySequence(QStringLiteral("Ctrl+Alt+E"))));
  column->addLayout(row);

  auto* grid = new QGridLayout;
  grid->setSpacing(scaled(this, 4));
  const struct {
    const char *text, *tip, *key;
    int value;
  } cards[] = {{"Warn", "Two warnings are a yellow card", "Ctrl+Alt+W", 0},
               {"Yellow", "Two yellow cards are a red one", "Ctrl+Alt+Y", 1},
               {"Red", "Sent off: it does not come back", "Ctrl+Alt+Z", 2}};
  int place = 0;
  for (const auto& card : cards) {
    const QString words = QString::fromUtf8(card.text).toLower() + QStringLiteral(" card");
    const auto pressed = [this, value = card.value, words] {
      callForChosen({.kind = CallKind::Card, .value = value},
                    value == 0 ? QStringLiteral("warning") : words);
    };
    grid->addWidget(
        makeRefereeButton(this, QString::fromUtf8(card.text), QString::fromUtf8(card.tip), pressed,
                          QKeySequence(QString::fromUtf8(card.key))),
        0, place++);
  }
  grid->addWidget(
      makeRefereeButton(
          this, QStringLiteral("Take off"),
          QStringLiteral("Off the field as a substitute; Pardon lets it, or another, come on"),
          [this] {
            callForChosen({.kind = CallKind::Penalise, .penalty = PenaltyKind::Substitute},
                          QStringLiteral("substitution"));
          },
          QKeySequence(QStringLiteral("Ctrl+Alt+U"))),
      0, place);
  column->addLayout(grid);

  m_robots = new QTableWidget(0, columns, this);
  m_robots->setObjectName(QStringLiteral("refereeRobots"));
  m_robots->setHorizontalHeaderLabels({QStringLiteral("Robot"), QStringLiteral("Penalty"),
                                       QStringLiteral("Seconds"), QStringLiteral("Cards")});
  m_robots->verticalHeader()->hide();
  m_robots->horizontalHeader()->setSectionResizeMode(Penalty, QHeaderView::Stretch);
  m_robots->setColumnWidth(Robot, scaled(this, 56));
  m_robots->setColumnWidth(Seconds, scaled(this, 64));
  m_robots->setColumnWidth(Cards, scaled(this, 96));
  m_robots->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_robots->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_robots->setMinimumHeight(scaled(this, 120));
  column->addWidget(m_robots);
}

std::vector<RobotId> RefereePenalties::chosen() const {
  std::vector<RobotId> robots;
  for (const QModelIndex& index : m_robots->selectionModel()->selectedRows()) {
    robots.push_back(RobotId{m_robots->item(index.row(), Robot)->data(Qt::UserRole).toInt()});
  }
  return robots;
}

void RefereePenalties::callForChosen(const sim::RefereeCall& call, const QString& words) {
  const std::vector<RobotId> robots = chosen();
  if (robots.empty()) return;
  MatchEdits* edits = m_match->edits();
  edits->performTogether(words, [&] {
    for (const RobotId robot : robots) {
      sim::RefereeCall one = call;
      one.robot = robot;
      callReferee(edits, one, words);
    }
  });
}

void RefereePenalties::show(const link::MatchFrame* frame) {
  m_robots->setRowCount(frame ? static_cast<int>(frame->robots.size()) : 0);
  for (int row = 0; row < m_robots->rowCount(); ++row) {
    const link::RobotFrame& robot = frame->robots[static_cast<std::size_t>(row)];
    cell(row, Robot, robotName(robot))->setData(Qt::UserRole, robot.slot().value);
    cell(row, Penalty, robot.penalty ? QString::fromStdString(robot.penalty->words) : QString());
    cell(row, Seconds, robot.penalty ? QString::number(robot.penalty->secondsLeft) : QString());
    cell(row, Cards, cardsOf(*frame->referee, robot.identity));
  }
}

QTableWidgetItem* RefereePenalties::cell(int row, int column, const QString& text) {
  QTableWidgetItem* item = m_robots->item(row, column);
  if (item == nullptr) {
    item = new QTableWidgetItem;
    m_robots->setItem(row, column, item);
  }
  if (item->text() != text) item->setText(text);
  return item;
}

}  // namespace pitchboard::ui

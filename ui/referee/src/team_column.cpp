// SPDX-License-Identifier: GPL-3.0-or-later
#include "team_column.h"

#include <QGridLayout>
#include <QHeaderView>
#include <QVBoxLayout>
#include <algorithm>

#include <ui/base/referee_text.h>
#include <ui/base/table_style.h>
#include <ui/sources/referee_calls.h>

#include "next_steps.h"
#include "referee_model.h"

namespace pitchboard::ui {

using sim::CallKind;

TeamColumn::TeamColumn(bool right, Call called, QWidget* parent)
    : QWidget(parent),
      m_right(right),
      m_called(std::move(called)),
      m_square(new QLabel(this)),
      m_name(new QLabel(this)),
      m_score(new QLabel(this)),
      m_buttons(new QWidget(this)),
      m_model(new RefereeModel(this)),
      m_table(new QTableView(this)) {
  const int gap = scaled(this, 4);
  m_square->setFixedSize(scaled(this, 10), scaled(this, 10));
  m_name->setObjectName(right ? QStringLiteral("refereeRight") : QStringLiteral("refereeLeft"));
  m_name->setFont(themeFont(TypeRole::Body, true));
  m_name->setMinimumWidth(1);
  m_score->setFont(themeFont(TypeRole::Score));
  auto* head = new QHBoxLayout;
  head->setSpacing(gap);
  head->addWidget(m_square);
  head->addWidget(m_name, 1);
  head->addWidget(m_score);
  auto* grid = new QGridLayout(m_buttons);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(gap);
  add("Goal", "A goal for this team", {.kind = CallKind::Goal, .value = 1});
  add("−1", "Takes back a goal of this team", {.kind = CallKind::Goal, .value = -1});
  add("Kick-off", "This team has the next kick-off", {.kind = CallKind::KickOff});
  add("Timeout", "In INITIAL, READY and SET", {.kind = CallKind::Timeout});
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(gap);
  column->addLayout(head);
  column->addWidget(m_buttons);
  column->addWidget(m_table, 1);

  m_table->setObjectName(right ? QStringLiteral("refereeRightPlayers")
                               : QStringLiteral("refereeLeftPlayers"));
  m_table->setModel(m_model);
  styleTable(m_table);
  m_table->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);
  m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
  m_table->verticalHeader()->setMinimumSectionSize(scaled(this, 18));
  m_table->verticalHeader()->setDefaultSectionSize(scaled(this, 18));
  QHeaderView* header = m_table->horizontalHeader();
  header->setStretchLastSection(false);
  header->setMinimumSectionSize(scaled(this, 18));
  header->setSectionResizeMode(QHeaderView::ResizeToContents);
  header->setSectionResizeMode(RefereeModel::State, QHeaderView::Stretch);
}

void TeamColumn::add(const char* name, const char* tip, const sim::RefereeCall& call) {
  const int at = static_cast<int>(m_calls.size());
  const QString text = QString::fromUtf8(name);
  auto* button = new QPushButton(text, m_buttons);
  button->setObjectName(QStringLiteral("referee %1 %2")
                            .arg(text, m_right ? QStringLiteral("right") : QStringLiteral("left")));
  button->setMinimumWidth(scaled(this, 40));
  connect(button, &QPushButton::clicked, this, [this, at, text] {
    sim::RefereeCall made = m_calls[static_cast<std::size_t>(at)].call;
    made.team = m_team;
    m_called(made, made.value < 0 ? QStringLiteral("goal taken back") : text.toLower());
  });
  static_cast<QGridLayout*>(m_buttons->layout())->addWidget(button, at / 2, at % 2);
  m_calls.push_back({button, call, QString::fromUtf8(tip)});
}

void TeamColumn::show(const link::MatchFrame& frame, bool refereed) {
  const Game& game = *frame.game;
  const GameTeam& team = game.teamAt(m_right);
  m_team = static_cast<int>(m_right ? 1 - game.leftTeam() : game.leftTeam());
  std::vector<int> shirts = team.onField();
  if (refereed) {
    // Everybody whom a person can call, also substitutes.
    shirts.clear();
    for (const link::RobotFrame& robot : frame.robots) {
      const int shirt = robot.identity.number;
      if (robot.identity.team == team.colour && team.slotOf(shirt) != 0) shirts.push_back(shirt);
    }
  }
  const auto drawn = robotColor(team.colour);
  const QColor colour = drawn ? theme().team(*drawn) : theme().secondaryText;
  m_square->setStyleSheet(QStringLiteral("background: %1; border-radius: 2px").arg(colour.name()));
  const QString more = refereeTeamText(frame, team);
  m_name->setText(refereed ? refereeTeamName(frame, team) : more);
  m_name->setToolTip(more);
  m_score->setText(QString::number(team.score));
  m_score->setVisible(refereed);
  m_buttons->setVisible(refereed);
  m_model->setCompact(refereed);
  m_model->update(frame, team, shirts);
  m_table->horizontalHeader()->setVisible(!refereed);
  m_table->setColumnHidden(RefereeModel::Cards, refereed);
  m_table->setColumnHidden(RefereeModel::Left, refereed);
  // Robots answer the referee, who tells it in monitor mode only.
  m_table->setColumnHidden(RefereeModel::Robot, refereed || frame.reception.replies.empty());
  // Five rows; more are scrolled to.
  const int rows = std::clamp(m_model->rowCount(), 2, 5);
  m_table->setMinimumHeight(rows * m_table->verticalHeader()->defaultSectionSize() +
                            (refereed ? 2 : m_table->horizontalHeader()->sizeHint().height() + 2));
}

void TeamColumn::setLocked(const link::MatchFrame* frame, const QString& why) {
  for (const Button& one : m_calls) {
    sim::RefereeCall call = one.call;
    call.team = m_team;
    const QString reason = why.isEmpty() ? whyRefused(frame, call) : why;
    one.button->setEnabled(reason.isEmpty());
    one.button->setToolTip(reason.isEmpty() ? one.tip : reason);
  }
}

std::vector<int> TeamColumn::chosen() const {
  std::vector<int> numbers;
  for (const QModelIndex& index : m_table->selectionModel()->selectedRows()) {
    numbers.push_back(index.data(RefereeModel::numberRole).toInt());
  }
  return numbers;
}

}  // namespace pitchboard::ui

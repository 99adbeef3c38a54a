// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/live/referee_dock.h>

#include <QHeaderView>
#include <QLabel>
#include <QStackedWidget>
#include <QTableView>
#include <QTimer>
#include <QVBoxLayout>

#include <ui/base/referee_words.h>
#include <ui/base/table_style.h>
#include <ui/sources/source_switch.h>

#include "referee_model.h"

namespace pitchboard::ui {
namespace {

class RefereeDock : public QStackedWidget {
 public:
  RefereeDock(SourceSwitch* source, QWidget* parent)
      : QStackedWidget(parent),
        m_source(source),
        m_empty(makeEmptyLabel(this, QStringLiteral("noReferee"))),
        m_page(new QWidget(this)),
        m_state(addLine("refereeState", TypeRole::Body, true)),
        m_setPlay(addLine("refereeSetPlay", TypeRole::Body, false)),
        m_truth(addLine("refereeTruth", TypeRole::Secondary, false)) {
    constexpr int refreshMilliseconds = 200;
    auto* column = new QVBoxLayout(m_page);
    const int gap = scaled(this, 4);
    column->setContentsMargins(gap, gap, gap, gap);
    column->setSpacing(gap);
    for (QLabel* line : {m_state, m_setPlay, m_truth}) column->addWidget(line);
    for (std::size_t i = 0; i < m_teams.size(); ++i) {
      m_teams[i] = makeTeam(i);
      column->addWidget(m_teams[i].name);
      column->addWidget(m_teams[i].table, 1);
    }
    addWidget(m_empty);
    addWidget(m_page);
    m_empty->setText(
        QStringLiteral("No referee's packet has been heard yet. Its port, version and senders are "
                       "chosen in the settings of Live."));
    auto* timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, [this] {
      if (isVisible()) refresh();
    });
    timer->start(refreshMilliseconds);
    connect(source, &FrameSource::restarted, this, &RefereeDock::refresh);
    refresh();
  }

 protected:
  void showEvent(QShowEvent* event) override {
    refresh();
    QStackedWidget::showEvent(event);
  }

 private:
  struct Team {
    QLabel* name = nullptr;
    QTableView* table = nullptr;
    RefereeModel* model = nullptr;
  };

  QLabel* addLine(const char* name, TypeRole role, bool bold) {
    auto* label = new QLabel(m_page);
    label->setObjectName(QLatin1String(name));
    label->setFont(themeFont(role, bold));
    label->setWordWrap(true);
    return label;
  }

  Team makeTeam(std::size_t side) {
    Team team{addLine(side == 0 ? "refereeLeft" : "refereeRight", TypeRole::Body, true),
              new QTableView(m_page), nullptr};
    team.model = new RefereeModel(team.table);
    team.table->setObjectName(side == 0 ? QStringLiteral("refereeLeftPlayers")
                                        : QStringLiteral("refereeRightPlayers"));
    team.table->setModel(team.model);
    styleTable(team.table);
    // All of it fits beside the field; what is longest gives way.
    QHeaderView* head = team.table->horizontalHeader();
    head->setStretchLastSection(false);
    head->setSectionResizeMode(QHeaderView::ResizeToContents);
    head->setSectionResizeMode(RefereeModel::State, QHeaderView::Stretch);
    return team;
  }

  void refresh() {
    const FramePtr frame = m_source->frame();
    if (!frame || !frame->referee) {
      setCurrentWidget(m_empty);
      return;
    }
    const link::RefereeView& view = *frame->referee;
    m_state->setText(refereeStateText(view));
    m_setPlay->setText(refereeSetPlayText(view));
    m_setPlay->setVisible(!m_setPlay->text().isEmpty());
    m_truth->setText(refereeTruthText(view));
    m_truth->setVisible(!m_truth->text().isEmpty());
    for (std::size_t i = 0; i < m_teams.size(); ++i) {
      m_teams[i].name->setText(refereeTeamText(view.teams[i], view.ourTeam));
      m_teams[i].model->update(view.teams[i], view.replies);
      // Robots answer the referee, who tells it in monitor mode only.
      m_teams[i].table->setColumnHidden(RefereeModel::Robot, view.replies.empty());
    }
    setCurrentWidget(m_page);
  }

  SourceSwitch* m_source;
  QLabel* m_empty;
  QWidget* m_page;
  QLabel *m_state, *m_setPlay, *m_truth;
  std::array<Team, 2> m_teams{};
};

}  // namespace

QWidget* makeRefereeDock(SourceSwitch* source, QWidget* parent) {
  return new RefereeDock(source, parent);
}

}  // namespace pitchboard::ui

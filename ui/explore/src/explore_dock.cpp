// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/explore/explore_dock.h>

#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QTableWidget>
#include <cmath>

#include <ui/base/explanation.h>
#include <ui/base/robot_text.h>
#include <ui/base/scrolled_form.h>
#include <ui/base/table_style.h>
#include <ui/base/time_axis.h>
#include <ui/explore/explorer.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/source_switch.h>
#include <ui/sources/timeline.h>

#include "goal_chart.h"

namespace pitchboard::ui {
namespace {

QString signedText(double value) {
  return (value < 0.0 ? QString() : QStringLiteral("+")) + numberText(value, 3);
}

QString shareText(const rollout::Share& share) {
  return QStringLiteral("%1 % (%2 to %3)")
      .arg(numberText(100.0 * share.value, 1), numberText(100.0 * share.low, 1),
           numberText(100.0 * share.high, 1));
}

class ExploreDock : public ScrolledForm {
 public:
  ExploreDock(const ExploreDockParts& parts, QWidget* parent)
      : ScrolledForm(parent, 8), m_parts(parts), m_explorer(parts.explorer) {
    addStart(form(), column());
    addResult(form(), column());
    finishForm();
    connect(m_explorer, &Explorer::changed, this, [this] { showAll(); });
    connect(m_parts.source, &FrameSource::frameReceived, this, [this] { showRobots(); });
    connect(m_parts.source, &FrameSource::restarted, this, [this] { showRobots(); });
    connect(m_parts.selection, &RobotSelection::changed, this, [this](const auto& ids) {
      if (!ids.empty()) m_explorer->setRobot(ids.front());
    });
    showAll();
  }

 protected:
  void changeEvent(QEvent* event) override {
    ScrolledForm::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) showAll();
  }
  void showEvent(QShowEvent* event) override {
    ScrolledForm::showEvent(event);
    showRobots();
  }

 private:
  void addStart(QWidget* form, QVBoxLayout* column) {
    auto* row = new QHBoxLayout;
    m_start = new QPushButton(QStringLiteral("Explore from this moment"), form);
    m_start->setObjectName(QStringLiteral("exploreStart"));
    m_start->setToolTip(QStringLiteral(
        "Plays short games from the moment shown, in the background. Nothing is sent to robots."));
    connect(m_start, &QPushButton::clicked, m_explorer, &Explorer::start);
    row->addWidget(m_start, 1);
    m_robot = new QComboBox(form);
    m_robot->setObjectName(QStringLiteral("exploreRobot"));
    m_robot->setAccessibleName(QStringLiteral("Robot"));
    m_robot->setToolTip(QStringLiteral("Compares the actions of this robot"));
    connect(m_robot, &QComboBox::activated, this, [this](int index) {
      m_explorer->setRobot(index > 0 ? std::optional(m_robots[static_cast<std::size_t>(index - 1)])
                                     : std::nullopt);
    });
    row->addWidget(m_robot);
    column->addLayout(row);
    auto* running = new QHBoxLayout;
    m_progress = new QProgressBar(form);
    m_progress->setObjectName(QStringLiteral("exploreProgress"));
    m_progress->setRange(0, 100);
    m_progress->setFormat(QStringLiteral("%p %"));
    running->addWidget(m_progress, 1);
    m_cancel = new QPushButton(QStringLiteral("Cancel"), form);
    m_cancel->setObjectName(QStringLiteral("exploreCancel"));
    connect(m_cancel, &QPushButton::clicked, m_explorer, &Explorer::cancel);
    running->addWidget(m_cancel);
    m_clear = new QPushButton(QStringLiteral("Clear"), form);
    m_clear->setObjectName(QStringLiteral("exploreClear"));
    m_clear->setToolTip(QStringLiteral("Removes the result from the panel and the field"));
    connect(m_clear, &QPushButton::clicked, m_explorer, &Explorer::clear);
    running->addWidget(m_clear);
    column->addLayout(running);
    m_state = makeExplanation({}, form);
    m_state->setObjectName(QStringLiteral("exploreState"));
    column->addWidget(m_state);
  }

  void addResult(QWidget* form, QVBoxLayout* column) {
    m_result = new QWidget(form);
    auto* rows = new QVBoxLayout(m_result);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(scaled(this, 6));
    auto* time = new QHBoxLayout;
    m_slider = new QSlider(Qt::Horizontal, m_result);
    m_slider->setObjectName(QStringLiteral("exploreSecond"));
    m_slider->setAccessibleName(QStringLiteral("Time after the moment"));
    m_slider->setToolTip(QStringLiteral("Shows on the field where the ball may be at this time"));
    m_slider->setRange(0, Explorer::seconds);
    m_slider->setPageStep(5);
    connect(m_slider, &QSlider::valueChanged, m_explorer, &Explorer::showSecond);
    time->addWidget(m_slider, 1);
    m_second = new QLabel(m_result);
    m_second->setObjectName(QStringLiteral("exploreSecondText"));
    m_second->setMinimumWidth(
        m_second->fontMetrics().horizontalAdvance(QStringLiteral("Ball in 30 s")));
    time->addWidget(m_second);
    rows->addLayout(time);
    m_goals = new QLabel(m_result);
    m_goals->setObjectName(QStringLiteral("exploreGoals"));
    m_goals->setWordWrap(true);
    m_goals->setTextFormat(Qt::RichText);
    rows->addWidget(m_goals);
    m_chart = new GoalChart(m_result);
    rows->addWidget(m_chart);
    m_actions = new QTableWidget(0, 3, m_result);
    m_actions->setObjectName(QStringLiteral("exploreActions"));
    m_actions->setHorizontalHeaderLabels(
        {QStringLiteral("Action"), QStringLiteral("Goals"), QStringLiteral("Below the best")});
    m_actions->horizontalHeaderItem(1)->setToolTip(
        QStringLiteral("Expected goals for minus goals against in 30 s"));
    m_actions->horizontalHeaderItem(2)->setToolTip(
        QStringLiteral("How much worse than the best action, with the 95 % confidence interval"));
    styleTable(m_actions);
    m_actions->setSelectionMode(QAbstractItemView::NoSelection);
    m_actions->setFocusPolicy(Qt::NoFocus);
    m_actions->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    rows->addWidget(m_actions);
    m_verdict = new QLabel(m_result);
    m_verdict->setObjectName(QStringLiteral("exploreVerdict"));
    m_verdict->setWordWrap(true);
    m_verdict->setFont(themeFont(TypeRole::Body, true));
    rows->addWidget(m_verdict);
    column->addWidget(m_result);
    m_notes = makeExplanation({}, form);
    m_notes->setObjectName(QStringLiteral("exploreNotes"));
    column->addWidget(m_notes);
  }

  void showRobots() {
    if (!isVisible()) return;  // frames come sixty times a second
    const FramePtr frame = m_parts.source->frame();
    m_start->setEnabled(frame && !frame->robots.empty());
    std::vector<RobotKey> robots;
    QStringList names;
    if (frame) {
      for (const link::RobotFrame& robot : frame->robots) {
        robots.push_back(robot.key);
        names << robotName(robot);
      }
    }
    if (robots == m_robots && names == m_names && m_robot->count() > 0) return;
    m_robots = std::move(robots);
    m_names = names;
    m_robot->clear();
    m_robot->addItem(QStringLiteral("No robot"));
    m_robot->addItems(m_names);
    showRobot();
  }

  void showRobot() {
    const auto robot = m_explorer->robot();
    const auto found = robot ? std::ranges::find(m_robots, *robot) : m_robots.end();
    m_robot->setCurrentIndex(
        found == m_robots.end() ? 0 : static_cast<int>(found - m_robots.begin()) + 1);
  }

  void showAll() {
    showRobot();
    const bool running = m_explorer->isRunning();
    const ExploredMoment* found = m_explorer->found();
    const bool any = found != nullptr && !found->result.times.empty();
    m_progress->setVisible(running);
    m_cancel->setVisible(running);
    m_clear->setVisible(!running && any);
    m_progress->setValue(static_cast<int>(std::lround(100.0 * m_explorer->progress())));
    m_result->setVisible(any);
    m_notes->setVisible(found != nullptr);
    m_state->setText(stateText(found, any));
    const QSignalBlocker quiet(m_slider);
    m_slider->setValue(m_explorer->second());
    m_second->setText(QStringLiteral("Ball in %1 s").arg(m_explorer->second()));
    if (found != nullptr) {
      QStringList notes;
      for (const std::string& note : found->start.notes) notes << QString::fromStdString(note);
      m_notes->setText(notes.join(QLatin1Char('\n')));
    }
    if (!any) return;
    m_goals->setText(goalText(*found));
    m_chart->show(found, m_explorer->second());
    showActions(found->result);
  }

  QString stateText(const ExploredMoment* found, bool any) const {
    if (!m_explorer->problem().isEmpty()) return m_explorer->problem();
    if (found == nullptr) {
      return QStringLiteral(
                 "Shows where the ball may go in the next %1 s, how likely a goal is, and which "
                 "action is best for the chosen robot.")
          .arg(Explorer::seconds);
    }
    const QString from = momentText(found->time, 2, m_parts.timeline->clock());
    if (!any) return QStringLiteral("From %1").arg(from);
    return QStringLiteral("From %1 · %2 rollouts")
        .arg(from, countText(static_cast<qulonglong>(found->result.rollouts)));
  }

  QString goalText(const ExploredMoment& found) const {
    const link::ExploreResult& result = found.result;
    const auto line = [&](std::size_t side) {
      const auto& team = found.teams[side];
      const QString name = team        ? capitalised(info(*team).name)
                           : side == 0 ? QStringLiteral("Left team")
                                       : QStringLiteral("Right team");
      const rollout::Share& share = side == 0 ? result.last().goalLeft : result.last().goalRight;
      return QStringLiteral("<span style='color:%1'>■</span> %2 scores: %3")
          .arg(teamLineColor(team).name(), name, shareText(share));
    };
    return QStringLiteral("Within %1 s<br>").arg(result.seconds) + line(0) +
           QStringLiteral("<br>") + line(1);
  }

  void showActions(const link::ExploreResult& result) {
    m_actions->setVisible(!result.actions.empty());
    m_verdict->setVisible(!result.actions.empty());
    m_verdict->setText(QString::fromStdString(result.verdict()));
    m_actions->setRowCount(static_cast<int>(result.actions.size()));
    for (std::size_t i = 0; i < result.actions.size(); ++i) {
      const link::ExploredAction& action = result.actions[i];
      const bool best = i == result.best;
      const QString behind = best ? QStringLiteral("best")
                                  : QStringLiteral("%1 ± %2").arg(
                                        numberText(action.behind.value, 3),
                                        numberText(action.behind.high - action.behind.value, 3));
      const std::array texts{QString::fromStdString(action.text), signedText(action.value.value),
                             behind};
      for (int column = 0; column < 3; ++column) {
        auto* item = new QTableWidgetItem(texts[static_cast<std::size_t>(column)]);
        QFont font = m_actions->font();
        font.setBold(best);
        item->setFont(font);
        if (column == 1) {
          item->setToolTip(QStringLiteral("95 %: %1 to %2")
                               .arg(signedText(action.value.low), signedText(action.value.high)));
        }
        m_actions->setItem(static_cast<int>(i), column, item);
      }
    }
    m_actions->resizeColumnToContents(0);
    m_actions->resizeColumnToContents(1);
    m_actions->setFixedHeight(m_actions->horizontalHeader()->sizeHint().height() +
                              m_actions->rowCount() *
                                  m_actions->verticalHeader()->defaultSectionSize() +
                              2 * m_actions->frameWidth());
  }

  ExploreDockParts m_parts;
  Explorer* m_explorer;
  std::vector<RobotKey> m_robots;  // in the box, after "No robot"
  QStringList m_names;
  QPushButton* m_start;
  QComboBox* m_robot;
  QProgressBar* m_progress;
  QPushButton* m_cancel;
  QPushButton* m_clear;
  QLabel* m_state;
  QWidget* m_result;
  QSlider* m_slider;
  QLabel* m_second;
  QLabel* m_goals;
  GoalChart* m_chart;
  QTableWidget* m_actions;
  QLabel* m_verdict;
  QLabel* m_notes;
};

}  // namespace

QWidget* makeExploreDock(const ExploreDockParts& parts, QWidget* parent) {
  return new ExploreDock(parts, parent);
}

}  // namespace pitchboard::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/referee/refereeing_dock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include <robotlink/scenario/referee_rule_sets.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/source_switch.h>

#include "formations.h"
#include "referee_buttons.h"
#include "referee_game.h"
#include "referee_log.h"
#include "referee_orders.h"
#include "referee_penalties.h"

namespace pitchboard::ui {
namespace {

using sim::CallKind;

class RefereeingDock : public QScrollArea {
 public:
  RefereeingDock(MatchController* controller, const SourceSwitch* source, QWidget* parent)
      : QScrollArea(parent), m_match(controller), m_source(source) {
    setObjectName(QStringLiteral("refereeingDock"));
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* form = new QWidget(this);
    m_column = new QVBoxLayout(form);
    const int edge = scaled(this, 8);
    m_column->setContentsMargins(edge, 0, edge, edge);
    m_column->setSpacing(scaled(this, 4));
    addRules(form);
    m_game = new RefereeGame(m_match, form);
    m_column->addWidget(m_game);
    m_penalties = new RefereePenalties(m_match, form);
    m_column->addWidget(m_penalties);
    addFormations(form);
    addLog(form);
    setWidget(form);
    setMinimumWidth(form->minimumSizeHint().width() + scaled(this, 14));
    connect(&shown(), &FrameSource::frameReceived, this, &RefereeingDock::refresh);
    connect(&shown(), &FrameSource::restarted, this, &RefereeingDock::refresh);
    if (m_source != nullptr) {
      connect(m_source, &SourceSwitch::changed, this, &RefereeingDock::refresh);
    }
    connect(m_match->edits(), &MatchEdits::lockedChanged, this, &RefereeingDock::refresh);
    refresh();
  }

 private:
  /// Whose moment the dock shows: as the rest of the window, also while looking back.
  const FrameSource& shown() const {
    return m_source != nullptr ? static_cast<const FrameSource&>(*m_source) : *m_match;
  }

  void call(const sim::RefereeCall& made, const QString& text) {
    callReferee(m_match->edits(), made, text);
  }

  void addRules(QWidget* form) {
    m_column->addWidget(makeRefereeHeading(QStringLiteral("Rules"), form));
    m_rules = new QComboBox(form);
    m_rules->setObjectName(QStringLiteral("refereeRules"));
    for (const link::RuleSetInfo& set : link::refereeRuleSets()) {
      m_rules->addItem(QString::fromStdString(set.title), QString::fromStdString(set.name));
      m_rules->setItemData(m_rules->count() - 1, QString::fromStdString(set.description),
                           Qt::ToolTipRole);
    }
    m_rules->setToolTip(
        QStringLiteral("Choosing rules restarts the game in INITIAL. Undo brings it back."));
    connect(m_rules, &QComboBox::activated, this, [this] {
      chooseReferee(m_match->edits(), m_rules->currentData().toString().toStdString(),
                    m_rules->currentText());
    });
    m_column->addWidget(m_rules);
    m_automatic = new QCheckBox(QStringLiteral("The referee calls by itself"), form);
    m_automatic->setObjectName(QStringLiteral("refereeAutomatic"));
    m_automatic->setToolTip(
        QStringLiteral("Off: only your calls, and READY that runs out, change the game."));
    connect(m_automatic, &QCheckBox::clicked, this, [this](bool on) {
      call({.kind = CallKind::Automatic, .value = on ? 1 : 0},
           on ? QStringLiteral("automatic referee") : QStringLiteral("referee by hand"));
    });
    m_column->addWidget(m_automatic);
    m_state = new QLabel(form);
    m_state->setObjectName(QStringLiteral("refereeState"));
    m_state->setWordWrap(true);
    m_state->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    // Room for the second line, so that no button moves when somebody looks back.
    m_state->setMinimumHeight(2 * m_state->fontMetrics().lineSpacing());
    m_column->addWidget(m_state);
  }

  void addFormations(QWidget* form) {
    m_column->addWidget(makeRefereeHeading(QStringLiteral("Formations"), form));
    m_formations = new QWidget(form);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(0, 0, 0, 0);
    m_formation = new QComboBox(form);
    m_formation->setObjectName(QStringLiteral("refereeFormation"));
    for (const Formation& one : formations()) {
      m_formation->addItem(QString::fromUtf8(one.name));
      m_formation->setItemData(m_formation->count() - 1, QString::fromUtf8(one.meaning),
                               Qt::ToolTipRole);
    }
    row->addWidget(m_formation, 1);
    for (const bool left : {true, false}) {
      auto* load = new QPushButton(
          left ? QStringLiteral("Left attacks") : QStringLiteral("Right attacks"), form);
      load->setToolTip(QStringLiteral("Puts ball and robots there; play goes on"));
      connect(load, &QPushButton::clicked, this, [this, left] { loadFormation(left); });
      row->addWidget(load);
    }
    m_formations->setLayout(row);
    m_column->addWidget(m_formations);
    m_asSetPlay = new QCheckBox(QStringLiteral("With the referee's set play"), form);
    m_asSetPlay->setObjectName(QStringLiteral("refereeAsSetPlay"));
    m_asSetPlay->setToolTip(
        QStringLiteral("While PLAYING the side that attacks gets the corner kick, throw-in, ... as "
                       "well"));
    m_column->addWidget(m_asSetPlay);
  }

  void loadFormation(bool left) {
    const FramePtr frame = m_match->frame();
    if (!frame) return;
    const FormationPlaces places =
        placesOf(static_cast<std::size_t>(m_formation->currentIndex()), *frame, left);
    std::vector<RobotPlacement> moves;
    for (const auto& [id, pose] : places.robots) {
      if (const link::RobotFrame* robot = frame->robot(id)) {
        moves.push_back({id, robot->pose, pose});
      }
    }
    MatchEdits* edits = m_match->edits();
    edits->performTogether(QStringLiteral("formation: ") + m_formation->currentText(), [&] {
      edits->moveRobots(moves);
      edits->moveBall(frame->snapshot.ball, places.ball);
      if (m_asSetPlay->isChecked() && frame->referee && places.setPlay != sim::SetPlay::None) {
        call({.kind = CallKind::SetPlay,
              .team = places.attackers == TeamColor::Blue ? 0 : 1,
              .setPlay = places.setPlay,
              .place = places.ball},
             m_formation->currentText());
      }
    });
  }

  void addLog(QWidget* form) {
    m_column->addWidget(makeRefereeHeading(QStringLiteral("Log of the referee"), form));
    m_column->addWidget(new RefereeLog(m_match, form), 1);
  }

  void refresh() {
    // In Live and Replay the match goes on unseen, and nobody leads what he does not see.
    const bool simulating = m_source == nullptr || m_source->kind() == SourceKind::Simulate;
    const FramePtr frame = simulating ? shown().frame() : nullptr;
    const bool refereed = frame && frame->referee;
    const bool free = !m_match->edits()->isLocked();
    m_game->setEnabled(refereed && free);
    m_penalties->setEnabled(refereed && free);
    m_asSetPlay->setEnabled(refereed && free);
    m_penalties->show(refereed ? frame.get() : nullptr);
    m_automatic->setEnabled(refereed && free);
    m_rules->setEnabled(frame && free);
    m_formations->setEnabled(frame && free);
    if (frame && !m_rules->view()->isVisible()) {
      const QString name = QString::fromStdString(frame->refereeRules);
      const int index = m_rules->findData(name.isEmpty() ? QStringLiteral("published") : name);
      if (index != m_rules->currentIndex()) m_rules->setCurrentIndex(index);
    }
    if (refereed) m_automatic->setChecked(frame->refereeAutomatic);
    QString text = refereed ? stateText(*frame->referee)
                   : frame  ? QStringLiteral("This match has no referee. Choose rules to get one.")
                   : !simulating && m_match->frame()
                       ? QStringLiteral(
                             "Only the match in Simulate is led from here. What a "
                             "referee sends stands in View > Referee.")
                       : QStringLiteral("No simulated match is open.");
    if (!free) text += QLatin1Char('\n') + MatchEdits::lockedText();
    m_state->setText(text);
  }

  static QString stateText(const link::RefereeView& view) {
    QString text = QString::fromStdString(view.state);
    if (!view.setPlay.empty()) text += QStringLiteral(", ") + QString::fromStdString(view.setPlay);
    if (!view.phase.empty()) text += QStringLiteral(", ") + QString::fromStdString(view.phase);
    text += view.firstHalf ? QStringLiteral(", first half") : QStringLiteral(", second half");
    if (view.stopped) text += QStringLiteral(", stopped");
    if (view.secondaryTime) text += QStringLiteral(", %1 s").arg(*view.secondaryTime);
    return text;
  }

  MatchController* m_match;
  const SourceSwitch* m_source;
  QVBoxLayout* m_column = nullptr;
  RefereeGame* m_game = nullptr;
  RefereePenalties* m_penalties = nullptr;
  QComboBox *m_rules = nullptr, *m_formation = nullptr;
  QCheckBox *m_automatic = nullptr, *m_asSetPlay = nullptr;
  QLabel* m_state = nullptr;
  QWidget* m_formations = nullptr;
};

}  // namespace

QWidget* makeRefereeingDock(MatchController* controller, const SourceSwitch* source,
                            QWidget* parent) {
  return new RefereeingDock(controller, source, parent);
}

}  // namespace pitchboard::ui

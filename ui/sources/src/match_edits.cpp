// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/match_edits.h>

#include <QUndoStack>
#include <algorithm>
#include <utility>

#include <base/try.h>
#include <ui/sources/retired_match.h>

namespace pitchboard::ui {
MatchEdits::MatchEdits(MatchController* match)
    : QObject(match), m_match(match), m_undoStack(new QUndoStack(this)) {
  constexpr int undoLimit = 1000;
  m_undoStack->setUndoLimit(undoLimit);
  connect(m_undoStack, &QUndoStack::indexChanged, this, [this] {
    const auto* last = lastEdit();
    if (last == nullptr || last->mergeKey() != m_gesture.mergeKey()) m_gesture = {};
    dropRefused();
  });
  connect(match, &MatchController::scenarioChanged, this, [this] {
    if (!m_replacing) m_undoStack->clear();
    while (m_unanswered > 0) answer(false);
    const link::Scenario scenario = m_match->isOpening() ? m_match->scenario() : link::Scenario{};
    m_robots.clear();
    m_added.clear();
    for (const link::ScenarioRobot& entry : scenario.robots) {
      m_robots.emplace(entry.identity.id, entry);
    }
    m_advisors = scenario.advisors;
    takePhysics(scenario.settings.physics);
  });
}

const link::ScenarioRobot* MatchEdits::robot(RobotId id) const {
  const auto found = m_robots.find(id);
  return found != m_robots.end() ? &found->second : nullptr;
}

void MatchEdits::setLocked(bool on) {
  if (on == m_locked) return;
  m_locked = on;
  m_reportedLocked = false;
  emit lockedChanged(on);
}

QString MatchEdits::lockedText() {
  return QStringLiteral("You are viewing the past. Press Now to return to the match.");
}

bool MatchEdits::allowsChange() {
  if (m_locked && !std::exchange(m_reportedLocked, true)) emit failed(lockedText());
  return !m_locked;
}

struct MatchEdits::Performed {
  MatchEdit edit;
  bool carriedOut = false;  // the match's thread
  std::shared_ptr<bool> refused = std::make_shared<bool>(false);
};

namespace {

/// Carries out `run` of each step, or of none: after a failure `back` of those before it.
template <class Iterator, class Run>
Result<void> runAll(Iterator begin, Iterator end, Run run, Run back, link::SimulatedMatch& match) {
  for (Iterator step = begin; step != end; ++step) {
    auto done = ((*step).*run)(match);
    if (done) continue;
    while (step != begin) (void)((*--step).*back)(match);
    return done;
  }
  return {};
}

}  // namespace

void MatchEdits::perform(MatchEdit edit) {
  if (!(m_match->isOpen() || m_match->isOpening()) || !allowsChange()) return;
  const auto made = std::make_shared<Performed>();
  made->edit = std::move(edit);
  ++m_unanswered;
  emit sent();
  carryOut(
      made,
      [this, made] {
        m_undoStack->push(new EditCommand({made->edit.text, [this, made] { carryOut(made); },
                                           [this, made] { takeBack(made); }, made->edit.mergeKey,
                                           made->refused}));
        answer(true);
      },
      [this] { answer(false); });
}

void MatchEdits::answer(bool done) {
  --m_unanswered;
  emit answered(done);
}

void MatchEdits::carryOut(const std::shared_ptr<Performed>& made, std::function<void()> onSuccess,
                          const std::function<void()>& onFailure) {
  const MatchEdit& edit = made->edit;
  if (edit.note) edit.note();
  m_match->post({edit.whatFailed,
                 [made](link::SimulatedMatch& match) -> Result<void> {
                   made->carriedOut = false;
                   TRY(runAll(made->edit.steps.begin(), made->edit.steps.end(), &EditStep::redo,
                              &EditStep::undo, match));
                   made->carriedOut = true;
                   return {};
                 },
                 [this, made, onFailure] {
                   if (made->edit.takeBack) made->edit.takeBack();
                   *made->refused = true;
                   dropRefused();
                   if (onFailure) onFailure();
                 },
                 std::move(onSuccess), edit.changes});
}

void MatchEdits::takeBack(const std::shared_ptr<Performed>& made) {
  const MatchEdit& edit = made->edit;
  if (edit.takeBack) edit.takeBack();
  m_match->post({QStringLiteral("Could not undo “%1”").arg(edit.text),
                 [made](link::SimulatedMatch& match) -> Result<void> {
                   if (!made->carriedOut) return {};
                   return runAll(made->edit.steps.rbegin(), made->edit.steps.rend(),
                                 &EditStep::undo, &EditStep::redo, match);
                 },
                 [made] {
                   if (made->edit.note) made->edit.note();
                 },
                 {},
                 edit.changes});
}

const EditCommand* MatchEdits::lastEdit() const {
  return static_cast<const EditCommand*>(m_undoStack->command(m_undoStack->index() - 1));
}

void MatchEdits::dropRefused() {
  const EditCommand* last = lastEdit();
  if (last != nullptr && last->isRefused()) m_undoStack->undo();
}

void MatchEdits::order(MatchOrder change) {
  if (allowsChange()) m_match->post(std::move(change));
}

void MatchEdits::order(link::MatchRunner::Command change) {
  if (allowsChange()) m_match->post(std::move(change));
}

link::Scenario MatchEdits::setUp(link::Scenario scenario) const {
  std::erase_if(scenario.robots, [this](const link::ScenarioRobot& one) {
    return !m_robots.contains(one.identity.id);
  });
  for (const auto& [id, wanted] : m_robots) {
    const auto known =
        std::ranges::find(scenario.robots, id, [](const auto& one) { return one.identity.id; });
    if (known == scenario.robots.end()) {
      scenario.robots.push_back(wanted);
      continue;
    }
    if (m_added.contains(id)) {  // in the place of one that was removed
      *known = wanted;
      continue;
    }
    known->identity = wanted.identity;
    known->behaviour = wanted.behaviour;
    known->model = wanted.model;
    known->runtime = wanted.runtime;
  }
  scenario.advisors = m_advisors;
  scenario.settings.physics = m_physics;
  if (const FramePtr frame = m_match->frame()) {
    scenario.settings.noise = frame->settings->noise;
    scenario.settings.rigidBody = frame->settings->rigidBody;
  }
  return scenario;
}

void MatchEdits::adopt(const link::Moment& moment) {
  m_undoStack->clear();
  std::map<RobotId, link::ScenarioRobot> robots;
  for (std::size_t i = 0; i < moment.state.robots.size(); ++i) {
    const sim::RobotIdentity& identity = moment.state.robots[i];
    link::ScenarioRobot entry;
    if (const link::ScenarioRobot* known = robot(identity.id)) entry = *known;
    entry.identity = identity;
    entry.model = moment.state.models[i];
    if (const link::MomentRobot* of = moment.robot(identity.id)) entry.behaviour = of->behaviour;
    robots.emplace(identity.id, entry);
  }
  m_robots = std::move(robots);
  takePhysics(moment.state.settings.physics);
}

void MatchEdits::replaceMatch(const link::Scenario& scenario, const QString& text,
                              const QString& done, bool paused, std::function<void()> between) {
  if (!m_match->isOpen()) {
    m_match->replace(scenario, paused, std::move(between));
    return;
  }
  const auto other = std::make_shared<std::shared_ptr<RetiredMatch>>();  // that is not played
  m_replacing = true;
  *other = m_match->replace(scenario, paused, std::move(between));
  m_replacing = false;
  const auto swap = [this, other] {
    m_replacing = true;
    *other = m_match->bringBack(*other);
    m_replacing = false;
  };
  m_undoStack->push(new EditCommand({text, swap, swap}));
  emit replaced(done);
}

}  // namespace pitchboard::ui

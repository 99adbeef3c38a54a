// SPDX-License-Identifier: GPL-3.0-or-later
// The decision process of the soccer behaviours: world model, behaviour, blackboard, ten times a
// second. Where to walk it leaves to planning.
#include <base/try.h>

#include "soccer/behaviour.h"
#include "soccer/soccer_board.h"

#include <typeinfo>

namespace pitchboard::link {
namespace {

class SoccerDecision final : public CognitiveProcess {
 public:
  SoccerDecision(const ProcessOptions& options, const sim::FieldSpec& field,
                 std::unique_ptr<Behaviour> behaviour)
      : m_world(field, options.model, options.parameters, options.facesLeft),
        m_behaviour(std::move(behaviour)) {}

  void step(Blackboard& board, const Clock& clock) override {
    m_board.read(board, m_world, m_input);
    m_world.update(m_input, clock.seconds);
    m_board.lookFor(board, m_world.looksForOpponents());
    const Choice choice = m_behaviour->choose(m_world);
    if (const Target* target = std::get_if<Target>(&choice.move)) {
      m_target.write(board, m_world.field(), turned(*target));
    } else {
      // Planning lets go first; what it writes is no longer wanted.
      m_target.clear(board);
      const Act& act = std::get<Act>(choice.move);
      // B before A, because control reads B in the moment it sees a new A.
      board.write(m_variables.decisionActionB, act.b);
      board.write(m_variables.decisionActionA, act.action);
    }
    constexpr double lost = 0.4;  // s: a frame that missed the ball is no reason to search
    if (choice.search && m_world.ballAge() > lost) board.write(m_variables.decisionSearchOn, 1);
    m_board.publish(board, m_world, choice.intention, choice.target);
    board.write(m_variables.decisionWorking, 1);
  }

  double period() const override { return 0.1; }

  SoccerDecision(const SoccerDecision& other)
      : m_board(other.m_board),
        m_world(other.m_world),
        m_behaviour(other.m_behaviour->clone()),
        m_variables(other.m_variables),
        m_target(other.m_target) {}

  std::unique_ptr<const CognitiveProcess> remembered() const override {
    return std::make_unique<SoccerDecision>(*this);
  }

  bool restore(const CognitiveProcess& memory) override {
    const auto* other = dynamic_cast<const SoccerDecision*>(&memory);
    if (!other) return false;
    const Behaviour& mine = *m_behaviour;
    const Behaviour& theirs = *other->m_behaviour;
    if (typeid(mine) != typeid(theirs)) return false;
    m_world = other->m_world;
    m_behaviour = theirs.clone();
    return true;
  }

 private:
  Target turned(Target target) const {
    target.pose = m_world.toStudio(target.pose);
    if (target.ball) target.ball = m_world.toStudio(*target.ball);
    return target;
  }

  SoccerBoard m_board;
  SoccerInput m_input;  // of this cycle
  WorldModel m_world;
  std::unique_ptr<Behaviour> m_behaviour;
  RobotVariables m_variables;
  TargetVariables m_target;
};

}  // namespace

Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision(
    const ProcessOptions& options,
    std::unique_ptr<Behaviour> (*make)(const BehaviourParameters& parameters)) {
  TRY(sim::validate(options.field));
  TRY(sim::validate(options.model));
  TRY(validate(options.parameters));
  sim::FieldSpec field = options.field;
  if (options.model.radius > 0.0) field.robotRadius = options.model.radius;
  return std::make_unique<SoccerDecision>(options, field, make(options.parameters));
}

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
// The decision process of the soccer behaviours: world model, behaviour, blackboard, ten times a
// second.
#include "soccer/behaviour.h"

namespace pitchboard::link {
namespace {

class SoccerDecision final : public CognitiveProcess {
 public:
  SoccerDecision(const ProcessOptions& options, const sim::FieldSpec& field,
                 std::unique_ptr<Behaviour> behaviour)
      : m_world(field, options.model, options.facesLeft), m_behaviour(std::move(behaviour)) {}

  void step(Blackboard& board, const Clock& clock) override {
    m_world.update(board, clock);
    const Choice choice = m_behaviour->choose(m_world);
    // B before A, because control reads B in the moment it sees a new A.
    board.write(m_variables.decisionActionB, choice.act.b);
    board.write(m_variables.decisionActionA, choice.act.action);
    constexpr double lost = 0.4;  // s: a frame that missed the ball is no reason to search
    if (choice.search && m_world.ballAge() > lost) board.write(m_variables.decisionSearchOn, 1);
    m_world.tell(board, choice.intention, choice.target);
    board.write(m_variables.decisionWorking, 1);
  }

  double period() const override { return 0.1; }

  void tellThoughts(RobotThoughts& thoughts) const override {
    auto path = std::make_shared<PlannedPath>();
    const Walk& walk = m_behaviour->walk();
    if (walk.lastStep() == m_world.now() && walk.path().points.size() > 1) {
      path->complete = walk.path().complete;
      path->points.push_back(m_world.toStudio(m_world.pose().position));
      for (std::size_t i = 1; i < walk.path().points.size() && i < PlannedPath::most; ++i) {
        path->points.push_back(m_world.toStudio(walk.path().points[i]));
      }
    }
    thoughts.path = std::move(path);
  }

 private:
  WorldModel m_world;
  std::unique_ptr<Behaviour> m_behaviour;
  RobotVariables m_variables;
};

}  // namespace

template <class B>
Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision(const ProcessOptions& options) {
  if (const Result<void> valid = sim::validate(options.field); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  if (const Result<void> valid = sim::validate(options.model); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  sim::FieldSpec field = options.field;
  if (options.model.radius > 0.0) field.robotRadius = options.model.radius;
  return std::make_unique<SoccerDecision>(options, field, std::make_unique<B>(field));
}

template Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision<Striker>(
    const ProcessOptions&);
template Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision<Supporter>(
    const ProcessOptions&);
template Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision<Keeper>(
    const ProcessOptions&);
template Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision<Idle>(const ProcessOptions&);

}  // namespace pitchboard::link

// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_makers.h"

#include <base/try.h>
#include <robotlink/cognition/soccer_input.h>
#include <simcore/world/field.h>
#include <simcore/world/published_frame.h>

#include "planning/walk.h"
#include "team/team_variables.h"

namespace pitchboard::link {

/// Where all other robots stand that a robot knows of, from its blackboard: team-mates as the team
/// process writes them, opponents as decision remembers them. Studio frame, metres. Use from one
/// thread.
class KnownRobots {
 public:
  void read(const Blackboard& board, const sim::FieldSpec& field, Points& places) const;

 private:
  TeamVariables m_team;
};

namespace {

Point fromCm(const sim::FieldSpec& field, double x, double y) {
  return sim::published_frame::studioFromLocalization(field, {x, y, 0.0}).position;
}

template <std::size_t Count>
void readPlaces(const Blackboard& board, const sim::FieldSpec& field,
                const std::array<FloatVar, Count>& xs, const std::array<FloatVar, Count>& ys,
                Points& places) {
  for (std::size_t i = 0; i < Count; ++i) {
    const double x = static_cast<double>(readOr(board, xs[i], -1.0F));
    const double y = static_cast<double>(readOr(board, ys[i], -1.0F));
    // Zeros mean that the variables were never written: no robot stands exactly on the corner.
    if (x >= 0.0 && y >= 0.0 && x + y > 0.0 && x < 1e5 && y < 1e5)
      places.push_back(fromCm(field, x, y));
  }
}

}  // namespace

void KnownRobots::read(const Blackboard& board, const sim::FieldSpec& field, Points& places) const {
  places.clear();
  readPlaces(board, field, m_team.mateX, m_team.mateY, places);
  if (places.empty()) {  // another team's process writes these only
    for (std::size_t i = 0; i < m_team.place.size(); ++i) {
      const auto place = unpackPlace(readOr(board, m_team.place[i], -1));
      if (place && readOr(board, m_team.state[i]) != static_cast<int>(MateState::Unknown))
        places.push_back(fromCm(field, place->x, place->y));
    }
  }
  readPlaces(board, field, m_team.opponentX, m_team.opponentY, places);
}

namespace {

namespace frame = sim::published_frame;

class Planning final : public CognitiveProcess {
 public:
  Planning(const sim::FieldSpec& field, double othersRadius, const sim::RobotModel& body)
      : m_field(field), m_walk(field, othersRadius, body) {}

  void step(Blackboard& board, const Clock& clock) override {
    const auto target = m_target.read(board, m_field);
    if (!target) {
      if (!m_walk.path().points.empty()) m_target.writePath(board, m_field, {});
      m_walk.rest();
      return;
    }
    m_now.now = clock.seconds;
    m_now.pose = frame::studioFromLocalization(
        m_field, {static_cast<double>(board.read(m_variables.localizationX)),
                  static_cast<double>(board.read(m_variables.localizationY)),
                  static_cast<double>(board.read(m_variables.localizationTheta))});
    m_robots.read(board, m_field, m_now.robots);
    const Act act = m_walk.step(m_now, *target).value_or(acts::stop);
    const std::span<const Point> path = m_walk.path().points;
    m_target.writePath(board, m_field, path.empty() ? path : path.subspan(1));
    // Decision may have thought of something else meanwhile: then the action is its own again.
    if (!m_target.read(board, m_field)) return;
    // B before A, because control reads B in the moment it sees a new A.
    board.write(m_variables.decisionActionB, act.b);
    board.write(m_variables.decisionActionA, act.action);
  }

  double period() const override { return 0.1; }

  void sendDebugData(CognitionDebug& cognitionDebug) const override {
    auto path = std::make_shared<PlannedPath>();
    const Path& walked = m_walk.path();
    if (walked.points.size() > 1) {
      path->complete = walked.complete;
      path->points.push_back(m_now.pose.position);
      for (std::size_t i = 1; i < walked.points.size() && i < PlannedPath::most; ++i) {
        path->points.push_back(walked.points[i]);
      }
    }
    cognitionDebug.path = std::move(path);
  }

  std::unique_ptr<const CognitiveProcess> remembered() const override {
    return std::make_unique<Planning>(*this);
  }

  bool restore(const CognitiveProcess& memory) override {
    const auto* other = dynamic_cast<const Planning*>(&memory);
    if (other) *this = *other;
    return other != nullptr;
  }

 private:
  sim::FieldSpec m_field;
  Walk m_walk;
  RobotVariables m_variables;
  TargetVariables m_target;
  KnownRobots m_robots;
  Surroundings m_now;
};

}  // namespace

Result<std::unique_ptr<CognitiveProcess>> makePlanning(const ProcessOptions& options) {
  TRY(sim::validate(options.field));
  TRY(sim::validate(options.model));
  sim::FieldSpec field = options.field;
  if (options.model.radius > 0.0) field.robotRadius = options.model.radius;
  return std::make_unique<Planning>(field, options.field.robotRadius, options.model);
}

}  // namespace pitchboard::link

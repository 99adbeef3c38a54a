// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/explore/explore_start.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include <base/try.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/models/noise_presets.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/rollout/rollout_start.h>
#include <robotlink/rollout/rollouts.h>
#include <robotlink/session/ball_sighting.h>
#include <robotlink/session/moment_scenario.h>
#include <simcore/world/field.h>

namespace pitchboard::link {
namespace {

constexpr double headingSigma = 0.1;                 // rad; team messages do not contain it
constexpr double longestAgo = 10.0, stepAgo = 0.25;  // s, in the search for a ball
constexpr double speedOver = 0.5;                    // s between the two sightings of a speed
constexpr double fastestSeen = 6.0;                  // m/s: what is faster is two different balls
constexpr double setPlayLasts = 10.0;  // s that the other team keeps away if nobody tells
constexpr double keeperWithin = 1.2;   // m from the own goal's centre

class StartMaker {
 public:
  StartMaker(const MatchFrame& frame, const ExploreStartOptions& options)
      : m_known(frame),
        m_options(options),
        m_truth(options.useTruth && frame.truthKnown && frame.ballKnown) {}

  Result<ExploreStart> make() {
    TRY(takeRobots());
    TRY(takeBall());
    TRY(takeMoment());
    takeBeliefs();
    return std::move(m_out);
  }

 private:
  void note(std::string text) { m_out.notes.push_back(std::move(text)); }

  Result<void> takeRobots() {
    note(m_truth ? "Robots and ball start at their true positions."
                 : "Robots start where they believe they are, and the ball where they see it.");
    std::vector<RobotFrame> kept;
    for (RobotFrame& robot : m_known.robots) {
      const char* why = nullptr;
      if (robot.timedOut()) {
        why = " stopped sending; it is left out.";
      } else if (!robot.poseKnown() || (!m_truth && !robot.belief)) {
        why = " does not know where it is; it is left out.";
      } else if (kept.size() == rollout::Rollouts::maxPlayers) {
        why = " is left out: a rollout has at most 22 robots.";
      }
      if (why != nullptr) {
        note(robot.name + why);
        continue;
      }
      kept.push_back(std::move(robot));
    }
    m_known.robots = std::move(kept);
    if (m_known.robots.empty()) {
      return failure(ErrorCode::NotFound,
                     "No robot knows where it is at this moment. Choose another moment.");
    }
    for (const RobotFrame& robot : m_known.robots) {
      m_out.robots.push_back(robot.uid);
      m_out.names.push_back(robot.name);
    }
    return {};
  }

  Result<void> takeBall() {
    rollout::BallBelief& ball = m_out.belief.ball;
    if (m_truth) {
      ball.place = m_known.snapshot.ball;
      ball.velocity = m_known.snapshot.ballVelocity;
      ball.sigma = ball.velocitySigma = 0.0;
      return {};
    }
    const double now = m_known.snapshot.time;
    std::optional<BallSighting> seen = ballSeenIn(m_known);
    for (double ago = stepAgo; !seen && m_options.earlier && ago <= longestAgo; ago += stepAgo) {
      seen = seenAt(now - ago);
      ball.age = ago;
    }
    if (!seen) {
      return failure(ErrorCode::NotFound,
                     "No robot saw the ball at this moment or in the 10 s before it. Choose "
                     "another moment.");
    }
    if (ball.age > 0.0) {
      char text[80];
      std::snprintf(text, sizeof text, "The ball was last seen %.2g s before this moment.",
                    ball.age);
      note(text);
    }
    ball.place = seen->place;
    ball.sigma = seen->sigma;
    takeBallSpeed(now - ball.age, *seen);
    return {};
  }

  /// The difference of two sightings, if it is more than their noise.
  void takeBallSpeed(double time, const BallSighting& seen) {
    rollout::BallBelief& ball = m_out.belief.ball;
    ball.velocity = {};
    const auto before = seenAt(time - speedOver);
    if (!before) return;
    const double rolled = distance(before->place, seen.place);
    // A robot that is wrong about its own place is so in both sightings.
    const double noise = std::max(minBallSigma, std::min(seen.sigma, before->sigma) / 2.0);
    if (rolled < 2.0 * noise || rolled > fastestSeen * speedOver) return;
    ball.velocity = {(seen.place.x - before->place.x) / speedOver,
                     (seen.place.y - before->place.y) / speedOver};
    ball.velocitySigma = noise / speedOver;
  }

  std::optional<BallSighting> seenAt(double time) const {
    if (!m_options.earlier) return {};
    const auto frame = m_options.earlier(time);
    return frame ? ballSeenIn(*frame) : std::nullopt;
  }

  /// Models, sides and the game, as a match that begins at this moment would have them.
  Result<void> takeMoment() {
    m_known.ballKnown = true;
    m_known.snapshot.ball = m_out.belief.ball.place;
    m_known.snapshot.ballVelocity = m_out.belief.ball.velocity;
    MomentOptions options;
    options.poses = m_truth ? MomentOptions::Poses::True : MomentOptions::Poses::Believed;
    options.base = m_options.base;
    for (RobotFrame& robot : m_known.robots) takeSide(robot);
    MomentScenario moment = scenarioFromMoment(m_known, options);
    Scenario& scenario = moment.scenario;
    if (m_options.base == nullptr) {
      note("Robot models are unknown: all robots play as kid-size with realistic noise.");
      const auto model = TRY(loadRobotModel("kid-size"));
      scenario.settings.noise = TRY(noisePreset("realistic"));
      for (ScenarioRobot& robot : scenario.robots) robot.model = model;
    }
    takeBehaviours(scenario);
    for (std::string& text : moment.notes) note(std::move(text));
    RolloutStart start = rolloutStartOf(scenario);
    m_out.setup = std::move(start.setup);
    m_out.belief.robots = std::move(start.belief.robots);
    return takeGame(scenario);
  }

  /// Live robots do not tell which goal they attack; a referee's packet replaces this guess.
  void takeSide(RobotFrame& robot) const {
    if (m_known.truthKnown) return;
    robot.identity.imuStartsAt180 = info(robot.identity.team).facesLeft;
  }

  void takeBehaviours(Scenario& scenario) {
    std::string assumed, still;
    const double goal = scenario.settings.field.halfLength();
    for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
      ScenarioRobot& robot = scenario.robots[i];
      const auto list = [](std::string& names, const std::string& name) {
        names += (names.empty() ? "" : ", ") + name;
      };
      if (m_known.robots[i].behaviour.empty()) {
        const Point own{robot.identity.imuStartsAt180 ? goal : -goal, 0.0};
        const bool keeps = distance(robot.pose.position, own) < keeperWithin;
        robot.behaviour = keeps ? "keeper" : "striker";
        list(assumed, m_out.names[i] + (keeps ? " (keeper)" : " (striker)"));
      }
      const BehaviourInfo* known = findBehaviour(robot.behaviour);
      if (known == nullptr || !known->usesPose) list(still, m_out.names[i]);
    }
    if (!assumed.empty()) note("Unknown behaviours were assumed: " + assumed + '.');
    if (!still.empty()) {
      note("Rollouts cannot play the behaviour of these robots, which stand still: " + still + '.');
    }
    const auto isLeft = [](const ScenarioRobot& robot) { return !robot.identity.imuStartsAt180; };
    const auto left = std::ranges::count_if(scenario.robots, isLeft);
    if (left == 0 || left == std::ssize(scenario.robots)) {
      note("Only one team is known. Without opponents goals are more likely than in the game.");
    }
  }

  Result<void> takeGame(const Scenario& scenario) {
    rollout::GameBelief& game = m_out.belief.game;
    game.goalsLeft = std::max(0, scenario.score.left);
    game.goalsRight = std::max(0, scenario.score.right);
    if (!scenario.game) return {};
    const sim::GameStart& start = *scenario.game;
    if (start.over || start.state == PlayState::Finished) {
      return failure(ErrorCode::Unsupported, "The game is over. Choose an earlier moment.");
    }
    if (m_known.game) {
      game.goalsLeft = m_known.game->teamAt(false).score;
      game.goalsRight = m_known.game->teamAt(true).score;
    }
    if (start.clock && *start.clock > 0.0) game.secondsLeft = *start.clock;
    if (start.state != PlayState::Playing) {
      note("The game is in " + std::string(labelOf(start.state)) +
           ". Rollouts have no referee: all robots play at once.");
      return {};
    }
    const bool isAnnounced = start.setPlay && start.setPlay->kind != SetPlay::None &&
                             start.setPlay->team &&
                             start.setPlay->step != Restart::Step::Executed &&
                             start.setPlay->step != Restart::Step::Free;
    if (!isAnnounced) return {};
    for (const ScenarioRobot& robot : scenario.robots) {
      if (robot.identity.team != *start.setPlay->team) continue;
      game.setPlay = start.setPlay->kind;
      game.setPlaySide = robot.identity.imuStartsAt180 ? rollout::Side::Right : rollout::Side::Left;
      game.setPlayLeft = start.countdown.value_or(setPlayLasts);
    }
    return {};
  }

  void takeBeliefs() {
    std::string penalised;
    for (std::size_t i = 0; i < m_known.robots.size(); ++i) {
      const RobotFrame& robot = m_known.robots[i];
      rollout::RobotBelief& belief = m_out.belief.robots[i];
      belief.sigma = m_truth ? 0.0 : robot.sigma.value_or(unknownSigma);
      belief.yawSigma = m_truth ? 0.0 : headingSigma;
      if (m_truth) {
        const double c = std::cos(robot.pose.yaw), s = std::sin(robot.pose.yaw);
        belief.forward = c * robot.velocity.x + s * robot.velocity.y;
        belief.left = c * robot.velocity.y - s * robot.velocity.x;
      }
      belief.down = robot.fallen || robot.gettingUp;
      if (belief.down) belief.getsUpIn = m_out.setup.players[i].model.getUpFront;
      belief.absent = robot.penalty.has_value();
      if (belief.absent) penalised += (penalised.empty() ? "" : ", ") + m_out.names[i];
    }
    if (!penalised.empty()) note("Penalised robots do not come back: " + penalised + '.');
  }

  MatchFrame m_known;  // with the robots that take part
  const ExploreStartOptions& m_options;
  bool m_truth;
  ExploreStart m_out;
};

}  // namespace

Result<ExploreStart> exploreStart(const MatchFrame& frame, const ExploreStartOptions& options) {
  return StartMaker(frame, options).make();
}

}  // namespace pitchboard::link

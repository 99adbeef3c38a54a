// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/play_follower.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::link {
namespace {

// docs/statistics.md has these numbers, too.
constexpr double touchMargin = 0.016;  // m between a robot and the ball that it touches
constexpr double duelTime = 0.3;       // s after a kick
constexpr double liveMargin = 0.05;    // m more, of what a live robot sees
constexpr double deflectMargin = 0.2;  // m, if the ball changes its way
constexpr double minPass = 0.5;        // m that the ball rolls
constexpr double stepWay = 0.1;        // m less, until somebody is seen at the ball
constexpr double maxPassTime = 15.0;   // s
constexpr double minShot = 0.1;        // m that the ball rolls before play is stopped
constexpr double wideMargin = 0.5;     // m beside the posts
constexpr double controlTime = 0.5;    // s
constexpr double restartTime = 15.0;   // s after a set play was taken
constexpr double goalTime = 10.0;      // s from a shot to the referee's goal
constexpr double sceneTime = 8.0;      // s before a goal
constexpr double maxBallSpeed = 8.0;   // m/s; what is faster was carried
constexpr double maxSurprise = 0.3;    // m that a ball which rolls out lands elsewhere
constexpr double minKickSpeed = 0.8;   // m/s, of a kick that nobody tells of
constexpr double minSpeedUp = 0.5;     // m/s
constexpr double reachTime = 0.5;      // s in which the speed of a kick is measured

bool plays(const TallyRobot& robot) {
  return robot.place && !robot.penalised && !(robot.link && robot.link->timedOut);
}

const TallyRobot* nearestTo(const Point& ball, const TallyMoment& moment, double reach) {
  const TallyRobot* nearest = nullptr;
  for (const TallyRobot& robot : moment.robots) {
    if (!plays(robot)) continue;
    const double away = distance(*robot.place, ball);
    if (away >= reach) continue;
    reach = away;
    nearest = &robot;
  }
  return nearest;
}

const TallyRobot* robotOf(const TallyMoment& moment, RobotUid uid) {
  const auto found = std::ranges::find(moment.robots, uid, &TallyRobot::uid);
  return found == moment.robots.end() ? nullptr : &*found;
}

}  // namespace

void PlayFollower::take(const TallyMoment& moment, std::span<const RobotUid> kicked,
                        bool isBefore) {
  m_isBefore = isBefore;
  for (const auto& [colour, team] : moment.teams) {
    if (team.attacksRight) m_attacksRight[colour] = *team.attacksRight;
  }
  followPenalties(moment);
  followBall(moment, kicked);
  followRestart(moment);
  followGoals(moment);
  keepSample(moment);
}

void PlayFollower::add(PlayEvent event) {
  if (!m_isBefore) m_events.push_back(std::move(event));
}

void PlayFollower::followBall(const TallyMoment& moment, std::span<const RobotUid> kicked) {
  const Sample* last = m_recent.empty() ? nullptr : &m_recent.back();
  const double step = last ? moment.time - last->time : 0.0;
  const bool follows = moment.ball && last && last->ball && step > 0.0 && step <= 1.0 &&
                       distance(*last->ball, *moment.ball) <= maxBallSpeed * step &&
                       !isOut(*last->ball, *moment.ball, step);
  const bool isCalled = moment.restart && (!m_restart || m_restart->taken);
  if (!moment.isInPlay || !follows || isCalled) {
    if (m_kick) endKick(moment, nullptr);
    m_holder.reset();
    m_rival.reset();
    m_velocity = {};
    // A kick after which the ball is gone at once: a goal, or past it.
    const TallyRobot* robot = kicked.empty() ? nullptr : robotOf(moment, kicked.back());
    if (robot && last && last->ball) takeHiddenKick(moment, *robot, *last->ball);
    if (!moment.isInPlay || !moment.ball || robot) return;
  }
  const TallyRobot* toucher = toucherOf(moment);
  const TallyRobot* kicker = follows ? kickerByMotion(moment) : nullptr;
  for (const RobotUid uid : kicked) {
    const TallyRobot* robot = robotOf(moment, uid);
    if (robot && robot->place) kicker = robot;
  }
  const bool kicksAgain = m_kick && std::ranges::count(kicked, m_kick->who.uid) > 0;
  if (m_kick && kicker) endKick(moment, kicksAgain ? robotOf(moment, m_kick->who.uid) : kicker);
  if (m_kick) followKick(moment, toucher);
  if (kicker) {
    startKick(moment, *kicker);
    followKick(moment, nullptr);
  }
  if (kicker || toucher) m_lastTouch = whoOf(kicker ? *kicker : *toucher);
  if (follows) {
    m_velocity = {(moment.ball->x - last->ball->x) / step, (moment.ball->y - last->ball->y) / step};
  }
  followControl(moment);
}

/// Whether a ball that rolled out of the field was put back.
bool PlayFollower::isOut(const Point& last, const Point& ball, double step) const {
  const Point rolled{last.x + m_velocity.x * step, last.y + m_velocity.y * step};
  return (std::abs(rolled.x) > m_field.halfLength() || std::abs(rolled.y) > m_field.halfWidth()) &&
         distance(rolled, ball) > maxSurprise;
}

double PlayFollower::gapOf(const TallyRobot& robot, const Point& ball) const {
  const double radius = robot.radius > 0.0 ? robot.radius : m_field.robotRadius;
  return distance(*robot.place, ball) - radius - m_field.ballRadius;
}

void PlayFollower::takeHiddenKick(const TallyMoment& moment, const TallyRobot& robot,
                                  const Point& from) {
  m_lastTouch = whoOf(robot);
  const auto attacks = m_attacksRight.find(robot.team);
  if (attacks == m_attacksRight.end()) return;
  const double toLine = m_field.halfLength() - (attacks->second ? from.x : -from.x);
  if (toLine > minPass || std::abs(from.y) > m_field.goalWidth / 2.0 + wideMargin) return;
  PlayEvent shot;
  shot.kind = PlayKind::Shot;
  shot.outcome = PlayOutcome::Wide;
  shot.time = shot.end = moment.time;
  shot.team = robot.team;
  shot.robot = robot.uid;
  shot.name = robot.name;
  shot.from = shot.to = from;
  add(std::move(shot));
}

/// The nearest robot at the ball, or that beside a ball whose way has changed.
const TallyRobot* PlayFollower::toucherOf(const TallyMoment& moment) const {
  const auto nearest = [&](double least) {
    const TallyRobot* found = nullptr;
    for (const TallyRobot& robot : moment.robots) {
      if (!plays(robot)) continue;
      // A live robot knows best itself how far the ball is.
      const bool sees = robot.link && robot.ballDistance;
      const double gap = gapOf(robot, *moment.ball) +
                         (sees ? *robot.ballDistance - distance(*robot.place, *moment.ball) : 0.0) -
                         (sees ? liveMargin : 0.0);
      if (gap >= least) continue;
      least = gap;
      found = &robot;
    }
    return found;
  };
  if (const TallyRobot* near = nearest(touchMargin)) return near;
  // What robots report of the ball's way trembles.
  if (!m_kick || moment.ballSigma > 0.0 || m_recent.empty() || !m_recent.back().ball)
    return nullptr;
  const Point& before = *m_recent.back().ball;
  const double step = moment.time - m_recent.back().time;
  const double speed = std::hypot(m_velocity.x, m_velocity.y);
  if (speed * step < 0.02 || distance(m_kick->from, before) < minPass) return nullptr;
  const Point moved{moment.ball->x - before.x, moment.ball->y - before.y};
  const double along = (moved.x * m_velocity.x + moved.y * m_velocity.y) / speed;
  const double across = std::abs(moved.x * m_velocity.y - moved.y * m_velocity.x) / speed;
  const double usual = 0.3 * speed * step, error = 0.01;
  const bool deflected = along < usual - error || across > usual + error;
  return deflected ? nearest(deflectMargin) : nullptr;
}

/// A ball that suddenly rolls away from a robot which does not tell when it kicks.
const TallyRobot* PlayFollower::kickerByMotion(const TallyMoment& moment) const {
  const Sample& last = m_recent.back();
  const double step = moment.time - last.time;
  const double before = std::hypot(m_velocity.x, m_velocity.y);
  const double now = distance(*last.ball, *moment.ball) / step;
  if (now < minKickSpeed || now < before + minSpeedUp) return nullptr;
  const TallyRobot* near = nearestTo(*last.ball, moment, ballReach);
  return near && !near->tellsKicks ? near : nullptr;
}

void PlayFollower::startKick(const TallyMoment& moment, const TallyRobot& robot) {
  // The ball lay at the robot's feet, before it rolled away or after it had arrived.
  Point from = *moment.ball;
  double since = moment.time;
  if (!m_recent.empty() && m_recent.back().ball &&
      gapOf(robot, *m_recent.back().ball) < gapOf(robot, from)) {
    from = *m_recent.back().ball;
    since = m_recent.back().time;
  }
  m_kick = Kick{
      whoOf(robot), moment.time, since, from, from, 0.0, std::max(robot.sigma, moment.ballSigma)};
}

void PlayFollower::followKick(const TallyMoment& moment, const TallyRobot* toucher) {
  Kick& kick = *m_kick;
  if (moment.time - kick.time > maxPassTime) return endKick(moment, nullptr);
  if (toucher && distance(kick.from, *moment.ball) >= minPass &&
      distance(kick.from, kick.last) >= minPass - stepWay) {
    return endKick(moment, toucher);
  }
  // Somebody has taken the ball where it lay.
  if (moment.time - kick.time > duelTime && toucher && toucher->uid != kick.who.uid) {
    m_kick.reset();
    return;
  }
  const double step = moment.time - kick.lastTime;
  if (step > 0.0 && moment.time - kick.time <= reachTime) {
    const double moved = distance(kick.last, *moment.ball);
    const double middle = distance(kick.from, kick.last) + moved / 2.0;
    kick.reach = std::max(kick.reach, middle + sim::rollingDistance(m_field.surface, moved / step));
  }
  kick.last = *moment.ball;
  kick.lastTime = moment.time;
}

/// Whether the ball headed for the opponents' goal and would have reached it.
std::optional<PlayOutcome> PlayFollower::shotOf(const Kick& kick) const {
  const auto attacks = m_attacksRight.find(kick.who.team);
  if (attacks == m_attacksRight.end()) return {};
  const double goalX = (attacks->second ? 1.0 : -1.0) * m_field.halfLength();
  const double toGoal = goalX - kick.from.x, moved = kick.last.x - kick.from.x;
  if (moved * toGoal <= 0.0) return {};
  const double whole = toGoal / moved;
  const double y = kick.from.y + whole * (kick.last.y - kick.from.y);
  if (kick.reach < whole * distance(kick.from, kick.last)) return {};
  if (std::abs(y) > m_field.goalWidth / 2.0 + wideMargin) return {};
  return std::abs(y) <= m_field.goalWidth / 2.0 ? PlayOutcome::Saved : PlayOutcome::Wide;
}

/// `toucher`: who got the ball; null if play was stopped or nobody did for long.
void PlayFollower::endKick(const TallyMoment& moment, const TallyRobot* toucher) {
  const Kick kick = *m_kick;
  m_kick.reset();
  // Of a goal from nearby, too.
  if (distance(kick.from, kick.last) < (toucher ? minPass - stepWay : minShot)) return;
  const bool isLate = moment.time - kick.time > maxPassTime;
  // A robot that gets its own kick back has not passed.
  if ((toucher && toucher->uid == kick.who.uid) || (isLate && !toucher)) return;
  PlayEvent event;
  event.time = kick.time;
  event.end = moment.time;
  event.team = kick.who.team;
  event.robot = kick.who.uid;
  event.name = kick.who.name;
  event.from = kick.from;
  event.to = kick.last;
  event.sigma = kick.sigma;
  if (toucher) {
    event.other = toucher->uid;
    event.otherName = toucher->name;
  }
  const bool isMate = toucher && toucher->team == kick.who.team;
  const auto shot = isMate ? std::nullopt : shotOf(kick);
  if (!shot && !toucher && distance(kick.from, kick.last) < minPass) return;
  event.kind = shot ? PlayKind::Shot : PlayKind::Pass;
  event.outcome = shot      ? *shot
                  : isMate  ? PlayOutcome::Completed
                  : toucher ? PlayOutcome::Intercepted
                            : PlayOutcome::Out;
  if (shot && m_restart && m_restart->what.team == kick.who.team) m_restart->hasShot = true;
  add(std::move(event));
}

/// A team has the ball while one of its robots is nearest to it and in reach; the other team has
/// won it when that lasts.
void PlayFollower::followControl(const TallyMoment& moment) {
  const TallyRobot* near = nearestTo(*moment.ball, moment, ballReach);
  if (!near) return;
  if (!m_holder || near->team == m_holder->who.team) {
    if (!m_holder || m_holder->who.uid != near->uid) {
      m_holder = Control{whoOf(*near), moment.time, *moment.ball};
    }
    m_rival.reset();
    return;
  }
  if (!m_rival || m_rival->who.team != near->team) {
    m_rival = Control{whoOf(*near), moment.time, *moment.ball};
  }
  if (moment.time - m_rival->since < controlTime - 1e-6) return;
  PlayEvent event;
  event.kind = PlayKind::BallWon;
  event.time = event.end = m_rival->since;
  event.team = m_rival->who.team;
  event.robot = m_rival->who.uid;
  event.name = m_rival->who.name;
  event.other = m_holder->who.uid;
  event.otherName = m_holder->who.name;
  event.from = m_rival->place;
  event.sigma = std::max(near->sigma, moment.ballSigma);
  add(std::move(event));
  if (m_restart && m_restart->taken && m_restart->what.team != m_rival->who.team) {
    endRestart(m_rival->since, PlayOutcome::Lost);
  }
  m_holder = std::exchange(m_rival, {});
}

void PlayFollower::followRestart(const TallyMoment& moment) {
  if (moment.restart && (!m_restart || m_restart->taken || m_restart->what != *moment.restart)) {
    if (m_restart) endRestart(moment.time, PlayOutcome::Out);
    PlayEvent event;
    event.kind = PlayKind::SetPlay;
    event.outcome = PlayOutcome::GoesOn;
    event.time = event.end = moment.time;
    event.team = moment.restart->team;
    event.from = moment.ball;
    event.sigma = moment.ballSigma;
    event.detail =
        moment.restart->kind == SetPlay::None ? "kick-off" : labelOf(moment.restart->kind);
    m_restart = Restart{*moment.restart, m_events.size(), {}, false};
    add(std::move(event));
    if (m_isBefore) m_restart.reset();
    return;
  }
  if (!m_restart) return;
  PlayEvent& event = m_events[m_restart->event];
  if (!m_restart->taken) {
    if (moment.restart || !moment.isInPlay) {
      event.from = moment.ball;
      return;
    }
    m_restart->taken = moment.time;
    m_lastTouch.reset();
  }
  event.end = moment.time;
  event.to = moment.ball;
  if (event.robot == RobotUid{} && m_lastTouch && m_lastTouch->team == event.team) {
    event.robot = m_lastTouch->uid;
    event.name = m_lastTouch->name;
  }
  if (!moment.isInPlay) {
    // Maybe for a goal, which ends it as such.
    endRestart(moment.time, PlayOutcome::Out);
  } else if (moment.time - *m_restart->taken >= restartTime) {
    endRestart(moment.time, PlayOutcome::Kept);
  }
}

void PlayFollower::endRestart(double time, PlayOutcome outcome) {
  PlayEvent& event = m_events[m_restart->event];
  event.end = time;
  event.outcome = m_restart->hasShot ? PlayOutcome::Shot : outcome;
  m_restart.reset();
}

void PlayFollower::followGoals(const TallyMoment& moment) {
  for (const auto& [colour, team] : moment.teams) {
    if (!team.score) continue;
    const auto [known, isNew] = m_scores.try_emplace(colour, *team.score);
    if (std::exchange(known->second, *team.score) + 1 != *team.score || isNew || m_isBefore) {
      continue;
    }
    PlayEvent goal;
    goal.kind = PlayKind::Goal;
    goal.time = goal.end = moment.time;
    goal.team = colour;
    if (m_lastTouch) {
      goal.robot = m_lastTouch->uid;
      goal.name = m_lastTouch->name;
    }
    double played = moment.time - 2.0 * tallyStep;  // s, when the ball was certainly not yet in
    for (auto event = m_events.rbegin(); event != m_events.rend(); ++event) {
      if (moment.time - event->time > goalTime + restartTime) break;
      const bool isRecent = moment.time - event->end <= goalTime;
      if (event->team != colour || !isRecent) continue;
      if (event->kind == PlayKind::Shot &&
          (event->outcome == PlayOutcome::Saved || event->time == moment.time) &&
          goal.from == std::nullopt) {
        event->outcome = PlayOutcome::Goal;
        played = event->time;
        event->other = {};
        event->otherName.clear();
        goal.from = event->from;
        goal.sigma = event->sigma;
        goal.robot = event->robot;
        goal.name = event->name;
      } else if (event->kind == PlayKind::SetPlay &&
                 (event->outcome == PlayOutcome::Out || event->outcome == PlayOutcome::Shot)) {
        event->outcome = PlayOutcome::Goal;
      }
    }
    addScene(moment, goal, played);
    add(std::move(goal));
  }
}

/// The ball's way up to where it was carried back.
void PlayFollower::addScene(const TallyMoment& moment, const PlayEvent& goal, double played) {
  GoalScene scene{goal, {}, {}};
  std::vector<RobotUid> uids;
  for (const TallyRobot& robot : moment.robots) {
    scene.robots.push_back({robot.name, robot.team, {}});
    uids.push_back(robot.uid);
  }
  for (const Sample& sample : m_recent) {
    if (!sample.ball) continue;
    if (!scene.ball.empty() && distance(scene.ball.back(), *sample.ball) > maxBallSpeed * 0.2) {
      if (sample.time >= played) break;  // carried back after the goal
      scene.ball.clear();
      for (GoalScene::Path& robot : scene.robots) robot.points.clear();
    }
    scene.ball.push_back(*sample.ball);
    for (const auto& [uid, place] : sample.robots) {
      const auto index = std::ranges::find(uids, uid) - uids.begin();
      if (index < std::ssize(uids))
        scene.robots[static_cast<std::size_t>(index)].points.push_back(place);
    }
  }
  std::erase_if(scene.robots, [](const GoalScene::Path& path) { return path.points.empty(); });
  if (!scene.ball.empty()) m_goals.push_back(std::move(scene));
}

void PlayFollower::followPenalties(const TallyMoment& moment) {
  for (const TallyRobot& robot : moment.robots) {
    const auto known = m_penalties.find(robot.uid);
    if (known != m_penalties.end()) {
      if (known->second) m_events[*known->second].end = moment.time;
      if (robot.penalised) continue;
      if (known->second) m_events[*known->second].outcome = PlayOutcome::None;
      m_penalties.erase(known);
    } else if (robot.penalised) {
      PlayEvent event;
      event.kind = PlayKind::Penalty;
      event.outcome = PlayOutcome::GoesOn;
      event.time = event.end = moment.time;
      event.team = robot.team;
      event.robot = robot.uid;
      event.name = robot.name;
      event.from = robot.place;
      event.sigma = robot.sigma;
      event.detail = labelOf(robot.penalty);
      m_penalties[robot.uid] = m_isBefore ? std::nullopt : std::optional(m_events.size());
      add(std::move(event));
    }
  }
}

void PlayFollower::keepSample(const TallyMoment& moment) {
  Sample sample{moment.time, moment.ball, {}};
  if (!m_recent.empty() && moment.time - m_recent.front().time > sceneTime) {
    sample.robots = std::move(m_recent.front().robots);  // reuses its memory
    sample.robots.clear();
    m_recent.pop_front();
  }
  for (const TallyRobot& robot : moment.robots) {
    if (plays(robot)) sample.robots.emplace_back(robot.uid, *robot.place);
  }
  m_recent.push_back(std::move(sample));
}

std::vector<PlayEvent> PlayFollower::events() const {
  std::vector<PlayEvent> out = m_events;
  std::ranges::stable_sort(out, {}, &PlayEvent::time);
  return out;
}

}  // namespace pitchboard::link

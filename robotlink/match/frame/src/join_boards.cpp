// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/join_boards.h>

#include <algorithm>
#include <utility>

#include <robotlink/frame/build_robot.h>

namespace pitchboard::link {
namespace {

bool isOfThisComputer(const RobotFrame& board) {
  return board.link->sender.address == telemetry::Address{};
}

/// The robot of the first `count` that sends messages from the address of this blackboard; null:
/// none. Robots that share the address of this computer are told apart by their teams only.
RobotFrame* senderAt(const RobotFrame& board, MatchFrame& frame, std::size_t count) {
  RobotFrame* other = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    RobotFrame& robot = frame.robots[i];
    if (robot.key.number != board.key.number || !robot.link) continue;
    if (robot.link->sender.address != board.link->sender.address) continue;
    if (robot.key.team == board.key.team) return &robot;
    const bool isKnown = robot.key.team != 0 && board.key.team != 0;
    if (other == nullptr && !(isKnown && board.link->sender.address.isLoopback())) other = &robot;
  }
  return other;
}

/// The robot of the first `count` that this blackboard is; null: none.
RobotFrame* senderOf(const RobotFrame& board, MatchFrame& frame, std::size_t count) {
  const auto first = frame.robots.begin(), last = first + static_cast<std::ptrdiff_t>(count);
  const auto same = std::ranges::find(first, last, board.uid, &RobotFrame::uid);
  if (same != last) return &*same;
  if (!isOfThisComputer(board)) return senderAt(board, frame, count);
  RobotFrame* unknown = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    RobotFrame& robot = frame.robots[i];
    if (robot.key.number != board.key.number || !robot.link) continue;
    const auto colour = colourAt(robot.key.team, frame.teams);
    if (robot.key.sender == 0 && colour == board.identity.team) return &robot;
    if (robot.key.sender == 0 && !colour && unknown == nullptr) unknown = &robot;
  }
  return unknown;
}

/// The place of its colour in the frame's teams, which may become one more.
int placeOf(const RobotFrame& board, MatchFrame& frame) {
  const auto teams = static_cast<int>(frame.teams.size());
  if (board.key.team != placeByColour) return board.key.team;
  for (int place = 0; place < teams; ++place) {
    if (colourAt(place, frame.teams) == board.identity.team) return place;
  }
  // Place 0 is of robots of no team, once there are teams.
  for (int place = teams > 1 ? 1 : 0; place < teams; ++place) {
    if (colourAt(place, frame.teams)) continue;
    const RobotFrame* other = frame.robot(RobotKey{place, board.key.number, 0});
    if (other == nullptr || other->identity.team == board.identity.team) return place;
  }
  frame.teams.push_back({0, {}, board.identity.team, false});
  return teams;
}

/// A blackboard that was never written would put its robot into the corner of the field.
void forgetUnwritten(RobotFrame& board) {
  const std::vector<double>& values = board.board.values;
  const auto isZero = [](double value) { return value == 0.0; };
  if (values.empty() || !std::ranges::all_of(values, isZero)) return;
  board.belief.reset();
  board.ball.reset();
  board.pose = {};
  board.headYaw = 0.0;
}

void join(RobotFrame& robot, RobotFrame& board, const Teams& teams) {
  if (isOfThisComputer(board) && !colourAt(robot.key.team, teams)) {
    robot.name = board.identity.name();
    robot.identity.team = board.identity.team;
  }
  robot.boardKey = board.boardKey;
  if (board.timedOut()) return;
  if (robot.timedOut() || !robot.battery) robot.battery = board.battery;
  if (robot.timedOut()) robot.link = std::move(board.link);
  robot.pose = board.pose;
  robot.headYaw = board.headYaw;
  robot.belief = board.belief;
  robot.sigma = board.sigma;
  robot.ball = board.ball;
  robot.decided = board.decided;
  robot.action = board.action;
  robot.lamps = board.lamps;
  robot.board = std::move(board.board);
}

}  // namespace

std::vector<RobotUid> joinBoards(MatchFrame& frame, std::vector<RobotFrame> boards) {
  const std::size_t count = frame.robots.size();
  std::vector<RobotUid> uids(boards.size());
  std::vector<RobotUid> joined;
  frame.robots.reserve(count + boards.size());
  std::ranges::for_each(boards, forgetUnwritten);
  // Boards of this computer come first, so that a recording gives all of them the same keys.
  for (const bool here : {true, false}) {
    for (std::size_t i = 0; i < boards.size(); ++i) {
      RobotFrame& board = boards[i];
      if (isOfThisComputer(board) != here) continue;
      RobotFrame* robot = senderOf(board, frame, count);
      if (robot != nullptr && std::ranges::find(joined, robot->uid) == joined.end()) {
        join(*robot, board, frame.teams);
        joined.push_back(uids[i] = robot->uid);
        continue;
      }
      const int place = placeOf(board, frame);
      board.key = frame.freeKey({place, board.key.number, 0});
      board.name = robotName(board.key, frame.teams);
      if (here) {
        board.name = board.identity.name();
        if (board.key.sender > 0) board.name += " (" + std::to_string(board.key.sender + 1) + ")";
      }
      // A robot of this computer has taken its messages.
      if (frame.robot(board.uid) != nullptr) board.uid = uidOf(board.key);
      uids[i] = board.uid;
      frame.robots.push_back(std::move(board));
    }
  }
  if (!boards.empty()) {
    frame.sortRobots();
    frame.teamBalls = agreedBalls(frame.robots);
  }
  return uids;
}

}  // namespace pitchboard::link

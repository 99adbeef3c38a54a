// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Robots of topics, recorded or live: what a mapping finds in messages, and the replies of robots
// to a referee, become rows of each robot and robots of a frame. Times are seconds of the source.
// Not thread-safe.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/live/topic_mapping.h>
#include <robotlink/live/transform_tree.h>
#include <telemetry/referee/gamecontroller.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

struct TopicRobot;

class TopicRobots {
 public:
  static constexpr std::size_t maxRobots = 60;
  static constexpr double ballHold = 1.0;  ///< s; then a ball is not seen any more

  struct Options {
    sim::FieldSpec field{};
    double timeout = 2.0;  ///< s; then a robot is offline
    int source = 0;        ///< 0 to maxSources; robots of two sources are different ones
    /// Returns a free name for the group of a robot; empty: the name is free.
    std::function<std::string(const std::string&)> nameOf{};
    /// Returns a number that is free in a team, the wanted one if it is; empty: it is free.
    std::function<int(TeamColor, int)> numberOf{};
  };
  static constexpr int maxSources = 100;

  /// `rows` must outlive this.
  TopicRobots(telemetry::RowSink& rows, const TopicMapping& mapping, Options options);
  ~TopicRobots();

  /// Further topics are known: robots get further values, and robots are added. Those that are
  /// known keep number and team.
  void update(const TopicMapping& mapping);
  /// Does not show a robot until its next message.
  void forget(RobotUid robot);
  void setTimeout(double seconds) { m_options.timeout = seconds; }

  /// Takes what this message says of robots.
  void take(const telemetry::RecordedTopic& topic, const telemetry::RecordedMessage& message,
            double time);
  /// Takes a robot's reply to the referee, whose game says which way it plays.
  void take(const telemetry::RobotReply& reply, const Game& game, double time);

  /// Returns the robots that were received, for joinBoards().
  std::vector<RobotFrame> frames(double time, const std::optional<Game>& game) const;
  /// Returns falls since the last call.
  std::vector<MatchEvent> drainEvents() { return std::exchange(m_events, {}); }
  /// Returns where a robot's messages come from.
  std::string sourceOf(RobotUid robot) const;
  std::vector<std::string> names() const;
  /// Returns whether a robot of this team has this number.
  bool hasNumber(TeamColor team, int number) const;
  std::uint64_t variables() const;
  void addNotes(std::vector<std::string>& notes) const;

 private:
  TopicRobot& add(const MappedRobot& mapped);
  void identify(TopicRobot& robot);
  TopicRobot* replying(const telemetry::RobotReply& reply, const Game& game);
  void takeTransformed(const std::string& frame, double time);
  TopicRobot* ofFrame(const std::string& frame);
  TopicRobot* addOfFrame(const std::string& frame);
  void takeFallen(TopicRobot& robot, const telemetry::RecordedMessage& message, double time);
  void setFallen(TopicRobot& robot, bool isFallen, double time);
  void write(TopicRobot& robot, double time);

  telemetry::RowSink& m_rows;
  Options m_options;
  std::vector<std::unique_ptr<TopicRobot>> m_robots;
  TransformTree m_tree;
  std::vector<MatchEvent> m_events;
  std::uint64_t m_refused = 0;
};

}  // namespace pitchboard::link

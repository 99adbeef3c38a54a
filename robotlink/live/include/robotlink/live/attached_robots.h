// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Robots whose blackboard lies on this computer: any System V segment, looked at and never written,
// each sampled by a thread of its own at its own rate, at fixed times. LiveWatch shows them as it
// shows robots that are heard; beside a simulated match they are rows. A segment that is removed is
// said, and taken up when it comes again.

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/frame/match_frame.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

struct AttachedBoard {
  static constexpr double slowest = 0.1, fastest = 1000.0;
  int key = 100;
  std::string catalogFile;  ///< empty: the published map
  std::size_t bytes = 0;    ///< of the segment; 0: as the catalog says
  int robot = 0;            ///< number on the shirt; 0: key / 100
  double rate = 60.0;       ///< samples per second
  TeamColor team = TeamColor::Blue;
  bool operator==(const AttachedBoard&) const = default;
  int number() const { return robot > 0 ? robot : std::max(1, key / 100); }
};

/// "100,catalog=FILE,size=4096,robot=3,rate=100,team=red". Errors name the part.
Result<AttachedBoard> parseAttachedBoard(std::string_view text);
/// Text that parseAttachedBoard() reads back, if the catalog's path has no comma.
std::string attachedBoardText(const AttachedBoard& board);
/// Refuses a number out of range, two boards of one key, and a catalog that cannot be read.
Result<void> validate(const std::vector<AttachedBoard>& boards);

/// Names of their groups of rows, as a simulation would call the robots ("B3"); of two with one
/// name the second one has its key behind it. So has one whose name is among `taken`.
std::vector<std::string> boardNames(const std::vector<AttachedBoard>& boards,
                                    const std::vector<std::string>& taken = {});

/// How a robot is heard whose blackboard is read `rate` times a second; `gone`: it was removed.
telemetry::LinkHealth boardLink(double age, double rate, bool gone);

/// A sample of a blackboard, as RowView.
struct BoardRow {
  double time = 0.0;  ///< s, of the source
  std::vector<std::uint32_t> words;
  std::vector<double> values{};
};

/// How one board is doing.
struct AttachedStatus {
  AttachedBoard board;
  bool attached = false;
  std::string problem;  ///< why it is not attached; empty when it is
  std::uint64_t samples = 0, missed = 0;
  double rate = 0.0;  ///< samples per second reached over the last second
};

/// Takes the rows of a board; called with each batch.
using BoardRowsTaker =
    std::function<void(const telemetry::GroupInfo& group, std::span<const BoardRow> rows)>;

class AttachedRobots {
 public:
  /// `seconds`: the time of the rows, s; called on any thread. `catalog`: of boards that name none.
  explicit AttachedRobots(std::function<double()> seconds,
                          VariableCatalog catalog = VariableCatalog::published());
  ~AttachedRobots();

  /// Attaches these and no others; a board that stays as it is goes on. They must be valid.
  /// `taken`: names that their groups must not have.
  void set(const std::vector<AttachedBoard>& boards, const std::vector<std::string>& taken = {});
  /// Each board that was ever attached as a robot, for joinBoards().
  std::vector<RobotFrame> robots(const sim::FieldSpec& field) const;
  /// The rows since the last call.
  void takeRows(const BoardRowsTaker& take);
  std::vector<AttachedStatus> status() const;

 private:
  class Reader;
  const std::function<double()> m_seconds;
  const VariableCatalog m_catalog;
  std::vector<std::unique_ptr<Reader>> m_readers;
};

/// Puts rows of boards into a sink; a group for each board.
class BoardRowKeeper {
 public:
  explicit BoardRowKeeper(std::shared_ptr<telemetry::RowSink> sink) : m_sink(std::move(sink)) {}
  void take(const telemetry::GroupInfo& group, std::span<const BoardRow> rows) {
    take(group.name, group, {group.name, {}}, rows);
  }
  /// What a group is called by now, and attributes besides its own.
  struct Name {
    std::string name;
    std::map<std::string, std::string> attributes;
    bool operator==(const Name&) const = default;
  };
  /// Of the board that is always called `board`.
  void take(const std::string& board, const telemetry::GroupInfo& group, const Name& name,
            std::span<const BoardRow> rows);

 private:
  struct Known {
    telemetry::GroupId id = 0;
    Name name;
    std::size_t columns = 0;
  };
  std::shared_ptr<telemetry::RowSink> m_sink;
  std::map<std::string, Known> m_groups;
};

}  // namespace pitchboard::link
